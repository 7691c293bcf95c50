/* Binds the tables of a result to their schemas, and draws a figure from its description.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_tables.h"

#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static wt_status bind_indentation(const wt_result *result, figure_tables *tables, wt_error *err)
{
    const char *const prefix = indentation_schema.name;
    const size_t length = strlen(prefix), n = wt_result_n_tables(result);
    tables->indentation = wt_alloc(n, sizeof *tables->indentation);
    for (size_t i = 0; i < n; i++) {
        const wt_table *table = wt_result_table(result, i);
        const char *name = wt_table_name(table);
        if (strncmp(name, prefix, length) != 0)
            continue;
        wt_status status = table_bind(table, &indentation_schema, name + length,
                                      &tables->indentation[tables->n_indentation++], err);
        if (status != WT_OK)
            return status;
    }
    return WT_OK;
}

wt_status figure_tables_bind(const wt_result *result, figure_tables *tables, wt_error *err)
{
    wt_status status = WT_OK;
    *tables = (figure_tables){.n_indentation = 0};
#define BIND(table)                                                                                \
    if (status == WT_OK)                                                                           \
        status = table_bind_result(result, &table##_schema, "", &tables->table, err);
    FIGURE_TABLES(BIND)
    return status != WT_OK ? status : bind_indentation(result, tables, err);
}

void figure_tables_clear(figure_tables *tables)
{
    free(tables->indentation);
    *tables = (figure_tables){.n_indentation = 0};
}

const table_view *figure_tables_find(const figure_tables *tables, const table_schema *schema)
{
#define FIND(table)                                                                                \
    if (schema == &table##_schema)                                                                 \
        return &tables->table;
    FIGURE_TABLES(FIND)
    return NULL;
}

const table_view *figure_tables_indentation(const figure_tables *tables, const char *group)
{
    for (size_t i = 0; i < tables->n_indentation; i++)
        if (strcmp(tables->indentation[i].suffix, group) == 0)
            return &tables->indentation[i];
    return NULL;
}

/* ---- data ------------------------------------------------------------------------------------ */

/* Adds a column if `is_one` and if it is not in the list yet. */
static void add_figure_column(unsigned columns[FIGURE_COLUMNS], size_t *n, bool is_one,
                              unsigned column)
{
    for (size_t i = 0; i < *n; i++)
        is_one = is_one && columns[i] != column;
    if (is_one && *n < FIGURE_COLUMNS)
        columns[(*n)++] = column;
}

size_t drawing_list_columns(const figure_description *figure, unsigned columns[FIGURE_COLUMNS])
{
    size_t n = 0;
    add_figure_column(columns, &n, figure->x.scale != AXIS_NONE, figure->x.column);
    for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++) {
        const schema_field *column = &figure->table->columns[curve->column];
        const bool errors = curve->with_errors || curve->band != 0;
        add_figure_column(columns, &n, true, curve->column);
        add_figure_column(columns, &n, errors && column->standard_error != 0,
                          column->standard_error);
        add_figure_column(columns, &n, errors && column->high != 0, column->low);
        add_figure_column(columns, &n, errors && column->high != 0, column->high);
    }
    add_figure_column(columns, &n, figure->colour.scale != AXIS_NONE, figure->colour.column);
    return n;
}

/* Returns the index of a column in the described sections, from 0. */
static size_t section_column(const figure_drawing *d, unsigned column)
{
    size_t place = 0;
    while (place < d->n_columns && d->columns[place] != column)
        place++;
    return place;
}

/* Extends the range by a described column of the section of a group. */
static void span_add_described(value_span *span, const figure_drawing *d, size_t group,
                               unsigned column, const figure_axis *axis)
{
    if (axis->scale != AXIS_NONE)
        span_add_section(span, d, d->data[group], section_column(d, column),
                         axis->scale == AXIS_LOG);
}

/* Extends the range by the 95 % interval of a column with a standard error. */
static void span_add_errors(value_span *span, const figure_drawing *d, size_t group,
                            unsigned column, const figure_axis *axis)
{
    if (d->data[group] == NO_SECTION)
        return;
    const wt_table *const section = d->sections[d->data[group]];
    const size_t y = section_column(d, column),
                 e = section_column(d, d->figure->table->columns[column].standard_error);
    for (size_t row = 0; row < drawing_row_count(d, d->data[group]); row++)
        for (int side = -1; side <= 1; side += 2)
            span_add(span,
                     wt_table_number(section, row, y) +
                         side * NORMAL_95 * wt_table_number(section, row, e),
                     axis->scale == AXIS_LOG);
}

