/* Interval limits from replicates, corrected for the sampling error of the draws.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/replicate_intervals.h"

#include "core/base/array.h"
#include "core/math/cholesky.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>

/* Quantile of n sorted values at the probability `part`; NaN beyond the last of the m finite ones.
 */
static double censored_quantile(const double *sorted, size_t m, size_t n, double part)
{
    const double at = fmax(part * (double)n - 0.5, 0);
    const size_t i = (size_t)at;
    if (i + 1 >= m)
        return (double)NAN;
    return sorted[i] + (at - (double)i) * (sorted[i + 1] - sorted[i]);
}

/* ---- along the line -------------------------------------------------------------------------- */

typedef struct parabola {
    double b[3];
} parabola;

/* Fits a parabola to the values against their positions along the linear fit; the quadratic term
 * describes nonlinearity. False if the fit is singular. */
static bool fit_parabola(const replicates *r, size_t k, const double *at, parabola *fitted)
{
    double a[9] = {0};
    *fitted = (parabola){{0}};
    for (size_t i = 0; i < r->n; i++) {
        const double value = r->value[i * r->stride + k], power[3] = {1, at[i], at[i] * at[i]};
        for (size_t u = 0; isfinite(value) && u < 3; u++) {
            fitted->b[u] += power[u] * value;
            for (size_t v = 0; v <= u; v++)
                a[u * 3 + v] += power[u] * power[v];
        }
    }
    return cholesky_solve(a, 3, 3, 0, fitted->b);
}

static double evaluate_parabola(const parabola *fitted, double x)
{
    return fitted->b[0] + x * (fitted->b[1] + x * fitted->b[2]);
}

typedef struct line_position {
    double at;
    size_t replicate;
} line_position;

static int compare_positions(const void *left, const void *right)
{
    const line_position *const a = left, *const b = right;
    return a->at != b->at ? (a->at > b->at) - (a->at < b->at)
                          : (a->replicate > b->replicate) - (a->replicate < b->replicate);
}

/* Correction of each of the n values if each draw had its expected order statistic; 0 without a
 * fit. */
static void compute_corrections(const replicates *r, size_t k, double *correction)
{
    parabola fitted;
    double *const at = wt_alloc(r->n + 1, sizeof *at);
    line_position *const positions = wt_alloc(r->n + 1, sizeof *positions);
    const bool has_line = replicates_line_positions(r, k, at) && fit_parabola(r, k, at, &fitted);
    for (size_t i = 0; i < r->n; i++)
        correction[i] = 0;
    for (size_t i = 0; has_line && i < r->n; i++)
        positions[i] = (line_position){at[i], i};
    if (has_line)
        qsort(positions, r->n, sizeof *positions, compare_positions);
    for (size_t i = 0; has_line && i < r->n; i++) {
        const double expected = normal_quantile(((double)i + 0.5) / (double)r->n);
        correction[positions[i].replicate] =
            evaluate_parabola(&fitted, expected) - evaluate_parabola(&fitted, positions[i].at);
    }
    free(at);
    free(positions);
}

void replicate_interval(const replicates *r, size_t k, double tail_probability,
                        wt_interval *interval)
{
    double *const sorted = wt_alloc(r->n + 1, sizeof *sorted);
    double *const correction = wt_alloc(r->n + 1, sizeof *correction);
    size_t m = 0;
    compute_corrections(r, k, correction);
    for (size_t i = 0; i < r->n; i++) {
        const double value = r->value[i * r->stride + k];
        if (isfinite(value))
            sorted[m++] = value + correction[i];
    }
    numbers_sort(sorted, m);
    interval->low = exp(censored_quantile(sorted, m, r->n, tail_probability));
    interval->high = exp(censored_quantile(sorted, m, r->n, 1 - tail_probability));
    free(sorted);
    free(correction);
}
