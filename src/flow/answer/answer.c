/* The answer of a run: the four questions a user brings, and the material of a case that is about
 * nothing else.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/answer.h"
#include "flow/answer/caveats.h"

#include "base/array.h"
#include "base/clocale.h"
#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static const char what_rubber[] = "What is the rubber like?";
static const char is_there[] = "Is there a modified layer?";
static const char how_different[] = "How different is it?";
static const char how_thick[] = "How thick is it?";
static const char what_friction[] = "What does it do to friction?";

/* mm^3/(N m) in a specific wear rate of 1 m^2/N. */
#define MM3_PER_N_M 1e9

/* The message of a stage that failed, or that failed to take more into account. */
static const char *why_failed(const answer_story *story, const char *stage)
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

/* Why something was not given, as a sentence. */
static void say_why_not(const answer_story *story, flow_stage_id stage, flow_outcome outcome,
                        const char *because, const char *question, const char *kind)
{
    const char *id = flow_stages[stage].id;
    if (outcome == FLOW_FAILED)
        answer_say(story, question, kind, "Not answered: %s.", why_failed(story, id));
    else if (outcome == FLOW_BLOCKED)
        answer_say(story, question, kind,
                   "Not answered: a stage that %s needs failed; the table failures says why.", id);
    else
        answer_say(story, question, kind, "Not asked: %s.", because);
}

static void say_missing(const answer_story *story, flow_stage_id stage, const char *question,
                        const char *kind)
{
    static const char left_out[] = "left out because ";
    const char *because = story->plan->because[stage];
    if (strncmp(because, left_out, strlen(left_out)) == 0)
        because += strlen(left_out);
    say_why_not(story, stage, story->plan->outcome[stage], because, question, kind);
}

/* ---- layer, difference ----------------------------------------------------------------------- */

/* The first row of the comparison is that over all rates. */
static double over_all(const answer_story *story, comparison_column column)
{
    return comparison_get(&story->comparison, 0, column);
}

static bool said(const answer_story *story, const char *verdict)
{
    const char *differs = comparison_words(&story->comparison, COMPARISON_KEY_DIFFERS);
    return differs != NULL && strncmp(differs, verdict, strlen(verdict)) == 0;
}

/* "4 spots in the bulk and 5 in the track; p 0.01 by Welch, 0.03 by Mann and Whitney ..." */
static void list_evidence(const answer_story *story, char *text, size_t size)
{
    const char *unit = comparison_words(&story->comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    const double smallest = over_all(story, COMPARISON_MANN_WHITNEY_SMALLEST_P);
    char least[96] = "";
    if (smallest > 0.05)
        clocale_print(least, sizeof least, ", which cannot be below %.2g with so few", smallest);
    clocale_print(text, size,
                  "%.0f %s in the bulk and %.0f in the track; p %s by Welch, %s by "
                  "Mann and Whitney%s",
                  over_all(story, COMPARISON_SPOTS_BULK),
                  strncmp(unit, "curve", 5) == 0 ? "curves" : "spots",
                  over_all(story, COMPARISON_SPOTS_TRACK),
                  number_chance(over_all(story, COMPARISON_WELCH_P)).text,
                  number_chance(over_all(story, COMPARISON_MANN_WHITNEY_P)).text, least);
}

static void answer_layer(const answer_story *story)
{
    if (story->comparison.table == NULL) {
        say_missing(story, FLOW_STAGE_COMPARISON, is_there, "layer");
        return;
    }
    const char *differs = comparison_words(&story->comparison, COMPARISON_KEY_DIFFERS);
    const char *settled = comparison_words(&story->comparison, COMPARISON_KEY_SETTLED_BY);
    const double low = over_all(story, COMPARISON_RATIO_LOW);
    char evidence[320] = "";
    if (!isnan(low)) {
        char found[256];
        list_evidence(story, found, sizeof found);
        clocale_print(evidence, sizeof evidence,
                      " E_track/E_bulk = %#.3g, 95 %% interval %#.3g to %#.3g (%s).",
                      over_all(story, COMPARISON_RATIO), low,
                      over_all(story, COMPARISON_RATIO_HIGH), found);
    }
    answer_say(story, is_there, "layer", "%c%s.%s%s%s%s", toupper((unsigned char)differs[0]),
               differs + 1, evidence, settled != NULL ? " What would settle it: " : "",
               settled != NULL ? settled : "", settled != NULL ? "." : "");
}

static void say_group(const answer_story *story, const char *name, const char *words)
{
    const table_view *groups = &story->modulus_groups;
    size_t row = 0;
    while (row < groups->n_rows &&
           strcmp(modulus_groups_text(groups, row, MODULUS_GROUPS_GROUP), name) != 0)
        row++;
    if (row == groups->n_rows)
        return;
    double low = modulus_groups_get(groups, row, MODULUS_GROUPS_LOW);
    double high = modulus_groups_get(groups, row, MODULUS_GROUPS_HIGH);
    double n_spots = modulus_groups_get(groups, row, MODULUS_GROUPS_N_SPOTS);
    char interval[224] = "no interval from fewer than two spots";
    if (!isnan(low) && !isnan(high))
        snprintf(interval, sizeof interval, "95 %% interval %s to %s", words_of(low, "Pa").text,
                 words_of(high, "Pa").text);
    answer_say(story, how_different, "difference",
               "%s: E = %s (geometric mean, %s) from %.0f curves on %.0f spot%s, %.0f rejected.",
               words,
               words_of(modulus_groups_get(groups, row, MODULUS_GROUPS_GEOMETRIC_MEAN), "Pa").text,
               interval, modulus_groups_get(groups, row, MODULUS_GROUPS_N), n_spots,
               n_spots > 1 ? "s" : "", modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED));
}

