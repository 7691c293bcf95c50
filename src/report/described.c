/* A figure drawn as its description says.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <string.h>

/* ---- data ------------------------------------------------------------------------------------ */

/* Adds a column that is not there yet. */
static void add_column(unsigned columns[FIGURE_COLUMNS], size_t *n, unsigned column)
{
    for (size_t i = 0; i < *n; i++)
        if (columns[i] == column)
            return;
    if (*n < FIGURE_COLUMNS)
        columns[(*n)++] = column;
}

size_t drawing_columns(const figure_description *figure, unsigned columns[FIGURE_COLUMNS])
{
    size_t n = 0;
    if (figure->x.scale != AXIS_NONE)
        add_column(columns, &n, figure->x.column);
    for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++) {
        add_column(columns, &n, curve->column);
        if (curve->band != 0 || curve->with_error)
            add_column(columns, &n, figure->table->columns[curve->column].standard_error);
        if (curve->high != 0) {
            add_column(columns, &n, curve->low);
            add_column(columns, &n, curve->high);
        }
    }
    if (figure->colour.scale != AXIS_NONE)
        add_column(columns, &n, figure->colour.column);
    return n;
}

size_t drawing_place(const figure_drawing *d, unsigned column)
{
    unsigned columns[FIGURE_COLUMNS];
    size_t n = drawing_columns(d->figure, columns), place = 0;
    while (place < n && columns[place] != column)
        place++;
    return place;
}

/* A described column of the section of a group. */
static void span_described(value_span *span, const figure_drawing *d, size_t group, unsigned column,
                           axis_scale scale)
{
    span_add_section(span, d, d->data[group], drawing_place(d, column), scale == AXIS_LOG);
}

static void span_curve(figure_drawing *d, size_t group, const figure_curve *curve)
{
    value_span *span = &d->y[curve->panel];
    axis_scale scale = d->figure->y[curve->panel].scale;
    if (curve->form == CURVE_FIT || curve->form == CURVE_DATA)
        return;
    span_described(span, d, group, curve->column, scale);
    if (curve->high == 0)
        return;
    span_described(span, d, group, curve->low, scale);
    span_described(span, d, group, curve->high, scale);
}

bool drawing_data(figure_drawing *d)
{
    const figure_description *figure = d->figure;
    unsigned columns[FIGURE_COLUMNS];
    size_t n = drawing_columns(figure, columns);
    bool any = false;
    char title[64];

    (void)snprintf(title, sizeof title, "%s",
                   figure->data_title != NULL ? figure->data_title : figure->name);
    for (char *s = title; figure->data_title == NULL && *s != '\0'; s++)
        *s = *s == '_' ? ' ' : *s;
    d->x = d->colour = SPAN_EMPTY;
    for (size_t i = 0; i < FIGURE_PANELS; i++)
        d->y[i] = SPAN_EMPTY;
    for (size_t i = 0; i < d->n_groups; i++) {
        const row_filter rows = {{figure->group}, {figure->by_group ? d->groups[i] : NULL}, false};
        d->data[i] = drawing_section(d, d->table, figure->by_group ? d->groups[i] : title, &rows,
                                     columns, n, figure->by_group ? 2 : 1);
        span_described(&d->x, d, i, figure->x.column, figure->x.scale);
        if (figure->colour.scale != AXIS_NONE)
            span_described(&d->colour, d, i, figure->colour.column, figure->colour.scale);
        for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++)
            span_curve(d, i, curve);
    }
    for (size_t i = 0; i < FIGURE_PANELS; i++)
        any = any || !span_empty(&d->y[i]);
    if (any && !span_empty(&d->x) && d->status == WT_OK)
        return true;
    drawing_nothing(d);
    return false;
}

void drawing_nothing(figure_drawing *d)
{
    text_add(&d->omitted, d->figure->nothing != NULL ? d->figure->nothing : "");
}

/* ---- axes and curves ------------------------------------------------------------------------- */

void drawing_axis(figure_drawing *d, const char *letter, const figure_axis *axis, const char *label,
                  value_span span)
{
    (axis->scale == AXIS_LOG ? axis_log
                             : axis_linear)(d, letter, label != NULL ? label : axis->label,
                                            &d->figure->table->columns[axis->column], span);
}

/* Column and factor to the unit of its axis: "($2*y_unit)". */
enum { PLACE_SIZE = 96 };
static void write_place(const figure_drawing *d, const char *letter, const figure_axis *axis,
                        unsigned column, bool above_zero, char place[PLACE_SIZE])
{
    size_t n = drawing_place(d, column) + 1;
    if (axis->scale == AXIS_NUMBER)
        (void)snprintf(place, PLACE_SIZE, "%zu", n);
    else if (d->figure->table->columns[axis->column].quantity == WT_Q_TEMPERATURE)
        (void)snprintf(place, PLACE_SIZE, "($%zu+%s_offset)", n, letter);
    else if (above_zero)
        (void)snprintf(place, PLACE_SIZE, "($%zu > 0 ? $%zu*%s_unit : NaN)", n, n, letter);
    else
        (void)snprintf(place, PLACE_SIZE, "($%zu*%s_unit)", n, letter);
}

