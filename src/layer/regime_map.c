/* Regime map: balance thickness and its effect on friction against the power that modifies the
 * rubber. It covers velocities and pressures, for the stated values and, for the errors, by
 * replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"
#include "layer/monte_carlo.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/root.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative tolerances of the velocity of an edge, for the stated values and for a replicate, which
 * scatters far more. */
static const double edge_tolerance = 1e-9, replicate_tolerance = 1e-4;

TABLE_ROW(layer_regime_map, LAYER_REGIME_MAP, double pressure, velocity;
          wt_estimate power, ratio, thickness; double share;
          wt_estimate friction, with_layer, change;)
TABLE_KEYS(layer_regime_map, LAYER_REGIME_MAP, double pressure;
           wt_estimate from_velocity, to_velocity, from_power, to_power;
           double from_velocity_low, from_velocity_high, to_velocity_low, to_velocity_high,
           from_power_low, from_power_high, to_power_low, to_power_high;
           const char *words, *known, *errors, *moduli;)

/* ---- at one velocity and pressure ------------------------------------------------------------ */

enum { AT_POWER, AT_RATIO, AT_THICKNESS, AT_FRICTION, AT_WITH_LAYER, AT_CHANGE, N_AT };
typedef struct regime_map_point {
    double value[N_AT], numerical[N_AT];
} regime_map_point;

/* Computes power, R and thickness, and the friction on bare rubber unless it is NULL. */
static wt_status compute_point_balance(const layer_context *context, operating_point conditions,
                                       wt_layer_steady_state *balance, layer_friction *friction,
                                       wt_error *err)
{
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    wt_status status = layer_compute_contact(context, conditions, &energy, &p, friction, err);
    if (status != WT_OK)
        return status;
    p.balance_only = true;
    p.skip_numerical_errors = friction == NULL || context->replicate != WT_NO_REPLICATE;
    status = wt_layer_steady_state_compute(&energy.source, &p, balance, err);
    layer_energy_clear(&energy);
    return status;
}

static double coefficient_error(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis_error : f->total_error;
}

static wt_status add_layer_friction(const layer_context *context, operating_point conditions,
                                    bool total, regime_map_point *at, wt_error *err)
{
    layer_friction with;
    const double thickness = at->value[AT_THICKNESS], bare = at->value[AT_FRICTION];
    conditions.layer = operating_point_under_layer(context, thickness).layer;
    const wt_status status = layer_compute_friction(context, conditions, &with, err);
    if (status != WT_OK)
        return status;
    at->value[AT_WITH_LAYER] = total ? with.total : with.hysteresis;
    at->value[AT_CHANGE] = at->value[AT_WITH_LAYER] / bare - 1;
    at->numerical[AT_WITH_LAYER] = coefficient_error(&with);
    at->numerical[AT_CHANGE] =
        (at->numerical[AT_WITH_LAYER] +
         at->numerical[AT_FRICTION] * fabs(at->value[AT_WITH_LAYER] / bare)) /
        bare;
    return WT_OK;
}

static wt_status compute_existence_point(const layer_context *context, operating_point conditions,
                                         regime_map_point *at, wt_error *err)
{
    wt_layer_steady_state b;
    layer_friction f;
    const wt_status status = compute_point_balance(context, conditions, &b, &f, err);
    if (status != WT_OK)
        return status;
    const double unknown = (double)NAN;
    *at = (regime_map_point){{b.surface_power, b.ratio, b.thickness.value,
                              layer_friction_coefficient(&f), unknown, unknown},
                             {unknown, fabs(b.ratio) * b.ratio_error, b.thickness.numerical_error,
                              coefficient_error(&f), unknown, unknown}};
    if (isnan(context->modulus_ratio) || !isfinite(b.thickness.value))
        return WT_OK;
    return add_layer_friction(context, conditions, !isnan(f.total), at, err);
}

/* ---- edges ----------------------------------------------------------------------------------- */

enum { EDGE_FIRST, EDGE_LAST, N_EDGES };
typedef struct edges {
    const layer_context *context;
    wt_status status; /* first failure of a root search */
    wt_error *err;
    double velocity[N_EDGES], power[N_EDGES]; /* first and last edge; NaN if outside the list */
    size_t n;
    char words[256];
} edges;

