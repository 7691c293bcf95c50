/* The indentation table: one row per curve; and the accepted part of it as a group.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/indentation.h"
#include "flow/job/tables.h"

#include <stdlib.h>
#include <string.h>

enum {
    FILE_NAME,
    CURVE,
    SPOT,
    X,
    Y,
    VERDICT,
    REASON,
    MODULUS,
    MODULUS_ERROR,
    CONTACT,
    CONTACT_ERROR,
    BASELINE_OFFSET,
    BASELINE_TILT,
    NOISE,
    R_SQUARED,
    MAX_FORCE,
    MAX_INDENTATION,
    ADHESION,
    PIEZO_RATE,
    INDENTATION_RATE,
    LOAD_TIME,
    SECOND_MINIMUM,
    SENSITIVITY_GAIN,
    EQUIVALENT_FREQUENCY
};

wt_status flow_indentation_table(const char *group, wt_table **table, wt_error *err)
{
    static const flow_column columns[] = {
        {"file", NULL, "file of the curve"},
        {"curve", "1", "number of the curve in its file"},
        {"spot", NULL, "place on the sample; curves of one spot are not independent"},
        {"x", "m", "lateral position x"},
        {"y", "m", "lateral position y"},
        {"verdict", NULL, "accepted, or why not"},
        {"reason", NULL, "the verdict with its numbers"},
        {"modulus", "Pa", "Young's modulus"},
        {"modulus_standard_error", "Pa", "standard error of the modulus"},
        {"contact_point", "m", "tip position at contact"},
        {"contact_point_standard_error", "m", "standard error of the contact point"},
        {"baseline_offset", "N", "force of the baseline at contact"},
        {"baseline_tilt", "N/m", "slope of the baseline"},
        {"noise", "N", "standard deviation of the baseline residual"},
        {"r_squared", "1", "coefficient of determination of the contact part"},
        {"max_force", "N", "largest force above the baseline"},
        {"max_indentation", "m", "largest indentation"},
        {"adhesion_force", "N", "largest pull before contact"},
        {"piezo_rate", "m/s", "rate of the piezo"},
        {"indentation_rate", "m/s", "mean rate of indentation"},
        {"load_time", "s", "time from contact to the end of the approach"},
        {"second_minimum_ratio", "1",
         "misfit of the second best contact point over the best; nan if there is no second"},
        {"sensitivity_gain", "1",
         "relative error of the modulus per relative error of sensitivity"},
        {"equivalent_frequency", "rad/s", "angular frequency of equal loading"},
    };
    char name[80], title[96];
    snprintf(name, sizeof name, "indentation/%s", group);
    snprintf(title, sizeof title, "Indentation of every curve, %s", group);
    return flow_table_new(name, title, columns, FLOW_COUNT(columns), table, err);
}

wt_status flow_indentation_add(wt_table *table, const flow_indentation *row, wt_error *err)
{
    const wt_indent_fit *fit = &row->fit;
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, FILE_NAME, row->file, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, SPOT, row->spot, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, VERDICT, wt_curve_verdict_id(fit->verdict), err);
    if (status == WT_OK)
        status = wt_table_put_text(table, REASON, fit->reason, err);
    if (status != WT_OK)
        return status;
    wt_table_put(table, CURVE, (double)row->curve);
    wt_table_put(table, X, row->x);
    wt_table_put(table, Y, row->y);
    wt_table_put(table, MODULUS, fit->modulus.value);
    wt_table_put(table, MODULUS_ERROR, fit->modulus.standard_error);
    wt_table_put(table, CONTACT, fit->contact_point.value);
    wt_table_put(table, CONTACT_ERROR, fit->contact_point.standard_error);
    wt_table_put(table, BASELINE_OFFSET, fit->baseline_offset.value);
    wt_table_put(table, BASELINE_TILT, fit->baseline_tilt.value);
    wt_table_put(table, NOISE, fit->noise);
    wt_table_put(table, R_SQUARED, fit->r_squared);
    wt_table_put(table, MAX_FORCE, fit->max_force);
    wt_table_put(table, MAX_INDENTATION, fit->max_indentation);
    wt_table_put(table, ADHESION, fit->adhesion_force);
    wt_table_put(table, PIEZO_RATE, fit->piezo_rate);
    wt_table_put(table, INDENTATION_RATE, fit->indentation_rate);
    wt_table_put(table, LOAD_TIME, fit->load_time);
    wt_table_put(table, SECOND_MINIMUM, fit->second_minimum_ratio);
    wt_table_put(table, SENSITIVITY_GAIN, fit->sensitivity_gain);
    wt_table_put(table, EQUIVALENT_FREQUENCY, row->equivalent_frequency);
    return WT_OK;
}

/* ---- a group from the table -------------------------------------------------------------------
 */

