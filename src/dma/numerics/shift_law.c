/* Shift laws: generalised least squares with the full covariance of the shifts and a temperature
 * error of each isotherm, which is averaged.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/shift_law.h"

#include "core/base/quantity.h"
#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Half width of the Cauchy prior of the temperature error [K]: the tolerance of a class B
 * platinum thermometer at 0 degC (IEC 60751). */
const double law_temperature_tolerance = 0.3;
/* Additional prior weight of the smallest temperature error, a fifth of all, because a program
 * may be very stable. The data must then favour it by 4 to 1 to give it half of the weight, which
 * is substantial evidence on the scale of Jeffreys (Theory of Probability, 1961, appendix B). */
static const double zero_spread_weight = 0.15;
/* Minimum number of isotherms for that weight. With n - 3 degrees of freedom scatter as large as
 * the noise appears absent (chi^2 below half its mean) with probability 0.39 for five, 0.26 for
 * seven. */
enum { LEAST_STEADY = 7 };
/* Range of the pole distance below the coldest isotherm [K]. Measurements end above it, because
 * the pole is 51.6 K below the glass transition (Williams, Landel and Ferry 1955). A farther
 * pole gives a straight line, with 1 % of curvature over 100 K. */
#define POLE_NEAREST 2.0
#define POLE_FARTHEST 1e4
/* Maximum error of ln of the pole distance (a factor 50 to either side at 95 %). A less certain
 * pole has no visible curvature, its constants are meaningless, and the law is rejected. */
#define POLE_ERROR 2.0
/* Positions of the pole in the scan, a factor 1.5 apart, and parabolas through three positions
 * about the best one, each a tenth of the former apart. The last one is less than 1e-6 off. */
enum { POLE_GRID = 20, POLE_PARABOLAS = 4 };
/* Maximum move of a parabola, in its distances: the minimum may be as far away as the former
 * positions. */
static const double most_move = 10.0;

double law_spread(size_t i)
{
    return ldexp(0.004, (int)i);
}

/* ---- the laws -------------------------------------------------------------------------------- */

static bool law_has_wlf(const law_shape *shape)
{
    return shape->kind != WT_LAW_ARRHENIUS;
}

size_t law_unknowns(const law_shape *shape)
{
    static const size_t count[] = {
        [WT_LAW_WLF] = 3, [WT_LAW_ARRHENIUS] = 2, [WT_LAW_WLF_ARRHENIUS] = 4}; /* number of unknowns
                                                                                */
    return count[shape->kind] + (shape->outlier >= 0 ? 1 : 0);
}

size_t law_outlier_index(const law_shape *shape)
{
    if (shape->outlier < 0)
        return LAW_MAX_UNKNOWNS;
    return shape->kind == WT_LAW_WLF_ARRHENIUS ? 3 : 2;
}

size_t law_pole_index(const law_shape *shape)
{
    return law_has_wlf(shape) ? law_unknowns(shape) - 1 : LAW_MAX_UNKNOWNS;
}

/* Returns -(T - Tref)/(C2 + T - Tref) and its derivative by ln of the pole distance. */
static double wlf_factor(const law_shape *shape, double distance, double temperature,
                         double *by_pole)
{
    const double rise = temperature - shape->reference;
    const double sum = distance + temperature - shape->coldest;
    *by_pole = rise / sum * (distance / sum);
    return -rise / sum;
}

static double arrhenius_factor(double reference, double temperature)
{
    return (reference - temperature) / (reference * temperature) / (GAS_CONSTANT * M_LN10);
}

/* Returns the factor of the main constant and its derivative by the pole. */
static double main_law_factor(const law_shape *shape, double distance, double temperature,
                              double *by_pole)
{
    const double r = shape->reference, joint = shape->joint;
    *by_pole = 0.0;
    if (!law_has_wlf(shape))
        return arrhenius_factor(r, temperature);
    if (shape->kind != WT_LAW_WLF_ARRHENIUS)
        return wlf_factor(shape, distance, temperature, by_pole);
    double of_reference;
    const double part = wlf_factor(shape, distance, fmax(temperature, joint), by_pole) -
                        wlf_factor(shape, distance, fmax(r, joint), &of_reference);
    *by_pole -= of_reference;
    return part;
}

