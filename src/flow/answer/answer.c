/* The answer of a run: the four questions a user brings, and the material of a case that is about
 * nothing else.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/answer.h"
#include "flow/job/tables.h"

#include "base/clocale.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static const char what_rubber[] = "What is the rubber like?";
static const char is_there[] = "Is there a modified layer?";
static const char how_different[] = "How different is it?";
static const char how_thick[] = "How thick is it?";
static const char what_friction[] = "What does it do to friction?";

/* ---- words ------------------------------------------------------------------------------------
 */

flow_words flow_say(double value, const char *unit)
{
    flow_words words = {""};
    if (isnan(value))
        snprintf(words.text, sizeof words.text, "not known");
    else if (isinf(value))
        snprintf(words.text, sizeof words.text, "without limit");
    else if (strcmp(unit, "1") == 0)
        clocale_print(words.text, sizeof words.text, "%.3g", value);
    else
        wt_format_si(value, unit, 3, words.text, sizeof words.text);
    return words;
}

/* The error in the scale of the value: "3.16 ± 0.96 um". */
flow_words flow_say_estimate(wt_estimate e)
{
    const char *unit = e.unit != NULL ? e.unit : "1";
    flow_words value = flow_say(e.value, unit), words = value;
    if (!isfinite(e.value) || !(e.standard_error > 0) || !isfinite(e.standard_error))
        return words;
    const char *suffix = strchr(value.text, ' ');
    size_t length = suffix == NULL ? strlen(value.text) : (size_t)(suffix - value.text);
    double shown = (double)NAN;
    if (!wt_number_parse(value.text, length, '.', &shown) || !(fabs(shown) > 0))
        return words;
    double error = e.standard_error * fabs(shown / e.value);
    clocale_print(words.text, sizeof words.text,
                  error >= 10 ? "%.*s \xc2\xb1 %.0f%.40s" : "%.*s \xc2\xb1 %.2g%.40s", (int)length,
                  value.text, error, suffix == NULL ? "" : suffix);
    return words;
}

flow_words flow_say_celsius(double kelvin)
{
    flow_words words;
    clocale_print(words.text, sizeof words.text,
                  "%.1f \xc2\xb0"
                  "C",
                  kelvin - WT_ZERO_CELSIUS);
    return words;
}

wt_estimate flow_key(const wt_table *table, const char *key)
{
    wt_estimate e = {(double)NAN, (double)NAN, (double)NAN, "1"};
    if (table == NULL || !wt_table_estimate(table, key, &e))
        return (wt_estimate){(double)NAN, (double)NAN, (double)NAN, "1"};
    return e;
}

wt_status flow_answer_add(wt_table *table, wt_error *err, const char *question, const char *kind,
                          const char *format, ...)
{
    enum { QUESTION, ANSWER, KIND };
    char text[1200];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    wt_status status = wt_table_add_row(table, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, QUESTION, question, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, ANSWER, text, err);
    if (status == WT_OK)
        status = wt_table_put_text(table, KIND, kind, err);
    return status;
}

/* The message of a stage that failed. */
static const char *why_failed(const flow_story *story, const char *stage)
{
    for (size_t i = 0; i < wt_table_n_rows(story->failures); i++) {
        const char *name = flow_table_get_text(story->failures, i, "file");
        if (strncmp(name, "stage ", 6) == 0 && strcmp(name + 6, stage) == 0)
            return flow_table_get_text(story->failures, i, "message");
    }
    return "the stage failed";
}

/* Why a stage gave nothing, as a sentence. */
static wt_status say_missing(const flow_story *story, const char *stage, const char *question,
                             const char *kind, wt_table *table, wt_error *err)
{
    static const char left_out[] = "left out because ";
    size_t i = 0;
    while (i + 1 < flow_n_stages && strcmp(flow_stages[i].id, stage) != 0)
        i++;
    const char *because = story->plan->because[i];
    if (story->outcome[i] == FLOW_FAILED)
        return flow_answer_add(table, err, question, kind, "Not answered: %s.",
                               why_failed(story, stage));
    if (story->outcome[i] == FLOW_BLOCKED)
        return flow_answer_add(table, err, question, kind,
                               "Not answered: a stage that %s needs failed; the table failures "
                               "says why.",
                               stage);
    if (strncmp(because, left_out, strlen(left_out)) == 0)
        because += strlen(left_out);
    return flow_answer_add(table, err, question, kind, "Not asked: %s.", because);
}

