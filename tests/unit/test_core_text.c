/* Errors, the parse log, numbers, paths. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "core/base/text.h"
#include "weartrack/core.h"

#include <float.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void statuses(void **state)
{
    (void)state;
    assert_string_equal(wt_status_text(WT_E_IO), "input or output failed");
    assert_string_equal(wt_status_text((wt_status)999), "unknown status");
}

static void error_parts(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    char line[512];
    assert_int_equal(wt_fail(&err, WT_E_CORRUPT, "the %s is odd", "header"), WT_E_CORRUPT);
    wt_error_place(&err, "line %d", 12);
    wt_error_expected(&err, "%.2f", 1.5);
    wt_error_found(&err, "a\tb\x01\xFF");
    wt_error_advice(&err, "export it again");
    wt_error_file(&err, "a.txt");
    wt_error_file(&err, "b.txt"); /* the first name stays */
    const char *const expected =
        "a.txt: line 12: the header is odd; expected 1.50; found a b ?; export it again";
    assert_int_equal(wt_error_format(&err, line, sizeof line), strlen(expected));
    assert_string_equal(line, expected);
    assert_int_equal(wt_error_format(&err, line, 12), strlen(expected));
    assert_string_equal(line, "a.txt: l...");
    assert_int_equal(wt_error_format(&err, NULL, 0), strlen(expected));
    /* A new failure replaces the rest, and may quote the old text. */
    (void)wt_fail(&err, WT_E_IO, "after: %s", err.message);
    assert_string_equal(err.message, "after: the header is odd");
    assert_true(err.file[0] == '\0' && err.place[0] == '\0' && err.advice[0] == '\0');
    err = (wt_error)WT_ERROR_INIT;
    err.status = WT_E_UNIT;
    (void)wt_error_format(&err, line, sizeof line);
    assert_string_equal(line, wt_status_text(WT_E_UNIT));
    assert_int_equal(wt_fail(NULL, WT_E_ARG, "nobody listens"), WT_E_ARG);
    wt_error_file(NULL, "x");
    wt_error_place(NULL, "x");
}

static void texts_are_cut_at_a_character(void **state)
{
    (void)state;
    /* Every position of two-, three- and four-byte characters at the end of the buffer. */
    static const char *const characters[] = {"\xC2\xB5", "\xE2\x88\x9A", "\xF0\x9D\x94\xBC"};
    for (size_t c = 0; c < 3; c++) {
        for (size_t lead = 0; lead < 4; lead++) {
            char text[700] = "";
            memset(text, 'a', lead);
            text[lead] = '\0';
            while (strlen(text) < 600)
                strcat(text, characters[c]);
            wt_error err = WT_ERROR_INIT;
            (void)wt_fail(&err, WT_E_IO, "%s", text);
            wt_error_file(&err, text);
            const char *const parts[] = {err.message, err.file};
            const size_t sizes[] = {sizeof err.message, sizeof err.file};
            for (size_t p = 0; p < 2; p++) {
                const size_t n = strlen(parts[p]);
                assert_true(n < sizes[p] && n + 5 > sizes[p] - 3);
                assert_int_equal(utf8_valid_length(parts[p], n), n);
                assert_string_equal(parts[p] + n - 3, "...");
                assert_memory_equal(parts[p], text, n - 3);
            }
        }
    }
}

