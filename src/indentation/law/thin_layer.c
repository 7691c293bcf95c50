/* Apparent modulus of a layer on a half-space. The law is fitted to solutions of the integral
 * equation for cone, sphere and pyramid, with errors of 0.4 % for ratios of 0.67 to 1.5.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/thin_layer.h"

#include <math.h>

/* Upper limit of x within which the law is accurate to 2 %, as for the ratio. */
static const double max_radius_ratio = 6.0;

bool thin_layer_is_valid(double ratio, double x)
{
    return ratio >= THIN_LAYER_MIN_RATIO && ratio <= THIN_LAYER_MAX_RATIO && x >= 0.0 &&
           x < max_radius_ratio;
}

double thin_layer_apparent_modulus(double ratio, double x)
{
    const double q = log(ratio);
    const double influence =
        1.0 - 1.0 / (1.0 + x * ((0.907 - 0.065 * q) +
                                x * ((0.999 - 0.762 * q) + x * (0.437 + 0.007 * q))));
    return 1.0 / (1.0 - influence + influence * ratio);
}
