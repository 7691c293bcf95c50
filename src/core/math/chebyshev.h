/* Internal to the kernel room: polynomials through values at cos(pi k / degree).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_MATH_CHEBYSHEV_H
#define WT_CORE_MATH_CHEBYSHEV_H

#include <stddef.h>

/* The highest degree, and room for the coefficients of one, in whole registers. */
enum { LONG_DEGREE = 16, FIT_ROOM = 20 };

/* From values at cos(pi k / degree), each so many of those of the highest degree, by the columns of
 * that degree. */
void chebyshev_fit(const double *restrict value, size_t degree, const double *restrict fit,
                   double *restrict coefficient);
/* What the series leaves out, relative to the smallest value. */
double chebyshev_tail(const double *coefficient, const double *value, size_t degree);
/* As many terms as the error needs that is there anyway, as powers of z instead of T_n(z): twice as
 * fast to sum, and what rounding makes of them is about the sum of their magnitudes. Returns what
 * that and the terms cut off make. */
double chebyshev_powers(double *coefficient, size_t *degree, double allowed);

#endif
