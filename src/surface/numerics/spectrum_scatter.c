/* Scatter of a power spectrum: of its modes, from place to place, and over the directions in the
 * plane of the surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/math/special.h"
#include "core/math/students_t.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>
#include <stdlib.h>

/* ---- directions ------------------------------------------------------------------------------ */

/* Standard error of an unknown direction: uniform over a turn divided by the order. */
static double uniform_direction_error(double order)
{
    return 2 * M_PI / order / sqrt(12);
}

/* Sums over the reliable bins, weighted by the number of modes. */
typedef struct direction_sums {
    double n, variance, cosine, sine, cosine_fourth, sine_fourth, square;
} direction_sums;

static direction_sums sum_directions(const wt_surface_spectrum *spectrum)
{
    direction_sums s = {0};
    for (size_t k = 0; k < spectrum->n; k++) {
        const wt_spectrum_bin *b = &spectrum->bins[k];
        if (!b->reliable)
            continue;
        const double n = (double)b->n, scatter = b->deviation / b->density;
        s.n += n;
        /* Each component has the variance 4 / freedom for isotropic, exponential modes. If the
         * modes scatter more, their scatter replaces it. */
        s.variance += 4 * n * n * scatter * scatter / b->freedom;
        s.square += n * scatter * scatter;
        s.cosine += n * b->cosine;
        s.sine += n * b->sine;
        s.cosine_fourth += n * b->cosine_fourth;
        s.sine_fourth += n * b->sine_fourth;
    }
    return s;
}

wt_surface_anisotropy wt_surface_anisotropy_fit(const wt_surface_spectrum *spectrum, unsigned order)
{
    const double nan = (double)NAN, turns = (double)order;
    const direction_sums s = sum_directions(spectrum);
    if (spectrum->kind != WT_SPECTRUM_2D || !(s.n > 0) || isnan(s.cosine))
        return (wt_surface_anisotropy){nan, nan, nan, nan, nan};
    const double second = hypot(s.cosine, s.sine) / s.n,
                 fourth = hypot(s.cosine_fourth, s.sine_fourth) / s.n;
    const double amplitude = order == 2 ? second : fourth, square = amplitude * amplitude;
    /* The anisotropy itself adds to the scatter of the modes and is removed. The mean square of
     * a mode over its squared mean is (1 + scatter^2) (1 + a^2/2 + b^2/2). */
    const double all = s.square / s.n, turned = 1 + (second * second + fourth * fourth) / 2;
    const double mode_share = fmax(0, (all + 1) / turned - 1) / all;
    const double scatter = sqrt(s.variance) / s.n;
    return (wt_surface_anisotropy){
        .amplitude = amplitude,
        .direction =
            (order == 2 ? atan2(s.sine, s.cosine) : atan2(s.sine_fourth, s.cosine_fourth)) / turns,
        .amplitude_error = scatter * sqrt(mode_share),
        .direction_error = fmin(uniform_direction_error(turns), scatter / (turns * amplitude)),
        .p_value = exp(-square * s.n * s.n / (2 * s.variance))};
}

wt_interval wt_surface_sector(const wt_surface_spectrum *spectrum, size_t sector, double *modes)
{
    const double nan = (double)NAN;
    double n = 0, sum = 0, variance = 0;
    for (size_t k = 0; k < spectrum->n; k++) {
        const wt_spectrum_bin *b = &spectrum->bins[k];
        if (!b->reliable || !(b->sector_modes[sector] > 0))
            continue;
        const double scatter = b->deviation / b->density;
        n += b->sector_modes[sector];
        sum += b->sector_sum[sector];
        variance += 2 * b->sector_modes[sector] * b->sector_tie * scatter * scatter;
    }
    *modes = n;
    if (!(n > 0) || !(sum > 0))
        return (wt_interval){nan, nan, nan, nan};
    const double mean = sum / n;
    return surface_interval(mean, 2 * n * n / variance);
}

/* ---- places ---------------------------------------------------------------------------------- */

/* Weights of the scans in the bins. A place is rougher or smoother at all wavenumbers. Scans of
 * different sizes lie at different places, so their bins have independent errors. */
typedef struct place_weights {
    const double *weight; /* [n_bins * n] */
    size_t n_bins, n;
} place_weights;

static bool have_equal_weights(const place_weights *w, size_t a, size_t b)
{
    for (size_t k = 0; k < w->n_bins; k++)
        if (w->weight[k * w->n + a] != w->weight[k * w->n + b])
            return false;
    return true;
}

