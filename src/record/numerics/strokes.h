/* Double strokes of a reciprocating record, and their friction. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_STROKES_H
#define WT_RECORD_NUMERICS_STROKES_H

#include "weartrack/record.h"

/* Samples of one cycle. `turn`: first sample of the return stroke of a double stroke. */
typedef struct cycle_span {
    size_t first, turn, end;
} cycle_span;

typedef struct cycle_spans {
    cycle_span *span; /* [n], allocated for one per sample */
    size_t n;
} cycle_spans;

/* Mean friction of the forward and the return stroke without the ends of the stroke, and its
 * variance about them. */
typedef struct stroke_means {
    double there, back, variance;
} stroke_means;

/* Finds double strokes within the steps by turning points of the position, else by sign changes of
 * the friction. Finds none without either. */
void strokes_find(const wt_record *record, const double *friction, cycle_spans *spans);
stroke_means strokes_mean(const wt_record *record, const double *friction, cycle_span span);
/* True if friction of one sign is that of both directions, with a zero above it. A magnitude falls
 * to zero at both reversals; friction with a zero changes from one level to the other. */
bool strokes_have_zero(const wt_record *record, const double *friction, const cycle_spans *spans);

#endif
