/* Steps of the master curve fit: start, outliers, connected isotherms, noise and the test of
 * superposition.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/param.h"
#include "core/math/arena_gsl.h"
#include "dma/numerics/isotherm.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Initial widths of the prior of the vertical shift [decade]: clamping and departure of the
 * material (master_widths.c). */
static const double start_geometry = 0.002, start_departure = 0.02;
/* Maximum number of refits after outliers or curvature weights change. Later refits change
 * little. */
enum { MOST_ROUNDS = 4, BEND_ROUNDS = 3 };

/* An isotherm this close to the reference temperature is the reference [K], as thermometers and
 * chambers agree. */
static const double same_temperature = 0.1;
/* The fit restarts if a shift moved this far from its start [decade]. The relaxation times
 * extend 1.5 decades beyond the isotherms, and one decade shall remain. */
static const double max_start_shift = 0.5;
/* Terms per decade of a smooth spectrum, of a trial and of a line spectrum. E'' of equal terms h
 * apart in ln tau ripples by 2/cosh(pi^2/h): 1e-5 at 3 per decade, 8e-4 at 2, 5 % at 1. At 10
 * per decade a line is within a factor 1.12 of a term. A trial costs an eighth of that; E'' of
 * terms beyond its margin [decade] is known from those within to 1e-3. Above
 * the curvature limit [ln] a spectrum is not smooth. Moduli resolve slopes up to 1, because
 * steeper ones hide under the flanks of a Maxwell element. A corner between two such slopes has
 * curvature 1.5 at 3 per decade; the limit is twice that. Lines between the terms then shift the
 * isotherms by more than their errors. */
static const double smooth_terms = 3.0, trial_terms = 5.0, trial_margin = 1.5, sharp_terms = 10.0,
                    sharp_curvature = 3.0;
/* Misfit of a modulus beyond its noise from which the shifts are meaningless [ln]. On a plateau
 * with d ln E'/d ln w = 0.1 it is 0.17 decade, about master_max_shift_error. If
 * superposition holds or nearly holds the misfit is 0.3 to 3 %; glassy polymers have 5 to 20 %
 * of E''. Below the limit the shift errors grow with the misfit (master_overlap.c), so only the
 * route changes abruptly. */
static const double gross_misfit = 0.04;
/* Misfit from which the shifts may be affected [ln]: 0.04 decade, twice the error from 1 % of
 * noise. */
static const double shift_relevant_misfit = 0.01;
/* Initial curvature scale of lines: a factor 150 between terms. The noise must fall by the
 * factor noise_ratio_limit and by six standard errors, one false alarm in 1e9 for normal noise. At
 * the factor 1.3 lines between terms add 69 % to the square of the noise: a smaller misfit is below
 * 0.83 of the noise and moves no shift by more than its error. */
static const double lines_smooth = 5.0, noise_ratio_limit = 1.3, noise_significance = 6.0;
/* Lines are fitted if a step towards them may leave less than this share of the squares. If they
 * reduce the noise of one of two moduli by noise_ratio_limit they leave 0.8. */
static const double most_promising = 0.9;

/* [K]; between the tolerances of platinum thermometers (0.15 K, IEC 60751) and of thermocouples
 * (1.5 K, IEC 60584), which are placed beside the sample. */
static const double assumed_temperature_error = 0.5;

wt_master_options wt_master_options_defaults(void)
{
    return (wt_master_options){.reference_temperature = (double)NAN,
                               .vertical = WT_VERTICAL_TIED,
                               .sample_temperature_error = assumed_temperature_error,
                               .terms_per_decade = (double)NAN};
}

static const wt_param rows[] = {
    {PARAM("reference-temperature", wt_master_options, reference_temperature, WT_Q_TEMPERATURE,
           ABOVE(0)),
     .value = "T", .unset = "the isotherm in the middle",
     .help = SUCH_AS("reference temperature, ", "20degC", "; it need not be one of the isotherms")},
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
    {PARAM("sample-temperature-error", wt_master_options, sample_temperature_error,
           WT_Q_TEMPERATURE_DIFFERENCE, FROM_TO(0, 20)),
     .value = "DT",
     .help =
         SUCH_AS("standard error of the temperature of the DMA sample against the stated one, the "
                 "same for all isotherms, ",
                 "0.2K", "; friction and layer contain it")},
    {PARAM("terms-per-decade", wt_master_options, terms_per_decade, WT_Q_NONE, FROM_TO(2, 10)),
     .value = "X", .unset = "as the spectrum needs: 3, or 10 of sharp lines",
     .help = "of the relaxation spectrum"},
    {PARAM_FLAG_OF("liquid", wt_master_options, liquid), .help = "no equilibrium modulus"},
    {PARAM_CHOICE_OF("shift-by", wt_master_options, shift_by, "moduli|storage|loss|loss-factor"),
     .help = "data that determine the shifts and the spectrum: both moduli (or what was measured "
             "of all isotherms), one of them, or the loss factor, which does not determine the "
             "level of the moduli"},
};
PARAM_TABLE(wt_master_options_params, wt_master_options, rows, wt_master_options_defaults, NO_PARTS)

