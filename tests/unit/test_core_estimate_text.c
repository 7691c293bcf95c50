/* Estimates and lists as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "case/answer/format_number.h"
#include "core/table/registry.h"
#include "weartrack/study.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

static void check_estimate(const char *text, wt_quantity quantity, double value, double error)
{
    wt_estimate e = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_estimate_parse(text, quantity, &e, &err) != WT_OK)
        fail_msg("%s: %s", text, err.message);
    assert_near(e.value, value, 1e-14);
    assert_near(e.standard_error, error, 1e-13);
    assert_string_equal(e.unit, wt_quantity_unit(quantity));
}

static void test_estimates(void **state)
{
    (void)state;
    check_estimate("0.4MPa", WT_Q_PRESSURE, 0.4e6, 0);
    check_estimate("0.4MPa +- 0.02MPa", WT_Q_PRESSURE, 0.4e6, 0.02e6);
    check_estimate("0.4MPa+-5%", WT_Q_PRESSURE, 0.4e6, 0.02e6);
    check_estimate(" 0.4 MPa \xc2\xb1 20 kPa\n", WT_Q_PRESSURE, 0.4e6, 0.02e6);
    check_estimate("20degC +- 0.5K", WT_Q_TEMPERATURE, 293.15, 0.5);
    check_estimate("0.64 +- 0.03", WT_Q_NONE, 0.64, 0.03);
    check_estimate("1e-3 mm^3/(N m) +- 10%", WT_Q_WEAR_RATE, 1e-12, 1e-13);
    check_estimate("8 +- 5%", WT_Q_NONE, 8, 0.4); /* relative to the value, also with a unit */
    check_estimate("2+-10 percent", WT_Q_NONE, 2, 0.2);
    check_estimate("64% +- 0.03", WT_Q_NONE, 0.64, 0.03);
}

static void test_estimate_errors(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        wt_quantity quantity;
        wt_status status;
        const char *found;
    } cases[] = {
        {"0.4", WT_Q_PRESSURE, WT_E_UNIT, NULL},
        {"0.4MPa +- 0.02", WT_Q_PRESSURE, WT_E_UNIT, NULL},
        {"0.4MPa +- -0.02MPa", WT_Q_PRESSURE, WT_E_RANGE, "\"-0.02MPa\""},
        {"0.4MPa +- -5%", WT_Q_PRESSURE, WT_E_RANGE, "\"-5%\""},
        {"20degC +- 5%", WT_Q_TEMPERATURE, WT_E_UNIT, NULL},
        {"64% +- 5%", WT_Q_NONE, WT_E_UNIT, "\"64% +- 5%\""},
        {"0.64 +- %", WT_Q_NONE, WT_E_ARG, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_estimate e = {7, 7, 7, "kept"};
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_estimate_parse(cases[i].text, cases[i].quantity, &e, &err),
                         cases[i].status);
        assert_string_equal(e.unit, "kept");
        if (cases[i].found != NULL)
            assert_string_equal(err.found, cases[i].found);
    }
}

static void check_list(const char *text, wt_quantity quantity, const double *expected, size_t n)
{
    double *values = NULL;
    size_t count = 0;
    wt_error err = WT_ERROR_INIT;
    if (wt_list_parse(text, quantity, &values, &count, &err) != WT_OK)
        fail_msg("%s: %s", text, err.message);
    assert_int_equal(count, n);
    for (size_t i = 0; i < n; i++)
        assert_near(values[i], expected[i], 1e-13);
    free(values);
}

static void test_lists(void **state)
{
    (void)state;
    const double one[] = {0.3}, three[] = {1e-3, 1e-2, 0.3}, log5[] = {1e-4, 1e-3, 1e-2, 0.1, 1};
    const double lin[] = {0, 25, 50}, milli[] = {1e-5, 1e-4, 1e-3};
    check_list("0.3m/s", WT_Q_VELOCITY, one, 1);
    check_list("1mm/s, 1cm/s,0.3 m/s", WT_Q_VELOCITY, three, 3);
    check_list("1e-4:1m/s:log:5", WT_Q_VELOCITY, log5, 5);
    check_list("1e-2:1e0mm/s:log:3", WT_Q_VELOCITY, milli, 3);
    check_list("0.1mm/s:1m/s:log:5", WT_Q_VELOCITY, log5, 5);
    check_list("0:50s:lin:3", WT_Q_TIME, lin, 3);
}

