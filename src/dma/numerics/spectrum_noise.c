/* Noise of the moduli: size, smoothness of the spectrum, curvature weights and outliers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

/* Minimum relative noise. No instrument is more accurate, exports have four or five digits, and
 * rounding must not decide for exact data. */
static const double least_noise = 1e-4;
/* Minimum scale of the second differences. Over ten decades with three terms each, such
 * differences of equal sign change the line by 0.45. */
static const double least_smooth = 1e-3;
/* The local curvature is averaged over this many decades to either side, about the width of one
 * relaxation time in E'' (1.14 decades at half height). The prior of equal curvature has the
 * weight of 5 second differences; the window has 7 at 3 terms per decade. Chosen: the share of
 * the window is 7 of 12. It would be 7 of 9 with 2, which noise disturbs, and 7 of 27 with 20,
 * which equalises all. */
static const double curvature_window = 1.0, curvature_prior_count = 5.0;
/* Degrees of freedom of the Student distribution during the search for outliers, as in Lange,
 * Little and Taylor (J. Am. Stat. Assoc. 84 (1989) 881). */
static const double student_freedom = 4.0;
/* A point is excluded beyond the first number of standard deviations and restored below the
 * second. For normal noise, one of a thousand points is lost in one of a hundred sweeps. */
static const double outlier = 5.0, no_outlier = 4.5;

static double count_used_points(const spectrum *s, int q)
{
    double n = 0.0;
    for (size_t k = 0; k < s->n; k++)
        n += s->weight[q][k] > 0.0;
    return n;
}

/* Returns the trace of covariance times normal equations, which do not contain the smooth part. */
static double product_trace(const bordered_matrix *covariance, const bordered_matrix *normal)
{
    double sum = 0.0, sides = 0.0;
    for (size_t i = 0; i < normal->m; i++)
        for (size_t k = 0; k < normal->m; k++)
            sum += gsl_matrix_get(covariance->border, i, k) * gsl_matrix_get(normal->border, i, k);
    for (size_t i = 0; i < BLOCK_SIDE * normal->n; i++)
        for (size_t k = 0; k < normal->m; k++)
            sides += gsl_matrix_get(covariance->side, i, k) * gsl_matrix_get(normal->side, i, k);
    for (size_t i = 0; i < normal->n; i++) {
        const double *v = covariance->diagonal + BLOCK_DIAGONAL * i,
                     *n = normal->diagonal + BLOCK_DIAGONAL * i;
        sum += v[0] * n[0] + 2.0 * v[1] * n[1] + v[2] * n[2];
    }
    return sum + 2.0 * sides;
}

double spectrum_noise_update(spectrum *s, double share)
{
    double change = 0.0;
    for (int q = 0; q < MODULI; q++) {
        const double square = s->noise[q] * s->noise[q];
        s->freedom[q] = product_trace(&s->covariance, &s->normal[q]) / square;
        const double left = fmax(count_used_points(s, q) - s->freedom[q], 1.0);
        const double next = fmax(sqrt(spectrum_squares(s, q) / left), least_noise);
        const double move = log(next / s->noise[q]);
        change = fmax(change, fabs(move));
        s->noise[q] = share < 1.0 ? s->noise[q] * exp(share * move) : next;
    }
    const double rank = (double)(s->bend_end - s->bend_first);
    const double used = rank - spectrum_roughness_trace(s) / (s->smooth * s->smooth);
    const double rough = spectrum_roughness(s, s->value);
    const double next = fmax(sqrt(rough / fmax(used, 1e-3)), least_smooth);
    double move = log(next / s->smooth);
    change = fmax(change, 0.1 * fabs(move));
    /* the steps shrink geometrically: the ratio of two predicts the remaining distance */
    const double ratio = s->smooth_move != 0.0 ? move / s->smooth_move : 0.0;
    s->smooth_move = move;
    if (share < 1.0) {
        move *= share;
    } else if (ratio > 0.2) {
        move *= fmin(1.0 / (1.0 - fmin(ratio, 0.9)), 1.0 / fmax(fabs(move), 0.1));
        s->smooth_move = 0.0; /* the next step starts a new pair */
    }
    s->smooth = fmax(s->smooth * exp(move), least_smooth);
    return change;
}

