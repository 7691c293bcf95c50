/* Special functions, Chebyshev polynomials, a quadrature rule and a hash. Internal to the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_SPECIAL_H
#define WT_CORE_MATH_SPECIAL_H

#include <stddef.h>
#include <stdint.h>

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

/* Hash of 64 bits for seeds (Steele, Lea, Flood, OOPSLA 2014). Neighbouring seeds and indices
 * become unrelated. */
static inline uint64_t splitmix64(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

#endif
