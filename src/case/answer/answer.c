/* Writes the answer of a run: a summary and one section for each question of the user.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer.h"
#include "case/answer/caveats.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/base/range_text.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static const char in_short[] = "In short";
static const char is_there[] = "Is there a modified layer?";
static const char how_different[] = "How different is it?";
static const char how_thick[] = "How thick is it?";
static const char what_friction[] = "What does it do to friction?";
static const char not_asked[] = "What was not asked?";

/* Returns the message of a stage that failed completely or failed at a higher level. */
static const char *why_failed(const answer_context *story, const char *stage)
{
    const size_t length = strlen(stage);
    for (size_t i = 0; i < story->failures.n_rows; i++) {
        const char *name = failures_text(&story->failures, i, FAILURES_FILE);
        if (strncmp(name, "stage ", 6) == 0 && strncmp(name + 6, stage, length) == 0 &&
            (name[6 + length] == '\0' || name[6 + length] == ' '))
            return failures_text(&story->failures, i, FAILURES_MESSAGE);
    }
    return "the stage failed";
}

/* Returns the stage that keeps `stage` from running. It is the first failed stage among those whose
 * outputs `stage` needs; blocked stages are followed to their own cause. */
static flow_stage_id root_of(const flow_plan *plan, flow_stage_id stage, unsigned level)
{
    const flow_things takes = flow_needs(plan, stage, level) | flow_stages[stage].any;
    for (size_t i = 0; i < FLOW_N_STAGES && i < (size_t)stage; i++) {
        if ((flow_stages[i].gives & takes) == 0)
            continue;
        if (plan->outcome[i] == FLOW_FAILED)
            return (flow_stage_id)i;
        if (plan->outcome[i] == FLOW_BLOCKED)
            return root_of(plan, (flow_stage_id)i, 0);
    }
    return stage;
}

/* Adds a sentence with the reason why a requested result is missing. */
static void say_why_not(const answer_context *story, flow_stage_id stage, flow_outcome outcome,
                        const char *question, const char *kind)
{
    const flow_plan *plan = story->plan;
    if (outcome == FLOW_FAILED)
        answer_add_sentence(story, question, kind, "Not answered: %s.",
                            why_failed(story, flow_stages[stage].id));
    else if (outcome == FLOW_BLOCKED) {
        const flow_stage_id root = root_of(plan, stage, plan->level[stage]);
        answer_add_sentence(
            story, question, kind, "Not answered: a stage that %s needs failed (%s): %s.",
            flow_stages[stage].id, flow_stages[root].id, why_failed(story, flow_stages[root].id));
    } else if (outcome == FLOW_UNMEASURED)
        answer_add_sentence(story, question, kind, "Not measured: %s.", plan->why_unmeasured);
}

static void say_missing(const answer_context *story, flow_stage_id stage, const char *question,
                        const char *kind)
{
    say_why_not(story, stage, story->plan->outcome[stage], question, kind);
}

/* Adds what the case does not request, or has no data for, after all other sections. */
static void say_not_asked(const answer_context *story)
{
    static const struct {
        flow_stage_id stage;
        const char *question, *kind;
    } asked[] = {{FLOW_STAGE_COMPARISON, is_there, "layer"},
                 {FLOW_STAGE_LAYER, how_thick, "thickness"},
                 {FLOW_STAGE_FRICTION, what_friction, "friction"}};
    static const char left_out[] = "left out because ";
    const flow_plan *plan = story->plan;
    for (size_t i = 0; i < COUNT_OF(asked); i++) {
        const char *because = plan->because[asked[i].stage];
        if (plan->outcome[asked[i].stage] == FLOW_LEFT_OUT &&
            strncmp(because, left_out, strlen(left_out)) == 0)
            answer_add_sentence(story, not_asked, asked[i].kind, "%s Not asked: %s.",
                                asked[i].question, because + strlen(left_out));
    }
    if (plan->outcome[FLOW_STAGE_FRICTION] == FLOW_DONE &&
        plan->fuller[FLOW_STAGE_FRICTION] == FLOW_LEFT_OUT &&
        plan->without[FLOW_STAGE_FRICTION][0] != '\0')
        answer_add_sentence(story, not_asked, "friction",
                            "What the layer does to friction. Not asked: %s.",
                            plan->without[FLOW_STAGE_FRICTION]);
}

