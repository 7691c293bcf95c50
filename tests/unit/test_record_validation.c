/* Measured against predicted friction: the records follow from the prediction, so that the expected
 * results are known.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "table_cells.h"
#include "truth_fixture.h"

#include "core/table/registry.h"
#include "weartrack/record.h"
#include "weartrack/study.h"

#include <math.h>
#include <string.h>

enum { STEPS = 13 };
static double velocity[STEPS];
static wt_layer_observation observation;
static wt_table *record;
static size_t at_rest = SIZE_MAX; /* row of the record */
static bool by_rotation;          /* which alone states it */
static double warm; /* temperature of every second row, the others have none; 0: of no row */

static void set_up(void)
{
    for (int i = 0; i < STEPS; i++)
        velocity[i] = pow(10, -3 + 0.25 * i);
    sliding_set_up(velocity, STEPS);
    sliding.shear_stress.standard_error = 0.2e6;
    surface.c0.standard_error = 0.5e-18;
    observation = (wt_layer_observation){.thickness = {1e-6, 1e-7, 0, "m"},
                                         .modulus_ratio = {0.6, 0.03, 0, "1"}};
    work.replicates = 60;
}

/* A row of a record with empty other columns. */
static void put_row(table_writer *t, const double (*values)[2], size_t n)
{
    table_row(t);
    for (unsigned c = 0; c < RECORD_N_COLUMNS; c++) {
        double value = (double)NAN;
        for (size_t i = 0; i < n; i++)
            if ((unsigned)values[i][0] == c)
                value = values[i][1];
        if (record_schema.columns[c].kind == SCHEMA_TEXT)
            record_put_text(t, (record_column)c, "made");
        else
            record_put(t, (record_column)c, value);
    }
}

/* Predicted friction with a shear stress (below 0: four fifths of the hysteresis part only) and its
 * own largest wavenumber, times a power of the velocity, as a record with an error of `error`. */
static void make_record(double shear, double q1, double power, double error, bool layered)
{
    const wt_estimate kept = sliding.shear_stress;
    const double used = surface.q1;
    wt_friction_tables f = {0};
    const size_t draws = work.replicates;
    sliding.shear_stress = (wt_estimate){fmax(shear, 0), 0, 0, "Pa"};
    surface.q1 = q1;
    work.replicates = 0;
    assert_int_equal(wt_sliding_friction_compute(&sliding, &observation, &work, &f, NULL), WT_OK);
    sliding.shear_stress = kept;
    surface.q1 = used;
    work.replicates = draws;
    table_writer t = table_begin(&record_schema, NULL);
    record_set_text(&t, RECORD_KEY_N_FILES, "1");
    for (size_t i = 0; i < STEPS; i++) {
        const double mu = number_cell(f.friction, i, layered ? "friction_with_layer" : "friction") *
                          pow(velocity[i], power) * (shear < 0 ? 0.8 : 1);
        const double nan = (double)NAN;
        const bool rests = i == at_rest;
        const double row[][2] = {{RECORD_VELOCITY, !rests        ? velocity[i]
                                                   : by_rotation ? nan
                                                                 : 0},
                                 {RECORD_ROTATION, rests && by_rotation ? 0 : nan},
                                 {RECORD_TEMPERATURE, warm > 0 && i % 2 == 1 ? warm : nan},
                                 {RECORD_FRICTION, mu},
                                 {RECORD_FRICTION_STANDARD_ERROR, error * mu},
                                 {RECORD_FRICTION_LOW, mu * (1 - 2 * error)},
                                 {RECORD_FRICTION_HIGH, mu * (1 + 2 * error)}};
        put_row(&t, row, sizeof row / sizeof *row);
    }
    wt_table_free(f.friction);
    wt_table_free(record);
    record = NULL;
    assert_int_equal(table_end(&t, &record), WT_OK);
}

static wt_validation_job job_of(bool layered)
{
    wt_validation_job job = wt_validation_job_defaults();
    job.sliding = &sliding;
    job.layer_observation = layered ? &observation : NULL;
    job.record = record;
    return job;
}

