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
#include "layer/numerics/energy_density_kernel.h"
#include "core/base/shared_params.h"
#include "core/math/simd.h"
#include "friction/numerics/friction_kernel.h"

#include <math.h>
#include <stdlib.h>

/* Depths of the comparison of two sources, from 0.1 / q1 to the limit of double precision: exp(-2 q
 * z) underflows in products near q z = 710. */
enum { DEPTHS = 32 };
static const double last_depth = 710;

/* Number of cells towards q0, each a quarter of the previous one. They resolve the longest waves,
 * which dominate at the last depth. */
static const size_t min_level = 6;

/* Largest number of comparisons, each with one more halving of the subintervals. */
enum { MAX_HALVINGS = 4 };

/* Largest relative difference of w and of int w, for both profiles. */
static double compare_sources(const wt_energy_source *a, const wt_energy_source *b,
                              const wt_roughness *roughness)
{
    double worst = 0;
    const double from = 0.1 / roughness->q1;
    const double to = last_depth / roughness->q0;
    for (size_t i = 0; i <= DEPTHS; i++) {
        const double depth = i ? from * pow(to / from, (double)(i - 1) / (DEPTHS - 1)) : 0;
        double of_a[ENERGY_PROFILE_VALUES], of_b[ENERGY_PROFILE_VALUES];
        energy_log_profiles(a, depth, of_a);
        energy_log_profiles(b, depth, of_b);
        for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
            worst = fmax(worst, fabs(of_a[k] - of_b[k])); /* NaN if both have no power */
    }
    return worst;
}

wt_status wt_energy_source_from_friction(wt_friction_workspace *workspace, double pressure,
                                         double velocity, wt_energy_source *source, wt_error *err)
{
    if (workspace == NULL || source == NULL)
        return wt_fail(err, WT_E_ARG, "an energy source needs a friction workspace");
    wt_status status = friction_prepare(workspace, pressure, &velocity, 1, err);
    if (status != WT_OK)
        return status;
    friction_load at = friction_load_create(workspace, pressure, velocity);
    friction_scratch scratch;
    arena memory = {0};
    wt_energy_source pair[2] = {{0}, {0}};
    friction_scratch_init(&scratch, workspace, 0, &memory);
    status = friction_solve_heat(workspace, &scratch, &at, err);
    const subinterval_plan *plan =
        status == WT_OK ? friction_plan(workspace, &scratch, &at, NULL, 0) : NULL;
    size_t now = 0;
    double error = (double)INFINITY;
    for (size_t k = 0; status == WT_OK && k < MAX_HALVINGS && error > workspace->options.tolerance;
         k++) {
        now = 1 - now;
        node_contributions record = {0};
        friction_pass pass;
        const friction_effort effort = {
            .level = min_level, .halves = k, .accurate_everywhere = true};
        friction_evaluate(workspace, &scratch, plan, effort, at, false, &record, &pass);
        wt_energy_source *s = &pair[now];
        wt_energy_source_clear(s);
        *s = (wt_energy_source){.profile = WT_PROFILE_PERSSON,
                                .n = record.n,
                                .wavenumber = record.q,
                                .power = record.mu};
        for (size_t i = 0; i < s->n; i++)
            s->power[i] *= pressure * at.speed;
        if (k > 0)
            error = compare_sources(s, &pair[1 - now], workspace->roughness) +
                    pass.hysteresis_error / (pass.hysteresis > 0 ? pass.hysteresis : 1);
        s->numerical_error = error + friction_relative_error(workspace, &pass, at).hysteresis;
    }
    if (status == WT_OK)
        status = energy_check(&pair[now], err);
    if (status == WT_OK) {
        *source = pair[now];
        pair[now] = (wt_energy_source){0};
    }
    wt_energy_source_clear(&pair[0]);
    wt_energy_source_clear(&pair[1]);
    workspace->scratch[0].nodes += scratch.nodes;
    arena_free(&memory);
    return status;
}

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

bool energy_wavenumber_range(const wt_energy_source *source, double *q_min, double *q_max)
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

/* True if the density falls with depth. The incompressible density of one wavenumber has its
 * extrema at q z = 1 and 1 - r. They coincide for m = 1, and only then does the density fall
 * monotonically. */
