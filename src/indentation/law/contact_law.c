/* Contact laws of rigid tips on an elastic half-space: Hertz, Sneddon, blunted pyramid.
 *
 * Sphere: Sneddon, Int. J. Eng. Sci. 3 (1965) 47, with t = atanh(a/R): delta = R t tanh(t) and
 * G = R^2 { (1 + tanh(t)^2) t - tanh(t) }. A continued fraction computes the difference t -
 * tanh(t).
 *
 * Blunted pyramid: Rico et al., Phys. Rev. E 72 (2005) 021914, with a parabolic cap r^2/(2R) up to
 * the transition radius b. The published pair delta(a), F(a) loses digits at both ends in double
 * precision. This file uses s = sqrt(a^2 - b^2)/b, h = sqrt(1 + s^2), a = b h:
 *
 *     delta = b^2 h / (R (h + s)) + m cot(theta) b h atan(s)
 *     G     = 2 { b^3 (2h + s) / (3 R (h + s)^2) + (m/2) cot(theta) (a^2 atan(s) + b^2 s) }
 *
 * without cancellation. delta(s) is convex and rises, so Newton's method from above converges
 * without a safeguard.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/tip.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* ---- layer on a half-space ------------------------------------------------------------------- */

/* Apparent modulus of a layer on a half-space. The law is fitted to solutions of the integral
 * equation for cone, sphere and pyramid, with errors of 0.4 % for ratios of 0.67 to 1.5. */

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

/* ---- thin sample on a rigid base ------------------------------------------------------------- */

/* Thin sample on a rigid base. The base increases the force by a factor that depends on x, the
 * contact radius a without the base over the thickness h:
 *
 *     1 + g x + g^2 (3 - u)/2 x^2 + ...,   x = a/h.
 *
 * The first two terms are those of a uniform displacement, with u = 1 for a punch, 2/3 for a
 * paraboloid and 1/2 for a cone. The other terms are fitted to solutions of the integral equation.
 * An incompressible bonded sample has the kernel (sinh 2y - 2y)/(cosh 2y + 1 + 2y^2), a sliding
 * one (cosh 2y - 1)/(sinh 2y + 2y). The error is 0.4 % up to x = 1. It is 2.5 % where a wide cap
 * ends, and for a sphere indented by more than a ninth of its radius. */

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
    const double reach = a / tip->sample_thickness.value, x = fmin(reach, THIN_SAMPLE_MAX_RATIO);
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
                                          (by_x / tip->sample_thickness.value + by_u * u_slope),
                                  (double)NAN};
}

/* ---- half-space ------------------------------------------------------------------------------ */

double tip_facet_factor(unsigned sides)
{
    return sides == 0 ? 1.0 : sides / M_PI * sin(M_PI / sides);
}

bool contact_law_is_valid(const wt_tip *tip, double depth)
{
    const bool has_faces = tip->shape == WT_TIP_CONE || tip->shape == WT_TIP_BLUNTED_PYRAMID;
    return (has_faces || !(depth > ROUND_TIP_MAX_DEPTH_RATIO * tip->radius)) &&
           !(thin_sample_radius_ratio(tip, depth) > THIN_SAMPLE_MAX_RATIO);
}

double contact_switch_depth(const wt_tip *tip)
{
    switch (tip->shape) {
    case WT_TIP_PARABOLOID:
        return (double)INFINITY;
    case WT_TIP_CONE:
    case WT_TIP_SPHERE:
    case WT_TIP_PUNCH:
        return 0.0;
    case WT_TIP_BLUNTED_PYRAMID:
        break;
    }
    return tip->transition_radius == 0.0
               ? 0.0
               : tip->transition_radius * tip->transition_radius / tip->radius;
}

static contact_point_values paraboloid_contact(double radius, double delta)
{
    double a = sqrt(radius * delta);
    return (contact_point_values){4.0 / 3.0 * a * delta, 2.0 * a, a / delta};
}

static double sphere_force(double radius, double t)
{
    const double share = tanh(t);
    double rest = t - share;
    if (t < 1.0) {
        double w = 0.0;
        for (int odd = 19; odd > 1; odd -= 2)
            w = t * t / (odd + w);
        rest = w * share;
    }
    return radius * radius * (share * share * t + rest);
}

