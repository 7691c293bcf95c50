/* Adds warnings to the log that follow from the tables of a result. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/answer/format_number.h"
#include "core/base/array.h"
#include "core/table/registry.h"
#include "weartrack/case.h"

#include <math.h>
#include <string.h>

static void warn_material(double share, const char *statement, wt_log *log)
{
    if (share >= ANSWER_SHARE_MIN)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "friction: up to %s of the hysteresis comes from frequencies outside the "
                   "measured ones",
                   format_share(share).text);
    if (statement != NULL)
        wt_log_add(log, WT_WARNING, NULL, NULL, "friction: %s", statement);
}

static void warn_friction(const table_view *v, wt_log *log)
{
    const char *numerical = friction_key_text(v, FRICTION_KEY_NUMERICAL_STATEMENT);
    if (numerical != NULL)
        wt_log_add(log, WT_WARNING, NULL, NULL, "friction: %s", numerical);
    warn_material(largest_extrapolated_share(v),
                  friction_key_text(v, FRICTION_KEY_MATERIAL_STATEMENT), log);
    const double outside = friction_value(v, FRICTION_KEY_LAYER_OUTSIDE).value;
    if (outside >= ANSWER_SHARE_MIN)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "layer: %s of the hysteresis on it comes from frequencies at which its "
                   "moduli were not measured",
                   format_share(outside).text);
}

static void warn_softening(const table_view *v, wt_log *log)
{
    const double share = softening_value(v, SOFTENING_KEY_SHARE_ABOVE).value;
    if (share >= ANSWER_SHARE_MIN)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "friction: up to %.0f %% of the hysteresis comes from strains above those "
                   "of the softening, up to %.3g, for which its last f and g were taken",
                   100 * share, softening_value(v, SOFTENING_KEY_STRAIN).value);
}

static void warn_flash(const table_view *v, wt_log *log)
{
    static const flash_key keys[] = {FLASH_KEY_UNSETTLED, FLASH_KEY_BRANCHES, FLASH_KEY_LAW_RANGE};
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        const char *words = flash_key_text(v, keys[i]);
        if (words != NULL)
            wt_log_add(log, WT_WARNING, NULL, NULL, "flash temperature: %s", words);
    }
}

static void warn_dma_comparison(const table_view *v, wt_log *log)
{
    const size_t n = count_extrapolated(v);
    const char *statement = dma_comparison_key_text(v, DMA_COMPARISON_KEY_MATERIAL_STATEMENT);
    double low, high;
    if (find_dma_ratio(v, &low, &high) && is_different_rubber(low, high))
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "indentation and DMA do not describe one rubber: at equal frequency the "
                   "indentation modulus of the bulk is %s times |E*|; units, spring constant, "
                   "sensitivity, tip, temperature and the files are to be checked",
                   format_with_unit(1 / low > high ? low : high, "1").text);
    if (n > 0)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "%zu of %zu comparisons with DMA lie outside the measured frequencies", n,
                   v->n_rows);
    if (statement != NULL)
        wt_log_add(log, WT_WARNING, NULL, NULL, "comparison with DMA: %s", statement);
}

/* The name of the group follows the slash in the name of the table. */
static void warn_curves(const wt_table *table, wt_log *log)
{
    const size_t prefix = strlen(indentation_schema.name);
    char text[512];
    text_builder t = {text, sizeof text, 0};
    table_view view;
    if (strncmp(wt_table_name(table), indentation_schema.name, prefix) == 0 &&
        table_bind(table, &indentation_schema, "", &view, NULL) == WT_OK &&
        append_spectrum_mismatch(&t, &view, wt_table_name(table) + prefix))
        wt_log_add(log, WT_WARNING, NULL, NULL, "indentation: %s", text);
}

static void warn_layer(const table_view *v, wt_log *log)
{
    static const layer_key statements[] = {LAYER_KEY_MATERIAL_STATEMENT,
                                           LAYER_KEY_NUMERICAL_STATEMENT};
    for (size_t i = 0; i < COUNT_OF(statements); i++) {
        const char *words = layer_key_text(v, statements[i]);
        if (words != NULL)
            wt_log_add(log, WT_WARNING, NULL, NULL, "layer: %s", words);
    }
}

void wt_result_log_remarks(const wt_result *result, wt_log *log)
{
    table_view view;
    for (size_t i = 0; i < wt_result_n_tables(result); i++)
        warn_curves(wt_result_table(result, i), log);
    if (table_bind_result(result, &friction_schema, "", &view, NULL) == WT_OK)
        warn_friction(&view, log);
    else if (table_bind_result(result, &what_if_schema, "", &view, NULL) == WT_OK)
        warn_material(what_if_value(&view, WHAT_IF_KEY_EXTRAPOLATED_SHARE).value,
                      what_if_key_text(&view, WHAT_IF_KEY_MATERIAL_STATEMENT), log);
    if (table_bind_result(result, &softening_schema, "", &view, NULL) == WT_OK)
        warn_softening(&view, log);
    if (table_bind_result(result, &flash_schema, "", &view, NULL) == WT_OK)
        warn_flash(&view, log);
    if (table_bind_result(result, &dma_comparison_schema, "", &view, NULL) == WT_OK)
        warn_dma_comparison(&view, log);
    if (table_bind_result(result, &layer_schema, "", &view, NULL) == WT_OK)
        warn_layer(&view, log);
}
