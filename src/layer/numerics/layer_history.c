/* Thickness against time at constant load, by closed form, damage transport or the rate balance,
 * which is integrated here; and the balance of formation and wear: thickness, stability and
 * relaxation, and the removal of a layer without a balance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/gauss_legendre.h"
#include "layer/numerics/layer_kernel.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* Numbers of nodes of the two rules, whose difference is the error of the lower one. */
enum { LOW_NODES = 12, HIGH_NODES = 16 };

/* Length of a subinterval as a share of the distance to the balance, where the time has a
 * logarithm. The second limit is in units of the local decay length, over which formation is
 * smooth. The shares affect the cost only: inaccurate subintervals are halved. */
static const double distance_share = 0.7;
static const double decay_lengths = 2;

/* Tolerance of the difference of the two rules; a hundred subintervals then have an error of 1e-10.
 */
static const double subinterval_goal = 1e-12;

/* Formation is neglected below this share of wear. */
static const double log_negligible = -41.5; /* 1e-18 */

typedef struct layer_instant {
    double time;
    wt_layer_point *point;
} layer_instant;

typedef struct integration {
    const layer_rates *rates;
    const gauss_rule *low, *high;
    double target;    /* final thickness [m]: the balance, or 0 */
    double direction; /* +1 for growth, -1 for wear */
    double thickness, time;
    double time_error;
    double sensitivity;      /* int Qf / (Qf - Qw)^2: minus d time / d ln Qf */
    double part[HIGH_NODES]; /* of the time of the latest subinterval, at each node */
} integration;

static double net_rate(const layer_rates *rates, double thickness)
{
    return layer_formation_rate(rates, thickness) - rates->wear;
}

/* Time from `from` over `length` in the direction of the integration. part: [nodes], or NULL. */
static double subinterval_time(const integration *m, const gauss_rule *rule, double from,
                               double length, double *part, double *sensitivity)
{
    double sum = 0;
    *sensitivity = 0;
    for (size_t i = 0; i < rule->n; i++) {
        const double thickness = from + m->direction * 0.5 * length * (1 + rule->node[i]);
        const double formation = layer_formation_rate(m->rates, thickness);
        const double rate = formation - m->rates->wear;
        const double weight = 0.5 * length * rule->weight[i] / fabs(rate);
        sum += weight;
        if (part != NULL)
            part[i] = weight;
        *sensitivity += weight * (formation / fabs(rate));
    }
    return sum;
}

/* Length of the next subinterval; 0 if the target is reached up to rounding. */
static double choose_length(const integration *m)
{
    const double kappa = layer_decay_rate(m->rates, m->thickness);
    const double rate = fabs(net_rate(m->rates, m->thickness));
    const double slope = layer_formation_rate(m->rates, m->thickness) * kappa;
    double length = fabs(m->target - m->thickness);
    const double noise = 4 * DBL_EPSILON * (m->thickness + (kappa > 0 ? 1 / kappa : 0));
    const bool balance = m->direction > 0 || m->rates->log_ratio >= 0;
    if (balance) {
        if (length <= noise)
            return 0;
        length *= distance_share;
    } else if (slope > 0) { /* the balance is virtual, at a negative thickness */
        length = fmin(length, distance_share * log1p(kappa * rate / slope) / kappa);
    }
    if (kappa == 0) /* surface of a profile that begins at 0 */
        return m->rates->q_min > 0 ? fmin(length, 1 / m->rates->q_min) : length;
    return fmin(length, decay_lengths / kappa);
}

/* Relative rounding error of Qf, which is the exponential of a sum of logarithms. */
static double rounding_error(const layer_rates *rates, double thickness)
{
    const double depth = rates->q_min * thickness;
    return 16 * DBL_EPSILON * (1 + fabs(rates->log_power) + 2 * depth);
}

/* Integrates one subinterval and shortens it until its two rules agree within the noise of Qf - Qw.
 * Returns the time. */
static double integrate_subinterval(integration *m, double *length, double *error,
                                    double *sensitivity)
{
    double time = 0, ignored;
    for (int i = 0; i < 60; i++) {
        const double end = m->thickness + m->direction * *length;
        const double formation = layer_formation_rate(m->rates, end);
        const double noise =
            rounding_error(m->rates, end) * formation / fabs(formation - m->rates->wear);
        time = subinterval_time(m, m->high, m->thickness, *length, m->part, sensitivity);
        *error = fabs(time - subinterval_time(m, m->low, m->thickness, *length, NULL, &ignored));
        /* times below the smallest normal number have no digits left, and neither has a formation
         * that underflows */
        if (!(*error > (subinterval_goal + 4 * noise) * time + DBL_MIN))
            break;
        *length *= 0.5;
    }
    return time;
}