bool energy_is_monotonic(const wt_energy_source *source)
{
    return source->profile == WT_PROFILE_PERSSON || source->local_friction == 1;
}

/* Polynomials of the density and its derivatives in x, with s = 1 - r: g = q exp(-2 x) P(x), g' =
 * q^2 exp(-2 x) D(x), g'' = q^3 exp(-2 x) B(x). A quadratic c[0] + c[1] t + c[2] t^2 in the
 * distance t from x. */
typedef struct quadratic {
    double c[3];
} quadratic;

WIDE_INLINE quadratic density_polynomial(double s, double x)
{
    return (quadratic){
        {2 * ((2 - s) * x * x + s * (1 - x) * (1 - x)), 4 * ((2 - s) * x - s * (1 - x)), 4}};
}

WIDE_INLINE quadratic slope_polynomial(double s, double x)
{
    return (quadratic){{-8 * (x - 1) * (x - s), -8 * (2 * x - 1 - s), -8}};
}

WIDE_INLINE quadratic curvature_polynomial(double s, double x)
{
    return (quadratic){
        {8 * (2 * x * x - 2 * (2 + s) * x + 1 + 3 * s), 8 * (4 * x - 2 * (2 + s)), 16}};
}

/* Wavenumbers of a source at a depth; a batch fits into the first-level cache. */
enum { BATCH = 64 };
typedef struct batch {
    size_t n;
    const double *q;
    double r, depth, length;
    double power[BATCH];       /* power that remains at the depth, over exp(-2 q_min depth) */
    double decay_expm1[BATCH]; /* exp(-2 q length) - 1 */
} batch;

/* Fills a batch, beginning with a wavenumber. */
WIDE_REGISTERS
static void batch_fill(const wt_energy_source *source, size_t from, double q_min, batch *b)
{
    double x[BATCH];
    b->n = source->n - from < BATCH ? source->n - from : BATCH;
    b->q = source->wavenumber + from;
    for (size_t i = 0; i < b->n; i++) /* wavenumbers without power may be below q_min */
        x[i] = b->q[i] > q_min ? -2 * (b->q[i] - q_min) * b->depth : 0;
    vector_exp(x, b->n, b->power);
    for (size_t i = 0; i < b->n; i++) {
        b->power[i] *= source->power[from + i];
        x[i] = -2 * b->q[i] * b->length;
    }
    if (b->length > 0)
        vector_expm1(x, b->n, b->decay_expm1);
}

/* Evaluates a function of depth z for each wavenumber, for the power exp(2 q z). */
typedef void shape_fn(const wt_energy_source *source, const batch *b, double *value);

