/* The plan: which stages a case needs, why the others are left out, and what became of them.
 * Internal to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_PLAN_PLAN_H
#define WT_CASE_PLAN_PLAN_H

#include "case/case.h"
#include "case/plan/stages.h"

/* What became of a stage; of one that did not run yet: left out. */
typedef enum flow_outcome {
    FLOW_LEFT_OUT,
    FLOW_DONE,
    FLOW_FAILED,
    FLOW_BLOCKED,   /* a stage before failed */
    FLOW_UNMEASURED /* the files do not hold what it needs */
} flow_outcome;

typedef struct flow_plan {
    flow_things sources;  /* what the case holds */
    flow_things wanted;   /* what is asked for */
    flow_things required; /* that and what the chosen stages need */
    bool chosen[FLOW_N_STAGES];
    unsigned level[FLOW_N_STAGES]; /* the fullest that the case gives it what it needs for */
    char because[FLOW_N_STAGES][320];
    char without[FLOW_N_STAGES][192]; /* why not fuller: "the case has no ..."; "" = it is */
    flow_outcome outcome[FLOW_N_STAGES];
    /* of a stage that was done, at a lower level than that of the plan if the fuller one was not */
    unsigned done[FLOW_N_STAGES];
    flow_outcome fuller[FLOW_N_STAGES];
    flow_things
        unmeasured; /* what a stage that was done did not find in its files, and what rests */
    char why_unmeasured[256]; /* on that; "the records tell nothing of ...; give ..." */
} flow_plan;

/* What a stage needs in this plan: of a case whose rubber softens with strain, all that slides
 * needs the softening, too, and of one whose layer wears as measured, all of the layer that. */
flow_things flow_needs(const flow_plan *plan, size_t stage, unsigned level);
/* Whether a stage can do its work with what is there. */
bool flow_can(const flow_plan *plan, size_t stage, unsigned level, flow_things there);
void flow_plan_make(const wt_case *c, flow_plan *plan);

#endif
