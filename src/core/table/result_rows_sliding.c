/* Rows of a result: sliding friction, layer, friction records and collected cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/result_rows_parts.h"

#include <math.h>
#include <string.h>

static void add_friction(rows_source *s, const table_view *v)
{
    const result_value_tables *t = &s->values;
    const result_value hysteresis = result_value_friction(t, FRICTION_KEY_HYSTERESIS),
                       shearing = result_value_friction(t, FRICTION_KEY_SHEARING),
                       area = result_value_friction(t, FRICTION_KEY_AREA_RATIO),
                       total = result_value_friction(t, FRICTION_KEY_FRICTION),
                       layered = result_value_friction(t, FRICTION_KEY_WITH_LAYER),
                       change = result_value_friction(t, FRICTION_KEY_RELATIVE_CHANGE);
    const bool known = !isnan(total.number.value);
    rows_condition(s, hysteresis.velocity, "m/s");
    rows_condition(s, hysteresis.pressure, "Pa");
    rows_condition(s, friction_value(v, FRICTION_KEY_TEMPERATURE).value, "degC");
    if (known)
        rows_add_value(s, 0, &total, "friction coefficient");
    rows_add_value(s, known, &hysteresis, known ? "hysteresis" : "friction by hysteresis");
    if (!isnan(shearing.number.value))
        rows_add_value(s, 1, &shearing, "shearing");
    if (!known)
        rows_note(&s->rows->rows[s->rows->n - 1], "no shear stress: without shearing");
    rows_add_value(s, 0, &area, "real contact area");
    if (!isnan(layered.number.value)) {
        rows_add_value(s, 0, &layered, "friction with layer");
        rows_add_value(s, 1, &change, "change");
    } else if (friction_value(v, FRICTION_KEY_LAYER_THICKNESS).value > 0) {
        rows_note(rows_add_text(s, 0, "not known", "friction with layer"), "no shear stress");
    }
}

static void add_layer(rows_source *s, const table_view *v)
{
    const result_value thickness = result_value_thickness(&s->values);
    const bool given = layer_key_enum(v, LAYER_KEY_CRITICAL_ENERGY_FROM) == ENERGY_CALIBRATED;
    const double value = thickness.number.value;
    rows_condition(s, thickness.velocity, "m/s");
    rows_condition(s, thickness.pressure, "Pa");
    result_row *row;
    if (isinf(value)) {
        row = rows_add_text(s, 0, "no limit", "layer thickness");
        rows_note(row, "without wear the layer grows without limit");
    } else if (!(value > 0)) {
        row = rows_add_text(s, 0, value == 0 ? "no layer" : "not known", "layer thickness");
        row->number.range_low = thickness.range.low;
        row->number.range_high = thickness.range.high;
        row->number.unit = "m";
    } else {
        row = rows_add_value(s, 0, &thickness, "layer thickness");
    }
    if (row->note[0] == '\0')
        rows_note(row, given ? "given: U_c is calibrated to it" : "predicted from U_c");
    if (value > 0 && isfinite(value))
        rows_add_number(s, 1, rows_estimate(layer_value(v, LAYER_KEY_TIME_TO_90_PERCENT)),
                        "time to 90 %%");
    rows_add_number(s, 0, rows_estimate(layer_value(v, LAYER_KEY_FORMATION_WEAR_RATIO)),
                    "formation / wear at the surface");
    rows_add_number(s, 0, rows_estimate(layer_value(v, LAYER_KEY_CRITICAL_ENERGY)),
                    "critical energy U_c");
    rows_add_number(s, 0, rows_estimate(layer_value(v, LAYER_KEY_WEAR_RATE)), "specific wear rate");
}

static void add_identification(rows_source *s, const table_view *v)
{
    for (size_t i = 0; i < v->n_rows; i++) {
        const char *by = identification_text(v, i, IDENTIFICATION_BY);
        result_row *row = rows_add_number(
            s, 0,
            rows_number(identification_get(v, i, IDENTIFICATION_ENERGY),
                        identification_get(v, i, IDENTIFICATION_ENERGY_LOW),
                        identification_get(v, i, IDENTIFICATION_ENERGY_HIGH), "J/m^3"),
            "critical energy U_c");
        rows_note(row, "%s", by);
        row = rows_add_number(s, 1,
                              rows_number(identification_get(v, i, IDENTIFICATION_WEAR),
                                          identification_get(v, i, IDENTIFICATION_WEAR_LOW),
                                          identification_get(v, i, IDENTIFICATION_WEAR_HIGH),
                                          "m^2/N"),
                              "specific wear rate");
        if (!isnan(identification_get(v, i, IDENTIFICATION_CORRELATION)))
            rows_note(row, "correlation %.2f",
                      identification_get(v, i, IDENTIFICATION_CORRELATION));
        rows_reason(row, "known least", identification_text(v, i, IDENTIFICATION_LOOSE));
        rows_reason(row, by, identification_text(v, i, IDENTIFICATION_NOTE));
    }
}

/* All errors of a number together, and the source with the largest share of the variance. */
static void add_error_budget(rows_source *s, const table_view *v)
{
    clocale_append(s->rows->heading, sizeof s->rows->heading, "relative standard errors");
    for (size_t from = 0, to; from < v->n_rows; from = to) {
        const char *number = error_budget_text(v, from, ERROR_BUDGET_NUMBER);
        double together = (double)NAN;
        size_t largest = SIZE_MAX;
        for (to = from;
             to < v->n_rows && strcmp(error_budget_text(v, to, ERROR_BUDGET_NUMBER), number) == 0;
             to++) {
            if (error_budget_enum(v, to, ERROR_BUDGET_KIND) == ERROR_TOGETHER)
                together = error_budget_get(v, to, ERROR_BUDGET_RELATIVE_ERROR);
            else if (error_budget_get(v, to, ERROR_BUDGET_SHARE) > 0 &&
                     (largest == SIZE_MAX || error_budget_get(v, to, ERROR_BUDGET_SHARE) >
                                                 error_budget_get(v, largest, ERROR_BUDGET_SHARE)))
                largest = to;
        }
        const double none = (double)NAN;
        result_row *row =
            rows_add_number(s, 0, rows_number(together, none, none, "%"), "error of %s", number);
        if (largest != SIZE_MAX)
            rows_note(row, "most by %s", error_budget_text(v, largest, ERROR_BUDGET_SOURCE));
    }
}

