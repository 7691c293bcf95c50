/* The balance of formation and wear: where it is, how stable, how fast reached, and what happens to
 * a layer that has none.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/layer.h"

#include <math.h>

static wt_layer_regime regime_of(double log_ratio)
{
    if (!(log_ratio > 0))
        return WT_LAYER_NONE;
    return log_ratio < 1 ? WT_LAYER_THIN : WT_LAYER_THICK;
}

/* With damage transport nothing regrows where R <= 1: the old layer is worn off from the top. */
static double removal_of_old_layer(const layer_rates *rates, double start)
{
    if (start == 0)
        return 0;
    return rates->wear > 0 ? start / rates->wear : HUGE_VAL;
}

wt_status wt_layer_balance_compute(const wt_energy_source *source,
                                   const wt_layer_parameters *parameters, wt_layer_balance *balance,
                                   wt_error *err)
{
    if (balance == NULL)
        return wt_fail(err, WT_E_ARG, "a balance needs a place for the result");
    layer_rates r;
    wt_layer_balance b = {0};
    wt_status status = layer_rates_make(source, parameters, &r, err);
    if (status == WT_OK)
        status = layer_fixed_point(&r, 0, &b.thickness, err);
    if (status == WT_OK)
        status = layer_incubation(&r, parameters->incubation, &b.incubation_time, err);
    if (status != WT_OK)
        return status;

    b.surface_power = r.power;
    b.formation_rate_zero = r.formation;
    b.wear_rate = r.wear;
    b.ratio = r.formation == 0 ? 0 : exp(r.log_ratio);
    b.critical_specific_wear_rate =
        r.formation == 0
            ? 0
            : exp(r.log_power - r.threshold) / (parameters->pressure * parameters->velocity);
    b.regime = regime_of(r.log_ratio);
    const double rate = r.wear > 0 ? r.wear * layer_decay(&r, b.thickness.value) : 0;
    b.eigenvalue = b.regime == WT_LAYER_NONE ? 0 : -rate;
    b.relaxation_time = rate > 0 ? 1 / rate : HUGE_VAL;
    b.removal_time = (double)NAN;
    if (b.regime == WT_LAYER_NONE) {
        if (parameters->incubation)
            b.removal_time = removal_of_old_layer(&r, parameters->start_thickness);
        else
            status = layer_removal(&r, parameters->start_thickness, &b.removal_time, err);
    }
    if (status == WT_OK)
        *balance = b;
    return status;
}

double wt_layer_calibrate(const wt_energy_source *source, const wt_layer_parameters *parameters,
                          double thickness)
{
    return wt_energy_tail(source, thickness) /
           (parameters->damage * parameters->specific_wear_rate * parameters->pressure *
            parameters->velocity);
}