/* ---- summary --------------------------------------------------------------------------------- */

static void say_short(const answer_context *story, const char *what, const char *text)
{
    answer_add_sentence(story, in_short, "short", "%s: %s.", what, text);
}

/* Adds the summary line of a requested result that is missing. */
static void short_of_missing(const answer_context *story, const char *what, flow_stage_id stage)
{
    const flow_outcome outcome = story->plan->outcome[stage];
    if (outcome == FLOW_FAILED)
        answer_add_sentence(story, in_short, "short", "%s: not answered: %s.", what,
                            why_failed(story, flow_stages[stage].id));
    else if (outcome == FLOW_BLOCKED)
        answer_add_sentence(story, in_short, "short", "%s: not answered, for what it needs failed.",
                            what);
    else if (outcome == FLOW_UNMEASURED)
        answer_add_sentence(story, in_short, "short", "%s: not measured: %s.", what,
                            story->plan->why_unmeasured);
}

static void short_of_friction(const answer_context *story, text_builder *t)
{
    const result_value_tables *found = &story->found;
    const result_value total = result_value_of_friction(found, FRICTION_KEY_FRICTION),
                       hysteresis = result_value_of_friction(found, FRICTION_KEY_HYSTERESIS),
                       with_layer = result_value_of_friction(found, FRICTION_KEY_WITH_LAYER);
    if (!isnan(with_layer.number.value)) {
        append_change(t, found, true);
        text_append(t, "; mu = %s without it and %s with it", format_plain_number(&total).text,
                    format_plain_number(&with_layer).text);
    } else if (!isnan(total.number.value))
        text_append(t, "mu = %s without a layer", format_result_value(&total).text);
    else
        text_append(t, "hysteresis part %s without a layer", format_result_value(&hysteresis).text);
    text_append(t, ", at %s", format_with_unit(total.velocity, "m/s").text);
}

static void answer_in_short(const answer_context *story)
{
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    const char *thickness = strncmp(format_origin(&story->found), "put in", 6) == 0
                                ? "Thickness"
                                : "Thickness (predicted)";
    if (story->found.comparison.table != NULL) {
        append_ratio(&t, &story->found);
        say_short(story, "Layer (measured)", text);
    } else
        short_of_missing(story, "Layer (measured)", FLOW_STAGE_COMPARISON);
    t.used = 0;
    if (story->found.layer.table != NULL) {
        append_thickness(&t, &story->found);
        if (story->layer_feedback.table != NULL) {
            text_append(&t, "; ");
            append_balance(&t, &story->layer_feedback);
        }
        say_short(story, thickness, text);
    } else
        short_of_missing(story, thickness, FLOW_STAGE_LAYER);
    t.used = 0;
    if (story->found.friction.table != NULL) {
        short_of_friction(story, &t);
        say_short(story, "Friction (predicted)", text);
    } else
        short_of_missing(story, "Friction (predicted)", FLOW_STAGE_FRICTION);
}

/* ---- layer, difference ----------------------------------------------------------------------- */

/* The first row of the table comparison holds the comparison over all rates. */
static double over_all(const answer_context *story, comparison_column column)
{
    return comparison_get(&story->found.comparison, 0, column);
}

static bool said(const answer_context *story, const char *verdict)
{
    const char *differs = comparison_words(&story->found.comparison, COMPARISON_KEY_DIFFERS);
    return differs != NULL && strncmp(differs, verdict, strlen(verdict)) == 0;
}

