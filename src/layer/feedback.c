/* Table of the balances of a layer with feedback on its own energy, with uncertainties from
 * replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"
#include "job/random_draws.h"
#include "layer/layer_energy.h"
#include "layer/monte_carlo.h"

#include "core/table/table_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Number of thicknesses in the search for balances: the step is 9 % of the thickness over six
 * decades. */
enum { GRID = 160 };
/* Number for a replicate: the step is 35 %, far smaller than the distance of balances that are not
 * close to a fold. */
enum { REPLICATE_GRID = 48 };
/* Range of the search: from a layer that hardly affects the shortest wave to one thicker than the
 * longest wave. */
static const double thinnest = 1e-2; /* in units of 1/q1 */
static const double thickest = 4;    /* in units of 1/q0 */

TABLE_ROW(layer_feedback, LAYER_FEEDBACK, const char *kind; balance_stability stable;
          wt_estimate thickness, map_slope, eigenvalue, wear_rate, hysteresis, area_ratio,
          friction;)
TABLE_KEYS(layer_feedback, LAYER_FEEDBACK, wt_estimate one_way, ratio, modulus_ratio;
           double low, high; const char *words, *agreement, *errors, *moduli;)

wt_status feedback_energy(double thickness, void *user, wt_energy_source *source,
                          wt_layer_parameters *parameters, wt_error *err)
{
    const layer_context *context = user;
    layer_energy energy = {.source = {.n = 0}};
    const wt_status status = layer_compute_energy(
        context, operating_point_under_layer(context, thickness), &energy, parameters, err);
    *source = energy.source;
    return status;
}

wt_status feedback_find_balances(layer_context *context, wt_layer_feedback *loop, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    double low = 0, high = 0;
    wt_status status = feedback_energy(0, context, &source, &p, err);
    for (size_t i = 0; status == WT_OK && i < source.n; i++) {
        low = i == 0 ? source.wavenumber[0] : fmin(low, source.wavenumber[i]);
        high = fmax(high, source.wavenumber[i]);
    }
    if (status == WT_OK)
        status = wt_layer_feedback_solve(
            feedback_energy, context, thinnest / high, thickest / low,
            context->replicate == WT_NO_REPLICATE ? GRID : REPLICATE_GRID, loop, err);
    wt_energy_source_clear(&source);
    return status;
}

/* ---- by one set of values ------------------------------------------------------------------- */

/* Quantities of a balance or a fold, with the friction there. */
enum { AT_THICKNESS, AT_SLOPE, AT_EIGENVALUE, AT_WEAR, AT_HYSTERESIS, AT_AREA, AT_FRICTION, N_AT };
typedef struct balance_state {
    double value[N_AT], numerical[N_AT];
} balance_state;

typedef struct balances {
    layer_context *context;
    wt_layer_feedback loop;
    wt_layer_steady_state one_way;
    balance_state root[WT_LAYER_MAX_ROOTS], fold[WT_LAYER_MAX_ROOTS];
} balances;

static wt_status add_friction(const balances *b, balance_state *at, wt_error *err)
{
    layer_friction f;
    const wt_status status = layer_compute_friction(
        b->context, operating_point_under_layer(b->context, at->value[AT_THICKNESS]), &f, err);
    if (status != WT_OK)
        return status;
    at->value[AT_HYSTERESIS] = f.hysteresis;
    at->value[AT_AREA] = f.area_ratio;
    at->value[AT_FRICTION] = f.total;
    at->numerical[AT_HYSTERESIS] = f.hysteresis_error;
    at->numerical[AT_AREA] = f.area_error;
    at->numerical[AT_FRICTION] = f.total_error;
    return WT_OK;
}

/* An error of formation over wear moves a root by that error over the slope of ln(Qf / Qw). */
static wt_status add_root_error(const balances *b, balance_state *at, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    wt_layer_steady_state here;
    wt_status status = feedback_energy(at->value[AT_THICKNESS], b->context, &source, &p, err);
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&source, &p, &here, err);
    if (status == WT_OK)
        at->numerical[AT_THICKNESS] =
            here.ratio_error * here.wear_rate / fabs(at->value[AT_EIGENVALUE]);
    wt_energy_source_clear(&source);
    return status;
}

