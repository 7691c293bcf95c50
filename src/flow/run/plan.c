/* The plan: which stages this case needs, and why the others are left out.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/tables.h"
#include "flow/run/stages.h"
#include "weartrack/report.h"

#include <math.h>
#include <string.h>

/* Name of each thing in the plan; for sources also what is missing without them. */
static const struct {
    const char *name, *missing;
} things[FLOW_N_THINGS] = {
    [FLOW_BULK_CURVES] = {"bulk curves", "no bulk curves (<bulk> in <indentation>)"},
    [FLOW_TRACK_CURVES] = {"wear-track curves", "no wear-track curves (<track> in <indentation>)"},
    [FLOW_DMA_FILES] = {"DMA files", "no DMA files (<files> in <dma>)"},
    [FLOW_GIVEN_MATERIAL] = {"given material", "no material (<prony> in <dma>)"},
    [FLOW_COUNTER_SURFACE] = {"counter surface", "no counter surface (<roughness>)"},
    [FLOW_CONDITIONS] = {"sliding conditions", "no sliding conditions (<sliding>)"},
    [FLOW_LAYER_PARAMETERS] = {"layer parameters", "no layer parameters (<layer>)"},
    [FLOW_GIVEN_RATIO] = {"given modulus ratio", "no modulus ratio (<modulus-ratio> in <layer>)"},
    [FLOW_INDENTATION_BULK] = {"indentation/bulk", ""},
    [FLOW_INDENTATION_TRACK] = {"indentation/track", ""},
    [FLOW_CURVE_BULK] = {"bulk curve", ""},
    [FLOW_CURVE_TRACK] = {"wear-track curve", ""},
    [FLOW_MODULUS_GROUPS] = {"modulus_groups", ""},
    [FLOW_COMPARISON] = {"comparison", ""},
    [FLOW_MODULUS_RATE] = {"modulus_rate", ""},
    [FLOW_DMA_COMPARISON] = {"dma_comparison", ""},
    [FLOW_SHIFT_FACTORS] = {"shift_factors", ""},
    [FLOW_MASTER_CURVE] = {"master_curve", ""},
    [FLOW_PRONY] = {"prony", ""},
    [FLOW_ROUGHNESS] = {"roughness", ""},
    [FLOW_LAYER] = {"layer", ""},
    [FLOW_ENERGY_DENSITY] = {"energy_density", ""},
    [FLOW_FRICTION] = {"friction", ""},
    [FLOW_CONTACT_AREA] = {"contact_area", ""},
    [FLOW_RUBBER] = {"material", ""},
    [FLOW_SURFACE] = {"roughness law", ""},
    [FLOW_MODULUS_RATIO] = {"modulus ratio", ""},
};

#define FIRST_TABLE FLOW_INDENTATION_BULK
#define FIRST_INNER FLOW_RUBBER
#define SOURCES (FLOW_BIT(FIRST_TABLE) - 1)

void flow_things_list(flow_things set, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (unsigned i = 0; i < FLOW_N_THINGS && used < size; i++)
        if (set & FLOW_BIT(i))
            used += (size_t)snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "",
                                     things[i].name);
}

/* ---- names ------------------------------------------------------------------------------------
 */

/* Things behind a table; 0 if it is always there or unknown. */
static flow_things things_of_table(const char *table)
{
    if (strcmp(table, "force_displacement") == 0 || strcmp(table, "force_indentation") == 0)
        return FLOW_BIT(FLOW_CURVE_BULK) | FLOW_BIT(FLOW_CURVE_TRACK);
    for (unsigned i = FIRST_TABLE; i < FIRST_INNER; i++)
        if (strcmp(table, things[i].name) == 0)
            return FLOW_BIT(i);
    return 0;
}

bool flow_table_is_known(const char *table)
{
    static const char *const always[] = {"answer", "inputs", "notes", "failures", "cost"};
    for (size_t i = 0; i < FLOW_COUNT(always); i++)
        if (strcmp(table, always[i]) == 0)
            return true;
    return things_of_table(table) != 0;
}

