/* Fit of a decay to a series of cycles.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/decay_fit.h"

#include "core/base/array.h"
#include "record/numerics/autocorrelation.h"

#include <math.h>

/* ---- one time factor ------------------------------------------------------------------------- */

/* Times at which the decay is tabulated: from a change of 3e-4 on to 7e-8 for the smallest power.
 */
enum { TIMES = 240 };
static const double first_time = 1e-10, last_time = 3000;

/* exp(-t^power) and its integral from the start. Means computed from it are exact in the first
 * cycles, too, in which most of a decay may pass. */
typedef struct decay_integral {
    double step; /* of ln time */
    double value[TIMES], time[TIMES], sum[TIMES];
} decay_integral;

/* Integral within interval i, in which the decay is linear in the logarithm of time. */
static double integrate_interval(const decay_integral *d, size_t i, double from, double to,
                                 double log_ratio)
{
    const double rise = (d->value[i + 1] - d->value[i]) / d->step;
    return (d->value[i] - rise) * (to - from) + rise * to * log_ratio;
}

static void decay_integral_fill(decay_integral *d, double power)
{
    d->step = log(last_time / first_time) / (TIMES - 1);
    for (size_t i = 0; i < TIMES; i++) {
        d->time[i] = first_time * exp((double)i * d->step);
        d->value[i] = exp(-pow(d->time[i], power));
    }
    d->sum[0] = d->value[0] * d->time[0];
    for (size_t i = 1; i < TIMES; i++)
        d->sum[i] =
            d->sum[i - 1] + integrate_interval(d, i - 1, d->time[i - 1], d->time[i], d->step);
}

static double decay_integral_at(const decay_integral *d, double time)
{
    const double place = log(time / first_time) / d->step;
    if (!(place > 0))
        return d->value[0] * time;
    if (place >= TIMES - 1)
        return d->sum[TIMES - 1];
    const size_t i = (size_t)place;
    return d->sum[i] + integrate_interval(d, i, d->time[i], time, (place - (double)i) * d->step);
}

/* ---- all time factors ------------------------------------------------------------------------ */

/* Step of the coarse scan (in ln), and number of factors of the fine scan. */
static const double coarse = 0.2;
enum { FINE = 40, COARSE_MOST = 200 };
/* ln of the ratio to the largest likelihood at which a factor is skipped: about 1e-5. */
static const double deep = 12;
/* A decay of which half passes within two means is not resolved. The scan goes from 1/8 of that to
 * a multiple of the length of the series. */
static const double fewest_means = 2, least_part = 0.125, most_lengths = 5;

/* Mean and mean square. */
typedef struct moment_sum {
    double mean, square;
} moment_sum;

/* Averages over the laws of the scatter at one factor. */
typedef struct law_sum {
    double log_factor, weight; /* weight: ln of the likelihood over all laws */
    moment_sum ratio, level;
} law_sum;

typedef struct factor_scan {
    const double *y; /* [n_means] */
    size_t n_means;
    double variance, least; /* of the series; least squared residual of a mean */
    decay_integral decay;
    double *column;            /* [n_means] */
    bool kept[SCATTER_LAWS];   /* laws that are not excluded */
    double best[SCATTER_LAWS]; /* largest likelihood of each law */
    size_t n;                  /* number of factors */
    law_sum sum[COARSE_MOST];  /* [n] */
} factor_scan;

static moment_sum add_moments(moment_sum sum, double old, double now, double value, double variance)
{
    return (moment_sum){old * sum.mean + now * value,
                        old * sum.square + now * (value * value + variance)};
}

/* Mean of the decay in each interval of the series. */
static void fill_column(factor_scan *t, double log_factor)
{
    const double width = exp(-log_factor) / (double)t->n_means;
    double before = 0;
    for (size_t i = 0; i < t->n_means; i++) {
        const double sum = decay_integral_at(&t->decay, width * (double)(i + 1));
        t->column[i] = (sum - before) / width;
        before = sum;
    }
}

static law_sum evaluate_factor(factor_scan *t, double log_factor)
{
    law_sum sum = {.log_factor = log_factor, .weight = -(double)INFINITY};
    const double df = (double)t->n_means - 2;
    fill_column(t, log_factor);
    for (size_t i = 0; i < SCATTER_LAWS; i++) {
        if (!t->kept[i])
            continue;
        scatter_sums s = scatter_begin(scatter_law_at(SCATTER_FOR_CHANGE, i, t->n_means));
        for (size_t k = 0; k < t->n_means; k++)
            scatter_add_column(&s, t->column[k], t->y[k]);
        const scatter_fit f = scatter_solve(&s, true);
        const double scatter = fmax(f.squares / df, t->least);
        /* The prior admits changes of the order of the total scatter. Without it, a decay outside
         * the series would be as probable as it is unconstrained. */
        const double l = scatter_prior(SCATTER_FOR_CHANGE, i) +
                         scatter_profile_likelihood(&s, t->least) -
                         0.5 * log1p(f.variance * scatter / t->variance);
        if (!isfinite(l)) /* the decay does not pass within the series */
            continue;
        const double variance = scatter * f.variance * df / (df - 2); /* of Student's t */
        const double all = log_add(sum.weight, l), old = exp(sum.weight - all), now = exp(l - all),
                     slope = s.product[1] / s.product[0];
        sum.ratio = add_moments(sum.ratio, old, now, f.coefficient, variance);
        sum.level =
            add_moments(sum.level, old, now, s.product[3] / s.product[0] - f.coefficient * slope,
                        scatter * df / (df - 2) / s.product[0] + slope * slope * variance);
        sum.weight = all;
        t->best[i] = fmax(t->best[i], l);
    }
    return sum;
}

