/* Plan of a case: its stages, the reasons for excluded stages, and the outcome of each stage.
 * Internal to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_PLAN_PLAN_H
#define WT_CASE_PLAN_PLAN_H

#include "case/case.h"
#include "case/plan/stages.h"

/* Outcome of a stage. The initial value is FLOW_EXCLUDED. */
typedef enum flow_outcome {
    FLOW_EXCLUDED,
    FLOW_DONE,
    FLOW_FAILED,
    FLOW_BLOCKED,   /* a stage that it needs failed */
    FLOW_UNMEASURED /* the files do not contain the data that it needs */
} flow_outcome;

typedef struct flow_plan {
    flow_resource_set sources;  /* what the case contains */
    flow_resource_set wanted;   /* what the user requests */
    flow_resource_set required; /* `wanted` and the needs of the chosen stages */
    bool chosen[FLOW_N_STAGES];
    unsigned level[FLOW_N_STAGES];               /* highest level whose inputs the case contains */
    char reason[FLOW_N_STAGES][304];             /* why it is chosen, or not */
    char lower_level_reason[FLOW_N_STAGES][192]; /* reason for a lower level: "the case has no ...";
                                         "" at the highest level */
    flow_outcome outcome[FLOW_N_STAGES];
    /* level of a stage that ran; below `level` if the higher one failed */
    unsigned achieved_level[FLOW_N_STAGES];
    flow_outcome full_outcome[FLOW_N_STAGES];
    char failure[FLOW_N_STAGES][512]; /* message of a stage that failed at some level */
    flow_resource_set unmeasured; /* outputs that a stage did not find in its files, and all that
                               depends on them */
    char unmeasured_reason[256];  /* reason: "the records tell nothing of ...; give ..." */
} flow_plan;

/* Returns the inputs that a stage needs in this plan. If the rubber softens with strain, every
 * sliding stage also needs the softening. If the wear of the layer is measured, every layer stage
 * also needs the wear. */
flow_resource_set flow_plan_needs(const flow_plan *plan, size_t stage, unsigned level);
/* Returns true if a stage can run with the available resources. */
bool flow_stage_can_run(const flow_plan *plan, size_t stage, unsigned level,
                        flow_resource_set available);
/* Writes "runs because ..." or "left out because ...". */
enum { FLOW_REASON_SIZE = 320 };
void flow_plan_reason(const flow_plan *plan, size_t stage, char *text, size_t size);
void flow_plan_create(const wt_case *c, flow_plan *plan);

#endif
