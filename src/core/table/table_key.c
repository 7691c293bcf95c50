/* Keys of a table. An estimate is a key whose text has a fixed form, so that a stream contains it
 * like any other key. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/table.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/number.h"

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
        if (asprintf(&names[i], "%s%s", key, part_suffixes[i]) < 0)
            out_of_memory(strlen(key));
}

static void key_free(table_key *key)
{
    free(key->name);
    free(key->text);
    free(key->unit);
}

void table_free_keys(wt_table *table)
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
    char *text = NULL;
    (void)wt_number_format(estimate->value, value);
    (void)wt_number_format(estimate->standard_error, standard_error);
    (void)wt_number_format(estimate->numerical_error, numerical_error);
    const char *const unit =
        estimate->unit != NULL && estimate->unit[0] != '\0' ? estimate->unit : "1";
    if (asprintf(&text, "%s%s%s%s%s%s%s", value, standard_error_mark, standard_error,
                 numerical_error_mark, numerical_error, unit_mark, unit) < 0)
        out_of_memory(sizeof *text);
    return text;
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
