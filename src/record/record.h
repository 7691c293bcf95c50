/* Parts of the job of friction records. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RECORD_H
#define WT_RECORD_RECORD_H

#include "job/inputs.h"
#include "weartrack/record.h"

#include "core/table/registry.h"

/* Conditions of a record; NaN if unknown. */
typedef struct record_conditions {
    double velocity, rotation, normal_force, pressure, temperature;
} record_conditions;
/* Returns means over cycles; the velocity is weighted by their time. */
record_conditions conditions_mean(const wt_cycle *cycles, size_t n);
bool conditions_are_equal(record_conditions a, record_conditions b);
/* True if nothing slides. */
bool conditions_are_at_rest(record_conditions at);
/* Returns the number of cycles from the first on that belong to one step. */
size_t conditions_step_length(const wt_cycle *cycles, size_t n);

/* Repeated measurements of one quantity. The error of their mean is the scatter if it exceeds the
 * stated errors. */
typedef struct record_group {
    double n, mean, squares,
        error_squares; /* squares about the mean; sum of squared standard errors */
} record_group;
void record_group_add(record_group *s, wt_estimate e);
/* Returns the mean with its standard error; NaN if the group is empty. */
wt_estimate record_group_mean(const record_group *s, const char *unit);

/* Wear rates. Several rates of one run (by mass, by area) count as one measurement. */
typedef struct wear_rates {
    record_group run, all; /* current run; previous runs */
    double freedom;        /* of the last run */
} wear_rates;
void wear_rates_close_run(wear_rates *rates);
double wear_rates_df(const wear_rates *rates);

/* True if any input for the wear is stated. */
bool wear_is_requested(const wt_record_job *job);
wt_record_job wear_without_inputs(wt_record_job job);
/* Mean cross-section of the profiles of job->profile, with their scatter. */
wt_status wear_profile_area(const wt_record_job *job, const wt_job *work, wt_estimate *area,
                            wt_error *err);
/* Adds the rows of a file to the table of the wear. `radius` [m] of the track; NaN if unknown. The
 * rates are added to `rates` as one run. */
wt_status wear_add(const wt_record_job *job, const wt_record *record, const wt_cycles *cycles,
                   wt_estimate radius, const char *file, table_writer *t, wear_rates *rates,
                   wt_error *err);

#endif
