/* The headline numbers of the page: the few values a reader looks for, with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "report/cells.h"

#include <math.h>
#include <string.h>

/* An interval as statistical error: "0.59 to 0.69 (95 %)". */
static void interval_row(page_writer *page, const char *name, double value, double low, double high,
                         const char *unit, const char *remark)
{
    growing_text interval = {0};
    const wt_estimate estimate = {value, (high - low) / 4, 0, unit};
    if (isfinite(low) && isfinite(high)) {
        page_interval(&interval, low, high, value, unit, "");
        text_add(&interval, " (95 % interval)");
    } else
        text_add(&interval, "not known");
    page_estimate(page, name, &estimate, "", text_string(&interval), remark);
    page->out.failed = page->out.failed || interval.failed;
    text_free(&interval);
}

static void ratio_row(page_writer *page)
{
    const wt_table *table = wt_result_find(page->result, "comparison");
    for (size_t row = 0; table != NULL && row < wt_table_n_rows(table); row++) {
        if (!isnan(cell_number(table, row, "rate_low")) ||
            !isfinite(cell_number(table, row, "ratio")))
            continue; // the row over all rates has no limits of the rate
        growing_text remark = {0};
        const char *unit = wt_table_key(table, "unit_of_analysis");
        text_add(&remark, "geometric means; n = ");
        text_fixed(&remark, cell_number(table, row, "n_track"), 0);
        text_add(&remark, " in the track, ");
        text_fixed(&remark, cell_number(table, row, "n_bulk"), 0);
        text_add(&remark, " in the bulk");
        if (unit != NULL)
            text_format(&remark, ", unit of analysis: %s", unit);
        interval_row(page, "Modulus, track over bulk", cell_number(table, row, "ratio"),
                     cell_number(table, row, "ratio_low"), cell_number(table, row, "ratio_high"),
                     "1", text_string(&remark));
        page->out.failed = page->out.failed || remark.failed;
        text_free(&remark);
        return;
    }
}

static void group_rows(page_writer *page)
{
    const wt_table *table = wt_result_find(page->result, "modulus_groups");
    for (size_t row = 0; table != NULL && row < wt_table_n_rows(table); row++) {
        growing_text name = {0}, remark = {0};
        text_format(&name, "Modulus, %s", cell_text(table, row, "group"));
        text_format(&remark, "geometric mean; n = %.0f, rejected %.0f",
                    cell_number(table, row, "n"), cell_number(table, row, "n_rejected"));
        if (isfinite(cell_number(table, row, "geometric_mean")))
            interval_row(page, text_string(&name), cell_number(table, row, "geometric_mean"),
                         cell_number(table, row, "low"), cell_number(table, row, "high"), "Pa",
                         text_string(&remark));
        page->out.failed = page->out.failed || name.failed || remark.failed;
        text_free(&name);
        text_free(&remark);
    }
}

static void key_row(page_writer *page, const char *table_name, const char *key, const char *name,
                    const char *remark)
{
    const wt_table *table = wt_result_find(page->result, table_name);
    wt_estimate estimate;
    if (table != NULL && wt_table_estimate(table, key, &estimate) && !isnan(estimate.value))
        page_estimate(page, name, &estimate, key, NULL, remark);
}

static void add_velocity(growing_text *text, double velocity)
{
    lab_unit lab = lab_unit_for("m/s", "velocity", velocity);
    text_short(text, lab_value(&lab, velocity), 3);
    text_format(text, " %s", lab.label);
}

/* At the velocity that the answer is given for. */
static void reference_rows(page_writer *page, const wt_table *table)
{
    wt_estimate velocity;
    if (!wt_table_estimate(table, "reference_velocity", &velocity))
        return;
    growing_text remark = {0};
    text_add(&remark, "at the reference velocity, ");
    add_velocity(&remark, velocity.value);
    key_row(page, "friction", "friction_at_reference", "Friction coefficient",
            text_string(&remark));
    key_row(page, "friction", "hysteresis_at_reference", "Friction coefficient, hysteresis part",
            text_string(&remark));
    key_row(page, "friction", "area_ratio_at_reference", "Real over nominal contact area",
            text_string(&remark));
    key_row(page, "friction", "friction_with_layer_at_reference", "Friction coefficient with layer",
            text_string(&remark));
    key_row(page, "friction", "friction_change_at_reference", "Change of friction by the layer",
            text_string(&remark));
    page->out.failed = page->out.failed || remark.failed;
    text_free(&remark);
}

static void friction_row(page_writer *page, const wt_table *table, const char *column,
                         const char *name)
{
    char standard[96], numerical[96];
    (void)snprintf(standard, sizeof standard, "%s_standard_error", column);
    (void)snprintf(numerical, sizeof numerical, "%s_numerical_error", column);
    size_t best = SIZE_MAX;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        if (isfinite(cell_number(table, row, column)) &&
            (best == SIZE_MAX ||
             cell_number(table, row, column) > cell_number(table, best, column)))
            best = row;
    if (best == SIZE_MAX)
        return;
    growing_text remark = {0};
    double velocity = cell_number(table, best, "velocity"),
           share = cell_number(table, best, "extrapolated_share");
    text_add(&remark, "at ");
    add_velocity(&remark, velocity);
    if (share >= 1e-3) {
        text_add(&remark, "; ");
        text_number(&remark, 100 * share, 2);
        text_add(&remark, " % from frequencies outside the measured ones");
    }
    const wt_estimate estimate = {cell_number(table, best, column),
                                  cell_number(table, best, standard),
                                  cell_number(table, best, numerical), "1"};
    page_estimate(page, name, &estimate, column, NULL, text_string(&remark));
    page->out.failed = page->out.failed || remark.failed;
    text_free(&remark);
}

static bool has_any(const wt_result *result)
{
    static const char *const tables[] = {"comparison", "modulus_groups", "shift_factors",
                                         "friction", "layer"};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        if (wt_result_find(result, tables[i]) != NULL)
            return true;
    return false;
}

void page_numbers(page_writer *page)
{
    if (!has_any(page->result))
        return;
    page_heading(page, "numbers", "Numbers");
    page_estimates_begin(page,
                         "Main results. Statistical error: one standard error, or the "
                         "interval stated; numerical error: of the computation",
                         true);
    ratio_row(page);
    group_rows(page);
    key_row(page, "shift_factors", "wlf_c1", "WLF constant C₁",
            "correlated with C₂, see the table of constants");
    key_row(page, "shift_factors", "wlf_c2", "WLF constant C₂", "");
    key_row(page, "shift_factors", "reference_temperature", "Reference temperature", "");
    const wt_table *friction = wt_result_find(page->result, "friction");
    if (friction != NULL) {
        reference_rows(page, friction);
        friction_row(page, friction, "friction", "Friction coefficient, largest");
    }
    key_row(page, "layer", "balance_thickness", "Layer thickness at balance",
            "where formation and wear are equally fast");
    page_estimates_end(page);
}
