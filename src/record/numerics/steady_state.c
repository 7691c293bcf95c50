/* End of the running-in of a series of cycles: the change point, averaged over the unknown scatter
 * before and after. Compare Scargle et al., Astrophys. J. 764 (2013) 167; here the scatter is
 * autocorrelated. Fit of a decay with the factor of its time unknown. Published rules for the
 * truncation of the beginning. Mean and drift of the steady state with autocorrelated scatter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/steady_state.h"

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "record/numerics/autocorrelation.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

/* Model of n means over equal times, in units of the length of the series: level + ratio x
 * exp(-(t / factor)^power), with slow and white scatter. The likelihood is averaged over laws of
 * the scatter and over factors. */
typedef struct decay_fit {
    bool seen;                 /* odds over a constant above DECAY_MIN_ODDS */
    double log_odds;           /* ln of these odds */
    double log_factor;         /* mean */
    double ratio;              /* mean */
    double level, level_error; /* mean and standard deviation */
} decay_fit;

/* As for the running-in: at most one false alarm in twenty. */
#define DECAY_MIN_ODDS 20
/* Fewest means of a fit. */
enum { DECAY_MIN_MEANS = 16 };

/* ---- one time factor ------------------------------------------------------------------------- */

/* Times at which the decay is tabulated: from a change of 3e-4 to 7e-8 for the smallest power. */
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

/* Fits a power. The series must scatter. Only the odds are set unless the decay is seen. */
static decay_fit decay_fit_compute(const double *y, size_t n, double power)
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

/* ---- end of the running-in ------------------------------------------------------------------- */

/* Fewest points before the change: two more than the constants of a line. Fewest points after it:
 * they determine a scatter to 25 %, with a share of the series below. */
enum { FEWEST_BEFORE = 4, FEWEST_BEHIND = 12 };
static const double least_behind = 0.1;

/* Odds over a series without a running-in at which one is reported: at most one false alarm in
 * twenty. */
static const double least_odds = 20;

/* Prior range of the logarithm of the ratio of the two scatters: 1 % to 100. */
static const double scatter_range = 9.2;

static const double tail = 0.025; /* on each side of a 95 % interval */

typedef struct likelihoods {
    size_t n;
    double *before, *behind; /* [n + 1] of the points before k, and of those from k on */
    double least;
} likelihoods;

/* Evaluates all change points at once, since the scatter is the same from either end. */
static void add_change_law(likelihoods *l, const double *y, size_t i)
{
    const scatter_law law = scatter_law_at(SCATTER_FOR_CHANGE, i, l->n);
    const double prior = scatter_prior(SCATTER_FOR_CHANGE, i);
    scatter_sums s = scatter_begin(law);
    for (size_t k = 1; k <= l->n; k++) {
        scatter_add(&s, y[k - 1]);
        if (k >= FEWEST_BEFORE)
            l->before[k] = log_add(l->before[k], prior + scatter_likelihood(&s, true, l->least));
    }
    s = scatter_begin(law);
    for (size_t k = l->n; k-- > 0;) {
        scatter_add(&s, y[k]);
        if (s.n >= FEWEST_BEHIND)
            l->behind[k] = log_add(l->behind[k], prior + scatter_likelihood(&s, false, l->least));
    }
}

static likelihoods change_likelihoods(const double *y, size_t n, double variance, arena *memory)
{
    likelihoods l = {n, arena_numbers(memory, n + 1), arena_numbers(memory, n + 1),
                     SCATTER_RESOLUTION * SCATTER_RESOLUTION * variance};
    for (size_t k = 0; k <= n; k++)
        l.before[k] = l.behind[k] = -(double)INFINITY;
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        add_change_law(&l, y, i);
    return l;
}

/* Limits of the change. */
static size_t last_change(size_t n)
{
    return n - (size_t)fmax(FEWEST_BEHIND, ceil(least_behind * (double)n)) + 1;
}