/* ---- layer, difference ------------------------------------------------------------------------
 */

static wt_status answer_layer(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *comparison = wt_result_find(story->result, "comparison");
    if (comparison == NULL)
        return say_missing(story, "comparison", is_there, "layer", table, err);
    double ratio = flow_table_get(comparison, 0, "ratio");
    double low = flow_table_get(comparison, 0, "ratio_low");
    double high = flow_table_get(comparison, 0, "ratio_high");
    double p = flow_table_get(comparison, 0, "welch_p");
    double mann_whitney = flow_table_get(comparison, 0, "mann_whitney_p");
    const char *verdict = "Not shown: the modulus of the wear track does not differ from that of "
                          "the bulk at the 95 % level";
    if (high < 1)
        verdict = "Yes: the wear track is softer than the bulk";
    else if (low > 1)
        verdict = "Yes: the wear track is stiffer than the bulk";
    const char *unit = wt_table_key(comparison, "unit_of_analysis");
    bool by_curve = unit != NULL && strncmp(unit, "curve", 5) == 0;
    return flow_answer_add(
        table, err, is_there, "layer",
        "%s%s. E_track/E_bulk = %.3g, 95 %% interval %.3g to %.3g (Welch p of the "
        "difference %.2g, Mann-Whitney p %.2g; %.0f bulk and %.0f track curves).",
        verdict,
        by_curve ? ", where it was measured; whether it is so elsewhere cannot be said without two "
                   "spots or more in each group"
                 : "",
        ratio, low, high, p, mann_whitney, flow_table_get(comparison, 0, "n_bulk"),
        flow_table_get(comparison, 0, "n_track"));
}

/* Row of a group in "modulus_groups", or the number of rows. */
static size_t group_row(const wt_table *groups, const char *name)
{
    size_t n = wt_table_n_rows(groups), i = 0;
    while (i < n && strcmp(flow_table_get_text(groups, i, "group"), name) != 0)
        i++;
    return i;
}

static wt_status say_group(const wt_table *groups, const char *name, const char *words,
                           wt_table *table, wt_error *err)
{
    size_t row = group_row(groups, name);
    if (row == wt_table_n_rows(groups))
        return WT_OK;
    double low = flow_table_get(groups, row, "low"), high = flow_table_get(groups, row, "high");
    char interval[224] = "no interval from fewer than two spots";
    if (!isnan(low) && !isnan(high))
        snprintf(interval, sizeof interval, "95 %% interval %s to %s", flow_say(low, "Pa").text,
                 flow_say(high, "Pa").text);
    return flow_answer_add(
        table, err, how_different, "difference",
        "%s: E = %s (geometric mean, %s) from %.0f curves on %.0f spot%s, %.0f rejected.", words,
        flow_say(flow_table_get(groups, row, "geometric_mean"), "Pa").text, interval,
        flow_table_get(groups, row, "n"), flow_table_get(groups, row, "n_spots"),
        flow_table_get(groups, row, "n_spots") > 1 ? "s" : "",
        flow_table_get(groups, row, "n_rejected"));
}

static wt_status say_rates(const wt_table *comparison, wt_table *table, wt_error *err)
{
    double low = (double)NAN, high = (double)NAN, least = (double)NAN;
    size_t n = 0;
    for (size_t i = 1; i < wt_table_n_rows(comparison); i++) {
        double ratio = flow_table_get(comparison, i, "ratio");
        if (isnan(ratio))
            continue;
        n++;
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        least = fmax(least, flow_table_get(comparison, i, "holm_p"));
    }
    if (n < 2)
        return WT_OK;
    return flow_answer_add(table, err, how_different, "difference",
                           "Rate by rate (%zu indentation rates) the ratio is %.3g to %.3g; the "
                           "largest p after Holm's correction is %.2g.",
                           n, low, high, least);
}