/* Returns the factor of the energy below the joint. */
static double below_joint_factor(const law_shape *shape, double temperature)
{
    return shape->kind == WT_LAW_WLF_ARRHENIUS
               ? arrhenius_factor(fmin(shape->reference, shape->joint),
                                  fmin(temperature, shape->joint))
               : 0.0;
}

static double pole_distance(const law_shape *shape, const double *unknown)
{
    return law_has_wlf(shape) ? exp(unknown[law_pole_index(shape)]) : 1.0;
}

double law_value(const law_shape *shape, const double *unknown, double temperature,
                 double *gradient)
{
    double by_pole;
    const double main_part =
                     main_law_factor(shape, pole_distance(shape, unknown), temperature, &by_pole),
                 below = below_joint_factor(shape, temperature);
    const bool joined = shape->kind == WT_LAW_WLF_ARRHENIUS;
    if (gradient != NULL) {
        for (size_t u = 0; u < LAW_MAX_UNKNOWNS; u++)
            gradient[u] = 0.0;
        gradient[1] = main_part;
        if (joined)
            gradient[2] = below;
        if (law_has_wlf(shape))
            gradient[law_pole_index(shape)] = unknown[1] * by_pole;
    }
    return unknown[1] * main_part + (joined ? unknown[2] * below : 0.0);
}

double law_isotherm_value(const law_data *data, const law_shape *shape, const double *unknown,
                          size_t i)
{
    return unknown[0] + law_value(shape, unknown, data->temperature[i], NULL) +
           ((long)i == shape->outlier ? unknown[law_outlier_index(shape)] : 0.0);
}

wt_shift_law law_constants(const law_shape *shape, const double *unknown)
{
    wt_shift_law law = {.kind = shape->kind,
                        .wlf = {shape->reference, (double)NAN, (double)NAN},
                        .activation_energy = (double)NAN,
                        .joint = shape->kind == WT_LAW_WLF_ARRHENIUS ? shape->joint : (double)NAN};
    if (law_has_wlf(shape)) {
        law.wlf.c1 = unknown[1];
        law.wlf.c2 = shape->reference - shape->coldest + pole_distance(shape, unknown);
    }
    if (shape->kind == WT_LAW_ARRHENIUS)
        law.activation_energy = unknown[1];
    if (shape->kind == WT_LAW_WLF_ARRHENIUS)
        law.activation_energy = unknown[2];
    return law;
}

/* ---- generalised least squares --------------------------------------------------------------- */

wt_status law_gls_covariance(const law_data *data, double spread, gsl_matrix *covariance,
                             wt_error *err)
{
    gsl_matrix_memcpy(covariance, data->covariance);
    for (size_t i = 0; i < data->n; i++)
        *gsl_matrix_ptr(covariance, i, i) += spread * spread * data->slope[i] * data->slope[i];
    if (!dense_factor(covariance))
        return wt_fail(err, WT_E_CONVERGENCE, "the covariance of the shifts is not positive");
    return WT_OK;
}

/* Fills the columns that depend on the pole distance: the main one, and its derivative if the
 * matrix has that column. */
static void design_pole(const law_data *data, const law_shape *shape, double distance,
                        double main_factor, gsl_matrix *x)
{
    const size_t pole = law_pole_index(shape);
    for (size_t i = 0; i < data->n; i++) {
        double by_pole;
        gsl_matrix_set(x, i, 1, main_law_factor(shape, distance, data->temperature[i], &by_pole));
        if (pole < x->size2)
            gsl_matrix_set(x, i, pole, main_factor * by_pole);
    }
}

/* Fills the columns of offset, branch below the joint and outlier. */
static void design_fixed(const law_data *data, const law_shape *shape, gsl_matrix *x)
{
    const size_t outlier = law_outlier_index(shape);
    for (size_t i = 0; i < data->n; i++) {
        gsl_matrix_set(x, i, 0, 1.0);
        if (shape->kind == WT_LAW_WLF_ARRHENIUS)
            gsl_matrix_set(x, i, 2, below_joint_factor(shape, data->temperature[i]));
        if (outlier < LAW_MAX_UNKNOWNS)
            gsl_matrix_set(x, i, outlier, (long)i == shape->outlier ? 1.0 : 0.0);
    }
}

