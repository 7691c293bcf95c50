/* Groups of moduli and their comparison.
 *
 * Moduli scatter by factors, so all statistics use ln E: ratio, interval, p value and effect size
 * (Hedges, J. Educ. Stat. 6 (1981) 107). Curves on one spot share the position and are not
 * independent. If spots are known, the spot is the unit and its mean the observation.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/group_statistics.h"
#include "core/base/array.h"
#include "core/math/special.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct spot_modulus {
    long spot;
    double modulus;
} spot_modulus;

/* Observations: curves, or means over spots. */
typedef struct unit_means {
    double *log_modulus; /* [n] */
    size_t n;
} unit_means;

static int by_spot(const void *a, const void *b)
{
    const spot_modulus *x = a, *y = b;
    if (x->spot != y->spot)
        return x->spot < y->spot ? -1 : 1;
    return (x->modulus > y->modulus) - (x->modulus < y->modulus);
}

static wt_status check_moduli(const wt_group *group, wt_error *err)
{
    if (group->n == 0)
        return wt_fail(err, WT_E_EMPTY, "the group has no accepted curve");
    for (size_t i = 0; i < group->n; i++) {
        if (!(group->modulus[i] > 0.0) || !isfinite(group->modulus[i])) {
            wt_status status = wt_fail(err, WT_E_RANGE, "a modulus of the group is not usable");
            wt_error_place(err, "value %zu of %zu", i + 1, group->n);
            wt_error_expected(err, "a value above 0 Pa");
            wt_error_found(err, "%g Pa", group->modulus[i]);
            return status;
        }
    }
    return WT_OK;
}

/* Creates the units in an order that does not depend on that of the curves, so that sums are
 * reproducible. */
static wt_status create_units(const wt_group *group, bool use_spots, arena *memory, unit_means *u,
                              wt_error *err)
{
    wt_status status = check_moduli(group, err);
    if (status != WT_OK)
        return status;
    gsl_quiet();
    spot_modulus *curves = arena_alloc(memory, group->n, sizeof *curves);
    *u = (unit_means){arena_numbers(memory, group->n), 0};
    for (size_t i = 0; i < group->n; i++)
        curves[i] = (spot_modulus){use_spots ? group->spot[i] : 0, group->modulus[i]};
    qsort(curves, group->n, sizeof *curves, by_spot);
    for (size_t i = 0; i < group->n;) {
        long spot = curves[i].spot;
        double log_sum = 0.0, m = 0.0;
        do {
            log_sum += log(curves[i].modulus);
            m += 1.0;
            i++;
        } while (use_spots && i < group->n && curves[i].spot == spot);
        u->log_modulus[u->n++] = log_sum / m;
    }
    return WT_OK;
}

typedef struct curve_cell {
    long spot, rate_class;
    double log_modulus;
} curve_cell;

static int compare_cells(const void *a, const void *b)
{
    const curve_cell *x = a, *y = b;
    if (x->spot != y->spot)
        return x->spot < y->spot ? -1 : 1;
    if (x->rate_class != y->rate_class)
        return x->rate_class < y->rate_class ? -1 : 1;
    return (x->log_modulus > y->log_modulus) - (x->log_modulus < y->log_modulus);
}

/* Variance of the mean of a group due to the scatter of its curves within spots and rates. It is 0
 * if no two curves share both. */
static double within_cell_variance(const wt_group *group, arena *memory)
{
    if (group->spot == NULL)
        return 0; /* each curve is a spot */
    curve_cell *cells = arena_alloc(memory, group->n, sizeof *cells);
    double sum = 0, freedom = 0;
    for (size_t i = 0; i < group->n; i++)
        cells[i] =
            (curve_cell){group->spot[i], group->rate_class != NULL ? group->rate_class[i] : 0,
                         log(group->modulus[i])};
    qsort(cells, group->n, sizeof *cells, compare_cells);
    for (size_t first = 0, end; first < group->n; first = end) {
        double mean = 0;
        for (end = first; end < group->n && cells[end].spot == cells[first].spot &&
                          cells[end].rate_class == cells[first].rate_class;
             end++)
            mean += cells[end].log_modulus;
        mean /= (double)(end - first);
        for (size_t i = first; i < end; i++)
            sum += pow(cells[i].log_modulus - mean, 2);
        freedom += (double)(end - first) - 1;
    }
    return freedom > 0 ? sum / freedom / (double)group->n : 0;
}

