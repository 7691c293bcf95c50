/* Special functions and a quadrature rule. Internal to the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_SPECIAL_H
#define WT_CORE_MATH_SPECIAL_H

/* psi(x) = d ln Gamma/dx for x > 0; NaN elsewhere. */
double digamma(double x);

/* Gauss-Legendre rule with 8 nodes on [-1, 1]: -gauss_8_node[i] and gauss_8_node[i], both with the
 * weight gauss_8_weight[i]. */
extern const double gauss_8_node[4], gauss_8_weight[4];
/* The call acts once for the process and is thread-safe. It must precede every GSL function that
 * can fail, and the caller must check the status of that function. */
void gsl_quiet(void);

#endif
