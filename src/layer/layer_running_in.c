/* Table of the friction during running-in: layer growth and its effect on friction, for the stated
 * values and, for the standard errors, by replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"
#include "layer/layer_energy.h"
#include "layer/monte_carlo.h"

#include "core/base/array.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>

/* Running-in ends when this share of the change of friction remains. */
static const double settled_share = 0.05;
/* Number of bisections of a time step, to 1e-12 of it. */
enum { MAX_HALVINGS = 40 };

/* One computation through the times of the task. */
typedef struct running_in_run {
    layer_context *context;
    const double *time; /* [n] borrowed */
    size_t n;
    layer_friction_model friction_model;
    wt_energy_source source; /* source of bare rubber, and its parameters; empty with feedback */
    wt_layer_parameters parameters;
    wt_layer_point *points;   /* [n] */
    layer_friction *friction; /* [n] */
    wt_estimate thickness;    /* at balance; NaN or infinite if there is none */
    layer_friction bare, balance;
    double settled; /* settling time [s]; NaN if outside the times */
} running_in_run;

typedef struct running_task {
    layer_draws draws;
    double *time;
    size_t n;
    running_in_run centre;
    char shear[256], known[200], errors[560];
} running_task;

TABLE_ROW(running_in, RUNNING_IN, double time;
          wt_estimate thickness, hysteresis, area_ratio, shear_stress, friction;)
TABLE_KEYS(running_in, RUNNING_IN, double velocity; wt_estimate modulus_ratio;
           wt_estimate bare, balance, thickness, settled; double settled_low, settled_high;
           const char *known, *shear, *back, *errors, *moduli;)

/* ---- thickness ------------------------------------------------------------------------------- */

/* Computes the balance that a bare surface reaches, and the thickness against time, with feedback.
 */
static wt_status compute_feedback_thickness(running_in_run *r, wt_error *err)
{
    wt_layer_feedback loop;
    wt_status status = feedback_find_balances(r->context, &loop, err);
    if (status != WT_OK)
        return status;
    r->thickness = estimate_without_error(loop.ratio > 1 ? (double)NAN : 0);
    for (size_t i = loop.n_roots; i-- > 0;)
        if (loop.root[i].stable)
            r->thickness.value = loop.root[i].thickness;
    return wt_layer_feedback_history(feedback_energy, r->context, &loop, r->time, r->n, r->points,
                                     err);
}

static wt_status compute_thickness(running_in_run *r, wt_error *err)
{
    wt_layer_steady_state balance;
    wt_status status = WT_OK;
    r->points = wt_alloc(r->n + 1, sizeof *r->points);
    r->friction = wt_alloc(r->n + 1, sizeof *r->friction);
    if (r->context->job->has_feedback)
        return compute_feedback_thickness(r, err);
    status = feedback_energy(0, r->context, &r->source, &r->parameters, err);
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&r->source, &r->parameters, &balance, err);
    if (status == WT_OK) {
        r->thickness = balance.thickness;
        status = wt_layer_history(&r->source, &r->parameters, r->time, r->n, r->points, err);
    }
    return status;
}

/* ---- friction -------------------------------------------------------------------------------- */

/* Thickness at a time between two of the list. With feedback it is interpolated linearly in the
 * logarithm of the time. */
static wt_status interpolate_thickness(const running_in_run *r, size_t i, double time,
                                       double *thickness, wt_error *err)
{
    const double from = r->points[i].thickness.value, to = r->points[i + 1].thickness.value;
    wt_layer_point point;
    if (r->source.n == 0) {
        const double part = log(time / r->time[i]) / log(r->time[i + 1] / r->time[i]);
        *thickness = from + part * (to - from);
        return WT_OK;
    }
    const wt_status status = wt_layer_history(&r->source, &r->parameters, &time, 1, &point, err);
    *thickness = status == WT_OK ? point.thickness.value : (double)NAN;
    return status;
}

static wt_status bisect_settling_time(running_in_run *r, size_t i, double limit, wt_error *err)
{
    double low = r->time[i], high = r->time[i + 1];
    const double end = layer_friction_coefficient(&r->balance);
    for (int k = 0; k < MAX_HALVINGS; k++) {
        const double middle = sqrt(low * high);
        double thickness;
        layer_friction f;
        wt_status status = interpolate_thickness(r, i, middle, &thickness, err);
        if (status == WT_OK)
            status = layer_friction_model_evaluate(&r->friction_model, thickness, &f, err);
        if (status != WT_OK)
            return status;
        if (fabs(layer_friction_coefficient(&f) - end) > limit)
            low = middle;
        else
            high = middle;
    }
    r->settled = high;
    return WT_OK;
}

