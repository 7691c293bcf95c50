/* Figures of a measured surface: its power spectrum with errors and law, and what of it depends on
 * the direction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include <math.h>

static void caption_measured(figure_drawing *d)
{
    const wt_estimate height = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_RMS_HEIGHT),
                      slope = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_RMS_SLOPE),
                      hurst = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_HURST);
    const double share = power_spectrum_value(d->table, POWER_SPECTRUM_KEY_SHARE).value;
    text_format(&d->caption, " Root-mean-square height %s. Root-mean-square slope %s.",
                ESTIMATE(&height), ESTIMATE(&slope));
    if (isfinite(hurst.value))
        text_format(&d->caption, " Self-affine law: H = %s.", ESTIMATE(&hurst));
    if (isfinite(share))
        text_format(&d->caption,
                    " Beyond the points with bars the spectrum is that of the law: %s %% of the "
                    "squared slope.",
                    NUMBER(100 * share, 2));
}

static void caption_angular(figure_drawing *d)
{
    const double chance = angular_spectrum_value(d->table, ANGULAR_SPECTRUM_KEY_CHANCE).value,
                 fourth =
                     angular_spectrum_value(d->table, ANGULAR_SPECTRUM_KEY_CHANCE_FOURTH).value;
    text_format(&d->caption,
                " Chance that scatter alone makes directions differ as much: %s (half a turn), %s "
                "(a quarter).",
                NUMBER(chance, 2), NUMBER(fourth, 2));
}

const figure_description figures_surface[] = {
    {.name = "measured_spectrum",
     .title = "Power spectrum of a measured surface",
     .table = &power_spectrum_schema,
     .data_title = "measured spectrum",
     .x = {POWER_SPECTRUM_WAVENUMBER, AXIS_LOG, "Wavenumber q"},
     .y = {{POWER_SPECTRUM_DENSITY, AXIS_LOG, "Power spectrum C(q)"}},
     .curves = {CURVE(POWER_SPECTRUM_DENSITY, BARS, .style = 1, .title = "measured",
                      .with_errors = true),
                CURVE(POWER_SPECTRUM_LAW, FIT, .style = 11, .title = "self-affine law")},
     .nothing = "no density above zero",
     .words = "Power spectrum of a surface, means over bins with their 95 % intervals, within the "
              "range where scans are reliable.",
     .caption = caption_measured},
    {.name = "angular_spectrum",
     .title = "Angular spectrum of a measured surface",
     .table = &angular_spectrum_schema,
     .data_title = "angular spectrum",
     .x = {ANGULAR_SPECTRUM_DIRECTION, AXIS_LINEAR, "Direction from x"},
     .y = {{ANGULAR_SPECTRUM_RATIO, AXIS_FROM_ZERO, "C(q) over that of all directions"}},
     .curves = {CURVE(ANGULAR_SPECTRUM_RATIO, BARS, .style = 1, .title = "measured",
                      .with_errors = true),
                CURVE(ANGULAR_SPECTRUM_TERMS, FIT, .style = 11, .title = "two terms")},
     .nothing = "no direction has a density",
     .words = "Power spectrum of a surface by the direction of its waves over that of all "
              "directions, means over the range where scans are reliable with their 95 % "
              "intervals, and its terms cos 2 phi and cos 4 phi.",
     .caption = caption_angular},
    {.name = NULL},
};
