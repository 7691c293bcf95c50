/* Figures of the dynamic mechanical analysis: master curve, shift factors, comparison with the
 * indentation.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/figures.h"

#include "report/cells.h"

#include <math.h>
#include <string.h>

/* 'E' or 'G', as any of the DMA tables says. */
static char modulus_letter(const wt_drawing *d)
{
    static const char *const tables[] = {"prony", "shift_factors", "master_curve"};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        const wt_table *table = wt_result_find(d->result, tables[i]);
        const char *deformation = table != NULL ? wt_table_key(table, "deformation") : NULL;
        if (deformation != NULL)
            return strcmp(deformation, "shear") == 0 ? 'G' : 'E';
    }
    return 'E';
}

/* " at T" with the reference temperature, if a table states it. */
static bool reference_temperature(const wt_drawing *d, wt_estimate *temperature)
{
    static const char *const tables[] = {"shift_factors", "prony", "master_curve"};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        const wt_table *table = wt_result_find(d->result, tables[i]);
        if (table != NULL && wt_table_estimate(table, "reference_temperature", temperature) &&
            isfinite(temperature->value))
            return true;
    }
    return false;
}

void wt_draw_master_curve(wt_drawing *d)
{
    static const char *const columns[] = {"angular_frequency",
                                          "storage_modulus",
                                          "loss_modulus",
                                          "temperature",
                                          "fitted_storage",
                                          "fitted_loss",
                                          NULL};
    const wt_table *table = wt_result_find(d->result, "master_curve");
    int section = wt_drawing_section(d, table, "master curve", NULL, columns, 2, true);
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY, colour = WT_SPAN_EMPTY, fit = WT_SPAN_EMPTY;
    wt_span_add_section(&x, d, section, columns[0], true);
    wt_span_add_section(&y, d, section, columns[1], true);
    wt_span_add_section(&y, d, section, columns[2], true);
    wt_span_add_section(&colour, d, section, columns[3], false);
    wt_span_add_section(&fit, d, section, columns[4], true);
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no point of the master curve has numbers above zero");
        return;
    }
    char letter = modulus_letter(d), label[64];
    (void)snprintf(label, sizeof label, "%c′, %c″", letter, letter);
    d->width = 1.15;
    wt_axis_log(d, "x", "Reduced angular frequency", "rad/s", x);
    wt_axis_log(d, "y", label, "Pa", y);
    bool coloured = !wt_span_empty(&colour);
    if (coloured)
        wt_axis_linear(d, "cb", "Temperature", "K", "temperature", colour);
    const char *tint = coloured ? "lc palette" : "lc rgb 'black'";
    const char *column = coloured ? ":($4+cb_offset)" : "";
    wt_plot_begin(d);
    wt_plot_item(d, section, "($1*x_unit):($2*y_unit)%s with points ls 51 %s notitle", column,
                 tint);
    wt_plot_item(d, section, "($1*x_unit):($3*y_unit)%s with points ls 52 %s notitle", column,
                 tint);
    wt_plot_other(d, "keyentry with points ls 51 lc rgb '#111111' title '%c′'", letter);
    wt_plot_other(d, "keyentry with points ls 52 lc rgb '#111111' title '%c″'", letter);
    if (!wt_span_empty(&fit)) {
        wt_plot_item(d, section, "($1*x_unit):($5*y_unit) with lines ls 11 title 'Prony series'");
        wt_plot_item(d, section, "($1*x_unit):($6*y_unit) with lines ls 11 notitle");
    }
    wt_plot_end(d);

    wt_estimate temperature;
    wt_text_add(&d->caption, "Storage and loss modulus shifted to the reference temperature");
    if (reference_temperature(d, &temperature)) {
        wt_text_add(&d->caption, " of ");
        wt_caption_value(d, temperature.value, "K", "reference_temperature");
    }
    size_t rows = wt_table_n_rows(table);
    wt_text_format(&d->caption,
                   "; %zu points of %zu isotherms, coloured by the temperature of the "
                   "measurement.",
                   rows, rows == 0 ? 0 : wt_table_block(table, rows - 1) + 1);
    const wt_table *prony = wt_result_find(d->result, "prony");
    if (!wt_span_empty(&fit) && prony != NULL)
        wt_text_format(&d->caption, " Lines: Prony series with %zu terms fitted to both moduli.",
                       wt_table_n_rows(prony));
}

