/* Thickness against time at constant load: choice between closed form, damage transport and rate
 * balance, in order of time.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_kernel.h"

#include "core/base/array.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Damage transport: the old layer moves up and is worn off; new damage accumulates below. */
static wt_status history_damage(const layer_rates *rates, double start, const layer_instant *at,
                                size_t n, wt_error *err)
{
    double earlier = 0;
    for (size_t i = 0; i < n; i++) {
        wt_estimate grown;
        const wt_status status = layer_damage_depth(rates, at[i].time, earlier, &grown, err);
        if (status != WT_OK)
            return status;
        earlier = grown.value;
        const double old = fmax(0, start - rates->wear * at[i].time);
        if (old > grown.value) {
            grown.value = old;
            grown.numerical_error = rates->skip_numerical_errors
                                        ? (double)NAN
                                        : fmax(grown.numerical_error, 4 * DBL_EPSILON * start) +
                                              rates->wear_error * rates->wear * at[i].time;
        }
        at[i].point->thickness = grown;
    }
    return WT_OK;
}

/* Returns kappa if all power is at one wavenumber under an exponential profile, else 0. */
static double single_kappa(const layer_rates *rates)
{
    const bool single = rates->source->profile == WT_PROFILE_PERSSON && rates->q_min > 0 &&
                        rates->q_min == rates->q_max;
    return single ? 2 * rates->q_min : 0;
}

/* Closed form. Its error follows from rounding and from the error of Qf(0). */
static void history_exponential(const layer_rates *rates, double kappa, double start,
                                const double *time, size_t n, wt_layer_point *points)
{
    const double relative = rates->error + 8 * DBL_EPSILON;
    const double least_wear = rates->wear * fmax(0, 1 - rates->wear_error),
                 most_wear = rates->wear * (1 + rates->wear_error);
    for (size_t i = 0; i < n; i++) {
        const double formation = rates->formation;
        const double value =
            wt_layer_exponential_thickness(start, kappa, formation, rates->wear, time[i]);
        const double more = wt_layer_exponential_thickness(start, kappa, formation * (1 + relative),
                                                           least_wear, time[i]);
        const double less = wt_layer_exponential_thickness(
            start, kappa, formation * fmax(0, 1 - relative), most_wear, time[i]);
        points[i].thickness = (wt_estimate){
            .value = value,
            .numerical_error = fmax(more - value, value - less) +
                               8 * DBL_EPSILON * (fmax(start, value) + fmin(value, 1 / kappa)),
            .unit = "m"};
    }
}

wt_status layer_history_sorted(const layer_rates *rates, double start, bool transport,
                               const double *time, size_t n, wt_layer_point *points, wt_error *err)
{
    layer_instant *order = wt_alloc(n + 1, sizeof *order);
    for (size_t i = 0; i < n; i++)
        order[i] = (layer_instant){time[i], &points[i]};
    qsort(order, n, sizeof *order, numbers_compare);
    const wt_status status = transport ? history_damage(rates, start, order, n, err)
                                       : layer_integrate_thickness(rates, start, order, n, err);
    free(order);
    return status;
}

wt_status layer_times_check(const double *time, size_t n, wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!(time[i] >= 0) || !isfinite(time[i])) {
            wt_fail(err, WT_E_RANGE, "time %zu of %zu of a layer is outside its range", i + 1, n);
            wt_error_expected(err, "finite and >= 0 s");
            wt_error_found(err, "%g", time[i]);
            return WT_E_RANGE;
        }
    return WT_OK;
}

wt_status wt_layer_history(const wt_energy_source *source, const wt_layer_parameters *parameters,
                           const double *time, size_t n, wt_layer_point *points, wt_error *err)
{
    if (n && (time == NULL || points == NULL))
        return wt_fail(err, WT_E_ARG, "the history of a layer needs times and a place for it");
    layer_rates rates;
    wt_status status = layer_rates_compute(source, parameters, &rates, err);
    if (status == WT_OK)
        status = layer_times_check(time, n, err);
    if (status != WT_OK || n == 0)
        return status;
    const double kappa = single_kappa(&rates);
    if (kappa > 0 && !parameters->incubation)
        history_exponential(&rates, kappa, parameters->start_thickness, time, n, points);
    else
        status = layer_history_sorted(&rates, parameters->start_thickness, parameters->incubation,
                                      time, n, points, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        points[i].time = time[i];
        points[i].formation_rate = layer_formation_rate(&rates, points[i].thickness.value);
        points[i].wear_rate = rates.wear;
    }
    return status;
}
