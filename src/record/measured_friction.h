/* The steps of records that a prediction is held against (internal to record).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_MEASURED_FRICTION_H
#define WT_RECORD_MEASURED_FRICTION_H

#include "core/table/registry.h"
#include "weartrack/flow.h"

/* Friction is predicted at what the record says, and at what the case says where it says nothing.
 */
typedef struct measured_step {
    double velocity, temperature, pressure; /* temperature NaN: the reference of the rubber */
    double friction, error;
    wt_interval measured; /* the same with its interval */
    const char *note;     /* why it is not compared, or "" */
    const char *file;     /* borrowed from the table */
} measured_step;

typedef struct measured {
    measured_step *step; /* by temperature, pressure and velocity; then those not compared */
    size_t n, n_all;
    char remarks[640]; /* what was taken for granted */
} measured;

/* Of a row of the record, what it does not say as the case has it. */
measured_step measured_step_of(const table_view *record, size_t row, const wt_sliding *sliding);
/* Its pressure and temperature, with the errors of the case. */
void measured_conditions(const measured_step *step, wt_sliding *sliding);

/* What the record does not say and the case does, in words; of the first steps alone, or of all. */
void measured_taken(const table_view *record, bool first_steps, char *remarks, size_t size);

wt_status measured_make(const table_view *record, const wt_sliding *sliding, measured *m,
                        wt_error *err) WT_NODISCARD;
/* One more in the key remarks. */
void measured_remark(measured *m, const char *words);
void measured_clear(measured *m);
/* How many steps from `first` on have its temperature and pressure. */
size_t measured_alike(const measured *m, size_t first);

#endif