static void change_interval(const double *log_weight, size_t first, size_t end, wt_running_in *r)
{
    double all = -(double)INFINITY, below = 0;
    bool low = false, middle = false;
    for (size_t k = first; k < end; k++)
        all = log_add(all, log_weight[k]);
    for (size_t k = first; k < end; k++) {
        const double at = (double)k, weight = exp(log_weight[k] - all);
        below += weight;
        if (!low && below > tail)
            r->end.low = at;
        if (!middle && below >= 0.5)
            r->end.value = at;
        low = below > tail;
        middle = below >= 0.5;
        r->end.high = at;
        if (below >= 1 - tail)
            break;
    }
    /* standard error of the normal law with this interval: the tails may be long and light */
    r->end.standard_error = (r->end.high - r->end.low) / (2 * NORMAL_95);
    r->steady_start = (size_t)r->end.high;
}

/* ln of the odds of a running-in at any point over none. It has one line and one scatter more. The
 * prior admits coefficients within the scatter of the series. The law of the scatter is averaged
 * over. */
static double change_log_odds(const likelihoods *l, const double *log_weight, size_t first,
                              size_t end, double variance)
{
    double any = -(double)INFINITY;
    for (size_t k = first; k < end; k++)
        any = log_add(any, log_weight[k]);
    return any - l->behind[0] - log((double)(end - first)) - log(2 * M_PI * variance) -
           log(2 * scatter_range);
}

static void assess_running_in(const likelihoods *l, double variance, wt_running_in *r)
{
    const size_t first = FEWEST_BEFORE, end = last_change(l->n);
    for (size_t k = first; k < end; k++)
        l->before[k] += l->behind[k];
    if (change_log_odds(l, l->before, first, end, variance) < log(least_odds)) {
        r->reason = "no running-in exceeds the scatter";
        return;
    }
    change_interval(l->before, first, end, r);
    if (r->steady_start + 1 < end) {
        r->is_detected = true;
        return;
    }
    *r = (wt_running_in){.end = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                         .steady_start = end - 1,
                         .reason = "it does not become steady before the last tenth"};
}

static void find_running_in(const double *y, size_t n, wt_running_in *r)
{
    arena memory = {0};
    const double variance = scatter_total_variance(y, n);
    if (n < FEWEST_BEFORE + 2 * FEWEST_BEHIND)
        return;
    if (!(variance > 0)) {
        r->reason = "the cycles do not scatter";
        return;
    }
    const likelihoods l = change_likelihoods(y, n, variance, &memory);
    r->reason = "";
    assess_running_in(&l, variance, r);
    arena_free(&memory);
}

/* Converts batches to points. A change within a batch shows at either of its ends. */
static void convert_parts_to_points(const scatter_batches *parts, wt_running_in *r)
{
    const double length = (double)parts->length, rest = (double)parts->rest;
    if (parts->length == 1 || r->steady_start == 0)
        return;
    r->steady_start = parts->rest + parts->length * r->steady_start;
    r->end.value = rest + length * r->end.value;
    r->end.low = rest + length * (r->end.low - 1) + 1;
    r->end.high = rest + length * (r->end.high + 1) - 1;
    r->end.standard_error = (r->end.high - r->end.low) / (2 * NORMAL_95);
    r->steady_start = r->is_detected ? (size_t)r->end.high : r->steady_start;
}

wt_running_in wt_running_in_find(const double *y, size_t n)
{
    wt_running_in found = {.end = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                           .reason = "too few cycles"};
    double *scratch;
    const scatter_batches parts = scatter_batch(y, n, &scratch);
    find_running_in(parts.y, parts.n, &found);
    convert_parts_to_points(&parts, &found);
    free(scratch);
    return found;
}

/* ---- decay that goes on ---------------------------------------------------------------------- */

/* More averages of the series do not change the fit. From exponential to nearly logarithmic. */
enum { DECAY_MAX_BATCHES = 120 };
static const double decay_power[] = {1, 0.8, 0.65, 0.5, 0.35};
/* The law of the decay is not known beyond the end of the series. Standard error for that: a share
 * of what is left, and of the distance from the plateau of an exponential. */
