/* What of a spectrum depends on the direction in the plane of the surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/surface/surface.h"

#include <math.h>

/* The standard error of a direction of which nothing is known: any in a turn over the order. */
static double unknown_direction(double order)
{
    return 2 * M_PI / order / sqrt(12);
}

wt_surface_anisotropy wt_surface_directions(const wt_surface_spectrum *spectrum, unsigned order)
{
    const double nan = (double)NAN, turns = (double)order;
    double n = 0, variance = 0, cosine = 0, sine = 0;
    for (size_t k = 0; k < spectrum->n; k++) {
        const wt_spectrum_bin *b = &spectrum->bins[k];
        if (!b->reliable)
            continue;
        n += (double)b->n;
        /* Each part scatters by 2 / sqrt(freedom) where the directions are alike and the modes are
         * exponential; where these scatter more, by that. */
        const double part = (double)b->n * 2 * b->deviation / b->density;
        variance += part * part / b->freedom;
        cosine += (double)b->n * (order == 2 ? b->cosine : b->cosine_fourth);
        sine += (double)b->n * (order == 2 ? b->sine : b->sine_fourth);
    }
    if (spectrum->kind != WT_SPECTRUM_2D || !(n > 0) || isnan(cosine))
        return (wt_surface_anisotropy){nan, nan, nan, nan, nan};
    const double amplitude = hypot(cosine, sine) / n, error = sqrt(variance) / n;
    return (wt_surface_anisotropy){.amplitude = amplitude,
                                   .direction = atan2(sine, cosine) / turns,
                                   .amplitude_error = error,
                                   .direction_error =
                                       fmin(unknown_direction(turns), error / (turns * amplitude)),
                                   .chance = exp(-amplitude * amplitude * n * n / (2 * variance))};
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
