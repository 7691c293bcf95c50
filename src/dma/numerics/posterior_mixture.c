/* Intervals of mixtures of normal or Student distributions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/math/root.h"
#include "core/math/students_t.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* Distance from the means [standard deviations] at which a normal tail is below 1e-19, and one of
 * Student's t with two degrees of freedom below 1 %. */
static const double max_deviations = 9.0;

typedef struct mixture_level {
    const mixture_component *part;
    size_t n;
    double freedom, probability;
} mixture_level;

double mixture_probability(const mixture_component *part, size_t n, double freedom, double x)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double away = x - part[i].mean, scaled = away / part[i].deviation;
        sum += part[i].weight * (!(part[i].deviation > 0.0) ? (away >= 0.0 ? 1.0 : 0.0)
                                 : isinf(freedom)           ? gsl_cdf_ugaussian_P(scaled)
                                                            : gsl_cdf_tdist_P(scaled, freedom));
    }
    return sum;
}

static double excess_probability(double x, void *user)
{
    const mixture_level *l = user;
    return mixture_probability(l->part, l->n, l->freedom, x) - l->probability;
}

/* Newton steps to a quantile of normal distributions from that of one with the same mean and
 * deviation. Returns NaN if they do not converge. */
enum { MOST_STEPS = 20 };
static const double close_enough = 1e-6; /* [deviations]; the next step is its square */

static double normal_mixture_quantile(const mixture_level *l)
{
    double mean = 0.0, square = 0.0, step = HUGE_VAL;
    for (size_t i = 0; i < l->n; i++)
        mean += l->part[i].weight * l->part[i].mean;
    for (size_t i = 0; i < l->n; i++)
        square += l->part[i].weight * (l->part[i].deviation * l->part[i].deviation +
                                       (l->part[i].mean - mean) * (l->part[i].mean - mean));
    const double deviation = sqrt(square);
    double x = mean + deviation * (l->probability < 0.5 ? -NORMAL_95 : NORMAL_95);
    for (int k = 0; k < MOST_STEPS && fabs(step) > close_enough * deviation; k++) {
        double below = -l->probability, density = 0.0;
        for (size_t i = 0; i < l->n; i++) {
            const double scaled = (x - l->part[i].mean) / l->part[i].deviation;
            below += l->part[i].weight * gsl_cdf_ugaussian_P(scaled);
            density += l->part[i].weight / l->part[i].deviation * exp(-0.5 * scaled * scaled) /
                       sqrt(2.0 * M_PI);
        }
        step = below / density;
        x -= fmax(-deviation, fmin(step, deviation));
    }
    return fabs(step) <= close_enough * deviation ? x : (double)NAN;
}

static double mixture_quantile(mixture_level l)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    double quantile = isinf(l.freedom) ? normal_mixture_quantile(&l) : (double)NAN;
    if (isfinite(quantile))
        return quantile;
    for (size_t i = 0; i < l.n; i++) {
        low = fmin(low, l.part[i].mean - max_deviations * l.part[i].deviation);
        high = fmax(high, l.part[i].mean + max_deviations * l.part[i].deviation);
    }
    quantile = low < high ? low : high; /* where exact components reach the probability */
    if (excess_probability(low, &l) < 0.0 &&
        root_find(excess_probability, &l, low, high, 0.0, &quantile, NULL) != WT_OK)
        quantile = (double)NAN;
    return quantile;
}

wt_interval student_mixture_interval(const mixture_component *part, size_t n, double freedom)
{
    wt_interval interval = {0};
    for (size_t i = 0; i < n; i++)
        interval.value += part[i].weight * part[i].mean;
    interval.low = mixture_quantile((mixture_level){part, n, freedom, 0.025});
    interval.high = mixture_quantile((mixture_level){part, n, freedom, 0.975});
    interval.standard_error = (interval.high - interval.low) / (2.0 * NORMAL_95);
    return interval;
}

wt_interval mixture_interval(const mixture_component *part, size_t n)
{
    return student_mixture_interval(part, n, (double)INFINITY);
}

wt_interval interval_offset(wt_interval x, double by)
{
    x.value += by;
    x.low += by;
    x.high += by;
    return x;
}

wt_interval interval_map(wt_interval x, double (*f)(double))
{
    wt_interval y = {f(x.value), 0.0, f(x.low), f(x.high)};
    y.standard_error = 0.5 * (y.high - y.low) / NORMAL_95;
    return y;
}
