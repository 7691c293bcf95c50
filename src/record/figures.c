/* Figures of friction records: friction against cycle, velocity, load and temperature.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "report/drawing.h"

#include <math.h>

/* Draws the cycles and the mean of the steady state of each step at the end of its running-in. */
static void draw_record(figure_drawing *d)
{
    static const unsigned columns[] = {RECORD_RUNNING_IN, RECORD_FRICTION, RECORD_RUNNING_IN_LOW,
                                       RECORD_RUNNING_IN_HIGH};
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    const int ends = drawing_section(d, &d->tables->record, "end of the running-in", NULL, columns,
                                     COUNT_OF(columns), COUNT_OF(columns));
    drawing_curves(d, 0);
    plot_item(d, ends,
              "($1*x_unit):($2*y_unit):($3*x_unit):($4*x_unit) with xerrorbars ls 2 title "
              "'end of the running-in'");
    plot_end(d);
}

static void caption_record(figure_drawing *d)
{
    const table_view *const steps = &d->tables->record;
    size_t without = 0;
    for (size_t row = 0; row < steps->n_rows; row++)
        without += isnan(record_get(steps, row, RECORD_RUNNING_IN)) ? 1 : 0;
    text_format(&d->caption, " Steps: %zu.", steps->n_rows);
    if (without > 0)
        text_format(&d->caption, " Without an end of the running-in: %zu.", without);
}

/* Uses degrees Celsius, which the description of a curve cannot express. The columns are the value
 * and its interval. */
static void draw_temperature(figure_drawing *d)
{
    if (!drawing_build_data(d))
        return;
    drawing_axes(d);
    plot_item(d, d->data[0], "($1+x_offset):2:4:5 with yerrorbars ls 1 notitle");
    plot_end(d);
}

#define AGAINST(which, column, scale, label, words_)                                               \
    {                                                                                              \
        .name = "record_" which, .title = "Friction as measured, against " which,                  \
        .table = &record_schema, .data_title = "steady part", .x = {column, scale, label},         \
        .needs_several_x = true, .y = {{RECORD_FRICTION, AXIS_NUMBER, "Friction coefficient μ"}},  \
        .curves = {CURVE(RECORD_FRICTION, BARS, .style = 1, .with_errors = true)},                 \
        .caption_text = words_                                                                     \
    }

const figure_description figures_record[] = {
    {.name = "record",
     .title = "Friction as measured",
     .table = &record_cycles_schema,
     .other_tables = "record",
     .data_title = "cycles",
     .x = {RECORD_CYCLES_CYCLE, AXIS_NUMBER, "Cycle"},
     .y = {{RECORD_CYCLES_FRICTION, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(RECORD_CYCLES_FRICTION, LINE, .style = 21, .title = "mean of a cycle")},
     .empty_reason = "no friction coefficient is a number",
     .caption_text =
         "Mean friction coefficient of every cycle, one line for each step of a record. The "
         "marks stand at the end of the running-in, with its interval of 95 %, and at the mean "
         "of the steady part behind it.",
     .draw = draw_record,
     .caption = caption_record},
    AGAINST("velocity", RECORD_VELOCITY, AXIS_LOG, "Sliding velocity",
            "Friction coefficient of the steady part of every step against the velocity of the "
            "step, with its interval of 95 %."),
    AGAINST("load", RECORD_NORMAL_FORCE, AXIS_LINEAR, "Normal force",
            "Friction coefficient of the steady part of every step against the load of the step, "
            "with its interval of 95 %."),
    {.name = "record_temperature",
     .title = "Friction as measured, against temperature",
     .table = &record_schema,
     .data_title = "steady part",
     .x = {RECORD_TEMPERATURE, AXIS_LINEAR, "Temperature"},
     .needs_several_x = true,
     .y = {{RECORD_FRICTION, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(RECORD_FRICTION, OWN, .with_errors = true)},
     .caption_text =
         "Friction coefficient of the steady part of every step against the temperature of the "
         "step, with its interval of 95 %.",
     .draw = draw_temperature},
    {.name = NULL},
};

/* The caption states the subject and the verdict of the key. */
static void caption_verdict(figure_drawing *d)
{
    text_format(&d->caption, " Of %s: %s.", validation_key_text(d->table, VALIDATION_KEY_JUDGED),
                validation_key_text(d->table, VALIDATION_KEY_VERDICT));
}

/* Marks the ratio 1, at which measured and predicted friction agree. */
static void mark_agreement(figure_drawing *d)
{
    span_add(&d->y[0], 1, false);
    text_add(&d->script, "set arrow from graph 0, first 1 to graph 1, first 1 nohead back ls 12\n");
}

const figure_description figures_validation[] = {
    {.name = "validation",
     .title = "Friction, measured and predicted",
     .table = &validation_schema,
     .data_title = "steps of the records",
     .x = {VALIDATION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{VALIDATION_MEASURED, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(VALIDATION_MEASURED, BARS, .style = 1, .title = "measured",
                      .with_errors = true),
                CURVE(VALIDATION_PREDICTED, JOINED_BARS, .style = 21, .title = "predicted",
                      .with_errors = true),
                CURVE(VALIDATION_WITH_LAYER, JOINED_BARS, .style = 24,
                      .title = "predicted with layer", .with_errors = true)},
     .caption_text =
         "Friction coefficient of the steady part of every step of the records, with its "
         "interval of 95 %, and as predicted at its velocity, temperature and pressure, with "
         "its interval of 95 %; a line joins steps of one temperature and pressure.",
     .caption = caption_verdict},
    {.name = "validation_ratio",
     .title = "Friction, measured over predicted",
     .table = &validation_schema,
     .data_title = "steps of the records",
     .x = {VALIDATION_VELOCITY, AXIS_LOG, "Sliding velocity"},
     .y = {{VALIDATION_RATIO, AXIS_NUMBER, "Measured over predicted"}},
     .curves = {CURVE(VALIDATION_RATIO, BARS, .style = 1, .title = "without a layer",
                      .with_errors = true),
                CURVE(VALIDATION_RATIO_LAYER, BARS, .style = 4, .title = "with the layer",
                      .with_errors = true)},
     .empty_reason = "no shear stress is given, so that friction is not predicted",
     .caption_text =
         "Measured over predicted friction of every step of the records, with its interval of "
         "95 % by both errors and the scatter between the steps. At the dotted line they agree.",
     .prepare = mark_agreement,
     .caption = caption_verdict},
    {.name = "validation_course",
     .title = "Friction in running-in, measured and predicted",
     .table = &validation_course_schema,
     .data_title = "running-in of the records",
     .x = {VALIDATION_COURSE_TIME, AXIS_LOG, "Time from the start on"},
     .y = {{VALIDATION_COURSE_MEASURED, AXIS_NUMBER, "Friction coefficient μ"}},
     .curves = {CURVE(VALIDATION_COURSE_BARE, LINE, .style = 21, .title = "without a layer",
                      .band = 71),
                CURVE(VALIDATION_COURSE_LAYER, LINE, .style = 24,
                      .title = "predicted while the layer grows", .band = 74),
                CURVE(VALIDATION_COURSE_MEASURED, POINTS, .style = 1, .title = "measured")},
     .caption_text =
         "Friction coefficient of the records from their start on, means of the cycles, and as "
         "predicted while the layer grows and without one, with its interval of 95 %."},
    {.name = NULL},
};
