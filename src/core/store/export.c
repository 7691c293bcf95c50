/* Exports a table for other programs: text with separators, or JSON. A missing number is an empty
 * cell, or null. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/registry.h"
#include "core/table/table.h"

#include <errno.h>
#include <math.h>
#include <string.h>

/* ---- text with separators -------------------------------------------------------------------- */

/* True if a spreadsheet would execute the text as a formula; numbers are harmless. */
static bool is_formula(const char *text)
{
    double number;
    return text[0] != '\0' && strchr("=+-@\t\r", text[0]) != NULL && text[1] != '\0' &&
           !wt_number_parse(text, strlen(text), '.', &number);
}

/* Writes a cell with quotes as in RFC 4180, also between tabs. `mark` precedes the text. */
static void write_cell(FILE *out, const char *mark, const char *text, char separator)
{
    const char special[] = {separator, '"', '\n', '\r', '\0'};
    if (strpbrk(text, special) == NULL) {
        (void)fprintf(out, "%s%s", mark, text);
        return;
    }
    (void)fprintf(out, "\"%s", mark);
    for (const char *p = text; *p != '\0'; p++) {
        if (*p == '"')
            (void)putc('"', out);
        (void)putc(*p, out);
    }
    (void)putc('"', out);
}

static const char *format_cell_number(double value, char buffer[32])
{
    buffer[0] = '\0';
    if (!isnan(value))
        (void)wt_number_format(value, buffer);
    return buffer;
}

static void write_separated_header(FILE *out, const wt_table *table, bool blocks, char separator)
{
    if (blocks)
        (void)fprintf(out, "block%c", separator);
    for (size_t i = 0; i < wt_table_n_columns(table); i++) {
        char name[256];
        const char *unit = wt_table_column_unit(table, i);
        const bool has_unit = *unit != '\0' && strcmp(unit, "1") != 0;
        (void)snprintf(name, sizeof name, has_unit ? "%s[%s]" : "%s",
                       wt_table_column_name(table, i), unit);
        if (i > 0)
            (void)putc(separator, out);
        write_cell(out, "", name, separator);
    }
    (void)putc('\n', out);
}

/* A table with several blocks has a first column with the block number. */
static bool has_blocks(const wt_table *table)
{
    const size_t n = wt_table_n_rows(table);
    return n > 0 && wt_table_block(table, n - 1) > 0;
}

static void write_separated(FILE *out, const wt_table *table, char separator, bool formulas)
{
    char number[32];
    const bool blocks = has_blocks(table);
    write_separated_header(out, table, blocks, separator);
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        if (blocks)
            (void)fprintf(out, "%zu%c", wt_table_block(table, row), separator);
        for (size_t i = 0; i < wt_table_n_columns(table); i++) {
            if (i > 0)
                (void)putc(separator, out);
            if (wt_table_column_kind(table, i) == WT_COLUMN_TEXT)
                write_cell(out, !formulas && is_formula(wt_table_text(table, row, i)) ? "'" : "",
                           wt_table_text(table, row, i), separator);
            else
                (void)fputs(format_cell_number(wt_table_number(table, row, i), number), out);
        }
        (void)putc('\n', out);
    }
}

/* ---- JSON ------------------------------------------------------------------------------------ */

/* JSON has no infinite numbers: they are strings. */
static void write_json_number(FILE *out, double value)
{
    char number[32];
    if (isnan(value))
        (void)fputs("null", out);
    else
        (void)fprintf(out, isinf(value) ? "\"%s\"" : "%s", format_cell_number(value, number));
}

static void write_json_member(FILE *out, const char *before, const char *name, const char *text)
{
    (void)fprintf(out, "%s\"%s\": ", before, name);
    json_write_text(out, text);
}

