/* The master curve of a sweep: start, outliers, which isotherms hang together, noise, the fits over
 * the widths of the vertical shift, the law, the verdict. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "dma/numerics/master_fit.h"

#include "core/base/param.h"
#include "core/math/arena_gsl.h"
#include "dma/numerics/spectrum_start.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Widths of the prior of the vertical shift to start with [decade]: clamping, departure of the
 * material (master_widths.c). */
static const double start_geometry = 0.002, start_departure = 0.02;
/* Noise that is the same all along an isotherm. */
const double master_even[SPECTRUM_SHAPES] = {0.0};
/* Fits anew after points were left out, or bends were taken over: each finds less to change, and
 * more are only time. */
enum { MOST_ROUNDS = 4, BEND_ROUNDS = 3 };

/* An isotherm this close to the reference temperature is the reference [K]: what thermometers and
 * chambers agree to. */
static const double same_temperature = 0.1;
/* A fit is started anew when a shift has moved so far from its start that the relaxation times no
 * longer reach well beyond the isotherms [decade]: of the 1.5 decades that they go on, a whole one
 * shall be left. */
static const double far = 0.5;
/* Terms per decade that describe a smooth spectrum, and one of sharp lines. E'' of equal terms h
 * apart in ln tau ripples by 2/cosh(pi^2/h) of itself: 1e-5 with 3 a decade, 8e-4 with 2, 5 % with
 * 1. A line may lie half a step from the nearest terms: with 10 a decade that is a factor 1.12 in
 * frequency. A trial has terms enough between, at an eighth of the cost.
 * Where neighbouring terms bend more than `sharp` [ln], it is no smooth one: moduli follow a
 * spectrum that rises and falls with slopes up to 1, for steeper ones hide under the flanks of a
 * Maxwell element, and a corner between two such slopes bends by 1.5 at 3 terms a decade; this is
 * twice that. Lines then lie between the terms, which pull the isotherms towards themselves, all
 * but the one that is held, by more than their errors. */
static const double smooth_terms = 3.0, trial_terms = 5.0, sharp_terms = 10.0, sharp = 3.0;
/* What one spectrum is off a modulus by, beyond the noise within the isotherms, from which on its
 * shifts mean nothing [ln]: over the slope of a plateau, d ln E'/d ln w = 0.1, that is 0.17 decade,
 * about what a shift may be off by to be determined (master_links.c). Isotherms of which
 * superposition holds or nearly holds miss by 0.3 to 3 %, those of glassy polymers by 5 to 20 % of
 * E''. Below the limit the errors of the shifts grow with the misfit (master_overlap.c), so that
 * nothing jumps there but the route. */
static const double gross_misfit = 0.04;
/* The same from which on it may be in the shifts: 0.04 decade, twice the error that 1 % of noise
 * leaves of them. */
static const double may_move = 0.01;
/* Bends of lines, to start from: free, a factor 150 from one term to the next. Noise over what
 * lines leave of it, and by how many of its standard errors that is more than none. Six are one
 * false alarm in 1e9 of normal noise, which leaves room for longer tails. Chosen: at 1.3 the lines
 * between the terms add 69 % to the square of the noise; at 1.15, a third, some smooth spectra are
 * taken for lines, which costs ten terms a decade and no precision; at 1.6 lines are not seen that
 * add 1.2 times the noise. */
static const double lines_smooth = 5.0, more_noise = 1.3, surely = 6.0;