/* "4 spots in the bulk and 5 in the track; p 0.01 by Welch, 0.03 by Mann and Whitney ..." */
static void list_evidence(const answer_context *story, char *text, size_t size)
{
    const char *unit = comparison_words(&story->found.comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    const double smallest = over_all(story, COMPARISON_MANN_WHITNEY_SMALLEST_P);
    const double scatter =
        comparison_value(&story->found.comparison, COMPARISON_KEY_SPOT_SCATTER).value;
    const double n[] = {over_all(story, COMPARISON_SPOTS_BULK),
                        over_all(story, COMPARISON_SPOTS_TRACK)};
    char least[96] = "";
    if (scatter > 0) {
        clocale_print(text, size,
                      "%.0f spot%s in the bulk and %.0f in the track, which scatter by %.3g %% as "
                      "given; p %s",
                      n[0], n[0] > 1 ? "s" : "", n[1], 100 * scatter,
                      number_chance(over_all(story, COMPARISON_WELCH_P)).text);
        return;
    }
    if (smallest > 0.05)
        clocale_print(least, sizeof least, ", which cannot be below %.2g with so few", smallest);
    clocale_print(text, size,
                  "%.0f %s in the bulk and %.0f in the track; p %s by Welch, %s by "
                  "Mann and Whitney%s",
                  n[0], strncmp(unit, "curve", 5) == 0 ? "curves" : "spots", n[1],
                  number_chance(over_all(story, COMPARISON_WELCH_P)).text,
                  number_chance(over_all(story, COMPARISON_MANN_WHITNEY_P)).text, least);
}

static void answer_layer(const answer_context *story)
{
    if (story->found.comparison.table == NULL) {
        say_missing(story, FLOW_STAGE_COMPARISON, is_there, "layer");
        return;
    }
    const result_value ratio = result_value_of_ratio(&story->found);
    char evidence[480] = "";
    if (!isnan(ratio.low)) {
        char found[320];
        list_evidence(story, found, sizeof found);
        clocale_print(evidence, sizeof evidence, " E_track/E_bulk = %s, %s (%s).",
                      format_plain_number(&ratio).text, format_interval(&ratio).text, found);
    }
    answer_add_sentence(story, is_there, "layer", "%c%s.%s%s%s%s",
                        toupper((unsigned char)ratio.verdict[0]), ratio.verdict + 1, evidence,
                        ratio.remedy != NULL ? " What would settle it: " : "",
                        ratio.remedy != NULL ? ratio.remedy : "", ratio.remedy != NULL ? "." : "");
}

static void say_group(const answer_context *story, const char *name, const char *words)
{
    const table_view *groups = &story->found.groups;
    size_t row = 0;
    while (row < groups->n_rows &&
           strcmp(modulus_groups_text(groups, row, MODULUS_GROUPS_GROUP), name) != 0)
        row++;
    if (row == groups->n_rows)
        return;
    const result_value modulus = result_value_of_group(&story->found, row);
    const double n_spots = modulus_groups_get(groups, row, MODULUS_GROUPS_N_SPOTS);
    char interval[480] = "no interval from fewer than two spots";
    if (!isnan(modulus.low))
        snprintf(interval, sizeof interval, "%s by %s", format_interval(&modulus).text,
                 modulus.includes);
    if (!(modulus_groups_get(groups, row, MODULUS_GROUPS_N) > 0)) {
        const double rejected = modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED);
        if (rejected == 1)
            answer_add_sentence(story, how_different, "difference",
                                "%s: the only curve has no modulus.", words);
        else
            answer_add_sentence(story, how_different, "difference",
                                "%s: none of the %.0f curves has a modulus.", words, rejected);
        return;
    }
    answer_add_sentence(
        story, how_different, "difference",
        "%s: E = %s%s (geometric mean, %s) from %.0f curves on %.0f spot%s, %.0f rejected.", words,
        format_plain_number(&modulus).text, format_frequency(&modulus).text, interval,
        modulus_groups_get(groups, row, MODULUS_GROUPS_N), n_spots, n_spots > 1 ? "s" : "",
        modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED));
}

