/* Groups of moduli and their comparison: geometric means, Welch, Mann and Whitney, Hedges, Holm.
 *
 * Moduli scatter by factors, so intervals and the ratio are made of ln E. Curves on one spot share
 * the place and are not independent: where spots are known, the spot is the unit and its mean the
 * observation.
 *
 * Welch, Biometrika 34 (1947) 28; Mann and Whitney, Ann. Math. Stat. 18 (1947) 50; Hedges, J. Educ.
 * Stat. 6 (1981) 107; Holm, Scand. J. Stat. 6 (1979) 65.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/array.h"
#include "base/gsl_quiet.h"
#include "base/pool.h"
#include "model/special.h"
#include "weartrack/fit.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Up to this many units together the counts of the exact distribution are exact in a double. */
enum { EXACT_UNITS = 50 };
static const double confidence = 0.95;

typedef struct curve {
    long spot;
    double modulus;
} curve;

/* The observations: curves, or means over spots. */
typedef struct units {
    double *modulus, *log_modulus; /* [n] */
    size_t n;
} units;

typedef struct moments {
    double n, mean, variance; /* ddof 1; NaN for n < 2 */
} moments;

static int by_spot(const void *a, const void *b)
{
    const curve *x = a, *y = b;
    if (x->spot != y->spot)
        return x->spot < y->spot ? -1 : 1;
    return (x->modulus > y->modulus) - (x->modulus < y->modulus);
}

static wt_status check_group(const wt_group *group, wt_error *err)
{
    if (group->n == 0)
        return wt_fail(err, WT_E_EMPTY, "the group has no accepted curve");
    for (size_t i = 0; i < group->n; i++) {
        if (!(group->modulus[i] > 0.0) || !isfinite(group->modulus[i])) {
            wt_status status = wt_fail(err, WT_E_RANGE, "a modulus of the group is not usable");
            wt_error_place(err, "value %zu of %zu", i + 1, group->n);
            wt_error_expected(err, "a value above 0 Pa");
            wt_error_found(err, "%g Pa", group->modulus[i]);
            return status;
        }
    }
    return WT_OK;
}

/* In an order that does not depend on that of the curves, so that sums have the same bits. */
static wt_status make_units(const wt_group *group, bool use_spots, pool *memory, units *u,
                            wt_error *err)
{
    wt_status status = check_group(group, err);
    if (status != WT_OK)
        return status;
    gsl_quiet();
    curve *curves = pool_alloc(memory, group->n, sizeof *curves);
    *u = (units){pool_numbers(memory, group->n), pool_numbers(memory, group->n), 0};
    if (memory->failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for a group of %zu moduli", group->n);
    for (size_t i = 0; i < group->n; i++)
        curves[i] = (curve){use_spots ? group->spot[i] : 0, group->modulus[i]};
    qsort(curves, group->n, sizeof *curves, by_spot);
    for (size_t i = 0; i < group->n;) {
        long spot = curves[i].spot;
        double sum = 0.0, log_sum = 0.0, m = 0.0;
        do {
            sum += curves[i].modulus;
            log_sum += log(curves[i].modulus);
            m += 1.0;
            i++;
        } while (use_spots && i < group->n && curves[i].spot == spot);
        u->modulus[u->n] = sum / m;
        u->log_modulus[u->n++] = log_sum / m;
    }
    return WT_OK;
}

static moments moments_of(const double *x, size_t n)
{
    moments m = {(double)n, 0.0, 0.0};
    for (size_t i = 0; i < n; i++)
        m.mean += x[i];
    m.mean /= m.n;
    for (size_t i = 0; i < n; i++)
        m.variance += (x[i] - m.mean) * (x[i] - m.mean);
    m.variance = n > 1 ? m.variance / (m.n - 1.0) : (double)NAN;
    return m;
}

static double quantile_t(double df)
{
    return gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, df);
}