static void span_add_curve(figure_drawing *d, size_t group, const figure_curve *curve)
{
    const schema_field *column = &d->figure->table->columns[curve->column];
    const figure_axis *axis = &d->figure->y[curve->panel];
    if (curve->form == CURVE_FIT || curve->form == CURVE_DATA)
        return;
    span_add_described(&d->y[curve->panel], d, group, curve->column, axis);
    if (curve->with_errors && column->high != 0) {
        span_add_described(&d->y[curve->panel], d, group, column->low, axis);
        span_add_described(&d->y[curve->panel], d, group, column->high, axis);
    } else if (curve->with_errors || (curve->band != 0 && axis->scale != AXIS_LOG))
        span_add_errors(&d->y[curve->panel], d, group, curve->column, axis);
}

bool drawing_build_data(figure_drawing *d)
{
    const figure_description *figure = d->figure;
    for (size_t i = 0; i < d->n_groups; i++) {
        const row_filter rows = {{figure->group}, {figure->by_group ? d->groups[i] : NULL}, NULL};
        d->data[i] = drawing_section(d, d->table, d->groups[i], &rows, d->columns, d->n_columns,
                                     figure->by_group ? 2 : 1);
        span_add_described(&d->x, d, i, figure->x.column, &figure->x);
        span_add_described(&d->colour, d, i, figure->colour.column, &figure->colour);
        for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++)
            span_add_curve(d, i, curve);
    }
    return !span_is_empty(&d->x) && (!figure->needs_several_x || d->x.high > d->x.low) &&
           !(span_is_empty(&d->y[0]) && span_is_empty(&d->y[1])) && d->status == WT_OK;
}

/* ---- axes ------------------------------------------------------------------------------------ */

void drawing_axis(figure_drawing *d, drawing_axis_id id, const figure_axis *axis, const char *label,
                  value_span span)
{
    const schema_field *column = &d->figure->table->columns[axis->column];
    if (axis->scale == AXIS_FROM_ZERO)
        span_add(&span, 0, false);
    if (axis->scale == AXIS_LOG)
        axis_log(d, id, label != NULL ? label : axis->label, column, span);
    else
        axis_linear(d, id, label != NULL ? label : axis->label, column, span);
}

/* True if the colour has a meaning: different values. */
static bool is_coloured(const figure_drawing *d)
{
    return !span_is_empty(&d->colour) && d->colour.high > d->colour.low;
}

/* Largest difference of two colour values that count as one setting: half a kelvin, or 1 % of a
 * frequency. */
static double colour_tolerance(const figure_drawing *d, double value)
{
    const schema_field *column = &d->figure->table->columns[d->figure->colour.column];
    return column->quantity == WT_Q_TEMPERATURE ? 0.5 : 0.01 * fabs(value);
}

/* Collects the different values of the colour if they are few. */
static void collect_colours(figure_drawing *d)
{
    const size_t place = section_column(d, d->figure->colour.column);
    size_t n = 0;
    for (size_t i = 0; i < d->n_groups; i++)
        for (size_t row = 0; row < drawing_row_count(d, d->data[i]); row++) {
            const double value = wt_table_number(d->sections[d->data[i]], row, place);
            bool known = !isfinite(value);
            for (size_t k = 0; k < n && !known; k++)
                known = fabs(value - d->colours[k]) <= colour_tolerance(d, d->colours[k]);
            if (!known && n == MAX_KEY_COLOURS)
                return;
            if (!known)
                d->colours[n++] = value;
        }
    d->n_colours = n;
}

void drawing_axes(figure_drawing *d)
{
    drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
    drawing_axis(d, AXIS_Y, &d->figure->y[0], d->y_label, d->y[0]);
    if (!is_coloured(d))
        return;
    drawing_axis(d, AXIS_COLOUR, &d->figure->colour, NULL, d->colour);
    collect_colours(d);
    if (d->n_colours > 0)
        text_add(&d->script, "unset colorbox\nset rmargin 3\n");
    else
        d->width = 1.15;
}

void drawing_colours(figure_drawing *d, const char *with)
{
    const schema_field *column = &d->figure->table->columns[d->figure->colour.column];
    for (size_t i = 0; i < d->n_colours; i++)
        plot_expression(d, "keyentry with %s lc palette cb %s%s title '%s'", with,
                        LITERAL(d->colours[i]),
                        column->quantity == WT_Q_TEMPERATURE ? "+cb_offset" : "*cb_unit",
                        VALUE(column->quantity, schema_unit(column), d->colours[i]));
}