static double log_rate_ratio(double log_velocity, void *user)
{
    edges *e = user;
    operating_point conditions = operating_point_default();
    wt_layer_steady_state b = {.ratio = (double)NAN};
    conditions.velocity = exp(log_velocity);
    if (e->status == WT_OK)
        e->status = compute_point_balance(e->context, conditions, &b, NULL, e->err);
    return b.ratio > 0 ? log(b.ratio) : -HUGE_VAL;
}

/* Finds the edge between two velocities, and the power there. */
static void add_regime_edge(edges *e, double low, double high, bool begins)
{
    double at;
    const bool replicate = e->context->replicate != WT_NO_REPLICATE;
    const wt_status status =
        root_find(log_rate_ratio, e, log(low), log(high),
                  replicate ? replicate_tolerance : edge_tolerance, &at, e->err);
    e->status = e->status == WT_OK ? status : e->status;
    operating_point conditions = operating_point_default();
    wt_layer_steady_state b;
    conditions.velocity = exp(at);
    if (e->status == WT_OK)
        e->status = compute_point_balance(e->context, conditions, &b, NULL, e->err);
    if (e->status != WT_OK)
        return;
    const size_t used = strlen(e->words);
    clocale_print(e->words + used, sizeof e->words - used, "%s%s %.4g m/s (%.4g W/m^2)",
                  used > 0 ? ", " : "", begins ? "from" : "up to", conditions.velocity,
                  b.surface_power);
    const size_t k = begins ? EDGE_FIRST : EDGE_LAST;
    if (!begins || e->n == 0) {
        e->velocity[k] = conditions.velocity;
        e->power[k] = b.surface_power;
    }
    if (begins) /* a range that ended before is not the last one */
        e->velocity[EDGE_LAST] = e->power[EDGE_LAST] = (double)NAN;
    e->n++;
}

/* Finds the edges at the nominal pressure. */
static edges find_existence_edges(const layer_context *context, wt_error *err)
{
    const double unset = (double)NAN;
    edges e = {.context = context, .err = err, .velocity = {unset, unset}, .power = {unset, unset}};
    const wt_sliding *s = context->sliding;
    double before = log_rate_ratio(log(s->velocity[0]), &e);
    bool any = before > 0;
    for (size_t i = 1; e.status == WT_OK && i < s->n_velocity; i++) {
        const double now = log_rate_ratio(log(s->velocity[i]), &e);
        if ((now > 0) != (before > 0))
            add_regime_edge(&e, s->velocity[i - 1], s->velocity[i], now > 0);
        any = any || now > 0;
        before = now;
    }
    if (e.status == WT_OK && e.n == 0)
        snprintf(e.words, sizeof e.words, "%s",
                 any ? "at every velocity of the list" : "at no velocity of the list");
    return e;
}

/* ---- by one set of values -------------------------------------------------------------------- */

typedef struct regime_map_task {
    layer_draws draws;
    wt_sliding sliding; /* sliding with rising velocities */
    double *velocity;   /* [n_velocity] */
    size_t blocks, n;   /* number of pressures and of rows */
    edges edges;
    regime_map_point *at; /* [n] */
    char known[400], errors[560];
} regime_map_task;

static operating_point row_conditions(const regime_map_task *task, size_t row)
{
    operating_point conditions = operating_point_default();
    const wt_sliding *s = &task->sliding;
    conditions.velocity = s->velocity[row % s->n_velocity];
    conditions.pressure =
        s->n_pressures > 0 ? s->pressures[row / s->n_velocity] : s->pressure.value;
    return conditions;
}

static wt_status compute_existence_rows(const regime_map_task *task, const layer_context *context,
                                        regime_map_point *at, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < task->n; i++)
        status = compute_existence_point(context, row_conditions(task, i), &at[i], err);
    return status;
}

/* ---- replicates ------------------------------------------------------------------------------ */

/* Quantities of a replicate; those of each row follow. Edges are logarithms. */
enum { SOLVED, LN_VELOCITY, LN_POWER = LN_VELOCITY + N_EDGES, N_NUMBERS = LN_POWER + N_EDGES };

/* Largest share of replicates without an edge for which the quantiles of a 95 % interval exist. */
static const double max_missing_share = 0.025;

