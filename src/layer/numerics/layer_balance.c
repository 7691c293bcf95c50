/* Balance of formation and wear: thickness, stability and relaxation, and the removal of a layer
 * without a balance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_kernel.h"

#include <float.h>
#include <math.h>

static wt_layer_regime classify_regime(double log_ratio)
{
    if (!(log_ratio > 0))
        return WT_LAYER_NONE;
    return log_ratio < 1 ? WT_LAYER_THIN : WT_LAYER_THICK;
}

static wt_estimate time_estimate(double value, double error)
{
    return (wt_estimate){.value = value, .numerical_error = error, .unit = "s"};
}

/* Removal time of the initial layer. With damage transport no new layer forms for R <= 1: the old
 * layer is worn from the top. */
static wt_estimate compute_removal_time(const layer_rates *rates, double start)
{
    if (start == 0)
        return time_estimate(0, 0);
    const double time = rates->wear > 0 ? start / rates->wear : HUGE_VAL;
    return time_estimate(time, (4 * DBL_EPSILON + rates->wear_error) * time);
}

/* 1/(kappa Qw) at the balance; its error follows from those of the thickness and of kappa. */
static wt_estimate compute_relaxation_time(const layer_rates *rates, wt_estimate thickness)
{
    const double rate =
        rates->wear > 0 ? rates->wear * layer_decay_rate(rates, thickness.value) : 0;
    if (!(rate > 0))
        return time_estimate(HUGE_VAL, 0);
    const double time = 1 / rate;
    if (rates->skip_numerical_errors)
        return time_estimate(time, (double)NAN);
    const double above = layer_decay_rate(rates, thickness.value + thickness.numerical_error);
    const double below =
        layer_decay_rate(rates, fmax(0, thickness.value - thickness.numerical_error));
    const double moved =
        fmax(fabs(1 / (rates->wear * above) - time), fabs(1 / (rates->wear * below) - time));
    return time_estimate(time,
                         moved + time * (2 * rates->error + rates->wear_error + 64 * DBL_EPSILON));
}

wt_status wt_layer_steady_state_compute(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters,
                                        wt_layer_steady_state *balance, wt_error *err)
{
    if (balance == NULL)
        return wt_fail(err, WT_E_ARG, "a balance needs a place for the result");
    layer_rates r;
    wt_layer_steady_state b = {0};
    wt_status status = layer_rates_compute(source, parameters, &r, err);
    if (status == WT_OK)
        status = layer_fixed_point(&r, 0, &b.thickness, err);
    b.incubation_time = time_estimate((double)NAN, (double)NAN);
    if (status == WT_OK && !parameters->balance_only)
        status = layer_damage_time(&r, parameters->incubation, (wt_estimate){.unit = "m"},
                                   &b.incubation_time, err);
    if (status != WT_OK)
        return status;

    b.surface_power = r.power;
    b.formation_rate_zero = r.formation;
    b.wear_rate = r.wear;
    b.ratio = r.formation == 0 ? 0 : exp(r.log_ratio);
    b.ratio_error = r.error + r.wear_error;
    wt_layer_parameters unit = *parameters; /* parameters with k = 1, for the severity factor */
    unit.specific_wear_rate = 1;
    b.critical_specific_wear_rate =
        r.formation == 0
            ? 0
            : exp(r.log_power - r.threshold) /
                  (parameters->pressure * parameters->velocity * layer_wear_rate(&unit, r.power));
    b.regime = classify_regime(r.log_ratio);
    b.relaxation_time = compute_relaxation_time(&r, b.thickness);
    b.eigenvalue = b.regime == WT_LAYER_NONE ? 0 : -1 / b.relaxation_time.value;
    b.removal_time = time_estimate((double)NAN, (double)NAN);
    if (b.regime == WT_LAYER_NONE) {
        if (parameters->incubation)
            b.removal_time = compute_removal_time(&r, parameters->start_thickness);
        else
            status = layer_integrate_time(&r, parameters->start_thickness,
                                          (wt_estimate){.unit = "m"}, &b.removal_time, err);
    }
    if (status == WT_OK)
        *balance = b;
    return status;
}

wt_status wt_layer_growth_time(const wt_energy_source *source,
                               const wt_layer_parameters *parameters, wt_estimate thickness,
                               wt_estimate *time, wt_error *err)
{
    if (time == NULL)
        return wt_fail(err, WT_E_ARG, "the time of a thickness needs a place for it");
    layer_rates r;
    *time = time_estimate((double)NAN, (double)NAN);
    wt_status status = layer_rates_compute(source, parameters, &r, err);
    if (status != WT_OK || !(thickness.value > 0))
        return status;
    const double start = parameters->start_thickness;
    if (parameters->incubation)
        status = layer_damage_time(&r, true, thickness, time, err);
    else if (start < thickness.value)
        status = layer_integrate_time(&r, start, thickness, time, err);
    /* never reached, or the old layer is still thicker at that time */
    if (isinf(time->value) || start - r.wear * time->value >= thickness.value)
        *time = time_estimate((double)NAN, (double)NAN);
    return status;
}

double wt_layer_calibrate(const wt_energy_source *source, const wt_layer_parameters *parameters,
                          double thickness)
{
    return wt_energy_tail(source, thickness) /
           (parameters->damage * layer_wear_rate(parameters, wt_energy_tail(source, 0)) *
            parameters->pressure * parameters->velocity);
}
