/* Writes the answer of a run: a summary and one section for each question of the user.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer.h"
#include "case/answer/limits.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/number.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static const char title_summary[] = "In short";
static const char question_layer[] = "Is there a modified layer?";
static const char question_difference[] = "How different is it?";
static const char question_thickness[] = "How thick is it?";
static const char question_friction[] = "What does it do to friction?";
static const char title_not_requested[] = "What was not asked?";

/* Returns the message of a stage that failed completely or failed at a higher level. */
static const char *stage_failure_message(const answer_context *context, const char *stage)
{
    const size_t length = strlen(stage);
    for (size_t i = 0; i < context->failures.n_rows; i++) {
        const char *name = failures_text(&context->failures, i, FAILURES_FILE);
        if (strncmp(name, "stage ", 6) == 0 && strncmp(name + 6, stage, length) == 0 &&
            (name[6 + length] == '\0' || name[6 + length] == ' '))
            return failures_text(&context->failures, i, FAILURES_MESSAGE);
    }
    return "the stage failed";
}

/* Returns the stage that keeps `stage` from running. It is the first failed stage among those whose
 * outputs `stage` needs; blocked stages are followed to their own cause. */
static flow_stage_id find_failed_stage(const flow_plan *plan, flow_stage_id stage, unsigned level)
{
    const flow_resource_set takes =
        flow_plan_needs(plan, stage, level) | flow_stages[stage].alternatives;
    for (size_t i = 0; i < FLOW_N_STAGES && i < (size_t)stage; i++) {
        if ((flow_stages[i].outputs & takes) == 0)
            continue;
        if (plan->outcome[i] == FLOW_FAILED)
            return (flow_stage_id)i;
        if (plan->outcome[i] == FLOW_BLOCKED)
            return find_failed_stage(plan, (flow_stage_id)i, 0);
    }
    return stage;
}

/* Adds a sentence with the reason why a requested result is missing. */
static void add_reason(const answer_context *context, flow_stage_id stage, flow_outcome outcome,
                       const char *question, answer_kind kind)
{
    const flow_plan *plan = context->plan;
    if (outcome == FLOW_FAILED)
        answer_add_sentence(context, question, kind, "Not answered: %s.",
                            stage_failure_message(context, flow_stages[stage].id));
    else if (outcome == FLOW_BLOCKED) {
        const flow_stage_id root = find_failed_stage(plan, stage, plan->level[stage]);
        answer_add_sentence(context, question, kind,
                            "Not answered: a stage that %s needs failed (%s): %s.",
                            flow_stages[stage].id, flow_stages[root].id,
                            stage_failure_message(context, flow_stages[root].id));
    } else if (outcome == FLOW_UNMEASURED)
        answer_add_sentence(context, question, kind, "Not measured: %s.", plan->unmeasured_reason);
}

static void add_unanswered(const answer_context *context, flow_stage_id stage, const char *question,
                           answer_kind kind)
{
    add_reason(context, stage, context->plan->outcome[stage], question, kind);
}

/* Adds what the case does not request, or has no data for, after all other sections. */
static void add_not_requested(const answer_context *context)
{
    static const struct {
        flow_stage_id stage;
        const char *question;
        answer_kind kind;
    } questions[] = {{FLOW_STAGE_COMPARISON, question_layer, ANSWER_KIND_LAYER},
                     {FLOW_STAGE_LAYER, question_thickness, ANSWER_KIND_THICKNESS},
                     {FLOW_STAGE_FRICTION, question_friction, ANSWER_KIND_FRICTION}};
    const flow_plan *plan = context->plan;
    for (size_t i = 0; i < COUNT_OF(questions); i++) {
        const flow_stage_id stage = questions[i].stage;
        if (plan->outcome[stage] == FLOW_EXCLUDED && !plan->chosen[stage])
            answer_add_sentence(context, title_not_requested, questions[i].kind,
                                "%s Not asked: %s.", questions[i].question, plan->reason[stage]);
    }
    if (plan->outcome[FLOW_STAGE_FRICTION] == FLOW_DONE &&
        plan->full_outcome[FLOW_STAGE_FRICTION] == FLOW_EXCLUDED &&
        plan->lower_level_reason[FLOW_STAGE_FRICTION][0] != '\0')
        answer_add_sentence(context, title_not_requested, ANSWER_KIND_FRICTION,
                            "What the layer does to friction. Not asked: %s.",
                            plan->lower_level_reason[FLOW_STAGE_FRICTION]);
}

