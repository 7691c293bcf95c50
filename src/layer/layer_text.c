/* Text about model options of a layer that differ from the default, with the origin of each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_text.h"

#include "core/base/clocale.h"
#include "core/base/quantity.h"

#include <math.h>

/* Rate of modification without load in 30 years. A rate above it is not plausible for rubber. */
static const double shelf_rate = 1e-9; /* [1/s] */

void layer_describe(const wt_layer_job *job, const layer_energy *energy,
                    const wt_layer_parameters *parameters, layer_description *words)
{
    const wt_activation *a = &parameters->activation;
    *words = (layer_description){.energy = ""};
    if (job->energy == WT_LAYER_SHEAR)
        clocale_print(words->energy, sizeof words->energy,
                      "%.3g %% of the shearing of the surface, which goes as deep as the "
                      "hysteresis (reconstructed)",
                      100 * job->shear_share);
    if (job->energy == WT_LAYER_BOTH)
        clocale_print(words->energy, sizeof words->energy,
                      "hysteresis, and %.3g %% of the shearing of the surface, which goes as deep "
                      "(reconstructed): shearing is %.3g %% of it",
                      100 * job->shear_share,
                      100 * job->shear_share * energy->shear_power /
                          (energy->hysteresis_power + job->shear_share * energy->shear_power));
    if (job->closure == WT_CLOSURE_ACTIVATED)
        clocale_print(words->closure, sizeof words->closure,
                      "activated (reconstructed): barrier %.4g eV, activation volume %.4g nm^3, "
                      "attempts at kB T/%s, at %.1f degC, on a real contact of %.3g %%%s",
                      a->barrier / ELECTRONVOLT, 1e27 * a->volume,
                      a->attempt == WT_ATTEMPT_H ? "h" : "hbar", a->temperature - WT_ZERO_CELSIUS,
                      100 * a->area_ratio, a->ageing ? "; it ages without load" : "");
    if (job->severity_power > 0)
        clocale_print(words->severity, sizeof words->severity,
                      "k = %.4g mm^3/(N m) (1 + (E / %.4g kW/m^2)^%.3g) (reconstructed)",
                      1e9 * parameters->specific_wear_rate, 1e-3 * job->severity_power,
                      job->severity_exponent);
}

void layer_warn_shelf_life(const wt_layer_job *job, const wt_layer_parameters *parameters,
                           wt_log *log)
{
    const wt_activation *a = &parameters->activation;
    if (job->closure != WT_CLOSURE_ACTIVATED || wt_activation_unloaded_rate(a) <= shelf_rate)
        return;
    wt_log_add(log, WT_WARNING, NULL, NULL,
               "a barrier of %.4g eV lets the rubber be modified in %.3g s without any load "
               "at %.1f degC: below %.4g eV it does not keep",
               a->barrier / ELECTRONVOLT, parameters->damage / wt_activation_unloaded_rate(a),
               a->temperature - WT_ZERO_CELSIUS,
               wt_activation_min_barrier(a->temperature, a->attempt, shelf_rate) / ELECTRONVOLT);
}
