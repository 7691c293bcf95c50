/* Energy and friction at an operating point: other loads than those of the sliding, or under a
 * layer, for the stated values or a replicate.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/random_draws.h"
#include "layer/layer_energy.h"

#include <math.h>

double layer_sliding_velocity(const wt_sliding *sliding, const wt_layer_job *layer)
{
    return isnan(layer->velocity) ? flow_reference_velocity(sliding) : layer->velocity;
}

operating_point operating_point_default(void)
{
    return (operating_point){.pressure = (double)NAN,
                             .velocity = (double)NAN,
                             .temperature = (double)NAN,
                             .layer = {.modulus_ratio = 1}};
}

operating_point operating_point_under_layer(const layer_context *context, double thickness)
{
    operating_point conditions = operating_point_default();
    if (thickness > 0)
        conditions.layer = (wt_layer_state){.thickness = thickness,
                                            .modulus_ratio = context->modulus_ratio,
                                            .slope = context->slope};
    return conditions;
}

wt_estimate estimate_without_error(double value)
{
    return (wt_estimate){value, (double)NAN, (double)NAN, NULL};
}

/* Sliding with the values of an operating point; *velocity must outlive the result. */
static wt_sliding sliding_at_conditions(const layer_context *context, operating_point conditions,
                                        double *velocity)
{
    wt_sliding s = *context->sliding;
    *velocity = isnan(conditions.velocity) ? layer_sliding_velocity(context->sliding, context->job)
                                           : conditions.velocity;
    s.velocity = velocity;
    s.n_velocity = 1;
    s.reference_velocity = *velocity;
    if (!isnan(conditions.pressure)) {
        s.pressure.standard_error *= conditions.pressure / s.pressure.value;
        s.pressure.value = conditions.pressure;
    }
    if (!isnan(conditions.temperature))
        s.temperature.value = conditions.temperature;
    return s;
}

static wt_status create_operating_contact(const layer_context *context, const wt_sliding *s,
                                          operating_point conditions, sliding_contact *c,
                                          wt_error *err)
{
    wt_job local_job = *context->work;
    local_job.left_out = WT_EXTRA_ALL;
    /* the cached materials are for the temperature of the sliding */
    return sliding_contact_create(s, &local_job, context->replicate,
                                  isnan(conditions.temperature) ? context->drawn : NULL,
                                  conditions.layer, c, err);
}

void layer_friction_set_total(const wt_layer_job *job, wt_layer_state layer, layer_friction *f)
{
    layer.modulus_ratio = f->ratio;
    const double stress = wt_layer_shear_stress(&job->shear, f->bulk_stress, layer);
    f->shear_stress = stress;
    f->total = f->hysteresis + stress * f->area_ratio / f->pressure;
    f->total_error = f->hysteresis_error + stress * f->area_error / f->pressure;
}

double layer_friction_coefficient(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis : f->total;
}

static wt_status compute_friction_at_point(const layer_context *context, const wt_sliding *s,
                                           const sliding_contact *c, operating_point conditions,
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
        .bulk_stress = c->shear_stress,
        .pressure = c->pressure,
        .ratio = sliding_layer_at_shear_rate(c, conditions.layer, s->velocity[0]).modulus_ratio};
    layer_friction_set_total(context->job, conditions.layer, friction);
    return WT_OK;
}

wt_status layer_compute_contact(const layer_context *context, operating_point conditions,
                                layer_energy *energy, wt_layer_parameters *parameters,
                                layer_friction *friction, wt_error *err)
{
    double velocity;
    const wt_sliding s = sliding_at_conditions(context, conditions, &velocity);
    sliding_contact c = {0};
    wt_status status = create_operating_contact(context, &s, conditions, &c, err);
    if (status == WT_OK && friction != NULL)
        status = compute_friction_at_point(context, &s, &c, conditions, friction, err);
    if (status == WT_OK && energy != NULL) {
        status =
            layer_energy_compute(&s, context->job, &c, velocity, conditions.layer, energy, err);
        if (status == WT_OK)
            *parameters = layer_parameters_create(context->job, &c, velocity, context->work->seed,
                                                  context->replicate);
    }
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_compute_energy(const layer_context *context, operating_point conditions,
                               layer_energy *energy, wt_layer_parameters *parameters, wt_error *err)
{
    return layer_compute_contact(context, conditions, energy, parameters, NULL, err);
}

wt_status layer_compute_friction(const layer_context *context, operating_point conditions,
                                 layer_friction *friction, wt_error *err)
{
    return layer_compute_contact(context, conditions, NULL, NULL, friction, err);
}

wt_status layer_job_calibrate(const layer_context *context, wt_layer_job *calibrated, wt_error *err)
{
    *calibrated = *context->job;
    if (isnan(context->job->observed_thickness.value))
        return WT_OK;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    const wt_status status =
        layer_compute_energy(context, operating_point_default(), &energy, &p, err);
    if (status != WT_OK)
        return status;
    calibrated->critical_energy = (wt_estimate){
        wt_layer_calibrate(&energy.source, &p,
                           flow_draw_positive(context->job->observed_thickness, context->work->seed,
                                              context->replicate, FLOW_DRAW_OBSERVED)),
        0, 0, "J/m^3"};
    calibrated->observed_thickness.value = (double)NAN;
    layer_energy_clear(&energy);
    return WT_OK;
}
