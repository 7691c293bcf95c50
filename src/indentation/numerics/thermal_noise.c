/* Spring constant by Sader's method, and thermal noise of a cantilever: maximum likelihood fit of a
 * simple harmonic oscillator with a white floor.
 *
 * An averaged periodogram is its mean times a gamma variable. The likelihood is therefore
 * Whittle's, the sum of ln S + p/S, for any number of averages. The scatter about the fit
 * determines that number, and the correlation of neighbouring bins the effect of the window.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/cholesky.h"
#include "weartrack/indentation.h"

#include <complex.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846; /* double precision */
/* Factor of eq. 1 of the paper for the first mode of a rectangular cantilever. */
static const double first_mode = 0.1906;

/* Spring constant of a cantilever from resonance and quality factor in a fluid, without a
 * deflection.
 *
 * Rectangular cantilevers: Sader, Chon and Mulvaney, Rev. Sci. Instrum. 70 (1999) 3967, with the
 * hydrodynamic function of Sader, J. Appl. Phys. 84 (1998) 64, eqs. 20 and 21. */

/* ---- the hydrodynamic function --------------------------------------------------------------- */

/* Computes exp(z) K_n(z), n = 0 and 1, for abs(arg z) < pi/2 as the integral of exp(-z (cosh t -
 * 1)) cosh(n t). The error of the trapezoidal rule falls exponentially with 1/step. The tail ends
 * where the exponent is below that of the smallest double. */
static void bessel_k(double complex z, double complex k[2])
{
    const double step = 1.0 / 64, smallest = -745; /* ln of the smallest double */
    k[0] = k[1] = 0.5 * step;
    for (double t = step;; t += step) {
        const double complex e = -z * (cosh(t) - 1);
        if (creal(e) + t < smallest)
            return;
        k[0] += step * cexp(e);
        k[1] += step * cexp(e) * cosh(t);
    }
}

static double evaluate_polynomial(const double *c, int n, double x)
{
    double sum = 0;
    while (n-- > 0)
        sum = sum * x + c[n];
    return sum;
}

/* Hydrodynamic function of a circular cylinder times a correction for a flat blade. The correction
 * is the fit of the paper, accurate to 0.1 % from Re = 1e-6 to 1e4. */
void wt_hydrodynamic_function(double reynolds, double *real, double *imaginary)
{
    /* Eqs. 21a and 21b of the paper. */
    static const double real_over[] = {0.91324,  -0.48274,   0.46842,   -0.12886,
                                       0.044055, -0.0035117, 0.00069085},
                        real_under[] = {1,        -0.56964,   0.48690,   -0.13444,
                                        0.045155, -0.0035862, 0.00069085},
                        imaginary_over[] = {-0.024134,   -0.029256,   0.016294,
                                            -0.00010961, 0.000064577, -0.000044510},
                        imaginary_under[] = {1,        -0.59702,  0.55182,  -0.18357,
                                             0.079156, -0.014369, 0.0028361};
    const double complex i = (double complex)I, root = csqrt(i * reynolds);
    const double x = log10(reynolds);
    double complex k[2];
    bessel_k(-i * root, k);
    const double complex circle = 1 + 4 * i * k[1] / (root * k[0]),
                         blade = evaluate_polynomial(real_over, 7, x) /
                                     evaluate_polynomial(real_under, 7, x) +
                                 i * evaluate_polynomial(imaginary_over, 6, x) /
                                     evaluate_polynomial(imaginary_under, 7, x);
    *real = creal(circle * blade);
    *imaginary = cimag(circle * blade);
}

/* ---- the fluid ------------------------------------------------------------------------------- */

