/* Route to the master curve: reference temperature, one spectrum of all isotherms or of a part, or
 * one at the shifts of the overlaps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/param.h"
#include "core/base/text.h"
#include "core/math/root.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- routes ---------------------------------------------------------------------------------- */

/* Tests if one spectrum describes the isotherms from `first` to `last`. It fails without
 * convergence, with too large a span, missing overlap or too few isotherms. */
static wt_status test_part(const master_work *whole, size_t first, size_t last, bool *holds,
                           wt_error *err)
{
    master_work work = {.options = whole->options, .part = true, .set = whole->set};
    const double base = whole->set.curves[whole->anchor].temperature;
    work.options.reference_temperature = whole->reference;
    work.set.curves += first;
    work.set.n = work.last = last - first + 1;
    *holds = false;
    master_work_alloc(&work);
    wt_status status = master_choose_anchor(&work, base, err);
    if (status == WT_OK)
        status = master_find_initial_shifts(&work, err);
    if (status == WT_OK)
        master_measure_misfit(&work);
    if (status == WT_OK && !work.is_gross && work.s->n_curves == work.set.n)
        status = master_estimate_noise(&work, err);
    if (status == WT_OK && !work.is_gross && work.s->n_curves == work.set.n)
        status = master_test_superposition(&work, err);
    if (status == WT_OK && work.tested && !master_misfit_is_significant(&work.lack))
        *holds = master_shifts_agree(&work);
    posterior_free(work.posterior);
    arena_free(&work.memory);
    const bool none = status == WT_E_CONVERGENCE || status == WT_E_RANGE ||
                      status == WT_E_NO_OVERLAP || status == WT_E_MISSING;
    return none ? WT_OK : status;
}

/* ---- part that one spectrum describes -------------------------------------------------------- */

/* Minimum number of isotherms with a law (shift_law.h). */
enum { LEAST_PART = LAW_MIN_ISOTHERMS };

/* Extends one end of the part as far as the test holds: first to the last isotherm, then by
 * bisection. */
static wt_status widen_part(master_work *work, bool warm, wt_error *err)
{
    size_t *const end = warm ? &work->last : &work->first;
    size_t steps =
        warm ? work->set.n - 1 - work->last : work->first; /* isotherms that may still be added */
    wt_status status = WT_OK;
    for (size_t tried = steps; status == WT_OK && steps > 0; tried = (steps + 1) / 2) {
        bool holds;
        const size_t next = warm ? *end + tried : *end - tried;
        status = test_part(work, warm ? work->first : next, warm ? next : work->last, &holds, err);
        if (status == WT_OK && holds) {
            *end = next;
            steps -= tried;
        } else {
            steps = tried - 1;
        }
    }
    return status;
}

/* Fits again from the isotherm nearest to `base` [K]. The reference stays. */
static wt_status move_anchor(master_work *work, double base, wt_error *err)
{
    work->options.reference_temperature = work->reference;
    const wt_status status = master_choose_anchor(work, base, err);
    if (status == WT_OK)
        closed_form_shifts(&work->set, work->anchor, work->posterior->closed_form);
    return status;
}

/* Finds the part that one spectrum describes. It starts around the anchor, and from there towards
 * the warm side, above the glass. The anchor then moves into the part. */
static wt_status find_describable_part(master_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    wt_status status = WT_OK;
    if (work->set.quantity != WT_SHIFT_MODULI || n <= LEAST_PART)
        return WT_OK;
    size_t first = work->anchor > 0 ? work->anchor - 1 : 0;
    do {
        work->first = first + LEAST_PART <= n ? first : n - LEAST_PART;
        work->last = work->first + LEAST_PART - 1;
        status = test_part(work, work->first, work->last, &work->part, err);
        first += LEAST_PART - 1;
    } while (status == WT_OK && !work->part && work->last + 1 < n);
    if (status != WT_OK || !work->part)
        return status;
    status = widen_part(work, true, err);
    if (status == WT_OK)
        status = widen_part(work, false, err);
    if (status == WT_OK && (work->anchor < work->first || work->anchor > work->last)) {
        status =
            move_anchor(work, work->set.curves[(work->first + work->last) / 2].temperature, err);
        master_find_overlaps(work);
    }
    return status;
}

/* Fits without a restart. The gross misfit is measured only if the vertical shifts are not
 * fixed. */
