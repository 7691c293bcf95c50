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
static char modulus_letter(const figure_drawing *d)
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
static bool reference_temperature(const figure_drawing *d, wt_estimate *temperature)
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

void draw_master_curve(figure_drawing *d)
{
    static const char *const columns[] = {"angular_frequency",
                                          "storage_modulus",
                                          "loss_modulus",
                                          "temperature",
                                          "fitted_storage",
                                          "fitted_loss",
                                          NULL};
    const wt_table *table = wt_result_find(d->result, "master_curve");
    int section = drawing_section(d, table, "master curve", NULL, columns, 2, true);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY, colour = SPAN_EMPTY, fit = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], true);
    span_add_section(&y, d, section, columns[1], true);
    span_add_section(&y, d, section, columns[2], true);
    span_add_section(&colour, d, section, columns[3], false);
    span_add_section(&fit, d, section, columns[4], true);
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no point of the master curve has numbers above zero");
        return;
    }
    char letter = modulus_letter(d), label[64];
    (void)snprintf(label, sizeof label, "%c′, %c″", letter, letter);
    d->width = 1.15;
    axis_log(d, "x", "Reduced angular frequency", "rad/s", x);
    axis_log(d, "y", label, "Pa", y);
    bool coloured = !span_empty(&colour);
    if (coloured)
        axis_linear(d, "cb", "Temperature", "K", "temperature", colour);
    const char *tint = coloured ? "lc palette" : "lc rgb 'black'";
    const char *column = coloured ? ":($4+cb_offset)" : "";
    plot_begin(d);
    plot_item(d, section, "($1*x_unit):($2*y_unit)%s with points ls 51 %s notitle", column, tint);
    plot_item(d, section, "($1*x_unit):($3*y_unit)%s with points ls 52 %s notitle", column, tint);
    plot_other(d, "keyentry with points ls 51 lc rgb '#111111' title '%c′'", letter);
    plot_other(d, "keyentry with points ls 52 lc rgb '#111111' title '%c″'", letter);
    if (!span_empty(&fit)) {
        plot_item(d, section, "($1*x_unit):($5*y_unit) with lines ls 11 title 'Prony series'");
        plot_item(d, section, "($1*x_unit):($6*y_unit) with lines ls 11 notitle");
    }
    plot_end(d);

    wt_estimate temperature;
    text_add(&d->caption, "Storage and loss modulus shifted to the reference temperature");
    if (reference_temperature(d, &temperature)) {
        text_add(&d->caption, " of ");
        caption_value(d, temperature.value, "K", "reference_temperature");
    }
    size_t rows = wt_table_n_rows(table);
    text_format(&d->caption,
                "; %zu points of %zu isotherms, coloured by the temperature of the "
                "measurement.",
                rows, rows == 0 ? 0 : wt_table_block(table, rows - 1) + 1);
    const wt_table *prony = wt_result_find(d->result, "prony");
    if (!span_empty(&fit) && prony != NULL)
        text_format(&d->caption, " Lines: Prony series with %zu terms fitted to both moduli.",
                    wt_table_n_rows(prony));
}

