/* Mean and drift of a steady-state series with autocorrelated scatter.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/autocorrelation.h"

#include "core/math/normal_quantile.h"
#include "core/math/students_t.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

enum { FEWEST = 4 }; /* two more than the constants of a line */
/* Relative to the mean: rounding errors of equal samples. */
static const double rounding = 1e-12;
static const double tail = 0.025; /* on each side of a 95 % interval */
/* Fewer independent points do not determine their scatter. */
static const double least_independent = 8;
/* Prior odds of a drift. With even odds, slow scatter passes for a drift and the coverage falls by
 * up to 4 %. With none, a drift passes for slow scatter and triples the error of white scatter. The
 * second value is the squared end-to-end change of a drift that is all of the variance, in units of
 * it. */
static const double drift_odds = 0.1, whole_change = 12;

static wt_interval mixture_interval(const t_mixture *m)
{
    const double low = mixture_quantile(m, tail), high = mixture_quantile(m, 1 - tail);
    return (wt_interval){mixture_mean(m), (high - low) / (2 * NORMAL_95), low, high};
}

/* Interval of laws with one centre, which is symmetric. */
static wt_interval symmetric_interval(const t_mixture *m, double centre)
{
    const double high = mixture_quantile(m, 1 - tail);
    return (wt_interval){centre, (high - centre) / NORMAL_95, 2 * centre - high, high};
}

/* Adds one law, about a constant and about a line: a drift is not scatter. */
static void add_steady_law(const scatter_batches *parts, moments m, size_t i, t_mixture *mean,
                           t_mixture *drift)
{
    const double least = SCATTER_RESOLUTION * SCATTER_RESOLUTION * m.variance, n = (double)parts->n,
                 length = (double)parts->length, prior = scatter_prior(SCATTER_FOR_MEAN, i);
    scatter_sums s = scatter_begin(scatter_law_at(SCATTER_FOR_MEAN, i, parts->n));
    for (size_t k = 0; k < parts->n; k++)
        scatter_add(&s, parts->y[k] - m.mean);
    const scatter_fit constant = scatter_solve(&s, false), line = scatter_solve(&s, true);
    const double of_mean = scatter_mean_variance(s.law, parts->n),
                 about_constant = fmax(constant.squares / (n - 1), least),
                 about_line = fmax(line.squares / (n - 2), least),
                 line_weight = prior + scatter_likelihood(&s, true, least);
    mixture_add(mean, prior + scatter_likelihood(&s, false, least), n - 1, m.mean,
                sqrt(about_constant * of_mean));
    mixture_add(mean,
                line_weight + log(drift_odds) - 0.5 * log(2 * M_PI * whole_change * m.variance),
                n - 2, m.mean, sqrt(about_line * of_mean));
    mixture_add(drift, line_weight, n - 2, line.coefficient / length,
                sqrt(about_line * line.variance) / length);
}

/* Mean, drift and correlation averaged over all laws with their probabilities. */
static void average_laws(const scatter_batches *parts, moments m, wt_steady *steady)
{
    t_mixture mean = {.n = 0}, drift = {.n = 0};
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        add_steady_law(parts, m, i, &mean, &drift);
    mixture_normalise(&mean);
    mixture_normalise(&drift);
    steady->mean = symmetric_interval(&mean, m.mean);
    steady->drift = mixture_interval(&drift);
    steady->correlation = 0;
    for (size_t i = 0; i < mean.n; i++)
        steady->correlation +=
            exp(mean.log_weight[i]) * mean.scale[i] * mean.scale[i] * m.n / m.variance;
    steady->note = m.n < least_independent * steady->correlation
                       ? "the record is short against the correlation of its scatter"
                       : "";
}

wt_status wt_steady_mean(const double *y, size_t n, wt_steady *steady, wt_error *err)
{
    const double none = (double)NAN;
    const wt_interval unknown = {none, none, none, none};
    *steady = (wt_steady){.n = n,
                          .mean = unknown,
                          .drift = unknown,
                          .deviation = none,
                          .min = none,
                          .max = none,
                          .correlation = none,
                          .note = "too few cycles for an error"};
    if (n == 0)
        return wt_fail(err, WT_E_ARG, "a mean of nothing");
    const moments m = sample_moments(y, n);
    steady->mean.value = m.mean;
    steady->deviation = sqrt(m.variance);
    steady->min = steady->max = y[0];
    for (size_t i = 0; i < n; i++) {
        steady->min = fmin(steady->min, y[i]);
        steady->max = fmax(steady->max, y[i]);
    }
    if (n >= FEWEST && !(steady->deviation > rounding * fabs(m.mean)))
        steady->note = "the cycles do not scatter, which tells no error";
    if (n < FEWEST || !(steady->deviation > rounding * fabs(m.mean)))
        return WT_OK;
    double *scratch;
    const scatter_batches parts = scatter_batch(y, n, &scratch);
    average_laws(&parts, m, steady);
    free(scratch);
    return WT_OK;
}
