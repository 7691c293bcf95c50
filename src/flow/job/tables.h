/* Building tables from a list of columns. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_TABLES_H
#define WEARTRACK_FLOW_TABLES_H

#include "weartrack/data.h"

#include <math.h>

typedef struct flow_column {
    const char *name;
    const char *unit; /* NULL = text */
    const char *title;
} flow_column;

/* A new table with these columns, in this order; *table is NULL on failure. */
wt_status flow_table_new(const char *name, const char *title, const flow_column *columns, size_t n,
                         wt_table **table, wt_error *err) WT_NODISCARD;

#define FLOW_COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Sets a key from a format. */
wt_status flow_table_key(wt_table *table, wt_error *err, const char *key, const char *format, ...)
    WT_PRINTF(4, 5) WT_NODISCARD;

/* Key as an estimate with unit. */
wt_status flow_table_value(wt_table *table, const char *key, double value, double standard_error,
                           double numerical_error, const char *unit, wt_error *err) WT_NODISCARD;

/* Appends `what` to a list of words parted by ", "; cut where there is no room. */
void flow_add_words(char *words, size_t size, const char *what);

/* A number of a row by column name, NaN if there is no such column. */
double flow_table_get(const wt_table *table, size_t row, const char *column);

/* Sorts numbers, none of which is NaN, rising. */
void flow_sort(double *x, size_t n);

/* A text of a row by column name, "" if there is no such column. */
const char *flow_table_get_text(const wt_table *table, size_t row, const char *column);

#endif
