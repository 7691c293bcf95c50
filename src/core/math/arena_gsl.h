/* Zeroed GSL vectors and matrices in an arena, which frees them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_ARENA_GSL_H
#define WT_CORE_MATH_ARENA_GSL_H

#include "core/base/array.h"

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

static inline gsl_vector *arena_vector(arena *memory, size_t n)
{
    gsl_vector *v = arena_alloc(memory, 1, sizeof *v);
    *v = (gsl_vector){.size = n, .stride = 1, .data = arena_numbers(memory, n)};
    return v;
}

static inline gsl_matrix *arena_matrix(arena *memory, size_t rows, size_t columns)
{
    gsl_matrix *m = arena_alloc(memory, 1, sizeof *m);
    *m = (gsl_matrix){.size1 = rows,
                      .size2 = columns,
                      .tda = columns,
                      .data = arena_numbers(memory, rows * columns)};
    return m;
}

#endif
