/* A penalised cubic B-spline on a uniform grid, by banded normal equations (P-splines: Eilers and
 * Marx, Statist. Sci. 11 (1996) 89). SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/pspline.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

/* Three knots per decade follow a rubber's transition to better than 0.2 %. */
static const double knot_spacing = 1.0 / 3.0; /* decade */
/* Weight of the squared second differences of the coefficients: it tells gaps how to go on and
 * leaves data alone. */
static const double penalty_weight = 1e-3;
static const double difference[3] = {1.0, -2.0, 1.0};

/* Decades; no rubber spans a tenth of it. */
enum { MAX_SPAN = 400 };

static void basis(double u, double value[PSPLINE_ORDER], double slope[PSPLINE_ORDER])
{
    const double v = 1.0 - u;
    value[0] = v * v * v / 6.0;
    value[1] = (4.0 + u * u * (3.0 * u - 6.0)) / 6.0;
    value[2] = (4.0 + v * v * (3.0 * v - 6.0)) / 6.0;
    value[3] = u * u * u / 6.0;
    slope[0] = -0.5 * v * v / knot_spacing;
    slope[1] = 0.5 * u * (3.0 * u - 4.0) / knot_spacing;
    slope[2] = -0.5 * v * (3.0 * v - 4.0) / knot_spacing;
    slope[3] = 0.5 * u * u / knot_spacing;
}

wt_status pspline_new(spline_fit *s, double x_min, double x_max, wt_error *err)
{
    if (!(x_max - x_min <= MAX_SPAN))
        return wt_fail(err, WT_E_CONVERGENCE, "the shifts spread the isotherms over %g decades",
                       x_max - x_min);
    s->first = (long)floor(x_min / knot_spacing);
    s->n = (size_t)((long)floor(x_max / knot_spacing) - s->first) + PSPLINE_ORDER;
    s->gram = gsl_matrix_calloc(s->n, PSPLINE_ORDER);
    s->coefficient = gsl_vector_calloc(s->n);
    if (s->gram == NULL || s->coefficient == NULL) {
        pspline_free(s);
        return wt_fail(err, WT_E_MEMORY, "no memory for a spline");
    }
    return WT_OK;
}

void pspline_free(spline_fit *s)
{
    if (s == NULL)
        return;
    gsl_matrix_free(s->gram);
    gsl_vector_free(s->coefficient);
    *s = (spline_fit){0};
}

size_t pspline_locate(const spline_fit *s, double x, double value[PSPLINE_ORDER],
                      double slope[PSPLINE_ORDER])
{
    const double scaled = x / knot_spacing;
    const double cell = floor(scaled);
    basis(scaled - cell, value, slope);
    return (size_t)((long)cell - s->first);
}

static void add_to_band(gsl_matrix *gram, size_t row, size_t column, double value)
{
    *gsl_matrix_ptr(gram, column, row - column) += value;
}

void pspline_add(spline_fit *s, double x, double y, double weight)
{
    double value[PSPLINE_ORDER], slope[PSPLINE_ORDER];
    const size_t cell = pspline_locate(s, x, value, slope);
    for (size_t r = 0; r < PSPLINE_ORDER; r++) {
        *gsl_vector_ptr(s->coefficient, cell + r) += weight * value[r] * y;
        for (size_t c = 0; c <= r; c++)
            add_to_band(s->gram, cell + r, cell + c, weight * value[r] * value[c]);
    }
}

wt_status pspline_solve(spline_fit *s, double *penalty, wt_error *err)
{
    for (size_t k = 0; k + 2 < s->n; k++)
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j <= i; j++)
                add_to_band(s->gram, k + i, k + j, penalty_weight * difference[i] * difference[j]);
    if (gsl_linalg_cholesky_band_decomp(s->gram) != GSL_SUCCESS ||
        gsl_linalg_cholesky_band_svx(s->gram, s->coefficient) != GSL_SUCCESS)
        return wt_fail(err, WT_E_CONVERGENCE, "the spline of the master curve is singular");
    double sum = 0.0;
    for (size_t k = 0; k + 2 < s->n; k++) {
        double d = 0.0;
        for (size_t i = 0; i < 3; i++)
            d += difference[i] * gsl_vector_get(s->coefficient, k + i);
        sum += d * d;
    }
    *penalty = penalty_weight * sum;
    return WT_OK;
}

wt_status pspline_inverse(const spline_fit *s, gsl_matrix **inverse, wt_error *err)
{
    gsl_matrix *made = gsl_matrix_alloc(s->n, s->n);
    if (made == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the covariance of a spline");
    if (gsl_linalg_cholesky_band_invert(s->gram, made) != GSL_SUCCESS) {
        gsl_matrix_free(made);
        return wt_fail(err, WT_E_INTERNAL, "banded inverse failed");
    }
    *inverse = made;
    return WT_OK;
}

/* trace(G^-1 (G - P)) = n - trace(G^-1 P) */
double pspline_freedom(const spline_fit *s, const gsl_matrix *inverse)
{
    double held = 0.0;
    for (size_t k = 0; k + 2 < s->n; k++)
        for (size_t i = 0; i < 3; i++)
            for (size_t j = 0; j < 3; j++)
                held += penalty_weight * difference[i] * difference[j] *
                        gsl_matrix_get(inverse, k + i, k + j);
    return (double)s->n - held;
}

double pspline_slope_variance(const spline_fit *s, const gsl_matrix *inverse, double x)
{
    double value[PSPLINE_ORDER], slope[PSPLINE_ORDER], sum = 0.0;
    const size_t cell = pspline_locate(s, x, value, slope);
    for (size_t i = 0; i < PSPLINE_ORDER; i++)
        for (size_t j = 0; j < PSPLINE_ORDER; j++)
            sum += slope[i] * slope[j] * gsl_matrix_get(inverse, cell + i, cell + j);
    return sum;
}