/* Contact area of each velocity with all of the roughness. */
static void add_contact_area(rows_source *s, const table_view *v)
{
    const double none = (double)NAN;
    for (size_t i = 0; i < v->n_rows; i++) {
        const double velocity = contact_area_get(v, i, CONTACT_AREA_VELOCITY);
        if (i + 1 < v->n_rows && contact_area_get(v, i + 1, CONTACT_AREA_VELOCITY) == velocity)
            continue;
        result_row *row = rows_add_number(
            s, 0, rows_number(contact_area_get(v, i, CONTACT_AREA_AREA_RATIO), none, none, "1"),
            "real over nominal area");
        rows_note(row, "at %s, magnification %s", rows_short(velocity, "m/s").value,
                  rows_short(contact_area_get(v, i, CONTACT_AREA_MAGNIFICATION), "1").value);
    }
}

/* Numbers of the model as used, with their range over its choices; the row of a layer has that of
 * the thickness. */
static void add_what_if(rows_source *s, const table_view *v, bool has_layer)
{
    static const struct {
        what_if_column column;
        const char *unit, *name;
    } numbers[] = {{WHAT_IF_FRICTION, "1", "friction coefficient"},
                   {WHAT_IF_HYSTERESIS, "1", "hysteresis friction"},
                   {WHAT_IF_WITH_LAYER, "1", "friction with the layer"},
                   {WHAT_IF_THICKNESS, "m", "thickness of the layer"}};
    const double none = (double)NAN;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers && v->n_rows > 0; k++) {
        double low = none, high = none;
        for (size_t i = 0; i < v->n_rows; i++) {
            low = fmin(low, what_if_get(v, i, numbers[k].column)); /* fmin ignores NaN */
            high = fmax(high, what_if_get(v, i, numbers[k].column));
        }
        const double used = what_if_get(v, 0, numbers[k].column);
        if (isnan(used) || (has_layer && numbers[k].column == WHAT_IF_THICKNESS))
            continue;
        rows_add_number(s, 0, (row_number){used, none, none, low, high, numbers[k].unit}, "%s",
                        numbers[k].name);
    }
}

void rows_of_friction(rows_source *s)
{
    table_view view, layer;
    const bool has_friction = rows_bind(s, &friction_schema, &view);
    if (has_friction)
        add_friction(s, &view);
    if (!has_friction && rows_bind(s, &what_if_schema, &view))
        add_what_if(s, &view, rows_bind(s, &layer_schema, &layer));
    if (!has_friction && rows_bind(s, &contact_area_schema, &view))
        add_contact_area(s, &view);
}

