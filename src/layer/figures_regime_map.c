/* Figures of the regime map: thickness against the power that modifies the rubber, and maps over
 * velocity and pressure with the line R = 1.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include "core/base/array.h"
#include "core/math/normal_quantile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative width of a figure with a colour bar, as in the figure engine. */
static const double width_with_colour_bar = 1.15;

static void caption_existence(figure_drawing *d)
{
    const wt_estimate from = layer_regime_map_value(d->table, LAYER_REGIME_MAP_KEY_FROM_VELOCITY),
                      to = layer_regime_map_value(d->table, LAYER_REGIME_MAP_KEY_TO_VELOCITY);
    const char *const known = layer_regime_map_key_text(d->table, LAYER_REGIME_MAP_KEY_KNOWN);
    text_format(&d->caption, " At %s there is a layer %s.",
                VALUE(WT_Q_PRESSURE, NULL,
                      layer_regime_map_value(d->table, LAYER_REGIME_MAP_KEY_PRESSURE).value),
                layer_regime_map_key_text(d->table, LAYER_REGIME_MAP_KEY_WORDS));
    if (isfinite(from.value))
        text_format(&d->caption, " It begins at %s.", ESTIMATE(&from));
    if (isfinite(to.value))
        text_format(&d->caption, " It ends at %s.", ESTIMATE(&to));
    if (layer_regime_map_key_enum(d->table, LAYER_REGIME_MAP_KEY_KNOWN) == VERDICT_INCONCLUSIVE)
        text_format(&d->caption, " Of the edges one %s.", known);
}

/* ln R, shifted by this number of standard errors of R. */
static double shifted_log_ratio(const table_view *t, size_t row, double errors)
{
    const double ratio = layer_regime_map_get(t, row, LAYER_REGIME_MAP_RATIO),
                 error = layer_regime_map_get(t, row, LAYER_REGIME_MAP_RATIO_STANDARD_ERROR);
    return log(ratio) + (errors == 0 ? 0 : errors * error / ratio);
}

/* Velocity at which R = 1 between two velocities, linear in the logarithms; NaN if not between
 * them. */
static double interpolate_edge(const table_view *t, size_t row, double errors)
{
    const double from = shifted_log_ratio(t, row, errors),
                 to = shifted_log_ratio(t, row + 1, errors);
    const double a = log(layer_regime_map_get(t, row, LAYER_REGIME_MAP_VELOCITY)),
                 b = log(layer_regime_map_get(t, row + 1, LAYER_REGIME_MAP_VELOCITY));
    if (isnan(from) || isnan(to) || (from > 0) == (to > 0) ||
        wt_table_block(t->table, row) != wt_table_block(t->table, row + 1))
        return (double)NAN;
    return isfinite(from) && isfinite(to) ? exp(a + (b - a) * from / (from - to)) : exp(a);
}

/* Adds the line R = 1 as a section of velocity and pressure, for an R shifted by this number of
 * standard errors. There is no section without points. */
static int add_edge_section(figure_drawing *d, const char *title, double errors)
{
    static const char *const names[] = {"velocity", "pressure", NULL};
    static const char *const units[] = {"m/s", "Pa"};
    const table_view *t = d->table;
    double *values = wt_alloc(2 * t->n_rows, sizeof *values);
    size_t n = 0;
    for (size_t row = 0; row + 1 < t->n_rows; row++) {
        const double velocity = interpolate_edge(t, row, errors);
        if (isnan(velocity))
            continue;
        values[2 * n] = velocity;
        values[2 * n++ + 1] = layer_regime_map_get(t, row, LAYER_REGIME_MAP_PRESSURE);
    }
    const int section =
        n > 0 ? drawing_number_section(d, title, names, units, values, n) : NO_SECTION;
    free(values);
    return section;
}

/* Square root of the smallest ratio of two values of a column: the half width of a box of the map.
 */
static double half_step_factor(figure_drawing *d, layer_regime_map_column column)
{
    const size_t n = d->table->n_rows;
    double *values = wt_alloc(n, sizeof *values), least = (double)INFINITY;
    for (size_t row = 0; row < n; row++)
        values[row] = layer_regime_map_get(d->table, row, column);
    numbers_sort(values, n);
    for (size_t i = 1; i < n; i++)
        if (values[i - 1] > 0 && values[i] > values[i - 1] * (1 + 1e-6) &&
            values[i] / values[i - 1] < least)
            least = values[i] / values[i - 1];
    free(values);
    return isfinite(least) ? sqrt(least) : 1;
}

static void widen_span(value_span *span, double factor)
{
    span_add(span, span->low / factor, true);
    span_add(span, span->high * factor, true);
}

