/* The joint fit of all isotherms: one penalised cubic B-spline for log E' and one for log E'',
 * projected out of the least squares; Levenberg-Marquardt on the shifts alone (variable projection
 * in the form of Kaufman, BIT 15 (1975) 49; P-splines: Eilers and Marx, Statist. Sci. 11 (1996)
 * 89). SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/gsl_quiet.h"
#include "fit/pool_gsl.h"
#include "fit/pspline.h"
#include "fit/shift.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

/* Standard deviation of the prior that holds an undetermined shift near its start [decade]; far
 * above what counts as determined. */
static const double prior_spread = 3.0;
/* Residuals beyond this many robust standard deviations lose weight (Huber). */
static const double huber_limit = 3.0;
/* Weight below which a point is named as an outlier: twice the limit. */
static const double outlier_weight = 0.5;

enum { MAX_ITERATIONS = 100, REWEIGHTINGS = 3 };

/* One point in the fit. */
struct point {
    size_t curve;
    double x; /* as measured */
};

struct joint {
    pool memory;
    shift_joint *task;
    size_t n_points, n_unknowns;
    struct point *points;        /* [n_points] curve by curve */
    double *y[MODULI];           /* [n_points] measured ordinates */
    double *weight[MODULI];      /* [n_points] */
    double *residual[MODULI];    /* [n_points] */
    double *slope[MODULI];       /* [n_points] spline slope at the shifted abscissa */
    double *scratch;             /* [n_points] */
    double *start;               /* [n_unknowns] centre of the prior */
    double *value, *trial;       /* [n_unknowns] */
    long *column_a, *column_b;   /* [set->n] unknown of a curve, -1 if none */
    gsl_matrix *normal[MODULI];  /* Schur complement of one modulus */
    gsl_matrix *matrix, *factor; /* n_unknowns squared */
    gsl_vector *gradient, *step;
    double prior;                       /* weight of the prior in the objective */
    double *slope_square, *slope_noise; /* [set->n] */
    double effective[MODULI];           /* degrees of freedom of the spline */
};

/* ---- evaluation for given shifts ------------------------------------------------------------- */

static double shift_a(const struct joint *j, const double *unknown, size_t curve)
{
    return j->column_a[curve] < 0 ? j->task->a[curve] : unknown[j->column_a[curve]];
}

static double shift_b(const struct joint *j, const double *unknown, size_t curve)
{
    return j->column_b[curve] < 0 ? j->task->b[curve] : unknown[j->column_b[curve]];
}

/* Fits the spline of one modulus for given shifts: coefficients, residuals, slopes; adds the
 * weighted sum of squares and the penalty to *objective. */
static wt_status fit_spline(struct joint *j, const double *unknown, int q, spline_fit *s,
                            double *objective, wt_error *err)
{
    double value[PSPLINE_ORDER], slope[PSPLINE_ORDER];
    double x_min = HUGE_VAL, x_max = -HUGE_VAL;
    for (size_t k = 0; k < j->n_points; k++) {
        const double x = j->points[k].x + shift_a(j, unknown, j->points[k].curve);
        x_min = fmin(x_min, x);
        x_max = fmax(x_max, x);
    }
    wt_status status = pspline_new(s, x_min, x_max, err);
    if (status != WT_OK)
        return status;
    for (size_t k = 0; k < j->n_points; k++) {
        const size_t curve = j->points[k].curve;
        pspline_add(s, j->points[k].x + shift_a(j, unknown, curve),
                    j->y[q][k] + shift_b(j, unknown, curve), j->weight[q][k]);
    }
    double sum;
    status = pspline_solve(s, &sum, err);
    if (status != WT_OK)
        return status;
    for (size_t k = 0; k < j->n_points; k++) {
        const size_t curve = j->points[k].curve;
        const size_t cell =
            pspline_locate(s, j->points[k].x + shift_a(j, unknown, curve), value, slope);
        double fitted = 0.0, rise = 0.0;
        for (size_t r = 0; r < PSPLINE_ORDER; r++) {
            fitted += value[r] * gsl_vector_get(s->coefficient, cell + r);
            rise += slope[r] * gsl_vector_get(s->coefficient, cell + r);
        }
        j->residual[q][k] = j->y[q][k] + shift_b(j, unknown, curve) - fitted;
        j->slope[q][k] = rise;
        sum += j->weight[q][k] * j->residual[q][k] * j->residual[q][k];
    }
    *objective += sum;
    return WT_OK;
}

