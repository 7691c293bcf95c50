/* Writes tables according to their schemas. After the first failure nothing is written, and
 * table_end reports it, so that the calls before need no check. Other code calls these functions
 * through core/table/registry.h, which accepts the columns and keys of one table only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_WRITER_H
#define WT_CORE_TABLE_TABLE_WRITER_H

#include "core/table/schema.h"

#include <stdarg.h>

typedef struct table_writer {
    wt_table *table;
    const table_schema *schema; /* borrowed until table_end */
    const char *suffix;
    bool continued; /* the table belongs to the caller */
    wt_status status;
    wt_error *err;
    uint64_t left_out, row, keys;     /* excluded columns, columns set in the last row, keys set */
    size_t column[SCHEMA_FIELDS_MAX]; /* positions of the columns in the table */
} table_writer;

/* Deviations of a table from its schema; 0 and NULL for none. */
typedef struct table_variant {
    const char *suffix; /* of names that end in '/' or '_'; borrowed */
    const char *name, *title;
    uint64_t left_out;           /* excluded columns, one bit each */
    const schema_field *columns; /* with other units or long names */
} table_variant;

/* Create a new table. */
table_writer table_begin(const table_schema *schema, wt_error *err);
table_writer table_begin_variant(const table_schema *schema, table_variant variant, wt_error *err);
/* Continues a table that was created with this schema. */
table_writer table_continue(wt_table *table, const table_schema *schema, const char *suffix,
                            wt_error *err);
void table_row(table_writer *writer);   /* begins a row; the row before must be complete */
void table_block(table_writer *writer); /* begins a block */
/* Checks the last row and the keys, and transfers the table to the caller. On failure the table is
 * freed and *table is NULL. `table` is NULL for a continued table, whose keys are not checked. */
wt_status table_end(table_writer *writer, wt_table **table) WT_NODISCARD;

/* ---- called by core/table/registry.h --------------------------------------------------------- */

void writer_number(table_writer *writer, const table_schema *of, unsigned column, double value);
void writer_text(table_writer *writer, const table_schema *of, unsigned column, const char *text);
/* Set a row or the keys from a structure. `fields` are the fields of `of` with forms and
 * offsets. */
void writer_add_row(table_writer *writer, const table_schema *of, const schema_field *fields,
                    const void *row);
void writer_set_keys(table_writer *writer, const table_schema *of, const schema_field *fields,
                     const void *keys);
void writer_key(table_writer *writer, const table_schema *of, unsigned key, wt_estimate estimate);
void writer_key_text(table_writer *writer, const table_schema *of, unsigned key, const char *text);
void writer_key_print(table_writer *writer, const table_schema *of, unsigned key,
                      const char *format, va_list arguments) WT_PRINTF(4, 0);

#endif
