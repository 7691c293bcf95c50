/* Figures of the sliding contact: power spectrum, friction, contact area, length scales.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

#include "core/base/array.h"

#include <math.h>

static void caption_spectrum(figure_drawing *d)
{
    text_format(&d->caption, " Root-mean-square height %s. Root-mean-square slope %s.",
                VALUE(WT_Q_LENGTH, NULL, roughness_value(d->table, ROUGHNESS_KEY_RMS_HEIGHT).value),
                VALUE(WT_Q_NONE, "1", roughness_value(d->table, ROUGHNESS_KEY_RMS_SLOPE).value));
}

/* ---- friction against velocity --------------------------------------------------------------- */

static void prepare_friction(figure_drawing *d)
{
    value_span total = EMPTY_SPAN;
    span_add_column(&total, d->table, FRICTION_TOTAL, false);
    if (span_is_empty(&total))
        d->y_label = "Hysteresis friction coefficient";
    span_add(&d->y[0], 0, false);
    span_add(&d->y[0], 1.1 * d->y[0].high, false); // margin for the bands
}

/* Returns the largest numerical error relative to its value; NaN if no error is available. */
static double largest_error(const table_view *friction)
{
    double largest = (double)NAN;
    for (size_t row = 0; row < friction->n_rows; row++)
        largest =
            fmax(largest, fabs(friction_get(friction, row, FRICTION_HYSTERESIS_NUMERICAL_ERROR) /
                               friction_get(friction, row, FRICTION_HYSTERESIS)));
    return largest;
}

static void caption_friction_curves(figure_drawing *d)
{
    value_span layer = EMPTY_SPAN, share = EMPTY_SPAN;
    const char *includes = friction_key_text(d->table, FRICTION_KEY_ERROR_INCLUDES);
    span_add_column(&layer, d->table, FRICTION_WITH_LAYER, false);
    span_add_column(&share, d->table, FRICTION_EXTRAPOLATED_SHARE, false);

    if (includes != NULL && includes[0] != '\0')
        text_format(&d->caption, " (from %s)", includes);
    text_add(&d->caption, ".");
    if (!span_is_empty(&layer)) {
        wt_estimate thickness = friction_value(d->table, FRICTION_KEY_LAYER_THICKNESS);
        text_add(&d->caption, " Dashed: with the modified layer on the surface");
        if (!isnan(thickness.value))
            text_format(&d->caption, ", thickness %s", ESTIMATE(&thickness));
        text_add(&d->caption, ".");
    }
    text_format(
        &d->caption, " Conditions: nominal pressure %s, temperature %s",
        VALUE(WT_Q_PRESSURE, NULL, friction_value(d->table, FRICTION_KEY_PRESSURE).value),
        VALUE(WT_Q_TEMPERATURE, NULL, friction_value(d->table, FRICTION_KEY_TEMPERATURE).value));
    const double least = 1e-3; /* a smaller share is reported as "less than" */
    double shear = friction_value(d->table, FRICTION_KEY_SHEAR_STRESS).value;
    if (isfinite(shear))
        text_format(&d->caption, ", shear stress of the real contact %s",
                    VALUE(WT_Q_PRESSURE, NULL, shear));
    text_add(&d->caption, ".");
    double numerical = largest_error(d->table);
    if (isfinite(numerical))
        text_format(&d->caption,
                    " Largest numerical error of the hysteresis part: %s %%, not in the bands.",
                    NUMBER(100 * numerical, 2));
    if (!span_is_empty(&share) && share.high > 0)
        text_format(&d->caption,
                    " %s %s %% of the hysteresis part comes from frequencies outside the measured "
                    "ones.",
                    share.high < least ? "Less than" : "Up to",
                    NUMBER(100 * fmax(share.high, least), share.high < least ? 1 : 2));
}

/* ---- softening with strain ------------------------------------------------------------------- */

static void caption_softening(figure_drawing *d)
{
    text_format(&d->caption, " Softening: %s. Largest strain met: %s. %s.",
                softening_key_text(d->table, SOFTENING_KEY_SOURCE),
                NUMBER(softening_value(d->table, SOFTENING_KEY_STRAIN).value, 2),
                softening_key_text(d->table, SOFTENING_KEY_EFFECT));
}

/* ---- flash temperature ----------------------------------------------------------------------- */

