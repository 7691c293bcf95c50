/* Figures of isotherms and of the master curve, and the superposition plot without a
 * frequency axis.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"

#include <math.h>
#include <string.h>

/* ---- quantities computed from both moduli ---------------------------------------------------- */

static double loss_factor_value(double storage, double loss)
{
    return storage > 0 ? loss / storage : (double)NAN;
}

static double modulus_magnitude(double storage, double loss)
{
    return hypot(storage, loss);
}

static double phase_angle_degrees(double storage, double loss)
{
    return atan2(loss, storage) * (180 / M_PI);
}

/* A quantity with its name in the gnuplot script and the C function that sets the axis limits. */
typedef struct derived_quantity {
    const char *name;
    double (*compute)(double storage, double loss);
    axis_scale scale;
    bool is_modulus;
    const char *label, *suffix; /* for a modulus: text before and after its letter */
} derived_quantity;

static const derived_quantity loss_ratio = {"ratio", loss_factor_value, AXIS_LOG,
                                            false,   "tan δ",           ""},
                              size_log = {"size", modulus_magnitude, AXIS_LOG, true, "|", "*|"},
                              angle = {"angle", phase_angle_degrees, AXIS_FROM_ZERO, false, "δ (°)",
                                       ""};

/* Data columns that all figures of the master curve share; column 0 is the frequency. */
enum { STORAGE = 1, TEMPERATURE = 3, FITTED = 4 };

static void define_derived_quantities(figure_drawing *d)
{
    text_add(&d->script, "ratio(s, l) = s > 0 ? l/s : NaN\n"
                         "size(s, l) = sqrt(s**2 + l**2)\nangle(s, l) = atan2(l, s)*180/pi\n");
}

static char drawn_modulus_letter(const figure_drawing *d)
{
    return modulus_letter(master_curve_key_enum(d->table, MASTER_CURVE_KEY_DEFORMATION));
}

static void derived_quantity_axis(figure_drawing *d, drawing_axis_id axis,
                                  const derived_quantity *c)
{
    static const schema_field number = {.quantity = WT_Q_NONE};
    const schema_field *column =
        c->is_modulus ? &master_curve_schema.columns[MASTER_CURVE_STORAGE_MODULUS] : &number;
    const char letter[2] = {c->is_modulus ? drawn_modulus_letter(d) : '\0', '\0'};
    const wt_table *data = d->sections[d->data[0]];
    value_span span = EMPTY_SPAN;
    char label[64];
    (void)snprintf(label, sizeof label, "%s%s%s", c->label, letter, c->suffix);
    for (size_t row = 0; row < wt_table_n_rows(data); row++)
        span_add(&span,
                 c->compute(wt_table_number(data, row, STORAGE),
                            wt_table_number(data, row, STORAGE + 1)),
                 c->scale == AXIS_LOG);
    if (span_is_empty(&span))
        span = (value_span){1, 1};
    if (c->scale == AXIS_LOG) {
        axis_log(d, axis, label, column, span);
    } else {
        span_add(&span, 0, false);
        axis_linear(d, axis, label, column, span);
    }
}

/* ---- isotherms and master curve -------------------------------------------------------------- */

/* Points have the colour of their temperature of measurement in all figures. */
static void plot_measured_points(figure_drawing *d, const char *using, const char *with)
{
    const bool coloured = !span_is_empty(&d->colour);
    plot_item(d, d->data[0], "%s%s with %s %s notitle", using, coloured ? ":($4+cb_offset)" : "",
              with, coloured ? "lc palette" : "lc rgb 'black'");
}

/* Plots the interval of the fit. The data columns are value, lower limit and upper limit. */
static void plot_fit_interval(figure_drawing *d, size_t column, const char *unit, const char *title)
{
    plot_item(d, d->data[0], "($1*x_unit):($%zu*%s):($%zu*%s) with filledcurves ls 61", column + 1,
              unit, column + 2, unit);
    plot_key(d, title);
}

static const char spectrum_title[] = "one spectrum", interval_title[] = "95 % interval";

