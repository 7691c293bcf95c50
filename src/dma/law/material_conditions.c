/* How temperature and strain change the moduli: Williams-Landel-Ferry and Arrhenius, strain
 * softening.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/dma.h"

#include "core/base/param.h"
#include "core/base/quantity.h"

#include <math.h>

/* ---- strain ---------------------------------------------------------------------------------- */

/* No filled rubber softens by more than a hundred times (Payne): what is beyond is a modulus in
 * another unit. */
static const double least_factor = 1e-3, most_factor = 1e3;

wt_status wt_softening_check(const wt_softening *table, wt_error *err)
{
    if (table == NULL || table->n == 0 || table->strain == NULL || table->storage == NULL ||
        table->loss == NULL)
        return wt_fail(err, WT_E_ARG, "a softening needs a table of strain, f and g");
    for (size_t k = 0; k < table->n; k++) {
        const double strain = table->strain[k], f = table->storage[k], g = table->loss[k];
        wt_status status = WT_OK;
        if (!(strain > (k ? table->strain[k - 1] : 0)) || !isfinite(strain))
            status = range_error("strain of a softening", strain, "finite, > 0 and rising", err);
        else if (!(f >= least_factor && f <= most_factor))
            status = range_error("f of a softening", f, "from 1e-3 to 1e3", err);
        else if (!(g >= least_factor && g <= most_factor))
            status = range_error("g of a softening", g, "from 1e-3 to 1e3", err);
        if (status != WT_OK) {
            wt_error_place(err, "point %zu of %zu", k + 1, table->n);
            return status;
        }
    }
    return WT_OK;
}

/* ---- temperature ----------------------------------------------------------------------------- */

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