const char *flow_figure_table(const char *figure)
{
    for (size_t i = 0; i < wt_figure_count(); i++)
        if (strcmp(wt_figure_get(i).name, figure) == 0)
            return wt_figure_get(i).table;
    return NULL;
}

/* ---- what is there, what is wanted ------------------------------------------------------------
 */

static flow_things sources_of(const wt_case *c)
{
    const struct {
        bool there;
        flow_thing thing;
    } all[] = {
        {c->bulk.n > 0, FLOW_BULK_CURVES},
        {c->track.n > 0, FLOW_TRACK_CURVES},
        {c->dma.n > 0, FLOW_DMA_FILES},
        {c->has_prony, FLOW_GIVEN_MATERIAL},
        {c->has_self_affine || c->has_spectrum, FLOW_COUNTER_SURFACE},
        {c->has_sliding, FLOW_CONDITIONS},
        {c->has_layer, FLOW_LAYER_PARAMETERS},
        {c->has_modulus_ratio, FLOW_GIVEN_RATIO},
    };
    flow_things set = 0;
    for (size_t i = 0; i < FLOW_COUNT(all); i++)
        if (all[i].there)
            set |= FLOW_BIT(all[i].thing);
    return set;
}

static flow_things wanted_by(const wt_case *c)
{
    flow_things all = FLOW_BIT(FIRST_INNER) - 1 - SOURCES, wanted = 0;
    if (c->n_asked == 0)
        wanted = all;
    for (size_t i = 0; i < c->n_asked; i++)
        wanted |= things_of_table(c->asked[i]);
    if (c->has_compare && !c->compare_groups)
        wanted &= ~FLOW_BIT(FLOW_COMPARISON);
    if (c->has_compare && !c->compare_rates)
        wanted &= ~FLOW_BIT(FLOW_MODULUS_RATE);
    if (c->has_compare && !c->compare_dma)
        wanted &= ~FLOW_BIT(FLOW_DMA_COMPARISON);
    return wanted;
}

/* ---- choosing ---------------------------------------------------------------------------------
 */

static int count_bits(flow_things set)
{
    int n = 0;
    for (; set != 0; set &= set - 1)
        n++;
    return n;
}

/* Stages whose needs can all be met; one pass suffices since the table is in order. */
static void find_able(flow_things sources, bool able[FLOW_MAX_STAGES])
{
    flow_things reachable = sources;
    for (size_t i = 0; i < flow_n_stages; i++) {
        able[i] = (flow_stages[i].needs & ~reachable) == 0;
        if (able[i])
            reachable |= flow_stages[i].gives;
    }
}

/* Whether stage a is to be preferred to b for what they both give: the one that takes more into
 * account, or else the one that does less that nobody asked for. */
static bool is_better(const flow_plan *plan, size_t a, size_t b)
{
    int more = count_bits(flow_stages[a].needs) - count_bits(flow_stages[b].needs);
    if (more != 0)
        return more > 0;
    return count_bits(flow_stages[a].gives & ~plan->required) <
           count_bits(flow_stages[b].gives & ~plan->required);
}

/* Chooses the best stage that gives a thing, then what it needs. */
static void choose(flow_plan *plan, const bool able[FLOW_MAX_STAGES], flow_thing thing,
                   const char *because)
{
    size_t best = flow_n_stages;
    for (size_t i = 0; i < flow_n_stages; i++) {
        if (!able[i] || !(flow_stages[i].gives & FLOW_BIT(thing)))
            continue;
        if (plan->chosen[i])
            return;
        if (best == flow_n_stages || is_better(plan, i, best))
            best = i;
    }
    if (best == flow_n_stages)
        return;
    plan->chosen[best] = true;
    snprintf(plan->because[best], sizeof plan->because[best], "runs because %s", because);
    for (unsigned t = FIRST_TABLE; t < FLOW_N_THINGS; t++) {
        if (!(flow_stages[best].needs & FLOW_BIT(t)))
            continue;
        char reason[128];
        plan->required |= FLOW_BIT(t);
        snprintf(reason, sizeof reason, "%s needs its %s", flow_stages[best].id, things[t].name);
        choose(plan, able, (flow_thing)t, reason);
    }
}

