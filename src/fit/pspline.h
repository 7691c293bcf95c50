/* A penalised cubic B-spline on a uniform grid of log frequency (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_PSPLINE_H
#define WT_FIT_PSPLINE_H

#include "weartrack/base.h"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

enum { WT_PSPLINE_ORDER = 4 };

/* Knots lie at whole multiples of a third of a decade, wherever the data begin, so shifting the
 * data moves no knot. */
typedef struct wt_pspline {
    long first;              /* grid number of the first cell */
    size_t n;                /* coefficients */
    gsl_matrix *gram;        /* n x order, lower band; its Cholesky factor once solved */
    gsl_vector *coefficient; /* right-hand side until solved */
} wt_pspline;

/* Covers [x_min, x_max] (decades). WT_E_CONVERGENCE if that is absurdly wide. */
wt_status wt_pspline_new(wt_pspline *s, double x_min, double x_max, wt_error *err) WT_NODISCARD;
void wt_pspline_free(wt_pspline *s);
/* First of the four coefficients that matter at x, with value and slope of their functions. */
size_t wt_pspline_locate(const wt_pspline *s, double x, double value[WT_PSPLINE_ORDER],
                         double slope[WT_PSPLINE_ORDER]);
/* Adds a point to the normal equations. */
void wt_pspline_add(wt_pspline *s, double x, double y, double weight);
/* Coefficients of the penalised least squares; *penalty: the penalty at the solution. */
wt_status wt_pspline_solve(wt_pspline *s, double *penalty, wt_error *err) WT_NODISCARD;
/* Inverse of the solved normal matrix; *inverse is new, free with gsl_matrix_free. */
wt_status wt_pspline_inverse(const wt_pspline *s, gsl_matrix **inverse, wt_error *err) WT_NODISCARD;
/* Effective number of parameters of the solved spline. */
double wt_pspline_freedom(const wt_pspline *s, const gsl_matrix *inverse);
/* Variance of the slope at x for data of unit variance. */
double wt_pspline_slope_variance(const wt_pspline *s, const gsl_matrix *inverse, double x);

#endif