static wt_status say_dma(const wt_table *dma, const wt_table *indentation, wt_table *table,
                         wt_error *err)
{
    double low = (double)NAN, high = (double)NAN;
    size_t n = 0;
    for (size_t i = 0; i < wt_table_n_rows(dma); i++) {
        if (strcmp(flow_table_get_text(dma, i, "group"), "bulk") != 0)
            continue;
        double ratio = flow_table_get(dma, i, "ratio");
        low = fmin(low, ratio);
        high = fmax(high, ratio);
        n++;
    }
    if (n == 0)
        return WT_OK;
    char range[64], lever[128] = "";
    clocale_print(range, sizeof range, n > 1 ? "%.3g to %.3g" : "%.3g", low, high);
    wt_estimate k = flow_key(indentation, "spring_constant");
    if (k.standard_error > 0)
        clocale_print(lever, sizeof lever,
                      "; the stated error of the spring constant is one of %.2g %% in this",
                      100 * k.standard_error / k.value);
    return flow_answer_add(table, err, how_different, "difference",
                           "At equal frequency the indentation modulus of the bulk is %s times "
                           "|E*| of the DMA%s.",
                           range, lever);
}

static wt_status answer_difference(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *groups = wt_result_find(story->result, "modulus_groups");
    const wt_table *comparison = wt_result_find(story->result, "comparison");
    const wt_table *dma = wt_result_find(story->result, "dma_comparison");
    wt_status status = WT_OK;
    if (comparison == NULL) {
        status = say_missing(story, "comparison", how_different, "difference", table, err);
    } else {
        double ratio = flow_table_get(comparison, 0, "ratio");
        status = flow_answer_add(
            table, err, how_different, "difference",
            "The modulus of the wear track is %.3g times that of the bulk (%+.0f %%); the means "
            "differ by %s; effect size (Hedges' g) %.2g.",
            ratio, 100 * (ratio - 1),
            flow_say(flow_table_get(comparison, 0, "difference"), "Pa").text,
            flow_table_get(comparison, 0, "effect_size"));
    }
    if (status == WT_OK && groups != NULL)
        status = say_group(groups, "bulk", "Bulk", table, err);
    if (status == WT_OK && groups != NULL)
        status = say_group(groups, "track", "Wear track", table, err);
    if (status == WT_OK && comparison != NULL)
        status = say_rates(comparison, table, err);
    if (status == WT_OK && dma != NULL)
        status = say_dma(dma, wt_result_find(story->result, "indentation/bulk"), table, err);
    return status;
}

/* ---- thickness --------------------------------------------------------------------------------
 */

static wt_status say_times(const wt_table *layer, wt_table *table, wt_error *err)
{
    wt_estimate incubation = flow_key(layer, "incubation_time");
    wt_estimate settled = flow_key(layer, "time_to_90_percent");
    if (isnan(incubation.value))
        return WT_OK;
    char then[192] = "";
    if (!isnan(settled.value))
        clocale_print(then, sizeof then, " and reaches 90 %% of the balance after %s",
                      flow_say_estimate(settled).text);
    return flow_answer_add(table, err, how_thick, "thickness",
                           "It begins to form after %s%s (time under load).",
                           flow_say_estimate(incubation).text, then);
}

