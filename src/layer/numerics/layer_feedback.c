/* Layer with feedback on the energy that forms it: formation under a layer of thickness d against
 * wear. The iteration from thickness to balance need not converge; all roots are therefore
 * bracketed on a grid.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "layer/numerics/layer_kernel.h"

#include "core/math/root.h"

#include <math.h>
#include <stdlib.h>

/* Step of the difference quotient relative to the thickness: its fourth power is below the accuracy
 * of the energy. */
static const double slope_step = 3e-3;
/* Smallest height of an extremum of ln(Qf / Qw) above rounding. */
static const double min_fold_height = 1e-7;
/* Number of golden-section steps: they reduce a bracket to 1e-8, where an extremum is flat to
 * 1e-16. */
enum { SECTIONS = 40 };

/* Thickness relative to the first of the grid that counts as 0. */
static const double below_grid = 1e-9;

typedef struct loop_search {
    wt_layer_energy_fn energy;
    void *user;
    wt_status status; /* first failure */
    wt_error *err;
} loop_search;

/* Formation and wear under a layer of given thickness. */
typedef struct loop_point {
    double log_ratio; /* ln(Qf / Qw) */
    double formation, wear, decay, wear_factor, q_max;
} loop_point;

static loop_point compute_loop_point(loop_search *s, double thickness)
{
    loop_point p = {.log_ratio = (double)NAN};
    wt_energy_source source = {0};
    wt_layer_parameters parameters;
    layer_rates rates;
    if (s->status != WT_OK)
        return p;
    s->status = s->energy(thickness, s->user, &source, &parameters, s->err);
    if (s->status == WT_OK)
        s->status = layer_rates_compute(&source, &parameters, &rates, s->err);
    if (s->status == WT_OK) {
        p = (loop_point){.formation = layer_formation_rate(&rates, thickness),
                         .wear = rates.wear,
                         .decay = layer_decay_rate(&rates, thickness),
                         .wear_factor = parameters.specific_wear_rate,
                         .q_max = rates.q_max};
        p.log_ratio =
            rates.formation > 0
                ? rates.log_ratio + energy_log_tail(rates.source, thickness) - rates.log_power
                : -HUGE_VAL;
    }
    wt_energy_source_clear(&source);
    return p;
}

static double compute_log_ratio(double log_thickness, void *user)
{
    return compute_loop_point(user, exp(log_thickness)).log_ratio;
}

static double negative_log_ratio(double log_thickness, void *user)
{
    return -compute_log_ratio(log_thickness, user);
}

/* d ln(Qf / Qw) / dd by five points. */
static double log_ratio_slope(loop_search *s, double thickness)
{
    const double h = slope_step * thickness;
    const double inner_difference = compute_loop_point(s, thickness + h).log_ratio -
                                    compute_loop_point(s, thickness - h).log_ratio;
    const double outer_difference = compute_loop_point(s, thickness + 2 * h).log_ratio -
                                    compute_loop_point(s, thickness - 2 * h).log_ratio;
    return (8 * inner_difference - outer_difference) / (12 * h);
}

static void add_root(loop_search *s, double thickness, wt_layer_feedback *loop)
{
    if (loop->n_roots == WT_LAYER_MAX_ROOTS)
        return;
    wt_layer_root *r = &loop->root[loop->n_roots++];
    const loop_point p = compute_loop_point(s, thickness);
    /* d (Qf - Qw) / dd at equal rates */
    r->thickness = thickness;
    r->eigenvalue = p.wear * log_ratio_slope(s, thickness);
    r->map_slope = 1 + r->eigenvalue / (p.wear * p.decay);
    r->stable = r->eigenvalue < 0;
}

static void add_fold(loop_search *s, double low, double high, bool maximum, wt_layer_feedback *loop)
{
    if (loop->n_folds == WT_LAYER_MAX_ROOTS)
        return;
    const double log_position =
        root_maximum(maximum ? compute_log_ratio : negative_log_ratio, s, low, high, SECTIONS);
    const loop_point p = compute_loop_point(s, exp(log_position));
    loop->fold[loop->n_folds++] =
        (wt_layer_fold){exp(log_position), p.wear_factor * exp(p.log_ratio), maximum};
}

/* Adds a balance below the grid. There, either the bare surface or the layer of the first thickness
 * is modified, and the other is worn. The thickness is 0 if the energy is discontinuous at 0, as
 * for shearing. The balance is stable if the bare surface is modified; otherwise it is a threshold.
 */
static void add_thinnest_root(loop_search *s, double log_low, bool grows, wt_layer_feedback *loop)
{
    const double least = log_low + log(below_grid);
    double root = -HUGE_VAL;
    if ((compute_log_ratio(least, s) > 0) == grows) {
        const wt_status status = root_find(compute_log_ratio, s, least, log_low, 0, &root, s->err);
        s->status = s->status == WT_OK ? status : s->status;
    }
    if (s->status != WT_OK)
        return;
    if (isfinite(root))
        add_root(s, exp(root), loop);
    else
        loop->root[loop->n_roots++] = (wt_layer_root){0, grows, (double)NAN, (double)NAN};
}

