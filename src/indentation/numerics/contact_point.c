/* Fit without adhesion from the scan of the contact point, and contact points by estimators of
 * other programs for comparison. None of these fits baseline, contact point and modulus together,
 * and none has an error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include <math.h>

/* ---- fit without adhesion -------------------------------------------------------------------- */

/* Fit without adhesion: scan of the contact point, refinement, and a viscoelastic refinement if
 * the spectrum of the rubber is known. */

static const double better_chi2 = 9.0; /* smallest 2 ln(likelihood ratio) against viscoelasticity */

/* Finds the times of the remaining samples, which are a subset of the measured ones in the same
 * order. Returns false unless the times rise. */
static bool match_sample_times(const curve_fitting *f)
{
    const curve_samples *s = &f->input.samples;
    const curve_branch *measured = f->approach;
    double *time = f->workspace->time;
    size_t i = 0;
    for (size_t j = 0; measured->time != NULL && j < measured->n && i < s->n; j++) {
        const double z = f->input.direction * measured->height[j] - f->input.position_origin,
                     force = measured->force[j] - f->input.force_origin;
        if (z - s->position[i] != 0.0 || force - f->workspace->force[i] != 0.0)
            continue;
        time[i] = measured->time[j];
        if (i > 0 && !(time[i] > time[i - 1]))
            return false;
        i++;
    }
    return i == s->n;
}

bool curve_prepare_relaxation(curve_fitting *f, const wt_prony *series, bool in_loading_times)
{
    wt_indent_workspace *w = f->workspace;
    const curve_samples *s = &f->input.samples;
    const size_t first = f->solution.first_contact;
    if (first < 1 || first + 1 >= s->n || !match_sample_times(f))
        return false;
    const double load = w->time[s->n - 1] - w->time[first - 1];
    double shortest = load;
    for (size_t i = 0; in_loading_times && i < s->n; i++)
        w->time[i] /= load;
    for (size_t i = first; i < s->n; i++)
        shortest = fmin(shortest, w->time[i] - w->time[i - 1]);
    f->unit = hereditary_modulus(series, in_loading_times ? 1.0 : 1.0 / load);
    hereditary_begin(&w->memory, series, 1.0 / f->unit, shortest, w->time[s->n - 1] - w->time[0]);
    return true;
}

/* Refits an elastic solution with the spectrum of the options if the times are known. A curve that
 * the elastic fit describes better has another spectrum. */
static void refit_with_spectrum(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    if (!curve_prepare_relaxation(f, f->options->spectrum, false))
        return;
    f->kind.memory = true;
    curve_refine(f->table, &f->input.samples, f->kind, elastic.p, f->workspace, &f->solution);
    f->spectrum_mismatch = elastic.effective_n * log(f->solution.cost / elastic.cost) > better_chi2;
    if (f->solution.converged && !f->spectrum_mismatch)
        return;
    f->kind.memory = false;
    f->solution = elastic;
}

bool curve_scan_and_refine(curve_fitting *f)
{
    const wt_indent_options *o = f->options;
    const curve_samples *s = &f->input.samples;
    bool fixed = !isnan(o->fixed_contact_point);
    if (fixed) {
        double c = o->fixed_contact_point - f->input.position_origin;
        if (!curve_scan_point(f->table, s, o->fit_tilt, c, f->workspace, &f->minima[0]))
            return false;
        f->n_minima = 1;
    } else {
        f->n_minima =
            curve_scan(f->table, s, o->fit_tilt, !o->plain_least_squares, f->workspace, f->minima);
        if (f->n_minima == 0)
            return false;
    }
    const curve_minimum *best = &f->minima[0];
    const double start[CURVE_N_PARAMETERS] = {best->reduced_modulus, best->contact_point,
                                              best->offset, best->tilt, 0.0};
    f->kind = (curve_kind){.tilt = o->fit_tilt,
                           .contact_fixed = fixed,
                           .plain = o->plain_least_squares,
                           .wave = f->kind.wave};
    curve_refine(f->table, s, f->kind, start, f->workspace, &f->solution);
    if (o->spectrum != NULL && !o->plain_least_squares)
        refit_with_spectrum(f);
    return true;
}

/* ---- estimators of other programs ------------------------------------------------------------ */

static const double baseline_share =
    0.1;                             /* share of the samples in the baseline of the threshold */
static const double threshold = 2.0; /* in largest deviations of the baseline */
static const size_t windows = 20;    /* number of windows; a variance covers one */
enum { LEAST_WINDOW = 5 };

static const char *const estimator_texts[WT_CONTACT_ESTIMATORS] = {
    [WT_CONTACT_THRESHOLD] = "threshold of the baseline",
    [WT_CONTACT_VARIANCES] = "ratio of variances",
    [WT_CONTACT_LINES] = "meeting of two lines",
    [WT_CONTACT_DIRECT_PATH] = "distance from the direct path",
    [WT_CONTACT_GOODNESS_OF_FIT] = "goodness of fit"};

const char *wt_contact_estimator_text(wt_contact_estimator estimator)
{
    const size_t i = (size_t)estimator;
    return i < WT_CONTACT_ESTIMATORS ? estimator_texts[i] : "unknown";
}

/* Weighted sums over a range of samples. */
typedef struct line_sums {
    double n, z, f, zz, zf, ff;
} line_sums;

