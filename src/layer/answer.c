/* Sentences of the answer about identification and the thickness from the curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
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

static const char thickness_question[] = "How thick is it?";

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
