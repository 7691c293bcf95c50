/* End of the running-in of a series of cycles: the change point, averaged over the unknown scatter
 * before and after. Compare Scargle et al., Astrophys. J. 764 (2013) 167; here the scatter is
 * autocorrelated.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/autocorrelation.h"

#include "core/base/arena.h"
#include "core/math/normal_quantile.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>

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

static double total_variance(const double *y, size_t n)
{
    double mean = 0, sum = 0;
    for (size_t i = 0; i < n; i++)
        mean += y[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        sum += (y[i] - mean) * (y[i] - mean);
    return sum / (double)n;
}

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
    const size_t behind = (size_t)fmax(FEWEST_BEHIND, ceil(least_behind * (double)l->n));
    const size_t first = FEWEST_BEFORE, end = l->n - behind + 1;
    for (size_t k = first; k < end; k++)
        l->before[k] += l->behind[k];
    if (change_log_odds(l, l->before, first, end, variance) < log(least_odds)) {
        r->reason = "no running-in stands out of the scatter";
        return;
    }
    change_interval(l->before, first, end, r);
    if (r->steady_start + 1 < end) {
        r->is_detected = true;
        return;
    }
    *r = (wt_running_in){.end = {(double)NAN, (double)NAN, (double)NAN, (double)NAN},
                         .steady_start = l->n - behind,
                         .reason = "it does not become steady before the last tenth"};
}

static void find_running_in(const double *y, size_t n, wt_running_in *r)
{
    arena memory = {0};
    const double variance = total_variance(y, n);
    if (n < FEWEST_BEFORE + 2 * FEWEST_BEHIND)
        return;
    if (!(variance > 0)) {
        r->reason = "the cycles do not scatter";
        return;
    }
    likelihoods l = {n, arena_numbers(&memory, n + 1), arena_numbers(&memory, n + 1),
                     SCATTER_RESOLUTION * SCATTER_RESOLUTION * variance};
    for (size_t k = 0; k <= n; k++)
        l.before[k] = l.behind[k] = -(double)INFINITY;
    for (size_t i = 0; i < SCATTER_LAWS; i++)
        add_change_law(&l, y, i);
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
