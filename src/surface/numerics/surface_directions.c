/* Dependence of a spectrum on the direction in the plane of the surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include <math.h>

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