/* g(z; q) exp(2 q z) */
static void energy_shape(const wt_energy_source *source, const batch *b, double *value)
{
    const bool plain = source->profile == WT_PROFILE_PERSSON;
    for (size_t i = 0; i < b->n; i++)
        value[i] = b->q[i] * (plain ? 2 : density_polynomial(1 - b->r, b->q[i] * b->depth).c[0]);
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

WIDE_INLINE double smaller_value(double a, double b)
{
    return a < b ? a : b;
}

/* Largest |exp(-2 t) (c[0] + c[1] t + c[2] t^2)| for 0 <= t <= width. */
WIDE_INLINE double polynomial_bound(quadratic of, double width)
{
    static const double inverse_square = 0.13533528323661269; /* exp(-2) */
    return fabs(of.c[0]) + fabs(of.c[1]) * smaller_value(width, 0.5 / M_E) +
           fabs(of.c[2]) * smaller_value(width * width, inverse_square);
}

/* Length below which the closed form cancels. The series in y = -2 l has the terms l^(k+1) y^j /
 * (j! (k+1+j)); the first neglected one, j = 7, is below 1e-16. */
static const double short_length = 0.01;
/* Largest length. exp(-800) is 0 at its end, and its square must not overflow. */
static const double longest_length = 400;

/* int_0^l t^k exp(-2 t) dt; the second argument is exp(-2 l) - 1. */
WIDE_INLINE quadratic moments(double l, double decay_expm1)
{
    const double y = -2 * l, limited_length = smaller_value(l, longest_length),
                 left = 1 + decay_expm1;
    const double first =
        l *
        (1 + y * (1 / 2.0 +
                  y * (1 / 6.0 + y * (1 / 24.0 + y * (1 / 120.0 + y * (1 / 720.0 + y / 5040.0))))));
    const double second =
        l * l *
        (1 / 2.0 +
         y * (1 / 3.0 +
              y * (1 / 8.0 + y * (1 / 30.0 + y * (1 / 144.0 + y * (1 / 840.0 + y / 5760.0))))));
    const double third =
        l * l * l *
        (1 / 3.0 +
         y * (1 / 4.0 +
              y * (1 / 10.0 + y * (1 / 36.0 + y * (1 / 168.0 + y * (1 / 960.0 + y / 6480.0))))));
    const double j0 = -0.5 * decay_expm1;
    const double j1 = 0.5 * (j0 - limited_length * left);
    const double j2 = j1 - 0.5 * limited_length * limited_length * left;
    return (quadratic){{l < short_length ? first : j0, l < short_length ? second : j1,
                        l < short_length ? third : j2}};
}

WIDE_INLINE double integrate_polynomial(quadratic of, quadratic moment)
{
    return of.c[0] * moment.c[0] + of.c[1] * moment.c[1] + of.c[2] * moment.c[2];
}

/* exp(2 q z) int_z^(z+length) g */
WIDE_REGISTERS
static void integral_shape(const wt_energy_source *source, const batch *b, double *value)
{
    const bool plain = source->profile == WT_PROFILE_PERSSON;
    const double s = 1 - b->r, depth = b->depth, length = b->length;
    for (size_t i = 0; plain && i < b->n; i++)
        value[i] = -b->decay_expm1[i];
    for (size_t i = 0; !plain && i < b->n; i++) {
        const double q = b->q[i];
        const double gain = integrate_polynomial(density_polynomial(s, q * depth),
                                                 moments(q * length, b->decay_expm1[i]));
        value[i] = gain > 0 ? gain : 0;
    }
}

/* Sum over the wavenumbers, divided by exp(-2 q_min depth). */
static double scaled_sum(const wt_energy_source *source, shape_fn *of, double depth, double length,
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

void energy_surface_terms(const wt_energy_source *source, double length, double *power)
{
    batch b = {.length = length};
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, 0, &b);
        (length > 0 ? integral_shape : energy_shape)(source, &b, power + from);
        for (size_t i = 0; i < b.n; i++)
            power[from + i] *= b.power[i];
    }
}

/* Below this sum the powers are scaled by the slowest decay. It is far above 1e-308, where doubles
 * lose digits. */
static const double min_sum = 1e-200;

static double log_sum(const wt_energy_source *source, shape_fn *of, double depth, double length)
{
    double q_min, q_max;
    const double sum = scaled_sum(source, of, depth, length, 0);
    if (sum > min_sum || !energy_wavenumber_range(source, &q_min, &q_max))
        return log(sum);
    return log(scaled_sum(source, of, depth, length, q_min)) - 2 * q_min * depth;
}

/* Sum of the values with power; values without power may be arbitrary. */
WIDE_REGISTERS
static double sum_with_power(const double *value, const double *power, size_t n)
{
    double sum[WIDE] = {0};
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE)
        for (size_t k = 0; k < WIDE; k++)
            sum[k] += power[i + k] > 0 ? value[i + k] : 0;
    for (; i < n; i++)
        sum[0] += power[i] > 0 ? value[i] : 0;
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Tail and density of both profiles for a batch. */
WIDE_REGISTERS
static void profile_terms(const batch *b, double value[ENERGY_PROFILE_VALUES][BATCH])
{
    const double r = b->r, depth = b->depth;
    for (size_t i = 0; i < b->n; i++) {
        const double q = b->q[i], power = b->power[i], x = q * depth;
        value[0][i] = power;
        value[1][i] = power * q * 2;
        value[2][i] = power * (1 + 2 * x * (x + r));
        value[3][i] = power * q * density_polynomial(1 - r, x).c[0];
    }
}

static void profile_sums(const wt_energy_source *source, double depth, double q_min,
                         double sum[ENERGY_PROFILE_VALUES])
{
    double value[ENERGY_PROFILE_VALUES][BATCH];
    batch b = {.r = asymmetry(source->local_friction), .depth = depth};
    for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
        sum[k] = 0;
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, q_min, &b);
        profile_terms(&b, value);
        for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
            sum[k] += sum_with_power(value[k], b.power, b.n);
    }
}

