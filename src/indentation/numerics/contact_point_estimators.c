/* Contact points by estimators of other programs, for comparison with the fit. None of them fits
 * baseline, contact point and modulus together, and none has an error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include <math.h>

static const double baseline_share =
    0.1;                             /* share of the samples in the baseline of the threshold */
static const double threshold = 2.0; /* in largest deviations of the baseline */
static const size_t windows = 20;    /* number of windows; a variance covers one */
enum { LEAST_WINDOW = 5 };

static const char *const words[WT_CONTACT_ESTIMATORS] = {
    [WT_CONTACT_THRESHOLD] = "threshold of the baseline",
    [WT_CONTACT_VARIANCES] = "ratio of variances",
    [WT_CONTACT_LINES] = "meeting of two lines",
    [WT_CONTACT_DIRECT_PATH] = "distance from the direct path",
    [WT_CONTACT_GOODNESS_OF_FIT] = "goodness of fit"};

const char *wt_contact_estimator_text(wt_contact_estimator estimator)
{
    const size_t i = (size_t)estimator;
    return i < WT_CONTACT_ESTIMATORS ? words[i] : "unknown";
}

/* Weighted sums over a range of samples. */
typedef struct sums {
    double n, z, f, zz, zf, ff;
} sums;

static void add(sums *to, double z, double f, double sign)
{
    to->n += sign;
    to->z += sign * z;
    to->f += sign * f;
    to->zz += sign * z * z;
    to->zf += sign * z * f;
    to->ff += sign * f * f;
}

static double variance(const sums *s)
{
    return (s->ff - s->f * s->f / s->n) / s->n;
}

/* Returns the first sample whose force exceeds the baseline mean by twice the largest deviation, or
 * n without such a sample. */
static size_t by_threshold(const double *force, size_t n)
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
static size_t run_on(size_t run, double before, double now)
{
    return now < before || now > before ? 1 : run + 1;
}

/* Returns the sample with the largest ratio of the variances after and before it. The result is n
 * for constant forces of a coarse detector, because rounding would decide. */
static size_t by_variances(const double *force, size_t n)
{
    const size_t window = n / windows > LEAST_WINDOW ? n / windows : LEAST_WINDOW;
    sums before = {0}, behind = {0};
    double best = 0.0;
    size_t at = n, run = 0;
    for (size_t i = 0; i < window && 2 * window < n; i++) {
        run = i > 0 ? run_on(run, force[i - 1], force[i]) : 1;
        add(&before, 0.0, force[i], 1.0);
        add(&behind, 0.0, force[window + 1 + i], 1.0);
    }
    for (size_t i = window; i + window < n; i++) {
        if (run >= window)
            return n;
        const double ratio = variance(&behind) / variance(&before);
        if (ratio > best) {
            best = ratio;
            at = i;
        }
        run = run_on(run, force[i - 1], force[i]);
        if (i + window + 1 < n) {
            add(&before, 0.0, force[i], 1.0);
            add(&before, 0.0, force[i - window], -1.0);
            add(&behind, 0.0, force[i + window + 1], 1.0);
            add(&behind, 0.0, force[i + 1], -1.0);
        }
    }
    return at;
}

/* Returns the sample where a constant and a line meet with the least squares of the force. Height
 * and slope are linear parameters for each sample. */
static size_t by_lines(const double *position, const double *force, size_t n)
{
    sums all = {0}, behind = {0};
    double best = (double)INFINITY;
    size_t at = n;
    for (size_t i = 0; i < n; i++)
        add(&all, position[i], force[i], 1.0);
    for (size_t i = n; i-- > 1;) {
        add(&behind, position[i], force[i], 1.0);
        /* Sums of x = position - c after the sample; x is 0 before it. */
        const double c = position[i - 1], x = behind.z - c * behind.n,
                     xx = behind.zz - c * (2.0 * behind.z - c * behind.n),
                     xf = behind.zf - c * behind.f;
        const double free_xx = xx - x * x / all.n, free_xf = xf - x * all.f / all.n;
        const double left = free_xx > 0.0 && free_xf > 0.0 ? -free_xf * free_xf / free_xx : 0.0;
        if (left < best) {
            best = left;
            at = i - 1;
        }
    }
    return at;
}

/* Returns the sample farthest below the line from the first to the strongest force, with both axes
 * scaled to 1. */
static size_t by_direct_path(const double *force, size_t n)
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
    const size_t found[] = {[WT_CONTACT_THRESHOLD] = by_threshold(s->force, n),
                            [WT_CONTACT_VARIANCES] = by_variances(s->force, n),
                            [WT_CONTACT_LINES] = by_lines(s->position, s->force, n),
                            [WT_CONTACT_DIRECT_PATH] = by_direct_path(s->force, n)};
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