/* Sum over the moduli in use and the prior, for given shifts. */
static wt_status evaluate(struct joint *j, const double *unknown, spline_fit spline[MODULI],
                          double *objective, wt_error *err)
{
    wt_status status = WT_OK;
    *objective = 0.0;
    for (size_t u = 0; u < j->n_unknowns; u++)
        *objective += j->prior * (unknown[u] - j->start[u]) * (unknown[u] - j->start[u]);
    for (int q = 0; q < MODULI && status == WT_OK; q++) {
        pspline_free(&spline[q]);
        if (j->task->use[q])
            status = fit_spline(j, unknown, q, &spline[q], objective, err);
    }
    return status;
}

/* Normal matrix of the unknowns with the spline of modulus q projected out, V'WV - (B'WV)' G^-1
 * (B'WV), into normal[q]; adds V'W r to the gradient. V: derivatives of the residual at fixed
 * coefficients. */
static wt_status add_normal(struct joint *j, const double *unknown, int q, const spline_fit *s,
                            wt_error *err)
{
    const size_t n_unknowns = j->n_unknowns;
    gsl_matrix *cross = gsl_matrix_calloc(s->n, n_unknowns);
    gsl_matrix *solved = gsl_matrix_alloc(s->n, n_unknowns);
    wt_status status = WT_OK;
    double value[PSPLINE_ORDER], slope[PSPLINE_ORDER];

    if (cross == NULL || solved == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "no memory for the normal equations");
        goto done;
    }
    gsl_matrix_set_zero(j->normal[q]);
    for (size_t k = 0; k < j->n_points; k++) {
        const size_t curve = j->points[k].curve;
        const long column[2] = {j->column_a[curve], j->column_b[curve]};
        const double derivative[2] = {-j->slope[q][k], 1.0};
        const double w = j->weight[q][k];
        const size_t cell =
            pspline_locate(s, j->points[k].x + shift_a(j, unknown, curve), value, slope);
        for (int m = 0; m < 2; m++) {
            if (column[m] < 0)
                continue;
            const size_t c = (size_t)column[m];
            *gsl_vector_ptr(j->gradient, c) += w * derivative[m] * j->residual[q][k];
            for (size_t r = 0; r < PSPLINE_ORDER; r++)
                *gsl_matrix_ptr(cross, cell + r, c) += w * derivative[m] * value[r];
            for (int l = 0; l < 2; l++)
                if (column[l] >= 0)
                    *gsl_matrix_ptr(j->normal[q], c, (size_t)column[l]) +=
                        w * derivative[m] * derivative[l];
        }
    }
    if (gsl_linalg_cholesky_band_solvem(s->gram, cross, solved) != GSL_SUCCESS) {
        status = wt_fail(err, WT_E_INTERNAL, "banded solution failed");
        goto done;
    }
    gsl_blas_dgemm(CblasTrans, CblasNoTrans, -1.0, cross, solved, 1.0, j->normal[q]);
done:
    gsl_matrix_free(cross);
    gsl_matrix_free(solved);
    return status;
}

static wt_status normal_equations(struct joint *j, spline_fit spline[MODULI], wt_error *err)
{
    wt_status status = WT_OK;
    gsl_matrix_set_zero(j->matrix);
    gsl_vector_set_zero(j->gradient);
    for (int q = 0; q < MODULI && status == WT_OK; q++) {
        if (!j->task->use[q])
            continue;
        status = add_normal(j, j->value, q, &spline[q], err);
        if (status == WT_OK)
            gsl_matrix_add(j->matrix, j->normal[q]);
    }
    for (size_t u = 0; u < j->n_unknowns; u++) {
        *gsl_matrix_ptr(j->matrix, u, u) += j->prior;
        *gsl_vector_ptr(j->gradient, u) += j->prior * (j->value[u] - j->start[u]);
    }
    return status;
}

/* ---- Levenberg-Marquardt --------------------------------------------------------------------- */

