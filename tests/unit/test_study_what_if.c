/* One-at-a-time sensitivity: every row equals a single run with that choice, to the last bit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"
#include "truth_fixture.h"

#include "core/table/result_value.h"
#include "weartrack/study.h"

static wt_layer_observation observation;
static wt_layer_job layer;

static void set_up(void)
{
    static const double velocity[] = {1e-3, 0.1, 10};
    sliding_set_up(velocity, 3);
    observation =
        (wt_layer_observation){.thickness = {1e-6, 0, 0, "m"}, .modulus_ratio = {0.6, 0, 0, "1"}};
    layer = wt_layer_job_defaults();
    layer.specific_wear_rate.value = 1e-12;
    layer.critical_energy.value = 2e10;
    work.replicates = 0;
}

static wt_table *what_if(bool with_layer, bool with_known)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_model_sensitivity_compute(&sliding, with_layer ? &layer : NULL,
                                     with_known ? &observation : NULL, &work, &table,
                                     &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return table;
}

/* Row of a choice; the table must have it on request. */
static size_t find_row(const wt_table *table, const char *choice, const char *tried)
{
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        if (strcmp(text_cell(table, i, "choice"), choice) == 0 &&
            (tried == NULL || strcmp(text_cell(table, i, "alternative"), tried) == 0))
            return i;
    if (tried != NULL)
        fail_msg("no row %s, %s", choice, tried);
    return SIZE_MAX;
}

static void check_cell(const wt_table *table, size_t row, const char *column, double value)
{
    char change[64];
    const double used = number_cell(table, 0, column), cell = number_cell(table, row, column);
    /* the velocity alone gives the same as with others, except for digits below the error */
    if (!(fabs(cell / value - 1) <= 1e-12))
        fail_msg("row %zu (%s %s), %s: %.17g, a single run gives %.17g", row,
                 text_cell(table, row, "choice"), text_cell(table, row, "alternative"), column,
                 cell, value);
    snprintf(change, sizeof change, "%s_change", column);
    assert_true(fabs(number_cell(table, row, change) - (value / used - 1)) <= 2e-12);
}

/* Results of single runs with the present settings. */
static void check_row(const wt_table *table, const char *choice, const char *tried)
{
    const size_t row = find_row(table, choice, tried);
    wt_layer_tables l = {0};
    wt_friction_tables f = {0};
    wt_layer_observation on_top = observation;
    assert_int_equal(wt_layer_thickness_compute(&sliding, &layer, &work, &l, NULL), WT_OK);
    on_top.thickness = l.thickness;
    assert_int_equal(wt_sliding_friction_compute(&sliding, &on_top, &work, &f, NULL), WT_OK);
    check_cell(table, row, "thickness", l.thickness.value);
    check_cell(table, row, "hysteresis", key_estimate(f.friction, "hysteresis_at_reference").value);
    check_cell(table, row, "area_ratio", key_estimate(f.friction, "area_ratio_at_reference").value);
    check_cell(table, row, "friction", key_estimate(f.friction, "friction_at_reference").value);
    check_cell(table, row, "friction_with_layer",
               key_estimate(f.friction, "friction_with_layer_at_reference").value);
    wt_table_free(l.layer);
    wt_table_free(f.friction);
    set_up();
}

static void test_single_runs(void **state)
{
    (void)state;
    set_up();
    wt_table *table = what_if(true, true);
    check_row(table, "as used", "");
    surface.q1 = 0.1 * 2e6;
    check_row(table, "largest wavenumber q1", "2e5 rad/m");
    surface.q1 = 10 * 2e6;
    check_row(table, "largest wavenumber q1", "2e7 rad/m");
    surface.q0 = 1e3;
    check_row(table, "smallest wavenumber q0", "1e3 rad/m");
    surface.q0 = 4e3;
    check_row(table, "smallest wavenumber q0", "4e3 rad/m");
    sliding.gamma = 0.5;
    check_row(table, "factor gamma of partial contact", "0.5");
    rubber.poisson_ratio = 0.4;
    check_row(table, "Poisson ratio", "0.4");
    layer.profile = WT_PROFILE_INCOMPRESSIBLE;
    check_row(table, "depth profile", "incompressible, m = 0");
    layer.profile = WT_PROFILE_INCOMPRESSIBLE;
    layer.local_friction = 1;
    check_row(table, "depth profile", "incompressible, m = 1");
    observation.bulk_shear = true;
    check_row(table, "shear stress of the layer", "that of the bulk");
    assert_int_equal(wt_table_n_rows(table), 12);
    wt_table_free(table);
}