/* ---- start ----------------------------------------------------------------------------------- */

/* Adapts the vertical shift to the data. tan delta has none, and one modulus does not separate
 * it from the horizontal shift. */
wt_status master_check_vertical(master_work *work, wt_error *err)
{
    if (work->set.quantity == WT_SHIFT_LOSS_FACTOR)
        work->options.vertical = WT_VERTICAL_NONE;
    /* the model of creep is a solid; a liquid gets a small equilibrium modulus */
    work->flows = work->set.loading == WT_CREEP && work->options.liquid;
    work->options.liquid = work->options.liquid && !work->flows;
    if (work->set.quantity == WT_SHIFT_MODULI || work->options.vertical != WT_VERTICAL_FREE)
        return WT_OK;
    wt_fail(err, WT_E_ARG, "one modulus alone does not determine free vertical shifts");
    wt_error_place(err, "vertical-shift");
    wt_error_expected(err, "tied, physical or none");
    return WT_E_ARG;
}

/* Returns the distance of an isotherm from the place where the fit starts. */
static double distance_to_start(const master_work *work, size_t i, bool stated, double base)
{
    const double asked = work->options.reference_temperature;
    if (stated && !isnan(asked))
        return fabs(work->set.curves[i].temperature - asked);
    return isnan(base) ? fabs((double)i - (double)(work->set.n / 2))
                       : fabs(work->set.curves[i].temperature - base);
}

/* Sets the reference temperature and finds its isotherm. */
static void set_reference(master_work *work)
{
    const shift_set *set = &work->set;
    const double asked = work->options.reference_temperature;
    double nearest = same_temperature;
    work->reference = isnan(asked) ? set->curves[work->anchor].temperature : asked;
    work->at = isnan(asked) ? work->anchor : set->n;
    work->root = work->anchor;
    for (size_t i = 0; !isnan(asked) && i < set->n; i++) {
        const double away = fabs(set->curves[i].temperature - asked);
        if (set->curves[i].n >= SHIFT_MIN_POINTS && away <= nearest &&
            (work->at == set->n || away < nearest)) {
            nearest = away;
            work->at = i;
        }
    }
    work->vertical.reference_temperature = work->reference;
    work->vertical.expansion = work->options.expansion;
    for (size_t i = 0; i < set->n; i++)
        work->physical[i] = vertical_physical(&work->vertical, set->curves[i].temperature) / M_LN10;
}

wt_status master_hold_hand_shifts(master_work *work, double base, wt_error *err)
{
    const size_t n = work->set.n;
    size_t n_by_hand = 0, nearest = n;
    for (size_t i = 0; i < n; i++) {
        n_by_hand += work->set.curves[i].origin == WT_SHIFT_BY_HAND;
        if (work->set.curves[i].n >= SHIFT_MIN_POINTS &&
            (nearest == n ||
             distance_to_start(work, i, true, base) < distance_to_start(work, nearest, true, base)))
            nearest = i;
    }
    if (n_by_hand == 0 || nearest == n)
        return WT_OK;
    shift_curve *const held = &work->set.curves[nearest];
    if (held->origin == WT_SHIFT_BY_HAND) {
        wt_fail(err, WT_E_ARG, "the isotherm at the reference temperature has no shift of its own");
        wt_error_place(err, "shift");
        wt_error_found(err, "%.2f degC", held->temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "shift the others, or give another --reference-temperature");
        wt_error_options(err, "reference-temperature");
        return WT_E_ARG;
    }
    if (!held->is_shift_fixed) {
        held->is_shift_fixed = true;
        held->origin = WT_SHIFT_REFERENCE;
    }
    for (size_t i = 0; i < n; i++)
        if (work->set.curves[i].origin == WT_SHIFT_BY_HAND)
            work->set.curves[i].fixed_log_a += held->fixed_log_a;
    return WT_OK;
}

