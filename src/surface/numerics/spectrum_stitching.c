/* Scatter of a power spectrum: of its modes, from place to place, and over the directions in the
 * plane of the surface. Combination of the spectra of several scans: different scan sizes are
 * stitched, different places are averaged.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/special.h"
#include "core/math/students_t.h"
#include "surface/numerics/surface_analysis.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

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

/* 95 % interval of the true value for a mean. */
static wt_interval spectrum_interval(double mean, double freedom)
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
    return spectrum_interval(mean, 2 * n * n / variance);
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

/* Finds the scan sizes and their weights from the weights of the scans in each bin of `to`,
 * [n_scans] for each bin. */
static void set_position_weights(const double *weights, size_t n_scans, wt_surface_spectrum *to)
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

/* ---- combination ---------------------------------------------------------------------- */

/* Working data of the combination; all spectra have the same bin edges. */
typedef struct stitching_work {
    const wt_surface_spectrum *const *spectra;
    size_t n;
    int first, last;
    double *offset; /* [n] deviation of ln C of a scan from the mean */
    double *weight; /* [n] weight of the offset */
    size_t *group;  /* [n] first scan that is linked by shared bins */
} stitching_work;

/* ---- scatter from place to place ------------------------------------------------------------- */

/* Computes the mean of a bin without the offsets. Returns the number of scans in it. */
static size_t offset_free_mean(const stitching_work *j, int index, double *mean)
{
    double sum = 0, weights = 0;
    size_t n = 0;
    for (size_t i = 0; i < j->n; i++) {
        const wt_spectrum_bin *b = surface_reliable_bin(j->spectra[i], index);
        if (b == NULL)
            continue;
        sum += b->freedom * (surface_bin_log_density(b) - j->offset[i]);
        weights += b->freedom;
        n++;
    }
    *mean = sum / weights;
    return n;
}

/* Improves the offsets by one step and returns the largest change. */
static double refine_offsets(stitching_work *j, double *sum)
{
    double middle = 0, change = 0;
    size_t known = 0;
    for (size_t i = 0; i < j->n; i++)
        sum[i] = j->weight[i] = 0;
    for (int index = j->first; index <= j->last; index++) {
        double mean;
        if (offset_free_mean(j, index, &mean) < 2)
            continue;
        for (size_t i = 0; i < j->n; i++) {
            const wt_spectrum_bin *b = surface_reliable_bin(j->spectra[i], index);
            if (b == NULL)
                continue;
            sum[i] += (surface_bin_log_density(b) - mean) / surface_log_variance(b->freedom);
            j->weight[i] += 1 / surface_log_variance(b->freedom);
        }
    }
    for (size_t i = 0; i < j->n; i++)
        if (j->weight[i] > 0) {
            middle += sum[i] / j->weight[i];
            known++;
        }
    for (size_t i = 0; i < j->n; i++)
        if (j->weight[i] > 0) {
            const double next = sum[i] / j->weight[i] - middle / (double)known;
            change = fmax(change, fabs(next - j->offset[i]));
            j->offset[i] = next;
        }
    return change;
}

/* Groups the scans by shared bins. Scans without a shared bin cannot be compared. */
static void find_linked_groups(stitching_work *j)
{
    bool changed = true;
    for (size_t i = 0; i < j->n; i++)
        j->group[i] = i;
    while (changed) {
        changed = false;
        for (int index = j->first; index <= j->last; index++) {
            size_t least = j->n;
            for (size_t i = 0; i < j->n; i++)
                if (surface_reliable_bin(j->spectra[i], index) != NULL && j->group[i] < least)
                    least = j->group[i];
            for (size_t i = 0; i < j->n; i++)
                if (surface_reliable_bin(j->spectra[i], index) != NULL && j->group[i] > least) {
                    j->group[i] = least;
                    changed = true;
                }
        }
    }
}

/* Adds the squares of the offsets of a group about their mean and the variance of their mode
 * scatter. Returns the number of scans. */
