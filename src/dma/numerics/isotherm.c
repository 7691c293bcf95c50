/* Isotherms as logarithms, the shift of one onto another, and start positions of all, one by one
 * from the anchor outwards.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/isotherm.h"

#include "core/base/array.h"
#include "core/base/text.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- isotherms as logarithms ----------------------------------------------------------------- */

struct point {
    double x, y[MODULI];
};

struct order {
    double temperature;
    size_t index;
};

static int compare_isotherm_order(const void *left, const void *right)
{
    const struct order *a = left, *b = right;
    if (a->temperature != b->temperature)
        return a->temperature > b->temperature ? 1 : -1;
    return (a->index > b->index) -
           (a->index < b->index); /* runs at one temperature keep their order */
}

/* Returns tan delta of a point. */
static double loss_factor_value(const wt_isotherm *t, size_t k)
{
    return t->loss_factor != NULL ? t->loss_factor[k] : t->loss_modulus[k] / t->storage_modulus[k];
}

static wt_status check_isotherm_temperatures(const wt_sweep *sweep, wt_error *err)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const double t = sweep->isotherms[i].temperature;
        if (isfinite(t) && t > 0.0)
            continue;
        wt_status status =
            wt_fail(err, WT_E_RANGE, "isotherm %zu has no usable temperature", i + 1);
        wt_error_place(err, "%s", sweep->isotherms[i].source);
        wt_error_expected(err, "an absolute temperature above 0 K");
        wt_error_found(err, "%g", t);
        wt_error_advice(err, "check the temperature column and its unit");
        return status;
    }
    return WT_OK;
}

/* Returns the quantities of a point that are fitted, NaN if unmeasured. */
static void fitted_values(const wt_isotherm *t, wt_shift_quantity by, size_t k,
                          double value[MODULI])
{
    value[STORAGE] = t->storage_modulus[k];
    value[LOSS] = t->loss_modulus[k];
    if (by == WT_SHIFT_LOSS_FACTOR)
        value[LOSS] = loss_factor_value(t, k);
}

/* Points within this range are replaced by their mean [decade]. A relaxation broadens moduli
 * over a decade, so nothing changes within a tenth of it. */
static const double merge_width = 0.09;

/* Evenly spaced points are merged from two per group on, other points from five on. A few close
 * points cost little and stay unchanged. */
enum { LEAST_EVEN = 2, LEAST_TOGETHER = 5 };
static const double even_spacing_ratio = 1.5; /* largest step divided by the mean step */

/* In groups of LEAST_MANY or more, points farther from the median are excluded from the mean
 * [standard deviations]. */
static const double outlier_limit = 5.0;
enum { LEAST_MANY = 5 };

/* Returns the end of the group that starts at `from`. With `alone` each point is its own group. */
static size_t end_of_merge_range(const struct point *point, size_t n, size_t from, bool is_unmerged)
{
    size_t to = from + 1;
    while (!is_unmerged && to < n && point[to].x - point[from].x < merge_width)
        to++;
    return to;
}

static bool is_evenly_spaced(const struct point *point, size_t n)
{
    const double mean = (point[n - 1].x - point[0].x) / (double)(n - 1);
    bool is = true;
    for (size_t k = 1; k < n; k++)
        is = is && point[k].x - point[k - 1].x <= even_spacing_ratio * mean;
    return is;
}

/* Returns true if merging would save little or would leave too few points. */
static bool is_sparse(const struct point *point, size_t n)
{
    size_t left = 0;
    for (size_t k = 0; k < n; k = end_of_merge_range(point, n, k, false))
        left++;
    return left < SHIFT_MIN_POINTS ||
           n < (is_evenly_spaced(point, n) ? LEAST_EVEN : LEAST_TOGETHER) * left;
}

/* Returns the mean of a group without outliers; copy: [n] scratch. */
static double robust_mean(const struct point *point, size_t n, int q, double *copy)
{
    double sum = 0.0, weights = 0.0;
    for (size_t k = 0; k < n; k++)
        copy[k] = point[k].y[q];
    const double median = numbers_median(copy, n);
    for (size_t k = 0; k < n; k++)
        copy[k] = fabs(point[k].y[q] - median);
    const double outlier_distance = outlier_limit * 1.4826 * numbers_median(copy, n);
    for (size_t k = 0; k < n; k++) {
        const bool is_inlier = n < LEAST_MANY || fabs(point[k].y[q] - median) <= outlier_distance;
        sum += is_inlier ? point[k].y[q] : 0.0;
        weights += is_inlier;
    }
    return sum / weights; /* weights > 0, because half of the points are inliers */
}

