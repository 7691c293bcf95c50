/* Predicted running-in beside a record: the bundled one with changes of its case and its record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "weartrack/case.h"
#include "weartrack/record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(const char *text, const char *words)
{
    if (strstr(text, words) == NULL)
        fail_msg("\"%s\" is not in \"%s\"", words, text);
}

static void check_not(const char *text, const char *words)
{
    if (strstr(text, words) != NULL)
        fail_msg("\"%s\" is in \"%s\"", words, text);
}

/* ---- the bundled case ------------------------------------------------------------------------ */

static const char case_path[] = "test_flow_running_in.xml",
                  csv_path[] = "test_record_running_in.csv";
static const double true_time = 1658; /* [s] fixtures/growth/truth.txt */
static wt_result *result;
static const wt_table *runs;

static char *text_of(const char *path)
{
    FILE *const in = fopen(path, "rb");
    assert_non_null(in);
    char *const text = calloc(1, 1 << 16);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 16) - 1, in) > 0);
    fclose(in);
    return text;
}

static void change_case(const char *from, const char *to)
{
    char *const text = text_of(WT_SOURCE_DIR "/fixtures/growth/case.xml");
    const char *const pairs[][2] = {{from, to}, {"record.csv", csv_path}};
    FILE *const out = fopen(case_path, "wb");
    assert_non_null(out);
    const char *rest = text;
    for (size_t i = 0; i < 2; i++) {
        const char *const place = strstr(rest, pairs[i][0]);
        assert_non_null(place);
        fprintf(out, "%.*s%s", (int)(place - rest), rest, pairs[i][1]);
        rest = place + strlen(pairs[i][0]);
    }
    fputs(rest, out);
    fclose(out);
    free(text);
}

/* The record after `rest` rows at rest, with `still` of its own rows at rest, without friction in
 * `blank`. */
static void change_record(size_t rest, size_t still, size_t blank)
{
    static const double each = 10.4712688; /* [s] */
    char *const text = text_of(WT_SOURCE_DIR "/fixtures/growth/record.csv");
    FILE *const out = fopen(csv_path, "wb");
    assert_non_null(out);
    char *line = strtok(text, "\n");
    fprintf(out, "%s\n", line);
    for (size_t i = 0; i < rest; i++)
        fprintf(out, "%.9g,0,0,0.001\n", each * (double)i);
    for (size_t i = 0; (line = strtok(NULL, "\n")) != NULL; i++) {
        double time, laps, velocity, friction;
        assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf", &time, &laps, &velocity, &friction), 4);
        time += each * (double)rest;
        if (i < still)
            fprintf(out, "%.9g,0,0,0.001\n", time);
        else if (i < still + blank)
            fprintf(out, "%.9g,%g,%g,\n", time, laps, velocity);
        else
            fprintf(out, "%.9g,%g,%g,%.9g\n", time, laps, velocity, friction);
    }
    fclose(out);
    free(text);
}