static size_t add_group_squares(const stitching_work *j, size_t group, double *squares,
                                double *noise)
{
    double sum = 0, square = 0;
    size_t n = 0;
    for (size_t i = 0; i < j->n; i++)
        if (j->group[i] == group && j->weight[i] > 0) {
            sum += j->offset[i];
            square += j->offset[i] * j->offset[i];
            *noise += 1 / j->weight[i];
            n++;
        }
    if (n > 0)
        *squares += fmax(0, square - sum * sum / (double)n);
    return n;
}

/* Returns the share of the mode scatter that an interval subtracts: the lower third of its
 * distribution. With all of it, two places with twice the mode scatter are contained in 87 % and
 * three in 91 %. With this share two to ten places are contained in 93 to 98 %. */
static double noise_share(double freedom)
{
    gsl_quiet();
    return gsl_cdf_chisq_Pinv(1.0 / 3, freedom) / freedom;
}

/* Estimates the place scatter: variance of the offsets of linked scans minus the variance of
 * their mode scatter. */
static void estimate_position_scatter(stitching_work *j, wt_surface_spectrum *to, double *scratch)
{
    enum { STEPS = 200 };        /* each step reduces the change */
    const double settled = 1e-6; /* in ln C, far below its scatter */
    double squares = 0, noise = 0;
    size_t n = 0, groups = 0;
    for (int step = 0; step < STEPS && refine_offsets(j, scratch) > settled; step++)
        ;
    find_linked_groups(j);
    for (size_t i = 0; i < j->n; i++) {
        const size_t members = j->group[i] == i ? add_group_squares(j, i, &squares, &noise) : 0;
        n += members;
        groups += members > 0 ? 1 : 0;
    }
    to->place_scatter = to->place_reach = to->place_error = (double)NAN;
    if (n == groups)
        return;
    const double freedom = (double)(n - groups), all = squares / freedom, modes = noise / (double)n;
    to->place_scatter = sqrt(fmax(0, all - modes));
    to->place_reach = students_t_quantile(freedom) / NORMAL_95 *
                      sqrt(fmax(0, all - noise_share(freedom) * modes));
}

/* Computes the place error of the mean. A bin of one size has only the places of that size. A
 * bin of two sizes has mostly those of the scans with most modes. */
static void find_position_error(wt_surface_spectrum *to)
{
    double sum = 0;
    for (size_t k = 0; k < to->n; k++) {
        const double part = surface_total_position_weight(to, k);
        sum += part * part;
    }
    to->place_error = to->place_reach * sqrt(sum / (double)to->n);
}

/* ---- bins ------------------------------------------------------------------------------------ */

/* Adds the directional sums, weighted by the number of modes. */
static void add_direction_sums(const wt_spectrum_bin *b, wt_spectrum_bin *to)
{
    const double w = (double)b->n;
    to->cosine += w * b->cosine;
    to->sine += w * b->sine;
    to->cosine_fourth += w * b->cosine_fourth;
    to->sine_fourth += w * b->sine_fourth;
    to->sector_tie += w * b->sector_tie;
    for (size_t k = 0; k < WT_SURFACE_SECTORS; k++) {
        to->sector_modes[k] += b->sector_modes[k];
        to->sector_sum[k] += b->sector_sum[k];
    }
}

/* Averages ln q and ln C with the number of modes as weight. The mean of logarithms is biased
 * low for few modes, which is corrected. */
