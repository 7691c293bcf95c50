/* The two groups of a comparison: conversion of the accepted rows of an indentation table, and the
 * bins of the rates.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/math/special.h"
#include "core/table/registry.h"
#include "indentation/indent.h"
#include "study/compare.h"
#include "weartrack/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Width of a rate bin [decade]. Rates of one nominal piezo rate differ by less, because the softer
 * group indents slightly faster; see indentation/numerics/group_statistics.c. */
#define BIN_DECADES 0.5

const char *const compare_group_name[2] = {"bulk", "track"};

void compare_pair_clear(compare_pair *p)
{
    for (int g = 0; g < 2; g++)
        wt_group_data_clear(&p->data[g]);
    arena_free(&p->memory);
}

/* A bin starts at the lowest rate outside the previous bin. The border therefore never divides a
 * nominal rate. */
static void compare_assign_bins(compare_pair *p)
{
    size_t total = p->data[0].group.n + p->data[1].group.n, n = 0;
    double *rates = arena_numbers(&p->memory, total);
    p->low = arena_numbers(&p->memory, total);
    p->high = arena_numbers(&p->memory, total);
    p->modulus = arena_numbers(&p->memory, total);
    p->rate = arena_numbers(&p->memory, total);
    p->spot = arena_alloc(&p->memory, total, sizeof *p->spot);
    p->rate_class = arena_alloc(&p->memory, total, sizeof *p->rate_class);
    for (int g = 0; g < 2; g++)
        p->bin[g] = arena_alloc(&p->memory, p->data[g].group.n, sizeof *p->bin[g]);
    for (int g = 0; g < 2; g++)
        for (size_t i = 0; i < p->data[g].group.n; i++)
            if (p->data[g].indentation_rate[i] > 0)
                rates[n++] = p->data[g].indentation_rate[i];
    numbers_sort(rates, n);
    for (size_t i = 0; i < n; i++) {
        if (p->n_bins == 0 || log10(rates[i] / p->low[p->n_bins - 1]) > BIN_DECADES)
            p->low[p->n_bins++] = rates[i];
        p->high[p->n_bins - 1] = rates[i];
    }
    bool known[2] = {false, false};
    for (int g = 0; g < 2; g++) {
        for (size_t i = 0; i < p->data[g].group.n; i++) {
            double rate = p->data[g].indentation_rate[i];
            p->bin[g][i] = COMPARE_NO_BIN;
            for (size_t b = 0; rate > 0 && b < p->n_bins; b++)
                if (rate >= p->low[b] && rate <= p->high[b])
                    p->bin[g][i] = b;
            known[g] = known[g] || p->bin[g][i] != COMPARE_NO_BIN;
        }
    }
    p->by_rate = known[0] && known[1];
}

wt_group compare_select_curves(const compare_pair *p, int g, size_t bin, size_t offset,
                               bool factors)
{
    const wt_group_data *data = &p->data[g];
    const bool all = bin == COMPARE_ALL_BINS;
    wt_group part = {.modulus = p->modulus + offset,
                     .spot = data->group.spot == NULL ? NULL : p->spot + offset,
                     .rate = all && p->by_rate ? p->rate + offset : NULL,
                     .rate_class = p->rate_class + offset,
                     .n_rejected = all ? data->group.n_rejected : 0,
                     .spot_scatter = data->group.spot_scatter};
    for (size_t i = 0; i < data->group.n; i++) {
        const size_t at = p->bin[g][i];
        if (all ? p->by_rate && at == COMPARE_NO_BIN : at != bin)
            continue;
        p->modulus[offset + part.n] = factors ? data->spectrum_factor[i] : data->modulus[i];
        p->rate[offset + part.n] = data->indentation_rate[i];
        p->spot[offset + part.n] = data->spot[i];
        p->rate_class[offset + part.n] = (long)at;
        part.n++;
    }
    return part;
}

/* ---- both groups ----------------------------------------------------------------------------- */