static wt_status existence_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const regime_map_task *task = user;
    wt_layer_job job;
    layer_context context;
    edges found = {.status = WT_OK};
    const size_t rows = i < LAYER_ROW_REPLICATES ? task->n : 0;
    regime_map_point *at = wt_alloc(task->n + 1, sizeof *at);
    wt_status status = layer_draws_replicate_context(&task->draws, i, &job, &context, err);
    if (status == WT_OK) {
        found = find_existence_edges(&context, err);
        status = found.status;
    }
    if (status == WT_OK && rows > 0)
        status = compute_existence_rows(task, &context, at, err);
    out[SOLVED] = 1;
    for (size_t k = 0; k < N_EDGES; k++) {
        out[LN_VELOCITY + k] = log(found.velocity[k]);
        out[LN_POWER + k] = log(found.power[k]);
    }
    for (size_t k = 0; k < N_AT * task->n; k++)
        out[N_NUMBERS + k] =
            status == WT_OK && rows > 0 ? at[k / N_AT].value[k % N_AT] : (double)NAN;
    free(at);
    return status;
}

/* Share of the first n replicates in which a quantity exceeds a limit; NaN without replicates. */
static double share_above_limit(const replicates *r, size_t n, size_t k, double limit)
{
    size_t solved = 0, above = 0;
    for (size_t i = 0; i < n && i < r->n; i++) {
        const double *const out = r->value + i * r->stride;
        solved += out[SOLVED] > 0;
        above += out[SOLVED] > 0 && out[k] > limit;
    }
    return solved > 0 ? (double)above / (double)solved : (double)NAN;
}

/* Of the replicates that have an edge, how many are too few for an interval; words of those that
 * have none where the values have one, or the other way round. */
static bool assess_edge(regime_map_task *task, size_t end)
{
    const replicates *r = &task->draws.replicates;
    const double with = share_above_limit(r, r->n, LN_VELOCITY + end, -HUGE_VAL);
    const bool there = !isnan(task->edges.velocity[end]);
    const double missing = there ? 1 - with : with;
    const size_t used = strlen(task->known);
    if (!(missing > max_missing_share))
        return true;
    clocale_print(task->known + used, sizeof task->known - used,
                  "%s%s in %.3g %% of the replicates there is %s %s edge between the velocities of "
                  "the list; more velocities, or smaller errors of what is drawn, would settle it",
                  used > 0 ? "" : stated_verdict_text(VERDICT_INCONCLUSIVE), used > 0 ? ";" : ":",
                  100 * missing, there ? "no" : "a", end == EDGE_FIRST ? "first" : "last");
    return false;
}

/* ---- the table ------------------------------------------------------------------------------- */

static wt_estimate existence_estimate(const regime_map_point *at, const double *error, size_t k)
{
    return (wt_estimate){at->value[k], error[k], at->numerical[k], NULL};
}

static void add_existence_rows(const regime_map_task *task, table_writer *t)
{
    const replicates *r = &task->draws.replicates;
    for (size_t i = 0; i < task->n; i++) {
        const regime_map_point *at = &task->at[i];
        const operating_point conditions = row_conditions(task, i);
        const size_t first = N_NUMBERS + N_AT * i;
        const double *const e = r->error + first;
        if (i % task->sliding.n_velocity == 0)
            table_block(t);
        TABLE_ADD(layer_regime_map, t, conditions.pressure, conditions.velocity,
                  existence_estimate(at, e, AT_POWER), existence_estimate(at, e, AT_RATIO),
                  existence_estimate(at, e, AT_THICKNESS),
                  share_above_limit(r, LAYER_ROW_REPLICATES, first + AT_RATIO, 1),
                  existence_estimate(at, e, AT_FRICTION), existence_estimate(at, e, AT_WITH_LAYER),
                  existence_estimate(at, e, AT_CHANGE));
    }
}

static wt_interval empty_interval(double value)
{
    return (wt_interval){value, (double)NAN, (double)NAN, (double)NAN};
}

