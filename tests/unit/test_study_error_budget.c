/* The error budget of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"
#include "truth_fixture.h"
#include "weartrack/study.h"

static double relative(const wt_table *table, const char *number, const char *source)
{
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        if (strcmp(text_cell(table, i, "number"), number) == 0 &&
            strcmp(text_cell(table, i, "source"), source) == 0)
            return number_cell(table, i, "relative_error");
    fail_msg("no row %s, %s", number, source);
    return 0;
}

/* Standard error of a run with only this source. */
static double alone(const wt_sliding *of)
{
    wt_friction_tables tables = {0};
    assert_int_equal(wt_sliding_friction_compute(of, NULL, &work, &tables, NULL), WT_OK);
    const wt_estimate e = key_estimate(tables.friction, "friction_at_reference");
    wt_table_free(tables.friction);
    return e.standard_error / e.value;
}

/* "The choice of the X moves it by -76 % to +345 %": as in the table of choices. */
static void check_reach(const char *advice, const wt_table *what_if, const char *change)
{
    static const char of[] = "The choice of the ", by[] = " moves it by ", to[] = " % to ";
    const char *choice = strstr(advice, of), *number = strstr(advice, by);
    assert_true(choice != NULL && number != NULL);
    choice += strlen(of);
    double low = 0, high = 0;
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++) {
        const char *name = text_cell(what_if, i, "choice");
        if (strlen(name) != (size_t)(number - choice) ||
            strncmp(name, choice, (size_t)(number - choice)) != 0)
            continue;
        low = fmin(low, number_cell(what_if, i, change));
        high = fmax(high, number_cell(what_if, i, change));
    }
    assert_true(high > low);
    char *end;
    assert_near_abs(strtod(number + strlen(by), &end), 100 * low, 0.51);
    assert_int_equal(strncmp(end, to, strlen(to)), 0);
    assert_near_abs(strtod(end + strlen(to), NULL), 100 * high, 0.51);
}

/* The effect of a stated error is a line through the draws. Another seed moves it by 2 % (rms)
 * because of curvature; the scatter of the draws alone would move it by 5 %, and eight of them by
 * 14 % from the smallest to the largest. */
static void test_seeds(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    double low = (double)INFINITY, high = 0;
    const uint64_t before = work.seed;
    sliding.pressure.standard_error = 0;
    for (work.seed = 1; work.seed <= 8; work.seed++) {
        const double one = alone(&sliding);
        low = fmin(low, one);
        high = fmax(high, one);
    }
    work.seed = before;
    assert_true(low > 0);
    assert_near_abs(high / low, 1, 0.08);
}

static void test_one_source_at_a_time(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient";
    sliding_set_up_uncertain();
    wt_table *what_if = NULL, *table = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &table, NULL),
                     WT_OK);
    wt_sliding pressure = sliding, shear = sliding;
    pressure.shear_stress.standard_error = 0;
    shear.pressure.standard_error = 0;
    assert_near(relative(table, number, "pressure"), alone(&pressure), 1e-12);
    assert_near(relative(table, number, "shear stress"), alone(&shear), 1e-12);
    assert_near(relative(table, number, "all together"), alone(&sliding), 1e-12);
    /* mu_adhesion is 5e6 A/A0 / p, and its share of mu has the 10 % of the shear stress */
    assert_true(relative(table, number, "shear stress") < 0.12);
    assert_near(relative(table, number, "number of replicates"),
                alone(&sliding) / sqrt(2 * ((double)work.replicates - 1)), 1e-12);
    /* half the range of the what-if table */
    double low = number_cell(what_if, 0, "friction"), used = low, high = low;
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++)
        if (strcmp(text_cell(what_if, i, "choice"), "largest wavenumber q1") == 0) {
            low = fmin(low, number_cell(what_if, i, "friction"));
            high = fmax(high, number_cell(what_if, i, "friction"));
        }
    assert_near(relative(table, number, "largest wavenumber q1"), (high - low) / 2 / used, 1e-12);
    /* shares are those of the variance; without timing two tables are the same */
    double sum = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_true(isnan(number_cell(table, i, "seconds")));
        if (strcmp(text_cell(table, i, "number"), number) == 0 &&
            strcmp(text_cell(table, i, "kind"), "measured") == 0)
            sum += number_cell(table, i, "share");
    }
    assert_near(sum, 1, 1e-12);
    assert_string_equal(wt_table_key(table, "excluded_errors"), "material, temperature, roughness");
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "shear stress"));
    check_reach(wt_table_key(table, "hysteresis_advice"), what_if, "hysteresis_change");
    wt_table_free(what_if);
    wt_table_free(table);
}

/* Scatter and law of a measured surface are one source, and in no other. The effect of one per cent
 * of each is written on request. */
static void test_measured_surface(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient";
    double q[] = {1e3, 4e3, 1e6, 4e6}, c[] = {1e-16, 5e-17, 1e-24, 1e-26},
           modes[] = {0.5, 0.3, 0.1, 0}, law[] = {0, 0, 0, 0.3};
    wt_table *table = NULL;
    sliding_set_up_uncertain();
    surface = (wt_surface){.q0 = 1e3, .q1 = 4e6, .c0 = {1, 0, 0, "1"}};
    surface.spectrum = (wt_power_spectrum){.n = 4, .wavenumber = q, .density = c};
    surface.modes_error = modes;
    surface.law_error = law;
    sliding.shear_stress.standard_error = 0;
    wt_surface without = surface;
    without.modes_error = without.law_error = NULL;
    wt_sliding pressure = sliding, roughness = sliding;
    pressure.surface = &without;
    roughness.pressure.standard_error = 0;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, NULL, &work, &table, NULL),
                     WT_OK);
    assert_near(relative(table, number, "pressure"), alone(&pressure), 1e-12);
    assert_near(relative(table, number, "roughness"), alone(&roughness), 1e-12);
    assert_null(strstr(wt_table_key(table, "excluded_errors"), "roughness"));
    wt_table_free(table);
}

