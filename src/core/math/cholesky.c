/* Cholesky factor and solution in place. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/cholesky.h"
#include "core/math/blocked_product.h"

#include <gsl/gsl_matrix.h>
#include <math.h>
#include <stdbool.h>

/* Rows of one step: their factors and sums stay in registers. */
enum { BLOCK = 4 };

WIDE_REGISTERS
static void add_block_product(double *restrict into, size_t n, const double *factor, size_t stride,
                              const double *row, size_t tda)
{
    const double *r0 = row, *r1 = r0 + tda, *r2 = r1 + tda, *r3 = r2 + tda;
    const double c0 = factor[0], c1 = factor[stride], c2 = factor[2 * stride],
                 c3 = factor[3 * stride];
    for (size_t j = 0; j < n; j++)
        into[j] += (c0 * r0[j] + c1 * r1[j]) + (c2 * r2[j] + c3 * r3[j]);
}

WIDE_REGISTERS
static void add_scaled_row(double *restrict into, size_t n, double factor, const double *row)
{
    for (size_t j = 0; j < n; j++)
        into[j] += factor * row[j];
}

void dense_add_rows(double *into, size_t n, const double *factor, size_t stride, const double *row,
                    size_t tda, size_t rows)
{
    size_t k = 0;
    for (; k + BLOCK <= rows; k += BLOCK)
        add_block_product(into, n, factor + k * stride, stride, row + k * tda, tda);
    for (; k < rows; k++)
        add_scaled_row(into, n, factor[k * stride], row + k * tda);
}

/* Rows of the result that are finished before the following rows are updated. */
enum { PANEL = 64 };

/* Computes rows from..to of the upper factor, after the subtraction of the rows before. False if
 * the matrix is not positive definite. */
static bool factor_rows(gsl_matrix *m, size_t from, size_t to, double *column)
{
    const size_t n = m->size1;
    for (size_t k = from; k < to; k++) {
        double *row = gsl_matrix_ptr(m, k, k);
        for (size_t p = from; p < k; p++)
            column[p - from] = -gsl_matrix_get(m, p, k);
        dense_add_rows(row, n - k, column, 1, gsl_matrix_ptr(m, from, k), m->tda, k - from);
        if (!(row[0] > 0.0))
            return false;
        const double scale = 1.0 / sqrt(row[0]);
        for (size_t j = 0; j < n - k; j++)
            row[j] *= scale;
    }
    return true;
}

/* Subtracts the contribution of the rows before `from` from rows from..to of the upper triangle.
 * Both are multiples of TILE, or the end. */
WIDE_REGISTERS
static void subtract_previous_rows(gsl_matrix *m, size_t from, size_t to)
{
    const size_t n = m->size1, tda = m->tda;
    for (size_t k = 0; k < from; k += TILE_CACHED_ROWS) {
        const size_t rows = k + TILE_CACHED_ROWS < from ? TILE_CACHED_ROWS : from - k;
        const double *row = m->data + k * tda;
        for (size_t j = from; j < n; j += TILE)
            for (size_t i = from; i < to && i <= j; i += TILE)
                tile_add_product(m->data + i * tda + j, to - i, n - j, tda,
                                 (tile_rows){row + i, row + j, tda, tda, rows}, true);
    }
}

