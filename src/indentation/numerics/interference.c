/* Detection of a sine in the baseline. Optical interference has periods from about half a
 * wavelength (in water) to the length of the baseline.
 *
 * The block means of the baseline minus a cubic have a spectrum. A peak must exceed the values
 * within an octave on either side, which few curves pass. A sine of the largest gain is then
 * subtracted, and the noise of the rest (curve_noise.c) is the reference for the gain at that
 * frequency. The significance level is that of the largest among all resolved periods. The rest
 * includes a cubic, so a bent baseline has no sine. A sine must be present in both halves of the
 * baseline, or, with few cycles, leave a straight baseline. A disturbance near contact alone has
 * another cause.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/math/root.h"
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_fft_real.h>
#include <math.h>
#include <string.h>

enum {
    MAX_BLOCKS = 256, /* blocks; four per shortest period over 10 um */
    MIN_BLOCKS = 64,  /* minimum for a spectrum with an octave on either side */
    BLOCKS = 2 * MAX_BLOCKS,
    TRANSFORM = 2 * BLOCKS,
    PER_PERIOD = 4,    /* smallest number of blocks; their mean keeps 90 % of a sine */
    POWERS = 4,        /* a cubic for drift */
    REFINE_STEPS = 12, /* steps to the period before the fit */
};
static const double min_period = 150e-9; /* [m]; half a blue wavelength in water */
static const double max_period = 1.5e-6; /* [m]; slower oscillations are drift of unknown shape */
static const double max_amplitude_ratio =
    2.0; /* largest ratio of the fitted amplitude; a larger sine belongs to the contact */
/* Smallest ratio of a peak to the required one. Between two frequencies of the transform a peak is
 * lower, and coloured noise surrounds it. */
static const double candidate_share = 0.25;
static const double false_alarm_rate =
    0.001; /* for baselines without a sine: one in a map of a thousand */
static const double min_half_gain =
    0.25; /* smallest share of the gain in either half; a sine has twice as much */
static const double bent_chance = 0.01; /* p value of a straight baseline, as in the fit */
static const double slow_cycles =
    3.0; /* cycles below which a cubic leaves little in the spectrum */
/* Blocks per degree of freedom; few blocks determine the colour of the noise around a peak. */
static const double per_freedom = 10.0;
static const double negligible_amplitude = 2e-5; /* relative to the force; rounding in files */
static const double before_contact =
    0.2; /* share of the contact excluded before it, where a snap-in may be */

typedef struct baseline_blocks {
    size_t n;                     /* blocks */
    double length;                /* samples per block */
    double x[BLOCKS], z[BLOCKS];  /* residual minus a cubic; position */
    double power[POWERS][BLOCKS]; /* orthonormal */
    double travel;
    double cycle, lowest,
        highest; /* wave numbers: one cycle over the travel, and the range of the search */
    double waves, freedom; /* resolved waves in the range; degrees of freedom of the noise */
} baseline_blocks;

WIDE_REGISTERS static void subtract_cubic(const baseline_blocks *b, double *x)
{
    for (size_t k = 0; k < POWERS; k++) {
        const double along = curve_dot(b->power[k], x, b->n);
        for (size_t i = 0; i < b->n; i++)
            x[i] -= along * b->power[k][i];
    }
}

