/* Headlines of a result, and the table with one row for each result. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/store/store.h"
#include "core/table/finding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_status wt_result_contents(const wt_result *result, wt_table **list, wt_error *err)
{
    table_writer t = table_begin(&contents_schema, err);
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const wt_table *table = wt_result_table(result, i);
        table_row(&t);
        contents_put_text(&t, CONTENTS_TABLE, wt_table_name(table));
        contents_put(&t, CONTENTS_ROWS_OF, (double)wt_table_n_rows(table));
        contents_put(&t, CONTENTS_COLUMNS_OF, (double)wt_table_n_columns(table));
        contents_put(&t, CONTENTS_KEYS_OF, (double)wt_table_n_keys(table));
        contents_put_text(&t, CONTENTS_TITLE, wt_table_title(table));
    }
    return table_end(&t, list);
}

wt_status wt_table_keys(const wt_table *table, wt_table **list, wt_error *err)
{
    table_writer t = table_begin(&keys_schema, err);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *name = wt_table_key_name(table, i), *text = wt_table_key(table, name);
        wt_estimate e = {0};
        double plain = 0;
        const bool is_estimate = wt_table_estimate(table, name, &e);
        table_row(&t);
        keys_put_text(&t, KEYS_KEY, name);
        if (is_estimate) {
            keys_put(&t, KEYS_VALUE, e.value);
            keys_put(&t, KEYS_STANDARD_ERROR, e.standard_error);
            keys_put(&t, KEYS_NUMERICAL_ERROR, e.numerical_error);
            keys_put_text(&t, KEYS_UNIT, e.unit);
        } else if (wt_number_parse(text, strlen(text), '.', &plain)) {
            keys_put(&t, KEYS_VALUE, plain);
        } else {
            keys_put_text(&t, KEYS_WORDS, text);
        }
    }
    return table_end(&t, list);
}

/* ---- headlines of one result ----------------------------------------------------------------- */

/* Adds a row to the table "keys". `words` is the text of a key, or the description of a number. */
static void add_headline(table_writer *t, const char *name, wt_estimate e, const char *words)
{
    table_row(t);
    keys_put_text(t, KEYS_KEY, name);
    keys_put(t, KEYS_VALUE, e.value);
    keys_put(t, KEYS_STANDARD_ERROR, e.standard_error);
    keys_put(t, KEYS_NUMERICAL_ERROR, e.numerical_error);
    keys_put_text(t, KEYS_UNIT, e.unit);
    keys_put_text(t, KEYS_WORDS, words);
}

static void add_number_headline(table_writer *t, const char *stem, const char *suffix, double value,
                                const char *unit)
{
    char name[2 * SCHEMA_NAME_SIZE];
    (void)snprintf(name, sizeof name, "%s%s", stem, suffix);
    add_headline(t, name, (wt_estimate){value, (double)NAN, (double)NAN, unit}, NULL);
}

static void add_text_headline(table_writer *t, const char *name, const char *words)
{
    add_headline(t, name, (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL}, words);
}

static void add_bounds(table_writer *t, const char *stem, const char *suffixes[2], double low,
                       double high, const char *unit)
{
    if (isnan(low) && isnan(high))
        return;
    add_number_headline(t, stem, suffixes[0], low, unit);
    add_number_headline(t, stem, suffixes[1], high, unit);
}

static const char *bound_suffixes[2] = {"_low", "_high"};

/* Adds the limits of the interval and of the range over model choices. */
static void add_value_bounds(table_writer *t, const char *name, const result_value *f)
{
    static const char *range[2] = {"_model_low", "_model_high"};
    add_bounds(t, name, bound_suffixes, f->low, f->high, f->number.unit);
    add_bounds(t, name, range, f->range.low, f->range.high, f->number.unit);
}

/* Adds the keys that the schema declares as headlines. */
static void add_key_headlines(table_writer *t, const result_value_tables *found,
                              const table_view *view)
{
    const table_schema *schema = view->schema;
    for (unsigned i = 0; view->table != NULL && i < schema->n_keys; i++) {
        const schema_field *key = &schema->keys[i];
        result_value f;
        if (key->headline == NULL || view_key_text(view, schema, i) == NULL ||
            strcmp(key->name, "verdict") == 0) /* the column has the verdict of the comparison */
            continue;
        if (key->kind == SCHEMA_TEXT) /* without a reason */
            add_text_headline(t, key->name,
                              key->list != NULL ? view_key_listed(view, schema, i).text
                                                : view_key_text(view, schema, i));
        else
            add_headline(t, key->name, view_key(view, schema, i), key->headline);
        if (result_value_from_key(found, key, &f))
            add_value_bounds(t, key->name, &f);
    }
}

