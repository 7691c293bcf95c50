/* The accepted part of an indentation table as a group.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/flow.h"

#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    table_view t;
    wt_status status = table_bind(table, &indentation_schema, "", &t, err);
    if (status != WT_OK)
        return status;
    size_t allocated = t.n_rows > 0 ? t.n_rows : 1;
    wt_group_data d = {0};
    named *names = malloc(allocated * sizeof *names);
    d.modulus = malloc(allocated * sizeof *d.modulus);
    d.spot = malloc(allocated * sizeof *d.spot);
    d.indentation_rate = malloc(allocated * sizeof *d.indentation_rate);
    d.equivalent_frequency = malloc(allocated * sizeof *d.equivalent_frequency);
    if (names == NULL || d.modulus == NULL || d.spot == NULL || d.indentation_rate == NULL ||
        d.equivalent_frequency == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    for (size_t row = 0; row < t.n_rows; row++) {
        double modulus = indentation_get(&t, row, INDENTATION_MODULUS);
        if (strcmp(indentation_text(&t, row, INDENTATION_VERDICT), "accepted") != 0) {
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
        names[i] = (named){indentation_text(&t, row, INDENTATION_SPOT), i};
        d.indentation_rate[i] = indentation_get(&t, row, INDENTATION_RATE);
        d.equivalent_frequency[i] = indentation_get(&t, row, INDENTATION_EQUIVALENT_FREQUENCY);
    }
    number_spots(names, d.group.n, d.spot);
    const char *spots = indentation_words(&t, INDENTATION_KEY_SPOTS);
    d.spots_given = spots != NULL && strncmp(spots, "named", 5) == 0;
    d.group.modulus = d.modulus;
    d.group.spot = indentation_has(&t, INDENTATION_SPOT) ? d.spot : NULL;
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