/* Boxes coloured by a column, crosses where there is no layer, and the line between. */
static void draw_existence_map(figure_drawing *d, layer_regime_map_column shown, const char *label)
{
    const unsigned columns[] = {LAYER_REGIME_MAP_VELOCITY, LAYER_REGIME_MAP_PRESSURE,
                                (unsigned)shown, LAYER_REGIME_MAP_RATIO};
    const schema_field *field = d->table->schema->columns;
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN, colour = EMPTY_SPAN;
    span_add_column(&y, d->table, LAYER_REGIME_MAP_PRESSURE, true);
    if (!(y.high > y.low))
        return; /* a single pressure is no map */
    const int section =
        drawing_section(d, d->table, "places", NULL, columns, COUNT_OF(columns), COUNT_OF(columns));
    if (section < 0)
        return;
    span_add_section(&x, d, section, 0, true);
    span_add_section(&colour, d, section, 2, false);
    const double half_x = half_step_factor(d, LAYER_REGIME_MAP_VELOCITY),
                 half_y = half_step_factor(d, LAYER_REGIME_MAP_PRESSURE);
    if (d->status != WT_OK || span_is_empty(&x))
        return;
    widen_span(&x, half_x);
    widen_span(&y, half_y);
    axis_log(d, "x", "Sliding velocity", &field[LAYER_REGIME_MAP_VELOCITY], x);
    axis_log(d, "y", "Nominal pressure", &field[LAYER_REGIME_MAP_PRESSURE], y);
    axis_linear(d, "cb", label, &field[shown], colour);
    d->width = width_with_colour_bar;
    const int edge = add_edge_section(d, "no layer", 0),
              low = add_edge_section(d, "no layer, R lower", -NORMAL_95),
              high = add_edge_section(d, "no layer, R higher", NORMAL_95);
    text_format(&d->script,
                "half_x = %s; half_y = %s  # of a box, as factors\nset cblabel offset 1.5,0\n"
                "set border 15\nset key above\n",
                LITERAL(half_x), LITERAL(half_y));
    plot_item(d, section,
              "($1*x_unit):($4 > 1 ? $2*y_unit : NaN):($1/half_x*x_unit):($1*half_x*x_unit):"
              "($2/half_y*y_unit):($2*half_y*y_unit):($3*cb_unit) with boxxyerror fc palette "
              "notitle");
    plot_item(d, section,
              "($1*x_unit):($4 > 1 ? NaN : $2*y_unit) with points pt 2 ps 0.6 lc rgb 'black' title "
              "'no layer'");
    if (edge >= 0)
        plot_item(d, edge, "($1*x_unit):($2*y_unit) with lines lw 2 lc rgb 'black' title 'R = 1'");
    const int edge_limits[] = {low, high};
    bool titled = false;
    for (size_t i = 0; i < COUNT_OF(edge_limits); i++) {
        if (edge_limits[i] < 0)
            continue;
        plot_item(d, edge_limits[i], "($1*x_unit):($2*y_unit) with lines dt 2 lc rgb 'black'");
        plot_key(d, titled ? NULL : "95 % interval");
        titled = true;
    }
    plot_end(d);
}

static void draw_thickness_map(figure_drawing *d)
{
    draw_existence_map(d, LAYER_REGIME_MAP_THICKNESS, "Layer thickness");
}

static void draw_friction_map(figure_drawing *d)
{
    draw_existence_map(d, LAYER_REGIME_MAP_CHANGE, "Relative change of friction");
}

const figure_description figures_existence[] = {
    {.name = "layer_regime_map",
     .title = "Where a layer exists",
     .table = &layer_regime_map_schema,
     .data_title = "layer_regime_map",
     .x = {LAYER_REGIME_MAP_POWER, AXIS_LOG, "Power that modifies the rubber"},
     .y = {{LAYER_REGIME_MAP_THICKNESS, AXIS_LOG, "Layer thickness at balance"}},
     .colour = {LAYER_REGIME_MAP_PRESSURE, AXIS_LOG, "Nominal pressure"},
     .curves = {CURVE(LAYER_REGIME_MAP_THICKNESS, LINE, .style = 21, .above_zero = true)},
     .needs_several_x = true,
     .empty_reason = "there is no layer at any velocity",
     .caption_text =
         "Thickness at balance against the power per area that modifies the rubber, as the "
         "velocity grows along each line: where a line ends wear takes the layer away "
         "as fast as it forms, the conclusion of the source.",
     .caption = caption_existence},
    {.name = "layer_regime_map_thickness",
     .title = "Layer thickness over velocity and pressure",
     .table = &layer_regime_map_schema,
     .caption_text =
         "Thickness of the layer at balance; crosses: no layer; the line is where formation "
         "equals wear on a bare surface, R = 1.",
     .draw = draw_thickness_map,
     .caption = caption_existence},
    {.name = "layer_regime_map_friction",
     .title = "Change of friction by the layer over velocity and pressure",
     .table = &layer_regime_map_schema,
     .caption_text =
         "Relative change of the friction coefficient by the layer at balance; crosses: no "
         "layer; the line is where R = 1.",
     .draw = draw_friction_map,
     .caption = caption_existence},
    {.name = NULL},
};