static void heat_up(void)
{
    rubber.law = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293.15, 8.86, 101.6}};
    sliding.flash.on = true;
}

/* With flash temperature: without it, and with other thermal constants. */
static void test_heat(void **state)
{
    (void)state;
    set_up();
    assert_false(sliding.flash.on);
    wt_table *cold = what_if(true, true);
    assert_true(find_row(cold, "flash temperature", NULL) == SIZE_MAX);
    assert_true(find_row(cold, "heat conductivity of the rubber", NULL) == SIZE_MAX);
    heat_up();
    wt_table *table = what_if(true, true);
    assert_int_equal(wt_table_n_rows(table), wt_table_n_rows(cold) + 5);
    assert_string_equal(text_cell(table, find_row(table, "flash temperature", NULL), "used"),
                        "counted");
    heat_up();
    sliding.flash.on = false;
    check_row(table, "flash temperature", "not counted");
    heat_up();
    sliding.flash.diffusivity *= 2;
    check_row(table, "heat conductivity of the rubber", "0.44 W/(m K)");
    heat_up();
    sliding.flash.contact_size *= 0.5;
    check_row(table, "size of a macroscopic contact", "0.0005 m");
    wt_table_free(cold);
    wt_table_free(table);
}

/* Each choice in the reverse direction. */
static void test_reverse_direction(void **state)
{
    (void)state;
    set_up();
    sliding.gamma = 0.5;
    observation.bulk_shear = true;
    layer.profile = WT_PROFILE_INCOMPRESSIBLE;
    wt_table *table = what_if(true, true);
    sliding.gamma = 1;
    find_row(table, "factor gamma of partial contact", "1");
    find_row(table, "shear stress of the layer", "scaled by the ratio");
    find_row(table, "depth profile", "exponential");
    for (size_t i = 1; i < wt_table_n_rows(table); i++)
        assert_string_not_equal(text_cell(table, i, "used"), text_cell(table, i, "alternative"));
    wt_table_free(table);
}

/* A choice that does not apply has no row, and is named. */
static void test_choices_that_do_not_apply(void **state)
{
    (void)state;
    set_up();
    surface.qr = surface.q0;
    wt_table *table = what_if(false, false);
    assert_true(find_row(table, "depth profile", NULL) == SIZE_MAX);
    assert_true(find_row(table, "shear stress of the layer", NULL) == SIZE_MAX);
    assert_true(find_row(table, "vertical shift", NULL) == SIZE_MAX);
    assert_true(find_row(table, "smallest wavenumber q0", NULL) == SIZE_MAX);
    assert_true(isnan(number_cell(table, 0, "thickness")));
    const char *left_out = wt_table_key(table, "left_out");
    assert_non_null(left_out);
    assert_non_null(strstr(left_out, "vertical shift (no isotherms"));
    assert_non_null(strstr(left_out, "smallest wavenumber q0 (the roughness has no roll-off)"));
    wt_table_free(table);
    set_up();
    layer.critical_energy.value = (double)NAN; /* then the thickness is stated */
    layer.observed_thickness.value = 3e-6;
    table = what_if(true, false);
    assert_true(find_row(table, "depth profile", NULL) == SIZE_MAX);
    wt_table_free(table);
}