/* What depth does to the modulus. */
static void say_depth(const answer_story *story, const char *name, const char *words)
{
    table_view depth = story->modulus_depth;
    depth.suffix = name;
    const char *changes = modulus_depth_words(&depth, MODULUS_DEPTH_KEY_CHANGES);
    const char *reading = modulus_depth_words(&depth, MODULUS_DEPTH_KEY_READING);
    if (changes == NULL)
        return;
    answer_say(story, how_different, "difference",
               "Does the modulus of the %s change with depth? "
               "%c%s.",
               words, toupper((unsigned char)changes[0]), changes + 1);
    if (reading != NULL)
        answer_say(story, how_different, "caveat", "%c%s.", toupper((unsigned char)reading[0]),
                   reading + 1);
}

static void say_rates(const answer_story *story)
{
    double low = (double)NAN, high = (double)NAN, largest_p = (double)NAN;
    size_t n = 0;
    for (size_t i = 1; i < story->comparison.n_rows; i++) {
        double ratio = comparison_get(&story->comparison, i, COMPARISON_RATIO);
        if (isnan(ratio))
            continue;
        n++;
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        largest_p = fmax(largest_p, comparison_get(&story->comparison, i, COMPARISON_HOLM_P));
    }
    if (n >= 2)
        answer_say(story, how_different, "difference",
                   "Rate by rate (%zu indentation rates) the ratio is %.3g to %.3g; the "
                   "largest p after Holm's correction is %s.",
                   n, low, high, number_chance(largest_p).text);
}

static void say_dma(const answer_story *story)
{
    const table_view *dma = &story->dma_comparison;
    double low = (double)NAN, high = (double)NAN;
    for (size_t i = 0; i < dma->n_rows; i++) {
        if (strcmp(dma_comparison_text(dma, i, DMA_COMPARISON_GROUP), "bulk") != 0)
            continue;
        double ratio = dma_comparison_get(dma, i, DMA_COMPARISON_RATIO);
        low = fmin(low, ratio);
        high = fmax(high, ratio);
    }
    if (isnan(low))
        return;
    const bool alarm = low < 1 / ANSWER_DMA_FACTOR || high > ANSWER_DMA_FACTOR;
    char range[64], end[32], lever[128] = "";
    clocale_print(range, sizeof range, "%.3g", low);
    clocale_print(end, sizeof end, "%.3g", high);
    if (strcmp(range, end) != 0)
        clocale_print(range, sizeof range, "%.3g to %s", low, end);
    wt_estimate k = indentation_value(&story->indentation[0], INDENTATION_KEY_SPRING_CONSTANT);
    if (k.standard_error > 0)
        clocale_print(lever, sizeof lever,
                      ", of which the spring constant leaves %.2g %% uncertain",
                      100 * k.standard_error / k.value);
    answer_say(story, how_different, "difference",
               "%sAt equal frequency the indentation modulus of the bulk is %s times |E*| of the "
               "DMA%s.%s",
               alarm ? "Alarm: indentation and DMA do not describe one rubber. " : "", range, lever,
               alarm ? " Units, spring constant, sensitivity, tip, temperature and the files "
                       "themselves are to be checked before anything else is believed."
                     : "");
}