static void run_case(size_t draws)
{
    wt_case *read = NULL;
    wt_run_options few = wt_run_defaults();
    size_t failed = 0;
    wt_error err = WT_ERROR_INIT;
    few.replicates = draws;
    if (wt_case_read(case_path, &read, &err) != WT_OK ||
        wt_case_request_tables(read, "validation_running_in validation_course wear", &err) !=
            WT_OK ||
        wt_run_case(read, &few, NULL, &result, &failed, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_case_free(read);
    runs = wt_result_find(result, "validation_running_in");
    assert_non_null(runs);
}

static void case_end(void)
{
    wt_result_free(result);
    (void)remove(case_path);
    (void)remove(csv_path);
}

static const char energy[] = "<critical-energy>2e+10J/m^3 +- 5%</critical-energy>";

/* Of the prediction, whose inputs are off the true ones. */
static void check_times(double measured)
{
    const double predicted = number_cell(runs, 0, "settled_predicted");
    assert_int_equal(wt_table_n_rows(runs), 1);
    assert_true(fabs(predicted - true_time) < 0.2 * true_time);
    assert_true(fabs(measured - true_time) < 0.5 * true_time);
    assert_true(number_cell(runs, 0, "change_predicted") < 0);
}

/* Without draws the prediction has no errors, and no error is 0. */
static void test_without_draws(void **state)
{
    (void)state;
    change_case(energy, energy);
    change_record(0, 0, 0);
    run_case(0);
    check_times(number_cell(runs, 0, "settled_measured"));
    assert_true(isnan(number_cell(runs, 0, "settled_predicted_standard_error")));
    assert_true(isnan(number_cell(runs, 0, "change_predicted_standard_error")));
    check(wt_table_key(runs, "includes"), "nothing: none were drawn");
    case_end();
}

/* The prediction with its errors, and values of the case that replace missing ones of the record.
 */
static void test_with_draws(void **state)
{
    (void)state;
    change_case(energy, energy);
    change_record(0, 0, 0);
    run_case(40);
    const double predicted = number_cell(runs, 0, "settled_predicted"),
                 error = number_cell(runs, 0, "settled_predicted_standard_error");
    check_times(number_cell(runs, 0, "settled_measured"));
    assert_true(error > 0 && fabs(predicted - true_time) < 3 * error);
    assert_true(number_cell(runs, 0, "change_predicted_standard_error") > 0);
    assert_true(number_cell(runs, 0, "time_ratio_low") < 1);
    assert_true(number_cell(runs, 0, "time_ratio_high") > 1);
    const char *const remarks = wt_table_key(runs, "remarks");
    check(remarks, "the temperature of every step: that of the case");
    check(remarks, "the nominal pressure of every step: that of the case");
    check_not(remarks, "the velocity of every step");
    case_end();
}

/* The layer lowers friction all along, and the measured course is near the predicted one. */
static void test_course(void **state)
{
    (void)state;
    change_case(energy, energy);
    change_record(0, 0, 0);
    run_case(0);
    const wt_table *const course = wt_result_find(result, "validation_course");
    const size_t n = wt_table_n_rows(course);
    assert_true(n > 20);
    for (size_t i = 0; i < n; i++) {
        const double with = number_cell(course, i, "friction_with_layer");
        assert_true(number_cell(course, i, "friction_without_layer") > with + 0.01);
        assert_true(fabs(number_cell(course, i, "friction_measured") - with) < 0.02);
        assert_true(i == 0 || number_cell(course, i, "time") > number_cell(course, i - 1, "time"));
    }
    case_end();
}

/* Samples at rest before sliding are not friction, whether laps continue during them or not. For
 * cycles without friction the lap count shows sliding. */
static void test_before_the_first_friction(void **state)
{
    static const size_t changed[][3] = {{5, 0, 0}, {40, 0, 0}, {0, 5, 0}, {0, 0, 20}};
    (void)state;
    for (size_t i = 0; i < sizeof changed / sizeof *changed; i++) {
        change_case(energy, energy);
        change_record(changed[i][0], changed[i][1], changed[i][2]);
        run_case(0);
        check_times(number_cell(runs, 0, "settled_measured"));
        case_end();
    }
}

/* The total friction, and with it its change, needs a shear stress. */
static void test_without_shear_stress(void **state)
{
    (void)state;
    change_case("<shear-stress>3e+06Pa +- 3%</shear-stress>", "");
    change_record(0, 0, 0);
    run_case(0);
    assert_true(isnan(number_cell(runs, 0, "settled_predicted")));
    check(text_cell(runs, 0, "note"), "no shear stress is given");
    case_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_without_draws),
        cmocka_unit_test(test_with_draws),
        cmocka_unit_test(test_course),
        cmocka_unit_test(test_before_the_first_friction),
        cmocka_unit_test(test_without_shear_stress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
