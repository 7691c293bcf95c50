/* A layer at other loads than those of the sliding, and under a layer that is there already.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/layer/layer_energy.h"

#include <math.h>

layer_spot layer_here(void)
{
    return (layer_spot){(double)NAN, (double)NAN, (double)NAN, {0, 1}};
}

wt_estimate layer_alone(double value)
{
    return (wt_estimate){value, (double)NAN, (double)NAN, NULL};
}

/* The sliding with the values of a spot; *velocity is kept by the caller. */
static wt_sliding sliding_at(const wt_sliding *sliding, const wt_layer_job *job, layer_spot spot,
                             double *velocity)
{
    wt_sliding s = *sliding;
    *velocity = isnan(spot.velocity) ? flow_layer_velocity(sliding, job) : spot.velocity;
    s.velocity = velocity;
    s.n_velocity = 1;
    s.reference_velocity = *velocity;
    if (!isnan(spot.pressure))
        s.pressure = (wt_estimate){.value = spot.pressure, .unit = "Pa"};
    if (!isnan(spot.temperature))
        s.temperature = (wt_estimate){.value = spot.temperature, .unit = "K"};
    return s;
}

static wt_status contact_at(const wt_sliding *s, const wt_job *work, layer_spot spot,
                            sliding_contact *c, wt_error *err)
{
    wt_job own = *work;
    own.left_out = WT_EXTRAS;
    return sliding_contact_make(s, &own, WT_NO_REPLICATE, NULL, spot.layer, c, err);
}

wt_status layer_at(const wt_sliding *sliding, const wt_layer_job *job, const wt_job *work,
                   layer_spot spot, layer_energy *energy, wt_layer_parameters *parameters,
                   wt_error *err)
{
    double velocity;
    const wt_sliding s = sliding_at(sliding, job, spot, &velocity);
    sliding_contact c = {0};
    wt_status status = contact_at(&s, work, spot, &c, err);
    if (status == WT_OK)
        status = layer_energy_make(&s, job, &c, velocity, spot.layer, energy, err);
    if (status == WT_OK)
        *parameters = layer_parameters_of(job, &c, velocity, energy, 0, WT_NO_REPLICATE);
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_friction_at(const wt_sliding *sliding, const wt_layer_job *job, const wt_job *work,
                            layer_spot spot, layer_friction *friction, wt_error *err)
{
    double velocity;
    const wt_sliding s = sliding_at(sliding, job, spot, &velocity);
    sliding_contact c = {0};
    wt_friction_point p;
    wt_status status = contact_at(&s, work, spot, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, &velocity, 1, &p, err);
    if (status == WT_OK) {
        const double stress = wt_layer_shear_stress(&job->shear, sliding_shear(&s, &c, &p),
                                                    spot.layer, p.area_ratio.value);
        *friction = (layer_friction){p.hysteresis.value, p.area_ratio.value, stress,
                                     p.hysteresis.value + stress * p.area_ratio.value / c.pressure};
    }
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_job_calibrated(const wt_sliding *sliding, const wt_layer_job *job,
                               const wt_job *work, wt_layer_job *calibrated, wt_error *err)
{
    *calibrated = *job;
    if (isnan(job->observed_thickness.value))
        return WT_OK;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    const wt_status status = layer_at(sliding, job, work, layer_here(), &energy, &p, err);
    if (status != WT_OK)
        return status;
    calibrated->critical_energy.value =
        wt_layer_calibrate(&energy.source, &p, job->observed_thickness.value);
    calibrated->observed_thickness.value = (double)NAN;
    layer_energy_clear(&energy);
    return WT_OK;
}
