/* Friction during the growth of a layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/layer_growth.h"
#include "job/random_draws.h"
#include "layer/layer_energy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of times in equal ratios. With damage transport, the spacing locates an instantaneous
 * layer to 2 %. The rate balance is smooth, and linear interpolation misses less than 0.1 %. */
enum { TIMES_TRANSPORT = 600, TIMES_RATES = 150 };
/* Number of thicknesses at which friction is computed. The curve through them misses less than 0.1
 * % of its change. */
enum { NODES = 32 };
/* Thinnest layer, as a fraction of 1/q1 or at least as a fraction of the final thickness. The
 * shortest wave hardly senses it. */
static const double thinnest = 0.02, least_part = 1e-3;

typedef struct growth_inputs {
    wt_sliding sliding; /* at the conditions of the record */
    double velocity;
    const wt_sliding *stated; /* at the conditions of the case, where a thickness was observed */
    wt_layer_job job;         /* as stated, with the shear stress of the layer */
    const wt_layer_observation *observation;
    const wt_job *work;
    double *time; /* [n] */
    size_t n;
} growth_inputs;

/* Remaining fraction of the change of friction at the settling time. An instrument hardly resolves
 * the remainder. */
static const double remainder_share = 0.05;

/* Numbers of one draw that precede its friction in time. */
enum { BARE, END, N_FIRST };

/* ---- one draw -------------------------------------------------------------------------------- */

/* Creates the context of a draw at the conditions of the record. The caller owns its job. The
 * critical energy reproduces the observed thickness at the conditions of the case. */
static wt_status draw_context(const growth_inputs *g, size_t replicate, wt_material_cache *drawn,
                              wt_layer_job *job, layer_context *scene, wt_error *err)
{
    const wt_layer_observation *const observation = g->observation;
    const uint64_t seed = g->work->seed;
    *scene = (layer_context){.sliding = g->stated,
                             .job = &g->job,
                             .work = g->work,
                             .replicate = replicate,
                             .modulus_ratio = (double)NAN};
    const wt_status status = layer_job_calibrate(scene, job, err);
    job->velocity = g->velocity;
    job->time = NULL;
    *scene = (layer_context){.sliding = &g->sliding,
                             .job = job,
                             .work = g->work,
                             .replicate = replicate,
                             .drawn = drawn,
                             .modulus_ratio = flow_draw_positive_t(
                                 observation->modulus_ratio, observation->modulus_ratio_df, seed,
                                 replicate, FLOW_DRAW_RATIO),
                             .slope = sliding_layer_ratio_slope(observation, seed, replicate),
                             .bulk_shear = observation->bulk_shear};
    return status;
}

/* Friction with a layer, and the thickness in time. */
typedef struct growth_draw {
    layer_context *scene;
    wt_layer_parameters parameters;
    wt_layer_point *points; /* [n] at the times */
    double thickness, bare; /* final thickness [m]; friction coefficient without a layer */
    layer_friction_model friction_of;
} growth_draw;

static wt_status grow_layer(const growth_inputs *g, growth_draw *d, wt_error *err)
{
    wt_layer_parameters *const p = &d->parameters;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_steady_state balance;
    wt_status status = layer_compute_energy(d->scene, &energy, p, err);
    p->balance_only = true;
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&energy.source, p, &balance, err);
    if (status == WT_OK)
        d->thickness = balance.thickness.value;
    p->skip_numerical_errors = true;
    if (status == WT_OK && isfinite(d->thickness))
        status = wt_layer_history(&energy.source, p, g->time, g->n, d->points, err);
    layer_energy_clear(&energy);
    if (status == WT_OK && !isfinite(d->thickness))
        status = wt_fail(err, WT_E_RANGE, "the layer grows without end");
    return status;
}

static wt_status find_layer_friction(const growth_inputs *g, growth_draw *d, wt_error *err)
{
    layer_friction bare;
    double most = d->thickness;
    for (size_t i = 0; i < g->n; i++)
        most = fmax(most, d->points[i].thickness.value);
    wt_status status = layer_compute_friction(d->scene, 0, &bare, err);
    if (status != WT_OK)
        return status;
    d->bare = bare.total;
    if (most > 0)
        status = layer_friction_model_create(
            d->scene, fmin(thinnest / g->sliding.surface->q1, least_part * most), most, NODES,
            &d->friction_of, err);
    return status;
}

