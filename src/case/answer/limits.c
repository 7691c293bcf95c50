/* Finds the limits of a result in its tables. Each limit is one short sentence with its subject and
 * severity. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_status answer_context_bind(answer_context *context, const wt_result *result, wt_error *err)
{
    const struct {
        const table_schema *schema;
        const char *suffix;
        table_view *view;
    } tables[] = {
        {&indentation_schema, "bulk", &context->indentation[0]},
        {&indentation_schema, "track", &context->indentation[1]},
        {&modulus_depth_schema, "", &context->modulus_depth},
        {&dma_comparison_schema, "", &context->dma_comparison},
        {&shift_factors_schema, "", &context->shift_factors},
        {&master_curve_schema, "", &context->master_curve},
        {&softening_schema, "", &context->softening},
        {&flash_schema, "", &context->flash},
        {&roughness_schema, "", &context->roughness},
        {&wear_schema, "", &context->wear},
    };
    wt_status status = result_values_bind(result, &context->values, err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(tables); i++)
        status = table_bind_result(result, tables[i].schema, tables[i].suffix, tables[i].view, err);
    return status;
}

/* Limit of the indentation depth over the layer thickness. A deeper indentation also deforms the
 * material below the layer (Bueckle's rule for films). */
static const double deep_share = 0.1;

TABLE_ROW(limits, LIMITS, const char *severity, *subject, *limit;)

typedef struct limit {
    wt_severity severity;
    limit_subject subject;
    char text[400];
} limit;

typedef struct limit_list {
    limit *limit;
    size_t n;
} limit_list;

static void add(limit_list *list, wt_severity severity, limit_subject subject, const char *format,
                ...) WT_PRINTF(4, 5);
static void add(limit_list *list, wt_severity severity, limit_subject subject, const char *format,
                ...)
{
    va_list arguments;
    list->limit = array_grow(list->limit, list->n, sizeof *list->limit);
    limit *const l = &list->limit[list->n++];
    *l = (limit){.severity = severity, .subject = subject};
    va_start(arguments, format);
    clocale_vprint(l->text, sizeof l->text, format, arguments);
    va_end(arguments);
}

/* Adds "TEXT (OF)." unless the text is absent. */
static void add_stated(limit_list *list, limit_subject subject, const char *of, const char *text)
{
    if (text != NULL)
        add(list, WT_WARNING, subject, "%s (%s).", text, of);
}

/* ---- indentation ----------------------------------------------------------------------------- */

/* Returns the median of a column over the curves with a modulus. NaN without such curves. */
static double usable_median(const table_view *indentation, indentation_column column)
{
    size_t n = 0;
    double *const values = wt_alloc(indentation->n_rows + 1, sizeof *values);
    for (size_t i = 0; i < indentation->n_rows; i++) {
        const double value = indentation_get(indentation, i, column);
        if (!isnan(value) && wt_curve_verdict_is_usable((wt_curve_verdict)indentation_enum(
                                 indentation, i, INDENTATION_VERDICT)))
            values[n++] = value;
    }
    const double median = n > 0 ? numbers_median(values, n) : (double)NAN;
    free(values);
    return median;
}

static void add_group_limits(limit_list *list, const answer_context *context, int group)
{
    static const char *const names[2] = {"bulk", "track"};
    const table_view *const t = &context->indentation[group];
    char text[320];
    text_builder builder = {text, sizeof text, 0};
    if (t->table == NULL)
        return;
    if (append_spectrum_mismatch(&builder, t, names[group]))
        add(list, WT_WARNING, LIMITS_INDENTATION, "%s.", text);
    const size_t rejected = format_rejected_curves(t, text, sizeof text);
    if (rejected > 0)
        add(list, WT_NOTE, LIMITS_DATA, "%zu of %zu curves of the %s are rejected: %s.", rejected,
            t->n_rows, names[group], text);
    if (indentation_key_text(t, INDENTATION_KEY_SPOTS) != NULL &&
        indentation_key_enum(t, INDENTATION_KEY_SPOTS) != SPOTS_NAMED)
        add(list, WT_NOTE, LIMITS_INDENTATION,
            "The spots of the %s are not named: each %s counts as one spot.", names[group],
            context->c != NULL && context->c->compare.map_spots ? "place" : "file");
}

