/* Text about model options of a layer that differ from the default, with the origin of each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_text.h"

#include "core/base/clocale.h"
#include "core/base/quantity.h"

#include <math.h>

void layer_describe(const wt_layer_job *job, const layer_energy *energy,
                    const wt_layer_parameters *parameters, layer_description *words)
{
    *words = (layer_description){.energy = ""};
    if (job->energy == WT_LAYER_SHEAR)
        clocale_print(words->energy, sizeof words->energy,
                      "shearing of the surface, which goes as deep as the hysteresis "
                      "(reconstructed)");
    if (job->energy == WT_LAYER_BOTH)
        clocale_print(
            words->energy, sizeof words->energy,
            "hysteresis, and shearing of the surface, which goes as deep (reconstructed): "
            "shearing is %.3g %% of it",
            100 * energy->shear_power / (energy->hysteresis_power + energy->shear_power));
    if (job->severity_power > 0)
        clocale_print(words->severity, sizeof words->severity,
                      "k = %.4g mm^3/(N m) (1 + (E / %.4g kW/m^2)^%.3g) (reconstructed)",
                      1e9 * parameters->specific_wear_rate, 1e-3 * job->severity_power,
                      job->severity_exponent);
}
