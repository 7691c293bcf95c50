/* Energy and friction at an operating point: other loads than those of the sliding, or under a
 * layer, for the stated values or a replicate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/random_draws.h"
#include "layer/layer_energy.h"

#include <math.h>

operating_point operating_point_default(void)
{
    return (operating_point){.pressure = (double)NAN,
                             .velocity = (double)NAN,
                             .temperature = (double)NAN,
                             .layer = {.modulus_ratio = 1}};
}

operating_point layer_under(const layer_context *scene, double thickness)
{
    operating_point spot = operating_point_default();
    if (thickness > 0)
        spot.layer = (wt_layer_state){
            .thickness = thickness, .modulus_ratio = scene->modulus_ratio, .slope = scene->slope};
    return spot;
}

wt_estimate estimate_without_error(double value)
{
    return (wt_estimate){value, (double)NAN, (double)NAN, NULL};
}

/* Sliding with the values of an operating point; *velocity must outlive the result. */
static wt_sliding sliding_at(const layer_context *scene, operating_point spot, double *velocity)
{
    wt_sliding s = *scene->sliding;
    *velocity =
        isnan(spot.velocity) ? flow_layer_velocity(scene->sliding, scene->job) : spot.velocity;
    s.velocity = velocity;
    s.n_velocity = 1;
    s.reference_velocity = *velocity;
    if (!isnan(spot.pressure)) {
        s.pressure.standard_error *= spot.pressure / s.pressure.value;
        s.pressure.value = spot.pressure;
    }
    if (!isnan(spot.temperature))
        s.temperature.value = spot.temperature;
    return s;
}

static wt_status contact_at(const layer_context *scene, const wt_sliding *s, operating_point spot,
                            sliding_contact *c, wt_error *err)
{
    wt_job own = *scene->work;
    own.left_out = WT_EXTRAS;
    /* the cached materials are for the temperature of the sliding */
    return sliding_contact_make(s, &own, scene->replicate,
                                isnan(spot.temperature) ? scene->drawn : NULL, spot.layer, c, err);
}

void layer_friction_join(const wt_layer_job *job, wt_layer_state layer, layer_friction *f)
{
    layer.modulus_ratio = f->ratio;
    const double stress = wt_layer_shear_stress(&job->shear, f->bulk_stress, layer, f->area_ratio);
    f->shear_stress = stress;
    f->total = f->hysteresis + stress * f->area_ratio / f->pressure;
    f->total_error = f->hysteresis_error + stress * f->area_error / f->pressure;
}

double layer_friction_known(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis : f->total;
}

static wt_status find_friction(const layer_context *scene, const wt_sliding *s,
                               const sliding_contact *c, operating_point spot,
                               layer_friction *friction, wt_error *err)
{
    wt_friction_point p;
    const wt_status status =
        wt_friction_compute(c->workspace, c->pressure, s->velocity, 1, &p, err);
    if (status != WT_OK)
        return status;
    *friction = (layer_friction){
        .hysteresis = p.hysteresis.value,
        .area_ratio = p.area_ratio.value,
        .hysteresis_error = p.hysteresis.numerical_error,
        .area_error = p.area_ratio.numerical_error,
        .bulk_stress = sliding_shear(s, c, &p),
        .pressure = c->pressure,
        .ratio = sliding_layer_sheared(c, spot.layer, s->velocity[0]).modulus_ratio};
    layer_friction_join(scene->job, spot.layer, friction);
    return WT_OK;
}

wt_status layer_look(const layer_context *scene, operating_point spot, layer_energy *energy,
                     wt_layer_parameters *parameters, layer_friction *friction, wt_error *err)
{
    double velocity;
    const wt_sliding s = sliding_at(scene, spot, &velocity);
    sliding_contact c = {0};
    wt_status status = contact_at(scene, &s, spot, &c, err);
    if (status == WT_OK && friction != NULL)
        status = find_friction(scene, &s, &c, spot, friction, err);
    if (status == WT_OK && energy != NULL) {
        status = layer_energy_make(&s, scene->job, &c, velocity, spot.layer, energy, err);
        if (status == WT_OK)
            *parameters = layer_parameters_of(scene->job, &c, velocity, energy, scene->work->seed,
                                              scene->replicate);
    }
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_at(const layer_context *scene, operating_point spot, layer_energy *energy,
                   wt_layer_parameters *parameters, wt_error *err)
{
    return layer_look(scene, spot, energy, parameters, NULL, err);
}

wt_status layer_friction_at(const layer_context *scene, operating_point spot,
                            layer_friction *friction, wt_error *err)
{
    return layer_look(scene, spot, NULL, NULL, friction, err);
}

wt_status layer_job_calibrated(const layer_context *scene, wt_layer_job *calibrated, wt_error *err)
{
    *calibrated = *scene->job;
    if (isnan(scene->job->observed_thickness.value))
        return WT_OK;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    const wt_status status = layer_at(scene, operating_point_default(), &energy, &p, err);
    if (status != WT_OK)
        return status;
    calibrated->critical_energy = (wt_estimate){
        wt_layer_calibrate(&energy.source, &p,
                           flow_draw_positive(scene->job->observed_thickness, scene->work->seed,
                                              scene->replicate, FLOW_DRAW_OBSERVED)),
        0, 0, "J/m^3"};
    calibrated->observed_thickness.value = (double)NAN;
    layer_energy_clear(&energy);
    return WT_OK;
}
