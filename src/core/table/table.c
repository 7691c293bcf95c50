/* Tables: columns, rows and blocks. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/table.h"

#include "core/base/array.h"
#include "core/base/utf8.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_table *wt_table_new(const char *name, const char *title)
{
    wt_table *const table = wt_alloc(1, sizeof *table);
    table->name = wt_strdup(name);
    table->title = wt_strdup(title != NULL ? title : "");
    return table;
}

static void column_free(table_column *column, size_t n_rows)
{
    for (size_t i = 0; column->texts != NULL && i < n_rows; i++)
        if (i == 0 || column->texts[i] != column->texts[i - 1])
            free(column->texts[i]);
    free(column->texts);
    free(column->numbers);
    free(column->name);
    free(column->unit);
    free(column->long_name);
}

void wt_table_free(wt_table *table)
{
    if (table == NULL)
        return;
    for (size_t i = 0; i < table->n_columns; i++)
        column_free(&table->columns[i], table->n_rows);
    free(table->columns);
    free(table->blocks);
    table_free_keys(table);
    free(table->name);
    free(table->title);
    free(table);
}

const char *wt_table_name(const wt_table *table)
{
    return table->name;
}

wt_status wt_table_rename(wt_table *table, const char *name, wt_error *err)
{
    if (!table_name_is_valid(name))
        return wt_fail(err, WT_E_ARG, "\"%s\" is no name of a table", name);
    char *const former = table->name;
    table->name = wt_strdup(name); /* `name` may be part of the former one */
    free(former);
    return WT_OK;
}

const char *wt_table_title(const wt_table *table)
{
    return table->title;
}

/* A unit is written between square brackets in a line with tabs as separators. */
static bool unit_is_valid(const char *unit)
{
    const size_t length = strlen(unit);
    if (length == 0 || strcmp(unit, "text") == 0 || utf8_valid_length(unit, length) != length)
        return false;
    for (size_t i = 0; i < length; i++) {
        if ((unsigned char)unit[i] < ' ' || strchr("[]\x7F", unit[i]) != NULL)
            return false;
    }
    return true;
}

static wt_status add_typed_column(wt_table *table, wt_column_kind kind, const char *name,
                                  const char *unit, const char *long_name, wt_error *err)
{
    if (table->n_rows > 0)
        return wt_fail(err, WT_E_ARG, "column \"%s\" added to table \"%s\" after its rows", name,
                       table->name);
    if (table->n_columns >= TABLE_COLUMNS_MAX)
        return wt_fail(err, WT_E_ARG, "more than %d columns", (int)TABLE_COLUMNS_MAX);
    if (!table_name_part_is_valid(name) || strcmp(name, "block") == 0) {
        (void)wt_fail(err, WT_E_ARG, "not a name for a column");
        wt_error_expected(err, "letters, digits and '_', but not \"block\"");
        wt_error_found(err, "\"%s\"", name);
        return WT_E_ARG;
    }
    if (wt_table_find(table, name) >= 0)
        return wt_fail(err, WT_E_ARG, "two columns \"%s\" in table \"%s\"", name, table->name);
    if (kind == WT_COLUMN_NUMBER && !unit_is_valid(unit)) {
        (void)wt_fail(err, WT_E_ARG, "not a unit for column \"%s\"", name);
        wt_error_expected(err, "an SI unit, \"1\" for a number");
        wt_error_found(err, "\"%s\"", unit);
        return WT_E_ARG;
    }
    table->columns = array_grow(table->columns, table->n_columns, sizeof *table->columns);
    table->columns[table->n_columns++] =
        (table_column){.kind = kind,
                       .name = wt_strdup(name),
                       .unit = wt_strdup(unit),
                       .long_name = wt_strdup(long_name != NULL ? long_name : "")};
    return WT_OK;
}

wt_status wt_table_add_column(wt_table *table, const char *name, const char *unit,
                              const char *long_name, wt_error *err)
{
    return add_typed_column(table, WT_COLUMN_NUMBER, name, unit, long_name, err);
}

wt_status wt_table_add_text_column(wt_table *table, const char *name, const char *long_name,
                                   wt_error *err)
{
    return add_typed_column(table, WT_COLUMN_TEXT, name, "", long_name, err);
}

