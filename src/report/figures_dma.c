/* Figures of the dynamic mechanical analysis: comparison with the indentation, master curve, shift
 * factors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>
#include <string.h>

/* ---- comparison with the indentation --------------------------------------------------------- */

/* The DMA at the frequencies of all groups is one line, or one for each temperature. */
static void draw_dma_comparison(figure_drawing *d)
{
    static const unsigned dma[] = {DMA_COMPARISON_EQUIVALENT_FREQUENCY,
                                   DMA_COMPARISON_STORAGE_MODULUS, DMA_COMPARISON_COMPLEX_MODULUS};
    int section = drawing_section(d, d->table, "DMA", NULL, dma, 3, 2);
    if (!drawing_data(d))
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

/* ---- master curve ---------------------------------------------------------------------------- */

/* Points are coloured by the temperature of the measurement. */
static void draw_master_curve(figure_drawing *d)
{
    if (!drawing_data(d))
        return;
    const char *deformation = master_curve_words(d->table, MASTER_CURVE_KEY_DEFORMATION);
    char letter = strcmp(deformation, "shear") == 0 ? 'G' : 'E', label[64];
    (void)snprintf(label, sizeof label, "%c′, %c″", letter, letter);
    d->width = 1.15;
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    drawing_axis(d, "y", &d->figure->y[0], label, d->y[0]);
    bool coloured = !span_empty(&d->colour);
    if (coloured)
        drawing_axis(d, "cb", &d->figure->colour, NULL, d->colour);
    const char *tint = coloured ? "lc palette" : "lc rgb 'black'";
    const char *column = coloured ? ":($4+cb_offset)" : "";
    plot_item(d, d->data[0], "($1*x_unit):($2*y_unit)%s with points ls 51 %s notitle", column,
              tint);
    plot_item(d, d->data[0], "($1*x_unit):($3*y_unit)%s with points ls 52 %s notitle", column,
              tint);
    plot_other(d, "keyentry with points ls 51 lc rgb '#111111' title '%c′'", letter);
    plot_other(d, "keyentry with points ls 52 lc rgb '#111111' title '%c″'", letter);
    drawing_curves(d, 0);
    plot_end(d);
}

static void caption_master_curve(figure_drawing *d)
{
    const double reference =
        master_curve_value(d->table, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value;
    const size_t n = d->table->n_rows, terms = d->tables->prony.n_rows;
    value_span fit = SPAN_EMPTY;

    if (isfinite(reference))
        text_format(&d->caption, " of %s", VALUE(WT_Q_TEMPERATURE, NULL, reference));
    text_format(&d->caption,
                "; %zu points of %zu isotherms, coloured by the temperature of the measurement.", n,
                wt_table_block(d->table->table, n - 1) + 1);
    span_add_column(&fit, d->table, MASTER_CURVE_FITTED_STORAGE, true);
    if (!span_empty(&fit) && terms > 0)
        text_format(&d->caption, " Lines: one relaxation spectrum of %zu terms behind both moduli.",
                    terms);
}

/* ---- shift factors --------------------------------------------------------------------------- */

/* The law as it was fitted, with the offset of the reference isotherm, over the measured range
 * only; the pole is never in it. */
static bool define_law(figure_drawing *d)
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
    if ((!has_wlf && !has_energy) || !isfinite(reference) || !isfinite(offset))
        return false;
    /* K and degrees Celsius; WLF above the joint, Arrhenius below it */
    const double at = isfinite(joint) ? joint - WT_ZERO_CELSIUS : has_wlf ? -300 : 1e6;
    text_format(&d->script, "c1 = %s; c2 = %s; t_ref = %s; offset = %s\n",
                LITERAL(has_wlf ? c1 : 0), LITERAL(has_wlf ? c2 : 1),
                LITERAL(reference - WT_ZERO_CELSIUS), LITERAL(offset));
    text_format(&d->script, "slope = %s; joint = %s; t_low = %s; t_high = %s\n",
                LITERAL(has_energy ? energy / (8.31446261815324 * M_LN10) : 0), LITERAL(at),
                LITERAL(d->x.low - WT_ZERO_CELSIUS), LITERAL(d->x.high - WT_ZERO_CELSIUS));
    text_add(&d->script,
             "upper(t) = t > joint ? t : joint\nlower(t) = t < joint ? t : joint\n"
             "wlf(t) = -c1*(t - t_ref)/(c2 + t - t_ref)\n"
             "arrhenius(t) = slope/(t + 273.15)\n"
             "warm(t) = c1 == 0 ? 0 : wlf(upper(t)) - wlf(upper(t_ref))\n"
             "cold(t) = slope == 0 ? 0 : arrhenius(lower(t)) - arrhenius(lower(t_ref))\n"
             "law(t) = t < t_low || t > t_high ? NaN : offset + warm(t) + cold(t)\n"
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

static void draw_shift_factors(figure_drawing *d)
{
    if (!drawing_data(d))
        return;
    drawing_axes(d);
    text_add(&d->script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n");
    if (define_law(d)) {
        plot_item(d, d->data[0],
                  "($1+x_offset):($6+offset):($7+offset) with filledcurves ls 61 notitle");
        plot_other(d, "law(x) with lines ls 11 title 'fitted law'");
    }
    plot_item(d, d->data[0],
              "($1+x_offset):($4 == 0 ? NaN : $2):3 with yerrorbars ls 1 title 'from overlap'");
    if (count_undetermined(d->table) > 0)
        plot_item(d, d->data[0],
                  "($1+x_offset):($4 == 0 ? $2 : NaN) with points ls 14 title "
                  "'too little overlap'");
    plot_end(d);
}

static void caption_shift_factors(figure_drawing *d)
{
    size_t undetermined = count_undetermined(d->table);
    const wt_estimate c1 = shift_factors_value(d->table, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(d->table, SHIFT_FACTORS_KEY_WLF_C2),
                      energy = shift_factors_value(d->table, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY);
    const char *verdict = shift_factors_words(d->table, SHIFT_FACTORS_KEY_SUPERPOSITION);
    if (isfinite(c1.value))
        text_format(&d->caption,
                    " Line: WLF law with C₁ = %s and C₂ = %s, with the offset of the reference "
                    "isotherm that was fitted; band: its 95 %% interval.",
                    ESTIMATE(&c1), ESTIMATE(&c2));
    if (isfinite(energy.value))
        text_format(&d->caption, " Arrhenius%s with %s.", isfinite(c1.value) ? " in the cold" : "",
                    ESTIMATE(&energy));
    text_format(&d->caption, " Time-temperature superposition: %s.", verdict);
    if (undetermined > 0)
        text_format(&d->caption, " Not determined by overlap: %zu of %zu isotherms.", undetermined,
                    d->table->n_rows);
}

/* ---- temperature sweeps ---------------------------------------------------------------------- */

/* Points of a panel, coloured by frequency where there are several, and the peaks in it. */
static void plot_ramp(figure_drawing *d, int column, int style, const char *title)
{
    const bool coloured = d->colour.high > d->colour.low;
    plot_item(d, d->data[0], "($1+x_offset):($%d*y_unit)%s with points ls %d %s notitle", column,
              coloured ? ":($5*cb_unit)" : "", style, coloured ? "lc palette" : "lc rgb 'black'");
    plot_other(d, "keyentry with points ls %d lc rgb '#111111' title '%s'", style, title);
}

static void plot_peaks(figure_drawing *d, glass_transition_column peak, const char *title)
{
    const unsigned columns[] = {peak, peak + GLASS_TRANSITION_FACTOR_HEIGHT -
                                          GLASS_TRANSITION_FACTOR_PEAK};
    const int peaks = drawing_section(d, &d->tables->glass_transition, title, NULL, columns, 2, 2);
    plot_item(d, peaks, "($1+x_offset):($2*y_unit) with points ls 14 ps 1.5 title '%s'", title);
}

/* Moduli above, loss factor below. */
static void draw_ramp(figure_drawing *d)
{
    if (!drawing_data(d))
        return;
    const char *deformation = ramp_words(d->table, RAMP_KEY_DEFORMATION);
    const char letter = strcmp(deformation, "shear") == 0 ? 'G' : 'E';
    char label[64], storage[16], loss[16];
    (void)snprintf(label, sizeof label, "%c′, %c″", letter, letter);
    (void)snprintf(storage, sizeof storage, "%c′", letter);
    (void)snprintf(loss, sizeof loss, "%c″", letter);
    d->height = 1.5;
    text_add(&d->script, "set multiplot layout 2,1\n");
    drawing_axis(d, "x", &d->figure->x, NULL, d->x);
    if (d->colour.high > d->colour.low) {
        d->width = 1.15;
        drawing_axis(d, "cb", &d->figure->colour, NULL, d->colour);
    }
    drawing_axis(d, "y", &d->figure->y[0], label, d->y[0]);
    plot_ramp(d, 2, 51, storage);
    plot_ramp(d, 3, 52, loss);
    plot_peaks(d, GLASS_TRANSITION_LOSS_PEAK, "peak of the loss modulus");
    plot_end(d);
    text_add(&d->script, "unset mytics\n");
    drawing_axis(d, "y", &d->figure->y[1], NULL, d->y[1]);
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
     .nothing = "no indentation modulus with a known equivalent frequency",
     .words = "Indentation modulus (geometric mean, bars: 95 % confidence interval) against the "
              "angular frequency equivalent to the time of loading, with the modulus of the DMA "
              "master curve at the same frequencies. DMA strains the whole sample slightly, the "
              "tip a small volume strongly: agreement is not expected to be exact.",
     .draw = draw_dma_comparison,
     .caption = caption_dma_comparison},
    {.name = "master_curve",
     .title = "Master curve",
     .table = &master_curve_schema,
     .beside = "prony",
     .data_title = "master curve",
     .x = {MASTER_CURVE_ANGULAR_FREQUENCY, AXIS_LOG, "Reduced angular frequency"},
     .y = {{MASTER_CURVE_STORAGE_MODULUS, AXIS_LOG, "Storage and loss modulus"}},
     .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .curves = {CURVE(MASTER_CURVE_STORAGE_MODULUS, OWN), CURVE(MASTER_CURVE_LOSS_MODULUS, OWN),
                CURVE(MASTER_CURVE_TEMPERATURE, DATA),
                CURVE(MASTER_CURVE_FITTED_STORAGE, FIT, .style = 11, .title = "one spectrum"),
                CURVE(MASTER_CURVE_FITTED_LOSS, FIT, .style = 11)},
     .nothing = "no point of the master curve has numbers above zero",
     .words = "Storage and loss modulus shifted to the reference temperature",
     .draw = draw_master_curve,
     .caption = caption_master_curve},
    {.name = "ramp",
     .title = "Moduli against temperature",
     .table = &ramp_schema,
     .beside = "glass_transition",
     .data_title = "temperature sweeps",
     .x = {RAMP_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{RAMP_STORAGE_MODULUS, AXIS_LOG, "Storage and loss modulus"},
           {RAMP_LOSS_FACTOR, AXIS_FROM_ZERO, "tan δ"}},
     .colour = {RAMP_ANGULAR_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .curves = {CURVE(RAMP_STORAGE_MODULUS, OWN), CURVE(RAMP_LOSS_MODULUS, OWN),
                CURVE(RAMP_LOSS_FACTOR, OWN, .panel = 1)},
     .nothing = "no modulus above zero at any temperature",
     .words = "Storage and loss modulus against temperature and, below, tan δ, with the peaks that "
              "tell the glass transition.",
     .draw = draw_ramp,
     .caption = caption_ramp},
    {.name = "shift_factors",
     .title = "Shift factors",
     .table = &shift_factors_schema,
     .data_title = "shift factors",
     .x = {SHIFT_FACTORS_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{SHIFT_FACTORS_LOG_A, AXIS_NUMBER, "Shift factor, log₁₀ a_T"}},
     .curves = {CURVE(SHIFT_FACTORS_LOG_A, OWN, .with_errors = true),
                CURVE(SHIFT_FACTORS_DETERMINED, DATA), CURVE(SHIFT_FACTORS_LAW_LOG_A, OWN),
                CURVE(SHIFT_FACTORS_LAW_LOG_A_LOW, DATA),
                CURVE(SHIFT_FACTORS_LAW_LOG_A_HIGH, DATA)},
     .nothing = "no shift factor is known",
     .words = "Horizontal shift factors with one standard error (bars; smaller than the symbol "
              "where not seen).",
     .draw = draw_shift_factors,
     .caption = caption_shift_factors},
    {.name = NULL},
};