static void utf8_copies(void **state)
{
    (void)state;
    static const struct {
        size_t size;
        const char *text, *copy;
    } cases[] = {{1, "ab", ""},
                 {3, "ab", "ab"},
                 {3, "a\xc3\xa9", "a"},
                 {4, "a\xc3\xa9", "a\xc3\xa9"},
                 {5, "a\xe2\x82\xac\xe2\x82\xac", "a\xe2\x82\xac"},
                 {7, "a\xe2\x82\xac\xe2\x82\xac", "a\xe2\x82\xac"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char to[8] = "zzzzzzz";
        utf8_copy(to, cases[i].size, cases[i].text);
        assert_string_equal(to, cases[i].copy);
    }
}

static void utf8(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        size_t good;
    } cases[] = {{"", 0},
                 {"plain", 5},
                 {"\xC3\xA9", 2},
                 {"a\xC0\xAF", 1},        /* overlong */
                 {"\xE0\x80\x80", 0},     /* overlong */
                 {"\xED\xA0\x80", 0},     /* surrogate */
                 {"\xF4\x90\x80\x80", 0}, /* above U+10FFFF */
                 {"\xF5\x80\x80\x80", 0},
                 {"ab\xE2\x88", 2}, /* truncated */
                 {"\x80", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(utf8_valid_length(cases[i].text, strlen(cases[i].text)), cases[i].good);
}

static void parse_log(void **state)
{
    (void)state;
    wt_log *const log = wt_log_new();
    assert_non_null(log);
    for (int i = 0; i < 500; i++)
        wt_log_add(log, WT_WARNING, "a.txt", i == 0 ? "line 1" : "line 2", "value %s", "odd");
    wt_log_add(log, WT_NOTE, "a.txt", NULL, "value odd");
    wt_log_add(log, WT_WARNING, NULL, NULL, "value odd");
    wt_log_add(log, WT_WARNING, "a.txt", "line 9", "value odd");
    wt_log_add(log, WT_WARNING, "b.txt", "line 9", "value\nodd");
    assert_int_equal(wt_log_count(log), 4);
    const wt_log_entry first = wt_log_get(log, 0);
    assert_int_equal(first.severity, WT_WARNING);
    assert_string_equal(first.file, "a.txt");
    assert_string_equal(first.place, "line 1");
    assert_string_equal(first.text, "value odd");
    assert_int_equal(first.count, 501);
    assert_string_equal(wt_log_get(log, 2).file, "");
    assert_string_equal(wt_log_get(log, 3).text, "value odd");
    wt_log_free(log);
    wt_log_free(NULL);
    wt_log_add(NULL, WT_NOTE, NULL, NULL, "nobody listens");
    assert_int_equal(wt_log_count(NULL), 0);
}

static void check_number(const char *text, char decimal, bool good, double expected)
{
    double value = 7.5;
    const bool parsed = wt_number_parse(text, strlen(text), decimal, &value);
    if (parsed != good)
        print_error("\"%s\"\n", text);
    assert_int_equal(parsed, good);
    assert_near(value, good ? expected : 7.5, 0.0);
}

static void numbers(void **state)
{
    (void)state;
    check_number("2.385", '.', true, 2.385);
    check_number(" \t-2.385e-3 \r\n", '.', true, -2.385e-3);
    check_number("+.5", '.', true, 0.5);
    check_number("5.", '.', true, 5.0);
    check_number("2,385", ',', true, 2.385);
    check_number("1E+3", '.', true, 1000.0);
    check_number("0x10", '.', false, 0);
    check_number("2.385", ',', false, 0);
    check_number("2,385", '.', false, 0);
    check_number("1.2.3", '.', false, 0);
    check_number("", '.', false, 0);
    check_number(".", '.', false, 0);
    check_number("-", '.', false, 0);
    check_number("--", '.', false, 0);
    check_number("1e", '.', false, 0);
    check_number("1 2", '.', false, 0);
    check_number("nan", '.', false, 0);
    check_number("inf", '.', false, 0);
    check_number("1e999", '.', false, 0);
    check_number("1e-999", '.', true, 0.0);
    double value = 7.5;
    assert_true(wt_number_parse("12345", 3, '.', &value)); /* the exact number of bytes */
    assert_near(value, 123.0, 0.0);
    assert_false(wt_number_parse("1\0002", 3, '.', &value));
    char digits[2000];
    memset(digits, '1', sizeof digits);
    assert_false(wt_number_parse(digits, sizeof digits, '.', &value));
}

static uint64_t next_random(uint64_t *seed)
{
    *seed ^= *seed << 13; /* xorshift64 */
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return *seed;
}

static void check_round_trip(double value)
{
    char text[32];
    double again = 7.5;
    const size_t length = wt_number_format(value, text);
    assert_true(length < sizeof text && text[length] == '\0');
    assert_true(wt_number_parse(text, length, '.', &again));
    assert_memory_equal(&again, &value, sizeof value);
}

/* As in the C library. */
static void check_shortest(double value)
{
    char text[32], expected[32];
    (void)wt_number_format(value, text);
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(expected, sizeof expected, "%.*e", digits - 1, value);
        if (!(strtod(expected, NULL) < value || strtod(expected, NULL) > value))
            break;
    }
    char mantissa[32] = "", got[32] = "";
    size_t n = 0, m = 0;
    for (const char *c = expected; *c != '\0' && *c != 'e'; c++)
        if (*c >= '0' && *c <= '9')
            mantissa[n++] = *c;
    while (n > 1 && mantissa[n - 1] == '0')
        mantissa[--n] = '\0';
    for (const char *c = text; *c != '\0' && *c != 'e'; c++)
        if ((*c >= '1' && *c <= '9') || (*c == '0' && m > 0))
            got[m++] = *c;
    while (m > 1 && got[m - 1] == '0')
        got[--m] = '\0';
    assert_string_equal(got, mantissa);
    check_round_trip(value);
}

static void shortest_numbers(void **state)
{
    (void)state;
    uint64_t seed = 77;
    for (int i = 0; i < 100000; i++) {
        const double share = (double)(next_random(&seed) >> 11) * 0x1p-53,
                     size = pow(10, (double)(next_random(&seed) % 81) - 40);
        check_shortest((share + 0x1p-53) * size);
        check_shortest(-size * (double)(next_random(&seed) % 100000 + 1) / 7);
        check_shortest((double)(next_random(&seed) % 1000000 + 1) * size);
    }
    for (int i = -120; i < 120; i++) { /* powers of two and their neighbours */
        check_shortest(ldexp(1, i));
        check_shortest(nextafter(ldexp(1, i), 0));
        check_shortest(nextafter(ldexp(1, i), 1e300));
        check_shortest(pow(10, i / 4.0));
        check_shortest(nextafter(pow(10, i / 4), 0));
        check_shortest(nextafter(pow(10, i / 4), 1e300));
    }
}

static void round_trips(void)
{
    uint64_t seed = 0x9E3779B97F4A7C15;
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = next_random(&seed);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value))
            check_round_trip(value);
        const uint64_t tiny = bits & 0x800FFFFFFFFFFFFF; /* subnormal */
        memcpy(&value, &tiny, sizeof value);
        check_round_trip(value);
        check_round_trip((double)(bits >> 40) / 1000.0);
    }
    check_round_trip(0.0);
    check_round_trip(-0.0);
    check_round_trip(DBL_MAX);
    check_round_trip(DBL_MIN);
    check_round_trip(5e-324);
}

