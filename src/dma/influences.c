/* Influence of each isotherm on the master curve: the fit without it against that of all.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/quantity.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Changes by the fit without an isotherm; NaN: not known. */
typedef struct influence {
    double temperature;                 /* of the isotherm */
    double change, change_at, interval; /* largest change of log10 a, where, half width there */
    size_t outside, lost;
    double c1, c2, storage, loss;
    char note[256];
} influence;

TABLE_ROW(influences, INFLUENCES, influence one;)

/* Returns the geometric mean of the lowest and the highest frequency. */
static double middle_frequency(const wt_sweep *sweep)
{
    double low = HUGE_VAL, high = 0.0;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        for (size_t k = 0; k < sweep->isotherms[i].n; k++) {
            low = fmin(low, sweep->isotherms[i].angular_frequency[k]);
            high = fmax(high, sweep->isotherms[i].angular_frequency[k]);
        }
    return sqrt(low * high);
}

/* Returns the isotherm of a shift: shifts are in order of temperature, and equal ones in the order
 * of the sweep. */
static size_t isotherm_of_shift(const wt_sweep *sweep, size_t shift)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const double at = sweep->isotherms[i].temperature;
        size_t before = 0;
        for (size_t k = 0; k < sweep->n_isotherms; k++)
            before += sweep->isotherms[k].temperature < at ||
                      (sweep->isotherms[k].temperature == at && k < i);
        if (before == shift)
            return i;
    }
    return 0;
}

/* Returns the change of all shifts by a reference isotherm that is left out, which its neighbours
 * then place. It is no change of the shifts between isotherms. */
static double common_change(const wt_master *all, const wt_master *fit, size_t without)
{
    double *const change = wt_alloc(all->n_shifts, sizeof *change);
    size_t n = 0;
    for (size_t i = 0; i < all->n_shifts; i++) {
        if (i == without || !all->shifts[i].determined)
            continue;
        const wt_master_shift *const other = &fit->shifts[i < without ? i : i - 1];
        if (other->determined)
            change[n++] = other->log_a.value - all->shifts[i].log_a.value;
    }
    const double median = n > 0 ? numbers_median(change, n) : 0.0;
    free(change);
    return median;
}

static void compare_shifts(const wt_master *all, const wt_master *fit, size_t without,
                           influence *one)
{
    const bool is_reference = all->shifts[without].origin == WT_SHIFT_REFERENCE;
    const double common = is_reference ? common_change(all, fit, without) : 0.0;
    for (size_t i = 0; i < all->n_shifts; i++) {
        const wt_master_shift *const shift = &all->shifts[i];
        if (i == without || !shift->determined || shift->origin != WT_SHIFT_FITTED)
            continue;
        const wt_master_shift *const other = &fit->shifts[i < without ? i : i - 1];
        if (!other->determined) {
            one->lost++;
            continue;
        }
        const double change = other->log_a.value - common - shift->log_a.value;
        const double width = 0.5 * (shift->log_a.high - shift->log_a.low),
                     now = shift->log_a.value + change;
        const bool outside = now < shift->log_a.low || now > shift->log_a.high;
        /* one that leaves its interval stands before the larger changes that do not */
        if (outside != (one->outside > 0) ? outside : !(fabs(change) <= fabs(one->change))) {
            one->change = change;
            one->change_at = shift->temperature;
            one->interval = width;
        }
        one->outside += outside;
    }
}