static wt_status summarise(const wt_group *group, const units *u, pool *memory,
                           wt_group_summary *summary, wt_error *err)
{
    double *sorted = pool_numbers(memory, group->n);
    if (sorted == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a group of %zu moduli", group->n);
    memcpy(sorted, group->modulus, group->n * sizeof *sorted);
    numbers_sort(sorted, group->n);
    moments curves = moments_of(sorted, group->n), logs = moments_of(u->log_modulus, u->n);
    size_t half = group->n / 2;
    *summary = (wt_group_summary){
        .n = group->n,
        .n_rejected = group->n_rejected,
        .n_spots = u->n,
        .mean = curves.mean,
        .standard_deviation = sqrt(curves.variance),
        .geometric_mean = exp(logs.mean),
        .log_standard_error = sqrt(logs.variance / logs.n),
        .low = (double)NAN,
        .high = (double)NAN,
        .median = group->n % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]),
    };
    if (u->n > 1) {
        double reach = quantile_t(logs.n - 1.0) * summary->log_standard_error;
        summary->low = exp(logs.mean - reach);
        summary->high = exp(logs.mean + reach);
    }
    return WT_OK;
}

wt_status wt_group_summarise(const wt_group *group, wt_group_summary *summary, wt_error *err)
{
    units u;
    pool memory = {0};
    wt_status status = make_units(group, group->spot != NULL, &memory, &u, err);
    if (status == WT_OK)
        status = summarise(group, &u, &memory, summary, err);
    pool_free(&memory);
    return status;
}

/* ---- two groups ------------------------------------------------------------------------------ */

typedef struct welch {
    double difference, standard_error, df;
} welch;

/* Of b minus a. */
static welch welch_of(moments a, moments b)
{
    double va = a.variance / a.n, vb = b.variance / b.n, v = va + vb;
    return (welch){b.mean - a.mean, sqrt(v),
                   v * v / (va * va / (a.n - 1.0) + vb * vb / (b.n - 1.0))};
}

/* Number of ways in which m + n units without ties give each U = 0..m n: the coefficients of the
 * Gaussian binomial. counts: [m n + 1]. */
static void count_rankings(size_t m, size_t n, double *counts)
{
    size_t top = m * n;
    memset(counts, 0, (top + 1) * sizeof *counts);
    counts[0] = 1.0;
    for (size_t j = 1; j <= m; j++) {
        for (size_t u = top; u >= n + j; u--) /* times 1 - x^(n+j) */
            counts[u] -= counts[u - n - j];
        for (size_t u = j; u <= top; u++) /* over 1 - x^j */
            counts[u] += counts[u - j];
    }
}

typedef struct ranked {
    double value;
    bool track;
} ranked;

