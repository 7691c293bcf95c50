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

/* ---- units at one rate ----------------------------------------------------------------------- */

/* Units of two groups of moduli at one rate.
 *
 * A cell is the set of curves of one spot at one rate. The value of a unit is the mean of its
 * cells, each shifted to the middle rate x0 by the slope beta of ln E against ln rate: m = mean(y
 * - beta (x - x0)). If both groups have the same rates, beta cancels. Otherwise its variance adds
 * in proportion to the square of the remaining difference in x. beta is the slope within the spots
 * if they have several rates, because the scatter of the spots does not affect it; otherwise it is
 * the slope between them. */

/* Largest difference of rates of one class [ln]. It is half a decade, because steps of the rate are
 * one or half a decade and a soft group indents slightly faster. A modulus that rises by 6 % per
 * e-fold of rate, as rubber on its plateau, changes by 3 to 4 % from the middle to a limit. Without
 * a slope this difference remains. */
static const double same_rate = 0.5 * M_LN10;

/* Curves of one spot at one rate. */
typedef struct cell {
    int group; /* 0 = bulk, 1 = track */
    size_t unit;
    long rate;   /* class */
    double x, y; /* mean ln rate of the group in this class, mean ln E */
    size_t curves;
} cell;

typedef struct cell_list {
    cell *cell;
    size_t n;
    size_t units[2];
} cell_list;

typedef struct rate_curve {
    long spot, rate;
    double x, y;
} rate_curve;

static int compare_curves(const void *a, const void *b)
{
    const rate_curve *p = a, *q = b;
    if (p->spot != q->spot)
        return p->spot < q->spot ? -1 : 1;
    if (p->rate != q->rate)
        return p->rate < q->rate ? -1 : 1;
    if (p->y < q->y || p->y > q->y)
        return p->y < q->y ? -1 : 1;
    return (p->x > q->x) - (p->x < q->x);
}

/* Returns the curves in an order that does not depend on that of the group, so that sums are
 * reproducible. */
static rate_curve *sort_curves(const wt_group *group, bool by_spot, bool by_rate, arena *memory)
{
    rate_curve *curves = arena_alloc(memory, group->n, sizeof *curves);
    for (size_t i = 0; i < group->n; i++)
        curves[i] =
            (rate_curve){.spot = by_spot ? group->spot[i] : 0,
                         .rate = by_rate && group->rate_class != NULL ? group->rate_class[i] : 0,
                         .x = by_rate && group->rate != NULL ? log(group->rate[i]) : 0,
                         .y = log(group->modulus[i])};
    qsort(curves, group->n, sizeof *curves, compare_curves);
    return curves;
}

static void add_cells(const wt_group *group, int g, bool by_spot, arena *memory, cell_list *to)
{
    const rate_curve *curves = sort_curves(group, by_spot, group->rate != NULL, memory);
    for (size_t i = 0; i < group->n;) {
        const rate_curve first = curves[i];
        to->units[g] += !by_spot || i == 0 || curves[i - 1].spot != first.spot ? 1 : 0;
        cell *c = &to->cell[to->n++];
        *c = (cell){.group = g, .unit = to->units[g] - 1, .rate = first.rate};
        do {
            c->x += curves[i].x;
            c->y += curves[i].y;
            c->curves++;
            i++;
        } while (by_spot && i < group->n && curves[i].spot == first.spot &&
                 curves[i].rate == first.rate);
        c->x /= (double)c->curves;
        c->y /= (double)c->curves;
    }
}

/* Sums over the cells of a class, by group: curves and ln rate. */
typedef struct rate {
    double curves[2], x[2];
} rate;

static size_t count_rates(const cell_list *all)
{
    long last = 0;
    for (size_t i = 0; i < all->n; i++)
        last = all->cell[i].rate > last ? all->cell[i].rate : last;
    return (size_t)last + 1;
}

/* Assigns one rate to each class, and only keeps common rates if there are any. The rates of the
 * curves scatter with their moduli, and the softer group indents slightly faster, which is not the
 * slope. */