static wt_status tabulate_regime_map(regime_map_task *task, wt_table **table, wt_error *err)
{
    const replicates *r = &task->draws.replicates;
    wt_interval velocity[N_EDGES], power[N_EDGES];
    for (size_t k = 0; k < N_EDGES; k++) {
        velocity[k] = layer_draws_interval(&task->draws, LN_VELOCITY + k, task->edges.velocity[k]);
        power[k] = layer_draws_interval(&task->draws, LN_POWER + k, task->edges.power[k]);
        if (!assess_edge(task, k)) {
            velocity[k] = empty_interval(task->edges.velocity[k]);
            power[k] = empty_interval(task->edges.power[k]);
        }
    }
    if (task->known[0] == '\0')
        snprintf(task->known, sizeof task->known, "%s: %s",
                 stated_verdict_text(r->n > 0 ? VERDICT_YES : VERDICT_NOT_TESTED),
                 r->n > 0 ? "nearly all replicates have the same edges"
                          : "no replicates are drawn");
    layer_draws_describe(&task->draws, task->errors, sizeof task->errors);
    table_writer t = table_begin(&layer_regime_map_schema, err);
    add_existence_rows(task, &t);
    layer_regime_map_keys keys = {.pressure = task->sliding.pressure.value,
                                  .from_velocity_low = velocity[EDGE_FIRST].low,
                                  .from_velocity_high = velocity[EDGE_FIRST].high,
                                  .to_velocity_low = velocity[EDGE_LAST].low,
                                  .to_velocity_high = velocity[EDGE_LAST].high,
                                  .from_power_low = power[EDGE_FIRST].low,
                                  .from_power_high = power[EDGE_FIRST].high,
                                  .to_power_low = power[EDGE_LAST].low,
                                  .to_power_high = power[EDGE_LAST].high,
                                  .words = task->edges.words,
                                  .known = task->known,
                                  .errors = task->errors,
                                  .moduli = task->draws.moduli};
    wt_estimate *const ends[] = {&keys.from_velocity, &keys.to_velocity, &keys.from_power,
                                 &keys.to_power};
    const wt_interval *const of[] = {&velocity[EDGE_FIRST], &velocity[EDGE_LAST],
                                     &power[EDGE_FIRST], &power[EDGE_LAST]};
    for (size_t k = 0; k < 2 * N_EDGES; k++) {
        *ends[k] = estimate_without_error(of[k]->value);
        ends[k]->standard_error = of[k]->standard_error;
    }
    layer_regime_map_set_keys(&t, &keys);
    return table_end(&t, table);
}

/* The same with its velocities from the least on, between which edges are looked for. */
static void sort_velocities(regime_map_task *task, const wt_sliding *sliding)
{
    const size_t n = sliding->n_velocity;
    task->blocks = sliding->n_pressures > 0 ? sliding->n_pressures : 1;
    task->n = n * task->blocks;
    task->velocity = wt_alloc(n + 1, sizeof *task->velocity);
    task->at = wt_alloc(task->n + 1, sizeof *task->at);
    memcpy(task->velocity, sliding->velocity, n * sizeof *task->velocity);
    numbers_sort(task->velocity, n);
    task->sliding = *sliding;
    task->sliding.velocity = task->velocity;
}

wt_status wt_regime_map_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                const wt_layer_observation *observation, const wt_job *work,
                                wt_table **table, wt_error *err)
{
    if (sliding == NULL || job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no existence of a layer to make");
    regime_map_task task = {.n = 0};
    sort_velocities(&task, sliding);
    wt_status status = layer_draws_init(&task.draws, &task.sliding, job, observation, work,
                                        "existence", true, err);
    if (status == WT_OK) {
        task.edges = find_existence_edges(&task.draws.values, err);
        status = task.edges.status;
    }
    if (status == WT_OK)
        status = compute_existence_rows(&task, &task.draws.values, task.at, err);
    if (status == WT_OK)
        status = replicates_draw(&task.draws.replicates, N_NUMBERS + N_AT * task.n,
                                 existence_replicate, &task, err);
    if (status == WT_OK)
        status = tabulate_regime_map(&task, table, err);
    cost_report(work, (cost_summary){.items = (double)(task.blocks * (1 + task.draws.replicates.n)),
                                     .tolerance_asked = work->tolerance});
    layer_draws_clear(&task.draws);
    free(task.velocity);
    free(task.at);
    return status;
}