static void test_list_errors(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "1e-4:1m/s:log",     "1e-4:1m/s:log:1",
        "1e-4:1m/s:log:2.5", "1:1e-4m/s:log:5",
        "0:1m/s:log:5",      "1e-4:1m/s:cubic:5",
        "1e-4:1m/s:log:5:6", "0.3m/s,0.2m/s",
        "0.3m/s,,0.4m/s",    "",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        double *values = NULL;
        size_t n = 0;
        assert_int_not_equal(wt_list_parse(wrong[i], WT_Q_VELOCITY, &values, &n, NULL), WT_OK);
        assert_null(values);
    }
}

static void check_words(void)
{
    const wt_tip tip = {.shape = WT_TIP_CONE, .half_angle = 0.3};
    table_writer t = table_begin(&layer_schema, NULL);
    char text[64];
    layer_set_print(&t, LAYER_KEY_DUTY, "%g", 0.5);
    assert_int_equal(t.status, WT_OK);
    assert_string_equal(wt_table_key(t.table, "duty"), "0.5");
    wt_table_free(t.table);
    assert_string_equal(format_with_unit(0.25, "1").text, "0.250");
    assert_string_equal(format_estimate((wt_estimate){0.25, 0.125, 0, "1"}).text,
                        "0.25 \xc2\xb1 0.12");
    assert_string_equal(format_with_unit(5, "1").text, "5.00");
    assert_string_equal(format_with_unit(123, "1").text, "123");
    static const struct {
        wt_estimate e;
        const char *words;
    } decimals[] = {{{0.10498, 0.0029, 0, "1"}, "0.1050 \xc2\xb1 0.0029"},
                    {{1230.8, 226.6, 0, "s"}, "1230 \xc2\xb1 230 s"},
                    {{100853, 53, 0, "s"}, "100853 \xc2\xb1 53 s"},
                    {{3.157e-6, 7.76e-7, 0, "m"}, "3.16 \xc2\xb1 0.78 \xc2\xb5m"},
                    {{0.5, 1e-12, 0, "1"}, "0.500000 \xc2\xb1 1e-12"},
                    {{2e-7, 1e-8, 0, "1"}, "2.00e-07 \xc2\xb1 1e-08"}};
    for (size_t i = 0; i < sizeof decimals / sizeof *decimals; i++)
        assert_string_equal(format_estimate(decimals[i].e).text, decimals[i].words);
    assert_string_equal(format_celsius(WT_ZERO_CELSIUS + 20.5).text, "20.5 \xc2\xb0"
                                                                     "C");
    (void)wt_tip_describe(&tip, text, sizeof text);
    assert_string_equal(text, "cone, half-angle 17.19 degrees");
}

static void test_words_in_any_locale(void **state)
{
    (void)state;
    check_words();
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL)
        skip();
    check_words();
    (void)setlocale(LC_ALL, "C");
}

/* Equal names are one position, numbered by first occurrence, whatever is between them. */
static void test_spots(void **state)
{
    (void)state;
    static const char *const spots[] = {"b", "a", "b", "c", "a", "b"};
    static const long expected[] = {0, 1, 0, 2, 1, 0};
    enum { N = sizeof spots / sizeof spots[0] };
    const uint64_t put = SCHEMA_BIT(INDENTATION_SPOT) | SCHEMA_BIT(INDENTATION_VERDICT) |
                         SCHEMA_BIT(INDENTATION_MODULUS);
    wt_table *table = NULL;
    wt_group_data data;
    table_writer t = table_begin_variant(&indentation_schema,
                                         (table_variant){.suffix = "bulk", .left_out = ~put}, NULL);
    for (size_t i = 0; i < N; i++) {
        table_row(&t);
        indentation_put_text(&t, INDENTATION_SPOT, spots[i]);
        indentation_put_text(&t, INDENTATION_VERDICT, "accepted");
        indentation_put(&t, INDENTATION_MODULUS, 1e6);
    }
    assert_int_equal(table_end(&t, &table), WT_OK);
    assert_int_equal(wt_group_from_table(table, false, &data, NULL), WT_OK);
    assert_int_equal(data.group.n, N);
    for (size_t i = 0; i < N; i++)
        assert_int_equal(data.spot[i], expected[i]);
    wt_group_data_clear(&data);
    wt_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_estimates),
        cmocka_unit_test(test_estimate_errors),
        cmocka_unit_test(test_lists),
        cmocka_unit_test(test_list_errors),
        cmocka_unit_test(test_words_in_any_locale),
        cmocka_unit_test(test_spots),
    };
    return cmocka_run_group_tests_name("flow text", tests, NULL, NULL);
}