static wt_status refit_without_restart(master_work *work, wt_error *err)
{
    work->plain = true;
    wt_status status = master_find_initial_shifts(work, err);
    if (status == WT_OK)
        status = master_estimate_noise(work, err);
    if (status == WT_OK && !work->prior.held)
        master_measure_misfit(work);
    return status == WT_OK ? master_test_superposition(work, err) : status;
}

/* Fits one spectrum with free shifts. */
static wt_status fit_free_shifts(master_work *work, wt_error *err)
{
    wt_status status = master_find_initial_shifts(work, err);
    if (status == WT_OK && work->is_gross) { /* fixed vertical shifts may cause the whole misfit */
        status = master_set_widths(work, WT_VERTICAL_FREE, 0.0, 0.0, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_ROUGH, err);
        if (status != WT_OK)
            return status;
        master_measure_misfit(work);
        if (!work->is_gross) /* without them the fit is good: start again */
            return refit_without_restart(work, err);
        work->within = spectrum_estimate_noise(work->s);
        spectrum_set_point_noise(work->s, NULL);
    } else if (status == WT_OK) {
        status = master_estimate_noise(work, err);
        if (status == WT_OK) /* a good start may have ended far off */
            master_measure_misfit(work);
    }
    return status == WT_OK ? master_test_superposition(work, err) : status;
}

/* Returns true if the misfit affects the shifts. Fixed vertical shifts or a factor on E'' do
 * not. */
static bool misfit_is_relevant(const master_work *work)
{
    const lack_of_fit *lack = &work->lack;
    return !work->tested || ((work->exceeds_noise || master_misfit_is_significant(lack)) &&
                             fabs(lack->factor) < fmax(work->missed[STORAGE], work->missed[LOSS]));
}

/* Fits again from the start. */
static wt_status refit(master_work *work, wt_error *err)
{
    work->plain = work->is_gross = work->exceeds_noise = work->tested = false;
    work->lack = (lack_of_fit){0};
    const wt_status status = move_anchor(work, work->set.curves[work->anchor].temperature, err);
    return status == WT_OK ? fit_free_shifts(work, err) : status;
}

/* Fits one spectrum, without what does not belong to the others if one isotherm has that. */
static wt_status fit_one_spectrum(master_work *work, wt_error *err)
{
    size_t i;
    wt_status status = fit_free_shifts(work, err);
    for (size_t k = 0; k < work->set.n; k++)
        if (work->set.curves[k].is_shift_fixed)
            return status; /* stated shifts may cause the misfit */
    if (status != WT_OK || work->set.loading != WT_OSCILLATION || work->options.keep_isotherms)
        return status;
    if (master_find_unit_slip(work, &i)) {
        work->set.n_points -= work->set.curves[i].n;
        work->set.curves[i].n = 0;
        status = refit(work, err);
    }
    if (status != WT_OK || !work->tested || !master_misfits(work) ||
        !master_find_objecting(work, &i))
        return status;
    shift_curve *const curve = &work->set.curves[i];
    curve->is_loss_excluded = true;
    status = refit(work, err);
    if (status != WT_OK || !master_misfits(work))
        return status;
    curve->is_loss_excluded = false; /* the others do not superpose either */
    curve->exclusion[0] = '\0';
    return refit(work, err);
}

/* Fits one spectrum. If it fails or is far off, the function fits a part around the anchor, or else
 * a spectrum at the overlap shifts. */
static wt_status fit_by_best_route(master_work *work, wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    wt_status status = fit_one_spectrum(work, &failure);
    if (status == WT_E_CONVERGENCE)
        snprintf(work->no_spectrum, sizeof work->no_spectrum, "%s", failure.message);
    bool overlap = false;
    if (work->no_spectrum[0] != '\0' ||
        (status == WT_OK && work->is_gross && misfit_is_relevant(work)))
        overlap = master_can_use_overlaps(work);
    if (!overlap && status == WT_OK && work->is_gross)
        status = refit_without_restart(work, &failure);
    if (!overlap && status == WT_OK && work->tested && master_misfit_is_likely(&work->lack) &&
        work->set.used[STORAGE])
        master_uncertainty(work);
    if (!overlap && status == WT_OK && master_misfit_is_significant(&work->lack) &&
        master_all_uncertain(work))
        overlap = master_can_use_overlaps(work);
    if (!overlap) {
        if (status != WT_OK && err != NULL)
            *err = failure;
        return status;
    }
    master_store_original_shifts(work);
    work->posterior->extra_error = NULL; /* belonged to the spectrum of all isotherms */
    work->posterior->extra_covariance = NULL;
    status = find_describable_part(work, err);
    if (status == WT_OK && work->part) {
        work->whole = work->lack;
        memcpy(work->missed_whole, work->missed, sizeof work->missed);
        return fit_free_shifts(work, err);
    }
    if (status == WT_OK)
        status = master_use_overlap_shifts(work, err);
    return status == WT_OK ? master_estimate_noise(work, err) : status;
}

