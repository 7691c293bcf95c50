/* Writes the summary line of a result for standard error. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/answer/format_number.h"

#include "core/base/clocale.h"
#include "core/table/registry.h"
#include "weartrack/case.h"

#include <math.h>
#include <string.h>

typedef struct summary_line {
    text_builder line;
    const wt_result *result;
    result_value_tables values;
} summary_line;

#define append(s, ...) text_append(&(s)->line, __VA_ARGS__)

static void begin_clause(summary_line *s)
{
    append(s, "%s", s->line.used > 0 ? "; " : "");
}

/* Appends the text without its parts in brackets. */
static void append_undetectable_errors(summary_line *s, const char *text)
{
    char all[512];
    size_t n = 0;
    for (int depth = 0; *text != '\0' && n + 1 < sizeof all; text++) {
        depth += *text == '(';
        if (depth == 0 && !(*text == ' ' && text[1] == '('))
            all[n++] = *text;
        depth -= *text == ')';
    }
    all[n] = '\0';
    append(s, "; what no curve shows is not in that: %s", all);
}

static void append_assumed_errors(summary_line *s, const char *text, bool in_interval)
{
    append(s, "; %s: %s; state %s to narrow it",
           in_interval ? "in the interval" : "an interval would hold", text,
           strchr(text, ';') != NULL ? "them" : "it");
}

static void summarize_groups(summary_line *s, const table_view *v)
{
    const char *hidden = NULL, *assumed = NULL;
    bool has_interval = false;
    for (size_t i = 0; i < v->n_rows; i++) {
        const result_value modulus = result_value_group(&s->values, i);
        const double n = modulus_groups_get(v, i, MODULUS_GROUPS_N);
        const char *group = modulus_groups_text(v, i, MODULUS_GROUPS_GROUP);
        begin_clause(s);
        append(s, "%s: %.0f of %.0f curves accepted", group, n,
               n + modulus_groups_get(v, i, MODULUS_GROUPS_N_REJECTED));
        table_view curves;
        char reasons[512];
        const bool known =
            table_bind_result(s->result, &indentation_schema, group, &curves, NULL) == WT_OK;
        if (known && format_rejected_curves(&curves, reasons, sizeof reasons) > 0)
            append(s, " (rejected: %s)", reasons);
        if (isnan(modulus.number.value))
            continue;
        if (known && hidden == NULL)
            hidden = indentation_key_text(&curves, INDENTATION_KEY_NOT_SHOWN);
        if (known && assumed == NULL)
            assumed = indentation_key_text(&curves, INDENTATION_KEY_ASSUMED);
        has_interval = has_interval || !isnan(modulus.low);
        append(s, ", E = %s%s", format_plain_number(&modulus).text,
               format_frequency(&modulus).text);
        if (!isnan(modulus.low))
            append(s, " (%s, from %.0f spots)", format_interval(&modulus).text,
                   modulus_groups_get(v, i, MODULUS_GROUPS_N_SPOTS));
    }
    if (assumed != NULL)
        append_assumed_errors(s, assumed, has_interval);
    if (hidden != NULL)
        append_undetectable_errors(s, hidden);
}

static void summarize_ratio(summary_line *s, const table_view *v)
{
    if (v->n_rows == 0)
        return;
    begin_clause(s);
    append_modulus_ratio(&s->line, &s->values);
}

static void summarize_materials(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const char *remedy = material_ratio_key_text(v, MATERIAL_RATIO_KEY_SETTLED_BY);
    begin_clause(s);
    append(s, "%s", material_ratio_key_text(v, MATERIAL_RATIO_KEY_DIFFERS));
    if (remedy != NULL)
        append(s, "; what would settle it: %s", remedy);
}

static void summarize_shared_law(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const char *remedy = shared_shift_law_key_text(v, SHARED_SHIFT_LAW_KEY_SETTLED_BY);
    const char *without = shared_shift_law_key_text(v, SHARED_SHIFT_LAW_KEY_LEFT_OUT);
    const wt_estimate c1 = shared_shift_law_value(v, SHARED_SHIFT_LAW_KEY_WLF_C1);
    begin_clause(s);
    append(s, "one law: %s", shared_shift_law_key_text(v, SHARED_SHIFT_LAW_KEY_AGREE));
    if (remedy != NULL)
        append(s, "; what would settle it: %s", remedy);
    if (without != NULL)
        append(s, "; left out: %s", without);
    if (!isnan(c1.value))
        append(s, "; WLF C1 = %s, C2 = %s, reference temperature %s", format_estimate(c1).text,
               format_estimate(shared_shift_law_value(v, SHARED_SHIFT_LAW_KEY_WLF_C2)).text,
               shared_shift_law_key_text(v, SHARED_SHIFT_LAW_KEY_MOVED));
}

