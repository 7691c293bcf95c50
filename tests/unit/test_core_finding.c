/* Results and the digits of their numbers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/table/finding.h"

#include <math.h>
#include <string.h>

/* A value is not rounded too far: it has at least three digits, for any width of its interval. */
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
            /* A narrow interval needs more than three digits; otherwise its limits print alike. */
            if (factors[i] < 1.01)
                assert_true(digits > 3);
        }
    assert_int_equal(result_value_digits(296, (double)NAN, (double)NAN), 3);
    assert_int_equal(result_value_digits(0, -1, 1), 3);
}

/* Without a comparison and a layer there is no question. */
static void test_no_findings(void **state)
{
    (void)state;
    const result_value_tables none = {.comparison = {.schema = &comparison_schema}};
    finding findings[FINDING_QUESTIONS];
    assert_false(findings_compute(&none, findings));
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        assert_int_equal(findings[i].verdict, FINDING_NOT_COMPUTED);
}

/* The table of version 0.9.0 has sentences in as many rows, which are not results. */
static void test_table_of_earlier_version(void **state)
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

/* Each verdict has its text; the number of verdicts is that of the closed list. */
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

/* Without a layer friction does not change, without an interval; with one it does. */
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

/* The widest choice, how to decide it, the share of the range that the others leave, and the curves
 * that determine a thickness. */
static void test_what_to_measure(void **state)
{
    (void)state;
    static const struct {
        const char *choice, *remedy;
        double thickness;
    } rows[] = {{"as used", "", 3e-6},
                {"smallest wavenumber q0", "Measure one.", 2e-6},
                {"largest wavenumber q1", "Measure other.", 12e-6},
                {"largest wavenumber q1", "Measure other.", 6e-6},
                {"of a later version", "Measure third.", 4e-6},
                {"of another", "Measure third.", 3.5e-6}};
    wt_error err = WT_ERROR_INIT;
    table_writer w = table_begin(&what_if_schema, &err);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        table_row(&w);
        for (size_t c = 0; c < what_if_schema.n_columns; c++)
            if (what_if_schema.columns[c].kind == SCHEMA_TEXT)
                what_if_put_text(&w, (what_if_column)c,
                                 c == WHAT_IF_CHOICE   ? rows[i].choice
                                 : c == WHAT_IF_REMEDY ? rows[i].remedy
                                                       : "");
            else
                what_if_put(&w, (what_if_column)c,
                            c == WHAT_IF_THICKNESS ? rows[i].thickness : (double)NAN);
    }
    wt_table *table = NULL;
    if (table_end(&w, &table) != WT_OK)
        fail_msg("%s: %s", err.place, err.message);
    wt_table *const layer = table_of_key("layer", "balance_thickness", 3e-6, 1e-6, "m"),
                    *const curves = wt_table_new("track_layer", "curves");
    assert_int_equal(wt_table_set_key(curves, "settled_by", "deeper curves", &err), WT_OK);
    result_value_tables tables = {
        .comparison = {.schema = &comparison_schema, .suffix = ""},
        .friction = {.schema = &friction_schema, .suffix = ""},
        .layer = {.table = layer, .schema = &layer_schema, .suffix = ""},
        .track_layer = {.table = curves, .schema = &track_layer_schema, .suffix = ""}};
    assert_int_equal(table_bind(table, &what_if_schema, "", &tables.what_if, NULL), WT_OK);
    finding findings[FINDING_QUESTIONS];
    assert_true(findings_compute(&tables, findings));
    const finding *f = &findings[FINDING_LAYER_THICKNESS];
    assert_string_equal(f->value.range.widest, "largest wavenumber q1");
    assert_near(f->value.range.rest_low, 2e-6, 0);
    assert_near(f->value.range.rest_high, 4e-6, 0);
    assert_near(f->rest, 0.2, 1e-12);
    assert_string_equal(f->remedy, "Measure other. If confirmed, 2.00 um to 4.00 um remain. By "
                                   "indentation: deeper curves.");
    assert_string_equal(findings[FINDING_TRACK_DIFFERS].remedy, "");
    wt_table_free(table);
    wt_table_free(layer);
    wt_table_free(curves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits_of_every_interval), cmocka_unit_test(test_no_findings),
        cmocka_unit_test(test_table_of_earlier_version), cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_change_without_a_layer),   cmocka_unit_test(test_what_to_measure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