wt_status master_choose_anchor(master_work *work, double base, wt_error *err)
{
    const shift_set *set = &work->set;
    double nearest = HUGE_VAL;
    bool stated = false; /* the anchor is then a stated isotherm */
    work->anchor = set->n;
    for (size_t i = 0; i < set->n; i++)
        stated = stated || (set->curves[i].is_shift_fixed && set->curves[i].n >= SHIFT_MIN_POINTS);
    for (size_t i = 0; i < set->n; i++) {
        const double away = distance_to_start(work, i, stated, base);
        if (set->curves[i].n >= SHIFT_MIN_POINTS && (!stated || set->curves[i].is_shift_fixed) &&
            away < nearest) {
            nearest = away;
            work->anchor = i;
        }
    }
    if (work->anchor < set->n) {
        set_reference(work);
        return WT_OK;
    }
    wt_fail(err, WT_E_MISSING, "no isotherm has enough points");
    wt_error_expected(err, "at least %d points each", SHIFT_MIN_POINTS);
    return WT_E_MISSING;
}

void master_work_alloc(master_work *work)
{
    const size_t n = work->set.n;
    arena *m = &work->memory;
    work->placed = arena_alloc(m, n, sizeof *work->placed);
    work->a = arena_numbers(m, n);
    work->b = arena_numbers(m, n);
    work->physical = arena_numbers(m, n);
    work->overlap = arena_numbers(m, n);
    vertical_alloc(m, n, &work->vertical);
    work->edge = arena_alloc(m, n, sizeof *work->edge);
    work->original_a = arena_numbers(m, n);
    wt_posterior *const p = work->posterior = wt_alloc(1, sizeof *p);
    work->curve = p->curve = arena_alloc(&p->memory, n, sizeof *p->curve);
    p->closed_form = arena_numbers(&p->memory, n);
    work->s = &p->frame;
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

/* Creates a spectrum for the placed curves at their present shifts, without outliers, and the
 * arrays of the posterior for each curve. */
static wt_status new_spectrum(master_work *work, wt_error *err)
{
    wt_posterior *p = work->posterior;
    const size_t evaluations = work->s->evaluations;
    spectrum_free(work->s);
    wt_status status =
        spectrum_new(&work->set, work->placed, work->anchor, work->a, work->b,
                     work->terms_per_decade, HUGE_VAL, work->options.liquid, work->s, err);
    work->s->evaluations = evaluations;
    if (status != WT_OK)
        return status;
    const size_t n = work->s->n_curves;
    arena *m = &work->s->memory; /* freed with the spectrum */
    p->temperature = arena_numbers(m, n);
    p->mean_b = arena_numbers(m, n);
    p->slope = arena_numbers(m, n);
    p->scratch = arena_numbers(m, 9 * n + 4 * work->s->n_shared);
    p->border = arena_numbers(m, work->s->n_shared + SPECTRUM_MAX_SMOOTH);
    p->side = arena_numbers(m, BLOCK_SIDE * n);
    work->vertical.mean = p->mean_b;
    size_t curve = 0;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i]) {
            p->temperature[curve] = work->set.curves[i].temperature;
            work->curve[i] = curve++;
        }
    if (master_reference_is_fitted(work)) /* free vertical shifts are those against it */
        work->s->level_curve = work->curve[work->at];
    return master_set_widths(work, work->options.vertical, start_geometry, start_departure, err);
}

/* Refits without outliers until their set is stable. */
static wt_status exclude_outliers(master_work *work, wt_error *err)
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

/* Fits with a heavy-tailed noise distribution, then without outliers. */
static wt_status fit_robust(master_work *work, wt_error *err)
{
    const wt_status status = spectrum_fit(work->s, SPECTRUM_ROBUST, err);
    return status == WT_OK ? exclude_outliers(work, err) : status;
}

/* Stores the fitted shifts and returns the largest change [decade]. */
static double store_fitted_shifts(master_work *work)
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

/* Returns true if a line spectrum reduces the noise of a modulus significantly. The standard
 * error of the log ratio follows from the additional parameters. */
static bool lines_reduce_noise(const spectrum *lines, const spectrum *s, int q)
{
    const double less = log(s->noise[q] / lines->noise[q]);
    const double left = spectrum_squares(lines, q) / (lines->noise[q] * lines->noise[q]);
    const double more = fmax(lines->freedom[q] - s->freedom[q], 0.0);
    return s->used[q] && less > log(noise_ratio_limit) &&
           less * left > noise_significance * sqrt(more / 2.0);
}