static void formatted_numbers(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0.1, "0.1"},
                 {1e5, "100000"},
                 {0.0, "0"},
                 {-0.0, "-0"},
                 {-7, "-7"},
                 {999999999999999, "999999999999999"},
                 {-120000000000000, "-120000000000000"},
                 {1e15, "1e15"},
                 {1234567890123456, "1234567890123456"},
                 {-1e15, "-1e15"},
                 {1e-5, "1e-5"},
                 {1e300, "1e300"},
                 {5e-324, "5e-324"},
                 {-2.5, "-2.5"},
                 {(double)NAN, "nan"},
                 {(double)INFINITY, "inf"},
                 {-(double)INFINITY, "-inf"},
                 {1.0 / 3.0, "0.3333333333333333"},
                 {0.30000000000000004, "0.30000000000000004"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[32];
        assert_int_equal(wt_number_format(cases[i].value, text), strlen(cases[i].text));
        assert_string_equal(text, cases[i].text);
    }
    round_trips();
}

static void foreign_locale(void **state)
{
    (void)state;
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL)
        skip();
    round_trips();
    char text[32], line[64];
    (void)wt_number_format(2.385, text);
    assert_string_equal(text, "2.385");
    wt_error err = WT_ERROR_INIT;
    (void)wt_fail(&err, WT_E_RANGE, "%g", 0.5);
    (void)wt_error_format(&err, line, sizeof line);
    assert_string_equal(line, "0.5");
    (void)snprintf(line, sizeof line, "%g", 0.5);
    assert_string_equal(line, "0,5"); /* the locale of the program is unchanged */
    (void)setlocale(LC_ALL, "C");
}

