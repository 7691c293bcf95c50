/* Isotherms of a sweep as logarithms, sorted, with unusable points left out and named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/shift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct point {
    double x, y[MODULI];
};

static int by_x(const void *left, const void *right)
{
    const double a = ((const struct point *)left)->x, b = ((const struct point *)right)->x;
    return (a > b) - (a < b);
}

struct order {
    double temperature;
    size_t index;
};

static int by_temperature(const void *left, const void *right)
{
    const struct order *a = left, *b = right;
    if (a->temperature != b->temperature)
        return a->temperature > b->temperature ? 1 : -1;
    return (a->index > b->index) - (a->index < b->index); /* runs of one temperature keep order */
}

static wt_status check_temperatures(const wt_sweep *sweep, wt_error *err)
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

/* Fills one curve from an isotherm; scratch: [isotherm->n]. */
static wt_status fill_curve(const wt_isotherm *isotherm, struct point *scratch, shift_curve *curve,
                            wt_parselog *log, wt_error *err)
{
    size_t n = 0;
    size_t first_bad = isotherm->n;
    for (size_t k = 0; k < isotherm->n; k++) {
        const double w = isotherm->angular_frequency[k];
        const double storage = isotherm->storage_modulus[k], loss = isotherm->loss_modulus[k];
        if (w > 0.0 && storage > 0.0 && loss > 0.0 && isfinite(w) && isfinite(storage) &&
            isfinite(loss)) {
            scratch[n++] = (struct point){log10(w), {log10(storage), log10(loss)}};
        } else {
            if (first_bad == isotherm->n)
                first_bad = k;
            curve->n_left_out++;
        }
    }
    if (curve->n_left_out > 0 && n < SHIFT_MIN_POINTS) {
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
    if (curve->n_left_out > 0)
        wt_parselog_add(log, WT_WARNING, isotherm->source, NULL,
                        "isotherm of %.2f °C: %zu of %zu points left out, no positive modulus "
                        "(first: %g rad/s, storage %g Pa, loss %g Pa)",
                        isotherm->temperature - WT_ZERO_CELSIUS, curve->n_left_out, isotherm->n,
                        isotherm->angular_frequency[first_bad],
                        isotherm->storage_modulus[first_bad], isotherm->loss_modulus[first_bad]);
    qsort(scratch, n, sizeof *scratch, by_x);
    for (size_t k = 0; k < n; k++) {
        curve->x[k] = scratch[k].x;
        for (int q = 0; q < MODULI; q++)
            curve->y[q][k] = scratch[k].y[q];
    }
    curve->n = n;
    return WT_OK;
}

wt_status shift_set_new(const wt_sweep *sweep, wt_parselog *log, pool *memory, shift_set *set,
                        wt_error *err)
{
    const size_t n = sweep->n_isotherms;
    size_t n_points = 0, n_longest = 1;
    wt_status status = check_temperatures(sweep, err);

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
    struct order *order = pool_alloc(memory, n, sizeof *order);
    struct point *scratch = pool_alloc(memory, n_longest, sizeof *scratch);
    double *next = pool_numbers(memory, (1 + MODULI) * n_points);
    *set = (shift_set){.n = n, .curves = pool_alloc(memory, n, sizeof *set->curves)};
    if (memory->failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu isotherms", n);
    for (size_t i = 0; i < n; i++)
        order[i] = (struct order){sweep->isotherms[i].temperature, i};
    qsort(order, n, sizeof *order, by_temperature);
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        const wt_isotherm *isotherm = &sweep->isotherms[order[i].index];
        shift_curve *curve = &set->curves[i];
        curve->temperature = isotherm->temperature;
        curve->x = next;
        curve->y[STORAGE] = next + isotherm->n;
        curve->y[LOSS] = next + 2 * isotherm->n;
        next += 3 * isotherm->n;
        status = fill_curve(isotherm, scratch, curve, log, err);
        set->n_points += curve->n;
    }
    return status;
}