/* A curve in both groups comes from a file that was given twice. */
static wt_status check_copies(const compare_pair *p, wt_error *err)
{
    const wt_group_data *a = &p->data[0], *b = &p->data[1];
    size_t n = 0;
    for (size_t i = 0, k = 0; i < a->n_digests && k < b->n_digests;) {
        const uint64_t x = a->digest[i].digest, y = b->digest[k].digest;
        n += x == y && x != 0 ? 1 : 0;
        i += x <= y ? 1 : 0;
        k += y <= x ? 1 : 0;
    }
    if (n == 0)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "bulk and track hold the same curves");
    wt_error_expected(err, "curves of the bulk and others of the track");
    wt_error_found(err, "%zu curves of the same content in both", n);
    wt_error_advice(err, "a file was given for both, perhaps under two names: leave it out of one");
    return WT_E_RANGE;
}

/* True if all curves have a factor on the spectrum, which does not depend on the rate, and no
 * temperature slope is stated. */
static bool compares_factors(const wt_compare_job *job, const compare_pair *p)
{
    bool all = p->present[0] && p->present[1] && isnan(job->temperature_slope.value);
    all = all && p->data[0].group.n > 0 && p->data[1].group.n > 0;
    for (int g = 0; all && g < 2; g++)
        for (size_t i = 0; i < p->data[g].group.n; i++)
            all = all && p->data[g].spectrum_factor[i] > 0;
    return all;
}

/* Replaces the assumed errors of a group by those that the job states. */
static void replace_assumed_errors(const wt_compare_job *job, wt_group_data *d)
{
    const double stated[] = {[WT_SYSTEMATIC_SPRING_CONSTANT] = job->lever_error,
                             [WT_SYSTEMATIC_SENSITIVITY] = job->sensitivity_error};
    for (size_t i = 0; i < COUNT_OF(stated); i++)
        if (stated[i] > 0 && d->assumed_error[i] > 0) {
            d->common_error[i] = stated[i];
            d->assumed_error[i] = (double)NAN;
        }
    double *const angle = &d->assumed_error[WT_SYSTEMATIC_HALF_ANGLE],
                  *const radius = &d->assumed_error[WT_SYSTEMATIC_RADIUS];
    if (job->tip_error > 0 && (*angle > 0 || *radius > 0)) {
        d->tip_error = job->tip_error;
        *angle = *radius = (double)NAN;
    }
}

wt_status compare_read_groups(const wt_compare_job *job, compare_pair *p, wt_error *err)
{
    const wt_table *given[2] = {job->bulk, job->track};
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        p->present[g] = given[g] != NULL;
        if (p->present[g]) {
            status = wt_group_from_table(given[g], job->map_spots, &p->data[g], err);
            replace_assumed_errors(job, &p->data[g]);
        }
        p->data[g].group.spot_scatter = sqrt(log1p(job->spot_scatter * job->spot_scatter));
    }
    if (status == WT_OK)
        status = check_copies(p, err);
    p->by_factor = status == WT_OK && compares_factors(job, p);
    if (status == WT_OK)
        compare_assign_bins(p);
    return status;
}

typedef struct named_spot {
    const char *spot;
    double x, y; /* position, if it identifies a spot; else 0 */
    size_t item;
} named_spot;

/* ---- rows of an indentation table ------------------------------------------------------------ */

static int compare_spots(const named_spot *x, const named_spot *y)
{
    const int order = strcmp(x->spot, y->spot);
    if (order != 0)
        return order;
    return x->x != y->x ? numbers_compare(&x->x, &y->x) : numbers_compare(&x->y, &y->y);
}

static int compare_named_spots(const void *a, const void *b)
{
    const named_spot *x = a, *y = b;
    int order = compare_spots(x, y);
    return order != 0 ? order : (x->item > y->item) - (x->item < y->item);
}

/* Numbers the spots in the order of their first appearance. A sort finds equal spots, as each curve
 * may have its own. */
static void number_spots(named_spot *names, size_t n, long *spot)
{
    long next = 0;
    qsort(names, n, sizeof *names, compare_named_spots);
    for (size_t i = 0, first = 0; i < n; i++) {
        if (compare_spots(&names[i], &names[first]) != 0)
            first = i;
        spot[names[i].item] = (long)names[first].item;
    }
    /* The first row of a spot precedes the others, and its number is then known. */
    for (size_t i = 0; i < n; i++)
        spot[i] = spot[i] == (long)i ? next++ : spot[spot[i]];
}

