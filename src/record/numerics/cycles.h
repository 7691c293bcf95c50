/* Division of a friction record into cycles. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_CYCLES_H
#define WT_RECORD_NUMERICS_CYCLES_H

#include "weartrack/core.h"

/* Samples of one cycle. `turn`: first sample of the return stroke of a double stroke. */
typedef struct cycle_span {
    size_t first, turn, end;
} cycle_span;

typedef struct cycle_spans {
    cycle_span *span; /* [n], allocated for one per sample */
    size_t n;
} cycle_spans;

/* Finds double strokes within the steps by turning points of the position, else by sign changes of
 * the friction. Finds none without either. */
void strokes_find(const wt_record *record, const double *friction, cycle_spans *spans);
/* Mean friction of the forward and the return stroke without the ends of the stroke. */
typedef struct stroke_means {
    double there, back;
} stroke_means;
stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span);

#endif
