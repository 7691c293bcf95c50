/* Converts the isotherms of a sweep to sorted logarithms and reports unusable points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/isotherm.h"

#include "core/base/array.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    gsl_sort(copy, 1, n);
    const double median = gsl_stats_median_from_sorted_data(copy, 1, n);
    for (size_t k = 0; k < n; k++)
        copy[k] = fabs(point[k].y[q] - median);
    gsl_sort(copy, 1, n);
    const double outlier_distance =
        outlier_limit * 1.4826 * gsl_stats_median_from_sorted_data(copy, 1, n);
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

/* Fills one curve from an isotherm; scratch: [isotherm->n]. */
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
        wt_status status =
            wt_fail(err, WT_E_RANGE,
                    "the isotherm of %.2f °C has too few points with positive frequency and moduli",
                    isotherm->temperature - WT_ZERO_CELSIUS);
        wt_error_place(err, "%s", isotherm->source);
        wt_error_expected(err, "at least %d", SHIFT_MIN_POINTS);
        wt_error_found(err, "%zu of %zu; point %zu: %g rad/s, storage %g Pa, loss %g Pa", n,
                       isotherm->n, first_bad + 1, isotherm->angular_frequency[first_bad],
                       isotherm->storage_modulus[first_bad], isotherm->loss_modulus[first_bad]);
        wt_error_advice(err, "leave this temperature out of the sweep");
        return status;
    }
    if (curve->n_skipped > 0)
        wt_log_add(log, WT_WARNING, isotherm->source, NULL,
                   "isotherm of %.2f °C: %zu of %zu points left out, no positive modulus "
                   "(first: %g rad/s, storage %g Pa, loss %g Pa)",
                   isotherm->temperature - WT_ZERO_CELSIUS, curve->n_skipped, isotherm->n,
                   isotherm->angular_frequency[first_bad], isotherm->storage_modulus[first_bad],
                   isotherm->loss_modulus[first_bad]);
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

wt_status shift_set_new(const wt_sweep *sweep, wt_shift_quantity by, wt_log *log, arena *memory,
                        shift_set *set, wt_error *err)
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
        status = wt_fail(err, WT_E_MISSING, "a master curve needs at least two isotherms");
        wt_error_found(err, "%zu", n);
        wt_error_advice(err, "give all temperatures of the sweep together");
        return status;
    }
    struct order *order = arena_alloc(memory, n, sizeof *order);
    struct point *scratch = arena_alloc(memory, n_longest, sizeof *scratch);
    double *next = arena_numbers(memory, (1 + MODULI) * n_points);
    *set = (shift_set){
        .n = n, .loading = sweep->loading, .curves = arena_alloc(memory, n, sizeof *set->curves)};
    status = choose_fitted_quantities(sweep, by, set, err);
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
    return status;
}

double curve_modulus_change(const shift_set *set, size_t curve)
{
    const shift_curve *c = &set->curves[curve];
    const double *y = c->y[set->used[STORAGE] ? STORAGE : LOSS];
    return c->n > 0 ? fabs(y[c->n - 1] - y[0]) : 0.0;
}
