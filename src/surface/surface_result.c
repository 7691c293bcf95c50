/* Combines the scans of a surface to one spectrum, finds its end and computes its roughness
 * parameters.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/surface.h"

#include "core/base/number.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/registry.h"
#include "surface/numerics/surface_analysis.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- height maps and profiles ---------------------------------------------------------------- */

/* Combines the profiles to one spectrum of the surface. They add longer waves and other places,
 * but no directions. */
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

/* Returns the variance of ln C due to the mode scatter, as it enters a mean of several bins. */
static double bin_log_variance(const wt_spectrum_bin *b)
{
    return surface_log_variance(b->shared_freedom);
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
        const wt_spectrum_bin *map = &maps->bins[k],
                              *profile = surface_reliable_bin(profiles, map->index);
        if (profile == NULL)
            continue;
        const double weight = 1 / (bin_log_variance(map) + bin_log_variance(profile));
        sum += weight * (surface_bin_log_density(profile) - surface_bin_log_density(map));
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
    wt_format_si(2 * M_PI / q_short, "m", 3, from, sizeof from);
    wt_format_si(2 * M_PI / q_long, "m", 3, till, sizeof till);
    clocale_append(to, size, "%s%s to %s", before, from, till);
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
    const char *separator = to[0] != '\0' ? "; " : "";
    if (isnan(r->value))
        clocale_append(to, size, "%sthey share no waves with the height maps", separator);
    else if (isnan(r->standard_error))
        clocale_append(to, size,
                       "%swhere both have data, C by them is %.2g of that by the height maps; "
                       "their agreement is inconclusive, because the scatter between places is "
                       "not known: add a second map or profile",
                       separator, r->value);
    else
        clocale_append(to, size,
                       "%swhere both have data, C by them is %.2g (95 %%: %s) of that by the "
                       "height maps%s",
                       separator, r->value, format_range(r->low, r->high, 2).text,
                       surface_profiles_disagree(w) ? ": they disagree" : "");
}

/* ---- knots ----------------------------------------------------------------------------------- */

/* Rms slope of the usual cutoff: Lorenz, Persson et al., J. Phys.: Condens. Matter 23 (2011)
 * 175003 and later. */
static const double surface_steep_slope = 1.3;
/* Rubber cannot follow waves shorter than 1 nm. */
static const double shortest_wave = 1e-9;
/* Limit of the search for a slope along the law: the size of an atom [m]. */
static const double atom_size = 1e-10;
/* Knots per decade of the law. It is a straight line except for the step from the last bin. */
enum { LAW_PER_DECADE = 10 };

void surface_knots_clear(surface_knots *knots)
{
    free(knots->wavenumber);
    *knots = (surface_knots){.n = 0};
}

static double interpolate_density(const wt_spectrum_bin *a, const wt_spectrum_bin *b, double q)
{
    const double t = log(q / a->wavenumber) / log(b->wavenumber / a->wavenumber);
    return exp((1 - t) * log(a->density) + t * log(b->density));
}

/* Builds the knots: the bins up to `end`, interpolated there, and the law beyond the last bin. */
static surface_knots build_knots(const surface_result *w, double end)
{
    const wt_surface_spectrum *s = &w->spectrum;
    const double last = s->bins[s->n - 1].wavenumber;
    const double decades = fmax(0, log10(end / last));
    const size_t n_law = end > last ? (size_t)ceil(decades * LAW_PER_DECADE) : 0;
    surface_knots knots = {.wavenumber = wt_alloc(2 * (s->n + n_law + 1), sizeof(double))};
    knots.density = knots.wavenumber + s->n + n_law + 1;
    for (size_t k = 0; k < s->n && s->bins[k].wavenumber <= end; k++) {
        knots.wavenumber[knots.n] = s->bins[k].wavenumber;
        knots.density[knots.n++] = s->bins[k].density;
    }
    if (end < last && knots.n > 0 && knots.wavenumber[knots.n - 1] < end) {
        knots.density[knots.n] = interpolate_density(&s->bins[knots.n - 1], &s->bins[knots.n], end);
        knots.wavenumber[knots.n++] = end;
        knots.cut = true;
    }
    knots.n_measured = knots.n;
    for (size_t i = 1; i <= n_law; i++) {
        const double q = i == n_law ? end : last * pow(10, decades * (double)i / (double)n_law);
        knots.wavenumber[knots.n] = q;
        knots.density[knots.n++] = wt_self_affine_density(&w->law, q);
    }
    return knots;
}

static wt_status knots_to_roughness(const surface_knots *k, size_t n, wt_roughness **to,
                                    wt_error *err)
{
    if (n < 2) {
        wt_fail(err, WT_E_RANGE, "the spectrum ends before its second bin");
        wt_error_expected(err, "an end above the first wavenumbers that are reliable");
        return WT_E_RANGE;
    }
    return wt_roughness_table(k->wavenumber, k->density, n, to, err);
}