bool dense_factor(gsl_matrix *m)
{
    const size_t n = m->size1;
    double column[BLOCK];
    for (size_t from = 0; from < n; from += PANEL) {
        const size_t to = from + PANEL < n ? from + PANEL : n;
        subtract_previous_rows(m, from, to);
        for (size_t k = from; k < to; k += BLOCK) {
            const size_t end = k + BLOCK < to ? k + BLOCK : to;
            if (!factor_rows(m, k, end, column))
                return false;
            for (size_t i = end; i < to; i++) {
                for (size_t p = k; p < end; p++)
                    column[p - k] = -gsl_matrix_get(m, p, i);
                dense_add_rows(gsl_matrix_ptr(m, i, i), n - i, column, 1, gsl_matrix_ptr(m, k, i),
                               m->tda, end - k);
            }
        }
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            gsl_matrix_set(m, i, j, gsl_matrix_get(m, j, i));
    return true;
}

void dense_forward(const gsl_matrix *factor, double *x)
{
    const size_t n = factor->size1, tda = factor->tda;
    for (size_t from = 0; from < n; from += BLOCK) {
        const size_t to = from + BLOCK < n ? from + BLOCK : n;
        double less[BLOCK];
        for (size_t k = from; k < to; k++) {
            const double *row =
                factor->data + k * tda; /* the upper triangle contains the transpose */
            x[k] /= row[k];
            less[k - from] = -x[k];
            for (size_t j = k + 1; j < to; j++)
                x[j] -= x[k] * row[j];
        }
        dense_add_rows(x + to, n - to, less, 1, factor->data + from * tda + to, tda, to - from);
    }
}

/* Adds the contribution of the finished rows before `from` to rows from..to of the inverse of a
 * factor. */
WIDE_REGISTERS
static void add_previous_rows(const gsl_matrix *factor, gsl_matrix *inverse, size_t from, size_t to)
{
    const size_t tda = inverse->tda;
    for (size_t j = 0; j < from; j += TILE) /* columns; row j is zero before column j */
        for (size_t k = j; k < from; k += TILE_CACHED_ROWS) {
            const size_t rows = k + TILE_CACHED_ROWS < from ? TILE_CACHED_ROWS : from - k;
            for (size_t i = from; i < to; i += TILE)
                tile_add_product(inverse->data + i * tda + j, to - i, from - j, tda,
                                 (tile_rows){factor->data + k * factor->tda + i,
                                             inverse->data + k * tda + j, factor->tda, tda, rows},
                                 false);
        }
}

/* Inverts the factor, with zeros above the diagonal. A row is negative until it is finished. */
static void invert_factor(const gsl_matrix *factor, gsl_matrix *inverse)
{
    const size_t n = factor->size1;
    gsl_matrix_set_zero(inverse);
    for (size_t from = 0; from < n; from += PANEL) {
        const size_t to = from + PANEL < n ? from + PANEL : n;
        add_previous_rows(factor, inverse, from, to);
        for (size_t k = from; k < to; k++) {
            double *row = gsl_matrix_ptr(inverse, k, 0);
            const double *by = gsl_matrix_const_ptr(factor, k, 0);
            const double scale = 1.0 / by[k];
            for (size_t j = from; j < k; j += BLOCK) { /* a row ends at its diagonal */
                const size_t rows = j + BLOCK < k ? BLOCK : k - j;
                dense_add_rows(row, j + rows, by + j, 1, gsl_matrix_const_ptr(inverse, j, 0),
                               inverse->tda, rows);
            }
            for (size_t j = 0; j < k; j++)
                row[j] *= -scale;
            row[k] = scale;
        }
    }
}

/* Computes the upper triangle of the transpose of a lower triangle times the lower triangle. */
WIDE_REGISTERS
static void multiply_transpose(const gsl_matrix *lower, gsl_matrix *product)
{
    const size_t n = lower->size1, whole = n / BLOCK * BLOCK, tda = lower->tda;
    gsl_matrix_set_zero(product);
    for (size_t j = 0; j < n; j += TILE)
        for (size_t k = j; k < whole; k += TILE_CACHED_ROWS) {
            const size_t rows = k + TILE_CACHED_ROWS < whole ? TILE_CACHED_ROWS : whole - k;
            const double *row = lower->data + k * tda;
            for (size_t i = 0; i <= j; i += TILE)
                tile_add_product(product->data + i * product->tda + j, n - i, n - j, product->tda,
                                 (tile_rows){row + i, row + j, tda, tda, rows}, false);
        }
    for (size_t i = 0; whole < n && i < n; i++)
        dense_add_rows(gsl_matrix_ptr(product, i, i), n - i, gsl_matrix_const_ptr(lower, whole, i),
                       tda, gsl_matrix_const_ptr(lower, whole, i), tda, n - whole);
}

void dense_inverse(const gsl_matrix *factor, gsl_matrix *scratch, gsl_matrix *inverse)
{
    const size_t n = factor->size1;
    invert_factor(factor, scratch);
    multiply_transpose(scratch, inverse);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            gsl_matrix_set(inverse, i, j, gsl_matrix_get(inverse, j, i));
}

bool cholesky_factor(double *a, size_t stride, size_t n, double least)
{
    for (size_t i = 0; i < n; i++) {
        double *row = a + i * stride;
        for (size_t j = 0; j <= i; j++) {
            const double *other = a + j * stride;
            double sum = row[j];
            for (size_t k = 0; k < j; k++)
                sum -= row[k] * other[k];
            if (i == j && !(sum > least * row[i]))
                return false;
            row[j] = i == j ? sqrt(sum) : sum / other[j];
        }
    }
    return true;
}

void cholesky_forward(const double *l, size_t stride, size_t n, const double *b, double *x)
{
    for (size_t i = 0; i < n; i++) {
        double sum = b[i];
        for (size_t k = 0; k < i; k++)
            sum -= l[i * stride + k] * x[k];
        x[i] = sum / l[i * stride + i];
    }
}

bool cholesky_solve(double *a, size_t stride, size_t n, double least, double *x)
{
    if (!cholesky_factor(a, stride, n, least))
        return false;
    cholesky_forward(a, stride, n, x, x);
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            x[i] -= a[k * stride + i] * x[k];
        x[i] /= a[i * stride + i];
    }
    return true;
}