/* One damped step from `value` into `trial`; false if the damped matrix is not positive. */
static bool damped_step(struct joint *j, double damping)
{
    gsl_matrix_memcpy(j->factor, j->matrix);
    for (size_t u = 0; u < j->n_unknowns; u++)
        *gsl_matrix_ptr(j->factor, u, u) *= 1.0 + damping;
    gsl_vector_memcpy(j->step, j->gradient);
    if (gsl_linalg_cholesky_decomp1(j->factor) != GSL_SUCCESS ||
        gsl_linalg_cholesky_svx(j->factor, j->step) != GSL_SUCCESS)
        return false;
    for (size_t u = 0; u < j->n_unknowns; u++)
        j->trial[u] = j->value[u] - gsl_vector_get(j->step, u);
    return true;
}

/* Minimises over the shifts with the present weights. Leaves splines, residuals and normal
 * equations of the solution behind. */
static wt_status minimise(struct joint *j, spline_fit spline[MODULI], wt_error *err)
{
    double objective, next, damping = 1e-3;
    wt_status status = evaluate(j, j->value, spline, &objective, err);
    bool moved = true;
    for (int i = 0; status == WT_OK && moved && i < MAX_ITERATIONS; i++) {
        status = normal_equations(j, spline, err);
        moved = false;
        while (status == WT_OK && !moved && damping < 1e12) {
            if (damped_step(j, damping)) {
                /* A trial that flings an isotherm away is a step too long, not an end. */
                wt_status tried = evaluate(j, j->trial, spline, &next, NULL);
                if (tried != WT_OK && tried != WT_E_CONVERGENCE)
                    return wt_fail(err, tried, "no memory for the joint fit");
                moved = tried == WT_OK && next <= objective;
            }
            damping = moved ? damping / 10.0 : damping * 10.0;
        }
        if (!moved)
            break;
        double largest = 0.0;
        for (size_t u = 0; u < j->n_unknowns; u++)
            largest = fmax(largest, fabs(j->trial[u] - j->value[u]));
        memcpy(j->value, j->trial, j->n_unknowns * sizeof *j->value);
        j->task->last_step = largest;
        /* Done when no shift moves by a hundredth of what one reads, or when the gain is nothing
         * beside the noise (one standard error is a gain of objective / n_points). */
        if (largest < 1e-5 || objective - next < 1e-3 * objective / (double)j->n_points)
            moved = false;
        objective = next;
        damping = fmax(damping, 1e-9);
    }
    if (status == WT_OK)
        status = evaluate(j, j->value, spline, &objective, err);
    if (status == WT_OK)
        status = normal_equations(j, spline, err);
    return status;
}

/* ---- weights and errors ---------------------------------------------------------------------- */

/* Robust standard deviation of the residuals of a modulus (scaled median of absolute values). */
static double robust_spread(struct joint *j, int q)
{
    for (size_t k = 0; k < j->n_points; k++)
        j->scratch[k] = fabs(j->residual[q][k]);
    gsl_sort(j->scratch, 1, j->n_points);
    return fmax(1.4826 * gsl_stats_median_from_sorted_data(j->scratch, 1, j->n_points),
                SHIFT_NOISE_FLOOR);
}

static void reweight(struct joint *j)
{
    for (int q = 0; q < MODULI; q++) {
        if (!j->task->use[q])
            continue;
        const double limit = huber_limit * robust_spread(j, q);
        for (size_t k = 0; k < j->n_points; k++)
            j->weight[q][k] = fmin(1.0, limit / fabs(j->residual[q][k]));
    }
}

/* What the residuals of a modulus say: a first-order autoregression along each isotherm. */
struct noise {
    double spread;   /* standard deviation */
    double long_run; /* variance that counts for smooth regressors such as the shifts */
    double white;    /* variance of what changes from point to point */
};

static struct noise residual_noise(const struct joint *j, int q)
{
    double square = 0.0, n = 0.0, product = 0.0;
    for (size_t k = 0; k < j->n_points; k++) {
        const double r = sqrt(j->weight[q][k]) * j->residual[q][k];
        square += r * r;
        n += j->weight[q][k];
        if (k > 0 && j->points[k].curve == j->points[k - 1].curve)
            product += r * sqrt(j->weight[q][k - 1]) * j->residual[q][k - 1];
    }
    const double moduli = j->task->use[STORAGE] && j->task->use[LOSS] ? 2.0 : 1.0;
    const double freedom = fmax(n - j->effective[q] - (double)j->n_unknowns / moduli, 1.0);
    const double correlation = square > 0.0 ? fmin(fmax(product / square, 0.0), 0.9) : 0.0;
    const double inflation = (1.0 + correlation) / (1.0 - correlation);
    const double floor_square = SHIFT_NOISE_FLOOR * SHIFT_NOISE_FLOOR;
    return (struct noise){.spread = sqrt(square / freedom),
                          .long_run = fmax(square / freedom * inflation, floor_square),
                          .white = fmax(square / freedom / inflation, floor_square)};
}

