/* Figures of DMA: comparison with indentation, relaxation spectrum, temperature sweeps and strain
 * sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <string.h>

/* ---- strain sweeps --------------------------------------------------------------------------- */

/* Data columns: strain, the moduli and the frequency. */
enum { STORAGE = 2, LOSS = 3, FREQUENCY = 4 };

/* Plots the points of a panel. Several frequencies are distinguished by colour. */
static void plot_strain_points(figure_drawing *d, int column, int style, const char *title)
{
    const bool coloured = d->colour.high > d->colour.low;
    char colour[32] = "";
    if (coloured)
        (void)snprintf(colour, sizeof colour, ":($%d*cb_unit)", FREQUENCY);
    plot_item(d, d->data[0], "($1*x_unit):($%d*y_unit)%s with points ls %d %s notitle", column,
              colour, style, coloured ? "lc palette" : "lc rgb 'black'");
    plot_expression(d, "keyentry with points ls %d lc rgb '#111111' title '%s'", style, title);
}

/* Marks the strain at which the given fraction of the initial storage modulus remains. */
static void plot_fraction_mark(figure_drawing *d, payne_column strain, double fraction,
                               const char *title)
{
    const unsigned columns[] = {strain, PAYNE_STORAGE_START};
    const int marks = drawing_section(d, &d->tables->payne, title, NULL, columns, 2, 2);
    plot_item(d, marks, "($1*x_unit):(%g*$2*y_unit) with points ls 14 ps 1.5 title '%s'", fraction,
              title);
}

