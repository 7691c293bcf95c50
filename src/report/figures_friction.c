/* Figures of the sliding contact: power spectrum, friction, contact area, length scales.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>

static void caption_of_estimate(figure_drawing *d, const char *words, wt_estimate estimate)
{
    if (isnan(estimate.value))
        return;
    text_format(&d->caption, " %s ", words);
    caption_estimate(d, &estimate);
    text_add(&d->caption, ".");
}

static void caption_spectrum(figure_drawing *d)
{
    caption_of_estimate(d, "Root-mean-square height",
                        roughness_value(d->table, ROUGHNESS_KEY_RMS_HEIGHT));
    caption_of_estimate(d, "Root-mean-square slope",
                        roughness_value(d->table, ROUGHNESS_KEY_RMS_SLOPE));
}

/* ---- friction against velocity --------------------------------------------------------------- */

static void draw_friction(figure_drawing *d)
{
    value_span total = SPAN_EMPTY;
    if (!drawing_data(d))
        return;
    span_add(&d->y[0], 0, false);
    span_add(&d->y[0], 1.1 * d->y[0].high, false); // room for the bands
    span_add_column(&total, d->table, FRICTION_TOTAL, false);
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0],
                 span_empty(&total) ? "Hysteresis friction coefficient" : NULL, d->y[0]);
    plot_begin(d);
    drawing_bands(d, 0);
    drawing_curves(d, 0);
    plot_end(d);
}

/* "Conditions: nominal pressure 400 kPa, temperature 20 °C." as far as they are known. */
static void caption_conditions(figure_drawing *d)
{
    static const struct {
        friction_key key;
        const char *words;
    } conditions[] = {{FRICTION_KEY_PRESSURE, "nominal pressure"},
                      {FRICTION_KEY_TEMPERATURE, "temperature"},
                      {FRICTION_KEY_SHEAR_STRESS, "shear stress of the real contact"}};
    size_t written = 0;
    for (size_t i = 0; i < sizeof conditions / sizeof *conditions; i++) {
        wt_estimate value = friction_value(d->table, conditions[i].key);
        if (!isfinite(value.value))
            continue;
        text_format(&d->caption, "%s%s ", written++ == 0 ? " Conditions: " : ", ",
                    conditions[i].words);
        caption_value(d, friction_schema.keys[conditions[i].key].quantity, value.unit, value.value);
    }
    if (written > 0)
        text_add(&d->caption, ".");
}

/* The largest numerical error relative to its value; NaN if none is known. */
static double largest_error(const table_view *friction)
{
    double largest = (double)NAN;
    for (size_t row = 0; row < friction->n_rows; row++)
        largest =
            fmax(largest, fabs(friction_get(friction, row, FRICTION_HYSTERESIS_NUMERICAL_ERROR) /
                               friction_get(friction, row, FRICTION_HYSTERESIS)));
    return largest;
}

static void caption_friction(figure_drawing *d)
{
    value_span layer = SPAN_EMPTY, share = SPAN_EMPTY;
    const char *includes = friction_words(d->table, FRICTION_KEY_ERROR_INCLUDES);
    span_add_column(&layer, d->table, FRICTION_WITH_LAYER, false);
    span_add_column(&share, d->table, FRICTION_EXTRAPOLATED_SHARE, false);

    if (includes != NULL && includes[0] != '\0')
        text_format(&d->caption, " (from %s)", includes);
    text_add(&d->caption, ".");
    if (!span_empty(&layer)) {
        wt_estimate thickness = friction_value(d->table, FRICTION_KEY_LAYER_THICKNESS);
        text_add(&d->caption, " Dashed: with the modified layer on the surface");
        if (!isnan(thickness.value)) {
            text_add(&d->caption, ", thickness ");
            caption_estimate(d, &thickness);
        }
        text_add(&d->caption, ".");
    }
    caption_conditions(d);
    double numerical = largest_error(d->table);
    if (isfinite(numerical)) {
        text_add(&d->caption, " Largest numerical error of the hysteresis part: ");
        text_number(&d->caption, 100 * numerical, 2);
        text_add(&d->caption, " %, not in the bands.");
    }
    if (!span_empty(&share) && share.high > 0) {
        text_add(&d->caption, share.high < 1e-3 ? " Less than 0.1" : " Up to ");
        if (share.high >= 1e-3)
            text_number(&d->caption, 100 * share.high, 2);
        text_add(&d->caption, " % of the hysteresis part comes from frequencies outside the "
                              "measured ones.");
    }
}

