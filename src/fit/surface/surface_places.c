/* What the places that were scanned give the bins of a spectrum: a place is rougher or smoother at
 * all wavenumbers alike, but scans of another size lie at other places, so that bins of these are
 * not off together with those. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/surface/surface.h"

#include <math.h>

/* Bins, ten to a decade: sizes within a factor of 1.6 are one, for one pixel more may move an
 * edge. */
enum { SAME_SIZE = 2 };

static double weight_at(const wt_surface_spectrum *s, size_t bin, size_t scan)
{
    return s->place_weight[bin * s->n_places + scan];
}

/* It begins with the longest waves of all. */
static bool is_wide(const wt_surface_spectrum *s, size_t scan)
{
    for (size_t k = 0; k < s->n && s->bins[k].index <= s->bins[0].index + SAME_SIZE; k++)
        if (weight_at(s, k, scan) > 0)
            return true;
    return false;
}

bool surface_places_differ(const wt_surface_spectrum *s)
{
    for (size_t k = 0; k < s->n; k++)
        for (size_t i = 0; i < s->n_places; i++)
            if (!(weight_at(s, k, i) > 0))
                return true;
    return false;
}

double surface_places_part(const wt_surface_spectrum *s, size_t bin, surface_scans which)
{
    double square = 0;
    if (s->n_places == 0)
        return which == SURFACE_NARROW_SCANS ? 0 : 1 / sqrt((double)s->bins[bin].scans);
    for (size_t i = 0; i < s->n_places; i++) {
        const double weight = weight_at(s, bin, i);
        if (which == SURFACE_ALL_SCANS || is_wide(s, i) == (which == SURFACE_WIDE_SCANS))
            square += weight * weight;
    }
    return sqrt(square);
}