/* ---- summary --------------------------------------------------------------------------------- */

static void add_summary(const answer_context *context, const char *what, const char *text)
{
    answer_add_sentence(context, title_summary, ANSWER_KIND_SHORT, "%s: %s.", what, text);
}

/* Adds the summary line of a requested result that is missing. */
static void add_missing_summary(const answer_context *context, const char *what,
                                flow_stage_id stage)
{
    const flow_outcome outcome = context->plan->outcome[stage];
    if (outcome == FLOW_FAILED)
        answer_add_sentence(context, title_summary, ANSWER_KIND_SHORT, "%s: not answered: %s.",
                            what, stage_failure_message(context, flow_stages[stage].id));
    else if (outcome == FLOW_BLOCKED)
        answer_add_sentence(context, title_summary, ANSWER_KIND_SHORT,
                            "%s: not answered, for what it needs failed.", what);
    else if (outcome == FLOW_UNMEASURED)
        answer_add_sentence(context, title_summary, ANSWER_KIND_SHORT, "%s: not measured: %s.",
                            what, context->plan->unmeasured_reason);
}

static void append_friction_summary(const answer_context *context, text_builder *t)
{
    const result_value_tables *found = &context->values;
    const result_value total = result_value_friction(found, FRICTION_KEY_FRICTION),
                       hysteresis = result_value_friction(found, FRICTION_KEY_HYSTERESIS),
                       with_layer = result_value_friction(found, FRICTION_KEY_WITH_LAYER);
    if (!isnan(with_layer.number.value)) {
        append_friction_change(t, found, true);
        text_append(t, "; mu = %s without it and %s with it", format_plain_number(&total).text,
                    format_plain_number(&with_layer).text);
    } else if (!isnan(total.number.value))
        text_append(t, "mu = %s without a layer", format_result_value(&total).text);
    else
        text_append(t, "hysteresis part %s without a layer", format_result_value(&hysteresis).text);
    text_append(t, ", at %s", format_with_unit(total.velocity, "m/s").text);
}

static void answer_summary(const answer_context *context)
{
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    const char *thickness =
        is_thickness_put_in(&context->values) ? "Thickness" : "Thickness (predicted)";
    if (context->values.comparison.table != NULL) {
        append_modulus_ratio(&t, &context->values);
        add_summary(context, "Layer (measured)", text);
    } else
        add_missing_summary(context, "Layer (measured)", FLOW_STAGE_COMPARISON);
    t.used = 0;
    if (context->values.layer.table != NULL) {
        append_thickness(&t, &context->values);
        add_summary(context, thickness, text);
    } else
        add_missing_summary(context, thickness, FLOW_STAGE_LAYER);
    t.used = 0;
    if (context->values.friction.table != NULL) {
        append_friction_summary(context, &t);
        add_summary(context, "Friction (predicted)", text);
    } else
        add_missing_summary(context, "Friction (predicted)", FLOW_STAGE_FRICTION);
}

/* ---- layer, difference ----------------------------------------------------------------------- */

/* The first row of the table comparison holds the comparison over all rates. */
static double comparison_overall(const answer_context *context, comparison_column column)
{
    return comparison_get(&context->values.comparison, 0, column);
}

/* "4 spots in the bulk and 5 in the track; p 0.01 by Welch, 0.03 by Mann and Whitney ..." */
static void format_evidence(const answer_context *context, char *text, size_t size)
{
    const analysis_unit unit = (analysis_unit)comparison_key_enum(&context->values.comparison,
                                                                  COMPARISON_KEY_UNIT_OF_ANALYSIS);
    const double smallest = comparison_overall(context, COMPARISON_MANN_WHITNEY_SMALLEST_P);
    const double scatter =
        comparison_value(&context->values.comparison, COMPARISON_KEY_SPOT_SCATTER).value;
    const double n[] = {comparison_overall(context, COMPARISON_SPOTS_BULK),
                        comparison_overall(context, COMPARISON_SPOTS_TRACK)};
    char least[96] = "";
    if (scatter > 0) {
        clocale_print(text, size,
                      "%.0f spot%s in the bulk and %.0f in the track, which scatter by %.3g %% as "
                      "given; p %s",
                      n[0], n[0] > 1 ? "s" : "", n[1], 100 * scatter,
                      format_probability(comparison_overall(context, COMPARISON_WELCH_P)).text);
        return;
    }
    if (smallest > 0.05)
        clocale_print(least, sizeof least, ", which cannot be below %.2g with so few", smallest);
    clocale_print(text, size,
                  "%.0f %s in the bulk and %.0f in the track; p %s by Welch, %s by "
                  "Mann and Whitney%s",
                  n[0], unit == UNIT_IS_CURVE ? "curves" : "spots", n[1],
                  format_probability(comparison_overall(context, COMPARISON_WELCH_P)).text,
                  format_probability(comparison_overall(context, COMPARISON_MANN_WHITNEY_P)).text,
                  least);
}

