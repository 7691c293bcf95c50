/* Reads tables according to their schemas. Binding finds all columns once; a missing required
 * column is an error. Other code calls these functions through core/table/registry.h, which accepts
 * the columns and keys of one table only. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_VIEW_H
#define WT_CORE_TABLE_TABLE_VIEW_H

#include "core/table/schema.h"

typedef struct table_view {
    const wt_table *table; /* borrowed; NULL without a table, and then without rows and keys */
    const table_schema *schema;
    const char *suffix; /* of names that end in '/' or '_'; borrowed */
    size_t n_rows;
    long column[SCHEMA_FIELDS_MAX]; /* positions of the columns; -1 if the table lacks the column */
} table_view;

/* Binds a table to a schema. WT_E_MISSING names the table and the column or key; WT_E_UNIT reports
 * a unit that differs from the schema. */
wt_status table_bind(const wt_table *table, const table_schema *schema, const char *suffix,
                     table_view *view, wt_error *err) WT_NODISCARD;
/* Binds the table of the schema in a result; the view has no table if the result lacks it. */
wt_status table_bind_result(const wt_result *result, const table_schema *schema, const char *suffix,
                            table_view *view, wt_error *err) WT_NODISCARD;

/* ---- called by core/table/registry.h --------------------------------------------------------- */

bool view_has_column(const table_view *view, const table_schema *of, unsigned column);
/* Return a cell; NaN or "" if an optional column is missing. */
double view_number(const table_view *view, const table_schema *of, size_t row, unsigned column);
const char *view_text(const table_view *view, const table_schema *of, size_t row, unsigned column);
/* Return a text that is from a closed list, and its reason. */
listed_text view_listed(const table_view *view, const table_schema *of, size_t row,
                        unsigned column);
listed_text view_key_listed(const table_view *view, const table_schema *of, unsigned key);
/* Returns the set of texts in a key that lists several. */
uint64_t view_key_items(const table_view *view, const table_schema *of, unsigned key);
/* Returns an estimate; NaN if the key is missing or is a text. */
wt_estimate view_key(const table_view *view, const table_schema *of, unsigned key);
const char *view_key_text(const table_view *view, const table_schema *of,
                          unsigned key); /* NULL if missing */

#endif
