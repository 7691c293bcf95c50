/* The engine of format descriptions: encodings, line ends, decimal marks, corrupted rows, and the
 * split of a sweep into isotherms. The texts are written here, so that the truth is known.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "read/text/text.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static description_xsd *schema;
static wt_formats *formats;

/* Description of a sweep from the attributes of its parts. */
static text_description *describe_as(const char *text, const char *header, const char *table,
                                     const char *inside, const char *after)
{
    char xml[4096];
    wt_error err = WT_ERROR_INIT;
    text_description *d = NULL;
    int n = snprintf(
        xml, sizeof xml,
        "<format id=\"x\" version=\"1\" kinds=\"sweep\" verified=\"false\"><title>t</title>"
        "<evidence>e</evidence><detect><names score=\"9\"/></detect><text %s/>%s<table %s>%s"
        "<column quantity=\"frequency\"><name>f</name></column>"
        "<column quantity=\"angular_frequency\"><name>w</name></column>"
        "<column quantity=\"storage_modulus\"><name>E'</name></column>"
        "<column quantity=\"loss_modulus\"><name>E''</name></column>"
        "<column quantity=\"shear_storage_modulus\"><name>G'</name></column>"
        "<column quantity=\"shear_loss_modulus\"><name>G''</name></column>"
        "<column quantity=\"storage_modulus\" with=\"pull\"><name>M'</name></column>"
        "<column quantity=\"loss_modulus\" with=\"pull\"><name>M''</name></column>"
        "<column quantity=\"temperature\"><name>T</name></column></table>%s</format>",
        text, header, table, inside, after);
    assert_true(n > 0 && (size_t)n < sizeof xml);
    if (description_parse(schema, xml, (size_t)n, "x.xml", &d, &err) != WT_OK)
        print_message("%s: %s %s %s\n", err.place, err.message, err.expected, err.found);
    assert_non_null(d);
    return d;
}

static wt_status read_bytes(text_description *d, const void *bytes, size_t n, wt_sweep *sweep,
                            wt_log *log, wt_error *err)
{
    const wt_read_options options = wt_read_defaults();
    const file_reader reader = text_reader(d);
    wt_input *input = NULL;
    assert_int_equal(wt_input_open_memory(bytes, n, "made-up.txt", &input, err), WT_OK);
    wt_status status = text_read_sweep(&reader, input, &options, log, sweep, err);
    wt_input_close(input);
    return status;
}

static wt_status read_text(text_description *d, const char *text, wt_sweep *sweep, wt_log *log,
                           wt_error *err)
{
    return read_bytes(d, text, strlen(text), sweep, log, err);
}

static bool logged(const wt_log *log, const char *text)
{
    for (size_t i = 0; i < wt_log_count(log); i++)
        if (strstr(wt_log_get(log, i).text, text) != NULL)
            return true;
    return false;
}

/* ---- bytes -------------------------------------------------------------------------------- */

/* U+00B0 as one byte; converted below. */
static const char latin[] = "f\tE'\tE''\tT\nHz\tMPa\tMPa\t\xb0"
                            "C\n2\t3\t4\t20\n20\t5\t6\t20\n";

static size_t as_utf_16(const char *text, bool big, bool mark, char *out)
{
    size_t n = 0;
    if (mark) {
        out[n++] = big ? '\xfe' : '\xff';
        out[n++] = big ? '\xff' : '\xfe';
    }
    for (const char *c = text; *c != '\0'; c++) {
        out[n++] = big ? '\0' : *c;
        out[n++] = big ? *c : '\0';
    }
    return n;
}

static size_t with_line_end(const char *text, const char *end, char *out)
{
    size_t n = 0;
    for (const char *c = text; *c != '\0'; c++) {
        if (*c != '\n')
            out[n++] = *c;
        else
            for (const char *e = end; *e != '\0'; e++)
                out[n++] = *e;
    }
    return n;
}