wt_master_options wt_master_options_defaults(void)
{
    return (wt_master_options){.reference_temperature = (double)NAN,
                               .vertical = WT_VERTICAL_TIED,
                               .terms_per_decade = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM("reference-temperature", wt_master_options, reference_temperature, WT_Q_TEMPERATURE,
           ABOVE(0)),
     .value = "T", .unset = "the isotherm in the middle",
     .help = "reference temperature, such as 20degC; it need not be one of the isotherms"},
    {PARAM_CHOICE_OF("reference-at", wt_master_options, reference_at, "temperature|tan-delta-peak"),
     .help =
         "reference: the temperature that is given or chosen, or that at which tan delta peaks at "
         "1 Hz, a glass transition"},
    {PARAM_CHOICE_OF("vertical-shift", wt_master_options, vertical, "none|physical|free|tied"),
     .help = "vertical shift: none, as rubber elasticity says (Tref/T, with the thermal expansion "
             "of the density), fitted, or tied to that of rubber elasticity as closely as the data "
             "ask for"},
    {PARAM("expansion", wt_master_options, expansion, WT_Q_NONE, FROM_TO(0, 0.01)), .value = "X",
     .help =
         "volumetric thermal expansion in 1/K for the vertical shift of rubber elasticity; that "
         "of rubber is about 7e-4"},
    {PARAM("terms-per-decade", wt_master_options, terms_per_decade, WT_Q_NONE, FROM_TO(2, 10)),
     .value = "X", .unset = "as the spectrum needs: 3, or 10 of sharp lines",
     .help = "of the relaxation spectrum"},
    {PARAM_FLAG_OF("liquid", wt_master_options, liquid), .help = "no equilibrium modulus"},
    {PARAM_CHOICE_OF("shift-by", wt_master_options, shift_by, "moduli|storage|loss|loss-factor"),
     .help =
         "what isotherms are shifted by and the spectrum is fitted to: both moduli (or what was "
         "measured of all isotherms), one of them, or the loss factor, which tells no level"},
};
PARAM_TABLE(wt_master_options_params, wt_master_options, rows, wt_master_options_defaults, NO_PARTS)

/* ---- start ----------------------------------------------------------------------------------- */

/* tan delta knows no vertical shift, and one modulus does not tell it from the horizontal one. */
wt_status master_check_vertical(master_work *work, wt_error *err)
{
    if (work->set.by == WT_BY_LOSS_FACTOR)
        work->options.vertical = WT_VERTICAL_NONE;
    /* its retardation times are those of a solid; what flows is one with a small modulus */
    work->flows = work->set.loading == WT_CREEP && work->options.liquid;
    work->options.liquid = work->options.liquid && !work->flows;
    if (work->set.by == WT_BY_MODULI || work->options.vertical != WT_VERTICAL_FREE)
        return WT_OK;
    wt_fail(err, WT_E_ARG, "one modulus alone does not tell free vertical shifts");
    wt_error_place(err, "vertical-shift");
    wt_error_expected(err, "tied, physical or none");
    return WT_E_ARG;
}

/* The isotherm to start from: nearest to the reference temperature, or the one in the middle. */
wt_status master_choose_anchor(master_work *work, wt_error *err)
{
    const shift_set *set = &work->set;
    const double asked = work->options.reference_temperature;
    double nearest = HUGE_VAL;
    bool given = false; /* then the anchor is one of these */
    work->anchor = set->n;
    for (size_t i = 0; i < set->n; i++)
        given = given || (set->curves[i].given && set->curves[i].n >= SHIFT_MIN_POINTS);
    for (size_t i = 0; i < set->n; i++) {
        const double away = isnan(asked) ? fabs((double)i - (double)(set->n / 2))
                                         : fabs(set->curves[i].temperature - asked);
        if (set->curves[i].n >= SHIFT_MIN_POINTS && (!given || set->curves[i].given) &&
            away < nearest) {
            nearest = away;
            work->anchor = i;
        }
    }
    if (work->anchor == set->n) {
        wt_fail(err, WT_E_MISSING, "no isotherm has enough points");
        wt_error_expected(err, "at least %d points each", SHIFT_MIN_POINTS);
        return WT_E_MISSING;
    }
    const double at = set->curves[work->anchor].temperature;
    work->reference = isnan(asked) ? at : asked;
    work->measured_reference = fabs(at - work->reference) <= same_temperature;
    work->vertical.reference_temperature = work->reference;
    work->vertical.expansion = work->options.expansion;
    for (size_t i = 0; i < set->n; i++)
        work->physical[i] = vertical_physical(&work->vertical, set->curves[i].temperature) / M_LN10;
    return WT_OK;
}