/* Stores the points for the fit, rising and merged. curve->y also serves as scratch. */
static void merge_curve_points(const struct point *point, size_t n, shift_curve *curve)
{
    const bool is_unmerged = is_sparse(point, n);
    curve->n = 0;
    for (size_t from = 0, to; from < n; from = to, curve->n++) {
        to = end_of_merge_range(point, n, from, is_unmerged);
        double x = 0.0;
        for (size_t i = from; i < to; i++)
            x += point[i].x / (double)(to - from);
        curve->x[curve->n] = x;
        for (int q = 0; q < MODULI; q++)
            curve->y[q][curve->n] =
                to - from > 1 ? robust_mean(point + from, to - from, q, curve->y[q] + from)
                              : point[from].y[q];
    }
    curve->n_merged = is_unmerged ? 0 : n;
}

/* Up to this number of isotherms one without usable points is an error. */
enum { LEAST_USABLE = 3 };

/* Writes frequency and moduli of a point, without those that were not measured. */
static void describe_point(const wt_isotherm *isotherm, size_t i, char *text, size_t size)
{
    const double modulus[MODULI] = {
        [STORAGE] = isotherm->storage_modulus[i], [LOSS] = isotherm->loss_modulus[i]};
    clocale_print(text, size, "%g rad/s", isotherm->angular_frequency[i]);
    for (int q = 0; q < MODULI; q++)
        if (!isnan(modulus[q]))
            clocale_append(text, size, ", %s %g Pa",
                           q == LOSS              ? "loss"
                           : isnan(modulus[LOSS]) ? "modulus"
                                                  : "storage",
                           modulus[q]);
}

static wt_status fail_too_few_points(const wt_isotherm *isotherm, size_t n, size_t first_bad,
                                     wt_error *err)
{
    char point[96];
    describe_point(isotherm, first_bad, point, sizeof point);
    wt_fail(err, WT_E_RANGE,
            "the isotherm of %.2f °C has too few points with positive frequency and moduli",
            isotherm->temperature - WT_ZERO_CELSIUS);
    wt_error_place(err, "%s", isotherm->source);
    wt_error_expected(err, "at least %d", SHIFT_MIN_POINTS);
    wt_error_found(err, "%zu of %zu; point %zu: %s", n, isotherm->n, first_bad + 1, point);
    wt_error_advice(err, "leave this temperature out of the sweep");
    return WT_E_RANGE;
}

/* Fills one curve from an isotherm; scratch: [isotherm->n]. An isotherm without usable points is
 * left out, unless two or fewer would remain. */
static wt_status fill_shift_curve(const wt_isotherm *isotherm, const shift_set *set,
                                  struct point *scratch, shift_curve *curve, wt_log *log,
                                  wt_error *err)
{
    size_t n = 0;
    size_t first_bad = isotherm->n;
    for (size_t k = 0; k < isotherm->n; k++) {
        const double w = isotherm->angular_frequency[k];
        double value[MODULI];
        bool good = w > 0.0 && isfinite(w);
        fitted_values(isotherm, set->quantity, k, value);
        for (int q = 0; q < MODULI; q++) {
            good = good && (!set->used[q] || (value[q] > 0.0 && isfinite(value[q])));
            value[q] = set->used[q] ? log10(value[q]) : 0.0;
        }
        if (good) {
            scratch[n++] = (struct point){log10(w), {value[STORAGE], value[LOSS]}};
        } else {
            if (first_bad == isotherm->n)
                first_bad = k;
            curve->n_skipped++;
        }
    }
    if (curve->n_skipped > 0 && n < SHIFT_MIN_POINTS) {
        clocale_print(curve->exclusion, sizeof curve->exclusion,
                      "left out: %zu of %zu points have no positive modulus", curve->n_skipped,
                      isotherm->n);
        curve->n_skipped = 0;
        curve->has_no_moduli = true;
        return set->n <= LEAST_USABLE ? fail_too_few_points(isotherm, n, first_bad, err) : WT_OK;
    }
    if (curve->n_skipped > 0) {
        char point[96];
        describe_point(isotherm, first_bad, point, sizeof point);
        wt_log_add(log, WT_WARNING, isotherm->source, NULL,
                   "isotherm of %.2f °C: %zu of %zu points left out, no positive modulus "
                   "(first: %s)",
                   isotherm->temperature - WT_ZERO_CELSIUS, curve->n_skipped, isotherm->n, point);
    }
    qsort(scratch, n, sizeof *scratch, numbers_compare);
    merge_curve_points(scratch, n, curve);
    return WT_OK;
}

