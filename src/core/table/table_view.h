/* Reading a table as its schema says: its columns are found once, and one that must be there and is
 * not is an error. The functions here are called through those of core/table/registry.h, which take
 * the columns and keys of one table only. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_VIEW_H
#define WT_CORE_TABLE_TABLE_VIEW_H

#include "core/table/schema.h"

typedef struct table_view {
    const wt_table *table; /* borrowed; NULL: there is none, and no rows and keys */
    const table_schema *schema;
    const char *suffix; /* of names that end in '/' or '_'; borrowed */
    size_t n_rows;
    long column[SCHEMA_MOST]; /* places of the columns, -1 = not in this table */
} table_view;

/* WT_E_MISSING names the table and the column or key, WT_E_UNIT a unit other than the declared. */
wt_status table_bind(const wt_table *table, const table_schema *schema, const char *suffix,
                     table_view *view, wt_error *err) WT_NODISCARD;
/* The table of this schema in a result; a view without a table if it has none. */
wt_status table_bind_of(const wt_result *result, const table_schema *schema, const char *suffix,
                        table_view *view, wt_error *err) WT_NODISCARD;

/* ---- behind core/table/registry.h -------------------------------------------------------------
 */

bool view_has(const table_view *view, const table_schema *of, unsigned column);
/* NaN or "" where an optional column is not there. */
double view_number(const table_view *view, const table_schema *of, size_t row, unsigned column);
const char *view_text(const table_view *view, const table_schema *of, size_t row, unsigned column);
/* All NaN if the key is not there or is text in the place of a number. */
wt_estimate view_key(const table_view *view, const table_schema *of, unsigned key);
const char *view_key_text(const table_view *view, const table_schema *of, unsigned key); /* NULL */

#endif
