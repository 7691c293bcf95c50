/* Likelihood of autocorrelated scatter by a Kalman filter, and averages over the laws. Harvey,
 * Forecasting, structural time series models and the Kalman filter (1989), chapter 3.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/autocorrelation.h"

#include "weartrack/core.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <stdlib.h>

static const double shortest = 0.5; /* [steps] */
/* denser near 0 and 1, where a small white or slow part has a large effect */
static const double shares[SCATTER_SHARES] = {0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 1};

/* Prior of the laws: longest correlation length as a share of the series, and relative weights of
 * the shares. For a change, white scatter has the weight of all other shares. For a mean, the
 * weights are 4 (white), 1 (all slow) and 1 (partly slow, by share (1 - share) and spacing). */
static const struct {
    double longest, likely[SCATTER_SHARES];
} expected[] = {
    [SCATTER_FOR_CHANGE] = {0.25, {9, 1, 1, 1, 1, 1, 1, 1, 1, 1}},
    [SCATTER_FOR_MEAN] = {1, {4000, 3, 12, 42, 148, 296, 297, 173, 29, 1000}},
};

scatter_law scatter_law_at(scatter_purpose use, size_t i, size_t n)
{
    const double most = fmax(expected[use].longest * (double)n, 2 * shortest),
                 part = (double)(i / SCATTER_SHARES) / (SCATTER_LENGTHS - 1);
    const double length = shortest * pow(most / shortest, part);
    return (scatter_law){exp(-1 / length), shares[i % SCATTER_SHARES]};
}

double scatter_prior(scatter_purpose use, size_t i)
{
    const double *const likely = expected[use].likely;
    double all = 0;
    for (size_t k = 0; k < SCATTER_SHARES; k++)
        all += likely[k];
    return log(likely[i % SCATTER_SHARES] / all / SCATTER_LENGTHS);
}

scatter_sums scatter_begin(scatter_law law)
{
    return (scatter_sums){.law = law, .variance = law.share};
}

void scatter_add(scatter_sums *s, double y)
{
    scatter_add_column(s, (double)s->n, y);
}

void scatter_add_column(scatter_sums *s, double column, double y)
{
    const double value[3] = {1, column, y};
    double off[3];
    if (s->n == 0 || s->variance < s->set_at || s->variance > s->set_at) {
        const double spread = s->variance + (1 - s->law.share);
        s->set_at = s->variance;
        s->gain = s->variance / spread;
        s->weight = 1 / spread;
        s->log_spread = log(spread);
    }
    for (int i = 0; i < 3; i++) {
        off[i] = value[i] - s->state[i];
        s->state[i] = s->law.memory * (s->state[i] + s->gain * off[i]);
    }
    const double first = s->weight * off[0], second = s->weight * off[1];
    s->product[0] += first * off[0];
    s->product[1] += first * off[1];
    s->product[2] += second * off[1];
    s->product[3] += first * off[2];
    s->product[4] += second * off[2];
    s->product[5] += s->weight * off[2] * off[2];
    s->log_det += s->log_spread;
    s->variance = s->law.memory * s->law.memory * s->variance * (1 - s->gain) +
                  s->law.share * (1 - s->law.memory * s->law.memory);
    s->n++;
}

scatter_fit scatter_solve(const scatter_sums *s, bool line)
{
    const double *const p = s->product;
    const double mean = p[3] / p[0], about = p[5] - p[3] * mean;
    if (!line)
        return (scatter_fit){about, log(p[0]), mean, 1 / p[0]};
    const double tt = p[2] - p[1] * p[1] / p[0], slope = (p[4] - p[1] * mean) / tt;
    return (scatter_fit){about - slope * slope * tt, log(p[0]) + log(tt), slope, 1 / tt};
}

/* log_unit: ln of the squared unit of the second column. */
static double marginal_log_likelihood(const scatter_sums *s, bool line, double least,
                                      double log_unit)
{
    const scatter_fit f = scatter_solve(s, line);
    const double df = (double)s->n - (line ? 2 : 1);
    const double squares = fmax(f.squares, df * least);
    const double information = f.log_information - log_unit;
    return gsl_sf_lngamma(df / 2) - 0.5 * (df * log(M_PI * squares) + s->log_det + information);
}

