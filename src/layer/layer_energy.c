/* Energy that modifies the rubber in one sliding contact: hysteresis, shearing of the surface or
 * both.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_energy.h"
#include "job/random_draws.h"

#include <math.h>

void layer_energy_clear(layer_energy *energy)
{
    wt_energy_source_clear(&energy->source);
}

/* Ratio of the effective power to that of the hysteresis. */
static double power_factor(const wt_layer_job *job, const layer_energy *e)
{
    const double shear = job->energy == WT_LAYER_HYSTERESIS ? 0 : e->shear_power;
    const double hysteresis = job->energy == WT_LAYER_SHEAR ? 0 : e->hysteresis_power;
    return (hysteresis + shear) / e->hysteresis_power;
}

/* Computes friction, contact area and the power of shearing. */
static wt_status compute_contact_area(const wt_layer_job *job, const sliding_contact *c,
                                      double velocity, wt_layer_state layer, layer_energy *e,
                                      wt_error *err)
{
    const wt_status status =
        wt_friction_compute(c->workspace, c->pressure, &velocity, 1, &e->point, err);
    if (status != WT_OK)
        return status;
    const double area = e->point.area_ratio.value;
    e->shear_power = wt_layer_shear_stress(&job->shear, c->shear_stress,
                                           sliding_layer_at_shear_rate(c, layer, velocity)) *
                     area * fabs(velocity);
    return WT_OK;
}

wt_status layer_energy_compute(const wt_sliding *sliding, const wt_layer_job *job,
                               const sliding_contact *contact, double velocity,
                               wt_layer_state layer, layer_energy *energy, wt_error *err)
{
    layer_energy e = {.shear_power = (double)NAN};
    if (job->energy != WT_LAYER_HYSTERESIS && isnan(sliding->shear_stress.value)) {
        wt_fail(err, WT_E_MISSING, "what shearing the surface costs is not known");
        wt_error_expected(err, "shear-stress, as energy-from is not hysteresis");
        wt_error_advice(err, "give the shear stress of the real contact, such as 5MPa");
        return WT_E_MISSING;
    }
    wt_status status = wt_energy_source_from_friction(contact->workspace, contact->pressure,
                                                      velocity, &e.source, err);
    if (status == WT_OK && job->energy != WT_LAYER_HYSTERESIS)
        status = compute_contact_area(job, contact, velocity, layer, &e, err);
    e.source.profile = job->profile;
    e.source.local_friction = job->local_friction;
    for (size_t i = 0; i < e.source.n; i++)
        e.hysteresis_power += e.source.power[i];
    if (status == WT_OK && job->energy != WT_LAYER_HYSTERESIS) {
        const double factor = power_factor(job, &e);
        if (!isfinite(factor))
            status = wt_fail(err, WT_E_RANGE,
                             "shearing goes as deep as the hysteresis, of which there is none");
        for (size_t i = 0; i < e.source.n; i++)
            e.source.power[i] *= factor;
        e.source.numerical_error += e.point.area_ratio.numerical_error / e.point.area_ratio.value;
    }
    if (status == WT_OK)
        *energy = e;
    else
        layer_energy_clear(&e);
    return status;
}

wt_layer_parameters layer_parameters_create(const wt_layer_job *job, const sliding_contact *contact,
                                            double velocity, uint64_t seed, size_t replicate)
{
    wt_layer_parameters p = wt_layer_defaults();
    p.damage = job->damage;
    p.duty = job->duty;
    p.start_thickness = job->start_thickness;
    p.incubation = job->incubation;
    p.skip_numerical_errors = replicate != WT_NO_REPLICATE;
    p.pressure = contact->pressure;
    p.velocity = velocity;
    p.severity_power = job->severity_power;
    p.severity_exponent = job->severity_exponent;
    p.specific_wear_rate =
        flow_draw_positive(job->specific_wear_rate, seed, replicate, FLOW_DRAW_WEAR);
    p.critical_energy =
        flow_draw_positive(job->critical_energy, seed, replicate, FLOW_DRAW_CRITICAL_ENERGY);
    return p;
}