/* Fits from the isotherm nearest to `*base`, or from the middle one. *base: after a lack of
 * overlap, the temperature of a steeper isotherm; otherwise NaN. */
static wt_status master_fit_once(const wt_sweep *sweep, const wt_master_options *options,
                                 wt_log *log, wt_master *master, double *base, wt_error *err)
{
    master_work work = {.options = *options};
    wt_status status = param_check(wt_master_options_params(), &work.options, err);
    if (status == WT_OK)
        status = shift_set_new(sweep, &work.options, log, &work.memory, &work.set, err);
    if (status == WT_OK)
        status = master_check_vertical(&work, err);
    if (status == WT_OK) {
        master_work_alloc(&work);
        status = master_hold_hand_shifts(&work, *base, err);
    }
    if (status == WT_OK)
        status = master_choose_anchor(&work, *base, err);
    if (status == WT_OK) {
        closed_form_shifts(&work.set, work.anchor, work.posterior->closed_form);
        status = fit_by_best_route(&work, err);
    }
    if (status == WT_OK)
        status = master_fit_widths(&work, err);
    if (status == WT_OK) {
        master_refer_errors(&work);
        work.posterior->reference_a = master_reference_shift(&work);
        status = posterior_finish(work.posterior, work.reference, err);
    }
    if (status == WT_OK) {
        master_place_reference(&work);
        status = master_report(&work, sweep, log, master, err);
    }
    const size_t steeper = status == WT_E_NO_OVERLAP ? master_steeper_isotherm(&work) : work.anchor;
    const bool elsewhere = status == WT_E_NO_OVERLAP && isnan(*base) && work.at < work.set.n &&
                           work.at != work.anchor; /* the fit may start at the reference */
    *base = steeper != work.anchor ? work.set.curves[steeper].temperature
            : elsewhere            ? work.reference
                                   : (double)NAN;
    posterior_free(work.posterior);
    arena_free(&work.memory);
    return status;
}

/* ---- reference temperature ------------------------------------------------------------------- */

/* Step of the search for the peak of tan delta [decade], before a parabola through three points.
 * A peak of E'' is at least 1.14 decades wide at half height. */
static const double step = 0.05;
/* Maximum distance of the reference from the isotherms [K]. The universal WLF law is (51.6/31.6)^2
 * = 2.7 times as steep 20 K below the glass transition as there. Farther away its pole decides,
 * which the data do not determine, and the user must state the reference. */
static const double max_extrapolation = 20.0;
/* [K], far below the accuracy of a thermometer */
static const double temperature_tolerance = 1e-6;

static double fitted_loss_factor(const wt_posterior *p, double log_frequency)
{
    wt_interval modulus[WITH_LOSS_FACTOR];
    posterior_moduli(p, log_frequency * M_LN10, false, modulus);
    return modulus[LOSS_FACTOR].value;
}

/* Returns log10 of the reduced angular frequency of the largest peak of tan delta. NaN if there
 * is no peak in the measured range. */
static double find_loss_factor_peak(const wt_master *m)
{
    const size_t n = (size_t)floor((m->log_frequency[m->n - 1] - m->log_frequency[0]) / step);
    double y[3] = {0, 0, 0}, most = -HUGE_VAL, at = (double)NAN;
    for (size_t k = 0; k <= n; k++) {
        const double x = m->log_frequency[0] + step * (double)k;
        y[0] = y[1];
        y[1] = y[2];
        y[2] = fitted_loss_factor(m->posterior, x);
        if (k < 2 || !(y[1] > y[0] && y[1] >= y[2] && y[1] > most))
            continue;
        most = y[1];
        at = x - step + 0.5 * step * (y[0] - y[2]) / (y[0] - 2.0 * y[1] + y[2]);
    }
    return at;
}