/* Adds the verdict on the change of the modulus with depth. */
static void say_depth(answer_context *story, const char *name, const char *words)
{
    table_view depth = story->modulus_depth;
    depth.suffix = name;
    const char *changes = modulus_depth_words(&depth, MODULUS_DEPTH_KEY_CHANGES);
    const char *reading = modulus_depth_words(&depth, MODULUS_DEPTH_KEY_READING);
    if (changes == NULL)
        return;
    answer_add_sentence(story, how_different, "difference",
                        "Does the modulus of the %s change with depth? "
                        "%c%s.",
                        words, toupper((unsigned char)changes[0]), changes + 1);
    if (reading != NULL)
        answer_caveat(story, CAVEAT_VERDICT, "%c%s.", toupper((unsigned char)reading[0]),
                      reading + 1);
}

static void say_rates(const answer_context *story)
{
    double low = (double)NAN, high = (double)NAN, largest_p = (double)NAN;
    size_t n = 0;
    for (size_t i = 1; i < story->found.comparison.n_rows; i++) {
        double ratio = comparison_get(&story->found.comparison, i, COMPARISON_RATIO);
        if (isnan(ratio))
            continue;
        n++;
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        largest_p = fmax(largest_p, comparison_get(&story->found.comparison, i, COMPARISON_HOLM_P));
    }
    if (n >= 2)
        answer_add_sentence(story, how_different, "difference",
                            "Rate by rate (%zu indentation rates) the ratio is %s; the "
                            "largest p after Holm's correction is %s.",
                            n, format_range(low, high, 3).text, number_chance(largest_p).text);
}

static void say_dma(const answer_context *story)
{
    double low, high;
    if (!ratio_to_dma(&story->dma_comparison, &low, &high))
        return;
    const bool alarm = is_other_rubber(low, high);
    const number_text first = format_with_unit(low, "1"), last = format_with_unit(high, "1");
    const bool one = strcmp(first.text, last.text) == 0;
    char lever[128] = "";
    wt_estimate k = indentation_value(&story->indentation[0], INDENTATION_KEY_SPRING_CONSTANT);
    if (k.standard_error > 0)
        clocale_print(lever, sizeof lever,
                      ", of which the spring constant leaves %.2g %% uncertain",
                      100 * k.standard_error / k.value);
    answer_add_sentence(
        story, how_different, "difference",
        "%sAt equal frequency the indentation modulus of the bulk is %s%s%s times |E*| of "
        "the DMA%s.%s",
        alarm ? "Alarm: indentation and DMA do not describe one rubber. " : "", first.text,
        one ? "" : " to ", one ? "" : last.text, lever,
        alarm ? " Units, spring constant, sensitivity, tip, temperature and the files "
                "themselves are to be checked before anything else is believed."
              : "");
}

static void answer_difference(answer_context *story)
{
    if (story->found.comparison.table == NULL) {
        say_missing(story, FLOW_STAGE_COMPARISON, how_different, "difference");
    } else if (isnan(over_all(story, COMPARISON_RATIO))) {
        answer_add_sentence(story, how_different, "difference",
                            "The ratio of the moduli cannot be told, for the reason above.");
    } else {
        const result_value ratio = result_value_of_ratio(&story->found);
        const double effect = over_all(story, COMPARISON_EFFECT_SIZE);
        char size[96] = "";
        if (isnan(ratio.low))
            snprintf(size, sizeof size, "; an interval cannot be told, for the reason above");
        else if (!isnan(effect))
            clocale_print(size, sizeof size, "; effect size (Hedges' g of ln E) %.2g", effect);
        char rates[256] = "";
        text_builder t = {rates, sizeof rates, 0};
        append_rates(&t, &story->found);
        answer_add_sentence(
            story, how_different, "difference",
            "The modulus of the wear track is %s times that of the bulk (%+.0f %%)%s%s%s.",
            format_plain_number(&ratio).text, 100 * (ratio.number.value - 1),
            format_frequency(&ratio).text, rates, size);
    }
    say_group(story, "bulk", "Bulk");
    say_group(story, "track", "Wear track");
    say_depth(story, "bulk", "bulk");
    say_depth(story, "track", "wear track");
    say_rates(story);
    say_dma(story);
}