/* Evaluates factors in equal steps from low to high. */
static void evaluate_factors(factor_scan *t, double low, double high, size_t n)
{
    t->n = n;
    for (size_t i = 0; i < n; i++)
        t->sum[i] = evaluate_factor(t, low + (high - low) * (double)i / (double)(n - 1));
}

/* Excludes laws that are less likely than the best by a factor of e^-deep. */
static void scan_coarsely(factor_scan *t, const double limit[2])
{
    double best = -(double)INFINITY;
    for (size_t i = 0; i < SCATTER_LAWS; i++) {
        t->kept[i] = true;
        t->best[i] = -(double)INFINITY;
    }
    evaluate_factors(t, limit[0], limit[1],
                     (size_t)fmin(fmax(ceil((limit[1] - limit[0]) / coarse), 2), COARSE_MOST));
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        best = fmax(best, t->best[i]);
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        t->kept[i] = t->best[i] > best - deep;
}

/* ln of the odds of the decay, with any factor, over a constant. */
static double decay_log_odds(const factor_scan *t)
{
    double any = -(double)INFINITY, none = -(double)INFINITY;
    for (size_t i = 0; i < t->n; i++)
        any = log_add(any, t->sum[i].weight);
    for (size_t i = 0; i < SCATTER_LAWS; i++) {
        scatter_sums s = scatter_begin(scatter_law_at(SCATTER_FOR_CHANGE, i, t->n_means));
        for (size_t k = 0; k < t->n_means; k++)
            scatter_add(&s, t->y[k]);
        none = log_add(none, scatter_prior(SCATTER_FOR_CHANGE, i) +
                                 scatter_likelihood(&s, false, t->least));
    }
    return any - log((double)t->n) - none - 0.5 * log(2 * M_PI * t->variance);
}

/* Repeats the scan where the likelihood is large, until it covers many factors. A precise series
 * determines the factor to less than a step. */
enum { MANY = FINE / 2, SCANS = 5 };

static size_t scan_finely(factor_scan *t, const double limit[2])
{
    const double step = t->sum[1].log_factor - t->sum[0].log_factor;
    double largest = -(double)INFINITY, low = limit[1], high = limit[0];
    size_t n = 0;
    for (size_t i = 0; i < t->n; i++)
        largest = fmax(largest, t->sum[i].weight);
    for (size_t i = 0; i < t->n; i++)
        if (t->sum[i].weight > largest - deep) {
            low = fmin(low, t->sum[i].log_factor - step);
            high = fmax(high, t->sum[i].log_factor + step);
        }
    evaluate_factors(t, fmax(low, limit[0]), fmin(high, limit[1]), FINE);
    for (size_t i = 0; i < t->n; i++)
        n += t->sum[i].weight > largest - deep;
    return n;
}

/* ---- result ---------------------------------------------------------------------------------- */

static void set_means(const factor_scan *t, decay_fit *fit)
{
    double all = -(double)INFINITY, square = 0;
    for (size_t i = 0; i < t->n; i++)
        all = log_add(all, t->sum[i].weight);
    for (size_t i = 0; i < t->n; i++) {
        const law_sum *const sum = &t->sum[i];
        const double weight = exp(sum->weight - all);
        fit->log_factor += weight * sum->log_factor;
        fit->ratio += weight * sum->ratio.mean;
        fit->level += weight * sum->level.mean;
        square += weight * sum->level.square;
    }
    fit->level_error = sqrt(fmax(square - fit->level * fit->level, 0));
}

decay_fit decay_fit_compute(const double *y, size_t n, double power)
{
    arena memory = {0};
    factor_scan *const t = arena_alloc(&memory, 1, sizeof *t);
    decay_fit fit = {.seen = false};
    const double half = pow(M_LN2, 1 / power), /* time at which half is left */
        limit[2] = {log(least_part * fewest_means / (double)n / half), log(most_lengths / half)};
    t->y = y;
    t->n_means = n;
    t->variance = scatter_total_variance(y, n);
    t->least = SCATTER_RESOLUTION * SCATTER_RESOLUTION * t->variance;
    t->column = arena_numbers(&memory, n);
    decay_integral_fill(&t->decay, power);
    scan_coarsely(t, limit);
    fit.log_odds = decay_log_odds(t);
    fit.seen = fit.log_odds > log(DECAY_MIN_ODDS);
    if (fit.seen) {
        for (int i = 0; i < SCANS && scan_finely(t, limit) < MANY; i++)
            continue;
        set_means(t, &fit);
    }
    arena_free(&memory);
    return fit;
}