void rows_of_layer(rows_source *s)
{
    table_view view;
    if (rows_bind(s, &layer_schema, &view))
        add_layer(s, &view);
    if (rows_bind(s, &identification_schema, &view))
        add_identification(s, &view);
}

void rows_of_errors(rows_source *s)
{
    table_view view;
    if (rows_bind(s, &error_budget_schema, &view))
        add_error_budget(s, &view);
}

/* ---- records --------------------------------------------------------------------------------- */

static void append_condition(result_row *row, double value, const char *unit)
{
    if (!isnan(value))
        clocale_append(row->note, sizeof row->note, "%s%s", row->note[0] != '\0' ? ", " : "",
                       rows_short(value, unit).value);
}

static void add_record(rows_source *s, const table_view *v)
{
    const wt_estimate mean = record_value(v, RECORD_KEY_FRICTION);
    clocale_append(s->rows->heading, sizeof s->rows->heading, "friction coefficient, %zu step%s",
                   v->n_rows, v->n_rows == 1 ? "" : "s");
    if (!isnan(mean.value) && v->n_rows > 1)
        rows_add_number(s, 0, rows_estimate(mean), "mean of the steps");
    for (size_t i = 0; i < v->n_rows; i++) {
        const double end = record_get(v, i, RECORD_RUNNING_IN);
        result_row *row = rows_add_number(s, v->n_rows > 1 && !isnan(mean.value),
                                          rows_number(record_get(v, i, RECORD_FRICTION),
                                                      record_get(v, i, RECORD_FRICTION_LOW),
                                                      record_get(v, i, RECORD_FRICTION_HIGH), "1"),
                                          "step %zu", i + 1);
        append_condition(row, record_get(v, i, RECORD_VELOCITY), "m/s");
        append_condition(row, record_get(v, i, RECORD_NORMAL_FORCE), "N");
        if (!isnan(end))
            clocale_append(row->note, sizeof row->note, "%srun-in %.3g cycles",
                           row->note[0] != '\0' ? ", " : "", end);
        rows_reason(row, record_text(v, i, RECORD_FILE), record_text(v, i, RECORD_NOTE));
        rows_reason(row, "running-in", record_text(v, i, RECORD_RUNNING_IN_NOTE));
    }
}

static void add_wear(rows_source *s, const table_view *v)
{
    for (size_t i = 0; i < v->n_rows; i++) {
        result_row *row =
            rows_add_number(s, 0,
                            rows_number(wear_get(v, i, WEAR_RATE), wear_get(v, i, WEAR_RATE_LOW),
                                        wear_get(v, i, WEAR_RATE_HIGH), "m^2/N"),
                            "specific wear rate");
        const bool known = !isnan(wear_get(v, i, WEAR_RATE));
        rows_note(row, "%s", wear_text(v, i, known ? WEAR_OF : WEAR_NOTE));
        rows_reason(row, "specific wear rate", wear_text(v, i, WEAR_NOTE));
        const double pressure = wear_get(v, i, WEAR_PRESSURE), none = (double)NAN;
        if (isnan(pressure))
            continue;
        row = rows_add_number(s, 0, rows_number(pressure, none, none, "Pa"),
                              "pressure under the ball");
        rows_note(row, "duty %s", rows_short(wear_get(v, i, WEAR_DUTY), "1").value);
    }
}

static void add_validation_step(rows_source *s, const table_view *v, size_t i)
{
    const bool layered = !isnan(validation_get(v, i, VALIDATION_RATIO_LAYER));
    const double predicted =
        validation_get(v, i, layered ? VALIDATION_WITH_LAYER : VALIDATION_PREDICTED);
    result_row *row = rows_add_number(
        s, 1,
        layered ? rows_number(validation_get(v, i, VALIDATION_RATIO_LAYER),
                              validation_get(v, i, VALIDATION_RATIO_LAYER_LOW),
                              validation_get(v, i, VALIDATION_RATIO_LAYER_HIGH), "1")
                : rows_number(validation_get(v, i, VALIDATION_RATIO),
                              validation_get(v, i, VALIDATION_RATIO_LOW),
                              validation_get(v, i, VALIDATION_RATIO_HIGH), "1"),
        "at %s", rows_short(validation_get(v, i, VALIDATION_VELOCITY), "m/s").value);
    rows_note(row, "%s / %s", rows_short(validation_get(v, i, VALIDATION_MEASURED), "1").value,
              rows_short(predicted, "1").value);
    rows_reason(row, "step", validation_text(v, i, VALIDATION_NOTE));
}

