/* The stages of what a layer is beyond its thickness at constant load.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/run/steps.h"

wt_status flow_step_layer_bands(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    return wt_layer_bands_make(&sliding, &run->c->layer, &run->job, &run->table[FLOW_LAYER_BANDS],
                               err);
}

wt_status flow_step_running_in(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_known known;
    const wt_status status = flow_run_known_layer(run, &known, err);
    return status == WT_OK ? wt_running_in_make(&sliding, &run->c->layer, &known, &run->job,
                                                &run->table[FLOW_RUNNING_IN], err)
                           : status;
}

wt_status flow_step_layer_balances(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_known known;
    const wt_status status = flow_run_known_layer(run, &known, err);
    return status == WT_OK ? wt_layer_balances_make(&sliding, &run->c->layer, &known, &run->job,
                                                    &run->table[FLOW_LAYER_BALANCES], err)
                           : status;
}

wt_status flow_step_existence(flow_run *run, wt_error *err)
{
    const wt_sliding sliding = flow_run_sliding(run);
    wt_layer_known known;
    const wt_status status = run->level > 0 ? flow_run_known_layer(run, &known, err) : WT_OK;
    return status == WT_OK
               ? wt_existence_make(&sliding, &run->c->layer, run->level > 0 ? &known : NULL,
                                   &run->job, &run->table[FLOW_EXISTENCE], err)
               : status;
}
