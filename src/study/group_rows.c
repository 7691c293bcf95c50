/* Conversion of the accepted rows of an indentation table to a group.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/study.h"

#include "core/base/array.h"
#include "core/math/splitmix64.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct named_spot {
    const char *spot;
    double x, y; /* position, if it identifies a spot; else 0 */
    size_t item;
} named_spot;

static int compare_numbers(double a, double b)
{
    return (a > b) - (a < b);
}

static int compare_spots(const named_spot *x, const named_spot *y)
{
    const int order = strcmp(x->spot, y->spot);
    if (order != 0)
        return order;
    return x->x != y->x ? compare_numbers(x->x, y->x) : compare_numbers(x->y, y->y);
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

/* Finds the rows of curves with a modulus, accepted or doubtful, without copies. */
static wt_status find_accepted_rows(const table_view *t, wt_group_data *d, size_t *row_of,
                                    wt_error *err)
{
    size_t n = 0;
    for (size_t row = 0; row < t->n_rows; row++) {
        const double modulus = indentation_get(t, row, INDENTATION_MODULUS);
        if (!wt_curve_verdict_is_usable(indentation_enum(t, row, INDENTATION_VERDICT))) {
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

/* Determines if the spots were named, from the text of the table. A table without this text comes
 * from another program. */
static void find_spot_naming(const table_view *t, wt_group_data *d)
{
    d->spots_are_named = indentation_key_text(t, INDENTATION_KEY_SPOTS) != NULL
                             ? indentation_key_enum(t, INDENTATION_KEY_SPOTS) == SPOTS_NAMED
                             : indentation_has(t, INDENTATION_SPOT);
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

/* Reads adhesion, largest force and largest indentation of a curve. */
static void read_pull_and_depth(const table_view *t, size_t row, size_t i, wt_group_data *d)
{
    d->pull[i] = fmax(indentation_get(t, row, INDENTATION_ADHESION_FORCE),
                      indentation_get(t, row, INDENTATION_PULL_OFF_FORCE));
    d->max_force[i] = indentation_get(t, row, INDENTATION_MAX_FORCE);
    d->max_indentation[i] = indentation_get(t, row, INDENTATION_MAX_INDENTATION);
}

/* Returns NaN if the key is missing. */
static double plain_key_number(const table_view *t, indentation_key key)
{
    double value = (double)NAN;
    const char *words = indentation_key_text(t, key);
    if (words != NULL && !wt_number_parse(words, strlen(words), '.', &value))
        value = (double)NAN;
    return value;
}

/* Reads quantities that all curves of the group share. */
static void read_shared_inputs(const table_view *t, wt_group_data *d)
{
    d->sensitivity = indentation_value(t, INDENTATION_KEY_SENSITIVITY);
    d->tip = indentation_key_text(t, INDENTATION_KEY_TIP);
    d->has_several_cantilevers = indentation_key_text(t, INDENTATION_KEY_SPRING_CONSTANTS) != NULL;
    d->has_several_sensitivities = indentation_key_text(t, INDENTATION_KEY_SENSITIVITIES) != NULL;
    const tip_form form = indentation_key_enum(t, INDENTATION_KEY_TIP);
    d->has_several_tips = form == SEVERAL_TIPS || form == SEVERAL_BLUNTED_PYRAMIDS;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++) {
        const indentation_key error = (indentation_key)(INDENTATION_KEY_LEVER_ERROR + i),
                              gain = (indentation_key)(INDENTATION_KEY_LEVER_GAIN + i);
        d->common_error[i] = indentation_value(t, error).value;
        d->common_gain[i] = indentation_value(t, gain);
    }
    d->loss_error = shown_key_error(t, INDENTATION_KEY_LOSS_ERROR);
    d->bend_error = shown_key_error(t, INDENTATION_KEY_BEND_ERROR);
    d->misfit_error = shown_key_error(t, INDENTATION_KEY_MISFIT_ERROR);
    d->pooled_misfit = plain_key_number(t, INDENTATION_KEY_POOLED_MISFIT);
    d->pooled_misfit_p = plain_key_number(t, INDENTATION_KEY_POOLED_MISFIT_CHANCE);
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
    size_t allocated = t.n_rows > 0 ? t.n_rows : 1;
    wt_group_data d = {0};
    named_spot *names = malloc(allocated * sizeof *names);
    size_t *row_of = malloc(allocated * sizeof *row_of);
    d.modulus = malloc(allocated * sizeof *d.modulus);
    d.spot = malloc(allocated * sizeof *d.spot);
    d.indentation_rate = malloc(allocated * sizeof *d.indentation_rate);
    d.equivalent_frequency = malloc(allocated * sizeof *d.equivalent_frequency);
    d.spectrum_factor = malloc(allocated * sizeof *d.spectrum_factor);
    d.digest = malloc(allocated * sizeof *d.digest);
    d.pull = malloc(allocated * sizeof *d.pull);
    d.lack_of_fit = malloc(allocated * sizeof *d.lack_of_fit);
    d.fitted_spot = malloc(allocated * sizeof *d.fitted_spot);
    d.max_force = malloc(allocated * sizeof *d.max_force);
    d.max_indentation = malloc(allocated * sizeof *d.max_indentation);
    if (names == NULL || row_of == NULL || d.modulus == NULL || d.spot == NULL ||
        d.indentation_rate == NULL || d.equivalent_frequency == NULL || d.spectrum_factor == NULL ||
        d.digest == NULL || d.pull == NULL || d.lack_of_fit == NULL || d.fitted_spot == NULL ||
        d.max_force == NULL || d.max_indentation == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    else
        status = find_accepted_rows(&t, &d, row_of, err);
    if (status == WT_OK) {
        find_spot_naming(&t, &d);
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
        read_pull_and_depth(&t, row_of[i], i, &d);
    }
    if (status == WT_OK) {
        number_spots(names, d.group.n, d.spot);
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
    free(data->modulus);
    free(data->spot);
    free(data->indentation_rate);
    free(data->equivalent_frequency);
    free(data->spectrum_factor);
    free(data->digest);
    free(data->pull);
    free(data->lack_of_fit);
    free(data->fitted_spot);
    free(data->max_force);
    free(data->max_indentation);
    *data = (wt_group_data){0};
}