static void summarise_group(const wt_group *group, const unit_means *u, arena *memory,
                            wt_group_summary *summary)
{
    double *sorted = arena_numbers(memory, group->n);
    memcpy(sorted, group->modulus, group->n * sizeof *sorted);
    numbers_sort(sorted, group->n);
    moments curves = sample_moments(sorted, group->n), logs = sample_moments(u->log_modulus, u->n);
    size_t half = group->n / 2;
    *summary = (wt_group_summary){
        .n = group->n,
        .n_rejected = group->n_rejected,
        .n_spots = u->n,
        .mean = curves.mean,
        .standard_deviation = sqrt(curves.variance),
        .geometric_mean = exp(logs.mean),
        .log_standard_error = sqrt(logs.variance / logs.n),
        .df = logs.n - 1,
        .low = (double)NAN,
        .high = (double)NAN,
        .median = group->n % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]),
    };
    if (u->n == 1 && group->spot_scatter > 0) {
        summary->log_standard_error =
            sqrt(group->spot_scatter * group->spot_scatter + within_cell_variance(group, memory));
        summary->df = (double)INFINITY;
    }
    if (!isnan(summary->log_standard_error)) {
        const double half_width = students_t_quantile(summary->df) * summary->log_standard_error;
        summary->low = exp(logs.mean - half_width);
        summary->high = exp(logs.mean + half_width);
    }
}

wt_status wt_group_summarise(const wt_group *group, wt_group_summary *summary, wt_error *err)
{
    unit_means u;
    arena memory = {0};
    wt_status status = create_units(group, group->spot != NULL, &memory, &u, err);
    if (status == WT_OK)
        summarise_group(group, &u, &memory, summary);
    arena_free(&memory);
    return status;
}

/* ---- two groups ------------------------------------------------------------------------------ */

/* Summarises bulk and track. The units are spots if both groups have them. */
static wt_status summarise_groups(const wt_group *const groups[2], arena *memory, wt_comparison *c,
                                  wt_error *err)
{
    wt_group_summary *const summaries[2] = {&c->bulk, &c->track};
    wt_status status = WT_OK;
    c->by_spot = groups[0]->spot != NULL && groups[1]->spot != NULL;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        unit_means u;
        status = create_units(groups[g], c->by_spot, memory, &u, err);
        if (status == WT_OK)
            summarise_group(groups[g], &u, memory, summaries[g]);
    }
    return status;
}

/* True if the spots do not determine their scatter. */
static bool has_few_spots(const compare_units *u)
{
    const size_t fewer = u->n[0] < u->n[1] ? u->n[0] : u->n[1],
                 more = u->n[0] < u->n[1] ? u->n[1] : u->n[0];
    return fewer < 2 && more < COMPARE_MIN_SPOTS;
}

/* Returns the reason why the comparison is undecided. `given` states that the scatter of the spots
 * of both groups is given. */
static wt_verdict_undecided_reason undecided_reason(const compare_units *u, bool given)
{
    const bool has_single_unit = u->n[0] < 2 || u->n[1] < 2;
    if ((has_few_spots(u) && !given) || (has_single_unit && u->rate_matching == WT_RATES_BETWEEN))
        return WT_UNDECIDED_ONE_SPOT;
    if (!u->known)
        return WT_UNDECIDED_NO_COMMON_RATE;
    return u->apart && u->interaction_p < 0.05 ? WT_UNDECIDED_SLOPES_DIFFER : WT_UNDECIDED_NOT;
}

/* Sets Hedges' g with the pooled standard deviation. */
static void set_effect_size(moments a, moments b, wt_comparison *c)
{
    const double df = a.n + b.n - 2.0;
    double sum = a.n > 1 ? (a.n - 1.0) * a.variance : 0.0;
    sum += b.n > 1 ? (b.n - 1.0) * b.variance : 0.0;
    c->scatter = df > 0.0 ? sqrt(sum / df) : (double)NAN;
    c->effect_size = c->undecided_reason == WT_UNDECIDED_NOT
                         ? c->log_ratio.value / c->scatter * (1.0 - 3.0 / (4.0 * df - 1.0))
                         : (double)NAN;
}

/* Sets the interval of the ratio. `given` is the variance of the difference if the spots do not
 * determine it. */