void energy_log_profiles(const wt_energy_source *source, double depth,
                         double logarithm[ENERGY_PROFILE_VALUES])
{
    double sum[ENERGY_PROFILE_VALUES], scaled[ENERGY_PROFILE_VALUES], q_min, q_max;
    bool small = false;
    profile_sums(source, depth, 0, sum);
    for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
        small = small || !(sum[k] > min_sum);
    small = small && energy_wavenumber_range(source, &q_min, &q_max);
    if (small)
        profile_sums(source, depth, q_min, scaled);
    for (size_t k = 0; k < ENERGY_PROFILE_VALUES; k++)
        logarithm[k] =
            small && !(sum[k] > min_sum) ? log(scaled[k]) - 2 * q_min * depth : log(sum[k]);
}

double energy_monotonic_depth(const wt_energy_source *source)
{
    double q_min, q_max;
    const double last = fmax(1, 1 - asymmetry(source->local_friction));
    return !energy_is_monotonic(source) && energy_wavenumber_range(source, &q_min, &q_max)
               ? last / q_min
               : 0;
}

/* Contributions of the wavenumbers of a batch to an expansion of the incompressible profile. */
typedef struct expansion_terms {
    double value[BATCH], slope[BATCH], curvature[BATCH];
} expansion_terms;

/* Contributions to the density. */
WIDE_REGISTERS
static void density_terms(const batch *b, double reach, expansion_terms *t)
{
    const double s = 1 - b->r, depth = b->depth;
    for (size_t i = 0; i < b->n; i++) {
        const double q = b->q[i], power = q * b->power[i], x = q * depth;
        t->value[i] = power * density_polynomial(s, x).c[0];
        t->slope[i] = power * q * slope_polynomial(s, x).c[0];
        t->curvature[i] = power * q * q * polynomial_bound(curvature_polynomial(s, x), q * reach);
    }
}

/* Contributions to the integral of the density over a length. */
WIDE_REGISTERS
static void integral_terms(const batch *b, double reach, expansion_terms *t)
{
    const double s = 1 - b->r, depth = b->depth, length = b->length;
    for (size_t i = 0; i < b->n; i++) {
        const double q = b->q[i], power = b->power[i], x = q * depth, width = q * reach;
        const double l = q * length, decay_expm1 = b->decay_expm1[i],
                     limited_length = smaller_value(l, longest_length);
        const quadratic over = moments(l, decay_expm1);
        const double gain = integrate_polynomial(density_polynomial(s, x), over);
        const double apart =
            polynomial_bound(slope_polynomial(s, x), width) +
            (1 + decay_expm1) * polynomial_bound(slope_polynomial(s, x + limited_length), width);
        const double along = l * polynomial_bound(curvature_polynomial(s, x), width + l);
        t->value[i] = power * (gain > 0 ? gain : 0);
        t->slope[i] = power * q * integrate_polynomial(slope_polynomial(s, x), over);
        t->curvature[i] = power * q * q * smaller_value(apart, along);
    }
}

energy_expansion energy_expand(const wt_energy_source *source, double q_min, double depth,
                               double length, double reach)
{
    batch b = {.r = asymmetry(source->local_friction), .depth = depth, .length = length};
    expansion_terms t;
    energy_expansion sum = {.log_scale = -2 * q_min * depth};
    for (size_t from = 0; from < source->n; from += BATCH) {
        batch_fill(source, from, q_min, &b);
        if (length > 0)
            integral_terms(&b, reach, &t);
        else
            density_terms(&b, reach, &t);
        sum.value += sum_with_power(t.value, b.power, b.n);
        sum.slope += sum_with_power(t.slope, b.power, b.n);
        sum.curvature += sum_with_power(t.curvature, b.power, b.n);
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

double energy_log_integral(const wt_energy_source *source, double depth, double length)
{
    return length > 0 ? log_sum(source, integral_shape, depth, length) : -(double)INFINITY;
}

double wt_energy_density(const wt_energy_source *source, double depth)
{
    return depth >= 0 ? exp(energy_log_density(source, depth)) : 0;
}

double wt_energy_tail(const wt_energy_source *source, double depth)
{
    return exp(energy_log_tail(source, fmax(depth, 0)));
}