/* Fits without one isotherm and fills its changes. */
static void leave_out(const wt_sweep *sweep, const wt_master_options *options, const wt_master *all,
                      double frequency, size_t without, influence *one)
{
    const double none = (double)NAN;
    wt_sweep rest = *sweep;
    wt_master fit = {0};
    wt_error failure = WT_ERROR_INIT;
    *one = (influence){.temperature = all->shifts[without].temperature,
                       .change = none,
                       .change_at = none,
                       .interval = none,
                       .c1 = none,
                       .c2 = none,
                       .storage = none,
                       .loss = none};
    rest.n_isotherms = sweep->n_isotherms - 1;
    rest.isotherms = wt_alloc(sweep->n_isotherms, sizeof *rest.isotherms);
    const size_t left_out = isotherm_of_shift(sweep, without);
    memcpy(rest.isotherms, sweep->isotherms, left_out * sizeof *rest.isotherms);
    memcpy(rest.isotherms + left_out, sweep->isotherms + left_out + 1,
           (rest.n_isotherms - left_out) * sizeof *rest.isotherms);
    const wt_status status = wt_master_fit(&rest, options, NULL, &fit, &failure);
    free(rest.isotherms);
    if (status != WT_OK) {
        snprintf(one->note, sizeof one->note, "no fit without it: %.230s", failure.message);
        return;
    }
    wt_interval moduli[2][2];
    wt_master_moduli(all, frequency, &moduli[0][0], &moduli[0][1]);
    wt_master_moduli(&fit, frequency, &moduli[1][0], &moduli[1][1]);
    one->storage = pow(10, moduli[1][0].value - moduli[0][0].value) - 1;
    one->loss = pow(10, moduli[1][1].value - moduli[0][1].value) - 1;
    if (all->law.kind == fit.law.kind) {
        one->c1 = fit.c1.value - all->c1.value;
        one->c2 = fit.c2.value - all->c2.value;
    }
    compare_shifts(all, &fit, without, one);
    if (fit.shift_route != all->shift_route)
        snprintf(one->note, sizeof one->note,
                 fit.shift_route == WT_SHIFTS_FROM_SPECTRUM
                     ? "without it one spectrum describes the others"
                     : "without it no spectrum describes the others");
    wt_master_clear(&fit);
}

/* Names the isotherm that moves a shift farthest out of its interval. */
static void warn_influence(const influence *worst, size_t n_such, wt_log *log)
{
    if (n_such == 0)
        return;
    wt_log_add(log, WT_WARNING, NULL, NULL,
               "without the isotherm of %.2f °C, log aT at %.2f °C changes by %+.2g, its 95 %% "
               "interval is +-%.2g: measure %.2f °C again%s",
               worst->temperature - WT_ZERO_CELSIUS, worst->change_at - WT_ZERO_CELSIUS,
               worst->change, worst->interval, worst->temperature - WT_ZERO_CELSIUS,
               n_such > 1 ? "; others move shifts out of their intervals, too" : "");
}

wt_status flow_influence_table(const wt_sweep *sweep, const wt_master_options *options,
                               const wt_master *all, wt_log *log, wt_table **table, wt_error *err)
{
    const double frequency = middle_frequency(sweep);
    wt_master_options own = *options;
    influence worst = {.change = 0.0};
    size_t n_such = 0;
    own.series_only = true;
    own.reference_at = WT_REFERENCE_TEMPERATURE;
    own.reference_temperature = all->reference_temperature;
    own.terms_per_decade = all->terms_per_decade; /* avoids a second search */
    table_writer t = table_begin(&influences_schema, err);
    for (size_t i = 0; i < all->n_shifts && sweep->n_isotherms > 2; i++) {
        influence one;
        if (isnan(all->shifts[i].noise_factor)) /* it is in no fit */
            continue;
        leave_out(sweep, &own, all, frequency, i, &one);
        TABLE_ADD(influences, &t, one);
        n_such += one.outside > 0;
        if (one.outside > 0 && fabs(one.change) > fabs(worst.change))
            worst = one;
    }
    influences_set_value(&t, INFLUENCES_KEY_REFERENCE_TEMPERATURE, all->reference_temperature, 0,
                         0);
    influences_set_value(&t, INFLUENCES_KEY_ANGULAR_FREQUENCY, frequency, 0, 0);
    warn_influence(&worst, n_such, log);
    return table_end(&t, table);
}