/* ---- thickness ------------------------------------------------------------------------------- */

static void say_times(const answer_context *story)
{
    wt_estimate incubation = layer_value(&story->found.layer, LAYER_KEY_INCUBATION_TIME);
    wt_estimate settled = layer_value(&story->found.layer, LAYER_KEY_TIME_TO_90_PERCENT);
    if (isnan(incubation.value))
        return;
    char then[192] = "";
    if (!isnan(settled.value))
        clocale_print(then, sizeof then, " and reaches 90 %% of the balance after %s",
                      format_known_estimate(settled).text);
    answer_add_sentence(story, how_thick, "thickness",
                        "It begins to form after %s%s, time under load.",
                        format_known_estimate(incubation).text, then);
}

/* Indentation and the layer model may disagree. In this case the answer has a caveat. */
static void say_disagreement(answer_context *story, bool modelled)
{
    if (story->found.comparison.table == NULL)
        return;
    if (said(story, "yes") && !modelled)
        answer_caveat(story, CAVEAT_THICKNESS,
                      "That there is no layer does not agree with the indentation, which shows a "
                      "modified track: the specific wear rate, the critical energy or the model "
                      "does not fit it.");
    if (!said(story, "yes") && modelled)
        answer_caveat(story, CAVEAT_THICKNESS,
                      "The indentation %s this layer: it is what the model makes of the specific "
                      "wear rate and the critical energy given.",
                      said(story, "no") ? "does not show" : "cannot say whether there is");
}

/* The text includes the model choices that cause the limits of the range. */
static result_value_text format_thickness(const answer_context *story)
{
    const result_value thickness = result_value_of_thickness(&story->found);
    const result_value_text choices = format_choices(&thickness);
    const bool none = !(thickness.number.value > 0);
    result_value_text words = {""};
    text_builder t = {words.text, sizeof words.text, 0};
    if (none && choices.text[0] != '\0')
        text_append(&t, ", but %s", choices.text);
    else if (!none)
        text_append(&t, "%s (%s)%s%s", format_plain_number(&thickness).text,
                    format_interval(&thickness).text, choices.text[0] != '\0' ? "; " : "",
                    choices.text);
    return words;
}

static void answer_thickness(answer_context *story)
{
    const table_view *layer = &story->found.layer;
    if (layer->table == NULL) {
        say_missing(story, FLOW_STAGE_LAYER, how_thick, "thickness");
        return;
    }
    const result_value thickness = result_value_of_thickness(&story->found);
    const number_text ratio =
        format_known_estimate(layer_value(layer, LAYER_KEY_FORMATION_WEAR_RATIO));
    const number_text velocity = format_with_unit(thickness.velocity, "m/s"),
                      pressure = format_with_unit(thickness.pressure, "Pa");
    const result_value_text words = format_thickness(story);
    const bool none = strcmp(layer_words(layer, LAYER_KEY_REGIME), "none") == 0;
    if (none)
        answer_add_sentence(
            story, how_thick, "thickness",
            "There is none at %s and %s%s: wear removes the rubber faster than it is modified "
            "(formation over wear R = %s, not above 1). The specific wear rate would have to be "
            "below %s.",
            velocity.text, pressure.text, words.text, ratio.text,
            format_with_unit(layer_value(layer, LAYER_KEY_CRITICAL_WEAR_RATE).value, "m^2/N").text);
    else if (isinf(thickness.number.value))
        answer_add_sentence(
            story, how_thick, "thickness", "%s; the table layer gives its thickness in time.",
            layer_ages(&story->found)
                ? "It has no balance: the rubber ages, and in time all of it is modified"
                : "Without wear it grows without end, ever more slowly");
    else
        answer_add_sentence(
            story, how_thick, "thickness",
            "%s. That is where formation balances wear, at %s and %s; %s. Formation over "
            "wear R = %s. With 1 %% more wear it is %.2g %% thinner.",
            words.text, velocity.text, pressure.text, format_origin(&story->found), ratio.text,
            -layer_value(layer, LAYER_KEY_WEAR_SENSITIVITY).value);
    answer_wear_of_layer(story, how_thick);
    if (!none)
        say_times(story);
    if (thickness.range.widest != NULL)
        answer_add_sentence(story, how_thick, "thickness",
                            "What would settle it most: a measurement that settles the %s.",
                            thickness.range.widest);
    say_disagreement(story, !none);
}

