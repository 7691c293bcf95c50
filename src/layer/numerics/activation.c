/* Activated closure: Omega = P A exp(-max(0, eps - V_a e) / kB T) in contact, in addition to A
 * exp(-eps / kB T) everywhere. The latter is subtracted, so that the remainder has a finite
 * integral to any depth.
 *
 * The integral is stored on subintervals of depth over which two Gauss-Legendre rules agree, from
 * the surface to where Omega is linear in e; below, it is the integral of e.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/activation.h"
#include "core/math/gauss_legendre.h"

#include "core/base/quantity.h"
#include "core/math/root.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Numbers of nodes of the two rules, whose difference is the error of the lower one. */
enum { LOW_NODES = 12, HIGH_NODES = 16 };
/* Tolerance of the difference of the two rules; larger subintervals are halved down to the second
 * share of their depth. Omega has a kink where the barrier vanishes, which a subinterval that short
 * may contain. */
static const double subinterval_goal = 1e-13;
static const double min_relative_length = 1e-14;
/* Value of ln(V_a e / kB T) below which expm1(x) equals x in double precision. */
static const double log_linear = -37;
/* Above this x, exp(-x) is negligible against 1. */
static const double large_exponent = 40;
/* Upper limit of the number of subintervals: a profile needs some hundred, and fifty at each kink.
 */
enum { MAX_SUBINTERVALS = 20000 };

struct activation {
    wt_energy_source dwell;    /* source whose density is e */
    double log_rate;           /* ln(P Omega_inf) */
    double barrier;            /* eps / kB T */
    double log_volume;         /* ln(V_a / kB T) */
    double barrier_free_depth; /* depth above which the barrier is 0, if e falls */
    const gauss_rule *low, *high;
    size_t n, room;   /* number of subintervals, and capacity */
    double *edge;     /* [n + 1] */
    double *log_part; /* [n] ln of the integral over a subinterval */
    double *log_tail; /* [n + 1] ln of the integral below an edge */
};

/* ---- without load ---------------------------------------------------------------------------- */

static double attempt_rate(wt_attempt_frequency attempt, double temperature)
{
    return BOLTZMANN * temperature / (attempt == WT_ATTEMPT_H ? PLANCK : REDUCED_PLANCK);
}

double wt_activation_unloaded_rate(const wt_activation *parameters)
{
    const wt_activation *p = parameters;
    return p->temperature > 0 ? attempt_rate(p->attempt, p->temperature) *
                                    exp(-p->barrier / (BOLTZMANN * p->temperature))
                              : (double)NAN;
}

double wt_activation_min_barrier(double temperature, wt_attempt_frequency attempt, double rate)
{
    return BOLTZMANN * temperature * log(attempt_rate(attempt, temperature) / rate);
}

/* Condition T ln(A(T) / rate) = eps / kB. The left side rises for A > rate. */
typedef struct shelf_condition {
    double barrier, rate;
    wt_attempt_frequency attempt;
} shelf_condition;

static double shelf_excess(double temperature, void *user)
{
    const shelf_condition *s = user;
    return wt_activation_min_barrier(temperature, s->attempt, s->rate) / s->barrier - 1;
}

double wt_activation_max_temperature(double barrier, wt_attempt_frequency attempt, double rate)
{
    shelf_condition s = {barrier, rate, attempt};
    double low = rate / attempt_rate(attempt, 1), high = fmax(1, 2 * low), found = (double)NAN;
    if (!(barrier > 0) || !(rate > 0))
        return found;
    while (isfinite(high) && shelf_excess(high, &s) < 0)
        high *= 2;
    return root_find(shelf_excess, &s, low, high, 0, &found, NULL) == WT_OK ? found : (double)NAN;
}

/* ---- the rate -------------------------------------------------------------------------------- */

/* ln(V_a e / kB T) */
static double log_reduced_energy(const activation *a, double depth)
{
    return a->log_volume + energy_log_density(&a->dwell, depth);
}

/* ln(exp(x) - 1) as a function of ln x; x is limited to the barrier. */
static double log_expm1(const activation *a, double log_x)
{
    if (log_x < log_linear)
        return log_x;
    const double x = fmin(exp(fmin(log_x, log(a->barrier))), a->barrier);
    return x > large_exponent ? x : log(expm1(x));
}

double activation_log_density(const activation *a, double depth)
{
    return a->log_rate + log_expm1(a, log_reduced_energy(a, depth));
}

/* ln of the integral between two depths, by one rule. */
static double log_interval_integral(const activation *a, const gauss_rule *rule, double low,
                                    double high)
{
    double value[HIGH_NODES], most = -HUGE_VAL, sum = 0;
    const double half = 0.5 * (high - low);
    for (size_t i = 0; i < rule->n; i++) {
        value[i] = activation_log_density(a, low + half * (1 + rule->node[i]));
        most = fmax(most, value[i]);
    }
    for (size_t i = 0; i < rule->n; i++)
        sum += rule->weight[i] * exp(value[i] - most);
    return log(half * sum) + most;
}

