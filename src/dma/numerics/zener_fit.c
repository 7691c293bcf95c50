/* Fits a fractional Zener law to the points of a master curve and compares it with the series.
 * The constants have no errors, because the residuals are not noise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/special.h"
#include "dma/law/prony_law.h"
#include "weartrack/dma.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

/* Limits of the iteration; twelve dampings by ten leave 1e-12 of a step. */
enum { CONSTANTS = 4, STEPS = 200, DAMPINGS = 12 };
/* Above this ratio to the measured moduli the glass modulus is undetermined, because less than a
 * tenth of the transition is visible. A long-term modulus below this share of the lowest E'
 * counts as 0. */
static const double max_glass_ratio = 10, negligible = 1e-3;
enum { LN_E0, LN_RISE, LN_TAU, LOGIT_ALPHA };

/* Computes ln E' and ln E'' of E0 + rise z/(1 + z), z = (i w tau)^alpha. */
static void zener_log_moduli(const double *p, double ln_w, double ln[2])
{
    const double alpha = 1 / (1 + exp(-p[LOGIT_ALPHA])), exponent = alpha * (ln_w + p[LN_TAU]);
    const double r = exp(-fabs(exponent)), c = cos(alpha * M_PI_2), s = sin(alpha * M_PI_2);
    const double below = 1 + 2 * r * c + r * r, above = exponent < 0 ? r * (c + r) : 1 + r * c;
    ln[0] = log(exp(p[LN_E0]) + exp(p[LN_RISE]) * (above / below));
    ln[1] = p[LN_RISE] + log(r * s / below);
}

/* Returns true if both moduli of the point are measured and not excluded. */
static bool is_usable_point(const wt_master *m, size_t i)
{
    return !m->is_outlier[i] && isfinite(m->log_storage[i]) && isfinite(m->log_loss[i]);
}

/* Returns the sum of squared ln residuals of the included points, and fills the sum of each
 * modulus. */
static double log_residual_squares(const wt_master *m, const double *p, double squares[2])
{
    squares[0] = squares[1] = 0;
    for (size_t i = 0; i < m->n; i++) {
        double ln[2];
        if (!is_usable_point(m, i))
            continue;
        zener_log_moduli(p, m->log_frequency[i] * M_LN10, ln);
        squares[0] += pow(ln[0] - m->log_storage[i] * M_LN10, 2);
        squares[1] += pow(ln[1] - m->log_loss[i] * M_LN10, 2);
    }
    return squares[0] + squares[1];
}

static void normal_equations(const wt_master *m, const double *p, double normal[][CONSTANTS],
                             double *gradient)
{
    const double step = 1e-5;
    for (int i = 0; i < CONSTANTS; i++) {
        gradient[i] = 0;
        for (int j = 0; j < CONSTANTS; j++)
            normal[i][j] = 0;
    }
    for (size_t k = 0; k < m->n; k++) {
        double here[2], slope[2][CONSTANTS];
        const double x = m->log_frequency[k] * M_LN10;
        if (!is_usable_point(m, k))
            continue;
        zener_log_moduli(p, x, here);
        for (int i = 0; i < CONSTANTS; i++) {
            double shifted[CONSTANTS], high[2], low[2];
            for (int j = 0; j < CONSTANTS; j++)
                shifted[j] = p[j] + (j == i ? step : 0);
            zener_log_moduli(shifted, x, high);
            shifted[i] = p[i] - step;
            zener_log_moduli(shifted, x, low);
            for (int q = 0; q < 2; q++)
                slope[q][i] = (high[q] - low[q]) / (2 * step);
        }
        const double off[2] = {m->log_storage[k] * M_LN10 - here[0],
                               m->log_loss[k] * M_LN10 - here[1]};
        for (int q = 0; q < 2; q++)
            for (int i = 0; i < CONSTANTS; i++) {
                gradient[i] += slope[q][i] * off[q];
                for (int j = 0; j < CONSTANTS; j++)
                    normal[i][j] += slope[q][i] * slope[q][j];
            }
    }
}