static void caption_flash(figure_drawing *d)
{
    const char *none = flash_key_text(d->table, FLASH_KEY_UNSETTLED);
    text_format(&d->caption, " Surroundings at %s; %s.",
                VALUE(WT_Q_TEMPERATURE, NULL, flash_value(d->table, FLASH_KEY_SURROUNDINGS).value),
                flash_key_text(d->table, FLASH_KEY_EFFECT));
    if (none != NULL)
        text_format(&d->caption, " Without one: %s.", none);
}

static void caption_contact_area(figure_drawing *d)
{
    value_span isotropic = EMPTY_SPAN;
    span_add_column(&isotropic, d->table, CONTACT_AREA_ISOTROPIC, true);
    if (!span_is_empty(&isotropic))
        text_add(&d->caption, " Solid: transversely isotropic rubber. Dashed: the isotropic one.");
}

/* ---- directions ------------------------------------------------------------------------------ */

static void draw_transverse_isotropy(figure_drawing *d)
{
    static const struct {
        const char *factors, *title;
        int style;
    } factor_sets[] = {{"none", "isotropic", 23},
                       {"loss", "factors on E″ alone", 22},
                       {"storage", "factors on E′ alone", 21},
                       {"both", "both", 24}};
    static const struct {
        transverse_isotropy_column column;
        const char *label;
    } panels[] = {{TRANSVERSE_ISOTROPY_HYSTERESIS, "Hysteresis friction coefficient"},
                  {TRANSVERSE_ISOTROPY_AREA_RATIO, "Real over nominal contact area"}};
    static const unsigned columns[] = {TRANSVERSE_ISOTROPY_VELOCITY, TRANSVERSE_ISOTROPY_HYSTERESIS,
                                       TRANSVERSE_ISOTROPY_AREA_RATIO};
    const schema_field *field = d->table->schema->columns;
    int section[COUNT_OF(factor_sets)];
    value_span velocity = EMPTY_SPAN, friction = EMPTY_SPAN;
    span_add_column(&velocity, d->table, TRANSVERSE_ISOTROPY_VELOCITY, true);
    span_add_column(&friction, d->table, TRANSVERSE_ISOTROPY_HYSTERESIS, false);
    if (span_is_empty(&velocity) || span_is_empty(&friction))
        return;
    d->height = 1.5;
    text_add(&d->script, "set multiplot layout 2,1\n");
    for (size_t k = 0; k < COUNT_OF(factor_sets); k++) {
        const row_filter rows = {
            {TRANSVERSE_ISOTROPY_FACTORS, 0}, {factor_sets[k].factors, NULL}, NULL};
        section[k] = drawing_section(d, d->table, factor_sets[k].factors, &rows, columns, 3, 3);
    }
    axis_log(d, AXIS_X, "Sliding velocity", &field[TRANSVERSE_ISOTROPY_VELOCITY], velocity);
    for (size_t p = 0; p < COUNT_OF(panels); p++) {
        value_span span = EMPTY_SPAN;
        span_add(&span, 0, false);
        span_add_column(&span, d->table, panels[p].column, false);
        axis_linear(d, AXIS_Y, panels[p].label, &field[panels[p].column], span);
        for (size_t k = 0; k < COUNT_OF(factor_sets); k++)
            plot_item(d, section[k], "($1*x_unit):($%zu*y_unit) with lines ls %d title '%s'", p + 2,
                      factor_sets[k].style, factor_sets[k].title);
        plot_end(d);
        text_add(&d->script, "unset key\n");
    }
    text_add(&d->script, "unset multiplot\n");
}

/* ---- decades --------------------------------------------------------------------------------- */

/* The table has at most three velocities, one block each. */
enum { MAX_VELOCITIES = 3 };

static size_t list_velocities(const table_view *table, double velocity[MAX_VELOCITIES])
{
    size_t n = 0;
    for (size_t row = 0; row < table->n_rows; row++) {
        const double v = friction_decades_get(table, row, FRICTION_DECADES_VELOCITY);
        if ((n == 0 || v != velocity[n - 1]) && n < MAX_VELOCITIES)
            velocity[n++] = v;
    }
    return n;
}

