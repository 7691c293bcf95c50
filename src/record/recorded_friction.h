/* Friction of the cycles of a record against time, from its start on (internal to
 * record). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RECORDED_FRICTION_H
#define WT_RECORD_RECORDED_FRICTION_H

#include "record/measured_friction.h"
#include "record/numerics/running_in_curve.h"

/* The first step of a record in which anything slides, of a surface without a layer: those that
 * follow begin with one. */
typedef struct recorded {
    measured_step at;
    size_t n, step;    /* of its file, from 1 on */
    double begin;      /* of the first that has a friction, from the start of sliding on [s] */
    double *end;       /* [n] of the cycles, from the start of the step on [s] */
    double *friction;  /* [n] */
    double running_in; /* cycles before it is steady by itself; NaN: not known */
    const char *note;  /* why it is not compared, or "" */
} recorded;

/* *runs [*n], to be freed by recorded_free. */
wt_status recorded_read(const table_view *record, const table_view *cycles,
                        const wt_sliding *sliding, recorded **runs, size_t *n,
                        wt_error *err) WT_NODISCARD;
void recorded_free(recorded *runs, size_t n);

/* The cycles up to a time, as means of equal numbers of them. */
wt_status recorded_series(const recorded *r, double until, running_in_series *s,
                          wt_error *err) WT_NODISCARD;
/* How many means those are. */
size_t recorded_means(const recorded *r, double until);
/* Whether such means hold more than one cycle. */
bool recorded_is_joined(const recorded *r, double until);

#endif