/* Finds the quantities that all isotherms have at some point. */
static void find_measured_moduli(const wt_sweep *sweep, bool has[MODULI], bool *factor)
{
    has[STORAGE] = has[LOSS] = *factor = true;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *t = &sweep->isotherms[i];
        bool storage = t->n == 0, loss = storage, ratio = storage;
        for (size_t k = 0; k < t->n; k++) {
            storage = storage || isfinite(t->storage_modulus[k]);
            loss = loss || isfinite(t->loss_modulus[k]);
            ratio = ratio || isfinite(loss_factor_value(t, k));
        }
        has[STORAGE] = has[STORAGE] && storage;
        has[LOSS] = has[LOSS] && loss;
        *factor = *factor && ratio;
    }
}

static wt_status choose_fitted_quantities(const wt_sweep *sweep, wt_shift_quantity by,
                                          shift_set *set, wt_error *err)
{
    static const char *const names[] = {[WT_SHIFT_MODULI] = "storage or loss modulus",
                                        [WT_SHIFT_STORAGE] = "storage modulus",
                                        [WT_SHIFT_LOSS] = "loss modulus",
                                        [WT_SHIFT_LOSS_FACTOR] = "loss factor"};
    bool has[MODULI], factor;
    find_measured_moduli(sweep, has, &factor);
    if (by == WT_SHIFT_MODULI && !(has[STORAGE] && has[LOSS]))
        by = has[STORAGE] ? WT_SHIFT_STORAGE : has[LOSS] ? WT_SHIFT_LOSS : WT_SHIFT_LOSS_FACTOR;
    set->quantity = by;
    set->used[STORAGE] = by == WT_SHIFT_MODULI || by == WT_SHIFT_STORAGE;
    set->used[LOSS] = by != WT_SHIFT_STORAGE;
    if (by == WT_SHIFT_LOSS_FACTOR
            ? factor
            : set->used[STORAGE] <= has[STORAGE] && set->used[LOSS] <= has[LOSS])
        return WT_OK;
    wt_fail(err, WT_E_MISSING, "not all isotherms have a %s", names[by]);
    wt_error_expected(err, "the same of all: storage modulus, loss modulus or loss factor");
    return WT_E_MISSING;
}

/* A gap of the temperatures above which isotherms may be in kelvin, and how far outside the others
 * they may be when converted [K]. */
static const double kelvin_gap = 100.0, kelvin_margin = 20.0;

/* Leaves out isotherms whose temperatures are only plausible as kelvin that were read as degrees
 * Celsius: they lie far above the others, and converted they lie among them. At most a third of the
 * isotherms. */
static void exclude_kelvin(shift_set *set)
{
    const shift_curve *c = set->curves;
    size_t first = set->n > 0 ? set->n - 1 : 0;
    while (first > 0 && 3 * (set->n - first) <= set->n &&
           !(c[first].temperature - c[first - 1].temperature > kelvin_gap))
        first--;
    if (first == 0 || 3 * (set->n - first) > set->n)
        return;
    for (size_t i = first; i < set->n; i++) {
        const double t = c[i].temperature - WT_ZERO_CELSIUS;
        if (t < c[0].temperature - kelvin_margin || t > c[first - 1].temperature + kelvin_margin)
            return;
    }
    for (size_t i = first; i < set->n; i++) {
        clocale_print(set->curves[i].exclusion, sizeof set->curves[i].exclusion,
                      "left out: its temperature looks like kelvin read as °C (%.2f K is %.2f °C)",
                      c[i].temperature - WT_ZERO_CELSIUS, c[i].temperature - 2.0 * WT_ZERO_CELSIUS);
        set->n_points -= c[i].n;
        set->curves[i].n = 0;
    }
}

