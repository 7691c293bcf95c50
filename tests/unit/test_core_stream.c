/* The text stream: round trip, and refused texts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "status_name.h"
#include "weartrack/core.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static wt_table *make_table(void)
{
    wt_table *const t = wt_table_new("indentation/bulk", "Curves of the bulk");
    assert_non_null(t);
    assert_int_equal(wt_table_set_key(t, "tip", "sphere:radius=2\xC2\xB5m", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "remark", "two\nlines\tand \\ this", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "nothing", "", NULL), WT_OK);
    assert_int_equal(
        wt_table_set_estimate(t, "wlf_c2", (wt_estimate){51.6, 0.1, (double)NAN, "K"}, NULL),
        WT_OK);
    assert_int_equal(wt_table_add_text_column(t, "file", "name of the file", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus", "Pa", "Young's modulus", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "r_squared", "1", NULL, NULL), WT_OK);
    static const struct {
        const char *text;
        double a, b;
    } rows[] = {{"a.txt", 2.385e6, 0.1},
                {"#odd name\t.txt", -0.0, (double)NAN},
                {"-", (double)INFINITY, 5e-324},
                {"", 1.0 / 3.0, 1.7976931348623157e308},
                {"\x01\x7F raw \xFF byte \xC3\xA9", -(double)INFINITY, 0.30000000000000004}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (i == 2)
            wt_table_new_block(t);
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_text(t, 0, rows[i].text);
        wt_table_set_number(t, 1, rows[i].a);
        wt_table_set_number(t, 2, rows[i].b);
    }
    return t;
}

static char *write_text(const wt_table *t, const wt_provenance *provenance)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_int_equal(wt_stream_write(out, t, provenance, NULL), WT_OK);
    assert_int_equal(fclose(out), 0);
    return text;
}

static wt_status read_text(const char *text, wt_table **t, wt_error *err)
{
    FILE *const in = fmemopen((void *)(uintptr_t)text, strlen(text), "r");
    assert_non_null(in);
    const wt_status status = wt_stream_read(in, "test", t, err);
    (void)fclose(in);
    return status;
}

static void assert_tables_equal(const wt_table *a, const wt_table *b)
{
    assert_string_equal(wt_table_name(a), wt_table_name(b));
    assert_string_equal(wt_table_title(a), wt_table_title(b));
    assert_int_equal(wt_table_n_keys(a), wt_table_n_keys(b));
    for (size_t i = 0; i < wt_table_n_keys(a); i++) {
        const char *const key = wt_table_key_name(a, i);
        assert_string_equal(key, wt_table_key_name(b, i));
        assert_string_equal(wt_table_key(a, key), wt_table_key(b, key));
    }
    assert_int_equal(wt_table_n_columns(a), wt_table_n_columns(b));
    assert_int_equal(wt_table_n_rows(a), wt_table_n_rows(b));
    for (size_t c = 0; c < wt_table_n_columns(a); c++) {
        assert_string_equal(wt_table_column_name(a, c), wt_table_column_name(b, c));
        assert_string_equal(wt_table_column_unit(a, c), wt_table_column_unit(b, c));
        assert_string_equal(wt_table_column_long_name(a, c), wt_table_column_long_name(b, c));
        assert_int_equal(wt_table_column_kind(a, c), wt_table_column_kind(b, c));
        for (size_t r = 0; r < wt_table_n_rows(a); r++) {
            if (wt_table_column_kind(a, c) == WT_COLUMN_TEXT) {
                assert_string_equal(wt_table_text(a, r, c), wt_table_text(b, r, c));
            } else {
                assert_near(wt_table_number(a, r, c), wt_table_number(b, r, c), 0.0);
                assert_int_equal(signbit(wt_table_number(a, r, c)) != 0,
                                 signbit(wt_table_number(b, r, c)) != 0);
            }
            assert_int_equal(wt_table_block(a, r), wt_table_block(b, r));
        }
    }
}

static void round_trip(void **state)
{
    (void)state;
    wt_table *const t = make_table();
    wt_table *read = NULL;
    char *const text = write_text(t, NULL);
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(read_text(text, &read, &err), WT_OK);
    assert_tables_equal(t, read);
    wt_estimate e = {0};
    assert_true(wt_table_estimate(read, "wlf_c2", &e));
    assert_near(e.value, 51.6, 0);
    assert_near(e.standard_error, 0.1, 0);
    assert_near(e.numerical_error, (double)NAN, 0);
    assert_string_equal(e.unit, "K");
    assert_false(wt_table_estimate(read, "tip", &e));
    assert_false(wt_table_estimate(read, "absent", &e));
    wt_table_free(read);
    wt_table_free(t);
    free(text);
}

static void exact_text(void **state)
{
    (void)state;
    wt_table *const t = wt_table_new("friction", "");
    assert_int_equal(wt_table_add_column(t, "velocity", "m/s", "sliding velocity", NULL), WT_OK);
    assert_int_equal(wt_table_add_text_column(t, "note", "", NULL), WT_OK);
    for (int i = 0; i < 2; i++) {
        wt_table_new_block(t);
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_number(t, 0, 0.001 * (i + 1));
    }
    assert_int_equal(wt_table_set_estimate(t, "pressure", (wt_estimate){4e5, 0, 0, "Pa"}, NULL),
                     WT_OK);
    wt_provenance *const p = wt_provenance_new();
    char *const argv[] = {"/opt/x/weartrack", "friction", "it's"};
    wt_provenance_set_command(p, 3, argv);
    wt_provenance_input input = {.path = "my file",
                                 .role = WT_ROLE_DMA,
                                 .format = "dma-text 1",
                                 .bytes = 12,
                                 .sha256 = "ab"};
    wt_provenance_add_input(p, &input);
    char *text = write_text(t, p);
    char expected[1000];
    (void)snprintf(expected, sizeof expected,
                   "## weartrack: %s\n"
                   "## command: weartrack friction 'it'\\\\''s'\n"
                   "## input: my file\tdma\tdma-text 1\t12\tab\n"
                   "## table: friction\n"
                   "## title: -\n"
                   "## pressure: 400000 standard_error=0 numerical_error=0 unit=Pa\n"
                   "## column: velocity\tsliding velocity\n"
                   "# velocity[m/s]\tnote[text]\n"
                   "0.001\t-\n"
                   "\n"
                   "0.002\t-\n"
                   "##\n",
                   wt_version());
    assert_string_equal(text, expected);
    wt_table *read = NULL;
    assert_int_equal(read_text(text, &read, NULL), WT_OK);
    assert_tables_equal(t, read);
    wt_table_free(read);
    wt_table_free(t);
    wt_provenance_free(p);
    free(text);
}

static void several_tables(void **state)
{
    (void)state;
    wt_table *const t = make_table();
    char *const one = write_text(t, NULL);
    char *two = NULL;
    assert_true(asprintf(&two, "\xEF\xBB\xBF%s%s", one, one) > 0);
    FILE *const in = fmemopen(two, strlen(two), "r");
    for (int i = 0; i < 2; i++) {
        wt_table *read = NULL;
        assert_int_equal(wt_stream_read(in, "test", &read, NULL), WT_OK);
        assert_tables_equal(t, read);
        wt_table_free(read);
    }
    wt_table *read = NULL;
    assert_int_equal(wt_stream_read(in, "test", &read, NULL), WT_END);
    assert_null(read);
    (void)fclose(in);
    free(one);
    free(two);
    wt_table_free(t);
}

static void handwritten_stream(void **state)
{
    (void)state;
    wt_table *t = NULL;
    assert_int_equal(read_text("# a[m]\tb[text]\r\n1\tx\r\n\r\n\r\n 2.5e3 \t", &t, NULL), WT_OK);
    assert_string_equal(wt_table_name(t), "table");
    assert_int_equal(wt_table_n_rows(t), 2);
    assert_near(wt_table_number(t, 1, 0), 2500, 0);
    assert_string_equal(wt_table_text(t, 0, 1), "x");
    assert_string_equal(wt_table_text(t, 1, 1), "");
    assert_int_equal(wt_table_block(t, 0), 0);
    assert_int_equal(wt_table_block(t, 1), 1);
    wt_table_free(t);
    t = NULL;
    assert_int_equal(read_text("\n\n##\n", &t, NULL), WT_END);
    assert_null(t);
    assert_int_equal(read_text("# a[m]\n", &t, NULL), WT_OK); /* a table without rows */
    assert_int_equal(wt_table_n_rows(t), 0);
    wt_table_free(t);
}

