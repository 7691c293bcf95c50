/* Simulation of force curves from their own fits (parametric bootstrap). The simulation uses a tip
 * that enters and leaves a viscoelastic half-space (indentation/law/hereditary.h). The fit uses a
 * simpler model.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/curve_set.h"
#include "job/random_draws.h"

#include "core/base/array.h"
#include "core/data/force_curve.h"
#include "indentation/law/hereditary.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Upper limit of the samples that one replicate fits in about a second. */
#define MAX_SIMULATED_SAMPLES ((size_t)1 << 20)

enum { APPROACH, RETRACT, BRANCHES };

typedef struct stored_curve {
    wt_indent_fit fit;
    double spring_constant;
    size_t n[BRANCHES];
    double *position[BRANCHES]; /* [m]; rises on approach, falls on retract */
    double *time[BRANCHES]; /* [s]; the times of the retract continue those of the approach; NULL if
                           not known */
    double *block;
} stored_curve;

struct wt_curve_set {
    wt_tip tip;
    wt_indent_options options;
    double temperature;
    stored_curve *curves;
    size_t n, samples;
    bool is_unusable;
};

wt_curve_set *wt_curve_set_new(void)
{
    return calloc(1, sizeof(wt_curve_set));
}

static void clear_curves(wt_curve_set *set)
{
    for (size_t i = 0; i < set->n; i++)
        free(set->curves[i].block);
    free(set->curves);
    set->curves = NULL;
    set->n = 0;
}

void wt_curve_set_free(wt_curve_set *set)
{
    if (set == NULL)
        return;
    clear_curves(set);
    free(set);
}

wt_status curve_set_mark_unusable(wt_curve_set *set)
{
    clear_curves(set);
    set->is_unusable = true;
    return WT_OK;
}

size_t curve_set_size(const wt_curve_set *set)
{
    return set != NULL && !set->is_unusable ? set->n : 0;
}

const wt_tip *curve_set_tip(const wt_curve_set *set)
{
    return &set->tip;
}

double curve_set_temperature(const wt_curve_set *set)
{
    return set->temperature;
}

bool curve_set_has_spectrum(const wt_curve_set *set)
{
    for (size_t i = 0; i < set->n; i++)
        if (!(set->curves[i].fit.spectrum_factor.value > 0))
            return false;
    return set->n > 0;
}

static double estimate_relative_error(wt_estimate e)
{
    return e.standard_error / e.value;
}

double curve_set_variance(const wt_curve_set *set)
{
    double sum = 0;
    for (size_t i = 0; i < set->n; i++)
        sum += pow(estimate_relative_error(set->curves[i].fit.modulus), 2);
    return sum / (double)set->n;
}

/* ---- storing --------------------------------------------------------------------------------- */

void curve_set_begin(wt_curve_set *set, const wt_indent_job *job)
{
    clear_curves(set);
    *set = (wt_curve_set){
        .tip = job->tip, .options = job->options, .temperature = job->temperature.value};
    set->options.spectrum = NULL;
}

/* Stores sorted positions, because the noise of the height is not noise of the piezo, and times.
 * Returns the number of samples, or 0 if the branch has no height. */
static size_t store_branch(const wt_segment *segment, double direction, double *position,
                           double *time, bool *timed)
{
    const double *height = segment != NULL ? segment_height(segment) : NULL;
    const double *at = height != NULL ? segment_time(segment, time) : NULL;
    size_t n = 0;
    *timed = at != NULL;
    for (size_t i = 0; height != NULL && i < segment->n_points; i++) {
        if (!isfinite(height[i]))
            continue;
        position[n] = direction * height[i];
        if (at != NULL)
            time[n] = at[i];
        if (at != NULL && n > 0 && !(time[n] > time[n - 1]))
            *timed = false;
        n++;
    }
    numbers_sort(position, n);
    return n;
}

/* Shifts the times of the retract so that it begins one step after the approach ends. */
static void join_times(stored_curve *k)
{
    const size_t n = k->n[APPROACH];
    if (k->n[RETRACT] == 0)
        return;
    const double shift =
        2 * k->time[APPROACH][n - 1] - k->time[APPROACH][n - 2] - k->time[RETRACT][0];
    for (size_t i = 0; i < k->n[RETRACT]; i++)
        k->time[RETRACT][i] += shift;
}

static bool has_relaxation(const wt_indent_fit *fit)
{
    return fit->spectrum_factor.value > 0 || fit->loss_power > 0;
}

