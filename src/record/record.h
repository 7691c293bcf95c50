/* Parts of the job of friction records. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_RECORD_H
#define WT_RECORD_RECORD_H

#include "job/inputs.h"

#include "core/table/registry.h"

/* What a file was recorded at; NaN: not known. */
typedef struct record_conditions {
    double velocity, rotation, normal_force, pressure, temperature;
} record_conditions;
/* Means over cycles, of the velocity over their time. */
record_conditions conditions_of(const wt_cycle *cycles, size_t n);
bool conditions_alike(record_conditions a, record_conditions b);
/* Nothing slides. */
bool conditions_rest(record_conditions at);
/* The number of cycles from the first on that belong to one step. */
size_t conditions_step(const wt_cycle *cycles, size_t n);

/* Measurements of one number: their mean has the scatter among them where that is more than their
 * errors. */
typedef struct record_group {
    double n, mean, squares, own; /* squares about the mean; of their errors */
} record_group;
void record_group_add(record_group *s, wt_estimate e);
/* NaN of nothing. */
wt_estimate record_group_mean(const record_group *s, const char *unit);
/* Degrees of freedom of its error where that is of the scatter, else NaN. */
double record_group_freedom(const record_group *s);

/* Rates of wear: what tells that of one run, such as mass and area, is one measurement. */
typedef struct wear_rates {
    record_group run, all; /* the run that is not ended yet; those before */
    double freedom;        /* of the last of those */
} wear_rates;
void wear_rates_end_run(wear_rates *rates);
wt_estimate wear_rates_mean(const wear_rates *rates);
double wear_rates_freedom(const wear_rates *rates);

/* Whether anything of the wear was given. */
bool wear_is_requested(const wt_record_job *job);
wt_record_job wear_left_out(wt_record_job job);
/* Mean cross-section of the profiles of job->profile, with their scatter. */
wt_status wear_area_of_profiles(const wt_record_job *job, const wt_job *work, wt_estimate *area,
                                wt_error *err);
/* Rows of a file for the table of the wear. `radius` [m] of the track, NaN: not known. Their rates
 * are added to `rates` as one run. */
wt_status wear_add(const wt_record_job *job, const wt_record *record, const wt_cycles *cycles,
                   wt_estimate radius, const char *file, table_writer *t, wear_rates *rates,
                   wt_error *err);

/* Whether a file is a result of weartrack: a text stream or HDF5. */
bool stored_record_begins(wt_input *input);
/* Its rows of a table, if it has that, go to the table that is written as they are; each is shown.
 */
typedef void stored_row(void *user, const table_view *view, size_t row);
wt_status stored_record_rows(const wt_result *result, const table_schema *schema, table_writer *t,
                             stored_row *each, void *user, wt_error *err) WT_NODISCARD;

#endif