wt_status master_work_alloc(master_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    arena *m = &work->memory;
    work->placed = arena_alloc(m, n, sizeof *work->placed);
    work->a = arena_numbers(m, n);
    work->b = arena_numbers(m, n);
    work->physical = arena_numbers(m, n);
    work->overlap = arena_numbers(m, n);
    vertical_make_room(m, n, &work->vertical);
    work->link = arena_alloc(m, n, sizeof *work->link);
    work->own_a = arena_numbers(m, n);
    work->posterior = posterior_new();
    if (work->posterior != NULL) {
        work->posterior->curve = arena_alloc(&work->posterior->memory, n, sizeof(size_t));
        work->posterior->closed_form = arena_numbers(&work->posterior->memory, n);
        work->curve = work->posterior->curve;
        work->s = &work->posterior->frame;
    }
    return m->failed || work->posterior == NULL || work->posterior->memory.failed
               ? wt_fail(err, WT_E_MEMORY, "no memory for %zu isotherms", n)
               : WT_OK;
}

wt_status master_set_widths(master_work *work, wt_vertical_shift kind, double geometry,
                            double departure, wt_error *err)
{
    work->vertical.geometry = geometry;
    work->vertical.departure = departure;
    wt_status status = vertical_prior(&work->vertical, kind, work->posterior->temperature, work->s,
                                      &work->prior, err);
    if (status == WT_OK)
        spectrum_set_prior(work->s, &work->prior);
    return status;
}

/* A spectrum for the placed curves, and what the posterior keeps of each. */
wt_status master_make_spectrum(master_work *work, wt_error *err)
{
    wt_posterior *p = work->posterior;
    const size_t evaluations = work->s->evaluations;
    spectrum_free(work->s);
    wt_status status = spectrum_new(&work->set, work->placed, work->anchor, work->a, work->b,
                                    work->terms_per_decade, work->options.liquid, work->s, err);
    work->s->evaluations = evaluations;
    if (status != WT_OK)
        return status;
    const size_t n = work->s->n_curves;
    arena *m = &work->s->memory; /* these go with the spectrum */
    p->temperature = arena_numbers(m, n);
    p->mean_b = arena_numbers(m, n);
    p->slope = arena_numbers(m, n);
    p->scratch = arena_numbers(m, 7 * n + 4 * work->s->n_linear);
    p->with_all = arena_numbers(m, 3 * n + work->s->n_linear);
    if (m->failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu isotherms", n);
    work->vertical.mean = p->mean_b;
    size_t curve = 0;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i]) {
            p->temperature[curve] = work->set.curves[i].temperature;
            work->curve[i] = curve++;
        }
    return master_set_widths(work, work->options.vertical, start_geometry, start_departure, err);
}

/* Without the points that are far off. */
static wt_status leave_out(master_work *work, wt_error *err)
{
    wt_status status = WT_OK;
    for (int round = 0; status == WT_OK && round < MOST_ROUNDS; round++) {
        const size_t changed = spectrum_outliers(work->s);
        if (round > 0 && changed == 0)
            break;
        status = spectrum_fit(work->s, SPECTRUM_ROUGH, err);
    }
    return status;
}

/* First with heavy tails. */
wt_status master_fit_robust(master_work *work, wt_error *err)
{
    const wt_status status = spectrum_fit(work->s, SPECTRUM_ROBUST, err);
    return status == WT_OK ? leave_out(work, err) : status;
}

/* Takes the shifts over; how far one has moved. */
static double take_shifts(master_work *work)
{
    double most = 0.0;
    for (size_t i = 0; i < work->set.n; i++) {
        if (!work->placed[i])
            continue;
        const double a = spectrum_a(work->s, work->curve[i]) / M_LN10;
        most = fmax(most, fabs(a - work->a[i]));
        work->a[i] = a;
        work->b[i] = spectrum_b(work->s, work->curve[i]) / M_LN10;
    }
    return most;
}

/* Whether lines leave less noise of a modulus. The standard error of the logarithm of their ratio:
 * by what the parameters that lines have more take from it by chance. */
static bool leave_less(const spectrum *lines, const spectrum *s, int q)
{
    const double less = log(s->noise[q] / lines->noise[q]);
    const double left = spectrum_squares(lines, q) / (lines->noise[q] * lines->noise[q]);
    const double more = fmax(lines->freedom[q] - s->freedom[q], 0.0);
    return s->used[q] && less > log(more_noise) && less * left > surely * sqrt(more / 2.0);
}