static wt_status evaluate_friction(const growth_draw *d, double thickness, double *out,
                                   wt_error *err)
{
    layer_friction at = {.total = d->bare};
    const wt_status status =
        thickness > 0 ? layer_friction_model_evaluate(&d->friction_of, thickness, &at, err) : WT_OK;
    *out = at.total;
    return status;
}

/* out: [N_FIRST + n] */
static wt_status compute_draw(const growth_inputs *g, layer_context *scene, double *out,
                              wt_error *err)
{
    growth_draw d = {.scene = scene, .points = wt_alloc(g->n, sizeof *d.points)};
    wt_status status = grow_layer(g, &d, err);
    if (status == WT_OK)
        status = find_layer_friction(g, &d, err);
    for (size_t i = 0; status == WT_OK && i < g->n; i++)
        status = evaluate_friction(&d, d.points[i].thickness.value, &out[N_FIRST + i], err);
    if (status == WT_OK)
        status = evaluate_friction(&d, d.thickness, &out[END], err);
    out[BARE] = d.bare;
    layer_friction_model_clear(&d.friction_of);
    free(d.points);
    return status;
}

/* ---- times ----------------------------------------------------------------------------------- */

/* Refines the times at which a layer is shown. */
static wt_status choose_times(growth_inputs *g, growth *out, wt_error *err)
{
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    wt_layer_steady_state balance;
    wt_layer_job job;
    layer_context scene;
    double *shown = NULL;
    size_t n = 0;
    wt_status status = draw_context(g, WT_NO_REPLICATE, NULL, &job, &scene, err);
    if (status == WT_OK)
        status = layer_compute_energy(&scene, &energy, &p, err);
    if (status == WT_OK)
        status = wt_layer_steady_state_compute(&energy.source, &p, &balance, err);
    layer_energy_clear(&energy);
    if (status == WT_OK && balance.thickness.value <= 0)
        status = wt_fail(err, WT_E_RANGE, "no layer is predicted there: wear exceeds formation");
    if (status == WT_OK)
        shown = layer_times_choose(&job, &balance, &n);
    if (status == WT_OK) {
        /* With the rate balance the layer starts at once. The times start where the thinnest
         * relevant layer exists. */
        const double at_once = thinnest / g->sliding.surface->q1 / balance.formation_rate_zero,
                     first =
                         g->job.incubation || !(at_once > 0) ? shown[0] : fmin(shown[0], at_once);
        out->log_first = log(first);
        out->log_step = log(shown[n - 1] / first) / (double)(g->n - 1);
        for (size_t i = 0; i < g->n; i++)
            g->time[i] = exp(out->log_first + (double)i * out->log_step);
    }
    free(shown);
    return status;
}

/* ---- draws ----------------------------------------------------------------------------------- */

typedef struct growth_replicates {
    growth_inputs g;
    replicates *r;
} growth_replicates;

static wt_status compute_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const growth_replicates *const d = user;
    wt_layer_job job;
    layer_context scene;
    const wt_status status = draw_context(&d->g, i, d->r->drawn, &job, &scene, err);
    return status == WT_OK ? compute_draw(&d->g, &scene, out, err) : status;
}