/* Indentation and layer model need not agree; where they do not, the reader is told. */
static wt_status say_disagreement(const flow_story *story, bool modelled, wt_table *table,
                                  wt_error *err)
{
    const wt_table *comparison = wt_result_find(story->result, "comparison");
    if (comparison == NULL)
        return WT_OK;
    const bool measured = flow_table_get(comparison, 0, "ratio_high") < 1 ||
                          flow_table_get(comparison, 0, "ratio_low") > 1;
    if (measured && !modelled)
        return flow_answer_add(table, err, how_thick, "caveat",
                               "This does not agree with the indentation, which shows a modified "
                               "track: the specific wear rate, the critical energy or the model "
                               "does not fit it.");
    if (!measured && modelled)
        return flow_answer_add(table, err, how_thick, "caveat",
                               "The indentation does not show this layer: it is what the model "
                               "makes of the specific wear rate and the critical energy given.");
    return WT_OK;
}

static wt_status answer_thickness(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *layer = wt_result_find(story->result, "layer");
    if (layer == NULL)
        return say_missing(story, "layer", how_thick, "thickness", table, err);
    wt_estimate thickness = flow_key(layer, "balance_thickness");
    wt_estimate ratio = flow_key(layer, "formation_wear_ratio");
    wt_estimate velocity = flow_key(layer, "velocity"), pressure = flow_key(layer, "pressure");
    const char *regime = wt_table_key(layer, "regime");
    wt_status status = WT_OK;
    if (regime != NULL && strcmp(regime, "none") == 0) {
        status = flow_answer_add(
            table, err, how_thick, "thickness",
            "There is none at %s and %s: wear removes the rubber faster than it is modified "
            "(formation over wear R = %s, not above 1). The specific wear rate would have to be "
            "below %.3g mm^3/(N m).",
            flow_say(velocity.value, "m/s").text, flow_say(pressure.value, "Pa").text,
            flow_say_estimate(ratio).text,
            1e9 * flow_key(layer, "critical_specific_wear_rate").value);
        return status == WT_OK ? say_disagreement(story, false, table, err) : status;
    }
    if (isinf(thickness.value))
        status = flow_answer_add(table, err, how_thick, "thickness",
                                 "Without wear it grows without end, ever more slowly; the table "
                                 "layer gives its thickness in time.");
    else
        status =
            flow_answer_add(table, err, how_thick, "thickness",
                            "%s where formation balances wear, at %s and %s (formation over wear R "
                            "= %s). With 1 %% "
                            "more wear it is %.2g %% thinner.",
                            flow_say_estimate(thickness).text, flow_say(velocity.value, "m/s").text,
                            flow_say(pressure.value, "Pa").text, flow_say_estimate(ratio).text,
                            -flow_key(layer, "wear_sensitivity").value);
    if (status == WT_OK)
        status = say_times(layer, table, err);
    return status == WT_OK ? say_disagreement(story, true, table, err) : status;
}

/* ---- friction ---------------------------------------------------------------------------------
 */

static wt_status say_friction(const wt_table *friction, wt_table *table, wt_error *err)
{
    wt_estimate velocity = flow_key(friction, "reference_velocity");
    wt_estimate total = flow_key(friction, "friction_at_reference");
    wt_estimate hysteresis = flow_key(friction, "hysteresis_at_reference");
    wt_estimate area = flow_key(friction, "area_ratio_at_reference");
    if (isnan(total.value))
        return flow_answer_add(table, err, what_friction, "friction",
                               "Without a layer, at %s, the hysteresis part is %s with a real "
                               "contact of %s of the nominal area; the total is not known because "
                               "no shear stress is given.",
                               flow_say(velocity.value, "m/s").text,
                               flow_say_estimate(hysteresis).text, flow_say_estimate(area).text);
    return flow_answer_add(
        table, err, what_friction, "friction",
        "Without a layer, at %s, mu = %s: hysteresis %s, shearing of the real contact %.3g "
        "(contact area %s of the nominal one).",
        flow_say(velocity.value, "m/s").text, flow_say_estimate(total).text,
        flow_say_estimate(hysteresis).text, total.value - hysteresis.value,
        flow_say_estimate(area).text);
}

