/* Joint estimate of two correlated constants from several cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/numerics/correlated_pair.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/special.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

enum { ENERGY, WEAR, N_CONSTANTS }; /* the constants of a pair, and their number */
/* Largest share of common errors that keeps the covariance matrix regular in double precision, and
 * the smallest share tried. */
static const double whole = 1 - 1e-6, min_common_share = 1.0 / 64;
/* Relative limit of the determinant: below it the two constants are fully correlated. */
static const double min_relative_determinant = 1e-9;

constant_axes constant_axes_compute(pair_covariance c)
{
    const double middle = 0.5 * (c.energy + c.wear),
                 apart = hypot(0.5 * (c.energy - c.wear), c.both),
                 angle = 0.5 * atan2(2 * c.both, c.energy - c.wear),
                 scale = sqrt(c.energy * c.wear);
    constant_axes a = {.correlation = scale > 0 ? fmax(-1, fmin(1, c.both / scale)) : (double)NAN,
                       .loose_error = sqrt(middle + apart),
                       .tight_error = sqrt(fmax(middle - apart, 0))};
    if (isnan(angle))
        a.tight_error = (double)NAN; /* fmax ignores NaN */
    else if (fabs(cos(angle)) >= fabs(sin(angle)))
        clocale_print(a.loose, sizeof a.loose, "U_c k^%.2f", tan(angle));
    else
        clocale_print(a.loose, sizeof a.loose, "k U_c^%.2f", 1 / tan(angle));
    return a;
}

static double covariance_determinant(pair_covariance c)
{
    return c.energy * c.wear - c.both * c.both;
}

static pair_covariance invert_covariance(pair_covariance c)
{
    const double d = covariance_determinant(c);
    return (pair_covariance){c.wear / d, c.energy / d, -c.both / d};
}

/* ---- common errors --------------------------------------------------------------------------- */

typedef struct pair_work {
    const constant_pair *of;
    const bool *common;
    size_t n;
    double *root;       /* [n][2][2] lower Cholesky factors of the covariances of the inputs */
    double *covariance; /* [2n][2n] */
    double *columns;    /* [3][2n] design columns of both constants, and the values */
} pair_work;

static void compute_covariance_root(pair_covariance c, double root[4])
{
    root[0] = sqrt(fmax(c.energy, 0));
    root[1] = 0;
    root[2] = root[0] > 0 ? c.both / root[0] : 0;
    root[3] = sqrt(fmax(c.wear - root[2] * root[2], 0));
}

/* Covariance of constant `a` of pair i with constant `b` of pair k. */
static double element_covariance(const pair_work *w, double part, size_t i, size_t k, size_t a,
                                 size_t b)
{
    const pair_covariance *c = &w->of[i].whole;
    if (i == k)
        return a != b ? c->both : a == ENERGY ? c->energy : c->wear;
    if (!w->common[i * w->n + k])
        return 0;
    const double *p = w->root + 4 * i + 2 * a, *q = w->root + 4 * k + 2 * b;
    return part * (p[0] * q[0] + p[1] * q[1]);
}

static double dot_product(const double *x, const double *y, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

/* Computes chi-squared by generalised least squares. False if the covariance matrix is singular. */
static bool compute_chi_squared(pair_work *w, double part, double *to)
{
    const size_t all = N_CONSTANTS * w->n;
    gsl_matrix_view v = gsl_matrix_view_array(w->covariance, all, all);
    for (size_t r = 0; r < all; r++) {
        w->columns[r] = r % N_CONSTANTS == ENERGY;
        w->columns[all + r] = r % N_CONSTANTS == WEAR;
        w->columns[2 * all + r] = r % N_CONSTANTS == ENERGY
                                      ? w->of[r / N_CONSTANTS].energy - w->of[0].energy
                                      : w->of[r / N_CONSTANTS].wear - w->of[0].wear;
        for (size_t c = 0; c < all; c++)
            w->covariance[r * all + c] = element_covariance(
                w, part, r / N_CONSTANTS, c / N_CONSTANTS, r % N_CONSTANTS, c % N_CONSTANTS);
    }
    if (gsl_linalg_cholesky_decomp1(&v.matrix) != 0)
        return false;
    for (size_t k = 0; k < 3; k++) {
        gsl_vector_view x = gsl_vector_view_array(w->columns + k * all, all);
        if (gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, &v.matrix, &x.vector) != 0)
            return false;
    }
    const double *e = w->columns, *k = e + all, *y = k + all;
    const pair_covariance i = invert_covariance(
        (pair_covariance){dot_product(e, e, all), dot_product(k, k, all), dot_product(e, k, all)});
    const double of_e = dot_product(e, y, all), of_k = dot_product(k, y, all);
    *to = fmax(dot_product(y, y, all) - i.energy * of_e * of_e - i.wear * of_k * of_k -
                   2 * i.both * of_e * of_k,
               0);
    return true;
}

