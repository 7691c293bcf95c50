/* Table of the stages. Creates the plan of a case: the stages that run, and the reason why each
 * other stage is excluded. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/plan/plan.h"

#include "case/plan/stages.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define B(resource) FLOW_BIT(FLOW_##resource)

static const flow_optional_input optional_inputs[FLOW_N_OPTIONAL_INPUTS][FLOW_OPTIONAL_INPUTS_MAX] =
    {
        [FLOW_OPTIONAL_SPECTRUM] = {{B(RUBBER), ", by the spectrum of the material",
                                     "the spectrum of the material"}},
        [FLOW_OPTIONAL_RATE_CORRECTION] = {{B(RUBBER),
                                            ", at one rate and temperature by the material",
                                            "the material"}},
        [FLOW_OPTIONAL_TRACK] = {{B(INDENTATION_TRACK), " and wear track", "the wear track"}},
        [FLOW_OPTIONAL_LAYER] = {{B(LAYER) | B(MODULUS_RATIO), ", with and without the layer",
                                  "the layer"}},
        [FLOW_OPTIONAL_STEADY_STATE] = {{B(LAYER), ", beside that of the theory",
                                         "the thickness of the theory"}},
        [FLOW_OPTIONAL_WEAR] = {{B(WEAR), ", with the wear as measured", "the measured wear"}},
        [FLOW_OPTIONAL_THICKNESS] = {{B(LAYER_PARAMETERS), ", thickness of the layer", "the layer"},
                                     {B(MODULUS_RATIO), ", friction with it",
                                      "the modulus ratio of the layer"}},
};

#define STAGE_ROW(id, name, title, needs, any, additions, outputs, step)                           \
    [FLOW_STAGE_##id] = {#name, title, needs, any, optional_inputs[additions], outputs},
const flow_stage flow_stages[FLOW_N_STAGES] = {STAGES(STAGE_ROW)};

unsigned flow_stage_levels(size_t stage)
{
    unsigned n = 0;
    while (n < FLOW_OPTIONAL_INPUTS_MAX && flow_stages[stage].optional_inputs[n].resources != 0)
        n++;
    return n;
}

flow_resource_set flow_stage_needs(size_t stage, unsigned level)
{
    flow_resource_set needs = flow_stages[stage].needs;
    for (unsigned i = 0; i < level; i++)
        needs |= flow_stages[stage].optional_inputs[i].resources;
    return needs;
}

void flow_stage_title(size_t stage, unsigned level, char *text, size_t size)
{
    const flow_stage *s = &flow_stages[stage];
    size_t used = (size_t)snprintf(text, size, "%s", s->title);
    for (unsigned i = 0; i < level && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s", s->optional_inputs[i].title);
}

/* ---- sources and requested resources --------------------------------------------------------- */

static flow_resource_set case_sources(const wt_case *c)
{
#define SOURCE_FLAG(id, words, missing, there) ((there) ? FLOW_BIT(FLOW_##id) : 0) |
    return SOURCES(SOURCE_FLAG) 0;
}

/* A call with its own request ignores this switch of the case. */
static bool is_validation_off(const wt_case *c)
{
    return !c->is_explicit_request && !c->validation.wanted;
}

/* A case with a record and a list of requested results also gets the comparison with the record. */
static flow_resource_set record_validations(const wt_case *c)
{
    const bool held =
        c->has_requests && !c->is_explicit_request && c->validation.wanted && c->record.n > 0;
    return held ? (FLOW_VALIDATIONS | FLOW_BIT(FLOW_WEAR)) & ~c->requested : 0;
}

