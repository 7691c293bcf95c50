/* Friction while a layer grows. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/validation/growth.h"
#include "flow/layer/acts_back.h"
#include "flow/sliding/sliding_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Times in equal ratios: by damage transport so close that a layer which is there at once is placed
 * to 2 %; the rate balance is smooth, and its line between two misses a thousandth. */
enum { TIMES_TRANSPORT = 600, TIMES_RATES = 150 };
/* Thicknesses at which friction is computed, in equal ratios, linear in the logarithm between: a
 * line then misses the bends of friction by less than a hundredth of its change. */
enum { NODES = 48 };
/* From a layer that the shortest wave hardly feels: of 1/q1, but of what is grown at least. */
static const double thinnest = 0.02, least_part = 1e-3;

typedef struct growing {
    wt_sliding sliding; /* at the conditions of the record */
    double velocity;
    const wt_sliding *stated; /* the conditions of the case, at which a thickness was observed */
    wt_layer_job job;         /* at the velocity of the record */
    double worn_at;           /* velocity at which that thickness came about */
    wt_layer_known known;     /* with any thickness */
    const wt_job *work;
    double *time; /* [n] */
    size_t n;
} growing;

/* ---- friction -------------------------------------------------------------------------------- */

typedef struct one_draw {
    const growing *g;
    size_t replicate;
    wt_drawn *drawn;
    double ratio; /* of the moduli of layer and bulk */
} one_draw;

static wt_status contact_of(const one_draw *d, wt_layer_state layer, sliding_contact *c,
                            wt_error *err)
{
    return sliding_contact_make(&d->g->sliding, d->g->work, d->replicate, d->drawn, layer, c, err);
}

static wt_status friction_with(const one_draw *d, double thickness, double *friction, wt_error *err)
{
    const wt_layer_state layer = {thickness, thickness > 0 ? d->ratio : 1};
    const wt_sliding *const s = &d->g->sliding;
    sliding_contact c = {0};
    wt_friction_point p;
    wt_status status = contact_of(d, layer, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, &d->g->velocity, 1, &p, err);
    if (status == WT_OK)
        *friction = p.hysteresis.value + sliding_layer_shear(&d->g->known, sliding_shear(s, &c, &p),
                                                             layer, p.area_ratio.value) *
                                             p.area_ratio.value / c.pressure;
    sliding_contact_clear(&c);
    return status;
}

typedef struct friction_nodes {
    double log_first, log_step, value[NODES];
} friction_nodes;

static wt_status find_nodes(const one_draw *d, double most, friction_nodes *nodes, wt_error *err)
{
    const double low = fmin(thinnest / d->g->sliding.surface->q1, least_part * most);
    wt_status status = WT_OK;
    nodes->log_first = log(low);
    nodes->log_step = log(most / low) / (NODES - 1);
    for (int i = 0; status == WT_OK && i < NODES; i++)
        status =
            friction_with(d, exp(nodes->log_first + i * nodes->log_step), &nodes->value[i], err);
    return status;
}

static double friction_at(const friction_nodes *nodes, double bare, double thickness)
{
    if (!(thickness > 0))
        return bare;
    const double place = fmax((log(thickness) - nodes->log_first) / nodes->log_step, 0);
    const size_t i = (size_t)fmin(place, NODES - 2);
    return nodes->value[i] + (place - (double)i) * (nodes->value[i + 1] - nodes->value[i]);
}

/* ---- thickness ------------------------------------------------------------------------------- */

