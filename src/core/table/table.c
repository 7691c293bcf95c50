/* Tables: columns, rows and blocks. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/table.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/number.h"
#include "core/base/text.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char standard_error_mark[] = " standard_error=";

static const char numerical_error_mark[] = " numerical_error=";

static const char unit_mark[] = " unit=";

static const char *const part_suffixes[KEY_PARTS] = {
    [KEY_STANDARD_ERROR] = "_standard_error",
    [KEY_NUMERICAL_ERROR] = "_numerical_error",
    [KEY_UNITS] = "_units",
};

void table_key_part_names(const char *key, char *names[KEY_PARTS])
{
    for (size_t i = 0; i < KEY_PARTS; i++)
        names[i] = format_text("%s%s", key, part_suffixes[i]);
}

static void key_free(table_key *key)
{
    free(key->name);
    free(key->text);
    free(key->unit);
}

static void table_free_keys(wt_table *table)
{
    for (size_t i = 0; i < table->n_keys; i++)
        key_free(&table->keys[i]);
    free(table->keys);
}

/* Formats an estimate as "17.4 standard_error=0.3 numerical_error=0 unit=K". The caller frees the
 * text. */
static char *format_estimate_key(const wt_estimate *estimate)
{
    char value[32], standard_error[32], numerical_error[32];
    (void)wt_number_format(estimate->value, value);
    (void)wt_number_format(estimate->standard_error, standard_error);
    (void)wt_number_format(estimate->numerical_error, numerical_error);
    const char *const unit =
        estimate->unit != NULL && estimate->unit[0] != '\0' ? estimate->unit : "1";
    return format_text("%s%s%s%s%s%s%s", value, standard_error_mark, standard_error,
                       numerical_error_mark, numerical_error, unit_mark, unit);
}

/* Parses the output of format_estimate_key; estimate->unit points into `text`. */
static bool parse_estimate(const char *text, wt_estimate *estimate)
{
    const char *const second = strstr(text, standard_error_mark);
    const char *const third = second != NULL ? strstr(second, numerical_error_mark) : NULL;
    const char *const fourth = third != NULL ? strstr(third, unit_mark) : NULL;
    if (fourth == NULL)
        return false;
    const char *const standard_error = second + strlen(standard_error_mark);
    const char *const numerical_error = third + strlen(numerical_error_mark);
    estimate->unit = fourth + strlen(unit_mark);
    return estimate->unit[0] != '\0' &&
           parse_stored_number(text, (size_t)(second - text), &estimate->value) &&
           parse_stored_number(standard_error, (size_t)(third - standard_error),
                               &estimate->standard_error) &&
           parse_stored_number(numerical_error, (size_t)(fourth - numerical_error),
                               &estimate->numerical_error);
}

/* True for names with another meaning in a stream or as an attribute in a store. */
static bool is_reserved(const char *name)
{
    static const char *const words[] = {"weartrack", "command", "input",        "table",
                                        "title",     "column",  "column_order", "key_order"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (strcmp(name, words[i]) == 0)
            return true;
    }
    return false;
}

/* True if the estimate key `estimate` needs the name for one of its parts. */
static bool is_estimate_part(const char *name, const char *estimate)
{
    const size_t length = strlen(estimate);
    if (strncmp(name, estimate, length) != 0)
        return false;
    for (size_t i = 0; i < KEY_PARTS; i++) {
        if (strcmp(name + length, part_suffixes[i]) == 0)
            return true;
    }
    return false;
}

static table_key *find_table_key(const wt_table *table, const char *name)
{
    for (size_t i = 0; i < table->n_keys; i++) {
        if (strcmp(table->keys[i].name, name) == 0)
            return &table->keys[i];
    }
    return NULL;
}

static wt_status check_key_name(const char *name, wt_error *err)
{
    if (table_name_part_is_valid(name) && !is_reserved(name))
        return WT_OK;
    wt_fail(err, WT_E_ARG, "not a name for a key");
    wt_error_expected(err, "letters, digits and '_', no word that the file formats use");
    wt_error_found(err, "\"%s\"", name);
    return WT_E_ARG;
}

/* Fills a key from its text. An estimate is rewritten, so that it has one spelling. */
static void fill_key(const char *name, table_key *key)
{
    key->is_estimate = parse_estimate(key->text, &key->parsed);
    if (key->is_estimate) {
        char *const canonical = format_estimate_key(&key->parsed);
        free(key->text);
        key->text = canonical;
        (void)parse_estimate(canonical, &key->parsed);
    }
    key->name = wt_strdup(name);
    key->unit = wt_strdup(key->is_estimate ? key->parsed.unit : "");
    key->parsed.unit = key->unit;
}

