/* Master curve of isotherms that one spectrum does not describe: shifts by the overlap of
 * neighbours, and a spectrum fitted to them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/math/arena_gsl.h"
#include "dma/numerics/spectrum_start.h"

#include <math.h>

/* Shifts of the spectrum and of the overlaps disagree if they differ by more standard errors
 * than this. */
static const double agree = 2.0;

/* Returns true if all shifts of the spectrum agree with the overlaps. */
static bool all_agree(const master_work *work, const overlap_link *link)
{
    const spectrum *s = work->s;
    for (size_t i = 0; i < work->set.n; i++) {
        const long column = work->placed[i] ? s->column_a[work->curve[i]] : -1;
        if (column < 0)
            continue;
        const double variance = spectrum_variance(s, work->curve[i]);
        const double off = spectrum_a(s, work->curve[i]) / M_LN10 - link[i].a;
        if (!(fabs(off) <= agree * hypot(link[i].error, sqrt(variance) / M_LN10)))
            return false;
    }
    return true;
}

wt_status master_agrees(const master_work *work, bool *agrees, wt_error *err)
{
    const size_t n = work->set.n;
    arena memory = {0};
    overlap_link *link = arena_alloc(&memory, n, sizeof *link);
    wt_status status =
        memory.failed ? wt_fail(err, WT_E_MEMORY, "no memory for the overlaps") : WT_OK;
    *agrees = false;
    for (int physical = 0; physical < 2 && status == WT_OK && !*agrees; physical++) {
        status = master_links(work, physical == 1, link, err);
        *agrees = status == WT_OK && all_agree(work, link);
    }
    arena_free(&memory);
    return status;
}

wt_status master_may_overlap(master_work *work, bool *may, wt_error *err)
{
    size_t placed = 0;
    bool given = !work->set.used[STORAGE];
    for (size_t i = 0; i < work->set.n; i++)
        given = given || work->set.curves[i].given;
    *may = false;
    if (given)
        return WT_OK;
    const wt_status status = master_overlaps(work, err);
    for (size_t i = 0; status == WT_OK && i < work->set.n; i++)
        placed += work->link[i].placed;
    *may = placed > 1;
    return status;
}

static size_t isotherms_away(const master_work *work, size_t i)
{
    return i > work->anchor ? i - work->anchor : work->anchor - i;
}

/* Returns the sum of squared errors of the steps that two isotherms share. */
static double common_steps(const master_work *work, size_t one, size_t other)
{
    double sum = 0.0;
    while (one != other) {
        size_t *const next =
            isotherms_away(work, one) > isotherms_away(work, other) ? &one : &other;
        *next = work->link[*next].onto;
    }
    for (; one != work->anchor; one = work->link[one].onto)
        sum += work->link[one].step * work->link[one].step;
    return sum;
}

/* Converts a misfit of E' to a shift [decade], from the slope of the isotherms. It may
 * accumulate from one isotherm to the next if the material changes with temperature. */
static double missed_shift(const master_work *work, double missed, size_t from, size_t i)
{
    double sum = 0.0;
    for (; i != from; i = i < from ? i + 1 : i - 1) {
        const shift_curve *c = &work->set.curves[i];
        sum += missed / M_LN10 * (c->x[c->n - 1] - c->x[0]) / shift_change(&work->set, i);
    }
    return sum;
}

/* Returns the shift error due to the misfit of the spectrum [decade]. If one spectrum fails,
 * slow and fast times shift differently, in an unknown direction. */
static double doubt_of_spectrum(const master_work *work, size_t i)
{
    bool given = false;
    for (size_t k = 0; k < work->set.n; k++)
        given = given || work->set.curves[k].given;
    if (given || master_is_factor(&work->lack))
        return 0.0; /* stated shifts may cause the misfit; a factor on all E'' does not affect
                       shifts */
    const double missed = sqrt(work->lack.beyond) * work->missed[STORAGE];
    return hypot(work->lack.parted * work->own_a[i], missed_shift(work, missed, work->anchor, i));
}

/* Returns the squared change of a shift by alternatives as good as E' alone, between two
 * isotherms. If one spectrum fails, no alternative is known to be right. */
static double squared_ways(const overlap_link *from, const overlap_link *to)
{
    const double by_loss = to->by_loss - from->by_loss,
                 by_vertical = to->by_vertical - from->by_vertical;
    return by_loss * by_loss + by_vertical * by_vertical;
}

/* Returns the variance of one shift due to the overlaps [decade^2]. Weak overlaps add no error
 * to a spectrum. */
static double squared_doubt(const master_work *work, size_t i)
{
    const overlap_link *link = &work->link[i];
    if (!link->placed)
        return 0.0;
    const double square = common_steps(work, i, i) + link->error * link->error;
    const double alike = link->spread * link->spread;
    if (work->route == WT_SHIFTS_OF_OVERLAP)
        return square + alike + squared_ways(&work->link[work->anchor], link);
    const double off = isnan(work->own_a[i]) ? 0.0 : fabs(link->a - work->own_a[i]);
    return alike + pow(fmax(off - agree * sqrt(square), 0.0), 2);
}

/* Returns true if the user stated the shift. Shifts of overlaps are also fixed, but do not count
 * here. */
static bool is_held(const master_work *work, size_t i)
{
    return work->route != WT_SHIFTS_OF_OVERLAP && work->set.curves[i].given;
}

