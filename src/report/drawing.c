/* One figure while it is made: data, groups, the plot command.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include "report/cells.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void drawing_clear(figure_drawing *d)
{
    for (size_t i = 0; i < d->n_sections; i++)
        wt_table_free(d->sections[i]);
    text_free(&d->script);
    text_free(&d->caption);
    text_free(&d->omitted);
    *d = (figure_drawing){0};
}

static bool row_matches(const wt_table *table, size_t row, const row_filter *rows)
{
    for (int i = 0; rows != NULL && i < 2; i++) {
        if (rows->column[i] == NULL)
            continue;
        long column = text_column(table, rows->column[i]);
        if (column < 0 ||
            (strcmp(wt_table_text(table, row, (size_t)column), rows->text[i]) == 0) == rows->other)
            return false;
    }
    return true;
}

/* Name of section `i`: figure and number, as table names are written. */
static wt_table *section_new(figure_drawing *d, const char *title)
{
    char name[96];
    (void)snprintf(name, sizeof name, "%s/%zu", d->name, d->n_sections);
    wt_table *table = wt_table_new(name, title);
    if (table == NULL)
        d->status = wt_fail(d->err, WT_E_MEMORY, "out of memory");
    return table;
}

static int section_take(figure_drawing *d, wt_table *table)
{
    if (d->n_sections == DRAWING_SECTIONS) {
        wt_table_free(table);
        d->status = wt_fail(d->err, WT_E_INTERNAL, "figure %s has too many parts", d->name);
        return NO_SECTION;
    }
    d->sections[d->n_sections] = table;
    return (int)d->n_sections++;
}

int drawing_section(figure_drawing *d, const wt_table *table, const char *title,
                    const row_filter *rows, const char *const *columns, size_t needed, bool blocks)
{
    enum { MAX_COLUMNS = 12 };
    long source[MAX_COLUMNS];
    size_t n = 0, last_block = 0;
    bool any = false, first = true;
    wt_table *copy = NULL;

    if (d->status != WT_OK || (copy = section_new(d, title)) == NULL)
        return NO_SECTION;
    for (; columns[n] != NULL && n < MAX_COLUMNS; n++) {
        source[n] = number_column(table, columns[n]);
        bool there = source[n] >= 0;
        size_t column = there ? (size_t)source[n] : 0;
        d->status = wt_table_add_column(
            copy, columns[n], there ? wt_table_column_unit(table, column) : "1",
            there ? wt_table_column_long_name(table, column) : columns[n], d->err);
        if (d->status != WT_OK)
            goto fail;
    }
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        if (!row_matches(table, row, rows))
            continue;
        size_t block = wt_table_block(table, row);
        if (blocks && !first && block != last_block)
            d->status = wt_table_new_block(copy, d->err);
        if (d->status == WT_OK)
            d->status = wt_table_add_row(copy, d->err);
        if (d->status != WT_OK)
            goto fail;
        first = false;
        last_block = block;
        bool complete = true;
        for (size_t i = 0; i < n; i++) {
            double value =
                source[i] >= 0 ? wt_table_number(table, row, (size_t)source[i]) : (double)NAN;
            // An infinite value is no place in a picture.
            wt_table_put(copy, i, isfinite(value) ? value : (double)NAN);
            complete = complete && (i >= needed || isfinite(value));
        }
        any = any || complete;
    }
    if (!any)
        goto fail;
    return section_take(d, copy);
fail:
    wt_table_free(copy);
    return NO_SECTION;
}

int drawing_point(figure_drawing *d, const char *title, const char *const *columns,
                  const char *const *units, const double *values)
{
    wt_table *point = NULL;
    if (d->status != WT_OK || (point = section_new(d, title)) == NULL)
        return NO_SECTION;
    for (size_t i = 0; columns[i] != NULL; i++) {
        d->status = wt_table_add_column(point, columns[i], units[i], columns[i], d->err);
        if (d->status != WT_OK)
            goto fail;
    }
    d->status = wt_table_add_row(point, d->err);
    if (d->status != WT_OK)
        goto fail;
    for (size_t i = 0; columns[i] != NULL; i++)
        wt_table_put(point, i, values[i]);
    return section_take(d, point);
fail:
    wt_table_free(point);
    return NO_SECTION;
}

