/* Figures of the horizontal shift factors with their law, of the vertical shift factors and of the
 * influence of each isotherm on them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include "core/base/quantity.h"

#include <math.h>
#include <string.h>

/* ---- shift factors --------------------------------------------------------------------------- */

/* Returns the temperature range of the isotherms that determine the law. The law is drawn only
 * there. */
static value_span law_temperature_span(const figure_drawing *d)
{
    value_span span = EMPTY_SPAN;
    for (size_t row = 0; row < d->table->n_rows; row++)
        if (shift_factors_get(d->table, row, SHIFT_FACTORS_DETERMINED) != 0)
            span_add(&span, shift_factors_get(d->table, row, SHIFT_FACTORS_TEMPERATURE), true);
    return span;
}

/* Writes the fitted law, with the offset of the reference isotherm, as gnuplot functions. They
 * are limited to the determined range, which never includes the pole. */
static bool define_shift_law(figure_drawing *d)
{
    const table_view *shifts = d->table;
    const double c1 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C1).value,
                 c2 = shift_factors_value(shifts, SHIFT_FACTORS_KEY_WLF_C2).value,
                 energy = shift_factors_value(shifts, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY).value,
                 joint = shift_factors_value(shifts, SHIFT_FACTORS_KEY_JOINT).value,
                 offset = shift_factors_value(shifts, SHIFT_FACTORS_KEY_OFFSET).value,
                 reference =
                     shift_factors_value(shifts, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE).value;
    const bool has_wlf = isfinite(c1) && isfinite(c2), has_energy = isfinite(energy);
    const value_span over = law_temperature_span(d);
    if ((!has_wlf && !has_energy) || !isfinite(reference) || !isfinite(offset) ||
        span_is_empty(&over))
        return false;
    /* joint [K] converted to degrees Celsius; WLF applies above it, Arrhenius below */
    const double joint_celsius = isfinite(joint) ? joint - WT_ZERO_CELSIUS : has_wlf ? -300 : 1e6;
    text_format(&d->script, "c1 = %s; c2 = %s; t_ref = %s; offset = %s\n",
                LITERAL(has_wlf ? c1 : 0), LITERAL(has_wlf ? c2 : 1),
                LITERAL(reference - WT_ZERO_CELSIUS), LITERAL(offset));
    text_format(&d->script, "slope = %s; joint = %s; t_low = %s; t_high = %s\n",
                LITERAL(has_energy ? energy / (GAS_CONSTANT * M_LN10) : 0), LITERAL(joint_celsius),
                LITERAL(over.low - WT_ZERO_CELSIUS), LITERAL(over.high - WT_ZERO_CELSIUS));
    text_add(&d->script,
             "upper(t) = t > joint ? t : joint\nlower(t) = t < joint ? t : joint\n"
             "wlf(t) = -c1*(t - t_ref)/(c2 + t - t_ref)\n"
             "arrhenius(t) = slope/(t + 273.15)\n"
             "warm(t) = c1 == 0 ? 0 : wlf(upper(t)) - wlf(upper(t_ref))\n"
             "cold(t) = slope == 0 ? 0 : arrhenius(lower(t)) - arrhenius(lower(t_ref))\n"
             "over(t, y) = t < t_low - 1e-6 || t > t_high + 1e-6 ? NaN : y\n"
             "law(t) = over(t, offset + warm(t) + cold(t))\n"
             "set samples 400\n");
    return true;
}

static size_t count_undetermined(const table_view *shift_factors)
{
    size_t n = 0;
    for (size_t row = 0; row < shift_factors->n_rows; row++)
        n += shift_factors_get(shift_factors, row, SHIFT_FACTORS_DETERMINED) == 0;
    return n;
}

/* Range of the residuals of the law. The data columns are shift, its error, a flag and the law. */
static value_span residual_span(const figure_drawing *d, double offset)
{
    const wt_table *data = d->sections[d->data[0]];
    value_span span = EMPTY_SPAN;
    for (size_t row = 0; row < wt_table_n_rows(data); row++) {
        const double law = wt_table_number(data, row, 4), error = wt_table_number(data, row, 2);
        const double residual = wt_table_number(data, row, 1) - offset - law;
        span_add(&span, residual - NORMAL_95 * error, false);
        span_add(&span, residual + NORMAL_95 * error, false);
        span_add(&span, wt_table_number(data, row, 5) - law, false);
        span_add(&span, wt_table_number(data, row, 6) - law, false);
    }
    span_add(&span, 0, false);
    return span;
}

static void plot_residual(figure_drawing *d)
{
    const double offset = shift_factors_value(d->table, SHIFT_FACTORS_KEY_OFFSET).value;
    drawing_axis(d, AXIS_Y, &d->figure->y[1], NULL, residual_span(d, offset));
    text_add(&d->script, "unset key\n");
    text_add(&d->script, "set ylabel 'Residual, log_{10} a_T' enhanced\n");
    plot_item(d, d->data[0],
              "($1+x_offset):(over($1+x_offset,$6)-$5):($7-$5) with filledcurves ls 61 "
              "notitle");
    plot_expression(d, "0 with lines ls 11 notitle");
    plot_item(d, d->data[0],
              "($1+x_offset):($4 == 0 ? NaN : $2-offset-$5):(" HALF_95
              "*$3) with yerrorbars ls 1 notitle");
    plot_end(d);
}

