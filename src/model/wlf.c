/* Shift laws: Williams-Landel-Ferry, its change of reference temperature, and Arrhenius.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/model.h"

#include <math.h>

static const double gas_constant = 8.31446261815324; /* J/(mol K), exact since 2019 */
static const double ln10 = 2.302585092994045684;

double wt_wlf_log_shift(const wt_wlf *wlf, double temperature)
{
    const double rise = temperature - wlf->reference_temperature;
    const double above_pole = wlf->c2 + rise;
    /* A pole at or above the reference would make the law infinite between the two. */
    if (!(above_pole > 0.0) || !(wlf->c2 > 0.0))
        return (double)NAN;
    return -wlf->c1 * rise / above_pole;
}

wt_status wt_wlf_rereference(const wt_wlf *wlf, double temperature, wt_wlf *out, wt_error *err)
{
    const double c2 = wlf->c2 + (temperature - wlf->reference_temperature);
    if (!(wlf->c2 > 0.0) || !isfinite(wlf->c1) || !isfinite(wlf->c2)) {
        wt_status status = wt_fail(err, WT_E_RANGE, "the WLF constants are not usable");
        wt_error_expected(err, "finite c1 and c2 > 0 K");
        wt_error_found(err, "c1 = %g, c2 = %g K", wlf->c1, wlf->c2);
        wt_error_advice(err, "check that the constants belong to the reference temperature %.2f °C",
                        wlf->reference_temperature - WT_ZERO_CELSIUS);
        return status;
    }
    if (!(c2 > 0.0) || !isfinite(c2)) {
        wt_status status =
            wt_fail(err, WT_E_RANGE, "the WLF law has no value at the new reference temperature");
        wt_error_expected(err, "a temperature above the pole at %.2f °C",
                          wlf->reference_temperature - wlf->c2 - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f °C", temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "choose a warmer reference temperature");
        return status;
    }
    const wt_wlf moved = {
        .reference_temperature = temperature, .c1 = wlf->c1 * (wlf->c2 / c2), .c2 = c2};
    *out = moved;
    return WT_OK;
}

double wt_arrhenius_log_shift(double activation_energy, double reference_temperature,
                              double temperature)
{
    if (!(temperature > 0.0) || !(reference_temperature > 0.0))
        return (double)NAN;
    /* 1/T - 1/Tref as one quotient: no cancellation for neighbouring temperatures. */
    return activation_energy / (gas_constant * ln10) *
           ((reference_temperature - temperature) / (temperature * reference_temperature));
}