static void answer_layer(const answer_context *context)
{
    if (context->values.comparison.table == NULL) {
        add_unanswered(context, FLOW_STAGE_COMPARISON, question_layer, ANSWER_KIND_LAYER);
        return;
    }
    const result_value ratio = result_value_ratio(&context->values);
    char evidence[480] = "";
    if (!isnan(ratio.low)) {
        char found[320];
        format_evidence(context, found, sizeof found);
        clocale_print(evidence, sizeof evidence, " E_track/E_bulk = %s, %s (%s).",
                      format_plain_number(&ratio).text, format_interval(&ratio).text, found);
    }
    answer_add_sentence(context, question_layer, ANSWER_KIND_LAYER, "%c%s.%s%s%s%s",
                        toupper((unsigned char)ratio.verdict[0]), ratio.verdict + 1, evidence,
                        ratio.remedy != NULL ? " What would settle it: " : "",
                        ratio.remedy != NULL ? ratio.remedy : "", ratio.remedy != NULL ? "." : "");
}

static void add_group_modulus(const answer_context *context, const char *name, const char *words)
{
    const table_view *groups = &context->values.groups;
    size_t row = 0;
    while (row < groups->n_rows &&
           strcmp(modulus_groups_text(groups, row, MODULUS_GROUPS_GROUP), name) != 0)
        row++;
    if (row == groups->n_rows)
        return;
    const result_value modulus = result_value_group(&context->values, row);
    const double n_spots = modulus_groups_get(groups, row, MODULUS_GROUPS_N_SPOTS);
    char interval[480] = "";
    if (!isnan(modulus.low))
        snprintf(interval, sizeof interval, "%s by %s", format_interval(&modulus).text,
                 modulus.includes);
    else
        snprintf(interval, sizeof interval, "%s",
                 n_spots < 2 ? "no interval from fewer than two spots"
                             : "no interval, because an error that all curves share is not known");
    if (!(modulus_groups_get(groups, row, MODULUS_GROUPS_N) > 0)) {
        const double rejected = modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED);
        if (rejected == 1)
            answer_add_sentence(context, question_difference, ANSWER_KIND_DIFFERENCE,
                                "%s: the only curve has no modulus.", words);
        else
            answer_add_sentence(context, question_difference, ANSWER_KIND_DIFFERENCE,
                                "%s: none of the %.0f curves has a modulus.", words, rejected);
        return;
    }
    answer_add_sentence(
        context, question_difference, ANSWER_KIND_DIFFERENCE,
        "%s: E = %s%s (geometric mean, %s) from %.0f curves on %.0f spot%s, %.0f rejected.", words,
        format_plain_number(&modulus).text, format_frequency(&modulus).text, interval,
        modulus_groups_get(groups, row, MODULUS_GROUPS_N), n_spots, n_spots > 1 ? "s" : "",
        modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED));
}

/* Adds the verdict on the change of the modulus with depth. */
static void add_depth_verdict(answer_context *context, const char *name, const char *words)
{
    table_view depth = context->modulus_depth;
    depth.suffix = name;
    const char *changes = modulus_depth_key_text(&depth, MODULUS_DEPTH_KEY_CHANGES);
    if (changes == NULL)
        return;
    answer_add_sentence(context, question_difference, ANSWER_KIND_DIFFERENCE,
                        "Does the modulus of the %s change with depth? "
                        "%c%s.",
                        words, toupper((unsigned char)changes[0]), changes + 1);
}

