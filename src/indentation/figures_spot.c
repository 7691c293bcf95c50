/* Figure of a spot: heights before and after an indentation, and their change.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>

/* Returns the smallest distance of neighbours in a column of a grid, or 0 if there is none. */
static double grid_pitch(const table_view *table, spot_map_column column)
{
    double step = 0;
    for (size_t row = 1; row < table->n_rows; row++) {
        const double gap =
            fabs(spot_map_get(table, row, column) - spot_map_get(table, row - 1, column));
        if (gap > 0 && (step == 0 || gap < step))
            step = gap;
    }
    return step;
}

/* Draws the cells of one column in colour, with the circle of the contact. */
static void draw_spot_panel(figure_drawing *d, int section, const char *title)
{
    plot_heading(d, title);
    plot_item(d, section,
              "($1*x_unit):($2*y_unit):(half_x*x_unit):(half_y*y_unit):($3*cb_unit) with "
              "boxxyerror fc palette notitle");
    plot_expression(
        d, "[t=0:2*pi] contact*x_unit*cos(t), contact*y_unit*sin(t) with lines lw 1 lc rgb "
           "'white' notitle");
    plot_end(d);
}

static void draw_spot_map(figure_drawing *d)
{
    static const spot_map_column shown_columns[] = {SPOT_MAP_BEFORE, SPOT_MAP_AFTER,
                                                    SPOT_MAP_CHANGE};
    static const char *const titles[] = {"before", "after", "change"};
    enum { PANELS = sizeof shown_columns / sizeof *shown_columns };
    const double contact = spot_map_value(d->table, SPOT_MAP_KEY_CONTACT_RADIUS).value;
    int sections[PANELS];
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN,
               colours[PANELS] = {EMPTY_SPAN, EMPTY_SPAN, EMPTY_SPAN};
    size_t n = 0;
    for (size_t i = 0; i < PANELS; i++) {
        const unsigned columns[] = {SPOT_MAP_X, SPOT_MAP_Y, shown_columns[i]};
        sections[i] = drawing_section(d, d->table, titles[i], NULL, columns, 3, 3);
        /* Both heights share one colour scale. */
        span_add_section(&colours[i < 2 ? 0 : i], d, sections[i], 2, false);
        n += sections[i] >= 0;
    }
    if (n == 0 || d->status != WT_OK)
        return;
    const double step_x = grid_pitch(d->table, SPOT_MAP_X),
                 step_y = grid_pitch(d->table, SPOT_MAP_Y);
    span_add_column(&x, d->table, SPOT_MAP_X, false);
    span_add_column(&y, d->table, SPOT_MAP_Y, false);
    const size_t across = n < 2 ? n : 2, down = (n + 1) / 2;
    d->width = 0.95 * (double)across;
    d->height = 0.9 * (double)down;
    axis_linear(d, "x", "x from the place", &spot_map_schema.columns[SPOT_MAP_X],
                (value_span){x.low - step_x / 2, x.high + step_x / 2});
    axis_linear(d, "y", "y from the place", &spot_map_schema.columns[SPOT_MAP_Y],
                (value_span){y.low - step_y / 2, y.high + step_y / 2});
    text_format(&d->script,
                "half_x = %s; half_y = %s; contact = %s  # m\nset parametric\nset size ratio -1\n"
                "set border 15\nset cblabel offset 1,0\nset multiplot layout %zu,%zu\n",
                LITERAL(step_x / 2), LITERAL(step_y / 2), LITERAL(contact), down, across);
    for (size_t i = 0; i < PANELS; i++) {
        if (sections[i] < 0)
            continue;
        axis_linear(d, "cb", i < 2 ? "Height" : "Change of the height",
                    &spot_map_schema.columns[shown_columns[i]], colours[i < 2 ? 0 : i]);
        draw_spot_panel(d, sections[i], titles[i]);
    }
    text_add(&d->script, "unset multiplot\n");
}

const figure_description figures_spot[] = {
    {.name = "spot_map",
     .title = "Heights about a spot",
     .table = &spot_map_schema,
     .empty_reason = "no height is known about the place",
     .caption_text =
         "Heights about the place of an indentation, each less its plane: before it; after it, "
         "moved by the drift between the images; and what changed. The circle is the contact "
         "of the tip at its depth.",
     .draw = draw_spot_map},
    {.name = NULL},
};