/* Returns true if the law was stated. Only a fitted law has a standard error. */
static bool law_is_stated(const table_view *shifts)
{
    const wt_estimate slope = shift_factors_value(shifts, SHIFT_FACTORS_KEY_LAW_SLOPE);
    return isfinite(slope.value) && !isfinite(slope.standard_error);
}

/* The upper panel shows the shifts and their law, the lower panel the residuals. */
void draw_shift_factors(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    text_add(&d->script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n");
    const bool law = define_shift_law(d);
    if (law) {
        d->height = 1.6;
        text_add(&d->script, "set multiplot layout 2,1\n");
        plot_item(d, d->data[0],
                  "($1+x_offset):(over($1+x_offset,$6)+offset):($7+offset) with filledcurves ls 61 "
                  "title '95 %% interval of the law'");
        plot_expression(d, "law(x) with lines ls 11 title '%s'",
                        law_is_stated(d->table) ? "given law" : "fitted law");
    }
    plot_item(d, d->data[0],
              "($1+x_offset):($4 == 0 ? NaN : $2):(" HALF_95
              "*$3) with yerrorbars ls 1 title 'from overlap'");
    if (count_undetermined(d->table) > 0)
        plot_item(d, d->data[0],
                  "($1+x_offset):($4 == 0 ? $2 : NaN) with points ls 14 title "
                  "'too little overlap'");
    plot_end(d);
    if (!law)
        return;
    plot_residual(d);
    text_add(&d->script, "unset multiplot\n");
}

void caption_shift_factors(figure_drawing *d)
{
    size_t undetermined = count_undetermined(d->table);
    const wt_estimate c1 = shift_factors_value(d->table, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(d->table, SHIFT_FACTORS_KEY_WLF_C2),
                      energy = shift_factors_value(d->table, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY);
    const char *verdict = shift_factors_key_text(d->table, SHIFT_FACTORS_KEY_SUPERPOSITION);
    if (isfinite(c1.value))
        text_format(&d->caption, " Line: WLF law with C₁ = %s and C₂ = %s, %s.", ESTIMATE(&c1),
                    ESTIMATE(&c2),
                    law_is_stated(d->table) ? "by which the shifts were given"
                                            : "with the offset of the reference isotherm that was "
                                              "fitted; band: its 95 % interval");
    if (isfinite(energy.value))
        text_format(&d->caption,
                    isfinite(c1.value) ? " Arrhenius in the cold with %s." : " Arrhenius with %s.",
                    ESTIMATE(&energy));
    text_format(&d->caption, " Time-temperature superposition: %s.", verdict);
    if (undetermined > 0)
        text_format(&d->caption, " Not determined by overlap: %zu of %zu isotherms.", undetermined,
                    d->table->n_rows);
}

/* ---- vertical shifts ------------------------------------------------------------------------- */

void draw_vertical_shifts(figure_drawing *d)
{
    const int vertical = shift_factors_key_enum(d->table, SHIFT_FACTORS_KEY_VERTICAL);
    if (d->table->n_rows < 2 || vertical == WT_VERTICAL_NONE || !drawing_build_data(d))
        return;
    drawing_axes(d);
    text_add(&d->script, "set ylabel 'Shift factor, log_{10} b_T' enhanced\n");
    plot_item(d, d->data[0], "($1+x_offset):4 with lines ls 12 title 'rubber elasticity'");
    plot_item(d, d->data[0], "($1+x_offset):5 with lines ls 11 title 'material'");
    plot_item(d, d->data[0],
              "($1+x_offset):2:(" HALF_95 "*$3) with yerrorbars ls 1 title 'isotherms'");
    plot_end(d);
}

void caption_vertical_shifts(figure_drawing *d)
{
    double most = 0;
    for (size_t row = 0; row < d->table->n_rows; row++) {
        const double deviation = shift_factors_get(d->table, row, SHIFT_FACTORS_LOG_B) -
                                 shift_factors_get(d->table, row, SHIFT_FACTORS_LOG_B_PHYSICAL);
        most = fmax(most, isfinite(deviation) ? fabs(deviation) : 0);
    }
    text_format(&d->caption,
                " The factors should be smooth and, above the glass transition, near the line "
                "of rubber elasticity; here they deviate from it by up to %s decade. A filler "
                "that softens with temperature or a clamp that yields causes such a deviation.",
                NUMBER(most, 2));
}

/* ---- influences ------------------------------------------------------------------------------ */

void draw_influences(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    value_span span = EMPTY_SPAN;
    span_add(&span, 0, false);
    for (size_t row = 0; row < d->table->n_rows; row++) {
        span_add(&span, fabs(influences_get(d->table, row, INFLUENCES_CHANGE)), false);
        span_add(&span, influences_get(d->table, row, INFLUENCES_INTERVAL), false);
    }
    drawing_axes(d);
    drawing_axis(d, AXIS_Y, &d->figure->y[0], NULL, span);
    text_add(&d->script, "set ylabel 'Largest change of log_{10} a_T' enhanced\n");
    plot_item(d, d->data[0], "($1+x_offset):(abs($2)) with impulses ls 1 lw 6 title 'change'");
    plot_item(d, d->data[0],
              "($1+x_offset):3 with points ls 14 title 'half width of the 95 %% interval'");
    plot_end(d);
}