/* Returns true if a line spectrum with fixed vertical shifts reduces the noise. A failed fit is no
 * failure of the caller. */
static bool try_line_spectrum(const master_work *work)
{
    const spectrum *s = work->s;
    spectrum lines;
    double squares = 0.0;
    bool better = false;
    if (spectrum_new(&work->set, work->placed, work->anchor, work->a, work->b, trial_terms,
                     trial_margin, work->options.liquid, &lines, NULL) != WT_OK)
        return false;
    double *b = arena_numbers(&lines.memory, s->n_curves);
    const spectrum_prior held = {.held = true, .mean = b};
    for (size_t i = 0; i < s->n_curves; i++)
        b[i] = spectrum_b(s, i);
    spectrum_set_prior(&lines, &held);
    lines.smoothness = lines_smooth;
    for (int q = 0; q < MODULI; q++) {
        memcpy(lines.weight[q], s->weight[q], s->n * sizeof *s->weight[q]);
        lines.noise[q] = s->noise[q];
        squares += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
    }
    spectrum_keep(&lines);
    spectrum_start_from(&lines, s);
    const bool promising = spectrum_expected_objective(&lines) < most_promising * squares;
    spectrum_return(&lines);
    if (promising && spectrum_fit(&lines, SPECTRUM_TRIAL, NULL) == WT_OK) {
        (void)spectrum_noise_update(&lines, 1.0, 0.0);
        for (int q = 0; q < MODULI; q++)
            better = better || lines_reduce_noise(&lines, s, q);
    }
    work->s->evaluations += lines.evaluations;
    spectrum_free(&lines);
    return better;
}

/* Returns true if more terms are needed, because the spectrum has sharp curvature or lines reduce
 * the noise. */
static bool needs_line_spectrum(master_work *work)
{
    (void)store_fitted_shifts(work);
    return work->s->smoothness > sharp_curvature || try_line_spectrum(work);
}

static wt_status refine_line_spectrum(master_work *work, wt_error *err)
{
    if (!needs_line_spectrum(work))
        return WT_OK;
    work->lines = true;
    work->terms_per_decade = sharp_terms;
    const wt_status status = new_spectrum(work, err);
    work->s->smoothness = lines_smooth;
    return status == WT_OK ? fit_robust(work, err) : status;
}

/* Measures the misfit beyond the noise within the isotherms. */
void master_measure_misfit(master_work *work)
{
    double all[MODULI], within[MODULI];
    spectrum_measure_misfit(work->s, all, within);
    work->is_gross = work->exceeds_noise = false;
    for (int q = 0; q < MODULI; q++) {
        const double missed = all[q] * all[q] - within[q] * within[q];
        const bool is_gross = missed > gross_misfit * gross_misfit;
        work->is_gross = work->is_gross || is_gross;
        work->exceeds_noise = work->exceeds_noise || (is_gross && missed > within[q] * within[q]);
        work->missed[q] = sqrt(fmax(missed, 0.0));
    }
}

wt_status master_find_initial_shifts(master_work *work, wt_error *err)
{
    const double asked = work->options.terms_per_decade;
    wt_status status = WT_OK;
    work->is_gross = false;
    work->terms_per_decade = isnan(asked) ? smooth_terms : asked;
    spectrum_find_initial_shifts(&work->set, work->anchor, work->options.vertical, work->physical,
                                 work->placed, work->a, work->b);
    for (size_t i = 0; work->part && i < work->set.n; i++)
        work->placed[i] = work->placed[i] && i >= work->first && i <= work->last;
    for (int round = 0; status == WT_OK && round < MOST_ROUNDS; round++) {
        const size_t before = work->s->n_curves;
        const double moved = round > 0 ? store_fitted_shifts(work) : 0.0;
        const size_t n = spectrum_select_connected(&work->set, work->anchor, work->a, work->placed,
                                                   work->overlap);
        if (round > 0 && n == before && moved < max_start_shift)
            break;
        status = new_spectrum(work, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_ROBUST, err);
        if (status == WT_OK && round == 0 && !work->part && !work->plain) {
            master_measure_misfit(work); /* that of a line spectrum is large with few terms */
            work->is_gross = work->is_gross && (!isnan(asked) || !needs_line_spectrum(work));
        }
        if (work->is_gross)
            break;
        if (status == WT_OK)
            status = exclude_outliers(work, err);
    }
    if (status == WT_OK && isnan(asked) && !work->is_gross)
        status = refine_line_spectrum(work, err);
    if (status == WT_OK && work->s->n_curves < 2 && work->set.n > 1) {
        status = wt_fail(err, WT_E_NO_OVERLAP, "no isotherm overlaps the one of %.2f °C",
                         work->set.curves[work->anchor].temperature - WT_ZERO_CELSIUS);
        wt_error_expected(err, "neighbouring isotherms that share a range of storage modulus");
        wt_error_advice(err, "measure at smaller steps of temperature or over more frequencies");
    }
    return status;
}