static flow_resource_set wanted_resources(const wt_case *c)
{
    flow_resource_set wanted = c->has_requests ? c->requested : FLOW_TABLES & ~FLOW_ONLY_REQUESTED;
    if (c->has_compare && !c->compare_groups)
        wanted &= ~(FLOW_BIT(FLOW_COMPARISON) | FLOW_BIT(FLOW_TRACK_LAYER));
    if (c->has_compare && !c->compare_rates)
        wanted &= ~FLOW_BIT(FLOW_MODULUS_RATE);
    if (c->has_compare && !c->compare_dma)
        wanted &= ~FLOW_BIT(FLOW_DMA_COMPARISON);
    if (is_validation_off(c))
        wanted &= ~FLOW_VALIDATIONS;
    return wanted | record_validations(c);
}

flow_resource_set flow_plan_needs(const flow_plan *plan, size_t stage, unsigned level)
{
    const flow_resource_set needs = flow_stage_needs(stage, level),
                            softening =
                                FLOW_BIT(FLOW_GIVEN_SOFTENING) | FLOW_BIT(FLOW_REQUESTED_SOFTENING);
    const bool slides = (needs & FLOW_BIT(FLOW_CONDITIONS)) != 0,
               wears = (needs & FLOW_BIT(FLOW_LAYER_PARAMETERS)) != 0;
    return needs | (slides && (plan->sources & softening) != 0 ? FLOW_BIT(FLOW_SOFTENING) : 0) |
           (wears && (plan->sources & FLOW_BIT(FLOW_MEASURED_WEAR)) != 0 ? FLOW_BIT(FLOW_WEAR) : 0);
}

bool flow_stage_can_run(const flow_plan *plan, size_t stage, unsigned level,
                        flow_resource_set there)
{
    const flow_resource_set any = flow_stages[stage].alternatives;
    return (flow_plan_needs(plan, stage, level) & ~there) == 0 && (any == 0 || (any & there) != 0);
}

/* ---- choice of stages ------------------------------------------------------------------------ */

/* Finds the stages whose needs can be met, and their highest level. One pass suffices because the
 * table is in order of dependence. */
static void find_possible_stages(flow_plan *plan, bool able[FLOW_N_STAGES])
{
    flow_resource_set reachable = plan->sources;
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        able[i] = flow_stage_can_run(plan, i, 0, reachable);
        if (!able[i])
            continue;
        while (plan->level[i] < flow_stage_levels(i) &&
               flow_stage_can_run(plan, i, plan->level[i] + 1, reachable))
            plan->level[i]++;
        reachable |= flow_stages[i].outputs;
    }
}

/* Returns the needs and the alternative inputs of a stage; some of them may be unavailable. */
static flow_resource_set resources_used(const flow_plan *plan, size_t stage)
{
    return flow_plan_needs(plan, stage, plan->level[stage]) | flow_stages[stage].alternatives;
}

/* Returns true if stage `a` is preferred to stage `b` for a common output. The stage that takes
 * more into account is preferred. A stage with the same inputs and further outputs that are not
 * required is not preferred. */
static bool is_preferred(const flow_plan *plan, size_t a, size_t b)
{
    const flow_stage *s = &flow_stages[a], *t = &flow_stages[b];
    const flow_resource_set of_a = resources_used(plan, a), of_b = resources_used(plan, b);
    const int additions = flow_resources_count(of_a) - flow_resources_count(of_b);
    const int idle = flow_resources_count(s->outputs & ~plan->required) -
                     flow_resources_count(t->outputs & ~plan->required);
    const bool same_way = (of_a & ~of_b) == 0 || (of_b & ~of_a) == 0;
    if (idle != 0 && (same_way || additions == 0))
        return idle < 0;
    return additions > 0;
}