void spectrum_criterion(spectrum *s)
{
    s->criterion = spectrum_objective(s, s->value) + s->log_det + spectrum_prior_log_det(s) +
                   spectrum_log_det_correlation(s);
    for (int q = 0; q < MODULI; q++)
        for (size_t k = 0; k < s->n; k++)
            if (s->weight[q][k] > 0.0)
                s->criterion += 2.0 * log(s->noise[q] * s->spread[q][k]);
}

/* ---- curvature weights ----------------------------------------------------------------------- */

/* Returns the information about a second difference; *square: its square in units of smooth^2. */
static double curvature_information(const spectrum *s, size_t j, double *square)
{
    static const double weight[3] = {1.0, -2.0, 1.0}; /* second difference */
    const double unit = s->smooth * s->smooth;
    const double bend = s->value[j] - 2.0 * s->value[j + 1] + s->value[j + 2];
    double variance = 0.0;
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 3; k++)
            variance += weight[i] * weight[k] * gsl_matrix_get(s->covariance.border, j + i, j + k);
    *square = bend * bend / unit;
    return fmax(1.0 - s->bend[j] * variance / unit, 0.0);
}

void spectrum_update_curvature(spectrum *s)
{
    const size_t reach = (size_t)ceil(curvature_window * M_LN10 / s->step);
    const size_t first = s->n_fast + reach;
    const size_t last = s->n_measured > first + reach ? s->n_measured - reach : first;
    double *next = s->term; /* scratch */
    for (size_t j = s->bend_first; j < s->bend_end; j++) {
        const size_t at = j < first ? first : j > last ? last : j;
        double sum = curvature_prior_count, known = curvature_prior_count;
        for (size_t i = at - reach; i <= at + reach && i < s->bend_end; i++) {
            double square;
            known += curvature_information(s, i, &square);
            sum += square;
        }
        next[j] = j > last ? fmin(known / sum, 1.0) : known / sum;
    }
    for (size_t j = s->bend_first; j < s->bend_end; j++)
        s->bend[j] = next[j];
}

/* ---- outliers -------------------------------------------------------------------------------- */

void spectrum_student_weights(spectrum *s)
{
    for (size_t i = 0; i < s->n_curves; i++)
        for (int q = 0; q < MODULI; q++)
            for (size_t k = s->first[i]; s->used[q] && k < s->first[i + 1]; k++) {
                const double r = s->residual[q][k] / s->noise[q];
                const double square = r * r / s->weight[q][k];
                s->weight[q][k] = (student_freedom + 1.0) / (student_freedom + square);
            }
}

/* Returns the standard deviation from the median of n absolute residuals, which it sorts. */
static double robust_deviation(double *residual, size_t n)
{
    for (size_t k = 0; k < n; k++)
        residual[k] = fabs(residual[k]);
    gsl_sort(residual, 1, n);
    return 1.4826 * gsl_stats_median_from_sorted_data(residual, 1, n);
}

size_t spectrum_outliers(spectrum *s)
{
    size_t changed = 0;
    const double rho = s->rho;
    double *copy = s->copy;
    s->rho = 0.0;
    for (int q = 0; q < MODULI; q++)
        for (size_t k = 0; k < s->n; k++) {
            s->previous_weight[q][k] = s->weight[q][k];
            s->weight[q][k] = s->used[q] ? 1.0 : 0.0;
        }
    spectrum_evaluate(s, s->value, false);
    s->rho = rho;
    for (int q = 0; q < MODULI; q++) {
        if (!s->used[q])
            continue;
        for (size_t k = 0; k < s->n; k++)
            copy[k] = s->residual[q][k];
        const double all = robust_deviation(copy, s->n);
        for (size_t i = 0; i < s->n_curves; i++) {
            const size_t from = s->first[i], n = s->first[i + 1] - from;
            for (size_t k = 0; k < n; k++)
                copy[k] = s->residual[q][from + k];
            const double spread = fmax(fmax(robust_deviation(copy, n), all), least_noise);
            for (size_t k = from; k < from + n; k++) {
                const double off = fabs(s->residual[q][k]) / spread;
                const bool out = off > (s->previous_weight[q][k] == 0.0 ? no_outlier : outlier);
                s->weight[q][k] = out ? 0.0 : 1.0;
                changed += out != (s->previous_weight[q][k] == 0.0);
            }
        }
    }
    return changed;
}
