/* Energy density w(z) of a source at depth z, and its integrals, as logarithms: no value
 * underflows. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_ENERGY_DENSITY_KERNEL_H
#define WT_LAYER_NUMERICS_ENERGY_DENSITY_KERNEL_H

#include "weartrack/layer.h"

#include <math.h>

/* Returns ln(exp(a) + exp(b)). */
static inline double log_add(double a, double b)
{
    const double high = fmax(a, b);
    return isinf(high) ? high : high + log1p(exp(fmin(a, b) - high));
}

/* Returns WT_E_RANGE with the invalid value of a source. */
wt_status energy_check(const wt_energy_source *source, wt_error *err) WT_NODISCARD;
/* Return ln of w(z), of int_z^inf w dz, and of int_z^(z+length) w dz. The result is -infinity for a
 * source without power. */
double energy_log_density(const wt_energy_source *source, double depth);
double energy_log_tail(const wt_energy_source *source, double depth);
double energy_log_integral(const wt_energy_source *source, double depth, double length);
/* Computes the first two for both profiles at the cost of one. */
enum { ENERGY_PROFILE_VALUES = 4 };
void energy_log_profiles(const wt_energy_source *source, double depth,
                         double logarithm[ENERGY_PROFILE_VALUES]);
/* Computes for the profile `persson` the powers [n] of a source whose tail at z is int_z^(z+length)
 * w, or w itself for length 0. */
void energy_surface_terms(const wt_energy_source *source, double length, double *power);
/* Returns the smallest and the largest wavenumber with power; false if there is none. */
bool energy_wavenumber_range(const wt_energy_source *source, double *q_min, double *q_max);
/* Returns true if w falls with depth for any set of wavenumbers. */
bool energy_is_monotonic(const wt_energy_source *source);
/* Returns the depth below which w falls for any powers [m]. */
double energy_monotonic_depth(const wt_energy_source *source);

/* int_z^(z+length) w, or w itself for length 0, at a depth, with its slope there and a bound of its
 * second derivative over the next `reach`. All are multiplied by exp(log_scale). q_min is the
 * smallest wavenumber with power. */
typedef struct energy_expansion {
    double log_scale;
    double value, slope, curvature;
} energy_expansion;
energy_expansion energy_expand(const wt_energy_source *source, double q_min, double depth,
                               double length, double reach);

#endif
