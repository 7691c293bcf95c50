/* Priors of a spectrum: smoothness, equilibrium modulus and vertical shifts, and the complete
 * equations of the fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- vertical shifts ------------------------------------------------------------------------- */

/* Correlation length of the departure of the material [K]; a filler network or a transition
 * changes over tens of kelvin. It exceeds two steps of 10 K between
 * isotherms, below which the departure follows single isotherms, as clamping does. It is below
 * half the range of 100 K of a sweep, above which the departure is nearly a line. */
static const double correlation_length = 40.0;

/* Returns the covariance of the smooth departure at two temperatures; it is 0 at the reference. */
static double vertical_departure_covariance(const vertical *v, double t1, double t2)
{
    const double r = v->reference_temperature;
    const double k12 =
        exp(-0.5 * (t1 - t2) * (t1 - t2) / (correlation_length * correlation_length));
    const double k1 = exp(-0.5 * (t1 - r) * (t1 - r) / (correlation_length * correlation_length));
    const double k2 = exp(-0.5 * (t2 - r) * (t2 - r) / (correlation_length * correlation_length));
    return k12 - k1 - k2 + 1.0;
}

double vertical_physical(const vertical *v, double temperature)
{
    const double t0 = v->reference_temperature;
    return log(t0 / temperature) + v->expansion * (temperature - t0);
}

void vertical_alloc(arena *memory, size_t n, vertical *v)
{
    const size_t most = n < SPECTRUM_MAX_SMOOTH ? n : SPECTRUM_MAX_SMOOTH;
    v->prior_storage.precision = arena_numbers(memory, n);
    v->prior_storage.smooth_part = arena_matrix(memory, n, most);
    v->left = arena_numbers(memory, n);
    v->root = arena_matrix(memory, most, most);
    v->prior_storage.at = arena_numbers(memory, most);
}

/* Factors the covariance of the departure by pivoted Cholesky down to rounding. Returns the
 * number of components. */
static size_t factor_departure(const vertical *v, const double *temperature, size_t n,
                               gsl_matrix *smooth_part)
{
    const double departure = v->departure * M_LN10;
    double *left = v->left;
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        left[i] = vertical_departure_covariance(v, temperature[i], temperature[i]);
    for (; departure > 0.0 && m < smooth_part->size2; m++) {
        size_t pivot = 0;
        for (size_t i = 1; i < n; i++)
            pivot = left[i] > left[pivot] ? i : pivot;
        if (!(left[pivot] > DBL_EPSILON))
            break;
        const double root = sqrt(left[pivot]);
        for (size_t i = 0; i < n; i++) {
            double with = vertical_departure_covariance(v, temperature[i], temperature[pivot]);
            for (size_t j = 0; j < m; j++)
                with -= gsl_matrix_get(smooth_part, i, j) * gsl_matrix_get(smooth_part, pivot, j);
            gsl_matrix_set(smooth_part, i, m, with / root);
        }
        for (size_t i = 0; i < n; i++)
            left[i] -= pow(gsl_matrix_get(smooth_part, i, m), 2);
        left[pivot] = 0.0;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++)
            *gsl_matrix_ptr(smooth_part, i, j) *= departure;
    return m;
}

/* Converts the factor F of the departure to S = F R^-T, where R is the factor of 1 + F' P F.
 * *log_det: ln of its determinant. */
static bool departure_to_smooth(const vertical *v, size_t n, double clamped, size_t m,
                                gsl_matrix *smooth_part, double *log_det)
{
    double *root = v->root->data;
    const size_t stride = v->root->tda;
    for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k <= j; k++) {
            double sum = 0.0;
            for (size_t i = 0; i < n; i++)
                sum += gsl_matrix_get(smooth_part, i, j) * gsl_matrix_get(smooth_part, i, k);
            root[j * stride + k] = clamped * sum + (j == k ? 1.0 : 0.0);
        }
    if (!cholesky_factor(root, stride, m, 0.0))
        return false;
    for (size_t i = 0; i < n; i++)
        cholesky_forward(root, stride, m, gsl_matrix_ptr(smooth_part, i, 0),
                         gsl_matrix_ptr(smooth_part, i, 0));
    *log_det = 0.0;
    for (size_t j = 0; j < m; j++)
        *log_det += 2.0 * log(root[j * stride + j]);
    return true;
}

wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err)
{
    const size_t n = s->n_curves;
    const double geometry = v->geometry * M_LN10, clamped = 1.0 / (geometry * geometry);
    *prior = v->prior_storage;
    prior->held = kind == WT_VERTICAL_NONE || kind == WT_VERTICAL_PHYSICAL;
    prior->mean = v->mean;
    for (size_t i = 0; i < n; i++) {
        if (kind != WT_VERTICAL_FREE || i == s->level_curve) /* others start from the former mean */
            v->mean[i] = kind == WT_VERTICAL_NONE ? 0.0 : vertical_physical(v, temperature[i]);
        prior->precision[i] = kind == WT_VERTICAL_TIED || i == s->level_curve ? clamped : 0.0;
    }
    if (kind == WT_VERTICAL_FREE && geometry > 0.0)
        prior->log_det = 2.0 * log(geometry);
    else if (kind != WT_VERTICAL_TIED)
        prior->precision = NULL;
    if (kind != WT_VERTICAL_TIED)
        return WT_OK;
    const size_t m = prior->n_smooth = factor_departure(v, temperature, n, prior->smooth_part);
    if (!departure_to_smooth(v, n, clamped, m, prior->smooth_part, &prior->log_det))
        return wt_fail(err, WT_E_INTERNAL, "the prior of the vertical shifts is not positive");
    prior->log_det += 2.0 * (double)n * log(geometry);
    return WT_OK;
}

/* ---- spectrum and noise ---------------------------------------------------------------------- */

/* Prior of the second difference of terms j to j + 2, in the measured range or beyond an end. */
typedef struct curvature_prior {
    const double *weight;
    double mean, precision;
} curvature_prior;

static bool is_extrapolated(const spectrum *s, size_t j)
{
    return j < s->bend_first || j >= s->bend_end;
}

static curvature_prior find_curvature_prior(const spectrum *s, size_t j)
{
    static const double plain[3] = {1.0, -2.0, 1.0}; /* second difference */
    const spectrum_extrapolation *b = &s->beyond[j < s->bend_first ? 0 : 1];
    if (is_extrapolated(s, j))
        return (curvature_prior){b->weight, b->mean, b->precision};
    return (curvature_prior){plain, 0.0, s->bend[j] / (s->smoothness * s->smoothness)};
}

static double curvature_residual(const curvature_prior *law, const double *value)
{
    return law->weight[0] * value[0] + law->weight[1] * value[1] + law->weight[2] * value[2] -
           law->mean;
}

double spectrum_roughness(const spectrum *s, const double *value)
{
    double sum = 0.0;
    for (size_t j = s->bend_first; j < s->bend_end; j++) {
        const curvature_prior law = find_curvature_prior(s, j);
        sum += s->bend[j] * pow(curvature_residual(&law, value + j), 2);
    }
    return sum;
}

double spectrum_roughness_trace(const spectrum *s)
{
    double sum = 0.0;
    for (size_t j = s->bend_first; j < s->bend_end; j++) {
        const curvature_prior law = find_curvature_prior(s, j);
        for (size_t i = 0; i < 3; i++)
            for (size_t k = 0; k < 3; k++)
                sum += s->bend[j] * law.weight[i] * law.weight[k] *
                       gsl_matrix_get(s->covariance.border, j + i, j + k);
    }
    return sum;
}

static double vertical_residual(const spectrum *s, const double *value, size_t curve)
{
    return spectrum_trial_b(s, value, curve) - s->prior->mean[curve];
}

/* Residual of the level, which a loose prior fixes for tan delta alone. The level is not
 * reported. */
static double level_residual(const spectrum *s, const double *value)
{
    double sum = -s->level;
    for (size_t j = 0; j < s->n_terms; j++)
        sum += value[j] / (double)s->n_terms;
    return sum;
}

/* Computes S' P times the deviation of the vertical shifts from their mean, into prior->at. */
static void project_smooth_part(const spectrum *s, const double *value)
{
    const spectrum_prior *p = s->prior;
    memset(p->at, 0, p->n_smooth * sizeof *p->at);
    for (size_t i = 0; i < s->n_curves; i++) {
        const double off = p->precision[i] * vertical_residual(s, value, i);
        for (size_t j = 0; j < p->n_smooth; j++)
            p->at[j] += gsl_matrix_get(p->smooth_part, i, j) * off;
    }
}

/* Returns the deviation of a vertical shift without its smooth part. */
static double unsmooth_residual(const spectrum *s, const double *value, size_t curve)
{
    const spectrum_prior *p = s->prior;
    double off = vertical_residual(s, value, curve);
    for (size_t j = 0; j < p->n_smooth; j++)
        off -= gsl_matrix_get(p->smooth_part, curve, j) * p->at[j];
    return off;
}

static double vertical_penalty(const spectrum *s, const double *value)
{
    const spectrum_prior *p = s->prior;
    double sum = 0.0;
    if (p->precision == NULL)
        return 0.0;
    project_smooth_part(s, value);
    for (size_t i = 0; i < s->n_curves; i++)
        sum += p->precision[i] * vertical_residual(s, value, i) * unsmooth_residual(s, value, i);
    return sum;
}

double spectrum_objective(const spectrum *s, const double *value)
{
    double sum = 0.0;
    for (size_t j = 0; j + 2 < s->n_terms; j++) {
        const curvature_prior law = find_curvature_prior(s, j);
        sum += law.precision * pow(curvature_residual(&law, value + j), 2);
    }
    for (int q = 0; q < MODULI; q++)
        sum += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
    if (!s->liquid) {
        const double off = (value[s->n_terms] - s->equilibrium_mean) / s->equilibrium_spread;
        sum += off * off;
    }
    if (s->ratio)
        sum += pow(level_residual(s, value), 2);
    for (size_t i = s->n_linear; i < s->n_shared; i++)
        sum += value[i] * value[i];
    return sum + vertical_penalty(s, value);
}