static void draw_decades(figure_drawing *d)
{
    static const unsigned columns[] = {FRICTION_DECADES_FROM, FRICTION_DECADES_TO,
                                       FRICTION_DECADES_HYSTERESIS, FRICTION_DECADES_VELOCITY};
    const schema_field *field = d->table->schema->columns;
    double velocity[MAX_VELOCITIES];
    value_span x = EMPTY_SPAN, y = EMPTY_SPAN;
    const size_t n = list_velocities(d->table, velocity);
    const int section = drawing_section(d, d->table, "decades", NULL, columns, COUNT_OF(columns),
                                        COUNT_OF(columns));
    if (section < 0)
        return;
    span_add_section(&x, d, section, 0, true);
    span_add_section(&x, d, section, 1, true);
    span_add(&y, 0, false);
    span_add_section(&y, d, section, 2, false);
    axis_log(d, AXIS_X, "Wavenumber q", &field[FRICTION_DECADES_FROM], x);
    axis_linear(d, AXIS_Y, "Hysteresis friction by the decade", &field[FRICTION_DECADES_HYSTERESIS],
                y);
    for (size_t k = 0; k < n; k++) {
        char title[48];
        wt_format_si(velocity[k], "m/s", 2, title, sizeof title);
        /* bars within a decade: from the first velocity on the left to the last on the right */
        plot_item(
            d, section,
            "(column(-1) == %zu ? sqrt($1*$2)*x_unit : NaN):($3/2):"
            "($1*($2/$1)**%.3f*x_unit):($1*($2/$1)**%.3f*x_unit):(0):3 with boxxyerror ls %zu "
            "fs solid 0.8 noborder",
            k, ((double)k + 0.1) / (double)n, ((double)k + 0.9) / (double)n, 21 + k);
        plot_title(d, title);
    }
    plot_end(d);
}

static void caption_decades(figure_drawing *d)
{
    text_format(&d->caption, " The most: %s.",
                friction_decades_key_text(d->table, FRICTION_DECADES_KEY_STRONGEST));
}