/* Thickness at a time inside the subinterval that starts here, by Newton's method with a bracket.
 * The start value is linear. */
static double locate_thickness(const integration *m, double length, double duration, double time)
{
    double low = 0, high = length;
    double distance = length * ((time - m->time) / duration);
    for (int i = 0; i < 60; i++) {
        double ignored;
        const double excess =
            m->time + subinterval_time(m, m->high, m->thickness, distance, NULL, &ignored) - time;
        if (excess > 0)
            high = distance;
        else
            low = distance;
        const double here = m->thickness + m->direction * distance;
        double next = distance - excess * fabs(net_rate(m->rates, here));
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        const double change = fabs(next - distance);
        distance = next;
        /* the noise of the quadrature is some ulps of the whole thickness */
        if (change <= 4 * DBL_EPSILON * distance || change <= 16 * DBL_EPSILON * m->thickness)
            break;
    }
    return m->thickness + m->direction * distance;
}

/* The same by the polynomial through the nodes, for draws: to 1e-8 of the subinterval, whose rule
 * is exact to twice the degree. The time to x is the sum over k of a_k (P_(k+1) - P_(k-1)), with
 * P_(-1) = -1. */
static double interpolate_thickness(const integration *m, double length, double time)
{
    double a[HIGH_NODES] = {0}, low = -1, high = 1, x = 0;
    for (size_t i = 0; i < HIGH_NODES; i++) {
        double before = 0, p = 1;
        for (size_t k = 0; k < HIGH_NODES; k++) {
            a[k] += 0.5 * m->part[i] * p;
            const double next =
                ((double)(2 * k + 1) * m->high->node[i] * p - (double)k * before) / (double)(k + 1);
            before = p;
            p = next;
        }
    }
    for (int i = 0; i < 60; i++) {
        double before = -1, p = 1, duration = 0, slope = 0;
        for (size_t k = 0; k < HIGH_NODES; k++) {
            const double next =
                ((double)(2 * k + 1) * x * p - (k > 0 ? (double)k * before : 0)) / (double)(k + 1);
            duration += a[k] * (next - before);
            slope += a[k] * (double)(2 * k + 1) * p;
            before = p;
            p = next;
        }
        const double excess = m->time + duration - time;
        *(excess > 0 ? &high : &low) = x;
        double next = x - excess / slope;
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        const double change = fabs(next - x);
        x = next;
        if (change <= 1e-10)
            break;
    }
    return m->thickness + m->direction * 0.5 * length * (1 + x);
}

static wt_estimate thickness_estimate(const integration *m, double thickness, double time,
                                      double time_error, double sensitivity)
{
    const double rate = fabs(net_rate(m->rates, thickness));
    const double relative = rounding_error(m->rates, thickness);
    const double error =
        rate * (time_error + relative * time + (m->rates->error + relative) * sensitivity) +
        4 * DBL_EPSILON * thickness;
    return (wt_estimate){.value = fmax(thickness, 0), .numerical_error = error, .unit = "m"};
}

/* Length over which only wear matters. Far above the balance the thickness is linear in time, down
 * to where formation is significant. */
static wt_status skip_pure_wear(integration *m, double *length, wt_error *err)
{
    *length = 0;
    if (m->direction > 0 || m->rates->wear == 0)
        return WT_OK;
    wt_estimate felt = {0};
    if (m->rates->formation > 0) {
        const wt_status status = layer_fixed_point(m->rates, log_negligible, &felt, err);
        if (status != WT_OK)
            return status;
    }
    *length = fmax(0, m->thickness - fmax(felt.value, m->target));
    return WT_OK;
}

/* Starts an integration. *linear is the length over which only wear matters. */
static wt_status begin_integration(integration *m, const layer_rates *rates, double start,
                                   wt_estimate *target, double *linear, wt_error *err)
{
    *m = (integration){.rates = rates, .thickness = start};
    const wt_status status = layer_fixed_point(rates, 0, target, err);
    m->low = gauss_rule_get(LOW_NODES);
    m->high = gauss_rule_get(HIGH_NODES);
    m->target = target->value;
    m->direction = net_rate(rates, start) > 0 ? 1 : -1;
    if (m->direction < 0)
        m->target = fmin(m->target, start);
    return status == WT_OK ? skip_pure_wear(m, linear, err) : status;
}

