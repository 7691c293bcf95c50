/* A stored material: its draws equal those of the isotherms bit for bit; invalid draws are refused.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "truth_fixture.h"

static double velocity[2] = {1e-3, 0.1};

static wt_table *friction_of(const wt_rubber *rubber, wt_estimate pressure)
{
    const wt_surface surface = {.self_affine = true,
                                .q0 = 2e3,
                                .qr = 4e3,
                                .q1 = 2e4,
                                .hurst = 0.8,
                                .c0 = {2e-17, 0, 0, "m^4"}};
    wt_sliding sliding = wt_sliding_defaults();
    wt_job work = wt_job_defaults();
    wt_friction_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    sliding.rubber = rubber;
    sliding.surface = &surface;
    sliding.pressure = pressure;
    sliding.temperature.value = 308.15;
    sliding.velocity = velocity;
    sliding.n_velocity = 2;
    work.threads = 1;
    work.replicates = 8;
    if (wt_sliding_friction_compute(&sliding, NULL, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return tables.friction;
}

static const wt_estimate exact_pressure = {0.8e6, 0, 0, "Pa"};

/* ---- same as in memory ----------------------------------------------------------------------- */

static wt_rubber of_isotherms(void)
{
    static const char *const files[] = {WT_SOURCE_DIR "/fixtures/case/dma.txt"};
    const wt_file_set set = {.patterns = files, .n_patterns = 1, .read = wt_read_defaults()};
    wt_master_job job = wt_master_job_defaults();
    wt_job work = wt_job_defaults();
    wt_rubber rubber = {0};
    wt_formats *formats = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.fit.reference_temperature =
        key_estimate(wt_result_find(fixture_produced(), "prony"), "reference_temperature").value;
    if (wt_master_compute(&job, &work, NULL, &rubber, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_formats_free(formats);
    return rubber;
}

static void check_same(const wt_table *a, const wt_table *b)
{
    assert_int_equal(wt_table_n_keys(a), wt_table_n_keys(b));
    for (size_t i = 0; i < wt_table_n_keys(a); i++) {
        const char *key = wt_table_key_name(a, i);
        assert_string_equal(wt_table_key(a, key), wt_table_key(b, key));
    }
    for (size_t c = 0; c < wt_table_n_columns(a); c++)
        for (size_t row = 0; row < wt_table_n_rows(a); row++) {
            const double x = wt_table_number(a, row, c), y = wt_table_number(b, row, c);
            if (memcmp(&x, &y, sizeof x) != 0 && !(isnan(x) && isnan(y)))
                fail_msg("%s: %.17g, %.17g", wt_table_column_name(a, c), x, y);
        }
}

static void test_draws_are_identical(void **state)
{
    (void)state;
    static const char path[] = "test_flow_stored.h5";
    wt_result *stored = NULL;
    wt_rubber rubber = of_isotherms(), again = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_store_write(path, fixture_produced(), false, NULL), WT_OK);
    assert_int_equal(wt_store_read(path, &stored, NULL), WT_OK);
    unlink(path);
    if (fixture_rubber(stored, &again, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.place);
    assert_int_equal(again.n_draws, 200);
    wt_table *a = friction_of(&rubber, exact_pressure), *b = friction_of(&again, exact_pressure);
    const char *includes = wt_table_key(a, "standard_error_includes");
    assert_string_equal(includes, "material with its shift law");
    assert_true(cell(a, 0, "hysteresis_standard_error") > 0);
    check_same(a, b);
    wt_table_free(a);
    wt_table_free(b);
    wt_rubber_clear(&rubber);
    wt_rubber_clear(&again);
    wt_result_free(stored);
}

/* Table of an older version: unknown values are not 0. */
static void test_without_draws(void **state)
{
    (void)state;
    static const fixture_change changes[] = {{"material_draws", .leave_out = true},
                                             {"series_draws", .leave_out = true}};
    wt_result *old = fixture_changed(fixture_produced(), changes, 2);
    wt_rubber rubber = {0};
    assert_int_equal(fixture_rubber(old, &rubber, NULL), WT_OK);
    rubber.c1_error = rubber.c2_error = 0;
    wt_table *exact = friction_of(&rubber, exact_pressure),
             *drawn = friction_of(&rubber, (wt_estimate){0.8e6, 0.1e6, 0, "Pa"});
    assert_true(isnan(cell(exact, 0, "hysteresis_standard_error")));
    assert_true(isnan(key_estimate(exact, "area_ratio_at_reference").standard_error));
    assert_true(cell(drawn, 0, "area_ratio_standard_error") > 0);
    assert_non_null(strstr(wt_table_key(exact, "standard_error_excludes"), "material"));
    assert_non_null(strstr(wt_table_key(drawn, "standard_error_excludes"), "material"));
    wt_table_free(exact);
    wt_table_free(drawn);
    wt_rubber_clear(&rubber);
    wt_result_free(old);
}

/* ---- foreign files --------------------------------------------------------------------------- */

static bool not_the_last(const wt_table *table, size_t row)
{
    return row + 1 < wt_table_n_rows(table);
}

static void no_draw(wt_table *copy, size_t row)
{
    if (row == 3)
        fixture_put(copy, "draw", 7);
}

static void no_number(wt_table *copy, size_t row)
{
    if (row == 3)
        fixture_put(copy, "draw", (double)NAN);
}

static void far_too_many(wt_table *copy, size_t row)
{
    (void)row;
    fixture_put(copy, "draw", 1e300);
}

static void no_modulus(wt_table *copy, size_t row)
{
    if (row == 3)
        fixture_put(copy, "modulus", (double)NAN);
}

static void endless_modulus(wt_table *copy, size_t row)
{
    if (row == 3)
        fixture_put(copy, "modulus", (double)INFINITY);
}

static void no_time(wt_table *copy, size_t row)
{
    if (row == 3)
        fixture_put(copy, "relaxation_time", 0);
}

static void negative_equilibrium(wt_table *copy, size_t row)
{
    if (row == 0)
        fixture_put(copy, "equilibrium_modulus", -1);
}

static void no_law_reason(wt_table *copy, size_t row)
{
    if (row == 0)
        fixture_put(copy, "wlf_c2", (double)NAN);
}

static void no_vertical(wt_table *copy, size_t row)
{
    if (row == 1)
        fixture_put(copy, "log_b_material", (double)NAN);
}

static void other_temperature(wt_table *copy, size_t row)
{
    if (row == 1)
        fixture_put(copy, "temperature", 300);
}

static void other_reference(wt_table *copy)
{
    fixture_check(
        wt_table_set_estimate(copy, "reference_temperature", (wt_estimate){250, 0, 0, "K"}, NULL));
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        fixture_change change;
        wt_status expected;
        const char *place;
    } bad[] = {
        {{"series_draws", .leave_out = true}, WT_E_MISSING, ""},
        {{"material_draws", .leave_out = true}, WT_E_MISSING, ""},
        {{"series_draws", .without = "modulus"}, WT_E_MISSING, ""},
        {{"series_draws", .keep = not_the_last}, WT_E_RANGE, "series_draws"},
        {{"material_draws", .keep = not_the_last}, WT_E_RANGE, "material_draws"},
        {{"series_draws", .edit = no_draw}, WT_E_RANGE, "row 4 of series_draws"},
        {{"material_draws", .edit = no_draw}, WT_E_RANGE, "row 4 of material_draws"},
        {{"material_draws", .edit = no_number}, WT_E_RANGE, "row 4 of material_draws"},
        {{"material_draws", .edit = far_too_many}, WT_E_RANGE, "material_draws"},
        {{"series_draws", .edit = no_modulus}, WT_E_RANGE, "row 4 of series_draws"},
        {{"series_draws", .edit = endless_modulus}, WT_E_RANGE, "row 4 of series_draws"},
        {{"series_draws", .edit = no_time}, WT_E_RANGE, "row 4 of series_draws"},
        {{"material_draws", .edit = negative_equilibrium}, WT_E_RANGE, "row 1 of material_draws"},
        {{"material_draws", .edit = no_law_reason}, WT_E_RANGE, "row 1 of material_draws"},
        {{"material_draws", .edit = no_vertical}, WT_E_RANGE, "row 2 of material_draws"},
        {{"material_draws", .edit = other_temperature}, WT_E_RANGE, "row 2 of material_draws"},
        {{"material_draws", .finish = other_reference}, WT_E_RANGE, "material_draws"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        wt_result *result = fixture_with(&bad[i].change);
        wt_rubber rubber = {0};
        wt_error err = WT_ERROR_INIT;
        const wt_status status = fixture_rubber(result, &rubber, &err);
        if (status != bad[i].expected || strstr(err.place, bad[i].place) == NULL)
            fail_msg("%zu: status %d, %s: %s", i, (int)status, err.message, err.place);
        wt_result_free(result);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_draws_are_identical),
        cmocka_unit_test(test_without_draws),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests_name("stored material", tests, NULL, NULL);
}
