/* Figures of the modified layer: energy against depth, thickness against time.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    time = number_to_digits(time, DATA_DIGITS); /* as the times of the curve */
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
    drawing_axis(d, AXIS_Y, &d->figure->y[0], NULL, d->y[0]);
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
    drawing_axis(d, AXIS_Y, &d->figure->y[1], NULL, d->y[1]);
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
    drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
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
         "Thickness of the modified layer in time (band: 95 % interval) and the rates of "
         "formation and wear that make it; balance is where the two rates meet.",
     .draw = draw_layer,
     .caption = caption_layer},
    {.name = "track_layer",
     .title = "Thickness of the layer by the curves",
     .table = &track_layer_schema,
     .by_group = true,
     .group = TRACK_LAYER_CURVE,
     .x = {TRACK_LAYER_DEPTH, AXIS_LOG, "Indentation, thickness"},
     .y = {{TRACK_LAYER_MODULUS, AXIS_LOG, "Modulus at this depth"}},
     .curves = {CURVE(TRACK_LAYER_MODULUS, OWN, .with_errors = true)},
     .empty_reason = "there are too few curves for the modulus against depth",
     .caption_text =
         "Modulus of the homogeneous rubber that would give the force at this depth, of bulk "
         "and track (bars: 95 % confidence interval), and of layers on the bulk that have the "
         "ratio of the moduli at the depth of the curves; grey: the thickness known otherwise "
         "with its 95 % interval, on the same axis.",
     .draw = draw_track_layer,
     .caption = caption_track_layer},
    {.name = NULL},
};
