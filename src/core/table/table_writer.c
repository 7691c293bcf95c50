/* Writes tables according to their schemas. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/table_writer.h"
#include "core/base/text.h"

#include <math.h>

/* Numeric member of any form; missing values are NaN. */
typedef struct numeric_member {
    wt_estimate estimate;
    double low, high;
} numeric_member;

static numeric_member member_number(const schema_field *field, const void *row)
{
    const void *const at = (const char *)row + field->offset;
    const wt_interval *interval = at;
    numeric_member n = {.low = (double)NAN, .high = (double)NAN};
    if (field->form == FORM_NUMBER)
        n.estimate.value = *(const double *)at;
    else if (field->form == FORM_COUNT)
        n.estimate.value = (double)*(const size_t *)at;
    else if (field->form == FORM_YES_NO)
        n.estimate.value = *(const bool *)at;
    else if (field->form == FORM_ESTIMATE)
        n.estimate = *(const wt_estimate *)at;
    else
        n = (numeric_member){
            {interval->value, interval->standard_error, 0, NULL}, interval->low, interval->high};
    return n;
}

static const char *member_text(const schema_field *field, const void *row)
{
    const char *const at = (const char *)row + field->offset;
    if (field->form == FORM_ENUM)
        return closed_list_get(field->list, *(const int *)(const void *)at);
    return field->form == FORM_TEXT ? *(const char *const *)(const void *)at : at;
}

static bool is_text_form(const schema_field *field)
{
    return field->form == FORM_TEXT || field->form == FORM_CHARACTERS || field->form == FORM_ENUM;
}

static void write_member(table_writer *w, const table_schema *of, const schema_field *field,
                         unsigned column, const void *row)
{
    if (is_text_form(field)) {
        writer_text(w, of, column, member_text(field, row));
        return;
    }
    const numeric_member n = member_number(field, row);
    const unsigned columns[] = {field->standard_error, field->numerical_error, field->low,
                                field->high};
    const double values[] = {n.estimate.standard_error, n.estimate.numerical_error, n.low, n.high};
    const size_t first = field->form == FORM_ESTIMATE || field->form == FORM_INTERVAL ? 0 : 4,
                 last = field->form == FORM_INTERVAL ? 4 : 2;
    writer_number(w, of, column, n.estimate.value);
    for (size_t i = first; i < last; i++)
        if (columns[i] != 0)
            writer_number(w, of, columns[i], values[i]);
}

void writer_add_row(table_writer *w, const table_schema *of, const schema_field *fields,
                    const void *row)
{
    table_row(w);
    for (size_t i = 0; w->status == WT_OK && i < of->n_columns; i++)
        if (fields[i].form != FORM_NONE && !(w->left_out & SCHEMA_BIT(i)))
            write_member(w, of, &fields[i], (unsigned)i, row);
}

static void set_member_key(table_writer *w, const table_schema *of, const schema_field *field,
                           unsigned key, const void *keys)
{
    char text[64];
    if (is_text_form(field)) {
        const char *const words = member_text(field, keys);
        if (!field->optional || (words != NULL && words[0] != '\0'))
            writer_key_text(w, of, key, words);
        return;
    }
    const wt_estimate estimate = member_number(field, keys).estimate;
    if (field->optional && isnan(estimate.value))
        return;
    if (field->kind == SCHEMA_NUMBER || field->form == FORM_ESTIMATE ||
        field->form == FORM_INTERVAL) {
        writer_key(w, of, key, estimate);
    } else {
        const int digits = field->form == FORM_COUNT ? 17 : field->precision;
        (void)clocale_print(text, sizeof text, "%.*g", digits != 0 ? digits : 6, estimate.value);
        writer_key_text(w, of, key, text);
    }
}

void writer_set_keys(table_writer *w, const table_schema *of, const schema_field *fields,
                     const void *keys)
{
    for (size_t i = 0; w->status == WT_OK && i < of->n_keys; i++)
        if (fields[i].form != FORM_NONE)
            set_member_key(w, of, &fields[i], (unsigned)i, keys);
}

static void add_schema_columns(table_writer *w, const schema_field *columns)
{
    for (size_t i = 0, n = 0; w->status == WT_OK && i < w->schema->n_columns; i++) {
        const schema_field *const c = &columns[i];
        if (w->left_out & SCHEMA_BIT(i))
            continue;
        w->column[i] = n++;
        w->status =
            c->kind == SCHEMA_TEXT
                ? wt_table_add_text_column(w->table, c->name, c->long_name, w->err)
                : wt_table_add_column(w->table, c->name, schema_unit(c), c->long_name, w->err);
    }
}

table_writer table_begin_variant(const table_schema *schema, table_variant variant, wt_error *err)
{
    char name[SCHEMA_NAME_SIZE];
    table_writer w = {.schema = schema,
                      .suffix = variant.suffix != NULL ? variant.suffix : "",
                      .err = err,
                      .left_out = variant.left_out};
    schema_name(variant.name != NULL ? variant.name : schema->name, w.suffix, name);
    w.table = wt_table_new(name, variant.title != NULL ? variant.title : schema->title);
    add_schema_columns(&w, variant.columns != NULL ? variant.columns : schema->columns);
    return w;
}

