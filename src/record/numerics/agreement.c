/* Smooth curve of ln(measured/predicted) over the logarithm of the velocity.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numerics/agreement.h"

#include "core/base/array.h"
#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"
#include "core/math/students_t.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- curve ----------------------------------------------------------------------------------- */

/* Counts the distinct velocities and returns their range. */
static size_t count_velocities(const agreement_data *d, double ends[2])
{
    double *const sorted = wt_alloc(d->n, sizeof *sorted);
    memcpy(sorted, d->log_velocity, d->n * sizeof *sorted);
    numbers_sort(sorted, d->n);
    double last = sorted[0];
    size_t n = 1;
    for (size_t i = 1; i < d->n; i++)
        if (sorted[i] - last > AGREEMENT_MIN_SEPARATION) {
            n++;
            last = sorted[i];
        }
    ends[0] = sorted[0];
    ends[1] = sorted[d->n - 1];
    free(sorted);
    return n;
}

/* Computes the rows of `weight` for a scatter: (X W X)^-1 X W. False if the velocities do not
 * determine all terms. */
static bool find_curve_weights(const agreement_data *d, agreement *a, double scatter)
{
    /* A term is undetermined by rounding if less than this part of it is independent of the
     * others. */
    const double least = 1e-12;
    const size_t p = a->terms;
    double normal[AGREEMENT_TERMS * AGREEMENT_TERMS] = {0};
    for (size_t i = 0; i < d->n; i++)
        for (size_t k = 0; k < p; k++)
            for (size_t l = 0; l <= k; l++)
                normal[k * p + l] += a->at[k * d->n + i] * a->at[l * d->n + i] /
                                     (d->measurement_variance[i] + scatter);
    for (size_t i = 0; i < d->n; i++) {
        double factor[AGREEMENT_TERMS * AGREEMENT_TERMS], x[AGREEMENT_TERMS];
        memcpy(factor, normal, sizeof normal);
        for (size_t k = 0; k < p; k++)
            x[k] = a->at[k * d->n + i] / (d->measurement_variance[i] + scatter);
        if (!cholesky_solve(factor, p, p, least, x))
            return false;
        for (size_t k = 0; k < p; k++)
            a->weight[k * d->n + i] = x[k];
    }
    return true;
}

static void find_curve(const agreement_data *d, agreement *a)
{
    for (size_t k = 0; k < a->terms; k++) {
        a->coefficient[k] = 0;
        for (size_t i = 0; i < d->n; i++)
            a->coefficient[k] += a->weight[k * d->n + i] * d->value[i];
    }
    for (size_t i = 0; i < d->n; i++) {
        a->fitted_value[i] = 0;
        for (size_t k = 0; k < a->terms; k++)
            a->fitted_value[i] += a->coefficient[k] * a->at[k * d->n + i];
    }
}

/* Variance of the residual at step i due to the prediction. `row`: [n] scratch. */
static double residual_prediction_variance(const agreement_data *d, const agreement *a, size_t i,
                                           double *row)
{
    double sum = 0;
    agreement_weights(a, i, row);
    for (size_t k = 0; k < d->n; k++)
        row[k] = (k == i ? 1 : 0) - row[k];
    for (size_t k = 0; k < d->n; k++)
        for (size_t l = 0; l < d->n; l++)
            sum += row[k] * d->prediction_covariance[k * d->n + l] * row[l];
    return fmax(sum, 0);
}

/* Weighted residual squares over their expectation, less 1. A value below 0 needs no further
 * scatter. `shape`: variance of each residual due to the prediction. */
static double excess_chi_squared(const agreement_data *d, agreement *a, double scatter,
                                 const double *shape)
{
    double sum = 0, expected = (double)(d->n - a->terms);
    if (!find_curve_weights(d, a, scatter))
        return -1;
    find_curve(d, a);
    for (size_t i = 0; i < d->n; i++) {
        const double left = d->value[i] - a->fitted_value[i],
                     variance = d->measurement_variance[i] + scatter;
        sum += left * left / variance;
        expected += shape[i] / variance;
    }
    return sum / expected - 1;
}

/* Bisections of an interval that starts at the sum of squares, to 1e-12 of it. */
enum { HALVINGS = 40 };

static void find_excess_scatter(const agreement_data *d, agreement *a, const double *shape)
{
    double low = 0, high = 0;
    a->scatter = 0;
    if (d->n == a->terms || excess_chi_squared(d, a, 0, shape) <= 0)
        return;
    for (size_t i = 0; i < d->n; i++)
        high += (d->value[i] - a->fitted_value[i]) * (d->value[i] - a->fitted_value[i]);
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        if (excess_chi_squared(d, a, middle, shape) > 0)
            low = middle;
        else
            high = middle;
    }
    a->scatter = 0.5 * (low + high);
}

/* Standard errors of the curve at all steps. `row`: [n] scratch. */
static void find_curve_errors(const agreement_data *d, agreement *a, double *row)
{
    for (size_t i = 0; i < d->n; i++) {
        double variance = 0, scatter = 0;
        agreement_weights(a, i, row);
        for (size_t k = 0; k < d->n; k++) {
            scatter += row[k] * row[k] * a->scatter;
            variance += row[k] * row[k] * (d->measurement_variance[k] + a->scatter);
            for (size_t l = 0; l < d->n; l++)
                variance += row[k] * d->prediction_covariance[k * d->n + l] * row[l];
        }
        a->error[i] = sqrt(variance);
        a->df[i] = agreement_df(variance, scatter, a->scatter_df);
    }
}