wt_fluid wt_medium_properties(wt_medium medium, double temperature)
{
    const double t = temperature - WT_ZERO_CELSIUS, unknown = (double)NAN;
    if (medium == WT_MEDIUM_AIR) /* dry air at 1013.25 hPa; viscosity by Sutherland's law */
        return (wt_fluid){101325 * 28.9647e-3 / (8.314462618 * temperature),
                          1.716e-5 * pow(temperature / 273.15, 1.5) * (273.15 + 110.4) /
                              (temperature + 110.4)};
    if (!(t >= 0 && t <= 100))
        return (wt_fluid){unknown, unknown};
    /* Density: Tanaka et al., Metrologia 38 (2001) 301. Viscosity: IAPWS, liquid water at 0.1 MPa.
     */
    const double x = temperature / 300, off = t - 3.983035;
    return (wt_fluid){999.97495 * (1 - off * off * (t + 301.797) / (522528.9 * (t + 69.34881))),
                      1e-6 * (280.68 * pow(x, -1.9) + 511.45 * pow(x, -7.7) +
                              61.131 * pow(x, -19.6) + 0.45903 * pow(x, -40))};
}

/* ---- the spring constant --------------------------------------------------------------------- */

static double sader_stiffness(double length, double width, double resonance, double quality,
                              wt_fluid fluid)
{
    const double omega = 2 * pi * resonance;
    double real, imaginary;
    wt_hydrodynamic_function(fluid.density * omega * width * width / (4 * fluid.viscosity), &real,
                             &imaginary);
    return first_mode * fluid.density * width * width * length * quality * imaginary * omega *
           omega;
}

wt_estimate wt_sader_spring_constant(wt_estimate length, wt_estimate width, wt_estimate resonance,
                                     wt_estimate quality, wt_fluid fluid)
{
    const double step =
        1e-4; /* of a difference quotient, whose error is of the order of its square */
    const double l = length.value, b = width.value, f = resonance.value, q = quality.value;
    const double k = sader_stiffness(l, b, f, q, fluid);
    const double compare_widths = log(sader_stiffness(l, b * (1 + step), f, q, fluid) /
                                      sader_stiffness(l, b * (1 - step), f, q, fluid)) /
                                  (2 * step),
                 by_resonance = log(sader_stiffness(l, b, f * (1 + step), q, fluid) /
                                    sader_stiffness(l, b, f * (1 - step), q, fluid)) /
                                (2 * step);
    const double error = hypot(hypot(length.standard_error / l, quality.standard_error / q),
                               hypot(compare_widths * width.standard_error / b,
                                     by_resonance * resonance.standard_error / f));
    return (wt_estimate){k, k * error, 0, "N/m"};
}

/* ---- oscillator ------------------------------------------------------------------------------ */

/* Logarithmic parameters: floor, mean square of the deflection, resonance, quality. */
enum { FLOOR, MEAN_SQUARE, RESONANCE, QUALITY, P };
/* Limit of the iterations. Correlated neighbouring bins, two for a Hann window. Smallest number of
 * points, six per parameter. Blocks for a slow departure, five per parameter. Bins of the mean in
 * the search for the peak. */
enum { STEPS = 200, LAGS = 3, MIN_POINTS = 24, BLOCKS = 20, PEAK_SMOOTH = 3 };
/* Start values of the quality, from an overdamped cantilever in water to one in vacuum. Range of
 * the fit in peak widths to either side, where the oscillator has 1/6400 of its top and the floor
 * is visible. Limits of the range over the resonance, between low-frequency noise and the second
 * mode at 6.27 (Butt and Jaschke 1995). */
static const double least_quality = 0.7, most_quality = 1e6, quality_step = 1.5;
static const double range_widths = 40, range_low = 0.25, range_high = 3;
/* Probability for 95 % intervals. Clipping of residuals in standard deviations, which one normal
 * value in 370 exceeds. Standard deviation of a normal distribution over its median absolute
 * deviation. */
static const double interval_level = 0.975, clip_deviations = 3, mad_to_deviation = 1.4826;

typedef struct periodogram {
    const double *f, *p; /* [n] within the range */
    size_t n;
} periodogram;

/* Returns the spectrum at a frequency; g receives its logarithmic derivatives by the parameters. */
static double oscillator_spectrum(const double theta[P], double f, double g[P])
{
    const double white = exp(theta[FLOOR]), f0 = exp(theta[RESONANCE]), q = exp(theta[QUALITY]);
    const double x = f / f0, x2 = x * x, d = (1 - x2) * (1 - x2) + x2 / (q * q);
    const double peak = 2 * exp(theta[MEAN_SQUARE]) / (pi * f0 * q) / d, s = white + peak;
    if (g != NULL) {
        /* ln peak = ln square - ln f0 - ln q - ln d; x is proportional to 1/f0. */
        const double d_x = -4 * x2 * (1 - x2) + 2 * x2 / (q * q); /* d d / d ln x */
        const double d_q = -2 * x2 / (q * q);
        g[FLOOR] = white / s;
        g[MEAN_SQUARE] = peak / s;
        g[RESONANCE] = peak / s * (-1 + d_x / d);
        g[QUALITY] = peak / s * (-1 - d_q / d);
    }
    return s;
}

