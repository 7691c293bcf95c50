/* Priors of a spectrum: smoothness, equilibrium modulus and vertical shifts, and the complete
 * equations of the fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/cholesky_dense.h"

#include <math.h>
#include <string.h>

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
    return (curvature_prior){plain, 0.0, s->bend[j] / (s->smooth * s->smooth)};
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
            p->at[j] += gsl_matrix_get(p->smooth, i, j) * off;
    }
}

/* Returns the deviation of a vertical shift without its smooth part. */
static double unsmooth_residual(const spectrum *s, const double *value, size_t curve)
{
    const spectrum_prior *p = s->prior;
    double off = vertical_residual(s, value, curve);
    for (size_t j = 0; j < p->n_smooth; j++)
        off -= gsl_matrix_get(p->smooth, curve, j) * p->at[j];
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
            gsl_matrix_set(s->precision.side, BLOCK_SIDE * i + 1, s->n_linear + j,
                           -w * gsl_matrix_get(p->smooth, i, j));
    }
    for (size_t j = 0; j < p->n_smooth; j++)
        gsl_matrix_set(s->precision.border, s->n_linear + j, s->n_linear + j, 1.0);
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
    add_vertical_prior(s);
}

/* Adds J'r of a modulus times `scale`. */
static void add_gradient(spectrum *s, int q, double scale)
{
    const size_t m = s->n_linear, width = m + 2;
    double *gradient = gsl_vector_ptr(s->gradient, 0);
    for (size_t i = 0; i < s->n_curves; i++)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            const double *row = s->row[q] + k * width, r = scale * s->residual[q][k];
            for (size_t j = 0; j < m; j++)
                gradient[j] += r * row[j];
            if (s->column_a[i] >= 0)
                gradient[s->column_a[i]] += r * row[m];
            if (s->column_b[i] >= 0)
                gradient[s->column_b[i]] += r * row[m + 1];
        }
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
    gsl_vector_set_zero(s->gradient);
    s->precision.m = s->n_linear + s->prior->n_smooth;
    bordered_zero(&s->precision);
    for (int q = 0; q < MODULI; q++) {
        const double scale = 1.0 / (s->noise[q] * s->noise[q]);
        add_normal_equations(&s->precision, &s->normal[q], scale);
        add_gradient(s, q, scale);
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

void spectrum_precision(const spectrum *s, gsl_matrix *precision)
{
    const bordered_matrix *p = &s->precision;
    const size_t m = s->n_linear;
    gsl_matrix_set_zero(precision);
    for (size_t i = 0; i < m; i++)
        memcpy(gsl_matrix_ptr(precision, i, 0), gsl_matrix_const_ptr(p->border, i, 0),
               m * sizeof(double));
    for (size_t i = 0; i < s->n_curves; i++) {
        const long column[BLOCK_SIDE] = {s->column_a[i], s->column_b[i]};
        for (size_t c = 0; c < BLOCK_SIDE; c++) {
            const double *row = gsl_matrix_const_ptr(p->side, BLOCK_SIDE * i + c, 0);
            if (column[c] < 0)
                continue;
            const size_t at = (size_t)column[c];
            for (size_t j = 0; j < m; j++) {
                gsl_matrix_set(precision, at, j, row[j]);
                gsl_matrix_set(precision, j, at, row[j]);
            }
            for (size_t d = 0; d < BLOCK_SIDE; d++)
                if (column[d] >= 0)
                    gsl_matrix_set(precision, at, (size_t)column[d],
                                   p->diagonal[BLOCK_DIAGONAL * i + c + d]);
        }
        /* removes the smooth part: P - P S S' P */
        for (size_t k = 0; s->column_b[i] >= 0 && s->prior->n_smooth > 0 && k < s->n_curves; k++) {
            const double *one = gsl_matrix_const_ptr(p->side, BLOCK_SIDE * i + 1, m),
                         *other = gsl_matrix_const_ptr(p->side, BLOCK_SIDE * k + 1, m);
            for (size_t j = 0; s->column_b[k] >= 0 && j < s->prior->n_smooth; j++)
                *gsl_matrix_ptr(precision, (size_t)s->column_b[i], (size_t)s->column_b[k]) -=
                    one[j] * other[j];
        }
    }
}

double spectrum_prior_log_det(const spectrum *s)
{
    return 2.0 * (double)(s->bend_end - s->bend_first) * log(s->smooth) + s->prior->log_det;
}
