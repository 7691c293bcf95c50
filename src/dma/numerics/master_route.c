/* Which way the master curve of a sweep is found: one spectrum with shifts of its own, that of a
 * part of the isotherms, or one at the shifts of the overlaps. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/param.h"
#include "dma/numerics/closed_form.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Change along the steepest isotherm over that along the one to start from: from there on the other
 * tells shifts with half the error, for that is noise over slope. */
static const double much_steeper = 2.0;

/* NaN, or the temperature of an isotherm that changes much more than the one that was started from.
 */
static double steeper_reference(const master_work *work)
{
    const shift_set *set = &work->set;
    size_t steepest = work->anchor;
    for (size_t i = 0; i < set->n; i++)
        if (set->curves[i].n >= SHIFT_MIN_POINTS &&
            shift_change(set, i) > shift_change(set, steepest))
            steepest = i;
    return shift_change(set, steepest) > much_steeper * shift_change(set, work->anchor)
               ? set->curves[steepest].temperature
               : (double)NAN;
}

/* Whether one spectrum describes the isotherms from `first` to `last`: not if it does not end,
 * spans too much, or leaves some without overlap or too few that it could be of. */
static wt_status try_part(const master_work *whole, size_t first, size_t last, bool *holds,
                          wt_error *err)
{
    master_work work = {.options = whole->options, .part = true, .set = whole->set};
    work.options.reference_temperature = whole->reference;
    work.set.curves += first;
    work.set.n = work.last = last - first + 1;
    *holds = false;
    wt_status status = master_work_alloc(&work, err);
    if (status == WT_OK)
        status = master_choose_anchor(&work, err);
    if (status == WT_OK)
        status = master_place(&work, err);
    if (status == WT_OK)
        status = master_measure_misfit(&work, err);
    if (status == WT_OK && !work.gross && work.s->n_curves == work.set.n)
        status = master_find_noise(&work, err);
    if (status == WT_OK && !work.gross && work.s->n_curves == work.set.n)
        status = master_test(&work, err);
    if (status == WT_OK && work.tested && !master_misfit_is_real(&work.lack))
        status = master_agrees(&work, holds, err);
    posterior_free(work.posterior);
    arena_free(&work.memory);
    const bool none = status == WT_E_CONVERGENCE || status == WT_E_RANGE ||
                      status == WT_E_NO_OVERLAP || status == WT_E_MISSING;
    return none ? WT_OK : status;
}

/* ---- a part that one spectrum describes ------------------------------------------------------ */

/* Fewer isotherms than these have no law (shift_law.h). */
enum { LEAST_PART = LAW_LEAST_TOLD };

/* The farthest end with which the part still holds: all there is, then by halves. */
static wt_status widen_part(master_work *work, bool warm, wt_error *err)
{
    size_t *const end = warm ? &work->last : &work->first;
    size_t steps = warm ? work->set.n - 1 - work->last : work->first; /* that may hold */
    wt_status status = WT_OK;
    for (size_t tried = steps; status == WT_OK && steps > 0; tried = (steps + 1) / 2) {
        bool holds;
        const size_t next = warm ? *end + tried : *end - tried;
        status = try_part(work, warm ? work->first : next, warm ? next : work->last, &holds, err);
        if (status == WT_OK && holds) {
            *end = next;
            steps -= tried;
        } else {
            steps = tried - 1;
        }
    }
    return status;
}

static wt_status find_part(master_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    bool holds = false;
    wt_status status = WT_OK;
    if (work->set.by != WT_BY_MODULI || n <= LEAST_PART)
        return WT_OK;
    /* about the anchor, rather to the warm side: rubber is above its glass */
    work->first = work->anchor > 0 ? work->anchor - 1 : 0;
    if (work->first + LEAST_PART > n)
        work->first = n - LEAST_PART;
    work->last = work->first + LEAST_PART - 1;
    status = try_part(work, work->first, work->last, &holds, err);
    if (status != WT_OK || !holds)
        return status;
    status = widen_part(work, true, err);
    if (status == WT_OK)
        status = widen_part(work, false, err);
    work->part = true;
    return status;
}