static void summarize_material(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const wt_estimate c1 = shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C1);
    const char *const sample = shift_factors_key_text(v, SHIFT_FACTORS_KEY_SAMPLE);
    begin_clause(s);
    if (sample != NULL)
        append(s, "%s: ", sample);
    append(
        s, "%zu isotherm%s at the reference temperature %s", v->n_rows, v->n_rows == 1 ? "" : "s",
        format_celsius(shift_factors_value(v, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE).value).text);
    if (!isnan(c1.value))
        append(s, ", WLF C1 = %s, C2 = %s", format_estimate(c1).text,
               format_estimate(shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C2)).text);
    const char *verdict = shift_factors_key_text(v, SHIFT_FACTORS_KEY_SUPERPOSITION);
    /* A failed or inconclusive superposition is explained by a warning. */
    const wt_superposition state =
        (wt_superposition)shift_factors_key_enum(v, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const bool warned = v->n_rows > 1 && state != WT_SUPERPOSITION_HOLDS;
    append(s, ", superposition: %.*s", (int)(warned ? strcspn(verdict, ":") : strlen(verdict)),
           verdict);
}

/* The number of decimals follows from the error. */
static void append_peak(summary_line *s, wt_estimate at, const char *of)
{
    const double error = at.standard_error;
    if (!(error > 0) || !isfinite(error)) {
        append(s, " %s (peak of %s, error not known)", format_celsius(at.value).text, of);
        return;
    }
    const int decimals = (int)fmax(0, fmin(4, 1 - floor(log10(error))));
    append(s, " %.*f °C ± %.*f K (peak of %s)", decimals, at.value - WT_ZERO_CELSIUS, decimals,
           error, of);
}

static void summarize_transition(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const wt_estimate factor = glass_transition_value(v, GLASS_TRANSITION_KEY_FACTOR_PEAK),
                      loss = glass_transition_value(v, GLASS_TRANSITION_KEY_LOSS_PEAK);
    begin_clause(s);
    if (isnan(factor.value) && isnan(loss.value)) {
        append(s, "no glass transition in the range measured");
        return;
    }
    append(s, "glass transition at %s:",
           format_value(glass_transition_value(v, GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY)).text);
    if (!isnan(factor.value))
        append_peak(s, factor, "tan delta");
    if (!isnan(loss.value)) {
        append(s, "%s", isnan(factor.value) ? "" : ",");
        append_peak(s, loss, "the loss modulus");
    }
    const wt_estimate energy =
        glass_transition_value(v, isnan(factor.value) ? GLASS_TRANSITION_KEY_LOSS_ENERGY
                                                      : GLASS_TRANSITION_KEY_FACTOR_ENERGY);
    if (!isnan(energy.value))
        append(s, "; activation energy %.3g ± %.2g kJ/mol", energy.value / 1000,
               energy.standard_error / 1000);
}

static void summarize_payne(summary_line *s, const table_view *v)
{
    enum { MOST = 3 }; /* limit for the length of the line */
    for (size_t i = 0; i < v->n_rows && i < MOST; i++) {
        const double tenth = payne_get(v, i, PAYNE_STRAIN_TENTH);
        begin_clause(s);
        append(s,
               "at %s the storage modulus goes from %s to %s, between strains of %.2g and %.2g %%",
               format_with_unit(payne_get(v, i, PAYNE_ANGULAR_FREQUENCY), "rad/s").text,
               format_with_unit(payne_get(v, i, PAYNE_STORAGE_START), "Pa").text,
               format_with_unit(payne_get(v, i, PAYNE_STORAGE_END), "Pa").text,
               100 * payne_get(v, i, PAYNE_STRAIN_MIN), 100 * payne_get(v, i, PAYNE_STRAIN_MAX));
        if (!isnan(tenth))
            append(s, "; a tenth is lost at %.2g %%", 100 * tenth);
    }
    if (v->n_rows > MOST)
        append(s, "; %zu more strain sweeps", v->n_rows - MOST);
}