static wt_validation_tables made(const wt_validation_job *job)
{
    wt_validation_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_validation_compute(job, &work, &t, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return t;
}

static void check_begins(const wt_table *table, const char *key, const char *words)
{
    const char *const text = wt_table_key(table, key);
    if (text == NULL || strncmp(text, words, strlen(words)) != 0)
        fail_msg("%s: \"%s\", expected \"%s...\"", key, text != NULL ? text : "(none)", words);
}

static double key_of(const wt_table *table, const char *key)
{
    return key_estimate(table, key).value;
}

/* Both limits are adjacent, as the page names the second "to", and have no unknown errors, because
 * they have no errors. */
static void check_ends(const wt_table *table, const char *range)
{
    char low[64], high[64];
    size_t i = 0;
    wt_estimate end;
    snprintf(low, sizeof low, "%s_low", range);
    snprintf(high, sizeof high, "%s_high", range);
    while (i < wt_table_n_keys(table) && strcmp(wt_table_key_name(table, i), low) != 0)
        i++;
    assert_true(i + 1 < wt_table_n_keys(table));
    assert_string_equal(wt_table_key_name(table, i + 1), high);
    assert_true(wt_table_estimate(table, low, &end) && end.standard_error == 0);
    assert_true(wt_table_estimate(table, high, &end) && end.numerical_error == 0);
}

/* The true shear stress is required, with and without the layer. */
static void test_required_shear(void **state)
{
    (void)state;
    for (int layered = 0; layered < 2; layered++) {
        set_up();
        make_record(8e6, surface.q1, 0, 0.003, layered != 0);
        const wt_validation_job job = job_of(layered != 0);
        wt_validation_tables t = made(&job);
        assert_true(fabs(key_of(t.validation, "shear_stress_needed") / 8e6 - 1) < 1e-6);
        assert_true(key_of(t.validation, "shear_stress_needed_low") < 8e6);
        assert_true(key_of(t.validation, "shear_stress_needed_high") > 8e6);
        check_begins(t.validation, "shear_stress_plausible", "yes");
        check_begins(t.validation, "verdict_with_needed", "yes");
        check_begins(t.validation, "verdict", "no");
        check_begins(t.validation, "outcome", "yes, with another shear stress of 8 MPa (95 %: ");
        assert_non_null(
            strstr(wt_table_key(t.validation, "outcome"), ", which is plausible; margin"));
        check_begins(t.validation, "judged", layered ? "friction with" : "friction without");
        assert_int_equal(wt_table_n_rows(t.validation), STEPS);
        for (size_t i = 0; i < STEPS; i++) {
            const double needed = number_cell(t.validation, i, "shear_stress_needed"),
                         low = number_cell(t.validation, i, "shear_stress_needed_low"),
                         high = number_cell(t.validation, i, "shear_stress_needed_high");
            assert_true(fabs(needed / 8e6 - 1) < 1e-6);
            /* in the logarithm, as that of all steps */
            assert_true(low < needed && fabs(low * high / (needed * needed) - 1) < 1e-9);
        }
        wt_tables_clear(&t, sizeof t);
    }
}

/* An infinite layer has no friction, and the message states that another one is tested. */
static void test_endless_layer(void **state)
{
    (void)state;
    set_up();
    make_record(5e6, surface.q1, 0, 0.003, false);
    observation.thickness = (wt_estimate){(double)INFINITY, 0, 0, "m"};
    const wt_validation_job job = job_of(true);
    wt_validation_tables t = made(&job);
    check_begins(t.validation, "judged", "friction without");
    assert_non_null(strstr(wt_table_key(t.validation, "remarks"), "grows without end"));
    wt_tables_clear(&t, sizeof t);
}

/* The shear stress of bulk and layer is the same in the prediction as in friction. */
static void test_layer_shear(void **state)
{
    (void)state;
    for (int layered = 0; layered < 2; layered++) {
        set_up();
        observation.bulk_shear = true;
        make_record(5e6, surface.q1, 0, 0.003, layered != 0);
        const wt_validation_job job = job_of(true);
        wt_validation_tables t = made(&job);
        for (size_t i = 0; i < STEPS; i++)
            assert_true(fabs(number_cell(t.validation, i, layered ? "ratio_with_layer" : "ratio") -
                             1) < 1e-9);
        if (layered)
            assert_true(fabs(key_of(t.validation, "shear_stress_needed") / 5e6 - 1) < 1e-6);
        wt_tables_clear(&t, sizeof t);
    }
}

static void take_slope(double slope, double error)
{
    observation.ratio_slope = (wt_estimate){slope, error, 0, "1"};
    observation.ratio_frequency = 1e3;
    observation.ratio_lowest = 10;
    observation.ratio_highest = 1e6;
    observation.ratio_temperature = (double)NAN;
}

/* A layer with a frequency-dependent modulus is the same as in friction, its slope is a separate
 * error source, and the result describes it. */
static void test_slope(void **state)
{
    (void)state;
    static const char source[] = "slope of the modulus ratio";
    set_up();
    take_slope(0.1, 0.03);
    make_record(5e6, surface.q1, 0, 0.003, true);
    const wt_validation_job job = job_of(true);
    wt_validation_tables t = made(&job);
    for (size_t i = 0; i < STEPS; i++)
        assert_near(number_cell(t.validation, i, "ratio_with_layer"), 1, 1e-9);
    assert_near(key_of(t.validation, "layer_ratio_slope"), 0.1, 1e-12);
    assert_near(key_of(t.validation, "layer_modulus_ratio"), 0.6, 1e-12);
    assert_near(key_of(t.validation, "layer_thickness"), 1e-6, 1e-12);
    check_begins(t.validation, "layer_moduli", "0.6 times those of the bulk at 1e+03 rad/s");
    assert_null(strstr(wt_table_key(t.validation, "layer_moduli"), "taken as 0"));
    const size_t row = row_where(t.sources, "source", source);
    assert_true(number_cell(t.sources, row, "error") > 0.001);
    for (size_t i = 0; i < wt_table_n_rows(t.sources); i++)
        assert_string_not_equal(text_cell(t.sources, i, "source"), "observed thickness");
    wt_tables_clear(&t, sizeof t);
}

/* With few replicates no row states an unknown value. */
static void test_few_replicates(void **state)
{
    (void)state;
    set_up();
    work.replicates = 8;
    make_record(5e6, surface.q1, 0, 0.003, true);
    const wt_validation_job job = job_of(true);
    wt_validation_tables t = made(&job);
    const size_t row = row_where(t.sources, "source", "material and all else that is drawn");
    assert_true(number_cell(t.sources, row, "share") > 0.5);
    for (size_t i = 0; i < wt_table_n_rows(t.sources); i++)
        assert_true(number_cell(t.sources, i, "error") > 0);
    check_begins(t.sources, "advice", "more replicates");
    wt_tables_clear(&t, sizeof t);
}

/* A constant ratio needs no message. A slope that requires a negative loss modulus is reported
 * once. */
static void test_layer_report(void **state)
{
    (void)state;
    set_up();
    work.replicates = 0;
    work.tolerance = 1e-4;
    make_record(5e6, surface.q1, 0, 0.003, true);
    wt_validation_job job = job_of(true);
    wt_validation_tables plain = made(&job);
    assert_null(wt_table_key(plain.validation, "layer_moduli"));
    assert_near(key_of(plain.validation, "layer_modulus_ratio"), 0.6, 1e-12);
    take_slope(-0.3, 0);
    make_record(5e6, surface.q1, 0, 0.003, true);
    job = job_of(true);
    wt_log *const log = work.log = wt_log_new();
    assert_non_null(log);
    wt_validation_tables steep = made(&job);
    work.log = NULL;
    assert_non_null(strstr(wt_table_key(steep.validation, "layer_moduli"),
                           "its loss modulus would be below 0 by such a slope, and is taken as 0"));
    size_t n = 0;
    for (size_t i = 0; i < wt_log_count(log); i++)
        n += strstr(wt_log_get(log, i).text, "is taken as 0") != NULL;
    assert_int_equal(n, 1);
    wt_log_free(log);
    wt_tables_clear(&plain, sizeof plain);
    wt_tables_clear(&steep, sizeof steep);
}

/* A record of another wavenumber: the limits of its numbers, and one line of a figure. */
static void test_limits(void **state)
{
    (void)state;
    set_up();
    make_record(5e6, 0.8 * surface.q1, 0, 0.003, false);
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    assert_int_equal(wt_table_block(t.validation, STEPS - 1), 0);
    check_ends(t.validation, "ratio");
    check_ends(t.validation, "shear_stress_needed");
    wt_tables_clear(&t, sizeof t);
}

static void test_verdicts(void **state)
{
    (void)state;
    static const struct {
        double shear, power, error;
        const char *verdict, *shape;
    } cases[] = {{5e6, 0, 0.003, "yes", "yes"},
                 {5e6, 0.2, 0.003, "no", "no"}, /* no number bends a curve */
                 {5e6, 0, 0.3, "inconclusive", "inconclusive"}};
    for (size_t i = 0; i < 3; i++) {
        set_up();
        make_record(cases[i].shear, surface.q1, cases[i].power, cases[i].error, false);
        const wt_validation_job job = job_of(false);
        wt_validation_tables t = made(&job);
        check_begins(t.validation, "verdict", cases[i].verdict);
        check_begins(t.validation, "outcome", cases[i].verdict);
        const double power = key_of(t.validation, "verdict_power");
        assert_true(i == 2 ? power < 0.8 : power > 0.99);
        check_begins(t.validation, "verdict_with_needed", cases[i].shape);
        assert_int_equal(wt_table_key(t.validation, "settled_by") != NULL, i == 2);
        wt_tables_clear(&t, sizeof t);
    }
}

/* The parts of the variance add up, and that of the shear stress is its stated error times its
 * share of friction. */
static void test_sources(void **state)
{
    (void)state;
    set_up();
    make_record(5e6, surface.q1, 0, 0.003, false);
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    double sum = 0, shear = 0;
    for (size_t i = 0; i < wt_table_n_rows(t.sources); i++) {
        sum += number_cell(t.sources, i, "share");
        if (strcmp(text_cell(t.sources, i, "source"), "shear stress") == 0)
            shear = number_cell(t.sources, i, "error");
    }
    assert_true(fabs(sum - 1) < 1e-9);
    assert_true(shear > 0.5 * 0.04 && shear < 0.04); /* more than half is shearing */
    wt_tables_clear(&t, sizeof t);
}

/* Without a shear stress there is no verdict, but the required shear stress is stated. */
static void test_no_shear(void **state)
{
    (void)state;
    set_up();
    make_record(4e6, surface.q1, 0, 0.003, false);
    sliding.shear_stress = (wt_estimate){(double)NAN, 0, 0, "Pa"};
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    check_begins(t.validation, "verdict", "inconclusive: no shear stress");
    assert_true(fabs(key_of(t.validation, "shear_stress_needed") / 4e6 - 1) < 1e-6);
    assert_true(isnan(number_cell(t.validation, 0, "ratio")));
    wt_tables_clear(&t, sizeof t);
}

/* Less than the hysteresis part alone. */
static void test_below_hysteresis(void **state)
{
    (void)state;
    set_up();
    make_record(-1, surface.q1, 0, 0.001, false);
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    assert_true(key_of(t.validation, "shear_stress_needed") < 0);
    check_begins(t.validation, "verdict", "no");
    check_begins(t.validation, "verdict_with_needed", "no");
    check_begins(t.validation, "shear_stress_plausible",
                 "no: the hysteresis part alone is more than was measured");
    wt_tables_clear(&t, sizeof t);
}

/* The same for any number of threads and any order of the rows. */
static void test_threads(void **state)
{
    (void)state;
    set_up();
    make_record(6e6, surface.q1, 0, 0.003, true);
    const wt_validation_job job = job_of(true);
    wt_validation_tables one = made(&job);
    work.threads = 3;
    wt_validation_tables three = made(&job);
    assert_string_equal(wt_table_key(one.validation, "verdict"),
                        wt_table_key(three.validation, "verdict"));
    for (size_t i = 0; i < STEPS; i++)
        assert_true(!(number_cell(one.validation, i, "ratio_low") <
                      number_cell(three.validation, i, "ratio_low")) &&
                    !(number_cell(one.validation, i, "ratio_low") >
                      number_cell(three.validation, i, "ratio_low")));
    wt_tables_clear(&one, sizeof one);
    wt_tables_clear(&three, sizeof three);
}

/* A step at rest is reported and not compared. */
static void test_rest(void **state)
{
    (void)state;
    set_up();
    for (int rotation = 0; rotation < 2; rotation++) {
        at_rest = 2;
        by_rotation = rotation == 1;
        make_record(8e6, surface.q1, 0, 0.003, false);
        at_rest = SIZE_MAX;
        const wt_validation_job job = job_of(false);
        wt_validation_tables t = made(&job);
        assert_int_equal(wt_table_n_rows(t.validation), STEPS);
        assert_string_equal(wt_table_key(t.validation, "n_left_out"), "1");
        assert_string_equal(text_cell(t.validation, STEPS - 1, "note"), "nothing slides in it");
        assert_true(fabs(key_of(t.validation, "shear_stress_needed") / 8e6 - 1) < 1e-6);
        wt_tables_clear(&t, sizeof t);
    }
}

/* Steps with an unknown temperature are not steps at another one: each is predicted at its own. */
static void test_temperatures(void **state)
{
    (void)state;
    set_up();
    rubber.law = (wt_shift_law){.kind = WT_LAW_WLF, .wlf = {293.15, 6.5, 110}};
    rubber.temperature_min = rubber.temperature_max = (double)NAN;
    warm = 333.15;
    make_record(5e6, surface.q1, 0, 0.003, false);
    warm = 0;
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    wt_friction_tables cold = {0}, hot = {0};
    work.replicates = 0;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &cold, NULL), WT_OK);
    sliding.temperature.value = 333.15;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &hot, NULL), WT_OK);
    size_t n_hot = 0;
    for (size_t row = 0; row < STEPS; row++) {
        const bool is_hot = number_cell(t.validation, row, "temperature") == 333.15;
        size_t i = 0;
        while (fabs(velocity[i] / number_cell(t.validation, row, "velocity") - 1) > 1e-9)
            i++;
        assert_int_equal(is_hot, i % 2);
        n_hot += is_hot;
        const double expected = number_cell(is_hot ? hot.friction : cold.friction, i, "friction");
        assert_true(fabs(number_cell(t.validation, row, "friction_predicted") / expected - 1) <
                    1e-9);
    }
    assert_int_equal(n_hot, STEPS / 2);
    wt_table_free(cold.friction);
    wt_table_free(hot.friction);
    wt_tables_clear(&t, sizeof t);
}

