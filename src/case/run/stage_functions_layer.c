/* Comparison of the case with its records, and identification of a layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/run/stage_functions.h"

#include <math.h>

/* ---- comparison with the records ------------------------------------------------------------- */

wt_status flow_step_validation(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_observation layer;
    wt_validation_tables tables = {0};
    wt_validation_job job = run->c->validation;
    wt_status status = run->level > 0 ? flow_run_layer_observation(run, &layer, err) : WT_OK;
    job.sliding = &sliding;
    job.layer =
        run->c->has_layer && !isnan(run->layer.specific_wear_rate.value) ? &run->layer : NULL;
    job.layer_observation = run->level > 0 ? &layer : NULL;
    job.record = run->table[FLOW_RECORD];
    job.wear = run->table[FLOW_WEAR];
    if (status == WT_OK)
        status = wt_validation_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_VALIDATION, &tables.validation);
    flow_run_store_table(run, FLOW_VALIDATION_SOURCES, &tables.sources);
    return status;
}

wt_status flow_step_validation_running_in(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_observation layer;
    wt_running_in_tables tables = {0};
    wt_validation_job job = run->c->validation;
    wt_status status = flow_run_layer_observation(run, &layer, err);
    job.sliding = &sliding;
    job.layer = &run->layer;
    job.layer_observation = &layer;
    job.record = run->table[FLOW_RECORD];
    job.cycles = run->table[FLOW_RECORD_CYCLES];
    job.wear = run->table[FLOW_WEAR];
    if (status == WT_OK)
        status = wt_running_in_validation_compute(&job, &run->job, &tables, err);
    flow_run_store_table(run, FLOW_VALIDATION_RUNNING_IN, &tables.running_in);
    flow_run_store_table(run, FLOW_VALIDATION_COURSE, &tables.running_in_curve);
    return status;
}

/* The wear rate stated for the identification takes precedence over that of the records. */
wt_status flow_step_identification(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_identify_job job = run->c->identify;
    wt_estimate measured;
    if (run->level > 0 && isnan(job.specific_wear_rate.value) &&
        wt_table_estimate(run->table[FLOW_WEAR], "specific_wear_rate", &measured))
        job.specific_wear_rate = measured;
    return wt_identification_compute(&sliding, &job, &run->job, &run->table[FLOW_IDENTIFICATION],
                                     err);
}