typedef struct reference_search {
    const wt_shift_law *law;
    double peak;
} reference_search;

/* Returns true below the peak, and also below the pole of the law, where it has no value. */
static bool is_below_peak(double temperature, void *user)
{
    const reference_search *s = user;
    return !(log10(2.0 * M_PI) + wt_shift_law_log_a(s->law, temperature) < s->peak);
}

/* Finds the temperature at which the law shifts 1 Hz to the peak. */
static wt_status find_transition_temperature(const wt_master *m, double *temperature, wt_error *err)
{
    const double peak = m->n > 0 && wt_master_shift_quantity(m) != WT_SHIFT_LOSS
                            ? find_loss_factor_peak(m)
                            : (double)NAN;
    double low = m->shifts[0].temperature - max_extrapolation,
           high = m->shifts[m->n_shifts - 1].temperature + max_extrapolation;
    const bool law = m->law.kind != WT_LAW_NONE;
    const double first = law ? log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, low) : 0.0,
                 last = law ? log10(2.0 * M_PI) + wt_shift_law_log_a(&m->law, high) : 0.0;
    if (!law || isnan(peak) || first < peak || !(last < peak)) { /* first is NaN below the pole */
        char peak_position[64];
        clocale_print(peak_position, sizeof peak_position,
                      "at 1 Hz tan delta peaks more than %g K %s the isotherms", max_extrapolation,
                      first < peak ? "below" : "above");
        wt_fail(err, WT_E_RANGE, "no glass transition for a reference: %s",
                !law          ? "the shifts have no law"
                : isnan(peak) ? "tan delta has no peak that was measured"
                              : peak_position);
        wt_error_advice(err, "give a reference temperature");
        return WT_E_RANGE;
    }
    reference_search search = {&m->law, peak};
    root_bisect(is_below_peak, &search, &low, &high, 0,
                (int)ceil(log2((high - low) / temperature_tolerance)));
    *temperature = high;
    return WT_OK;
}

/* Fits, and if the middle isotherm is too flat repeats the fit from the steepest one, which is the
 * reference unless one is stated. */
static wt_status fit_with_fallback_start(const wt_sweep *sweep, wt_master_options options,
                                         wt_log *log, wt_master *master, wt_error *err)
{
    double base = (double)NAN;
    wt_error flat = WT_ERROR_INIT;
    wt_log *first_log = wt_log_new(); /* buffered, because a second fit repeats the messages */
    const wt_status status = master_fit_once(sweep, &options, first_log, master, &base, &flat);
    if (isnan(base))
        wt_log_append(log, first_log, NULL);
    wt_log_free(first_log);
    if (isnan(base)) {
        if (status != WT_OK && err != NULL)
            *err = flat;
        return status;
    }
    if (isnan(options.reference_temperature)) {
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "the isotherm in the middle is too flat to shift others onto it: the reference "
                   "is %.2f °C, where the modulus changes most with frequency",
                   base - WT_ZERO_CELSIUS);
        options.reference_temperature = base;
    }
    return master_fit_once(sweep, &options, log, master, &base, err);
}

/* Fits, with the stated reference or the peak of tan delta. */
static wt_status fit_at_reference(const wt_sweep *sweep, wt_master_options adjusted, wt_log *log,
                                  wt_master *master, wt_error *err)
{
    if (adjusted.reference_at != WT_REFERENCE_TAN_DELTA_PEAK)
        return fit_with_fallback_start(sweep, adjusted, log, master, err);
    if (!isnan(adjusted.reference_temperature)) {
        wt_fail(err, WT_E_ARG, "two references: a temperature and the peak of tan delta");
        wt_error_place(err, "reference-at");
        wt_error_advice(err, "give one of them");
        return WT_E_ARG;
    }
    wt_master first = {0};
    wt_status status = fit_with_fallback_start(sweep, adjusted, NULL, &first, err);
    if (status == WT_OK)
        status = find_transition_temperature(&first, &adjusted.reference_temperature, err);
    wt_master_clear(&first);
    return status == WT_OK ? fit_with_fallback_start(sweep, adjusted, log, master, err) : status;
}

/* ---- temperatures that drift within an isotherm ---------------------------------------------- */

