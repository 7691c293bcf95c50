/* Sentences of the answer that compare measured and predicted friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"
#include "core/base/number.h"

#include <ctype.h>
#include <math.h>

static const char question[] = "Does the theory explain the friction that was measured?";

void append_verdict(text_builder *t, const table_view *v)
{
    text_append(t, "the theory (%s) against the record: %s",
                validation_key_text(v, VALIDATION_KEY_JUDGED),
                validation_key_text(v, validation_key_text(v, VALIDATION_KEY_OUTCOME) != NULL
                                           ? VALIDATION_KEY_OUTCOME
                                           : VALIDATION_KEY_VERDICT));
}

void append_required_shear(text_builder *t, const table_view *v)
{
    const wt_estimate required = validation_value(v, VALIDATION_KEY_NEEDED);
    if (isnan(required.value))
        return;
    text_append(t, "the record asks for a shear stress of %s; plausible: %s",
                format_estimate_interval(required,
                                         validation_value(v, VALIDATION_KEY_NEEDED_LOW).value,
                                         validation_value(v, VALIDATION_KEY_NEEDED_HIGH).value)
                    .text,
                validation_key_text(v, VALIDATION_KEY_PLAUSIBLE));
}

void append_running_in_verdict(text_builder *t, const table_view *v)
{
    text_append(t, "the running-in with the layer against the record: %s",
                validation_running_in_key_text(v, VALIDATION_RUNNING_IN_KEY_VERDICT));
}

void append_required_wear(text_builder *t, const table_view *v)
{
    const wt_estimate wear = validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_WEAR);
    if (isnan(wear.value))
        return;
    text_append(t, "the running-in time asks for k = %s with U_c = %s, the thickness as predicted",
                format_estimate_interval(
                    wear, validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_WEAR_LOW).value,
                    validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_WEAR_HIGH).value)
                    .text,
                format_estimate_interval(
                    validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_ENERGY),
                    validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_ENERGY_LOW).value,
                    validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_ENERGY_HIGH).value)
                    .text);
}

static void report_running_in(const answer_context *context)
{
    const table_view *const v = &context->validation_running_in;
    if (v->table == NULL)
        return;
    char text[800];
    text_builder t = {text, sizeof text, 0};
    const char *const settled =
                          validation_running_in_key_text(v, VALIDATION_RUNNING_IN_KEY_SETTLED_BY),
                      *const agrees =
                          validation_running_in_key_text(v, VALIDATION_RUNNING_IN_KEY_AGREES);
    append_running_in_verdict(&t, v);
    text[0] = (char)toupper((unsigned char)text[0]);
    answer_add_sentence(context, question, ANSWER_KIND_VALIDATION, "%s.", text);
    if (validation_running_in_key_text(v, VALIDATION_RUNNING_IN_KEY_REMARKS) != NULL)
        answer_add_sentence(context, question, ANSWER_KIND_VALIDATION,
                            "To be kept in mind of the running-in: %s.",
                            validation_running_in_key_text(v, VALIDATION_RUNNING_IN_KEY_REMARKS));
    if (settled != NULL)
        answer_add_sentence(context, question, ANSWER_KIND_VALIDATION,
                            "What would settle the running-in: %s.", settled);
    t.used = 0;
    append_required_wear(&t, v);
    if (t.used == 0)
        return;
    text[0] = (char)toupper((unsigned char)text[0]);
    if (agrees != NULL)
        text_append(&t, "; against the wear that was measured: %s", agrees);
    answer_add_sentence(context, question, ANSWER_KIND_VALIDATION, "%s.", text);
}

static void report_required_shear(const answer_context *context, const table_view *v)
{
    char text[700] = "";
    text_builder t = {text, sizeof text, 0};
    const char *const shape = validation_key_text(v, VALIDATION_KEY_SHAPE);
    append_required_shear(&t, v);
    if (t.used == 0)
        return;
    text[0] = (char)toupper((unsigned char)text[0]);
    if (shape != NULL)
        text_append(&t, ". The verdict with it: %s", shape);
    answer_add_sentence(context, question, ANSWER_KIND_VALIDATION, "%s.", text);
}

static void report_narrowed_range(const answer_context *context, const table_view *v)
{
    const bool layer = !isnan(validation_value(v, VALIDATION_KEY_LAYERED_KEPT_LOW).value);
    const double all[] = {validation_value(v, layer ? VALIDATION_KEY_LAYERED_ALL_LOW
                                                    : VALIDATION_KEY_FRICTION_ALL_LOW)
                              .value,
                          validation_value(v, layer ? VALIDATION_KEY_LAYERED_ALL_HIGH
                                                    : VALIDATION_KEY_FRICTION_ALL_HIGH)
                              .value},
                 kept[] = {validation_value(v, layer ? VALIDATION_KEY_LAYERED_KEPT_LOW
                                                     : VALIDATION_KEY_FRICTION_KEPT_LOW)
                               .value,
                           validation_value(v, layer ? VALIDATION_KEY_LAYERED_KEPT_HIGH
                                                     : VALIDATION_KEY_FRICTION_KEPT_HIGH)
                               .value};
    if (isnan(kept[0]))
        return;
    answer_add_sentence(
        context, question, ANSWER_KIND_VALIDATION,
        "Over the choices of the model the friction at the reference velocity is %s; over "
        "those that the record leaves, %s.",
        format_range(all[0], all[1], 3).text, format_range(kept[0], kept[1], 3).text);
}

void answer_validation(const answer_context *context)
{
    const table_view *const v = &context->validation;
    if (v->table == NULL) { /* this stage may have failed */
        report_running_in(context);
        return;
    }
    char text[400];
    text_builder t = {text, sizeof text, 0};
    const char *const settled = validation_key_text(v, VALIDATION_KEY_SETTLED_BY),
                      *const wear = validation_key_text(v, VALIDATION_KEY_WEAR);
    append_verdict(&t, v);
    text[0] = (char)toupper((unsigned char)text[0]);
    answer_add_sentence(context, question, ANSWER_KIND_VALIDATION, "%s.", text);
    if (settled != NULL)
        answer_add_sentence(context, question, ANSWER_KIND_VALIDATION, "What would settle it: %s.",
                            settled);
    if (context->validation_sources.table != NULL)
        answer_add_sentence(context, question, ANSWER_KIND_VALIDATION,
                            "What would narrow it most: %s.",
                            validation_sources_key_text(&context->validation_sources,
                                                        VALIDATION_SOURCES_KEY_ADVICE));
    report_required_shear(context, v);
    report_narrowed_range(context, v);
    if (wear != NULL)
        answer_add_sentence(
            context, question, ANSWER_KIND_VALIDATION,
            "The specific wear rate as measured is %.3g times that of the layer: %s.",
            validation_value(v, VALIDATION_KEY_WEAR_RATIO).value, wear);
    report_running_in(context);
}
