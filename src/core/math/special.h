/* Special functions and a quadrature rule. Internal to the library. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_MATH_SPECIAL_H
#define WT_CORE_MATH_SPECIAL_H

#include <stddef.h>

/* Smallest number of points. Akima's curve does not oscillate next to a step. */
enum { AKIMA_POINTS_MIN = 5 };

typedef struct akima_curve akima_curve;

/* psi(x) = d ln Gamma/dx for x > 0; NaN elsewhere. */
double digamma(double x);

/* Gauss-Legendre rule with 8 nodes on [-1, 1]: -gauss_8_node[i] and gauss_8_node[i], both with the
 * weight gauss_8_weight[i]. */
extern const double gauss_8_node[4], gauss_8_weight[4];
/* The call acts once for the process and is thread-safe. It must precede every GSL function that
 * can fail, and the caller must check the status of that function. */
void gsl_quiet(void);
/* Creates a curve through n points with increasing x. */
akima_curve *akima_curve_new(const double *x, const double *y, size_t n);
/* Returns the value at x, which is between the first and the last point. */
double akima_curve_value(const akima_curve *c, double x);
void akima_curve_free(akima_curve *c);

#endif
