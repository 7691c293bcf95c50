/* Energy density with depth: w(z) = sum_i power_i g(z; q_i), and its integrals.
 *
 * `persson`: g = 2 q exp(-2 q z), the profile of the flash-temperature heat source of Persson,
 * J. Phys.: Condens. Matter 18 (2006) 7789. `incompressible`: with x = q z and local friction m,
 *   g = 4 q exp(-2 x) [x^2 + m^2 (1 - x)^2] / (1 + m^2)
 * and its tail exp(-2 x) [1 + 2 x^2 + 2 x r], r = (1 - m^2) / (1 + m^2): the square of the Mohr
 * radius in a half-space of Poisson ratio 1/2 under a cosine of pressure and shear.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/energy.h"
#include "kernel/params.h"

#include <math.h>
#include <stdlib.h>

void wt_energy_source_clear(wt_energy_source *source)
{
    if (source == NULL)
        return;
    free(source->wavenumber);
    free(source->power);
    *source = (wt_energy_source){0};
}

wt_status energy_check(const wt_energy_source *source, wt_error *err)
{
    if (source == NULL || source->n == 0 || source->wavenumber == NULL || source->power == NULL)
        return wt_fail(err, WT_E_ARG, "a layer needs an energy source with at least one term");
    double sum = 0;
    for (size_t i = 0; i < source->n; i++) {
        const double q = source->wavenumber[i];
        const double power = source->power[i];
        wt_status status = WT_OK;
        if (!(q > 0) || !isfinite(q))
            status = range_error("wavenumber of an energy source", q, "finite and > 0 rad/m", err);
        else if (!(power >= 0) || !isfinite(power))
            status = range_error("power of an energy source", power, "finite and >= 0 W/m^2", err);
        if (status != WT_OK) {
            wt_error_place(err, "term %zu of %zu", i + 1, source->n);
            return status;
        }
        sum += power;
    }
    if (!isfinite(sum))
        return range_error("total power of an energy source", sum, "finite, in W/m^2", err);
    if (!(source->numerical_error >= 0) || !isfinite(source->numerical_error))
        return range_error("numerical_error of an energy source", source->numerical_error,
                           "finite and >= 0", err);
    static const wt_param local_friction = ENERGY_LOCAL_FRICTION(wt_energy_source);
    return param_check_number(&local_friction, source->local_friction, err);
}

bool energy_range(const wt_energy_source *source, double *q_min, double *q_max)
{
    *q_min = (double)INFINITY;
    *q_max = 0;
    for (size_t i = 0; i < source->n; i++)
        if (source->power[i] > 0) {
            *q_min = fmin(*q_min, source->wavenumber[i]);
            *q_max = fmax(*q_max, source->wavenumber[i]);
        }
    return *q_max > 0;
}

/* r = (1 - m^2) / (1 + m^2), for any m. */
static double asymmetry(double m)
{
    return m > 1 ? -(1 - 1 / (m * m)) / (1 + 1 / (m * m)) : (1 - m * m) / (1 + m * m);
}

/* The incompressible density of one wavenumber has its extrema at q z = 1 and 1 - r; they fall
 * together for m = 1, and only then does it fall all the way. */
bool energy_falls(const wt_energy_source *source)
{
    return source->profile == WT_PROFILE_PERSSON || source->local_friction == 1;
}

/* The density over q exp(-2 x) and its derivatives, quadratics in x: g = q exp(-2 x) P(x), g' = q^2
 * exp(-2 x) D(x), g'' = q^3 exp(-2 x) B(x), with s = 1 - r. */
static double density_bracket(double s, double x)
{
    return 2 * ((2 - s) * x * x + s * (1 - x) * (1 - x));
}

static double slope_bracket(double s, double x)
{
    return -8 * (x - 1) * (x - s);
}

/* exp(2 q z) times what one wavenumber gives at a depth. */
typedef double shape_fn(const wt_energy_source *source, double r, double q, double depth,
                        double length);

/* g(z; q) exp(2 q z) */
static double shape(const wt_energy_source *source, double r, double q, double depth, double length)
{
    (void)length;
    if (source->profile == WT_PROFILE_PERSSON)
        return 2 * q;
    return q * density_bracket(1 - r, q * depth);
}

/* exp(2 q z) int_z^inf g */
static double tail_shape(const wt_energy_source *source, double r, double q, double depth,
                         double length)
{
    (void)length;
    if (source->profile == WT_PROFILE_PERSSON)
        return 1;
    const double x = q * depth;
    return 1 + 2 * x * (x + r);
}

/* Largest |exp(-2 t) (a + b t + c t^2)| for 0 <= t <= width. */
static double largest(double a, double b, double c, double width)
{
    return fabs(a) + fabs(b) * fmin(width, 0.5 / M_E) + fabs(c) * fmin(width * width, exp(-2));
}