static void equalise_rates(cell_list *all, rate *rates, bool *apart)
{
    const size_t n_rates = count_rates(all);
    for (size_t i = 0; i < all->n; i++) {
        const cell *c = &all->cell[i];
        rate *r = &rates[c->rate];
        r->curves[c->group] += (double)c->curves;
        r->x[c->group] += (double)c->curves * c->x;
    }
    *apart = true;
    for (size_t i = 0; i < n_rates; i++)
        *apart = *apart && !(rates[i].curves[0] > 0 && rates[i].curves[1] > 0);
    size_t n_kept = 0;
    for (size_t i = 0; i < all->n; i++) {
        cell c = all->cell[i];
        const rate *r = &rates[c.rate];
        if (!*apart && !(r->curves[1 - c.group] > 0))
            continue;
        c.x = (r->x[0] + r->x[1]) / (r->curves[0] + r->curves[1]);
        all->cell[n_kept++] = c;
    }
    all->n = n_kept;
}

/* ---- sums over the cells --------------------------------------------------------------------- */

/* Sums of one unit. Its cells are adjacent. */
typedef struct unit_sums {
    int group;
    size_t cells, curves;
    double x, y; /* means */
    double xx, xy, yy;
} unit_sums;

static size_t sum_spots(const cell_list *all, unit_sums *spots)
{
    size_t n = 0;
    for (size_t i = 0, end; i < all->n; i = end) {
        const cell *first = &all->cell[i];
        unit_sums s = {.group = first->group};
        for (end = i; end < all->n && all->cell[end].group == first->group &&
                      all->cell[end].unit == first->unit;
             end++) {
            s.cells++;
            s.curves += all->cell[end].curves;
            s.x += all->cell[end].x;
            s.y += all->cell[end].y;
        }
        s.x /= (double)s.cells;
        s.y /= (double)s.cells;
        for (size_t k = i; k < end; k++) {
            const double dx = all->cell[k].x - s.x, dy = all->cell[k].y - s.y;
            s.xx += dx * dx;
            s.xy += dx * dy;
            s.yy += dy * dy;
        }
        spots[n++] = s;
    }
    return n;
}

/* Fits the slope within the spots and tests if it is equal in both groups. */
static void fit_within_spot_slope(const unit_sums *spots, size_t n, compare_units *u)
{
    double xx[2] = {0}, xy[2] = {0}, yy = 0, cells_used = 0;
    for (size_t i = 0; i < n; i++) {
        const unit_sums *s = &spots[i];
        xx[s->group] += s->xx;
        xy[s->group] += s->xy;
        yy += s->yy;
        cells_used += (double)s->cells;
    }
    const double df = cells_used - (double)n - 1, all = xx[0] + xx[1];
    if (!(df >= 1) || !(all > 0))
        return;
    u->slope = (xy[0] + xy[1]) / all;
    u->slope_df = df;
    u->slope_error = sqrt(fmax(0, yy - u->slope * u->slope * all) / df / all);
    if (!(df >= 2) || !(xx[0] > 0) || !(xx[1] > 0))
        return;
    const double bulk = xy[0] / xx[0], track = xy[1] / xx[1];
    const double rest = fmax(0, yy - bulk * xy[0] - track * xy[1]) / (df - 1);
    const double t = fabs(track - bulk) / sqrt(rest * (1 / xx[0] + 1 / xx[1]));
    u->interaction_p = 2 * gsl_cdf_tdist_Q(t, df - 1);
}

/* Computes the means of x over the units of each group, and returns the sum of squares within the
 * groups. */
static double mean_rates(const unit_sums *spots, size_t n, double x[2], double *xy)
{
    double y[2] = {0}, count[2] = {0}, xx = 0;
    x[0] = x[1] = *xy = 0;
    for (size_t i = 0; i < n; i++) {
        count[spots[i].group] += 1;
        x[spots[i].group] += spots[i].x;
        y[spots[i].group] += spots[i].y;
    }
    for (int g = 0; g < 2; g++) {
        x[g] /= count[g];
        y[g] /= count[g];
    }
    for (size_t i = 0; i < n; i++) {
        const double dx = spots[i].x - x[spots[i].group];
        xx += dx * dx;
        *xy += dx * (spots[i].y - y[spots[i].group]);
    }
    return xx;
}

