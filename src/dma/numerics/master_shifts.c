/* Isotherms that do not belong to the others: one whose E'' is off, and one whose frequencies have
 * another unit. What is off is left out and named. The shifts of a fitted sweep with their notes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>

/* Minimum number of isotherms that remain. With three, any one of them may be the wrong one. */
enum { LEAST_LEFT = 4 };

/* ---- an isotherm whose E'' is off ------------------------------------------------------------ */

/* The smallest gap that is named [ln], its significance in standard errors, and the share of it up
 * to which the other isotherms agree. A material that changes with temperature parts them by
 * similar gaps from one isotherm to the next. */
static const double least_gap = 0.03, gap_significance = 4.0, agreement = 0.3;
enum { LEAST_PAIRS = 3 };

/* Computes by how much E'' of isotherm i exceeds that of isotherm j at equal E' [ln], which no
 * horizontal shift changes, and its standard error. NaN: they share too few points. */
static double loss_gap(const master_work *work, size_t i, size_t j, double *error)
{
    const shift_curve *s = &work->set.curves[i], *p = &work->set.curves[j];
    const double b = work->physical[i] - work->physical[j];
    double sum = 0.0, square = 0.0;
    size_t n = 0;
    for (size_t k = 0; k < s->n; k++) {
        const double y = s->y[STORAGE][k] + b;
        size_t m = 1;
        while (m < p->n && !(y >= p->y[STORAGE][m - 1] && y < p->y[STORAGE][m]))
            m++;
        if (m >= p->n)
            continue;
        const double *const e = p->y[STORAGE] + m - 1, *const loss = p->y[LOSS] + m - 1;
        const double off =
            s->y[LOSS][k] + b - loss[0] - (y - e[0]) / (e[1] - e[0]) * (loss[1] - loss[0]);
        sum += off * M_LN10;
        square += off * off * M_LN10 * M_LN10;
        n++;
    }
    const double mean = sum / (double)n;
    *error = sqrt(fmax(square / (double)n - mean * mean, 0.0) / ((double)n - 1.0));
    return n >= LEAST_PAIRS ? mean : (double)NAN;
}

/* Returns the gap of isotherm list[k] to both neighbours, or 0 if it does not object: the gaps must
 * have one sign, the neighbours agree with each other, and so do all other isotherms. */
static double objection(const master_work *work, const size_t *list, size_t n, size_t k)
{
    double error[3];
    const double cold = loss_gap(work, list[k], list[k - 1], &error[0]),
                 warm = loss_gap(work, list[k], list[k + 1], &error[1]);
    const double least = fmin(fabs(cold), fabs(warm));
    if (!(cold * warm > 0.0 && fabs(cold) > gap_significance * error[0] &&
          fabs(warm) > gap_significance * error[1] && least > least_gap &&
          fabs(loss_gap(work, list[k - 1], list[k + 1], &error[2])) < agreement * least))
        return 0.0;
    for (size_t i = 1; i < n; i++)
        if (i != k && i != k + 1 &&
            fabs(loss_gap(work, list[i - 1], list[i], &error[0])) - 2.0 * error[0] >
                agreement * least)
            return 0.0;
    return 0.5 * (cold + warm);
}

bool master_misfits(const master_work *work)
{
    return work->is_gross || master_misfit_is_significant(&work->lack) ||
           master_loss_is_inconsistent(&work->lack);
}

bool master_find_objecting(master_work *work, size_t *found)
{
    size_t n = 0, *list = wt_alloc(work->set.n, sizeof *list);
    double gap = 0.0;
    for (size_t i = 0; work->set.quantity == WT_SHIFT_MODULI && i < work->set.n; i++)
        if (work->set.curves[i].n >= SHIFT_MIN_POINTS)
            list[n++] = i;
    for (size_t k = 1; n > LEAST_LEFT && k + 1 < n && gap == 0.0; k++) {
        gap = objection(work, list, n, k);
        *found = list[k];
    }
    free(list);
    if (gap != 0.0)
        clocale_print(work->set.curves[*found].exclusion, sizeof work->set.curves[*found].exclusion,
                      "its E'' is left out: it deviates by %+.0f %% from what E' and the "
                      "others imply",
                      100.0 * expm1(gap));
    return gap != 0.0;
}

/* ---- an isotherm with another unit of frequency ---------------------------------------------- */

/* Tolerance of a shift by 2 pi, and largest deviation of the other isotherms from their neighbours
 * [decade]. */
static const double unit_tolerance = 0.12, smooth_deviation = 0.15;

/* Returns the deviation of the shift of isotherm `list[k]` from the cubic through two isotherms on
 * either side, or the parabola through three at the ends of the list. NaN: no neighbour on one
 * side. */
