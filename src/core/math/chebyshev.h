/* Polynomials through values at cos(pi k / degree). Internal to math. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CHEBYSHEV_H
#define WT_CORE_MATH_CHEBYSHEV_H

#include <stddef.h>

/* The highest degree, and the length of an array of coefficients in whole vector registers. */
enum { CHEBYSHEV_DEGREE_MAX = 16, CHEBYSHEV_FIT_STRIDE = 20 };

/* Computes the coefficients from values at cos(pi k / degree). `value` has the points of the
 * highest degree. `fit` is the matrix for this degree. */
void chebyshev_fit(const double *restrict value, size_t degree, const double *restrict fit,
                   double *restrict coefficient);
/* Estimates the truncation error of the series, relative to the smallest value. */
double chebyshev_tail(const double *coefficient, const double *value, size_t degree);
/* Truncates the series to the terms that the allowed error needs, and converts T_n(z) to powers of
 * z. The powers are summed twice as fast; their rounding error is about the sum of their
 * magnitudes. Returns the error due to rounding and truncation. */
double chebyshev_to_monomials(double *coefficient, size_t *degree, double allowed);

#endif