size_t drawing_rows(const figure_drawing *d, int section)
{
    return section < 0 ? 0 : wt_table_n_rows(d->sections[section]);
}

size_t drawing_every(const figure_drawing *d, int section, size_t limit)
{
    size_t rows = drawing_rows(d, section);
    return rows <= limit ? 1 : (rows + limit - 1) / limit;
}

size_t drawing_groups(const wt_table *table, const char *column, const char *groups[DRAWING_GROUPS])
{
    long c = table == NULL ? -1 : text_column(table, column);
    size_t n = 0;
    if (c < 0)
        return 0;
    static const char *const usual[] = {"bulk", "track"};
    for (size_t pass = 0; pass < 3; pass++)
        for (size_t row = 0; row < wt_table_n_rows(table) && n < DRAWING_GROUPS; row++) {
            const char *group = wt_table_text(table, row, (size_t)c);
            bool seen = pass < 2 && strcmp(group, usual[pass]) != 0;
            for (size_t i = 0; i < n && !seen; i++)
                seen = strcmp(groups[i], group) == 0;
            if (!seen)
                groups[n++] = group;
        }
    return n;
}

int drawing_group_style(const char *group, size_t place)
{
    if (strcmp(group, "bulk") == 0)
        return 1;
    if (strcmp(group, "track") == 0)
        return 2;
    return place < 2 ? 3 + (int)place : 1 + (int)place;
}

void plot_begin(figure_drawing *d)
{
    d->n_items = 0;
}

static void next_item(figure_drawing *d)
{
    text_add(&d->script, d->n_items++ == 0 ? "plot \\\n  " : ", \\\n  ");
}

WT_PRINTF(2, 0)
static void add_formatted(figure_drawing *d, const char *format, va_list arguments)
{
    char line[512];
    int length = vsnprintf(line, sizeof line, format, arguments);
    if (length < 0 || (size_t)length >= sizeof line)
        d->script.failed = true;
    else
        text_add(&d->script, line);
}

void plot_item(figure_drawing *d, int section, const char *format, ...)
{
    if (section < 0)
        return;
    next_item(d);
    text_format(&d->script, "'%s.tsv' index %d using ", d->name, section);
    va_list arguments;
    va_start(arguments, format);
    add_formatted(d, format, arguments);
    va_end(arguments);
}

void plot_other(figure_drawing *d, const char *format, ...)
{
    next_item(d);
    va_list arguments;
    va_start(arguments, format);
    add_formatted(d, format, arguments);
    va_end(arguments);
}

void plot_title(figure_drawing *d, const char *title)
{
    text_add(&d->script, " title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced");
}

void plot_end(figure_drawing *d)
{
    text_add(&d->script, "\n");
    d->n_items = 0;
}

bool key_number(const wt_table *table, const char *key, double *value)
{
    wt_estimate estimate;
    if (wt_table_estimate(table, key, &estimate)) {
        *value = estimate.value;
        return isfinite(*value);
    }
    const char *text = wt_table_key(table, key);
    return text != NULL && wt_number_parse(text, strlen(text), '.', value);
}

void caption_value(figure_drawing *d, double value, const char *unit, const char *quantity)
{
    lab_unit lab = lab_unit_for(unit, quantity, value);
    text_short(&d->caption, lab_value(&lab, value), 3);
    if (isfinite(value) && lab.label[0] != '\0')
        text_format(&d->caption, " %s", lab.label);
}

void caption_estimate(figure_drawing *d, const wt_estimate *estimate, const char *quantity)
{
    double error = fabs(estimate->standard_error);
    if (!(error > 0) || !isfinite(estimate->value)) {
        caption_value(d, estimate->value, estimate->unit, quantity);
        return;
    }
    lab_unit lab = lab_unit_for(estimate->unit, quantity, estimate->value);
    double scaled = error * lab.factor;
    int decimals = 1 - (int)floor(log10(scaled));
    decimals = decimals < 0 ? 0 : decimals > 9 ? 9 : decimals;
    text_fixed(&d->caption, lab_value(&lab, estimate->value), decimals);
    text_add(&d->caption, " ± ");
    text_fixed(&d->caption, scaled, decimals);
    if (lab.label[0] != '\0')
        text_format(&d->caption, " %s", lab.label);
}