const figure_description figures_friction[] = {
    {.name = "power_spectrum",
     .in_depth = true,
     .title = "Power spectrum of the counter surface",
     .table = &roughness_schema,
     .data_title = "power spectrum",
     .x = {ROUGHNESS_WAVENUMBER, AXIS_LOG, "Wavenumber q"},
     .y = {{ROUGHNESS_DENSITY, AXIS_LOG, "Power spectrum C(q)"}},
     .curves = {CURVE(ROUGHNESS_DENSITY, LINE, .style = 21)},
     .empty_reason = "no density above zero",
     .caption_text =
         "Power spectrum of the counter surface over the wavenumbers that enter the friction.",
     .caption = caption_spectrum},
    {.name = "friction",
     .title = "Friction against sliding velocity",
     .table = &friction_schema,
     .data_title = "friction",
     .x = {FRICTION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{FRICTION_TOTAL, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(FRICTION_TOTAL, LINE, .style = 21, .title = "total", .band = 71),
                CURVE(FRICTION_HYSTERESIS, LINE, .style = 22, .title = "hysteresis", .band = 72),
                CURVE(FRICTION_ADHESION, LINE, .style = 23, .title = "shearing"),
                CURVE(FRICTION_WITH_LAYER, LINE, .style = 24, .title = "total with layer",
                      .band = 74)},
     .empty_reason = "no friction coefficient is a number",
     .caption_text =
         "Friction coefficient and its parts against sliding velocity. Bands: 95 % interval",
     .prepare = prepare_friction,
     .caption = caption_friction_curves},
    {
        .name = "contact_area",
        .in_depth = true,
        .title = "Real contact area against magnification",
        .table = &contact_area_schema,
        .data_title = "area_ratio",
        .x = {CONTACT_AREA_MAGNIFICATION, AXIS_LOG, "Magnification ζ = q/q₀"},
        .y = {{CONTACT_AREA_AREA_RATIO, AXIS_LOG, "Contact area A/A₀"}},
        .colour = {CONTACT_AREA_VELOCITY, AXIS_LOG, "Sliding velocity"},
        .curves = {CURVE(CONTACT_AREA_AREA_RATIO, LINE, .style = 21),
                   CURVE(CONTACT_AREA_ISOTROPIC, LINE, .style = 24, .dashed = true)},
        .empty_reason = "no number to draw",
        .caption_text =
            "Share of the nominal contact area that is in contact when roughness up to the "
            "magnification is seen; one line for each sliding velocity.",
        .caption = caption_contact_area,
    },
    {
        .name = "friction_scales",
        .in_depth = true,
        .title = "Which length scales make the friction",
        .table = &contact_area_schema,
        .data_title = "hysteresis",
        .x = {CONTACT_AREA_MAGNIFICATION, AXIS_LOG, "Magnification ζ = q/q₀"},
        .y = {{CONTACT_AREA_HYSTERESIS, AXIS_FROM_ZERO, "Hysteresis friction up to ζ"}},
        .colour = {CONTACT_AREA_VELOCITY, AXIS_LOG, "Sliding velocity"},
        .curves = {CURVE(CONTACT_AREA_HYSTERESIS, LINE, .style = 21)},
        .empty_reason = "no number to draw",
        .caption_text =
            "Hysteresis part of the friction coefficient from roughness up to the magnification: "
            "where a line rises, those length scales make the friction. A line that still rises "
            "at its right end depends on the upper cut-off of the spectrum.",
    },
    {.name = "transverse_isotropy",
     .title = "What the directions of the material do",
     .table = &transverse_isotropy_schema,
     .empty_reason = "no friction of the material with its directions",
     .caption_text =
         "Hysteresis friction and contact area of the transversely isotropic material against "
         "velocity: with its factors on the moduli, with those on one modulus alone and as "
         "the isotropic material.",
     .draw = draw_transverse_isotropy},
    {.name = "softening",
     .title = "What softening with strain does",
     .table = &softening_schema,
     .data_title = "hysteresis",
     .x = {SOFTENING_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{SOFTENING_HYSTERESIS, AXIS_FROM_ZERO, "Hysteresis friction coefficient"}},
     .curves = {CURVE(SOFTENING_HYSTERESIS, LINE, .style = 21,
                      .title = "moduli soften with strain"),
                CURVE(SOFTENING_HYSTERESIS_WITHOUT, LINE, .style = 24,
                      .title = "moduli at small strain")},
     .empty_reason = "no hysteresis friction is a number",
     .caption_text =
         "Hysteresis part of the friction coefficient against sliding velocity with the moduli "
         "that soften with strain, and with those at small strain. The strain at a length "
         "scale is taken from the rms slope of the roughness down to it.",
     .caption = caption_softening},
    {.name = "flash_temperature",
     .title = "Flash temperature",
     .table = &flash_schema,
     .data_title = "temperature",
     .x = {FLASH_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{FLASH_TEMPERATURE, AXIS_LINEAR, "Temperature at the finest scale"}},
     .curves = {CURVE(FLASH_TEMPERATURE, LINE, .style = 21)},
     .empty_reason = "no temperature is a number",
     .caption_text = "Temperature of the rubber at the finest scale of the contact against sliding "
                     "velocity: the heat of friction at every length scale warms it there.",
     .caption = caption_flash},
    {.name = "flash_friction",
     .title = "What the flash temperature does to friction",
     .table = &flash_schema,
     .data_title = "hysteresis",
     .x = {FLASH_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{FLASH_HYSTERESIS, AXIS_FROM_ZERO, "Hysteresis friction coefficient"}},
     .curves = {CURVE(FLASH_HYSTERESIS, LINE, .style = 21, .title = "with flash temperature"),
                CURVE(FLASH_HYSTERESIS_WITHOUT, LINE, .style = 23,
                      .title = "as warm as the surroundings")},
     .empty_reason = "no hysteresis friction is a number",
     .caption_text =
         "Hysteresis part of the friction coefficient against sliding velocity with flash "
         "temperatures, and with rubber at the temperature of its surroundings.",
     .caption = caption_flash},
    {.name = "friction_decades",
     .title = "Which decades of the wavenumber make the friction",
     .table = &friction_decades_schema,
     .empty_reason = "no hysteresis friction of a decade is a number",
     .caption_text =
         "Contribution of the roughness of each decade of the wavenumber to the hysteresis "
         "friction coefficient, at the slowest, the reference and the fastest velocity. The "
         "first and the last decade may be cut by the ends of the power spectrum.",
     .draw = draw_decades,
     .caption = caption_decades},
    {.name = NULL},
};