static void set_ratio_interval(const compare_units *u, moments a, moments b, double known,
                               double given, wt_comparison *c)
{
    const t_error shift = {sqrt(u->shift_variance), u->slope_df};
    t_error e = compare_welch(a, b, shift, known);
    c->scatter_is_stated = has_few_spots(u);
    if (c->scatter_is_stated)
        e = t_error_add_normal(shift, known + given);
    if (c->rate_matching == WT_RATES_BETWEEN)
        e = t_error_add_normal((t_error){u->between_error, u->between_df}, known);
    const double half_width = students_t_quantile(e.df) * e.error;
    c->log_ratio.standard_error = e.error;
    c->df = e.df;
    c->ratio_low = exp(c->log_ratio.value - half_width);
    c->ratio_high = exp(c->log_ratio.value + half_width);
    c->t = c->log_ratio.value / e.error;
    c->p =
        2.0 * (isinf(e.df) ? gsl_cdf_ugaussian_Q(fabs(c->t)) : gsl_cdf_tdist_Q(fabs(c->t), e.df));
    c->offset_variance_share = known / (e.error * e.error);
}

static wt_status compare_values(const compare_units *u, const wt_estimate *offset,
                                const wt_group *const groups[2], arena *memory, wt_comparison *c,
                                wt_error *err)
{
    const moments a = sample_moments(u->value[0], u->n[0]);
    const moments b = sample_moments(u->value[1], u->n[1]);
    const double known = offset != NULL ? offset->standard_error * offset->standard_error : 0.0;
    c->undecided_reason =
        undecided_reason(u, groups[0]->spot_scatter > 0 && groups[1]->spot_scatter > 0);
    if (c->undecided_reason == WT_UNDECIDED_NOT && !has_few_spots(u) && !(a.variance > 0.0) &&
        !(b.variance > 0.0)) {
        wt_status status =
            wt_fail(err, WT_E_RANGE, "all moduli of each group are equal: no scatter");
        wt_error_advice(err, "measured moduli scatter; are these values copies of one curve?");
        return status;
    }
    if (u->known) {
        c->log_ratio.value = b.mean - a.mean - (offset != NULL ? offset->value : 0.0);
        c->ratio = exp(c->log_ratio.value);
    }
    set_effect_size(a, b, c);
    if (c->undecided_reason != WT_UNDECIDED_NOT)
        return WT_OK;
    double given = 0;
    if (has_few_spots(u))
        for (int g = 0; g < 2; g++) {
            const double spot = groups[g]->spot_scatter, all = (double)groups[g]->n;
            given += spot * spot / (double)u->n[g];
            if (c->by_spot) /* scatter of the curves in the comparison */
                given += within_cell_variance(groups[g], memory) * all / (double)u->curves[g];
        }
    set_ratio_interval(u, a, b, known, given, c);
    compare_ranks(u, memory, c);
    return WT_OK;
}

wt_status wt_compare_moduli(const wt_group *bulk, const wt_group *track, const wt_estimate *offset,
                            wt_comparison *result, wt_error *err)
{
    const double none = (double)NAN;
    const wt_group *const groups[2] = {bulk, track};
    wt_comparison c = {.log_ratio = {none, none, 0.0, "1"},
                       .df = none,
                       .ratio = none,
                       .ratio_low = none,
                       .ratio_high = none,
                       .t = none,
                       .p = none,
                       .effect_size = none,
                       .offset_variance_share = none,
                       .mann_whitney_u = none,
                       .mann_whitney_p = none,
                       .mann_whitney_smallest_p = none};
    arena memory = {0};
    compare_units u;
    wt_status status = summarise_groups(groups, &memory, &c, err);
    if (status == WT_OK) {
        compare_units_create(groups, c.by_spot, &memory, &u);
        c.n_bulk = u.n[0];
        c.n_track = u.n[1];
        c.curves_bulk = u.curves[0];
        c.curves_track = u.curves[1];
        c.rate_matching = u.rate_matching;
        c.rate_slope = (wt_estimate){u.slope, u.slope_error, 0.0, "1"};
        c.interaction_p = u.interaction_p;
        status = compare_values(&u, offset, groups, &memory, &c, err);
    }
    arena_free(&memory);
    if (status == WT_OK)
        *result = c;
    return status;
}

double wt_equivalent_frequency(double load_time, double force_exponent)
{
    if (!(load_time > 0.0))
        return (double)NAN;
    return exp(digamma(force_exponent + 1.0)) / load_time;
}
