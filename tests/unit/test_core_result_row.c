/* How the rows of a result print their numbers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/table/registry.h"
#include "core/table/result_row.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of digits of the first number in a text, without leading zeros. */
static size_t significant_digits(const char *text)
{
    size_t n = 0;
    bool begun = false;
    for (; *text != '\0' && *text != ' ' && *text != 'e'; text++) {
        begun = begun || (isdigit((unsigned char)*text) && *text != '0');
        n += begun && isdigit((unsigned char)*text) ? 1 : 0;
    }
    return n;
}

/* Number of a text in SI units, by the prefix of its unit or else that of `like`. */
static double number_of(const char *text, const char *like)
{
    static const struct {
        char prefix;
        double factor;
    } prefixes[] = {{'n', 1e-9}, {'u', 1e-6}, {'m', 1e-3}, {'k', 1e3},
                    {'M', 1e6},  {'G', 1e9},  {'T', 1e12}, {'p', 1e-12}};
    char *end = NULL;
    const double number = strtod(text, &end);
    const char *unit = *end == ' ' && strncmp(end, " to ", 4) != 0 ? end : strchr(like, ' ');
    for (size_t i = 0; unit != NULL && i < sizeof prefixes / sizeof *prefixes; i++)
        if (unit[1] == prefixes[i].prefix && strncmp(unit + 2, "Pa", 2) == 0)
            return number * prefixes[i].factor;
    return number;
}

/* For any width of the interval: at least three digits, each number within half a unit of the third
 * digit, and different limits print differently. */
static void test_intervals_of_every_width(void **state)
{
    (void)state;
    static const double values[] = {2.96e-7, 0.0075, 6.37, 296e3, 7.5e3, 8.27e6, 9.996e5};
    static const double factors[] = {1.001, 1.01, 1.1, 1.5, 2, 10, 100, 1e3, 1e4, 1e5};
    for (size_t v = 0; v < sizeof values / sizeof *values; v++)
        for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
            const double none = (double)NAN;
            const row_number n = {
                values[v], values[v] / factors[i], values[v] * factors[i], none, none, "Pa"};
            const row_number_text text = row_number_format(&n);
            const char *to = strstr(text.interval, " to ");
            assert_non_null(to);
            if (significant_digits(text.value) < 3 || significant_digits(text.interval) < 3 ||
                significant_digits(to + 4) < 3 ||
                !(fabs(number_of(text.value, text.value) / n.value - 1) < 5.1e-3) ||
                !(fabs(number_of(text.interval, text.value) / n.low - 1) < 5.1e-3) ||
                !(fabs(number_of(to + 4, text.value) / n.high - 1) < 5.1e-3))
                fail_msg("%g, %g to %g: %s, %s", n.value, n.low, n.high, text.value, text.interval);
            if ((size_t)(to - text.interval) == strlen(to + 4))
                assert_int_not_equal(strncmp(text.interval, to + 4, (size_t)(to - text.interval)),
                                     0);
        }
}

static void test_forms(void **state)
{
    (void)state;
    const double none = (double)NAN, without = (double)INFINITY;
    static const char *const no_unit = "1";
    const struct {
        row_number number;
        const char *value, *interval, *range;
    } cases[] = {
        {{7.98e6, 7.67e6, 8.30e6, none, none, "Pa"}, "7.98 MPa", "7.67 to 8.30", ""},
        {{296e3, 41, 379e6, none, none, "Pa"}, "296 kPa", "41.0 Pa to 379 MPa", ""},
        {{3.02e-6, 1.42e-6, 4.62e-6, 1.01e-6, 10.24e-6, "m"},
         "3.02 um",
         "1.42 to 4.62",
         "1.01 to 10.24"},
        {{-0.19, -0.234, -0.146, -0.345, 0.182, "%"}, "-19.0 %", "-23.4 to -14.6", "-34.5 to 18.2"},
        {{293.15, none, none, none, none, "degC"}, "20.0 degC", "", ""},
        {{8e-13, none, none, none, none, "m^2/N"}, "0.000800 mm^3/(N m)", "", ""},
        {{none, 570e-9, without, none, none, "m"}, "-", ">= 570 nm", ""},
        {{none, none, none, none, none, "m"}, "not known", "", ""},
        {{without, none, none, none, none, "m"}, "no limit", "", ""},
        {{0, 0, 0.2, none, none, no_unit}, "0", "0 to 0.200", ""},
        {{5.9e5, none, none, none, none, "rad/m"}, "5.90e5 rad/m", "", ""},
        {{4321, none, none, none, none, "rad/m"}, "4321 rad/m", "", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const row_number_text text = row_number_format(&cases[i].number);
        assert_string_equal(text.value, cases[i].value);
        assert_string_equal(text.interval, cases[i].interval);
        assert_string_equal(text.range, cases[i].range);
    }
}

/* A result without a table with rows has no rows. */
static void test_no_rows(void **state)
{
    (void)state;
    wt_result *result = wt_result_new();
    result_rows rows;
    result_rows_compute(result, &rows);
    assert_int_equal(rows.n, 0);
    assert_false(result_rows_of_findings(result, &rows));
    result_rows_clear(&rows);
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_intervals_of_every_width),
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_no_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
