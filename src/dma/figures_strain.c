/* Figure of strain sweeps: softening of a filled rubber with the strain amplitude.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>

/* Data columns: strain, the moduli and the laws, and the frequency. */
enum { STORAGE = 2, LOSS = 3, STORAGE_LAW = 4, LOSS_LAW = 5, FREQUENCY = 6 };

static bool has_kraus_law(const figure_drawing *d)
{
    for (size_t row = 0; row < d->table->n_rows; row++)
        if (!isnan(payne_sweep_get(d->table, row, PAYNE_SWEEP_STORAGE_KRAUS)))
            return true;
    return false;
}

/* Plots the points of a panel and the law of Kraus. Several frequencies are distinguished by
 * colour. */
static void plot_strain_points(figure_drawing *d, int column, int law, int style, const char *title)
{
    const bool coloured = d->colour.high > d->colour.low;
    char colour[32] = "";
    if (coloured)
        (void)snprintf(colour, sizeof colour, ":($%d*cb_unit)", FREQUENCY);
    if (has_kraus_law(d))
        plot_item(d, d->data[0], "($1*x_unit):($%d*y_unit) with lines ls 11 title 'law of Kraus'",
                  law);
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
    plot_strain_points(d, STORAGE, STORAGE_LAW, 51, storage);
    plot_fraction_mark(d, PAYNE_STRAIN_TENTH, 0.9, "a tenth lost");
    plot_fraction_mark(d, PAYNE_STRAIN_HALF, 0.5, "half lost");
    plot_end(d);
    drawing_axis(d, "y", &d->figure->y[1], NULL, d->y[1]);
    plot_strain_points(d, LOSS, LOSS_LAW, 52, loss);
    drawing_colours(d, "points ls 51"); /* for both panels; the key of this panel has free space */
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

static void caption_payne(figure_drawing *d)
{
    const table_view *sweeps = &d->tables->payne;
    size_t without = 0, half = 0;
    for (size_t row = 0; row < sweeps->n_rows; row++) {
        without += isnan(payne_get(sweeps, row, PAYNE_STORAGE_0)) ? 1 : 0;
        half += isnan(payne_get(sweeps, row, PAYNE_STRAIN_HALF)) ? 1 : 0;
    }
    const size_t n = wt_table_block(d->table->table, d->table->n_rows - 1) + 1;
    text_format(&d->caption, n == 1 ? " %zu strain sweep." : " %zu strain sweeps.", n);
    if (without > 0)
        text_format(&d->caption, " Without a law of Kraus: %zu.", without);
    if (half > 0)
        text_format(&d->caption, " In which half of the storage modulus is not lost: %zu.", half);
}

const figure_description figures_payne[] = {
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
                CURVE(PAYNE_SWEEP_LOSS_MODULUS, OWN, .panel = 1),
                CURVE(PAYNE_SWEEP_STORAGE_KRAUS, DATA), CURVE(PAYNE_SWEEP_LOSS_KRAUS, DATA)},
     .empty_reason = "no modulus above zero at any amplitude",
     .caption_text =
         "Storage modulus and, below, loss modulus against the amplitude of strain, with the "
         "law of Kraus (lines) and the amplitudes at which a tenth and half of the storage "
         "modulus are lost. A filled rubber falls between two plateaus, and the loss modulus "
         "has its maximum where half of that fall is reached.",
     .draw = draw_payne,
     .caption = caption_payne},
    {.name = NULL},
};
