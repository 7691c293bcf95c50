/* Master curve of isotherms that one spectrum does not describe: shifts by the overlap of
 * neighbours, and a spectrum fitted to them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/math/arena_gsl.h"
#include "dma/numerics/isotherm.h"

#include <math.h>

/* Shifts of the spectrum and of the overlaps disagree if they differ by more standard errors
 * than this. */
static const double agreement_limit = 2.0;

/* Returns true if all shifts of the spectrum agree with the overlaps. */
static bool shifts_match_edges(const master_work *work, const overlap_edge *edge)
{
    const spectrum *s = work->s;
    for (size_t i = 0; i < work->set.n; i++) {
        const long column = work->placed[i] ? s->column_a[work->curve[i]] : -1;
        if (column < 0)
            continue;
        const double variance = spectrum_variance(s, work->curve[i]);
        const double error = sqrt(variance) / M_LN10;
        const double off = spectrum_a(s, work->curve[i]) / M_LN10 - edge[i].a;
        if (!(error <= master_max_shift_error &&
              fabs(off) <= agreement_limit * hypot(edge[i].error, error)))
            return false;
    }
    return true;
}

bool master_shifts_agree(const master_work *work)
{
    arena memory = {0};
    overlap_edge *edge = arena_alloc(&memory, work->set.n, sizeof *edge);
    bool agree = false;
    for (int physical = 0; physical < 2 && !agree; physical++) {
        master_overlap_edges(work, physical == 1, edge);
        agree = shifts_match_edges(work, edge);
    }
    arena_free(&memory);
    return agree;
}

bool master_can_use_overlaps(master_work *work)
{
    size_t placed = 0;
    bool given = !work->set.used[STORAGE];
    for (size_t i = 0; i < work->set.n; i++)
        given = given || work->set.curves[i].is_shift_fixed;
    if (given)
        return false;
    master_find_overlaps(work);
    for (size_t i = 0; i < work->set.n; i++)
        placed += work->edge[i].placed;
    return placed > 1;
}

static size_t distance_to_anchor(const master_work *work, size_t i)
{
    return i > work->anchor ? i - work->anchor : work->anchor - i;
}

/* Returns the sum of squared errors of the steps between two isotherms. */
static double path_variance(const master_work *work, size_t left, size_t right)
{
    double sum = 0.0;
    while (left != right) {
        size_t *const next =
            distance_to_anchor(work, left) > distance_to_anchor(work, right) ? &left : &right;
        sum += work->edge[*next].step * work->edge[*next].step;
        *next = work->edge[*next].onto;
    }
    return sum;
}

/* Returns the sum of squared errors of the steps that the ways of two isotherms to the root
 * share. */
static double shared_step_variance(const master_work *work, size_t left, size_t right)
{
    const size_t root = work->root;
    if (left == right)
        return path_variance(work, left, root);
    return 0.5 * (path_variance(work, left, root) + path_variance(work, right, root) -
                  path_variance(work, left, right));
}

/* Returns an error of a shift against the root from the errors of both against the anchor, which
 * grow from neighbour to neighbour. */
static double error_to_root(const master_work *work, size_t i, double own, double of_root)
{
    const bool same_side = (i < work->anchor) == (work->root < work->anchor);
    return same_side ? fabs(own - of_root) : own + of_root;
}

/* Converts a misfit of E' to a shift [decade], from the slope of the isotherms. It may
 * accumulate from one isotherm to the next if the material changes with temperature. */
static double misfit_to_shift(const master_work *work, double missed, size_t from, size_t i)
{
    double sum = 0.0;
    for (; i != from; i = i < from ? i + 1 : i - 1) {
        const shift_curve *c = &work->set.curves[i];
        if (c->n < SHIFT_MIN_POINTS)
            continue;
        sum += missed / M_LN10 * (c->x[c->n - 1] - c->x[0]) / curve_modulus_change(&work->set, i);
    }
    return sum;
}

/* Returns the shift error due to the misfit of the spectrum [decade]. If one spectrum fails,
 * slow and fast times shift differently, in an unknown direction. */
static double spectrum_misfit_shift(const master_work *work, size_t i)
{
    bool given = false;
    for (size_t k = 0; k < work->set.n; k++)
        given = given || work->set.curves[k].is_shift_fixed;
    if (given || master_misfit_is_loss_factor(&work->lack))
        return 0.0; /* stated shifts may cause the misfit; a factor on all E'' does not affect
                       shifts */
    const double missed = sqrt(work->lack.beyond) * work->missed[STORAGE];
    return hypot(work->lack.parted * (work->original_a[i] - work->original_a[work->root]),
                 misfit_to_shift(work, missed, work->root, i));
}

/* Returns the squared change of a shift by alternatives as good as E' alone, between two
 * isotherms. If one spectrum fails, no alternative is known to be right. */
static double alternative_variance(const overlap_edge *from, const overlap_edge *to)
{
    const double by_loss = to->by_loss - from->by_loss,
                 by_vertical = to->by_vertical - from->by_vertical;
    return by_loss * by_loss + by_vertical * by_vertical;
}

/* Returns the variance of one shift due to the overlaps [decade^2]. Weak overlaps add no error
 * to a spectrum. */
static double overlap_variance(const master_work *work, size_t i)
{
    const overlap_edge *edge = &work->edge[i];
    if (!edge->placed)
        return 0.0;
    const overlap_edge *root = &work->edge[work->root];
    const double error = error_to_root(work, i, edge->error, root->error),
                 spread = error_to_root(work, i, edge->spread, root->spread);
    const double square = shared_step_variance(work, i, i) + error * error;
    const double alike = spread * spread;
    if (work->route == WT_SHIFTS_FROM_OVERLAP)
        return square + alike + alternative_variance(root, edge);
    const double difference =
        edge->a - root->a - (work->original_a[i] - work->original_a[work->root]);
    const double off = isnan(difference) ? 0.0 : fabs(difference);
    return alike + pow(fmax(off - agreement_limit * sqrt(square), 0.0), 2);
}