/* Averages the baseline. Returns false if it contains no period. */
WIDE_REGISTERS static bool average_baseline(const curve_fitting *f, baseline_blocks *b)
{
    const curve_samples *s = &f->input.samples;
    const double contact = f->solution.p[CURVE_C], end = s->position[s->n - 1];
    const double last = contact - before_contact * (end - contact);
    size_t n = 0;
    while (n < s->n && s->position[n] < last)
        n++;
    b->travel = n > 0 ? s->position[n - 1] - s->position[0] : 0.0;
    if (!(b->travel > min_period) || n < MIN_BLOCKS)
        return false;
    const double wanted = fmin(fmax(PER_PERIOD * b->travel / min_period, MIN_BLOCKS), MAX_BLOCKS);
    const size_t length = n > (size_t)wanted ? n / (size_t)wanted : 1, first = n % length;
    b->n = n / length;
    b->length = (double)length;
    for (size_t i = 0; i < b->n; i++) {
        const size_t from = first + i * length;
        b->z[i] = curve_sum(s->position + from, length) / b->length;
        b->x[i] =
            curve_sum(s->force + from, length) / b->length - curve_baseline(&f->solution, b->z[i]);
    }
    double *column[POWERS];
    for (size_t k = 0; k < POWERS; k++) {
        column[k] = b->power[k];
        for (size_t i = 0; i < b->n; i++)
            column[k][i] = k > 0 ? (b->z[i] - last) / b->travel * column[k - 1][i] : 1.0;
    }
    size_t n_powers;
    curve_orthogonalise(b->x, column, POWERS, 0, b->n, &n_powers);
    if (n_powers < POWERS)
        return false;
    b->cycle = 2.0 * M_PI / b->travel;
    b->lowest = fmax(b->cycle, 2.0 * M_PI / max_period);
    b->highest = fmin(2.0 * M_PI / min_period, 2.0 * M_PI / PER_PERIOD * (double)b->n / b->travel);
    b->waves = fmax(2.0 * (b->highest - b->lowest) / b->cycle, 1.0);
    b->freedom = (double)b->n / per_freedom;
    return b->highest > b->lowest;
}

/* Returns the wave number of the most significant peak; 0 if there is none. */
static double find_spectral_peak(const baseline_blocks *b)
{
    double x[TRANSFORM], sum[BLOCKS + 1];
    size_t size = 2, best = 0;
    while (size < 2 * b->n)
        size *= 2;
    memcpy(x, b->x, b->n * sizeof *x);
    memset(x + b->n, 0, (size - b->n) * sizeof *x);
    gsl_fft_real_radix2_transform(x, 1, size);
    const size_t half = size / 2;
    sum[0] = sum[1] = 0.0; /* cumulative sums below k */
    for (size_t k = 1; k < half; k++) {
        x[k] = x[k] * x[k] + x[size - k] * x[size - k];
        sum[k + 1] = sum[k] + x[k];
    }
    /* Bins of the transform per cycle over the baseline. */
    const double cycle = (double)size / (double)b->n, unit = b->cycle / cycle;
    const size_t peak_width = (size_t)(1.5 * cycle) + 1;
    const double required_ratio =
        0.5 * b->freedom * (pow(false_alarm_rate / b->waves, -2.0 / b->freedom) - 1.0);
    double most = candidate_share * required_ratio;
    for (size_t k = (size_t)ceil(b->lowest / unit); k < half; k++) {
        const size_t from = k / 2 > 1 ? k / 2 : 1, left = k > peak_width ? k - peak_width : from;
        const size_t least = k + 5 * peak_width, above = 2 * k > least ? 2 * k : least;
        const size_t to = above < half ? above : half, right = k + peak_width + 1;
        double around = 0.0, count = 0.0;
        if (left > from) {
            around += sum[left] - sum[from];
            count += (double)(left - from);
        }
        if (to > right) {
            around += sum[to] - sum[right];
            count += (double)(to - right);
        }
        if (count > 0.0 && x[k] * count > most * around) {
            most = x[k] * count / around;
            best = k;
        }
    }
    const double number = (double)best * unit; /* a faster and stronger peak is no interference */
    return number < b->highest ? number : 0.0;
}

/* Fits a sine of this wave number. Returns the decrease of the sum of squares. */
WIDE_REGISTERS static double fit_sine(const baseline_blocks *b, double number, curve_wave *wave,
                                      double *fitted)
{
    double cosine[BLOCKS], sine[BLOCKS];
    for (size_t i = 0; i < b->n; i++) {
        cosine[i] = cos(number * b->z[i]);
        sine[i] = sin(number * b->z[i]);
    }
    subtract_cubic(b, cosine);
    subtract_cubic(b, sine);
    const double cc = curve_dot(cosine, cosine, b->n), ss = curve_dot(sine, sine, b->n);
    const double cs = curve_dot(cosine, sine, b->n), under = cc * ss - cs * cs;
    const double cx = curve_dot(cosine, b->x, b->n), sx = curve_dot(sine, b->x, b->n);
    if (!(under > 0.0))
        return 0.0;
    *wave = (curve_wave){.p = {(cx * ss - sx * cs) / under, (sx * cc - cx * cs) / under, number}};
    for (size_t i = 0; i < b->n && fitted != NULL; i++)
        fitted[i] = wave->p[WAVE_COSINE] * cosine[i] + wave->p[WAVE_SINE] * sine[i];
    return wave->p[WAVE_COSINE] * cx + wave->p[WAVE_SINE] * sx;
}