/* Sets the errors of the shifts if superposition fails or may fail. They combine the scatter
 * within the overlaps, the difference of spectrum and overlaps, and the misfit. The law treats
 * them as independent step errors of the same total size, because a common error leaves its form
 * unchanged. An error that is only possible is ignored by the law. Stated shifts have no error. */
static wt_status doubt_shifts(master_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    wt_posterior *p = work->posterior;
    const bool may = work->route != WT_SHIFTS_OF_OVERLAP && !master_misfit_is_real(&work->lack);
    const bool fails = !may && !master_loss_is_off(&work->lack);
    double all = 0.0, steps = 0.0;
    p->doubt = arena_numbers(&p->memory, work->s->n_curves);
    p->doubts = arena_matrix(&p->memory, work->s->n_curves, work->s->n_curves);
    if (p->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the overlaps");
    for (size_t i = 0; i < n; i++) {
        if (!work->placed[i] || is_held(work, i))
            continue;
        const double own = work->route == WT_SHIFTS_OF_OVERLAP ? 0.0 : doubt_of_spectrum(work, i);
        const double square = squared_doubt(work, i);
        const double sure = fails ? square + own * own : square;
        p->doubt[work->curve[i]] = hypot(sqrt(square), own);
        all += work->link[i].placed ? sure : 0.0;
        steps += work->link[i].placed ? common_steps(work, i, i) : 0.0;
        for (size_t k = 0; k < n; k++)
            if (work->placed[k] && !is_held(work, k) && work->link[i].placed &&
                work->link[k].placed && (i < work->anchor) == (k < work->anchor))
                gsl_matrix_set(p->doubts, work->curve[i], work->curve[k], common_steps(work, i, k));
    }
    gsl_matrix_scale(p->doubts, steps > 0.0 ? all / steps : 1.0);
    if (may)
        gsl_matrix_set_zero(p->doubts);
    for (size_t i = 0; i < n; i++) /* without an overlap the error is independent */
        if (work->placed[i] && !is_held(work, i) && !work->link[i].placed)
            gsl_matrix_set(p->doubts, work->curve[i], work->curve[i],
                           fails ? pow(p->doubt[work->curve[i]], 2) : 0.0);
    return WT_OK;
}

void master_keep_original(master_work *work)
{
    for (size_t i = 0; i < work->set.n; i++)
        work->own_a[i] = work->placed[i] && work->no_spectrum[0] == '\0'
                             ? spectrum_a(work->s, work->curve[i]) / M_LN10
                             : (double)NAN;
}

wt_status master_uncertainty(master_work *work, wt_error *err)
{
    double *b = arena_numbers(&work->memory, work->set.n);
    if (b == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the overlaps");
    const double b0 = spectrum_b(work->s, work->curve[work->anchor]);
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i])
            b[i] = (spectrum_b(work->s, work->curve[i]) - b0) / M_LN10;
    master_keep_original(work);
    const wt_status status = overlap_chain(&work->set, work->anchor, b, NULL, work->link, err);
    return status == WT_OK ? doubt_shifts(work, err) : status;
}

bool master_all_uncertain(const master_work *work)
{
    const double *doubt = work->posterior->doubt;
    bool all = doubt != NULL;
    for (size_t i = 0; all && i < work->set.n; i++)
        all = i == work->anchor || !work->placed[i] || doubt[work->curve[i]] > master_largest_sigma;
    return all;
}

wt_status master_by_overlap(master_work *work, wt_error *err)
{
    const bool physical = work->options.vertical == WT_VERTICAL_PHYSICAL;
    shift_set *set = &work->set;
    wt_status status = WT_OK;
    for (size_t i = 0; i < set->n; i++) {
        work->placed[i] = work->link[i].placed;
        work->a[i] = work->placed[i] ? work->link[i].a : 0.0;
        work->b[i] = physical ? work->physical[i] : 0.0;
    }
    (void)spectrum_connected(set, work->anchor, work->a, work->placed, work->overlap);
    for (size_t i = 0; i < set->n; i++) {
        set->curves[i].given = work->placed[i];
        set->curves[i].given_a = work->a[i];
    }
    work->route = WT_SHIFTS_OF_OVERLAP;
    work->options.vertical = physical ? WT_VERTICAL_PHYSICAL : WT_VERTICAL_NONE;
    work->lines = false;
    status = master_make_spectrum(work, err);
    if (status == WT_OK)
        status = doubt_shifts(work, err);
    return status == WT_OK ? master_fit_robust(work, err) : status;
}

/* ---- isotherms outside the described part */

bool master_beside_part(const master_work *work, size_t i, double *a, double *error)
{
    const size_t end = i < work->first ? work->first : work->last;
    const overlap_link *link = work->link;
    if (!work->part || (i >= work->first && i <= work->last) || !link[i].placed ||
        !link[end].placed || !work->placed[end])
        return false;
    const wt_interval at = posterior_a(work->posterior, work->curve[end]);
    const double alike = hypot(link[i].spread - link[end].spread, link[i].error - link[end].error);
    *a = at.value + link[i].a - link[end].a;
    *error = sqrt(at.standard_error * at.standard_error + alike * alike +
                  squared_ways(&link[end], &link[i]) +
                  fmax(common_steps(work, i, i) - common_steps(work, end, end), 0.0));
    return true;
}