static int by_value(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

/* U of the track by the sum of its ranks, equal values sharing the mean of theirs; *ties is the sum
 * of t^3 - t over groups of t equal values. Exact: all are whole numbers or halves. */
static wt_status rank_units(const units *bulk, const units *track, pool *memory, double *u,
                            double *ties, wt_error *err)
{
    const size_t m = track->n, n = m + bulk->n;
    ranked *all = pool_alloc(memory, n, sizeof *all);
    if (all == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the comparison of two groups");
    for (size_t i = 0; i < n; i++)
        all[i] = i < m ? (ranked){track->log_modulus[i], true}
                       : (ranked){bulk->log_modulus[i - m], false};
    qsort(all, n, sizeof *all, by_value);
    double ranks = 0.0;
    *ties = 0.0;
    for (size_t first = 0, end = 0; first < n; first = end) {
        double of_track = 0.0;
        do
            of_track += all[end].track ? 1.0 : 0.0;
        while (++end < n && all[end].value == all[first].value);
        const double t = (double)(end - first);
        ranks += of_track * 0.5 * (double)(first + 1 + end);
        *ties += t * t * t - t;
    }
    *u = ranks - 0.5 * (double)m * (double)(m + 1);
    return WT_OK;
}

static wt_status mann_whitney(const units *bulk, const units *track, pool *memory,
                              wt_comparison *result, wt_error *err)
{
    const size_t m = track->n, n = bulk->n;
    double u = 0.0, ties = 0.0;
    wt_status status = rank_units(bulk, track, memory, &u, &ties, err);
    if (status != WT_OK)
        return status;
    const double pairs = (double)m * (double)n, all = (double)(m + n);
    const double lower = fmin(u, pairs - u);
    result->mann_whitney_u = u;
    result->mann_whitney_exact = ties == 0.0 && m + n <= EXACT_UNITS;
    if (!result->mann_whitney_exact) {
        double variance = pairs / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
        double distance = fmax(0.0, 0.5 * pairs - lower - 0.5); /* continuity */
        result->mann_whitney_p =
            variance > 0.0 ? fmin(1.0, 2.0 * gsl_cdf_ugaussian_Q(distance / sqrt(variance))) : 1.0;
        return WT_OK;
    }
    double *counts = pool_numbers(memory, m * n + 1);
    if (counts == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the comparison of two groups");
    count_rankings(m, n, counts);
    double tail = 0.0, total = 0.0;
    for (size_t i = 0; i <= m * n; i++) {
        total += counts[i];
        if ((double)i <= lower)
            tail += counts[i];
    }
    result->mann_whitney_p = fmin(1.0, 2.0 * tail / total);
    return WT_OK;
}

static wt_status too_few(const char *which, const units *u, bool spots, wt_error *err)
{
    wt_status status = wt_fail(err, WT_E_EMPTY, "the %s cannot be compared", which);
    wt_error_expected(err, "at least 2 %s", spots ? "spots" : "curves");
    wt_error_found(err, "%zu", u->n);
    wt_error_advice(err, spots ? "measure on more spots; curves on one spot are not independent"
                               : "measure more curves, or see why they were rejected");
    return status;
}

wt_status wt_compare(const wt_group *bulk, const wt_group *track, wt_comparison *result,
                     wt_error *err)
{
    wt_comparison c = {.by_spot = bulk->spot != NULL && track->spot != NULL};
    units a, b;
    pool memory = {0};
    wt_status status = make_units(bulk, c.by_spot, &memory, &a, err);
    if (status == WT_OK)
        status = make_units(track, c.by_spot, &memory, &b, err);
    if (status != WT_OK)
        goto done;
    if (a.n < 2 || b.n < 2) {
        status = too_few(a.n < 2 ? "bulk" : "track", a.n < 2 ? &a : &b, c.by_spot, err);
        goto done;
    }
    if ((status = summarise(bulk, &a, &memory, &c.bulk, err)) != WT_OK ||
        (status = summarise(track, &b, &memory, &c.track, err)) != WT_OK)
        goto done;

    moments log_a = moments_of(a.log_modulus, a.n), log_b = moments_of(b.log_modulus, b.n);
    moments mean_a = moments_of(a.modulus, a.n);
    moments mean_b = moments_of(b.modulus, b.n);
    if (!(log_a.variance + log_b.variance > 0.0)) {
        status = wt_fail(err, WT_E_RANGE, "all moduli of each group are equal: no scatter");
        wt_error_advice(err, "measured moduli scatter; are these values copies of one curve?");
        goto done;
    }
    welch of_logs = welch_of(log_a, log_b), of_means = welch_of(mean_a, mean_b);
    double reach = quantile_t(of_logs.df) * of_logs.standard_error;
    c.log_ratio = (wt_estimate){of_logs.difference, of_logs.standard_error, 0.0, "1"};
    c.ratio = exp(of_logs.difference);
    c.ratio_low = exp(of_logs.difference - reach);
    c.ratio_high = exp(of_logs.difference + reach);
    c.difference = (wt_estimate){of_means.difference, of_means.standard_error, 0.0, "Pa"};
    c.welch_t = of_means.difference / of_means.standard_error;
    c.welch_df = of_means.df;
    c.welch_p = 2.0 * gsl_cdf_tdist_Q(fabs(c.welch_t), c.welch_df);
    double df = log_a.n + log_b.n - 2.0;
    double pooled = ((log_a.n - 1.0) * log_a.variance + (log_b.n - 1.0) * log_b.variance) / df;
    c.effect_size = of_logs.difference / sqrt(pooled) * (1.0 - 3.0 / (4.0 * df - 1.0));
    status = mann_whitney(&a, &b, &memory, &c, err);
done:
    pool_free(&memory);
    if (status == WT_OK)
        *result = c;
    return status;
}

void wt_holm(const double *p, size_t n, double *adjusted)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++) {
        left += isnan(p[i]) ? 0 : 1;
        adjusted[i] = isnan(p[i]) ? (double)NAN : -1.0; /* -1: not yet done */
    }
    for (double highest = 0.0; left > 0; left--) {
        size_t smallest = n;
        for (size_t i = 0; i < n; i++)
            if (adjusted[i] == -1.0 && (smallest == n || p[i] < p[smallest]))
                smallest = i;
        highest = fmax(highest, fmin(1.0, (double)left * p[smallest]));
        adjusted[smallest] = highest;
    }
}

double wt_equivalent_frequency(double load_time, double force_exponent)
{
    if (!(load_time > 0.0))
        return (double)NAN;
    return exp(digamma(force_exponent + 1.0)) / load_time;
}