/* The upper panel shows the storage modulus, the lower panel the loss modulus. */
static void draw_payne(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    const char letter = modulus_letter(payne_sweep_key_enum(d->table, PAYNE_SWEEP_KEY_DEFORMATION));
    char storage[16], loss[16];
    (void)snprintf(storage, sizeof storage, "%c′", letter);
    (void)snprintf(loss, sizeof loss, "%c″", letter);
    d->height = 1.6;
    text_add(&d->script, "set multiplot layout 2,1\n");
    drawing_axes(d);
    plot_strain_points(d, STORAGE, 51, storage);
    plot_fraction_mark(d, PAYNE_STRAIN_TENTH, 0.9, "a tenth lost");
    plot_fraction_mark(d, PAYNE_STRAIN_HALF, 0.5, "half lost");
    plot_end(d);
    drawing_axis(d, AXIS_Y, &d->figure->y[1], NULL, d->y[1]);
    plot_strain_points(d, LOSS, 52, loss);
    drawing_colours(d, "points ls 51"); /* for both panels; the key of this panel has free space */
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

static void caption_payne(figure_drawing *d)
{
    const table_view *sweeps = &d->tables->payne;
    size_t half = 0;
    for (size_t row = 0; row < sweeps->n_rows; row++)
        half += isnan(payne_get(sweeps, row, PAYNE_STRAIN_HALF)) ? 1 : 0;
    const size_t n = wt_table_block(d->table->table, d->table->n_rows - 1) + 1;
    text_format(&d->caption, n == 1 ? " %zu strain sweep." : " %zu strain sweeps.", n);
    if (half > 0)
        text_format(&d->caption, " In which half of the storage modulus is not lost: %zu.", half);
}

/* ---- comparison with the indentation --------------------------------------------------------- */

/* The DMA moduli at the frequencies of all groups form one line, or one line for each
 * temperature. */
static void draw_dma_comparison(figure_drawing *d)
{
    static const unsigned dma[] = {DMA_COMPARISON_EQUIVALENT_FREQUENCY,
                                   DMA_COMPARISON_STORAGE_MODULUS, DMA_COMPARISON_COMPLEX_MODULUS};
    int section = drawing_section(d, d->table, "DMA", NULL, dma, 3, 2);
    if (!drawing_build_data(d))
        return;
    span_add_section(&d->y[0], d, section, 1, true);
    span_add_section(&d->y[0], d, section, 2, true);
    drawing_axes(d);
    plot_item(d, section,
              "($1*x_unit):($3*y_unit) smooth unique with lines ls 11 title 'DMA |E*|'");
    plot_item(d, section, "($1*x_unit):($2*y_unit) smooth unique with lines ls 15 title 'DMA E′'");
    drawing_curves(d, 0);
    plot_end(d);
}

static void caption_dma_comparison(figure_drawing *d)
{
    size_t extrapolated = 0, n = d->table->n_rows;
    for (size_t row = 0; row < n; row++)
        extrapolated += dma_comparison_get(d->table, row, DMA_COMPARISON_EXTRAPOLATED) > 0;
    if (extrapolated > 0)
        text_format(&d->caption,
                    " %zu of %zu points lie outside the measured frequencies of the master curve.",
                    extrapolated, n);
    if (n > 0 && wt_table_block(d->table->table, n - 1) > 0)
        text_add(&d->caption, " The DMA is that at the temperature of each group.");
}

/* ---- relaxation spectrum --------------------------------------------------------------------- */

static void draw_relaxation_spectrum(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    plot_item(d, d->data[0],
              "($1*x_unit):($3*y_unit):($4*y_unit) with filledcurves ls 61 title 'conservative "
              "95 %% limits'");
    plot_item(d, d->data[0], "($1*x_unit):($2*y_unit) with lines ls 11 title 'spectrum'");
    plot_end(d);
}

/* ---- temperature sweeps ---------------------------------------------------------------------- */

/* Plots the points of a panel, coloured by frequency if there are several. */
static void plot_ramp(figure_drawing *d, int column, int style, const char *title)
{
    const bool coloured = d->colour.high > d->colour.low;
    plot_item(d, d->data[0], "($1+x_offset):($%d*y_unit)%s with points ls %d %s notitle", column,
              coloured ? ":($5*cb_unit)" : "", style, coloured ? "lc palette" : "lc rgb 'black'");
    plot_expression(d, "keyentry with points ls %d lc rgb '#111111' title '%s'", style, title);
}

static void plot_peaks(figure_drawing *d, glass_transition_column peak, const char *title)
{
    const unsigned columns[] = {peak, peak + GLASS_TRANSITION_FACTOR_HEIGHT -
                                          GLASS_TRANSITION_FACTOR_PEAK};
    const int peaks = drawing_section(d, &d->tables->glass_transition, title, NULL, columns, 2, 2);
    plot_item(d, peaks, "($1+x_offset):($2*y_unit) with points ls 14 ps 1.5 title '%s'", title);
}

/* The upper panel shows the moduli, the lower panel the loss factor. */
static void draw_ramp(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    const char letter = modulus_letter(ramp_key_enum(d->table, RAMP_KEY_DEFORMATION));
    char label[64], storage[16], loss[16];
    (void)snprintf(label, sizeof label, "%c′, %c″", letter, letter);
    (void)snprintf(storage, sizeof storage, "%c′", letter);
    (void)snprintf(loss, sizeof loss, "%c″", letter);
    d->height = 1.5;
    text_add(&d->script, "set multiplot layout 2,1\n");
    d->y_label = label;
    drawing_axes(d);
    plot_ramp(d, 2, 51, storage);
    plot_ramp(d, 3, 52, loss);
    plot_peaks(d, GLASS_TRANSITION_LOSS_PEAK, "peak of the loss modulus");
    drawing_colours(d, "points ls 51");
    plot_end(d);
    text_add(&d->script, "unset mytics\n");
    drawing_axis(d, AXIS_Y, &d->figure->y[1], NULL, d->y[1]);
    plot_ramp(d, 4, 51, "tan δ");
    plot_peaks(d, GLASS_TRANSITION_FACTOR_PEAK, "peak of tan δ");
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

static void caption_ramp(figure_drawing *d)
{
    const table_view *peaks = &d->tables->glass_transition;
    size_t none = 0;
    for (size_t row = 0; row < peaks->n_rows; row++)
        none += isnan(glass_transition_get(peaks, row, GLASS_TRANSITION_FACTOR_PEAK)) ? 1 : 0;
    text_format(&d->caption, " %zu temperature sweeps.",
                wt_table_block(d->table->table, d->table->n_rows - 1) + 1);
    if (none > 0)
        text_format(&d->caption, " Without a peak of tan δ in range: %zu.", none);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

const figure_description figures_dma[] = {
    {.name = "dma_comparison",
     .title = "Indentation against DMA",
     .table = &dma_comparison_schema,
     .by_group = true,
     .group = DMA_COMPARISON_GROUP,
     .x = {DMA_COMPARISON_EQUIVALENT_FREQUENCY, AXIS_LOG, "Equivalent angular frequency"},
     .y = {{DMA_COMPARISON_MODULUS, AXIS_LOG, "Young's modulus"}},
     .curves = {CURVE(DMA_COMPARISON_MODULUS, BARS, .with_errors = true),
                CURVE(DMA_COMPARISON_EXTRAPOLATED, DATA)},
     .empty_reason = "no indentation modulus with a known equivalent frequency",
     .caption_text =
         "Indentation modulus (geometric mean, bars: 95 % confidence interval) against the "
         "angular frequency equivalent to the time of loading, with the modulus of the DMA "
         "master curve at the same frequencies. DMA strains the whole sample slightly, the "
         "tip a small volume strongly: agreement is not expected to be exact.",
     .draw = draw_dma_comparison,
     .caption = caption_dma_comparison},
    {.name = NULL},
};

const figure_description figures_payne[] = {
    {.name = "relaxation_spectrum",
     .in_depth = true,
     .title = "Relaxation spectrum",
     .table = &relaxation_spectrum_schema,
     .data_title = "relaxation spectrum",
     .x = {RELAXATION_SPECTRUM_RELAXATION_TIME, AXIS_LOG, "Relaxation time"},
     .y = {{RELAXATION_SPECTRUM_DENSITY, AXIS_LOG, "H, modulus for each unit of ln τ"}},
     .curves = {CURVE(RELAXATION_SPECTRUM_DENSITY, OWN), CURVE(RELAXATION_SPECTRUM_LOW, DATA),
                CURVE(RELAXATION_SPECTRUM_HIGH, DATA)},
     .empty_reason = "no relaxation time lies within the measured frequencies",
     .caption_text =
         "Relaxation spectrum of the master curve with conservative 95 % limits (band): the "
         "modulus that relaxes at each time. A step of the storage modulus appears as a "
         "maximum. Where the band is wide, the measurement determines little.",
     .draw = draw_relaxation_spectrum},
    {.name = "ramp",
     .title = "Moduli against temperature",
     .table = &ramp_schema,
     .other_tables = "glass_transition",
     .data_title = "temperature sweeps",
     .x = {RAMP_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{RAMP_STORAGE_MODULUS, AXIS_LOG, "Storage and loss modulus"},
           {RAMP_LOSS_FACTOR, AXIS_FROM_ZERO, "tan δ"}},
     .colour = {RAMP_ANGULAR_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .curves = {CURVE(RAMP_STORAGE_MODULUS, OWN), CURVE(RAMP_LOSS_MODULUS, OWN),
                CURVE(RAMP_LOSS_FACTOR, OWN, .panel = 1)},
     .empty_reason = "no modulus above zero at any temperature",
     .caption_text =
         "Storage and loss modulus against temperature and, below, tan δ, with the peaks of "
         "the glass transition.",
     .draw = draw_ramp,
     .caption = caption_ramp},
    {.name = "payne",
     .title = "Softening with strain",
     .table = &payne_sweep_schema,
     .other_tables = "payne",
     .data_title = "strain sweeps",
     .x = {PAYNE_SWEEP_STRAIN, AXIS_LOG, "Strain amplitude"},
     .y = {{PAYNE_SWEEP_STORAGE_MODULUS, AXIS_FROM_ZERO, "Storage modulus"},
           {PAYNE_SWEEP_LOSS_MODULUS, AXIS_FROM_ZERO, "Loss modulus"}},
     .colour = {PAYNE_SWEEP_ANGULAR_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .curves = {CURVE(PAYNE_SWEEP_STORAGE_MODULUS, OWN),
                CURVE(PAYNE_SWEEP_LOSS_MODULUS, OWN, .panel = 1)},
     .empty_reason = "no modulus above zero at any amplitude",
     .caption_text =
         "Storage modulus and, below, loss modulus against the amplitude of strain, with the "
         "amplitudes at which a tenth and half of the storage modulus are lost. The storage "
         "modulus of a filled rubber falls between two plateaus, "
         "and its loss modulus has the maximum where half of that fall is reached.",
     .draw = draw_payne,
     .caption = caption_payne},
    {.name = NULL},
};