/* Finds the wavenumber at which the rms slope reaches `slope`, in the measured range or along
 * the law. NaN if it is not reached. */
static wt_status find_slope_limit(const surface_result *w, double slope, double *end, bool *by_law,
                                  wt_error *err)
{
    const double last = w->spectrum.bins[w->spectrum.n - 1].wavenumber;
    wt_status status = WT_OK;
    *end = (double)NAN;
    for (int beyond = 0; status == WT_OK && isnan(*end) && beyond <= (w->law.found ? 1 : 0);
         beyond++) {
        surface_knots k = build_knots(w, beyond == 1 ? 2 * M_PI / atom_size : last);
        wt_roughness *r = NULL;
        status = knots_to_roughness(&k, k.n, &r, err);
        if (status == WT_OK)
            *end = wt_roughness_slope_wavenumber(r, slope);
        *by_law = beyond == 1;
        wt_roughness_free(r);
        surface_knots_clear(&k);
    }
    return status;
}

/* ---- errors of the knots --------------------------------------------------------------------- */

static size_t knot_bin(const wt_surface_spectrum *s, size_t knot)
{
    return knot < s->n ? knot : s->n - 1;
}

/* Returns the place error of a single scan; NaN if unknown or with one size. */
static double single_position_error(const wt_surface_spectrum *s)
{
    return s->place_error > 0 && s->n_sizes > 1 ? s->place_reach : (double)NAN;
}

double surface_knot_size_error(const wt_surface_spectrum *s, size_t knot, size_t size)
{
    return s->n_sizes > 1
               ? single_position_error(s) * surface_position_weight(s, knot_bin(s, knot), size)
               : (double)NAN;
}

/* The same due to the places of all sizes. */
double surface_knot_position_error(const wt_surface_spectrum *s, size_t knot)
{
    return single_position_error(s) * surface_total_position_weight(s, knot_bin(s, knot));
}

/* A bin is correlated equally with the next and the previous bin. */
double surface_next_bin_correlation(const wt_surface_spectrum *s, size_t bin)
{
    const wt_spectrum_bin *const a = &s->bins[bin], *const b = a + 1;
    const double most = POWER_SPECTRUM_MAX_CORRELATION;
    const double beside_a = fmax(0, a->freedom / a->shared_freedom - 1),
                 beside_b = fmax(0, b->freedom / b->shared_freedom - 1);
    return b->index == a->index + 1 ? fmin(most, 0.5 * sqrt(beside_a * beside_b)) : 0;
}

double surface_law_error(const surface_result *w, double wavenumber)
{
    const double alone = wt_self_affine_log_error(&w->law, wavenumber, false),
                 all = wt_self_affine_log_error(&w->law, wavenumber, true),
                 last = surface_knot_position_error(&w->spectrum, w->spectrum.n),
                 places = isnan(last) ? w->spectrum.place_error : last,
                 common = places > 0 ? places : 0;
    return sqrt(fmax(alone * alone, all * all - common * common));
}

/* ---- roughness parameters -------------------------------------------------------------------- */

typedef double roughness_statistic(const wt_roughness *roughness);

static wt_status compute_statistic(const surface_knots *k, roughness_statistic *statistic,
                                   double *to, wt_error *err)
{
    wt_roughness *r = NULL;
    const wt_status status = knots_to_roughness(k, k->n, &r, err);
    if (status == WT_OK)
        *to = statistic(r);
    wt_roughness_free(r);
    return status;
}

enum { NO_SIZE = INT_MAX };

/* Returns the standard error of ln C at a knot due to its scatter. */
static double knot_error(const surface_result *w, size_t i)
{
    return i < w->knots.n_measured ? sqrt(surface_log_variance(w->spectrum.bins[i].freedom))
                                   : surface_law_error(w, w->knots.wavenumber[i]);
}

/* Computes the parameter with the knots [from, to) raised by their error, or by the place error
 * of one scan size. */
static wt_status perturbed_statistic(surface_result *w, size_t from, size_t to, size_t size,
                                     roughness_statistic *statistic, double *perturbed,
                                     wt_error *err)
{
    surface_knots *k = &w->knots;
    double *unperturbed = wt_alloc(to - from, sizeof *unperturbed);
    for (size_t i = from; i < to; i++) {
        unperturbed[i - from] = k->density[i];
        k->density[i] *= exp(size == NO_SIZE ? knot_error(w, i)
                                             : surface_knot_size_error(&w->spectrum, i, size));
    }
    const wt_status status = compute_statistic(k, statistic, perturbed, err);
    for (size_t i = from; i < to; i++)
        k->density[i] = unperturbed[i - from];
    free(unperturbed);
    return status;
}

/* Adds the variance of the parameter from place to place. The parameter is the root of an
 * integral over C. With several scan sizes each contributes separately. */