/* Half of the deviance for one average. */
static double half_deviance(const periodogram *v, const double theta[P])
{
    double sum = 0;
    for (size_t i = 0; i < v->n; i++) {
        const double ratio = v->p[i] / oscillator_spectrum(theta, v->f[i], NULL);
        sum += ratio - 1 - log(ratio);
    }
    return sum;
}

/* Solves a x = b for a positive definite a. Returns false if a is not. */
static bool solve_scoring(double a[P][P], const double b[P], double x[P])
{
    double l[P][P];
    memcpy(l, a, sizeof l);
    memcpy(x, b, P * sizeof *b);
    return cholesky_solve(&l[0][0], P, P, 0, x);
}

static void fisher_information(const periodogram *v, const double theta[P], double fisher[P][P],
                               double score[P])
{
    for (int a = 0; a < P; a++) {
        score[a] = 0;
        for (int b = 0; b < P; b++)
            fisher[a][b] = 0;
    }
    for (size_t i = 0; i < v->n; i++) {
        double g[P];
        const double r = v->p[i] / oscillator_spectrum(theta, v->f[i], g) - 1;
        for (int a = 0; a < P; a++) {
            score[a] += r * g[a];
            for (int b = 0; b < P; b++)
                fisher[a][b] += g[a] * g[b];
        }
    }
}

/* Damped Fisher scoring. Returns true at convergence. */
static bool maximise_likelihood(const periodogram *v, double theta[P])
{
    double best = half_deviance(v, theta), damping = 1e-3;
    for (int step = 0; step < STEPS; step++) {
        double fisher[P][P], score[P], move[P], next[P], largest = 0;
        fisher_information(v, theta, fisher, score);
        for (int a = 0; a < P; a++)
            fisher[a][a] *= 1 + damping;
        if (!solve_scoring(fisher, score, move))
            return false;
        for (int a = 0; a < P; a++) {
            next[a] = theta[a] + move[a];
            largest = fmax(largest, fabs(move[a]));
        }
        const double now = half_deviance(v, next);
        if (!(now <= best)) {
            if (largest < 1e-9)
                return true;
            damping *= 10;
            continue;
        }
        best = now;
        damping /= 10;
        for (int a = 0; a < P; a++)
            theta[a] = next[a];
        if (largest < 1e-9)
            return true;
    }
    return false;
}

/* ---- errors ---------------------------------------------------------------------------------- */

/* Computes the variance of the residuals and their correlation with the next ones. */
static double residual_scatter(const double *r, size_t n, double correlation[LAGS + 1])
{
    double squares = 0;
    for (size_t i = 0; i < n; i++)
        squares += r[i] * r[i];
    for (size_t lag = 0; lag <= LAGS; lag++) {
        double sum = 0;
        for (size_t i = 0; i + lag < n; i++)
            sum += r[i] * r[i + lag];
        /* an insignificant correlation counts as 0 */
        correlation[lag] = lag == 0 || sum / squares > 2 / sqrt((double)n) ? sum / squares : 0;
    }
    return squares / (double)(n - P);
}

/* Computes the covariance of the parameters with the correlation of neighbours. Returns false if
 * the matrix is singular. */