static void add_curvature_priors(spectrum *s)
{
    for (size_t j = 0; j + 2 < s->n_terms; j++) {
        const curvature_prior law = find_curvature_prior(s, j);
        const double off = curvature_residual(&law, s->value + j);
        for (size_t i = 0; i < 3; i++) {
            *gsl_vector_ptr(s->gradient, j + i) -= law.precision * law.weight[i] * off;
            for (size_t k = 0; k < 3; k++)
                *gsl_matrix_ptr(s->precision.border, j + i, j + k) +=
                    law.precision * law.weight[i] * law.weight[k];
        }
    }
}

static void add_vertical_prior(spectrum *s)
{
    const spectrum_prior *p = s->prior;
    if (p->precision == NULL)
        return;
    project_smooth_part(s, s->value);
    for (size_t i = 0; i < s->n_curves; i++) {
        const double w = p->precision[i];
        if (s->column_b[i] < 0)
            continue;
        *gsl_vector_ptr(s->gradient, (size_t)s->column_b[i]) -=
            w * unsmooth_residual(s, s->value, i);
        s->precision.diagonal[BLOCK_DIAGONAL * i + 2] += w;
        for (size_t j = 0; j < p->n_smooth; j++)
            gsl_matrix_set(s->precision.side, BLOCK_SIDE * i + 1, s->n_shared + j,
                           -w * gsl_matrix_get(p->smooth_part, i, j));
    }
    for (size_t j = 0; j < p->n_smooth; j++)
        gsl_matrix_set(s->precision.border, s->n_shared + j, s->n_shared + j, 1.0);
}

static void add_priors(spectrum *s)
{
    add_curvature_priors(s);
    if (!s->liquid) {
        const double w = 1.0 / (s->equilibrium_spread * s->equilibrium_spread);
        *gsl_matrix_ptr(s->precision.border, s->n_terms, s->n_terms) += w;
        *gsl_vector_ptr(s->gradient, s->n_terms) -=
            w * (s->value[s->n_terms] - s->equilibrium_mean);
    }
    const double share = 1.0 / (double)s->n_terms,
                 off = s->ratio ? level_residual(s, s->value) : 0.0;
    for (size_t j = 0; s->ratio && j < s->n_terms; j++) {
        *gsl_vector_ptr(s->gradient, j) -= share * off;
        for (size_t i = 0; i < s->n_terms; i++)
            *gsl_matrix_ptr(s->precision.border, j, i) += share * share;
    }
    for (size_t i = s->n_linear; i < s->n_shared; i++) {
        *gsl_matrix_ptr(s->precision.border, i, i) += 1.0;
        *gsl_vector_ptr(s->gradient, i) -= s->value[i];
    }
    add_vertical_prior(s);
}

/* Adds the normal equations of a modulus times `scale`. */
static void add_normal_equations(bordered_matrix *into, const bordered_matrix *normal, double scale)
{
    const size_t m = normal->m;
    for (size_t i = 0; i < m; i++)
        dense_add_rows(gsl_matrix_ptr(into->border, i, 0), m, &scale, 1,
                       gsl_matrix_const_ptr(normal->border, i, 0), m, 1);
    for (size_t i = 0; i < BLOCK_SIDE * normal->n; i++)
        dense_add_rows(gsl_matrix_ptr(into->side, i, 0), m, &scale, 1,
                       gsl_matrix_const_ptr(normal->side, i, 0), m, 1);
    for (size_t i = 0; i < BLOCK_DIAGONAL * normal->n; i++)
        into->diagonal[i] += scale * normal->diagonal[i];
}

void spectrum_assemble(spectrum *s)
{
    s->inverted = false;
    gsl_vector_set_zero(s->gradient);
    s->precision.m = s->n_shared + s->prior->n_smooth;
    bordered_zero(&s->precision);
    for (int q = 0; q < MODULI; q++) {
        const double scale = 1.0 / (s->noise[q] * s->noise[q]);
        add_normal_equations(&s->precision, &s->normal[q], scale);
        dense_add_rows(s->gradient->data, s->n_unknowns, &scale, 1, s->right[q], s->n_unknowns, 1);
    }
    add_priors(s);
    for (size_t i = 0; i < s->n_curves; i++) { /* fixed shifts */
        double *diagonal = s->precision.diagonal + BLOCK_DIAGONAL * i;
        if (s->column_a[i] < 0)
            diagonal[0] = 1.0;
        if (s->column_b[i] < 0)
            diagonal[2] = 1.0;
    }
}

double spectrum_prior_log_det(const spectrum *s)
{
    return 2.0 * (double)(s->bend_end - s->bend_first) * log(s->smoothness) + s->prior->log_det;
}