/* Finds the roots and extrema of values on a grid of ln d. */
static void search_grid(loop_search *s, const double *x, const double *value, size_t n,
                        wt_layer_feedback *loop)
{
    for (size_t i = 1; s->status == WT_OK && i < n; i++) {
        double root;
        if ((value[i - 1] > 0) != (value[i] > 0)) {
            wt_status status = root_find(compute_log_ratio, s, x[i - 1], x[i], 0, &root, s->err);
            if (s->status == WT_OK)
                s->status = status;
            if (s->status == WT_OK)
                add_root(s, exp(root), loop);
        }
        if (i + 1 == n)
            continue;
        const double before = value[i] - value[i - 1], after = value[i + 1] - value[i];
        if (before * after < 0 && fmin(fabs(before), fabs(after)) > min_fold_height)
            add_fold(s, x[i - 1], x[i + 1], before > 0, loop);
    }
}

wt_status wt_layer_feedback_solve(wt_layer_energy_fn energy, void *user, double low, double high,
                                  size_t grid, wt_layer_feedback *loop, wt_error *err)
{
    if (energy == NULL || loop == NULL || !(low > 0) || !(high > low) || grid < 3)
        return wt_fail(err, WT_E_ARG, "a layer with feedback needs a range of thickness");
    loop_search s = {.energy = energy, .user = user, .err = err};
    double *x = wt_alloc(2 * grid, sizeof *x);
    double *value = x + grid;
    wt_layer_feedback l = {.low = low, .high = high};
    const double bare = compute_loop_point(&s, 0).log_ratio;
    l.ratio = exp(bare);
    if (!(bare > 0))
        l.root[l.n_roots++] = (wt_layer_root){0, true, (double)NAN, (double)NAN};
    for (size_t i = 0; s.status == WT_OK && i < grid; i++) {
        x[i] = log(low) + log(high / low) * (double)i / (double)(grid - 1);
        value[i] = compute_log_ratio(x[i], &s);
    }
    if (s.status == WT_OK && (bare > 0) != (value[0] > 0))
        add_thinnest_root(&s, x[0], bare > 0, &l);
    if (s.status == WT_OK)
        search_grid(&s, x, value, grid, &l);
    free(x);
    if (s.status == WT_OK)
        *loop = l;
    return s.status;
}

/* ---- in time --------------------------------------------------------------------------------- */

/* Formation under the layer for the time integration, which uses the wear rate of the bare surface.
 * A change of the wear rate by the layer is counted as formation, which exceeds wear up to the
 * first balance. */
typedef struct formation_search {
    loop_search *search;
    double wear;
} formation_search;

static double compute_log_formation(double thickness, void *user)
{
    const formation_search *o = user;
    const loop_point p = compute_loop_point(o->search, thickness);
    const double log_formation = p.log_ratio + log(p.wear);
    return p.wear == o->wear ? log_formation : log(exp(log_formation) - p.wear + o->wear);
}

static wt_status integrate_feedback_history(loop_search *s, layer_rates *rates, const double *time,
                                            size_t n, wt_layer_point *points, wt_error *err)
{
    const wt_status status = layer_history_sorted(rates, 0, false, time, n, points, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        points[i].time = time[i];
        const loop_point p = compute_loop_point(s, points[i].thickness.value);
        points[i].formation_rate = p.formation;
        points[i].wear_rate = p.wear;
    }
    return status == WT_OK ? s->status : status;
}

/* Returns the lowest stable root above a bare surface; 0 if no layer grows. */
static double target_thickness(const wt_layer_feedback *loop)
{
    for (size_t i = 0; loop->ratio > 1 && i < loop->n_roots; i++)
        if (loop->root[i].stable)
            return loop->root[i].thickness;
    return 0;
}

wt_status wt_layer_feedback_history(wt_layer_energy_fn energy, void *user,
                                    const wt_layer_feedback *loop, const double *time, size_t n,
                                    wt_layer_point *points, wt_error *err)
{
    if (energy == NULL || loop == NULL || (n > 0 && (time == NULL || points == NULL)))
        return wt_fail(err, WT_E_ARG, "a layer with feedback needs its roots and times");
    wt_status status = layer_times_check(time, n, err);
    if (status != WT_OK)
        return status;
    loop_search s = {.energy = energy, .user = user, .err = err};
    const loop_point bare = compute_loop_point(&s, 0);
    const double target = target_thickness(loop);
    if (s.status != WT_OK)
        return s.status;
    if (!(target > 0)) {
        for (size_t i = 0; i < n; i++)
            points[i] = (wt_layer_point){time[i], {.unit = "m"}, bare.formation, bare.wear};
        if (!(loop->ratio > 1) || loop->n_roots > 0)
            return WT_OK;
        wt_fail(err, WT_E_RANGE, "a layer with feedback grows beyond the longest waves");
        wt_error_expected(err, "a balance below %.3g um", 1e6 * loop->high);
        wt_error_found(err, "none, with R = %.3g on a bare surface", loop->ratio);
        wt_error_advice(err, "without wear, or with little, it has no balance: leave out feedback");
        return WT_E_RANGE;
    }
    feedback_rate *feedback = wt_alloc(1, sizeof *feedback);
    formation_search o = {&s, bare.wear};
    status = feedback_rate_create(compute_log_formation, &o, 1 / bare.q_max, target, feedback, err);
    if (status == WT_OK)
        status = s.status;
    layer_rates rates = {.feedback = feedback,
                         .q_min = 1 / target,
                         .q_max = bare.q_max,
                         .formation = bare.formation,
                         .wear = bare.wear,
                         .log_ratio = log(bare.formation / bare.wear)};
    if (status == WT_OK)
        status = integrate_feedback_history(&s, &rates, time, n, points, err);
    feedback_rate_clear(feedback);
    free(feedback);
    return status;
}
