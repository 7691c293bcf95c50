/* Block equations with a border against the solution of the full matrix.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"
#include "dma/numerics/bordered_matrix.h"

#include <math.h>
#include <stdint.h>

enum { BLOCKS = 9, MOST_BORDER = 23, ALL = MOST_BORDER + BLOCK_SIDE * BLOCKS };

static double draw(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 - 0.5;
}

struct whole {
    arena memory;
    gsl_matrix *matrix, *factor, *inverse, *scratch;
};

/* Creates the matrices of n unknowns: border, then blocks. */
static void make_whole(struct whole *w, size_t n)
{
    w->matrix = arena_matrix(&w->memory, n, n);
    w->factor = arena_matrix(&w->memory, n, n);
    w->inverse = arena_matrix(&w->memory, n, n);
    w->scratch = arena_matrix(&w->memory, n, n);
}

/* A positive definite matrix of this form: each row touches the border and one block. */
static void fill(bordered_matrix *b, struct whole *w, uint64_t seed)
{
    uint64_t state = seed;
    const size_t m = b->m;
    bordered_zero(b);
    for (size_t i = 0; i < BLOCKS; i++)
        for (int k = 0; k < 6; k++) {
            double row[ALL] = {0.0};
            const size_t at = m + BLOCK_SIDE * i;
            for (size_t j = 0; j < m; j++)
                row[j] = draw(&state);
            row[at] = draw(&state);
            row[at + 1] = i == 4 ? 0.0 : draw(&state); /* that one does not exist */
            for (size_t u = 0; u < w->matrix->size1; u++)
                for (size_t v = 0; v < w->matrix->size1; v++)
                    *gsl_matrix_ptr(w->matrix, u, v) += row[u] * row[v];
        }
    const size_t missing = m + BLOCK_SIDE * 4 + 1;
    gsl_matrix_set(w->matrix, missing, missing, 1.0);
    for (size_t u = 0; u < m; u++)
        *gsl_matrix_ptr(w->matrix, u, u) += 0.1;
    for (size_t u = 0; u < m; u++)
        for (size_t v = 0; v < m; v++)
            gsl_matrix_set(b->border, u, v, gsl_matrix_get(w->matrix, u, v));
    for (size_t r = 0; r < BLOCK_SIDE * BLOCKS; r++) {
        for (size_t u = 0; u < m; u++)
            gsl_matrix_set(b->side, r, u, gsl_matrix_get(w->matrix, m + r, u));
        for (size_t c = 0; c <= r % BLOCK_SIDE; c++)
            b->diagonal[BLOCK_DIAGONAL * (r / BLOCK_SIDE) + r % BLOCK_SIDE + c] =
                gsl_matrix_get(w->matrix, m + r, m + r - r % BLOCK_SIDE + c);
    }
}

static void check_inverse(const bordered_matrix *inverse, const gsl_matrix *of)
{
    const size_t m = inverse->m;
    for (size_t u = 0; u < m; u++)
        for (size_t v = 0; v < m; v++)
            assert_near_abs(gsl_matrix_get(inverse->border, u, v), gsl_matrix_get(of, u, v), 1e-10);
    for (size_t r = 0; r < BLOCK_SIDE * BLOCKS; r++) {
        for (size_t u = 0; u < m; u++)
            assert_near_abs(gsl_matrix_get(inverse->side, r, u), gsl_matrix_get(of, m + r, u),
                            1e-10);
        for (size_t c = 0; c <= r % BLOCK_SIDE; c++)
            assert_near_abs(
                inverse->diagonal[BLOCK_DIAGONAL * (r / BLOCK_SIDE) + r % BLOCK_SIDE + c],
                gsl_matrix_get(of, m + r, m + r - r % BLOCK_SIDE + c), 1e-10);
    }
}

/* With a full border and with a partial one. */
static void test_equals_full_matrix(void **state)
{
    (void)state;
    for (size_t m = MOST_BORDER - 6; m <= MOST_BORDER; m += 6) {
        struct whole w = {0};
        const size_t n = m + BLOCK_SIDE * BLOCKS;
        double x[ALL], y[ALL], log_det = 0.0;
        uint64_t random = 5;
        make_whole(&w, n);
        bordered_matrix b = bordered_new(&w.memory, MOST_BORDER, BLOCKS),
                        factor = bordered_new(&w.memory, MOST_BORDER, BLOCKS),
                        inverse = bordered_new(&w.memory, MOST_BORDER, BLOCKS);
        gsl_matrix *scratch = arena_matrix(&w.memory, MOST_BORDER, MOST_BORDER);
        b.m = m;
        fill(&b, &w, 11 + m);
        bordered_copy(&factor, &b);
        assert_true(bordered_factor(&factor));
        gsl_matrix_memcpy(w.factor, w.matrix);
        assert_true(dense_factor(w.factor));
        dense_inverse(w.factor, w.scratch, w.inverse);
        for (size_t u = 0; u < n; u++)
            log_det += 2.0 * log(gsl_matrix_get(w.factor, u, u));
        assert_near(bordered_log_det(&factor), log_det, 1e-11);
        bordered_inverse(&factor, scratch, &inverse);
        check_inverse(&inverse, w.inverse);
        for (size_t u = 0; u < n; u++)
            x[u] = y[u] = draw(&random);
        bordered_solve_lower(&factor, x, x + m);
        bordered_solve_upper(&factor, x, x + m);
        for (size_t u = 0; u < n; u++) {
            double sum = 0.0;
            for (size_t v = 0; v < n; v++)
                sum += gsl_matrix_get(w.inverse, u, v) * y[v];
            assert_near_abs(x[u], sum, 1e-10);
        }
        dense_forward(w.factor, y);
        random = 5;
        for (size_t u = 0; u < n; u++) { /* L y is what it was */
            double sum = 0.0;
            for (size_t v = 0; v <= u; v++)
                sum += gsl_matrix_get(w.factor, u, v) * y[v];
            assert_near_abs(sum, draw(&random), 1e-12);
        }
        arena_free(&w.memory);
    }
}

static void test_not_positive(void **state)
{
    (void)state;
    for (int where = 0; where < 3; where++) {
        struct whole w = {0};
        make_whole(&w, MOST_BORDER + BLOCK_SIDE * BLOCKS);
        bordered_matrix b = bordered_new(&w.memory, MOST_BORDER, BLOCKS);
        fill(&b, &w, 3);
        if (where == 0)
            b.diagonal[BLOCK_DIAGONAL * 2] = -1.0;
        if (where == 1)
            b.diagonal[BLOCK_DIAGONAL * 2 + 2] = 0.0;
        if (where == 2)
            gsl_matrix_set(b.border, 7, 7, 0.0);
        assert_false(bordered_factor(&b));
        arena_free(&w.memory);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_equals_full_matrix),
                                       cmocka_unit_test(test_not_positive)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