static bool parameter_covariance(const periodogram *v, const double theta[P],
                                 const double *gradient, double variance,
                                 const double correlation[LAGS + 1], double cov[P][P])
{
    double fisher[P][P], score[P], score_covariance[P][P] = {{0}}, inverse[P][P];
    fisher_information(v, theta, fisher, score);
    for (size_t lag = 0; lag <= LAGS; lag++)
        for (size_t i = 0; i + lag < v->n; i++)
            for (int a = 0; a < P; a++)
                for (int b = 0; b < P; b++) {
                    const double *x = gradient + i * P, *y = gradient + (i + lag) * P;
                    score_covariance[a][b] += variance * correlation[lag] *
                                              (lag == 0 ? x[a] * x[b] : x[a] * y[b] + y[a] * x[b]);
                }
    for (int a = 0; a < P; a++) {
        double unit[P] = {0};
        unit[a] = 1;
        if (!solve_scoring(fisher, unit, inverse[a]))
            return false;
    }
    for (int a = 0; a < P; a++)
        for (int b = 0; b < P; b++) {
            cov[a][b] = 0;
            for (int k = 0; k < P; k++)
                for (int l = 0; l < P; l++)
                    cov[a][b] += inverse[a][k] * score_covariance[k][l] * inverse[b][l];
        }
    return true;
}

static wt_interval log_normal_interval(double log_value, double variance)
{
    const double value = exp(log_value), error = sqrt(variance);
    const double half = gsl_cdf_ugaussian_Pinv(interval_level) * error;
    return (wt_interval){value, value * error, value * exp(-half), value * exp(half)};
}

/* p value of slow departures: block sums of the residuals against their scatter. A departure
 * increases the scatter, so clipped residuals determine it. */
static double slow_departure_chance(const double *r, size_t n, double *scratch)
{
    double shared = 1, squares = 0, correlation[LAGS + 1];
    for (size_t i = 0; i < n; i++)
        scratch[i] = fabs(r[i]);
    numbers_sort(scratch, n);
    const double most = clip_deviations * mad_to_deviation * scratch[n / 2];
    for (size_t i = 0; i < n; i++)
        scratch[i] = fmax(-most, fmin(most, r[i]));
    const double variance = residual_scatter(scratch, n, correlation);
    for (size_t lag = 1; lag <= LAGS; lag++)
        shared += 2 * correlation[lag];
    for (size_t b = 0; b < BLOCKS; b++) {
        const size_t first = n * b / BLOCKS, end = n * (b + 1) / BLOCKS;
        double sum = 0;
        for (size_t i = first; i < end; i++)
            sum += r[i];
        squares += sum * sum / (double)(end - first) / (variance * shared);
    }
    return gsl_cdf_chisq_Q(squares, BLOCKS - P);
}

static bool set_fit_errors(const periodogram *v, const double theta[P], wt_thermal *t,
                           double *scratch)
{
    double *const r = scratch, *const gradient = scratch + v->n;
    double correlation[LAGS + 1], cov[P][P];
    for (size_t i = 0; i < v->n; i++)
        r[i] = v->p[i] / oscillator_spectrum(theta, v->f[i], gradient + i * P) - 1;
    const double variance = residual_scatter(r, v->n, correlation);
    if (!parameter_covariance(v, theta, gradient, variance, correlation, cov))
        return false;
    t->mean_square = log_normal_interval(theta[MEAN_SQUARE], cov[MEAN_SQUARE][MEAN_SQUARE]);
    t->resonance = log_normal_interval(theta[RESONANCE], cov[RESONANCE][RESONANCE]);
    t->quality = log_normal_interval(theta[QUALITY], cov[QUALITY][QUALITY]);
    t->floor = exp(theta[FLOOR]);
    t->averages = 1 / variance;
    t->misfit_p = slow_departure_chance(r, v->n, gradient);
    return isfinite(t->mean_square.standard_error) && isfinite(t->quality.standard_error);
}

/* ---- position of the peak -------------------------------------------------------------------- */

/* Returns the maximum of p f, averaged over a few bins. Low-frequency noise hardly affects it. */
static size_t find_resonance_peak(const double *f, const double *p, size_t n)
{
    size_t peak = PEAK_SMOOTH / 2;
    double most = 0;
    for (size_t i = PEAK_SMOOTH / 2; i + PEAK_SMOOTH / 2 < n; i++) {
        double sum = 0;
        for (size_t k = 0; k < PEAK_SMOOTH; k++)
            sum += p[i + k - PEAK_SMOOTH / 2];
        if (f[i] * sum > most) {
            most = f[i] * sum;
            peak = i;
        }
    }
    return peak;
}

