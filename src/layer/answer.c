/* Sentences of the answer about balances, existence, bands, running-in and the thickness from the
 * curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static const char thickness_question[] = "How thick is it?",
                  friction_question[] = "What does it do to friction?";

/* Returns the smallest stable thickness [m]; NaN if there is none. */
static double thinnest_stable(const table_view *v)
{
    double least = (double)NAN;
    for (size_t i = 0; i < v->n_rows; i++)
        if (layer_feedback_enum(v, i, LAYER_FEEDBACK_STABLE) == BALANCE_STABLE)
            least = fmin(least, layer_feedback_get(v, i, LAYER_FEEDBACK_THICKNESS));
    return least;
}

void append_balance(text_builder *t, const table_view *balances)
{
    const double least = thinnest_stable(balances);
    text_append(t,
                "where the layer acts back on the energy that makes it, from a bare surface %s%s",
                isnan(least) ? "no balance is found"
                : least > 0  ? "the balance is at "
                             : "there is no layer",
                least > 0 ? format_with_unit(least, "m").text : "");
}

static void add_balances(const answer_context *context)
{
    const table_view *const v = &context->layer_feedback;
    if (v->table == NULL)
        return;
    const char *const agreement = layer_feedback_key_text(v, LAYER_FEEDBACK_KEY_AGREEMENT);
    char text[160];
    text_builder t = {text, sizeof text, 0};
    append_balance(&t, v);
    text[0] = (char)toupper((unsigned char)text[0]);
    answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS, "%s: %s.", text,
                        layer_feedback_key_text(v, LAYER_FEEDBACK_KEY_WORDS));
    if (layer_feedback_key_enum(v, LAYER_FEEDBACK_KEY_AGREEMENT) == VERDICT_INCONCLUSIVE)
        answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS,
                            "Whether that many balances are there, the inputs %s.", agreement);
}

static void add_existence(const answer_context *context)
{
    const table_view *const v = &context->layer_regime_map;
    if (v->table == NULL)
        return;
    const char *const assessment = layer_regime_map_key_text(v, LAYER_REGIME_MAP_KEY_KNOWN);
    answer_add_sentence(
        context, thickness_question, ANSWER_KIND_THICKNESS, "At %s a layer exists %s.",
        format_with_unit(layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_PRESSURE).value, "Pa").text,
        layer_regime_map_key_text(v, LAYER_REGIME_MAP_KEY_WORDS));
    const wt_estimate from = layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_FROM_VELOCITY),
                      to = layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_TO_VELOCITY);
    const double begins[] =
        {layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_FROM_VELOCITY_LOW).value,
         layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_FROM_VELOCITY_HIGH).value},
                 ends[] = {layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_TO_VELOCITY_LOW).value,
                           layer_regime_map_value(v, LAYER_REGIME_MAP_KEY_TO_VELOCITY_HIGH).value};
    if (isfinite(begins[0]))
        answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS, "It begins at %s.",
                            format_estimate_interval(from, begins[0], begins[1]).text);
    if (isfinite(ends[0]))
        answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS, "It ends at %s.",
                            format_estimate_interval(to, ends[0], ends[1]).text);
    if (layer_regime_map_key_enum(v, LAYER_REGIME_MAP_KEY_KNOWN) == VERDICT_INCONCLUSIVE)
        answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS,
                            "Of its edges the inputs %s.", assessment);
}

void answer_track_layer(const answer_context *context)
{
    const table_view *const v = &context->track_layer;
    if (v->table == NULL)
        return;
    const char *const allowed = track_layer_key_text(v, TRACK_LAYER_KEY_ALLOWED),
                      *const agree = track_layer_key_text(v, TRACK_LAYER_KEY_AGREE),
                      *const settled_by = track_layer_key_text(v, TRACK_LAYER_KEY_SETTLED_BY);
    answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS,
                        "What thickness do the curves alone allow? %c%s.%s%s%s%s%s%s",
                        toupper((unsigned char)allowed[0]), allowed + 1,
                        agree != NULL ? " Does the theory agree? " : "", agree != NULL ? agree : "",
                        agree != NULL ? "." : "",
                        settled_by != NULL ? " What would settle it: " : "",
                        settled_by != NULL ? settled_by : "", settled_by != NULL ? "." : "");
}

static void add_bands(const answer_context *context)
{
    const table_view *const v = &context->layer_bands;
    const char *const events =
        v->table != NULL ? layer_bands_key_text(v, LAYER_BANDS_KEY_EVENTS) : NULL;
    if (events == NULL)
        return;
    const wt_estimate first = layer_bands_value(v, LAYER_BANDS_KEY_FIRST);
    answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS,
                        "By the transport of damage: %s.", events);
    if (first.standard_error > 0 &&
        isfinite(layer_bands_value(v, LAYER_BANDS_KEY_FIRST_HIGH).value))
        answer_add_sentence(
            context, thickness_question, ANSWER_KIND_THICKNESS,
            "Rubber is first modified after %s.",
            format_estimate_interval(first, layer_bands_value(v, LAYER_BANDS_KEY_FIRST_LOW).value,
                                     layer_bands_value(v, LAYER_BANDS_KEY_FIRST_HIGH).value)
                .text);
    const char *const assessment = layer_bands_key_text(v, LAYER_BANDS_KEY_KNOWN);
    if (layer_bands_key_enum(v, LAYER_BANDS_KEY_KNOWN) == VERDICT_INCONCLUSIVE)
        answer_add_sentence(context, thickness_question, ANSWER_KIND_THICKNESS,
                            "Of that the inputs %s.", assessment);
}

void answer_layer_models(const answer_context *context)
{
    add_bands(context);
    add_balances(context);
    add_existence(context);
}

static number_text format_endpoint(wt_estimate e)
{
    return e.standard_error > 0 ? format_estimate(e) : format_value(e);
}

void answer_running_in(const answer_context *context)
{
    const table_view *const v = &context->running_in;
    if (v->table == NULL)
        return;
    const wt_estimate bare = running_in_value(v, RUNNING_IN_KEY_BARE),
                      end = running_in_value(v, RUNNING_IN_KEY_BALANCE),
                      settled = running_in_value(v, RUNNING_IN_KEY_SETTLED);
    char text[192] = "";
    text_builder t = {text, sizeof text, 0};
    const double low = running_in_value(v, RUNNING_IN_KEY_SETTLED_LOW).value,
                 high = running_in_value(v, RUNNING_IN_KEY_SETTLED_HIGH).value;
    if (!isnan(settled.value) && isnan(high)) /* no replicates, or some settle after the last
                                                 time */
        text_append(&t, "; 5 %% of the change are left after %s in contact",
                    format_value(settled).text);
    else if (!isnan(settled.value))
        text_append(&t, "; 5 %% of the change are left after %s in contact",
                    format_estimate_interval(settled, low, high).text);
    if (!isnan(end.value))
        answer_add_sentence(context, friction_question, ANSWER_KIND_FRICTION,
                            "While the layer grows, friction goes from %s to %s%s.",
                            format_endpoint(bare).text, format_endpoint(end).text, text);
    const char *const assessment = running_in_key_text(v, RUNNING_IN_KEY_KNOWN);
    if (running_in_key_enum(v, RUNNING_IN_KEY_KNOWN) == VERDICT_INCONCLUSIVE)
        answer_add_sentence(context, friction_question, ANSWER_KIND_FRICTION,
                            "Of when that is the inputs %s.", assessment);
}