/* The critical energy that makes a thickness observed at the conditions of the case. */
static wt_status calibrate(const one_draw *d, double *critical_energy, wt_error *err)
{
    const growing *const g = d->g;
    const wt_layer_state none = {.modulus_ratio = 1};
    const uint64_t seed = g->work->seed;
    layer_energy energy = {.source = {.n = 0}};
    sliding_contact c = {0};
    /* a material of its own, as it may be of another temperature */
    wt_status status = sliding_contact_make(g->stated, g->work, d->replicate, NULL, none, &c, err);
    if (status == WT_OK)
        status = layer_energy_make(g->stated, &g->job, &c, g->worn_at, none, &energy, err);
    if (status == WT_OK) {
        const wt_layer_parameters p =
            layer_parameters_of(&g->job, &c, g->worn_at, &energy, seed, d->replicate);
        *critical_energy = wt_layer_calibrate(
            &energy.source, &p,
            flow_draw_positive(g->job.observed_thickness, seed, d->replicate, FLOW_DRAW_OBSERVED));
    }
    layer_energy_clear(&energy);
    sliding_contact_clear(&c);
    return status;
}

static wt_status find_energy(const one_draw *d, layer_energy *energy, wt_layer_parameters *p,
                             wt_error *err)
{
    const growing *const g = d->g;
    const wt_layer_state none = {.modulus_ratio = 1};
    sliding_contact c = {0};
    wt_status status = contact_of(d, none, &c, err);
    if (status == WT_OK)
        status = layer_energy_make(&g->sliding, &g->job, &c, g->velocity, none, energy, err);
    if (status == WT_OK)
        *p = layer_parameters_of(&g->job, &c, g->velocity, energy, g->work->seed, d->replicate);
    sliding_contact_clear(&c);
    return status == WT_OK && !isnan(g->job.observed_thickness.value)
               ? calibrate(d, &p->critical_energy, err)
               : status;
}

static wt_status grow_back(const growing *g, double ratio, wt_layer_point *points,
                           double *thickness, wt_error *err)
{
    layer_scene scene = {&g->sliding, &g->job, g->work, WT_NO_REPLICATE, NULL, ratio};
    wt_layer_loop loop;
    wt_status status = acts_back_find(&scene, &loop, err);
    if (status != WT_OK)
        return status;
    *thickness = 0;
    for (size_t i = loop.n_roots; i-- > 0;)
        if (loop.root[i].stable)
            *thickness = loop.root[i].thickness;
    return wt_layer_loop_history(acts_back_energy, &scene, &loop, g->time, g->n, points, err);
}

/* Thickness at the times, and in the end. */
static wt_status grow(const one_draw *d, wt_layer_parameters *p, wt_layer_point *points,
                      double *thickness, wt_error *err)
{
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_balance balance;
    wt_status status = find_energy(d, &energy, p, err);
    p->balance_only = true;
    if (status == WT_OK)
        status = wt_layer_balance_compute(&energy.source, p, &balance, err);
    if (status == WT_OK)
        *thickness = balance.thickness.value;
    p->without_errors = true;
    if (status == WT_OK && d->g->job.acts_back)
        status = grow_back(d->g, d->ratio, points, thickness, err);
    else if (status == WT_OK && isfinite(*thickness))
        status = wt_layer_history(&energy.source, p, d->g->time, d->g->n, points, err);
    layer_energy_clear(&energy);
    if (status == WT_OK && !isfinite(*thickness))
        status = wt_fail(err, WT_E_RANGE, "the layer grows without end");
    return status;
}

/* out: [GROWTH_NUMBERS + n] */
static wt_status follow(const one_draw *d, double *out, wt_error *err)
{
    wt_layer_parameters p;
    double end = (double)NAN, most = 0, *const friction = out + GROWTH_NUMBERS;
    friction_nodes nodes = {.log_step = 1};
    wt_layer_point *const points = calloc(d->g->n, sizeof *points);
    wt_status status = points == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                                      : grow(d, &p, points, &end, err);
    if (status == WT_OK)
        status = friction_with(d, 0, &out[GROWTH_BARE], err);
    for (size_t i = 0; status == WT_OK && i < d->g->n; i++)
        most = fmax(most, points[i].thickness.value);
    most = fmax(most, end);
    if (status == WT_OK && most > 0)
        status = find_nodes(d, most, &nodes, err);
    if (status == WT_OK) {
        for (size_t i = 0; i < d->g->n; i++)
            friction[i] = friction_at(&nodes, out[GROWTH_BARE], points[i].thickness.value);
        out[GROWTH_END] = friction_at(&nodes, out[GROWTH_BARE], end);
        out[GROWTH_WEAR] = p.specific_wear_rate;
        out[GROWTH_ENERGY] = p.closure == WT_CLOSURE_ENERGY ? p.critical_energy : (double)NAN;
    }
    free(points);
    return status;
}