/* Whether more terms leave less noise, as lines and with the vertical shifts as they are. */
static wt_status try_lines(const master_work *work, bool *better, wt_error *err)
{
    const spectrum *s = work->s;
    spectrum lines;
    wt_status status = spectrum_new(&work->set, work->placed, work->anchor, work->a, work->b,
                                    trial_terms, work->options.liquid, &lines, err);
    if (status != WT_OK)
        return status;
    double *b = arena_numbers(&lines.memory, s->n_curves);
    const spectrum_prior held = {.held = true, .mean = b};
    if (b == NULL)
        status = wt_fail(err, WT_E_MEMORY, "no memory for a spectrum");
    for (size_t i = 0; i < s->n_curves && status == WT_OK; i++)
        b[i] = spectrum_b(s, i);
    if (status == WT_OK) {
        spectrum_set_prior(&lines, &held);
        lines.smooth = lines_smooth;
        for (int q = 0; q < MODULI; q++) {
            memcpy(lines.weight[q], s->weight[q], s->n * sizeof *s->weight[q]);
            lines.noise[q] = s->noise[q];
        }
        status = spectrum_fit(&lines, SPECTRUM_TRIAL, err);
        if (status == WT_OK)
            (void)spectrum_noise_update(&lines, 1.0);
    }
    for (int q = 0; q < MODULI && status == WT_OK; q++)
        *better |= leave_less(&lines, s, q);
    work->s->evaluations += lines.evaluations;
    spectrum_free(&lines);
    return status;
}

/* Whether more terms are needed: few of them either bend, or take lines for noise. */
static wt_status needs_lines(master_work *work, bool *better, wt_error *err)
{
    *better = work->s->smooth > sharp;
    wt_error no_lines = WT_ERROR_INIT; /* a trial without an answer is no reason to give none */
    (void)take_shifts(work);
    if (!*better && try_lines(work, better, &no_lines) == WT_E_MEMORY)
        return wt_fail(err, WT_E_MEMORY, "%s", no_lines.message);
    return WT_OK;
}

static wt_status sharpen_spectrum(master_work *work, wt_error *err)
{
    bool better = false;
    wt_status lines = needs_lines(work, &better, err);
    if (lines != WT_OK || !better)
        return lines;
    work->lines = true;
    work->terms_per_decade = sharp_terms;
    const wt_status status = master_make_spectrum(work, err);
    work->s->smooth = lines_smooth;
    return status == WT_OK ? master_fit_robust(work, err) : status;
}

/* How far the fit is from what is within the isotherms. */
wt_status master_measure_misfit(master_work *work, wt_error *err)
{
    double all[MODULI], within[MODULI];
    const wt_status status = spectrum_misses(work->s, all, within, err);
    work->gross = work->louder = false;
    for (int q = 0; status == WT_OK && q < MODULI; q++) {
        const double missed = all[q] * all[q] - within[q] * within[q];
        const bool gross = missed > gross_misfit * gross_misfit;
        work->gross = work->gross || gross;
        work->louder = work->louder || (gross && missed > within[q] * within[q]);
        work->missed[q] = sqrt(fmax(missed, 0.0));
    }
    return status;
}

/* Where one spectrum is far off it may have begun in a wrong place: the overlaps of the storage
 * modulus alone are another one. Sharp lines are far off, too, until there are terms for them. */
static wt_status start_again(master_work *work, wt_error *err)
{
    bool lines = false;
    wt_status status = master_measure_misfit(work, err);
    if (status != WT_OK || !work->gross)
        return status;
    if (isnan(work->options.terms_per_decade))
        status = needs_lines(work, &lines, err);
    if (status != WT_OK || lines || !work->set.used[STORAGE]) {
        work->gross = work->gross && !lines;
        return status;
    }
    status = master_overlaps(work, err);
    for (size_t i = 0; status == WT_OK && i < work->set.n; i++)
        if (work->link[i].placed && !work->set.curves[i].given) {
            work->placed[i] = true;
            work->a[i] = work->link[i].a;
        }
    (void)spectrum_connected(&work->set, work->anchor, work->a, work->placed, work->overlap);
    if (status == WT_OK)
        status = master_make_spectrum(work, err);
    if (status == WT_OK)
        status = spectrum_fit(work->s, SPECTRUM_ROBUST, err);
    return status == WT_OK ? master_measure_misfit(work, err) : status;
}