/* Number of fits that find the law by which the points of a drifting isotherm are shifted. The law
 * of the first fit is some 10 % off for a drift of 1.5 K, and each fit reduces that tenfold. */
enum { DRIFT_FITS = 3 };

/* Returns d log10 aT/dT at isotherm i [decade/K], by the law or by the determined neighbours; 0 if
 * there is neither. */
static double shift_slope(const wt_master *m, size_t i)
{
    static const double half_step = 0.5; /* [K] */
    const double t = m->shifts[i].temperature;
    const double by_law = m->law.kind == WT_LAW_NONE
                              ? (double)NAN
                              : (wt_shift_law_log_a(&m->law, t + half_step) -
                                 wt_shift_law_log_a(&m->law, t - half_step)) /
                                    (2 * half_step);
    size_t before = i, after = i;
    while (before > 0 && (before == i || !m->shifts[before].determined))
        before--;
    while (after + 1 < m->n_shifts && (after == i || !m->shifts[after].determined))
        after++;
    const wt_master_shift *const a = &m->shifts[m->shifts[before].determined ? before : i],
                                 *const b = &m->shifts[m->shifts[after].determined ? after : i];
    const double slope = (b->log_a.value - a->log_a.value) / (b->temperature - a->temperature);
    return isfinite(by_law) ? by_law : isfinite(slope) ? slope : 0;
}

/* Sets the frequencies of the drifting isotherms to those at the temperature of the isotherm.
 * Returns the number of isotherms that change. */
static size_t shift_drifting_points(const wt_sweep *sweep, const wt_master *m, wt_isotherm *shifted)
{
    size_t n_changed = 0;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *const t = &sweep->isotherms[i];
        size_t k = 0;
        while (k < m->n_shifts && m->shifts[k].temperature != t->temperature)
            k++;
        const double slope = k < m->n_shifts ? shift_slope(m, k) : 0;
        n_changed += t->point_temperature != NULL && slope != 0;
        for (size_t j = 0; t->point_temperature != NULL && j < t->n; j++) {
            const double off = t->point_temperature[j] - t->temperature;
            shifted[i].angular_frequency[j] =
                t->angular_frequency[j] * (isnan(off) ? 1 : pow(10, slope * off));
        }
    }
    return n_changed;
}

/* Copies the isotherms, and the frequencies of those that drift. The other arrays are shared. */
static size_t copy_drifting(const wt_sweep *sweep, arena *memory, wt_isotherm **copies)
{
    size_t n_drifting = 0;
    *copies = arena_alloc(memory, sweep->n_isotherms, sizeof **copies);
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *const copy = &(*copies)[i];
        *copy = sweep->isotherms[i];
        if (copy->point_temperature == NULL)
            continue;
        n_drifting++;
        copy->angular_frequency = arena_alloc(memory, copy->n, sizeof(double));
        memcpy(copy->angular_frequency, sweep->isotherms[i].angular_frequency,
               copy->n * sizeof(double));
    }
    return n_drifting;
}

wt_status wt_master_fit(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                        wt_master *master, wt_error *err)
{
    wt_master_options quick = options != NULL ? *options : wt_master_options_defaults();
    const wt_master_options final = quick;
    arena memory = {0};
    wt_sweep shifted = *sweep;
    const size_t n_drifting = copy_drifting(sweep, &memory, &shifted.isotherms);
    size_t n_changed = 0;
    wt_status status = WT_OK;
    quick.series_only = true;
    for (size_t i = 0; n_drifting > 0 && status == WT_OK && i < DRIFT_FITS; i++) {
        wt_master fit = {0};
        status = fit_at_reference(&shifted, quick, NULL, &fit, err);
        if (status == WT_OK)
            n_changed = shift_drifting_points(sweep, &fit, shifted.isotherms);
        wt_master_clear(&fit);
    }
    if (status == WT_OK)
        status = fit_at_reference(&shifted, final, log, master, err);
    if (status == WT_OK && n_changed > 0)
        wt_log_action(log, WT_NOTE, WT_CORRECTED, n_changed, WT_KEEP_OPTION, NULL, NULL,
                      "the temperature drifts within %zu isotherm%s: each point counts at its own "
                      "temperature, by the slope of the shifts",
                      n_changed, n_changed > 1 ? "s" : "");
    arena_free(&memory);
    return status;
}