table_writer table_begin(const table_schema *schema, wt_error *err)
{
    return table_begin_variant(schema, (table_variant){0}, err);
}

table_writer table_continue(wt_table *table, const table_schema *schema, const char *suffix,
                            wt_error *err)
{
    table_writer w = {.table = table,
                      .schema = schema,
                      .suffix = suffix,
                      .continued = true,
                      .err = err,
                      .row = ~(uint64_t)0};
    for (size_t i = 0; w.status == WT_OK && i < schema->n_columns; i++) {
        const long found = wt_table_find(table, schema->columns[i].name);
        w.column[i] = (size_t)found;
        if (found < 0)
            w.status = wt_fail(err, WT_E_ARG, "table \"%s\" has no column \"%s\"",
                               wt_table_name(table), schema->columns[i].name);
    }
    return w;
}

/* Reports an error of the program, not of its user. */
static void fail_schema_field(table_writer *w, const char *name, const char *what)
{
    w->status =
        wt_fail(w->err, WT_E_INTERNAL, "table \"%s\": \"%s\" %s", w->schema->name, name, what);
}

static void check_last_row(table_writer *w)
{
    if (w->status != WT_OK || wt_table_n_rows(w->table) == 0)
        return;
    for (size_t i = 0; w->status == WT_OK && i < w->schema->n_columns; i++)
        if (!((w->row | w->left_out) & SCHEMA_BIT(i)) && !w->schema->columns[i].sparse)
            fail_schema_field(w, w->schema->columns[i].name, "was not put in a row");
}

void table_row(table_writer *w)
{
    check_last_row(w);
    if (w->status == WT_OK)
        w->status = wt_table_add_row(w->table, w->err);
    w->row = 0;
}

void table_block(table_writer *w)
{
    if (w->status == WT_OK)
        wt_table_new_block(w->table);
}

wt_status table_end(table_writer *w, wt_table **table)
{
    check_last_row(w);
    for (size_t i = 0; !w->continued && w->status == WT_OK && i < w->schema->n_keys; i++)
        if (!(w->keys & SCHEMA_BIT(i)) && !w->schema->keys[i].optional)
            fail_schema_field(w, w->schema->keys[i].name, "was not set");
    if (!w->continued && w->status != WT_OK) {
        wt_table_free(w->table);
        w->table = NULL;
    }
    if (table != NULL)
        *table = w->table;
    return w->status;
}

/* ---- cells and keys -------------------------------------------------------------------------- */

/* Returns true if the cell can be set, and marks it as set. */
static bool accepts_cell(table_writer *w, const table_schema *of, unsigned column, bool text)
{
    if (w->status != WT_OK)
        return false;
    if (w->schema != of || column >= w->schema->n_columns || (w->left_out & SCHEMA_BIT(column)) ||
        (w->schema->columns[column].kind == SCHEMA_TEXT) != text) {
        fail_schema_field(w, of->name, "has no such column");
        return false;
    }
    if (w->row & SCHEMA_BIT(column)) {
        fail_schema_field(w, of->columns[column].name, "was put twice in a row");
        return false;
    }
    w->row |= SCHEMA_BIT(column);
    return true;
}

void writer_number(table_writer *w, const table_schema *of, unsigned column, double value)
{
    if (accepts_cell(w, of, column, false))
        wt_table_set_number(w->table, w->column[column], value);
}

void writer_text(table_writer *w, const table_schema *of, unsigned column, const char *text)
{
    if (accepts_cell(w, of, column, true))
        wt_table_set_text(w->table, w->column[column], text);
}

static bool accepts_key(table_writer *w, const table_schema *of, unsigned key,
                        char name[SCHEMA_NAME_SIZE])
{
    if (w->status != WT_OK)
        return false;
    if (w->schema != of || key >= w->schema->n_keys) {
        fail_schema_field(w, of->name, "has no such key");
        return false;
    }
    w->keys |= SCHEMA_BIT(key);
    schema_name(w->schema->keys[key].name, w->suffix, name);
    return true;
}

void writer_key(table_writer *w, const table_schema *of, unsigned key, wt_estimate estimate)
{
    char name[SCHEMA_NAME_SIZE];
    if (!accepts_key(w, of, key, name))
        return;
    estimate.unit = schema_unit(&of->keys[key]);
    w->status = wt_table_set_estimate(w->table, name, estimate, w->err);
}

void writer_key_text(table_writer *w, const table_schema *of, unsigned key, const char *text)
{
    char name[SCHEMA_NAME_SIZE];
    if (accepts_key(w, of, key, name))
        w->status = wt_table_set_key(w->table, name, text, w->err);
}

void writer_key_print(table_writer *w, const table_schema *of, unsigned key, const char *format,
                      va_list arguments)
{
    char text[1024];
    (void)clocale_vprint(text, sizeof text, format, arguments);
    writer_key_text(w, of, key, text);
}