static wt_status say_change(const wt_table *friction, wt_table *table, wt_error *err)
{
    size_t n = wt_table_n_rows(friction);
    wt_estimate with = flow_key(friction, "friction_with_layer_at_reference");
    wt_estimate change = flow_key(friction, "friction_change_at_reference");
    wt_estimate relative = flow_key(friction, "relative_change_at_reference");
    char range[256] = "";
    if (n > 1)
        snprintf(range, sizeof range, " From %s to %s the change is %+.0f %% to %+.0f %%.",
                 flow_say(flow_table_get(friction, 0, "velocity"), "m/s").text,
                 flow_say(flow_table_get(friction, n - 1, "velocity"), "m/s").text,
                 100 * flow_key(friction, "relative_change_low").value,
                 100 * flow_key(friction, "relative_change_high").value);
    return flow_answer_add(
        table, err, what_friction, "friction",
        "With the layer (%s thick, modulus ratio %s), at %s, mu = %s: a change of %s (%+.0f %%).%s",
        flow_say_estimate(flow_key(friction, "layer_thickness")).text,
        flow_say_estimate(flow_key(friction, "layer_modulus_ratio")).text,
        flow_say(flow_key(friction, "reference_velocity").value, "m/s").text,
        flow_say_estimate(with).text, flow_say_estimate(change).text, 100 * relative.value, range);
}

static wt_status answer_friction(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *friction = wt_result_find(story->result, "friction");
    if (friction == NULL)
        return say_missing(story, "friction", what_friction, "friction", table, err);
    wt_status status = say_friction(friction, table, err);
    if (status != WT_OK)
        return status;
    if (wt_table_key(friction, "layer_thickness") == NULL)
        return say_missing(story, "friction_with_layer", what_friction, "friction", table, err);
    if (isnan(flow_key(friction, "friction_with_layer_at_reference").value))
        return WT_OK;
    if (!(flow_key(friction, "layer_thickness").value > 0))
        return flow_answer_add(table, err, what_friction, "friction",
                               "Where wear leaves no layer, that is the friction: nothing "
                               "changes.");
    return say_change(friction, table, err);
}

/* Only where no later stage uses the material: there it is an answer, else a step. */
static wt_status answer_rubber(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *shift = wt_result_find(story->result, "shift_factors");
    const wt_table *prony = wt_result_find(story->result, "prony");
    if (shift == NULL || prony == NULL || wt_result_find(story->result, "comparison") != NULL ||
        wt_result_find(story->result, "friction") != NULL)
        return WT_OK;
    const char *deformation = wt_table_key(prony, "deformation");
    const char *superposition = wt_table_key(shift, "superposition");
    return flow_answer_add(
        table, err, what_rubber, "material",
        "At %s: WLF C1 = %s, C2 = %s, from %zu isotherms; equilibrium modulus %s (%s). "
        "Time-temperature superposition: %s.",
        flow_say_celsius(flow_key(shift, "reference_temperature").value).text,
        flow_say_estimate(flow_key(shift, "wlf_c1")).text,
        flow_say_estimate(flow_key(shift, "wlf_c2")).text, wt_table_n_rows(shift),
        flow_say_estimate(flow_key(prony, "equilibrium_modulus")).text,
        deformation != NULL ? deformation : "", superposition != NULL ? superposition : "");
}

wt_status flow_answer(const flow_story *story, wt_table **result, wt_error *err)
{
    static const flow_column columns[] = {
        {"question", NULL, "question"},
        {"answer", NULL, "answer"},
        {"kind", NULL, "material, layer, difference, thickness, friction or caveat"},
    };
    wt_table *table = NULL;
    wt_status status =
        flow_table_new("answer", "The answer", columns, FLOW_COUNT(columns), &table, err);
    if (status == WT_OK)
        status = answer_rubber(story, table, err);
    if (status == WT_OK)
        status = answer_layer(story, table, err);
    if (status == WT_OK)
        status = answer_difference(story, table, err);
    if (status == WT_OK)
        status = answer_thickness(story, table, err);
    if (status == WT_OK)
        status = answer_friction(story, table, err);
    if (status == WT_OK)
        status = flow_caveats(story, table, err);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *result = table;
    return WT_OK;
}