wt_status master_place(master_work *work, wt_error *err)
{
    const double asked = work->options.terms_per_decade;
    wt_status status = WT_OK;
    work->gross = false;
    work->terms_per_decade = isnan(asked) ? smooth_terms : asked;
    spectrum_start(&work->set, work->anchor, work->options.vertical, work->physical, work->placed,
                   work->a, work->b);
    for (size_t i = 0; work->part && i < work->set.n; i++)
        work->placed[i] = work->placed[i] && i >= work->first && i <= work->last;
    for (int round = 0; status == WT_OK && round < MOST_ROUNDS; round++) {
        const size_t before = work->s->n_curves;
        const double moved = round > 0 ? take_shifts(work) : 0.0;
        const size_t n =
            spectrum_connected(&work->set, work->anchor, work->a, work->placed, work->overlap);
        if (round > 0 && n == before && moved < far)
            break;
        status = master_make_spectrum(work, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_ROBUST, err);
        if (status == WT_OK && round == 0 && !work->part && !work->plain)
            status = start_again(work, err);
        if (work->gross)
            break;
        if (status == WT_OK)
            status = leave_out(work, err);
    }
    if (status == WT_OK && isnan(asked) && !work->gross)
        status = sharpen_spectrum(work, err);
    if (status == WT_OK && work->s->n_curves < 2 && work->set.n > 1) {
        status = wt_fail(err, WT_E_NO_OVERLAP, "no isotherm overlaps the one of %.2f °C",
                         work->set.curves[work->anchor].temperature - WT_ZERO_CELSIUS);
        wt_error_expected(err, "neighbouring isotherms that share a range of storage modulus");
        wt_error_advice(err, "measure at smaller steps of temperature or over more frequencies");
    }
    return status;
}

/* ---- the fits -------------------------------------------------------------------------------- */

/* Noise factors by what is within the isotherms; where the spectrum bends; correlation by the fit,
 * so that what a spectrum misses a little counts as noise. */
wt_status master_find_noise(master_work *work, wt_error *err)
{
    wt_status status = spectrum_noise_within(work->s, &work->within, err);
    spectrum_spread(work->s, master_even);
    for (int round = 0; status == WT_OK && round < BEND_ROUNDS; round++) {
        status = spectrum_fit(work->s, SPECTRUM_ROUGH, err);
        if (status == WT_OK && round + 1 < BEND_ROUNDS)
            spectrum_bends(work->s);
    }
    return status == WT_OK ? spectrum_choose_rho(work->s, err) : status;
}

/* With free vertical shifts, so that those are no part of the verdict, and with the noise as it is
 * along the isotherms: the fit takes it as even, for a misfit at their ends is no reason to believe
 * them less. */
wt_status master_test(master_work *work, wt_error *err)
{
    if (work->s->n_curves < 2 || work->set.by != WT_BY_MODULI)
        return WT_OK;
    spectrum *s = work->s;
    /* also where nobody asks, if what superposition fails by may be in the shifts */
    work->tested = !work->options.series_only || work->part ||
                   fmax(work->missed[STORAGE], work->missed[LOSS]) > may_move;
    const double rho = s->rho;
    wt_status status = master_set_widths(work, WT_VERTICAL_FREE, 0.0, 0.0, err);
    s->rho = work->within.rho;
    spectrum_spread(s, work->within.shape);
    if (status == WT_OK)
        status = spectrum_fit(s, work->gross ? SPECTRUM_ROUGH : SPECTRUM_NOISE, err);
    if (status == WT_OK && work->tested)
        status = superposition_test(s, work->within.uncertainty, &work->lack, err);
    s->rho = rho;
    spectrum_spread(s, master_even);
    if (status == WT_OK) /* the columns as the cells have them */
        status =
            master_set_widths(work, work->options.vertical, start_geometry, start_departure, err);
    return status;
}