/* ---- against magnification ------------------------------------------------------------------- */

/* One line for each velocity, coloured by it. */
static void draw_scales(figure_drawing *d)
{
    const figure_axis *y = &d->figure->y[0];
    if (!drawing_data(d))
        return;
    bool coloured = !span_empty(&d->colour) && d->colour.high > d->colour.low;
    d->width = coloured ? 1.15 : 1;
    if (y->scale == AXIS_LINEAR)
        span_add(&d->y[0], 0, false);
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", y, NULL, d->y[0]);
    if (coloured)
        drawing_axis(d, "cb", &d->figure->colour, NULL, d->colour);
    text_add(&d->script, "unset key\n");
    plot_begin(d);
    plot_item(d, d->data[0], "($1*x_unit):($2*y_unit)%s",
              coloured ? ":($3*cb_unit) with lines lw 1.8 lc palette" : " with lines ls 21");
    plot_end(d);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_friction[] = {
    {.name = "power_spectrum",
     .title = "Power spectrum of the counter surface",
     .table = &roughness_schema,
     .x = {ROUGHNESS_WAVENUMBER, AXIS_LOG, "Wavenumber q"},
     .y = {{ROUGHNESS_DENSITY, AXIS_LOG, "Power spectrum C(q)"}},
     .curves = {{.column = ROUGHNESS_DENSITY, .form = CURVE_LINE, .style = 21}},
     .nothing = "no density above zero",
     .words = "Power spectrum of the counter surface over the wavenumbers that enter the friction.",
     .caption = caption_spectrum},
    {.name = "friction",
     .title = "Friction against sliding velocity",
     .table = &friction_schema,
     .x = {FRICTION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{FRICTION_TOTAL, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves =
         {{.column = FRICTION_TOTAL, .form = CURVE_LINE, .style = 21, .title = "total", .band = 71},
          {.column = FRICTION_HYSTERESIS,
           .form = CURVE_LINE,
           .style = 22,
           .title = "hysteresis",
           .band = 72},
          {.column = FRICTION_ADHESION, .form = CURVE_LINE, .style = 23, .title = "shearing"},
          {.column = FRICTION_WITH_LAYER,
           .form = CURVE_LINE,
           .style = 24,
           .title = "total with layer",
           .band = 74}},
     .nothing = "no friction coefficient is a number",
     .words = "Friction coefficient and its parts against sliding velocity. Bands: one standard "
              "error",
     .draw = draw_friction,
     .caption = caption_friction},
    {.name = "contact_area",
     .title = "Real contact area against magnification",
     .table = &contact_area_schema,
     .data_title = "area_ratio",
     .x = {CONTACT_AREA_MAGNIFICATION, AXIS_LOG, "Magnification ζ = q/q₀"},
     .y = {{CONTACT_AREA_AREA_RATIO, AXIS_LOG, "Real over nominal contact area A/A₀"}},
     .colour = {CONTACT_AREA_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .curves = {{.column = CONTACT_AREA_AREA_RATIO, .form = CURVE_OWN}},
     .nothing = "no number to draw",
     .words = "Share of the nominal contact area that is in contact when roughness up to the "
              "magnification is seen; one line for each sliding velocity.",
     .draw = draw_scales},
    {.name = "friction_scales",
     .title = "Which length scales make the friction",
     .table = &contact_area_schema,
     .data_title = "hysteresis",
     .x = {CONTACT_AREA_MAGNIFICATION, AXIS_LOG, "Magnification ζ = q/q₀"},
     .y = {{CONTACT_AREA_HYSTERESIS, AXIS_LINEAR, "Hysteresis friction up to ζ"}},
     .colour = {CONTACT_AREA_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .curves = {{.column = CONTACT_AREA_HYSTERESIS, .form = CURVE_OWN}},
     .nothing = "no number to draw",
     .words = "Hysteresis part of the friction coefficient from roughness up to the magnification: "
              "where a line rises, those length scales make the friction. A line that still rises "
              "at its right end depends on the upper cut-off of the spectrum.",
     .draw = draw_scales},
    {.name = NULL},
};
