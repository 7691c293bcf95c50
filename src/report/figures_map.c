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
    size_t c = (size_t)wt_number_column(table, column), n = wt_table_n_rows(table);
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
    if (wt_number_column(table, "x") < 0 || wt_number_column(table, "y") < 0 ||
        wt_text_column(table, "file") < 0 || n < MAP_POINTS || n > MAP_LIMIT)
        return false;
    for (size_t row = 0; row < n; row++)
        if (!isfinite(wt_cell_number(table, row, "x")) ||
            !isfinite(wt_cell_number(table, row, "y")) ||
            strcmp(wt_cell_text(table, row, "file"), wt_cell_text(table, 0, "file")) != 0)
            return false;
    return grid_step(table, "x") > 0 && grid_step(table, "y") > 0;
}

typedef struct map_panel {
    const char *group;
    const wt_table *table;
    int accepted, rejected;
    double step_x, step_y;
} map_panel;

static void draw_panel(wt_drawing *d, const map_panel *panel)
{
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY;
    wt_span_add_column(&x, panel->table, "x", false);
    wt_span_add_column(&y, panel->table, "y", false);
    x = (wt_span){x.low - panel->step_x / 2, x.high + panel->step_x / 2};
    y = (wt_span){y.low - panel->step_y / 2, y.high + panel->step_y / 2};
    wt_axis_linear(d, "x", "x", "m", "", x);
    wt_axis_linear(d, "y", "y", "m", "", y);
    wt_text_add(&d->script, "half_x = ");
    wt_text_literal(&d->script, panel->step_x / 2);
    wt_text_add(&d->script, "; half_y = ");
    wt_text_literal(&d->script, panel->step_y / 2);
    wt_text_add(&d->script, "  # m\nset title ");
    wt_text_quoted(&d->script, panel->group);
    wt_text_add(&d->script, " noenhanced\n");
    wt_plot_begin(d);
    wt_plot_item(d, panel->accepted,
                 "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
                 "boxxyerror fc palette notitle");
    wt_plot_item(d, panel->rejected, "($1*x_unit):($2*y_unit) with points ls 14 pt 2 notitle");
    wt_plot_end(d);
}

void wt_draw_modulus_map(wt_drawing *d)
{
    static const char *const columns[] = {"x", "y", "modulus", NULL};
    static const wt_rows accepted = {{"verdict", NULL}, {"accepted", NULL}, false};
    static const wt_rows rejected = {{"verdict", NULL}, {"accepted", NULL}, true};
    const char *groups[WT_DRAWING_GROUPS];
    size_t n_groups =
               wt_drawing_groups(wt_result_find(d->result, "modulus_groups"), "group", groups),
           n = 0;
    map_panel panels[WT_DRAWING_GROUPS];
    wt_span colour = WT_SPAN_EMPTY;

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
        panel.accepted = wt_drawing_section(d, table, groups[i], &accepted, columns, 3, false);
        panel.rejected = wt_drawing_section(d, table, "rejected", &rejected, columns, 2, false);
        wt_span_add_section(&colour, d, panel.accepted, "modulus", true);
        if (panel.accepted >= 0)
            panels[n++] = panel;
    }
    if (n == 0 || wt_span_empty(&colour) || d->status != WT_OK)
        return;
    d->width = 0.95 * (double)n;
    wt_axis_log(d, "cb", "Modulus", "Pa", colour);
    wt_text_format(&d->script, "set size ratio -1\nset border 15\nset multiplot layout 1,%zu\n", n);
    for (size_t i = 0; i < n; i++)
        draw_panel(d, &panels[i]);
    wt_text_add(&d->script, "unset multiplot\n");
    wt_text_add(&d->caption, "Modulus of the accepted curves at their positions; crosses: rejected "
                             "curves. One scale of colour for all maps.");
}
