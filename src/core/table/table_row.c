/* Fills rows and keys of a table from the members of a structure. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/table_writer.h"

#include "core/base/clocale.h"

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
