/* How noise goes together along an isotherm: a first-order autoregression, by the criterion of the
 * fit, or within the isotherms alone. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/spectrum.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

static const double rhos[] = {0.0, 0.2, 0.4, 0.6, 0.75, 0.88};
enum { RHOS = sizeof rhos / sizeof *rhos };

wt_status spectrum_choose_rho(spectrum *s, wt_error *err)
{
    double best = s->criterion, chosen = s->rho;
    wt_status status = WT_OK;
    for (size_t i = 1; status == WT_OK && i < RHOS; i++) {
        s->rho = rhos[i];
        status = spectrum_fit(s, SPECTRUM_ROUGH, err);
        if (status != WT_OK || s->criterion >= best)
            break; /* it has one minimum */
        best = s->criterion;
        chosen = rhos[i];
    }
    s->rho = chosen;
    return status == WT_OK ? spectrum_fit(s, SPECTRUM_NOISE, err) : status;
}

/* ---- within the isotherms -------------------------------------------------------------------- */

/* A polynomial of its own through the residuals of an isotherm in a modulus, of as many
 * coefficients as its points allow: what a second process leaves bends more than a parabola, and
 * would be taken for noise that goes together over decades. */
enum { LEAST_COEFFICIENTS = 3, MOST_COEFFICIENTS = 5, MOST_WIDTH = MOST_COEFFICIENTS + 1 };
/* Points beyond the coefficients below which an isotherm says nothing. */
enum { LEAST_LEFT = 3 };

struct within {
    double squares, freedom, log_det;
};

/* v: [n * MOST_WIDTH] scratch; residuals are not whitened. */
static struct within residual_within(const spectrum *s, size_t curve, int q, double *v)
{
    const size_t from = s->first[curve], to = s->first[curve + 1];
    const double middle = 0.5 * (s->x[from] + s->x[to - 1]);
    const double half = 0.5 * (s->x[to - 1] - s->x[from]);
    size_t n = LEAST_COEFFICIENTS;
    while (n < MOST_COEFFICIENTS && 2 * (n + 2) <= to - from)
        n++;
    const size_t width = n + 1;
    double cross_block[MOST_WIDTH * MOST_WIDTH] = {0};
    struct within w = {0.0, -(double)n, 0.0};
    for (size_t k = from; k < to; k++) {
        double power = s->weight[q][k] > 0.0 ? 1.0 : 0.0;
        w.freedom += power;
        v[k * width + n] = power * s->residual[q][k];
        for (size_t i = 0; i < n; i++, power *= (s->x[k] - middle) / half)
            v[k * width + i] = power;
    }
    if (w.freedom < (double)LEAST_LEFT || !(half > 0.0))
        return (struct within){0.0, 0.0, 0.0};
    spectrum_whiten(s, curve, q, v, width);
    for (size_t k = from; k < to; k++)
        for (size_t i = 0; i < width; i++)
            for (size_t j = 0; j < width; j++)
                cross_block[i * width + j] += v[k * width + i] * v[k * width + j];
    /* the last pivot of the Cholesky factor is what the polynomial leaves */
    gsl_matrix_view cross = gsl_matrix_view_array(cross_block, width, width);
    if (gsl_linalg_cholesky_decomp1(&cross.matrix) != GSL_SUCCESS)
        return (struct within){0.0, 0.0, 0.0};
    const double last = gsl_matrix_get(&cross.matrix, n, n);
    w.squares = last * last;
    for (size_t i = 0; i < n; i++)
        w.log_det += 2.0 * log(gsl_matrix_get(&cross.matrix, i, i));
    return w;
}

/* -2 ln restricted likelihood of the polynomials, and the variance of each modulus. */
static double within_all(const spectrum *s, double *v, double variance[MODULI])
{
    double criterion = spectrum_log_det_correlation(s);
    for (int q = 0; q < MODULI; q++) {
        struct within sum = {0};
        for (size_t i = 0; i < s->n_curves; i++) {
            const struct within w = residual_within(s, i, q, v);
            sum.squares += w.squares;
            sum.freedom += w.freedom;
            sum.log_det += w.log_det;
        }
        variance[q] = sum.freedom > 0.0 ? sum.squares / sum.freedom : 0.0;
        criterion += sum.log_det + (sum.freedom > 0.0 ? sum.freedom * log(variance[q]) : 0.0);
    }
    return criterion;
}

wt_status spectrum_noise_within(spectrum *s, double *rho, wt_error *err)
{
    double *v = calloc(s->n * MOST_WIDTH, sizeof *v);
    double best = HUGE_VAL, variance[MODULI];
    if (v == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the noise");
    s->rho = 0.0;
    for (size_t i = 0; i < s->n_curves; i++)
        s->kappa[i] = 1.0;
    spectrum_evaluate(s, s->value, false);
    for (size_t i = 0; i < RHOS; i++) {
        s->rho = rhos[i];
        const double criterion = within_all(s, v, variance);
        if (criterion < best) {
            best = criterion;
            *rho = rhos[i];
        }
    }
    s->rho = *rho;
    (void)within_all(s, v, variance);
    double mean = 0.0;
    for (size_t i = 0; i < s->n_curves; i++) {
        double squares = SPECTRUM_KAPPA_BELIEF, freedom = SPECTRUM_KAPPA_BELIEF;
        for (int q = 0; q < MODULI; q++) {
            const struct within w = residual_within(s, i, q, v);
            if (variance[q] > 0.0) {
                squares += w.squares / variance[q];
                freedom += w.freedom;
            }
        }
        s->kappa[i] = sqrt(squares / freedom);
        mean += log(s->kappa[i]) / (double)s->n_curves;
    }
    for (size_t i = 0; i < s->n_curves; i++)
        s->kappa[i] *= exp(-mean);
    s->rho = 0.0;
    free(v);
    return WT_OK;
}
