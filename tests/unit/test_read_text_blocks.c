/* Split of a text export into curves and isotherms, and the duration of a segment.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

#include "read/text/text.h"

/* Isotherms separated by two columns: the group, and the curve of a force table. */
static text_description *describe(description_xsd **schema)
{
    static const char xml[] =
        "<format id=\"x\" version=\"1\" kinds=\"force sweep\" verified=\"false\"><title>t</title>"
        "<evidence>e</evidence><detect><names score=\"9\"/></detect><text separator=\"tab\"/>"
        "<table units=\"none\">"
        "<column quantity=\"frequency\" unit=\"Hz\"><name>f</name></column>"
        "<column quantity=\"storage_modulus\" unit=\"Pa\"><name>E'</name></column>"
        "<column quantity=\"loss_modulus\" unit=\"Pa\"><name>E''</name></column>"
        "<column quantity=\"temperature\" unit=\"K\"><name>T</name></column>"
        "<column quantity=\"height\" unit=\"m\"><name>h</name></column>"
        "<column quantity=\"force\" unit=\"N\"><name>F</name></column></table>"
        "<isotherms group=\"run\"/><segments curve=\"part\"/></format>";
    text_description *d = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(description_xsd_new(schema, &err), WT_OK);
    if (description_parse(*schema, xml, strlen(xml), "x.xml", &d, &err) != WT_OK)
        print_message("%s: %s %s %s\n", err.place, err.message, err.expected, err.found);
    assert_non_null(d);
    return d;
}

/* Number of isotherms from two rows of a text that only differ in these cells. */
static size_t isotherms_of(text_description *d, const char *first, const char *second)
{
    const wt_read_options options = wt_read_defaults();
    const file_reader reader = text_reader(d);
    wt_input *input = NULL;
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    char text[512];
    const int n = snprintf(text, sizeof text,
                           "f\tE'\tE''\tT\trun\tpart\n1\t1e6\t1e5\t300\t%s\n2\t2e6\t2e5\t300\t%s\n"
                           "4\t3e6\t2e5\t300\t%s\n8\t4e6\t2e5\t300\t%s\n",
                           first, first, second, second);
    assert_int_equal(wt_input_open_memory(text, (size_t)n, "made-up.txt", &input, NULL), WT_OK);
    if (text_read_sweep(&reader, input, &options, NULL, &sweep, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    const size_t isotherms = sweep.n_isotherms;
    wt_sweep_clear(&sweep);
    wt_input_close(input);
    return isotherms;
}

static void by_cells(void **state)
{
    (void)state;
    description_xsd *schema = NULL;
    text_description *const d = describe(&schema);
    assert_int_equal(isotherms_of(d, "a\tc", "a\tc"), 1);
    assert_int_equal(isotherms_of(d, "a\tc", "b\tc"), 2);
    assert_int_equal(isotherms_of(d, "a\tc", "a\td"), 2);
    assert_int_equal(isotherms_of(d, "a\tc", "c\ta"), 2);
    assert_int_equal(isotherms_of(d, "ab\tc", "a\tbc"), 2); /* the same letters */
    assert_int_equal(isotherms_of(d, "ab\tc", "ba\tc"), 2);
    assert_int_equal(isotherms_of(d, "a\taa", "aa\ta"), 2);
    assert_int_equal(isotherms_of(d, "a1\tc", "a2\tc"), 2);
    description_free(d);
    description_xsd_free(schema);
}

/* Segment 0 of the only curve of a text. */
static wt_segment *read_segment(reading *r, const char *text)
{
    assert_int_equal(wt_input_open_memory(text, strlen(text), "made-up.txt", &r->input, NULL),
                     WT_OK);
    if (wt_force_open(formats, r->input, NULL, r->log, &r->source, &r->err) != WT_OK)
        fail_msg("%s; %s", r->err.message, r->err.found);
    next_curve(r);
    return &r->curve.segments[0];
}

static void duration(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double expected;
    } cases[] = {
        /* Three samples of 2 ms each, though the first is 10 s after the start. */
        {"time (s)\theight (nm)\tforce (nN)\n10.000\t30\t0\n10.002\t20\t1\n10.004\t10\t2\n", 0.006},
        {"time (s)\theight (nm)\tforce (nN)\n1\t30\t0\n5\t20\t1\n", 8},
        {"time (s)\theight (nm)\tforce (nN)\n10\t30\t0\n", (double)NAN},
        {"height (nm)\tforce (nN)\n30\t0\n20\t1\n10\t2\n", (double)NAN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        reading r = {.log = wt_log_new()};
        assert_near(read_segment(&r, cases[i].text)->duration, cases[i].expected, 1e-9);
        close_all(&r);
    }
    /* The header has precedence over the column. */
    reading r = {.log = wt_log_new()};
    const wt_segment *const s = read_segment(
        &r, "## table: force_curve/0\n## title: t\n## column: height\n"
            "# segment[text]\ttime[s]\theight[m]\tforce[N]\n"
            "approach\t1\t3e-8\t0\napproach\t2\t2e-8\t0\napproach\t3\t1e-8\t1e-9\n##\n");
    assert_near(s->duration, 3, 1e-9);
    close_all(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_cells), cmocka_unit_test(duration)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