/* Zero at the depth where V_a e = eps. */
static double barrier_excess(double depth, void *user)
{
    const activation *a = user;
    return log_reduced_energy(a, depth) - log(a->barrier);
}

static wt_status find_barrier_free_depth(activation *a, wt_error *err)
{
    double q_min, q_max;
    (void)energy_wavenumber_range(&a->dwell, &q_min, &q_max);
    if (!energy_is_monotonic(&a->dwell) || !(barrier_excess(0, a) > 0))
        return WT_OK;
    double high = 1 / q_max;
    while (barrier_excess(high, a) > 0)
        high *= 2;
    return root_find(barrier_excess, a, 0, high, 0, &a->barrier_free_depth, err);
}

/* ---- subintervals ---------------------------------------------------------------------------- */

static bool grow_subintervals(activation *a)
{
    if (a->n + 1 < a->room)
        return true;
    const size_t capacity = a->room ? 2 * a->room : 128;
    double *edge = realloc(a->edge, capacity * sizeof *edge);
    a->edge = edge ? edge : a->edge;
    double *part = realloc(a->log_part, capacity * sizeof *part);
    a->log_part = part ? part : a->log_part;
    if (edge == NULL || part == NULL)
        return false;
    a->room = capacity;
    return true;
}

/* Adds the next subinterval, as long as the rules agree; *length returns the trial length of the
 * following one. */
static void add_subinterval(activation *a, double *length)
{
    const double from = a->edge[a->n];
    double part;
    if (from < a->barrier_free_depth && from + *length > a->barrier_free_depth)
        *length = a->barrier_free_depth - from;
    for (;;) {
        part = log_interval_integral(a, a->high, from, from + *length);
        const double other = log_interval_integral(a, a->low, from, from + *length);
        if (fabs(part - other) <= subinterval_goal || *length <= min_relative_length * from)
            break;
        *length *= 0.5;
    }
    a->log_part[a->n] = part;
    a->edge[++a->n] = from + *length;
    *length *= 2;
}

/* ln of the integral below the last subinterval, where Omega is linear in e. */
static double linear_tail(const activation *a, double depth)
{
    return a->log_rate + a->log_volume + energy_log_tail(&a->dwell, depth);
}

static wt_status create_subintervals(activation *a, wt_error *err)
{
    double q_min, q_max;
    (void)energy_wavenumber_range(&a->dwell, &q_min, &q_max);
    const double falling = energy_monotonic_depth(&a->dwell);
    double length = 1 / q_max;
    if (!grow_subintervals(a))
        return wt_fail(err, WT_E_MEMORY, "out of memory for the rate of an activated layer");
    a->edge[0] = 0;
    while (a->edge[a->n] < falling || !(log_reduced_energy(a, a->edge[a->n]) < log_linear)) {
        if (a->n == MAX_SUBINTERVALS)
            return wt_fail(err, WT_E_RANGE, "the rate of an activated layer cannot be integrated");
        if (!grow_subintervals(a))
            return wt_fail(err, WT_E_MEMORY, "out of memory for the rate of an activated layer");
        add_subinterval(a, &length);
    }
    a->log_tail = malloc((a->n + 1) * sizeof *a->log_tail);
    if (a->log_tail == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for the rate of an activated layer");
    a->log_tail[a->n] = linear_tail(a, a->edge[a->n]);
    for (size_t i = a->n; i > 0; i--)
        a->log_tail[i - 1] = log_add(a->log_tail[i], a->log_part[i - 1]);
    return WT_OK;
}

/* Returns the last edge at or above a depth. */
static size_t find_subinterval(const activation *a, double depth)
{
    size_t low = 0, high = a->n;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (a->edge[middle] <= depth)
            low = middle;
        else
            high = middle;
    }
    return depth >= a->edge[a->n] ? a->n : low;
}

double activation_log_tail(const activation *a, double depth)
{
    const size_t i = find_subinterval(a, depth);
    if (i == a->n)
        return linear_tail(a, depth);
    if (depth == a->edge[i])
        return a->log_tail[i];
    return log_add(a->log_tail[i + 1], log_interval_integral(a, a->high, depth, a->edge[i + 1]));
}

double activation_log_integral(const activation *a, double depth, double length)
{
    const double end = depth + length, last = a->edge[a->n];
    const size_t first = find_subinterval(a, depth), to = find_subinterval(a, end);
    if (!(end > depth)) /* the length is below the resolution of the depth */
        return length > 0 ? activation_log_density(a, depth) + log(length) : -HUGE_VAL;
    if (first == a->n)
        return a->log_rate + a->log_volume + energy_log_integral(&a->dwell, depth, length);
    if (first == to)
        return log_interval_integral(a, a->high, depth, end);
    double sum = log_interval_integral(a, a->high, depth, a->edge[first + 1]);
    for (size_t i = first + 1; i < to; i++)
        sum = log_add(sum, a->log_part[i]);
    if (to == a->n && end > last)
        return log_add(sum, a->log_rate + a->log_volume +
                                energy_log_integral(&a->dwell, last, end - last));
    return end > a->edge[to] ? log_add(sum, log_interval_integral(a, a->high, a->edge[to], end))
                             : sum;
}

