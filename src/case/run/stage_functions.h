/* What a run holds between its stages, and the function of each stage. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_RUN_STAGE_FUNCTIONS_H
#define WT_CASE_RUN_STAGE_FUNCTIONS_H

#include "case/plan/plan.h"

typedef struct flow_run {
    const wt_case *c;
    wt_job job;
    flow_plan plan;
    unsigned level;                 /* of the stage that runs */
    wt_table *table[FLOW_N_THINGS]; /* of the things that are a table of their own */
    wt_indent_tables curves;        /* only the curve tables */
    wt_curve_set *kept[2];          /* curves of bulk and track, for the coverage */
    wt_rubber rubber, layer_rubber;
    bool has_layer_rubber;
    wt_surface surface;
    wt_strain_softening softness;
    wt_layer_job layer; /* of the case, with the wear rate as measured where it gives none */
    wt_estimate modulus_ratio, thickness;
    double modulus_ratio_df;  /* 0 = its error is normal */
    double calibration_share; /* of its variance */
    bool no_provenance;
    size_t trials;             /* of the coverage */
    wt_accuracy_job precision; /* of the error against run time */
} flow_run;

void flow_run_clear(flow_run *run);
/* The rubber as given in a case, which may be that of a layer. */
wt_status flow_run_given_rubber(const wt_case *c, const wt_job *work, wt_rubber *rubber,
                                wt_error *err) WT_NODISCARD;
/* The rubber has the directions that the case says. */
void flow_run_set_direction(flow_run *run);

/* The sliding contact of a run so far, and what is known of its layer: WT_E_MISSING without a
 * modulus ratio, as a comparison that cannot say leaves none. */
wt_sliding flow_run_sliding(const flow_run *run);
wt_status flow_run_known_layer(const flow_run *run, wt_layer_observation *known,
                               wt_error *err) WT_NODISCARD;

/* Moves a table into the run; one that a stage left there before goes. */
void flow_run_store_table(flow_run *run, flow_resource thing, wt_table **table);

/* Adds to advice that names an option how a case says it. */
void flow_case_advice(wt_error *failure);

#define STEP_PROTOTYPE(id, name, title, needs, any, more, gives, step)                             \
    wt_status step(flow_run *run, wt_error *err);
STAGES(STEP_PROTOTYPE)

#endif
