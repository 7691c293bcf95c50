/* Noise of the moduli: size and correlation within the isotherms, smoothness of the spectrum,
 * curvature weights and outliers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/cholesky.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- noise within the isotherms -------------------------------------------------------------- */

/* Coefficients of the polynomial of an isotherm, depending on its number of points. The residual
 * of a second process needs more than a parabola, otherwise it looks like correlated noise. At
 * least two points per coefficient are required. */
enum { LEAST_COEFFICIENTS = 3, MOST_COEFFICIENTS = 5, MOST_WIDTH = MOST_COEFFICIENTS + 1 };

/* Minimum number of points beyond the coefficients. */
enum { LEAST_LEFT = 3 };

/* Grid of atanh of the correlation, up to a correlation of 0.97; the step is the standard error
 * for 30 points, 1/sqrt(n - 3) (R. A. Fisher 1921). The polynomial removes slow components, so
 * few points do not distinguish it from 0. A Cauchy prior applies. Its half width
 * is the standard error for 14 points, the size of an isotherm. */
enum { CORRELATIONS = 15 };
static const double correlation_first = -0.36, correlation_step = 0.18,
                    correlation_prior_width = 0.3;
/* Rise of the criterion, -2 ln, from which larger correlations have no weight: exp(-10) = 5e-5. */
static const double negligible_criterion = 20.0;

/* Shape of ln noise along all isotherms: a line and a parabola in the position from -1 to 1. The
 * prior width is a factor 2.2 from one end to the other. It is twice the standard error of a slope
 * with 30 values, so their weight is four times that of the prior. The rounds suffice because the
 * shapes are nearly independent. */
enum { SHAPES = SPECTRUM_SHAPES, NOISE_ROUNDS = 4 };
static const double shape_prior_width = 0.4;

struct within {
    double squares, freedom, log_det;
};

struct noise_work {
    double *v;            /* [n * MOST_WIDTH] */
    double *rest, *left;  /* [n] residual of the polynomial; remaining share of the point */
    double scale[MODULI]; /* variances of the moduli */
    double score[SHAPES]; /* score of the shape */
    double information[SHAPES * SHAPES];
};

/* Returns the position of a point on its isotherm, -1 to 1. */
static double isotherm_position(const spectrum *s, size_t curve, size_t k)
{
    const double from = s->x[s->first[curve]], to = s->x[s->first[curve + 1] - 1];
    return to > from ? (2.0 * s->x[k] - from - to) / (to - from) : 0.0;
}

/* Fits the polynomial of a curve in a modulus; fills rest and left if `points`. */
static struct within fit_isotherm_polynomial(const spectrum *s, size_t curve, int q, bool points,
                                             struct noise_work *w)
{
    const size_t from = s->first[curve], to = s->first[curve + 1];
    size_t n = LEAST_COEFFICIENTS;
    while (n < MOST_COEFFICIENTS && 2 * (n + 2) <= to - from)
        n++;
    const size_t width = n + 1;
    double cross[MOST_WIDTH * MOST_WIDTH] = {0}, *v = w->v;
    struct within sum = {0.0, -(double)n, 0.0};
    for (size_t k = from; k < to; k++) {
        const double at = isotherm_position(s, curve, k);
        double power = spectrum_weight(s, k, q);
        sum.freedom += power > 0.0;
        v[k * width + n] = s->residual[q][k];
        for (size_t i = 0; i < n; i++, power *= at)
            v[k * width + i] = power;
    }
    if (sum.freedom < (double)LEAST_LEFT)
        return (struct within){0.0, 0.0, 0.0};
    spectrum_whiten(s, curve, q, v + from * width, width);
    for (size_t k = from; k < to; k++)
        for (size_t i = 0; i < width; i++)
            for (size_t j = 0; j <= i; j++)
                cross[i * width + j] += v[k * width + i] * v[k * width + j];
    if (!cholesky_factor(cross, width, width, 0.0))
        return (struct within){0.0, 0.0, 0.0};
    /* multiplies each row by the inverse factor: orthogonal polynomials and the residual */
    const double last = cross[n * width + n];
    for (size_t k = from; points && k < to; k++) {
        cholesky_forward(cross, width, width, v + k * width, v + k * width);
        w->left[k] = s->weight[q][k] > 0.0 ? 1.0 : 0.0;
        for (size_t i = 0; i < n; i++)
            w->left[k] -= v[k * width + i] * v[k * width + i];
        w->rest[k] = last * v[k * width + n];
    }
    sum.squares = last * last;
    for (size_t i = 0; i < n; i++)
        sum.log_det += 2.0 * log(cross[i * width + i]);
    return sum;
}