/* A column plus and minus its standard error. */
static void plot_band(figure_drawing *d, size_t group, const figure_curve *curve)
{
    char x[PLACE_SIZE];
    size_t y = drawing_place(d, curve->column) + 1,
           e = drawing_place(d, d->figure->table->columns[curve->column].standard_error) + 1;
    write_place(d, "x", &d->figure->x, d->figure->x.column, false, x);
    if (d->figure->y[curve->panel].scale == AXIS_LOG) // which has no place for what is below zero
        plot_item(d, d->data[group],
                  "%s:($%zu > 0 ? ($%zu > $%zu ? $%zu-$%zu : 1e-3*$%zu)*y_unit : NaN):"
                  "($%zu > 0 ? ($%zu+$%zu)*y_unit : NaN) with filledcurves ls %d notitle",
                  x, y, y, e, y, e, y, y, y, e, curve->band);
    else
        plot_item(d, d->data[group], "%s:($%zu-$%zu):($%zu+$%zu) with filledcurves ls %d notitle",
                  x, y, e, y, e, curve->band);
}

static bool has_key(const figure_description *figure)
{
    bool any = figure->by_group;
    for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++)
        any = any || curve->title != NULL;
    return any;
}

/* Once for all groups. */
static void write_title(figure_drawing *d, const figure_curve *curve)
{
    bool *titled = &d->titled[curve - d->figure->curves];
    if (curve->title != NULL && !*titled)
        text_format(&d->script, " title '%s'", curve->title);
    else
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
    const unsigned columns[] = {curve->column, curve->low, curve->high};
    bool by_group = d->figure->by_group && curve->form != CURVE_FIT;
    growing_text line = {0};
    char place[PLACE_SIZE];

    write_place(d, "x", &d->figure->x, d->figure->x.column, false, place);
    text_add(&line, place);
    for (size_t i = 0; i < (curve->high != 0 ? 3 : 1); i++) {
        write_place(d, "y", axis, columns[i], curve->above_zero, place);
        text_format(&line, ":%s", place);
    }
    if (curve->points > 0)
        text_format(&line, " every %zu", drawing_every(d, d->data[group], curve->points));
    plot_item(d, d->data[group], "%s with %s ls %d", text_string(&line), with[curve->form],
              curve->style + (by_group ? drawing_group_style(d, group) : 0));
    if (by_group)
        plot_title(d, d->groups[group]);
    else if (has_key(d->figure))
        write_title(d, curve);
    d->script.failed = d->script.failed || line.failed;
    text_free(&line);
}

static bool has_number(const figure_drawing *d, size_t group, const figure_curve *curve)
{
    value_span span = SPAN_EMPTY;
    span_described(&span, d, group, curve->column, d->figure->y[curve->panel].scale);
    return !span_empty(&span);
}

void drawing_bands(figure_drawing *d, size_t panel)
{
    for (size_t i = 0; i < d->n_groups; i++)
        for (const figure_curve *curve = d->figure->curves; curve->form != CURVE_NONE; curve++)
            if (curve->panel == panel && curve->band != 0 && has_number(d, i, curve))
                plot_band(d, i, curve);
}

void drawing_curves(figure_drawing *d, size_t panel)
{
    for (size_t i = 0; i < d->n_groups; i++)
        for (const figure_curve *curve = d->figure->curves; curve->form != CURVE_NONE; curve++)
            if (curve->panel == panel && curve->form != CURVE_OWN && curve->form != CURVE_DATA &&
                has_number(d, i, curve))
                plot_curve(d, i, curve);
}

static void draw_as_described(figure_drawing *d)
{
    const figure_description *figure = d->figure;
    if (!drawing_data(d))
        return;
    drawing_axis(d, "x", &figure->x, NULL, d->x);
    drawing_axis(d, "y", &figure->y[0], NULL, d->y[0]);
    if (!has_key(figure))
        text_add(&d->script, "unset key\n");
    plot_begin(d);
    drawing_bands(d, 0);
    drawing_curves(d, 0);
    plot_end(d);
}

/* Names of the groups, "bulk" and "track" first, then as they come. */
static void find_groups(figure_drawing *d)
{
    static const char *const usual[] = {"bulk", "track"};
    const table_view *table = d->table;
    for (size_t pass = 0; pass < 3; pass++)
        for (size_t row = 0; row < table->n_rows && d->n_groups < DRAWING_GROUPS; row++) {
            const char *group = view_text(table, table->schema, row, d->figure->group);
            bool seen = pass < 2 && strcmp(group, usual[pass]) != 0;
            for (size_t i = 0; i < d->n_groups && !seen; i++)
                seen = strcmp(d->groups[i], group) == 0;
            if (!seen)
                d->groups[d->n_groups++] = group;
        }
}

wt_status drawing_make(figure_drawing *d, const figure_description *figure,
                       const bound_tables *tables, wt_error *err)
{
    *d = (figure_drawing){.figure = figure,
                          .tables = tables,
                          .table = bound_find(tables, figure->table),
                          .err = err,
                          .width = 1,
                          .height = 1};
    if (figure->by_group)
        find_groups(d);
    else
        d->groups[d->n_groups++] = "";
    if (figure->draw != NULL)
        figure->draw(d);
    else
        draw_as_described(d);
    if (d->script.length > 0) {
        text_add(&d->caption, figure->words);
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
    text_free(&d->omitted);
    *d = (figure_drawing){.n_sections = 0};
}
