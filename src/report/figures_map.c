/* Figure of the modulus over the sample, where the curves were taken on a grid.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAP_POINTS = 9, MAP_LIMIT = 70000 }; /* fewer are no map, more no picture for a page */

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Smallest distance of two positions that differ, 0 if there are none. What is closer than a
 * thousandth of the whole is the same position. */
static double grid_step(const wt_table *table, const char *column)
{
    size_t c = (size_t)number_column(table, column), n = wt_table_n_rows(table);
    double *x = calloc(n, sizeof *x), step = 0;
    if (x == NULL)
        return 0;
    for (size_t row = 0; row < n; row++)
        x[row] = wt_table_number(table, row, c);
    qsort(x, n, sizeof *x, compare_numbers);
    for (size_t i = 1; i < n; i++) {
        double gap = x[i] - x[i - 1];
        if (gap > 1e-3 * (x[n - 1] - x[0]) && (step == 0 || gap < step))
            step = gap;
    }
    free(x);
    return step;
}

/* Positions that are known, from one file: places of several files need not share an origin. */
static bool is_map(const wt_table *table)
{
    size_t n = wt_table_n_rows(table);
    if (number_column(table, "x") < 0 || number_column(table, "y") < 0 ||
        text_column(table, "file") < 0 || n < MAP_POINTS || n > MAP_LIMIT)
        return false;
    for (size_t row = 0; row < n; row++)
        if (!isfinite(cell_number(table, row, "x")) || !isfinite(cell_number(table, row, "y")) ||
            strcmp(cell_text(table, row, "file"), cell_text(table, 0, "file")) != 0)
            return false;
    return grid_step(table, "x") > 0 && grid_step(table, "y") > 0;
}

typedef struct map_panel {
    const char *group;
    const wt_table *table;
    int accepted, rejected;
    double step_x, step_y;
} map_panel;

static void draw_panel(figure_drawing *d, const map_panel *panel)
{
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    span_add_column(&x, panel->table, "x", false);
    span_add_column(&y, panel->table, "y", false);
    x = (value_span){x.low - panel->step_x / 2, x.high + panel->step_x / 2};
    y = (value_span){y.low - panel->step_y / 2, y.high + panel->step_y / 2};
    axis_linear(d, "x", "x", "m", "", x);
    axis_linear(d, "y", "y", "m", "", y);
    text_add(&d->script, "half_x = ");
    text_literal(&d->script, panel->step_x / 2);
    text_add(&d->script, "; half_y = ");
    text_literal(&d->script, panel->step_y / 2);
    text_add(&d->script, "  # m\nset title ");
    text_quoted(&d->script, panel->group);
    text_add(&d->script, " noenhanced\n");
    plot_begin(d);
    plot_item(d, panel->accepted,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_item(d, panel->rejected, "($1*x_unit):($2*y_unit) with points ls 14 pt 2 notitle");
    plot_end(d);
}

void draw_modulus_map(figure_drawing *d)
{
    static const char *const columns[] = {"x", "y", "modulus", NULL};
    static const row_filter accepted = {{"verdict", NULL}, {"accepted", NULL}, false};
    static const row_filter rejected = {{"verdict", NULL}, {"accepted", NULL}, true};
    const char *groups[DRAWING_GROUPS];
    size_t n_groups = drawing_groups(wt_result_find(d->result, "modulus_groups"), "group", groups),
           n = 0;
    map_panel panels[DRAWING_GROUPS];
    value_span colour = SPAN_EMPTY;

    for (size_t i = 0; i < n_groups && d->status == WT_OK; i++) {
        char name[128];
        (void)snprintf(name, sizeof name, "indentation/%s", groups[i]);
        const wt_table *table = wt_result_find(d->result, name);
        if (table == NULL || !is_map(table))
            continue;
        map_panel panel = {.group = groups[i],
                           .table = table,
                           .step_x = grid_step(table, "x"),
                           .step_y = grid_step(table, "y")};
        panel.accepted = drawing_section(d, table, groups[i], &accepted, columns, 3, false);
        panel.rejected = drawing_section(d, table, "rejected", &rejected, columns, 2, false);
        span_add_section(&colour, d, panel.accepted, "modulus", true);
        if (panel.accepted >= 0)
            panels[n++] = panel;
    }
    if (n == 0 || span_empty(&colour) || d->status != WT_OK)
        return;
    d->width = 0.95 * (double)n;
    axis_log(d, "cb", "Modulus", "Pa", colour);
    text_format(&d->script, "set size ratio -1\nset border 15\nset multiplot layout 1,%zu\n", n);
    for (size_t i = 0; i < n; i++)
        draw_panel(d, &panels[i]);
    text_add(&d->script, "unset multiplot\n");
    text_add(&d->caption, "Modulus of the accepted curves at their positions; crosses: rejected "
                          "curves. One scale of colour for all maps.");
}