/* Rate balance: sets the thickness, but no other member, of the points at n rising times. */
static wt_status integrate_thickness(const layer_rates *rates, double start,
                                     const layer_instant *at, size_t n, wt_error *err)
{
    integration m;
    wt_estimate target;
    double linear = 0;
    wt_status status = begin_integration(&m, rates, start, &target, &linear, err);
    if (status != WT_OK)
        return status;

    size_t i = 0;
    if (net_rate(rates, start) == 0) { /* no motion: no rates, or start at the balance */
        for (; i < n; i++)
            at[i].point->thickness = (wt_estimate){
                .value = start, .numerical_error = target.numerical_error, .unit = "m"};
        return status;
    }
    if (linear > 0) {
        const double until = linear / rates->wear;
        for (; i < n && at[i].time < until; i++)
            at[i].point->thickness =
                thickness_estimate(&m, start - rates->wear * at[i].time, at[i].time, 0, 0);
        m.thickness = start - linear;
        m.time = until;
    }
    for (; i < n && at[i].time == 0; i++)
        at[i].point->thickness = (wt_estimate){.value = start, .unit = "m"};
    while (i < n) {
        double length = choose_length(&m);
        if (!(length > 0))
            break;
        double error, sensitivity;
        const double duration = integrate_subinterval(&m, &length, &error, &sensitivity);
        const double sum_error = m.time_error + error;
        const double sum_sensitivity = m.sensitivity + sensitivity;
        for (; i < n && at[i].time <= m.time + duration; i++) {
            if (rates->skip_numerical_errors)
                at[i].point->thickness =
                    (wt_estimate){.value = interpolate_thickness(&m, length, at[i].time),
                                  .numerical_error = (double)NAN,
                                  .unit = "m"};
            else
                at[i].point->thickness =
                    thickness_estimate(&m, locate_thickness(&m, length, duration, at[i].time),
                                       at[i].time, sum_error, sum_sensitivity);
        }
        m.thickness += m.direction * length;
        m.time += duration;
        m.time_error = sum_error;
        m.sensitivity = sum_sensitivity;
        if (!isfinite(m.time))
            break;
    }
    for (; i < n; i++) { /* the target is reached */
        at[i].point->thickness = (wt_estimate){.value = m.target, .unit = "m"};
        at[i].point->thickness.numerical_error =
            target.numerical_error + fabs(m.thickness - m.target);
    }
    return status;
}

/* Time from `start` to `goal`, which must lie on the path of the integration. */
static double integrate_to_thickness(integration *m, double goal, double linear)
{
    const double first = fmin(linear, m->thickness - goal);
    if (linear > 0) {
        m->thickness -= first;
        m->time = first / m->rates->wear;
    }
    while (m->direction * (goal - m->thickness) > 0) {
        double error, sensitivity;
        const double left = m->direction * (goal - m->thickness);
        double length = fmin(choose_length(m), left);
        if (!(length > 0))
            break;
        m->time += integrate_subinterval(m, &length, &error, &sensitivity);
        m->time_error += error;
        m->sensitivity += sensitivity;
        m->thickness = length >= left ? goal : m->thickness + m->direction * length;
    }
    return m->time;
}

/* Rate balance: time from one thickness to another on the path to the balance or to the bare
 * surface; infinite if it is not on the path. */
static wt_status integrate_time(const layer_rates *rates, double start, wt_estimate goal,
                                wt_estimate *time, wt_error *err)
{
    *time = (wt_estimate){.unit = "s"};
    if (start == goal.value)
        return WT_OK;
    *time = (wt_estimate){.value = HUGE_VAL, .unit = "s"};
    const double rate = net_rate(rates, start), there = net_rate(rates, goal.value);
    const bool grows = goal.value > start;
    if (!isfinite(goal.value) || (grows ? !(rate > 0 && there > 0) : !(rate < 0 && there < 0)))
        return WT_OK;
    integration m;
    wt_estimate target;
    double linear = 0;
    const wt_status status = begin_integration(&m, rates, start, &target, &linear, err);
    if (status == WT_OK) {
        const double relative = rounding_error(rates, fmax(start, goal.value));
        time->value = integrate_to_thickness(&m, goal.value, linear);
        time->numerical_error = m.time_error + relative * time->value +
                                (rates->error + relative) * m.sensitivity +
                                (goal.numerical_error + 4 * DBL_EPSILON * start) / fabs(there);
    }
    return status;
}

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

