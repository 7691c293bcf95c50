/* A penalised cubic B-spline on a uniform grid of log frequency (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_PSPLINE_H
#define WT_FIT_PSPLINE_H

#include "weartrack/base.h"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

enum { PSPLINE_ORDER = 4 };

/* Knots lie at whole multiples of a third of a decade, wherever the data begin, so shifting the
 * data moves no knot. */
typedef struct spline_fit {
    long first;              /* grid number of the first cell */
    size_t n;                /* coefficients */
    gsl_matrix *gram;        /* n x order, lower band; its Cholesky factor once solved */
    gsl_vector *coefficient; /* right-hand side until solved */
} spline_fit;

/* Covers [x_min, x_max] (decades). WT_E_CONVERGENCE if that is absurdly wide. */
wt_status pspline_new(spline_fit *s, double x_min, double x_max, wt_error *err) WT_NODISCARD;
void pspline_free(spline_fit *s);
/* First of the four coefficients that matter at x, with value and slope of their functions. */
size_t pspline_locate(const spline_fit *s, double x, double value[PSPLINE_ORDER],
                      double slope[PSPLINE_ORDER]);
/* Adds a point to the normal equations. */
void pspline_add(spline_fit *s, double x, double y, double weight);
/* Coefficients of the penalised least squares; *penalty: the penalty at the solution. */
wt_status pspline_solve(spline_fit *s, double *penalty, wt_error *err) WT_NODISCARD;
/* Inverse of the solved normal matrix; *inverse is new, free with gsl_matrix_free. */
wt_status pspline_inverse(const spline_fit *s, gsl_matrix **inverse, wt_error *err) WT_NODISCARD;
/* Effective number of parameters of the solved spline. */
double pspline_freedom(const spline_fit *s, const gsl_matrix *inverse);
/* Variance of the slope at x for data of unit variance. */
double pspline_slope_variance(const spline_fit *s, const gsl_matrix *inverse, double x);

#endif
