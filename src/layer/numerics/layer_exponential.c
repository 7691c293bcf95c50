/* Thickness against time for a single exponential energy profile, in closed form.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/energy_density_kernel.h"

#include <math.h>

/* d delta/dt = Qf0 exp(-kappa delta) - Qw, clamped at 0. With s = kappa Qw t, phi = (1-exp(-s))/s:
 *   delta = d0 + log1p(a) / kappa,  a = kappa t phi (Qf0 exp(-kappa d0) - Qw)
 * Near a = -1 the same result is the logarithm of a sum of two positive terms. */
double wt_layer_exponential_thickness(double start_thickness, double kappa,
                                      double formation_rate_zero, double wear_rate, double time)
{
    if (!(start_thickness >= 0 && kappa >= 0 && formation_rate_zero >= 0 && wear_rate >= 0 &&
          time >= 0) ||
        !isfinite(start_thickness) || !isfinite(kappa) || !isfinite(formation_rate_zero) ||
        !isfinite(wear_rate) || !isfinite(time))
        return (double)NAN;
    if (kappa == 0)
        return fmax(0, start_thickness + (formation_rate_zero - wear_rate) * time);
    const double s = kappa * wear_rate * time;
    const double phi = s > 0 ? -expm1(-s) / s : 1;
    const double rate = formation_rate_zero * exp(-kappa * start_thickness) - wear_rate;
    const double a = kappa * (time * phi) * rate;
    if (a > -0.5)
        return fmax(0, start_thickness + log1p(a) / kappa);
    const double grown = log(kappa) + log(formation_rate_zero) + log(time * phi);
    return fmax(0, log_add(grown, kappa * start_thickness - s) / kappa);
}