/* Labels the axis with the reference temperature. */
static void reduced_axis(figure_drawing *d)
{
    char label[DRAWING_LABEL];
    drawing_temperature_label(
        label, d->figure->x.label,
        master_curve_value(d->table, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value);
    drawing_axis(d, AXIS_X, &d->figure->x, label, d->x);
}

static void plot_fit_line(figure_drawing *d, size_t column, const char *unit, const char *title)
{
    plot_item(d, d->data[0], "($1*x_unit):($%zu*%s) with lines ls 11", column, unit);
    plot_key(d, title);
}

/* Plot styles of the two moduli. */
typedef struct curve_style {
    const char *storage, *loss;
} curve_style;

static void plot_moduli(figure_drawing *d, bool fitted, curve_style with)
{
    const char letter = drawn_modulus_letter(d);
    if (fitted) {
        plot_fit_interval(d, FITTED + 1, "y_unit", interval_title);
        plot_fit_interval(d, FITTED + 4, "y_unit", NULL);
    }
    plot_measured_points(d, "($1*x_unit):($2*y_unit)", with.storage);
    plot_measured_points(d, "($1*x_unit):($3*y_unit)", with.loss);
    plot_expression(d, "keyentry with %s lc rgb '#111111' title '%c′'", with.storage, letter);
    plot_expression(d, "keyentry with %s lc rgb '#111111' title '%c″'", with.loss, letter);
    if (fitted) {
        plot_fit_line(d, FITTED + 1, "y_unit", spectrum_title);
        plot_fit_line(d, FITTED + 4, "y_unit", NULL);
    }
    plot_end(d);
}

/* The upper panel shows the moduli, the lower panel tan delta. */
static void draw_frequency_panels(figure_drawing *d, bool fitted, curve_style with)
{
    char label[64];
    if (!drawing_build_data(d))
        return;
    (void)snprintf(label, sizeof label, "%c′, %c″", drawn_modulus_letter(d),
                   drawn_modulus_letter(d));
    d->width = 1.15;
    d->height = 1.6;
    define_derived_quantities(d);
    text_add(&d->script, "set multiplot layout 2,1\n");
    if (fitted)
        reduced_axis(d);
    else
        drawing_axis(d, AXIS_X, &d->figure->x, NULL, d->x);
    drawing_axis(d, AXIS_Y, &d->figure->y[0], label, d->y[0]);
    if (!span_is_empty(&d->colour))
        drawing_axis(d, AXIS_COLOUR, &d->figure->colour, NULL, d->colour);
    plot_moduli(d, fitted, with);
    derived_quantity_axis(d, AXIS_Y, &loss_ratio);
    text_add(&d->script, "unset key\nunset colorbox\n");
    if (fitted)
        plot_fit_interval(d, FITTED + 7, "1", NULL);
    plot_measured_points(d, "($1*x_unit):(ratio($2,$3))", with.storage);
    if (fitted)
        plot_fit_line(d, FITTED + 7, "1", NULL);
    plot_end(d);
    text_add(&d->script, "unset multiplot\n");
}

static size_t count_isotherms(const figure_drawing *d)
{
    return wt_table_block(d->table->table, d->table->n_rows - 1) + 1;
}

/* Joins the points by lines. Dense isotherms are drawn as lines without points. */
static void draw_isotherms(figure_drawing *d)
{
    enum { MANY = 25 };
    static const curve_style few = {"linespoints ls 51", "linespoints ls 52"},
                             many = {"lines ls 51", "lines ls 52 dt (5,3)"};
    draw_frequency_panels(d, false, d->table->n_rows > MANY * count_isotherms(d) ? many : few);
}

static void draw_master_curve(figure_drawing *d)
{
    draw_frequency_panels(d, true, (curve_style){"points ls 51", "points ls 52"});
}

static void caption_isotherms(figure_drawing *d)
{
    text_format(
        &d->caption,
        " %zu %s. Curves that superposition can join have the same shape and are displaced "
        "along the axis. Where a curve crosses its neighbours, check the sample, the clamping "
        "and the oven first.",
        count_isotherms(d), count_isotherms(d) == 1 ? "isotherm" : "isotherms");
}

static void caption_master_curve(figure_drawing *d)
{
    const double reference =
        master_curve_value(d->table, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value;
    const size_t n = d->table->n_rows, terms = d->tables->prony.n_rows;
    value_span fit = EMPTY_SPAN;

    if (isfinite(reference))
        text_format(&d->caption, " of %s", VALUE(WT_Q_TEMPERATURE, NULL, reference));
    text_format(&d->caption,
                ", and tan δ below; %zu points of %zu %s, coloured by the temperature of "
                "the measurement.",
                n, count_isotherms(d), count_isotherms(d) == 1 ? "isotherm" : "isotherms");
    span_add_column(&fit, d->table, MASTER_CURVE_FITTED_STORAGE, true);
    if (span_is_empty(&fit))
        return;
    if (terms > 0)
        text_format(&d->caption, " Lines: one relaxation spectrum of %zu terms behind both moduli.",
                    terms);
    text_add(&d->caption, " Grey: its 95 % interval, mostly narrower than the line. In a good "
                          "master curve the points of all temperatures lie on one line without "
                          "steps.");
}

/* ---- step experiments ------------------------------------------------------------------------ */

static void draw_step(figure_drawing *d, bool fitted)
{
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    if (fitted)
        reduced_axis(d);
    if (!span_is_empty(&d->colour) && d->n_colours == 0)
        drawing_axis(d, AXIS_COLOUR, &d->figure->colour, NULL, d->colour);
    if (fitted)
        plot_fit_interval(d, FITTED + 1, "y_unit", interval_title);
    plot_measured_points(d, "($1*x_unit):($2*y_unit)", "points ls 51");
    drawing_colours(d, "points ls 51");
    if (fitted)
        plot_fit_line(d, FITTED + 1, "y_unit", spectrum_title);
    plot_end(d);
}

static void draw_step_isotherms(figure_drawing *d)
{
    draw_step(d, false);
}

static void draw_step_master_curve(figure_drawing *d)
{
    draw_step(d, true);
}

static void caption_step_master_curve(figure_drawing *d)
{
    const double reference =
        master_curve_value(d->table, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value;
    if (isfinite(reference))
        text_format(&d->caption, " of %s", VALUE(WT_Q_TEMPERATURE, NULL, reference));
    text_format(&d->caption,
                "; %zu points of %zu %s, coloured by the temperature of the measurement. "
                "Line: one relaxation spectrum behind them; grey: its 95 %% interval.",
                d->table->n_rows, count_isotherms(d),
                count_isotherms(d) == 1 ? "isotherm" : "isotherms");
}

/* ---- superposition without a frequency ------------------------------------------------------- */

static void draw_van_gurp_palmen(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    d->width = 1.15;
    define_derived_quantities(d);
    derived_quantity_axis(d, AXIS_X, &size_log);
    derived_quantity_axis(d, AXIS_Y, &angle);
    if (!span_is_empty(&d->colour))
        drawing_axis(d, AXIS_COLOUR, &d->figure->colour, NULL, d->colour);
    plot_measured_points(d, "(size($2,$3)*x_unit):(angle($2,$3)*y_unit)", "points ls 51");
    plot_item(d, d->data[0],
              "(size($5,$6)*x_unit):(angle($5,$6)*y_unit) with lines ls 11 title '%s'",
              spectrum_title);
    plot_end(d);
}

/* ---- descriptions ---------------------------------------------------------------------------- */

/* Figures of step experiments. Without step data no message about missing data is printed. */
#define STEP_MASTER_FIGURE(id, heading, quantity, label, OWN_VALUE)                                \
    {                                                                                              \
        .name = id, .title = heading, .table = &master_curve_schema, .data_title = heading,        \
        .x = {MASTER_CURVE_TIME, AXIS_LOG, "Reduced time"},                                        \
        .y = {{MASTER_CURVE_##quantity, AXIS_LOG, label}},                                         \
        .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},                          \
        .curves = {CURVE(MASTER_CURVE_##quantity, OWN), CURVE(OWN_VALUE, DATA),                    \
                   CURVE(MASTER_CURVE_TEMPERATURE, DATA),                                          \
                   CURVE(FITTED_OF_##quantity, DATA, .with_errors = true)},                        \
        .caption_text = label " shifted to the reference temperature",                             \
        .draw = draw_step_master_curve, .caption = caption_step_master_curve                       \
    }
#define STEP_ISOTHERM_FIGURE(id, heading, quantity, label, OWN_VALUE)                              \
    {                                                                                              \
        .name = id, .title = heading, .table = &master_curve_schema, .data_title = heading,        \
        .x = {MASTER_CURVE_OWN_TIME, AXIS_LOG, "Time"}, .y = {{OWN_VALUE, AXIS_LOG, label}},       \
        .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},                          \
        .curves = {CURVE(OWN_VALUE, OWN), CURVE(MASTER_CURVE_##quantity, DATA),                    \
                   CURVE(MASTER_CURVE_TEMPERATURE, DATA)},                                         \
        .caption_text =                                                                            \
            label " of each isotherm before any shift; colours as in the master curve.",           \
        .draw = draw_step_isotherms, .caption = caption_isotherms                                  \
    }
#define FITTED_OF_RELAXATION_MODULUS MASTER_CURVE_FITTED_RELAXATION
#define FITTED_OF_CREEP_COMPLIANCE MASTER_CURVE_FITTED_CREEP

const figure_description figures_master[] = {
    {.name = "isotherms",
     .in_depth = true,
     .title = "Isotherms before shifting",
     .table = &master_curve_schema,
     .data_title = "isotherms",
     .x = {MASTER_CURVE_OWN_FREQUENCY, AXIS_LOG, "Angular frequency"},
     .y = {{MASTER_CURVE_OWN_STORAGE, AXIS_LOG, "Storage and loss modulus"}},
     .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .curves = {CURVE(MASTER_CURVE_OWN_STORAGE, OWN), CURVE(MASTER_CURVE_OWN_LOSS, OWN),
                CURVE(MASTER_CURVE_TEMPERATURE, DATA)},
     .empty_reason = "there are no positive oscillatory moduli; step tests have a figure "
                     "against time",
     .caption_text =
         "Storage and loss modulus at the temperature of each isotherm, and tan δ below, before "
         "any shift; the colours are those of the master curve.",
     .draw = draw_isotherms,
     .caption = caption_isotherms},
    {.name = "master_curve",
     .title = "Master curve",
     .table = &master_curve_schema,
     .other_tables = "prony",
     .data_title = "master curve",
     .x = {MASTER_CURVE_ANGULAR_FREQUENCY, AXIS_LOG, "Reduced angular frequency"},
     .y = {{MASTER_CURVE_STORAGE_MODULUS, AXIS_LOG, "Storage and loss modulus"}},
     .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .curves = {CURVE(MASTER_CURVE_STORAGE_MODULUS, OWN), CURVE(MASTER_CURVE_LOSS_MODULUS, OWN),
                CURVE(MASTER_CURVE_TEMPERATURE, DATA),
                CURVE(MASTER_CURVE_FITTED_STORAGE, DATA, .with_errors = true),
                CURVE(MASTER_CURVE_FITTED_LOSS, DATA, .with_errors = true),
                CURVE(MASTER_CURVE_FITTED_LOSS_FACTOR, DATA, .with_errors = true)},
     .empty_reason = "there are no positive oscillatory moduli; step tests have a figure "
                     "against time",
     .caption_text = "Storage and loss modulus shifted to the reference temperature",
     .draw = draw_master_curve,
     .caption = caption_master_curve},
    STEP_ISOTHERM_FIGURE("relaxation_isotherms", "Relaxation before shifting", RELAXATION_MODULUS,
                         "Relaxation modulus", MASTER_CURVE_OWN_RELAXATION),
    STEP_MASTER_FIGURE("relaxation", "Master curve of relaxation", RELAXATION_MODULUS,
                       "Relaxation modulus", MASTER_CURVE_OWN_RELAXATION),
    STEP_ISOTHERM_FIGURE("creep_isotherms", "Creep before shifting", CREEP_COMPLIANCE,
                         "Creep compliance", MASTER_CURVE_OWN_CREEP),
    STEP_MASTER_FIGURE("creep", "Master curve of creep", CREEP_COMPLIANCE, "Creep compliance",
                       MASTER_CURVE_OWN_CREEP),
    {.name = "shift_factors",
     .title = "Shift factors",
     .table = &shift_factors_schema,
     .data_title = "shift factors",
     .x = {SHIFT_FACTORS_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{SHIFT_FACTORS_LOG_A, AXIS_NUMBER, "Shift factor, log₁₀ a_T"},
           {SHIFT_FACTORS_LAW_LOG_A, AXIS_NUMBER, "Residual, log₁₀ a_T"}},
     .curves = {CURVE(SHIFT_FACTORS_LOG_A, OWN, .with_errors = true),
                CURVE(SHIFT_FACTORS_DETERMINED, DATA), CURVE(SHIFT_FACTORS_LAW_LOG_A, OWN),
                CURVE(SHIFT_FACTORS_LAW_LOG_A_LOW, DATA),
                CURVE(SHIFT_FACTORS_LAW_LOG_A_HIGH, DATA)},
     .empty_reason = "no shift factor is known",
     .caption_text =
         "Horizontal shift factors with their 95 % interval (bars; smaller than the symbol "
         "where not seen).",
     .draw = draw_shift_factors,
     .caption = caption_shift_factors},
    {.name = "vertical_shifts",
     .in_depth = true,
     .title = "Vertical shift factors",
     .table = &shift_factors_schema,
     .data_title = "vertical shift factors",
     .x = {SHIFT_FACTORS_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .y = {{SHIFT_FACTORS_LOG_B, AXIS_NUMBER, "Shift factor, log₁₀ b_T"}},
     .curves = {CURVE(SHIFT_FACTORS_LOG_B, OWN, .with_errors = true),
                CURVE(SHIFT_FACTORS_LOG_B_PHYSICAL, OWN), CURVE(SHIFT_FACTORS_LOG_B_MATERIAL, OWN)},
     .empty_reason = "there is no vertical shift",
     .caption_text =
         "Vertical shift factors of the isotherms with their 95 % interval, their smooth part, "
         "which is treated as a property of the material, and the factors that density and "
         "temperature alone would give.",
     .draw = draw_vertical_shifts,
     .caption = caption_vertical_shifts},
    {.name = "influences",
     .in_depth = true,
     .title = "Influence of each isotherm",
     .table = &influences_schema,
     .data_title = "influence of each isotherm",
     .x = {INFLUENCES_TEMPERATURE, AXIS_LINEAR, "Temperature of the isotherm left out"},
     .y = {{INFLUENCES_CHANGE, AXIS_NUMBER, "Largest change of log₁₀ a_T"}},
     .curves = {CURVE(INFLUENCES_CHANGE, OWN), CURVE(INFLUENCES_INTERVAL, DATA)},
     .empty_reason = "no shift is known without one of the isotherms",
     .caption_text =
         "Largest change of a horizontal shift if one isotherm is left out, with the half width of "
         "the 95 % interval of that shift. A bar above its mark: the isotherm moves another one by "
         "more than the interval says; measure it again.",
     .draw = draw_influences},
    {.name = "van_gurp_palmen",
     .in_depth = true,
     .title = "Superposition: van Gurp-Palmen plot",
     .table = &master_curve_schema,
     .data_title = "master curve",
     .x = {MASTER_CURVE_ANGULAR_FREQUENCY, AXIS_LOG, "Reduced angular frequency"},
     .y = {{MASTER_CURVE_STORAGE_MODULUS, AXIS_LOG, "Storage modulus"}},
     .colour = {MASTER_CURVE_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .empty_reason = "there are no positive oscillatory moduli; step tests have a figure "
                     "against time",
     .curves = {CURVE(MASTER_CURVE_STORAGE_MODULUS, OWN), CURVE(MASTER_CURVE_LOSS_MODULUS, OWN),
                CURVE(MASTER_CURVE_TEMPERATURE, DATA), CURVE(MASTER_CURVE_FITTED_STORAGE, DATA),
                CURVE(MASTER_CURVE_FITTED_LOSS, DATA)},
     .caption_text =
         "Phase angle against the magnitude of the modulus, shifted vertically only (van "
         "Gurp-Palmen plot): frequency and horizontal shift do not enter. If superposition "
         "holds, the isotherms lie on one line. Where they spread with temperature, no "
         "horizontal shift can join them.",
     .draw = draw_van_gurp_palmen},
    {.name = NULL},
};