/* Chooses the best stage with the output `resource`, and then the stages that it needs. */
static void choose_stage(flow_plan *plan, const bool able[FLOW_N_STAGES], flow_resource resource,
                         const char *because)
{
    size_t best = FLOW_N_STAGES;
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        if (!able[i] || !(flow_stages[i].outputs & FLOW_BIT(resource)))
            continue;
        if (plan->chosen[i])
            return;
        if (best == FLOW_N_STAGES || is_preferred(plan, i, best))
            best = i;
    }
    if (best == FLOW_N_STAGES)
        return;
    plan->chosen[best] = true;
    snprintf(plan->reason[best], sizeof plan->reason[best], "%s", because);
    for (unsigned t = FLOW_FIRST_TABLE; t < FLOW_N_RESOURCES; t++) {
        if (!(resources_used(plan, best) & FLOW_BIT(t)))
            continue;
        char reason[128];
        plan->required |= FLOW_BIT(t);
        snprintf(reason, sizeof reason, "%s needs its %s", flow_stages[best].id,
                 flow_resource_rows[t].label);
        choose_stage(plan, able, (flow_resource)t, reason);
    }
}

static flow_resource_set stage_missing_sources(const flow_plan *plan, size_t stage);

/* Returns the missing sources of the first need that cannot be met, one for each alternative to
 * meet it; 0 if all needs can be met. */
static flow_resource_set missing_sources(const flow_plan *plan, flow_resource_set needs)
{
    for (unsigned t = 0; t < FLOW_N_RESOURCES; t++) {
        if (!(needs & FLOW_BIT(t)) || (plan->sources & FLOW_BIT(t)))
            continue;
        if (t < FLOW_FIRST_TABLE)
            return FLOW_BIT(t);
        flow_resource_set missing = 0;
        bool possible = false;
        for (size_t i = 0; i < FLOW_N_STAGES && !possible; i++) {
            if (!(flow_stages[i].outputs & FLOW_BIT(t)))
                continue;
            flow_resource_set here = stage_missing_sources(plan, i);
            possible = here == 0;
            missing |= here;
        }
        if (!possible)
            return missing;
    }
    return 0;
}

static flow_resource_set stage_missing_sources(const flow_plan *plan, size_t stage)
{
    const flow_resource_set any = flow_stages[stage].alternatives;
    flow_resource_set missing = missing_sources(plan, flow_plan_needs(plan, stage, 0));
    for (unsigned t = 0; missing == 0 && t < FLOW_N_RESOURCES; t++)
        if ((any & FLOW_BIT(t)) != 0 && missing_sources(plan, FLOW_BIT(t)) == 0)
            return 0;
    for (unsigned t = 0; t < FLOW_N_RESOURCES; t++)
        if ((any & FLOW_BIT(t)) != 0)
            missing |= missing_sources(plan, FLOW_BIT(t));
    return missing;
}

/* Example: "the case has no bulk curves (...) and no modulus ratio (...)". */
static void format_missing(flow_resource_set missing, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "the case has ");
    for (unsigned t = 0; t < FLOW_FIRST_TABLE && used < size; t++, missing >>= 1)
        if (missing & 1)
            used += (size_t)snprintf(text + used, size - used, "%s%s",
                                     flow_resource_rows[t].missing, missing > 1 ? " and " : "");
}

/* Adds the reason why a stage runs below its highest level. */
static void add_limitation(flow_plan *plan, size_t i)
{
    const unsigned level = plan->level[i];
    if (level == flow_stage_levels(i))
        return;
    const flow_optional_input *additions = &flow_stages[i].optional_inputs[level];
    const size_t used = strlen(plan->reason[i]);
    format_missing(missing_sources(plan, additions->resources), plan->lower_level_reason[i],
                   sizeof plan->lower_level_reason[i]);
    snprintf(plan->reason[i] + used, sizeof plan->reason[i] - used, "; without %s, for %s",
             additions->label, plan->lower_level_reason[i]);
}

/* Names the tables that a stage can make and that nothing needs. They cost it time, so that the run
 * leaves them out. */
