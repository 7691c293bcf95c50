/* Friction predicted at the steps of records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/sliding_contact.h"
#include "record/validation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps with the same temperature and pressure. */
typedef struct prediction_group {
    wt_sliding sliding;
    const wt_layer_observation *observation; /* or NULL */
    const wt_job *work;
    size_t n;
    const double *velocity;
} prediction_group;

static double *part_values(double *out, size_t n, prediction_part part)
{
    return out + (size_t)part * n;
}

/* Computes one contact. `friction_per_shear` is the derivative of the friction with respect to the
 * shear stress of the bulk. */
static wt_status compute_contact(const prediction_group *g, wt_material_cache *drawn,
                                 size_t replicate, wt_layer_state layer, wt_friction_point *points,
                                 double *hysteresis, double *friction_per_shear, wt_error *err)
{
    sliding_contact c = {0};
    wt_status status =
        sliding_contact_create(&g->sliding, g->work, replicate, drawn, layer, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, g->velocity, g->n, points, err);
    for (size_t i = 0; status == WT_OK && i < g->n; i++) {
        const wt_layer_state sheared = sliding_layer_at_shear_rate(&c, layer, g->velocity[i]);
        hysteresis[i] = points[i].hysteresis.value;
        friction_per_shear[i] = sliding_layer_shear_stress(g->observation, 1, sheared) *
                                points[i].area_ratio.value / c.pressure;
    }
    sliding_contact_clear(&c);
    return status;
}

static wt_status compute_group(const prediction_group *g, wt_material_cache *drawn,
                               size_t replicate, double *out, wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_friction_point *const points = wt_alloc(g->n, sizeof *points);
    wt_status status =
        compute_contact(g, drawn, replicate, none, points, part_values(out, g->n, PART_HYSTERESIS),
                        part_values(out, g->n, PART_BY_SHEAR), err);
    for (size_t i = 0; i < g->n; i++)
        part_values(out, g->n, PART_HYSTERESIS_LAYER)[i] =
            part_values(out, g->n, PART_BY_SHEAR_LAYER)[i] = (double)NAN;
    if (status == WT_OK && g->observation != NULL) {
        const wt_layer_state layer = sliding_layer_state(g->observation, g->work->seed, replicate);
        status = compute_contact(g, drawn, replicate, layer, points,
                                 part_values(out, g->n, PART_HYSTERESIS_LAYER),
                                 part_values(out, g->n, PART_BY_SHEAR_LAYER), err);
    }
    free(points);
    return status;
}

/* ---- draws ----------------------------------------------------------------------------------- */

typedef struct group_replicates {
    const prediction_group *prediction_group;
    replicates *r;
} group_replicates;

static wt_status friction_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const group_replicates *d = user;
    return compute_group(d->prediction_group, d->r->drawn, i, out, err);
}

