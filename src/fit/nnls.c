/* Non-negative linear least squares by the active-set method of Lawson and Hanson.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/nnls.h"

#include "base/gsl_quiet.h"
#include "fit/pool_gsl.h"

#include <float.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

/* The reduced problem: R (columns x columns, upper triangle of A = QR) and c = Q'b. */
struct active_set {
    pool memory;
    size_t n;
    gsl_matrix *r;
    gsl_vector *c;
    gsl_matrix *sub;     /* columns of R in the passive (free) set */
    gsl_vector *tau;     /* of the QR of `sub` */
    gsl_vector *rhs;     /* Q' c */
    gsl_vector *work;    /* residual */
    gsl_vector *descent; /* A'(b - A x) */
    size_t *member;      /* passive columns in the order of `sub` */
    bool *passive;
    double *trial;
};

static void active_set_alloc(struct active_set *s, size_t n)
{
    s->n = n;
    s->r = pool_matrix(&s->memory, n, n);
    s->c = pool_vector(&s->memory, n);
    s->sub = pool_matrix(&s->memory, n, n);
    s->tau = pool_vector(&s->memory, n);
    s->rhs = pool_vector(&s->memory, n);
    s->work = pool_vector(&s->memory, n);
    s->descent = pool_vector(&s->memory, n);
    s->member = pool_alloc(&s->memory, n, sizeof *s->member);
    s->passive = pool_alloc(&s->memory, n, sizeof *s->passive);
    s->trial = pool_numbers(&s->memory, n);
}

/* Unconstrained least squares over the passive columns into `trial` (0 elsewhere); false if they
 * are numerically dependent. */
static bool solve_passive(struct active_set *s)
{
    size_t m = 0;
    for (size_t j = 0; j < s->n; j++) {
        s->trial[j] = 0.0;
        if (!s->passive[j])
            continue;
        gsl_vector_const_view from = gsl_matrix_const_column(s->r, j);
        gsl_vector_view to = gsl_matrix_column(s->sub, m);
        gsl_vector_memcpy(&to.vector, &from.vector);
        s->member[m++] = j;
    }
    if (m == 0)
        return true;
    gsl_matrix_view sub = gsl_matrix_submatrix(s->sub, 0, 0, s->n, m);
    gsl_vector_view tau = gsl_vector_subvector(s->tau, 0, m);
    gsl_vector_memcpy(s->rhs, s->c);
    if (gsl_linalg_QR_decomp(&sub.matrix, &tau.vector) != GSL_SUCCESS ||
        gsl_linalg_QR_QTvec(&sub.matrix, &tau.vector, s->rhs) != GSL_SUCCESS)
        return false;
    /* Columns have unit norm, so a diagonal at rounding level means dependence. */
    for (size_t k = 0; k < m; k++)
        if (fabs(gsl_matrix_get(&sub.matrix, k, k)) <= (double)s->n * DBL_EPSILON)
            return false;
    for (size_t k = m; k-- > 0;) {
        double sum = gsl_vector_get(s->rhs, k);
        for (size_t l = k + 1; l < m; l++)
            sum -= gsl_matrix_get(&sub.matrix, k, l) * s->trial[s->member[l]];
        s->trial[s->member[k]] = sum / gsl_matrix_get(&sub.matrix, k, k);
    }
    return true;
}

/* Moves x to the trial point, or as far as the first bound, dropping what reaches it. True when
 * the trial point was reached. */
static bool step_to_trial(struct active_set *s, double *x)
{
    double reach = 1.0;
    for (size_t j = 0; j < s->n; j++)
        if (s->passive[j] && s->trial[j] <= 0.0)
            reach = fmin(reach, x[j] / (x[j] - s->trial[j]));
    bool inside = true;
    for (size_t j = 0; j < s->n; j++) {
        if (!s->passive[j])
            continue;
        const bool falls = s->trial[j] <= 0.0 && x[j] <= reach * (x[j] - s->trial[j]);
        x[j] += reach * (s->trial[j] - x[j]);
        if (falls || !(x[j] > 0.0)) {
            x[j] = 0.0;
            s->passive[j] = false;
            inside = false;
        }
    }
    return inside;
}

