/* Measured steps of records that a prediction is compared with. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_MEASURED_FRICTION_H
#define WT_RECORD_MEASURED_FRICTION_H

#include "core/table/registry.h"
#include "weartrack/friction.h"

/* The conditions are those of the record. The case replaces conditions that the record does not
 * state. */
typedef struct measured_step {
    double velocity, temperature, pressure; /* [m/s], [K], [Pa]; temperature NaN: the reference
                                               temperature of the rubber */
    double friction, error;
    wt_interval measured; /* friction with its interval */
    const char *note;     /* reason of exclusion, or "" */
    const char *file;     /* borrowed from the table */
} measured_step;

typedef struct measured {
    measured_step *step; /* sorted by temperature, pressure and velocity; excluded steps last */
    size_t n, n_all;
    char remarks[640]; /* assumptions about conditions */
} measured;

/* Sets pressure and temperature of the step, with the relative errors of the case. */
void measured_step_conditions(const measured_step *step, wt_sliding *sliding);

/* Appends remarks on conditions that come from the case, for the first steps or for all steps. */
void measured_default_remarks(const table_view *record, bool first_steps, char *remarks,
                              size_t size);

wt_status measured_steps_read(const table_view *record, const wt_sliding *sliding, measured *m,
                              wt_error *err) WT_NODISCARD;
/* Appends a remark to the key "remarks". */
void measured_steps_add_remark(measured *m, const char *words);
void measured_steps_clear(measured *m);
/* Returns the number of steps from `first` on with the same temperature and pressure. */
size_t measured_group_length(const measured *m, size_t first);
/* ---- cycles of running-in -------------------------------------------------------------------- */

/* First sliding step of a record, on a surface without a layer. Later steps begin with one. */
typedef struct recorded_run {
    measured_step at;
    size_t n, step;   /* cycles; number of the step in its file, from 1 on */
    double begin;     /* start of the first cycle with a friction, from the start of sliding on
                         [s] */
    double samples;   /* samples in a cycle */
    double *end;      /* [n] ends of the cycles, from the start of the step on [s] */
    double *friction; /* [n] */
    const char *note; /* reason of exclusion, or "" */
} recorded_run;

/* Returns [*n] runs, freed by recorded_free. */
recorded_run *recorded_read(const table_view *record, const table_view *cycles,
                            const wt_sliding *sliding, size_t *n);
void recorded_free(recorded_run *runs, size_t n);
#endif