static bool join_bin(const stitching_work *j, int index, wt_spectrum_bin *to)
{
    double n = 0, freedom = 0, ln_q = 0, ln_c = 0, q = 0, bias = 0, variance = 0, shared = 0,
           deviation = 0;
    *to = (wt_spectrum_bin){.index = index, .reliable = true};
    for (size_t i = 0; i < j->n; i++) {
        const wt_spectrum_bin *b = surface_reliable_bin(j->spectra[i], index);
        if (b == NULL)
            continue;
        const double w = (double)b->n;
        n += w;
        freedom += b->freedom;
        ln_q += w * log(b->wavenumber);
        ln_c += w * log(b->density);
        q += w * b->mean_wavenumber;
        bias += w * surface_log_bias(b->freedom);
        variance += w * w * surface_log_variance(b->freedom);
        shared += w * w * surface_log_variance(b->shared_freedom);
        add_direction_sums(b, to);
        to->n += b->n;
        to->scans += b->scans;
        deviation += w * (b->deviation / b->density) * (b->deviation / b->density);
        to->width = fmax(to->width, b->width);
    }
    if (n == 0)
        return false;
    const bool one = to->scans == 1;
    to->wavenumber = exp(ln_q / n);
    to->mean_wavenumber = q / n;
    to->density = exp(ln_c / n + (one ? 0 : surface_log_bias(freedom) - bias / n));
    to->freedom = one ? freedom : surface_variance_freedom(variance / (n * n));
    to->deviation = to->density * sqrt(deviation / n);
    to->shared_freedom = surface_variance_freedom(shared / (n * n));
    to->cosine /= n;
    to->sine /= n;
    to->cosine_fourth /= n;
    to->sine_fourth /= n;
    to->sector_tie /= n;
    return true;
}

/* Stores the weights of the scans in the bin. */
static void set_scan_weights(const stitching_work *j, int index, double *weight)
{
    double n = 0;
    for (size_t i = 0; i < j->n; i++) {
        const wt_spectrum_bin *b = surface_reliable_bin(j->spectra[i], index);
        weight[i] = b != NULL ? (double)b->n : 0;
        n += weight[i];
    }
    for (size_t i = 0; i < j->n; i++)
        weight[i] /= n;
}

static void find_bin_range(stitching_work *j, wt_surface_spectrum *to)
{
    j->first = INT_MAX;
    j->last = INT_MIN;
    to->from = (double)INFINITY;
    to->to = 0;
    for (size_t i = 0; i < j->n; i++) {
        const wt_surface_spectrum *s = j->spectra[i];
        to->from = fmin(to->from, s->from);
        if (s->to > to->to) {
            to->to = s->to;
            to->ends_by = s->ends_by;
        }
        for (size_t k = 0; k < s->n; k++)
            if (s->bins[k].reliable) {
                j->first = s->bins[k].index < j->first ? s->bins[k].index : j->first;
                j->last = s->bins[k].index > j->last ? s->bins[k].index : j->last;
            }
    }
}

wt_status wt_surface_combine(const wt_surface_spectrum *const *spectra, size_t n,
                             wt_surface_spectrum *joined, wt_error *err)
{
    if (spectra == NULL || n == 0 || joined == NULL)
        return wt_fail(err, WT_E_ARG, "no spectra");
    stitching_work j = {.spectra = spectra, .n = n};
    wt_surface_spectrum made = {.kind = spectra[0]->kind};
    find_bin_range(&j, &made);
    if (j.first > j.last) {
        wt_fail(err, WT_E_EMPTY, "no wavenumbers are reliable");
        wt_error_advice(err, "measure with more points, over a larger area, or with a sharper tip");
        return WT_E_EMPTY;
    }
    const size_t n_bins = (size_t)(j.last - j.first) + 1;
    double *weights = wt_alloc(n_bins * n, sizeof *weights);
    made.bins = wt_alloc(n_bins, sizeof *made.bins);
    j.group = wt_alloc(n, sizeof *j.group);
    j.offset = wt_alloc(3 * n, sizeof *j.offset);
    j.weight = j.offset + n;
    estimate_position_scatter(&j, &made, j.offset + 2 * n);
    for (int index = j.first; index <= j.last; index++)
        if (join_bin(&j, index, &made.bins[made.n]))
            set_scan_weights(&j, index, weights + made.n++ * n);
    set_position_weights(weights, n, &made);
    find_position_error(&made);
    *joined = made;
    free(weights);
    free(j.offset);
    free(j.group);
    return WT_OK;
}

wt_interval wt_surface_density(const wt_surface_spectrum *spectrum, size_t bin)
{
    const wt_spectrum_bin *b = &spectrum->bins[bin];
    double freedom = b->freedom;
    if (spectrum->place_error > 0) {
        const double place = spectrum->place_reach * surface_total_position_weight(spectrum, bin);
        freedom = surface_variance_freedom(surface_log_variance(freedom) + place * place);
    }
    return spectrum_interval(b->density, freedom);
}
