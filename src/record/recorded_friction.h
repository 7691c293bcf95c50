/* Friction of the cycles of a record against time, from its start on. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RECORDED_FRICTION_H
#define WT_RECORD_RECORDED_FRICTION_H

#include "record/measured_friction.h"
#include "record/numerics/running_in_curve.h"

/* First sliding step of a record, on a surface without a layer. Later steps begin with one. */
typedef struct recorded_run {
    measured_step at;
    size_t n, step;    /* cycles; number of the step in its file, from 1 on */
    double begin;      /* start of the first cycle with a friction, from the start of sliding on
                          [s] */
    double *end;       /* [n] ends of the cycles, from the start of the step on [s] */
    double *friction;  /* [n] */
    double running_in; /* cycles of running-in, by the scatter alone; NaN if unknown */
    const char *note;  /* reason of exclusion, or "" */
} recorded_run;

/* Returns [*n] runs, freed by recorded_free. */
recorded_run *recorded_read(const table_view *record, const table_view *cycles,
                            const wt_sliding *sliding, size_t *n);
void recorded_free(recorded_run *runs, size_t n);

/* Returns the cycles up to a time, as means over equal numbers of cycles. */
running_in_series recorded_read_series(const recorded_run *r, double until);
/* Returns the number of these means. */
size_t recorded_mean_count(const recorded_run *r, double until);
/* True if each mean holds more than one cycle. */
bool recorded_is_averaged(const recorded_run *r, double until);

#endif
