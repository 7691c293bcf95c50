/* Rows of a result: force curves, their calibration and their comparison. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/result_rows_parts.h"

#include <math.h>
#include <string.h>

typedef struct verdict_counts {
    size_t of[WT_CURVE_UNREADABLE + 1];
    size_t used, all;
} verdict_counts;

static verdict_counts count_verdicts(const table_view *curves)
{
    verdict_counts counts = {.all = curves->n_rows};
    for (size_t i = 0; i < curves->n_rows; i++) {
        const int verdict = indentation_enum(curves, i, INDENTATION_VERDICT);
        if (verdict >= 0 && verdict <= WT_CURVE_UNREADABLE)
            counts.of[verdict]++;
        counts.used += verdict >= WT_CURVE_ACCEPTED && verdict <= WT_CURVE_DOUBTFUL ? 1 : 0;
    }
    return counts;
}

static const char *verdict_text(int verdict)
{
    static const char *const texts[] = {
#define VERDICT_TEXT(name, id, text) text,
        WT_CURVE_VERDICT_LIST(VERDICT_TEXT)
#undef VERDICT_TEXT
    };
    return texts[verdict];
}

/* Numbers of accepted, wide and doubtful curves, and why the others are rejected. */
static void add_counts(rows_source *s, const table_view *curves, int level, const char *name)
{
    const verdict_counts counts = count_verdicts(curves);
    char text[64];
    snprintf(text, sizeof text, "%zu of %zu", counts.used, counts.all);
    result_row *row = rows_add_text(s, level, text, "%s", name);
    rows_note(row, "%zu accepted, %zu wide, %zu doubtful", counts.of[WT_CURVE_ACCEPTED],
              counts.of[WT_CURVE_WIDE], counts.of[WT_CURVE_DOUBTFUL]);
    if (counts.used == counts.all)
        return;
    snprintf(text, sizeof text, "%zu", counts.all - counts.used);
    row = rows_add_text(s, 1, text, "curves rejected");
    for (int v = WT_CURVE_DOUBTFUL + 1; v <= WT_CURVE_UNREADABLE; v++)
        if (counts.of[v] > 0)
            clocale_append(row->note, sizeof row->note, "%s%zu %s",
                           row->note[0] != '\0' ? ", " : "", counts.of[v], verdict_text(v));
}

static void add_group(rows_source *s, size_t i)
{
    const table_view *groups = &s->values.groups;
    const result_value modulus = result_value_group(&s->values, i);
    const char *group = modulus_groups_text(groups, i, MODULUS_GROUPS_GROUP);
    const double n = modulus_groups_get(groups, i, MODULUS_GROUPS_N),
                 spots = modulus_groups_get(groups, i, MODULUS_GROUPS_N_SPOTS);
    const bool alone = groups->n_rows == 1;
    result_row *row;
    if (isnan(modulus.number.value))
        row = rows_add_text(s, 0, "none", alone ? "Young's modulus" : "%s", group);
    else if (alone)
        row = rows_add_value(s, 0, &modulus, "Young's modulus");
    else
        row = rows_add_value(s, 0, &modulus, group);
    if (isnan(modulus.number.value))
        rows_note(row, "no curve has a modulus");
    else
        rows_note(row, "%.0f curve%s, %.0f spot%s%s", n, n == 1 ? "" : "s", spots,
                  spots == 1 ? "" : "s", isnan(modulus.low) ? ": no interval" : "");
    table_view curves;
    if (table_bind_result(s->result, &indentation_schema, group, &curves, NULL) != WT_OK ||
        curves.table == NULL)
        return;
    rows_reason(row, "errors that no curve shows",
                indentation_key_text(&curves, INDENTATION_KEY_NOT_SHOWN));
    add_counts(s, &curves, 1, "curves used");
    const char *const assumed = indentation_key_text(&curves, INDENTATION_KEY_ASSUMED);
    if (assumed != NULL)
        rows_note(rows_add_text(s, 1, "", "errors assumed"), "%s", assumed);
}

static void add_ratio(rows_source *s, const table_view *v)
{
    const result_value ratio = result_value_ratio(&s->values);
    if (v->n_rows == 0)
        return;
    const char *verdict = comparison_key_text(v, COMPARISON_KEY_DIFFERS);
    result_row *row = rows_add_value(s, 0, &ratio, "track / bulk");
    if (verdict != NULL) {
        const sign_verdict sign = result_value_sign(&ratio);
        const stated_verdict differs =
            (stated_verdict)comparison_key_enum(v, COMPARISON_KEY_DIFFERS);
        if (isnan(ratio.low) || isnan(ratio.high))
            rows_note(row, "%s%s", finding_verdict_text(FINDING_NOT_ENOUGH_DATA),
                      verdict + length_without_reason(verdict));
        else
            rows_note(row, "%.*s%s", (int)length_without_reason(verdict), verdict,
                      differs != VERDICT_YES || sign == SIGN_UNDECIDED ? ""
                      : sign == SIGN_BELOW                             ? ", softer"
                                                                       : ", stiffer");
    }
    rows_reason(row, "is the track different", verdict);
    rows_reason(row, "how to decide it", ratio.remedy);
    rows_reason(row, "what else would explain it",
                comparison_key_text(v, COMPARISON_KEY_WOULD_EXPLAIN));
}