static void add_sample(line_sums *to, double z, double f, double sign)
{
    to->n += sign;
    to->z += sign * z;
    to->f += sign * f;
    to->zz += sign * z * z;
    to->zf += sign * z * f;
    to->ff += sign * f * f;
}

static double sample_variance(const line_sums *s)
{
    return (s->ff - s->f * s->f / s->n) / s->n;
}

/* Returns the first sample whose force exceeds the baseline mean by twice the largest deviation, or
 * n without such a sample. */
static size_t threshold_index(const double *force, size_t n)
{
    const size_t first = (size_t)(baseline_share * (double)n);
    double mean = 0.0, most = 0.0;
    size_t i = first;
    for (size_t j = 0; j < first; j++)
        mean += force[j] / (double)first;
    for (size_t j = 0; j < first; j++)
        most = fmax(most, fabs(force[j] - mean));
    while (i < n && !(force[i] - mean > threshold * most))
        i++;
    return first > 0 ? i : n;
}

/* Returns the length of the run of equal forces after one more sample. */
static size_t next_run_length(size_t run, double before, double now)
{
    return now < before || now > before ? 1 : run + 1;
}

/* Returns the sample with the largest ratio of the variances after and before it. The result is n
 * for constant forces of a coarse detector, because rounding would decide. */
static size_t variance_ratio_index(const double *force, size_t n)
{
    const size_t window = n / windows > LEAST_WINDOW ? n / windows : LEAST_WINDOW;
    line_sums before = {0}, after = {0};
    double best = 0.0;
    size_t at = n, run = 0;
    for (size_t i = 0; i < window && 2 * window < n; i++) {
        run = i > 0 ? next_run_length(run, force[i - 1], force[i]) : 1;
        add_sample(&before, 0.0, force[i], 1.0);
        add_sample(&after, 0.0, force[window + 1 + i], 1.0);
    }
    for (size_t i = window; i + window < n; i++) {
        if (run >= window)
            return n;
        const double ratio = sample_variance(&after) / sample_variance(&before);
        if (ratio > best) {
            best = ratio;
            at = i;
        }
        run = next_run_length(run, force[i - 1], force[i]);
        if (i + window + 1 < n) {
            add_sample(&before, 0.0, force[i], 1.0);
            add_sample(&before, 0.0, force[i - window], -1.0);
            add_sample(&after, 0.0, force[i + window + 1], 1.0);
            add_sample(&after, 0.0, force[i + 1], -1.0);
        }
    }
    return at;
}

/* Returns the sample where a constant and a line meet with the least squares of the force. Height
 * and slope are linear parameters for each sample. */
static size_t two_lines_index(const double *position, const double *force, size_t n)
{
    line_sums all = {0}, after = {0};
    double best = (double)INFINITY;
    size_t at = n;
    for (size_t i = 0; i < n; i++)
        add_sample(&all, position[i], force[i], 1.0);
    for (size_t i = n; i-- > 1;) {
        add_sample(&after, position[i], force[i], 1.0);
        /* Sums of x = position - c after the sample; x is 0 before it. */
        const double c = position[i - 1], x = after.z - c * after.n,
                     xx = after.zz - c * (2.0 * after.z - c * after.n), xf = after.zf - c * after.f;
        const double free_xx = xx - x * x / all.n, free_xf = xf - x * all.f / all.n;
        const double residual_change =
            free_xx > 0.0 && free_xf > 0.0 ? -free_xf * free_xf / free_xx : 0.0;
        if (residual_change < best) {
            best = residual_change;
            at = i - 1;
        }
    }
    return at;
}

/* Returns the sample farthest below the line from the first to the strongest force, with both axes
 * scaled to 1. */
static size_t direct_path_index(const double *force, size_t n)
{
    double low = force[0], high = force[0], least = (double)INFINITY;
    size_t at = n;
    for (size_t i = 1; i < n; i++) {
        low = fmin(low, force[i]);
        high = fmax(high, force[i]);
    }
    for (size_t i = 0; i < n && high > low; i++) {
        const double below = (force[i] - low) / (high - low) - (double)i / (double)(n - 1);
        if (below < least) {
            least = below;
            at = i;
        }
    }
    return at;
}

void curve_estimate_contact(curve_fitting *f, double contact[WT_CONTACT_ESTIMATORS])
{
    const curve_samples *s = &f->input.samples;
    const double c = f->solution.p[CURVE_C];
    const size_t n = f->input.n_all - f->n_snap;
    curve_samples all = *s;
    curve_minimum minima[CURVE_MAX_MINIMA];
    const size_t found[] = {[WT_CONTACT_THRESHOLD] = threshold_index(s->force, n),
                            [WT_CONTACT_VARIANCES] = variance_ratio_index(s->force, n),
                            [WT_CONTACT_LINES] = two_lines_index(s->position, s->force, n),
                            [WT_CONTACT_DIRECT_PATH] = direct_path_index(s->force, n)};
    for (size_t i = 0; i < sizeof found / sizeof found[0]; i++) {
        const size_t j = found[i];
        const double above =
            j < n ? s->force[j] - curve_baseline(&f->solution, s->position[j]) : (double)NAN;
        contact[i] = j < n ? s->position[j] - above / s->spring_constant - c : (double)NAN;
    }
    all.n = n;
    all.gap_from = all.gap_to = 0;
    contact[WT_CONTACT_GOODNESS_OF_FIT] =
        curve_scan(f->table, &all, f->options->fit_tilt, false, f->workspace, minima) > 0
            ? minima[0].contact_point - c
            : (double)NAN;
}