/* True if the schema of the table declares the key as a number that is stored as text. */
static bool is_plain_number(const wt_table *table, const char *key)
{
    const char *name = wt_table_name(table);
    for (size_t i = 0; i < table_n_schemas; i++) {
        const table_schema *schema = table_schemas[i];
        const size_t length = strlen(schema->name);
        if (strcmp(schema->name, name) != 0 && (length == 0 || schema->name[length - 1] != '/' ||
                                                strncmp(schema->name, name, length) != 0))
            continue;
        for (size_t k = 0; k < schema->n_keys; k++) {
            const schema_field *field = &schema->keys[k];
            const size_t own = strlen(field->name);
            if (field->kind == SCHEMA_PLAIN &&
                (strcmp(field->name, key) == 0 ||
                 (field->name[own - 1] == '_' && strncmp(field->name, key, own) == 0)))
                return true;
        }
    }
    return false;
}

static void write_json_keys(FILE *out, const wt_table *table)
{
    double plain;
    (void)fputs(",\n \"keys\": {", out);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *name = wt_table_key_name(table, i);
        wt_estimate e;
        (void)fputs(i > 0 ? ",\n  " : "\n  ", out);
        json_write_text(out, name);
        (void)fputs(": ", out);
        if (!wt_table_estimate(table, name, &e)) {
            const char *text = wt_table_key(table, name);
            if (is_plain_number(table, name) && wt_number_parse(text, strlen(text), '.', &plain)) {
                write_json_number(out, plain);
                continue;
            }
            json_write_text(out, wt_table_key(table, name));
            continue;
        }
        (void)fputs("{\"value\": ", out);
        write_json_number(out, e.value);
        (void)fputs(", \"standard_error\": ", out);
        write_json_number(out, e.standard_error);
        (void)fputs(", \"numerical_error\": ", out);
        write_json_number(out, e.numerical_error);
        write_json_member(out, ", ", "unit", e.unit);
        (void)putc('}', out);
    }
    (void)putc('}', out);
}

static void write_json_columns(FILE *out, const wt_table *table)
{
    (void)fputs(",\n \"columns\": [", out);
    for (size_t i = 0; i < wt_table_n_columns(table); i++) {
        write_json_member(out, i > 0 ? ",\n  {" : "\n  {", "name", wt_table_column_name(table, i));
        if (wt_table_column_kind(table, i) == WT_COLUMN_NUMBER)
            write_json_member(out, ", ", "unit", wt_table_column_unit(table, i));
        write_json_member(out, ", ", "long_name", wt_table_column_long_name(table, i));
        (void)putc('}', out);
    }
    (void)putc(']', out);
}

static void write_json(FILE *out, const wt_table *table)
{
    const bool blocks = has_blocks(table);
    write_json_member(out, "{", "table", wt_table_name(table));
    write_json_member(out, ",\n ", "title", wt_table_title(table));
    write_json_keys(out, table);
    write_json_columns(out, table);
    (void)fputs(",\n \"rows\": [", out);
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        (void)fputs(row > 0 ? ",\n  {" : "\n  {", out);
        if (blocks)
            (void)fprintf(out, "\"block\": %zu, ", wt_table_block(table, row));
        for (size_t i = 0; i < wt_table_n_columns(table); i++) {
            (void)fprintf(out, "%s\"%s\": ", i > 0 ? ", " : "", wt_table_column_name(table, i));
            if (wt_table_column_kind(table, i) == WT_COLUMN_TEXT)
                json_write_text(out, wt_table_text(table, row, i));
            else
                write_json_number(out, wt_table_number(table, row, i));
        }
        (void)putc('}', out);
    }
    (void)fputs("]}\n", out);
}

wt_status wt_table_export(FILE *out, const wt_table *table, wt_export_form form, bool formulas,
                          wt_error *err)
{
    if (form == WT_EXPORT_STREAM)
        return wt_stream_write(out, table, NULL, err);
    if (form == WT_EXPORT_JSON)
        write_json(out, table);
    else
        write_separated(out, table, form == WT_EXPORT_CSV ? ',' : '\t', formulas);
    return ferror(out) ? wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno)) : WT_OK;
}
