/* Cholesky by rows: what the BLAS at hand does element by element goes through whole rows here,
 * four at a time, which keeps it out of the way to memory. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "fit/dense.h"

#include "base/wide.h"

#include <math.h>
#include <string.h>

/* Rows at a time: so many factors and sums stay in registers. */
enum { BLOCK = 4 };

WIDE_REGISTERS
static void add_block(double *restrict into, size_t n, const double *factor, size_t stride,
                      const double *row, size_t tda)
{
    const double *r0 = row, *r1 = r0 + tda, *r2 = r1 + tda, *r3 = r2 + tda;
    const double c0 = factor[0], c1 = factor[stride], c2 = factor[2 * stride],
                 c3 = factor[3 * stride];
    for (size_t j = 0; j < n; j++)
        into[j] += (c0 * r0[j] + c1 * r1[j]) + (c2 * r2[j] + c3 * r3[j]);
}

WIDE_REGISTERS
static void add_row(double *restrict into, size_t n, double factor, const double *row)
{
    for (size_t j = 0; j < n; j++)
        into[j] += factor * row[j];
}

void dense_add(double *into, size_t n, const double *factor, size_t stride, const double *row,
               size_t tda, size_t rows)
{
    size_t k = 0;
    for (; k + BLOCK <= rows; k += BLOCK)
        add_block(into, n, factor + k * stride, stride, row + k * tda, tda);
    for (; k < rows; k++)
        add_row(into, n, factor[k * stride], row + k * tda);
}

/* Rows from..to of the upper factor, those before taken out already; false: not positive. */
static bool factor_rows(gsl_matrix *m, size_t from, size_t to, double *column)
{
    const size_t n = m->size1;
    for (size_t k = from; k < to; k++) {
        double *row = gsl_matrix_ptr(m, k, k);
        for (size_t p = from; p < k; p++)
            column[p - from] = -gsl_matrix_get(m, p, k);
        dense_add(row, n - k, column, 1, gsl_matrix_ptr(m, from, k), m->tda, k - from);
        if (!(row[0] > 0.0))
            return false;
        const double scale = 1.0 / sqrt(row[0]);
        for (size_t j = 0; j < n - k; j++)
            row[j] *= scale;
    }
    return true;
}

bool dense_factor(gsl_matrix *m)
{
    const size_t n = m->size1;
    double column[BLOCK];
    for (size_t k = 0; k < n; k += BLOCK) {
        const size_t end = k + BLOCK < n ? k + BLOCK : n;
        if (!factor_rows(m, k, end, column))
            return false;
        for (size_t i = end; i < n; i++) {
            for (size_t p = k; p < end; p++)
                column[p - k] = -gsl_matrix_get(m, p, i);
            dense_add(gsl_matrix_ptr(m, i, i), n - i, column, 1, gsl_matrix_ptr(m, k, i), m->tda,
                      end - k);
        }
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            gsl_matrix_set(m, i, j, gsl_matrix_get(m, j, i));
    return true;
}

/* The inverse of the factor, zeros above its diagonal; it is negative until a row is done. */
static void invert_factor(const gsl_matrix *factor, gsl_matrix *inverse)
{
    gsl_matrix_set_zero(inverse);
    for (size_t k = 0; k < factor->size1; k++) {
        double *row = gsl_matrix_ptr(inverse, k, 0);
        const double *by = gsl_matrix_const_ptr(factor, k, 0);
        const double scale = 1.0 / by[k];
        for (size_t j = 0; j < k; j += BLOCK) { /* a row ends at its diagonal */
            const size_t rows = j + BLOCK < k ? BLOCK : k - j;
            dense_add(row, j + rows, by + j, 1, gsl_matrix_const_ptr(inverse, j, 0), inverse->tda,
                      rows);
        }
        for (size_t j = 0; j < k; j++)
            row[j] *= -scale;
        row[k] = scale;
    }
}

void dense_inverse(const gsl_matrix *factor, gsl_matrix *scratch, gsl_matrix *inverse)
{
    const size_t n = factor->size1;
    invert_factor(factor, scratch);
    gsl_matrix_set_zero(inverse);
    for (size_t k = 0; k < n; k += BLOCK) {
        const size_t rows = k + BLOCK < n ? BLOCK : n - k;
        for (size_t i = 0; i < k + rows; i++)
            dense_add(gsl_matrix_ptr(inverse, i, i), k + rows - i,
                      gsl_matrix_const_ptr(scratch, k, i), scratch->tda,
                      gsl_matrix_const_ptr(scratch, k, i), scratch->tda, rows);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            gsl_matrix_set(inverse, i, j, gsl_matrix_get(inverse, j, i));
}
