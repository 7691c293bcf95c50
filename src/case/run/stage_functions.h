/* Data that a run passes between its stages, and the functions of the stages. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_RUN_STAGE_FUNCTIONS_H
#define WT_CASE_RUN_STAGE_FUNCTIONS_H

#include "case/plan/plan.h"

typedef struct flow_run {
    const wt_case *c;
    wt_job job;
    flow_plan plan;
    unsigned level;                    /* of the current stage */
    wt_table *table[FLOW_N_RESOURCES]; /* tables of the resources that are tables of their own */
    wt_indent_tables curves;           /* only the curve tables */
    wt_rubber rubber;
    wt_surface surface;
    wt_strain_softening strain_softening;
    wt_layer_job layer; /* layer of the case; a missing wear rate is replaced by the measured one */
    wt_estimate modulus_ratio, thickness;
    double modulus_ratio_df;  /* 0 if its error is normal */
    double calibration_share; /* share of the calibration in the variance of modulus_ratio */
    bool no_provenance;
    wt_accuracy_job precision; /* options of the stage "error against run time" */
} flow_run;

void flow_run_clear(flow_run *run);
/* Rubber and surface of an earlier run. */
typedef struct flow_kept {
    bool has_rubber, has_surface;
    wt_rubber rubber;
    wt_surface surface;
} flow_kept;
void flow_kept_clear(flow_kept *kept);
/* As wt_run_case. If `kept` is not NULL, the rubber of the master curve and the measured surface
 * are taken from it, unless the case requires a table of their stages; after the run it has those
 * of the run. They have to be those of the same files and sections of the case. */
wt_status flow_run_case(const wt_case *c, const wt_run_options *options, flow_kept *kept,
                        wt_log *log, wt_result **result, size_t *n_failed,
                        wt_error *err) WT_NODISCARD;
/* Sets the transverse isotropy of the rubber as the case states it. */
void flow_run_set_direction(flow_run *run);

/* Return the sliding contact of a run and the observation of its layer. WT_E_MISSING without a
 * modulus ratio, for example after an inconclusive comparison. */
wt_sliding flow_run_sliding(const flow_run *run);

/* Returns the indentation job of the bulk (0) or the track (1). */
wt_indent_job flow_group_job(const flow_run *run, int g);

#define STEP_PROTOTYPE(id, name, title, needs, any, additions, outputs, step)                      \
    wt_status step(flow_run *run, wt_error *err);
STAGES(STEP_PROTOTYPE)

#endif