/* exp(2 x) times the largest |g'| / q^2 and |g''| / q^3 from x to x + width. */
static double largest_slope(double s, double x, double width)
{
    return largest(slope_bracket(s, x), -8 * (2 * x - 1 - s), -8, width);
}

static double largest_bend(double s, double x, double width)
{
    return largest(8 * (2 * x * x - 2 * (2 + s) * x + 1 + 3 * s), 8 * (4 * x - 2 * (2 + s)), 16,
                   width);
}

/* A way so short that its ends cancel is integrated by Gauss-Legendre, exact to 1e-16 there. */
static const double short_way = 0.01;

static double short_integral(double (*bracket)(double s, double x), double s, double x, double l)
{
    static const double node = 0.7745966692414834;
    const double first = 0.5 * l * (1 - node), last = 0.5 * l * (1 + node);
    return l *
           (5 * bracket(s, x + first) * exp(-2 * first) + 8 * bracket(s, x + 0.5 * l) * exp(-l) +
            5 * bracket(s, x + last) * exp(-2 * last)) /
           18;
}

/* exp(2 q z) int_z^(z+length) g */
static double gain_shape(const wt_energy_source *source, double r, double q, double depth,
                         double length)
{
    const double l = q * length;
    const double gone = -expm1(-2 * l);
    if (source->profile == WT_PROFILE_PERSSON)
        return gone;
    const double x = q * depth;
    if (l < short_way)
        return short_integral(density_bracket, 1 - r, x, l);
    const double here = 1 + 2 * x * (x + r);
    const double grown =
        2 * l * (2 * x + l + r); /* the bracket of the tail at x + l, less `here` */
    return l < 300 ? fmax(0, gone * here - (1 - gone) * grown) : here;
}

static double log_sum(const wt_energy_source *source, shape_fn *of, double depth, double length)
{
    double q_min, q_max;
    if (!energy_range(source, &q_min, &q_max))
        return -(double)INFINITY;
    const double r = asymmetry(source->local_friction);
    double sum = 0;
    for (size_t i = 0; i < source->n; i++) {
        const double q = source->wavenumber[i];
        if (source->power[i] > 0)
            sum +=
                source->power[i] * of(source, r, q, depth, length) * exp(-2 * (q - q_min) * depth);
    }
    return log(sum) - 2 * q_min * depth;
}

double energy_falling(const wt_energy_source *source)
{
    double q_min, q_max;
    const double last = fmax(1, 1 - asymmetry(source->local_friction));
    return !energy_falls(source) && energy_range(source, &q_min, &q_max) ? last / q_min : 0;
}

/* One wavenumber of the incompressible profile. */
static void course_add(energy_course *sum, double power, double s, double q, double depth,
                       double length, double reach)
{
    const double x = q * depth, width = q * reach, l = q * length;
    if (l == 0) {
        sum->value += power * q * density_bracket(s, x);
        sum->slope += power * q * q * slope_bracket(s, x);
        sum->curvature += power * q * q * q * largest_bend(s, x, width);
        return;
    }
    const double left = exp(-2 * l);
    const double apart =
        largest_slope(s, x, width) + (left > 0 ? left * largest_slope(s, x + l, width) : 0);
    const double slope =
        l < short_way ? short_integral(slope_bracket, s, x, l)
                      : (left > 0 ? left * density_bracket(s, x + l) : 0) - density_bracket(s, x);
    sum->slope += power * q * slope;
    sum->curvature += power * q * q * fmin(apart, l * largest_bend(s, x, width + l));
}

energy_course energy_course_at(const wt_energy_source *source, double depth, double length,
                               double reach)
{
    double q_min = 0, q_max;
    (void)energy_range(source, &q_min, &q_max);
    const double r = asymmetry(source->local_friction);
    energy_course sum = {.log_scale = -2 * q_min * depth};
    for (size_t i = 0; i < source->n; i++) {
        const double q = source->wavenumber[i];
        const double power = source->power[i] * exp(-2 * (q - q_min) * depth);
        if (!(power > 0))
            continue;
        course_add(&sum, power, 1 - r, q, depth, length, reach);
        if (length > 0)
            sum.value += power * gain_shape(source, r, q, depth, length);
    }
    return sum;
}

double energy_log_density(const wt_energy_source *source, double depth)
{
    return log_sum(source, shape, depth, 0);
}

double energy_log_tail(const wt_energy_source *source, double depth)
{
    return log_sum(source, tail_shape, depth, 0);
}

double energy_log_gain(const wt_energy_source *source, double depth, double length)
{
    return length > 0 ? log_sum(source, gain_shape, depth, length) : -(double)INFINITY;
}

double wt_energy_density(const wt_energy_source *source, double depth)
{
    return depth >= 0 ? exp(energy_log_density(source, depth)) : 0;
}

double wt_energy_tail(const wt_energy_source *source, double depth)
{
    return exp(energy_log_tail(source, fmax(depth, 0)));
}
