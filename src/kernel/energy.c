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

#include "base/exponential.h"

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
    for (size_t i = 0; i < source->n; i++) {
        const double q = source->wavenumber[i];
        if (!(source->power[i] > 0))
            continue;
        *q_min = q < *q_min ? q : *q_min;
        *q_max = q > *q_max ? q : *q_max;
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

/* Some wavenumbers of a source at a depth, as many as the first cache holds. */
enum { BATCH = 64 };
typedef struct batch {
    size_t n;
    const double *q;
    double r, depth, length;
    double power[BATCH]; /* as it is left at the depth, over exp(-2 q_min depth) */
    double gone[BATCH];  /* exp(-2 q length) - 1 */
} batch;

/* Begins at a wavenumber. */
static void batch_fill(const wt_energy_source *source, size_t from, double q_min, batch *b)
{
    double x[BATCH];
    b->n = source->n - from < BATCH ? source->n - from : BATCH;
    b->q = source->wavenumber + from;
    for (size_t i = 0; i < b->n; i++) /* without power it may be below q_min */
        x[i] = b->q[i] > q_min ? -2 * (b->q[i] - q_min) * b->depth : 0;
    exponential(x, b->n, b->power);
    for (size_t i = 0; i < b->n; i++) {
        b->power[i] *= source->power[from + i];
        x[i] = -2 * b->q[i] * b->length;
    }
    if (b->length > 0)
        exponential_less_one(x, b->n, b->gone);
}

/* What wavenumbers of power exp(2 q z) give at a depth z. */
typedef void shape_fn(const wt_energy_source *source, const batch *b, double *value);

/* g(z; q) exp(2 q z) */
static void energy_shape(const wt_energy_source *source, const batch *b, double *value)
{
    const bool plain = source->profile == WT_PROFILE_PERSSON;
    for (size_t i = 0; i < b->n; i++)
        value[i] = b->q[i] * (plain ? 2 : density_bracket(1 - b->r, b->q[i] * b->depth));
}

/* exp(2 q z) int_z^inf g */
static void tail_shape(const wt_energy_source *source, const batch *b, double *value)
{
    const bool plain = source->profile == WT_PROFILE_PERSSON;
    for (size_t i = 0; i < b->n; i++) {
        const double x = b->q[i] * b->depth;
        value[i] = plain ? 1 : 1 + 2 * x * (x + b->r);
    }
}

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

/* Largest |exp(-2 t) (a + b t + c t^2)| for 0 <= t <= width. */
static double largest_remainder(double a, double b, double c, double width)
{
    static const double inverse_square = 0.13533528323661269; /* exp(-2) */
    return fabs(a) + fabs(b) * lesser(width, 0.5 / M_E) +
           fabs(c) * lesser(width * width, inverse_square);
}

/* exp(2 x) times the largest |g'| / q^2 and |g''| / q^3 from x to x + width. */
static double largest_slope(double s, double x, double width)
{
    return largest_remainder(slope_bracket(s, x), -8 * (2 * x - 1 - s), -8, width);
}

static double largest_bend(double s, double x, double width)
{
    return largest_remainder(8 * (2 * x * x - 2 * (2 + s) * x + 1 + 3 * s),
                             8 * (4 * x - 2 * (2 + s)), 16, width);
}

/* A way so short that its ends cancel is integrated by Gauss-Legendre, exact to 1e-16 there. */
static const double short_way = 0.01;

static double short_integral(double (*bracket)(double s, double x), double s, double x, double l)
{
    static const double node = 0.7745966692414834; /* sqrt(3/5) */
    const double first = 0.5 * l * (1 - node), last = 0.5 * l * (1 + node);
    return l *
           (5 * bracket(s, x + first) * exp(-2 * first) + 8 * bracket(s, x + 0.5 * l) * exp(-l) +
            5 * bracket(s, x + last) * exp(-2 * last)) /
           18;
}

/* exp(2 q z) int_z^(z+length) g */
static void gain_shape(const wt_energy_source *source, const batch *b, double *value)
{
    const bool plain = source->profile == WT_PROFILE_PERSSON;
    const double r = b->r;
    for (size_t i = 0; i < b->n; i++) {
        const double x = b->q[i] * b->depth, l = b->q[i] * b->length;
        const double here = 1 + 2 * x * (x + r), left = 1 + b->gone[i];
        /* the bracket of the tail at x + l, less `here` */
        const double grown = 2 * l * (2 * x + l + r);
        const double gain = -b->gone[i] * here - (left > 0 ? left * grown : 0);
        value[i] = plain ? -b->gone[i] : gain > 0 ? gain : 0;
    }
    for (size_t i = 0; !plain && i < b->n; i++)
        if (b->q[i] * b->length < short_way)
            value[i] =
                short_integral(density_bracket, 1 - r, b->q[i] * b->depth, b->q[i] * b->length);
}

/* Over exp(-2 q_min depth). */
static double sum_of(const wt_energy_source *source, shape_fn *of, double depth, double length,
                     double q_min)
{
    double sum = 0, value[BATCH];
    batch b = {.r = asymmetry(source->local_friction), .depth = depth, .length = length};
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, q_min, &b);
        of(source, &b, value);
        for (size_t i = 0; i < b.n; i++)
            sum += b.power[i] * value[i];
    }
    return sum;
}