static double deviation_from_neighbours(const master_work *work, const size_t *list, size_t n,
                                        size_t k)
{
    const size_t first = k >= 2 ? k - 2 : 0, last = k + 2 < n ? k + 2 : n - 1;
    const double t = work->set.curves[list[k]].temperature;
    double expected = 0.0;
    if (k == 0 || k + 1 >= n)
        return (double)NAN;
    for (size_t i = first; i <= last; i++) {
        double weight = 1.0;
        const double ti = work->set.curves[list[i]].temperature;
        for (size_t j = first; j <= last; j++)
            if (j != i && j != k) {
                const double tj = work->set.curves[list[j]].temperature;
                weight *= (t - tj) / (ti - tj);
            }
        if (i != k)
            expected += weight * spectrum_a(work->s, work->curve[list[i]]) / M_LN10;
    }
    return spectrum_a(work->s, work->curve[list[k]]) / M_LN10 - expected;
}

/* Returns the largest deviation of any isotherm but `without` from its neighbours. */
static double largest_deviation(const master_work *work, const size_t *list, size_t n,
                                size_t without, size_t *others)
{
    size_t m = 0;
    double most = 0.0;
    for (size_t k = 0; k < n; k++)
        if (k != without)
            others[m++] = list[k];
    for (size_t k = 1; k + 1 < m; k++) {
        const double off = fabs(deviation_from_neighbours(work, others, m, k));
        most = off <= most ? most : off; /* two isotherms of one temperature have no deviation */
    }
    return most;
}

bool master_find_unit_slip(master_work *work, size_t *found)
{
    const double two_pi = log10(2.0 * M_PI);
    size_t n = 0, *list = wt_alloc(2 * work->set.n, sizeof *list), *others = list + work->set.n;
    double least = smooth_deviation;
    *found = work->set.n;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i] && !work->set.curves[i].is_shift_fixed)
            list[n++] = i;
    for (size_t k = 1; n > LEAST_LEFT + 1 && k + 1 < n; k++) {
        const double off = deviation_from_neighbours(work, list, n, k);
        if (!(fabs(fabs(off) - two_pi) <= unit_tolerance))
            continue;
        const double rest = largest_deviation(work, list, n, k, others);
        if (!(rest < least))
            continue;
        least = rest;
        *found = list[k];
        clocale_print(work->set.curves[*found].exclusion, sizeof work->set.curves[*found].exclusion,
                      "left out: its frequencies deviate by %.2f decade, as by a factor 2 pi: "
                      "%s",
                      fabs(off), off < 0.0 ? "rad/s read as Hz" : "Hz read as rad/s");
    }
    free(list);
    return *found < work->set.n;
}

/* ---- shifts ---------------------------------------------------------------------------------- */

static size_t count_outliers(const spectrum *s, size_t curve)
{
    size_t n = 0;
    for (size_t k = s->first[curve]; k < s->first[curve + 1]; k++)
        for (int q = 0; q < MODULI; q++)
            n += spectrum_is_fitted(s, curve, q) && s->weight[q][k] == 0.0;
    return n;
}

/* Notes why a shift is not determined. Returns false if it is determined. */
static bool note_undetermined(const master_work *work, size_t i, wt_master_shift *shift)
{
    /* a shift that is only possibly uncertain is reported, with the larger error */
    const bool fails = work->posterior->extra_error != NULL &&
                       master_misfit_is_significant(&work->lack) &&
                       !master_loss_is_inconsistent(&work->lack);
    /* against the anchor: whether a shift is determined does not depend on the reference */
    const double extra = fails && work->placed[i] ? work->base_error[work->curve[i]] : 0.0;
    const double own = work->placed[i]
                           ? hypot(posterior_fit_error(work->posterior, work->curve[i]), extra)
                           : (double)NAN;
    const shift_curve *c = &work->set.curves[i];
    if (c->n < SHIFT_MIN_POINTS && c->exclusion[0] != '\0')
        master_add_note(shift, "%s", c->exclusion);
    else if (c->n < SHIFT_MIN_POINTS)
        master_add_note(shift, "not determined: only %zu points", c->n);
    else if (!work->placed[i])
        master_add_note(shift, work->route == WT_SHIFTS_FROM_OVERLAP
                                   ? "not determined: it overlaps too little with its "
                                     "neighbours in E'"
                                   : "not determined: no overlap with the others");
    else if (work->route == WT_SHIFTS_FROM_OVERLAP)
        return false; /* each step is determined */
    else if (extra > master_max_shift_error)
        master_add_note(shift,
                        "not determined: superposition fails, overlaps differ by %.2g decade", own);
    else if (!(own <= master_max_shift_error))
        master_add_note(shift, "not determined: it is too flat, error of log aT %.2g decade", own);
    return shift->note[0] != '\0';
}

