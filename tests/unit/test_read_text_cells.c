/* Cells of text lines: each separator, quotes, lines with more cells than first allocated; files
 * and results with as many columns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "table_cells.h"

#include "read/header_values.h"
#include "read/text/text.h"

#include <math.h>

static const text_description plain = {.n_widths = 0};

/* The line has its exact length, so that a sanitizer detects a read beyond it. */
static text_span make_line(size_t n, char mark)
{
    char *text = malloc(8 * n);
    size_t length = 0;
    assert_non_null(text);
    for (size_t i = 0; i < n; i++) {
        if (i > 0)
            text[length++] = mark;
        length += (size_t)snprintf(text + length, 7, "c%zu", i);
    }
    text = realloc(text, length);
    assert_non_null(text);
    return (text_span){text, length};
}

static void test_many_cells(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 31, 32, 33, 63, 64, 65, 128, 129, 256, 257, 1000};
    static const struct {
        cell_separator separator;
        char mark;
    } separators[] = {{SEPARATOR_TAB, '\t'},
                      {SEPARATOR_SEMICOLON, ';'},
                      {SEPARATOR_COMMA, ','},
                      {SEPARATOR_WHITESPACE, ' '}};
    for (size_t s = 0; s < sizeof separators / sizeof *separators; s++)
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
            text_cells cells = {0};
            const text_span line = make_line(counts[k], separators[s].mark);
            for (int twice = 0; twice < 2; twice++) {
                cells_split(&cells, line, separators[s].separator, &plain);
                assert_int_equal(cells.n, counts[k]);
                assert_true(cells.capacity >= cells.n && cells.capacity <= 32 + 2 * cells.n);
                for (size_t i = 0; i < cells.n; i++) {
                    char expected[24];
                    snprintf(expected, sizeof expected, "c%zu", i);
                    assert_true(cell_equals(cells.cells[i], expected));
                }
            }
            cells_free(&cells);
            free((char *)line.text);
        }
}

/* Cells joined with '|'. */
static void splits(const char *line, cell_separator separator, const text_description *d,
                   const char *expected)
{
    text_cells cells = {0};
    char joined[256] = "";
    cells_split(&cells, (text_span){line, strlen(line)}, separator, d);
    for (size_t i = 0; i < cells.n; i++)
        snprintf(joined + strlen(joined), sizeof joined - strlen(joined), "%s%.*s",
                 i > 0 ? "|" : "", (int)cells.cells[i].length, cells.cells[i].text);
    assert_string_equal(joined, expected);
    cells_free(&cells);
}

static void test_separators(void **state)
{
    (void)state;
    size_t widths[] = {3, 2};
    const text_description fixed = {.widths = widths, .n_widths = 2};
    splits("a\t b c \t\td", SEPARATOR_TAB, &plain, "a|b c||d");
    splits("1,5;2;", SEPARATOR_SEMICOLON, &plain, "1,5|2|");
    splits("  a   b\tc ", SEPARATOR_WHITESPACE, &plain, "a|b|c");
    splits("", SEPARATOR_COMMA, &plain, "");
    splits("\"a,b\",c", SEPARATOR_COMMA, &plain, "a,b|c");
    splits("x, \"a,b\" ,c", SEPARATOR_COMMA, &plain, "x|a,b|c");
    splits("x,\"a,b\"", SEPARATOR_COMMA, &plain, "x|a,b");
    splits("E\" [Pa],c", SEPARATOR_COMMA, &plain, "E\" [Pa]|c");
    splits("\"a,b\"c,d", SEPARATOR_COMMA, &plain, "\"a|b\"c|d");
    splits("\" a \",\"\",\"", SEPARATOR_COMMA, &plain, "a||\"");
    splits("abcdefgh", SEPARATOR_FIXED, &fixed, "abc|de|fg|h");
    splits("\xc2\xb0"
           "b\xc2\xb5\xc2\xb5"
           "e",
           SEPARATOR_FIXED, &fixed,
           "\xc2\xb0"
           "b\xc2\xb5|\xc2\xb5"
           "e");
    assert_string_equal(separator_name(SEPARATOR_TAB), "tab");
    assert_string_equal(separator_name(SEPARATOR_FIXED), "fixed columns");
}

