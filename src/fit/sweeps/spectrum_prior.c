/* What is believed of a spectrum before it is measured: that it is smooth, its equilibrium modulus,
 * the vertical shifts; and the equations of the fit with that.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/spectrum.h"

#include <math.h>

/* Of terms j to j + 2: by the measured range, or beyond one of its ends. */
typedef struct bend_law {
    const double *weight;
    double mean, precision;
} bend_law;

static bool is_beyond(const spectrum *s, size_t j)
{
    return j < s->bend_first || j >= s->bend_end;
}

static bend_law law_of_bend(const spectrum *s, size_t j)
{
    static const double plain[3] = {1.0, -2.0, 1.0}; /* second difference */
    const spectrum_beyond *b = &s->beyond[j < s->bend_first ? 0 : 1];
    if (is_beyond(s, j))
        return (bend_law){b->weight, b->mean, b->precision};
    return (bend_law){plain, 0.0, s->bend[j] / (s->smooth * s->smooth)};
}

static double off_law(const bend_law *law, const double *value)
{
    return law->weight[0] * value[0] + law->weight[1] * value[1] + law->weight[2] * value[2] -
           law->mean;
}

double spectrum_roughness(const spectrum *s, const double *value)
{
    double sum = 0.0;
    for (size_t j = s->bend_first; j < s->bend_end; j++) {
        const bend_law law = law_of_bend(s, j);
        sum += s->bend[j] * pow(off_law(&law, value + j), 2);
    }
    return sum;
}

double spectrum_roughness_trace(const spectrum *s)
{
    double sum = 0.0;
    for (size_t j = s->bend_first; j < s->bend_end; j++) {
        const bend_law law = law_of_bend(s, j);
        for (size_t i = 0; i < 3; i++)
            for (size_t k = 0; k < 3; k++)
                sum += s->bend[j] * law.weight[i] * law.weight[k] *
                       gsl_matrix_get(s->covariance, j + i, j + k);
    }
    return sum;
}

static double off_mean_b(const spectrum *s, const double *value, size_t curve)
{
    return spectrum_b_of(s, value, curve) - s->prior->mean[curve];
}

/* By tan delta alone the level is held, loosely: it is no part of what is told. */
static double off_level(const spectrum *s, const double *value)
{
    double sum = -s->level;
    for (size_t j = 0; j < s->n_terms; j++)
        sum += value[j] / (double)s->n_terms;
    return sum;
}

double spectrum_objective(const spectrum *s, const double *value)
{
    double sum = 0.0;
    for (size_t j = 0; j + 2 < s->n_terms; j++) {
        const bend_law law = law_of_bend(s, j);
        sum += law.precision * pow(off_law(&law, value + j), 2);
    }
    for (int q = 0; q < MODULI; q++)
        sum += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
    if (!s->liquid) {
        const double off = (value[s->n_terms] - s->equilibrium_mean) / s->equilibrium_spread;
        sum += off * off;
    }
    if (s->ratio)
        sum += pow(off_level(s, value), 2);
    for (size_t i = 0; s->prior->precision != NULL && i < s->n_curves; i++)
        for (size_t k = 0; k < s->n_curves; k++)
            sum += gsl_matrix_get(s->prior->precision, i, k) * off_mean_b(s, value, i) *
                   off_mean_b(s, value, k);
    return sum;
}

static void add_bends(spectrum *s)
{
    for (size_t j = 0; j + 2 < s->n_terms; j++) {
        const bend_law law = law_of_bend(s, j);
        const double off = off_law(&law, s->value + j);
        for (size_t i = 0; i < 3; i++) {
            *gsl_vector_ptr(s->gradient, j + i) -= law.precision * law.weight[i] * off;
            for (size_t k = 0; k < 3; k++)
                *gsl_matrix_ptr(s->precision, j + i, j + k) +=
                    law.precision * law.weight[i] * law.weight[k];
        }
    }
}

static void add_vertical(spectrum *s)
{
    for (size_t i = 0; s->prior->precision != NULL && i < s->n_curves; i++)
        for (size_t k = 0; s->column_b[i] >= 0 && k < s->n_curves; k++) {
            const double w = gsl_matrix_get(s->prior->precision, i, k);
            *gsl_vector_ptr(s->gradient, (size_t)s->column_b[i]) -= w * off_mean_b(s, s->value, k);
            if (s->column_b[k] >= 0)
                *gsl_matrix_ptr(s->precision, (size_t)s->column_b[i], (size_t)s->column_b[k]) += w;
        }
}

static void add_priors(spectrum *s)
{
    add_bends(s);
    if (!s->liquid) {
        const double w = 1.0 / (s->equilibrium_spread * s->equilibrium_spread);
        *gsl_matrix_ptr(s->precision, s->n_terms, s->n_terms) += w;
        *gsl_vector_ptr(s->gradient, s->n_terms) -=
            w * (s->value[s->n_terms] - s->equilibrium_mean);
    }
    const double share = 1.0 / (double)s->n_terms, off = s->ratio ? off_level(s, s->value) : 0.0;
    for (size_t j = 0; s->ratio && j < s->n_terms; j++) {
        *gsl_vector_ptr(s->gradient, j) -= share * off;
        for (size_t i = 0; i < s->n_terms; i++)
            *gsl_matrix_ptr(s->precision, j, i) += share * share;
    }
    add_vertical(s);
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

void spectrum_assemble(spectrum *s)
{
    gsl_vector_set_zero(s->gradient);
    gsl_matrix_set_zero(s->precision);
    for (int q = 0; q < MODULI; q++) {
        const double scale = 1.0 / (s->noise[q] * s->noise[q]);
        for (size_t i = 0; i < s->n_unknowns; i++)
            for (size_t k = 0; k < s->n_unknowns; k++)
                *gsl_matrix_ptr(s->precision, i, k) += scale * gsl_matrix_get(s->normal[q], i, k);
        add_gradient(s, q, scale);
    }
    add_priors(s);
}

double spectrum_prior_log_det(const spectrum *s)
{
    return 2.0 * (double)(s->bend_end - s->bend_first) * log(s->smooth) + s->prior->log_det;
}