/* Returns true if the user stated the shift. Shifts of overlaps are also fixed, but do not count
 * here. */
static bool is_user_stated(const master_work *work, size_t i)
{
    return work->route != WT_SHIFTS_FROM_OVERLAP && work->set.curves[i].is_shift_fixed;
}

/* Sets the errors of the shifts if superposition fails or may fail. They combine the scatter
 * within the overlaps, the difference of spectrum and overlaps, and the misfit. The law treats
 * them as independent step errors of the same total size, because a common error leaves its form
 * unchanged. An error that is only possible is ignored by the law. Stated shifts have no error. */
static void set_extra_shift_errors(master_work *work)
{
    const size_t n = work->set.n;
    wt_posterior *p = work->posterior;
    const bool may =
        work->route != WT_SHIFTS_FROM_OVERLAP && !master_misfit_is_significant(&work->lack);
    const bool fails = !may && !master_loss_is_inconsistent(&work->lack);
    double all = 0.0, steps = 0.0;
    p->extra_error = arena_numbers(&p->memory, work->s->n_curves);
    p->extra_covariance = arena_matrix(&p->memory, work->s->n_curves, work->s->n_curves);
    for (size_t i = 0; i < n; i++) {
        if (!work->placed[i] || is_user_stated(work, i))
            continue;
        const double own =
            work->route == WT_SHIFTS_FROM_OVERLAP ? 0.0 : spectrum_misfit_shift(work, i);
        const double square = overlap_variance(work, i);
        const double sure = fails ? square + own * own : square;
        p->extra_error[work->curve[i]] = hypot(sqrt(square), own);
        all += work->edge[i].placed ? sure : 0.0;
        steps += work->edge[i].placed ? shared_step_variance(work, i, i) : 0.0;
        for (size_t k = 0; k < n; k++)
            if (work->placed[k] && !is_user_stated(work, k) && work->edge[i].placed &&
                work->edge[k].placed && (i < work->root) == (k < work->root))
                gsl_matrix_set(p->extra_covariance, work->curve[i], work->curve[k],
                               shared_step_variance(work, i, k));
    }
    gsl_matrix_scale(p->extra_covariance, steps > 0.0 ? all / steps : 1.0);
    if (may)
        gsl_matrix_set_zero(p->extra_covariance);
    for (size_t i = 0; i < n; i++) /* without an overlap the error is independent */
        if (work->placed[i] && !is_user_stated(work, i) && !work->edge[i].placed)
            gsl_matrix_set(p->extra_covariance, work->curve[i], work->curve[i],
                           fails ? pow(p->extra_error[work->curve[i]], 2) : 0.0);
}

void master_refer_errors(master_work *work)
{
    wt_posterior *p = work->posterior;
    if (work->route != WT_SHIFTS_FROM_OVERLAP && master_reference_is_fitted(work))
        (void)spectrum_select_connected(&work->set, work->at, work->a, work->placed, work->overlap);
    if (p->extra_error == NULL)
        return;
    work->base_error = p->extra_error;
    const bool can_refer =
        master_reference_is_fitted(work) && work->edge[work->at].placed && work->at != work->anchor;
    if (can_refer) {
        work->root = work->at;
        set_extra_shift_errors(work);
    }
}

void master_store_original_shifts(master_work *work)
{
    for (size_t i = 0; i < work->set.n; i++)
        work->original_a[i] = work->placed[i] && work->no_spectrum[0] == '\0'
                                  ? spectrum_a(work->s, work->curve[i]) / M_LN10
                                  : (double)NAN;
}

void master_uncertainty(master_work *work)
{
    double *b = arena_numbers(&work->memory, work->set.n);
    const double b0 = spectrum_b(work->s, work->curve[work->anchor]);
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i])
            b[i] = (spectrum_b(work->s, work->curve[i]) - b0) / M_LN10;
    master_store_original_shifts(work);
    overlap_chain(&work->set, work->anchor, b, NULL, work->edge);
    set_extra_shift_errors(work);
}

bool master_all_uncertain(const master_work *work)
{
    const double *extra_error = work->posterior->extra_error;
    bool all = extra_error != NULL;
    for (size_t i = 0; all && i < work->set.n; i++)
        all = i == work->anchor || !work->placed[i] ||
              extra_error[work->curve[i]] > master_max_shift_error;
    return all;
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
    work->route = WT_SHIFTS_FROM_OVERLAP;
    work->options.vertical = physical ? WT_VERTICAL_PHYSICAL : WT_VERTICAL_NONE;
    work->lines = false;
    const wt_status status = master_new_spectrum(work, err);
    if (status != WT_OK)
        return status;
    set_extra_shift_errors(work);
    return master_fit_robust(work, err);
}

/* ---- isotherms outside the described part ---------------------------------------------------- */

bool master_shift_outside_part(const master_work *work, size_t i, double *a, double *error)
{
    const size_t end = i < work->first ? work->first : work->last;
    const overlap_edge *edge = work->edge;
    if (!work->part || (i >= work->first && i <= work->last) || !edge[i].placed ||
        !edge[end].placed || !work->placed[end])
        return false;
    const wt_interval at = posterior_a(work->posterior, work->curve[end]);
    const double alike = hypot(edge[i].spread - edge[end].spread, edge[i].error - edge[end].error);
    *a = at.value + edge[i].a - edge[end].a;
    *error = sqrt(at.standard_error * at.standard_error + alike * alike +
                  alternative_variance(&edge[end], &edge[i]) + path_variance(work, i, end));
    return true;
}