void wt_draw_shift_factors(wt_drawing *d)
{
    static const char *const columns[] = {"temperature", "log_a",     "log_a_standard_error",
                                          "determined",  "wlf_log_a", NULL};
    const wt_table *table = wt_result_find(d->result, "shift_factors");
    int section = wt_drawing_section(d, table, "shift factors", NULL, columns, 2, false);
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY;
    wt_span_add_section(&x, d, section, columns[0], false);
    wt_span_add_section(&y, d, section, columns[1], false);
    wt_span_add_section(&y, d, section, columns[4], false);
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no shift factor is known");
        return;
    }
    wt_axis_linear(d, "x", "Temperature", "K", "temperature", x);
    wt_axis_linear(d, "y", "Shift factor, log₁₀ a_T", "1", "", y);
    wt_text_add(&d->script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n");
    wt_estimate c1, c2, reference;
    bool wlf = wt_table_estimate(table, "wlf_c1", &c1) && wt_table_estimate(table, "wlf_c2", &c2) &&
               wt_table_estimate(table, "reference_temperature", &reference) &&
               isfinite(c1.value) && isfinite(c2.value) && isfinite(reference.value);
    if (wlf) {
        // The law is drawn over the measured range only, and the pole is never in it.
        wt_text_add(&d->script, "c1 = ");
        wt_text_literal(&d->script, c1.value);
        wt_text_add(&d->script, "; c2 = ");
        wt_text_literal(&d->script, c2.value);
        wt_text_add(&d->script, "; t_ref = ");
        wt_text_literal(&d->script,
                        wt_lab_value(&(wt_lab_unit){1, -WT_ZERO_CELSIUS, ""}, reference.value));
        wt_text_add(&d->script, "  # K and degrees Celsius\nt_low = ");
        wt_text_literal(&d->script, x.low - WT_ZERO_CELSIUS);
        wt_text_add(&d->script, "; t_high = ");
        wt_text_literal(&d->script, x.high - WT_ZERO_CELSIUS);
        wt_text_add(&d->script, "\nwlf(t) = t < t_low || t > t_high || c2 + t - t_ref <= 0 ? NaN : "
                                "-c1*(t - t_ref)/(c2 + t - t_ref)\nset samples 400\n");
    }
    wt_plot_begin(d);
    if (wlf)
        wt_plot_other(d, "wlf(x) with lines ls 11 title 'WLF law'");
    wt_plot_item(d, section,
                 "($1+x_offset):($4 == 0 ? NaN : $2):3 with yerrorbars ls 1 title 'from overlap'");
    size_t undetermined = 0;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        undetermined += wt_cell_number(table, row, "determined") == 0;
    if (undetermined > 0)
        wt_plot_item(d, section,
                     "($1+x_offset):($4 == 0 ? $2 : NaN) with points ls 14 title "
                     "'too little overlap'");
    wt_plot_end(d);

    wt_text_add(&d->caption, "Horizontal shift factors with one standard error (bars; smaller than "
                             "the symbol where not seen).");
    if (wlf) {
        wt_text_add(&d->caption, " Line: WLF law with C₁ = ");
        wt_caption_estimate(d, &c1, "");
        wt_text_add(&d->caption, " and C₂ = ");
        wt_caption_estimate(d, &c2, "");
        wt_text_add(&d->caption, " at ");
        wt_caption_value(d, reference.value, "K", "reference_temperature");
        wt_text_add(&d->caption, "; the two constants are correlated, see the table.");
    }
    if (undetermined > 0)
        wt_text_format(&d->caption, " Not determined by overlap: %zu of %zu isotherms.",
                       undetermined, wt_table_n_rows(table));
}

void wt_draw_dma_comparison(wt_drawing *d)
{
    static const char *const points[] = {
        "equivalent_frequency", "indentation_modulus", "low", "high", "extrapolated", NULL};
    static const char *const curve[] = {"equivalent_frequency", "dma_storage_modulus",
                                        "dma_complex_modulus", NULL};
    const wt_table *table = wt_result_find(d->result, "dma_comparison");
    const char *groups[WT_DRAWING_GROUPS];
    size_t n = wt_drawing_groups(table, "group", groups);
    int section[WT_DRAWING_GROUPS];
    wt_span x = WT_SPAN_EMPTY, y = WT_SPAN_EMPTY;
    int dma = wt_drawing_section(d, table, "DMA", NULL, curve, 2, false);
    wt_span_add_section(&y, d, dma, curve[1], true);
    wt_span_add_section(&y, d, dma, curve[2], true);
    for (size_t i = 0; i < n; i++) {
        const wt_rows rows = {{"group", NULL}, {groups[i], NULL}, false};
        section[i] = wt_drawing_section(d, table, groups[i], &rows, points, 2, false);
        wt_span_add_section(&x, d, section[i], points[0], true);
        for (size_t k = 1; k < 4; k++)
            wt_span_add_section(&y, d, section[i], points[k], true);
    }
    if (wt_span_empty(&x) || wt_span_empty(&y) || d->status != WT_OK) {
        wt_text_add(&d->omitted, "no indentation modulus with a known equivalent frequency");
        return;
    }
    wt_axis_log(d, "x", "Equivalent angular frequency", "rad/s", x);
    wt_axis_log(d, "y", "Young's modulus", "Pa", y);
    wt_plot_begin(d);
    wt_plot_item(d, dma, "($1*x_unit):($3*y_unit) smooth unique with lines ls 11 title 'DMA |E*|'");
    wt_plot_item(d, dma, "($1*x_unit):($2*y_unit) smooth unique with lines ls 15 title 'DMA E′'");
    for (size_t i = 0; i < n; i++) {
        if (section[i] < 0)
            continue;
        wt_plot_item(d, section[i],
                     "($1*x_unit):($2*y_unit):($3*y_unit):($4*y_unit) with yerrorbars ls %d",
                     wt_drawing_group_style(groups[i], i));
        wt_plot_title(d, groups[i]);
    }
    wt_plot_end(d);
    size_t extrapolated = 0;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        extrapolated += wt_cell_number(table, row, "extrapolated") > 0;
    wt_text_add(&d->caption,
                "Indentation modulus (geometric mean, bars: 95 % confidence interval) against the "
                "angular frequency equivalent to the time of loading, with the modulus of the DMA "
                "master curve at the same frequencies. DMA strains the whole sample slightly, the "
                "tip a small volume strongly: agreement is not expected to be exact.");
    if (extrapolated > 0)
        wt_text_format(&d->caption,
                       " %zu of %zu points lie outside the measured frequencies of "
                       "the master curve.",
                       extrapolated, wt_table_n_rows(table));
}