static double sine_gain(double number, void *user)
{
    curve_wave ignored;
    return fit_sine(user, number, &ignored, NULL);
}

/* Returns the wave number of the largest gain within half a cycle. */
static double refine_wave_number(baseline_blocks *b, double number)
{
    return root_maximum(sine_gain, b, fmax(number - 0.5 * b->cycle, b->lowest),
                        number + 0.5 * b->cycle, REFINE_STEPS);
}

/* p value: probability that noise with the spectrum of `rest` has such a gain at any period. */
static double sine_chance(const baseline_blocks *b, const double *rest, double number, double gain)
{
    curve_spectrum noise = {.length = b->length};
    if (!curve_noise_spectrum(rest, b->n, &noise))
        return 0.0; /* the rest is zero */
    const double each =
        gain / 2.0 / curve_noise_variance(&noise, 2.0 * number / b->cycle, b->n, (size_t)b->length);
    const double one = pow(1.0 + 2.0 * each / b->freedom, -0.5 * b->freedom);
    return -expm1(b->waves * log1p(-one));
}

/* Finds a significant sine. Returns false if there is none. slow: it has few cycles. */
static bool find_baseline_wave(const curve_fitting *f, curve_wave *wave, bool *slow)
{
    baseline_blocks b;
    double fitted[BLOCKS], rest[BLOCKS];
    if (!average_baseline(f, &b))
        return false;
    double peak = find_spectral_peak(&b);
    if (f->solution.lack.baseline_p < bent_chance) { /* by few cycles? */
        double most = peak > 0.0 ? fit_sine(&b, peak, wave, NULL) : 0.0;
        for (double number = b.lowest; number < slow_cycles * b.cycle && number < b.highest;
             number += 0.25 * b.cycle) {
            const double gain = fit_sine(&b, number, wave, NULL);
            if (gain > most) {
                most = gain;
                peak = number;
            }
        }
    }
    if (!(peak > 0.0))
        return false;
    const double gain = fit_sine(&b, refine_wave_number(&b, peak), wave, fitted);
    const double half = curve_dot(fitted, b.x, b.n / 2);
    for (size_t i = 0; i < b.n; i++)
        rest[i] = b.x[i] - fitted[i];
    const double top = f->solution.p[CURVE_E] * f->workspace->g[f->input.samples.n - 1];
    *slow = wave->p[WAVE_NUMBER] < slow_cycles * b.cycle;
    return (*slow || fmin(half, gain - half) > min_half_gain * gain) &&
           curve_wave_amplitude(wave) > negligible_amplitude * top &&
           sine_chance(&b, rest, wave->p[WAVE_NUMBER], gain) < false_alarm_rate;
}

void curve_subtract_wave(curve_fitting *f, const curve_wave *wave)
{
    curve_samples *s = &f->input.samples;
    const double number = wave->p[WAVE_NUMBER];
    f->kind.wave = *wave;
    if (!curve_has_wave(wave))
        return;
    s->force = f->workspace->without_wave;
    for (size_t i = 0; i < f->input.n_all - f->n_snap; i++)
        s->force[i] = f->workspace->force[i] - wave->p[WAVE_COSINE] * cos(number * s->position[i]) -
                      wave->p[WAVE_SINE] * sin(number * s->position[i]);
}

bool curve_fit_interference(curve_fitting *f)
{
    curve_samples *s = &f->input.samples;
    curve_wave wave;
    bool slow;
    if (f->kind.plain || !find_baseline_wave(f, &wave, &slow))
        return true;
    curve_subtract_wave(f, &wave);
    if (curve_scan_and_refine(f) && f->solution.converged &&
        curve_wave_amplitude(&f->solution.wave) <
            max_amplitude_ratio * curve_wave_amplitude(&wave) &&
        (!slow || !(f->solution.lack.baseline_p < bent_chance)))
        return true;
    s->force = f->workspace->force;
    f->kind.wave = (curve_wave){.by_height = false};
    return curve_scan_and_refine(f);
}
