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
#define MOST_SAMPLES ((size_t)1 << 20)

enum { IN, OUT, WAYS };

typedef struct stored_curve {
    wt_indent_fit fit;
    double spring_constant;
    size_t n[WAYS];
    double *position[WAYS]; /* [m]; rises on approach, falls on retract */
    double *time[WAYS]; /* [s]; the times of the retract continue those of the approach; NULL if not
                           known */
    double *block;
} stored_curve;

struct wt_curve_set {
    wt_tip tip;
    wt_indent_options options;
    double temperature;
    stored_curve *curves;
    size_t n, samples;
    bool useless;
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

wt_status curve_set_give_up(wt_curve_set *set)
{
    clear_curves(set);
    set->useless = true;
    return WT_OK;
}

size_t curve_set_size(const wt_curve_set *set)
{
    return set != NULL && !set->useless ? set->n : 0;
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

static double relative_error(wt_estimate e)
{
    return e.standard_error / e.value;
}

double curve_set_variance(const wt_curve_set *set)
{
    double sum = 0;
    for (size_t i = 0; i < set->n; i++)
        sum += pow(relative_error(set->curves[i].fit.modulus), 2);
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
static size_t keep_way(const wt_segment *segment, double direction, double *position, double *time,
                       bool *timed)
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
    const size_t n = k->n[IN];
    if (k->n[OUT] == 0)
        return;
    const double shift = 2 * k->time[IN][n - 1] - k->time[IN][n - 2] - k->time[OUT][0];
    for (size_t i = 0; i < k->n[OUT]; i++)
        k->time[OUT][i] += shift;
}

static bool has_memory(const wt_indent_fit *fit)
{
    return fit->spectrum_factor.value > 0 || fit->loss_power > 0;
}

wt_status curve_set_add(wt_curve_set *set, const wt_force_curve *curve, const wt_indent_fit *fit,
                        wt_error *err)
{
    const wt_segment *way[WAYS] = {wt_force_curve_segment(curve, WT_SEGMENT_APPROACH),
                                   wt_force_curve_segment(curve, WT_SEGMENT_RETRACT)};
    const size_t n[WAYS] = {way[IN] != NULL ? way[IN]->n_points : 0,
                            way[OUT] != NULL ? way[OUT]->n_points : 0};
    set->samples += n[IN] + n[OUT];
    set->useless = set->useless || set->samples > MOST_SAMPLES || fit->work_of_adhesion.value > 0;
    if (set->useless) {
        clear_curves(set);
        return WT_OK;
    }
    stored_curve *curves = array_grow(set->curves, set->n, sizeof *curves);
    double *block = malloc(2 * (n[IN] + n[OUT] + 1) * sizeof *block), *next = block;
    if (curves != NULL)
        set->curves = curves;
    if (curves == NULL || block == NULL) {
        free(block);
        return wt_fail(err, WT_E_MEMORY, "out of memory for the curves");
    }
    stored_curve *k = &curves[set->n++];
    *k = (stored_curve){
        .fit = *fit, .spring_constant = curve->cantilever.spring_constant, .block = block};
    bool timed[WAYS];
    for (int w = 0; w < WAYS; w++) {
        k->position[w] = next;
        k->time[w] = next + n[w];
        next += 2 * n[w];
        k->n[w] = keep_way(way[w], fit->direction, k->position[w], k->time[w], &timed[w]);
    }
    numbers_reverse(k->position[OUT], k->n[OUT]);
    if (timed[IN] && (timed[OUT] || k->n[OUT] == 0) && k->n[IN] > 1)
        join_times(k);
    else if (has_memory(fit))
        set->useless = true;
    else
        k->time[IN] = k->time[OUT] = NULL;
    return WT_OK;
}

/* ---- one curve ------------------------------------------------------------------------------- */

struct curve_scratch {
    wt_indent_workspace *workspace;
    hereditary law;
    double *force[WAYS];        /* forces of the samples */
    double *base, *time, *push; /* samples in contact, both branches */
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
            most = k->n[IN] + k->n[OUT] > most ? k->n[IN] + k->n[OUT] : most;
        }
    s->workspace = wt_indent_workspace_new();
    s->block = malloc(4 * (most + 2) * sizeof *s->block);
    if (s->workspace == NULL || s->block == NULL) {
        curve_scratch_free(s);
        return NULL;
    }
    s->base = s->block;
    s->time = s->base + most + 2;
    s->push = s->time + most + 2;
    s->force[IN] = s->push + most + 2;
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
static size_t in_contact(const stored_curve *k, curve_scratch *s, size_t first[WAYS])
{
    const double contact = k->fit.contact_point.value, *x = k->position[IN];
    size_t n = 0, i = 0;
    while (i < k->n[IN] && !(x[i] > contact))
        i++;
    first[IN] = i;
    first[OUT] = 0;
    const double step = i > 0 ? (contact - x[i - 1]) / (x[i] - x[i - 1]) : 0;
#define TIME(w, i) (k->time[w] != NULL ? k->time[w][i] : (double)((w) == IN ? (i) : k->n[IN] + (i)))
    const double before = i > 0 ? TIME(IN, i - 1) : TIME(IN, 0) - 1;
    s->base[n] = 0;
    s->time[n++] = i < k->n[IN] ? before + step * (TIME(IN, i) - before) : before;
    for (int w = 0; w < WAYS; w++)
        for (i = first[w]; i < k->n[w] && k->position[w][i] > contact; i++) {
            s->base[n] = k->position[w][i] - contact;
            s->time[n++] = TIME(w, i);
        }
#undef TIME
    return n;
}

/* Prepares the relaxation series with the moduli of the simulated curve. */
static wt_status begin_law(const wt_curve_set *set, const stored_curve *k, double level,
                           const wt_prony *made, size_t n, curve_scratch *s, wt_error *err)
{
    const double reduced = 1 - set->options.poisson_ratio * set->options.poisson_ratio;
    const wt_prony elastic = {.equilibrium_modulus = 1};
    const wt_prony *series = &elastic;
    double scale = level / reduced, shortest = (double)INFINITY;
    curve_power power;
    if (k->fit.spectrum_factor.value > 0 && made != NULL) {
        series = made;
    } else if (k->fit.loss_power > 0) {
        curve_power_make(&power, k->fit.loss_power, k->fit.load_time);
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
static void add_noise(const stored_curve *k, const size_t first[WAYS], size_t n, uint64_t seed,
                      size_t place, curve_scratch *s)
{
    const wt_indent_fit *fit = &k->fit;
    const double length = fit->correlation_length > 1 ? fit->correlation_length : 1;
    const double kept = (length - 1) / (length + 1), rest = sqrt(1 - kept * kept);
    size_t at = 1, draw = 0;
    double noise = 0;
    s->force[OUT] = s->force[IN] + k->n[IN];
    for (int w = 0; w < WAYS; w++)
        for (size_t i = 0; i < k->n[w]; i++) {
            const double x = k->position[w][i] - fit->contact_point.value;
            const double z = flow_draw_normal(seed, (place << 24) + draw++, FLOW_DRAW_FORCE);
            noise = draw == 1 ? z : kept * noise + rest * z;
            s->force[w][i] =
                fit->baseline_offset.value + fit->baseline_tilt.value * x + fit->noise * noise;
            if (i >= first[w] && x > 0 && at < n)
                s->force[w][i] += s->push[at++];
        }
}

wt_status curve_set_try(const wt_curve_set *set, size_t i, double level, const wt_prony *made,
                        const wt_prony *fitted, const wt_contact_table *contact, uint64_t seed,
                        curve_scratch *s, curve_again *again, wt_error *err)
{
    const stored_curve *k = &set->curves[i];
    wt_indent_options options = set->options;
    wt_indent_fit fit;
    size_t first[WAYS];
    const size_t n = in_contact(k, s, first);
    wt_status status = begin_law(set, k, level, made, n, s, err);
    if (status == WT_OK)
        status = hereditary_loop(&s->law, contact, 1 / k->spring_constant, s->time, s->base, n,
                                 s->push, err);
    if (status != WT_OK)
        return status;
    add_noise(k, first, n, seed, i, s);
    options.spectrum = fitted;
    const curve_branch in = {k->position[IN], s->force[IN], k->time[IN], k->n[IN]},
                       out = {k->position[OUT], s->force[OUT], k->time[OUT], k->n[OUT]};
    status = curve_fit_branches(contact, &options, &in, &out, k->spring_constant, s->workspace,
                                &fit, err);
    if (status != WT_OK)
        return status;
    const wt_estimate found = fitted != NULL ? fit.spectrum_factor : fit.modulus;
    *again = (curve_again){.accepted = wt_curve_usable(fit.verdict) && found.value > 0,
                           .level = found.value,
                           .log_level = {log(found.value / level), relative_error(found), 0, "1"},
                           .contact_point = fit.contact_point};
    again->contact_point.value -= k->fit.contact_point.value;
    return WT_OK;
}
