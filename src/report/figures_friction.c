/* Figures of the sliding contact: power spectrum, friction, contact area, length scales.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>

/* ", at 0.4 MPa and 20 °C" as far as the keys of a table say. */
static void caption_conditions(wt_drawing *d, const wt_table *table)
{
    static const char *const keys[] = {"pressure", "temperature", "shear_stress"};
    static const char *const words[] = {"nominal pressure", "temperature",
                                        "shear stress of the real contact"};
    size_t written = 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        wt_estimate value;
        if (!wt_table_estimate(table, keys[i], &value) || !isfinite(value.value))
            continue;
        wt_text_format(&d->caption, "%s%s ", written++ == 0 ? " Conditions: " : ", ", words[i]);
        wt_caption_value(d, value.value, value.unit, keys[i]);
    }
    if (written > 0)
        wt_text_add(&d->caption, ".");
}

void wt_draw_power_spectrum(wt_drawing *d)
{
    static const char *const columns[] = {"wavenumber", "density", NULL};
    const wt_table *table = wt_result_find(d->result, "roughness");
    int section = wt_drawing_section(d, table, "power spectrum", NULL, columns, 2, true);
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY;
    wt_span_add_section(&x, d, section, columns[0], true);
    wt_span_add_section(&y, d, section, columns[1], true);
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no density above zero");
        return;
    }
    long density = wt_number_column(table, "density");
    const char *unit = wt_table_column_unit(table, (size_t)density);
    wt_axis_log(d, "x", "Wavenumber q", "rad/m", x);
    wt_axis_log(d, "y", "Power spectrum C(q)", unit, y);
    wt_text_add(&d->script, "unset key\n");
    wt_plot_begin(d);
    wt_plot_item(d, section, "($1*x_unit):($2*y_unit) with lines ls 21");
    wt_plot_end(d);
    wt_text_add(&d->caption,
                "Power spectrum of the counter surface over the wavenumbers that enter "
                "the friction.");
    wt_estimate value;
    if (wt_table_estimate(table, "rms_height", &value)) {
        wt_text_add(&d->caption, " Root-mean-square height ");
        wt_caption_estimate(d, &value, "");
        wt_text_add(&d->caption, ".");
    }
    if (wt_table_estimate(table, "rms_slope", &value)) {
        wt_text_add(&d->caption, " Root-mean-square slope ");
        wt_caption_estimate(d, &value, "");
        wt_text_add(&d->caption, ".");
    }
}

static double largest_ratio(const wt_table *table, const char *error, const char *value)
{
    double largest = (double)NAN;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        largest = fmax(largest,
                       fabs(wt_cell_number(table, row, error) / wt_cell_number(table, row, value)));
    return largest;
}

static void caption_friction(wt_drawing *d, const wt_table *table, bool layer)
{
    wt_text_add(&d->caption, "Friction coefficient and its parts against sliding velocity. Bands: "
                             "one standard error");
    const char *includes = wt_table_key(table, "standard_error_includes");
    if (includes != NULL && includes[0] != '\0')
        wt_text_format(&d->caption, " (from %s)", includes);
    wt_text_add(&d->caption, ".");
    if (layer) {
        wt_text_add(&d->caption, " Dashed: with the modified layer on the surface");
        wt_estimate thickness;
        if (wt_table_estimate(table, "layer_thickness", &thickness)) {
            wt_text_add(&d->caption, ", thickness ");
            wt_caption_estimate(d, &thickness, "");
        }
        wt_text_add(&d->caption, ".");
    }
    caption_conditions(d, table);
    double numerical = largest_ratio(table, "hysteresis_numerical_error", "hysteresis");
    if (isfinite(numerical)) {
        wt_text_add(&d->caption, " Largest numerical error of the hysteresis part: ");
        wt_text_number(&d->caption, 100 * numerical, 2);
        wt_text_add(&d->caption, " %, not in the bands.");
    }
    wt_span share = WT_SPAN_EMPTY;
    wt_span_add_column(&share, table, "extrapolated_share", false);
    if (!wt_span_empty(&share) && share.high > 0) {
        wt_text_add(&d->caption, share.high < 1e-3 ? " Less than 0.1" : " Up to ");
        if (share.high >= 1e-3)
            wt_text_number(&d->caption, 100 * share.high, 2);
        wt_text_add(&d->caption, " % of the hysteresis part comes from frequencies outside the "
                                 "measured ones.");
    }
}

/* Column plus and minus the one behind it, its standard error. */
static void draw_band(wt_drawing *d, int section, int column, int style)
{
    wt_plot_item(d, section, "($1*x_unit):($%d-$%d):($%d+$%d) with filledcurves ls %d notitle",
                 column, column + 1, column, column + 1, style);
}

