/* Figures of the sliding contact: power spectrum, friction, contact area, length scales.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>

/* ", at 0.4 MPa and 20 °C" as far as the keys of a table say. */
static void caption_conditions(figure_drawing *d, const wt_table *table)
{
    static const char *const keys[] = {"pressure", "temperature", "shear_stress"};
    static const char *const words[] = {"nominal pressure", "temperature",
                                        "shear stress of the real contact"};
    size_t written = 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        wt_estimate value;
        if (!wt_table_estimate(table, keys[i], &value) || !isfinite(value.value))
            continue;
        text_format(&d->caption, "%s%s ", written++ == 0 ? " Conditions: " : ", ", words[i]);
        caption_value(d, value.value, value.unit, keys[i]);
    }
    if (written > 0)
        text_add(&d->caption, ".");
}

void draw_power_spectrum(figure_drawing *d)
{
    static const char *const columns[] = {"wavenumber", "density", NULL};
    const wt_table *table = wt_result_find(d->result, "roughness");
    int section = drawing_section(d, table, "power spectrum", NULL, columns, 2, true);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], true);
    span_add_section(&y, d, section, columns[1], true);
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no density above zero");
        return;
    }
    long density = number_column(table, "density");
    const char *unit = wt_table_column_unit(table, (size_t)density);
    axis_log(d, "x", "Wavenumber q", "rad/m", x);
    axis_log(d, "y", "Power spectrum C(q)", unit, y);
    text_add(&d->script, "unset key\n");
    plot_begin(d);
    plot_item(d, section, "($1*x_unit):($2*y_unit) with lines ls 21");
    plot_end(d);
    text_add(&d->caption, "Power spectrum of the counter surface over the wavenumbers that enter "
                          "the friction.");
    wt_estimate value;
    if (wt_table_estimate(table, "rms_height", &value)) {
        text_add(&d->caption, " Root-mean-square height ");
        caption_estimate(d, &value, "");
        text_add(&d->caption, ".");
    }
    if (wt_table_estimate(table, "rms_slope", &value)) {
        text_add(&d->caption, " Root-mean-square slope ");
        caption_estimate(d, &value, "");
        text_add(&d->caption, ".");
    }
}

static double largest_ratio(const wt_table *table, const char *error, const char *value)
{
    double largest = (double)NAN;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        largest =
            fmax(largest, fabs(cell_number(table, row, error) / cell_number(table, row, value)));
    return largest;
}

static void caption_friction(figure_drawing *d, const wt_table *table, bool layer)
{
    text_add(&d->caption, "Friction coefficient and its parts against sliding velocity. Bands: "
                          "one standard error");
    const char *includes = wt_table_key(table, "standard_error_includes");
    if (includes != NULL && includes[0] != '\0')
        text_format(&d->caption, " (from %s)", includes);
    text_add(&d->caption, ".");
    if (layer) {
        text_add(&d->caption, " Dashed: with the modified layer on the surface");
        wt_estimate thickness;
        if (wt_table_estimate(table, "layer_thickness", &thickness)) {
            text_add(&d->caption, ", thickness ");
            caption_estimate(d, &thickness, "");
        }
        text_add(&d->caption, ".");
    }
    caption_conditions(d, table);
    double numerical = largest_ratio(table, "hysteresis_numerical_error", "hysteresis");
    if (isfinite(numerical)) {
        text_add(&d->caption, " Largest numerical error of the hysteresis part: ");
        text_number(&d->caption, 100 * numerical, 2);
        text_add(&d->caption, " %, not in the bands.");
    }
    value_span share = SPAN_EMPTY;
    span_add_column(&share, table, "extrapolated_share", false);
    if (!span_empty(&share) && share.high > 0) {
        text_add(&d->caption, share.high < 1e-3 ? " Less than 0.1" : " Up to ");
        if (share.high >= 1e-3)
            text_number(&d->caption, 100 * share.high, 2);
        text_add(&d->caption, " % of the hysteresis part comes from frequencies outside the "
                              "measured ones.");
    }
}

/* Column plus and minus the one behind it, its standard error. */
static void draw_band(figure_drawing *d, int section, int column, int style)
{
    plot_item(d, section, "($1*x_unit):($%d-$%d):($%d+$%d) with filledcurves ls %d notitle", column,
              column + 1, column, column + 1, style);
}

