/* Figures of the modified layer: energy against depth, thickness against time, regime map.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "report/drawing.h"

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

/* ---- thickness and rates in time, one above the other ---------------------------------------- */

static double positive_value(const figure_drawing *d, layer_key key)
{
    double value = layer_value(d->table, key).value;
    return isfinite(value) && value > 0 ? value : (double)NAN;
}

/* Incubation time [s]; NaN if unknown or if the curve does not show it. Without incubation in the
 * model the layer grows from the beginning, and a mark would contradict the curve. */
static double visible_incubation(const figure_drawing *d)
{
    double incubation = positive_value(d, LAYER_KEY_INCUBATION_TIME);
    for (size_t row = 0; row < d->table->n_rows; row++)
        if (layer_get(d->table, row, LAYER_TIME) < incubation &&
            layer_get(d->table, row, LAYER_THICKNESS) > 0)
            return (double)NAN;
    return incubation;
}

/* Draws a vertical line at a time, with a label at this fraction of the height. */
static void mark_time(figure_drawing *d, double time, const char *label, double graph_position)
{
    if (!(time >= d->x.low && time <= d->x.high))
        return;
    text_format(&d->script,
                "set arrow from %s*x_unit, graph 0 to %s*x_unit, graph 1 nohead ls 12 back\n",
                LITERAL(time), LITERAL(time));
    if (label != NULL)
        text_format(&d->script, "set label '%s' at %s*x_unit, graph %s offset 0.6,0 left front\n",
                    label, LITERAL(time), LITERAL(graph_position));
}

static void draw_thickness(figure_drawing *d)
{
    double balance = positive_value(d, LAYER_KEY_BALANCE_THICKNESS);
    span_add(&d->y[0], balance, true);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    mark_time(d, visible_incubation(d), "incubation", 0.75);
    mark_time(d, positive_value(d, LAYER_KEY_RELAXATION_TIME), "relaxation", 0.1);
    if (isfinite(balance))
        text_format(&d->script, "balance = %s  # m\n", LITERAL(balance));
    drawing_bands(d, 0);
    if (isfinite(balance))
        plot_expression(d, "balance*y_unit with lines ls 15 title 'balance'");
    drawing_curves(d, 0);
    plot_end(d);
}

static void draw_rates(figure_drawing *d)
{
    text_add(&d->script, "unset arrow\nunset label\n");
    drawing_axis(d, "y", &d->figure->y[1], NULL, d->y[1]);
    mark_time(d, visible_incubation(d), NULL, 0);
    mark_time(d, positive_value(d, LAYER_KEY_RELAXATION_TIME), NULL, 0);
    drawing_curves(d, 1);
    plot_end(d);
}

static void draw_layer(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    bool thickness = !span_is_empty(&d->y[0]), rates = !span_is_empty(&d->y[1]);
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    if (thickness && rates) {
        d->height = 1.5;
        text_add(&d->script, "set multiplot layout 2,1\n");
    }
    if (thickness)
        draw_thickness(d);
    if (rates)
        draw_rates(d);
    if (thickness && rates)
        text_add(&d->script, "unset multiplot\n");
}

static void caption_layer(figure_drawing *d)
{
    const wt_estimate balance = layer_value(d->table, LAYER_KEY_BALANCE_THICKNESS);
    const wt_estimate incubation = layer_value(d->table, LAYER_KEY_INCUBATION_TIME),
                      relaxation = layer_value(d->table, LAYER_KEY_RELAXATION_TIME);
    if (isfinite(positive_value(d, LAYER_KEY_BALANCE_THICKNESS)))
        text_format(&d->caption, " Balance thickness %s.", ESTIMATE(&balance));
    if (isfinite(visible_incubation(d)))
        text_format(&d->caption, " Incubation time %s.", ESTIMATE(&incubation));
    if (isfinite(positive_value(d, LAYER_KEY_RELAXATION_TIME)))
        text_format(&d->caption, " Relaxation time %s.", ESTIMATE(&relaxation));
}

/* Draws the edges with their errors where replicates have the same number of bands, else as points.
 */