/* Finds the key with the name, or adds an empty one. */
static wt_status find_or_add_key(wt_table *table, const char *name, table_key **place,
                                 wt_error *err)
{
    *place = find_table_key(table, name);
    if (*place != NULL)
        return WT_OK;
    if (table->n_keys >= TABLE_KEYS_MAX)
        return wt_fail(err, WT_E_ARG, "more than %d keys", (int)TABLE_KEYS_MAX);
    table->keys = array_grow(table->keys, table->n_keys, sizeof *table->keys);
    *place = &table->keys[table->n_keys++];
    **place = (table_key){0};
    return WT_OK;
}

/* Sets a key. The function takes ownership of `text`, also on failure. */
static wt_status set_key_text(wt_table *table, const char *name, char *text, wt_error *err)
{
    table_key key = {.text = text};
    wt_status status = check_key_name(name, err);
    if (status == WT_OK)
        fill_key(name, &key);
    for (size_t i = 0; status == WT_OK && i < table->n_keys; i++) {
        const table_key *const other = &table->keys[i];
        if ((other->is_estimate && is_estimate_part(name, other->name)) ||
            (key.is_estimate && is_estimate_part(other->name, name)))
            status = wt_fail(err, WT_E_ARG, "keys \"%s\" and \"%s\" of table \"%s\" collide", name,
                             other->name, table->name);
    }
    table_key *place = NULL;
    if (status == WT_OK)
        status = find_or_add_key(table, name, &place, err);
    if (status == WT_OK) {
        key_free(place);
        *place = key;
    } else {
        key_free(&key);
    }
    return status;
}

wt_status wt_table_set_key(wt_table *table, const char *key, const char *text, wt_error *err)
{
    return set_key_text(table, key, wt_strdup(text != NULL ? text : ""), err);
}

wt_status wt_table_set_estimate(wt_table *table, const char *key, wt_estimate estimate,
                                wt_error *err)
{
    return set_key_text(table, key, format_estimate_key(&estimate), err);
}

size_t wt_table_n_keys(const wt_table *table)
{
    return table->n_keys;
}

const char *wt_table_key_name(const wt_table *table, size_t i)
{
    return table->keys[i].name;
}

const char *wt_table_key(const wt_table *table, const char *key)
{
    const table_key *const found = find_table_key(table, key);
    return found != NULL ? found->text : NULL;
}

bool wt_table_estimate(const wt_table *table, const char *key, wt_estimate *estimate)
{
    const table_key *const found = find_table_key(table, key);
    if (found == NULL || !found->is_estimate)
        return false;
    *estimate = found->parsed;
    return true;
}

bool table_name_is_valid(const char *name)
{
    size_t part = 0;
    for (; *name != '\0'; name++) {
        if (*name == '/') {
            if (part == 0)
                return false;
            part = 0;
        } else if (strchr("abcdefghijklmnopqrstuvwxyz0123456789_", *name) != NULL) {
            part++;
        } else {
            return false;
        }
    }
    return part > 0;
}

bool table_name_part_is_valid(const char *word)
{
    return word[0] != '\0' && word[strspn(word, "abcdefghijklmnopqrstuvwxyz"
                                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == '\0';
}

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

void wt_tables_clear(void *tables, size_t size)
{
    wt_table **const table = tables;
    for (size_t i = 0; i < size / sizeof *table; i++) {
        wt_table_free(table[i]);
        table[i] = NULL;
    }
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

void wt_table_set_text(wt_table *table, size_t column, const char *text)
{
    assert(table->n_rows > 0 && column < table->n_columns &&
           table->columns[column].kind == WT_COLUMN_TEXT);
    char *copy = NULL;
    char **const cell = &table->columns[column].texts[table->n_rows - 1];
    char *const above = table->n_rows > 1 ? cell[-1] : NULL;
    if (text != NULL && text[0] != '\0')
        copy = above != NULL && strcmp(text, above) == 0 ? above : wt_strdup(text);
    if (*cell != above)
        free(*cell);
    *cell = copy;
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

void wt_table_new_block(wt_table *table)
{
    /* A block without rows is not created. */
    if (table->n_blocks > 0 && table->blocks[table->n_blocks - 1] != table->n_rows)
        begin_block(table);
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