static void summarize_record(summary_line *s, const table_view *v)
{
    if (v->n_rows == 0)
        return;
    begin_clause(s);
    append_record(&s->line, v);
}

static void summarize_wear(summary_line *s, const table_view *v)
{
    if (v->n_rows == 0)
        return;
    begin_clause(s);
    append_wear(&s->line, v);
}

static void summarize_dwell(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const wt_estimate at = dwell_value(v, DWELL_KEY_ANGULAR_FREQUENCY);
    size_t n = 0;
    for (size_t i = 0; i < v->n_rows; i++)
        n += isnan(dwell_get(v, i, DWELL_STORAGE)) ? 0 : 1;
    begin_clause(s);
    if (n > 0 && n < v->n_rows)
        append(s, "%zu of ", n);
    append(s, "%zu dwell%s", v->n_rows, v->n_rows == 1 ? "" : "s");
    if (isnan(at.value))
        append(s, ", no moduli of %s", v->n_rows == 1 ? "it" : "them");
    else
        append(s, ": at %s E' = %s, E'' = %s", format_with_unit(at.value, "rad/s").text,
               format_estimate(dwell_value(v, DWELL_KEY_STORAGE)).text,
               format_estimate(dwell_value(v, DWELL_KEY_LOSS)).text);
    for (size_t i = 0; i < v->n_rows && n > 0; i++)
        if (!isnan(dwell_get(v, i, DWELL_STORAGE)) && *dwell_text(v, i, DWELL_NOTE) != '\0') {
            append(s, " (%s)", dwell_text(v, i, DWELL_NOTE));
            break;
        }
}

static void append_dwell_ratio(summary_line *s, const char *modulus, double ratio, double low,
                               double high)
{
    append(s, " %s %s times that of the DMA", modulus, format_with_unit(ratio, "1").text);
    if (isnan(low))
        append(s, " (error not known)");
    else
        append(s, " (95 %% interval %s to %s)", format_with_unit(low, "1").text,
               format_with_unit(high, "1").text);
}

/* For each group the line has the middle row of those inside the frequency range of the DMA. */
static void summarize_dwell_dma(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const char *lacks = dwell_dma_key_text(v, DWELL_DMA_KEY_ERROR_LACKS);
    for (size_t from = 0, to; from < v->n_rows; from = to) {
        const char *group = dwell_dma_text(v, from, DWELL_DMA_GROUP);
        size_t first = SIZE_MAX, last = 0;
        for (to = from;
             to < v->n_rows && strcmp(dwell_dma_text(v, to, DWELL_DMA_GROUP), group) == 0; to++)
            if (dwell_dma_get(v, to, DWELL_DMA_EXTRAPOLATED) == 0 &&
                !isnan(dwell_dma_get(v, to, DWELL_DMA_STORAGE_RATIO))) {
                first = first == SIZE_MAX ? to : first;
                last = to;
            }
        begin_clause(s);
        if (first == SIZE_MAX) {
            append(s, "%s: no dwell tells a frequency at which the DMA was measured", group);
            continue;
        }
        const size_t row = (first + last) / 2;
        append(s, "%s: at %s", group,
               format_with_unit(dwell_dma_get(v, row, DWELL_DMA_ANGULAR_FREQUENCY), "rad/s").text);
        append_dwell_ratio(s, "E'", dwell_dma_get(v, row, DWELL_DMA_STORAGE_RATIO),
                           dwell_dma_get(v, row, DWELL_DMA_STORAGE_RATIO_LOW),
                           dwell_dma_get(v, row, DWELL_DMA_STORAGE_RATIO_HIGH));
        append(s, ",");
        append_dwell_ratio(s, "E''", dwell_dma_get(v, row, DWELL_DMA_LOSS_RATIO),
                           dwell_dma_get(v, row, DWELL_DMA_LOSS_RATIO_LOW),
                           dwell_dma_get(v, row, DWELL_DMA_LOSS_RATIO_HIGH));
        if (lacks != NULL)
            append(s, ", without the error of the %s",
                   dwell_dma_key_items(v, DWELL_DMA_KEY_ERROR_LACKS) ==
                           SCHEMA_BIT(SOURCE_TEMPERATURE)
                       ? "temperature of the DMA"
                       : "DMA");
    }
}