static void check_small(text_description *d, const char *bytes, size_t n)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_status status = read_bytes(d, bytes, n, &sweep, NULL, &err);
    if (status != WT_OK)
        print_message("%s %s: %s; %s\n", err.message, err.place, err.expected, err.found);
    assert_int_equal(status, WT_OK);
    assert_int_equal(sweep.n_isotherms, 1);
    assert_int_equal(sweep.isotherms[0].n, 2);
    assert_near(sweep.isotherms[0].temperature, 293.15, 1e-15);
    assert_near(sweep.isotherms[0].angular_frequency[0], 12.566370614359172, 1e-15);
    assert_near(sweep.isotherms[0].storage_modulus[1], 5e6, 1e-15);
    assert_near(sweep.isotherms[0].loss_modulus[0], 4e6, 1e-15);
    wt_sweep_clear(&sweep);
}

static void encodings(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    char out[512], utf8[512];
    (void)state;
    check_small(d, latin, sizeof latin - 1);
    for (int big = 0; big < 2; big++)
        for (int mark = 0; mark < 2; mark++) {
            size_t n = as_utf_16(latin, big != 0, mark != 0, out);
            check_small(d, out, n);
            out[n] = '\n'; /* half a character */
            check_small(d, out, n + 1);
        }
    size_t n = 0;
    memcpy(utf8, "\xef\xbb\xbf", 3);
    for (const char *c = latin; *c != '\0'; c++) {
        if (*c == '\xb0')
            utf8[3 + n++] = '\xc2';
        utf8[3 + n++] = *c;
    }
    check_small(d, utf8, n + 3);
    check_small(d, utf8 + 3, n);
    description_free(d);
}

static void line_ends(void **state)
{
    static const char *const ends[] = {"\n", "\r\n", "\r", "\r\r\n", "\n\n"};
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    char out[512];
    (void)state;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        check_small(d, out, with_line_end(latin, ends[i], out));
    check_small(d, latin, sizeof latin - 2); /* no line end at the end */
    description_free(d);
}

static void separators_and_decimal_marks(void **state)
{
    static const char *const texts[] = {
        "f,E',E'',T\nHz,MPa,MPa,degC\n2,3,4,20\n20,5,6,20\n",
        "f;E';E'';T\nHz;MPa;MPa;degC\n2,0;3,0;4,0;20,0\n2,0E1;5,0;6,0;20,0\n",
        "f\tE'\tE''\tT\nHz\tMPa\tMPa\tdegC\n2,0\t3\t4\t20\n20\t5\t6\t20\n",
        "f E' E'' T\nHz MPa MPa degC\n 2.0   3 4    20\n\t20 5 6 20\n",
        "\"f\",\"E'\",\"E''\",\"T\"\nHz,MPa,\"MPa\",degC\n\"2\",3,\"4\",20\n20,5,6,20\n",
        "f;E';E\";T\nHz;MPa;MPa;degC\n\"2,0\";3;4;20\n20;5;6;20\n",
    };
    text_description *d = describe_as("", "", "", "", "");
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_small(d, texts[i], strlen(texts[i]));
    description_free(d);
}

static void declared_by_the_file(void **state)
{
    /* Integers with commas look like decimals; the file states which they are. */
    static const char text[] = "#DECIMAL:COMMA\n#SEPARATOR:SEMICOLON\n"
                               "f;E';E'';T\nHz;MPa;MPa;degC\n2,0;3;4;20\n20;5;6;20\n";
    text_description *d =
        describe_as("",
                    "<header><field name=\"d\" regex=\"^#DECIMAL: *([A-Z]+)\" sets=\"decimal\"/>"
                    "<field name=\"s\" regex=\"^#SEPARATOR: *([A-Z]+)\" sets=\"separator\"/>"
                    "</header>",
                    "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    check_small(d, text, sizeof text - 1);
    static const char wrong[] = "#DECIMAL:POINT\nf;E';E'';T\nHz;MPa;MPa;degC\n2,0;3;4;20\n";
    assert_int_equal(read_text(d, wrong, &sweep, NULL, &err), WT_E_CORRUPT);
    assert_non_null(strstr(err.expected, "decimal point"));
    static const char point[] = "#DECIMAL:COMMA\nf;E';E'';T\nHz;MPa;MPa;degC\n2.0;3;4;20\n";
    assert_int_equal(read_text(d, point, &sweep, NULL, &err), WT_E_CORRUPT);
    assert_non_null(strstr(err.expected, "decimal comma"));
    description_free(d);
}

static void fixed_columns(void **state)
{
    /* The degree sign is one character of two bytes; the third cell of the first row is empty. */
    static const char text[] = "   f  E' E''   T\n  Hz MPa MPa  \xc2\xb0"
                               "C\n"
                               "   1   3      20\n   2   3   4  20\n  20   5   6  20\n";
    text_description *d = describe_as("separator=\"fixed\" widths=\"4\"", "", "", "", "");
    (void)state;
    check_small(d, text, sizeof text - 1);
    description_free(d);
}

/* ---- rows --------------------------------------------------------------------------------- */

static const char head[] = "f\tE'\tE''\tT\nHz\tMPa\tMPa\tdegC\n";

static wt_status read_rows(text_description *d, const char *rows, wt_sweep *sweep, wt_log *log,
                           wt_error *err)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s", head, rows);
    return read_text(d, text, sweep, log, err);
}