static void test_values(void **state)
{
    (void)state;
    char none[] = "-9999", word[] = "off";
    char *missing[] = {none, word};
    const text_description d = {.missing = missing, .n_missing = 2};
    static const struct {
        const char *text;
        char decimal;
        cell_kind kind;
        double value;
    } cases[] = {
        {"1.5", '.', CELL_NUMBER, 1.5},
        {"-1,5e3", ',', CELL_NUMBER, -1500},
        {"9e98", '.', CELL_NUMBER, 9e98},
        {"1e99", '.', CELL_MISSING, (double)NAN},
        {"-1e99", '.', CELL_MISSING, (double)NAN},
        {"-9999", '.', CELL_MISSING, (double)NAN},
        {"-9998", '.', CELL_NUMBER, -9998},
        {"off", '.', CELL_MISSING, (double)NAN},
        {"offs", '.', CELL_TEXT, (double)NAN},
        {"", '.', CELL_MISSING, (double)NAN},
        {"--", '.', CELL_MISSING, (double)NAN},
        {"N/A", '.', CELL_MISSING, (double)NAN},
        {"NaN", '.', CELL_NOT_FINITE, (double)NAN},
        {"-Inf", '.', CELL_NOT_FINITE, (double)NAN},
        {"1.#INF", '.', CELL_NOT_FINITE, (double)NAN},
        {"1.5 x", '.', CELL_TEXT, (double)NAN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 7;
        const text_span cell = {cases[i].text, strlen(cases[i].text)};
        if (cell_parse(cell, cases[i].decimal, &d, &value) != cases[i].kind)
            fail_msg("%s is of another kind", cases[i].text);
        assert_near(value, cases[i].value, 0);
    }
}

static void test_marks(void **state)
{
    (void)state;
    static const char line[] = "1,5;2.5;3.25;1,5e3;a,b;a.b;1.2,3;7";
    text_cells cells = {0};
    size_t commas = 10, points = 20;
    cells_split(&cells, (text_span){line, strlen(line)}, SEPARATOR_SEMICOLON, &plain);
    cells_count_decimal_marks(&cells, &commas, &points);
    assert_int_equal(commas, 12);
    assert_int_equal(points, 22);
    assert_false(cells_are_blank(&cells));
    cells_split(&cells, (text_span){" ; ", 3}, SEPARATOR_SEMICOLON, &plain);
    assert_true(cells_are_blank(&cells));
    char copy[8];
    text_copy(copy, sizeof copy, (text_span){"abcdef\xc2\xb0g", 9});
    assert_string_equal(copy, "abcdef"); /* half of a character is not a character */
    text_copy(copy, sizeof copy, (text_span){"ab", 2});
    assert_string_equal(copy, "ab");
    cells_free(&cells);
}

/* ---- files and results ----------------------------------------------------------------------- */

/* The known columns follow n - 4 unknown ones. */
static void test_wide_files(void **state)
{
    (void)state;
    static const size_t widths[] = {32, 33, 63, 65, 257, 300};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w++) {
        const size_t others = widths[w] - 4;
        wt_input *input = NULL;
        wt_sweep sweep = {0};
        wt_error err = WT_ERROR_INIT;
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        for (size_t i = 0; i < others; i++)
            fprintf(out, "remark %zu\t", i);
        fputs("f [Hz]\tT [degC]\tE' [MPa]\tE'' [MPa]\n", out);
        for (int row = 0; row < 5; row++) {
            for (size_t i = 0; i < others; i++)
                fprintf(out, "%zu\t", i);
            fprintf(out, "%d\t20\t%d\t%d\n", 1 + row, 10 + row, 5 + row);
        }
        assert_int_equal(fclose(out), 0);
        assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
        if (wt_sweep_read(formats, input, NULL, NULL, &sweep, &err) != WT_OK)
            fail_msg("%zu columns: %s", widths[w], err.message);
        assert_int_equal(sweep.n_isotherms, 1);
        assert_int_equal(sweep.isotherms[0].n, 5);
        assert_near(sweep.isotherms[0].temperature, 293.15, 1e-12);
        for (int row = 0; row < 5; row++) {
            assert_near(sweep.isotherms[0].angular_frequency[row], 2 * M_PI * (1 + row), 1e-12);
            assert_near(sweep.isotherms[0].storage_modulus[row], 1e6 * (10 + row), 1e-12);
            assert_near(sweep.isotherms[0].loss_modulus[row], 1e6 * (5 + row), 1e-12);
        }
        wt_sweep_clear(&sweep);
        wt_input_close(input);
    }
}

static double wide_value(size_t row, size_t column)
{
    return (double)(1000 * row + column) / 7;
}