/* Below it the powers are taken relative to the last that is left: far above where a double loses
 * digits, 1e-308. */
static const double least_sum = 1e-200;

static double log_sum(const wt_energy_source *source, shape_fn *of, double depth, double length)
{
    double q_min, q_max;
    const double sum = sum_of(source, of, depth, length, 0);
    if (sum > least_sum || !energy_range(source, &q_min, &q_max))
        return log(sum);
    return log(sum_of(source, of, depth, length, q_min)) - 2 * q_min * depth;
}

static void sums_of_both(const wt_energy_source *source, double depth, double q_min,
                         double sum[ENERGY_BOTH])
{
    static shape_fn *const of[] = {tail_shape, energy_shape};
    wt_energy_source as[2] = {*source, *source};
    double value[BATCH];
    batch b = {.r = asymmetry(source->local_friction), .depth = depth};
    as[0].profile = WT_PROFILE_PERSSON;
    as[1].profile = WT_PROFILE_INCOMPRESSIBLE;
    for (size_t k = 0; k < ENERGY_BOTH; k++)
        sum[k] = 0;
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, q_min, &b);
        for (size_t k = 0; k < ENERGY_BOTH; k++) {
            of[k % 2](&as[k / 2], &b, value);
            for (size_t i = 0; i < b.n; i++)
                sum[k] += b.power[i] * value[i];
        }
    }
}

void energy_log_both(const wt_energy_source *source, double depth, double logarithm[ENERGY_BOTH])
{
    double sum[ENERGY_BOTH], scaled[ENERGY_BOTH], q_min, q_max;
    bool small = false;
    sums_of_both(source, depth, 0, sum);
    for (size_t k = 0; k < ENERGY_BOTH; k++)
        small = small || !(sum[k] > least_sum);
    small = small && energy_range(source, &q_min, &q_max);
    if (small)
        sums_of_both(source, depth, q_min, scaled);
    for (size_t k = 0; k < ENERGY_BOTH; k++)
        logarithm[k] =
            small && !(sum[k] > least_sum) ? log(scaled[k]) - 2 * q_min * depth : log(sum[k]);
}

double energy_falling(const wt_energy_source *source)
{
    double q_min, q_max;
    const double last = fmax(1, 1 - asymmetry(source->local_friction));
    return !energy_falls(source) && energy_range(source, &q_min, &q_max) ? last / q_min : 0;
}

/* One wavenumber of the incompressible profile; left: exp(-2 q length). */
static void course_add(energy_course *sum, const batch *b, size_t i, double left, double reach)
{
    const double power = b->power[i], q = b->q[i], s = 1 - b->r;
    const double x = q * b->depth, width = q * reach, l = q * b->length;
    if (l == 0) {
        sum->value += power * q * density_bracket(s, x);
        sum->slope += power * q * q * slope_bracket(s, x);
        sum->curvature += power * q * q * q * largest_bend(s, x, width);
        return;
    }
    const double apart =
        largest_slope(s, x, width) + (left > 0 ? left * largest_slope(s, x + l, width) : 0);
    const double slope =
        l < short_way ? short_integral(slope_bracket, s, x, l)
                      : (left > 0 ? left * density_bracket(s, x + l) : 0) - density_bracket(s, x);
    sum->slope += power * q * slope;
    sum->curvature += power * q * q * lesser(apart, l * largest_bend(s, x, width + l));
}

energy_course energy_course_at(const wt_energy_source *source, double depth, double length,
                               double reach)
{
    double q_min = 0, q_max, value[BATCH], x[BATCH], left[BATCH];
    (void)energy_range(source, &q_min, &q_max);
    batch b = {.r = asymmetry(source->local_friction), .depth = depth, .length = length};
    energy_course sum = {.log_scale = -2 * q_min * depth};
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, q_min, &b);
        if (length > 0)
            gain_shape(source, &b, value);
        for (size_t i = 0; i < b.n; i++)
            x[i] = -2 * b.q[i] * length;
        exponential(x, b.n, left);
        for (size_t i = 0; i < b.n; i++) {
            if (!(b.power[i] > 0))
                continue;
            course_add(&sum, &b, i, left[i], reach);
            sum.value += length > 0 ? b.power[i] * value[i] : 0;
        }
    }
    return sum;
}

double energy_log_density(const wt_energy_source *source, double depth)
{
    return log_sum(source, energy_shape, depth, 0);
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
