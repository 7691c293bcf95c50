/* Tests of two groups of units (Welch, Mann and Whitney, Holm), and the required number of spots.
 *
 * Welch's interval is too narrow if two units are compared with more and lie close together by
 * chance; its coverage is 89 to 93 %. The pooled standard deviation is then a lower bound.
 * Separate variances (Behrens and Fisher) would make the interval up to three times as wide.
 *
 * Welch, Biometrika 34 (1947) 28; Mann and Whitney, Ann. Math. Stat. 18 (1947) 50; Holm, Scand. J.
 * Stat. 6 (1979) 65.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/special.h"
#include "indentation/numerics/curve.h"
#include "indentation/numerics/group_statistics.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- mean residual --------------------------------------------------------------------------- */

/* Test of the contact law by the curves of a group: Hotelling's T^2 of the mean of the first
 * cosines of the residual over the contact. The scatter of the curves determines the test for any
 * noise. */

/* T^2 requires more curves than cosines. Twice as many give as many degrees of freedom. */
enum { W = CURVE_WAVES, LEAST_CURVES = 2 * W };

wt_pooled_misfit wt_pooled_misfit_compute(const double (*misfit)[WT_MISFIT_TERMS], size_t n)
{
    double mean[W] = {0.0}, scatter[W * W] = {0.0}, solved[W], amplitude = 0.0, t = 0.0;
    wt_pooled_misfit pooled = {.n = n, .misfit = (double)NAN, .p_value = (double)NAN};
    if (n < LEAST_CURVES)
        return pooled;
    gsl_quiet();
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < W; a++)
            mean[a] += misfit[i][a] / (double)n;
    for (size_t i = 0; i < n; i++)
        for (size_t a = 0; a < W; a++)
            for (size_t b = 0; b < W; b++)
                scatter[a * W + b] +=
                    (misfit[i][a] - mean[a]) * (misfit[i][b] - mean[b]) / (double)(n - 1);
    gsl_matrix_view matrix = gsl_matrix_view_array(scatter, W, W);
    gsl_vector_view x = gsl_vector_view_array(solved, W);
    for (size_t a = 0; a < W; a++) {
        solved[a] = mean[a];
        amplitude += 0.5 * mean[a] * mean[a];
    }
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS ||
        gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
        return pooled;
    for (size_t a = 0; a < W; a++)
        t += mean[a] * solved[a];
    const double curves = (double)n;
    pooled.misfit = sqrt(amplitude);
    pooled.p_value =
        gsl_cdf_fdist_Q(curves * t * (curves - W) / (W * (curves - 1.0)), W, curves - W);
    return pooled;
}

/* ---- two groups ------------------------------------------------------------------------------ */

/* Largest number of units for the exact distribution. Its counts, at most 50 over 25 or 1.3e14, are
 * exact in a double. */
enum { EXACT_UNITS = 50 };
/* Customary power of a test since Cohen (1988). */
static const double test_power = 0.8;

/* ---- the difference of two means ------------------------------------------------------------- */

/* Largest scatter of a single unit over that of the other group. A single unit has no scatter of
 * its own. Between two groups of five units of one population the ratio is below two in 90 % of the
 * cases (square root of F(0.9; 4, 4) = 4.1), so repeats of usual number do not exclude it. */
static const double single_unit_scatter = 2;

/* Standard error of one unit against several, whose scatter is the only one available. */
static t_error single_unit_error(moments repeated, t_error shift, double known)
{
    const t_error mean_error = {
        sqrt(repeated.variance * (1 / repeated.n + single_unit_scatter * single_unit_scatter)),
        repeated.n - 1};
    const t_error parts[] = {mean_error, shift, {sqrt(known), (double)INFINITY}};
    return t_error_sum(parts, COUNT_OF(parts));
}

/* Uses the pooled standard deviation if two units are compared with more and Welch's interval is
 * narrower. */
