/* End of the running-in of a series of cycles: the change point, averaged over the unknown scatter
 * before and after. Compare Scargle et al., Astrophys. J. 764 (2013) 167; here the scatter is
 * autocorrelated. Published rules for the truncation of the beginning. Mean and drift of the
 * steady state with autocorrelated scatter.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/steady_state.h"

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "record/numerics/autocorrelation.h"
#include "record/numerics/decay_fit.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

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
