/* Prior of the vertical shifts: the physical shift, with independent clamping scatter and a
 * smooth departure of the material.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/vertical_shift.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"

#include <float.h>
#include <math.h>

/* Correlation length of the departure of the material [K]; a filler network or a transition
 * changes over tens of kelvin. Chosen: at 20 the departure follows isotherms 10 K apart
 * individually, as clamping does. At 80 it is nearly a line. */
static const double correlation_length = 40.0;

/* Returns the covariance of the smooth departure at two temperatures; it is 0 at the reference. */
static double vertical_departure_covariance(const vertical *v, double t1, double t2)
{
    const double r = v->reference_temperature;
    const double k12 =
        exp(-0.5 * (t1 - t2) * (t1 - t2) / (correlation_length * correlation_length));
    const double k1 = exp(-0.5 * (t1 - r) * (t1 - r) / (correlation_length * correlation_length));
    const double k2 = exp(-0.5 * (t2 - r) * (t2 - r) / (correlation_length * correlation_length));
    return k12 - k1 - k2 + 1.0;
}

double vertical_physical(const vertical *v, double temperature)
{
    const double t0 = v->reference_temperature;
    return log(t0 / temperature) + v->expansion * (temperature - t0);
}

void vertical_alloc(arena *memory, size_t n, vertical *v)
{
    const size_t most = n < SPECTRUM_MAX_SMOOTH ? n : SPECTRUM_MAX_SMOOTH;
    v->prior_storage.precision = arena_numbers(memory, n);
    v->prior_storage.smooth = arena_matrix(memory, n, most);
    v->left = arena_numbers(memory, n);
    v->root = arena_matrix(memory, most, most);
    v->prior_storage.at = arena_numbers(memory, most);
}

/* Factors the covariance of the departure by pivoted Cholesky down to rounding. Returns the
 * number of components. */
static size_t factor_departure(const vertical *v, const double *temperature, size_t n,
                               gsl_matrix *smooth)
{
    const double departure = v->departure * M_LN10;
    double *left = v->left;
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        left[i] = vertical_departure_covariance(v, temperature[i], temperature[i]);
    for (; departure > 0.0 && m < smooth->size2; m++) {
        size_t pivot = 0;
        for (size_t i = 1; i < n; i++)
            pivot = left[i] > left[pivot] ? i : pivot;
        if (!(left[pivot] > DBL_EPSILON))
            break;
        const double root = sqrt(left[pivot]);
        for (size_t i = 0; i < n; i++) {
            double with = vertical_departure_covariance(v, temperature[i], temperature[pivot]);
            for (size_t j = 0; j < m; j++)
                with -= gsl_matrix_get(smooth, i, j) * gsl_matrix_get(smooth, pivot, j);
            gsl_matrix_set(smooth, i, m, with / root);
        }
        for (size_t i = 0; i < n; i++)
            left[i] -= pow(gsl_matrix_get(smooth, i, m), 2);
        left[pivot] = 0.0;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++)
            *gsl_matrix_ptr(smooth, i, j) *= departure;
    return m;
}

/* Converts the factor F of the departure to S = F R^-T, where R is the factor of 1 + F' P F.
 * *log_det: ln of its determinant. */
static bool departure_to_smooth(const vertical *v, size_t n, double clamped, size_t m,
                                gsl_matrix *smooth, double *log_det)
{
    double *root = v->root->data;
    const size_t stride = v->root->tda;
    for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k <= j; k++) {
            double sum = 0.0;
            for (size_t i = 0; i < n; i++)
                sum += gsl_matrix_get(smooth, i, j) * gsl_matrix_get(smooth, i, k);
            root[j * stride + k] = clamped * sum + (j == k ? 1.0 : 0.0);
        }
    if (!cholesky_factor(root, stride, m, 0.0))
        return false;
    for (size_t i = 0; i < n; i++)
        cholesky_forward(root, stride, m, gsl_matrix_ptr(smooth, i, 0),
                         gsl_matrix_ptr(smooth, i, 0));
    *log_det = 0.0;
    for (size_t j = 0; j < m; j++)
        *log_det += 2.0 * log(root[j * stride + j]);
    return true;
}

wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err)
{
    const size_t n = s->n_curves;
    const double geometry = v->geometry * M_LN10, clamped = 1.0 / (geometry * geometry);
    *prior = v->prior_storage;
    prior->held = kind == WT_VERTICAL_NONE || kind == WT_VERTICAL_PHYSICAL;
    prior->mean = v->mean;
    for (size_t i = 0; i < n; i++) {
        v->mean[i] = kind == WT_VERTICAL_NONE ? 0.0 : vertical_physical(v, temperature[i]);
        prior->precision[i] = kind == WT_VERTICAL_TIED || i == s->anchor ? clamped : 0.0;
    }
    if (kind == WT_VERTICAL_FREE && geometry > 0.0)
        prior->log_det = 2.0 * log(geometry);
    else if (kind != WT_VERTICAL_TIED)
        prior->precision = NULL;
    if (kind != WT_VERTICAL_TIED)
        return WT_OK;
    const size_t m = prior->n_smooth = factor_departure(v, temperature, n, prior->smooth);
    if (!departure_to_smooth(v, n, clamped, m, prior->smooth, &prior->log_det))
        return wt_fail(err, WT_E_INTERNAL, "the prior of the vertical shifts is not positive");
    prior->log_det += 2.0 * (double)n * log(geometry);
    return WT_OK;
}

void vertical_smooth_part(const spectrum_prior *prior, size_t n, double *weight)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++)
            for (size_t j = 0; j < prior->n_smooth; j++)
                weight[i * n + k] += gsl_matrix_get(prior->smooth, i, j) *
                                     gsl_matrix_get(prior->smooth, k, j) * prior->precision[k];
}