static void add_rate_ratios(const answer_context *context)
{
    double low = (double)NAN, high = (double)NAN, largest_p = (double)NAN;
    size_t n = 0;
    for (size_t i = 1; i < context->values.comparison.n_rows; i++) {
        double ratio = comparison_get(&context->values.comparison, i, COMPARISON_RATIO);
        if (isnan(ratio))
            continue;
        n++;
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        largest_p =
            fmax(largest_p, comparison_get(&context->values.comparison, i, COMPARISON_HOLM_P));
    }
    if (n >= 2)
        answer_add_sentence(context, question_difference, ANSWER_KIND_DIFFERENCE,
                            "Rate by rate (%zu indentation rates) the ratio is %s; the "
                            "largest p after Holm's correction is %s.",
                            n, format_range(low, high, 3).text, format_probability(largest_p).text);
}

static void add_dma_ratio(const answer_context *context)
{
    double low, high;
    if (!find_dma_ratio(&context->dma_comparison, &low, &high))
        return;
    const bool alarm = is_different_rubber(low, high);
    const number_text first = format_with_unit(low, "1"), last = format_with_unit(high, "1");
    const bool one = strcmp(first.text, last.text) == 0;
    char lever[128] = "";
    wt_estimate k = indentation_value(&context->indentation[0], INDENTATION_KEY_SPRING_CONSTANT);
    if (k.standard_error > 0)
        clocale_print(lever, sizeof lever,
                      ", of which the spring constant leaves %.2g %% uncertain",
                      100 * k.standard_error / k.value);
    answer_add_sentence(
        context, question_difference, ANSWER_KIND_DIFFERENCE,
        "%sAt equal frequency the indentation modulus of the bulk is %s%s%s times |E*| of "
        "the DMA%s.%s",
        alarm ? "Alarm: indentation and DMA do not describe one rubber. " : "", first.text,
        one ? "" : " to ", one ? "" : last.text, lever,
        alarm ? " Units, spring constant, sensitivity, tip, temperature and the files "
                "themselves are to be checked before anything else is believed."
              : "");
}

static void answer_difference(answer_context *context)
{
    if (context->values.comparison.table == NULL) {
        add_unanswered(context, FLOW_STAGE_COMPARISON, question_difference, ANSWER_KIND_DIFFERENCE);
    } else if (isnan(comparison_overall(context, COMPARISON_RATIO))) {
        answer_add_sentence(context, question_difference, ANSWER_KIND_DIFFERENCE,
                            "The ratio of the moduli cannot be told, for the reason above.");
    } else {
        const result_value ratio = result_value_ratio(&context->values);
        const double effect = comparison_overall(context, COMPARISON_EFFECT_SIZE);
        char size[96] = "";
        if (isnan(ratio.low))
            snprintf(size, sizeof size, "; an interval cannot be told, for the reason above");
        else if (!isnan(effect))
            clocale_print(size, sizeof size, "; effect size (Hedges' g of ln E) %.2g", effect);
        char rates[256] = "";
        text_builder t = {rates, sizeof rates, 0};
        append_rate_correction(&t, &context->values);
        answer_add_sentence(
            context, question_difference, ANSWER_KIND_DIFFERENCE,
            "The modulus of the wear track is %s times that of the bulk (%+.0f %%)%s%s%s.",
            format_plain_number(&ratio).text, 100 * (ratio.number.value - 1),
            format_frequency(&ratio).text, rates, size);
    }
    add_group_modulus(context, "bulk", "Bulk");
    add_group_modulus(context, "track", "Wear track");
    add_depth_verdict(context, "bulk", "bulk");
    add_depth_verdict(context, "track", "wear track");
    add_rate_ratios(context);
    add_dma_ratio(context);
}

/* ---- thickness ------------------------------------------------------------------------------- */

static void add_formation_times(const answer_context *context)
{
    wt_estimate incubation = layer_value(&context->values.layer, LAYER_KEY_INCUBATION_TIME);
    wt_estimate settled = layer_value(&context->values.layer, LAYER_KEY_TIME_TO_90_PERCENT);
    if (isnan(incubation.value))
        return;
    char then[192] = "";
    if (!isnan(settled.value))
        clocale_print(then, sizeof then, " and reaches 90 %% of the balance after %s",
                      format_known_estimate(settled).text);
    answer_add_sentence(context, question_thickness, ANSWER_KIND_THICKNESS,
                        "It begins to form after %s%s, time under load.",
                        format_known_estimate(incubation).text, then);
}