static void add_group_headlines(table_writer *t, const result_value_tables *found)
{
    const table_view *groups = &found->groups;
    for (size_t row = 0; row < groups->n_rows; row++) {
        char stem[SCHEMA_NAME_SIZE];
        const result_value f = result_value_group(found, row);
        const char *group = modulus_groups_text(groups, row, MODULUS_GROUPS_GROUP);
        (void)snprintf(stem, sizeof stem, "%s_%s", f.name, group);
        add_number_headline(t, stem, "", f.number.value, f.number.unit);
        add_value_bounds(t, stem, &f);
        add_number_headline(t, "used_", group, modulus_groups_get(groups, row, MODULUS_GROUPS_N),
                            "1");
        add_number_headline(t, "rejected_", group,
                            modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED), "1");
    }
}

static void add_ratio_headlines(table_writer *t, const result_value_tables *found)
{
    if (found->comparison.n_rows == 0)
        return;
    finding findings[FINDING_QUESTIONS];
    (void)findings_compute(found, findings);
    const result_value f = findings[FINDING_TRACK_DIFFERS].value;
    add_text_headline(t, "verdict", finding_verdict_text(findings[FINDING_TRACK_DIFFERS].verdict));
    add_number_headline(t, f.name, "", f.number.value, f.number.unit);
    add_value_bounds(t, f.name, &f);
    add_number_headline(t, "welch_p", "", comparison_get(&found->comparison, 0, COMPARISON_WELCH_P),
                        "1");
}

/* Returns how completely the result answers the request. */
static wt_result_status result_completeness(const table_view *failures, const table_view *notes)
{
    bool lost = failures->n_rows > 0;
    for (size_t row = 0; row < notes->n_rows; row++)
        lost = lost || notes_enum(notes, row, NOTES_SEVERITY) == WT_LOSS;
    if (parse_number_or_nan(failures_key_text(failures, FAILURES_KEY_STATUS)) == WT_RESULT_EMPTY)
        return WT_RESULT_EMPTY;
    return lost ? WT_RESULT_PARTIAL : WT_RESULT_COMPLETE;
}

/* Adds the headlines of the keys of all tables, in the order of the registry. */
static wt_status add_table_headlines(table_writer *t, const wt_result *result,
                                     const result_value_tables *found, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t s = 0; status == WT_OK && s < table_n_schemas; s++) {
        table_view view;
        if (wt_result_find(result, table_schemas[s]->name) == NULL)
            continue;
        status = table_bind_result(result, table_schemas[s], "", &view, err);
        if (status == WT_OK)
            add_key_headlines(t, found, &view);
    }
    return status;
}

wt_status wt_result_main_values(const wt_result *result, wt_table **headlines, wt_error *err)
{
    result_value_tables found;
    const wt_status status = result_values_bind(result, &found, err);
    const table_view *const answer = &found.answer, *notes = &found.notes, *shifts = &found.shifts;
    if (status != WT_OK)
        return status;
    double n_remarks = 0;
    for (size_t row = 0; row < notes->n_rows; row++)
        n_remarks += notes_enum(notes, row, NOTES_SEVERITY) != WT_NOTE;
    table_writer t = table_begin(&keys_schema, err);
    add_number_headline(&t, "status", "", result_completeness(&found.failures, notes), "1");
    if (answer->table != NULL && answer_key_text(answer, ANSWER_KEY_CASE_TITLE) != NULL)
        add_text_headline(&t, "case_title", answer_key_text(answer, ANSWER_KEY_CASE_TITLE));
    add_ratio_headlines(&t, &found);
    add_group_headlines(&t, &found);
    if (t.status == WT_OK)
        t.status = add_table_headlines(&t, result, &found, err);
    /* the misfit of the common spectrum, on which the verdict on superposition is based */
    add_bounds(&t, "superposition_misfit", bound_suffixes,
               parse_number_or_nan(shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_MISFIT_LOW)),
               parse_number_or_nan(shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_MISFIT_HIGH)),
               "1");
    add_number_headline(&t, "remarks", "", n_remarks, "1");
    add_number_headline(&t, "failures", "", (double)found.failures.n_rows, "1");
    return table_end(&t, headlines);
}

/* ---- one row for each result ----------------------------------------------------------------- */