static void draw_bands(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], NULL, d->y[0]);
    plot_item(d, d->data[0],
              "($1*x_unit):($2*y_unit):($3*y_unit) with yerrorbars ls 21 lw 0.5 pt -1 notitle");
    plot_item(d, d->data[0],
              "($1*x_unit):($4*y_unit):($5*y_unit) with yerrorbars ls 22 lw 0.5 pt -1 notitle");
    drawing_curves(d, 0);
    plot_end(d);
}

static void caption_bands(figure_drawing *d)
{
    const char *events = layer_bands_key_text(d->table, LAYER_BANDS_KEY_EVENTS);
    text_format(&d->caption, " Loads: %s.", layer_bands_key_text(d->table, LAYER_BANDS_KEY_LOADS));
    if (events != NULL)
        text_format(&d->caption, " What happens: %s.", events);
    const wt_estimate first = layer_bands_value(d->table, LAYER_BANDS_KEY_FIRST);
    if (isfinite(first.value))
        text_format(&d->caption, " Rubber is first modified after %s.", ESTIMATE(&first));
}

static void caption_running_in(figure_drawing *d)
{
    const wt_estimate settled = running_in_value(d->table, RUNNING_IN_KEY_SETTLED);
    text_format(&d->caption, " Shear stress of the layer: %s; %s.",
                running_in_key_text(d->table, RUNNING_IN_KEY_SHEAR),
                running_in_key_text(d->table, RUNNING_IN_KEY_BACK));
    if (isfinite(settled.value))
        text_format(&d->caption, " After %s 5 %% of the change are left.", ESTIMATE(&settled));
}

/* ---- thickness by the curves ----------------------------------------------------------------- */

/* Marks the thickness from other data on the depth axis as a line with its interval. */
static void mark_independent_thickness(figure_drawing *d)
{
    const double at = track_layer_value(d->table, TRACK_LAYER_KEY_OTHER).value,
                 low = track_layer_value(d->table, TRACK_LAYER_KEY_OTHER_LOW).value,
                 high = track_layer_value(d->table, TRACK_LAYER_KEY_OTHER_HIGH).value;
    if (!(at >= d->x.low && at <= d->x.high))
        return;
    if (low < high)
        text_format(&d->script,
                    "set object 1 rectangle from %s*x_unit, graph 0 to %s*x_unit, graph 1 behind "
                    "fillcolor rgb '#dddddd' fillstyle solid noborder\n",
                    LITERAL(fmax(low, d->x.low)), LITERAL(fmin(high, d->x.high)));
    mark_time(d, at, "thickness", 0.06);
}

/* Draws measured groups with their intervals, and layers as lines. */
static void draw_track_layer(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    mark_independent_thickness(d);
    for (size_t i = 0; i < d->n_groups; i++) {
        const bool measured =
            strcmp(d->groups[i], "bulk") == 0 || strcmp(d->groups[i], "track") == 0;
        plot_item(d, d->data[i],
                  measured ? "($1*x_unit):($2*y_unit):($3*y_unit):($4*y_unit) with yerrorlines "
                             "ls %d"
                           : "($1*x_unit):($2*y_unit) with lines ls %d",
                  drawing_group_style(d, i));
        plot_title(d, d->groups[i]); // the group names are fixed texts of this program
    }
    plot_end(d);
}

