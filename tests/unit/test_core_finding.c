/* Findings and the digits of their numbers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"

#include "core/table/finding.h"

#include <math.h>
#include <string.h>

/* A value is never rounded away: at least three digits, whatever the width of its interval. */
static void test_digits_of_every_interval(void **state)
{
    (void)state;
    static const double values[] = {2.96e-7, 0.0075, 6.37, 296, 8.27e6};
    static const double factors[] = {1.001, 1.01, 1.1, 2, 10, 1e3, 1e5};
    for (size_t v = 0; v < sizeof values / sizeof *values; v++)
        for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
            const double value = values[v];
            const int digits = result_value_digits(value, value / factors[i], value * factors[i]);
            assert_in_range(digits, 3, 6);
            /* A narrow interval needs more digits than three, or its limits print alike. */
            if (factors[i] < 1.01)
                assert_true(digits > 3);
        }
    assert_int_equal(result_value_digits(296, (double)NAN, (double)NAN), 3);
    assert_int_equal(result_value_digits(0, -1, 1), 3);
}

/* Without a comparison and a layer no question is asked. */
static void test_no_findings(void **state)
{
    (void)state;
    const result_value_tables none = {.comparison = {.schema = &comparison_schema}};
    finding findings[FINDING_QUESTIONS];
    assert_false(findings_compute(&none, findings));
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        assert_int_equal(findings[i].verdict, FINDING_NOT_COMPUTED);
}

/* The table of version 0.9.0 has sentences in as many rows, which are no findings. */
static void test_former_answer(void **state)
{
    (void)state;
    for (int former = 0; former < 2; former++) {
        const table_variant columns = {.suffix = "",
                                       .left_out = ~(SCHEMA_BIT(ANSWER_QUESTION) |
                                                     SCHEMA_BIT(ANSWER_ANSWER) |
                                                     (former ? 0 : SCHEMA_BIT(ANSWER_VERDICT)))};
        wt_table *table = NULL;
        table_view view;
        wt_error err = WT_ERROR_INIT;
        table_writer w = table_begin_variant(&answer_schema, columns, &err);
        for (int i = 0; i < FINDING_QUESTIONS; i++) {
            table_row(&w);
            answer_put_text(&w, ANSWER_QUESTION, finding_question_text((finding_question)i));
            answer_put_text(&w, ANSWER_ANSWER, "a sentence");
            if (!former)
                answer_put_text(&w, ANSWER_VERDICT, finding_verdict_text(FINDING_NOT_COMPUTED));
        }
        if (table_end(&w, &table) != WT_OK)
            fail_msg("%s: %s", err.place, err.message);
        assert_int_equal(table_bind(table, &answer_schema, "", &view, NULL), WT_OK);
        assert_int_equal(findings_are_stated(&view), !former);
        wt_table_free(table);
    }
}

/* Each verdict has a text of its own; the number of verdicts is that of the closed list. */
static void test_verdicts(void **state)
{
    (void)state;
    for (int i = 0; i < FINDING_VERDICT_UNKNOWN; i++)
        for (int j = 0; j < i; j++)
            assert_string_not_equal(finding_verdict_text((finding_verdict)i),
                                    finding_verdict_text((finding_verdict)j));
    assert_string_equal(finding_verdict_text(FINDING_INCONCLUSIVE), "inconclusive");
    assert_string_equal(finding_verdict_text(FINDING_NOT_ENOUGH_DATA), "not enough data");
}

/* A table with one key. */
static wt_table *table_of_key(const char *name, const char *key, double value, double error,
                              const char *unit)
{
    wt_table *table = wt_table_new(name, name);
    if (wt_table_set_estimate(table, key, (wt_estimate){value, error, 0, unit}, NULL) != WT_OK)
        fail_msg("no key %s", key);
    return table;
}

/* Without a layer the change of the friction is none and needs no interval; with one it does. */
static void test_change_without_a_layer(void **state)
{
    (void)state;
    static const struct {
        double thickness, change;
        finding_verdict verdict;
        const char *sentence;
    } cases[] = {{0, 0, FINDING_PREDICTED, "There is no layer that could change the friction."},
                 {1e-6, -0.2, FINDING_NOT_ENOUGH_DATA, "The data do not allow a 95 % interval."}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double none = (double)NAN;
        wt_table *const layer = table_of_key("layer", "balance_thickness", cases[i].thickness, none,
                                             "m"),
                        *const friction = table_of_key("friction", "relative_change_at_reference",
                                                       cases[i].change, none, "1");
        const result_value_tables tables = {
            .comparison = {.schema = &comparison_schema, .suffix = ""},
            .what_if = {.schema = &what_if_schema, .suffix = ""},
            .layer = {.table = layer, .schema = &layer_schema, .suffix = ""},
            .friction = {.table = friction, .schema = &friction_schema, .suffix = ""}};
        finding findings[FINDING_QUESTIONS];
        assert_true(findings_compute(&tables, findings));
        assert_int_equal(findings[FINDING_FRICTION_CHANGE].verdict, cases[i].verdict);
        assert_string_equal(findings[FINDING_FRICTION_CHANGE].sentence, cases[i].sentence);
        assert_int_equal(findings[FINDING_TRACK_DIFFERS].verdict, FINDING_NOT_COMPUTED);
        assert_non_null(strstr(findings[FINDING_TRACK_DIFFERS].sentence, "weartrack compare"));
        wt_table_free(layer);
        wt_table_free(friction);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits_of_every_interval),
        cmocka_unit_test(test_no_findings),
        cmocka_unit_test(test_former_answer),
        cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_change_without_a_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