/* An error of the sensitivity changes a modulus by its gain, and the ratio of two groups as far as
 * the gains differ, or in full with two cantilevers. */
static void add_calibration_limits(limit_list *list, const answer_context *context)
{
    static const char *const names[2] = {"bulk", "track"};
    double gain[2];
    for (int g = 0; g < 2; g++)
        gain[g] = usable_median(&context->indentation[g], INDENTATION_SENSITIVITY_GAIN);
    for (int g = 0; g < 2; g++)
        if (!isnan(gain[g]) && isnan(gain[1 - g]))
            add(list, WT_NOTE, LIMITS_INDENTATION,
                "1 %% of the deflection sensitivity is %.3g %% of the modulus of the %s.",
                fabs(gain[g]), names[g]);
    if (isnan(gain[0]) || isnan(gain[1]) || context->values.comparison.table == NULL)
        return; /* no ratio */
    const bool two = comparison_key_enum(&context->values.comparison, COMPARISON_KEY_CANTILEVERS) ==
                     TWO_CANTILEVERS;
    add(list, WT_NOTE, LIMITS_INDENTATION,
        "1 %% of the deflection sensitivity is %.3g %% of the modulus of the bulk and %.3g %% of "
        "that of the track; with %s, %s of the ratio.",
        fabs(gain[0]), fabs(gain[1]), two ? "two cantilevers" : "one cantilever",
        format_percent((two ? hypot(gain[0], gain[1]) : fabs(gain[0] - gain[1])) / 100).text);
}

/* Adds the text of a key, which is the same for both groups. */
static void add_of_both_groups(limit_list *list, const answer_context *context, indentation_key key,
                               const char *begin)
{
    const char *const bulk = indentation_key_text(&context->indentation[0], key),
                      *const track = indentation_key_text(&context->indentation[1], key);
    if (bulk != NULL || track != NULL)
        add(list, WT_NOTE, LIMITS_INDENTATION, "%s: %s.", begin, bulk != NULL ? bulk : track);
}

static void add_dma_comparison_limits(limit_list *list, const answer_context *context)
{
    const table_view *const dma = &context->dma_comparison;
    double low, high;
    const size_t outside = count_extrapolated(dma);
    if (find_dma_ratio(dma, &low, &high) && is_different_rubber(low, high))
        add(list, WT_WARNING, LIMITS_INDENTATION,
            "Indentation and DMA do not describe one rubber: the modulus of the bulk is %s times "
            "|E*|. Check units, spring constant, sensitivity, tip and temperature.",
            format_with_unit(1 / low > high ? low : high, "1").text);
    if (outside > 0)
        add(list, WT_WARNING, LIMITS_INDENTATION,
            "%zu of %zu comparisons with DMA lie outside the measured frequencies.", outside,
            dma->n_rows);
    add_stated(list, LIMITS_INDENTATION, "comparison with DMA",
               dma_comparison_key_text(dma, DMA_COMPARISON_KEY_MATERIAL_STATEMENT));
}

static void add_comparison_limits(limit_list *list, const answer_context *context)
{
    const table_view *const comparison = &context->values.comparison;
    for (int g = 0; g < 2; g++)
        add_group_limits(list, context, g);
    add_calibration_limits(list, context);
    add_of_both_groups(list, context, INDENTATION_KEY_ASSUMED, "Assumed, as no error is stated");
    add_of_both_groups(list, context, INDENTATION_KEY_NOT_SHOWN, "Not shown by any curve");
    if (comparison->table == NULL)
        return;
    if (comparison_key_enum(comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS) == UNIT_IS_CURVE)
        add(list, WT_WARNING, LIMITS_INDENTATION,
            "No spots are named, so each curve counts as one: the interval of the ratio may be too "
            "narrow.");
    if (context->c != NULL && isnan(context->c->compare.track_temperature.value))
        add(list, WT_NOTE, LIMITS_INDENTATION,
            "No temperature of the track is stated: it is assumed to be that of the bulk.");
    const wt_compare_job *const job = context->c != NULL ? &context->c->compare : NULL;
    if (job != NULL && !isnan(job->track_temperature.value) &&
        job->track_temperature.value != job->temperature.value)
        add(list, WT_NOTE, LIMITS_INDENTATION,
            "The track was indented at %s: the ratio is corrected to the temperature of the bulk "
            "by %s.",
            format_celsius(job->track_temperature.value).text,
            isnan(job->temperature_slope.value) ? "the DMA" : "the stated temperature slope");
    const result_value ratio = result_value_ratio(&context->values);
    if (!isnan(ratio.frequency[0]))
        add(list, WT_NOTE, LIMITS_INDENTATION, "The ratio of the moduli is measured only%s.",
            format_frequency(&ratio).text);
}