static void add_validation(rows_source *s, const table_view *v)
{
    const char *plausible = validation_key_text(v, VALIDATION_KEY_PLAUSIBLE);
    result_row *row =
        rows_add_verdict(s, validation_key_listed(v, VALIDATION_KEY_VERDICT), "theory explains it");
    const int outcome = validation_key_enum(v, VALIDATION_KEY_OUTCOME);
    if (outcome < VALIDATION_OUTCOME_UNKNOWN)
        snprintf(row->text, sizeof row->text, "%s",
                 validation_outcome_text((validation_outcome)outcome));
    const char *judged = validation_key_text(v, VALIDATION_KEY_JUDGED);
    if (judged != NULL)
        rows_note(row, "%s", judged);
    rows_reason(row, "how to decide it", validation_key_text(v, VALIDATION_KEY_SETTLED_BY));
    rows_reason(row, "assumed", validation_key_text(v, VALIDATION_KEY_REMARKS));
    rows_add_number(s, 0, rows_of_keys(v, VALIDATION_KEY_RATIO), "measured / predicted");
    for (size_t i = 0; i < v->n_rows; i++)
        add_validation_step(s, v, i);
    const row_number needed = rows_of_keys(v, VALIDATION_KEY_NEEDED);
    if (isnan(needed.value))
        return;
    row = rows_add_number(s, 0, needed, "shear stress needed");
    rows_note(row, "used: %s",
              rows_short(validation_value(v, VALIDATION_KEY_SHEAR).value, "Pa").value);
    rows_reason(row, "is that shear stress plausible", plausible);
    rows_reason(row, "with it", validation_key_text(v, VALIDATION_KEY_SHAPE));
}

static void add_validation_running_in(rows_source *s, const table_view *v)
{
    for (size_t i = 0; i < v->n_rows; i++) {
        result_row *const row = rows_add_number(
            s, 0,
            rows_number(validation_running_in_get(v, i, VALIDATION_RUNNING_IN_SETTLED),
                        validation_running_in_get(v, i, VALIDATION_RUNNING_IN_SETTLED_LOW),
                        validation_running_in_get(v, i, VALIDATION_RUNNING_IN_SETTLED_HIGH), "s"),
            "steady friction after, measured");
        rows_reason(row, "running-in",
                    validation_running_in_text(v, i, VALIDATION_RUNNING_IN_NOTE));
        rows_add_number(
            s, 1,
            rows_estimate((wt_estimate){
                validation_running_in_get(v, i, VALIDATION_RUNNING_IN_PREDICTED),
                validation_running_in_get(v, i, VALIDATION_RUNNING_IN_PREDICTED_STANDARD_ERROR),
                (double)NAN, "s"}),
            "predicted with the layer");
        rows_add_number(
            s, 1,
            rows_number(validation_running_in_get(v, i, VALIDATION_RUNNING_IN_TIME_RATIO),
                        validation_running_in_get(v, i, VALIDATION_RUNNING_IN_TIME_RATIO_LOW),
                        validation_running_in_get(v, i, VALIDATION_RUNNING_IN_TIME_RATIO_HIGH),
                        "1"),
            "time, measured / predicted");
    }
}

void rows_of_records(rows_source *s)
{
    table_view view;
    const bool compared = rows_bind(s, &validation_schema, &view);
    if (compared)
        add_validation(s, &view); /* it has the steps of the record, too */
    if (!compared && rows_bind(s, &record_schema, &view))
        add_record(s, &view);
    if (rows_bind(s, &wear_schema, &view))
        add_wear(s, &view);
    if (rows_bind(s, &validation_running_in_schema, &view))
        add_validation_running_in(s, &view);
}

/* ---- several cases --------------------------------------------------------------------------- */

/* Returns false if no case has an indentation. */
static bool add_collection(rows_source *s, const table_view *v)
{
    bool any = false;
    for (size_t i = 0; i < v->n_rows; i++) {
        const char *const condition = collection_text(v, i, COLLECTION_CONDITION);
        if (isnan(collection_get(v, i, COLLECTION_RATIO)) &&
            collection_enum(v, i, COLLECTION_DIFFERS) == VERDICT_NOT_ASKED)
            continue; /* a case without indentation */
        any = true;
        result_row *row =
            rows_add_number(s, 0,
                            rows_number(collection_get(v, i, COLLECTION_RATIO),
                                        collection_get(v, i, COLLECTION_RATIO_LOW),
                                        collection_get(v, i, COLLECTION_RATIO_HIGH), "1"),
                            "%s%s%s", collection_text(v, i, COLLECTION_SAMPLE),
                            condition[0] != '\0' ? ", " : "", condition);
        const char *const differs =
            isnan(row->number.low) || isnan(row->number.high)
                ? finding_verdict_text(FINDING_NOT_ENOUGH_DATA)
                : stated_verdict_text((stated_verdict)collection_enum(v, i, COLLECTION_DIFFERS));
        rows_note(row, "track / bulk%s%s", *differs != '\0' ? "; differs: " : "", differs);
    }
    return any;
}