static wt_status compute_states(balances *b, wt_error *err)
{
    const double wear = b->context->job->specific_wear_rate.value;
    const bool with_errors = b->context->replicate == WT_NO_REPLICATE;
    const balance_state unknown = {.numerical = {(double)NAN, (double)NAN, (double)NAN, (double)NAN,
                                                 (double)NAN, (double)NAN, (double)NAN}};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < b->loop.n_roots; i++) {
        const wt_layer_root *r = &b->loop.root[i];
        b->root[i] = unknown;
        b->root[i].value[AT_THICKNESS] = r->thickness;
        b->root[i].value[AT_SLOPE] = r->map_slope;
        b->root[i].value[AT_EIGENVALUE] = r->eigenvalue;
        b->root[i].value[AT_WEAR] = wear;
        status = add_friction(b, &b->root[i], err);
        if (status == WT_OK && with_errors)
            status = add_root_error(b, &b->root[i], err);
    }
    for (size_t i = 0; status == WT_OK && i < b->loop.n_folds; i++) {
        const wt_layer_fold *f = &b->loop.fold[i];
        b->fold[i] = unknown;
        b->fold[i].value[AT_THICKNESS] = f->thickness;
        b->fold[i].value[AT_SLOPE] = b->fold[i].value[AT_EIGENVALUE] = (double)NAN;
        b->fold[i].value[AT_WEAR] = f->specific_wear_rate;
        status = add_friction(b, &b->fold[i], err);
    }
    return status;
}

static wt_status compute_balances(balances *b, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    wt_status status = feedback_find_balances(b->context, &b->loop, err);
    if (status == WT_OK)
        status = feedback_energy(0, b->context, &source, &p, err);
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&source, &p, &b->one_way, err);
    wt_energy_source_clear(&source);
    return status == WT_OK ? compute_states(b, err) : status;
}

/* ---- replicates ------------------------------------------------------------------------------ */

/* Quantities of a replicate. Those of the balances and folds follow, NaN if their number differs.
 */
enum { RATIO, ONE_WAY, BALANCES, SAME_BALANCES, SAME_FOLDS, N_NUMBERS };

typedef struct balances_task {
    layer_draws draws;
    balances centre;
    size_t solved, has_same_balances, has_same_folds; /* number of replicates: solved, and with the
                                                 same balances or folds as the stated values */
    char agreement[320], errors[760];
} balances_task;

static size_t count_stable(const wt_layer_feedback *loop)
{
    size_t n = 0;
    for (size_t i = 0; i < loop->n_roots; i++)
        n += loop->root[i].stable;
    return n;
}

static bool has_same_balances(const wt_layer_feedback *a, const wt_layer_feedback *b)
{
    if (a->n_roots != b->n_roots)
        return false;
    for (size_t i = 0; i < a->n_roots; i++)
        if (a->root[i].stable != b->root[i].stable ||
            (a->root[i].thickness > 0) != (b->root[i].thickness > 0))
            return false;
    return true;
}

static bool has_same_folds(const wt_layer_feedback *a, const wt_layer_feedback *b)
{
    if (a->n_folds != b->n_folds)
        return false;
    for (size_t i = 0; i < a->n_folds; i++)
        if (a->fold[i].maximum != b->fold[i].maximum)
            return false;
    return true;
}

static void store_states(const balance_state *states, size_t n, bool same, double *out)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < N_AT; k++)
            out[N_AT * i + k] = same ? states[i].value[k] : (double)NAN;
}