double master_reference_shift(const master_work *work)
{
    const size_t at = work->at, end = at < work->first ? work->first : work->last;
    if (at == work->set.n)
        return 0.0;
    if (master_reference_is_fitted(work))
        return spectrum_a(work->s, work->curve[at]) / M_LN10;
    if (!work->part || !work->placed[end] || !work->edge[at].placed || !work->edge[end].placed)
        return 0.0;
    return spectrum_a(work->s, work->curve[end]) / M_LN10 + work->edge[at].a - work->edge[end].a;
}

void master_place_reference(master_work *work)
{
    const wt_posterior *p = work->posterior;
    size_t cold, warm;
    work->is_reference_fitted = true;
    if (master_reference_is_fitted(work))
        work->place = posterior_at_curve(work->curve[work->at]);
    else if (p->shape.kind != WT_LAW_NONE && master_reference_neighbours(work, &cold, &warm) &&
             posterior_fit_error(p, work->curve[cold]) <= master_max_shift_error &&
             posterior_fit_error(p, work->curve[warm]) <= master_max_shift_error)
        work->place = posterior_between(p, work->curve[cold], work->reference);
    else
        work->is_reference_fitted = false;
}

/* Returns a fitted shift against the reference temperature. */
static wt_interval shift_to_reference(const master_work *work, size_t curve)
{
    const wt_posterior *p = work->posterior;
    const posterior_place own = posterior_at_curve(curve),
                          anchor = posterior_at_curve(work->curve[work->anchor]);
    double a, error;
    if (work->is_reference_fitted)
        return posterior_a(p, curve, &work->place);
    if (work->at == work->set.n || !master_shift_outside_part(work, work->at, &a, &error))
        return posterior_a_to_law(p, &own);
    wt_interval shift = posterior_a(p, curve, &anchor);
    error = hypot(error, shift.standard_error);
    a = shift.value - a;
    return (wt_interval){a, error, a - NORMAL_95 * error, a + NORMAL_95 * error};
}

/* Fills the shift of an isotherm outside the part that one spectrum describes. It is not in the
 * curve. */
static bool fill_shift_outside_part(const master_work *work, size_t i, wt_master_shift *shift)
{
    double a, error;
    if (!master_shift_outside_part(work, i, &a, &error))
        return false;
    const wt_interval anchor = shift_to_reference(work, work->curve[work->anchor]);
    a += anchor.value;
    error = i == work->at ? 0.0 : hypot(error, anchor.standard_error);
    shift->log_a = (wt_interval){a, error, a - NORMAL_95 * error, a + NORMAL_95 * error};
    master_add_note(shift, "by the overlap of E' with its neighbour, not in the curve");
    return true;
}

static void fill_shift(const master_work *work, size_t i, const double *log_b_material,
                       wt_master_shift *shift)
{
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    const size_t curve = work->curve[i];
    *shift =
        (wt_master_shift){.temperature = work->set.curves[i].temperature,
                          .origin = i == work->at ? WT_SHIFT_REFERENCE : work->set.curves[i].origin,
                          .log_a = unknown,
                          .log_b = unknown,
                          .log_b_physical = work->physical[i],
                          .log_b_material = (double)NAN,
                          .law = unknown,
                          .overlap = work->overlap[i],
                          .noise_factor = (double)NAN};
    if (work->placed[i]) {
        shift->noise_factor = work->s->kappa[curve];
        shift->n_outliers = count_outliers(work->s, curve);
    }
    if (fill_shift_outside_part(work, i, shift) || note_undetermined(work, i, shift))
        return;
    shift->determined = true;
    shift->log_a = shift_to_reference(work, curve);
    if (work->set.quantity == WT_SHIFT_LOSS_FACTOR)
        return;
    shift->log_b = posterior_b(work->posterior, curve);
    shift->log_b_material = log_b_material[curve];
}

void master_fill_shifts(const master_work *work, wt_master *m)
{
    const wt_posterior *p = work->posterior;
    const size_t n = work->s->n_curves;
    double *log_b = wt_alloc(2 * n, sizeof *log_b), *const one = log_b + n;
    m->shifts = wt_alloc(work->set.n, sizeof *m->shifts);
    for (size_t c = 0; c < p->n_components; c++) {
        posterior_smooth_b(p, p->components[c].cell, p->components[c].cell->value, one);
        for (size_t i = 0; i < n; i++)
            log_b[i] += p->components[c].weight * one[i];
    }
    for (size_t i = 0; i < work->set.n; i++)
        fill_shift(work, i, log_b, &m->shifts[i]);
    m->n_shifts = work->set.n;
    for (size_t i = 0; i < m->n_shifts; i++)
        m->n_outliers += m->shifts[i].n_outliers;
    free(log_b);
}