/* Squared slopes and their variances, summed over the points of each curve. */
static void add_slopes(struct joint *j, int q, const spline_fit *s, const gsl_matrix *inverse,
                       double variance)
{
    for (size_t k = 0; k < j->n_points; k++) {
        const size_t curve = j->points[k].curve;
        const double w = j->weight[q][k];
        const double x = j->points[k].x + shift_a(j, j->value, curve);
        j->slope_square[curve] += w * j->slope[q][k] * j->slope[q][k] / variance;
        j->slope_noise[curve] += w * pspline_slope_variance(s, inverse, x);
    }
}

/* Covariance N^-1 (sum_q s_q^2 N_q) N^-1, written out per curve. */
static wt_status covariance(struct joint *j, spline_fit spline[MODULI], wt_error *err)
{
    shift_joint *task = j->task;
    const size_t n = task->set->n, m = j->n_unknowns;
    gsl_matrix *middle = pool_matrix(&j->memory, m, m);
    gsl_matrix *left = pool_matrix(&j->memory, m, m);
    double largest = 0.0;

    if (j->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the covariance of the shifts");
    for (int q = 0; q < MODULI; q++) {
        task->rms[q] = (double)NAN;
        if (!task->use[q])
            continue;
        gsl_matrix *inverse = NULL;
        wt_status status = pspline_inverse(&spline[q], &inverse, err);
        if (status != WT_OK)
            return status;
        j->effective[q] = pspline_freedom(&spline[q], inverse);
        const struct noise noise = residual_noise(j, q);
        task->rms[q] = noise.spread;
        add_slopes(j, q, &spline[q], inverse, noise.white);
        gsl_matrix_free(inverse);
        gsl_matrix_memcpy(left, j->normal[q]);
        gsl_matrix_scale(left, noise.long_run);
        gsl_matrix_add(middle, left);
        largest = fmax(largest, noise.long_run);
    }
    for (size_t u = 0; u < m; u++) /* the prior is information of the same kind */
        *gsl_matrix_ptr(middle, u, u) += largest * j->prior;
    gsl_matrix_memcpy(j->factor, j->matrix);
    if (gsl_linalg_cholesky_decomp1(j->factor) != GSL_SUCCESS ||
        gsl_linalg_cholesky_invert(j->factor) != GSL_SUCCESS)
        return wt_fail(err, WT_E_CONVERGENCE, "the normal equations of the shifts are singular");
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1.0, j->factor, middle, 0.0, left);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1.0, left, j->factor, 0.0, middle);
    for (size_t i = 0; i < 2 * n; i++) {
        const long row = i < n ? j->column_a[i] : j->column_b[i - n];
        for (size_t k = 0; k < 2 * n; k++) {
            const long column = k < n ? j->column_a[k] : j->column_b[k - n];
            task->covariance_ab[i * 2 * n + k] =
                row < 0 || column < 0 ? 0.0 : gsl_matrix_get(middle, (size_t)row, (size_t)column);
        }
    }
    for (size_t i = 0; i < n; i++) {
        task->sigma_b[i] = 0.0;
        task->correlation[i] = 0.0;
        if (j->column_b[i] >= 0) {
            const size_t a = (size_t)j->column_a[i], b = (size_t)j->column_b[i];
            task->sigma_b[i] = sqrt(gsl_matrix_get(middle, b, b));
            task->correlation[i] =
                gsl_matrix_get(middle, a, b) /
                sqrt(gsl_matrix_get(middle, a, a) * gsl_matrix_get(middle, b, b));
        }
        task->slope_noise[i] = j->slope_noise[i] / j->slope_square[i];
    }
    return WT_OK;
}

/* ---- set-up ---------------------------------------------------------------------------------- */