void drawing_temperature_label(char label[DRAWING_LABEL], const char *words, double temperature)
{
    (void)snprintf(label, DRAWING_LABEL, isfinite(temperature) ? "%s at %s" : "%s%s", words,
                   isfinite(temperature) ? VALUE(WT_Q_TEMPERATURE, NULL, temperature) : "");
}

char modulus_letter(int deformation)
{
    return deformation == WT_SHEAR ? 'G' : 'E';
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* Adds a column with the factor of its axis: "($2*y_unit)". */
static void add_column_expression(text_buffer *item, const figure_drawing *d, const char *letter,
                                  const figure_axis *axis, unsigned column, bool above_zero)
{
    size_t n = section_column(d, column) + 1;
    const bool of_temperature =
        d->figure->table->columns[column].quantity == WT_Q_TEMPERATURE; /* drawn in °C */
    if (axis->scale == AXIS_NUMBER)
        text_format(item, "%zu", n);
    else if (of_temperature && axis->scale == AXIS_LINEAR)
        text_format(item, "($%zu+%s_offset)", n, letter);
    else if (above_zero)
        text_format(item, "($%zu > 0 ? $%zu*%s_unit : NaN)", n, n, letter);
    else
        text_format(item, "($%zu*%s_unit)", n, letter);
}

/* Plots a band of the 95 % interval. A logarithmic axis has no negative values. */
static void plot_error_band(figure_drawing *d, size_t group, const figure_curve *curve)
{
    const bool titled = !d->band_titled && !d->figure->by_group && curve->title != NULL;
    d->band_titled = d->band_titled || titled;
    size_t y = section_column(d, curve->column) + 1,
           e = section_column(d, d->figure->table->columns[curve->column].standard_error) + 1;
    if (d->figure->y[curve->panel].scale == AXIS_LOG)
        plot_item(d, d->data[group],
                  "($1*x_unit):($%zu > 0 ? ($%zu > " HALF_95 "*$%zu ? $%zu-" HALF_95
                  "*$%zu : 1e-3*$%zu)*y_unit : NaN):"
                  "($%zu > 0 ? ($%zu+" HALF_95 "*$%zu)*y_unit : NaN) with filledcurves ls %d",
                  y, y, e, y, e, y, y, y, e, curve->band);
    else
        plot_item(d, d->data[group],
                  "($1*x_unit):($%zu-" HALF_95 "*$%zu):($%zu+" HALF_95
                  "*$%zu) with filledcurves ls %d",
                  y, e, y, e, curve->band);
    plot_key(d, titled ? "95 % interval" : NULL);
}

static bool has_key(const figure_description *figure)
{
    bool any = figure->by_group;
    for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++)
        any = any || curve->title != NULL;
    return any;
}

/* Adds the title. A described title appears in the key once for all groups. */
static void add_curve_title(figure_drawing *d, size_t group, const figure_curve *curve)
{
    bool *titled = &d->titled[curve - d->figure->curves];
    if (d->figure->by_group && curve->form != CURVE_FIT)
        plot_title(d, d->groups[group]);
    else if (curve->title != NULL && !*titled)
        text_format(&d->script, " title '%s'", curve->title);
    else if (has_key(d->figure) || d->n_colours > 0)
        text_add(&d->script, " notitle");
    *titled = true;
}

static void plot_curve(figure_drawing *d, size_t group, const figure_curve *curve)
{
    static const char *const with[] = {[CURVE_LINE] = "lines",
                                       [CURVE_POINTS] = "points",
                                       [CURVE_BARS] = "yerrorbars",
                                       [CURVE_JOINED_BARS] = "yerrorlines",
                                       [CURVE_FIT] = "lines"};
    const figure_axis *axis = &d->figure->y[curve->panel];
    const schema_field *column = &d->figure->table->columns[curve->column];
    text_buffer item = {0};

    add_column_expression(&item, d, "x", &d->figure->x, d->figure->x.column, false);
    text_add(&item, ":");
    add_column_expression(&item, d, "y", axis, curve->column, curve->above_zero);
    if (curve->with_errors && column->high == 0) {
        text_format(&item, ":(" HALF_95 "*$%zu%s)", section_column(d, column->standard_error) + 1,
                    axis->scale == AXIS_NUMBER ? "" : "*y_unit");
    } else if (curve->with_errors) {
        text_add(&item, ":");
        add_column_expression(&item, d, "y", axis, column->low, false);
        text_add(&item, ":");
        add_column_expression(&item, d, "y", axis, column->high, false);
    }
    if (curve->points > 0)
        text_format(&item, " every %zu", drawing_stride(d, d->data[group], curve->points));
    if (is_coloured(d) && curve->form == CURVE_LINE)
        text_format(&item, ":($%zu*cb_unit) with lines lw 1.8%s lc palette",
                    section_column(d, d->figure->colour.column) + 1,
                    curve->dashed ? " dt (6,3)" : "");
    else
        text_format(&item, " with %s ls %d", with[curve->form],
                    curve->style + (curve->form == CURVE_FIT ? 0 : drawing_group_style(d, group)));
    plot_item(d, d->data[group], "%s", text_string(&item));
    add_curve_title(d, group, curve);
    text_free(&item);
}

