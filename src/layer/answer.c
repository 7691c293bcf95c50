/* Sentences of the answer about balances, existence, bands, running-in, identification and the
 * thickness from the curves. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"
#include "core/math/students_t.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* Pair of constants with intervals; both tables have these columns. */
typedef struct reported_pair {
    double energy, energy_low, energy_high, wear, wear_low, wear_high, correlation, loose_error;
    const char *loose;
} reported_pair;

/* Reads a pair. Value, error and limits of each constant are adjacent columns, as are the
 * correlation and the least known combination. */
static reported_pair read_reported_pair(const table_view *v, size_t row, unsigned energy,
                                        unsigned correlation)
{
    enum { VALUE, ERROR, LOW, HIGH, NEXT };
    const table_schema *const of = v->schema;
    const unsigned wear = energy + NEXT;
    return (reported_pair){.energy = view_number(v, of, row, energy + VALUE),
                           .energy_low = view_number(v, of, row, energy + LOW),
                           .energy_high = view_number(v, of, row, energy + HIGH),
                           .wear = view_number(v, of, row, wear + VALUE),
                           .wear_low = view_number(v, of, row, wear + LOW),
                           .wear_high = view_number(v, of, row, wear + HIGH),
                           .correlation = view_number(v, of, row, correlation),
                           .loose = view_text(v, of, row, correlation + 1),
                           .loose_error = view_number(v, of, row, correlation + 2)};
}

/* Appends a pair. The constants are correlated, so that one combination of them has the largest
 * uncertainty. */
static void append_pair(text_builder *t, const reported_pair *p)
{
    text_append(t, "U_c = %s, k = %s",
                format_estimate_interval((wt_estimate){.value = p->energy, .unit = "J/m^3"},
                                         p->energy_low, p->energy_high)
                    .text,
                format_estimate_interval((wt_estimate){.value = p->wear, .unit = "m^2/N"},
                                         p->wear_low, p->wear_high)
                    .text);
    if (!isnan(p->correlation))
        text_append(t, ", correlation %.2f", p->correlation);
    if (isfinite(p->loose_error) && p->loose_error > 0)
        text_append(t, "; known least is %s, to a factor of %.3g", p->loose,
                    exp(NORMAL_95 * p->loose_error));
}

/* The rows after the first are the methods that need no literature range. */
void append_identification(text_builder *t, const table_view *v)
{
    if (v->n_rows == 1)
        text_append(
            t,
            "the thickness alone tells k U_c = %s and neither of them: U_c / k is not determined "
            "before a wear rate or a running-in time is known",
            format_known_estimate(identification_value(v, IDENTIFICATION_KEY_PRODUCT)).text);
    for (size_t i = 1; i < v->n_rows; i++) {
        const reported_pair p =
            read_reported_pair(v, i, IDENTIFICATION_ENERGY, IDENTIFICATION_CORRELATION);
        text_append(t, "%sby %s ", i > 1 ? "; " : "", identification_text(v, i, IDENTIFICATION_BY));
        if (isnan(p.energy_low))
            text_append(t, "U_c = %s, k = %s (%s)", format_with_unit(p.energy, "J/m^3").text,
                        format_with_unit(p.wear, "m^2/N").text,
                        identification_text(v, i, IDENTIFICATION_NOTE));
        else
            append_pair(t, &p);
    }
    const char *const lacks = identification_key_text(v, IDENTIFICATION_KEY_LACKS);
    if (lacks != NULL)
        text_append(t, "; no error of %s is known, and none is in that", lacks);
}

/* Appends the pairs shared by all cases, one for each method. The table also has those of one
 * sample or condition. */
void append_shared_pairs(text_builder *t, const table_view *v)
{
    const char *const settled_by = shared_pairs_key_text(v, SHARED_PAIRS_KEY_SETTLED_BY);
    bool open = false, is_first_appended = false;
    for (size_t i = 0; i < v->n_rows; i++) {
        const sharing_verdict one_pair =
            (sharing_verdict)shared_pairs_enum(v, i, SHARED_PAIRS_ONE_PAIR);
        const reported_pair p =
            read_reported_pair(v, i, SHARED_PAIRS_ENERGY, SHARED_PAIRS_CORRELATION);
        if (shared_pairs_enum(v, i, SHARED_PAIRS_OVER) != OF_ALL)
            continue;
        text_append(t, "%sone U_c and k of %.0f cases by %s: %s", is_first_appended ? "; " : "",
                    shared_pairs_get(v, i, SHARED_PAIRS_N),
                    shared_pairs_text(v, i, SHARED_PAIRS_BY), sharing_verdict_text(one_pair));
        is_first_appended = true;
        open = open || one_pair == SHARING_INCONCLUSIVE;
        if (one_pair != SHARING_ONE)
            text_append(t, " (U_c: %s; k: %s)", shared_pairs_text(v, i, SHARED_PAIRS_ONE_ENERGY),
                        shared_pairs_text(v, i, SHARED_PAIRS_ONE_WEAR));
        if (one_pair == SHARING_DIFFERS) /* cases that differ have no common mean */
            continue;
        text_append(t, one_pair == SHARING_ONE ? ", " : "; as one ");
        append_pair(t, &p);
    }
    if (open && settled_by != NULL)
        text_append(t, "; what would settle it: %s", settled_by);
}

void answer_identification(const answer_context *context)
{
    const table_view *const v = &context->identification;
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    if (v->table == NULL)
        return;
    append_identification(&t, v);
    answer_add_sentence(context, "How thick is it?", ANSWER_KIND_THICKNESS,
                        "What makes it so thick? %c%s.", toupper((unsigned char)text[0]), text + 1);
}

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