/* ---- friction -------------------------------------------------------------------------------- */

static void say_friction(const answer_context *story)
{
    const result_value_tables *found = &story->found;
    const result_value total = result_value_of_friction(found, FRICTION_KEY_FRICTION),
                       hysteresis = result_value_of_friction(found, FRICTION_KEY_HYSTERESIS),
                       area = result_value_of_friction(found, FRICTION_KEY_AREA_RATIO);
    const number_text velocity = format_with_unit(total.velocity, "m/s");
    if (isnan(total.number.value))
        answer_add_sentence(
            story, what_friction, "friction",
            "Without a layer, at %s, the hysteresis part is %s, with a real contact of the "
            "nominal area of %s; the total is not known because no shear stress is given.",
            velocity.text, format_result_value(&hysteresis).text, format_result_value(&area).text);
    else
        answer_add_sentence(
            story, what_friction, "friction",
            "Without a layer, at %s, mu = %s: hysteresis %s, shearing of the real contact "
            "%.3g; contact area of the nominal one %s.",
            velocity.text, format_result_value(&total).text, format_result_value(&hysteresis).text,
            total.number.value - hysteresis.number.value, format_result_value(&area).text);
}

static void say_change(const answer_context *story)
{
    const result_value_tables *found = &story->found;
    const table_view *friction = &found->friction;
    const result_value with_layer = result_value_of_friction(found, FRICTION_KEY_WITH_LAYER),
                       change = result_value_of_friction(found, FRICTION_KEY_RELATIVE_CHANGE);
    const size_t n = friction->n_rows;
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    append_change(&t, found, true);
    if (n > 1)
        text_append(&t, ". From %s to %s the change is %+.0f %% to %+.0f %%",
                    format_with_unit(friction_get(friction, 0, FRICTION_VELOCITY), "m/s").text,
                    format_with_unit(friction_get(friction, n - 1, FRICTION_VELOCITY), "m/s").text,
                    100 * friction_value(friction, FRICTION_KEY_RELATIVE_CHANGE_LOW).value,
                    100 * friction_value(friction, FRICTION_KEY_RELATIVE_CHANGE_HIGH).value);
    const wt_estimate ratio = friction_value(friction, FRICTION_KEY_LAYER_MODULUS_RATIO);
    const bool own = isnan(ratio.value) && friction_words(friction, FRICTION_KEY_LAYER_MODULI);
    answer_add_sentence(
        story, what_friction, "friction",
        "With the layer (%s thick, %s%s), at %s, mu "
        "= %s.",
        format_value(friction_value(friction, FRICTION_KEY_LAYER_THICKNESS)).text,
        own ? "of a material of its own" : "modulus ratio ", own ? "" : format_value(ratio).text,
        format_with_unit(with_layer.velocity, "m/s").text, format_result_value(&with_layer).text);
    answer_add_sentence(story, what_friction, "friction", "%c%s.", toupper((unsigned char)text[0]),
                        text + 1);
    if (change.range.widest != NULL)
        answer_add_sentence(story, what_friction, "friction",
                            "What would settle it most: a measurement that settles the %s.",
                            change.range.widest);
}