static wt_status find_settling_time(running_in_run *r, wt_error *err)
{
    const double end = layer_friction_coefficient(&r->balance);
    const double limit = settled_share * fabs(layer_friction_coefficient(&r->bare) - end);
    r->settled = (double)NAN;
    for (size_t i = r->n; isfinite(limit) && i-- > 1;)
        if (fabs(layer_friction_coefficient(&r->friction[i - 1]) - end) > limit)
            return fabs(layer_friction_coefficient(&r->friction[i]) - end) <= limit &&
                           r->time[i - 1] > 0
                       ? bisect_settling_time(r, i - 1, limit, err)
                       : WT_OK;
    return WT_OK;
}

/* Computes thickness and friction at the times. `nodes` is the number of nodes for the
 * interpolation of friction; 0 for direct computation. */
static wt_status compute_thickness_and_friction(running_in_run *r, size_t nodes, wt_error *err)
{
    double thinnest = HUGE_VAL, thickest = 0;
    wt_status status = compute_thickness(r, err);
    for (size_t i = 0; status == WT_OK && i <= r->n; i++) {
        const double d = i < r->n ? r->points[i].thickness.value : r->thickness.value;
        thinnest = d > 0 ? fmin(thinnest, d) : thinnest;
        thickest = isfinite(d) ? fmax(thickest, d) : thickest;
    }
    if (status == WT_OK)
        status = layer_friction_model_create(r->context, thinnest, thickest, nodes,
                                             &r->friction_model, err);
    if (status == WT_OK)
        status = layer_friction_model_evaluate(&r->friction_model, 0, &r->bare, err);
    if (status == WT_OK)
        status =
            layer_friction_model_evaluate(&r->friction_model, r->thickness.value, &r->balance, err);
    for (size_t i = 0; status == WT_OK && i < r->n; i++)
        status = layer_friction_model_evaluate(&r->friction_model, r->points[i].thickness.value,
                                               &r->friction[i], err);
    return status == WT_OK ? find_settling_time(r, err) : status;
}

static void clear_running_in_run(running_in_run *r)
{
    layer_friction_model_clear(&r->friction_model);
    wt_energy_source_clear(&r->source);
    free(r->points);
    free(r->friction);
}

/* ---- replicates ------------------------------------------------------------------------------ */

/* Quantities of a replicate; those of each time follow. */
enum { BARE, BALANCE, THICKNESS, SETTLED, LN_SETTLED, N_NUMBERS };
enum { AT_THICKNESS, AT_HYSTERESIS, AT_AREA, AT_SHEAR, AT_FRICTION, N_AT };
/* Number of interpolation nodes: the interpolation error is far below the scatter of the
 * replicates. */
enum { NODES = 24 };

static void store_running_in(const running_in_run *r, double *out)
{
    out[BARE] = layer_friction_coefficient(&r->bare);
    out[BALANCE] = layer_friction_coefficient(&r->balance);
    out[THICKNESS] = r->thickness.value;
    out[SETTLED] = r->settled;
    out[LN_SETTLED] = log(r->settled);
    for (size_t i = 0; i < r->n; i++) {
        double *const at = out + N_NUMBERS + N_AT * i;
        at[AT_THICKNESS] = r->points[i].thickness.value;
        at[AT_HYSTERESIS] = r->friction[i].hysteresis;
        at[AT_AREA] = r->friction[i].area_ratio;
        at[AT_SHEAR] = r->friction[i].shear_stress;
        at[AT_FRICTION] = r->friction[i].total;
    }
}

static wt_status running_in_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const running_task *task = user;
    wt_layer_job job;
    layer_context context;
    running_in_run r = {.context = &context, .time = task->time, .n = task->n};
    wt_status status = layer_draws_replicate_context(&task->draws, i, &job, &context, err);
    if (status == WT_OK)
        status = compute_thickness_and_friction(&r, NODES, err);
    if (status == WT_OK)
        store_running_in(&r, out);
    clear_running_in_run(&r);
    return status;
}

/* ---- the table ------------------------------------------------------------------------------- */

static void describe_shear(running_task *task)
{
    if (isnan(task->draws.values.sliding->shear_stress.value))
        snprintf(task->shear, sizeof task->shear, "not known: hysteresis alone");
    else
        sliding_layer_shear_describe(&task->draws.calibrated.shear, task->shear,
                                     sizeof task->shear);
}

static wt_estimate estimate_with_errors(double value, double standard, double numerical)
{
    return (wt_estimate){value, standard, numerical, NULL};
}