/* The text includes the model choices that cause the limits of the range. */
static result_value_text format_thickness(const answer_context *context)
{
    const result_value thickness = result_value_thickness(&context->values);
    const result_value_text choices = format_choices(&thickness);
    const bool none = !(thickness.number.value > 0);
    result_value_text result = {""};
    text_builder t = {result.text, sizeof result.text, 0};
    if (none && choices.text[0] != '\0')
        text_append(&t, ", but %s", choices.text);
    else if (!none)
        text_append(&t, "%s (%s)%s%s", format_plain_number(&thickness).text,
                    format_interval(&thickness).text, choices.text[0] != '\0' ? "; " : "",
                    choices.text);
    return result;
}

static void answer_thickness(answer_context *context)
{
    const table_view *layer = &context->values.layer;
    if (layer->table == NULL) {
        add_unanswered(context, FLOW_STAGE_LAYER, question_thickness, ANSWER_KIND_THICKNESS);
        return;
    }
    const result_value thickness = result_value_thickness(&context->values);
    const number_text ratio =
        format_known_estimate(layer_value(layer, LAYER_KEY_FORMATION_WEAR_RATIO));
    const number_text velocity = format_with_unit(thickness.velocity, "m/s"),
                      pressure = format_with_unit(thickness.pressure, "Pa");
    const result_value_text result = format_thickness(context);
    const bool none = layer_key_enum(layer, LAYER_KEY_REGIME) == WT_LAYER_NONE;
    if (none)
        answer_add_sentence(
            context, question_thickness, ANSWER_KIND_THICKNESS,
            "There is none at %s and %s%s: wear removes the rubber faster than it is modified "
            "(formation over wear R = %s, not above 1). The specific wear rate would have to be "
            "below %s.",
            velocity.text, pressure.text, result.text, ratio.text,
            format_with_unit(layer_value(layer, LAYER_KEY_CRITICAL_WEAR_RATE).value, "m^2/N").text);
    else if (isinf(thickness.number.value))
        answer_add_sentence(
            context, question_thickness, ANSWER_KIND_THICKNESS,
            "Without wear it grows without end, ever more slowly; the table layer gives its "
            "thickness in time.");
    else
        answer_add_sentence(
            context, question_thickness, ANSWER_KIND_THICKNESS,
            "%s. That is where formation balances wear, at %s and %s; %s. Formation over "
            "wear R = %s. With 1 %% more wear it is %.2g %% thinner.",
            result.text, velocity.text, pressure.text, format_thickness_origin(&context->values),
            ratio.text, -layer_value(layer, LAYER_KEY_WEAR_SENSITIVITY).value);
    answer_layer_wear_rate(context, question_thickness);
    if (!none)
        add_formation_times(context);
    if (thickness.range.widest != NULL)
        answer_add_sentence(context, question_thickness, ANSWER_KIND_THICKNESS,
                            "What would settle it most: a measurement that settles the %s.",
                            thickness.range.widest);
}

/* ---- friction -------------------------------------------------------------------------------- */

static void add_bulk_friction(const answer_context *context)
{
    const result_value_tables *found = &context->values;
    const result_value total = result_value_friction(found, FRICTION_KEY_FRICTION),
                       hysteresis = result_value_friction(found, FRICTION_KEY_HYSTERESIS),
                       area = result_value_friction(found, FRICTION_KEY_AREA_RATIO);
    const number_text velocity = format_with_unit(total.velocity, "m/s");
    if (isnan(total.number.value))
        answer_add_sentence(
            context, question_friction, ANSWER_KIND_FRICTION,
            "Without a layer, at %s, the hysteresis part is %s, with a real contact of the "
            "nominal area of %s; the total is not known because no shear stress is given.",
            velocity.text, format_result_value(&hysteresis).text, format_result_value(&area).text);
    else
        answer_add_sentence(
            context, question_friction, ANSWER_KIND_FRICTION,
            "Without a layer, at %s, mu = %s: hysteresis %s, shearing of the real contact "
            "%.3g; contact area of the nominal one %s.",
            velocity.text, format_result_value(&total).text, format_result_value(&hysteresis).text,
            total.number.value - hysteresis.number.value, format_result_value(&area).text);
}