static void refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *place;
    } cases[] = {
        {"# a[m]\n1\n2x\n", "line 3, column 1 (a)"},
        {"# a[m]\tb[m]\n1\t\n", "line 2, column 2 (b)"},
        {"# a[m]\n1,5\n", "line 2, column 1 (a)"},
        {"# a[m]\tb[m]\n1\n", "line 2"},
        {"# a[m]\tb[m]\n1\t2\t3\n", "line 2"},
        {"# a[m]\tb\n", "line 1, column 2"},
        {"# a[m]\ta[m]\n", "line 1, column 2"},
        {"# a-b[m]\n", "line 1, column 1"},
        {"# a[]\n", "line 1, column 1"},
        {"# \n", "line 1"},
        {"1\t2\n", "line 1"},
        {"## key value\n# a[m]\n", "line 1"},
        {"## key: value\n", "line 1"},
        {"## key: 1\n## key: 2\n# a[m]\n", "line 2"},
        {"## table: Bad Name\n# a[m]\n", "line 1"},
        {"## table: x\n## table: y\n# a[m]\n", "line 2 of table x"},
        {"## block size: 1\n# a[m]\n", "line 1"},
        {"## column: a\n# a[m]\n", "line 1"},
        {"# a[m]\n1\n# 2\n", "line 3"},
        {"# a[text]\nx\\y\n", "line 2, column 1 (a)"},
        {"# a[text]\n\\x00\n", "line 2, column 1 (a)"},
        {"# a[text]\n\\x4", "line 2, column 1 (a)"},
        {"# a[text]\n\xFF\n", "line 2"},
        /* A program that failed midway. */
        {"## table: x\n# a[m]\n1\n", "line 3 of table x"},
        {"## table: x\n", "line 1 of table x"},
        {"## e: 1 standard_error=0 numerical_error=0 unit=1\n## e_units: 1\n# a[m]\n", "line 2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_table *t = NULL;
        wt_error err = WT_ERROR_INIT;
        const wt_status status = read_text(cases[i].text, &t, &err);
        if (status != WT_E_CORRUPT)
            print_error("case %zu: %s\n", i, status_name(status));
        assert_int_equal(status, WT_E_CORRUPT);
        assert_int_equal(err.status, WT_E_CORRUPT);
        assert_null(t);
        assert_string_equal(err.place, cases[i].place);
        assert_string_equal(err.file, "test");
    }
}