void draw_shift_factors(figure_drawing *d)
{
    static const char *const columns[] = {"temperature", "log_a",     "log_a_standard_error",
                                          "determined",  "wlf_log_a", NULL};
    const wt_table *table = wt_result_find(d->result, "shift_factors");
    int section = drawing_section(d, table, "shift factors", NULL, columns, 2, false);
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    span_add_section(&x, d, section, columns[0], false);
    span_add_section(&y, d, section, columns[1], false);
    span_add_section(&y, d, section, columns[4], false);
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no shift factor is known");
        return;
    }
    axis_linear(d, "x", "Temperature", "K", "temperature", x);
    axis_linear(d, "y", "Shift factor, log₁₀ a_T", "1", "", y);
    text_add(&d->script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n");
    wt_estimate c1, c2, reference;
    bool wlf = wt_table_estimate(table, "wlf_c1", &c1) && wt_table_estimate(table, "wlf_c2", &c2) &&
               wt_table_estimate(table, "reference_temperature", &reference) &&
               isfinite(c1.value) && isfinite(c2.value) && isfinite(reference.value);
    if (wlf) {
        // The law is drawn over the measured range only, and the pole is never in it.
        text_add(&d->script, "c1 = ");
        text_literal(&d->script, c1.value);
        text_add(&d->script, "; c2 = ");
        text_literal(&d->script, c2.value);
        text_add(&d->script, "; t_ref = ");
        text_literal(&d->script, lab_value(&(lab_unit){1, -WT_ZERO_CELSIUS, ""}, reference.value));
        text_add(&d->script, "  # K and degrees Celsius\nt_low = ");
        text_literal(&d->script, x.low - WT_ZERO_CELSIUS);
        text_add(&d->script, "; t_high = ");
        text_literal(&d->script, x.high - WT_ZERO_CELSIUS);
        text_add(&d->script, "\nwlf(t) = t < t_low || t > t_high || c2 + t - t_ref <= 0 ? NaN : "
                             "-c1*(t - t_ref)/(c2 + t - t_ref)\nset samples 400\n");
    }
    plot_begin(d);
    if (wlf)
        plot_other(d, "wlf(x) with lines ls 11 title 'WLF law'");
    plot_item(d, section,
              "($1+x_offset):($4 == 0 ? NaN : $2):3 with yerrorbars ls 1 title 'from overlap'");
    size_t undetermined = 0;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        undetermined += cell_number(table, row, "determined") == 0;
    if (undetermined > 0)
        plot_item(d, section,
                  "($1+x_offset):($4 == 0 ? $2 : NaN) with points ls 14 title "
                  "'too little overlap'");
    plot_end(d);

    text_add(&d->caption, "Horizontal shift factors with one standard error (bars; smaller than "
                          "the symbol where not seen).");
    if (wlf) {
        text_add(&d->caption, " Line: WLF law with C₁ = ");
        caption_estimate(d, &c1, "");
        text_add(&d->caption, " and C₂ = ");
        caption_estimate(d, &c2, "");
        text_add(&d->caption, " at ");
        caption_value(d, reference.value, "K", "reference_temperature");
        text_add(&d->caption, "; the two constants are correlated, see the table.");
    }
    if (undetermined > 0)
        text_format(&d->caption, " Not determined by overlap: %zu of %zu isotherms.", undetermined,
                    wt_table_n_rows(table));
}

void draw_dma_comparison(figure_drawing *d)
{
    static const char *const points[] = {
        "equivalent_frequency", "indentation_modulus", "low", "high", "extrapolated", NULL};
    static const char *const curve[] = {"equivalent_frequency", "dma_storage_modulus",
                                        "dma_complex_modulus", NULL};
    const wt_table *table = wt_result_find(d->result, "dma_comparison");
    const char *groups[DRAWING_GROUPS];
    size_t n = drawing_groups(table, "group", groups);
    int section[DRAWING_GROUPS];
    value_span x = SPAN_EMPTY, y = SPAN_EMPTY;
    int dma = drawing_section(d, table, "DMA", NULL, curve, 2, false);
    span_add_section(&y, d, dma, curve[1], true);
    span_add_section(&y, d, dma, curve[2], true);
    for (size_t i = 0; i < n; i++) {
        const row_filter rows = {{"group", NULL}, {groups[i], NULL}, false};
        section[i] = drawing_section(d, table, groups[i], &rows, points, 2, false);
        span_add_section(&x, d, section[i], points[0], true);
        for (size_t k = 1; k < 4; k++)
            span_add_section(&y, d, section[i], points[k], true);
    }
    if (span_empty(&x) || span_empty(&y) || d->status != WT_OK) {
        text_add(&d->omitted, "no indentation modulus with a known equivalent frequency");
        return;
    }
    axis_log(d, "x", "Equivalent angular frequency", "rad/s", x);
    axis_log(d, "y", "Young's modulus", "Pa", y);
    plot_begin(d);
    plot_item(d, dma, "($1*x_unit):($3*y_unit) smooth unique with lines ls 11 title 'DMA |E*|'");
    plot_item(d, dma, "($1*x_unit):($2*y_unit) smooth unique with lines ls 15 title 'DMA E′'");
    for (size_t i = 0; i < n; i++) {
        if (section[i] < 0)
            continue;
        plot_item(d, section[i],
                  "($1*x_unit):($2*y_unit):($3*y_unit):($4*y_unit) with yerrorbars ls %d",
                  drawing_group_style(groups[i], i));
        plot_title(d, groups[i]);
    }
    plot_end(d);
    size_t extrapolated = 0;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        extrapolated += cell_number(table, row, "extrapolated") > 0;
    text_add(&d->caption,
             "Indentation modulus (geometric mean, bars: 95 % confidence interval) against the "
             "angular frequency equivalent to the time of loading, with the modulus of the DMA "
             "master curve at the same frequencies. DMA strains the whole sample slightly, the "
             "tip a small volume strongly: agreement is not expected to be exact.");
    if (extrapolated > 0)
        text_format(&d->caption,
                    " %zu of %zu points lie outside the measured frequencies of "
                    "the master curve.",
                    extrapolated, wt_table_n_rows(table));
}