static replicates begin_growth_replicates(const growth_inputs *g)
{
    replicates r = replicates_create(&g->sliding, g->work, "friction in running-in");
    r.velocity = g->velocity;
    layer_replicates_add(&r, &g->sliding, &g->job);
    if (g->job.energy == WT_LAYER_HYSTERESIS)
        replicates_add(&r, g->sliding.shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    replicates_add_layer(&r, g->observation, "modulus ratio of the layer");
    return r;
}

static wt_status draw_growth(const growth_inputs *g, growth *out, wt_error *err)
{
    replicates r = begin_growth_replicates(g);
    const growth_replicates d = {*g, &r};
    out->n_draws = r.n;
    out->value = wt_alloc((1 + r.n) * out->stride, sizeof *out->value);
    wt_layer_job job;
    layer_context nominal;
    wt_status status = draw_context(g, WT_NO_REPLICATE, NULL, &job, &nominal, err);
    if (status == WT_OK)
        status = compute_draw(g, &nominal, out->value, err);
    if (status == WT_OK && r.n > 0)
        status = replicates_draw(&r, out->stride, compute_replicate, &d, err);
    if (status == WT_OK && r.n > 0)
        memcpy(out->value + out->stride, r.value, r.n * out->stride * sizeof *r.value);
    snprintf(out->includes, sizeof out->includes, "%s", replicates_included_errors(&r));
    replicates_clear(&r);
    return status;
}

wt_status growth_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                         const wt_layer_observation *observation, const measured_step *at,
                         const wt_job *work, growth *out, wt_error *err)
{
    wt_job own = *work;
    own.drawn = NULL; /* the stored draws are for another temperature */
    own.left_out = WT_EXTRA_ALL;
    growth_inputs g = {.sliding = *sliding,
                       .velocity = at->velocity,
                       .stated = sliding,
                       .job = *layer,
                       .observation = observation,
                       .work = &own,
                       .n = layer->incubation ? TIMES_TRANSPORT : TIMES_RATES};
    measured_step_conditions(at, &g.sliding);
    *out = (growth){.n = g.n, .stride = N_FIRST + g.n};
    g.sliding.velocity = &g.velocity;
    g.sliding.n_velocity = 1;
    g.sliding.reference_velocity = g.velocity;
    g.time = wt_alloc(g.n, sizeof *g.time);
    wt_status status = choose_times(&g, out, err);
    if (status == WT_OK)
        status = draw_growth(&g, out, err);
    free(g.time);
    return status;
}

void growth_clear(growth *g)
{
    free(g->value);
    *g = (growth){.n = 0};
}

static const double *draw_values(const growth *g, size_t k)
{
    return g->value + k * g->stride;
}

double growth_bare_friction(const growth *g, size_t k, double time)
{
    (void)time;
    return draw_values(g, k)[BARE];
}

/* Friction is constant before the first time, and that of the steady state after the last. */
double growth_friction_at(const growth *g, size_t k, double time)
{
    const double *const v = draw_values(g, k), *const friction = v + N_FIRST;
    const double place = (log(time) - g->log_first) / g->log_step;
    if (!(place > 0))
        return friction[0];
    if (place >= (double)(g->n - 1))
        return v[END];
    const size_t i = (size_t)place;
    return friction[i] + (place - (double)i) * (friction[i + 1] - friction[i]);
}

double growth_change(const growth *g, size_t k, double time)
{
    const double *const v = draw_values(g, k);
    double most = isfinite(v[END]) ? 0 : (double)NAN;
    (void)time;
    for (size_t i = 0; i < g->n; i++)
        if (fabs(v[END] - v[N_FIRST + i]) > fabs(most))
            most = v[END] - v[N_FIRST + i];
    return most;
}

double growth_settling_time(const growth *g, size_t k, double time)
{
    const double *const v = draw_values(g, k),
                        limit = remainder_share * fabs(growth_change(g, k, time));
    for (size_t i = g->n; limit > 0 && i-- > 0;) {
        const double here = fabs(v[N_FIRST + i] - v[END]);
        if (!(here > limit))
            continue;
        if (i + 1 == g->n)
            return (double)NAN;
        const double next = fabs(v[N_FIRST + i + 1] - v[END]),
                     part = (here - limit) / (here - next);
        return exp(g->log_first + ((double)i + part) * g->log_step);
    }
    return (double)NAN;
}

wt_estimate growth_estimate(const growth *g, growth_function *of, double time)
{
    double sum = 0, squares = 0, n = 0;
    for (size_t k = 1; k <= g->n_draws; k++) {
        const double x = of(g, k, time);
        if (isfinite(x)) {
            sum += x;
            squares += x * x;
            n++;
        }
    }
    return (wt_estimate){of(g, 0, time),
                         n > 1 ? sqrt(fmax(squares - sum * sum / n, 0) / (n - 1)) : (double)NAN,
                         (double)NAN, NULL};
}
