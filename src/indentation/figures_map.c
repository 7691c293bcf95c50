/* Figure of the modulus over the sample for curves on a grid.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAP_POINTS = 9, MAP_LIMIT = 70000 }; /* smallest and largest number of curves of a map */

/* Returns the smallest distance between two different positions, or 0 if there are none. Positions
 * closer than a thousandth of the range are equal. */
static double grid_step(const table_view *table, indentation_column column)
{
    size_t n = table->n_rows;
    double *x = wt_alloc(n, sizeof *x), step = 0;
    for (size_t row = 0; row < n; row++)
        x[row] = indentation_get(table, row, column);
    numbers_sort(x, n);
    for (size_t i = 1; i < n; i++) {
        double gap = x[i] - x[i - 1];
        if (gap > 1e-3 * (x[n - 1] - x[0]) && (step == 0 || gap < step))
            step = gap;
    }
    free(x);
    return step;
}

typedef struct map_panel {
    const char *group;
    const table_view *table;
    int accepted, doubtful, rejected;
    double step_x, step_y;
} map_panel;

/* True if all positions are known and come from one file. Several files need not share an origin.
 */
static bool has_map_positions(map_panel *panel)
{
    const table_view *table = panel->table;
    if (table == NULL || table->n_rows < MAP_POINTS || table->n_rows > MAP_LIMIT)
        return false;
    const char *file = indentation_text(table, 0, INDENTATION_FILE);
    for (size_t row = 0; row < table->n_rows; row++)
        if (!isfinite(indentation_get(table, row, INDENTATION_X)) ||
            !isfinite(indentation_get(table, row, INDENTATION_Y)) ||
            strcmp(indentation_text(table, row, INDENTATION_FILE), file) != 0)
            return false;
    panel->step_x = grid_step(table, INDENTATION_X);
    panel->step_y = grid_step(table, INDENTATION_Y);
    return table->column[INDENTATION_FILE] >= 0 && panel->step_x > 0 && panel->step_y > 0;
}

static void map_axis(figure_drawing *d, const char *letter, const map_panel *panel,
                     indentation_column column, double step)
{
    value_span span = EMPTY_SPAN;
    span_add_column(&span, panel->table, column, false);
    span = (value_span){span.low - step / 2, span.high + step / 2};
    axis_linear(d, letter, letter, &indentation_schema.columns[column], span);
}

static void draw_modulus_panel(figure_drawing *d, const map_panel *panel)
{
    map_axis(d, "x", panel, INDENTATION_X, panel->step_x);
    map_axis(d, "y", panel, INDENTATION_Y, panel->step_y);
    text_format(&d->script, "half_x = %s; half_y = %s  # m\n", LITERAL(panel->step_x / 2),
                LITERAL(panel->step_y / 2));
    plot_heading(d, panel->group);
    plot_item(d, panel->accepted,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_item(d, panel->doubtful,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_item(d, panel->doubtful, "($1*x_unit):($2*y_unit) with points ls 16 pt 6 notitle");
    plot_item(d, panel->doubtful, "($1*x_unit):($2*y_unit) with points ls 14 pt 6 notitle");
    plot_item(d, panel->rejected, "($1*x_unit):($2*y_unit) with points ls 14 pt 2 notitle");
    plot_end(d);
}

void draw_modulus_map(figure_drawing *d)
{
    static const unsigned columns[] = {INDENTATION_X, INDENTATION_Y, INDENTATION_MODULUS};
    static const row_filter accepted = {{INDENTATION_VERDICT}, {"accepted"}, false},
                            doubtful = {{INDENTATION_VERDICT}, {"doubtful"}, false};
    static const row_filter rejected = {
        {INDENTATION_VERDICT, INDENTATION_VERDICT}, {"accepted", "doubtful"}, true};
    map_panel panels[DRAWING_GROUPS];
    size_t n = 0;
    value_span colour = EMPTY_SPAN;

    for (size_t i = 0; i < d->n_groups && d->status == WT_OK; i++) {
        map_panel panel = {.group = d->groups[i],
                           .table = figure_tables_indentation(d->tables, d->groups[i])};
        if (!has_map_positions(&panel))
            continue;
        panel.accepted = drawing_section(d, panel.table, panel.group, &accepted, columns, 3, 3);
        panel.doubtful = drawing_section(d, panel.table, "doubtful", &doubtful, columns, 3, 3);
        panel.rejected = drawing_section(d, panel.table, "rejected", &rejected, columns, 3, 2);
        span_add_section(&colour, d, panel.accepted, 2, true);
        span_add_section(&colour, d, panel.doubtful, 2, true);
        if (panel.accepted >= 0 || panel.doubtful >= 0)
            panels[n++] = panel;
    }
    if (n == 0 || span_is_empty(&colour) || d->status != WT_OK)
        return;
    d->width = 0.95 * (double)n;
    axis_log(d, "cb", "Modulus", &indentation_schema.columns[INDENTATION_MODULUS], colour);
    text_format(
        &d->script,
        "set size ratio -1\nset border 15\nset cblabel offset 1,0\nset multiplot layout 1,%zu\n",
        n);
    for (size_t i = 0; i < n; i++)
        draw_modulus_panel(d, &panels[i]);
    text_add(&d->script, "unset multiplot\n");
}