static void damaged_rows(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(read_rows(d, "1\t2\t3\t20\n10\t2x\t3\t20\n", &sweep, NULL, &err),
                     WT_E_CORRUPT);
    assert_string_equal(err.file, "made-up.txt");
    assert_string_equal(err.place, "line 4, column 2 (E')");
    assert_non_null(strstr(err.found, "2x"));
    /* Also after a blank line the rest of the table is read. */
    assert_int_equal(
        read_rows(d, "1\t2\t3\t20\n\n10\t2\t3x\t20\n20\t2\t3\t20\n", &sweep, NULL, &err),
        WT_E_CORRUPT);
    assert_string_equal(err.place, "line 5, column 3 (E'')");
    assert_int_equal(read_rows(d, "1\t2\t3\t20\nend of data\n5\t2\t3\t20\n", &sweep, NULL, &err),
                     WT_E_CORRUPT);
    assert_int_equal(sweep.n_isotherms, 0);
    description_free(d);
}

/* The line number distinguishes isotherms of a file, so that a long name is shortened. */
static void source_of_a_long_name(void **state)
{
    static const char text[] = "f\tE'\tE''\tT\nHz\tMPa\tMPa\tdegC\n1\t2\t3\t20\n10\t2\t3\t20\n";
    const wt_read_options options = wt_read_defaults();
    char name[200];
    wt_sweep sweep = {.n_isotherms = 0};
    wt_input *input = NULL;
    (void)state;
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    const file_reader reader = text_reader(d);
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_int_equal(wt_input_open_memory(text, sizeof text - 1, name, &input, NULL), WT_OK);
    assert_int_equal(text_read_sweep(&reader, input, &options, NULL, &sweep, NULL), WT_OK);
    const char *source = sweep.isotherms[0].source;
    const size_t named = strspn(source, "n");
    assert_string_equal(source + named, ", line 1");
    assert_true(named > sizeof sweep.isotherms[0].source - 24);
    assert_true(strlen(source) < sizeof sweep.isotherms[0].source);
    wt_input_close(input);
    wt_sweep_clear(&sweep);
    description_free(d);
}

static void text_after_the_table(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    (void)state;
    assert_int_equal(
        read_rows(d, "1\t2\t3\t20\n10\t2\t3\t20\n\nRemarks: none\n", &sweep, log, &err), WT_OK);
    assert_false(logged(log, "after the end"));
    assert_int_equal(
        read_rows(d, "1\t2\t3\t20\n10\t2\t3\t20\n\nRemarks\n30\t2\t3\t20\n", &sweep, log, &err),
        WT_OK);
    assert_true(logged(log, "after the end"));
    wt_sweep_clear(&sweep);
    wt_log_free(log);
    description_free(d);
    d = describe_as("separator=\"tab\"", "", "", "<end regex=\"^end\"/>", "");
    assert_int_equal(read_rows(d, "1\t2\t3\t20\n10\t2\t3\t20\nend of data\n", &sweep, NULL, &err),
                     WT_OK);
    wt_sweep_clear(&sweep);
    description_free(d);
}

static void missing_values(void **state)
{
    static const char *const rows[] = {
        "\t3\t4\t20", "--\t3\t4\t20", "2\tNaN\t4\t20", "2\t1.0E+99\t4\t20",
        "2\t3",       "0\t3\t4\t20",  "-2\t3\t4\t20",  "2\toverload\t4\t20"};
    text_description *d =
        describe_as("separator=\"tab\" missing=\"overload none\"", "", "", "", "");
    wt_error err = WT_ERROR_INIT;
    char text[256];
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        wt_sweep sweep = {.n_isotherms = 0};
        wt_log *log = wt_log_new();
        snprintf(text, sizeof text, "1\t2\t3\t20\n%s\n10\t2\t3\t20\textra\n", rows[i]);
        assert_int_equal(read_rows(d, text, &sweep, log, &err), WT_OK);
        assert_int_equal(sweep.isotherms[0].n, 2);
        assert_true(logged(log, "1 rows without"));
        wt_sweep_clear(&sweep);
        wt_log_free(log);
    }
    description_free(d);
}