static void paths(void **state)
{
    (void)state;
    static const struct {
        const char *folder, *name, *joined;
    } joins[] = {{"a", "b", "a/b"}, {"a/", "b", "a/b"}, {"a", "/b", "/b"}, {".", "b", "b"},
                 {"", "b", "b"},    {NULL, "b", "b"},   {"/", "b", "/b"},  {"..", "b", "../b"}};
    for (size_t i = 0; i < sizeof joins / sizeof *joins; i++) {
        char *const joined = wt_path_join(joins[i].folder, joins[i].name);
        assert_string_equal(joined, joins[i].joined);
        free(joined);
    }
    static const struct {
        const char *path, *folder, *base;
    } splits[] = {{"a/b", "a", "b"}, {"b", ".", "b"}, {"/b", "/", "b"}, {"/a/b/c", "/a/b", "c"}};
    for (size_t i = 0; i < sizeof splits / sizeof *splits; i++) {
        char *const folder = wt_path_folder(splits[i].path);
        assert_string_equal(folder, splits[i].folder);
        assert_string_equal(wt_path_base(splits[i].path), splits[i].base);
        free(folder);
    }
}

static void nearest_names(void **state)
{
    (void)state;
    static const struct {
        const char *a, *b;
        size_t distance;
    } pairs[] = {{"", "", 0},           {"master", "master", 0}, {"mster", "master", 1},
                 {"quite", "quiet", 1}, {"ab", "ba", 1},         {"kitten", "sitting", 3},
                 {"", "abc", 3},        {"ca", "abc", 3}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const char *const a = pairs[i].a, *const b = pairs[i].b;
        assert_int_equal(spelling_distance(a, strlen(a), b, strlen(b)), pairs[i].distance);
        assert_int_equal(spelling_distance(b, strlen(b), a, strlen(a)), pairs[i].distance);
    }
    char lengthy[64];
    memset(lengthy, 'a', sizeof lengthy);
    assert_int_equal(spelling_distance(lengthy, 63, lengthy, 63), 0);
    assert_true(spelling_distance(lengthy, 64, lengthy, 64) == SIZE_MAX);

    static const char *const names[] = {"indent", "convert", "master", "ramp", "run"};
    static const struct {
        const char *word, *name;
    } words[] = {{"identt", "indent"}, {"mater", "master"}, {"rum", "run"}, {"RUN", "run"},
                 {"ran", "run"},       {"ram", "ramp"},     {"plot", NULL}, {"x", NULL},
                 {"", NULL},           {"rm", NULL}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        spell_suggestion near = spell_suggestion_begin(words[i].word, strlen(words[i].word));
        for (size_t k = 0; k < sizeof names / sizeof *names; k++)
            spell_suggestion_try(&near, names[k], strlen(names[k]));
        if (words[i].name == NULL)
            assert_null(near.name);
        else
            assert_string_equal(near.name, words[i].name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statuses),
        cmocka_unit_test(error_parts),
        cmocka_unit_test(texts_are_cut_at_a_character),
        cmocka_unit_test(utf8),
        cmocka_unit_test(utf8_copies),
        cmocka_unit_test(parse_log),
        cmocka_unit_test(numbers),
        cmocka_unit_test(formatted_numbers),
        cmocka_unit_test(shortest_numbers),
        cmocka_unit_test(foreign_locale),
        cmocka_unit_test(paths),
        cmocka_unit_test(nearest_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
