/* Computes the power spectrum of one height map or profile.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Waves over the shorter side that the form and the window distort. */
static const double first_waves = 2;
/* Largest share of missing heights. With this share of filled scattered points the error of C is
 * 5 %; patches are worse. */
static const double largest_missing = 0.2;
/* Fewest points of a reliable wave. For a self-affine surface, aliased waves contribute 2 % of the
 * density there; with 2 points it is half. */
static const double points_per_wave = 4;
/* Minimum number of points in a direction, so that a range of reliable waves remains. */
enum { LEAST_POINTS = 16 };

wt_surface_options wt_surface_options_defaults(void)
{
    return (wt_surface_options){
        .form = WT_FORM_QUADRATIC, .window = WT_WINDOW_HANN, .tip_radius = (double)NAN};
}

void wt_surface_spectrum_clear(wt_surface_spectrum *spectrum)
{
    if (spectrum == NULL)
        return;
    free(spectrum->bins);
    free(spectrum->place_part);
    *spectrum = (wt_surface_spectrum){.n = 0};
}

static double bin_edge(int index, double side)
{
    return pow(10, (index + side) / 10);
}

/* Returns the slope of ln C against ln q at a bin, from it and two bins on each side. */
static double local_slope(const wt_surface_spectrum *s, size_t at)
{
    enum { NEIGHBOURS = 2 }; /* over four bins the scatter changes the slope little */
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t k = at > NEIGHBOURS ? at - NEIGHBOURS : 0; k < s->n && k <= at + NEIGHBOURS; k++) {
        const double w = s->bins[k].freedom, u = log(s->bins[k].wavenumber),
                     v = log(s->bins[k].density);
        if (!(s->bins[k].density > 0))
            continue;
        n += w;
        x += w * u;
        y += w * v;
        xx += w * u * u;
        xy += w * u * v;
    }
    const double d = n * xx - x * x;
    return d > 0 ? (n * xy - x * y) / d : 0;
}

/* Returns the variance of the spectrum of a window along an axis, in squared modes: mean square
 * slope over mean square and (2 pi)^2. A periodic surface needs no window. */
static double window_variance(wt_surface_window window)
{
    switch (window) {
    case WT_WINDOW_HANN:
        return 1.0 / 3;
    case WT_WINDOW_WELCH:
        return 10 / (4 * M_PI * M_PI);
    default:
        return 0;
    }
}

/* Returns the relative leakage of a window for C = q^p, to second order, with m waves in the
 * length of the map. From one half on the law is meaningless for so few waves. */
static double window_leakage(const wt_height_map *map, double variance, double p, double q)
{
    const double m = q * (double)map->nx * map->dx / (2 * M_PI);
    if (map->ny == 1)
        return variance * p * (p - 1) / (2 * m * m);
    const double n = q * (double)map->ny * map->dy / (2 * M_PI);
    return variance * p * p / 4 * (1 / (m * m) + 1 / (n * n));
}

/* Corrects the mean of a bin for a steep spectrum. C = q^p exceeds its value at the geometric
 * mean by exp(p^2 width^2 / 2). The variation within the bin reduces the degrees of freedom. The
 * window adds leakage. */
static void correct_steep_bins(const wt_height_map *map, wt_surface_window window,
                               wt_surface_spectrum *s)
{
    const double most = 0.6; /* leakage at two waves and the slope of rough surfaces */
    const double variance = window_variance(window);
    double *slope = wt_alloc(s->n, sizeof *slope);
    for (size_t k = 0; k < s->n; k++)
        slope[k] = local_slope(s, k);
    for (size_t k = 0; k < s->n; k++) {
        wt_spectrum_bin *b = &s->bins[k];
        const double above = slope[k] * b->width;
        const double leak =
            fmin(most, fmax(0, window_leakage(map, variance, slope[k], b->wavenumber)));
        b->density *= exp(-above * above / 2) / (1 + leak);
        b->deviation *= exp(-above * above / 2) / (1 + leak);
        b->freedom *= exp(-above * above);
        b->shared_freedom *= exp(-above * above);
    }
    free(slope);
}

