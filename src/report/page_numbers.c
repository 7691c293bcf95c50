/* The headline numbers of the page: the few values a reader looks for, with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "report/cells.h"

#include <math.h>
#include <string.h>

/* An interval as statistical error: "0.59 to 0.69 (95 %)". */
static void interval_row(wt_page *page, const char *name, double value, double low, double high,
                         const char *unit, const char *remark)
{
    wt_text interval = {0};
    const wt_estimate estimate = {value, (high - low) / 4, 0, unit};
    if (isfinite(low) && isfinite(high)) {
        wt_page_interval(&interval, low, high, value, unit, "");
        wt_text_add(&interval, " (95 % interval)");
    } else
        wt_text_add(&interval, "not known");
    wt_page_estimate(page, name, &estimate, "", wt_text_string(&interval), remark);
    page->out.failed = page->out.failed || interval.failed;
    wt_text_free(&interval);
}

static void ratio_row(wt_page *page)
{
    const wt_table *table = wt_result_find(page->result, "comparison");
    for (size_t row = 0; table != NULL && row < wt_table_n_rows(table); row++) {
        if (!isnan(wt_cell_number(table, row, "rate_low")) ||
            !isfinite(wt_cell_number(table, row, "ratio")))
            continue; // the row over all rates has no limits of the rate
        wt_text remark = {0};
        const char *unit = wt_table_key(table, "unit_of_analysis");
        wt_text_add(&remark, "geometric means; n = ");
        wt_text_fixed(&remark, wt_cell_number(table, row, "n_track"), 0);
        wt_text_add(&remark, " in the track, ");
        wt_text_fixed(&remark, wt_cell_number(table, row, "n_bulk"), 0);
        wt_text_add(&remark, " in the bulk");
        if (unit != NULL)
            wt_text_format(&remark, ", unit of analysis: %s", unit);
        interval_row(page, "Modulus, track over bulk", wt_cell_number(table, row, "ratio"),
                     wt_cell_number(table, row, "ratio_low"),
                     wt_cell_number(table, row, "ratio_high"), "1", wt_text_string(&remark));
        page->out.failed = page->out.failed || remark.failed;
        wt_text_free(&remark);
        return;
    }
}

static void group_rows(wt_page *page)
{
    const wt_table *table = wt_result_find(page->result, "modulus_groups");
    for (size_t row = 0; table != NULL && row < wt_table_n_rows(table); row++) {
        wt_text name = {0}, remark = {0};
        wt_text_format(&name, "Modulus, %s", wt_cell_text(table, row, "group"));
        wt_text_format(&remark, "geometric mean; n = %.0f, rejected %.0f",
                       wt_cell_number(table, row, "n"), wt_cell_number(table, row, "n_rejected"));
        if (isfinite(wt_cell_number(table, row, "geometric_mean")))
            interval_row(page, wt_text_string(&name), wt_cell_number(table, row, "geometric_mean"),
                         wt_cell_number(table, row, "low"), wt_cell_number(table, row, "high"),
                         "Pa", wt_text_string(&remark));
        page->out.failed = page->out.failed || name.failed || remark.failed;
        wt_text_free(&name);
        wt_text_free(&remark);
    }
}

static void key_row(wt_page *page, const char *table_name, const char *key, const char *name,
                    const char *remark)
{
    const wt_table *table = wt_result_find(page->result, table_name);
    wt_estimate estimate;
    if (table != NULL && wt_table_estimate(table, key, &estimate) && !isnan(estimate.value))
        wt_page_estimate(page, name, &estimate, key, NULL, remark);
}

static void add_velocity(wt_text *text, double velocity)
{
    wt_lab_unit lab = wt_lab_unit_for("m/s", "velocity", velocity);
    wt_text_short(text, wt_lab_value(&lab, velocity), 3);
    wt_text_format(text, " %s", lab.label);
}

/* At the velocity that the answer is given for. */
static void reference_rows(wt_page *page, const wt_table *table)
{
    wt_estimate velocity;
    if (!wt_table_estimate(table, "reference_velocity", &velocity))
        return;
    wt_text remark = {0};
    wt_text_add(&remark, "at the reference velocity, ");
    add_velocity(&remark, velocity.value);
    key_row(page, "friction", "friction_at_reference", "Friction coefficient",
            wt_text_string(&remark));
    key_row(page, "friction", "hysteresis_at_reference", "Friction coefficient, hysteresis part",
            wt_text_string(&remark));
    key_row(page, "friction", "area_ratio_at_reference", "Real over nominal contact area",
            wt_text_string(&remark));
    key_row(page, "friction", "friction_with_layer_at_reference", "Friction coefficient with layer",
            wt_text_string(&remark));
    key_row(page, "friction", "friction_change_at_reference", "Change of friction by the layer",
            wt_text_string(&remark));
    page->out.failed = page->out.failed || remark.failed;
    wt_text_free(&remark);
}

static void friction_row(wt_page *page, const wt_table *table, const char *column, const char *name)
{
    char standard[96], numerical[96];
    (void)snprintf(standard, sizeof standard, "%s_standard_error", column);
    (void)snprintf(numerical, sizeof numerical, "%s_numerical_error", column);
    size_t best = SIZE_MAX;
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        if (isfinite(wt_cell_number(table, row, column)) &&
            (best == SIZE_MAX ||
             wt_cell_number(table, row, column) > wt_cell_number(table, best, column)))
            best = row;
    if (best == SIZE_MAX)
        return;
    wt_text remark = {0};
    double velocity = wt_cell_number(table, best, "velocity"),
           share = wt_cell_number(table, best, "extrapolated_share");
    wt_text_add(&remark, "at ");
    add_velocity(&remark, velocity);
    if (share >= 1e-3) {
        wt_text_add(&remark, "; ");
        wt_text_number(&remark, 100 * share, 2);
        wt_text_add(&remark, " % from frequencies outside the measured ones");
    }
    const wt_estimate estimate = {wt_cell_number(table, best, column),
                                  wt_cell_number(table, best, standard),
                                  wt_cell_number(table, best, numerical), "1"};
    wt_page_estimate(page, name, &estimate, column, NULL, wt_text_string(&remark));
    page->out.failed = page->out.failed || remark.failed;
    wt_text_free(&remark);
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

void wt_page_numbers(wt_page *page)
{
    if (!has_any(page->result))
        return;
    wt_page_heading(page, "numbers", "Numbers");
    wt_page_estimates_begin(page,
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
    wt_page_estimates_end(page);
}