/* ---- copies ---------------------------------------------------------------------------------- */

/* Digest of the measured values of a curve. 0 if only the modulus exists, which two curves may
 * share. */
static uint64_t curve_digest(const table_view *t, size_t row)
{
    static const indentation_column columns[] = {
        INDENTATION_MODULUS,     INDENTATION_MODULUS_STANDARD_ERROR, INDENTATION_CONTACT_POINT,
        INDENTATION_NOISE,       INDENTATION_BASELINE_TILT,          INDENTATION_MAX_FORCE,
        INDENTATION_LACK_OF_FIT, INDENTATION_MAX_INDENTATION};
    uint64_t digest = 1;
    size_t known = 0;
    for (size_t i = 0; i < COUNT_OF(columns); i++) {
        const double value = indentation_get(t, row, columns[i]);
        uint64_t bits = i;
        if (!isnan(value)) {
            known++;
            memcpy(&bits, &value, sizeof bits);
        }
        digest = splitmix64(digest ^ splitmix64(bits + i));
    }
    return known >= 3 ? digest : 0;
}

static int compare_digests(const void *a, const void *b)
{
    const wt_curve_digest *x = a, *y = b;
    if (x->digest != y->digest)
        return x->digest < y->digest ? -1 : 1;
    return (x->item > y->item) - (x->item < y->item);
}

/* Removes copies of curves. `row_of`: row of each remaining curve. */
static void remove_copies(const table_view *t, wt_group_data *d, size_t *row_of)
{
    wt_curve_digest *const all = d->digest;
    const size_t n = d->n_digests;
    qsort(all, n, sizeof *all, compare_digests);
    size_t kept = 0;
    for (size_t i = 0, first = 0; i < n; i++) {
        const bool copy = i > 0 && all[i].digest != 0 && all[i].digest == all[first].digest;
        if (!copy) {
            first = i;
            all[kept++] = all[i];
            continue;
        }
        if (d->n_copies++ == 0) {
            d->duplicate_file[0] = indentation_text(t, row_of[all[first].item], INDENTATION_FILE);
            d->duplicate_file[1] = indentation_text(t, row_of[all[i].item], INDENTATION_FILE);
        }
        row_of[all[i].item] = SIZE_MAX;
    }
    d->n_digests = kept;
}

/* ---- table ----------------------------------------------------------------------------------- */

/* Finds the rows of curves with a modulus, accepted, wide or doubtful, without copies. */
static wt_status find_accepted_rows(const table_view *t, wt_group_data *d, size_t *row_of,
                                    wt_error *err)
{
    size_t n = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        const double modulus = indentation_get(t, row, INDENTATION_MODULUS);
        if (!wt_curve_verdict_is_usable(
                (wt_curve_verdict)indentation_enum(t, row, INDENTATION_VERDICT))) {
            d->group.n_rejected++;
            continue;
        }
        if (!(modulus > 0) || !isfinite(modulus)) {
            wt_fail(err, WT_E_RANGE, "an accepted curve has no positive modulus");
            wt_error_place(err, "table %s, row %zu", wt_table_name(t->table), row + 1);
            wt_error_found(err, "%g Pa", modulus);
            return WT_E_RANGE;
        }
        d->digest[n] = (wt_curve_digest){curve_digest(t, row), n};
        row_of[n++] = row;
    }
    d->n_digests = n;
    remove_copies(t, d, row_of);
    for (size_t i = 0; i < n; i++)
        if (row_of[i] != SIZE_MAX)
            row_of[d->group.n++] = row_of[i];
    return WT_OK;
}

static void count_rejected(const table_view *t, wt_group_data *d)
{
    size_t counts[WT_CURVE_UNREADABLE + 1] = {0};
    for (size_t row = 0; row < t->n_rows; row++) {
        const int verdict = indentation_enum(t, row, INDENTATION_VERDICT);
        if (verdict <= WT_CURVE_UNREADABLE)
            counts[verdict]++;
    }
    for (int v = WT_CURVE_ACCEPTED; v <= WT_CURVE_UNREADABLE; v++)
        if (!wt_curve_verdict_is_usable((wt_curve_verdict)v) && counts[v] > d->n_main_rejection) {
            d->main_rejection = (wt_curve_verdict)v;
            d->n_main_rejection = counts[v];
        }
}

