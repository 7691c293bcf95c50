/* Filling a table as its schema says. The first failure stays: nothing is written after it, and
 * table_end reports it, so that no call between needs to be checked. The functions here are called
 * through those of core/table/registry.h, which take the columns and keys of one table only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_WRITER_H
#define WT_CORE_TABLE_TABLE_WRITER_H

#include "core/table/schema.h"

#include <stdarg.h>

typedef struct table_writer {
    wt_table *table;
    const table_schema *schema; /* borrowed until table_end */
    const char *suffix;
    bool continued; /* a table of the caller */
    wt_status status;
    wt_error *err;
    uint64_t left_out, row, keys; /* columns not there, columns put in the last row, keys set */
    size_t column[SCHEMA_MOST];   /* places of the columns in the table */
} table_writer;

/* What one table has instead of what its schema says; 0 and NULL: nothing. */
typedef struct table_variant {
    const char *suffix; /* of names that end in '/' or '_'; borrowed */
    const char *name, *title;
    uint64_t left_out;           /* columns that it is without, a bit for each */
    const schema_field *columns; /* with other units or words */
} table_variant;

/* A new table. */
table_writer table_begin(const table_schema *schema, wt_error *err);
table_writer table_begin_variant(const table_schema *schema, table_variant own, wt_error *err);
/* More rows and keys for a table made with this schema. */
table_writer table_continue(wt_table *table, const table_schema *schema, const char *suffix,
                            wt_error *err);
void table_row(table_writer *writer);   /* begins a row; the one before must be complete */
void table_block(table_writer *writer); /* begins a block */
/* Checks the last row and the keys and hands the table over; on failure it is freed and *table is
 * NULL. `table` is NULL for a continued one, whose keys are not checked. */
wt_status table_end(table_writer *writer, wt_table **table) WT_NODISCARD;

/* ---- behind core/table/registry.h -------------------------------------------------------------
 */

void writer_number(table_writer *writer, const table_schema *of, unsigned column, double value);
void writer_text(table_writer *writer, const table_schema *of, unsigned column, const char *text);
/* A row and keys of what a structure shows; `fields` are those of `of` with forms and offsets. */
void writer_row(table_writer *writer, const table_schema *of, const schema_field *fields,
                const void *row);
void writer_keys(table_writer *writer, const table_schema *of, const schema_field *fields,
                 const void *keys);
void writer_key(table_writer *writer, const table_schema *of, unsigned key, wt_estimate estimate);
void writer_key_text(table_writer *writer, const table_schema *of, unsigned key, const char *text);
void writer_key_print(table_writer *writer, const table_schema *of, unsigned key,
                      const char *format, va_list arguments) WT_PRINTF(4, 0);

#endif