/* Numbers that are drawn for friction with a shear stress and a layer. */
static replicates begin_friction_replicates(const prediction_group *g, const wt_sliding *sliding,
                                            const wt_job *work)
{
    replicates r = replicates_create(&g->sliding, work, "validation");
    if (!isnan(sliding->shear_stress.value))
        replicates_add(&r, sliding->shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    if (g->observation != NULL) {
        replicates_add(&r, g->observation->thickness.standard_error, FLOW_DRAW_THICKNESS,
                       "thickness of the layer");
        replicates_add_layer(&r, g->observation, "modulus ratio of the layer");
    }
    return r;
}

/* ---- all groups ------------------------------------------------------------------------------ */

/* Stores the numbers of a group in the steps from `first` on. */
static void store_group(const double *from, size_t n, size_t first, prediction *p, size_t k)
{
    for (size_t part = 0; part < PARTS; part++)
        memcpy(p->part + (k * PARTS + part) * p->n + first, from + part * n, n * sizeof *from);
}

static wt_status predict_group(const prediction_group *g, const wt_sliding *sliding,
                               const wt_job *work, bool draws, size_t first, prediction *p,
                               wt_error *err)
{
    double *const own = wt_alloc(PARTS * g->n, sizeof *own);
    replicates r = begin_friction_replicates(g, sliding, work);
    wt_status status = compute_group(g, NULL, WT_NO_REPLICATE, own, err);
    if (status == WT_OK)
        store_group(own, g->n, first, p, 0);
    if (status == WT_OK && draws && r.n > 0) {
        const group_replicates d = {g, &r};
        status = replicates_draw(&r, PARTS * g->n, friction_replicate, &d, err);
    }
    for (size_t k = 0; status == WT_OK && k < p->n_draws; k++)
        store_group(r.value + k * r.stride, g->n, first, p, 1 + k);
    memcpy(p->line, r.draw, sizeof p->line);
    p->n_lines = r.n_draws;
    replicates_clear(&r);
    free(own);
    return status;
}

static prediction_group step_group(const wt_sliding *sliding,
                                   const wt_layer_observation *observation,
                                   const measured_step *step, const double *velocity, size_t n,
                                   const wt_job *work)
{
    prediction_group g = {.sliding = *sliding,
                          .observation = observation,
                          .work = work,
                          .n = n,
                          .velocity = velocity};
    measured_step_conditions(step, &g.sliding);
    g.sliding.velocity = velocity;
    g.sliding.n_velocity = n;
    g.sliding.reference_velocity = velocity[0];
    return g;
}

static wt_status predict_groups(const wt_sliding *sliding, const wt_layer_observation *observation,
                                const measured *steps, const wt_job *work, bool draws,
                                prediction *p, wt_error *err)
{
    double *const velocity = wt_alloc(steps->n, sizeof *velocity);
    for (size_t i = 0; i < steps->n; i++)
        velocity[i] = steps->step[i].velocity;
    wt_status status = WT_OK;
    for (size_t first = 0, n; status == WT_OK && first < steps->n; first += n) {
        n = measured_group_length(steps, first);
        const prediction_group g =
            step_group(sliding, observation, &steps->step[first], velocity + first, n, work);
        status = predict_group(&g, sliding, work, draws, first, p, err);
        if (status == WT_OK && observation != NULL)
            status = sliding_layer_zero_loss_range(&g.sliding, observation, work,
                                                   p->zero_loss_range, err);
    }
    free(velocity);
    return status;
}

wt_status predict_friction(const wt_sliding *sliding, const wt_layer_observation *observation,
                           const measured *steps, const wt_job *work, bool draws, prediction *p,
                           wt_error *err)
{
    wt_job own = *work;
    own.drawn = NULL; /* the stored draws are for another temperature */
    own.left_out |= WT_EXTRA_EXTRAPOLATED_SHARE;
    *p = (prediction){.n = steps->n,
                      .layered = observation != NULL,
                      .zero_loss_range = {(double)NAN, (double)NAN}};
    const prediction_group any =
        step_group(sliding, observation, &steps->step[0], &steps->step[0].velocity, 1, &own);
    p->n_draws = draws ? begin_friction_replicates(&any, sliding, &own).n : 0;
    p->part = wt_alloc((1 + p->n_draws) * PARTS * p->n, sizeof *p->part);
    p->shear = wt_alloc(1 + p->n_draws, sizeof *p->shear);
    for (size_t k = 0; k <= p->n_draws; k++)
        p->shear[k] = flow_draw_positive(sliding->shear_stress, work->seed,
                                         k == 0 ? WT_NO_REPLICATE : k - 1, FLOW_DRAW_SHEAR_STRESS);
    return predict_groups(sliding, observation, steps, &own, draws, p, err);
}

void prediction_clear(prediction *p)
{
    free(p->part);
    free(p->shear);
    *p = (prediction){.part = NULL};
}

double prediction_part_value(const prediction *p, size_t k, prediction_part part, size_t step)
{
    return p->part[(k * PARTS + (size_t)part) * p->n + step];
}

double prediction_total(const prediction *p, size_t k, bool layered, size_t step, double shear)
{
    return prediction_part_value(p, k, layered ? PART_HYSTERESIS_LAYER : PART_HYSTERESIS, step) +
           shear * prediction_part_value(p, k, layered ? PART_BY_SHEAR_LAYER : PART_BY_SHEAR, step);
}