/* What a modulus that changes with depth means. */
static void add_depth_limits(limit_list *list, const answer_context *context)
{
    for (int g = 0; g < 2; g++) {
        table_view depth = context->modulus_depth;
        depth.suffix = g == 0 ? "bulk" : "track";
        const char *const reading = modulus_depth_key_text(&depth, MODULUS_DEPTH_KEY_READING);
        if (reading != NULL)
            add(list, WT_NOTE, LIMITS_INDENTATION, "Modulus of the %s against depth: %s.",
                depth.suffix, reading);
    }
}

/* ---- material and friction ------------------------------------------------------------------- */

static void add_material_limits(limit_list *list, const answer_context *context)
{
    const table_view *const shifts = &context->shift_factors;
    size_t undetermined = 0;
    if (shifts->table == NULL)
        return;
    for (size_t i = 0; i < shifts->n_rows; i++)
        undetermined += !(shift_factors_get(shifts, i, SHIFT_FACTORS_DETERMINED) > 0);
    const char *const verdict = shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const wt_superposition superposition =
        (wt_superposition)shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION);
    if (shifts->n_rows < 2)
        add(list, WT_WARNING, LIMITS_MATERIAL, "The material is known from one isotherm only.");
    else if (superposition == WT_SUPERPOSITION_FAILS)
        add(list, WT_WARNING, LIMITS_MATERIAL,
            "Time-temperature superposition %s: the master curve is doubtful.", verdict);
    else if (superposition == WT_SUPERPOSITION_INCONCLUSIVE)
        add(list, WT_WARNING, LIMITS_MATERIAL, "Time-temperature superposition is %s.", verdict);
    if (undetermined > 0)
        add(list, WT_WARNING, LIMITS_MATERIAL,
            "The data do not determine the shift of %zu of %zu isotherms; they are left out.",
            undetermined, shifts->n_rows);
}

static void add_assumed_temperature(limit_list *list, const answer_context *context)
{
    const double off =
        master_curve_value(&context->master_curve, MASTER_CURVE_KEY_SAMPLE_TEMPERATURE_ERROR).value;
    if (off > 0)
        add(list, WT_NOTE, LIMITS_MATERIAL,
            "The standard error of the temperature of the DMA sample is %s, which is assumed "
            "unless it is stated.",
            format_with_unit(off, "K").text);
}

/* The interval of a value excludes the model and what has no stated error. */
static void add_excluded(limit_list *list, limit_subject subject, const char *what,
                         const result_value *f)
{
    if (!isnan(f->number.value) && f->lacks != NULL)
        add(list, WT_NOTE, subject, "The 95 %% interval of the %s excludes errors of: %s.", what,
            f->lacks);
}

static void add_softening_limits(limit_list *list, const table_view *softening)
{
    const double share = softening_value(softening, SOFTENING_KEY_SHARE_ABOVE).value;
    if (share >= ANSWER_SHARE_MIN)
        add(list, WT_WARNING, LIMITS_FRICTION,
            "Up to %.0f %% of the hysteresis comes from strains above those of the softening, up "
            "to %.3g; its last values are used.",
            100 * share, softening_value(softening, SOFTENING_KEY_STRAIN).value);
}