/* Fits the means of the spots by group and ln rate, if each spot has one rate. */
static bool fit_between_spot_slope(const unit_sums *spots, size_t n, double xx, double xy,
                                   double *slope, compare_units *u)
{
    const double df = (double)n - 3;
    if (!(df >= 1) || !(xx > same_rate * same_rate / 4))
        return false;
    *slope = xy / xx;
    double y[2] = {0}, count[2] = {0}, rest = 0, x[2] = {0};
    for (size_t i = 0; i < n; i++) {
        count[spots[i].group] += 1;
        y[spots[i].group] += spots[i].y - *slope * spots[i].x;
        x[spots[i].group] += spots[i].x;
    }
    for (size_t i = 0; i < n; i++) {
        const int g = spots[i].group;
        const double r = spots[i].y - *slope * spots[i].x - y[g] / count[g];
        rest += r * r / df;
    }
    const double dx = x[1] / count[1] - x[0] / count[0];
    u->between_error = sqrt(rest * (1 / count[0] + 1 / count[1] + dx * dx / xx));
    u->between_df = df;
    return true;
}

static void set_unit_values(const unit_sums *spots, size_t n, compare_units *u)
{
    double x[2], xy, slope = 0;
    const double xx = mean_rates(spots, n, x, &xy), dx = x[1] - x[0];
    u->rate_matching = WT_RATES_COMMON;
    u->known = true;
    if (!isnan(u->slope)) {
        slope = u->slope;
        u->shift_variance = dx * dx * u->slope_error * u->slope_error;
        u->rate_matching = u->apart ? WT_RATES_WITHIN : WT_RATES_COMMON;
    } else if (u->apart || xx > same_rate * same_rate / 4) {
        u->rate_matching = WT_RATES_BETWEEN;
        u->known = fit_between_spot_slope(spots, n, xx, xy, &slope, u);
    }
    const double middle = (x[0] + x[1]) / 2;
    for (size_t i = 0; i < n; i++) {
        const int g = spots[i].group;
        u->value[g][u->n[g]++] = spots[i].y - slope * (spots[i].x - middle);
        u->curves[g] += spots[i].curves;
    }
}

static void compare_units_create(const wt_group *const groups[2], bool by_spot, arena *memory,
                                 compare_units *units)
{
    const size_t all = groups[0]->n + groups[1]->n;
    cell_list c = {.cell = arena_alloc(memory, all, sizeof *c.cell)};
    unit_sums *spots = arena_alloc(memory, all, sizeof *spots);
    compare_units u = {.slope = (double)NAN,
                       .slope_error = (double)NAN,
                       .slope_df = (double)NAN,
                       .interaction_p = (double)NAN};
    for (int g = 0; g < 2; g++)
        u.value[g] = arena_numbers(memory, groups[g]->n);
    for (int g = 0; g < 2; g++)
        add_cells(groups[g], g, by_spot, memory, &c);
    rate *rates = arena_alloc(memory, count_rates(&c), sizeof *rates);
    equalise_rates(&c, rates, &u.apart);
    const size_t n = sum_spots(&c, spots);
    fit_within_spot_slope(spots, n, &u);
    set_unit_values(spots, n, &u);
    *units = u;
}

/* ---- one group ------------------------------------------------------------------------------- */

/* Observations: curves, or means over spots. */
typedef struct unit_means {
    double *log_modulus; /* [n] */
    size_t n;
} unit_means;

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

static wt_status create_units(const wt_group *group, bool use_spots, arena *memory, unit_means *u,
                              wt_error *err)
{
    wt_status status = check_moduli(group, err);
    if (status != WT_OK)
        return status;
    gsl_quiet();
    const rate_curve *curves = sort_curves(group, use_spots, false, memory);
    *u = (unit_means){arena_numbers(memory, group->n), 0};
    for (size_t i = 0; i < group->n;) {
        const long first = curves[i].spot;
        double log_sum = 0.0, m = 0.0;
        do {
            log_sum += curves[i].y;
            m += 1.0;
            i++;
        } while (use_spots && i < group->n && curves[i].spot == first);
        u->log_modulus[u->n++] = log_sum / m;
    }
    return WT_OK;
}

/* Variance of the mean of a group due to the scatter of its curves within spots and rates. It is 0
 * if no two curves share both. */
static double within_cell_variance(const wt_group *group, arena *memory)
{
    if (group->spot == NULL)
        return 0; /* each curve is a spot */
    const rate_curve *curves = sort_curves(group, true, true, memory);
    double sum = 0, freedom = 0;
    for (size_t first = 0, end; first < group->n; first = end) {
        double mean = 0;
        for (end = first; end < group->n && curves[end].spot == curves[first].spot &&
                          curves[end].rate == curves[first].rate;
             end++)
            mean += curves[end].y;
        mean /= (double)(end - first);
        for (size_t i = first; i < end; i++)
            sum += pow(curves[i].y - mean, 2);
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