/* How many pairs of ratios differ, and those that do with the softer track. */
static void add_ratio_pairs(rows_source *s, const table_view *v)
{
    char said[64];
    const double pairs = (double)v->n_rows,
                 differ = ratio_pairs_value(v, RATIO_PAIRS_KEY_DIFFERENT).value,
                 undecided = ratio_pairs_value(v, RATIO_PAIRS_KEY_UNDECIDED).value;
    clocale_print(said, sizeof said, "%.0f of %.0f pairs", differ, pairs);
    result_row *row = rows_add_text(s, 0, said, "ratios that differ");
    rows_note(row, "%.0f alike, %.0f undecided", pairs - differ - undecided, undecided);
    rows_reason(row, "how to decide the others",
                ratio_pairs_key_text(v, RATIO_PAIRS_KEY_SETTLED_BY));
    for (size_t i = 0; i < v->n_rows; i++) {
        if (ratio_pairs_enum(v, i, RATIO_PAIRS_DIFFER) != VERDICT_YES)
            continue;
        const double ratio = ratio_pairs_get(v, i, RATIO_PAIRS_RATIO);
        const char *first = ratio_pairs_text(v, i, RATIO_PAIRS_FIRST),
                   *second = ratio_pairs_text(v, i, RATIO_PAIRS_SECOND);
        row = rows_add_number(s, 1,
                              rows_number(ratio, ratio_pairs_get(v, i, RATIO_PAIRS_RATIO_LOW),
                                          ratio_pairs_get(v, i, RATIO_PAIRS_RATIO_HIGH), "1"),
                              "%s: %s / %s", ratio_pairs_text(v, i, RATIO_PAIRS_OF), first, second);
        rows_note(row, "softer against its bulk: %s", ratio > 1 ? second : first);
    }
}

/* The largest friction of each case, and the velocity at which it is. */
static void add_collected_friction(rows_source *s, const table_view *v)
{
    const bool hysteresis =
        collected_friction_key_enum(v, COLLECTED_FRICTION_KEY_PART) == HYSTERESIS_ALONE;
    for (size_t i = 0, end; i < v->n_rows; i = end) {
        const char *const sample = collected_friction_text(v, i, COLLECTED_FRICTION_SAMPLE);
        const char *const condition = collected_friction_text(v, i, COLLECTED_FRICTION_CONDITION);
        size_t most = i;
        for (end = i + 1;
             end < v->n_rows &&
             strcmp(collected_friction_text(v, end, COLLECTED_FRICTION_SAMPLE), sample) == 0 &&
             strcmp(collected_friction_text(v, end, COLLECTED_FRICTION_CONDITION), condition) == 0;
             end++)
            if (collected_friction_get(v, end, COLLECTED_FRICTION_FRICTION) >
                collected_friction_get(v, most, COLLECTED_FRICTION_FRICTION))
                most = end;
        const wt_estimate largest = {
            collected_friction_get(v, most, COLLECTED_FRICTION_FRICTION),
            collected_friction_get(v, most, COLLECTED_FRICTION_FRICTION_STANDARD_ERROR), 0, "1"};
        result_row *row = rows_add_number(s, 0, rows_estimate(largest), "%s%s%s", sample,
                                          condition[0] != '\0' ? ", " : "", condition);
        rows_note(
            row, "largest friction%s, at %s", hysteresis ? " by hysteresis" : "",
            rows_short(collected_friction_get(v, most, COLLECTED_FRICTION_VELOCITY), "m/s").value);
    }
}

void rows_of_collection(rows_source *s)
{
    table_view view;
    bool indented = false;
    if (rows_bind(s, &collection_schema, &view))
        indented = add_collection(s, &view);
    if (!indented && rows_bind(s, &collected_friction_schema, &view))
        add_collected_friction(s, &view);
    if (rows_bind(s, &ratio_pairs_schema, &view))
        add_ratio_pairs(s, &view);
}