/* ---- the common pair ------------------------------------------------------------------------- */

/* Weight matrix of pair i by rows; `sum` is the inverse of the sum of the weights. */
static void pair_weight(const pair_work *w, pair_covariance sum, size_t i, double weight[4])
{
    const pair_covariance precision = invert_covariance(w->of[i].whole);
    weight[0] = sum.energy * precision.energy + sum.both * precision.both;
    weight[1] = sum.energy * precision.both + sum.both * precision.wear;
    weight[2] = sum.both * precision.energy + sum.wear * precision.both;
    weight[3] = sum.both * precision.both + sum.wear * precision.wear;
}

static void add_common(const pair_work *w, pair_covariance sum, size_t i, size_t k,
                       pair_covariance *to)
{
    double p[4], q[4];
    pair_weight(w, sum, i, p);
    pair_weight(w, sum, k, q);
    for (size_t a = 0; a < N_CONSTANTS; a++)
        for (size_t b = 0; b < N_CONSTANTS; b++) {
            const double c = element_covariance(w, 1, i, k, a, b);
            to->energy += p[a] * c * q[b];
            to->wear += p[2 + a] * c * q[2 + b];
            to->both += p[a] * c * q[2 + b];
        }
}

static void compute_weighted_mean(const pair_work *w, shared_pair *to)
{
    pair_covariance sum = {0, 0, 0};
    for (size_t i = 0; i < w->n; i++) {
        const pair_covariance precision = invert_covariance(w->of[i].whole);
        sum = (pair_covariance){sum.energy + precision.energy, sum.wear + precision.wear,
                                sum.both + precision.both};
    }
    sum = invert_covariance(sum);
    pair_covariance common = sum;
    for (size_t i = 0; i < w->n; i++) {
        double weight[4];
        pair_weight(w, sum, i, weight);
        to->energy += weight[0] * w->of[i].energy + weight[1] * w->of[i].wear;
        to->wear += weight[2] * w->of[i].energy + weight[3] * w->of[i].wear;
        for (size_t k = 0; k < w->n; k++)
            if (i != k)
                add_common(w, sum, i, k, &common);
    }
    to->covariance = common.energy + common.wear > sum.energy + sum.wear ? common : sum;
}

static void fit_shared_pair(pair_work *w, shared_pair *to)
{
    double common;
    *to = (shared_pair){.energy = 0};
    for (size_t i = 0; i < w->n; i++)
        compute_covariance_root(w->of[i].inputs, w->root + 4 * i);
    compute_weighted_mean(w, to);
    (void)compute_chi_squared(w, 0, &to->chi_squared);
    for (double part = whole; part > min_common_share; part /= 2)
        if (compute_chi_squared(w, part, &common)) {
            to->chi_squared = fmin(to->chi_squared, common);
            break;
        }
    to->p = gsl_cdf_chisq_Q(to->chi_squared, N_CONSTANTS * ((double)w->n - 1));
}

wt_status shared_pair_fit(const constant_pair *of, const bool *common, size_t n, shared_pair *to,
                          wt_error *err)
{
    gsl_quiet();
    if (n < 2)
        return wt_fail(err, WT_E_ARG, "one pair shares nothing");
    for (size_t i = 0; i < n; i++)
        if (!(covariance_determinant(of[i].whole) >
              min_relative_determinant * of[i].whole.energy * of[i].whole.wear))
            return wt_fail(err, WT_E_ARG, "a pair without a covariance shares nothing");
    arena memory = {0};
    pair_work w = {.of = of,
                   .common = common,
                   .n = n,
                   .root = arena_numbers(&memory, 4 * n),
                   .covariance = arena_numbers(&memory, N_CONSTANTS * n * N_CONSTANTS * n),
                   .columns = arena_numbers(&memory, 3 * N_CONSTANTS * n)};
    fit_shared_pair(&w, to);
    arena_free(&memory);
    return WT_OK;
}
