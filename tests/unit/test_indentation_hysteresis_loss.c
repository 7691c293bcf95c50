/* Shared error of curves with hysteresis loss.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "indentation/indent.h"

enum { CURVES = 8 };

/* Key loss_error for numbers of curves: with a loss of known size, with a loss of unknown effect,
 * and without loss. */
static double error_of(size_t known, size_t unknown)
{
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    indent_summary together = {0};
    table_writer rows = table_begin(&indentation_schema, &err);
    job.group = "bulk";
    work.log = wt_log_new();
    for (size_t i = 0; i < CURVES; i++) {
        wt_indent_fit fit = {.modulus = {1e6, 1e4, 0, "Pa"},
                             .loss = i < known + unknown ? 0.3 : 0.01,
                             .loss_bias = i < known ? 0.05 : (double)NAN,
                             .loss_error = i < known ? 0.04 : (double)NAN,
                             .spectrum_factor = {(double)NAN, (double)NAN, 0, "1"},
                             .misfit = {(double)NAN}};
        indent_summary_add(&together, &fit, &job.options);
    }
    indent_summary_report(&together, &job, &work, &rows);
    wt_estimate error = {0};
    assert_true(wt_table_estimate(rows.table, "loss_error", &error));
    indent_summary_clear(&together);
    wt_log_free(work.log);
    wt_table_free(rows.table);
    return error.value;
}

static void test_loss(void **state)
{
    (void)state;
    assert_near(error_of(0, 0), 0, 0);
    assert_near(error_of(CURVES, 0), 0.04, 1e-12);
    assert_true(isnan(error_of(0, CURVES)));
    assert_true(isnan(error_of(0, CURVES / 2)));
    assert_near(error_of(0, CURVES / 2 - 1), 0, 0);
    assert_near(error_of(5, 3), 0.04, 1e-12);
    assert_true(isnan(error_of(3, 3))); /* most have a loss, and few state its effect */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_loss)};
    return cmocka_run_group_tests_name("curves with loss", tests, NULL, NULL);
}
