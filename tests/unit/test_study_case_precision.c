/* Error against run time of the numbers of a case. */
#include "assert_near.h"
#include "sliding_fixture.h"
#include "table_cells.h"
#include "weartrack/case.h"

#include <math.h>
#include <string.h>

static wt_table *sweep(size_t repeats)
{
    const wt_accuracy_job job = {.repeats = repeats};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_case_precision_compute(&sliding, NULL, NULL, &job, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return table;
}

static bool is(const wt_table *table, size_t row, const char *part, const char *method)
{
    return strcmp(text_cell(table, row, "part"), part) == 0 &&
           strcmp(text_cell(table, row, "method"), method) == 0;
}

static wt_estimate friction_at(double tolerance, size_t replicates, uint64_t seed)
{
    wt_friction_tables tables = {0};
    wt_estimate e;
    wt_job as = work;
    as.tolerance = tolerance;
    as.replicates = replicates;
    as.seed = seed;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &as, &tables, NULL), WT_OK);
    assert_true(wt_table_estimate(tables.friction, "friction_at_reference", &e));
    wt_table_free(tables.friction);
    return e;
}

/* Difference between this tolerance and the tightest, never less than the error of the
 * reference. */
static void test_tolerance(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *table = sweep(1);
    const double tight = friction_at(1e-13, 0, 1).value;
    size_t found = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        const double error = number_cell(table, i, "true_error"),
                     reference = number_cell(table, i, "reference_error");
        assert_true(error >= reference && reference > 0);
        if (!is(table, i, "friction coefficient by tolerance", "weartrack"))
            continue;
        const double off =
            fabs(friction_at(1 / number_cell(table, i, "value"), 0, 1).value / tight - 1);
        assert_near_abs(error, fmax(off, reference), 1e-15);
        assert_true(error <= number_cell(table, i, "stated_error") + reference);
        found++;
    }
    assert_int_equal(found, 6);
    wt_table_free(table);
}

/* Trapezoidal rule: nine times as accurate with three times the wavenumbers, to the same number. */
static void test_textbook(void **state)
{
    (void)state;
    static const char *const parts[] = {"hysteresis part by tolerance",
                                        "real over nominal contact area by tolerance",
                                        "friction coefficient by tolerance"};
    sliding_set_up_uncertain();
    wt_table *table = sweep(1);
    for (size_t p = 0; p < sizeof parts / sizeof parts[0]; p++) {
        double first = 0, last = 0;
        for (size_t i = 0; i < wt_table_n_rows(table); i++) {
            if (!is(table, i, parts[p], "textbook"))
                continue;
            last = number_cell(table, i, "true_error");
            first = first > 0 ? first : last;
            assert_true(isnan(number_cell(table, i, "stated_error")));
        }
        assert_true(last > 0 && last < 1e-5 && last < first / 300);
    }
    sliding.gamma = 0.5; /* which it does not know */
    wt_table *without = sweep(1);
    for (size_t i = 0; i < wt_table_n_rows(without); i++)
        assert_string_equal(text_cell(without, i, "method"), "weartrack");
    wt_table_free(without);
    wt_table_free(table);
}

/* Standard errors from sets of replicates; more replicates determine them better. */
static void test_replicates(void **state)
{
    (void)state;
    static const char part[] = "error of friction coefficient by replicates";
    sliding_set_up_uncertain();
    wt_table *table = sweep(1);
    const double reference = friction_at(work.tolerance, 2400, work.seed).standard_error;
    size_t found = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        if (!is(table, i, part, "weartrack"))
            continue;
        const double n = number_cell(table, i, "value");
        double squares = 0;
        for (uint64_t set = 1; set <= 4; set++) {
            const wt_estimate e = friction_at(work.tolerance, (size_t)n, work.seed + set);
            squares += pow(e.standard_error / reference - 1, 2) / 4;
        }
        assert_near_abs(number_cell(table, i, "reference_error"), 1 / sqrt(2 * 2399.), 1e-12);
        assert_near_abs(number_cell(table, i, "true_error"),
                        fmax(sqrt(squares), 1 / sqrt(2 * 2399.)), 1e-12);
        assert_near(number_cell(table, i, "stated_error"), 1 / sqrt(2 * (n - 1)), 1e-12);
        found++;
    }
    assert_int_equal(found, 5);
    wt_table_free(table);
}

/* Without times two tables are the same for any number of threads; with them everything else is. */
static void test_times(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *plain = sweep(1);
    work.threads = 3;
    work.cost = wt_cost_new(true, 3);
    wt_table *timed = sweep(3);
    assert_int_equal(wt_table_n_rows(plain), wt_table_n_rows(timed));
    for (size_t i = 0; i < wt_table_n_rows(plain); i++) {
        assert_true(isnan(number_cell(plain, i, "seconds")));
        assert_true(number_cell(timed, i, "seconds") > 0);
        assert_string_equal(text_cell(plain, i, "part"), text_cell(timed, i, "part"));
        assert_near(number_cell(plain, i, "true_error"), number_cell(timed, i, "true_error"), 0);
    }
    wt_cost_free(work.cost);
    wt_table_free(plain);
    wt_table_free(timed);
}

/* The bundled case: all numbers have rows, and the answer is of the friction with the layer. */
static void test_bundled_case(void **state)
{
    (void)state;
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_run_options options = wt_run_defaults();
    size_t found = 0, failed = 0;
    options.no_provenance = true;
    options.threads = 1;
    options.replicates = 50;
    options.precision.repeats = 1;
    assert_int_equal(wt_case_read(WT_SOURCE_DIR "/fixtures/case/case.xml", &c, NULL), WT_OK);
    assert_int_equal(wt_case_request_tables(c, "work_precision cost", NULL), WT_E_NOT_FOUND);
    assert_int_equal(wt_case_request_tables(c, "", NULL), WT_E_NOT_FOUND);
    assert_int_equal(wt_case_request_tables(c, "what_if work_precision", NULL), WT_OK);
    assert_int_equal(wt_run_case(c, &options, NULL, &result, &failed, NULL), WT_OK);
    assert_int_equal(failed, 0);
    assert_non_null(wt_result_find(result, "what_if"));
    const wt_table *table = wt_result_find(result, "work_precision");
    assert_non_null(table);
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        if (!is(table, i, "layer thickness by tolerance", "weartrack"))
            continue;
        assert_true(number_cell(table, i, "true_error") <=
                    number_cell(table, i, "stated_error") +
                        number_cell(table, i, "reference_error"));
        found++;
    }
    assert_int_equal(found, 6);
    const char *answer = wt_table_key(table, "answer");
    assert_non_null(answer);
    assert_int_equal(strncmp(answer, "friction coefficient with layer: ", 33), 0);
    assert_non_null(strstr(answer, "at a tolerance of 0.01 and of "));
    assert_null(strstr(answer, "s at a tolerance")); /* no times */
    assert_true(wt_table_n_rows(table) > 60);
    wt_result_free(result);
    wt_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tolerance),    cmocka_unit_test(test_textbook),
        cmocka_unit_test(test_replicates),   cmocka_unit_test(test_times),
        cmocka_unit_test(test_bundled_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