/* Damage transport: the old layer moves up and is worn off; new damage accumulates below. */
static wt_status history_damage(const layer_rates *rates, double start, const layer_instant *at,
                                size_t n, wt_error *err)
{
    double earlier = 0;
    for (size_t i = 0; i < n; i++) {
        wt_estimate grown;
        const wt_status status = layer_damage_depth(rates, at[i].time, earlier, &grown, err);
        if (status != WT_OK)
            return status;
        earlier = grown.value;
        const double old = fmax(0, start - rates->wear * at[i].time);
        if (old > grown.value) {
            grown.value = old;
            grown.numerical_error = rates->skip_numerical_errors
                                        ? (double)NAN
                                        : fmax(grown.numerical_error, 4 * DBL_EPSILON * start);
        }
        at[i].point->thickness = grown;
    }
    return WT_OK;
}

/* Returns kappa if all power is at one wavenumber under an exponential profile, else 0. */
static double single_kappa(const layer_rates *rates)
{
    const bool single = rates->source->profile == WT_PROFILE_PERSSON && rates->q_min > 0 &&
                        rates->q_min == rates->q_max;
    return single ? 2 * rates->q_min : 0;
}

/* Closed form. Its error follows from rounding and from the error of Qf(0). */
static void history_exponential(const layer_rates *rates, double kappa, double start,
                                const double *time, size_t n, wt_layer_point *points)
{
    const double relative = rates->error + 8 * DBL_EPSILON;
    for (size_t i = 0; i < n; i++) {
        const double formation = rates->formation;
        const double value =
            wt_layer_exponential_thickness(start, kappa, formation, rates->wear, time[i]);
        const double more = wt_layer_exponential_thickness(start, kappa, formation * (1 + relative),
                                                           rates->wear, time[i]);
        const double less = wt_layer_exponential_thickness(
            start, kappa, formation * fmax(0, 1 - relative), rates->wear, time[i]);
        points[i].thickness = (wt_estimate){
            .value = value,
            .numerical_error = fmax(more - value, value - less) +
                               8 * DBL_EPSILON * (fmax(start, value) + fmin(value, 1 / kappa)),
            .unit = "m"};
    }
}

/* Returns WT_E_RANGE with the invalid time. */
static wt_status check_times(const double *time, size_t n, wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!(time[i] >= 0) || !isfinite(time[i])) {
            wt_fail(err, WT_E_RANGE, "time %zu of %zu of a layer is outside its range", i + 1, n);
            wt_error_expected(err, "finite and >= 0 s");
            wt_error_found(err, "%g", time[i]);
            return WT_E_RANGE;
        }
    return WT_OK;
}

wt_status wt_layer_history(const wt_energy_source *source, const wt_layer_parameters *parameters,
                           const double *time, size_t n, wt_layer_point *points, wt_error *err)
{
    if (n && (time == NULL || points == NULL))
        return wt_fail(err, WT_E_ARG, "the history of a layer needs times and a place for it");
    layer_rates rates;
    wt_status status = layer_rates_compute(source, parameters, &rates, err);
    if (status == WT_OK)
        status = check_times(time, n, err);
    if (status != WT_OK || n == 0)
        return status;
    const double kappa = single_kappa(&rates), start = parameters->start_thickness;
    layer_instant *const order = wt_alloc(n, sizeof *order);
    for (size_t i = 0; i < n; i++)
        order[i] = (layer_instant){time[i], &points[i]};
    qsort(order, n, sizeof *order, numbers_compare);
    if (parameters->incubation)
        status = history_damage(&rates, start, order, n, err);
    else if (kappa > 0)
        history_exponential(&rates, kappa, start, time, n, points);
    else
        status = integrate_thickness(&rates, start, order, n, err);
    free(order);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        points[i].time = time[i];
        points[i].formation_rate = rates.skip_numerical_errors
                                       ? (double)NAN
                                       : layer_formation_rate(&rates, points[i].thickness.value);
        points[i].wear_rate = rates.wear;
    }
    return status;
}

/* ---- balance -------------------------------------------------------------------------------- */

static wt_layer_regime classify_regime(double log_ratio)
{
    if (!(log_ratio > 0))
        return WT_LAYER_NONE;
    return log_ratio < 1 ? WT_LAYER_THIN : WT_LAYER_THICK;
}

static wt_estimate time_estimate(double value, double error)
{
    return (wt_estimate){.value = value, .numerical_error = error, .unit = "s"};
}