static void unusual_moduli_are_returned(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(read_rows(d, "1\t0\t-3\t20\n10\t2\t3\t20\n", &sweep, NULL, &err), WT_OK);
    assert_near(sweep.isotherms[0].loss_modulus[0], -3e6, 1e-15);
    assert_near_abs(sweep.isotherms[0].storage_modulus[0], 0, 0);
    wt_sweep_clear(&sweep);
    assert_int_equal(read_rows(d, "1\t1\t3\t-280\n10\t2\t3\t-280\n", &sweep, NULL, &err),
                     WT_E_RANGE);
    description_free(d);
}

/* ---- isotherms ---------------------------------------------------------------------------- */

static void check_split(text_description *d, const char *rows, size_t expected, const char *note)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    wt_status status = read_rows(d, rows, &sweep, log, &err);
    assert_int_equal(status, expected > 0 ? WT_OK : WT_E_EMPTY);
    assert_int_equal(sweep.n_isotherms, expected);
    for (size_t i = 0; i < sweep.n_isotherms; i++)
        for (size_t k = 1; k < sweep.isotherms[i].n; k++)
            assert_true(sweep.isotherms[i].angular_frequency[k] >=
                        sweep.isotherms[i].angular_frequency[k - 1]);
    if (note != NULL)
        assert_true(logged(log, note));
    wt_sweep_clear(&sweep);
    wt_log_free(log);
}

static void split_into_isotherms(void **state)
{
    text_description *plain = describe_as("separator=\"tab\"", "", "", "", "");
    text_description *jump =
        describe_as("separator=\"tab\"", "", "", "", "<isotherms temperature-jump=\"3 K\"/>");
    text_description *block = describe_as("separator=\"tab\"", "", "blank=\"block\"", "", "");
    (void)state;
    /* increasing saw-tooth, decreasing saw-tooth, both directions */
    check_split(plain, "1\t2\t3\t20\n10\t2\t3\t20\n1\t2\t3\t25\n10\t2\t3\t25\n", 2, NULL);
    check_split(plain, "10\t2\t3\t20\n1\t2\t3\t20\n10\t2\t3\t20\n1\t2\t3\t20\n", 2, NULL);
    check_split(plain, "1\t2\t3\t20\n10\t2\t3\t20\n5\t2\t3\t20\n1\t2\t3\t20\n", 2, NULL);
    /* the set frequency jitters, the temperature drifts */
    check_split(jump, "1\t2\t3\t20\n1.002\t2\t3\t21\n1.001\t2\t3\t22\n10\t2\t3\t23\n", 1, NULL);
    /* frequencies continue over two temperatures */
    check_split(jump, "1\t2\t3\t20\n2\t2\t3\t20\n5\t2\t3\t30\n10\t2\t3\t30\n", 2, NULL);
    check_split(plain, "1\t2\t3\t20\n2\t2\t3\t20\n\n5\t2\t3\t30\n10\t2\t3\t30\n", 1, NULL);
    check_split(block, "1\t2\t3\t20\n2\t2\t3\t20\n\n5\t2\t3\t30\n10\t2\t3\t30\n", 2, NULL);
    /* one frequency, temperature ramp */
    check_split(jump, "1\t2\t3\t20\n1\t2\t3\t21\n1\t2\t3\t30\n", 0, "one frequency");
    description_free(plain);
    description_free(jump);
    description_free(block);
}

/* The temperature is the mean of the points, its spread their standard deviation. */
static void temperature_of_points(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    (void)state;
    assert_int_equal(read_rows(d, "1\t2\t3\t20\n2\t2\t3\t21\n4\t2\t3\t25\n", &sweep, NULL, NULL),
                     WT_OK);
    assert_near(sweep.isotherms[0].temperature, 273.15 + 22, 1e-14);
    assert_near(sweep.isotherms[0].temperature_spread, sqrt(7), 1e-12);
    wt_sweep_clear(&sweep);
    assert_int_equal(read_rows(d, "1\t2\t3\t20\n2\t2\t3\t\n", &sweep, NULL, NULL), WT_OK);
    assert_near(sweep.isotherms[0].temperature_spread, (double)NAN, 0);
    wt_sweep_clear(&sweep);
    description_free(d);
}