/* Returns the first bin in which the scan has a weight. */
static size_t first_weighted_bin(const place_weights *w, size_t scan)
{
    size_t k = 0;
    while (k < w->n_bins && !(w->weight[k * w->n + scan] > 0))
        k++;
    return k;
}

/* Lists the first scan of each size, longest waves first, and returns the number of sizes. */
static size_t find_scan_sizes(const place_weights *w, size_t *first)
{
    size_t n = 0;
    for (size_t i = 0; i < w->n; i++) {
        size_t at = 0;
        while (at < n && !have_equal_weights(w, first[at], i))
            at++;
        if (at < n)
            continue;
        for (at = n++; at > 0 && first_weighted_bin(w, first[at - 1]) > first_weighted_bin(w, i);
             at--)
            first[at] = first[at - 1];
        first[at] = i;
    }
    return n;
}

void surface_set_position_weights(const double *weights, size_t n_scans, wt_surface_spectrum *to)
{
    const place_weights w = {weights, to->n, n_scans};
    size_t *first = wt_alloc(n_scans, sizeof *first);
    const size_t n = find_scan_sizes(&w, first);
    to->place_part = wt_alloc(to->n * n, sizeof *to->place_part);
    to->n_sizes = n;
    for (size_t k = 0; k < to->n; k++)
        for (size_t size = 0; size < n; size++) {
            double square = 0;
            for (size_t i = 0; i < n_scans; i++)
                if (have_equal_weights(&w, first[size], i))
                    square += weights[k * n_scans + i] * weights[k * n_scans + i];
            to->place_part[k * n + size] = sqrt(square);
        }
    free(first);
}

double surface_position_weight(const wt_surface_spectrum *s, size_t bin, size_t size)
{
    return s->place_part[bin * s->n_sizes + size];
}

double surface_total_position_weight(const wt_surface_spectrum *s, size_t bin)
{
    double square = 0;
    if (s->n_sizes == 0)
        return 1 / sqrt((double)s->bins[bin].scans);
    for (size_t size = 0; size < s->n_sizes; size++)
        square += pow(surface_position_weight(s, bin, size), 2);
    return sqrt(square);
}

/* ---- scatter of the modes -------------------------------------------------------------------- */

/* The squared amplitude of a mode of a random surface is exponential. The mean of several is
 * chi-squared with two degrees of freedom for each independent mode.
 *
 * Below one degree of freedom the place error dominates, which is normal in ln C. */
static const double min_df = 1;

double surface_log_bias(double freedom)
{
    return gsl_sf_psi(freedom / 2) - log(freedom / 2);
}

double surface_bin_log_density(const wt_spectrum_bin *bin)
{
    return log(bin->density) - surface_log_bias(bin->freedom);
}

const wt_spectrum_bin *surface_reliable_bin(const wt_surface_spectrum *s, int index)
{
    for (size_t k = 0; k < s->n; k++)
        if (s->bins[k].index == index)
            return s->bins[k].reliable ? &s->bins[k] : NULL;
    return NULL;
}

double surface_log_variance(double freedom)
{
    return gsl_sf_psi_n(1, freedom / 2);
}

/* Uses Newton's method in ln x on ln of the trigamma function, which is nearly straight: its
 * slope is between -2 and -1. */
double surface_variance_freedom(double variance)
{
    double x = variance > 1 ? 1 / sqrt(variance) : 1 / variance + 0.5;
    for (int i = 0; i < 8; i++) {
        const double value = gsl_sf_psi_n(1, x), slope = x * gsl_sf_psi_n(2, x) / value;
        x *= exp(log(variance / value) / slope);
    }
    return 2 * x;
}

wt_interval surface_interval(double mean, double freedom)
{
    wt_interval i = {.value = mean};
    gsl_quiet();
    if (freedom >= min_df) {
        i.low = mean * freedom / gsl_cdf_chisq_Qinv(0.025, freedom);
        i.high = mean * freedom / gsl_cdf_chisq_Pinv(0.025, freedom);
    } else {
        const double reach = NORMAL_95 * sqrt(surface_log_variance(freedom));
        i.low = mean * exp(-surface_log_bias(freedom) - reach);
        i.high = mean * exp(-surface_log_bias(freedom) + reach);
    }
    /* The interval is skewed, its logarithm is nearly symmetric. */
    i.standard_error = mean * log(i.high / i.low) / 2 / NORMAL_95;
    return i;
}
