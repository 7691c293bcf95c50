/* Symmetric positive equations of many small blocks that have only a border in common: terms of a
 * spectrum and the shifts of its isotherms. They cost the cube of the border alone. Internal to the
 * fit room. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_BORDERED_MATRIX_H
#define WT_DMA_NUMERICS_BORDERED_MATRIX_H

#include "core/base/arena.h"

#include <gsl/gsl_matrix.h>
#include <stdbool.h>

/* Unknowns of a block, and what of it is kept: first with itself, with the second, that with
 * itself. An unknown that is not there has 1 with itself and 0 with all others. */
enum { BLOCK_SIDE = 2, BLOCK_OWN = 3 };

typedef struct bordered {
    size_t m, n;        /* of the border; blocks */
    gsl_matrix *border; /* [m * m] */
    gsl_matrix *side;   /* [BLOCK_SIDE n * m] of the blocks with the border; rows of zeros follow */
    double *own;        /* [BLOCK_OWN n] */
} bordered;

/* Of at most so many; m may then be less. */
bordered bordered_new(arena *memory, size_t m, size_t n);
void bordered_zero(bordered *b);
/* Of the same m. */
void bordered_copy(bordered *to, const bordered *from);
/* In place; what counts of the border is its upper triangle. False: not positive. */
bool bordered_factor(bordered *b);
double bordered_log_det(const bordered *factor);
/* In place: border [m], side [BLOCK_SIDE n]. */
void bordered_solve(const bordered *factor, double *border, double *side);
/* Of the inverse what lies where the matrix is not zero; scratch: [m * m] or larger. */
void bordered_inverse(const bordered *factor, gsl_matrix *scratch, bordered *inverse);

#endif