static void answer_difference(const answer_story *story)
{
    if (story->comparison.table == NULL) {
        say_missing(story, FLOW_STAGE_COMPARISON, how_different, "difference");
    } else if (isnan(over_all(story, COMPARISON_RATIO))) {
        answer_say(story, how_different, "difference",
                   "The ratio of the moduli cannot be told, for the reason above.");
    } else {
        const double ratio = over_all(story, COMPARISON_RATIO);
        const double effect = over_all(story, COMPARISON_EFFECT_SIZE);
        char size[96] = "; an interval cannot be told, for the reason above";
        if (!isnan(effect))
            clocale_print(size, sizeof size, "; effect size (Hedges' g of ln E) %.2g", effect);
        answer_say(story, how_different, "difference",
                   "The modulus of the wear track is %.3g times that of the bulk (%+.0f %%)%s.",
                   ratio, 100 * (ratio - 1), size);
    }
    say_group(story, "bulk", "Bulk");
    say_group(story, "track", "Wear track");
    say_depth(story, "bulk", "bulk");
    say_depth(story, "track", "wear track");
    say_rates(story);
    say_dma(story);
}

/* Of a number, how far it moves with the model: " (2.60 um to 11.0 um if ...)". */
typedef struct range_text {
    char text[256];
} range_text;

static range_text range_of(const answer_story *story, what_if_key key)
{
    const char *range = what_if_words(&story->what_if, key);
    range_text words = {""};
    if (range != NULL)
        snprintf(words.text, sizeof words.text, " (%s)", range);
    return words;
}

/* ---- thickness ------------------------------------------------------------------------------- */

static void say_times(const answer_story *story)
{
    wt_estimate incubation = layer_value(&story->layer, LAYER_KEY_INCUBATION_TIME);
    wt_estimate settled = layer_value(&story->layer, LAYER_KEY_TIME_TO_90_PERCENT);
    if (isnan(incubation.value))
        return;
    char then[192] = "";
    if (!isnan(settled.value))
        clocale_print(then, sizeof then, " and reaches 90 %% of the balance after %s",
                      words_of_estimate(settled).text);
    answer_say(story, how_thick, "thickness", "It begins to form after %s%s (time under load).",
               words_of_estimate(incubation).text, then);
}

/* Indentation and layer model need not agree; where they do not, the reader is told. */
static void say_disagreement(const answer_story *story, bool modelled)
{
    if (story->comparison.table == NULL)
        return;
    if (said(story, "yes") && !modelled)
        answer_say(story, how_thick, "caveat",
                   "This does not agree with the indentation, which shows a modified track: the "
                   "specific wear rate, the critical energy or the model does not fit it.");
    if (!said(story, "yes") && modelled)
        answer_say(story, how_thick, "caveat",
                   "The indentation %s this layer: it is what the model makes of the specific wear "
                   "rate and the critical energy given.",
                   said(story, "no") ? "does not show" : "cannot say whether there is");
}

static void answer_thickness(const answer_story *story)
{
    const table_view *layer = &story->layer;
    if (layer->table == NULL) {
        say_missing(story, FLOW_STAGE_LAYER, how_thick, "thickness");
        return;
    }
    const wt_estimate thickness = layer_value(layer, LAYER_KEY_BALANCE_THICKNESS);
    const number_words ratio =
        words_of_estimate(layer_value(layer, LAYER_KEY_FORMATION_WEAR_RATIO));
    const number_words velocity = words_of_value(layer_value(layer, LAYER_KEY_VELOCITY));
    const number_words pressure = words_of_value(layer_value(layer, LAYER_KEY_PRESSURE));
    const bool none = strcmp(layer_words(layer, LAYER_KEY_REGIME), "none") == 0;
    if (none)
        answer_say(
            story, how_thick, "thickness",
            "There is none at %s and %s%s: wear removes the rubber faster than it is modified "
            "(formation over wear R = %s, not above 1). The specific wear rate would have to be "
            "below %.3g mm^3/(N m).",
            velocity.text, pressure.text, range_of(story, WHAT_IF_KEY_THICKNESS).text, ratio.text,
            MM3_PER_N_M * layer_value(layer, LAYER_KEY_CRITICAL_WEAR_RATE).value);
    else if (isinf(thickness.value))
        answer_say(story, how_thick, "thickness",
                   "Without wear it grows without end, ever more slowly; the table layer gives its "
                   "thickness in time.");
    else
        answer_say(story, how_thick, "thickness",
                   "%s%s where formation balances wear, at %s and %s (formation over wear R = %s). "
                   "With 1 %% more wear it is %.2g %% thinner.",
                   words_of_estimate(thickness).text, range_of(story, WHAT_IF_KEY_THICKNESS).text,
                   velocity.text, pressure.text, ratio.text,
                   -layer_value(layer, LAYER_KEY_WEAR_SENSITIVITY).value);
    if (!none)
        say_times(story);
    say_disagreement(story, !none);
}