/* ---- checks ---------------------------------------------------------------------------------- */

/* Ratio of the change along the steepest isotherm to that along the anchor. At 2 the shift error
 * halves, because it is noise divided by slope. */
static const double steepness_ratio = 2.0;

size_t master_steeper_isotherm(const master_work *work)
{
    const shift_set *set = &work->set;
    size_t steepest = work->anchor;
    for (size_t i = 0; i < set->n; i++)
        if (set->curves[i].n >= SHIFT_MIN_POINTS &&
            curve_modulus_change(set, i) > curve_modulus_change(set, steepest))
            steepest = i;
    return curve_modulus_change(set, steepest) >
                   steepness_ratio * curve_modulus_change(set, work->anchor)
               ? steepest
               : work->anchor;
}

/* Fails because no slope determines the shifts. */
static wt_status fail_flat_isotherms(const master_work *work, wt_error *err)
{
    const shift_curve *at = &work->set.curves[work->anchor];
    const size_t steepest = master_steeper_isotherm(work);
    const bool elsewhere = steepest != work->anchor;
    wt_fail(err, WT_E_NO_OVERLAP,
            elsewhere ? "no shift is determined: the isotherm of the reference temperature is flat"
                      : "no shift is determined: the isotherms are flat");
    wt_error_expected(err, "moduli that change along an isotherm by more than noise and clamping "
                           "change them");
    wt_error_found(
        err, "a change of %s along that of the reference, %.2f °C",
        format_percent(expm1(curve_modulus_change(&work->set, work->anchor) * M_LN10)).text,
        at->temperature - WT_ZERO_CELSIUS);
    if (elsewhere)
        wt_error_advice(
            err,
            "choose a reference temperature in the transition: %.2f °C, where it "
            "changes by %s, or --reference-at tan-delta-peak",
            work->set.curves[steepest].temperature - WT_ZERO_CELSIUS,
            format_percent(expm1(curve_modulus_change(&work->set, steepest) * M_LN10)).text);
    else
        wt_error_advice(err,
                        "measure into the transition, or choose a reference temperature there");
    return WT_E_NO_OVERLAP;
}

/* Checks that at least one isotherm is shifted onto the reference. */
wt_status master_check_shifts(const master_work *work, const wt_master *m, wt_error *err)
{
    size_t n = 0, placed = 0, doubted = 0;
    for (size_t i = 0; i < m->n_shifts; i++) {
        n += m->shifts[i].determined;
        placed += work->placed[i];
        doubted += work->placed[i] && i != work->anchor &&
                   posterior_fit_error(work->posterior, work->curve[i]) <= master_max_shift_error;
    }
    if (n > 1 || m->n_shifts == 1)
        return WT_OK;
    if (placed <= 1) {
        wt_fail(err, WT_E_NO_OVERLAP,
                "no shift is determined: once shifted, the isotherms share too "
                "few frequencies with that of the reference");
        wt_error_expected(err, "0.3 decade shared by neighbours");
        wt_error_advice(err, "measure at smaller steps of temperature or over more frequencies");
        return WT_E_NO_OVERLAP;
    }
    if (work->posterior->extra_error != NULL && doubted > 0) {
        wt_fail(err, WT_E_NO_OVERLAP,
                "no shift is determined: one spectrum does not describe the isotherms, and the "
                "overlaps of neighbours determine no shift to better than %.1f decade",
                master_max_shift_error);
        wt_error_advice(err, "leave out isotherms or points that one process does not describe, "
                             "shift by the storage modulus alone, or give a law of the shifts");
        return WT_E_NO_OVERLAP;
    }
    return fail_flat_isotherms(work, err);
}

wt_status master_check_reference(const master_work *work, const wt_master *m, wt_error *err)
{
    const double coldest = m->shifts[0].temperature,
                 warmest = m->shifts[m->n_shifts - 1].temperature;
    const bool inside = m->reference_temperature > coldest && m->reference_temperature < warmest;
    if (work->at < work->set.n || (inside && m->law.kind != WT_LAW_NONE) ||
        (m->law.kind != WT_LAW_NONE && m->offset.standard_error <= master_max_shift_error))
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "no shift can be given for the reference temperature %.2f °C",
            m->reference_temperature - WT_ZERO_CELSIUS);
    wt_error_expected(err, "a temperature that the law of the shifts reaches within %.1f decade",
                      master_max_shift_error);
    wt_error_advice(err, "choose one of the measured temperatures");
    return WT_E_RANGE;
}