static void summarize_sensitivity(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const wt_estimate value = sensitivity_value(v, SENSITIVITY_KEY_SENSITIVITY),
                      factor = sensitivity_value(v, SENSITIVITY_KEY_FACTOR);
    const slope_direction direction =
        (slope_direction)sensitivity_key_enum(v, SENSITIVITY_KEY_DIRECTION);
    const bool straight = sensitivity_key_enum(v, SENSITIVITY_KEY_VERDICT) == SLOPE_STRAIGHT;
    const char *option = sensitivity_key_text(v, SENSITIVITY_KEY_INDENT),
               *compare = sensitivity_key_text(v, SENSITIVITY_KEY_COMPARE),
               *verdict = sensitivity_key_text(v, SENSITIVITY_KEY_VERDICT);
    begin_clause(s);
    if (!isnan(value.value))
        append(s, "deflection sensitivity %s", format_estimate(value).text);
    else if (isnan(factor.value))
        append(s, "no deflection sensitivity");
    if (!isnan(factor.value))
        append(s, "%s%s of that of the file", isnan(value.value) ? "deflection sensitivity " : ", ",
               format_estimate(factor).text);
    for (size_t i = 0; i < v->n_rows; i++)
        if (sensitivity_enum(v, i, SENSITIVITY_DIRECTION) == (int)direction) {
            const double n = sensitivity_get(v, i, SENSITIVITY_N);
            append(s, " (%.0f curve%s, %s)", n, n > 1 ? "s" : "",
                   direction == SLOPE_OF_BOTH ? "approach and retract"
                                              : slope_direction_text(direction));
        }
    append(s, "; %s", verdict);
    if (option != NULL)
        append(s, "; %s %s%s%s", straight ? "use" : "if it is hard, use", option,
               compare != NULL ? ", and in compare " : "", compare != NULL ? compare : "");
}

static void summarize_thermal(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const wt_estimate k = thermal_value(v, THERMAL_KEY_SPRING_CONSTANT);
    size_t n = 0;
    for (size_t i = 0; i < v->n_rows; i++)
        n += isnan(thermal_get(v, i, THERMAL_SPRING_CONSTANT)) ? 0 : 1;
    begin_clause(s);
    if (isnan(k.value)) {
        append(s, "no spring constant: %s", v->n_rows > 0 ? thermal_text(v, 0, THERMAL_NOTE) : "");
        return;
    }
    append(s, "spring constant %s", format_estimate(k).text);
    if (v->n_rows == 1)
        append(s, " (resonance %s, quality factor %s)",
               format_with_unit(thermal_get(v, 0, THERMAL_RESONANCE), "Hz").text,
               format_with_unit(thermal_get(v, 0, THERMAL_QUALITY), "1").text);
    else
        append(s, " (mean of %zu spectra)", n);
    if (v->n_rows == 1 && !isnan(thermal_get(v, 0, THERMAL_RATIO)))
        append(s, ", %s of that of the file",
               format_with_unit(thermal_get(v, 0, THERMAL_RATIO), "1").text);
    const char *includes = thermal_key_text(v, THERMAL_KEY_INCLUDES),
               *indent = thermal_key_text(v, THERMAL_KEY_INDENT),
               *compare = thermal_key_text(v, THERMAL_KEY_COMPARE);
    if (k.standard_error >= 0)
        append(s, "; its error is that of %s", includes);
    if (v->n_rows == 1 && !isnan(thermal_get(v, 0, THERMAL_SADER)))
        append(s, "; by Sader's method %s",
               format_with_unit(thermal_get(v, 0, THERMAL_SADER), "N/m").text);
    if (indent == NULL)
        append(s, "; not to be used: %s", thermal_key_text(v, THERMAL_KEY_CONTRADICTION));
    else
        append(s, "; use %s%s%s", indent, compare != NULL ? ", and in compare " : "",
               compare != NULL ? compare : "");
}