/* ---- friction -------------------------------------------------------------------------------- */

static wt_estimate friction_at(const answer_story *story, friction_key key)
{
    return friction_value(&story->friction, key);
}

static void say_friction(const answer_story *story)
{
    const wt_estimate total = friction_at(story, FRICTION_KEY_FRICTION);
    const wt_estimate hysteresis = friction_at(story, FRICTION_KEY_HYSTERESIS);
    const number_words velocity =
        words_of_value(friction_at(story, FRICTION_KEY_REFERENCE_VELOCITY));
    const number_words area = words_of_estimate(friction_at(story, FRICTION_KEY_AREA_RATIO));
    if (isnan(total.value))
        answer_say(story, what_friction, "friction",
                   "Without a layer, at %s, the hysteresis part is %s%s with a real contact of %s "
                   "of the nominal area; the total is not known because no shear stress is given.",
                   velocity.text, words_of_estimate(hysteresis).text,
                   range_of(story, WHAT_IF_KEY_HYSTERESIS).text, area.text);
    else
        answer_say(story, what_friction, "friction",
                   "Without a layer, at %s, mu = %s%s: hysteresis %s%s, shearing of the real "
                   "contact %.3g (contact area %s of the nominal one).",
                   velocity.text, words_of_estimate(total).text,
                   range_of(story, WHAT_IF_KEY_FRICTION).text, words_of_estimate(hysteresis).text,
                   range_of(story, WHAT_IF_KEY_HYSTERESIS).text, total.value - hysteresis.value,
                   area.text);
}

static void say_change(const answer_story *story)
{
    const size_t n = story->friction.n_rows;
    char range[256] = "";
    if (n > 1)
        snprintf(range, sizeof range, " From %s to %s the change is %+.0f %% to %+.0f %%.",
                 words_of(friction_get(&story->friction, 0, FRICTION_VELOCITY), "m/s").text,
                 words_of(friction_get(&story->friction, n - 1, FRICTION_VELOCITY), "m/s").text,
                 100 * friction_at(story, FRICTION_KEY_RELATIVE_CHANGE_LOW).value,
                 100 * friction_at(story, FRICTION_KEY_RELATIVE_CHANGE_HIGH).value);
    answer_say(story, what_friction, "friction",
               "With the layer (%s thick, modulus ratio %s), at %s, mu = %s%s: a change of %s "
               "(%+.0f %%).%s",
               words_of_estimate(friction_at(story, FRICTION_KEY_LAYER_THICKNESS)).text,
               words_of_estimate(friction_at(story, FRICTION_KEY_LAYER_MODULUS_RATIO)).text,
               words_of_value(friction_at(story, FRICTION_KEY_REFERENCE_VELOCITY)).text,
               words_of_estimate(friction_at(story, FRICTION_KEY_WITH_LAYER)).text,
               range_of(story, WHAT_IF_KEY_WITH_LAYER).text,
               words_of_estimate(friction_at(story, FRICTION_KEY_CHANGE)).text,
               100 * friction_at(story, FRICTION_KEY_RELATIVE_CHANGE).value, range);
}

static void answer_friction(const answer_story *story)
{
    if (story->friction.table == NULL) {
        say_missing(story, FLOW_STAGE_FRICTION, what_friction, "friction");
        return;
    }
    say_friction(story);
    if (friction_words(&story->friction, FRICTION_KEY_LAYER_THICKNESS) == NULL)
        say_why_not(story, FLOW_STAGE_FRICTION, story->plan->fuller[FLOW_STAGE_FRICTION],
                    story->plan->without[FLOW_STAGE_FRICTION], what_friction, "friction");
    else if (isnan(friction_at(story, FRICTION_KEY_WITH_LAYER).value))
        return;
    else if (!(friction_at(story, FRICTION_KEY_LAYER_THICKNESS).value > 0))
        answer_say(story, what_friction, "friction",
                   "Where wear leaves no layer, that is the friction: nothing changes.");
    else
        say_change(story);
}