static void add_friction_limits(limit_list *list, const answer_context *context)
{
    static const flash_key flash_statements[] = {FLASH_KEY_UNSETTLED, FLASH_KEY_LAW_RANGE};
    const table_view *const friction = &context->values.friction, *const what_if =
                                                                      &context->values.what_if;
    const bool known = friction->table != NULL;
    const double share = known ? largest_extrapolated_share(friction)
                               : what_if_value(what_if, WHAT_IF_KEY_EXTRAPOLATED_SHARE).value;
    if (share >= ANSWER_SHARE_MIN)
        add(list, WT_WARNING, LIMITS_FRICTION,
            "Up to %s of the hysteresis comes from frequencies outside the measured ones.",
            format_percent(share).text);
    add_stated(list, LIMITS_FRICTION, "friction",
               known ? friction_key_text(friction, FRICTION_KEY_MATERIAL_STATEMENT)
                     : what_if_key_text(what_if, WHAT_IF_KEY_MATERIAL_STATEMENT));
    add_softening_limits(list, &context->softening);
    for (size_t i = 0; i < COUNT_OF(flash_statements); i++)
        add_stated(list, LIMITS_FRICTION, "flash temperature",
                   flash_key_text(&context->flash, flash_statements[i]));
    if (!known)
        return;
    add_stated(list, LIMITS_FRICTION, "friction",
               friction_key_text(friction, FRICTION_KEY_NUMERICAL_STATEMENT));
    const double outside = friction_value(friction, FRICTION_KEY_LAYER_OUTSIDE).value;
    if (outside >= ANSWER_SHARE_MIN)
        add(list, WT_WARNING, LIMITS_FRICTION,
            "%s of the hysteresis with the layer comes from frequencies at which its moduli were "
            "not measured.",
            format_percent(outside).text);
    const bool flash = friction_key_text(friction, FRICTION_KEY_FLASH) != NULL,
               softens = friction_key_text(friction, FRICTION_KEY_SOFTENING) != NULL;
    add(list, WT_NOTE, LIMITS_FRICTION, "The friction theory assumes dry contact%s%s.",
        softens ? "" : ", small strain", flash ? "" : ", and one temperature");
    const result_value hysteresis =
        result_value_friction(&context->values, FRICTION_KEY_HYSTERESIS);
    add_excluded(list, LIMITS_FRICTION, "friction", &hysteresis);
    if (context->c != NULL && isnan(context->c->sliding.temperature.value))
        add(list, WT_NOTE, LIMITS_FRICTION,
            "No sliding temperature is stated: the reference temperature of the material is used.");
    if (context->c != NULL && isnan(context->c->sliding.reference_velocity) && friction->n_rows > 1)
        add(list, WT_NOTE, LIMITS_FRICTION,
            "No reference velocity is stated: %s is the middle of the velocities.",
            format_with_unit(hysteresis.velocity, "m/s").text);
    if (friction_key_text(friction, FRICTION_KEY_LAYER_THICKNESS) != NULL &&
        friction_key_text(friction, FRICTION_KEY_LAYER_MODULI) == NULL)
        add(list, WT_NOTE, LIMITS_FRICTION,
            "One ratio scales modulus and shear stress of the layer at all frequencies.");
}

/* ---- layer ----------------------------------------------------------------------------------- */

static void add_agreement_limits(limit_list *list, const answer_context *context, bool has_layer)
{
    if (context->values.comparison.table == NULL)
        return;
    const stated_verdict differs =
        (stated_verdict)comparison_key_enum(&context->values.comparison, COMPARISON_KEY_DIFFERS);
    if (differs == VERDICT_YES && !has_layer)
        add(list, WT_WARNING, LIMITS_LAYER,
            "The theory predicts no layer, but the indentation shows a modified track: wear rate, "
            "critical energy or model are wrong.");
    else if (differs != VERDICT_YES && has_layer)
        add(list, WT_NOTE, LIMITS_LAYER,
            "The indentation does not show this layer: it follows from the stated wear rate and "
            "critical energy.");
}