/* Returns -2 ln restricted likelihood of the polynomials, and sets the variance of each modulus. */
static double restricted_likelihood(const spectrum *s, struct noise_work *w)
{
    double criterion = spectrum_log_det_correlation(s);
    for (int q = 0; q < MODULI; q++) {
        struct within sum = {0};
        for (size_t i = 0; i < s->n_curves; i++) {
            const struct within one = fit_isotherm_polynomial(s, i, q, false, w);
            sum.squares += one.squares;
            sum.freedom += one.freedom;
            sum.log_det += one.log_det;
        }
        w->scale[q] = sum.freedom > 0.0 ? sum.squares / sum.freedom : 0.0;
        criterion += sum.log_det + (sum.freedom > 0.0 ? sum.freedom * log(w->scale[q]) : 0.0);
    }
    return criterion;
}

/* Sets the correlation to its posterior mean. Returns the variance of its atanh. */
static double estimate_correlation(spectrum *s, struct noise_work *w)
{
    double criterion[CORRELATIONS], least = HUGE_VAL, sum[3] = {0.0, 0.0, 0.0};
    int n = 0;
    do { /* the criterion has one minimum */
        const double z = correlation_first + n * correlation_step;
        s->rho = tanh(z);
        criterion[n] = restricted_likelihood(s, w) +
                       2.0 * log1p(z * z / (correlation_prior_width * correlation_prior_width));
        least = fmin(least, criterion[n]);
    } while (criterion[n] < least + negligible_criterion && ++n < CORRELATIONS);
    for (int i = 0; i < n; i++) {
        const double weight = exp(-0.5 * (criterion[i] - least)),
                     z = correlation_first + i * correlation_step;
        sum[0] += weight;
        sum[1] += weight * z;
        sum[2] += weight * z * z;
    }
    const double mean = sum[1] / sum[0];
    s->rho = tanh(fmax(mean, 0.0)); /* a negative value is chance */
    return sum[2] / sum[0] - mean * mean;
}

/* Adds the score and information of a curve for the shape. The mean position is removed, because
 * it is the factor of the isotherm. */
static void add_noise_shape(const spectrum *s, size_t curve, int q, struct noise_work *w)
{
    double sum = 0.0, mean[SHAPES] = {0.0};
    for (size_t k = s->first[curve]; k < s->first[curve + 1]; k++) {
        const double u = isotherm_position(s, curve, k);
        sum += w->left[k];
        mean[0] += w->left[k] * u;
        mean[1] += w->left[k] * u * u;
    }
    for (size_t k = s->first[curve]; sum > 0.0 && k < s->first[curve + 1]; k++) {
        const double u = isotherm_position(s, curve, k);
        const double by[SHAPES] = {u - mean[0] / sum, u * u - mean[1] / sum};
        for (int i = 0; i < SHAPES; i++) {
            w->score[i] += by[i] * (w->rest[k] * w->rest[k] / w->scale[q] - w->left[k]);
            for (int j = 0; j < SHAPES; j++)
                w->information[i * SHAPES + j] += 2.0 * w->left[k] * by[i] * by[j];
        }
    }
}

/* Updates the noise factors and the shape from the polynomials. Returns the variance of ln noise
 * at the ends. */