/* Without replicates the errors of the prediction are missing, which is reported. */
static void test_no_replicates(void **state)
{
    (void)state;
    set_up();
    make_record(5e6, surface.q1, 0, 0.003, false);
    work.replicates = 0;
    const wt_validation_job job = job_of(false);
    wt_validation_tables t = made(&job);
    assert_non_null(strstr(wt_table_key(t.validation, "test"), "without replicates"));
    assert_non_null(strstr(wt_table_key(t.validation, "remarks"), "because they need replicates"));
    wt_tables_clear(&t, sizeof t);
}

static void test_refusals(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_validation_tables t = {0};
    set_up();
    make_record(5e6, surface.q1, 0, (double)NAN, false);
    wt_validation_job job = job_of(false);
    assert_int_equal(wt_validation_compute(&job, &work, &t, &err), WT_E_EMPTY);
    make_record(5e6, surface.q1, 0, 0.003, false);
    job = job_of(false);
    job.margin = 7;
    assert_int_equal(wt_validation_compute(&job, &work, &t, &err), WT_E_RANGE);
    job = job_of(false);
    job.record = NULL;
    assert_int_equal(wt_validation_compute(&job, &work, &t, &err), WT_E_ARG);
    assert_null(t.validation);
}

static int tear_down(void **state)
{
    (void)state;
    wt_table_free(record);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_required_shear),
        cmocka_unit_test(test_endless_layer),
        cmocka_unit_test(test_layer_shear),
        cmocka_unit_test(test_slope),
        cmocka_unit_test(test_layer_report),
        cmocka_unit_test(test_few_replicates),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_sources),
        cmocka_unit_test(test_no_shear),
        cmocka_unit_test(test_below_hysteresis),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_temperatures),
        cmocka_unit_test(test_no_replicates),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, tear_down);
}
