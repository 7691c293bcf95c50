/* Gaussian process regression of a curve through scattered points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/gaussian_process.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/math/arena_gsl.h"
#include "core/math/special.h"
#include "dma/numerics/posterior.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

enum { PARABOLA = GP_PARABOLA_TERMS };
/* Correlation lengths of the departure, relative to half the range. They extend from a quarter
 * (below it the curve has as many slope changes as 15 points) to more than the range. Ratios of
 * its variance to the noise variance of a point extend from what ten points resolve to exact
 * data. The steps are so small that the weights change little between neighbours. */
static const double lengths[] = {0.25, 0.4, 0.6, 1.0, 1.6, 2.5};
static const double ratios[] = {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
enum { MAX_COMPONENTS = COUNT_OF(lengths) * COUNT_OF(ratios) };
/* Components below this weight relative to the best one are dropped. All 48 together then weigh
 * less than a twentieth, which changes no shown digit. */
static const double negligible_weight = 1e-3;

/* One component of the mixture: a correlation length and a variance ratio. */
typedef struct gp_hyperparameters {
    double length, ratio;
    double log_weight, weight;
    double variance;  /* noise variance of a point */
    gsl_matrix *root; /* Cholesky factor of the covariance divided by the noise variance */
    gsl_matrix *flat; /* [n][PARABOLA] covariance^-1 powers */
    gsl_vector *pull; /* [n] covariance^-1 residual */
    double coefficient[PARABOLA], inverse[PARABOLA][PARABOLA];
} gp_hyperparameters;

/* Computes the powers of x or their derivatives. */
static void parabola_powers(double x, gp_order order, double p[PARABOLA])
{
    p[0] = order == GP_VALUE ? 1 : 0;
    p[1] = order == GP_VALUE ? x : 1;
    p[2] = order == GP_VALUE ? x * x : 2 * x;
}

/* Returns the covariance of the departure at x, or its slope, with the departure at a point. */
static double gp_departure_covariance(const gp_hyperparameters *w, double x, double at,
                                      gp_order order)
{
    const double away = (x - at) / w->length, value = w->ratio * exp(-0.5 * away * away);
    return order == GP_VALUE ? value : -away / w->length * value;
}

/* ---- points ---------------------------------------------------------------------------------- */

static void merge_neighbours(gaussian_process *s, const double *x, const double *y, size_t n)
{
    const size_t each = (n + GP_MAX_POINTS - 1) / GP_MAX_POINTS;
    s->n = (n + each - 1) / each;
    s->x = arena_numbers(&s->memory, s->n);
    s->y = arena_numbers(&s->memory, s->n);
    s->count = arena_numbers(&s->memory, s->n);
    s->components = arena_alloc(&s->memory, MAX_COMPONENTS, sizeof *s->components);
    s->centre = 0.5 * (x[0] + x[n - 1]);
    s->half = x[n - 1] > x[0] ? 0.5 * (x[n - 1] - x[0]) : 1;
    for (size_t i = 0; i < n; i++) {
        const size_t k = i / each;
        const double before = s->count[k]++;
        s->x[k] += ((x[i] - s->centre) / s->half - s->x[k]) / (before + 1);
        s->y[k] += (y[i] - s->y[k]) / (before + 1);
    }
}

/* ---- one component --------------------------------------------------------------------------- */

/* Fits the parabola by generalised least squares. Returns false if a matrix is singular. */
static bool solve_parabola(const gaussian_process *s, gp_hyperparameters *w, gsl_vector *powers_y,
                           double *log_det)
{
    double data[PARABOLA * PARABOLA] = {0};
    gsl_matrix_view normal = gsl_matrix_view_array(data, PARABOLA, PARABOLA);
    gsl_vector_view coefficient = gsl_vector_view_array(w->coefficient, PARABOLA);
    for (size_t i = 0; i < s->n; i++) {
        double p[PARABOLA];
        parabola_powers(s->x[i], GP_VALUE, p);
        for (size_t a = 0; a < PARABOLA; a++)
            for (size_t b = 0; b < PARABOLA; b++)
                data[a * PARABOLA + b] += p[a] * gsl_matrix_get(w->flat, i, b);
    }
    if (gsl_linalg_cholesky_decomp1(&normal.matrix) != GSL_SUCCESS)
        return false;
    for (size_t a = 0; a < PARABOLA; a++)
        *log_det += 2 * log(gsl_matrix_get(&normal.matrix, a, a));
    gsl_linalg_cholesky_solve(&normal.matrix, powers_y, &coefficient.vector);
    gsl_linalg_cholesky_invert(&normal.matrix);
    memcpy(w->inverse, data, sizeof data);
    return true;
}

/* Fits a component with its length and ratio. Returns false if a matrix is singular. powers_y:
 * [n] scratch. */
static bool fit_component(const gaussian_process *s, gp_hyperparameters *w, gsl_vector *powers_y)
{
    double log_det = 0, squares = 0;
    gsl_vector_set_zero(powers_y);
    for (size_t i = 0; i < s->n; i++)
        for (size_t k = 0; k < s->n; k++)
            gsl_matrix_set(w->root, i, k,
                           gp_departure_covariance(w, s->x[i], s->x[k], GP_VALUE) +
                               (i == k ? 1 / s->count[i] : 0));
    if (gsl_linalg_cholesky_decomp1(w->root) != GSL_SUCCESS)
        return false;
    for (size_t i = 0; i < s->n; i++) {
        double p[PARABOLA];
        parabola_powers(s->x[i], GP_VALUE, p);
        log_det += 2 * log(gsl_matrix_get(w->root, i, i));
        for (size_t a = 0; a < PARABOLA; a++)
            gsl_matrix_set(w->flat, i, a, p[a]);
    }
    for (size_t a = 0; a < PARABOLA; a++) {
        gsl_vector_view column = gsl_matrix_column(w->flat, a);
        gsl_linalg_cholesky_svx(w->root, &column.vector);
        for (size_t i = 0; i < s->n; i++)
            *gsl_vector_ptr(powers_y, a) += gsl_vector_get(&column.vector, i) * s->y[i];
    }
    gsl_vector_view known = gsl_vector_subvector(powers_y, 0, PARABOLA);
    if (!solve_parabola(s, w, &known.vector, &log_det))
        return false;
    for (size_t i = 0; i < s->n; i++) {
        double p[PARABOLA], fitted = 0;
        parabola_powers(s->x[i], GP_VALUE, p);
        for (size_t a = 0; a < PARABOLA; a++)
            fitted += p[a] * w->coefficient[a];
        gsl_vector_set(w->pull, i, s->y[i] - fitted);
    }
    gsl_vector_memcpy(powers_y, w->pull);
    gsl_linalg_cholesky_svx(w->root, w->pull);
    gsl_blas_ddot(powers_y, w->pull, &squares);
    const double freedom = (double)(s->n - PARABOLA);
    squares = fmax(squares, 1e-300);
    w->variance = squares / freedom;
    w->log_weight = -0.5 * (log_det + freedom * log(squares));
    return isfinite(w->log_weight);
}

static gp_hyperparameters *new_component(gaussian_process *s, double length, double ratio)
{
    gp_hyperparameters *w = &s->components[s->n_components];
    *w = (gp_hyperparameters){.length = length,
                              .ratio = ratio,
                              .root = arena_matrix(&s->memory, s->n, s->n),
                              .flat = arena_matrix(&s->memory, s->n, PARABOLA),
                              .pull = arena_vector(&s->memory, s->n)};
    return w;
}

wt_status gaussian_process_new(const double *x, const double *y, size_t n, gaussian_process *s,
                               wt_error *err)
{
    *s = (gaussian_process){.n = 0};
    gsl_quiet();
    merge_neighbours(s, x, y, n);
    gsl_vector *scratch = arena_vector(&s->memory, s->n);
    double best = -HUGE_VAL, sum = 0;
    for (size_t k = 0; k < COUNT_OF(lengths); k++)
        for (size_t r = 0; r < COUNT_OF(ratios); r++) {
            gp_hyperparameters *w = new_component(s, lengths[k], ratios[r]);
            if (!fit_component(s, w, scratch))
                continue;
            best = fmax(best, w->log_weight);
            s->n_components++;
        }
    if (s->n_components == 0)
        return wt_fail(err, WT_E_CONVERGENCE, "no curve through %zu points", n);
    const size_t made = s->n_components;
    s->n_components = 0;
    for (size_t i = 0; i < made; i++) {
        s->components[i].weight = exp(s->components[i].log_weight - best);
        if (s->components[i].weight < negligible_weight)
            continue;
        sum += s->components[i].weight;
        s->components[s->n_components++] = s->components[i];
    }
    for (size_t i = 0; i < s->n_components; i++)
        s->components[i].weight /= sum;
    return WT_OK;
}

void gaussian_process_free(gaussian_process *s)
{
    arena_free(&s->memory);
    *s = (gaussian_process){.n = 0};
}

/* ---- predictions ----------------------------------------------------------------------------- */

/* Mean of one component, for the scaled x. */
static double component_mean(const gaussian_process *s, const gp_hyperparameters *w, double x,
                             gp_order order)
{
    double p[PARABOLA], mean = 0;
    parabola_powers(x, order, p);
    for (size_t a = 0; a < PARABOLA; a++)
        mean += p[a] * w->coefficient[a];
    for (size_t i = 0; i < s->n; i++)
        mean += gp_departure_covariance(w, x, s->x[i], order) * gsl_vector_get(w->pull, i);
    return mean;
}

static double component_error(const gaussian_process *s, const gp_hyperparameters *w, double x,
                              gp_order order)
{
    double p[PARABOLA], known[GP_MAX_POINTS];
    double square = order == GP_VALUE ? w->ratio : w->ratio / (w->length * w->length);
    gsl_vector_view column = gsl_vector_view_array(known, s->n);
    parabola_powers(x, order, p);
    for (size_t i = 0; i < s->n; i++) {
        known[i] = gp_departure_covariance(w, x, s->x[i], order);
        for (size_t a = 0; a < PARABOLA; a++)
            p[a] -= known[i] * gsl_matrix_get(w->flat, i, a);
    }
    gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, w->root, &column.vector);
    for (size_t i = 0; i < s->n; i++)
        square -= known[i] * known[i];
    for (size_t a = 0; a < PARABOLA; a++)
        for (size_t b = 0; b < PARABOLA; b++)
            square += p[a] * w->inverse[a][b] * p[b];
    return sqrt(fmax(square, 0) * w->variance);
}