static void tension_and_shear(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(read_rows(d, "1\t2\t3\t20\n10\t2\t3\t20\n", &sweep, NULL, &err), WT_OK);
    assert_int_equal(read_text(d, "w\tG'\tG''\tT\nrad/s\tPa\tPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_E_UNIT);
    assert_int_equal(sweep.n_isotherms, 1);
    wt_sweep_clear(&sweep);
    assert_int_equal(read_text(d, "w\tG'\tG''\tT\nrad/s\tPa\tPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_OK);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    assert_near(sweep.isotherms[0].angular_frequency[1], 10, 1e-15);
    wt_sweep_clear(&sweep);
    description_free(d);
}

static void nothing_is_guessed(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    /* the unit of a modulus, Hz or rad/s, the kind of modulus, the temperature */
    assert_int_equal(read_text(d, "f\tE'\tE''\tT\nHz\t\tMPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_E_UNIT);
    assert_string_equal(
        err.advice,
        "give it with --units \"E'=UNIT\", as the instrument exports it (E' in MPa or Pa?)");
    assert_string_equal(err.place, "line 1, column 2");
    assert_int_equal(read_text(d, "f\tE'\tE''\tT\nrad/s\tPa\tPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_E_UNIT);
    assert_string_equal(err.found, "\"rad/s\"");
    assert_int_equal(read_text(d, "f\tM'\tM''\tT\nHz\tPa\tPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_E_MISSING);
    assert_non_null(strstr(err.expected, "pull"));
    assert_int_equal(
        read_text(d, "f\tE'\tE''\nHz\tPa\tPa\n1\t2\t3\n10\t2\t3\n", &sweep, NULL, &err),
        WT_E_MISSING);
    assert_non_null(strstr(err.advice, "--temperature"));
    assert_int_equal(read_text(d, "f\tE'\tE''\tT\nHz\tPa\tPa\t\n1\t2\t3\t20\n10\t2\t3\t20\n",
                               &sweep, NULL, &err),
                     WT_E_UNIT);
    assert_string_equal(
        err.advice,
        "give it with --units \"T=UNIT\", as the instrument exports it (T in degC or K?)");
    assert_int_equal(read_text(d,
                               "pull\tf\tM'\tM''\tT\nN\tHz\tPa\tPa\tK\n0\t1\t2\t3\t300\n"
                               "0\t10\t2\t3\t300\n",
                               &sweep, NULL, &err),
                     WT_OK);
    assert_int_equal(sweep.deformation, WT_TENSION);
    wt_sweep_clear(&sweep);
    description_free(d);
}

static void given_units(void **state)
{
    static const char text[] = "f\tE'\tE''\tT\nHz\t\tMPa\tK\n1\t2\t3\t300\n10\t2\t3\t300\n";
    static const char *const units[] = {"e\xe2\x80\xb2=kPa", "E\"=GPa", "D'=MPa"};
    static const char *const bad[] = {"MPa"};
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    const file_reader reader = text_reader(d);
    wt_read_options options = wt_read_defaults();
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    wt_input *input = NULL;
    (void)state;
    assert_int_equal(wt_input_open_memory(text, sizeof text - 1, "x", &input, &err), WT_OK);
    options.units = units;
    options.n_units = 3;
    assert_int_equal(text_read_sweep(&reader, input, &options, log, &sweep, &err), WT_OK);
    assert_near(sweep.isotherms[0].storage_modulus[0], 2e3, 1e-15);
    /* the value of the file has precedence */
    assert_near(sweep.isotherms[0].loss_modulus[0], 3e6, 1e-15);
    assert_true(
        logged(log, "is in \"MPa\", as the file or its format says; the unit given, \"GPa\""));
    assert_true(logged(log, "\"D'\", but there is no such column"));
    assert_false(logged(log, "\"E\"\", but there is no such column"));
    wt_sweep_clear(&sweep);
    options.units = bad;
    options.n_units = 1;
    assert_int_equal(text_read_sweep(&reader, input, &options, log, &sweep, &err), WT_E_ARG);
    wt_input_close(input);
    wt_log_free(log);
    description_free(d);
}

static void unknown_columns_are_named(void **state)
{
    text_description *d = describe_as("separator=\"tab\"", "", "", "", "");
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    (void)state;
    assert_int_equal(read_text(d,
                               "f\tE'\tE''\tT\tcolour\tT\nHz\tPa\tPa\tK\t\tK\n"
                               "1\t2\t3\t300\tred\t7\n10\t2\t3\t300\tblue\t7\n",
                               &sweep, log, &err),
                     WT_OK);
    assert_true(logged(log, "columns not used: colour"));
    assert_true(logged(log, "two columns of temperature differ by 293.0 K"));
    assert_near(sweep.isotherms[0].temperature, 300, 1e-15);
    wt_sweep_clear(&sweep);
    wt_log_free(log);
    description_free(d);
}

/* ---- detection ---------------------------------------------------------------------------- */

static wt_status detect_text(const char *text, size_t n, unsigned kinds, const char **id,
                             wt_error *err)
{
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    assert_int_equal(wt_input_open_memory(text, n, "made-up", &input, err), WT_OK);
    wt_status status = wt_format_detect(formats, input, NULL, kinds, &info, err);
    *id = status == WT_OK ? info->id : "";
    wt_input_close(input);
    return status;
}

static void detection(void **state)
{
    static const char words[] = "Dear reader,\nthis is a letter and no table at all.\n";
    static const char binary[] = "f\tE'\tE''\n\1\2\3\4\5\6\7\1\2\3\4\5\6\7\1\2\3\4\5\6\7";
    const char *id = NULL;
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(detect_text(words, sizeof words - 1, 0, &id, &err), WT_E_FORMAT);
    assert_int_equal(detect_text(binary, sizeof binary - 1, 0, &id, &err), WT_E_FORMAT);
    assert_int_equal(detect_text("", 0, 0, &id, &err), WT_E_UNSUPPORTED);
    assert_int_equal(detect_text(head, sizeof head - 1, 0, &id, &err), WT_OK);
    assert_string_equal(id, "table-units");
    /* the last line counts without a line end */
    static const char last[] = "proceduresegments\tFrequency sweep\n[step]";
    assert_int_equal(detect_text(last, sizeof last - 1, 0, &id, &err), WT_OK);
    assert_string_equal(id, "trios-text");
    assert_int_equal(detect_text(head, sizeof head - 1, WT_KIND_FORCE, &id, &err), WT_E_EMPTY);
    /* A marker far down: the detector requests more of the file. */
    const size_t n = 40000;
    char *deep = calloc(n + 200, 1);
    assert_non_null(deep);
    size_t used = (size_t)sprintf(deep, "proceduresegments\tFrequency sweep\n");
    while (used < n)
        used += (size_t)sprintf(deep + used, "Key number %zu\tvalue\n", used);
    used += (size_t)sprintf(deep + used, "[step]\nFrequency sweep - 1\n");
    assert_int_equal(detect_text(deep, used, 0, &id, &err), WT_OK);
    assert_string_equal(id, "trios-text");
    free(deep);
}

/* SQLite, which parses the JSON, was not used before in this process and can still be
 * configured. */
static void json_in_the_sandbox(void **state)
{
    wt_input *input = NULL;
    wt_sweep sweep = {0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(wt_input_open(WT_SOURCE_DIR "/fixtures/formats/trios-json/two-isotherms.json",
                                   &input, &err),
                     WT_OK);
    assert_int_equal(wt_sweep_read(formats, input, NULL, NULL, &sweep, &err), WT_OK);
    assert_int_equal(sweep.n_isotherms, 2);
    assert_int_equal(sqlite3_config(SQLITE_CONFIG_URI, 0), SQLITE_OK);
    assert_int_equal(sqlite3_initialize(), SQLITE_OK);
    assert_int_equal(sqlite3_config(SQLITE_CONFIG_URI, 0), SQLITE_MISUSE);
    wt_sweep_clear(&sweep);
    wt_input_close(input);
}

/* The program reads its own output: the same bits. */
static void own_stream(void **state)
{
    static const double kelvin[] = {253.15, 293.15}, omega[] = {0.1, 1. / 3, 2e7};
    wt_table *t = wt_table_new("sweep", "isotherms");
    wt_error err = WT_ERROR_INIT;
    char *text = NULL;
    size_t n = 0;
    wt_input *input = NULL;
    wt_sweep sweep = {.n_isotherms = 0};
    const wt_quantity columns[] = {WT_Q_TEMPERATURE, WT_Q_ANGULAR_FREQUENCY,
                                   WT_Q_SHEAR_STORAGE_MODULUS, WT_Q_SHEAR_LOSS_MODULUS};
    (void)state;
    for (size_t c = 0; c < 4; c++)
        assert_int_equal(wt_table_add_column(t, wt_quantity_id(columns[c]),
                                             wt_quantity_unit(columns[c]), "", &err),
                         WT_OK);
    for (size_t i = 0; i < 6; i++) {
        if (i == 3)
            wt_table_new_block(t);
        assert_int_equal(wt_table_add_row(t, &err), WT_OK);
        const double row[] = {kelvin[i / 3], omega[i % 3], 1e6 / (double)(i + 3), 1e5};
        for (size_t c = 0; c < 4; c++)
            wt_table_set_number(t, c, row[c]);
    }
    FILE *out = open_memstream(&text, &n);
    assert_non_null(out);
    assert_int_equal(wt_stream_write(out, t, NULL, &err), WT_OK);
    assert_int_equal(fclose(out), 0);
    assert_int_equal(wt_input_open_memory(text, n, "-", &input, &err), WT_OK);
    assert_int_equal(wt_sweep_read(formats, input, NULL, NULL, &sweep, &err), WT_OK);
    assert_int_equal(sweep.n_isotherms, 2);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    for (size_t i = 0; i < 6; i++) {
        const wt_isotherm *s = &sweep.isotherms[i / 3];
        assert_near(s->temperature, kelvin[i / 3], 1e-15);
        assert_near_abs(s->angular_frequency[i % 3], omega[i % 3], 0);
        assert_near_abs(s->storage_modulus[i % 3], 1e6 / (double)(i + 3), 0);
    }
    wt_sweep_clear(&sweep);
    wt_input_close(input);
    free(text);
    wt_table_free(t);
}

/* Twice the file takes about twice the time, not four times; the bound only detects the latter. */
static void long_files(void **state)
{
    text_description *d = describe_as("", "", "", "<step regex=\"^Step (.*)$\"/>", "");
    const size_t rows = 200000;
    char *text = malloc(rows * 32);
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "%s", head);
    for (size_t i = 0; i < rows; i++)
        used += (size_t)sprintf(text + used, "%.2f\t2.5\t3.5\t%zu\n", 1.0 + (double)(i % 100),
                                i / 100 % 99);
    const double start = wt_time_cpu();
    assert_int_equal(read_bytes(d, text, used, &sweep, NULL, &err), WT_OK);
    assert_int_equal(sweep.n_isotherms, rows / 100);
    assert_true(wt_time_cpu() - start < 20);
    wt_sweep_clear(&sweep);
    free(text);
    description_free(d);
}

static int setup(void **state)
{
    (void)state;
    return description_xsd_new(&schema, NULL) == WT_OK &&
                   wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK
               ? 0
               : -1;
}

static int teardown(void **state)
{
    (void)state;
    description_xsd_free(schema);
    wt_formats_free(formats);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encodings),
        cmocka_unit_test(line_ends),
        cmocka_unit_test(separators_and_decimal_marks),
        cmocka_unit_test(declared_by_the_file),
        cmocka_unit_test(fixed_columns),
        cmocka_unit_test(damaged_rows),
        cmocka_unit_test(text_after_the_table),
        cmocka_unit_test(missing_values),
        cmocka_unit_test(unusual_moduli_are_returned),
        cmocka_unit_test(split_into_isotherms),
        cmocka_unit_test(temperature_of_points),
        cmocka_unit_test(tension_and_shear),
        cmocka_unit_test(nothing_is_guessed),
        cmocka_unit_test(given_units),
        cmocka_unit_test(unknown_columns_are_named),
        cmocka_unit_test(detection),
        cmocka_unit_test(source_of_a_long_name),
        cmocka_unit_test(json_in_the_sandbox),
        cmocka_unit_test(own_stream),
        cmocka_unit_test(long_files),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
