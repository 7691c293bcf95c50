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
static double quantile(const double *sorted, size_t m, size_t n, double part)
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
static bool find_parabola(const replicates *r, size_t k, const double *at, parabola *bent)
{
    double a[9] = {0};
    *bent = (parabola){{0}};
    for (size_t i = 0; i < r->n; i++) {
        const double value = r->value[i * r->stride + k], power[3] = {1, at[i], at[i] * at[i]};
        for (size_t u = 0; isfinite(value) && u < 3; u++) {
            bent->b[u] += power[u] * value;
            for (size_t v = 0; v <= u; v++)
                a[u * 3 + v] += power[u] * power[v];
        }
    }
    return cholesky_solve(a, 3, 3, 0, bent->b);
}

static double parabola_at(const parabola *bent, double x)
{
    return bent->b[0] + x * (bent->b[1] + x * bent->b[2]);
}

typedef struct place {
    double at;
    size_t replicate;
} place;

static int by_place(const void *left, const void *right)
{
    const place *const a = left, *const b = right;
    return a->at != b->at ? (a->at > b->at) - (a->at < b->at)
                          : (a->replicate > b->replicate) - (a->replicate < b->replicate);
}

/* Correction of each of the n values if each draw had its expected order statistic; 0 without a
 * fit. */
static wt_status find_moves(const replicates *r, size_t k, double *move)
{
    bool known = false;
    parabola bent;
    double *const at = malloc((r->n + 1) * sizeof *at);
    place *const places = malloc((r->n + 1) * sizeof *places);
    const wt_status status =
        at != NULL && places != NULL ? replicates_along_line(r, k, at, &known) : WT_E_MEMORY;
    known = status == WT_OK && known && find_parabola(r, k, at, &bent);
    for (size_t i = 0; i < r->n; i++)
        move[i] = 0;
    for (size_t i = 0; known && i < r->n; i++)
        places[i] = (place){at[i], i};
    if (known)
        qsort(places, r->n, sizeof *places, by_place);
    for (size_t i = 0; known && i < r->n; i++) {
        const double expected = normal_quantile(((double)i + 0.5) / (double)r->n);
        move[places[i].replicate] = parabola_at(&bent, expected) - parabola_at(&bent, places[i].at);
    }
    free(at);
    free(places);
    return status;
}

wt_status replicate_interval(const replicates *r, size_t k, double beyond, wt_interval *interval)
{
    double *const sorted = malloc((r->n + 1) * sizeof *sorted);
    double *const move = malloc((r->n + 1) * sizeof *move);
    size_t m = 0;
    const wt_status status = sorted != NULL && move != NULL ? find_moves(r, k, move) : WT_E_MEMORY;
    for (size_t i = 0; status == WT_OK && i < r->n; i++) {
        const double value = r->value[i * r->stride + k];
        if (isfinite(value))
            sorted[m++] = value + move[i];
    }
    if (status == WT_OK) {
        numbers_sort(sorted, m);
        interval->low = exp(quantile(sorted, m, r->n, beyond));
        interval->high = exp(quantile(sorted, m, r->n, 1 - beyond));
    }
    free(sorted);
    free(move);
    return status;
}
