/* Transverse isotropy: the trends of the source (figures 3.3 and 3.4), on the bundled case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"

#include "weartrack/case.h"

#include <string.h>

static wt_result *result;

static int run_case(void **state)
{
    (void)state;
    wt_case *c = NULL;
    wt_run_options options = wt_run_defaults();
    wt_error err = WT_ERROR_INIT;
    size_t n_failed = 0;
    options.replicates = 0;
    if (wt_case_read(WT_SOURCE_DIR "/fixtures/transverse/case.xml", &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, &n_failed, &err) != WT_OK)
        print_error("%s: %s %s\n", err.place, err.message, err.found);
    wt_case_free(c);
    return result == NULL || n_failed > 0 ? -1 : 0;
}

static int free_result(void **state)
{
    (void)state;
    wt_result_free(result);
    return 0;
}

static double at(const wt_table *table, const char *factors, size_t i, const char *column)
{
    for (size_t row = 0; row < wt_table_n_rows(table); row++)
        if (strcmp(text_cell(table, row, "factors"), factors) == 0 && i-- == 0)
            return number_cell(table, row, column);
    fail_msg("no such row of %s", factors);
    return 0;
}

/* More loss along the normal: more friction. More storage: less contact area, the largest
 * effect. */
static void test_trends(void **state)
{
    (void)state;
    const wt_table *table = wt_result_find(result, "transverse_isotropy");
    assert_non_null(table);
    assert_int_equal(wt_table_n_rows(table), 4 * 31);
    for (size_t i = 0; i < 31; i++) {
        const double none = at(table, "none", i, "area_ratio"),
                     loss = at(table, "loss", i, "area_ratio"),
                     storage = at(table, "storage", i, "area_ratio");
        assert_true(at(table, "loss", i, "hysteresis") > 1.1 * at(table, "none", i, "hysteresis"));
        assert_true(at(table, "storage", i, "hysteresis") < at(table, "none", i, "hysteresis"));
        assert_true(storage < 0.85 * none && storage < loss);
        assert_true(loss < 1.001 * none);
    }
}

/* Both: the friction of the case. None: that of the isotropic rubber. */
static void test_limits(void **state)
{
    (void)state;
    const wt_table *table = wt_result_find(result, "transverse_isotropy"),
                   *friction = wt_result_find(result, "friction");
    for (size_t i = 0; i < 31; i++) {
        assert_near(at(table, "both", i, "hysteresis"), number_cell(friction, i, "hysteresis"),
                    1e-9);
        assert_near(at(table, "both", i, "area_ratio"), number_cell(friction, i, "area_ratio"),
                    1e-9);
    }
    static const double velocity[] = {1e-3, 0.1, 10};
    wt_friction_tables plain = {0};
    wt_table *directed = NULL;
    sliding_set_up(velocity, 3);
    work.replicates = 0;
    assert_int_equal(wt_transverse_isotropy_compute(&sliding, &work, &directed, NULL), WT_E_ARG);
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &plain, NULL), WT_OK);
    rubber.is_transverse = true;
    rubber.transverse = wt_transverse_defaults();
    rubber.transverse.axial_loss = 1.5;
    rubber.poisson_ratio = 0.49;
    assert_int_equal(wt_transverse_isotropy_compute(&sliding, &work, &directed, NULL), WT_OK);
    wt_table_free(plain.friction);
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &plain, NULL), WT_OK);
    for (size_t i = 0; i < 3; i++)
        assert_near(at(directed, "both", i, "hysteresis"),
                    number_cell(plain.friction, i, "hysteresis"), 1e-9);
    const char *by_loss = wt_table_key(directed, "by_loss"),
               *by_both = wt_table_key(directed, "by_both");
    assert_non_null(strstr(by_loss, "hysteresis friction +"));
    assert_ptr_equal(strstr(by_loss, "E″ of Ez times 1.5, Ep times 1, shear times 1: at "),
                     by_loss);
    assert_ptr_equal(strstr(by_both, "E′ and E″ of Ez times 1 and 1.5, Ep times 1,"), by_both);
    wt_table_free(plain.friction);
    wt_table_free(directed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_trends),
                                       cmocka_unit_test(test_limits)};
    return cmocka_run_group_tests_name("transverse_isotropy", tests, run_case, free_result);
}
