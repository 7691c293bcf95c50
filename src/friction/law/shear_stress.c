/* Shear stress of the real contact against velocity and temperature: Lorenz, Oh, Nam, Jeon and
 * Persson, J. Chem. Phys. 142 (2015) 194701.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/friction.h"

#include "core/base/quantity.h"

#include <math.h>

/* Values of that paper in SI units; the activation energy is 0.97 eV. */
wt_shear_law wt_shear_law_defaults(void)
{
    return (wt_shear_law){.kind = WT_SHEAR_CONSTANT,
                          .peak_velocity = 6e-3,
                          .width = 0.1,
                          .activation_energy = 0.97 * ELECTRONVOLT,
                          .reference_temperature = 293.15};
}

double wt_shear_peak_velocity(const wt_shear_law *law, double temperature)
{
    const double reference = law->reference_temperature;
    /* 1/Tref - 1/T as one quotient avoids cancellation for similar temperatures */
    return law->peak_velocity * exp(law->activation_energy / BOLTZMANN *
                                    ((temperature - reference) / (temperature * reference)));
}

double wt_shear_factor(const wt_shear_law *law, double velocity, double temperature)
{
    if (law->kind == WT_SHEAR_CONSTANT || law->width == 0)
        return 1; /* also at rest, where 0 times infinity is undefined */
    const double decades = log10(fabs(velocity) / wt_shear_peak_velocity(law, temperature));
    return exp(-law->width * decades * decades);
}