static void caption_track_layer(figure_drawing *d)
{
    const char *const agree = track_layer_key_text(d->table, TRACK_LAYER_KEY_AGREE);
    text_format(&d->caption, " By the curves: %s.",
                track_layer_key_text(d->table, TRACK_LAYER_KEY_ALLOWED));
    if (agree != NULL)
        text_format(&d->caption, " Do both agree? %s.", agree);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_layer[] = {
    {.name = "energy_density",
     .in_depth = true,
     .title = "Dissipated energy with depth",
     .table = &energy_density_schema,
     .data_title = "energy density",
     .x = {ENERGY_DENSITY_DEPTH, AXIS_LOG, "Depth below the surface"},
     .y = {{ENERGY_DENSITY_POWER, AXIS_LOG, "Dissipated power per volume"}},
     .curves = {CURVE(ENERGY_DENSITY_POWER, LINE, .style = 21)},
     .empty_reason = "no energy density above zero",
     .caption_text = "Power per volume that sliding dissipates in the rubber, with depth."},
    {.name = "layer",
     .title = "Thickness of the modified layer",
     .table = &layer_schema,
     .data_title = "layer",
     .x = {LAYER_TIME, AXIS_LOG, "Sliding time in contact"},
     .y = {{LAYER_THICKNESS, AXIS_LOG, "Layer thickness"},
           {LAYER_FORMATION_RATE, AXIS_LOG, "Rate"}},
     .curves = {CURVE(LAYER_THICKNESS, LINE, .style = 21, .title = "thickness", .band = 71,
                      .above_zero = true),
                CURVE(LAYER_FORMATION_RATE, LINE, .style = 22, .title = "formation",
                      .above_zero = true, .panel = 1),
                CURVE(LAYER_WEAR_RATE, LINE, .style = 23, .title = "wear", .above_zero = true,
                      .panel = 1)},
     .empty_reason = "no layer forms: no thickness above zero to draw on a logarithmic axis",
     .caption_text =
         "Thickness of the modified layer in time (band: one standard error) and the rates of "
         "formation and wear that make it; balance is where the two rates meet.",
     .draw = draw_layer,
     .caption = caption_layer},
    {.name = "layer_bands",
     .title = "Modified rubber in time",
     .table = &layer_bands_schema,
     .data_title = "bands",
     .x = {LAYER_BANDS_TIME, AXIS_LOG, "Sliding time in contact"},
     .y = {{LAYER_BANDS_LOWER, AXIS_FROM_ZERO, "Depth below the surface"}},
     .curves = {CURVE(LAYER_BANDS_LOWER, POINTS, .style = 21, .title = "lower edge", .band = 71),
                CURVE(LAYER_BANDS_UPPER, POINTS, .style = 22, .title = "upper edge", .band = 71)},
     .empty_reason = "nothing is modified",
     .caption_text =
         "Edges of the modified rubber below the surface of the time, which wear takes down: "
         "between an upper and the lower edge under it the rubber is modified. Bars: one "
         "standard error, of the replicates with as many bands.",
     .draw = draw_bands,
     .caption = caption_bands},
    {.name = "running_in",
     .title = "Friction in running-in",
     .table = &running_in_schema,
     .data_title = "running-in",
     .x = {RUNNING_IN_TIME, AXIS_LOG, "Sliding time in contact"},
     .y = {{RUNNING_IN_FRICTION, AXIS_LINEAR, "Friction coefficient μ"}},
     .curves = {CURVE(RUNNING_IN_FRICTION, LINE, .style = 21, .title = "hysteresis and shearing",
                      .band = 71),
                CURVE(RUNNING_IN_HYSTERESIS, LINE, .style = 22, .title = "hysteresis", .band = 72)},
     .empty_reason = "no shear stress is known, and so no friction",
     .caption_text =
         "Friction with the layer that has grown until then (bands: one standard error).",
     .caption = caption_running_in},
    {.name = "track_layer",
     .title = "Thickness of the layer by the curves",
     .table = &track_layer_schema,
     .by_group = true,
     .group = TRACK_LAYER_CURVE,
     .x = {TRACK_LAYER_DEPTH, AXIS_LOG, "Indentation, thickness"},
     .y = {{TRACK_LAYER_MODULUS, AXIS_LOG, "Modulus at this depth"}},
     .curves = {CURVE(TRACK_LAYER_MODULUS, OWN, .with_errors = true)},
     .empty_reason = "too few curves tell how the modulus changes with depth",
     .caption_text =
         "Modulus of the homogeneous rubber that would give the force at this depth, of bulk "
         "and track (bars: 95 % confidence interval), and of layers on the bulk that have the "
         "ratio of the moduli at the depth of the curves; grey: the thickness known otherwise "
         "with its 95 % interval, on the same axis.",
     .draw = draw_track_layer,
     .caption = caption_track_layer},
    {.name = NULL},
};
