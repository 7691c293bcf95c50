/* The stated intervals of the bundled case contain the true values.
 * SPDX-License-Identifier: GPL-3.0-or-later */

#include "case/case.h"
#include "table_cells.h"
#include "weartrack/case.h"

#include <string.h>

#define CASE WT_SOURCE_DIR "/fixtures/case"

/* Two-sided 99.7 % of a normal distribution, so that chance failures are rare. */
#define SIGMAS 3.0

static wt_result *result;
static size_t n_failed;

static int run_case(void **state)
{
    (void)state;
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_case_read(CASE "/case.xml", &c, &err) != WT_OK ||
        wt_run_case(c, NULL, NULL, &result, &n_failed, &err) != WT_OK) {
        print_error("%s: %s: %s\n", err.file, err.place, err.message);
        wt_case_free(c);
        return -1;
    }
    wt_case_free(c);
    return 0;
}

static int free_result(void **state)
{
    (void)state;
    wt_result_free(result);
    return 0;
}

static double truth(const char *name)
{
    FILE *in = fopen(CASE "/truth.txt", "r");
    char line[256], key[64];
    double value = (double)NAN, found = (double)NAN;
    assert_non_null(in);
    while (fgets(line, sizeof line, in) != NULL)
        if (sscanf(line, "%63s %lf", key, &value) == 2 && strcmp(key, name) == 0)
            found = value;
    fclose(in);
    assert_true(isfinite(found) != 0);
    return found;
}

static wt_estimate estimate(const char *table, const char *key)
{
    wt_estimate e = {0};
    const wt_table *t = wt_result_find(result, table);
    assert_non_null(t);
    if (!wt_table_estimate(t, key, &e))
        fail_msg("table %s has no estimate %s", table, key);
    return e;
}

/* The truth lies within the stated error, and the error is small enough to be useful. */
static void check(const char *table, const char *key, const char *name, double most)
{
    wt_estimate e = estimate(table, key);
    double expected = truth(name);
    if (!(fabs(e.value - expected) <= SIGMAS * e.standard_error) ||
        !(e.standard_error <= most * fabs(expected)))
        fail_msg("%s: %.6g +- %.2g, truth %.6g", name, e.value, e.standard_error, expected);
}

static void test_nothing_failed(void **state)
{
    (void)state;
    const wt_table *failures = wt_result_find(result, "failures");
    assert_non_null(failures);
    for (size_t i = 0; i < wt_table_n_rows(failures); i++)
        print_error("%s: %s\n", text_cell(failures, i, "file"), text_cell(failures, i, "message"));
    assert_int_equal(n_failed, 0);
}

static void test_ratio(void **state)
{
    (void)state;
    const wt_table *c = wt_result_find(result, "comparison");
    double expected = truth("modulus_ratio");
    assert_non_null(c);
    assert_string_equal(wt_table_key(c, "unit_of_analysis"), "spot");
    assert_true(number_cell(c, 0, "ratio_low") < expected);
    assert_true(number_cell(c, 0, "ratio_high") > expected);
    assert_true(number_cell(c, 0, "ratio_high") < 1);
    assert_true(number_cell(c, 0, "welch_p") < 0.01);
    assert_int_equal(wt_table_n_rows(c), 4); /* all rates, and three single rates */
    for (size_t i = 1; i < 4; i++) {
        assert_true(number_cell(c, i, "ratio_low") < expected);
        assert_true(number_cell(c, i, "ratio_high") > expected);
    }
}

static void test_material(void **state)
{
    (void)state;
    check("shift_factors", "wlf_c1", "wlf_c1", 0.1);
    check("shift_factors", "wlf_c2", "wlf_c2", 0.1);
    const char *superposition =
        wt_table_key(wt_result_find(result, "shift_factors"), "superposition");
    assert_int_equal(strncmp(superposition, "holds", 5), 0);
}

/* The curves have the spectrum of the DMA, and each determines its factor. */
static void test_spectrum(void **state)
{
    (void)state;
    static const char *const groups[] = {"indentation/bulk", "indentation/track"};
    for (int g = 0; g < 2; g++) {
        const wt_table *t = wt_result_find(result, groups[g]);
        assert_non_null(t);
        assert_int_equal(wt_table_n_rows(t), 48);
        for (size_t i = 0; i < 48; i++) {
            assert_string_equal(text_cell(t, i, "reason"), "accepted");
            /* scatter of 4 % between positions, 3 % between curves */
            assert_near(number_cell(t, i, "spectrum_factor"), g == 0 ? 1 : truth("modulus_ratio"),
                        0.2);
        }
    }
}

/* The indentation modulus of the bulk is that of the DMA at the same rate. */
static void test_against_dma(void **state)
{
    (void)state;
    const wt_table *dma = wt_result_find(result, "dma_comparison");
    size_t n_bulk = 0;
    assert_non_null(dma);
    for (size_t i = 0; i < wt_table_n_rows(dma); i++) {
        bool bulk = strcmp(text_cell(dma, i, "group"), "bulk") == 0;
        double modulus =
            number_cell(dma, i, "dma_complex_modulus") * (bulk ? 1 : truth("modulus_ratio"));
        assert_near(number_cell(dma, i, "indentation_modulus"), modulus, 0.03);
        assert_near(number_cell(dma, i, "extrapolated"), 0, 0);
        n_bulk += bulk ? 1 : 0;
    }
    assert_int_equal(n_bulk, 3);
}