void draw_friction(figure_drawing *d)
{
    static const char *const columns[] = {"velocity",
                                          "friction",
                                          "friction_standard_error",
                                          "hysteresis",
                                          "hysteresis_standard_error",
                                          "adhesion",
                                          "friction_with_layer",
                                          "friction_with_layer_standard_error",
                                          NULL};
    const wt_table *table = wt_result_find(d->result, "friction");
    int section = drawing_section(d, table, "friction", NULL, columns, 1, false);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY,
               part[4] = {SPAN_EMPTY, SPAN_EMPTY, SPAN_EMPTY, SPAN_EMPTY};
    static const size_t part_column[] = {1, 3, 5, 6};
    span_add_section(&x, d, section, columns[0], true);
    for (size_t i = 0; i < 4; i++) {
        span_add_section(&part[i], d, section, columns[part_column[i]], false);
        if (!span_empty(&part[i]))
            span_add(&y, part[i].high, false);
        if (!span_empty(&part[i]) && part[i].low < 0)
            span_add(&y, part[i].low, false);
    }
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no friction coefficient is a number");
        return;
    }
    bool total = !span_empty(&part[0]), layer = !span_empty(&part[3]);
    span_add(&y, 0, false);
    span_add(&y, 1.1 * y.high, false); // room for the bands
    axis_log(d, "x", "Sliding velocity", "m/s", x);
    axis_linear(d, "y", total ? "Friction coefficient μ" : "Hysteresis friction coefficient", "1",
                "", y);
    plot_begin(d);
    if (total)
        draw_band(d, section, 2, 71);
    if (!span_empty(&part[1]))
        draw_band(d, section, 4, 72);
    if (layer)
        draw_band(d, section, 7, 74);
    if (total)
        plot_item(d, section, "($1*x_unit):2 with lines ls 21 title 'total'");
    if (!span_empty(&part[1]))
        plot_item(d, section, "($1*x_unit):4 with lines ls 22 title 'hysteresis'");
    if (!span_empty(&part[2]))
        plot_item(d, section, "($1*x_unit):6 with lines ls 23 title 'shearing'");
    if (layer)
        plot_item(d, section, "($1*x_unit):7 with lines ls 24 title 'total with layer'");
    plot_end(d);
    caption_friction(d, table, layer);
}

/* Curves against magnification, one block per velocity, coloured by velocity. */
static void draw_scales(figure_drawing *d, const char *column, const char *label, bool log_y)
{
    const char *const columns[] = {"magnification", column, "velocity", NULL};
    const wt_table *table = wt_result_find(d->result, "contact_area");
    int section = drawing_section(d, table, column, NULL, columns, 2, true);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY, colour = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], true);
    span_add_section(&y, d, section, columns[1], log_y);
    span_add_section(&colour, d, section, columns[2], true);
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no number to draw");
        return;
    }
    bool coloured = !span_empty(&colour) && colour.high > colour.low;
    d->width = coloured ? 1.15 : 1;
    axis_log(d, "x", "Magnification ζ = q/q₀", "1", x);
    if (log_y)
        axis_log(d, "y", label, "1", y);
    else {
        span_add(&y, 0, false);
        axis_linear(d, "y", label, "1", "", y);
    }
    if (coloured)
        axis_log(d, "cb", "Sliding velocity", "m/s", colour);
    text_add(&d->script, "unset key\n");
    plot_begin(d);
    if (coloured)
        plot_item(d, section, "($1*x_unit):($2*y_unit):($3*cb_unit) with lines lw 1.8 lc palette");
    else
        plot_item(d, section, "($1*x_unit):($2*y_unit) with lines ls 21");
    plot_end(d);
}

void draw_contact_area(figure_drawing *d)
{
    draw_scales(d, "area_ratio", "Real over nominal contact area A/A₀", true);
    text_add(&d->caption, "Share of the nominal contact area that is in contact when roughness up "
                          "to the magnification is seen; one line for each sliding velocity.");
    caption_conditions(d, wt_result_find(d->result, "contact_area"));
}

void draw_friction_scales(figure_drawing *d)
{
    draw_scales(d, "hysteresis", "Hysteresis friction up to ζ", false);
    text_add(&d->caption, "Hysteresis part of the friction coefficient from roughness up to the "
                          "magnification: where a line rises, those length scales make the "
                          "friction. A line that still rises at its right end depends on the "
                          "upper cut-off of the spectrum.");
}
