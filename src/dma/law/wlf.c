/* Shift laws: Williams-Landel-Ferry and Arrhenius. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/dma.h"

#include "core/base/quantity.h"

#include <math.h>

double wt_wlf_log_shift(const wt_wlf *wlf, double temperature)
{
    const double rise = temperature - wlf->reference_temperature;
    const double above_pole = wlf->c2 + rise;
    /* With a pole at or above the reference the law is infinite between the two. */
    if (!(above_pole > 0.0) || !(wlf->c2 > 0.0))
        return (double)NAN;
    return -wlf->c1 * rise / above_pole;
}

double wt_arrhenius_log_shift(double activation_energy, double reference_temperature,
                              double temperature)
{
    if (!(temperature > 0.0) || !(reference_temperature > 0.0))
        return (double)NAN;
    /* One quotient for 1/T - 1/Tref avoids cancellation at neighbouring temperatures. */
    return activation_energy / (GAS_CONSTANT * M_LN10) *
           ((reference_temperature - temperature) / (temperature * reference_temperature));
}

double wt_shift_law_log_a(const wt_shift_law *law, double temperature)
{
    const double reference = law->wlf.reference_temperature;
    switch (law->kind) {
    case WT_LAW_WLF:
        return wt_wlf_log_shift(&law->wlf, temperature);
    case WT_LAW_ARRHENIUS:
        return wt_arrhenius_log_shift(law->activation_energy, reference, temperature);
    case WT_LAW_WLF_ARRHENIUS:
        return wt_wlf_log_shift(&law->wlf, fmax(temperature, law->joint)) -
               wt_wlf_log_shift(&law->wlf, fmax(reference, law->joint)) +
               wt_arrhenius_log_shift(law->activation_energy, fmin(reference, law->joint),
                                      fmin(temperature, law->joint));
    case WT_LAW_NONE:
        break;
    }
    return (double)NAN;
}