double scatter_likelihood(const scatter_sums *s, bool line, double least)
{
    /* the slope is taken over the whole series, so that its unit does not depend on the number of
     * points */
    return marginal_log_likelihood(s, line, least, line ? 2 * log((double)s->n) : 0);
}

double scatter_profile_likelihood(const scatter_sums *s, double least)
{
    return marginal_log_likelihood(s, true, least, 0);
}

double scatter_mean_variance(scatter_law law, size_t n)
{
    const double r = law.memory, m = (double)n;
    const double slow =
        (m * (1 + r) / (1 - r) - 2 * r * (1 - pow(r, m)) / ((1 - r) * (1 - r))) / (m * m);
    return law.share * slow + (1 - law.share) / m;
}

double scatter_total_variance(const double *y, size_t n)
{
    double mean = 0, sum = 0;
    for (size_t i = 0; i < n; i++)
        mean += y[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        sum += (y[i] - mean) * (y[i] - mean);
    return sum / (double)n;
}

scatter_batches scatter_batch(const double *y, size_t n, double **room)
{
    const size_t length = (n + SCATTER_MAX_BATCHES - 1) / SCATTER_MAX_BATCHES;
    *room = NULL;
    if (length <= 1)
        return (scatter_batches){y, n, 1, 0};
    scatter_batches parts = {NULL, n / length, length, n % length};
    parts.y = *room = wt_alloc(parts.n, sizeof **room);
    for (size_t i = 0; i < parts.n * length; i++)
        (*room)[i / length] += y[parts.rest + i] / (double)length;
    return parts;
}

double log_add(double a, double b)
{
    const double large = fmax(a, b);
    return isinf(large) ? large : large + log1p(exp(fmin(a, b) - large));
}

void mixture_add(t_mixture *m, double log_weight, double df, double centre, double scale)
{
    m->log_weight[m->n] = log_weight;
    m->df[m->n] = df;
    m->centre[m->n] = centre;
    m->scale[m->n++] = scale;
}

void mixture_normalise(t_mixture *m)
{
    double all = -(double)INFINITY;
    for (size_t i = 0; i < m->n; i++)
        all = log_add(all, m->log_weight[i]);
    for (size_t i = 0; i < m->n; i++)
        m->log_weight[i] -= all;
}

double mixture_mean(const t_mixture *m)
{
    double sum = 0;
    for (size_t i = 0; i < m->n; i++)
        sum += exp(m->log_weight[i]) * m->centre[i];
    return sum;
}

/* Approximate distance of the tails, for any degrees of freedom. */
static double mixture_width(const t_mixture *m)
{
    const double mean = mixture_mean(m);
    double sum = 0;
    for (size_t i = 0; i < m->n; i++) {
        const double off = m->centre[i] - mean;
        sum += exp(m->log_weight[i]) * (m->scale[i] * m->scale[i] + off * off);
    }
    return 2 * sqrt(sum);
}

static double mixture_distribution(const t_mixture *m, double x)
{
    double sum = 0;
    for (size_t i = 0; i < m->n; i++)
        if (m->log_weight[i] > -40) /* smaller weights are below the rounding of the sum */
            sum +=
                exp(m->log_weight[i]) * gsl_cdf_tdist_P((x - m->centre[i]) / m->scale[i], m->df[i]);
    return sum;
}

double mixture_quantile(const t_mixture *m, double p)
{
    enum { DOUBLINGS = 60, HALVINGS = 34 }; /* to 1e-10 of the width */
    const double centre = mixture_mean(m);
    double step = mixture_width(m);
    step = step > 0 ? step : fabs(centre) + 1;
    double low = centre - step, high = centre + step;
    for (int i = 0; i < DOUBLINGS && mixture_distribution(m, low) > p; i++)
        low = centre - (step *= 2);
    for (int i = 0; i < DOUBLINGS && mixture_distribution(m, high) < p; i++)
        high = centre + (step *= 2);
    for (int i = 0; i < HALVINGS && low < high; i++) {
        const double middle = 0.5 * (low + high);
        if (mixture_distribution(m, middle) < p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}