/* The densities of a measured spectrum are only known between its limits. */
static void test_limits(void **state)
{
    (void)state;
    double q[] = {1e3, 1e4, 1e6, 4e6}, c[] = {1e-16, 1e-17, 1e-24, 1e-26};
    set_up();
    surface = (wt_surface){.q0 = 1e3, .q1 = 1e6, .c0 = {1, 0, 0, "1"}};
    surface.spectrum = (wt_power_spectrum){.n = 4, .wavenumber = q, .density = c};
    wt_table *table = what_if(false, false);
    find_row(table, "largest wavenumber q1", "4e6 rad/m");
    find_row(table, "smallest wavenumber q0", "2e3 rad/m");
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_string_not_equal(text_cell(table, i, "alternative"), "1e7 rad/m");
        assert_string_not_equal(text_cell(table, i, "alternative"), "500 rad/m");
        assert_true(number_cell(table, i, "hysteresis") > 0);
    }
    wt_table_free(table);
    /* no wave of a law is shorter than 1 nm */
    set_up();
    surface.q1 = 4e9;
    table = what_if(false, false);
    find_row(table, "largest wavenumber q1", "6.28e9 rad/m");
    wt_table_free(table);
}

/* The range of a result is that of all rows. */
static void test_range(void **state)
{
    (void)state;
    set_up();
    wt_friction_tables f = {0};
    wt_result *result = wt_result_new();
    result_value_tables found;
    wt_table *table = what_if(true, true);
    double low = number_cell(table, 0, "hysteresis"), high = low;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        const double value = number_cell(table, i, "hysteresis");
        low = fmin(low, value);
        high = fmax(high, value);
    }
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &f, NULL), WT_OK);
    assert_non_null(result);
    assert_int_equal(wt_result_add(result, f.friction, NULL), WT_OK);
    assert_int_equal(wt_result_add(result, table, NULL), WT_OK);
    assert_int_equal(result_values_bind(result, &found, NULL), WT_OK);
    const result_value hysteresis = result_value_friction(&found, FRICTION_KEY_HYSTERESIS);
    assert_near(hysteresis.range.low, low, 0);
    assert_near(hysteresis.range.high, high, 0);
    assert_string_equal(hysteresis.range.widest, "largest wavenumber q1");
    const result_value shearing = result_value_friction(&found, FRICTION_KEY_SHEARING);
    const double stated = number_cell(table, 0, "friction") - number_cell(table, 0, "hysteresis");
    assert_near(shearing.number.value, stated, 1e-9);
    assert_true(shearing.range.low <= stated && shearing.range.high > 1.1 * stated);
    assert_true(isnan(result_value_thickness(&found).number.value)); /* no table of the layer */
    wt_result_free(result);
}

/* A row that cannot be computed states the reason, and the others remain: here the roughness of one
 * row overflows. */
static void test_failed_rows(void **state)
{
    (void)state;
    set_up();
    surface.c0.value = 1e287;
    wt_table *table = what_if(false, false);
    const size_t row = find_row(table, "largest wavenumber q1", "2e7 rad/m");
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_int_equal(isnan(number_cell(table, i, "area_ratio")) != 0, i == row);
        assert_int_equal(text_cell(table, i, "note")[0] != '\0', i == row);
    }
    assert_non_null(strstr(text_cell(table, row, "note"), "variance G stays finite"));
    surface.c0.value = 1e290; /* not even the reference run: an error, no table of blanks */
    wt_table *none = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &none, NULL),
                     WT_E_RANGE);
    assert_null(none);
    wt_table_free(table);
}

static void test_threads(void **state)
{
    (void)state;
    set_up();
    wt_table *one = what_if(true, true);
    work.threads = 3;
    wt_table *three = what_if(true, true);
    for (size_t c = 0; c < wt_table_n_columns(one); c++)
        if (wt_table_column_kind(one, c) == WT_COLUMN_NUMBER)
            assert_memory_equal(wt_table_numbers(one, c), wt_table_numbers(three, c),
                                wt_table_n_rows(one) * sizeof(double));
    wt_table_free(one);
    wt_table_free(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_single_runs),
        cmocka_unit_test(test_heat),
        cmocka_unit_test(test_reverse_direction),
        cmocka_unit_test(test_choices_that_do_not_apply),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_range),
        cmocka_unit_test(test_failed_rows),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests_name("what if", tests, NULL, NULL);
}