static wt_status add_position_variance(surface_result *w, roughness_statistic *statistic,
                                       double value, double *square, wt_error *err)
{
    const size_t n = w->spectrum.n_sizes;
    double perturbed = 0;
    wt_status status = WT_OK;
    if (!(w->spectrum.place_error > 0))
        return WT_OK;
    const double place = value * w->spectrum.place_error / 2;
    *square += n > 1 ? 0 : place * place;
    for (size_t size = 0; status == WT_OK && n > 1 && size < n; size++) {
        status = perturbed_statistic(w, 0, w->knots.n, size, statistic, &perturbed, err);
        *square += (perturbed - value) * (perturbed - value);
    }
    return status;
}

/* Computes a parameter with its standard error. Each bin is raised by its scatter, with the
 * correlation of neighbours. The whole law is raised by the error of its constants, and all
 * knots by the place error. */
static wt_status estimate_statistic(surface_result *w, roughness_statistic *statistic,
                                    wt_estimate *to, wt_error *err)
{
    const surface_knots *k = &w->knots;
    double value = 0, perturbed = 0, before = 0;
    wt_status status = compute_statistic(k, statistic, &value, err);
    double square = 0;
    if (status == WT_OK)
        status = add_position_variance(w, statistic, value, &square, err);
    for (size_t i = 0; status == WT_OK && i < k->n_measured; i++) {
        status = perturbed_statistic(w, i, i + 1, NO_SIZE, statistic, &perturbed, err);
        square += (perturbed - value) * (perturbed - value);
        if (i > 0 && i < w->spectrum.n) /* an interpolated end has the error of its bin */
            square += 2 * surface_next_bin_correlation(&w->spectrum, i - 1) * before *
                      (perturbed - value);
        before = perturbed - value;
    }
    if (status == WT_OK && k->n > k->n_measured) {
        status = perturbed_statistic(w, k->n_measured, k->n, NO_SIZE, statistic, &perturbed, err);
        square += (perturbed - value) * (perturbed - value);
    }
    *to = (wt_estimate){value, sqrt(square), 0, NULL};
    return status;
}

/* ---- end of the spectrum --------------------------------------------------------------------- */

static wt_status find_spectrum_limit(const wt_topography_job *job, const surface_result *w,
                                     double *end, wt_error *err)
{
    const double last = w->spectrum.bins[w->spectrum.n - 1].wavenumber;
    bool by_law = false;
    wt_status status = WT_OK;
    *end = isnan(job->end) ? last : job->end;
    if (!isnan(job->end_slope))
        status = find_slope_limit(w, job->end_slope, end, &by_law, err);
    if (status == WT_OK && isnan(*end)) {
        status = range_error("end-slope", job->end_slope, "a slope that the surface reaches", err);
        wt_error_advice(err, "give --end, or leave both out: the spectrum then ends with what is "
                             "reliable");
    }
    if (status == WT_OK && *end > last && !w->law.found)
        status = wt_fail(err, WT_E_RANGE,
                         "no self-affine law describes the spectrum, so that it cannot be "
                         "extended");
    return status;
}

static void warn_extrapolation(const wt_job *work, const surface_result *w, double end)
{
    char wavelength[32];
    wt_format_si(2 * M_PI / end, "m", 3, wavelength, sizeof wavelength);
    if (w->knots.n > w->knots.n_measured)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "beyond the reliable range the spectrum follows its self-affine law, to "
                   "waves of %s: %.0f %% of the squared slope come from there, and the errors "
                   "contain the scatter of the constants, not a deviation of the surface from "
                   "the law",
                   wavelength, 100 * w->extrapolated_share);
    if (end > 2 * M_PI / shortest_wave)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the spectrum ends at waves of %s, shorter than 1 nm: that is no roughness",
                   wavelength);
}

wt_status surface_find_cutoff(const wt_topography_job *job, const wt_job *work, surface_result *w,
                              wt_error *err)
{
    double end = 0;
    wt_status status = find_slope_limit(w, surface_steep_slope, &w->steep, &w->steep_by_law, err);
    if (status == WT_OK)
        status = find_spectrum_limit(job, w, &end, err);
    if (status != WT_OK)
        return status;
    w->knots = build_knots(w, end);
    status = estimate_statistic(w, wt_roughness_rms_height, &w->rms_height, err);
    if (status == WT_OK)
        status = estimate_statistic(w, wt_roughness_rms_slope, &w->rms_slope, err);
    if (status != WT_OK)
        return status;
    w->extrapolated_share = 0;
    if (w->knots.n > w->knots.n_measured) {
        surface_knots measured = w->knots;
        double slope = 0;
        measured.n = measured.n_measured;
        status = compute_statistic(&measured, wt_roughness_rms_slope, &slope, err);
        w->extrapolated_share = 1 - pow(slope / w->rms_slope.value, 2);
    }
    if (status == WT_OK)
        warn_extrapolation(work, w, end);
    return status;
}
