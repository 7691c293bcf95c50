/* Cholesky decomposition of small symmetric positive definite systems. Internal to the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CHOLESKY_H
#define WT_CORE_MATH_CHOLESKY_H

#include <stdbool.h>
#include <stddef.h>

/* Solves a x = b. The matrix a [n * n] has rows `stride` apart; its lower triangle becomes the
 * factor. x [n] contains b on entry. False if elimination leaves no more than `least` of a diagonal
 * element (0: nothing), because the system is then singular. In this case a and x are undefined. */
bool cholesky_solve(double *a, size_t stride, size_t n, double least, double *x);

/* Computes only the factor, with the same arguments. */
bool cholesky_factor(double *a, size_t stride, size_t n, double least);
/* Computes x = l^-1 b for such a factor l; b may be x. */
void cholesky_forward(const double *l, size_t stride, size_t n, const double *b, double *x);

#endif
