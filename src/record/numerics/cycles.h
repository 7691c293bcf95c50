/* Cycles of a friction record: which samples are one. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_CYCLES_H
#define WT_RECORD_NUMERICS_CYCLES_H

#include "weartrack/fit.h"

/* Samples of one cycle; of a double stroke `turn` is the first of the way back. */
typedef struct cycle_span {
    size_t first, turn, end;
} cycle_span;

typedef struct cycle_spans {
    cycle_span *span; /* [n], room for one at each sample */
    size_t n;
} cycle_spans;

/* Double strokes within the steps: by the turning points of the position, else by the changes of
 * sign of the friction. None are found where there is neither. */
void strokes_find(const wt_record *record, const double *friction, cycle_spans *spans);
/* Mean of the friction there and back, without the ends of the stroke. */
typedef struct stroke_means {
    double there, back;
} stroke_means;
stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span);

#endif