static void answer_friction(const answer_context *story)
{
    const result_value_tables *found = &story->found;
    if (found->friction.table == NULL) {
        say_missing(story, FLOW_STAGE_FRICTION, what_friction, "friction");
        return;
    }
    say_friction(story);
    if (friction_words(&found->friction, FRICTION_KEY_LAYER_THICKNESS) == NULL)
        say_why_not(story, FLOW_STAGE_FRICTION, story->plan->fuller[FLOW_STAGE_FRICTION],
                    what_friction, "friction");
    else if (isnan(result_value_of_friction(found, FRICTION_KEY_WITH_LAYER).number.value))
        return;
    else if (!(friction_value(&found->friction, FRICTION_KEY_LAYER_THICKNESS).value > 0))
        answer_add_sentence(story, what_friction, "friction",
                            "Where wear leaves no layer, that is the friction: nothing changes.");
    else
        say_change(story);
}

/* ---- the answer ------------------------------------------------------------------------------ */

static wt_status bind_tables(const wt_result *result, answer_context *story, wt_error *err)
{
    const struct {
        const table_schema *schema;
        const char *suffix;
        table_view *view;
    } tables[] = {
        {&indentation_schema, "bulk", &story->indentation[0]},
        {&indentation_schema, "track", &story->indentation[1]},
        {&modulus_depth_schema, "", &story->modulus_depth},
        {&dma_comparison_schema, "", &story->dma_comparison},
        {&shift_factors_schema, "", &story->shift_factors},
        {&prony_schema, "", &story->prony},
        {&roughness_schema, "", &story->roughness},
        {&power_spectrum_schema, "", &story->power_spectrum},
        {&surfaces_schema, "", &story->surfaces},
        {&record_schema, "", &story->record},
        {&wear_schema, "", &story->wear},
        {&validation_schema, "", &story->validation},
        {&validation_sources_schema, "", &story->validation_sources},
        {&validation_running_in_schema, "", &story->validation_running_in},
        {&layer_bands_schema, "", &story->layer_bands},
        {&layer_feedback_schema, "", &story->layer_feedback},
        {&layer_regime_map_schema, "", &story->existence},
        {&running_in_schema, "", &story->running_in},
        {&track_layer_schema, "", &story->track_layer},
        {&identification_schema, "", &story->identification},
    };
    wt_status status = result_values_bind(result, &story->found, err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(tables); i++)
        status = table_bind_of(result, tables[i].schema, tables[i].suffix, tables[i].view, err);
    return status;
}

wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_log *log, const wt_table *failures, wt_table **table, wt_error *err)
{
    answer_context story = {.c = c, .plan = plan, .log = log};
    wt_status status = bind_tables(result, &story, err);
    if (status == WT_OK)
        status = table_bind(failures, &failures_schema, "", &story.failures, err);
    if (status != WT_OK)
        return status;
    table_writer answer = table_begin(&answer_schema, err);
    story.answer = &answer;
    answer_in_short(&story);
    answer_rubber(&story);
    answer_layer(&story);
    answer_difference(&story);
    answer_thickness(&story);
    answer_track_layer(&story);
    answer_layer_models(&story);
    answer_identification(&story);
    answer_friction(&story);
    answer_running_in(&story);
    answer_validation(&story);
    answer_surface(&story);
    answer_record(&story);
    answer_caveats(&story);
    answer_put_caveats(&story);
    say_not_asked(&story);
    answer_context_clear(&story);
    if (wt_case_title(c)[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_TITLE, wt_case_title(c));
    if (c->sample[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_SAMPLE, c->sample);
    if (c->condition[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_CONDITION, c->condition);
    wt_table *made = NULL;
    status = table_end(&answer, &made);
    if (status == WT_OK && story.status != WT_OK)
        status = wt_fail(err, story.status, "out of memory");
    if (status == WT_OK)
        *table = made;
    else
        wt_table_free(made);
    return status;
}
