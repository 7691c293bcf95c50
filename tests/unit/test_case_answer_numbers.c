/* Numbers in the sentences of a result: unit, digits, errors, signs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "case/answer/format_number.h"
#include "core/base/number.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <string.h>

static void test_values(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *unit, *words;
    } cases[] = {
        {1.1512e-6, "m", "1.15 \xc2\xb5m"},
        {-2.5e6, "Pa", "-2.50 MPa"},
        {0.10049, "1", "0.100"},
        {1.23456, "1", "1.23"},
        {-0.0456, "1", "-0.0456"},
        {123.4, "1", "123"},
        {(double)NAN, "m", "not known"},
        {(double)INFINITY, "m", "without limit"},
        {1234, "s", "1230 s"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_string_equal(format_with_unit(cases[i].value, cases[i].unit).text, cases[i].words);
        const wt_estimate e = {cases[i].value, 0.1, 0.2, cases[i].unit};
        assert_string_equal(format_value(e).text, cases[i].words);
    }
    assert_string_equal(format_celsius(306.15).text, "33.0 \xc2\xb0"
                                                     "C");
    assert_string_equal(format_celsius(263.04).text, "-10.1 \xc2\xb0"
                                                     "C");
}

static void test_errors(void **state)
{
    (void)state;
    static const struct {
        double value, error;
        const char *unit, *words;
    } cases[] = {
        {3.163e-6, 0.962e-6, "m", "3.16 \xc2\xb1 0.96 \xc2\xb5m"},
        {0.10504, 0.00289, "1", "0.1050 \xc2\xb1 0.0029"},
        {1234.4, 226.0, "s", "1230 \xc2\xb1 230 s"},
        {-0.271, 0.0134, "1", "-0.271 \xc2\xb1 0.013"},
        {2.5e6, 1e5, "Pa", "2.50 \xc2\xb1 0.10 MPa"},
        {2.5e6, 0, "Pa", "2.50 MPa"},
        {3.163e-6, (double)NAN, "m", "3.16 \xc2\xb5m (error not known)"},
        {(double)NAN, (double)NAN, "m", "not known"},
        {(double)NAN, 0.1, "m", "not known"},
        {(double)INFINITY, (double)NAN, "m", "without limit"},
        {0.5, (double)INFINITY, "1", "0.500"},
        {1.084e-12, 5.1e-14, "m^2/N", "0.001084 \xc2\xb1 0.000051 mm^3/(N m)"},
        {4.2e-7, (double)NAN, "m^2/N", "420 mm^3/(N m) (error not known)"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const wt_estimate e = {cases[i].value, cases[i].error, 0, cases[i].unit};
        assert_string_equal(format_estimate(e).text, cases[i].words);
    }
}

/* Two limits that print alike with three digits get more digits; others keep three. */
static void test_limits_with_more_digits(void **state)
{
    (void)state;
    assert_string_equal(format_range(0.56651, 0.84118, 3).text, "0.567 to 0.841");
    assert_string_equal(format_range(0.99962, 1.0014, 3).text, "0.9996 to 1.001");
    assert_string_equal(format_range(-1e6, -1.00001e6, 2).text, "-1e+06 to -1.00001e+06");
    assert_string_equal(format_range(2, 2, 3).text, "2 to 2");
}

/* Differs by more than the factor, in either direction. */
static void test_other_rubber(void **state)
{
    (void)state;
    const double factor = ANSWER_DMA_FACTOR;
    assert_false(is_different_rubber(1 / factor, factor));
    assert_true(is_different_rubber(1, nextafter(factor, 10)));
    assert_true(is_different_rubber(nextafter(1 / factor, 0), 1));
}

static void test_rejected(void **state)
{
    (void)state;
    static const wt_curve_verdict verdicts[] = {WT_CURVE_ACCEPTED,   WT_CURVE_POOR_FIT,
                                                WT_CURVE_UNREADABLE, WT_CURVE_POOR_FIT,
                                                WT_CURVE_NO_CONTACT, WT_CURVE_ACCEPTED};
    wt_table *table = NULL;
    table_view view;
    char words[256], expected[256];
    wt_error err = WT_ERROR_INIT;
    const table_variant few = {
        .suffix = "bulk",
        .left_out = ~(SCHEMA_BIT(INDENTATION_VERDICT) | SCHEMA_BIT(INDENTATION_MODULUS))};
    table_writer t = table_begin_variant(&indentation_schema, few, &err);
    for (size_t i = 0; i < sizeof verdicts / sizeof *verdicts; i++) {
        table_row(&t);
        indentation_put_text(&t, INDENTATION_VERDICT, wt_curve_verdict_id(verdicts[i]));
        indentation_put(&t, INDENTATION_MODULUS, 1e6);
    }
    if (table_end(&t, &table) != WT_OK)
        fail_msg("%s", err.message);
    assert_int_equal(table_bind(table, &indentation_schema, "bulk", &view, NULL), WT_OK);
    assert_int_equal(format_rejected_curves(&view, words, sizeof words), 4);
    /* in the order of the verdicts */
    snprintf(expected, sizeof expected, "1 %s, 2 %s, 1 %s",
             wt_curve_verdict_text(WT_CURVE_NO_CONTACT), wt_curve_verdict_text(WT_CURVE_POOR_FIT),
             wt_curve_verdict_text(WT_CURVE_UNREADABLE));
    assert_string_equal(words, expected);
    wt_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_errors),
                                       cmocka_unit_test(test_limits_with_more_digits),
                                       cmocka_unit_test(test_other_rubber),
                                       cmocka_unit_test(test_rejected)};
    return cmocka_run_group_tests_name("words of the answer", tests, NULL, NULL);
}