/* As if it had never been in doubt; gross: with vertical shifts that are not held it is. */
static wt_status fit_plainly(master_work *work, wt_error *err)
{
    work->plain = true;
    wt_status status = master_place(work, err);
    if (status == WT_OK)
        status = master_find_noise(work, err);
    if (status == WT_OK && !work->prior.held)
        status = master_measure_misfit(work, err);
    return status == WT_OK ? master_test(work, err) : status;
}

/* One spectrum with shifts of its own. */
static wt_status fit_own(master_work *work, wt_error *err)
{
    wt_status status = master_place(work, err);
    if (status == WT_OK && work->gross) { /* vertical shifts that are held may be all that misses */
        status = master_set_widths(work, WT_VERTICAL_FREE, 0.0, 0.0, err);
        if (status == WT_OK)
            status = spectrum_fit(work->s, SPECTRUM_ROUGH, err);
        if (status == WT_OK)
            status = master_measure_misfit(work, err);
        if (status != WT_OK || !work->gross) /* all is well but for those: from the start again */
            return status != WT_OK ? status : fit_plainly(work, err);
        status = spectrum_noise_within(work->s, &work->within, err);
        spectrum_spread(work->s, master_even);
    } else if (status == WT_OK) {
        status = master_find_noise(work, err);
        if (status == WT_OK) /* what was a start that is near enough may have ended far off */
            status = master_measure_misfit(work, err);
    }
    return status == WT_OK ? master_test(work, err) : status;
}

/* The misfit is no matter of vertical shifts that are held, or of a factor on E'', which leave the
 * shifts what they are. */
static bool is_real(const master_work *work)
{
    const lack_of_fit *lack = &work->lack;
    return !work->tested || ((work->louder || master_misfit_is_real(lack)) &&
                             fabs(lack->factor) < fmax(work->missed[STORAGE], work->missed[LOSS]));
}

/* Where that is far off, or is not found: of the isotherms about the reference that one describes,
 * or, if there are none, one at the shifts of the overlaps. */
static wt_status fit_spectrum(master_work *work, wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    wt_status status = fit_own(work, &failure);
    if (status == WT_E_CONVERGENCE)
        snprintf(work->no_spectrum, sizeof work->no_spectrum, "%s", failure.message);
    bool overlap = false;
    if (work->no_spectrum[0] != '\0' || (status == WT_OK && work->gross && is_real(work))) {
        const wt_status may = master_may_overlap(work, &overlap, err);
        if (may != WT_OK)
            return may;
    }
    if (!overlap && status == WT_OK && work->gross)
        status = fit_plainly(work, &failure);
    if (!overlap && status == WT_OK && work->tested && master_misfit_is_likely(&work->lack) &&
        work->set.used[STORAGE])
        status = master_uncertainty(work, &failure);
    if (!overlap && status == WT_OK && master_misfit_is_real(&work->lack) &&
        master_all_uncertain(work)) {
        status = master_may_overlap(work, &overlap, err);
        if (status != WT_OK)
            return status;
    }
    if (!overlap) {
        if (status != WT_OK && err != NULL)
            *err = failure;
        return status;
    }
    master_keep_original(work);
    work->posterior->doubt = NULL; /* that of the spectrum of all */
    work->posterior->doubts = NULL;
    status = find_part(work, err);
    if (status == WT_OK && work->part) {
        work->whole = work->lack;
        memcpy(work->missed_whole, work->missed, sizeof work->missed);
        return fit_own(work, err);
    }
    if (status == WT_OK)
        status = master_by_overlap(work, err);
    return status == WT_OK ? master_find_noise(work, err) : status;
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
    if (status == WT_OK)
        status = master_work_alloc(&work, err);
    if (status == WT_OK)
        status = master_choose_anchor(&work, err);
    if (status == WT_OK) {
        closed_form_shifts(&work.set, work.anchor, work.posterior->closed_form);
        status = fit_spectrum(&work, err);
    }
    if (status == WT_OK)
        status = master_fit_widths(&work, err);
    if (status == WT_OK)
        status = posterior_close(work.posterior, work.reference, err);
    if (status == WT_OK)
        status = master_report(&work, sweep, log, master, err);
    *better = status == WT_E_NO_OVERLAP ? steeper_reference(&work) : (double)NAN;
    posterior_free(work.posterior);
    arena_free(&work.memory);
    return status;
}