static void add_layer_friction_rows(const running_task *task, table_writer *t)
{
    for (size_t i = 0; i < task->n; i++) {
        const layer_friction *f = &task->centre.friction[i];
        const wt_estimate d = task->centre.points[i].thickness;
        const double *const e = task->draws.replicates.error + N_NUMBERS + N_AT * i;
        TABLE_ADD(running_in, t, task->time[i],
                  estimate_with_errors(d.value, e[AT_THICKNESS], d.numerical_error),
                  estimate_with_errors(f->hysteresis, e[AT_HYSTERESIS], f->hysteresis_error),
                  estimate_with_errors(f->area_ratio, e[AT_AREA], f->area_error),
                  estimate_with_errors(f->shear_stress, e[AT_SHEAR], (double)NAN),
                  estimate_with_errors(f->total, e[AT_FRICTION], f->total_error));
    }
}

static double coefficient_error(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis_error : f->total_error;
}

static const char *describe_feedback(const wt_layer_job *job)
{
    if (job->has_feedback)
        return "the layer acts back on the energy that makes it; by the rate balance "
               "(reconstructed)";
    return "the energy is that of the bulk, friction that with the layer (reconstructed)";
}

static wt_status tabulate_running_in(running_task *task, wt_table **table, wt_error *err)
{
    const running_in_run *r = &task->centre;
    const layer_context *values = &task->draws.values;
    const double *const e = task->draws.replicates.error;
    const wt_interval settled = layer_draws_interval(&task->draws, LN_SETTLED, r->settled);
    layer_draws_assess(&task->draws, LN_SETTLED, r->settled,
                       "friction does not settle at these times", "friction settles at these times",
                       task->known, sizeof task->known);
    table_writer t = table_begin(&running_in_schema, err);
    add_layer_friction_rows(task, &t);
    describe_shear(task);
    layer_draws_describe(&task->draws, task->errors, sizeof task->errors);
    TABLE_SET(running_in, &t, layer_sliding_velocity(values->sliding, values->job),
              layer_draws_modulus_ratio(&task->draws),
              estimate_with_errors(layer_friction_coefficient(&r->bare), e[BARE],
                                   coefficient_error(&r->bare)),
              estimate_with_errors(layer_friction_coefficient(&r->balance), e[BALANCE],
                                   coefficient_error(&r->balance)),
              estimate_with_errors(r->thickness.value, e[THICKNESS], r->thickness.numerical_error),
              estimate_with_errors(r->settled, isnan(settled.low) ? (double)NAN : e[SETTLED],
                                   (double)NAN),
              settled.low, settled.high, task->known, task->shear, describe_feedback(values->job),
              task->errors, task->draws.moduli);
    return table_end(&t, table);
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Chooses the times from the balance without feedback, in rising order: the settling time is
 * searched for from the last one. */
static wt_status choose_running_in_times(running_task *task, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    wt_layer_steady_state balance;
    wt_status status = feedback_energy(0, &task->draws.values, &source, &p, err);
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&source, &p, &balance, err);
    if (status == WT_OK)
        task->time = layer_times_choose(task->draws.values.job, &balance, &task->n);
    if (status == WT_OK)
        numbers_sort(task->time, task->n);
    wt_energy_source_clear(&source);
    return status;
}

wt_status wt_running_in_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                const wt_layer_observation *observation, const wt_job *work,
                                wt_table **table, wt_error *err)
{
    if (job == NULL || observation == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no running-in of a layer to make");
    if (job->has_feedback && job->start_thickness > 0) {
        wt_fail(err, WT_E_ARG, "a layer that acts back is followed from a bare surface alone");
        wt_error_place(err, "start-thickness");
        wt_error_found(err, "%g m", job->start_thickness);
        wt_error_advice(err, "leave out start-thickness, or feedback");
        return WT_E_ARG;
    }
    running_task task = {.n = 0};
    wt_status status =
        layer_draws_init(&task.draws, sliding, job, observation, work, "running-in", true, err);
    if (status == WT_OK)
        status = choose_running_in_times(&task, err);
    task.draws.replicates.velocity = status == WT_OK ? layer_sliding_velocity(sliding, job) : 0;
    task.centre = (running_in_run){.context = &task.draws.values, .time = task.time, .n = task.n};
    if (status == WT_OK)
        status = compute_thickness_and_friction(&task.centre, 0, err);
    if (status == WT_OK)
        status = replicates_draw(&task.draws.replicates, N_NUMBERS + N_AT * task.n,
                                 running_in_replicate, &task, err);
    if (status == WT_OK)
        status = tabulate_running_in(&task, table, err);
    cost_report(work, (cost_summary){.items = (double)(task.n * (1 + task.draws.replicates.n)),
                                     .tolerance_asked = work->tolerance});
    layer_draws_clear(&task.draws);
    clear_running_in_run(&task.centre);
    free(task.time);
    return status;
}