static double update_noise_shape(spectrum *s, struct noise_work *w, double shape[SHAPES])
{
    const double belief = 1.0 / (shape_prior_width * shape_prior_width);
    const double end = 0.25; /* weight of the test columns, by the parabola */
    (void)restricted_likelihood(s, w);
    for (int i = 0; i < SHAPES; i++) {
        w->score[i] = -belief * shape[i];
        for (int j = 0; j < SHAPES; j++)
            w->information[i * SHAPES + j] = i == j ? belief : 0.0;
    }
    for (size_t i = 0; i < s->n_curves; i++) {
        double squares = SPECTRUM_KAPPA_PRIOR_POINTS, freedom = SPECTRUM_KAPPA_PRIOR_POINTS;
        for (int q = 0; q < MODULI; q++) {
            const struct within one = fit_isotherm_polynomial(s, i, q, true, w);
            if (!(one.freedom > 0.0 && w->scale[q] > 0.0))
                continue;
            squares += one.squares / w->scale[q] * s->kappa[i] * s->kappa[i];
            freedom += one.freedom;
            add_noise_shape(s, i, q, w);
        }
        s->kappa[i] = sqrt(squares / freedom);
    }
    gsl_matrix_view information = gsl_matrix_view_array(w->information, SHAPES, SHAPES);
    gsl_vector_view score = gsl_vector_view_array(w->score, SHAPES);
    gsl_linalg_cholesky_decomp1(&information.matrix);
    gsl_linalg_cholesky_svx(&information.matrix, &score.vector);
    gsl_linalg_cholesky_invert(&information.matrix);
    for (int i = 0; i < SHAPES; i++)
        shape[i] += fmax(-1.0, fmin(1.0, w->score[i]));
    return end * end * w->information[SHAPES * SHAPES - 1];
}

void spectrum_set_point_noise(spectrum *s, const double shape[SPECTRUM_SHAPES])
{
    double mean = 0.0;
    for (size_t i = 0; i < s->n_curves; i++)
        mean += log(s->kappa[i]) / (double)s->n_curves;
    for (size_t i = 0; i < s->n_curves; i++) {
        s->kappa[i] *= exp(-mean);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            const double u = isotherm_position(s, i, k);
            for (int q = 0; q < MODULI; q++)
                s->spread[q][k] =
                    s->kappa[i] *
                    (shape == NULL ? 1.0 : exp(shape[0] * u + shape[1] * (u * u - 1.0 / 3.0)));
        }
    }
}

static struct noise_work noise_work_new(const spectrum *s)
{
    struct noise_work w = {.v = wt_alloc(s->n * (MOST_WIDTH + 2 + MODULI), sizeof *w.v)};
    w.rest = w.v + s->n * MOST_WIDTH;
    w.left = w.rest + s->n;
    return w;
}

static double count_used_points(const spectrum *s, int q)
{
    double n = 0.0;
    for (size_t k = 0; k < s->n; k++)
        n += s->weight[q][k] > 0.0;
    return n;
}

void spectrum_measure_misfit(spectrum *s, double all[MODULI], double within[MODULI])
{
    const double rho = s->rho;
    struct noise_work w = noise_work_new(s);
    double *const weights = w.left + s->n; /* E', then E'' */
    s->rho = 0.0;
    for (int q = 0; q < MODULI; q++)
        memcpy(weights + (size_t)q * s->n, s->weight[q], s->n * sizeof *weights);
    (void)spectrum_outliers(s);
    spectrum_evaluate(s, s->value, false);
    (void)restricted_likelihood(s, &w);
    for (int q = 0; q < MODULI; q++) {
        const double n = count_used_points(s, q);
        all[q] = n > 0.0 ? sqrt(spectrum_squares(s, q) / n) : 0.0;
        within[q] = sqrt(w.scale[q]);
    }
    for (int q = 0; q < MODULI; q++)
        memcpy(s->weight[q], weights + (size_t)q * s->n, s->n * sizeof *weights);
    s->rho = rho;
    free(w.v);
}

spectrum_isotherm_noise spectrum_estimate_noise(spectrum *s)
{
    struct noise_work w = noise_work_new(s);
    spectrum_isotherm_noise within = {0};
    for (size_t i = 0; i < s->n_curves; i++)
        s->kappa[i] = 1.0;
    for (int round = 0; round < NOISE_ROUNDS; round++) {
        spectrum_set_point_noise(s, within.shape);
        s->rho = 0.0;
        spectrum_evaluate(s, s->value, false);
        const double of_correlation = estimate_correlation(s, &w);
        within.rho = s->rho;
        within.uncertainty = 4.0 * (of_correlation + update_noise_shape(s, &w, within.shape));
    }
    s->rho = 0.0;
    free(w.v);
    return within;
}