static wt_status balances_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const balances_task *task = user;
    const wt_layer_feedback *centre = &task->centre.loop;
    wt_layer_job job;
    layer_context context;
    balances b = {.context = &context};
    wt_status status = layer_draws_replicate_context(&task->draws, i, &job, &context, err);
    if (status == WT_OK) {
        job.specific_wear_rate = (wt_estimate){
            flow_draw_positive(job.specific_wear_rate, context.work->seed, i, FLOW_DRAW_WEAR), 0, 0,
            "m^2/N"};
        status = compute_balances(&b, err);
    }
    if (status != WT_OK)
        return status;
    out[RATIO] = b.loop.ratio;
    out[ONE_WAY] = b.one_way.thickness.value;
    out[BALANCES] = (double)b.loop.n_roots;
    out[SAME_BALANCES] = has_same_balances(&b.loop, centre);
    out[SAME_FOLDS] = has_same_folds(&b.loop, centre);
    double *const roots = out + N_NUMBERS, *const folds = roots + N_AT * centre->n_roots;
    store_states(b.root, centre->n_roots, out[SAME_BALANCES] > 0, roots);
    store_states(b.fold, centre->n_folds, out[SAME_FOLDS] > 0, folds);
    for (size_t k = 0; k < centre->n_roots; k++)
        roots[N_AT * k + AT_WEAR] = job.specific_wear_rate.value; /* the wear rate is an input */
    return WT_OK;
}

/* ---- the table ------------------------------------------------------------------------------- */

/* Share of replicates that must have the same balances for a conclusive number and for errors of
 * them. Below it, the replicates with other balances are not a random subset, and the rest scatter
 * too little. */
static const double agreement_share = 0.95;

static bool is_conclusive(const balances_task *task, size_t same)
{
    return (double)same >= agreement_share * (double)task->solved;
}

/* Tests if the replicates have the same number of balances with the same stability. */
static void assess_agreement(balances_task *task)
{
    const replicates *r = &task->draws.replicates;
    size_t fewest = WT_LAYER_MAX_ROOTS, most = 0;
    for (size_t i = 0; i < r->n; i++) {
        const double *const out = r->value + i * r->stride;
        if (isnan(out[RATIO]))
            continue;
        const size_t n = (size_t)out[BALANCES];
        task->solved++;
        task->has_same_balances += out[SAME_BALANCES] > 0;
        task->has_same_folds += out[SAME_FOLDS] > 0;
        fewest = n < fewest ? n : fewest;
        most = n > most ? n : most;
    }
    const size_t solved = task->solved, same = task->has_same_balances;
    const bool known = is_conclusive(task, same);
    char *const text = task->agreement;
    const size_t size = sizeof task->agreement;
    if (solved == 0)
        snprintf(text, size, "%s: %s", stated_verdict_text(VERDICT_NOT_TESTED),
                 replicates_included_errors(r));
    else if (known)
        snprintf(text, size, "%s: %zu of %zu replicates have as many balances, equally stable",
                 stated_verdict_text(VERDICT_YES), same, solved);
    else
        snprintf(text, size,
                 "%s: %zu of %zu replicates have as many balances, equally stable, and all of them "
                 "%zu to %zu; smaller errors of what is drawn would settle it",
                 stated_verdict_text(VERDICT_INCONCLUSIVE), same, solved, fewest, most);
    if (solved > 0 && !known)
        wt_log_add(task->draws.values.work->log, WT_WARNING, NULL, NULL,
                   "within the stated errors the number of balances of the layer, or their "
                   "stability, may be another: so it is in %zu of %zu replicates",
                   solved - same, solved);
}

/* Removes the errors of n balances or folds that too few replicates share. */
static void clear_uncertain_errors(balances_task *task, size_t same, size_t first, size_t n,
                                   bool given_wear, const char *what)
{
    char *const text = task->errors;
    const size_t used = strlen(text);
    if (n == 0 || is_conclusive(task, same))
        return;
    for (size_t k = 0; k < N_AT * n; k++)
        if (!given_wear || k % N_AT != AT_WEAR)
            task->draws.replicates.error[first + k] = (double)NAN;
    snprintf(text + used, sizeof task->errors - used,
             "; not known of the %s, which only %zu of %zu replicates have", what, same,
             task->solved);
}

/* Writes the error sources, and the balances and folds without errors. */
static void describe_errors(balances_task *task)
{
    const wt_layer_feedback *const loop = &task->centre.loop;
    const size_t folds = N_NUMBERS + N_AT * loop->n_roots;
    layer_draws_describe(&task->draws, task->errors, sizeof task->errors);
    clear_uncertain_errors(task, task->has_same_balances, N_NUMBERS, loop->n_roots, true,
                           "balances");
    clear_uncertain_errors(task, task->has_same_folds, folds, loop->n_folds, false, "folds");
}

