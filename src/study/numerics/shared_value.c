/* Common value of several independent measurements. The weights use the errors alone, because
 * systematic errors are known too poorly for weights. All results hold with zero and with full
 * covariance. Errors with few degrees of freedom widen the interval (Meier, Biometrics 9 (1953) 59)
 * and enter the test (Welch, Biometrika 38 (1951) 330). Otherwise the test is chi-squared with the
 * inverse covariance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/numerics/shared_value.h"
#include "core/math/special.h"
#include "core/math/students_t.h"
#include "weartrack/study.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

/* ---- two ratios ------------------------------------------------------------------------------ */

/* Contribution to the denominator of Satterthwaite's degrees of freedom; 0 for a normal error. */
static double df_component(const wt_log_ratio *ratio)
{
    const double variance = ratio->standard_error * ratio->standard_error;
    return isnan(ratio->df) ? 0 : variance * variance / ratio->df;
}

wt_log_ratio_difference wt_log_ratio_compare(const wt_log_ratio *a, const wt_log_ratio *b)
{
    const double nan = (double)NAN;
    wt_log_ratio_difference d = {a->value - b->value, nan, nan, nan, nan};
    const double error = hypot(a->standard_error, b->standard_error);
    if (!isfinite(d.value) || !(error > 0) || !isfinite(error))
        return d;
    const double part = df_component(a) + df_component(b), t = fabs(d.value) / error;
    if (part > 0)
        d.df = error * error * error * error / part;
    const double reach = error * students_t_quantile(part > 0 ? d.df : (double)INFINITY);
    d.low = d.value - reach;
    d.high = d.value + reach;
    d.p = 2 * (part > 0 ? gsl_cdf_tdist_Q(t, d.df) : gsl_cdf_ugaussian_Q(t));
    return d;
}

static const double outside = 0.05; /* error probability of all intervals together, and of one */

/* Below this many degrees of freedom, intervals of weighted means contain the truth in 90 % or
 * less, with any correction. Above it the share is 94 % (simulated with 4 and 8 groups). */
static const double few = 4;

/* Work arrays of one allocation. */
typedef struct shared_work {
    size_t n;
    double *weight, *apart, *common, *factor, *solved; /* [n], 3 of [n n], [2 n] */
} shared_work;

/* ---- several values -------------------------------------------------------------------------- */

/* Fills the covariance matrix with a fraction of the possible covariances. */
static void fill_covariance(const wt_log_ratio *of, const double *covariance, double part, size_t n,
                            double *to)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++)
            to[i * n + k] = i == k               ? of[i].standard_error * of[i].standard_error
                            : covariance != NULL ? part * covariance[i * n + k]
                                                 : 0;
}

static double min_df(const wt_log_ratio *of, size_t n)
{
    double least = (double)INFINITY;
    for (size_t i = 0; i < n; i++)
        least = fmin(least, of[i].df); /* fmin skips NaN */
    return least;
}

static void find_mean_weights(const wt_log_ratio *of, shared_work *w)
{
    const bool plain = min_df(of, w->n) < few;
    double sum = 0;
    for (size_t i = 0; i < w->n; i++)
        sum += w->weight[i] = plain ? 1 : 1 / (of[i].standard_error * of[i].standard_error);
    for (size_t i = 0; i < w->n; i++)
        w->weight[i] /= sum;
}

/* Variance of the weighted mean (less = n), or of value `less` minus the mean. */
static double difference_variance(const shared_work *w, const double *covariance, size_t less)
{
    double sum = 0;
    for (size_t i = 0; i < w->n; i++)
        for (size_t k = 0; k < w->n; k++)
            sum += ((i == less) - w->weight[i]) * ((k == less) - w->weight[k]) *
                   covariance[i * w->n + k];
    return fmax(sum, 0);
}

/* Chi-squared about the best value with the covariance in w->factor. False if it is not positive
 * definite. */
static bool compute_chi_squared(const wt_log_ratio *of, shared_work *w, double *to)
{
    const size_t n = w->n;
    double *const one = w->solved, *const value = w->solved + n;
    gsl_matrix_view m = gsl_matrix_view_array(w->factor, n, n);
    gsl_vector_view of_one = gsl_vector_view_array(one, n),
                    of_value = gsl_vector_view_array(value, n);
    double ones = 0, mixed = 0, values = 0;
    for (size_t i = 0; i < n; i++) {
        one[i] = 1;
        value[i] = of[i].value - of[0].value;
    }
    if (gsl_linalg_cholesky_decomp1(&m.matrix) != 0 ||
        gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, &m.matrix, &of_one.vector) != 0 ||
        gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, &m.matrix, &of_value.vector) != 0)
        return false;
    for (size_t i = 0; i < n; i++) {
        ones += one[i] * one[i];
        mixed += one[i] * value[i];
        values += value[i] * value[i];
    }
    *to = fmax(values - mixed * mixed / ones, 0);
    return true;
}

/* Smaller chi-squared of zero and full covariance. With full covariance, differences of values may
 * be exactly known. Pairwise covariances (a with b, b with c, not a with c) may not form a
 * covariance matrix. The largest admissible fraction is used then. */