static void test_friction(void **state)
{
    (void)state;
    check("friction", "hysteresis_at_reference", "hysteresis", 0.2);
    check("friction", "area_ratio_at_reference", "area_ratio", 0.2);
    check("friction", "friction_at_reference", "friction", 0.2);
    check("friction", "friction_with_layer_at_reference", "friction_with_layer", 0.3);
    /* the numerical error of a sum is that of its terms, and never zero */
    static const char *const keys[] = {"friction_at_reference", "friction_with_layer_at_reference",
                                       "friction_change_at_reference"};
    for (size_t i = 0; i < 3; i++) {
        double error = estimate("friction", keys[i]).numerical_error;
        assert_true(error > 0 && error < 1e-9);
    }
}

static void test_thickness(void **state)
{
    (void)state;
    check("layer", "balance_thickness", "thickness", 0.5);
    /* wear rate and critical energy, 10 % each, by their sensitivity; other errors are small */
    wt_estimate thickness = estimate("layer", "balance_thickness");
    double relative = thickness.standard_error / thickness.value;
    double sensitivity = -estimate("layer", "wear_sensitivity").value;
    assert_near(relative, sensitivity * sqrt(2) * 0.1, 0.25);
}

/* The maps reproduce the power law of the road. */
static void test_surface(void **state)
{
    (void)state;
    const wt_table *spectrum = wt_result_find(result, "power_spectrum"),
                   *scans = wt_result_find(result, "surfaces");
    size_t held = 0, n = 0;
    assert_non_null(spectrum);
    assert_int_equal(wt_table_n_rows(scans), 4);
    for (size_t i = 0; i < wt_table_n_rows(spectrum); i++) {
        if (strcmp(text_cell(spectrum, i, "source"), "measured") != 0)
            continue;
        const double q = number_cell(spectrum, i, "wavenumber") / truth("road_roll_off");
        const double c = truth("road_c0") * (q > 1 ? pow(q, -2 * (1 + truth("road_hurst"))) : 1);
        held += number_cell(spectrum, i, "density_low") < c &&
                c < number_cell(spectrum, i, "density_high");
        n++;
        assert_near_abs(log(number_cell(spectrum, i, "density") / c), 0,
                        4 * number_cell(spectrum, i, "modes_error"));
    }
    assert_true(n > 20 && (double)held > 0.85 * (double)n);
    check("power_spectrum", "hurst", "road_hurst", 0.02);
    /* the error of the surface is part of the error of friction; nothing is extrapolated */
    const char *includes =
        wt_table_key(wt_result_find(result, "friction"), "standard_error_includes");
    assert_non_null(strstr(includes, "scatter of the spectrum"));
    assert_true(number_cell(spectrum, wt_table_n_rows(spectrum) - 1, "wavenumber") >= 2e6);
}

/* Every question has a result with a number. */
static void test_answer(void **state)
{
    (void)state;
    const wt_table *answer = wt_result_find(result, "answer");
    assert_non_null(answer);
    assert_int_equal(wt_table_n_rows(answer), 3);
    for (size_t i = 0; i < wt_table_n_rows(answer); i++) {
        const double value = number_cell(answer, i, "value"), low = number_cell(answer, i, "low"),
                     high = number_cell(answer, i, "high");
        assert_true(low < value && value < high);
        assert_null(strstr(text_cell(answer, i, "answer"), "nan"));
        assert_true(text_cell(answer, i, "answer")[0] != '\0');
    }
}

/* Runs the case with one change and returns true if a result contains the words. */
static bool answer_holds(double wear, size_t spots, double track_temperature, const char *words)
{
    wt_case *c = NULL;
    wt_result *other = NULL;
    size_t failed = 0;
    bool found = false;
    assert_int_equal(wt_case_read(CASE "/case.xml", &c, NULL), WT_OK);
    c->layer.specific_wear_rate.value *= wear;
    c->bulk.n = c->track.n = spots;
    c->compare.track_temperature.value = track_temperature;
    assert_int_equal(wt_run_case(c, NULL, NULL, &other, &failed, NULL), WT_OK);
    const wt_table *answer = wt_result_find(other, "answer");
    assert_non_null(answer);
    for (size_t i = 0; i < wt_table_n_rows(answer); i++)
        found = found || strstr(text_cell(answer, i, "answer"), words) != NULL;
    const wt_table *limits = wt_result_find(other, "limits");
    for (size_t i = 0; i < wt_table_n_rows(limits); i++)
        found = found || strstr(text_cell(limits, i, "limit"), words) != NULL;
    wt_result_free(other);
    wt_case_free(c);
    return found;
}

/* A missing layer differs from a layer of zero thickness, and one position is not enough. */
static void test_answer_of_other_cases(void **state)
{
    (void)state;
    assert_true(answer_holds(100, 4, (double)NAN, "There is no layer: wear removes the rubber"));
    assert_false(answer_holds(100, 4, (double)NAN, "times the thickness of the layer"));
    assert_true(answer_holds(1, 1, (double)NAN, "each measured on one spot only"));
    assert_false(answer_holds(1, 4, (double)NAN, "measured on one spot only"));
    assert_true(answer_holds(1, 4, 306.15,
                             "The track was indented at 33.0 °C: the ratio is corrected "
                             "to the temperature of the bulk by the DMA"));
    assert_false(answer_holds(1, 4, 296.15, "ratio is corrected to the temperature"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_failed), cmocka_unit_test(test_ratio),
        cmocka_unit_test(test_material),       cmocka_unit_test(test_spectrum),
        cmocka_unit_test(test_against_dma),    cmocka_unit_test(test_friction),
        cmocka_unit_test(test_thickness),      cmocka_unit_test(test_surface),
        cmocka_unit_test(test_answer),         cmocka_unit_test(test_answer_of_other_cases),
    };
    return cmocka_run_group_tests_name("case truth", tests, run_case, free_result);
}