wt_status curve_set_add(wt_curve_set *set, const wt_force_curve *curve, const wt_indent_fit *fit,
                        wt_error *err)
{
    const wt_segment *branch[BRANCHES] = {wt_force_curve_segment(curve, WT_SEGMENT_APPROACH),
                                          wt_force_curve_segment(curve, WT_SEGMENT_RETRACT)};
    const size_t n[BRANCHES] = {branch[APPROACH] != NULL ? branch[APPROACH]->n_points : 0,
                                branch[RETRACT] != NULL ? branch[RETRACT]->n_points : 0};
    set->samples += n[APPROACH] + n[RETRACT];
    set->is_unusable =
        set->is_unusable || set->samples > MAX_SIMULATED_SAMPLES || fit->work_of_adhesion.value > 0;
    if (set->is_unusable) {
        clear_curves(set);
        return WT_OK;
    }
    stored_curve *curves = array_grow(set->curves, set->n, sizeof *curves);
    double *block = malloc(2 * (n[APPROACH] + n[RETRACT] + 1) * sizeof *block), *next = block;
    if (curves != NULL)
        set->curves = curves;
    if (curves == NULL || block == NULL) {
        free(block);
        return wt_fail(err, WT_E_MEMORY, "out of memory for the curves");
    }
    stored_curve *k = &curves[set->n++];
    *k = (stored_curve){
        .fit = *fit, .spring_constant = curve->cantilever.spring_constant, .block = block};
    bool timed[BRANCHES];
    for (int w = 0; w < BRANCHES; w++) {
        k->position[w] = next;
        k->time[w] = next + n[w];
        next += 2 * n[w];
        k->n[w] = store_branch(branch[w], fit->direction, k->position[w], k->time[w], &timed[w]);
    }
    numbers_reverse(k->position[RETRACT], k->n[RETRACT]);
    if (timed[APPROACH] && (timed[RETRACT] || k->n[RETRACT] == 0) && k->n[APPROACH] > 1)
        join_times(k);
    else if (has_relaxation(fit))
        set->is_unusable = true;
    else
        k->time[APPROACH] = k->time[RETRACT] = NULL;
    return WT_OK;
}

/* ---- one curve ------------------------------------------------------------------------------- */

struct curve_scratch {
    wt_indent_workspace *workspace;
    hereditary law;
    double *force[BRANCHES];             /* forces of the samples */
    double *base, *time, *contact_force; /* samples in contact, both branches */
    double *block;
};

curve_scratch *curve_scratch_new(const wt_curve_set *const sets[2])
{
    size_t most = 1;
    curve_scratch *s = calloc(1, sizeof *s);
    if (s == NULL)
        return NULL;
    for (int g = 0; g < 2; g++)
        for (size_t i = 0; i < curve_set_size(sets[g]); i++) {
            const stored_curve *k = &sets[g]->curves[i];
            most = k->n[APPROACH] + k->n[RETRACT] > most ? k->n[APPROACH] + k->n[RETRACT] : most;
        }
    s->workspace = wt_indent_workspace_new();
    s->block = malloc(4 * (most + 2) * sizeof *s->block);
    if (s->workspace == NULL || s->block == NULL) {
        curve_scratch_free(s);
        return NULL;
    }
    s->base = s->block;
    s->time = s->base + most + 2;
    s->contact_force = s->time + most + 2;
    s->force[APPROACH] = s->contact_force + most + 2;
    return s;
}

void curve_scratch_free(curve_scratch *s)
{
    if (s == NULL)
        return;
    wt_indent_workspace_free(s->workspace);
    hereditary_clear(&s->law);
    free(s->block);
    free(s);
}

/* Collects the samples in contact after the moment of contact. `first` receives the first sample of
 * each branch. */
static size_t collect_contact_samples(const stored_curve *k, curve_scratch *s,
                                      size_t first[BRANCHES])
{
    const double contact = k->fit.contact_point.value, *x = k->position[APPROACH];
    size_t n = 0, i = 0;
    while (i < k->n[APPROACH] && !(x[i] > contact))
        i++;
    first[APPROACH] = i;
    first[RETRACT] = 0;
    const double step = i > 0 ? (contact - x[i - 1]) / (x[i] - x[i - 1]) : 0;
#define SAMPLE_TIME(w, i)                                                                          \
    (k->time[w] != NULL ? k->time[w][i] : (double)((w) == APPROACH ? (i) : k->n[APPROACH] + (i)))
    const double before = i > 0 ? SAMPLE_TIME(APPROACH, i - 1) : SAMPLE_TIME(APPROACH, 0) - 1;
    s->base[n] = 0;
    s->time[n++] =
        i < k->n[APPROACH] ? before + step * (SAMPLE_TIME(APPROACH, i) - before) : before;
    for (int w = 0; w < BRANCHES; w++)
        for (i = first[w]; i < k->n[w] && k->position[w][i] > contact; i++) {
            s->base[n] = k->position[w][i] - contact;
            s->time[n++] = SAMPLE_TIME(w, i);
        }
#undef SAMPLE_TIME
    return n;
}