static one_draw draw_of(const growing *g, size_t replicate, wt_drawn *drawn)
{
    const wt_layer_state layer = sliding_layer(&g->known, g->work->seed, replicate);
    return (one_draw){g, replicate, drawn, layer.modulus_ratio};
}

/* ---- the times ------------------------------------------------------------------------------- */

/* Those that a layer is shown at, closer. */
static wt_status choose_times(growing *g, growth *out, wt_error *err)
{
    const one_draw d = draw_of(g, WT_NO_REPLICATE, NULL);
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    wt_layer_balance balance;
    double *shown = NULL;
    size_t n = 0;
    wt_status status = find_energy(&d, &energy, &p, err);
    if (status == WT_OK)
        status = wt_layer_balance_compute(&energy.source, &p, &balance, err);
    layer_energy_clear(&energy);
    if (status == WT_OK && balance.thickness.value <= 0 && !g->job.acts_back)
        status = wt_fail(err, WT_E_RANGE, "no layer is predicted there: wear exceeds formation");
    if (status == WT_OK)
        status = layer_times_choose(&g->job, &balance, &shown, &n, err);
    if (status == WT_OK) {
        out->log_first = log(shown[0]);
        out->log_step = log(shown[n - 1] / shown[0]) / (double)(g->n - 1);
        for (size_t i = 0; i < g->n; i++)
            g->time[i] = exp(out->log_first + (double)i * out->log_step);
    }
    free(shown);
    return status;
}

/* ---- draws ----------------------------------------------------------------------------------- */

typedef struct drawing {
    growing g;
    replicates *r;
} drawing;

static wt_status one_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const drawing *const d = user;
    const one_draw one = draw_of(&d->g, i, d->r->drawn);
    return follow(&one, out, err);
}

static replicates begin_replicates(const growing *g)
{
    const wt_layer_job *const job = &g->job;
    const bool calibrated = !isnan(job->observed_thickness.value),
               activated = job->closure == WT_CLOSURE_ACTIVATED;
    const wt_estimate *const given = activated    ? &job->barrier
                                     : calibrated ? &job->observed_thickness
                                                  : &job->critical_energy;
    replicates r = replicates_of(&g->sliding, g->work, "friction in running-in");
    r.velocity = g->velocity;
    replicates_add(&r, g->sliding.shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                   "shear stress");
    replicates_add(&r, g->known.modulus_ratio.standard_error, FLOW_DRAW_RATIO,
                   "modulus ratio of the layer");
    replicates_add(&r, job->specific_wear_rate.standard_error, FLOW_DRAW_WEAR,
                   "specific wear rate");
    replicates_add(&r, given->standard_error,
                   calibrated ? FLOW_DRAW_OBSERVED : FLOW_DRAW_CRITICAL_ENERGY,
                   activated    ? "barrier"
                   : calibrated ? "observed thickness"
                                : "critical energy");
    return r;
}

