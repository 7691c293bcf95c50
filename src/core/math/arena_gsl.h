/* Vectors and matrices of GSL in a pool: of zeros, freed with it. Whether there was memory, the
 * pool tells.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_MATH_ARENA_GSL_H
#define WT_CORE_MATH_ARENA_GSL_H

#include "core/base/arena.h"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

static inline gsl_vector *pool_vector(pool *memory, size_t n)
{
    gsl_vector *v = pool_alloc(memory, 1, sizeof *v);
    if (v != NULL)
        *v = (gsl_vector){.size = n, .stride = 1, .data = pool_numbers(memory, n)};
    return v;
}

static inline gsl_matrix *pool_matrix(pool *memory, size_t rows, size_t columns)
{
    gsl_matrix *m = pool_alloc(memory, 1, sizeof *m);
    if (m != NULL)
        *m = (gsl_matrix){.size1 = rows,
                          .size2 = columns,
                          .tda = columns,
                          .data = pool_numbers(memory, rows * columns)};
    return m;
}

#endif