wt_status shift_set_new(const wt_sweep *sweep, const wt_master_options *options, wt_log *log,
                        arena *memory, shift_set *set, wt_error *err)
{
    const size_t n = sweep->n_isotherms;
    size_t n_points = 0, n_longest = 1;
    wt_status status = check_isotherm_temperatures(sweep, err);

    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < n; i++) {
        n_points += sweep->isotherms[i].n;
        n_longest = sweep->isotherms[i].n > n_longest ? sweep->isotherms[i].n : n_longest;
    }
    if (n < 1 || n_points == 0) {
        status = wt_fail(err, WT_E_MISSING, "a master curve needs an isotherm with points");
        wt_error_found(err, "%zu isotherms, %zu points", n, n_points);
        wt_error_advice(err, "give all temperatures of the sweep together");
        return status;
    }
    struct order *order = arena_alloc(memory, n, sizeof *order);
    struct point *scratch = arena_alloc(memory, n_longest, sizeof *scratch);
    double *next = arena_numbers(memory, (1 + MODULI) * n_points);
    *set = (shift_set){
        .n = n, .loading = sweep->loading, .curves = arena_alloc(memory, n, sizeof *set->curves)};
    status = choose_fitted_quantities(sweep, options->shift_by, set, err);
    if (status == WT_OK && set->loading != WT_OSCILLATION && set->quantity != WT_SHIFT_STORAGE) {
        status = wt_fail(err, WT_E_ARG, "after a step there is one quantity to shift by");
        wt_error_expected(err, "shift-by moduli, which takes it");
    }
    for (size_t i = 0; i < n; i++)
        order[i] = (struct order){sweep->isotherms[i].temperature, i};
    qsort(order, n, sizeof *order, compare_isotherm_order);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        const wt_isotherm *isotherm = &sweep->isotherms[order[i].index];
        shift_curve *curve = &set->curves[i];
        curve->temperature = isotherm->temperature;
        curve->is_shift_fixed = isotherm->shift_is_stated;
        curve->origin = !isotherm->shift_is_stated   ? WT_SHIFT_FITTED
                        : isotherm->shift_is_by_hand ? WT_SHIFT_BY_HAND
                                                     : WT_SHIFT_GIVEN;
        curve->fixed_log_a = isotherm->stated_log_a;
        curve->is_vertical_fixed = isotherm->shift_is_stated &&
                                   isotherm->vertical_shift_is_stated &&
                                   set->quantity != WT_SHIFT_LOSS_FACTOR;
        curve->fixed_log_b = isotherm->stated_log_b;
        curve->x = next;
        curve->y[STORAGE] = next + isotherm->n;
        curve->y[LOSS] = next + 2 * isotherm->n;
        next += 3 * isotherm->n;
        status = fill_shift_curve(isotherm, set, scratch, curve, log, err);
        set->n_points += curve->n;
    }
    if (status == WT_OK && !options->keep_isotherms)
        exclude_kelvin(set);
    return status;
}

double curve_modulus_change(const shift_set *set, size_t curve)
{
    const shift_curve *c = &set->curves[curve];
    const double *y = c->y[set->used[STORAGE] ? STORAGE : LOSS];
    return c->n > 0 ? fabs(y[c->n - 1] - y[0]) : 0.0;
}

/* ---- shift of one isotherm ------------------------------------------------------------------- */

/* These values only set the start of the joint fit and affect no reported number. A point outside
 * the overlap counts with this residual [decade]. A smaller residual favours more overlap, a larger
 * one less residual. At half this value noise of 5 % is treated as a wrong position. */
static const double indifferent_residual = 0.05;

/* Residuals below this are equally good [decade]: 0.7 %, the noise of a good rheometer. */
static const double equal_residual = 0.003;

/* Number of tested shifts over the range of overlap: 40 per decade for ten decades. */
enum { GRID = 400 };

struct overlap {
    size_t n[MODULI];
    double sum, square; /* sums over the gaps y_p - y_s */
};

/* A start position of a curve. */
struct start {
    double cost, a, b;
};

/* Adds the gaps y_onto(x + a) - y_from(x) times `sign` for the points of `from` within `onto`.
 * Both abscissas rise, so one pass over `onto` suffices. */