static void grow_columns(wt_table *table)
{
    for (size_t i = 0; i < table->n_columns; i++) {
        table_column *const column = &table->columns[i];
        if (column->kind == WT_COLUMN_NUMBER)
            column->numbers = array_grow(column->numbers, table->n_rows, sizeof(double));
        else
            column->texts = array_grow(column->texts, table->n_rows, sizeof(char *));
    }
}

static void begin_block(wt_table *table)
{
    table->blocks = array_grow(table->blocks, table->n_blocks, sizeof *table->blocks);
    table->blocks[table->n_blocks++] = table->n_rows;
}

wt_status wt_table_add_row(wt_table *table, wt_error *err)
{
    if (table->n_columns == 0)
        return wt_fail(err, WT_E_ARG, "table \"%s\" has no columns", table->name);
    grow_columns(table);
    if (table->n_blocks == 0)
        begin_block(table);
    for (size_t i = 0; i < table->n_columns; i++) {
        if (table->columns[i].kind == WT_COLUMN_NUMBER)
            table->columns[i].numbers[table->n_rows] = (double)NAN;
        else
            table->columns[i].texts[table->n_rows] = NULL;
    }
    table->n_rows++;
    return WT_OK;
}

size_t wt_table_n_rows(const wt_table *table)
{
    return table->n_rows;
}

size_t wt_table_n_columns(const wt_table *table)
{
    return table->n_columns;
}

wt_column_kind wt_table_column_kind(const wt_table *table, size_t column)
{
    return table->columns[column].kind;
}

const char *wt_table_column_name(const wt_table *table, size_t column)
{
    return table->columns[column].name;
}

const char *wt_table_column_unit(const wt_table *table, size_t column)
{
    return table->columns[column].unit;
}

const char *wt_table_column_long_name(const wt_table *table, size_t column)
{
    return table->columns[column].long_name;
}

long wt_table_find(const wt_table *table, const char *column_name)
{
    for (size_t i = 0; i < table->n_columns; i++) {
        if (strcmp(table->columns[i].name, column_name) == 0)
            return (long)i;
    }
    return -1;
}

void wt_table_set_number(wt_table *table, size_t column, double value)
{
    assert(table->n_rows > 0 && column < table->n_columns &&
           table->columns[column].kind == WT_COLUMN_NUMBER);
    table->columns[column].numbers[table->n_rows - 1] = value;
}

wt_status wt_table_set_text(wt_table *table, size_t column, const char *text, wt_error *err)
{
    assert(table->n_rows > 0 && column < table->n_columns &&
           table->columns[column].kind == WT_COLUMN_TEXT);
    char *copy = NULL;
    char **const cell = &table->columns[column].texts[table->n_rows - 1];
    char *const above = table->n_rows > 1 ? cell[-1] : NULL;
    (void)err;
    if (text != NULL && text[0] != '\0')
        copy = above != NULL && strcmp(text, above) == 0 ? above : wt_strdup(text);
    if (*cell != above)
        free(*cell);
    *cell = copy;
    return WT_OK;
}

double wt_table_number(const wt_table *table, size_t row, size_t column)
{
    assert(row < table->n_rows && column < table->n_columns &&
           table->columns[column].kind == WT_COLUMN_NUMBER);
    return table->columns[column].numbers[row];
}

const char *wt_table_text(const wt_table *table, size_t row, size_t column)
{
    assert(row < table->n_rows && column < table->n_columns &&
           table->columns[column].kind == WT_COLUMN_TEXT);
    const char *const text = table->columns[column].texts[row];
    return text != NULL ? text : "";
}

const double *wt_table_numbers(const wt_table *table, size_t column)
{
    assert(column < table->n_columns && table->columns[column].kind == WT_COLUMN_NUMBER);
    return table->columns[column].numbers;
}

wt_status wt_table_new_block(wt_table *table, wt_error *err)
{
    /* A block without rows is not created. */
    (void)err;
    if (table->n_blocks > 0 && table->blocks[table->n_blocks - 1] != table->n_rows)
        begin_block(table);
    return WT_OK;
}

size_t wt_table_block(const wt_table *table, size_t row)
{
    size_t low = 0, high = table->n_blocks; /* blocks[low] <= row < blocks[high] */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (table->blocks[middle] <= row)
            low = middle;
        else
            high = middle;
    }
    return low;
}