/* Returns the spot of an accepted curve. With `spot_per_position` its position is part of the spot,
 * unless the user named the spots. */
static named_spot spot_name(const table_view *t, size_t row, size_t item, bool spot_per_position,
                            const wt_group_data *d)
{
    named_spot n = {indentation_text(t, row, INDENTATION_SPOT), 0, 0, item};
    if (!spot_per_position || d->spots_are_named)
        return n;
    n.x = indentation_get(t, row, INDENTATION_X);
    n.y = indentation_get(t, row, INDENTATION_Y);
    if (!isfinite(n.x) || !isfinite(n.y)) { /* an unknown position is unique */
        n.x = indentation_get(t, row, INDENTATION_CURVE);
        n.y = 0;
    }
    return n;
}

/* Error that the curves show: 0 if it was not requested, NaN if it is unknown. */
static double shown_key_error(const table_view *t, indentation_key key)
{
    return indentation_key_text(t, key) == NULL ? 0 : indentation_value(t, key).value;
}

/* The cube root of a mean of squares is nearly normal (Wilson and Hilferty 1931). */
static void read_misfits(const table_view *t, bool spot_per_position, named_spot *names,
                         wt_group_data *d)
{
    for (size_t row = 0; row < t->n_rows; row++) {
        const double lack = indentation_get(t, row, INDENTATION_LACK_OF_FIT);
        if (!isfinite(lack))
            continue;
        names[d->n_fitted] = spot_name(t, row, d->n_fitted, spot_per_position, d);
        d->lack_of_fit[d->n_fitted++] = cbrt(lack);
    }
    number_spots(names, d->n_fitted, d->fitted_spot);
}

/* Reads quantities that all curves of the group share. */
static void read_shared_inputs(const table_view *t, wt_group_data *d)
{
    d->sensitivity = indentation_value(t, INDENTATION_KEY_SENSITIVITY);
    d->temperature = indentation_value(t, INDENTATION_KEY_TEMPERATURE);
    d->has_tip = indent_tip_from_table(t, &d->tip);
    d->has_several_cantilevers = indentation_key_text(t, INDENTATION_KEY_SPRING_CONSTANTS) != NULL;
    d->has_several_sensitivities = indentation_key_text(t, INDENTATION_KEY_SENSITIVITIES) != NULL;
    const tip_form form = (tip_form)indentation_key_enum(t, INDENTATION_KEY_TIP);
    d->has_several_tips = form == SEVERAL_TIPS || form == SEVERAL_BLUNTED_PYRAMIDS;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++) {
        const indentation_key error = (indentation_key)(INDENTATION_KEY_LEVER_ERROR + i),
                              gain = (indentation_key)(INDENTATION_KEY_LEVER_GAIN + i);
        d->common_error[i] = indentation_value(t, error).value;
        d->common_gain[i] = indentation_value(t, gain);
        d->assumed_error[i] =
            indentation_value(t, (indentation_key)(INDENTATION_KEY_LEVER_ERROR_ASSUMED + i)).value;
    }
    d->tip_error = (double)NAN;
    d->range_error = shown_key_error(t, INDENTATION_KEY_RANGE_ERROR);
    d->loss_error = shown_key_error(t, INDENTATION_KEY_LOSS_ERROR);
    d->bend_error = shown_key_error(t, INDENTATION_KEY_BEND_ERROR);
    for (int i = 0; i < WT_FIT_RANGES; i++)
        d->range_shift[i] =
            indentation_value(t, (indentation_key)(INDENTATION_KEY_RANGE_SHIFT + i));
    d->loss_shift = indentation_value(t, INDENTATION_KEY_LOSS_SHIFT).value;
    d->pull_shift = indentation_value(t, INDENTATION_KEY_PULL_SHIFT).value;
    d->pooled_misfit = parse_number_or_nan(indentation_key_text(t, INDENTATION_KEY_POOLED_MISFIT));
    d->pooled_misfit_p =
        parse_number_or_nan(indentation_key_text(t, INDENTATION_KEY_POOLED_MISFIT_CHANCE));
}