void law_design(const law_data *data, const law_shape *shape, const double *unknown, gsl_matrix *x)
{
    design_fixed(data, shape, x);
    design_pole(data, shape, pole_distance(shape, unknown), unknown[1], x);
}

/* Shifts and design matrix divided by the errors. */
struct gls {
    const law_data *data;
    const law_shape *shape;
    const gsl_matrix *root; /* Cholesky factor of the covariance of the shifts and temperatures */
    gsl_vector_view y;      /* [n] */
    gsl_matrix_view x;      /* [n * unknowns] */
    double *column;         /* [n] a column */
};

/* Whitens the columns that depend on the pole, or the others. */
static void whiten_columns(const struct gls *g, gsl_matrix *x, bool pole_columns)
{
    for (size_t u = 0; u < x->size2; u++) {
        gsl_vector_view column = gsl_matrix_column(x, u),
                        copy = gsl_vector_view_array(g->column, x->size1);
        if ((u == 1 || u == law_pole_index(g->shape)) != pole_columns)
            continue;
        gsl_vector_memcpy(&copy.vector, &column.vector);
        dense_forward(g->root, g->column);
        gsl_vector_memcpy(&column.vector, &copy.vector);
    }
}

static struct gls gls_new(const law_data *data, const law_shape *shape, const gsl_matrix *root)
{
    const size_t n = data->n;
    double *const y = data->scratch, *const column = y + n;
    struct gls g = {.data = data,
                    .shape = shape,
                    .root = root,
                    .y = gsl_vector_view_array(y, n),
                    .x = gsl_matrix_view_array(column + n, n, law_unknowns(shape)),
                    .column = column};
    memcpy(y, data->log_a, n * sizeof *y);
    dense_forward(root, y);
    design_fixed(data, shape, &g.x.matrix);
    whiten_columns(&g, &g.x.matrix, false);
    return g;
}

/* Returns a view of the covariance of the first unknowns; solve_at_pole() leaves a factor of its
 * inverse there. */
static gsl_matrix_view fit_covariance(law_fit *fit, size_t used)
{
    return gsl_matrix_view_array_with_tda(&fit->covariance[0][0], used, used, LAW_MAX_UNKNOWNS);
}

/* Solves the least squares for a pole distance with `used` columns. Returns false if they are
 * dependent. The covariance gets the factor of its inverse. */
static bool solve_at_pole(struct gls *g, double distance, double main_factor, size_t used,
                          law_fit *fit)
{
    gsl_matrix_view x = gsl_matrix_submatrix(&g->x.matrix, 0, 0, g->data->n, used);
    gsl_matrix_view cross = fit_covariance(fit, used);
    gsl_vector_view right = gsl_vector_view_array(fit->unknown, used);
    design_pole(g->data, g->shape, distance, main_factor, &x.matrix);
    whiten_columns(g, &x.matrix, true);
    gsl_blas_dsyrk(CblasLower, CblasTrans, 1.0, &x.matrix, 0.0, &cross.matrix);
    gsl_blas_dgemv(CblasTrans, 1.0, &x.matrix, &g->y.vector, 0.0, &right.vector);
    if (gsl_linalg_cholesky_decomp1(&cross.matrix) != GSL_SUCCESS)
        return false;
    gsl_linalg_cholesky_svx(&cross.matrix, &right.vector);
    fit->log_det_design = fit->chi_square = 0.0;
    for (size_t u = 0; u < used; u++)
        fit->log_det_design += 2.0 * log(fit->covariance[u][u]);
    for (size_t i = 0; i < g->data->n; i++) {
        double off = gsl_vector_get(&g->y.vector, i);
        for (size_t u = 0; u < used; u++)
            off -= gsl_matrix_get(&x.matrix, i, u) * fit->unknown[u];
        fit->chi_square += off * off;
    }
    return true;
}