void wt_draw_friction(wt_drawing *d)
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
    int section = wt_drawing_section(d, table, "friction", NULL, columns, 1, false);
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY,
            part[4] = {WT_SPAN_EMPTY, WT_SPAN_EMPTY, WT_SPAN_EMPTY, WT_SPAN_EMPTY};
    static const size_t part_column[] = {1, 3, 5, 6};
    wt_span_add_section(&x, d, section, columns[0], true);
    for (size_t i = 0; i < 4; i++) {
        wt_span_add_section(&part[i], d, section, columns[part_column[i]], false);
        if (!wt_span_empty(&part[i]))
            wt_span_add(&y, part[i].high, false);
        if (!wt_span_empty(&part[i]) && part[i].low < 0)
            wt_span_add(&y, part[i].low, false);
    }
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no friction coefficient is a number");
        return;
    }
    bool total = !wt_span_empty(&part[0]), layer = !wt_span_empty(&part[3]);
    wt_span_add(&y, 0, false);
    wt_span_add(&y, 1.1 * y.high, false); // room for the bands
    wt_axis_log(d, "x", "Sliding velocity", "m/s", x);
    wt_axis_linear(d, "y", total ? "Friction coefficient μ" : "Hysteresis friction coefficient",
                   "1", "", y);
    wt_plot_begin(d);
    if (total)
        draw_band(d, section, 2, 71);
    if (!wt_span_empty(&part[1]))
        draw_band(d, section, 4, 72);
    if (layer)
        draw_band(d, section, 7, 74);
    if (total)
        wt_plot_item(d, section, "($1*x_unit):2 with lines ls 21 title 'total'");
    if (!wt_span_empty(&part[1]))
        wt_plot_item(d, section, "($1*x_unit):4 with lines ls 22 title 'hysteresis'");
    if (!wt_span_empty(&part[2]))
        wt_plot_item(d, section, "($1*x_unit):6 with lines ls 23 title 'shearing'");
    if (layer)
        wt_plot_item(d, section, "($1*x_unit):7 with lines ls 24 title 'total with layer'");
    wt_plot_end(d);
    caption_friction(d, table, layer);
}

/* Curves against magnification, one block per velocity, coloured by velocity. */
static void draw_scales(wt_drawing *d, const char *column, const char *label, bool log_y)
{
    const char *const columns[] = {"magnification", column, "velocity", NULL};
    const wt_table *table = wt_result_find(d->result, "contact_area");
    int section = wt_drawing_section(d, table, column, NULL, columns, 2, true);
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY, colour = WT_SPAN_EMPTY;
    wt_span_add_section(&x, d, section, columns[0], true);
    wt_span_add_section(&y, d, section, columns[1], log_y);
    wt_span_add_section(&colour, d, section, columns[2], true);
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no number to draw");
        return;
    }
    bool coloured = !wt_span_empty(&colour) && colour.high > colour.low;
    d->width = coloured ? 1.15 : 1;
    wt_axis_log(d, "x", "Magnification ζ = q/q₀", "1", x);
    if (log_y)
        wt_axis_log(d, "y", label, "1", y);
    else {
        wt_span_add(&y, 0, false);
        wt_axis_linear(d, "y", label, "1", "", y);
    }
    if (coloured)
        wt_axis_log(d, "cb", "Sliding velocity", "m/s", colour);
    wt_text_add(&d->script, "unset key\n");
    wt_plot_begin(d);
    if (coloured)
        wt_plot_item(d, section,
                     "($1*x_unit):($2*y_unit):($3*cb_unit) with lines lw 1.8 lc palette");
    else
        wt_plot_item(d, section, "($1*x_unit):($2*y_unit) with lines ls 21");
    wt_plot_end(d);
}

void wt_draw_contact_area(wt_drawing *d)
{
    draw_scales(d, "area_ratio", "Real over nominal contact area A/A₀", true);
    wt_text_add(&d->caption,
                "Share of the nominal contact area that is in contact when roughness up "
                "to the magnification is seen; one line for each sliding velocity.");
    caption_conditions(d, wt_result_find(d->result, "contact_area"));
}

void wt_draw_friction_scales(wt_drawing *d)
{
    draw_scales(d, "hysteresis", "Hysteresis friction up to ζ", false);
    wt_text_add(&d->caption, "Hysteresis part of the friction coefficient from roughness up to the "
                             "magnification: where a line rises, those length scales make the "
                             "friction. A line that still rises at its right end depends on the "
                             "upper cut-off of the spectrum.");
}