static void add_sensitivity(rows_source *s, const table_view *v)
{
    const wt_estimate value = sensitivity_value(v, SENSITIVITY_KEY_SENSITIVITY),
                      factor = sensitivity_value(v, SENSITIVITY_KEY_FACTOR);
    const slope_direction direction =
        (slope_direction)sensitivity_key_enum(v, SENSITIVITY_KEY_DIRECTION);
    const char *verdict = sensitivity_key_text(v, SENSITIVITY_KEY_VERDICT),
               *option = sensitivity_key_text(v, SENSITIVITY_KEY_INDENT),
               *compare = sensitivity_key_text(v, SENSITIVITY_KEY_COMPARE);
    result_row *row = rows_add_number(s, 0, rows_estimate(value), "deflection sensitivity");
    for (size_t i = 0; i < v->n_rows; i++)
        if (sensitivity_enum(v, i, SENSITIVITY_DIRECTION) == (int)direction)
            rows_note(row, "%.0f curve%s, %s", sensitivity_get(v, i, SENSITIVITY_N),
                      sensitivity_get(v, i, SENSITIVITY_N) == 1 ? "" : "s",
                      direction == SLOPE_OF_BOTH ? "approach and retract"
                                                 : slope_direction_text(direction));
    if (!isnan(factor.value))
        rows_add_number(s, 0, rows_estimate(factor), "over that of the file");
    if (verdict != NULL)
        rows_add_verdict(s, 0, verdict, "slope");
    if (option != NULL)
        rows_add_text(s, 1, "", "for weartrack indent: %s", option);
    if (compare != NULL)
        rows_add_text(s, 1, "", "for weartrack compare: %s", compare);
}

static void add_spot(rows_source *s, const table_view *v)
{
    const char *verdict = spot_key_text(v, SPOT_KEY_VERDICT);
    if (v->n_rows == 0)
        return;
    if (verdict != NULL)
        rows_add_verdict(s, 0, verdict, "smooth enough for the depth");
    rows_add_number(s, 0,
                    rows_number(spot_get(v, 0, SPOT_ROUGHNESS), spot_get(v, 0, SPOT_ROUGHNESS_LOW),
                                spot_get(v, 0, SPOT_ROUGHNESS_HIGH), "m"),
                    "rms roughness");
    result_row *row =
        rows_add_number(s, 0,
                        rows_number(spot_get(v, 0, SPOT_RATIO), spot_get(v, 0, SPOT_RATIO_LOW),
                                    spot_get(v, 0, SPOT_RATIO_HIGH), "1"),
                        "roughness / depth");
    rows_note(row, "limit %s", rows_short(spot_get(v, 0, SPOT_LIMIT), "1").value);
}

static void add_track_layer(rows_source *s, const table_view *v)
{
    const wt_estimate thickness = track_layer_value(v, TRACK_LAYER_KEY_THICKNESS);
    const char *allowed = track_layer_key_text(v, TRACK_LAYER_KEY_ALLOWED);
    const double low = track_layer_value(v, TRACK_LAYER_KEY_LOW).value,
                 high = track_layer_value(v, TRACK_LAYER_KEY_HIGH).value;
    if (isnan(thickness.value) && isnan(low))
        return;
    result_row *row = rows_add_number(
        s, 0, rows_number(thickness.value, low, isnan(high) ? (double)INFINITY : high, "m"),
        "layer by the curves");
    rows_reason(row, "thickness that the curves allow", allowed);
    rows_reason(row, "curves and theory", track_layer_key_text(v, TRACK_LAYER_KEY_AGREE));
}

void rows_of_curves(rows_source *s)
{
    static const struct {
        const table_schema *schema;
        void (*add)(rows_source *s, const table_view *view);
    } parts[] = {{&sensitivity_schema, add_sensitivity},
                 {&spot_schema, add_spot},
                 {&comparison_schema, add_ratio}};
    table_view view;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (rows_bind(s, parts[i].schema, &view))
            parts[i].add(s, &view);
    for (size_t i = 0; i < s->values.groups.n_rows; i++)
        add_group(s, i);
    for (size_t i = 0; i < wt_result_n_tables(s->result) && s->values.groups.n_rows == 0; i++) {
        const char *const name = wt_table_name(wt_result_table(s->result, i));
        const size_t length = strlen(indentation_schema.name);
        if (strncmp(name, indentation_schema.name, length) == 0 &&
            table_bind_result(s->result, &indentation_schema, name + length, &view, NULL) ==
                WT_OK &&
            view.table != NULL) {
            char label[64];
            snprintf(label, sizeof label, "%s curves used", name + length);
            add_counts(s, &view, 0, label);
        }
    }
    if (rows_bind(s, &track_layer_schema, &view))
        add_track_layer(s, &view);
}