static wt_estimate state_estimate(const balance_state *at, const double *error, size_t k)
{
    return (wt_estimate){at->value[k], error[k], at->numerical[k], NULL};
}

static void add_state_row(const balance_state *at, const double *e, const char *kind,
                          balance_stability stable, table_writer *t)
{
    TABLE_ADD(layer_feedback, t, kind, stable, state_estimate(at, e, AT_THICKNESS),
              state_estimate(at, e, AT_SLOPE), state_estimate(at, e, AT_EIGENVALUE),
              state_estimate(at, e, AT_WEAR), state_estimate(at, e, AT_HYSTERESIS),
              state_estimate(at, e, AT_AREA), state_estimate(at, e, AT_FRICTION));
}

static void add_balance_rows(const balances_task *task, table_writer *t)
{
    const wt_layer_feedback *loop = &task->centre.loop;
    const double *e = task->draws.replicates.error + N_NUMBERS;
    for (size_t i = 0; i < loop->n_roots; i++, e += N_AT)
        add_state_row(&task->centre.root[i], e, "balance",
                      loop->root[i].stable ? BALANCE_STABLE : BALANCE_UNSTABLE, t);
    for (size_t i = 0; i < loop->n_folds; i++, e += N_AT)
        add_state_row(&task->centre.fold[i], e, "fold",
                      loop->fold[i].maximum ? FOLD_ABOVE : FOLD_BELOW, t);
}

static const char *describe_loop(const wt_layer_feedback *loop)
{
    const size_t stable = count_stable(loop);
    if (loop->n_roots == 0)
        return "no balance between the thicknesses looked at (reconstructed)";
    if (stable > 1)
        return loop->ratio > 1 ? "several stable balances: which one a layer comes to depends on "
                                 "what was before; from a bare surface it is the thinnest "
                                 "(reconstructed)"
                               : "a bare surface stays bare, and a layer that is thick enough "
                                 "stays, too (reconstructed)";
    return loop->ratio > 1 ? "one stable balance (reconstructed)"
                           : "a bare surface stays bare (reconstructed)";
}

static wt_status tabulate_feedback(balances_task *task, wt_table **table, wt_error *err)
{
    const balances *b = &task->centre;
    const double *const e = task->draws.replicates.error;
    wt_estimate one_way = b->one_way.thickness;
    one_way.standard_error = e[ONE_WAY];
    const wt_estimate ratio = {b->loop.ratio, e[RATIO], b->loop.ratio * b->one_way.ratio_error,
                               NULL};
    assess_agreement(task);
    describe_errors(task);
    table_writer t = table_begin(&layer_feedback_schema, err);
    add_balance_rows(task, &t);
    TABLE_SET(layer_feedback, &t, one_way, ratio, layer_draws_modulus_ratio(&task->draws),
              b->loop.low, b->loop.high, describe_loop(&b->loop), task->agreement, task->errors,
              task->draws.moduli);
    return table_end(&t, table);
}

wt_status wt_layer_steady_states_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                         const wt_layer_observation *observation,
                                         const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || observation == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no balances of a layer to make");
    balances_task task = {.centre = {.context = &task.draws.values}};
    wt_status status = layer_draws_init(&task.draws, sliding, job, observation, work,
                                        "layer that acts back", true, err);
    if (status == WT_OK)
        status = compute_balances(&task.centre, err);
    if (status == WT_OK) {
        const wt_layer_feedback *loop = &task.centre.loop;
        task.draws.replicates.velocity = layer_sliding_velocity(sliding, job);
        status = replicates_draw(&task.draws.replicates,
                                 N_NUMBERS + N_AT * (loop->n_roots + loop->n_folds),
                                 balances_replicate, &task, err);
    }
    if (status == WT_OK)
        status = tabulate_feedback(&task, table, err);
    cost_report(work,
                (cost_summary){.items = GRID + (double)(REPLICATE_GRID * task.draws.replicates.n),
                               .tolerance_asked = work->tolerance});
    layer_draws_clear(&task.draws);
    return status;
}