static bool has_number(const figure_drawing *d, size_t group, const figure_curve *curve)
{
    value_span span = EMPTY_SPAN;
    span_add_described(&span, d, group, curve->column, &d->figure->y[curve->panel]);
    return !span_is_empty(&span);
}

/* True if there is a standard error. Without replicates there is none, and no band for the key. */
static bool has_error(const figure_drawing *d, size_t group, const figure_curve *curve)
{
    const figure_axis any = {.scale = AXIS_LINEAR};
    value_span span = EMPTY_SPAN;
    span_add_described(&span, d, group, d->figure->table->columns[curve->column].standard_error,
                       &any);
    return !span_is_empty(&span);
}

void drawing_bands(figure_drawing *d, size_t panel)
{
    for (const figure_curve *curve = d->figure->curves; curve->form != CURVE_NONE; curve++)
        for (size_t i = 0; i < d->n_groups; i++)
            if (curve->panel == panel && curve->band != 0 && has_number(d, i, curve) &&
                has_error(d, i, curve))
                plot_error_band(d, i, curve);
}

void drawing_curves(figure_drawing *d, size_t panel)
{
    for (size_t i = 0; i < d->n_groups; i++)
        for (const figure_curve *curve = d->figure->curves; curve->form != CURVE_NONE; curve++)
            if (curve->panel == panel && curve->form < CURVE_OWN && has_number(d, i, curve))
                plot_curve(d, i, curve);
}

static void draw_as_described(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    if (d->figure->prepare != NULL)
        d->figure->prepare(d);
    drawing_axes(d);
    if (!has_key(d->figure) && d->n_colours == 0)
        text_add(&d->script, "unset key\n");
    drawing_bands(d, 0);
    drawing_curves(d, 0);
    drawing_colours(d, "lines lw 1.8");
    plot_end(d);
}

/* ---- groups ---------------------------------------------------------------------------------- */

/* Collects the names of the groups, "bulk" and "track" first, then in order of rows. */
static void collect_groups(figure_drawing *d)
{
    static const char *const usual[] = {"bulk", "track"};
    const table_view *table = d->table;
    for (size_t pass = 0; pass < 3; pass++)
        for (size_t row = 0; row < table->n_rows; row++) {
            const char *group = view_text(table, table->schema, row, d->figure->group);
            bool seen = pass < 2 && strcmp(group, usual[pass]) != 0;
            for (size_t i = 0; i < d->n_groups && !seen; i++)
                seen = strcmp(d->groups[i], group) == 0;
            d->too_many = d->too_many || (!seen && d->n_groups == DRAWING_GROUPS);
            if (!seen && d->n_groups < DRAWING_GROUPS)
                d->groups[d->n_groups++] = group;
        }
}

wt_status drawing_build(figure_drawing *d, const figure_description *figure,
                        const figure_tables *tables, bool stacked, wt_error *err)
{
    *d = (figure_drawing){.figure = figure,
                          .stacked = stacked,
                          .tables = tables,
                          .table = figure_tables_find(tables, figure->table),
                          .err = err,
                          .width = 1,
                          .height = 1,
                          .x = EMPTY_SPAN,
                          .y = {EMPTY_SPAN, EMPTY_SPAN},
                          .colour = EMPTY_SPAN};
    d->n_columns = drawing_list_columns(figure, d->columns);
    if (figure->by_group)
        collect_groups(d);
    else
        d->groups[d->n_groups++] = figure->data_title;
    if (figure->draw != NULL)
        figure->draw(d);
    else
        draw_as_described(d);
    if (d->script.length > 0) {
        text_add(&d->caption, figure->caption_text);
        if (d->too_many)
            text_format(&d->caption, " Only the first %d are drawn.", DRAWING_GROUPS);
        if (figure->caption != NULL)
            figure->caption(d);
    }
    return d->status;
}

void drawing_clear(figure_drawing *d)
{
    for (size_t i = 0; i < d->n_sections; i++)
        wt_table_free(d->sections[i]);
    text_free(&d->script);
    text_free(&d->caption);
    *d = (figure_drawing){.n_sections = 0};
}