/* Prepares the relaxation series with the moduli of the simulated curve. */
static wt_status begin_hereditary_law(const wt_curve_set *set, const stored_curve *k, double level,
                                      const wt_prony *true_spectrum, size_t n, curve_scratch *s,
                                      wt_error *err)
{
    const double reduced = 1 - set->options.poisson_ratio * set->options.poisson_ratio;
    const wt_prony elastic = {.equilibrium_modulus = 1};
    const wt_prony *series = &elastic;
    double scale = level / reduced, shortest = (double)INFINITY;
    curve_power power;
    if (k->fit.spectrum_factor.value > 0 && true_spectrum != NULL) {
        series = true_spectrum;
    } else if (k->fit.loss_power > 0) {
        curve_power_create(&power, k->fit.loss_power, k->fit.load_time);
        scale /= (1 + k->fit.loss_shift) * hereditary_modulus(&power.series, 1 / k->fit.load_time);
        series = &power.series;
    }
    for (size_t i = 1; i < n; i++)
        shortest = fmin(shortest, s->time[i] - s->time[i - 1]);
    const wt_status status = hereditary_reserve(&s->law, series->n, err);
    if (status == WT_OK)
        hereditary_begin(&s->law, series, scale, shortest, s->time[n - 1] - s->time[0]);
    return status;
}

/* Computes the simulated forces: baseline, contact force and noise. The ratio of slow to fast noise
 * is that of the measured curve. */
static void simulate_forces(const stored_curve *k, const size_t first[BRANCHES], size_t n,
                            uint64_t seed, size_t curve_index, curve_scratch *s)
{
    const wt_indent_fit *fit = &k->fit;
    const double length = fit->correlation_length > 1 ? fit->correlation_length : 1;
    const double correlation = (length - 1) / (length + 1),
                 innovation = sqrt(1 - correlation * correlation);
    size_t at = 1, draw = 0;
    double noise = 0;
    s->force[RETRACT] = s->force[APPROACH] + k->n[APPROACH];
    for (int w = 0; w < BRANCHES; w++)
        for (size_t i = 0; i < k->n[w]; i++) {
            const double x = k->position[w][i] - fit->contact_point.value;
            const double z = flow_draw_normal(seed, (curve_index << 24) + draw++, FLOW_DRAW_FORCE);
            noise = draw == 1 ? z : correlation * noise + innovation * z;
            s->force[w][i] =
                fit->baseline_offset.value + fit->baseline_tilt.value * x + fit->noise * noise;
            if (i >= first[w] && x > 0 && at < n)
                s->force[w][i] += s->contact_force[at++];
        }
}

wt_status curve_set_simulate_fit(const wt_curve_set *set, size_t i, double level,
                                 const wt_prony *true_spectrum, const wt_prony *fitted_spectrum,
                                 const wt_contact_table *contact, uint64_t seed, curve_scratch *s,
                                 simulated_fit *result, wt_error *err)
{
    const stored_curve *k = &set->curves[i];
    wt_indent_options options = set->options;
    wt_indent_fit fit;
    size_t first[BRANCHES];
    const size_t n = collect_contact_samples(k, s, first);
    wt_status status = begin_hereditary_law(set, k, level, true_spectrum, n, s, err);
    if (status == WT_OK)
        status = hereditary_loop(&s->law, contact, 1 / k->spring_constant, s->time, s->base, n,
                                 s->contact_force, err);
    if (status != WT_OK)
        return status;
    simulate_forces(k, first, n, seed, i, s);
    options.spectrum = fitted_spectrum;
    const curve_branch in = {k->position[APPROACH], s->force[APPROACH], k->time[APPROACH],
                             k->n[APPROACH]},
                       out = {k->position[RETRACT], s->force[RETRACT], k->time[RETRACT],
                              k->n[RETRACT]};
    status = curve_fit_branches(contact, &options, &in, &out, k->spring_constant, s->workspace,
                                &fit, err);
    if (status != WT_OK)
        return status;
    const wt_estimate found = fitted_spectrum != NULL ? fit.spectrum_factor : fit.modulus;
    *result = (simulated_fit){
        .accepted = wt_curve_verdict_is_usable(fit.verdict) && found.value > 0,
        .level = found.value,
        .log_level = {log(found.value / level), estimate_relative_error(found), 0, "1"},
        .contact_point = fit.contact_point};
    result->contact_point.value -= k->fit.contact_point.value;
    return WT_OK;
}