/* Returns the factor from the scaled x to x. */
static double output_scale(const gaussian_process *s, gp_order order)
{
    return order == GP_VALUE ? 1 : 1 / s->half;
}

double gaussian_process_mean(const gaussian_process *s, double x, gp_order order)
{
    double mean = 0;
    for (size_t i = 0; i < s->n_components; i++)
        mean += s->components[i].weight *
                component_mean(s, &s->components[i], (x - s->centre) / s->half, order);
    return mean * output_scale(s, order);
}

/* Fills the distributions of all components at one x and returns their number. */
static size_t evaluate_components(const gaussian_process *s, double x, gp_order order,
                                  mixture_component part[MAX_COMPONENTS])
{
    const double at = (x - s->centre) / s->half, scale = output_scale(s, order);
    for (size_t i = 0; i < s->n_components; i++) {
        const gp_hyperparameters *w = &s->components[i];
        part[i] = (mixture_component){w->weight, scale * component_mean(s, w, at, order),
                                      scale * component_error(s, w, at, order)};
    }
    return s->n_components;
}

static double degrees_of_freedom(const gaussian_process *s)
{
    return (double)(s->n - PARABOLA);
}

double gaussian_process_probability_below(const gaussian_process *s, double x, gp_order order,
                                          double limit)
{
    mixture_component part[MAX_COMPONENTS];
    const size_t n = evaluate_components(s, x, order, part);
    return mixture_probability(part, n, degrees_of_freedom(s), limit);
}