/* ---- noise of the fit ------------------------------------------------------------------------ */

/* Minimum relative noise. No instrument is more accurate, exports have four or five digits, and
 * rounding must not decide for exact data. */
static const double least_noise = 1e-4;
/* Minimum scale of the second differences. Over ten decades with three terms each, such
 * differences of equal sign change the line by 0.45. */
static const double least_smooth = 1e-3;
/* The local curvature is averaged over this many decades to either side, about the width of one
 * relaxation time in E'' (1.14 decades at half height). The prior of equal curvature has the
 * weight of 5 second differences; the window has 7 at 3 terms per decade. The window then has most
 * of the weight, and the relative standard deviation of the mean square is sqrt(2/12) = 0.4. */
static const double curvature_window = 1.0, curvature_prior_count = 5.0;
/* Degrees of freedom of the Student distribution during the search for outliers, as in Lange,
 * Little and Taylor (J. Am. Stat. Assoc. 84 (1989) 881). */
static const double student_freedom = 4.0;
/* A point is excluded beyond the first number of standard deviations and restored below the
 * second. For normal noise, one of a thousand points is lost in one of a hundred sweeps. */
static const double outlier = 5.0, no_outlier = 4.5;

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

double spectrum_noise_update(spectrum *s, double share, double enough)
{
    double change = 0.0, next[MODULI];
    for (int q = 0; q < MODULI; q++) {
        const double square = s->noise[q] * s->noise[q];
        s->freedom[q] = product_trace(&s->covariance, &s->normal[q]) / square;
        const double left = fmax(count_used_points(s, q) - s->freedom[q], 1.0);
        next[q] = fmax(sqrt(spectrum_squares(s, q) / left), least_noise);
        change = fmax(change, fabs(log(next[q] / s->noise[q])));
    }
    const double rank = (double)(s->bend_end - s->bend_first);
    const double used = rank - spectrum_roughness_trace(s) / (s->smoothness * s->smoothness);
    const double rough = spectrum_roughness(s, s->value);
    const double move = log(fmax(sqrt(rough / fmax(used, 1e-3)), least_smooth) / s->smoothness);
    change = fmax(change, 0.1 * fabs(move));
    if (change < enough)
        return change; /* the unknowns can settle */
    for (int q = 0; q < MODULI; q++)
        s->noise[q] = share < 1.0 ? s->noise[q] * pow(next[q] / s->noise[q], share) : next[q];
    s->smoothness = fmax(s->smoothness * exp(share * move), least_smooth);
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
    const double unit = s->smoothness * s->smoothness;
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
    const size_t width = s->n_shared + 2;
    for (size_t i = 0; i < s->n_curves; i++)
        for (int q = 0; q < MODULI; q++)
            for (size_t k = s->first[i]; spectrum_is_fitted(s, i, q) && k < s->first[i + 1]; k++) {
                const double r = s->residual[q][k] / s->noise[q];
                const double square = r * r / s->weight[q][k];
                const double weight = (student_freedom + 1.0) / (student_freedom + square);
                const double by = sqrt(weight / s->weight[q][k]);
                s->weight[q][k] = weight;
                s->residual[q][k] *= by;
                for (size_t j = 0; j < width; j++)
                    s->row[q][k * width + j] *= by;
            }
}

/* Returns the standard deviation from the median of n absolute residuals, which it sorts. */
static double robust_deviation(double *residual, size_t n)
{
    for (size_t k = 0; k < n; k++)
        residual[k] = fabs(residual[k]);
    return n > 0 ? 1.4826 * numbers_median(residual, n) : 0.0;
}

size_t spectrum_outliers(spectrum *s)
{
    size_t changed = 0;
    const double rho = s->rho;
    double *copy = s->copy;
    s->rho = 0.0;
    for (int q = 0; q < MODULI; q++)
        for (size_t i = 0; i < s->n_curves; i++)
            for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
                s->previous_weight[q][k] = s->weight[q][k];
                s->weight[q][k] = spectrum_is_fitted(s, i, q) ? 1.0 : 0.0;
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
            const size_t from = s->first[i],
                         n = spectrum_is_fitted(s, i, q) ? s->first[i + 1] - from : 0;
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
