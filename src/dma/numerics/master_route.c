/* Selects the route to the master curve: one spectrum with free shifts, a spectrum of a part of
 * the isotherms, or one at the shifts of the overlaps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/param.h"
#include "dma/numerics/closed_form.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Ratio of the change along the steepest isotherm to that along the start isotherm. At 2 the
 * shift error halves, because it is noise divided by slope. */
static const double steepness_ratio = 2.0;

/* Returns the temperature of an isotherm that changes much more than the start isotherm, or NaN. */
static double steeper_reference(const master_work *work)
{
    const shift_set *set = &work->set;
    size_t steepest = work->anchor;
    for (size_t i = 0; i < set->n; i++)
        if (set->curves[i].n >= SHIFT_MIN_POINTS &&
            curve_modulus_change(set, i) > curve_modulus_change(set, steepest))
            steepest = i;
    return curve_modulus_change(set, steepest) >
                   steepness_ratio * curve_modulus_change(set, work->anchor)
               ? set->curves[steepest].temperature
               : (double)NAN;
}

/* Tests if one spectrum describes the isotherms from `first` to `last`. It fails without
 * convergence, with too large a span, missing overlap or too few isotherms. */
static wt_status test_part(const master_work *whole, size_t first, size_t last, bool *holds,
                           wt_error *err)
{
    master_work work = {.options = whole->options, .part = true, .set = whole->set};
    work.options.reference_temperature = whole->reference;
    work.set.curves += first;
    work.set.n = work.last = last - first + 1;
    *holds = false;
    master_work_alloc(&work);
    wt_status status = master_choose_anchor(&work, err);
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

static wt_status find_describable_part(master_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    bool holds = false;
    wt_status status = WT_OK;
    if (work->set.quantity != WT_SHIFT_MODULI || n <= LEAST_PART)
        return WT_OK;
    /* around the anchor, rather on the warm side, above the glass */
    work->first = work->anchor > 0 ? work->anchor - 1 : 0;
    if (work->first + LEAST_PART > n)
        work->first = n - LEAST_PART;
    work->last = work->first + LEAST_PART - 1;
    status = test_part(work, work->first, work->last, &holds, err);
    if (status != WT_OK || !holds)
        return status;
    status = widen_part(work, true, err);
    if (status == WT_OK)
        status = widen_part(work, false, err);
    work->part = true;
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
        spectrum_set_point_noise(work->s, master_uniform_noise);
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

/* Fits one spectrum. If it fails or is far off, the function fits a part around the reference,
 * or else a spectrum at the overlap shifts. */
static wt_status fit_by_best_route(master_work *work, wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    wt_status status = fit_free_shifts(work, &failure);
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

wt_status master_fit_once(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                          wt_master *master, double *better, wt_error *err)
{
    master_work work = {.options = *options};
    wt_status status = param_check(wt_master_options_params(), &work.options, err);
    if (status == WT_OK)
        status = shift_set_new(sweep, work.options.shift_by, log, &work.memory, &work.set, err);
    if (status == WT_OK)
        status = master_check_vertical(&work, err);
    if (status == WT_OK) {
        master_work_alloc(&work);
        status = master_choose_anchor(&work, err);
    }
    if (status == WT_OK) {
        closed_form_shifts(&work.set, work.anchor, work.posterior->closed_form);
        status = fit_by_best_route(&work, err);
    }
    if (status == WT_OK)
        status = master_fit_widths(&work, err);
    if (status == WT_OK)
        status = posterior_finish(work.posterior, work.reference, err);
    if (status == WT_OK)
        status = master_report(&work, sweep, log, master, err);
    *better = status == WT_E_NO_OVERLAP ? steeper_reference(&work) : (double)NAN;
    posterior_free(work.posterior);
    arena_free(&work.memory);
    return status;
}
