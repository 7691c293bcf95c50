/* Sentences of the answer about measured friction and wear.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"
#include "case/answer/format_number.h"

#include <math.h>
#include <string.h>

/* Returns the smallest (sign -1) or largest (sign 1) friction coefficient of all rows that are not
 * at rest. *n counts these rows. */
static double extreme_sliding_friction(const table_view *v, double sign, size_t *n)
{
    double most = (double)NAN;
    *n = 0;
    for (size_t i = 0; i < v->n_rows; i++) {
        if (record_get(v, i, RECORD_VELOCITY) == 0 || record_get(v, i, RECORD_ROTATION) == 0)
            continue;
        most = sign * fmax(sign * most, sign * record_get(v, i, RECORD_FRICTION));
        ++*n;
    }
    return most;
}

void append_record(text_builder *t, const table_view *v)
{
    const wt_estimate mu = record_value(v, RECORD_KEY_FRICTION);
    size_t n;
    const double least = extreme_sliding_friction(v, -1, &n),
                 most = extreme_sliding_friction(v, 1, &n);
    if (n == 0)
        text_append(t, "no friction of sliding: nothing slides");
    else if (isnan(mu.value))
        text_append(t, "friction as measured at %zu conditions, %s", n,
                    format_pair(least, most, 4).text);
    else
        text_append(t, "friction as measured %s", format_estimate(mu).text);
    const double end = record_get(v, 0, RECORD_RUNNING_IN);
    if (v->n_rows == 1 && !isnan(end))
        text_append(t, ", after a running-in of %.0f cycles", end);
    else if (v->n_rows == 1)
        text_append(t, "; %s", record_text(v, 0, RECORD_RUNNING_IN_NOTE));
    if (v->n_rows == 1 && record_text(v, 0, RECORD_NOTE)[0] != '\0')
        text_append(t, "; %s", record_text(v, 0, RECORD_NOTE));
}

/* Appends the nominal pressure under the ball and its duty. Both are known without a wear rate. */
static void append_ball_contact(text_builder *t, const table_view *v)
{
    double least = (double)NAN, most = (double)NAN;
    for (size_t i = 0; i < v->n_rows; i++) {
        least = fmin(least, wear_get(v, i, WEAR_PRESSURE));
        most = fmax(most, wear_get(v, i, WEAR_PRESSURE));
    }
    if (isnan(least))
        return;
    const number_text low = format_with_unit(least, "Pa"), high = format_with_unit(most, "Pa");
    text_append(t, "; nominal pressure under the ball %s", low.text);
    if (strcmp(low.text, high.text) != 0)
        text_append(t, " to %s", high.text);
    else if (!isnan(wear_get(v, 0, WEAR_DUTY)))
        text_append(t, ", duty %.3g", wear_get(v, 0, WEAR_DUTY));
}

void append_wear(text_builder *t, const table_view *v)
{
    const wt_estimate k = wear_value(v, WEAR_KEY_RATE);
    if (isnan(k.value))
        text_append(t, "no specific wear rate: %s", wear_text(v, 0, WEAR_NOTE));
    else
        text_append(t, "specific wear rate %s", format_positive_estimate(k).text);
    append_ball_contact(t, v);
}

void answer_layer_wear_rate(const answer_context *context, const char *question)
{
    const table_view *const layer = &context->values.layer;
    if (context->wear.table == NULL || layer->table == NULL)
        return;
    const wt_estimate is = wear_value(&context->wear, WEAR_KEY_RATE),
                      used = layer_value(layer, LAYER_KEY_WEAR_RATE);
    if (!(is.value > 0) || !(used.value > 0))
        return;
    if (used.value == is.value)
        answer_add_sentence(context, question, ANSWER_KIND_THICKNESS,
                            "Its specific wear rate is the one measured by the records: %s.",
                            format_positive_estimate(is).text);
    else
        answer_add_sentence(
            context, question, ANSWER_KIND_THICKNESS,
            "Its specific wear rate is the one given, %s; the one measured by the records is "
            "%.3g times that: %s.",
            format_value(used).text, is.value / used.value, format_positive_estimate(is).text);
}

void answer_record(const answer_context *context)
{
    char text[900];
    text_builder t = {text, sizeof text, 0};
    if (context->record.n_rows == 0)
        return;
    append_record(&t, &context->record);
    if (context->wear.n_rows > 0) {
        text_append(&t, "; ");
        append_wear(&t, &context->wear);
    }
    if (text[0] >= 'a' && text[0] <= 'z')
        text[0] = (char)(text[0] - 'a' + 'A');
    answer_add_sentence(context, "What was measured of friction?", ANSWER_KIND_RECORD, "%s.", text);
}
