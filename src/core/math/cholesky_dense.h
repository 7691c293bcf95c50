/* Factor and inverse of symmetric positive definite matrices. Internal to math.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_CHOLESKY_DENSE_H
#define WT_CORE_MATH_CHOLESKY_DENSE_H

#include <gsl/gsl_matrix.h>
#include <stdbool.h>

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
