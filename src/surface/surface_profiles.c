/* Combines height maps and profiles to one spectrum and compares them. Profiles add longer waves
 * and other places, but no directions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/surface.h"

#include "core/base/clocale.h"
#include "core/base/range_text.h"
#include "core/math/normal_quantile.h"
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Combines the profiles to one spectrum of the surface. */
static wt_status invert_profiles(const wt_surface_spectrum *const *profiles, size_t n,
                                 wt_surface_spectrum *to, wt_error *err)
{
    wt_surface_spectrum one = {.n = 0};
    wt_status status = wt_surface_combine(profiles, n, &one, err);
    if (status == WT_OK)
        status = wt_surface_invert(&one, to, err);
    wt_surface_spectrum_clear(&one);
    return status;
}

static double bin_log_density(const wt_spectrum_bin *b)
{
    return log(b->density) - surface_log_bias(b->freedom);
}

/* Returns the variance of ln C due to the mode scatter, as it enters a mean of several bins. */
static double bin_log_variance(const wt_spectrum_bin *b)
{
    return surface_log_variance(b->shared_freedom);
}

static const wt_spectrum_bin *reliable_bin(const wt_surface_spectrum *s, int index)
{
    for (size_t k = 0; k < s->n; k++)
        if (s->bins[k].index == index && s->bins[k].reliable)
            return &s->bins[k];
    return NULL;
}

/* Returns the place error of ln C of one kind of scan. If it is unknown, the place scatter of
 * the other kind is used, otherwise NaN. The difference between the kinds is the question, not
 * scatter. */
static double position_standard_error(const wt_surface_spectrum *s,
                                      const wt_surface_spectrum *others)
{
    return isnan(s->place_error) ? others->place_reach : s->place_error;
}

/* Returns the ratio of C from profiles to C from maps, averaged over shared bins; NaN without
 * any. */
static wt_interval profile_map_ratio(const wt_surface_spectrum *profiles,
                                     const wt_surface_spectrum *maps)
{
    double sum = 0, weights = 0;
    for (size_t k = 0; k < maps->n; k++) {
        const wt_spectrum_bin *map = &maps->bins[k], *profile = reliable_bin(profiles, map->index);
        if (profile == NULL)
            continue;
        const double weight = 1 / (bin_log_variance(map) + bin_log_variance(profile));
        sum += weight * (bin_log_density(profile) - bin_log_density(map));
        weights += weight;
    }
    if (!(weights > 0))
        return (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    const double places = hypot(position_standard_error(maps, profiles),
                                position_standard_error(profiles, maps)),
                 error = hypot(1 / sqrt(weights), places), ratio = exp(sum / weights);
    return (wt_interval){ratio, ratio * error, ratio * exp(-NORMAL_95 * error),
                         ratio * exp(NORMAL_95 * error)};
}

wt_status surface_join_scans(const surface_scan *scans, size_t n, surface_result *to, wt_error *err)
{
    const wt_surface_spectrum **of = wt_alloc(2 * (n + 1), sizeof *of);
    const wt_surface_spectrum **profiles = of + n + 1;
    wt_surface_spectrum inverted = {.n = 0};
    for (size_t i = 0; i < n; i++)
        if (scans[i].spectrum.kind == WT_SPECTRUM_2D)
            of[to->n_maps++] = &scans[i].spectrum;
        else
            profiles[to->n_profiles++] = &scans[i].spectrum;
    const bool both = to->n_maps > 0 && to->n_profiles > 0;
    wt_status status = WT_OK;
    if (to->n_profiles > 0)
        status = invert_profiles(profiles, to->n_profiles, &inverted, err);
    /* Without reliable maps the profiles are the whole spectrum. */
    if (status == WT_OK && both && wt_surface_combine(of, to->n_maps, &to->maps, NULL) != WT_OK)
        to->maps = (wt_surface_spectrum){.n = 0};
    if (both)
        of[to->n_maps] = &inverted;
    if (status == WT_OK && to->n_maps > 0)
        status = wt_surface_combine(of, to->n_maps + (both ? 1 : 0), &to->spectrum, err);
    else if (status == WT_OK)
        to->spectrum = inverted;
    to->profiles_ratio = (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    if (status == WT_OK && both) {
        to->profiles_ratio = profile_map_ratio(&inverted, &to->maps);
        to->profiles_from = inverted.bins[0].wavenumber;
        to->profiles_to = inverted.bins[inverted.n - 1].wavenumber;
    }
    if (to->n_maps > 0)
        wt_surface_spectrum_clear(&inverted);
    free(of);
    return status;
}

const wt_surface_spectrum *surface_directional_spectrum(const surface_result *whole)
{
    return whole->maps.n > 0 ? &whole->maps : &whole->spectrum;
}

static void append_wave_range(char *to, size_t size, const char *before, double q_long,
                              double q_short)
{
    char from[32], till[32];
    const size_t used = strlen(to);
    wt_format_si(2 * M_PI / q_short, "m", 3, from, sizeof from);
    wt_format_si(2 * M_PI / q_long, "m", 3, till, sizeof till);
    clocale_print(to + used, size - used, "%s%s to %s", before, from, till);
}

bool surface_profiles_disagree(const surface_result *w)
{
    return w->profiles_ratio.low > 1 || w->profiles_ratio.high < 1;
}

void surface_describe_profiles(const surface_result *w, char *to, size_t size)
{
    const wt_surface_spectrum *const all = &w->spectrum, *const maps = &w->maps;
    to[0] = '\0';
    if (maps->n == 0 || all->n == 0)
        return;
    const wt_spectrum_bin *const first = &maps->bins[0], *const last = &maps->bins[maps->n - 1];
    const wt_interval *const r = &w->profiles_ratio;
    const char *before = "they alone tell waves of ";
    if (all->bins[0].index < first->index) {
        append_wave_range(to, size, before, w->profiles_from,
                          fmin(first->wavenumber, w->profiles_to));
        before = " and of ";
    }
    if (all->bins[all->n - 1].index > last->index)
        append_wave_range(to, size, before, fmax(last->wavenumber, w->profiles_from),
                          w->profiles_to);
    const size_t used = strlen(to);
    if (isnan(r->value))
        clocale_print(to + used, size - used, "%sthey share no waves with the height maps",
                      used > 0 ? "; " : "");
    else if (isnan(r->standard_error))
        clocale_print(to + used, size - used,
                      "%swhere both tell, C by them is %.2g of that by the height maps; it cannot "
                      "be said whether they agree, for how places differ is not known: a second "
                      "map or profile would tell",
                      used > 0 ? "; " : "", r->value);
    else
        clocale_print(to + used, size - used,
                      "%swhere both tell, C by them is %.2g (95 %%: %s) of that by the "
                      "height maps%s",
                      used > 0 ? "; " : "", r->value, format_range(r->low, r->high, 2).text,
                      surface_profiles_disagree(w) ? ": they disagree" : "");
}