static void add_pair_gaps(const shift_curve *onto, const shift_curve *from, const bool *used,
                          double a, double sign, double pivot, struct overlap *sum)
{
    size_t k = 0;
    for (size_t i = 0; i < from->n; i++) {
        const double x = from->x[i] + a;
        if (x < onto->x[0])
            continue;
        if (x > onto->x[onto->n - 1])
            return;
        while (k + 2 < onto->n && onto->x[k + 1] < x)
            k++;
        const double width = onto->x[k + 1] - onto->x[k];
        const double share = width > 0.0 ? (x - onto->x[k]) / width : 0.5;
        for (int q = 0; q < MODULI; q++) {
            if (!used[q])
                continue;
            const double y = onto->y[q][k] + share * (onto->y[q][k + 1] - onto->y[q][k]);
            const double gap = sign * (y - from->y[q][i]) - pivot;
            sum->n[q]++;
            sum->sum += gap;
            sum->square += gap * gap;
        }
    }
}

/* Returns true if the ordinates overlap by a twentieth of a decade, which is beyond noise and
 * clamping, or by a quarter of the flatter curve. E'' is not monotonic, so E' decides if available.
 */
static bool ordinates_overlap(const shift_set *set, const shift_curve *p, const shift_curve *s)
{
    const int q = set->used[STORAGE] ? STORAGE : LOSS;
    double low[2], high[2];
    gsl_stats_minmax(&low[0], &high[0], p->y[q], 1, p->n);
    gsl_stats_minmax(&low[1], &high[1], s->y[q], 1, s->n);
    const double shared = fmin(high[0], high[1]) - fmax(low[0], low[1]);
    return shared > 0.0 && shared >= fmin(0.05, 0.25 * fmin(high[0] - low[0], high[1] - low[1]));
}

/* Fits the shift of curve s relative to curve p by least squares of the used moduli in both
 * directions. b is fitted if free_b, otherwise it is an input. Returns false without overlap. */
static bool shift_pair_fit(const shift_set *set, size_t onto, size_t from, bool free_b, double *a,
                           double *b)
{
    const shift_curve *p = &set->curves[onto], *s = &set->curves[from];
    const double fixed_b = free_b ? 0.0 : *b;
    if (p->n < SHIFT_MIN_POINTS || s->n < SHIFT_MIN_POINTS || !ordinates_overlap(set, p, s))
        return false;
    const double lowest = p->x[0] - s->x[s->n - 1], highest = p->x[p->n - 1] - s->x[0];
    const double step = (highest - lowest) / GRID;
    struct start likely = {.cost = HUGE_VAL}, closest = likely;
    for (int g = 1; g < GRID; g++) {
        const double shift = lowest + g * step;
        struct overlap sum = {0};
        add_pair_gaps(p, s, set->used, shift, 1.0, fixed_b, &sum);
        add_pair_gaps(s, p, set->used, -shift, -1.0, fixed_b, &sum);
        if ((set->used[STORAGE] && sum.n[STORAGE] < SHIFT_MIN_POINTS) ||
            (set->used[LOSS] && sum.n[LOSS] < SHIFT_MIN_POINTS))
            continue;
        const double n = (double)(sum.n[STORAGE] + sum.n[LOSS]), mean = free_b ? sum.sum / n : 0.0;
        const double square = fmax(sum.square / n - mean * mean, 0.0);
        /* log likelihood relative to residuals of `indifferent_residual` at all points; the plain
         * mean square would prefer a chance match of a few end points */
        const double cost = n * log((square + equal_residual * equal_residual) /
                                    (indifferent_residual * indifferent_residual));
        if (cost < likely.cost)
            likely = (struct start){cost, shift, fixed_b + mean};
        if (square < closest.cost)
            closest = (struct start){square, shift, fixed_b + mean};
    }
    /* if no shift fits within `indifferent_residual` the likelihood favours few points */
    *a = likely.cost < 0.0 ? likely.a : closest.a;
    *b = likely.cost < 0.0 ? likely.b : closest.b;
    return closest.cost < HUGE_VAL;
}

/* ---- start positions ------------------------------------------------------------------------- */