/* Sources whose absence keeps a stage from running: of the first need that cannot be met, one for
 * each way of meeting it. Empty if the stage is able. */
static flow_things missing_sources(flow_things sources, const flow_stage *stage)
{
    for (unsigned t = 0; t < FLOW_N_THINGS; t++) {
        if (!(stage->needs & FLOW_BIT(t)) || (sources & FLOW_BIT(t)))
            continue;
        if (t < FIRST_TABLE)
            return FLOW_BIT(t);
        flow_things missing = 0;
        bool possible = false;
        for (size_t i = 0; i < flow_n_stages && !possible; i++) {
            if (!(flow_stages[i].gives & FLOW_BIT(t)))
                continue;
            flow_things here = missing_sources(sources, &flow_stages[i]);
            possible = here == 0;
            missing |= here;
        }
        if (!possible)
            return missing;
    }
    return 0;
}

static void say_why_not(flow_plan *plan, size_t i, bool able)
{
    char *because = plan->because[i];
    const size_t size = sizeof plan->because[i];
    if (!able) {
        flow_things missing = missing_sources(plan->sources, &flow_stages[i]);
        size_t used = (size_t)snprintf(because, size, "left out because the case has ");
        for (unsigned t = 0; t < FIRST_TABLE && used < size; t++, missing >>= 1)
            if (missing & 1)
                used += (size_t)snprintf(because + used, size - used, "%s%s", things[t].missing,
                                         missing > 1 ? " and " : "");
        return;
    }
    flow_things useful = flow_stages[i].gives & plan->required;
    for (size_t k = 0; useful != 0 && k < flow_n_stages; k++) {
        if (plan->chosen[k] && (useful & ~flow_stages[k].gives) == 0) {
            snprintf(because, size, "left out because %s gives its results and more",
                     flow_stages[k].id);
            return;
        }
    }
    snprintf(because, size, "left out because nothing that is asked for needs it");
}

void flow_plan_make(const wt_case *c, flow_plan *plan)
{
    bool able[FLOW_MAX_STAGES] = {false};
    *plan = (flow_plan){.sources = sources_of(c), .wanted = wanted_by(c)};
    plan->required = plan->wanted;
    find_able(plan->sources, able);
    for (unsigned t = FIRST_TABLE; t < FIRST_INNER; t++) {
        if (!(plan->wanted & FLOW_BIT(t)))
            continue;
        char reason[128];
        snprintf(reason, sizeof reason, "%s is asked for", things[t].name);
        choose(plan, able, (flow_thing)t, reason);
    }
    for (size_t i = 0; i < flow_n_stages; i++)
        if (!plan->chosen[i])
            say_why_not(plan, i, able[i]);
}

wt_status wt_plan(const wt_case *c, wt_table **result, wt_error *err)
{
    enum { STAGE, TITLE, RUNS, BECAUSE, NEEDS, GIVES };
    static const flow_column columns[] = {
        {"stage", NULL, "stage"},
        {"title", NULL, "what it does"},
        {"runs", "1", "1: runs, 0: left out"},
        {"because", NULL, "why"},
        {"needs", NULL, "what it needs"},
        {"gives", NULL, "what it gives"},
    };
    if (c == NULL || result == NULL)
        return wt_fail(err, WT_E_ARG, "no case");
    flow_plan plan;
    wt_table *table = NULL;
    flow_plan_make(c, &plan);
    wt_status status =
        flow_table_new("plan", "Stages of this case", columns, FLOW_COUNT(columns), &table, err);
    for (size_t i = 0; status == WT_OK && i < flow_n_stages; i++) {
        char needs[256], gives[256];
        flow_things_list(flow_stages[i].needs, needs, sizeof needs);
        flow_things_list(flow_stages[i].gives, gives, sizeof gives);
        status = wt_table_add_row(table, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, STAGE, flow_stages[i].id, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, TITLE, flow_stages[i].title, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, BECAUSE, plan.because[i], err);
        if (status == WT_OK)
            status = wt_table_put_text(table, NEEDS, needs, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, GIVES, gives, err);
        if (status == WT_OK)
            wt_table_put(table, RUNS, plan.chosen[i]);
    }
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *result = table;
    return WT_OK;
}
