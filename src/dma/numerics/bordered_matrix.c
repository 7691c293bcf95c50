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
    for (size_t i = 0; i < b->m; i++)
        memset(border_row(b, i), 0, b->m * sizeof(double));
    for (size_t i = 0; i < BLOCK_SIDE * b->n; i++)
        memset(side_row(b, i), 0, b->m * sizeof(double));
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

void bordered_solve(const bordered_matrix *factor, double *border, double *side)
{
    const size_t m = factor->m, all = BLOCK_SIDE * factor->n;
    for (size_t i = 0; i < factor->n; i++)
        solve_lower(factor->diagonal + BLOCK_DIAGONAL * i, side + BLOCK_SIDE * i);
    for (size_t k = 0; k < all; k++) {
        const double *row = side_row(factor, k);
        for (size_t j = 0; j < m; j++)
            border[j] -= side[k] * row[j];
    }
    for (size_t i = 0; i < m; i++) { /* the rows contain the transpose of the factor */
        const double *row = border_row(factor, i);
        border[i] /= row[i];
        for (size_t j = i + 1; j < m; j++)
            border[j] -= border[i] * row[j];
    }
    for (size_t i = m; i-- > 0;) {
        const double *row = border_row(factor, i);
        double sum = border[i];
        for (size_t j = i + 1; j < m; j++)
            sum -= row[j] * border[j];
        border[i] = sum / row[i];
    }
    for (size_t k = 0; k < all; k++) {
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
    for (size_t i = 0; i < factor->n; i++) {
        const double *diagonal = factor->diagonal + BLOCK_DIAGONAL * i;
        double *row[BLOCK_SIDE], product[BLOCK_SIDE][BLOCK_SIDE] = {{1.0, 0.0}, {0.0, 1.0}};
        for (size_t c = 0; c < BLOCK_SIDE; c++) {
            const double *by = side_row(factor, BLOCK_SIDE * i + c);
            row[c] = side_row(inverse, BLOCK_SIDE * i + c);
            memset(row[c], 0, m * sizeof *row[c]);
            dense_add_rows(row[c], m, by, 1, inverse->border->data, inverse->border->tda, m);
            for (size_t d = 0; d <= c; d++) {
                const double *with = side_row(factor, BLOCK_SIDE * i + d);
                for (size_t j = 0; j < m; j++)
                    product[c][d] += row[c][j] * with[j];
            }
        }
        product[0][1] = product[1][0];
        for (size_t j = 0; j < m; j++) {
            double x[BLOCK_SIDE] = {-row[0][j], -row[1][j]};
            solve_upper(diagonal, x);
            row[0][j] = x[0];
            row[1][j] = x[1];
        }
        for (size_t c = 0; c < BLOCK_SIDE; c++)
            solve_upper(diagonal, product[c]);
        for (size_t c = 0; c < BLOCK_SIDE; c++) { /* second solve */
            double x[BLOCK_SIDE] = {product[0][c], product[1][c]};
            solve_upper(diagonal, x);
            product[0][c] = x[0];
            product[1][c] = x[1];
        }
        inverse->diagonal[BLOCK_DIAGONAL * i] = product[0][0];
        inverse->diagonal[BLOCK_DIAGONAL * i + 1] = product[1][0];
        inverse->diagonal[BLOCK_DIAGONAL * i + 2] = product[1][1];
    }
}