wt_interval gaussian_process_interval(const gaussian_process *s, double x)
{
    mixture_component part[MAX_COMPONENTS];
    const size_t n = evaluate_components(s, x, GP_VALUE, part);
    return student_mixture_interval(part, n, degrees_of_freedom(s));
}

/* ---- statistics of slopes -------------------------------------------------------------------- */

/* Maximum weight of components in which the statistic is undefined: the share outside a 95 %
 * interval. */
static const double max_undefined_share = 0.05;

typedef struct slope_workspace {
    const double *x; /* [n] */
    size_t n;
    double *mean, *moved;                /* [n] */
    gsl_matrix *known, *powers;          /* [points][n], [n][PARABOLA] */
    gsl_matrix *covariance, *directions; /* [n][n] */
    gsl_vector *squares;                 /* [n] */
    gsl_eigen_symmv_workspace *eigen;
} slope_workspace;

static double slope_covariance(const gp_hyperparameters *w, double x, double y)
{
    const double away = (x - y) / w->length;
    return w->ratio / (w->length * w->length) * (1 - away * away) * exp(-0.5 * away * away);
}

/* Finds the principal directions of the slopes of one component and their variances. */
static bool find_slope_modes(const gaussian_process *s, const gp_hyperparameters *w,
                             slope_workspace *v)
{
    for (size_t k = 0; k < v->n; k++) {
        const double at = (v->x[k] - s->centre) / s->half;
        gsl_vector_view column = gsl_matrix_column(v->known, k);
        double p[PARABOLA];
        parabola_powers(at, GP_SLOPE, p);
        for (size_t i = 0; i < s->n; i++) {
            const double value = gp_departure_covariance(w, at, s->x[i], GP_SLOPE);
            gsl_vector_set(&column.vector, i, value);
            for (size_t a = 0; a < PARABOLA; a++)
                p[a] -= value * gsl_matrix_get(w->flat, i, a);
        }
        for (size_t a = 0; a < PARABOLA; a++)
            gsl_matrix_set(v->powers, k, a, p[a]);
        for (size_t j = 0; j < v->n; j++)
            gsl_matrix_set(v->covariance, k, j,
                           slope_covariance(w, at, (v->x[j] - s->centre) / s->half));
        v->mean[k] = output_scale(s, GP_SLOPE) * component_mean(s, w, at, GP_SLOPE);
    }
    gsl_blas_dtrsm(CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, 1, w->root, v->known);
    gsl_blas_dgemm(CblasTrans, CblasNoTrans, -1, v->known, v->known, 1, v->covariance);
    for (size_t k = 0; k < v->n; k++)
        for (size_t j = 0; j < v->n; j++)
            for (size_t a = 0; a < PARABOLA * PARABOLA; a++)
                *gsl_matrix_ptr(v->covariance, k, j) += gsl_matrix_get(v->powers, k, a / PARABOLA) *
                                                        w->inverse[a / PARABOLA][a % PARABOLA] *
                                                        gsl_matrix_get(v->powers, j, a % PARABOLA);
    return gsl_eigen_symmv(v->covariance, v->squares, v->directions, v->eigen) == GSL_SUCCESS;
}