static double min_chi_squared(const wt_log_ratio *of, const double *covariance, shared_work *w)
{
    const double whole = 1 - 1e-6, least = 1.0 / 64; /* accuracy of a covariance; smallest
                                                        fraction tried */
    double apart = 0, common = 0;
    fill_covariance(of, NULL, 0, w->n, w->factor);
    (void)compute_chi_squared(of, w, &apart);
    for (double part = whole; covariance != NULL && part > least; part /= 2) {
        fill_covariance(of, covariance, part, w->n, w->factor);
        if (compute_chi_squared(of, w, &common))
            return fmin(apart, common);
    }
    return apart;
}

/* Welch's test; its weights are those of the errors. */
static void test_shared_value(const wt_log_ratio *of, const shared_work *w, shared_value *to)
{
    const double k = (double)w->n;
    double spread = 0, sum = 0;
    to->df = k - 1;
    for (size_t i = 0; i < w->n; i++)
        sum += 1 / (of[i].standard_error * of[i].standard_error);
    for (size_t i = 0; i < w->n; i++) {
        const double rest = 1 - 1 / (of[i].standard_error * of[i].standard_error * sum);
        if (!isnan(of[i].df))
            spread += rest * rest / of[i].df;
    }
    to->p =
        spread > 0
            ? gsl_cdf_fdist_Q(to->chi_squared / to->df / (1 + 2 * (k - 2) / (k * k - 1) * spread),
                              to->df, (k * k - 1) / (3 * spread))
            : gsl_cdf_chisq_Q(to->chi_squared, to->df);
}

static double error_quantile(double tail, double df)
{
    return isnan(df) ? gsl_cdf_ugaussian_Qinv(tail) : gsl_cdf_tdist_Qinv(tail, df);
}

/* Interval of the plain mean by Satterthwaite; the weighted mean has the smallest degrees of
 * freedom. */
static void find_interval(const wt_log_ratio *of, const shared_work *w, shared_value *to)
{
    const double variance =
        fmax(difference_variance(w, w->apart, w->n), difference_variance(w, w->common, w->n));
    double df = min_df(of, w->n), estimated = 0, freedom = 0;
    const bool plain = df < few;
    for (size_t i = 0; i < w->n; i++)
        if (!isnan(of[i].df)) {
            const double part = pow(w->weight[i] * of[i].standard_error, 2);
            freedom += part * part / of[i].df;
            estimated += 4 / of[i].df * w->weight[i] * (1 - w->weight[i]);
        }
    if (plain)
        df = variance * variance / freedom;
    to->error = sqrt(variance * (plain ? 1 : 1 + estimated));
    const double half = to->error * error_quantile(outside / 2, isinf(df) ? (double)NAN : df);
    to->low = to->value - half;
    to->high = to->value + half;
}

/* Satterthwaite's degrees of freedom of value i minus the mean. */
static double deviation_df(const wt_log_ratio *of, const shared_work *w, size_t i)
{
    const double variance = difference_variance(w, w->apart, i);
    double freedom = 0;
    for (size_t k = 0; k < w->n; k++)
        if (!isnan(of[k].df)) {
            const double part = pow(((i == k) - w->weight[k]) * of[k].standard_error, 2);
            freedom += part * part / of[k].df;
        }
    return freedom > 0 ? variance * variance / freedom : (double)NAN;
}

static void fit_shared_value(const wt_log_ratio *of, const double *covariance, shared_work *w,
                             shared_value *to, shared_deviation *deviation)
{
    const size_t n = w->n;
    *to = (shared_value){.value = 0};
    fill_covariance(of, NULL, 0, n, w->apart);
    fill_covariance(of, covariance, 1, n, w->common);
    find_mean_weights(of, w);
    for (size_t i = 0; i < n; i++)
        to->value += w->weight[i] * of[i].value;
    find_interval(of, w, to);
    for (size_t i = 0; i < n; i++) {
        const double d = of[i].value - to->value,
                     variance = fmax(difference_variance(w, w->apart, i),
                                     difference_variance(w, w->common, i)),
                     half = error_quantile(outside / 2 / (double)n, deviation_df(of, w, i)) *
                            sqrt(variance);
        deviation[i] = (shared_deviation){d, d - half, d + half};
    }
    to->chi_squared = min_chi_squared(of, covariance, w);
    test_shared_value(of, w, to);
}

wt_status shared_value_fit(const wt_log_ratio *of, const double *covariance, size_t n,
                           shared_value *to, shared_deviation *deviation, wt_error *err)
{
    gsl_quiet();
    if (n < 2)
        return wt_fail(err, WT_E_ARG, "one value shares nothing");
    for (size_t i = 0; i < n; i++)
        if (!(of[i].standard_error > 0) || !isfinite(of[i].value) || of[i].df <= 0)
            return wt_fail(err, WT_E_ARG, "a value without an error shares nothing");
    double *const numbers = wt_alloc(3 * n + 3 * n * n, sizeof *numbers);
    double *const squares = numbers + 3 * n;
    shared_work w = {n, numbers, squares, squares + n * n, squares + 2 * n * n, numbers + n};
    fit_shared_value(of, covariance, &w, to, deviation);
    free(numbers);
    return WT_OK;
}