static wt_status draw_all(const growing *g, growth *out, wt_error *err)
{
    replicates r = begin_replicates(g);
    const drawing d = {*g, &r};
    if (g->job.acts_back)
        r.n = 0;
    out->n_draws = r.n;
    out->value = calloc((1 + r.n) * out->stride, sizeof *out->value);
    out->course = calloc((1 + r.n) * out->n, sizeof *out->course);
    wt_status status = out->value == NULL || out->course == NULL
                           ? wt_fail(err, WT_E_MEMORY, "out of memory")
                           : WT_OK;
    const one_draw nominal = draw_of(g, WT_NO_REPLICATE, NULL);
    if (status == WT_OK)
        status = follow(&nominal, out->value, err);
    if (status == WT_OK && r.n > 0)
        status = replicates_draw(&r, out->stride, one_replicate, &d, err);
    if (status == WT_OK && r.n > 0)
        memcpy(out->value + out->stride, r.value, r.n * out->stride * sizeof *r.value);
    memcpy(out->line, r.draw, sizeof out->line);
    out->n_lines = r.n_draws;
    snprintf(out->includes, sizeof out->includes, "%s", replicates_include(&r));
    replicates_clear(&r);
    return status;
}

static void find_courses(growth *g)
{
    for (size_t k = 0; k <= g->n_draws; k++) {
        const double *const v = g->value + k * g->stride;
        double most = 0;
        for (size_t i = 0; i < g->n; i++) {
            g->course[k * g->n + i] = v[GROWTH_NUMBERS + i] - v[GROWTH_END];
            most = fmax(most, fabs(g->course[k * g->n + i]));
        }
        g->n_bare += isfinite(v[GROWTH_END]) && most <= 0;
    }
}

static growing growing_of(const wt_sliding *sliding, const wt_layer_job *layer,
                          const wt_layer_known *known, const measured_step *at, const wt_job *work)
{
    growing g = {.sliding = *sliding,
                 .velocity = at->velocity,
                 .stated = sliding,
                 .job = *layer,
                 .worn_at = flow_layer_velocity(sliding, layer),
                 .known = *known,
                 .work = work};
    measured_conditions(at, &g.sliding);
    g.job.velocity = at->velocity;
    g.job.time = NULL;
    g.known.thickness = (wt_estimate){1, 0, 0, "m"}; /* any, for the draws of the ratio */
    return g;
}

wt_status growth_make(const wt_sliding *sliding, const wt_layer_job *layer,
                      const wt_layer_known *known, const measured_step *at, const wt_job *work,
                      growth *out, wt_error *err)
{
    wt_job own = *work;
    own.drawn = NULL; /* of another temperature */
    own.left_out = WT_EXTRAS;
    growing g = growing_of(sliding, layer, known, at, &own);
    g.n = layer->incubation && !layer->acts_back ? TIMES_TRANSPORT : TIMES_RATES;
    *out = (growth){.n = g.n, .stride = GROWTH_NUMBERS + g.n, .without_errors = layer->acts_back};
    g.sliding.velocity = &g.velocity;
    g.sliding.n_velocity = 1;
    g.sliding.reference_velocity = g.velocity;
    g.time = malloc(g.n * sizeof *g.time);
    wt_status status = g.time == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory") : WT_OK;
    if (status == WT_OK && layer->acts_back) {
        const layer_scene stated = {sliding, layer, &own, WT_NO_REPLICATE, NULL, (double)NAN};
        status = layer_job_calibrated(&stated, &g.job, err);
    }
    g.job.velocity = g.velocity;
    g.job.time = NULL;
    if (status == WT_OK)
        status = choose_times(&g, out, err);
    if (status == WT_OK)
        status = draw_all(&g, out, err);
    if (status == WT_OK)
        find_courses(out);
    free(g.time);
    return status;
}

void growth_clear(growth *g)
{
    free(g->value);
    free(g->course);
    *g = (growth){.n = 0};
}

double growth_number_of(const growth *g, size_t k, growth_number number)
{
    return g->value[k * g->stride + (size_t)number];
}

course growth_course(const growth *g, size_t k)
{
    return (course){g->n, g->log_first, g->log_step, g->course + k * g->n};
}

double growth_friction(const growth *g, size_t k, double time)
{
    const course c = growth_course(g, k);
    return growth_number_of(g, k, GROWTH_END) + course_at(&c, log(time));
}
