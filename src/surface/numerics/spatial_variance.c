/* Variance of a spectrum from place to place. A place is rougher or smoother at all wavenumbers.
 * Scans of different sizes lie at different places, so their bins have independent errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <stdlib.h>

/* Weights of the scans in the bins. */
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