static double shifted_statistic(slope_workspace *v, size_t k, double step,
                                gaussian_process_statistic *statistic)
{
    for (size_t i = 0; i < v->n; i++)
        v->moved[i] = v->mean[i] + step * gsl_matrix_get(v->directions, i, k);
    return statistic(v->x, v->moved, v->n);
}

/* Computes the statistic of one component and its error. Returns false if it is undefined. */
static bool component_statistic(const gaussian_process *s, const gp_hyperparameters *w,
                                slope_workspace *v, gaussian_process_statistic *statistic,
                                double *mean, double *error)
{
    if (!find_slope_modes(s, w, v))
        return false;
    double sum = 0;
    *mean = statistic(v->x, v->mean, v->n);
    for (size_t k = 0; k < v->n && isfinite(*mean); k++) {
        const double step = output_scale(s, GP_SLOPE) *
                            sqrt(fmax(gsl_vector_get(v->squares, k), 0) * w->variance),
                     up = shifted_statistic(v, k, step, statistic),
                     down = shifted_statistic(v, k, -step, statistic),
                     half = isnan(up)     ? *mean - down
                            : isnan(down) ? up - *mean
                                          : (up - down) / 2;
        sum += half * half;
    }
    *error = sqrt(sum);
    return isfinite(*mean) && isfinite(*error);
}

static slope_workspace slope_workspace_new(const gaussian_process *s, const double *x, size_t n,
                                           arena *memory)
{
    const slope_workspace v = {.x = x,
                               .n = n,
                               .mean = arena_numbers(memory, n),
                               .moved = arena_numbers(memory, n),
                               .known = arena_matrix(memory, s->n, n),
                               .powers = arena_matrix(memory, n, PARABOLA),
                               .covariance = arena_matrix(memory, n, n),
                               .directions = arena_matrix(memory, n, n),
                               .squares = arena_vector(memory, n),
                               .eigen = gsl_eigen_symmv_alloc(n)};
    if (v.eigen == NULL)
        out_of_memory(n * sizeof(double));
    return v;
}

wt_interval gaussian_process_slope_interval(const gaussian_process *s, const double *x, size_t n,
                                            gaussian_process_statistic *statistic)
{
    arena memory = {0};
    slope_workspace v = slope_workspace_new(s, x, n, &memory);
    mixture_component part[MAX_COMPONENTS];
    size_t known = 0;
    double sum = 0;
    wt_interval interval = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    for (size_t i = 0; i < s->n_components; i++) {
        mixture_component *p = &part[known];
        p->weight = s->components[i].weight;
        if (!component_statistic(s, &s->components[i], &v, statistic, &p->mean, &p->deviation))
            continue;
        sum += p->weight;
        known++;
    }
    for (size_t i = 0; i < known; i++)
        part[i].weight /= sum;
    if (sum >= 1 - max_undefined_share)
        interval = student_mixture_interval(part, known, degrees_of_freedom(s));
    gsl_eigen_symmv_free(v.eigen);
    arena_free(&memory);
    return interval;
}