/* Marks the bins whose edges lie in the reliable range and whose scatter is known. */
static void mark_reliable(wt_surface_spectrum *s)
{
    for (size_t k = 0; k < s->n; k++) {
        wt_spectrum_bin *b = &s->bins[k];
        b->scans = 1;
        b->reliable = bin_edge(b->index, -0.5) >= s->from && bin_edge(b->index, 0.5) <= s->to &&
                      b->density > 0 && isfinite(b->density);
    }
}

static wt_status check_grid(const wt_height_map *map, wt_error *err)
{
    const bool profile = map->ny == 1;
    if (map->nx < LEAST_POINTS || (!profile && map->ny < LEAST_POINTS)) {
        wt_fail(err, WT_E_EMPTY, "too few points for a power spectrum");
        wt_error_expected(err, "%d or more in each direction", LEAST_POINTS);
        wt_error_found(err, "%zu x %zu", map->nx, map->ny);
        return WT_E_EMPTY;
    }
    if (!(map->dx > 0 && isfinite(map->dx)) || (!profile && !(map->dy > 0 && isfinite(map->dy))))
        return wt_fail(err, WT_E_UNIT, "the distance of the points is not known");
    return WT_OK;
}

static wt_status check_height_statistics(const wt_surface_heights *h, wt_error *err)
{
    const double share = (double)h->missing / (double)h->n;
    if (share > largest_missing) {
        wt_fail(err, WT_E_RANGE, "too many heights are missing");
        wt_error_expected(err, "%g of them at most", largest_missing);
        wt_error_found(err, "%.3g", share);
        wt_error_advice(err, "measure the surface again, or cut out a part that is whole");
        return WT_E_RANGE;
    }
    if (!(h->rms > 0))
        return wt_fail(err, WT_E_EMPTY, "all heights are the same");
    return WT_OK;
}

static void find_reliable_range(const wt_height_map *map, const wt_surface_options *o,
                                wt_surface_spectrum *to)
{
    const bool profile = map->ny == 1;
    const double length_x = (double)map->nx * map->dx, length_y = (double)map->ny * map->dy;
    const double coarse = profile ? map->dx : fmax(map->dx, map->dy);
    to->from = first_waves * 2 * M_PI / (profile ? length_x : fmin(length_x, length_y));
    to->to = 2 * M_PI / (points_per_wave * coarse);
    to->ends_by = "points";
    if (isnan(o->tip_radius))
        return;
    const double tip = surface_tip_limit(map, o->tip_radius);
    if (tip < to->to) {
        to->to = tip;
        to->ends_by = "tip";
    }
}

wt_status wt_surface_analyse(const wt_height_map *map, const wt_surface_options *options,
                             wt_surface_heights *heights, wt_surface_spectrum *spectrum,
                             wt_error *err)
{
    if (map == NULL || map->z == NULL || options == NULL || heights == NULL || spectrum == NULL)
        return wt_fail(err, WT_E_ARG, "no heights");
    const bool profile = map->ny == 1;
    double form[FORM_TERMS];
    wt_status status = check_grid(map, err);
    if (status != WT_OK)
        return status;
    double *z = wt_alloc(map->nx * map->ny, sizeof *z);
    memcpy(z, map->z, map->nx * map->ny * sizeof *z);
    const wt_height_map less = {z, map->nx, map->ny, map->dx, map->dy, map->levelled};
    wt_surface_spectrum made = {
        .place_scatter = (double)NAN, .place_reach = (double)NAN, .place_error = (double)NAN};
    status = surface_remove_form(z, map->nx, map->ny, (unsigned)options->form, form, err);
    if (status == WT_OK) {
        surface_height_statistics(&less, heights);
        status = check_height_statistics(heights, err);
    }
    if (status == WT_OK)
        status = surface_fill_missing(z, map->nx, map->ny, err);
    if (status == WT_OK) {
        const double coarse = profile ? map->dx : fmax(map->dx, map->dy);
        const double length = (double)map->nx * map->dx;
        find_reliable_range(&less, options, &made);
        const surface_bins bins = {
            1, 2 * M_PI / (profile ? length : fmax(length, (double)map->ny * map->dy)),
            M_PI / coarse};
        status = surface_transform(&less, options->window, profile, &bins, &made, err);
    }
    free(z);
    if (status == WT_OK) {
        correct_steep_bins(&less, options->window, &made);
        mark_reliable(&made);
        *spectrum = made;
    }
    return status;
}