struct law_text {
    char text[256];
};

/* The law of the shift factors with its constants. */
static struct law_text law_words(const table_view *shift)
{
    struct law_text words;
    const wt_estimate c1 = shift_factors_value(shift, SHIFT_FACTORS_KEY_WLF_C1),
                      energy = shift_factors_value(shift, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY);
    if (isnan(c1.value) && isnan(energy.value))
        snprintf(words.text, sizeof words.text, "no law of the shift factors");
    else if (isnan(c1.value))
        snprintf(words.text, sizeof words.text, "Arrhenius with %s",
                 words_of_estimate(energy).text);
    else
        snprintf(words.text, sizeof words.text, "WLF C1 = %s, C2 = %s%s",
                 words_of_estimate(c1).text,
                 words_of_estimate(shift_factors_value(shift, SHIFT_FACTORS_KEY_WLF_C2)).text,
                 isnan(energy.value) ? "" : ", Arrhenius in the cold");
    return words;
}

/* Only where no later stage uses the material: there it is an answer, else a step. */
static void answer_rubber(const answer_story *story)
{
    const table_view *shift = &story->shift_factors, *prony = &story->prony;
    if (shift->table == NULL || prony->table == NULL || story->comparison.table != NULL ||
        story->friction.table != NULL)
        return;
    const double reference =
        shift_factors_value(shift, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE).value;
    const wt_estimate equilibrium = prony_value(prony, PRONY_KEY_EQUILIBRIUM_MODULUS),
                      limit = prony_value(prony, PRONY_KEY_EQUILIBRIUM_LIMIT);
    const char *verdict = shift_factors_words(shift, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const bool holds = strncmp(verdict, "holds", 5) == 0; /* else a caveat says it */
    answer_say(story, what_rubber, "material",
               "At %s, from %zu isotherms: %s; equilibrium modulus %s%s (%s).%s%s%s",
               words_of_celsius(reference).text, shift->n_rows, law_words(shift).text,
               isnan(limit.value) ? "" : "at most ",
               words_of_estimate(isnan(limit.value) ? equilibrium : limit).text,
               prony_words(prony, PRONY_KEY_DEFORMATION),
               holds ? " Time-temperature superposition " : "", holds ? verdict : "",
               holds ? "." : "");
}

/* ---- the story ------------------------------------------------------------------------------- */

static wt_status bind_tables(const wt_result *result, answer_story *story, wt_error *err)
{
    const struct {
        const table_schema *schema;
        const char *suffix;
        table_view *view;
    } tables[] = {
        {&indentation_schema, "bulk", &story->indentation[0]},
        {&indentation_schema, "track", &story->indentation[1]},
        {&modulus_groups_schema, "", &story->modulus_groups},
        {&modulus_budget_schema, "", &story->modulus_budget},
        {&modulus_depth_schema, "", &story->modulus_depth},
        {&comparison_schema, "", &story->comparison},
        {&dma_comparison_schema, "", &story->dma_comparison},
        {&shift_factors_schema, "", &story->shift_factors},
        {&prony_schema, "", &story->prony},
        {&roughness_schema, "", &story->roughness},
        {&friction_schema, "", &story->friction},
        {&layer_schema, "", &story->layer},
        {&what_if_schema, "", &story->what_if},
    };
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(tables); i++)
        status = table_bind_of(result, tables[i].schema, tables[i].suffix, tables[i].view, err);
    return status;
}

wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_parselog *log, const wt_table *failures, wt_table **table,
                      wt_error *err)
{
    answer_story story = {.c = c, .plan = plan, .log = log};
    wt_status status = bind_tables(result, &story, err);
    if (status == WT_OK)
        status = table_bind(failures, &failures_schema, "", &story.failures, err);
    if (status != WT_OK)
        return status;
    table_writer answer = table_begin(&answer_schema, err);
    story.answer = &answer;
    answer_rubber(&story);
    answer_layer(&story);
    answer_difference(&story);
    answer_thickness(&story);
    answer_friction(&story);
    answer_caveats(&story);
    if (wt_case_title(c)[0] != '\0') /* the title of the page */
        answer_set_text(&answer, ANSWER_KEY_CASE_TITLE, wt_case_title(c));
    return table_end(&answer, table);
}