static void add_layer_limits(limit_list *list, const answer_context *context)
{
    const table_view *const layer = &context->values.layer;
    if (layer->table == NULL)
        return;
    add_stated(list, LIMITS_LAYER, "layer", layer_key_text(layer, LAYER_KEY_MATERIAL_STATEMENT));
    add_stated(list, LIMITS_LAYER, "layer", layer_key_text(layer, LAYER_KEY_NUMERICAL_STATEMENT));
    const result_value thickness = result_value_thickness(&context->values);
    const wt_estimate energy = layer_value(layer, LAYER_KEY_CRITICAL_ENERGY);
    if (is_thickness_put_in(&context->values))
        add(list, WT_NOTE, LIMITS_LAYER,
            "The critical energy is calibrated to the stated thickness, which is not a "
            "prediction.");
    else
        add(list, WT_NOTE, LIMITS_LAYER, "The critical energy, %s, is stated, not measured.",
            format_value(energy).text);
    add(list, WT_NOTE, LIMITS_LAYER, "No measured thickness has tested the layer model.");
    add(list, WT_NOTE, LIMITS_LAYER, "The layer does not change the energy that forms it.");
    add_excluded(list, LIMITS_LAYER, "thickness", &thickness);
    add_agreement_limits(list, context, layer_key_enum(layer, LAYER_KEY_REGIME) != WT_LAYER_NONE);
    if (context->wear.table != NULL) {
        const double measured = wear_value(&context->wear, WEAR_KEY_RATE).value,
                     used = layer_value(layer, LAYER_KEY_WEAR_RATE).value;
        if (measured > 0 && used > 0 && measured != used)
            add(list, WT_WARNING, LIMITS_LAYER,
                "The stated specific wear rate, %s, is used; the records measure %s.",
                format_with_unit(used, "m^2/N").text, format_with_unit(measured, "m^2/N").text);
    }
    const double value = thickness.number.value;
    if (!(value > 0) || !isfinite(value))
        return;
    if (context->roughness.n_rows > 0 &&
        value * roughness_get(&context->roughness, 0, ROUGHNESS_WAVENUMBER) > 1)
        add(list, WT_WARNING, LIMITS_LAYER,
            "The layer is thicker than the longest wave of the roughness reaches: the layer model "
            "is outside its range.");
    const double depth = usable_median(&context->indentation[1], INDENTATION_MAX_INDENTATION);
    if (depth > deep_share * value)
        add(list, WT_WARNING, LIMITS_LAYER,
            "Indentations of the track are %s deep, %.2g times the thickness: the layer differs "
            "more than the ratio says.",
            format_with_unit(depth, "m").text, depth / value);
}

static limit_list find_limits(const answer_context *context)
{
    limit_list list = {NULL, 0};
    const size_t failed = context->failures.n_rows;
    if (failed > 0)
        add(&list, WT_WARNING, LIMITS_DATA, "%zu file%s or stage%s failed; see the failures.",
            failed, failed == 1 ? "" : "s", failed == 1 ? "" : "s");
    add_dma_comparison_limits(&list, context); /* two rubbers are the worst for an answer */
    add_material_limits(&list, context);
    add_layer_limits(&list, context);
    add_friction_limits(&list, context);
    add_comparison_limits(&list, context);
    add_depth_limits(&list, context);
    add_assumed_temperature(&list, context);
    return list;
}

wt_status limits_table(const answer_context *context, wt_table **table, wt_error *err)
{
    limit_list list = find_limits(context);
    table_writer t = table_begin(&limits_schema, err);
    for (int severity = WT_WARNING; severity >= WT_NOTE; severity--)
        for (size_t i = 0; i < list.n; i++)
            if (list.limit[i].severity == (wt_severity)severity)
                TABLE_ADD(limits, &t, wt_severity_name(list.limit[i].severity),
                          limit_subject_text(list.limit[i].subject), list.limit[i].text);
    const wt_status status = table_end(&t, table);
    if (status == WT_OK && list.n == 0) {
        wt_table_free(*table);
        *table = NULL;
    }
    free(list.limit);
    return status;
}

void wt_result_log_remarks(const wt_result *result, wt_log *log)
{
    answer_context context = {.c = NULL};
    if (answer_context_bind(&context, result, NULL) != WT_OK)
        return; /* the command that wrote the table has failed already */
    const limit_list list = find_limits(&context);
    wt_log_topic topic = WT_TOPIC_WORST_LIMIT;
    for (size_t i = 0; i < list.n; i++) {
        if (list.limit[i].severity != WT_WARNING)
            continue;
        /* the fit of the material has told its own limits */
        if (list.limit[i].subject != LIMITS_MATERIAL)
            wt_log_add_topic(log, WT_WARNING, topic, NULL, NULL, "%s", list.limit[i].text);
        topic = WT_TOPIC_NONE;
    }
    free(list.limit);
}
