/* Cholesky decomposition of small symmetric positive definite systems. Internal to the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CHOLESKY_H
#define WT_CORE_MATH_CHOLESKY_H

#include <gsl/gsl_matrix.h>
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
/* Computes into[n] += sum of `rows` rows of length n, row k times factor[k * stride]. */
void dense_add_rows(double *into, size_t n, const double *factor, size_t stride, const double *row,
                    size_t tda, size_t rows);
/* Computes in place the Cholesky factor in the lower triangle and its transpose in the upper one.
 * False if the matrix is not positive definite. */
bool dense_factor(gsl_matrix *m);
/* Multiplies x [n] by the inverse of such a factor. */
void dense_forward(const gsl_matrix *factor, double *x);
/* Computes the inverse of the matrix from its factor. `scratch` has the same size. */
void dense_inverse(const gsl_matrix *factor, gsl_matrix *scratch, gsl_matrix *inverse);

#endif