/* ---- the fits -------------------------------------------------------------------------------- */

/* Estimates noise factors within the isotherms, then curvature weights, then correlation by the
 * fit. A small misfit of the spectrum therefore counts as noise. */
wt_status master_estimate_noise(master_work *work, wt_error *err)
{
    wt_status status = WT_OK;
    work->within = spectrum_estimate_noise(work->s);
    spectrum_set_point_noise(work->s, NULL);
    for (int round = 0; status == WT_OK && round < BEND_ROUNDS; round++) {
        status = spectrum_fit(work->s, SPECTRUM_ROUGH, err);
        if (status == WT_OK && round + 1 < BEND_ROUNDS)
            spectrum_update_curvature(work->s);
    }
    return status == WT_OK ? spectrum_choose_rho(work->s, err) : status;
}

/* Tests superposition with free vertical shifts, which the verdict excludes. The noise follows
 * the shape along the isotherms. The fit uses uniform noise, because a misfit at the ends does not
 * reduce their weight. */
wt_status master_test_superposition(master_work *work, wt_error *err)
{
    spectrum *s = work->s;
    spectrum_keep(s); /* the widths start from it */
    if (s->n_curves < 2 || work->set.quantity != WT_SHIFT_MODULI)
        return WT_OK;
    /* also tested without a request if the misfit may affect the shifts */
    work->tested = !work->options.series_only || work->part ||
                   fmax(work->missed[STORAGE], work->missed[LOSS]) > shift_relevant_misfit;
    if (!work->tested)
        return WT_OK;
    wt_status status = master_set_widths(work, WT_VERTICAL_FREE, 0.0, 0.0, err);
    s->rho = work->within.rho;
    spectrum_set_point_noise(s, work->within.shape);
    if (status == WT_OK)
        status = spectrum_fit(s, SPECTRUM_ROUGH, err);
    if (status == WT_OK)
        status = spectrum_refresh(s, err);
    if (status == WT_OK) { /* the rough fit and a step serve as a full fit */
        spectrum_step_residuals(s);
        work->lack = superposition_test(s, work->within.uncertainty);
    }
    s->rho = s->kept_rho;
    spectrum_set_point_noise(s, NULL);
    if (status == WT_OK) /* restores the columns that the cells use */
        status =
            master_set_widths(work, work->options.vertical, start_geometry, start_departure, err);
    return status;
}

wt_status master_use_overlap_shifts(master_work *work, wt_error *err)
{
    const bool physical = work->options.vertical == WT_VERTICAL_PHYSICAL;
    shift_set *set = &work->set;
    for (size_t i = 0; i < set->n; i++) {
        work->placed[i] = work->edge[i].placed;
        work->a[i] = work->placed[i] ? work->edge[i].a : 0.0;
        work->b[i] = physical ? work->physical[i] : 0.0;
    }
    (void)spectrum_select_connected(set, work->anchor, work->a, work->placed, work->overlap);
    if (master_reference_is_fitted(work))
        (void)spectrum_select_connected(set, work->at, work->a, work->placed, work->overlap);
    for (size_t i = 0; i < set->n; i++) {
        set->curves[i].is_shift_fixed = work->placed[i];
        set->curves[i].fixed_log_a = work->a[i];
    }
    set->without_instrument = true; /* they would take up part of the misfit */
    work->route = WT_SHIFTS_FROM_OVERLAP;
    work->options.vertical = physical ? WT_VERTICAL_PHYSICAL : WT_VERTICAL_NONE;
    work->lines = false;
    const wt_status status = new_spectrum(work, err);
    if (status != WT_OK)
        return status;
    master_set_shift_errors(work);
    return fit_robust(work, err);
}