/* Returns chi^2 with this pole, HUGE_VAL if the law rises with temperature. */
static double pole_chi_square(struct gls *g, double log_distance)
{
    law_fit fit = {0};
    const bool is_solved = solve_at_pole(g, exp(log_distance), 1.0, g->x.matrix.size2 - 1, &fit);
    return is_solved && fit.unknown[1] > 0.0 ? fit.chi_square : HUGE_VAL;
}

/* Finds the best ln of the pole distance by parabolas, from the given one if that is better than
 * its neighbours, otherwise from a scan. Returns false without one. */
static bool fit_pole(struct gls *g, double *at)
{
    const double nearest = log(POLE_NEAREST), farthest = log(POLE_FARTHEST);
    double step = (farthest - nearest) / POLE_GRID;
    double best = *at >= nearest ? pole_chi_square(g, *at) : HUGE_VAL;
    if (!(best < HUGE_VAL && best <= pole_chi_square(g, fmax(nearest, *at - step)) &&
          best <= pole_chi_square(g, fmin(farthest, *at + step)))) {
        best = HUGE_VAL;
        for (int i = 0; i <= POLE_GRID; i++) {
            const double p = nearest + i * step, chi = pole_chi_square(g, p);
            *at = chi < best ? p : *at;
            best = fmin(best, chi);
        }
    }
    for (int i = 0; i < POLE_PARABOLAS; i++, step *= 0.1) {
        const double before = pole_chi_square(g, *at - step),
                     after = pole_chi_square(g, *at + step);
        const double bend = before - 2.0 * best + after;
        const double move = bend > 0.0 ? 0.5 * (before - after) / bend : 0.0; /* [steps] */
        const double p =
            fmax(nearest, fmin(farthest, *at + step * fmax(-most_move, fmin(move, most_move))));
        const double chi = pole_chi_square(g, p);
        *at = chi < best ? p : *at;
        best = fmin(best, chi);
    }
    return best < HUGE_VAL;
}

wt_status law_fit_gls(law_data *data, const law_shape *shape, const gsl_matrix *root, law_fit *fit,
                      wt_error *err)
{
    struct gls g = gls_new(data, shape, root);
    const size_t k = law_unknowns(shape), pole = law_pole_index(shape);
    *fit = (law_fit){.n_unknowns = k};
    bool good;
    if (pole == LAW_MAX_UNKNOWNS) {
        good = solve_at_pole(&g, 1.0, 1.0, k, fit);
    } else {
        double p = data->pole;
        good = fit_pole(&g, &p) && solve_at_pole(&g, exp(p), 1.0, k - 1, fit);
        const law_fit linear = *fit;
        good = good && solve_at_pole(&g, exp(p), linear.unknown[1], k, fit);
        memcpy(fit->unknown, linear.unknown, sizeof linear.unknown);
        fit->unknown[pole] = data->pole = p;
        fit->chi_square = linear.chi_square;
    }
    if (!good || !(fit->unknown[1] > 0.0)) {
        wt_fail(err, WT_E_RANGE, "the shift factors do not fall with temperature");
        wt_error_advice(err, "are the temperatures those of the isotherms?");
        return WT_E_RANGE;
    }
    gsl_matrix_view covariance = fit_covariance(fit, k);
    gsl_linalg_cholesky_invert(&covariance.matrix);
    if (pole < LAW_MAX_UNKNOWNS && !(fit->covariance[pole][pole] < POLE_ERROR * POLE_ERROR))
        fit->chi_square = HUGE_VAL;
    for (size_t i = 0; i < data->n; i++)
        fit->log_det += 2.0 * log(gsl_matrix_get(root, i, i));
    return WT_OK;
}

double law_reml(const law_fit *fit)
{
    return fit->chi_square + fit->log_det + fit->log_det_design;
}

double law_spread_prior(const law_data *data, double spread)
{
    const bool none = data->n >= LEAST_STEADY && !(spread > law_spread(0));
    return spread /
               (1.0 + spread * spread / (law_temperature_tolerance * law_temperature_tolerance)) +
           (none ? zero_spread_weight : 0.0);
}