static void alloc_agreement(const agreement_data *d, agreement *a)
{
    a->weight = arena_numbers(&a->memory, a->terms * d->n);
    a->fitted_value = arena_numbers(&a->memory, d->n);
    a->error = arena_numbers(&a->memory, d->n);
    a->df = arena_numbers(&a->memory, d->n);
    a->at = arena_numbers(&a->memory, a->terms * d->n);
    for (size_t k = 0; k < a->terms; k++)
        for (size_t i = 0; i < d->n; i++) {
            const double u = (d->log_velocity[i] - a->centre) / a->span;
            a->at[k * d->n + i] = k == 0 ? 1 : k == 1 ? u : u * u;
        }
}

wt_status agreement_fit(const agreement_data *data, size_t most_terms, agreement *a, wt_error *err)
{
    *a = (agreement){.n = data->n};
    double ends[2] = {0, 0};
    if (data->n == 0)
        return wt_fail(err, WT_E_EMPTY, "no step to be compared");
    const size_t places = count_velocities(data, ends);
    a->terms = places < 3 ? 1 : places < 5 ? 2 : AGREEMENT_TERMS;
    if (most_terms > 0 && a->terms > most_terms)
        a->terms = most_terms;
    a->centre = 0.5 * (ends[0] + ends[1]);
    a->span = ends[1] > ends[0] ? 0.5 * (ends[1] - ends[0]) : 1;
    a->scatter_df = (double)(data->n - a->terms);
    double *const shape = wt_alloc(data->n, sizeof *shape), *const row =
                                                                wt_alloc(data->n, sizeof *row);
    wt_status status = WT_OK;
    alloc_agreement(data, a);
    if (!find_curve_weights(data, a, 0))
        status = wt_fail(err, WT_E_INTERNAL, "the velocities do not determine a curve");
    for (size_t i = 0; status == WT_OK && i < data->n; i++)
        shape[i] = residual_prediction_variance(data, a, i, row);
    if (status == WT_OK) {
        find_excess_scatter(data, a, shape);
        (void)excess_chi_squared(data, a, a->scatter, shape); /* weights for this scatter */
        find_curve_errors(data, a, row);
    }
    free(shape);
    free(row);
    return status;
}

void agreement_clear(agreement *a)
{
    arena_free(&a->memory);
    *a = (agreement){.n = 0};
}

void agreement_weights(const agreement *a, size_t i, double *row)
{
    for (size_t k = 0; k < a->n; k++) {
        row[k] = 0;
        for (size_t t = 0; t < a->terms; t++)
            row[k] += a->weight[t * a->n + k] * a->at[t * a->n + i];
    }
}

/* ---- intervals ------------------------------------------------------------------------------- */

double agreement_quantile(double df)
{
    return students_t_quantile(isfinite(df) ? df : (double)INFINITY);
}

double agreement_df(double variance, double scatter, double df)
{
    return scatter > 0 && df > 0 ? df * (variance / scatter) * (variance / scatter)
                                 : (double)INFINITY;
}

/* Quantile of an interval that holds at all steps simultaneously. */
static double simultaneous_quantile(const agreement *a, double df)
{
    const double terms = (double)a->terms, each = 0.05 / (2 * (double)a->n);
    const double scheffe = isfinite(df) ? sqrt(terms * gsl_cdf_fdist_Pinv(0.95, terms, df))
                                        : sqrt(gsl_cdf_chisq_Pinv(0.95, terms)),
                 bonferroni =
                     isfinite(df) ? gsl_cdf_tdist_Qinv(each, df) : gsl_cdf_ugaussian_Qinv(each);
    return fmin(scheffe, bonferroni);
}

void agreement_interval(const agreement *a, size_t i, bool at_once, double ends[2])
{
    const double half =
        (at_once ? simultaneous_quantile(a, a->df[i]) : agreement_quantile(a->df[i])) * a->error[i];
    ends[0] = a->fitted_value[i] - half;
    ends[1] = a->fitted_value[i] + half;
}

void agreement_assess(agreement *a, double margin)
{
    double farthest = -(double)INFINITY, beyond = 0;
    a->verdict = AGREEMENT_YES;
    a->deciding_step = 0;
    for (size_t i = 0; i < a->n; i++) {
        const double off = fabs(a->fitted_value[i]),
                     reach = off + agreement_quantile(a->df[i]) * a->error[i],
                     least = off - simultaneous_quantile(a, a->df[i]) * a->error[i] - margin;
        if (least > beyond) {
            a->verdict = AGREEMENT_NO;
            a->deciding_step = i;
            beyond = least;
        }
        if (a->verdict != AGREEMENT_NO && reach > farthest) {
            farthest = reach;
            a->deciding_step = i;
            a->verdict = reach > margin ? AGREEMENT_INCONCLUSIVE : AGREEMENT_YES;
        }
    }
}