wt_status wt_group_from_table(const wt_table *table, bool spot_per_position, wt_group_data *data,
                              wt_error *err)
{
    if (table == NULL || data == NULL)
        return wt_fail(err, WT_E_ARG, "no indentation table");
    table_view t;
    wt_status status = table_bind(table, &indentation_schema, "", &t, err);
    if (status != WT_OK)
        return status;
    const size_t n = t.n_rows;
    named_spot *const names = wt_alloc(n, sizeof *names);
    size_t *const row_of = wt_alloc(n, sizeof *row_of);
    double *const numbers = wt_alloc(8 * n, sizeof *numbers);
    long *const spots = wt_alloc(2 * n, sizeof *spots);
    wt_group_data d = {.modulus = numbers,
                       .indentation_rate = numbers + n,
                       .equivalent_frequency = numbers + 2 * n,
                       .spectrum_factor = numbers + 3 * n,
                       .pull = numbers + 4 * n,
                       .lack_of_fit = numbers + 5 * n,
                       .max_force = numbers + 6 * n,
                       .max_indentation = numbers + 7 * n,
                       .spot = spots,
                       .fitted_spot = spots + n,
                       .spot_name = wt_alloc(n, sizeof *d.spot_name),
                       .digest = wt_alloc(n, sizeof *d.digest)};
    status = find_accepted_rows(&t, &d, row_of, err);
    if (status == WT_OK) {
        /* a table without this text comes from another program */
        d.spots_are_named = indentation_key_text(&t, INDENTATION_KEY_SPOTS) != NULL
                                ? indentation_key_enum(&t, INDENTATION_KEY_SPOTS) == SPOTS_NAMED
                                : indentation_has(&t, INDENTATION_SPOT);
        count_rejected(&t, &d);
    }
    double gain = 0;
    for (size_t i = 0; status == WT_OK && i < d.group.n; i++) {
        d.modulus[i] = indentation_get(&t, row_of[i], INDENTATION_MODULUS);
        names[i] = spot_name(&t, row_of[i], i, spot_per_position, &d);
        d.indentation_rate[i] = indentation_get(&t, row_of[i], INDENTATION_RATE);
        d.equivalent_frequency[i] =
            indentation_get(&t, row_of[i], INDENTATION_EQUIVALENT_FREQUENCY);
        d.spectrum_factor[i] = indentation_get(&t, row_of[i], INDENTATION_SPECTRUM_FACTOR);
        gain += indentation_get(&t, row_of[i], INDENTATION_SENSITIVITY_GAIN);
        d.pull[i] = fmax(indentation_get(&t, row_of[i], INDENTATION_ADHESION_FORCE),
                         indentation_get(&t, row_of[i], INDENTATION_PULL_OFF_FORCE));
        d.max_force[i] = indentation_get(&t, row_of[i], INDENTATION_MAX_FORCE);
        d.max_indentation[i] = indentation_get(&t, row_of[i], INDENTATION_MAX_INDENTATION);
    }
    if (status == WT_OK) {
        number_spots(names, d.group.n, d.spot);
        for (size_t i = 0; i < d.group.n; i++)
            d.spot_name[names[i].item] = names[i].spot;
        read_misfits(&t, spot_per_position, names, &d);
        d.group.modulus = d.modulus;
        d.group.spot = indentation_has(&t, INDENTATION_SPOT) ? d.spot : NULL;
        d.spring_constant = indentation_value(&t, INDENTATION_KEY_SPRING_CONSTANT);
        d.sensitivity_gain = gain / (double)d.group.n;
        read_shared_inputs(&t, &d);
        *data = d;
        d = (wt_group_data){0};
    }
    free(names);
    free(row_of);
    wt_group_data_clear(&d);
    return status;
}

void wt_group_data_clear(wt_group_data *data)
{
    if (data == NULL)
        return;
    free(data->modulus); /* begins the array of all numbers, as `spot` that of all spots */
    free(data->spot);
    free(data->spot_name);
    free(data->digest);
    *data = (wt_group_data){0};
}
