/* Products of matrices, computed in tiles of the result. A tile stays in registers during the loop
 * over the rows. Each sum is accumulated in the order of the rows, so that the bits do not depend
 * on the division into tiles. Internal to math. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_BLOCKED_PRODUCT_H
#define WT_CORE_MATH_BLOCKED_PRODUCT_H

#include "core/math/simd.h"

#include <stdbool.h>

/* Rows of one step, and the side of a tile. */
enum { TILE_ROWS = 4, TILE = 4 };
/* Number of rows that stay in the first-level cache during the loop over all tiles. */
enum { TILE_CACHED_ROWS = 32 };

/* Two matrices with the same number of rows, from a column onwards. */
typedef struct tile_rows {
    const double *i, *j;
    size_t width_i, width_j; /* distance of two rows */
    size_t n;                /* rows, a multiple of TILE_ROWS */
} tile_rows;

/* Computes into[TILE * TILE] += (or -=) sum of i[row * width_i + i] j[row * width_j + j] over the
 * rows. */
WIDE_INLINE void tile_add_full(double *into, size_t tda, tile_rows of, bool minus)
{
    wide s0, s1, s2, s3;
    simd_load(&s0, into);
    simd_load(&s1, into + tda);
    simd_load(&s2, into + 2 * tda);
    simd_load(&s3, into + 3 * tda);
    for (size_t k = 0; k < of.n; k += TILE_ROWS) {
        const double *c0 = of.i, *c1 = c0 + of.width_i, *c2 = c1 + of.width_i,
                     *c3 = c2 + of.width_i;
        wide r0, r1, r2, r3;
        simd_load(&r0, of.j);
        simd_load(&r1, of.j + of.width_j);
        simd_load(&r2, of.j + 2 * of.width_j);
        simd_load(&r3, of.j + 3 * of.width_j);
        const wide t0 = (c0[0] * r0 + c1[0] * r1) + (c2[0] * r2 + c3[0] * r3);
        const wide t1 = (c0[1] * r0 + c1[1] * r1) + (c2[1] * r2 + c3[1] * r3);
        const wide t2 = (c0[2] * r0 + c1[2] * r1) + (c2[2] * r2 + c3[2] * r3);
        const wide t3 = (c0[3] * r0 + c1[3] * r1) + (c2[3] * r2 + c3[3] * r3);
        s0 = minus ? s0 - t0 : s0 + t0;
        s1 = minus ? s1 - t1 : s1 + t1;
        s2 = minus ? s2 - t2 : s2 + t2;
        s3 = minus ? s3 - t3 : s3 + t3;
        of.i += TILE_ROWS * of.width_i;
        of.j += TILE_ROWS * of.width_j;
    }
    simd_store(into, &s0);
    simd_store(into + tda, &s1);
    simd_store(into + 2 * tda, &s2);
    simd_store(into + 3 * tda, &s3);
}

/* Variant for n * m elements at the edge, where no whole tile fits. */
WIDE_INLINE void tile_add_partial(double *into, size_t n, size_t m, size_t tda, tile_rows of,
                                  bool minus)
{
    for (size_t k = 0; k < of.n; k += TILE_ROWS) {
        for (size_t i = 0; i < n; i++) {
            const double c0 = of.i[i], c1 = of.i[of.width_i + i], c2 = of.i[2 * of.width_i + i],
                         c3 = of.i[3 * of.width_i + i];
            for (size_t j = 0; j < m; j++) {
                const double sum = (c0 * of.j[j] + c1 * of.j[of.width_j + j]) +
                                   (c2 * of.j[2 * of.width_j + j] + c3 * of.j[3 * of.width_j + j]);
                into[i * tda + j] += minus ? -sum : sum;
            }
        }
        of.i += TILE_ROWS * of.width_i;
        of.j += TILE_ROWS * of.width_j;
    }
}

/* Adds a whole or a partial tile; n rows and m columns of the result remain. */
WIDE_INLINE void tile_add_product(double *into, size_t n, size_t m, size_t tda, tile_rows of,
                                  bool minus)
{
    if (n >= TILE && m >= TILE)
        tile_add_full(into, tda, of, minus);
    else
        tile_add_partial(into, n < TILE ? n : TILE, m < TILE ? m : TILE, tda, of, minus);
}

#endif
