/* Thin sample on a rigid base. The base increases the force by a factor that depends on x, the
 * contact radius a without the base over the thickness h:
 *
 *     1 + g x + g^2 (3 - u)/2 x^2 + ...,   x = a/h.
 *
 * The first two terms are those of a uniform displacement, with u = 1 for a punch, 2/3 for a
 * paraboloid and 1/2 for a cone. The other terms are fitted to solutions of the integral equation.
 * An incompressible bonded sample has the kernel (sinh 2y - 2y)/(cosh 2y + 1 + 2y^2), a sliding
 * one (cosh 2y - 1)/(sinh 2y + 2y). The error is 0.4 % up to x = 1. It is 2.5 % where a wide cap
 * ends, and for a sphere indented by more than a ninth of its radius.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/tip.h"

#include <math.h>

static const struct {
    double first, third[3], fourth[2], fifth[2];
} bases[] = {
    {1.126955, {4.95543, -6.63938, 2.40491}, {3.95496, -4.68918}, {-3.34946, 3.58523}},
    {0.743303, {1.16234, -1.19514, 0.120389}, {-0.220621, -0.071468}, {-0.332661, 0.440392}},
};

static double shape_number(const wt_tip *tip, double a, double *slope)
{
    const double b = tip->transition_radius;
    *slope = 0.0;
    switch (tip->shape) {
    case WT_TIP_PUNCH:
        return 1.0;
    case WT_TIP_PARABOLOID:
    case WT_TIP_SPHERE:
        return 2.0 / 3.0;
    case WT_TIP_CONE:
        return 0.5;
    case WT_TIP_BLUNTED_PYRAMID:
        break;
    }
    if (a <= b)
        return 2.0 / 3.0;
    const double left = pow(b / a, 3) / 6.0; /* transition from the cap to the faces */
    *slope = -3.0 * left / a;
    return 0.5 + left;
}

contact_point_values thin_sample_values(const wt_tip *tip, contact_point_values half_space)
{
    const double a = 0.5 * half_space.slope, growth = 0.5 * half_space.curvature;
    const double reach = a / tip->sample_thickness, x = fmin(reach, THIN_SAMPLE_MAX_RATIO);
    double u_slope, u = shape_number(tip, a, &u_slope);
    const double g = bases[tip->unbonded].first, g2 = 0.5 * g * g * (3.0 - u);
    const double *c = bases[tip->unbonded].third;
    const double c3 = c[0] + u * (c[1] + u * c[2]), d3 = c[1] + 2.0 * u * c[2];
    const double d4 = bases[tip->unbonded].fourth[1], c4 = bases[tip->unbonded].fourth[0] + u * d4;
    const double d5 = bases[tip->unbonded].fifth[1], c5 = bases[tip->unbonded].fifth[0] + u * d5;
    const double by_x = g + x * (2.0 * g2 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)));
    const double by_u = x * x * (-0.5 * g * g + x * (d3 + x * (d4 + x * d5)));
    /* Beyond its range the factor continues linearly, so that a fit converges. The verdict then
     * rejects the fit. */
    const double factor =
        1.0 + x * (g + x * (g2 + x * (c3 + x * (c4 + x * c5)))) + by_x * (reach - x);
    return (contact_point_values){factor * half_space.g,
                                  factor * half_space.slope +
                                      half_space.g * growth *
                                          (by_x / tip->sample_thickness + by_u * u_slope),
                                  (double)NAN};
}