/* With times every row of the budget has its own, also those of model choices, and everything else
 * is the same. */
static void test_times(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *what_if = NULL, *plain = NULL, *timed = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &plain, NULL),
                     WT_OK);
    wt_table_free(what_if);
    work.cost = wt_cost_new(true, 1);
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &timed, NULL),
                     WT_OK);
    assert_int_equal(wt_table_n_rows(timed), wt_table_n_rows(plain));
    size_t model = 0;
    for (size_t i = 0; i < wt_table_n_rows(timed); i++) {
        model += strcmp(text_cell(timed, i, "kind"), "model") == 0;
        assert_true(number_cell(timed, i, "seconds") > 0);
        assert_true(isnan(number_cell(plain, i, "seconds")));
        assert_near(number_cell(timed, i, "relative_error"),
                    number_cell(plain, i, "relative_error"), 0);
    }
    assert_true(model > 0);
    wt_cost_free(work.cost);
    wt_table_free(what_if);
    wt_table_free(plain);
    wt_table_free(timed);
}

/* A source without an effect on a number has no row for it. */
static void test_nothing_stated(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    sliding.pressure.standard_error = sliding.shear_stress.standard_error = 0;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, NULL, &work, &table, NULL),
                     WT_OK);
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        assert_string_equal(text_cell(table, i, "kind"), "numerical");
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "No error"));
    wt_table_free(table);
    /* the model choices are stated nevertheless */
    wt_table *what_if = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &table, NULL),
                     WT_OK);
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "no error is known beside it"));
    wt_table_free(what_if);
    wt_table_free(table);
}

/* A ratio without an error is not a source. */
static void test_exact_ratio(void **state)
{
    (void)state;
    const wt_layer_observation observation = {.thickness = {5e-6, 0, 0, "m"},
                                              .modulus_ratio = {0.6, 0, 0, "1"}};
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    assert_int_equal(
        wt_error_budget_compute(&sliding, NULL, &observation, NULL, &work, &table, NULL), WT_OK);
    assert_true(relative(table, "friction coefficient with layer", "pressure") > 0);
    assert_non_null(strstr(wt_table_key(table, "excluded_errors"), "modulus ratio"));
    assert_null(strstr(wt_table_key(table, "excluded_errors"), "calibration"));
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_string_not_equal(text_cell(table, i, "source"), "modulus ratio");
        assert_string_not_equal(text_cell(table, i, "source"), "stated error");
        assert_string_not_equal(text_cell(table, i, "source"), "calibration");
    }
    wt_table_free(table);
}

/* The scatter of the positions and the calibration errors are parts of one variance. */
static void test_calibration(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient with layer";
    const wt_layer_observation observation = {.thickness = {5e-6, 0, 0, "m"},
                                              .modulus_ratio = {0.6, 0.06, 0, "1"},
                                              .calibration_share = 0.36};
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    assert_int_equal(
        wt_error_budget_compute(&sliding, NULL, &observation, NULL, &work, &table, NULL), WT_OK);
    const double spots = relative(table, number, "modulus ratio"),
                 calibration = relative(table, number, "calibration");
    assert_near(calibration / spots, 0.6 / 0.8, 0.02);
    /* the parts of the ratio itself are known: 0.1 in total; its numerical part without curves is
     * not */
    assert_near(relative(table, "modulus ratio", "stated error"), 0.08, 1e-12);
    assert_near(relative(table, "modulus ratio", "calibration"), 0.06, 1e-12);
    assert_near(relative(table, "modulus ratio", "all together"), 0.1, 1e-12);
    assert_non_null(strstr(wt_table_key(table, "modulus_ratio_advice"), "64 %"));
    assert_null(strstr(wt_table_key(table, "modulus_ratio_advice"), "arithmetic"));
    assert_null(strstr(wt_table_key(table, "excluded_errors"), "calibration"));
    wt_table_free(table);
}

static wt_layer_observation with_slope(double slope, double error)
{
    return (wt_layer_observation){.thickness = {5e-6, 0, 0, "m"},
                                  .modulus_ratio = {0.6, 0, 0, "1"},
                                  .ratio_slope = {slope, error, 0, "1"},
                                  .ratio_frequency = 1e3,
                                  .ratio_lowest = 10,
                                  .ratio_highest = 1e5,
                                  .ratio_temperature = (double)NAN};
}

/* A slope is a separate source, and no other row includes its error. */
static void test_slope(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient with layer",
                      slope[] = "slope of the modulus ratio";
    wt_layer_observation observation = with_slope(0.1, 0);
    wt_table *exact = NULL, *table = NULL;
    sliding_set_up_uncertain();
    work.replicates = 16;
    assert_int_equal(
        wt_error_budget_compute(&sliding, NULL, &observation, NULL, &work, &exact, NULL), WT_OK);
    assert_non_null(strstr(wt_table_key(exact, "excluded_errors"), slope));
    observation.ratio_slope.standard_error = 0.05;
    assert_int_equal(
        wt_error_budget_compute(&sliding, NULL, &observation, NULL, &work, &table, NULL), WT_OK);
    assert_true(relative(table, number, slope) > 0.001);
    assert_near(relative(table, number, "pressure"), relative(exact, number, "pressure"), 1e-12);
    wt_table_free(exact);
    wt_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_one_source_at_a_time),
        cmocka_unit_test(test_measured_surface),
        cmocka_unit_test(test_times),
        cmocka_unit_test(test_nothing_stated),
        cmocka_unit_test(test_exact_ratio),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