static void truncated_and_changed_streams(void **state)
{
    (void)state;
    wt_table *const t = make_table();
    char *const text = write_text(t, NULL);
    const size_t length = strlen(text);
    char *const copy = malloc(length + 1);
    assert_non_null(copy);
    for (size_t cut = 1; cut + 1 < length; cut++) {
        memcpy(copy, text, length);
        copy[cut] = '\0';
        wt_table *read = NULL;
        assert_int_not_equal(read_text(copy, &read, NULL), WT_OK); /* never a partial table */
        assert_null(read);
    }
    for (size_t i = 0; i < length; i++) {
        for (unsigned value = 1; value < 256; value += 7) {
            memcpy(copy, text, length + 1);
            copy[i] = (char)value;
            wt_table *read = NULL;
            if (read_text(copy, &read, NULL) == WT_OK)
                wt_table_free(read);
            else
                assert_null(read);
        }
    }
    free(copy);
    free(text);
    wt_table_free(t);
}

static void full_disk(void **state)
{
    (void)state;
    FILE *const out = fopen("/dev/full", "w");
    if (out == NULL)
        skip();
    (void)setvbuf(out, NULL, _IONBF, 0);
    wt_table *const t = make_table();
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_stream_write(out, t, NULL, &err), WT_E_IO);
    assert_int_equal(err.status, WT_E_IO);
    (void)fclose(out);
    wt_table_free(t);
}

/* A table that could not be read back is not written. */
static void no_table(void **state)
{
    (void)state;
    wt_table *const t = wt_table_new("empty", "without columns");
    assert_non_null(t);
    char *text = NULL;
    size_t size = 0;
    FILE *const out = open_memstream(&text, &size);
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_stream_write(out, t, NULL, &err), WT_E_ARG);
    assert_non_null(strstr(err.message, "table \"empty\" has no columns"));
    assert_int_equal(wt_table_add_column(t, "modulus", "Pa", "a", NULL), WT_OK);
    assert_int_equal(fflush(out), 0);
    assert_int_equal(size, 0);
    assert_int_equal(wt_stream_write(out, t, NULL, NULL), WT_OK);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text, "## table: empty\n## title: without columns\n"
                              "## column: modulus\ta\n# modulus[Pa]\n##\n");
    free(text);
    wt_table_free(t);
}

static void foreign_locale(void **state)
{
    (void)state;
    wt_table *const t = make_table();
    char *const plain = write_text(t, NULL);
    if (setlocale(LC_ALL, "de_DE.UTF-8") != NULL) {
        char *const foreign = write_text(t, NULL);
        assert_string_equal(plain, foreign);
        wt_table *read = NULL;
        assert_int_equal(read_text(foreign, &read, NULL), WT_OK);
        assert_tables_equal(t, read);
        wt_table_free(read);
        free(foreign);
        (void)setlocale(LC_ALL, "C");
    }
    free(plain);
    wt_table_free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),     cmocka_unit_test(exact_text),
        cmocka_unit_test(several_tables), cmocka_unit_test(handwritten_stream),
        cmocka_unit_test(refused),        cmocka_unit_test(truncated_and_changed_streams),
        cmocka_unit_test(full_disk),      cmocka_unit_test(foreign_locale),
        cmocka_unit_test(no_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
