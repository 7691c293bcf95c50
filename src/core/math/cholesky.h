/* Internal to the library: few linear equations, symmetric and positive.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CHOLESKY_H
#define WT_CORE_MATH_CHOLESKY_H

#include <stdbool.h>
#include <stddef.h>

/* Solves a x = b by the factor of Cholesky: a [n * n], rows `stride` apart, of which the lower
 * triangle is read and becomes the factor; x [n] comes as b. False if less than `least` of an
 * element of the diagonal is left once the unknowns before are taken out of it (0: if nothing is),
 * for then they do not tell all; a and x are spoiled. */
bool cholesky_solve(double *a, size_t stride, size_t n, double least, double *x);

/* The factor alone, likewise. */
bool cholesky_factor(double *a, size_t stride, size_t n, double least);
/* x = l^-1 b of such a factor l; b may be x. */
void cholesky_forward(const double *l, size_t stride, size_t n, const double *b, double *x);

#endif