/* Frees the column of steepest descent whose freeing lowers the residual; false if there is none
 * (the solution is reached). `trial` then holds the least squares over the enlarged set. */
static bool enlarge(struct active_set *s, double tolerance)
{
    for (;;) {
        size_t best = s->n;
        double steepest = tolerance;
        for (size_t j = 0; j < s->n; j++)
            if (!s->passive[j] && gsl_vector_get(s->descent, j) > steepest) {
                steepest = gsl_vector_get(s->descent, j);
                best = j;
            }
        if (best == s->n)
            return false;
        s->passive[best] = true;
        if (solve_passive(s) && s->trial[best] > 0.0)
            return true;
        /* Its gain is rounding only: leave it at its bound and try the next. */
        s->passive[best] = false;
        gsl_vector_set(s->descent, best, 0.0);
    }
}

static wt_status iterate(struct active_set *s, double *x, wt_error *err)
{
    const double scale = gsl_blas_dnrm2(s->c);
    const double tolerance = 10.0 * (double)s->n * DBL_EPSILON * scale;
    /* Each step lowers the residual, so no set of columns comes twice; the bound only guards
     * against rounding. */
    for (size_t outer = 0; outer < 10 * s->n + 10; outer++) {
        gsl_vector_memcpy(s->work, s->c);
        gsl_vector_const_view solution = gsl_vector_const_view_array(x, s->n);
        gsl_blas_dgemv(CblasNoTrans, -1.0, s->r, &solution.vector, 1.0, s->work);
        gsl_blas_dgemv(CblasTrans, 1.0, s->r, s->work, 0.0, s->descent);
        if (!enlarge(s, tolerance))
            return WT_OK;
        while (!step_to_trial(s, x))
            if (!solve_passive(s))
                return wt_fail(err, WT_E_CONVERGENCE,
                               "non-negative least squares: dependent columns");
    }
    return wt_fail(err, WT_E_CONVERGENCE, "non-negative least squares did not end");
}

wt_status nnls(gsl_matrix *a, gsl_vector *b, double *x, wt_error *err)
{
    const size_t n = a->size2;
    struct active_set s = {0};
    wt_status status = WT_OK;

    gsl_quiet();
    if (n == 0 || a->size1 < n || b->size != a->size1)
        return wt_fail(err, WT_E_ARG, "non-negative least squares needs rows >= columns > 0");
    active_set_alloc(&s, n);
    double *norm = pool_numbers(&s.memory, n);
    if (s.memory.failed) {
        status = wt_fail(err, WT_E_MEMORY, "no memory for non-negative least squares");
        goto done;
    }
    for (size_t j = 0; j < n; j++) {
        gsl_vector_view column = gsl_matrix_column(a, j);
        norm[j] = gsl_blas_dnrm2(&column.vector);
        if (!isfinite(norm[j])) {
            status = wt_fail(err, WT_E_RANGE, "non-negative least squares: values not finite");
            goto done;
        }
        if (norm[j] > 0.0)
            gsl_vector_scale(&column.vector, 1.0 / norm[j]);
        x[j] = 0.0;
    }
    /* All that follows happens in columns x columns numbers instead of rows x columns. */
    if (gsl_linalg_QR_decomp(a, s.tau) != GSL_SUCCESS ||
        gsl_linalg_QR_QTvec(a, s.tau, b) != GSL_SUCCESS) {
        status = wt_fail(err, WT_E_INTERNAL, "QR decomposition failed");
        goto done;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i; j < n; j++)
            gsl_matrix_set(s.r, i, j, gsl_matrix_get(a, i, j));
        gsl_vector_set(s.c, i, gsl_vector_get(b, i));
    }
    status = iterate(&s, x, err);
    for (size_t j = 0; j < n; j++)
        x[j] = norm[j] > 0.0 ? x[j] / norm[j] : 0.0;
done:
    pool_free(&s.memory);
    return status;
}