typedef struct named {
    const char *spot;
    size_t item;
} named;

static int by_name(const void *a, const void *b)
{
    const named *x = a, *y = b;
    int order = strcmp(x->spot, y->spot);
    return order != 0 ? order : (x->item > y->item) - (x->item < y->item);
}

/* Numbers the spots in the order of their first appearance. A map has a spot for each curve, so
 * equal names are found by sorting. */
static void number_spots(named *names, size_t n, long *spot)
{
    long next = 0;
    qsort(names, n, sizeof *names, by_name);
    for (size_t i = 0, first = 0; i < n; i++) {
        if (strcmp(names[i].spot, names[first].spot) != 0)
            first = i;
        spot[names[i].item] = (long)names[first].item;
    }
    /* The first of a name comes before the others, and has its number when they ask for it. */
    for (size_t i = 0; i < n; i++)
        spot[i] = spot[i] == (long)i ? next++ : spot[spot[i]];
}

wt_status wt_group_from_table(const wt_table *table, wt_group_data *data, wt_error *err)
{
    if (table == NULL || data == NULL)
        return wt_fail(err, WT_E_ARG, "no indentation table");
    if (wt_table_find(table, "modulus") < 0 || wt_table_find(table, "verdict") < 0) {
        wt_fail(err, WT_E_MISSING, "table \"%s\" is not an indentation table",
                wt_table_name(table));
        wt_error_expected(err, "columns modulus and verdict");
        wt_error_advice(err, "give the output of `weartrack indent`");
        return WT_E_MISSING;
    }
    size_t rows = wt_table_n_rows(table), allocated = rows > 0 ? rows : 1;
    bool with_spot = wt_table_find(table, "spot") >= 0;
    wt_group_data d = {0};
    named *names = malloc(allocated * sizeof *names);
    d.modulus = malloc(allocated * sizeof *d.modulus);
    d.spot = malloc(allocated * sizeof *d.spot);
    d.indentation_rate = malloc(allocated * sizeof *d.indentation_rate);
    d.equivalent_frequency = malloc(allocated * sizeof *d.equivalent_frequency);
    wt_status status = WT_OK;
    if (names == NULL || d.modulus == NULL || d.spot == NULL || d.indentation_rate == NULL ||
        d.equivalent_frequency == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    for (size_t row = 0; row < rows; row++) {
        double modulus = flow_table_get(table, row, "modulus");
        if (strcmp(flow_table_get_text(table, row, "verdict"), "accepted") != 0) {
            d.group.n_rejected++;
            continue;
        }
        if (!(modulus > 0) || !isfinite(modulus)) {
            status = wt_fail(err, WT_E_RANGE, "an accepted curve has no positive modulus");
            wt_error_place(err, "table %s, row %zu", wt_table_name(table), row + 1);
            wt_error_found(err, "%g Pa", modulus);
            goto done;
        }
        size_t i = d.group.n++;
        d.modulus[i] = modulus;
        names[i] = (named){flow_table_get_text(table, row, "spot"), i};
        d.indentation_rate[i] = flow_table_get(table, row, "indentation_rate");
        d.equivalent_frequency[i] = flow_table_get(table, row, "equivalent_frequency");
    }
    number_spots(names, d.group.n, d.spot);
    const char *spots = wt_table_key(table, "spots");
    d.spots_given = spots != NULL && strncmp(spots, "named", 5) == 0;
    d.group.modulus = d.modulus;
    d.group.spot = with_spot ? d.spot : NULL;
    *data = d;
    d = (wt_group_data){0};
done:
    free(names);
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
    *data = (wt_group_data){0};
}

void wt_indent_tables_clear(wt_indent_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->indentation);
    wt_table_free(tables->force_displacement);
    wt_table_free(tables->force_indentation);
    *tables = (wt_indent_tables){0};
}