t_error compare_welch(moments a, moments b, t_error shift, double known)
{
    if (fmin(a.n, b.n) < 2)
        return single_unit_error(a.n > b.n ? a : b, shift, known);
    const t_error normal = {sqrt(known), (double)INFINITY};
    const t_error parts[] = {
        {sqrt(a.variance / a.n), a.n - 1}, {sqrt(b.variance / b.n), b.n - 1}, shift, normal};
    const t_error welch = t_error_sum(parts, COUNT_OF(parts));
    if (fmin(a.n, b.n) > 2 || fmax(a.n, b.n) < 3)
        return welch;
    const double df = a.n + b.n - 2;
    const double scatter = ((a.n - 1) * a.variance + (b.n - 1) * b.variance) / df;
    const t_error together[] = {{sqrt(scatter * (1 / a.n + 1 / b.n)), df}, shift, normal};
    const t_error pooled = t_error_sum(together, COUNT_OF(together));
    const bool wider =
        pooled.error * students_t_quantile(pooled.df) > welch.error * students_t_quantile(welch.df);
    return wider ? pooled : welch;
}

size_t wt_required_spots(double log_ratio, double scatter)
{
    for (size_t n = 2; n <= 1000; n++) {
        const double df = 2.0 * (double)n - 2;
        if (students_t_quantile(df) + gsl_cdf_tdist_Pinv(test_power, df) <=
            fabs(log_ratio) / (scatter * sqrt(2.0 / (double)n)))
            return n;
    }
    return 0;
}

/* ---- ranks ----------------------------------------------------------------------------------- */

/* Number of rankings of m + n units without ties for each U = 0..m n: the coefficients of the
 * Gaussian binomial. counts: [m n + 1]. */
static void count_rankings(size_t m, size_t n, double *counts)
{
    size_t top = m * n;
    memset(counts, 0, (top + 1) * sizeof *counts);
    counts[0] = 1.0;
    for (size_t j = 1; j <= m; j++) {
        for (size_t u = top; u >= n + j; u--) /* multiplies by 1 - x^(n+j) */
            counts[u] -= counts[u - n - j];
        for (size_t u = j; u <= top; u++) /* divides by 1 - x^j */
            counts[u] += counts[u - j];
    }
}

typedef struct ranked_unit {
    double value;
    bool track;
} ranked_unit;

/* Computes U of the track from the sum of its ranks, with mean ranks for ties. *ties is the sum of
 * t^3 - t over groups of t equal values. All values are integers or halves and exact. */
static void rank_units(const compare_units *units, arena *memory, double *u, double *ties)
{
    const size_t m = units->n[1], n = m + units->n[0];
    ranked_unit *all = arena_alloc(memory, n, sizeof *all);
    for (size_t i = 0; i < n; i++)
        all[i] = i < m ? (ranked_unit){units->value[1][i], true}
                       : (ranked_unit){units->value[0][i - m], false};
    qsort(all, n, sizeof *all, numbers_compare);
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
}

void compare_ranks(const compare_units *units, arena *memory, wt_comparison *result)
{
    const size_t m = units->n[1], n = units->n[0];
    double u = 0.0, ties = 0.0;
    rank_units(units, memory, &u, &ties);
    const double pairs = (double)m * (double)n, all = (double)(m + n);
    const double lower = fmin(u, pairs - u);
    result->mann_whitney_u = u;
    result->mann_whitney_smallest_p =
        fmin(1.0, 2.0 * exp(lgamma((double)m + 1) + lgamma((double)n + 1) - lgamma(all + 1)));
    result->mann_whitney_exact = ties == 0.0 && m + n <= EXACT_UNITS;
    if (!result->mann_whitney_exact) {
        double variance = pairs / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
        double distance = fmax(0.0, 0.5 * pairs - lower - 0.5); /* continuity correction */
        result->mann_whitney_p =
            variance > 0.0 ? fmin(1.0, 2.0 * gsl_cdf_ugaussian_Q(distance / sqrt(variance))) : 1.0;
        return;
    }
    double *counts = arena_numbers(memory, m * n + 1);
    count_rankings(m, n, counts);
    double tail = 0.0, total = 0.0;
    for (size_t i = 0; i <= m * n; i++) {
        total += counts[i];
        if ((double)i <= lower)
            tail += counts[i];
    }
    result->mann_whitney_p = fmin(1.0, 2.0 * tail / total);
}

void wt_holm_adjust(const double *p, size_t n, double *adjusted)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++) {
        left += isnan(p[i]) ? 0 : 1;
        adjusted[i] = isnan(p[i]) ? (double)NAN : -1.0; /* -1: pending */
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