/* Number of neighbours on which an isotherm is tried before it counts as unplaced. */
enum { NEIGHBOURS = 3 };
/* Largest departure of a tied vertical shift from that of rubber elasticity at the start [decade]:
 * ten standard deviations of the fit that follows. Errors of fitted ones add up from isotherm to
 * isotherm, and with hundreds of them the fit would not return. */
static const double max_start_departure = 0.20;

/* Places curve i on the nearest placed curve towards the anchor, or on the one after it if that
 * fails. */
static void find_initial_shift(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                               size_t i, bool *placed, double *a, double *b)
{
    const bool free_b = set->used[STORAGE] && set->used[LOSS] &&
                        (kind == WT_VERTICAL_FREE || kind == WT_VERTICAL_TIED);
    if (placed[i])
        return;
    const long inwards = i > anchor ? -1 : 1;
    int tried = 0;
    for (long p = (long)i + inwards; tried < NEIGHBOURS; p += inwards) {
        double by = 0.0, vertical = b[i] - b[p];
        if (placed[p]) {
            tried++;
            placed[i] = shift_pair_fit(set, (size_t)p, i, free_b, &by, &vertical);
            if (placed[i] && kind == WT_VERTICAL_TIED &&
                fabs(b[p] + vertical - b[i]) > max_start_departure) {
                vertical = b[i] - b[p];
                placed[i] = shift_pair_fit(set, (size_t)p, i, false, &by, &vertical);
            }
        }
        if (placed[i]) {
            a[i] = a[p] + by;
            b[i] = b[p] + vertical;
            return;
        }
        if ((size_t)p == anchor)
            return;
    }
}

void spectrum_find_initial_shifts(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                                  const double *physical, bool *placed, double *a, double *b)
{
    /* a table for another reference includes the vertical shift of this one in all rows */
    const shift_curve *at = &set->curves[anchor];
    const double off =
        at->is_vertical_fixed && at->fixed_log_a != 0.0 ? at->fixed_log_b - physical[anchor] : 0.0;
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        placed[i] = i == anchor || (c->is_shift_fixed && c->n >= SHIFT_MIN_POINTS);
        a[i] = c->is_shift_fixed ? c->fixed_log_a - set->curves[anchor].fixed_log_a : 0.0;
        b[i] = c->is_vertical_fixed ? c->fixed_log_b - off
               : kind == WT_VERTICAL_NONE || set->quantity == WT_SHIFT_LOSS_FACTOR ? 0.0
                                                                                   : physical[i];
    }
    for (size_t i = anchor + 1; i < set->n; i++)
        find_initial_shift(set, anchor, kind, i, placed, a, b);
    for (size_t i = anchor; i-- > 0;)
        find_initial_shift(set, anchor, kind, i, placed, a, b);
}

static double shared_decades(const shift_curve *p, double a_p, const shift_curve *s, double a_s)
{
    const double p_low = p->x[0] + a_p, p_high = p->x[p->n - 1] + a_p, s_low = s->x[0] + a_s,
                 s_high = s->x[s->n - 1] + a_s;
    return (p_high < s_high ? p_high : s_high) - (p_low > s_low ? p_low : s_low);
}

size_t spectrum_select_connected(const shift_set *set, size_t anchor, const double *a, bool *placed,
                                 double *overlap)
{
    const size_t n = set->n;
    size_t count = 1;
    for (size_t i = 0; i < n; i++)
        overlap[i] = i == anchor || (placed[i] && set->curves[i].is_shift_fixed) ? HUGE_VAL : 0.0;
    /* The overlap of an isotherm is the largest minimum overlap on a path to the anchor. Paths
     * mostly rise or fall, so few passes to and fro find all. */
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        for (size_t k = 0; k < 2 * n; k++) {
            const size_t p = k < n ? k : 2 * n - 1 - k;
            for (size_t i = 0; placed[p] && overlap[p] > 0.0 && i < n; i++) {
                if (!placed[i])
                    continue; /* it may have no points */
                const double both =
                    fmin(overlap[p], shared_decades(&set->curves[p], a[p], &set->curves[i], a[i]));
                if (!(both > overlap[i]))
                    continue;
                overlap[i] = both;
                is_changed = true;
            }
        }
    }
    for (size_t i = 0; i < set->n; i++) {
        placed[i] = placed[i] && overlap[i] > 0.0;
        count += placed[i] && i != anchor;
    }
    return count;
}