static void summarize_friction(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    const result_value hysteresis = result_value_friction(&s->values, FRICTION_KEY_HYSTERESIS),
                       area = result_value_friction(&s->values, FRICTION_KEY_AREA_RATIO),
                       total = result_value_friction(&s->values, FRICTION_KEY_FRICTION),
                       with_layer = result_value_friction(&s->values, FRICTION_KEY_WITH_LAYER);
    begin_clause(s);
    append(s, "at %s ", format_with_unit(hysteresis.velocity, "m/s").text);
    if (!isnan(total.number.value))
        append(s, "mu = %s, ", format_result_value(&total).text);
    if (!isnan(with_layer.number.value)) {
        append(s, "with layer %s, ", format_result_value(&with_layer).text);
        append_friction_change(&s->line, &s->values, false);
        append(s, ", ");
    } else if (friction_value(v, FRICTION_KEY_LAYER_THICKNESS).value > 0) {
        append(s, "friction with the layer not known without a shear stress, ");
    }
    append(s, "hysteresis %s, contact area of the nominal one %s",
           format_result_value(&hysteresis).text, format_result_value(&area).text);
}

static void summarize_identification(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    begin_clause(s);
    append_identification(&s->line, v);
}

static void summarize_shared_pairs(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    begin_clause(s);
    append_shared_pairs(&s->line, v);
}

static void summarize_validation(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    begin_clause(s);
    append_verdict(&s->line, v);
    if (!isnan(validation_value(v, VALIDATION_KEY_NEEDED).value)) {
        begin_clause(s);
        append_required_shear(&s->line, v);
    }
}

static void summarize_validation_running_in(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    begin_clause(s);
    append_running_in_verdict(&s->line, v);
    if (!isnan(validation_running_in_value(v, VALIDATION_RUNNING_IN_KEY_WEAR).value)) {
        begin_clause(s);
        append_required_wear(&s->line, v);
    }
}

static void summarize_layer(summary_line *s, const table_view *v)
{
    if (v->table == NULL)
        return;
    begin_clause(s);
    append_thickness(&s->line, &s->values);
    const result_value thickness = result_value_thickness(&s->values);
    if (thickness.number.value > 0 && isfinite(thickness.number.value))
        append(s, ", 90 %% of it after %s",
               format_known_estimate(layer_value(v, LAYER_KEY_TIME_TO_90_PERCENT)).text);
}

size_t wt_result_summary_line(const wt_result *result, char *buffer, size_t size)
{
    static const struct {
        const table_schema *schema;
        void (*summarize)(summary_line *s, const table_view *view);
    } parts[] = {{&dwell_schema, summarize_dwell},
                 {&dwell_dma_schema, summarize_dwell_dma},
                 {&sensitivity_schema, summarize_sensitivity},
                 {&thermal_schema, summarize_thermal},
                 {&modulus_groups_schema, summarize_groups},
                 {&comparison_schema, summarize_ratio},
                 {&material_ratio_schema, summarize_materials},
                 {&shared_shift_law_schema, summarize_shared_law},
                 {&shift_factors_schema, summarize_material},
                 {&glass_transition_schema, summarize_transition},
                 {&payne_schema, summarize_payne},
                 {&record_schema, summarize_record},
                 {&wear_schema, summarize_wear},
                 {&friction_schema, summarize_friction},
                 {&layer_schema, summarize_layer},
                 {&identification_schema, summarize_identification},
                 {&shared_pairs_schema, summarize_shared_pairs},
                 {&validation_schema, summarize_validation},
                 {&validation_running_in_schema, summarize_validation_running_in}};
    summary_line s = {.line = {buffer, size, 0}, .result = result};
    const locale_t previous = clocale_enter();
    if (size > 0)
        buffer[0] = '\0';
    if (result_values_bind(result, &s.values, NULL) != WT_OK) {
        /* A table without a required column adds no text; the other tables do. */
    }
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        table_view view;
        if (table_bind_result(result, parts[i].schema, "", &view, NULL) == WT_OK)
            parts[i].summarize(&s, &view);
    }
    for (size_t i = 0; i < wt_result_n_tables(result); i++) { /* tables of several samples */
        static const char prefix[] = "shift_factors/";
        const wt_table *const table = wt_result_table(result, i);
        table_view view;
        if (strncmp(wt_table_name(table), prefix, strlen(prefix)) == 0 &&
            table_bind(table, &shift_factors_schema, "", &view, NULL) == WT_OK)
            summarize_material(&s, &view);
    }
    clocale_leave(previous);
    return s.line.used;
}