static void add_friction_change(const answer_context *context)
{
    const result_value_tables *found = &context->values;
    const table_view *friction = &found->friction;
    const result_value with_layer = result_value_friction(found, FRICTION_KEY_WITH_LAYER),
                       change = result_value_friction(found, FRICTION_KEY_RELATIVE_CHANGE);
    const size_t n = friction->n_rows;
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    append_friction_change(&t, found, true);
    if (n > 1)
        text_append(&t, ". From %s to %s the change is %+.0f %% to %+.0f %%",
                    format_with_unit(friction_get(friction, 0, FRICTION_VELOCITY), "m/s").text,
                    format_with_unit(friction_get(friction, n - 1, FRICTION_VELOCITY), "m/s").text,
                    100 * friction_value(friction, FRICTION_KEY_RELATIVE_CHANGE_LOW).value,
                    100 * friction_value(friction, FRICTION_KEY_RELATIVE_CHANGE_HIGH).value);
    const wt_estimate ratio = friction_value(friction, FRICTION_KEY_LAYER_MODULUS_RATIO);
    const bool own = isnan(ratio.value) && friction_key_text(friction, FRICTION_KEY_LAYER_MODULI);
    answer_add_sentence(
        context, question_friction, ANSWER_KIND_FRICTION,
        "With the layer (%s thick, %s%s), at %s, mu "
        "= %s.",
        format_value(friction_value(friction, FRICTION_KEY_LAYER_THICKNESS)).text,
        own ? "of a material of its own" : "modulus ratio ", own ? "" : format_value(ratio).text,
        format_with_unit(with_layer.velocity, "m/s").text, format_result_value(&with_layer).text);
    answer_add_sentence(context, question_friction, ANSWER_KIND_FRICTION, "%c%s.",
                        toupper((unsigned char)text[0]), text + 1);
    if (change.range.widest != NULL)
        answer_add_sentence(context, question_friction, ANSWER_KIND_FRICTION,
                            "What would settle it most: a measurement that settles the %s.",
                            change.range.widest);
}

static void answer_friction(const answer_context *context)
{
    const result_value_tables *found = &context->values;
    if (found->friction.table == NULL) {
        add_unanswered(context, FLOW_STAGE_FRICTION, question_friction, ANSWER_KIND_FRICTION);
        return;
    }
    add_bulk_friction(context);
    if (friction_key_text(&found->friction, FRICTION_KEY_LAYER_THICKNESS) == NULL)
        add_reason(context, FLOW_STAGE_FRICTION, context->plan->full_outcome[FLOW_STAGE_FRICTION],
                   question_friction, ANSWER_KIND_FRICTION);
    else if (isnan(result_value_friction(found, FRICTION_KEY_WITH_LAYER).number.value))
        return;
    else if (!(friction_value(&found->friction, FRICTION_KEY_LAYER_THICKNESS).value > 0))
        answer_add_sentence(context, question_friction, ANSWER_KIND_FRICTION,
                            "Where wear leaves no layer, that is the friction: nothing changes.");
    else
        add_friction_change(context);
}

/* ---- the answer ------------------------------------------------------------------------------ */

wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_log *log, const wt_table *failures, wt_table **table,
                      wt_table **limits, wt_error *err)
{
    answer_context context = {.c = c, .plan = plan, .log = log};
    wt_status status = answer_context_bind(&context, result, err);
    if (status == WT_OK)
        status = table_bind(failures, &failures_schema, "", &context.failures, err);
    if (status != WT_OK)
        return status;
    table_writer answer = table_begin(&answer_schema, err);
    context.answer = &answer;
    answer_summary(&context);
    answer_rubber(&context);
    answer_layer(&context);
    answer_difference(&context);
    answer_thickness(&context);
    answer_track_layer(&context);
    answer_identification(&context);
    answer_friction(&context);
    answer_validation(&context);
    answer_surface(&context);
    answer_record(&context);
    add_not_requested(&context);
    if (wt_case_title(c)[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_TITLE, wt_case_title(c));
    if (c->sample[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_SAMPLE, c->sample);
    if (c->condition[0] != '\0')
        answer_set_text(&answer, ANSWER_KEY_CASE_CONDITION, c->condition);
    wt_table *made = NULL;
    status = table_end(&answer, &made);
    if (status == WT_OK)
        status = limits_table(&context, limits, err);
    if (status == WT_OK)
        *table = made;
    else
        wt_table_free(made);
    return status;
}