/* Headline of at least one result. */
typedef struct column {
    const char *name, *unit; /* unit "" for a text */
    const char *words;
    bool has_error[2]; /* standard and numerical */
} column;
static const keys_column error_of[2] = {KEYS_STANDARD_ERROR, KEYS_NUMERICAL_ERROR};
static const char *const error_suffix[2] = {"_standard_error", "_numerical_error"};
static const char *const error_words[2] = {"its standard error", "its numerical error"};

typedef struct columns {
    column *column;
    size_t n;
} columns;

/* Merges the headlines of a result into the list. A new one is inserted after its predecessor. */
static void merge_headline_columns(columns *list, const table_view *headlines)
{
    size_t place = 0;
    for (size_t row = 0; row < headlines->n_rows; row++) {
        const char *name = keys_text(headlines, row, KEYS_KEY);
        size_t i = place; /* most results have the same order */
        if (i >= list->n || strcmp(list->column[i].name, name) != 0)
            i = 0;
        while (i < list->n && strcmp(list->column[i].name, name) != 0)
            i++;
        if (i == list->n) {
            column *grown = array_grow(list->column, list->n, sizeof *grown);
            list->column = grown;
            memmove(grown + place + 1, grown + place, (list->n - place) * sizeof *grown);
            grown[place] = (column){name,
                                    keys_text(headlines, row, KEYS_UNIT),
                                    keys_text(headlines, row, KEYS_WORDS),
                                    {false, false}};
            list->n++;
            i = place;
        }
        for (int e = 0; e < 2; e++)
            list->column[i].has_error[e] |= keys_get(headlines, row, error_of[e]) > 0;
        place = i + 1;
    }
}

static wt_status add_summary_columns(wt_table *table, const columns *list, wt_error *err)
{
    wt_status status = wt_table_add_text_column(table, "file", "file of the result", err);
    for (size_t i = 0; status == WT_OK && i < list->n; i++) {
        const column *c = &list->column[i];
        status = c->unit[0] == '\0' ? wt_table_add_text_column(table, c->name, "", err)
                                    : wt_table_add_column(table, c->name, c->unit, c->words, err);
        for (int e = 0; status == WT_OK && e < 2; e++) {
            char name[SCHEMA_NAME_SIZE + 24];
            (void)snprintf(name, sizeof name, "%s%s", c->name, error_suffix[e]);
            if (c->has_error[e])
                status = wt_table_add_column(table, name, c->unit, error_words[e], err);
        }
    }
    return status;
}

static wt_status add_summary_row(wt_table *table, const columns *list, const char *file,
                                 const table_view *headlines, wt_error *err)
{
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        wt_table_set_text(table, 0, file);
    for (size_t i = 0, place = 1, next = 0; status == WT_OK && i < list->n; i++) {
        const column *c = &list->column[i];
        size_t row = next; /* most results have the same order */
        if (row >= headlines->n_rows || strcmp(keys_text(headlines, row, KEYS_KEY), c->name) != 0)
            row = 0;
        while (row < headlines->n_rows && strcmp(keys_text(headlines, row, KEYS_KEY), c->name) != 0)
            row++;
        const bool found = row < headlines->n_rows;
        next = found ? row + 1 : next;
        if (found && c->unit[0] == '\0')
            wt_table_set_text(table, place, keys_text(headlines, row, KEYS_WORDS));
        else if (found)
            wt_table_set_number(table, place, keys_get(headlines, row, KEYS_VALUE));
        place++;
        for (int e = 0; e < 2; e++)
            if (c->has_error[e] && found)
                wt_table_set_number(table, place++, keys_get(headlines, row, error_of[e]));
            else
                place += c->has_error[e];
    }
    return status;
}

wt_status wt_summary_table(const char *const *files, const wt_table *const *headlines, size_t n,
                           wt_table **summary, wt_error *err)
{
    columns list = {NULL, 0};
    wt_status status = WT_OK;
    table_view *views = wt_alloc(n, sizeof *views);
    wt_table *table = wt_table_new("summary", "Headlines of the results");
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        status = table_bind(headlines[i], &keys_schema, "", &views[i], err);
        if (status == WT_OK)
            merge_headline_columns(&list, &views[i]);
    }
    if (status == WT_OK)
        status = add_summary_columns(table, &list, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_summary_row(table, &list, files[i], &views[i], err);
    free(list.column);
    free(views);
    if (status == WT_OK)
        *summary = table;
    else
        wt_table_free(table);
    return status;
}