static contact_point_values sphere_contact(double radius, double delta)
{
    enum { MAX_ROUNDS = 60 }; /* limit of Newton's steps from above */
    const double x = delta / radius;
    double t = sqrt(x) * sqrt(1.0 + x), share = 0.0, cosh_term = 0.0; /* not below the root */
    for (int i = 0; i < MAX_ROUNDS; i++) {
        share = tanh(t);
        cosh_term = 1.0 / (cosh(t) * cosh(t));
        const double next = t - (t * share - x) / (share + t * cosh_term);
        if (!(fabs(next - t) > DBL_EPSILON * t))
            break;
        t = next;
    }
    return (contact_point_values){sphere_force(radius, t), 2.0 * radius * share,
                                  2.0 * cosh_term / (share + t * cosh_term)};
}

static contact_point_values sharp_contact(const wt_tip *tip, double delta)
{
    unsigned sides = tip->shape == WT_TIP_CONE ? 0 : tip->sides;
    double c = 2.0 / (M_PI * tip_facet_factor(sides)) * tan(tip->half_angle);
    return (contact_point_values){c * delta * delta, 2.0 * c * delta, 2.0 * c};
}

/* G beyond the transition radius. */
static double faces_force(const wt_tip *tip, double mcot, double s)
{
    const double b = tip->transition_radius, h = hypot(1.0, s), hs = h + s, a = b * h;
    return 2.0 * (b * b / tip->radius * b * (2.0 * h + s) / (3.0 * hs * hs) +
                  0.5 * mcot * (a * a * atan(s) + b * (b * s)));
}

/* Solves for the depth beyond the switch. Otherwise rounding of the depth hides a root near the
 * switch:
 * delta - b^2/R = m cot(theta) b h atan(s) - b^2 s / (R (h + s)). */
static contact_point_values faces_contact(const wt_tip *tip, double delta)
{
    const double b = tip->transition_radius;
    const double cap = b * b / tip->radius, beyond = delta - cap;
    const double mcot = tip_facet_factor(tip->sides) / tan(tip->half_angle);
    /* h atan(s) >= pi s/2 - 1, so this start is an upper bound of the root. */
    double s = 2.0 / M_PI * (delta / (mcot * b) + 1.0);
    double h = 0.0, hs = 0.0, rise = 0.0;
    for (;;) {
        h = hypot(1.0, s);
        hs = h + s;
        rise = mcot * b * (1.0 + s * atan(s)) - cap / (hs * hs); /* h ddelta/ds */
        double excess = mcot * b * h * atan(s) - cap * s / hs - beyond;
        double next = fmax(s - excess * h / rise, 0.0);
        /* The iterates fall until rounding stops them at the root. */
        if (!(next < s))
            break;
        s = next;
    }
    /* At the switch the growth of the contact is 0/0; the limit for a smooth cap is used. */
    const double growth = rise > 0.0 ? b * s / rise : 0.5 * tip->radius / b;
    return (contact_point_values){faces_force(tip, mcot, s), 2.0 * b * h, 2.0 * growth};
}

contact_point_values contact_values(const wt_tip *tip, double delta)
{
    switch (tip->shape) {
    case WT_TIP_PARABOLOID:
        return paraboloid_contact(tip->radius, delta);
    case WT_TIP_CONE:
        return sharp_contact(tip, delta);
    case WT_TIP_SPHERE:
        return sphere_contact(tip->radius, delta);
    case WT_TIP_PUNCH:
        return (contact_point_values){2.0 * tip->radius * delta, 2.0 * tip->radius, 0.0};
    case WT_TIP_BLUNTED_PYRAMID:
        break;
    }
    if (tip->transition_radius == 0.0)
        return sharp_contact(tip, delta);
    if (delta < contact_switch_depth(tip))
        return paraboloid_contact(tip->radius, delta);
    return faces_contact(tip, delta);
}

double thin_sample_radius_ratio(const wt_tip *tip, double delta)
{
    return tip->sample_thickness.value > 0.0 && delta > 0.0
               ? 0.5 * contact_values(tip, delta).slope / tip->sample_thickness.value
               : 0.0;
}

void wt_contact_function(const wt_tip *tip, double delta, double *g, double *slope)
{
    contact_point_values v = {0.0, 0.0, 0.0};
    if (isnan(delta))
        v.g = v.slope = delta;
    else if (delta > 0.0)
        v = contact_values(tip, delta);
    if (tip->sample_thickness.value > 0.0 && delta > 0.0)
        v = thin_sample_values(tip, v);
    *g = v.g;
    *slope = v.slope;
}