static void add_unneeded_tables(flow_plan *plan, size_t i)
{
    const flow_resource_set costly =
        FLOW_BIT(FLOW_MASTER_CURVE) | FLOW_BIT(FLOW_RELAXATION_SPECTRUM);
    const flow_resource_set unneeded = flow_stages[i].outputs & costly & ~plan->required;
    const size_t used = strlen(plan->reason[i]);
    char names[128];
    flow_resources_list(unneeded, names, sizeof names);
    if (unneeded != 0)
        snprintf(plan->reason[i] + used, sizeof plan->reason[i] - used,
                 "; nothing needs %s, which it leaves out", names);
}

static void set_exclusion_reason(flow_plan *plan, size_t i, bool able)
{
    char *because = plan->reason[i];
    const size_t size = sizeof plan->reason[i];
    if (!able) {
        char missing[256];
        format_missing(stage_missing_sources(plan, i), missing, sizeof missing);
        snprintf(because, size, "%s", missing);
        return;
    }
    flow_resource_set useful = flow_stages[i].outputs & plan->required;
    for (size_t k = 0; useful != 0 && k < FLOW_N_STAGES; k++) {
        if (plan->chosen[k] && (useful & ~flow_stages[k].outputs) == 0) {
            snprintf(because, size, "%s gives its results and more", flow_stages[k].id);
            return;
        }
    }
    snprintf(because, size, "no requested table needs it");
}

void flow_plan_create(const wt_case *c, flow_plan *plan)
{
    bool able[FLOW_N_STAGES] = {false};
    *plan = (flow_plan){.sources = case_sources(c), .wanted = wanted_resources(c)};
    plan->required = plan->wanted;
    find_possible_stages(plan, able);
    for (unsigned t = FLOW_FIRST_TABLE; t < FLOW_FIRST_INNER; t++) {
        if (!(plan->wanted & FLOW_BIT(t)))
            continue;
        char reason[128];
        if (record_validations(c) & FLOW_BIT(t))
            snprintf(reason, sizeof reason, "the case has a record, which is compared with it");
        else
            snprintf(reason, sizeof reason, "%s is asked for", flow_resource_rows[t].label);
        choose_stage(plan, able, (flow_resource)t, reason);
    }
    for (size_t i = 0; i < FLOW_N_STAGES; i++)
        if (plan->chosen[i]) {
            add_limitation(plan, i);
            add_unneeded_tables(plan, i);
        } else if (able[i] && is_validation_off(c) &&
                   (flow_stages[i].outputs & FLOW_VALIDATIONS) != 0) {
            snprintf(plan->reason[i], sizeof plan->reason[i],
                     "the case switches it off (<validate> in <record>)");
        } else {
            set_exclusion_reason(plan, i, able[i]);
        }
}

void flow_plan_reason(const flow_plan *plan, size_t stage, char *text, size_t size)
{
    snprintf(text, size, "%s because %s", plan->chosen[stage] ? "runs" : "left out",
             plan->reason[stage]);
}

wt_status wt_plan(const wt_case *c, wt_table **result, wt_error *err)
{
    if (c == NULL || result == NULL)
        return wt_fail(err, WT_E_ARG, "no case");
    flow_plan plan;
    flow_plan_create(c, &plan);
    table_writer t = table_begin(&plan_schema, err);
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        char title[160], needs[256], outputs[256], reason[FLOW_REASON_SIZE];
        flow_stage_title(i, plan.level[i], title, sizeof title);
        flow_resources_list(resources_used(&plan, i), needs, sizeof needs);
        flow_resources_list(flow_stages[i].outputs, outputs, sizeof outputs);
        table_row(&t);
        plan_put_text(&t, PLAN_STAGE, flow_stages[i].id);
        plan_put_text(&t, PLAN_TITLE, title);
        plan_put(&t, PLAN_RUNS, plan.chosen[i]);
        flow_plan_reason(&plan, i, reason, sizeof reason);
        plan_put_text(&t, PLAN_REASON, reason);
        plan_put_text(&t, PLAN_NEEDS, needs);
        plan_put_text(&t, PLAN_PRODUCES, outputs);
    }
    return table_end(&t, result);
}