/* Levenberg-Marquardt; returns the sum of squares. */
static double minimise_squares(const wt_master *m, double *p)
{
    double squares[2], sum = log_residual_squares(m, p, squares), damping = 1e-2;
    for (int i = 0; i < STEPS; i++) {
        double normal[CONSTANTS][CONSTANTS], gradient[CONSTANTS], next = HUGE_VAL;
        normal_equations(m, p, normal, gradient);
        for (int k = 0; k < DAMPINGS && !(next < sum); k++, damping *= 10) {
            double factor[CONSTANTS][CONSTANTS], move[CONSTANTS], trial[CONSTANTS];
            for (int a = 0; a < CONSTANTS; a++)
                for (int b = 0; b < CONSTANTS; b++)
                    factor[a][b] = normal[a][b] * (a == b ? 1 + damping : 1) + (a == b ? 1e-12 : 0);
            gsl_matrix_view f = gsl_matrix_view_array(&factor[0][0], CONSTANTS, CONSTANTS);
            gsl_vector_view g = gsl_vector_view_array(gradient, CONSTANTS),
                            d = gsl_vector_view_array(move, CONSTANTS);
            if (gsl_linalg_cholesky_decomp1(&f.matrix) != GSL_SUCCESS ||
                gsl_linalg_cholesky_solve(&f.matrix, &g.vector, &d.vector) != GSL_SUCCESS)
                continue;
            for (int a = 0; a < CONSTANTS; a++)
                trial[a] = p[a] + fmin(fmax(move[a], -3), 3);
            next = log_residual_squares(m, trial, squares);
            for (int a = 0; next < sum && a < CONSTANTS; a++)
                p[a] = trial[a];
        }
        if (!(next < sum))
            break;
        damping *= 1e-2;
        const bool done = sum - next < 1e-10 * sum;
        sum = next;
        if (done)
            break;
    }
    return sum;
}

/* Returns the small-sample Akaike criterion for equal variances, which count as one constant. */
static double akaike_criterion(double sum, double n, double constants)
{
    const double k = constants + 1;
    return n - k > 1 ? n * log(sum / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1) : (double)NAN;
}

static void series_squares(const wt_master *m, const wt_prony *series, double squares[2])
{
    squares[0] = squares[1] = 0;
    for (size_t i = 0; i < m->n; i++) {
        double storage, loss;
        prony_moduli(series, pow(10, m->log_frequency[i]), &storage, &loss);
        if (!is_usable_point(m, i))
            continue;
        squares[0] += pow(log(storage) - m->log_storage[i] * M_LN10, 2);
        squares[1] += pow(log(loss) - m->log_loss[i] * M_LN10, 2);
    }
}

wt_status wt_master_zener(const wt_master *m, const wt_prony *series, wt_zener_fit *fit,
                          wt_error *err)
{
    static const double exponents[] = {-1.0, 0.0, 1.0}; /* logit of alpha to start from */
    double points = 0, lowest = HUGE_VAL, highest = -HUGE_VAL, best = HUGE_VAL, squares[2];
    double constants[CONSTANTS] = {0};
    gsl_quiet();
    for (size_t i = 0; i < m->n; i++) {
        if (!is_usable_point(m, i))
            continue;
        points++;
        lowest = fmin(lowest, m->log_storage[i] * M_LN10);
        highest = fmax(highest, m->log_storage[i] * M_LN10);
    }
    if (points < CONSTANTS)
        return wt_fail(err, WT_E_EMPTY, "too few points for a fractional Zener law");
    for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++)
        for (int at = 1; at < 4; at++) {
            const double x = m->log_frequency[(size_t)at * m->n / 4] * M_LN10;
            double p[CONSTANTS] = {lowest, highest, -x, exponents[i]};
            const double sum = minimise_squares(m, p);
            if (!(sum < best))
                continue;
            best = sum;
            for (int k = 0; k < CONSTANTS; k++)
                constants[k] = p[k];
        }
    if (!(best < HUGE_VAL))
        return wt_fail(err, WT_E_CONVERGENCE, "no fractional Zener law goes through the points");
    (void)log_residual_squares(m, constants, squares);
    const double x = -constants[LN_TAU] / M_LN10, rise = exp(constants[LN_RISE]);
    const double e0 = exp(constants[LN_E0]);
    *fit = (wt_zener_fit){.e0 = constants[LN_E0] < lowest + log(negligible) ? 0 : e0,
                          .eg = e0 + rise,
                          .determined = e0 + rise < max_glass_ratio * exp(highest) &&
                                        x > m->log_frequency[0] - 1 &&
                                        x < m->log_frequency[m->n - 1] + 1,
                          .tau = exp(constants[LN_TAU]),
                          .alpha = 1 / (1 + exp(-constants[LOGIT_ALPHA])),
                          .rms_storage = sqrt(squares[0] / points),
                          .rms_loss = sqrt(squares[1] / points),
                          .aicc = akaike_criterion(best, 2 * points, CONSTANTS)};
    series_squares(m, series, squares);
    fit->series_rms_storage = sqrt(squares[0] / points);
    fit->series_rms_loss = sqrt(squares[1] / points);
    fit->series_aicc = akaike_criterion(squares[0] + squares[1], 2 * points,
                                        2 * (double)series->n + (series->equilibrium_modulus > 0));
    return WT_OK;
}
