/* Symmetric positive definite equations of many small blocks that share only a border: terms of
 * a spectrum and shifts of its isotherms. The cost is the cube of the size of the border.
 * Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_BORDERED_MATRIX_H
#define WT_DMA_NUMERICS_BORDERED_MATRIX_H

#include "core/base/array.h"

#include <gsl/gsl_matrix.h>
#include <stdbool.h>

/* Unknowns of a block, and its stored elements: (1,1), (2,1) and (2,2). An absent unknown has 1
 * on the diagonal and 0 elsewhere. */
enum { BLOCK_SIDE = 2, BLOCK_DIAGONAL = 3 };

typedef struct bordered_matrix {
    size_t m, n;        /* size of the border; number of blocks */
    gsl_matrix *border; /* [m * m] */
    gsl_matrix *side;   /* [BLOCK_SIDE n * m] blocks with the border; rows of zeros follow */
    double *diagonal;   /* [BLOCK_DIAGONAL n] */
} bordered_matrix;

/* Allocates a matrix with a border of m at most and n blocks. m may be reduced later. */
bordered_matrix bordered_new(arena *memory, size_t m, size_t n);
void bordered_zero(bordered_matrix *b);
/* Copies a matrix. The capacity of `to` must suffice. */
void bordered_copy(bordered_matrix *to, const bordered_matrix *from);
/* Factors in place. Only the upper triangle of the border is read. Returns false if the matrix
 * is not positive definite. */
bool bordered_factor(bordered_matrix *b);
double bordered_log_det(const bordered_matrix *factor);
/* Multiply in place by the inverse of the factor, and by that of its transpose: border [m], side
 * [BLOCK_SIDE n]. Both together solve the equations. */
void bordered_solve_lower(const bordered_matrix *factor, double *border, double *side);
void bordered_solve_upper(const bordered_matrix *factor, double *border, double *side);
/* Computes the elements of the inverse at the positions of the non-zero elements of the matrix;
 * scratch: [m * m] or larger. */
void bordered_inverse(const bordered_matrix *factor, gsl_matrix *scratch, bordered_matrix *inverse);

#endif
