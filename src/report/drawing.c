/* Data of one figure under construction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool drawing_is_wide(const figure_drawing *d)
{
    return d->width > 1.2;
}

size_t drawing_panels(figure_drawing *d, size_t n, size_t columns, double width, double height)
{
    columns = d->stacked ? 1 : columns < n ? columns : n;
    d->width = d->stacked ? 1 : width * (double)columns;
    d->height = height * (double)((n + columns - 1) / columns);
    return columns;
}

int drawing_group_style(const figure_drawing *d, size_t i)
{
    if (!d->figure->by_group)
        return 0;
    if (strcmp(d->groups[i], "bulk") == 0)
        return 1;
    if (strcmp(d->groups[i], "track") == 0)
        return 2;
    return i < 2 ? 3 + (int)i : 1 + (int)i;
}

/* ---- sections -------------------------------------------------------------------------------- */

static bool row_matches(const table_view *table, size_t row, const row_filter *rows)
{
    for (int i = 0; rows != NULL && i < 2; i++)
        if (rows->text[i] != NULL &&
            strcmp(view_text(table, table->schema, row, rows->column[i]), rows->text[i]) != 0)
            return false;
    return rows == NULL || rows->accepts == NULL || rows->accepts(table, row);
}

/* Creates a section table with the name of the figure and a number. */
static wt_table *create_section(figure_drawing *d, const char *title)
{
    char name[96];
    (void)snprintf(name, sizeof name, "%s/%zu", d->figure->name, d->n_sections);
    return wt_table_new(name, title);
}

/* Stores a section with data and returns its index; else frees it and returns NO_SECTION. */
static int store_data_section(figure_drawing *d, wt_table *section, bool any)
{
    if (d->status == WT_OK && any && d->n_sections == DRAWING_SECTIONS)
        d->status = wt_fail(d->err, WT_E_INTERNAL, "figure %s has too many parts", d->figure->name);
    if (d->status == WT_OK && any) {
        d->sections[d->n_sections] = section;
        return (int)d->n_sections++;
    }
    wt_table_free(section);
    return NO_SECTION;
}

int drawing_section(figure_drawing *d, const table_view *table, const char *title,
                    const row_filter *rows, const unsigned *columns, size_t n_columns,
                    size_t needed)
{
    size_t last_block = 0;
    bool any = false, first = true;
    if (d->status != WT_OK)
        return NO_SECTION;
    wt_table *section = create_section(d, title);
    for (size_t i = 0; i < n_columns && d->status == WT_OK; i++) {
        const schema_field *column = &table->schema->columns[columns[i]];
        d->status = wt_table_add_column(section, column->name, schema_unit(column),
                                        column->long_name, d->err);
    }
    for (size_t row = 0; row < table->n_rows && d->status == WT_OK; row++) {
        if (!row_matches(table, row, rows))
            continue;
        size_t block = wt_table_block(table->table, row);
        if (!first && block != last_block)
            wt_table_new_block(section);
        d->status = wt_table_add_row(section, d->err);
        if (d->status != WT_OK)
            break;
        first = false;
        last_block = block;
        bool complete = true;
        for (size_t i = 0; i < n_columns; i++) {
            double value = view_number(table, table->schema, row, columns[i]);
            // An infinite value cannot be drawn.
            wt_table_set_number(
                section, i, isfinite(value) ? number_to_digits(value, DATA_DIGITS) : (double)NAN);
            complete = complete && (i >= needed || isfinite(value));
        }
        any = any || complete;
    }
    return store_data_section(d, section, any);
}

int drawing_number_section(figure_drawing *d, const char *title, const char *const *columns,
                           const char *const *units, const double *values, size_t n_rows)
{
    if (d->status != WT_OK || n_rows == 0)
        return NO_SECTION;
    wt_table *section = create_section(d, title);
    for (size_t i = 0; d->status == WT_OK && columns[i] != NULL; i++)
        d->status = wt_table_add_column(section, columns[i], units[i], "", d->err);
    for (size_t row = 0; d->status == WT_OK && row < n_rows; row++) {
        d->status = wt_table_add_row(section, d->err);
        for (size_t i = 0; d->status == WT_OK && columns[i] != NULL; i++)
            wt_table_set_number(section, i, number_to_digits(*values++, DATA_DIGITS));
    }
    return store_data_section(d, section, true);
}

size_t drawing_row_count(const figure_drawing *d, int section)
{
    return section < 0 ? 0 : wt_table_n_rows(d->sections[section]);
}

size_t drawing_stride(const figure_drawing *d, int section, size_t limit)
{
    size_t rows = drawing_row_count(d, section);
    return rows <= limit ? 1 : (rows + limit - 1) / limit;
}

size_t drawing_max_stride(const figure_drawing *d, size_t limit)
{
    size_t most = 1;
    for (size_t i = 0; i < d->n_groups; i++) {
        size_t every = drawing_stride(d, d->data[i], limit);
        most = every > most ? every : most;
    }
    return most;
}

static void begin_plot_item(figure_drawing *d)
{
    text_add(&d->script, d->n_items++ == 0 ? "plot \\\n  " : ", \\\n  ");
}

void plot_item(figure_drawing *d, int section, const char *format, ...)
{
    if (section < 0)
        return;
    begin_plot_item(d);
    text_format(&d->script, "'%s.tsv' index %d using ", d->figure->name, section);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_expression(figure_drawing *d, const char *format, ...)
{
    begin_plot_item(d);
    va_list arguments;
    va_start(arguments, format);
    text_vformat(&d->script, format, arguments);
    va_end(arguments);
}

void plot_title(figure_drawing *d, const char *title)
{
    text_add(&d->script, " title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced");
}

void plot_key(figure_drawing *d, const char *text)
{
    if (text == NULL)
        text_add(&d->script, " notitle");
    else
        text_format(&d->script, " title '%s'", text);
}

void plot_end(figure_drawing *d)
{
    text_add(&d->script, "\n");
    d->n_items = 0;
}

void plot_heading(figure_drawing *d, const char *title)
{
    text_add(&d->script, "set title ");
    text_quoted(&d->script, title);
    text_add(&d->script, " noenhanced\n");
}
