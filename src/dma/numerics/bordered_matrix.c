/* Cholesky factorisation of bordered matrices. The blocks are eliminated one by one, which
 * leaves their Schur complement in the border.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/bordered_matrix.h"

#include "core/math/arena_gsl.h"
#include "core/math/blocked_product.h"
#include "core/math/cholesky.h"

#include <math.h>
#include <string.h>

bordered_matrix bordered_new(arena *memory, size_t m, size_t n)
{
    bordered_matrix b = {.m = m, .n = n};
    b.border = arena_matrix(memory, m, m);
    b.side = arena_matrix(memory, BLOCK_SIDE * n + TILE_ROWS - 1, m);
    b.diagonal = arena_numbers(memory, BLOCK_DIAGONAL * n);
    return b;
}

static double *side_row(const bordered_matrix *b, size_t row)
{
    return b->side->data + row * b->side->tda;
}

static double *border_row(const bordered_matrix *b, size_t row)
{
    return b->border->data + row * b->border->tda;
}

void bordered_zero(bordered_matrix *b)
{
    gsl_matrix_set_zero(b->border);
    gsl_matrix_set_zero(b->side);
    memset(b->diagonal, 0, BLOCK_DIAGONAL * b->n * sizeof *b->diagonal);
}

void bordered_copy(bordered_matrix *to, const bordered_matrix *from)
{
    to->m = from->m;
    for (size_t i = 0; i < from->m; i++)
        memcpy(border_row(to, i), border_row(from, i), from->m * sizeof(double));
    for (size_t i = 0; i < BLOCK_SIDE * from->n; i++)
        memcpy(side_row(to, i), side_row(from, i), from->m * sizeof(double));
    memcpy(to->diagonal, from->diagonal, BLOCK_DIAGONAL * from->n * sizeof *from->diagonal);
}

/* Factors a block and solves its side rows with the factor. */
static bool factor_block(bordered_matrix *b, size_t block)
{
    double *diagonal = b->diagonal + BLOCK_DIAGONAL * block;
    double *first = side_row(b, BLOCK_SIDE * block), *second = side_row(b, BLOCK_SIDE * block + 1);
    if (!(diagonal[0] > 0.0))
        return false;
    diagonal[0] = sqrt(diagonal[0]);
    diagonal[1] /= diagonal[0];
    diagonal[2] -= diagonal[1] * diagonal[1];
    if (!(diagonal[2] > 0.0))
        return false;
    diagonal[2] = sqrt(diagonal[2]);
    for (size_t j = 0; j < b->m; j++) {
        first[j] /= diagonal[0];
        second[j] = (second[j] - diagonal[1] * first[j]) / diagonal[2];
    }
    return true;
}

/* Subtracts the products of the sides from the upper triangle of the border. */
WIDE_REGISTERS
static void subtract_side_products(bordered_matrix *b)
{
    const size_t all = BLOCK_SIDE * b->n, tda = b->side->tda;
    for (size_t k = 0; k < all; k += TILE_CACHED_ROWS) {
        size_t rows = k + TILE_CACHED_ROWS < all ? TILE_CACHED_ROWS : all - k;
        rows =
            (rows + TILE_ROWS - 1) / TILE_ROWS * TILE_ROWS; /* the rows after the last are zeros */
        const double *row = side_row(b, k);
        for (size_t i = 0; i < b->m; i += TILE)
            for (size_t j = i; j < b->m; j += TILE)
                tile_add_product(border_row(b, i) + j, b->m - i, b->m - j, b->border->tda,
                                 (tile_rows){row + i, row + j, tda, tda, rows}, true);
    }
}

bool bordered_factor(bordered_matrix *b)
{
    for (size_t i = 0; i < b->n; i++)
        if (!factor_block(b, i))
            return false;
    subtract_side_products(b);
    gsl_matrix_view border = gsl_matrix_submatrix(b->border, 0, 0, b->m, b->m);
    return dense_factor(&border.matrix);
}

double bordered_log_det(const bordered_matrix *factor)
{
    double sum = 0.0;
    for (size_t i = 0; i < factor->n; i++)
        sum += 2.0 * (log(factor->diagonal[BLOCK_DIAGONAL * i]) +
                      log(factor->diagonal[BLOCK_DIAGONAL * i + 2]));
    for (size_t i = 0; i < factor->m; i++)
        sum += 2.0 * log(border_row(factor, i)[i]);
    return sum;
}