/* Removal time of the initial layer. With damage transport no new layer forms for R <= 1: the old
 * layer is worn from the top. */
static wt_estimate compute_removal_time(const layer_rates *rates, double start)
{
    if (start == 0)
        return time_estimate(0, 0);
    const double time = rates->wear > 0 ? start / rates->wear : HUGE_VAL;
    return time_estimate(time, 4 * DBL_EPSILON * time);
}

/* 1/(kappa Qw) at the balance; its error follows from those of the thickness and of kappa. */
static wt_estimate compute_relaxation_time(const layer_rates *rates, wt_estimate thickness)
{
    const double rate =
        rates->wear > 0 ? rates->wear * layer_decay_rate(rates, thickness.value) : 0;
    if (!(rate > 0))
        return time_estimate(HUGE_VAL, 0);
    const double time = 1 / rate;
    if (rates->skip_numerical_errors)
        return time_estimate(time, (double)NAN);
    const double above = layer_decay_rate(rates, thickness.value + thickness.numerical_error);
    const double below =
        layer_decay_rate(rates, fmax(0, thickness.value - thickness.numerical_error));
    const double moved =
        fmax(fabs(1 / (rates->wear * above) - time), fabs(1 / (rates->wear * below) - time));
    return time_estimate(time, moved + time * (2 * rates->error + 64 * DBL_EPSILON));
}

wt_status wt_layer_steady_state_compute(const wt_energy_source *source,
                                        const wt_layer_parameters *parameters,
                                        wt_layer_steady_state *balance, wt_error *err)
{
    if (balance == NULL)
        return wt_fail(err, WT_E_ARG, "a balance needs a place for the result");
    layer_rates r;
    wt_layer_steady_state b = {0};
    wt_status status = layer_rates_compute(source, parameters, &r, err);
    if (status == WT_OK)
        status = layer_fixed_point(&r, 0, &b.thickness, err);
    b.incubation_time = time_estimate((double)NAN, (double)NAN);
    if (status == WT_OK && !parameters->balance_only)
        status = layer_damage_time(&r, parameters->incubation, (wt_estimate){.unit = "m"},
                                   &b.incubation_time, err);
    if (status != WT_OK)
        return status;

    b.surface_power = r.power;
    b.formation_rate_zero = r.formation;
    b.wear_rate = r.wear;
    b.ratio = r.formation == 0 ? 0 : exp(r.log_ratio);
    b.ratio_error = r.error;
    b.critical_specific_wear_rate =
        r.formation == 0
            ? 0
            : exp(r.log_power - r.threshold) / (parameters->pressure * parameters->velocity);
    b.regime = classify_regime(r.log_ratio);
    b.relaxation_time = compute_relaxation_time(&r, b.thickness);
    b.eigenvalue = b.regime == WT_LAYER_NONE ? 0 : -1 / b.relaxation_time.value;
    b.removal_time = time_estimate((double)NAN, (double)NAN);
    if (b.regime == WT_LAYER_NONE) {
        if (parameters->incubation)
            b.removal_time = compute_removal_time(&r, parameters->start_thickness);
        else
            status = integrate_time(&r, parameters->start_thickness, (wt_estimate){.unit = "m"},
                                    &b.removal_time, err);
    }
    if (status == WT_OK)
        *balance = b;
    return status;
}

wt_status wt_layer_growth_time(const wt_energy_source *source,
                               const wt_layer_parameters *parameters, wt_estimate thickness,
                               wt_estimate *time, wt_error *err)
{
    if (time == NULL)
        return wt_fail(err, WT_E_ARG, "the time of a thickness needs a place for it");
    layer_rates r;
    *time = time_estimate((double)NAN, (double)NAN);
    wt_status status = layer_rates_compute(source, parameters, &r, err);
    if (status != WT_OK || !(thickness.value > 0))
        return status;
    const double start = parameters->start_thickness;
    if (parameters->incubation)
        status = layer_damage_time(&r, true, thickness, time, err);
    else if (start < thickness.value)
        status = integrate_time(&r, start, thickness, time, err);
    /* never reached, or the old layer is still thicker at that time */
    if (isinf(time->value) || start - r.wear * time->value >= thickness.value)
        *time = time_estimate((double)NAN, (double)NAN);
    return status;
}

double wt_layer_calibrate(const wt_energy_source *source, const wt_layer_parameters *parameters,
                          double thickness)
{
    return wt_energy_tail(source, thickness) /
           (parameters->damage * parameters->specific_wear_rate * parameters->pressure *
            parameters->velocity);
}
