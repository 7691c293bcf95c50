/* The stages of a run in one table, and the plan that follows from it. Adding a stage is one row in
 * stages.c and one function in steps.c. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_STAGES_H
#define WEARTRACK_FLOW_STAGES_H

#include "flow/case/case.h"

/* What stages need and give: what a case may hold (sources), tables, and things between stages. */
typedef enum flow_thing {
    FLOW_BULK_CURVES, /* sources */
    FLOW_TRACK_CURVES,
    FLOW_DMA_FILES,
    FLOW_GIVEN_MATERIAL,
    FLOW_COUNTER_SURFACE,
    FLOW_CONDITIONS,
    FLOW_LAYER_PARAMETERS,
    FLOW_GIVEN_RATIO,
    FLOW_INDENTATION_BULK, /* tables */
    FLOW_INDENTATION_TRACK,
    FLOW_CURVE_BULK, /* blocks of the two curve tables */
    FLOW_CURVE_TRACK,
    FLOW_COMPARISON,
    FLOW_MODULUS_GROUPS,
    FLOW_MODULUS_RATE,
    FLOW_DMA_COMPARISON,
    FLOW_SHIFT_FACTORS,
    FLOW_MASTER_CURVE,
    FLOW_PRONY,
    FLOW_ROUGHNESS,
    FLOW_LAYER,
    FLOW_ENERGY_DENSITY,
    FLOW_FRICTION,
    FLOW_CONTACT_AREA,
    FLOW_RUBBER, /* between stages */
    FLOW_SURFACE,
    FLOW_MODULUS_RATIO,
    FLOW_N_THINGS
} flow_thing;

typedef uint64_t flow_things; /* bit i = thing i */
#define FLOW_BIT(thing) ((flow_things)1 << (unsigned)(thing))

/* What a stage reports for the table "cost". */
typedef struct flow_cost {
    double items;
    double tolerance_asked; /* relative; NaN = does not apply */
    double error_estimated;
} flow_cost;

typedef struct flow_run flow_run;
typedef struct flow_stage {
    const char *id, *title;
    flow_things needs, gives;
    wt_status (*run)(flow_run *run, flow_cost *cost, wt_error *err);
} flow_stage;

/* In an order in which every stage comes after those it needs, and the fuller of two that give the
 * same before the plainer one, which then stands in if the fuller one fails. */
extern const flow_stage flow_stages[];
extern const size_t flow_n_stages;
#define FLOW_MAX_STAGES 32

typedef struct flow_plan {
    flow_things sources;  /* what the case holds */
    flow_things wanted;   /* what is asked for */
    flow_things required; /* that and what the chosen stages need */
    bool chosen[FLOW_MAX_STAGES];
    char because[FLOW_MAX_STAGES][192];
} flow_plan;

void flow_plan_make(const wt_case *c, flow_plan *plan);
/* Names of the things in words, "a, b and c". */
void flow_things_list(flow_things things, char *text, size_t size);

/* Name of the table that a figure of the report is drawn from; NULL if there is no such figure. */
const char *flow_figure_table(const char *figure);
bool flow_table_is_known(const char *table);

#endif