/* The factor L of a block has the elements (1,1), (2,1) and (2,2). */
static void solve_lower(const double *diagonal, double x[BLOCK_SIDE])
{
    x[0] /= diagonal[0];
    x[1] = (x[1] - diagonal[1] * x[0]) / diagonal[2];
}

static void solve_upper(const double *diagonal, double x[BLOCK_SIDE])
{
    x[1] /= diagonal[2];
    x[0] = (x[0] - diagonal[1] * x[1]) / diagonal[0];
}

void bordered_solve_lower(const bordered_matrix *factor, double *border, double *side)
{
    const size_t m = factor->m;
    gsl_matrix_const_view root = gsl_matrix_const_submatrix(factor->border, 0, 0, m, m);
    for (size_t i = 0; i < factor->n; i++)
        solve_lower(factor->diagonal + BLOCK_DIAGONAL * i, side + BLOCK_SIDE * i);
    for (size_t k = 0; k < BLOCK_SIDE * factor->n; k++) {
        const double *row = side_row(factor, k);
        for (size_t j = 0; side[k] != 0.0 && j < m; j++)
            border[j] -= side[k] * row[j];
    }
    dense_forward(&root.matrix, border);
}

void bordered_solve_upper(const bordered_matrix *factor, double *border, double *side)
{
    const size_t m = factor->m;
    for (size_t i = m; i-- > 0;) { /* the rows contain the transpose of the factor */
        const double *row = border_row(factor, i);
        double sum = border[i];
        for (size_t j = i + 1; j < m; j++)
            sum -= row[j] * border[j];
        border[i] = sum / row[i];
    }
    for (size_t k = 0; k < BLOCK_SIDE * factor->n; k++) {
        const double *row = side_row(factor, k);
        for (size_t j = 0; j < m; j++)
            side[k] -= row[j] * border[j];
    }
    for (size_t i = 0; i < factor->n; i++)
        solve_upper(factor->diagonal + BLOCK_DIAGONAL * i, side + BLOCK_SIDE * i);
}

void bordered_inverse(const bordered_matrix *factor, gsl_matrix *scratch, bordered_matrix *inverse)
{
    const size_t m = inverse->m = factor->m;
    gsl_matrix_const_view root = gsl_matrix_const_submatrix(factor->border, 0, 0, m, m);
    gsl_matrix_view space = gsl_matrix_submatrix(scratch, 0, 0, m, m),
                    border = gsl_matrix_submatrix(inverse->border, 0, 0, m, m);
    dense_inverse(&root.matrix, &space.matrix, &border.matrix);
    double *const by[BLOCK_SIDE] = {scratch->data, scratch->data + scratch->tda};
    for (size_t i = 0; i < factor->n; i++) {
        const double *d = factor->diagonal + BLOCK_DIAGONAL * i,
                     *first = side_row(factor, BLOCK_SIDE * i),
                     *second = side_row(factor, BLOCK_SIDE * i + 1);
        const double own = d[1] / (d[0] * d[2]);
        double *diagonal = inverse->diagonal + BLOCK_DIAGONAL * i;
        for (size_t j = 0; j < m; j++) { /* the block as a function of the border */
            double x[BLOCK_SIDE] = {-first[j], -second[j]};
            solve_upper(d, x);
            by[0][j] = x[0];
            by[1][j] = x[1];
        }
        diagonal[0] = 1.0 / (d[0] * d[0]) + own * own;
        diagonal[1] = -own / d[2];
        diagonal[2] = 1.0 / (d[2] * d[2]);
        for (size_t c = 0; c < BLOCK_SIDE; c++) {
            double *row = side_row(inverse, BLOCK_SIDE * i + c);
            memset(row, 0, m * sizeof *row);
            dense_add_rows(row, m, by[c], 1, inverse->border->data, inverse->border->tda, m);
            for (size_t e = 0; e <= c; e++)
                for (size_t j = 0; j < m; j++)
                    diagonal[c + e] += row[j] * by[e][j];
        }
    }
}