/* ---- with bounds ----------------------------------------------------------------------------- */

/* exp(-scale) times d Omega / dz, and the largest |d Omega/dz| and |d^2 Omega/dz^2| below a depth.
 */
typedef struct rate_slopes {
    double slope, max_slope, max_curvature;
} rate_slopes;

static rate_slopes compute_rate_slopes(const activation *a, double depth, double reach,
                                       double scale)
{
    double q_min = 0, q_max;
    (void)energy_wavenumber_range(&a->dwell, &q_min, &q_max);
    const energy_expansion c = energy_expand(&a->dwell, q_min, depth, 0, reach);
    const double volume = exp(a->log_volume + c.log_scale); /* factor of the scaled expansion */
    const double x = volume * c.value;
    const double highest =
        volume * (c.value + reach * (fmax(0, c.slope) + 0.5 * reach * c.curvature));
    const double steepest = volume * (fabs(c.slope) + reach * c.curvature);
    const double here = exp(a->log_rate - scale + fmin(x, a->barrier));
    const double most = exp(a->log_rate - scale + fmin(highest, a->barrier));
    return (rate_slopes){x < a->barrier ? here * volume * c.slope : 0, most * steepest,
                         most * (steepest * steepest + volume * c.curvature)};
}

energy_expansion activation_expand(const activation *a, double depth, double length, double reach)
{
    energy_expansion expansion = {.value = 1};
    expansion.log_scale =
        length > 0 ? activation_log_integral(a, depth, length) : activation_log_density(a, depth);
    const rate_slopes here = compute_rate_slopes(a, depth, reach, expansion.log_scale);
    if (!(length > 0)) {
        expansion.slope = here.slope;
        expansion.curvature = here.max_curvature;
        return expansion;
    }
    const rate_slopes there = compute_rate_slopes(a, depth + length, reach, expansion.log_scale);
    expansion.slope = exp(activation_log_density(a, depth + length) - expansion.log_scale) -
                      exp(activation_log_density(a, depth) - expansion.log_scale);
    expansion.curvature = here.max_slope + there.max_slope;
    return expansion;
}

/* ---- the object ------------------------------------------------------------------------------ */

double activation_error(const activation *a)
{
    const double most =
        fmin(exp(log_reduced_energy(a, energy_monotonic_depth(&a->dwell))), a->barrier);
    return subinterval_goal + (1 + most) * a->dwell.numerical_error +
           8 * DBL_EPSILON * (1 + a->barrier);
}

void activation_free(activation *a)
{
    if (a == NULL)
        return;
    wt_energy_source_clear(&a->dwell);
    free(a->edge);
    free(a->log_part);
    free(a->log_tail);
    free(a);
}

/* Copies the source as energy per wave: its power times the time that the wave needs to pass in
 * contact. */
static wt_status copy_dwell(const wt_energy_source *source, double contact_velocity,
                            wt_energy_source *dwell, wt_error *err)
{
    *dwell = *source;
    dwell->wavenumber = malloc(source->n * sizeof *dwell->wavenumber);
    dwell->power = malloc(source->n * sizeof *dwell->power);
    if (dwell->wavenumber == NULL || dwell->power == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for an activated layer");
    for (size_t i = 0; i < source->n; i++) {
        dwell->wavenumber[i] = source->wavenumber[i];
        dwell->power[i] = source->power[i] / (source->wavenumber[i] * contact_velocity);
    }
    return energy_check(dwell, err);
}

wt_status activation_new(const wt_energy_source *source, const wt_activation *parameters,
                         double velocity, activation **out, wt_error *err)
{
    const wt_activation *p = parameters;
    double q_min, q_max;
    *out = NULL;
    if (!energy_wavenumber_range(source, &q_min, &q_max))
        return WT_OK;
    activation *a = calloc(1, sizeof *a);
    if (a == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory for an activated layer");
    const double energy = BOLTZMANN * p->temperature;
    a->barrier = p->barrier / energy;
    a->log_volume = log(p->volume) - log(energy);
    a->log_rate = log(p->area_ratio) + log(attempt_rate(p->attempt, p->temperature)) - a->barrier;
    wt_status status = gauss_rule_get(LOW_NODES, &a->low, err);
    if (status == WT_OK)
        status = gauss_rule_get(HIGH_NODES, &a->high, err);
    if (status == WT_OK)
        status = copy_dwell(source, velocity * p->area_ratio, &a->dwell, err);
    if (status == WT_OK)
        status = find_barrier_free_depth(a, err);
    if (status == WT_OK)
        status = create_subintervals(a, err);
    if (status == WT_OK)
        *out = a;
    else
        activation_free(a);
    return status;
}
