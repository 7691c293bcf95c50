/* Table of a layer in the contact of sliding_fixture.h, and numbers of its keys.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_LAYER_TABLES_H
#define WT_TESTS_LAYER_TABLES_H

#include "sliding_fixture.h"
#include "table_cells.h"
#include "weartrack/layer.h"

#include <stdlib.h>
#include <string.h>

static inline wt_table *layer_of(const wt_layer_job *job)
{
    wt_layer_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_thickness_compute(&sliding, job, &work, &tables, &err) != WT_OK)
        fail_msg("layer: %s %s", err.message, err.found);
    return tables.layer;
}

/* Number after the words in a key, "" for the value itself. */
static inline double number_after(const wt_table *table, const char *key, const char *words)
{
    const char *text = wt_table_key(table, key);
    const char *at = text != NULL ? strstr(text, words) : NULL;
    if (at == NULL)
        fail_msg("no %s of %s", words, key);
    return strtod(at + strlen(words), NULL);
}

static inline double key_number(const wt_table *table, const char *key)
{
    return number_after(table, key, "");
}

#endif
