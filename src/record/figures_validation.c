/* Figures of measured friction against predicted friction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/drawing.h"

/* The caption states the subject and the verdict of the key. */
static void caption_verdict(figure_drawing *d)
{
    text_format(&d->caption, " Of %s: %s.", validation_key_text(d->table, VALIDATION_KEY_JUDGED),
                validation_key_text(d->table, VALIDATION_KEY_VERDICT));
}

static void caption_running_in_verdict(figure_drawing *d)
{
    text_format(&d->caption, " Running-in: %s.",
                validation_course_key_text(d->table, VALIDATION_COURSE_KEY_VERDICT));
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
         "one standard error; a line joins steps of one temperature and pressure.",
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
                CURVE(VALIDATION_COURSE_FITTED, FIT, .style = 22,
                      .title = "in the time that the record asks for"),
                CURVE(VALIDATION_COURSE_MEASURED, BARS, .style = 1, .title = "measured",
                      .with_errors = true)},
     .caption_text =
         "Friction coefficient of the records from their start on, means of the cycles with "
         "their interval of 95 %, as predicted while the layer grows and without one, with "
         "one standard error, and the predicted course as it lies nearest to the record.",
     .caption = caption_running_in_verdict},
    {.name = NULL},
};