/* Every third column is text. */
static wt_table *wide_table(size_t n)
{
    wt_table *t = wt_table_new("wide", "many columns");
    assert_non_null(t);
    for (size_t c = 0; c < n; c++) {
        char name[24];
        snprintf(name, sizeof name, "c%zu", c);
        assert_int_equal(c % 3 == 2 ? wt_table_add_text_column(t, name, "words", NULL)
                                    : wt_table_add_column(t, name, "m", "a number", NULL),
                         WT_OK);
    }
    for (size_t r = 0; r < 3; r++) {
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        for (size_t c = 0; c < n; c++) {
            char text[24];
            snprintf(text, sizeof text, "t%zu-%zu", r, c);
            if (c % 3 == 2)
                wt_table_set_text(t, c, text);
            else
                wt_table_set_number(t, c, wide_value(r, c));
        }
    }
    return t;
}

static void check_wide(const wt_table *t, size_t n)
{
    assert_non_null(t);
    assert_int_equal(wt_table_n_columns(t), n);
    assert_int_equal(wt_table_n_rows(t), 3);
    for (size_t r = 0; r < 3; r++)
        for (size_t c = 0; c < n; c++) {
            char text[24];
            snprintf(text, sizeof text, "c%zu", c);
            assert_int_equal(cell_column(t, text), c);
            snprintf(text, sizeof text, "t%zu-%zu", r, c);
            if (c % 3 == 2)
                assert_string_equal(wt_table_text(t, r, c), text);
            else
                assert_near(wt_table_number(t, r, c), wide_value(r, c), 0);
        }
}

static void test_wide_results(void **state)
{
    (void)state;
    static const size_t widths[] = {33, 63, 257, 600};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w++) {
        wt_table *t = wide_table(widths[w]), *back = NULL;
        check_wide(t, widths[w]);
        FILE *stream = tmpfile();
        assert_non_null(stream);
        assert_int_equal(wt_stream_write(stream, t, NULL, NULL), WT_OK);
        rewind(stream);
        assert_int_equal(wt_stream_read(stream, "wide", &back, NULL), WT_OK);
        check_wide(back, widths[w]);
        fclose(stream);
        wt_table_free(back);
        wt_result *result = wt_result_new(), *stored = NULL;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
        if (wt_store_write(path, result, false, &err) != WT_OK ||
            wt_store_read(path, &stored, &err) != WT_OK)
            fail_msg("%s", err.message);
        check_wide(wt_result_find(stored, "wide"), widths[w]);
        wt_result_free(stored);
        wt_result_free(result);
    }
}

/* Numbers of headers and their errors, before and after the unit. */
static void test_header_errors(void **state)
{
    static const struct {
        const char *text;
        double value, error;
        bool is_named;
    } rows[] = {{"0.12 +- 0.01 N/m", 0.12, 0.01, true},
                {"0,12+/-0,01 N/m", 0.12, 0.01, true},
                {" 0.12\u00b10.01", 0.12, 0.01, true},
                {"0.12 N/m \u00b1 0.01 N/m", 0.12, (double)NAN, true},
                {"0.12 N/m", 0.12, (double)NAN, false},
                {"0.12 +- N/m", 0.12, (double)NAN, false},
                {"0.12 +- -0.01 N/m", 0.12, (double)NAN, false},
                {"0.12 -0.01", (double)NAN, (double)NAN, false}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *const text = rows[i].text;
        const size_t n = strlen(text);
        wt_log *const log = wt_log_new();
        double value, error;
        size_t end;
        const header_number found = header_number_read(text, n, &value, &end);
        (void)header_number_error(text + end, n - end, &error);
        header_number_warn(found, text, n, "k", "--spring-constant", "f", "line 1", log);
        assert_true(value == rows[i].value || (isnan(value) && isnan(rows[i].value)));
        assert_true(error == rows[i].error || (isnan(error) && isnan(rows[i].error)));
        if (found == HEADER_NUMBER_ONE)
            assert_int_equal(wt_log_count(log), rows[i].is_named);
        if (rows[i].is_named)
            assert_non_null(strstr(wt_log_get(log, 0).text, "--spring-constant-error 0.0833"));
        wt_log_free(log);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many_cells),    cmocka_unit_test(test_separators),
        cmocka_unit_test(test_values),        cmocka_unit_test(test_marks),
        cmocka_unit_test(test_wide_files),    cmocka_unit_test(test_wide_results),
        cmocka_unit_test(test_header_errors),
    };
    return cmocka_run_group_tests_name("cells of text", tests, set_up, clean);
}