/* Returns the 10 % quantile. */
static double floor_level(const double *p, size_t n, double *scratch)
{
    for (size_t i = 0; i < n; i++)
        scratch[i] = p[i];
    numbers_sort(scratch, n);
    return scratch[n / 10];
}

/* Selects the start value of the quality with the best likelihood near the peak. */
static void start_parameters(const periodogram *v, double f0, double ground, double theta[P])
{
    double best = (double)INFINITY, area = 0;
    for (size_t i = 1; i < v->n; i++)
        area += fmax(0, v->p[i] - ground) * (v->f[i] - v->f[i - 1]);
    for (double q = least_quality; q < most_quality; q *= quality_step) {
        const double guess[P] = {log(ground), log(area), log(f0), log(q)};
        const double now = half_deviance(v, guess);
        if (now < best) {
            best = now;
            for (int a = 0; a < P; a++)
                theta[a] = guess[a];
        }
    }
}

static periodogram select_frequency_range(const double *f, const double *p, size_t n, double from,
                                          double to)
{
    size_t first = 0, end = n;
    while (first < n && !(f[first] >= from))
        first++;
    while (end > first && !(f[end - 1] <= to))
        end--;
    return (periodogram){f + first, p + first, end - first};
}

static bool reject_oscillator(wt_thermal *t, const char *why)
{
    t->reason = why;
    return false;
}

static bool fit_oscillator(const double *f, const double *p, size_t n, double from, double to,
                           wt_thermal *t, double *scratch)
{
    if (n < MIN_POINTS)
        return reject_oscillator(t, "too few points");
    const double f0 = f[find_resonance_peak(f, p, n)], ground = floor_level(p, n, scratch);
    double theta[P] = {0};
    const periodogram peak_range = select_frequency_range(f, p, n, range_low * f0, range_high * f0);
    start_parameters(&peak_range, f0, ground, theta);
    const double width = f0 / exp(theta[QUALITY]);
    t->from = !isnan(from) ? from : fmax(range_low * f0, f0 - range_widths * width);
    t->to = !isnan(to) ? to : fmin(range_high * f0, f0 + range_widths * width);
    const periodogram v = select_frequency_range(f, p, n, t->from, t->to);
    t->n = v.n;
    if (v.n < MIN_POINTS)
        return reject_oscillator(t, "too few points in the range of the fit");
    if (f0 < v.f[0] || f0 > v.f[v.n - 1])
        return reject_oscillator(t, "the largest peak lies outside of the range of the fit");
    if (!maximise_likelihood(&v, theta))
        return reject_oscillator(t, "no oscillator on a white floor fits");
    if (exp(theta[RESONANCE]) < v.f[0] || exp(theta[RESONANCE]) > v.f[v.n - 1])
        return reject_oscillator(t, "the resonance lies outside of the range of the fit");
    return set_fit_errors(&v, theta, t, scratch) ||
           reject_oscillator(t, "the spectrum does not bound the oscillator");
}

wt_status wt_thermal_fit(const double *frequency, const double *density, size_t n, double from,
                         double to, wt_thermal *thermal, wt_error *err)
{
    const double nan_ = (double)NAN;
    const wt_interval unknown = {nan_, nan_, nan_, nan_};
    if (frequency == NULL || density == NULL || thermal == NULL)
        return wt_fail(err, WT_E_ARG, "no spectrum");
    *thermal = (wt_thermal){.mean_square = unknown,
                            .resonance = unknown,
                            .quality = unknown,
                            .floor = nan_,
                            .from = nan_,
                            .to = nan_,
                            .averages = nan_,
                            .misfit_p = nan_,
                            .reason = ""};
    double *scratch = wt_alloc(n + 1, (P + 3) * sizeof *scratch);
    double *const f = scratch, *const p = scratch + n + 1;
    size_t m = 0;
    for (size_t i = 0; i < n; i++)
        if (frequency[i] > 0 && density[i] > 0 && isfinite(density[i])) {
            f[m] = frequency[i];
            p[m++] = density[i];
        }
    thermal->found = fit_oscillator(f, p, m, from, to, thermal, scratch + 2 * (n + 1));
    free(scratch);
    return WT_OK;
}
