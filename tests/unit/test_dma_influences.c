/* Influence of each isotherm: none matters in a clean sweep; a stiffer isotherm is named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/dma.h"

#include "core/table/registry.h"
#include "dma/master.h"
#include "dma_data.h"

enum { ISOTHERMS = 11, STIFF = 4 };

/* Fits the usual sweep with isotherm STIFF times a factor and computes the influences. half_width
 * replaces those of the intervals of all shifts; NaN: their own. */
static wt_table *influences_of(double factor, double half_width, const wt_master_options *options,
                               wt_log *log, wt_master *all)
{
    wt_sweep sweep = {0};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    dma_usual(&sweep, false, 0.01, 3);
    for (size_t k = 0; k < sweep.isotherms[STIFF].n; k++) {
        sweep.isotherms[STIFF].storage_modulus[k] *= factor;
        sweep.isotherms[STIFF].loss_modulus[k] *= factor;
    }
    /* the order of the sweep differs from that of the shifts */
    for (size_t i = 0; i < ISOTHERMS / 2; i++) {
        const wt_isotherm first = sweep.isotherms[i];
        sweep.isotherms[i] = sweep.isotherms[ISOTHERMS - 1 - i];
        sweep.isotherms[ISOTHERMS - 1 - i] = first;
    }
    if (wt_master_fit(&sweep, options, NULL, all, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    for (size_t i = 0; i < ISOTHERMS && !isnan(half_width); i++) {
        all->shifts[i].log_a.low = all->shifts[i].log_a.value - half_width;
        all->shifts[i].log_a.high = all->shifts[i].log_a.value + half_width;
    }
    if (flow_influence_table(&sweep, options, all, log, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_sweep_clear(&sweep);
    assert_int_equal(wt_table_n_rows(table), ISOTHERMS);
    return table;
}

static double cell(const wt_table *table, size_t row, const char *column)
{
    return wt_table_number(table, row, (size_t)wt_table_find(table, column));
}

static void a_clean_sweep_has_no_influence(void **state)
{
    (void)state;
    wt_log *log = wt_log_new();
    wt_master all = {0};
    wt_master_options options = wt_master_options_defaults();
    options.vertical = WT_VERTICAL_NONE;
    wt_table *const table = influences_of(1.0, (double)NAN, &options, log, &all);
    double outside = 0;
    for (size_t i = 0; i < ISOTHERMS; i++) {
        outside += cell(table, i, "outside");
        assert_near_abs(cell(table, i, "temperature"), 253.15 + 10.0 * (double)i, 1e-9);
        assert_near_abs(cell(table, i, "log_a_change"), 0, 0.02);
        assert_true(cell(table, i, "log_a_half_width") > 0.003);
        assert_near_abs(cell(table, i, "wlf_c1_change"), 0, 3 * all.c1.standard_error);
        assert_near_abs(cell(table, i, "wlf_c2_change"), 0, 3 * all.c2.standard_error);
        assert_near_abs(cell(table, i, "storage_change"), 0, 0.01);
        assert_near_abs(cell(table, i, "loss_change"), 0, 0.01);
        assert_near_abs(cell(table, i, "lost"), 0, 0);
    }
    assert_true(outside <= 3); /* of 110 */
    wt_table_free(table);
    wt_master_clear(&all);
    wt_log_free(log);
}

/* A stiffer isotherm moves others within their intervals, which include the lack of fit. */
static void a_stiffer_isotherm_is_named(void **state)
{
    (void)state;
    static const double half_widths[] = {(double)NAN, 0.018};
    for (size_t k = 0; k < 2; k++) {
        wt_log *log = wt_log_new();
        wt_master all = {0};
        wt_master_options options = wt_master_options_defaults();
        options.vertical = WT_VERTICAL_NONE;
        wt_table *const table = influences_of(1.25, half_widths[k], &options, log, &all);
        const double most = fabs(cell(table, STIFF, "log_a_change"));
        for (size_t i = 0; i < ISOTHERMS; i++) {
            assert_true(i == STIFF || fabs(cell(table, i, "log_a_change")) < most);
            assert_true((cell(table, i, "outside") > 0) == (k == 1 && i == STIFF));
        }
        assert_near_abs(most, 0.023, 0.004);
        assert_true(most < cell(table, STIFF, "log_a_half_width") || k == 1);
        assert_int_equal(wt_log_count(log), k);
        if (k == 1)
            assert_non_null(strstr(wt_log_get(log, 0).text, "without the isotherm of 20.00 °C"));
        wt_table_free(table);
        wt_master_clear(&all);
        wt_log_free(log);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_clean_sweep_has_no_influence),
        cmocka_unit_test(a_stiffer_isotherm_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
