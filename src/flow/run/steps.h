/* What a run holds between its stages, and the function of each stage. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_STEPS_H
#define WEARTRACK_FLOW_STEPS_H

#include "flow/run/stages.h"

struct flow_run {
    const wt_case *c;
    wt_job job;
    flow_plan plan;
    wt_table *indentation[2]; /* bulk, track */
    wt_indent_tables curves;  /* only the curve tables */
    wt_compare_tables compare;
    wt_table *dma_comparison;
    wt_master_tables master;
    wt_rubber rubber;
    wt_surface surface;
    wt_table *roughness;
    wt_estimate modulus_ratio;
    wt_layer_tables layer;
    wt_friction_tables friction;
};

void flow_run_clear(flow_run *run);
/* Rubber as given in the case; conditions of the case with rubber and surface set. */
wt_status flow_case_rubber(const wt_case *c, wt_rubber *rubber, wt_error *err) WT_NODISCARD;
wt_status flow_case_surface(const wt_case *c, const wt_job *common, wt_surface *surface,
                            wt_error *err) WT_NODISCARD;
wt_master_job flow_case_master(const wt_case *c);
wt_sliding flow_case_conditions(const wt_case *c, const wt_rubber *rubber,
                                const wt_surface *surface);

wt_status flow_step_bulk(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_track(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_compare(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_groups(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_master(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_given_material(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_dma_comparison(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_roughness(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_given_ratio(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_layer(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_friction_with_layer(flow_run *run, flow_cost *cost, wt_error *err);
wt_status flow_step_friction(flow_run *run, flow_cost *cost, wt_error *err);

#endif