static const double decay_left_error = 0.25, decay_law_error = 0.5;

/* Averages the powers. */
static steady_decay assess_decay(const double *y, size_t n, double variance)
{
    arena memory = {0};
    const likelihoods l = change_likelihoods(y, n, variance, &memory);
    double odds = -(double)INFINITY, plateau = 0, square = 0, left = 0, exponential = (double)NAN;
    for (size_t i = 0; i < COUNT_OF(decay_power); i++) {
        const decay_fit f = decay_fit_compute(y, n, decay_power[i]);
        if (!f.seen)
            continue;
        const double all = log_add(odds, f.log_odds), old = exp(odds - all),
                     now = exp(f.log_odds - all);
        plateau = old * plateau + now * f.level;
        square = old * square + now * (f.level * f.level + f.level_error * f.level_error);
        left = old * left + now * f.ratio * exp(-pow(exp(-f.log_factor), decay_power[i]));
        odds = all;
        exponential = i == 0 ? f.level : exponential;
    }
    for (size_t k = FEWEST_BEFORE; k < last_change(n); k++)
        l.before[k] += l.behind[k];
    const double change = change_log_odds(&l, l.before, FEWEST_BEFORE, last_change(n), variance);
    const double law = isnan(exponential) ? 0 : decay_law_error * (plateau - exponential),
                 error = hypot(sqrt(fmax(square - plateau * plateau, 0)),
                               hypot(decay_left_error * left, law));
    arena_free(&memory);
    return (steady_decay){
        odds - log(COUNT_OF(decay_power)) > fmax(change, 0) + log(least_odds),
        {plateau, error, plateau - NORMAL_95 * error, plateau + NORMAL_95 * error},
        left};
}

steady_decay steady_decay_find(const double *y, size_t n)
{
    const size_t length = (n + DECAY_MAX_BATCHES - 1) / DECAY_MAX_BATCHES;
    const size_t means = n / length, rest = n % length;
    if (n < FEWEST_BEFORE + 2 * FEWEST_BEHIND || means < DECAY_MIN_MEANS)
        return (steady_decay){.is_detected = false};
    double *const mean = wt_alloc(means, sizeof *mean);
    for (size_t i = 0; i < means * length; i++)
        mean[i / length] += y[rest + i] / (double)length;
    const double variance = scatter_total_variance(mean, means);
    const steady_decay found =
        variance > 0 ? assess_decay(mean, means, variance) : (steady_decay){.is_detected = false};
    free(mean);
    return found;
}

steady_decay_kind steady_decay_follow(const double *y, size_t n, wt_interval *mean, double *left)
{
    const steady_decay d = steady_decay_find(y, n);
    const double off = fabs(mean->value - d.plateau.value), least = mean->standard_error;
    if (!d.is_detected || off <= least)
        return DECAY_NONE;
    const bool told = d.plateau.standard_error < off, ends = fabs(d.left) <= least;
    *left = d.left;
    if (told) {
        *mean = d.plateau;
    } else if (!ends) {
        const double error = hypot(least, off), half = NORMAL_95 * error;
        *mean = (wt_interval){mean->value, error, mean->value - half, mean->value + half};
    }
    if (ends)
        return told ? DECAY_TOLD : DECAY_NONE;
    return told ? DECAY_GOES_ON : DECAY_UNKNOWN;
}

/* ---- steady state ---------------------------------------------------------------------------- */

enum { FEWEST = 4 }; /* two more than the constants of a line */
/* Relative to the mean: rounding errors of equal samples. */
static const double rounding = 1e-12;
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
        steady->note = "the cycles do not scatter, so the error is not known";
    if (n < FEWEST || !(steady->deviation > rounding * fabs(m.mean)))
        return WT_OK;
    double *scratch;
    const scatter_batches parts = scatter_batch(y, n, &scratch);
    average_laws(&parts, m, steady);
    free(scratch);
    return WT_OK;
}