/* Counts unknowns and points, numbers the unknowns. */
static bool number_unknowns(struct joint *j)
{
    const shift_joint *task = j->task;
    j->column_a = pool_alloc(&j->memory, task->set->n, sizeof *j->column_a);
    j->column_b = pool_alloc(&j->memory, task->set->n, sizeof *j->column_b);
    if (j->memory.failed)
        return false;
    for (size_t i = 0; i < task->set->n; i++) {
        const bool moves = task->placed[i] && i != task->anchor;
        j->column_a[i] = moves ? (long)j->n_unknowns++ : -1;
        j->column_b[i] = moves && task->free_b ? (long)j->n_unknowns++ : -1;
        j->n_points += task->placed[i] ? task->set->curves[i].n : 0;
    }
    return true;
}

static wt_status joint_alloc(struct joint *j, wt_error *err)
{
    const shift_joint *task = j->task;
    if (!number_unknowns(j))
        return wt_fail(err, WT_E_MEMORY, "no memory for the joint fit");
    const size_t m = j->n_unknowns, n = j->n_points;
    pool *memory = &j->memory;
    j->points = pool_alloc(memory, n, sizeof *j->points);
    for (int q = 0; q < MODULI; q++) {
        j->normal[q] = pool_matrix(memory, m, m);
        j->y[q] = pool_numbers(memory, n);
        j->weight[q] = pool_numbers(memory, n);
        j->residual[q] = pool_numbers(memory, n);
        j->slope[q] = pool_numbers(memory, n);
    }
    j->matrix = pool_matrix(memory, m, m);
    j->factor = pool_matrix(memory, m, m);
    j->gradient = pool_vector(memory, m);
    j->step = pool_vector(memory, m);
    j->scratch = pool_numbers(memory, n);
    j->start = pool_numbers(memory, m);
    j->value = pool_numbers(memory, m);
    j->trial = pool_numbers(memory, m);
    j->slope_square = pool_numbers(memory, task->set->n);
    j->slope_noise = pool_numbers(memory, task->set->n);
    if (memory->failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the joint fit of %zu points", n);
    size_t k = 0;
    for (size_t i = 0; i < task->set->n; i++) {
        const shift_curve *curve = &task->set->curves[i];
        for (size_t p = 0; task->placed[i] && p < curve->n; p++, k++) {
            j->points[k] = (struct point){i, curve->x[p]};
            for (int q = 0; q < MODULI; q++) {
                j->y[q][k] = curve->y[q][p];
                j->weight[q][k] = 1.0;
            }
        }
        if (j->column_a[i] >= 0)
            j->start[j->column_a[i]] = task->a[i];
        if (j->column_b[i] >= 0)
            j->start[j->column_b[i]] = task->b[i];
    }
    memcpy(j->value, j->start, m * sizeof *j->value);
    return WT_OK;
}

static void count_outliers(struct joint *j)
{
    for (size_t i = 0; i < j->task->set->n; i++)
        j->task->n_outliers[i] = 0;
    for (size_t k = 0; k < j->n_points; k++)
        if ((j->task->use[STORAGE] && j->weight[STORAGE][k] < outlier_weight) ||
            (j->task->use[LOSS] && j->weight[LOSS][k] < outlier_weight))
            j->task->n_outliers[j->points[k].curve]++;
}

/* Weight of the prior for the present residuals. */
static void set_prior(struct joint *j)
{
    double spread = SHIFT_NOISE_FLOOR;
    for (int q = 0; q < MODULI; q++)
        if (j->task->use[q])
            spread = fmax(spread, robust_spread(j, q));
    j->prior = (spread / prior_spread) * (spread / prior_spread);
}

wt_status shift_joint_fit(shift_joint *task, wt_error *err)
{
    struct joint j = {.task = task};
    spline_fit spline[MODULI] = {{0}};
    double objective;

    gsl_quiet();
    task->last_step = 0.0;
    wt_status status = joint_alloc(&j, err);
    if (status == WT_OK)
        status = evaluate(&j, j.value, spline, &objective, err);
    for (int round = 0; status == WT_OK && round < REWEIGHTINGS; round++) {
        set_prior(&j);
        if (round > 0)
            reweight(&j);
        status = minimise(&j, spline, err);
    }
    if (status == WT_OK)
        status = covariance(&j, spline, err);
    if (status != WT_OK)
        goto done;
    for (size_t i = 0; i < task->set->n; i++) {
        task->a[i] = shift_a(&j, j.value, i);
        task->b[i] = shift_b(&j, j.value, i);
    }
    if (task->n_outliers != NULL)
        count_outliers(&j);
done:
    for (int q = 0; q < MODULI; q++)
        pspline_free(&spline[q]);
    pool_free(&j.memory);
    return status;
}
