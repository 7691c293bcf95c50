/* Effects of the tip within its stated errors, and of a pull, on the parameters of a fit with
 * misfit.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/misfit_bias.h"

#include "core/math/cholesky.h"

#include <math.h>
#include <string.h>

enum {
    N = CURVE_N_PARAMETERS,
    LEGENDRE = MISFIT_FUNCTIONS,
    M = MISFIT_COLUMNS,
    BEND_ROUNDS = 4, /* Newton steps on a parabola in each variation */
    MOVE_STEPS = 12, /* steps to the largest variation in each direction */
};
static const double variation_chi2 = 3.84; /* chi^2 of a variation at the 95 % level */
static const double max_variation = 3.0;   /* limit in standard errors of the tip */

/* Adds `share` of column `of` to column `to` of the sums. */
static void add_sum_column(misfit_sums *d, size_t to, size_t of, double share)
{
    for (size_t k = 0; k < M; k++)
        d->mm[to][k] += share * d->mm[of][k];
    for (size_t k = 0; k < M; k++)
        d->mm[k][to] += share * d->mm[k][of];
    d->my[to] += share * d->my[of];
    for (size_t a = 0; a < d->n_free; a++)
        d->parameter_change[a][to] += share * d->parameter_change[a][of];
}

/* Computes the matrix of the variations with deviations of 1 in triangular form, and the
 * transformed solution. */
static bool solve_variations(const misfit_sums *d, double (*t)[M], double *x)
{
    const size_t n = d->n_variations;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            t[i][j] = d->mm[LEGENDRE + i][LEGENDRE + j] + (i == j ? 1.0 : 0.0);
    if (!cholesky_factor(&t[0][0], M, n, 0.0))
        return false;
    cholesky_forward(&t[0][0], M, n, d->my + LEGENDRE, x);
    return true;
}

/* Linearises the variations about their fitted values, because forces are not linear in the sizes
 * of a tip. The residual changes accordingly. */
static bool linearise_variations(misfit_sums *d)
{
    const misfit_sums straight = *d;
    const size_t n = d->n_variations, bends = LEGENDRE + n;
    double at[CURVE_TIP_VARIATIONS] = {0.0};
    for (int round = 0; round < BEND_ROUNDS && d->n_tips > 0; round++) {
        double t[M][M] = {{0.0}}, x[M];
        *d = straight;
        for (size_t i = 0; i < d->n_tips; i++)
            add_sum_column(d, LEGENDRE + i, bends + i, at[i]);
        for (size_t i = 0; i < d->n_tips; i++)
            for (size_t k = 0; k < M; k++)
                d->my[k] += 0.5 * at[i] * at[i] * d->mm[bends + i][k];
        if (!solve_variations(d, t, x))
            return false;
        for (size_t c = n; c-- > 0;) {
            for (size_t k = c + 1; k < n; k++)
                x[c] -= t[k][c] * x[k];
            x[c] /= t[c][c];
            /* Forces of three tips do not determine larger variations. */
            if (c < d->n_tips)
                at[c] = fmax(-max_variation, fmin(max_variation, x[c]));
        }
    }
    return true;
}

/* Minus 2 ln of the probability density of variation x of tip size i alone, up to a constant. */
static double variation_cost(const misfit_sums *d, size_t i, double x)
{
    const size_t c = LEGENDRE + i, q = LEGENDRE + d->n_variations + i;
    const double bend = 0.5 * x * x;
    return x * x - 2.0 * (x * d->my[c] + bend * d->my[q]) + x * x * d->mm[c][c] +
           2.0 * x * bend * d->mm[c][q] + bend * bend * d->mm[q][q];
}

/* Mean square effect of the variation of tip size i on the parameters, weighted by its probability.
 * Two very different tips may leave an equally small residual if only one of them indents beyond
 * its cap. */
static void variation_variance(const misfit_sums *d, size_t i, double spread[N])
{
    const size_t c = LEGENDRE + i, q = LEGENDRE + d->n_variations + i;
    double least = (double)INFINITY, all = 0.0;
    for (int j = -MOVE_STEPS; j <= MOVE_STEPS; j++)
        least = fmin(least, variation_cost(d, i, max_variation * j / MOVE_STEPS));
    for (size_t a = 0; a < N; a++)
        spread[a] = 0.0;
    for (int j = -MOVE_STEPS; j <= MOVE_STEPS; j++) {
        const double x = max_variation * j / MOVE_STEPS,
                     chance = exp(-0.5 * (variation_cost(d, i, x) - least));
        all += chance;
        for (size_t a = 0; a < d->n_free; a++)
            spread[a] +=
                chance *
                pow(x * d->parameter_change[a][c] + 0.5 * x * x * d->parameter_change[a][q], 2);
    }
    for (size_t a = 0; a < N; a++)
        spread[a] /= all;
}

bool misfit_remove_bias(misfit_sums *d, misfit_candidate *none, double tip[N])
{
    const size_t n = d->n_variations;
    double t[M][M] = {{0.0}}, by[LEGENDRE][M], of_y[M], straight[N][CURVE_TIP_VARIATIONS];
    double spread[CURVE_TIP_VARIATIONS][N];
    *none = (misfit_candidate){.log_likelihood = 0.0};
    for (size_t a = 0; a < d->n_free; a++)
        memcpy(straight[a], d->parameter_change[a] + LEGENDRE, d->n_tips * sizeof straight[a][0]);
    for (size_t i = 0; i < d->n_tips; i++)
        variation_variance(d, i, spread[i]);
    if (!linearise_variations(d) || !solve_variations(d, t, of_y))
        return false;
    const bool is_better_fit =
        misfit_dot(of_y, of_y, n) > variation_chi2 * (double)n && d->n_tips > 0;
    for (size_t k = 0; k < LEGENDRE; k++)
        cholesky_forward(&t[0][0], M, n, d->mm[k] + LEGENDRE, by[k]);
    for (size_t k = 0; k < LEGENDRE; k++) {
        d->my[k] -= misfit_dot(by[k], of_y, n);
        for (size_t l = 0; l < LEGENDRE; l++)
            d->mm[k][l] -= misfit_dot(by[k], by[l], n);
    }
    for (size_t a = 0; a < d->n_free; a++) {
        double y[M];
        cholesky_forward(&t[0][0], M, n, d->parameter_change[a] + LEGENDRE, y);
        none->shift[a] = -misfit_dot(y, of_y, n);
        none->variance[a] = misfit_dot(y, y, n);
        if (is_better_fit) {
            none->shift[a] = 0.0;
            none->variance[a] =
                fmax(misfit_dot(y, y, n), misfit_dot(straight[a], straight[a], d->n_tips));
        }
        for (size_t k = 0; k < d->n_tips; k++)
            none->variance[a] =
                fmax(none->variance[a], spread[k][a] - none->shift[a] * none->shift[a]);
        const double pull =
            d->n_variations > d->n_tips ? d->parameter_change[a][LEGENDRE + d->n_tips] : 0.0;
        tip[a] = d->n_tips > 0 ? fmax(0.0, none->variance[a] - pull * pull) : 0.0;
        for (size_t k = 0; k < LEGENDRE; k++)
            d->parameter_change[a][k] -= misfit_dot(by[k], y, n);
    }
    return true;
}
