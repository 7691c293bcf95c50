/* Texts of a report: numbers for reading, lab units, pictures for a page, axes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "report/display_units.h"
#include "report/drawing.h"
#include "report/figure_files.h"
#include "report/report_text.h"

#include <locale.h>
#include <string.h>

/* ---- texts and numbers ----------------------------------------------------------------------- */

static void assert_text(text_buffer *text, const char *expected)
{
    assert_string_equal(text_string(text), expected);
    text_free(text);
}

static void test_numbers_for_reading(void **state)
{
    (void)state;
    static const struct {
        double value;
        int digits;
        const char *expected;
    } cases[] = {
        {12.345, 3, "12.3"},           {-0.0046249, 3, "−0.00462"},
        {1.234e-7, 2, "1.2×10⁻⁷"},     {9.996, 3, "10.0"},
        {123456, 3, "1.23×10⁵"},       {2519.7, 3, "2520"},
        {0.00099996, 3, "0.00100"},    {0, 3, "0"},
        {(double)NAN, 3, "not known"}, {(double)INFINITY, 3, "∞"},
        {-(double)INFINITY, 3, "−∞"},  {99999, 1, "99999"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_string_equal(NUMBER(cases[i].value, cases[i].digits), cases[i].expected);
    }
    assert_string_equal(SHORT_NUMBER(0.5, 4), "0.5");
    assert_string_equal(SHORT_NUMBER(300, 2), "300");
    assert_string_equal(SHORT_NUMBER(20.04, 3), "20");
}

static void test_fixed_decimals(void **state)
{
    (void)state;
    static const struct {
        double value;
        int decimals;
        const char *expected;
    } cases[] = {
        {2.385, 2, "2.38"},  {9.97, 1, "10.0"},   {-0.04, 1, "0.0"},  {0.06, 1, "0.1"},
        {0.004, 1, "0.0"},   {0, 2, "0.00"},      {32, 0, "32"},      {-7.26, 0, "−7"},
        {99.96, 1, "100.0"}, {0.0999, 2, "0.10"}, {1e-9, 3, "0.000"}, {2438121, 0, "2438121"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_string_equal(FIXED(cases[i].value, cases[i].decimals), cases[i].expected);
    }
}

static void test_numbers_do_not_follow_the_locale(void **state)
{
    (void)state;
    bool comma = setlocale(LC_NUMERIC, "de_DE.UTF-8") != NULL;
    const number_text number = number_rounded(12.345, 3, false), fixed = number_fixed(-7.26, 1),
                      literal = number_literal(1.5e-9);
    (void)setlocale(LC_NUMERIC, "C");
    assert_string_equal(number.chars, "12.3");
    assert_string_equal(fixed.chars, "−7.3");
    assert_string_equal(literal.chars, "1.5e-9");
    if (!comma)
        skip();
}

static void test_literals(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *expected;
    } cases[] = {{1e9, "1e9"},   {3, "3.0"},           {-273.15, "-273.15"},      {0.1, "0.1"},
                 {1e-6, "1e-6"}, {(double)NAN, "NaN"}, {1.0 / 3, "0.3333333333"}, {120, "120.0"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_string_equal(LITERAL(cases[i].value), cases[i].expected);
    }
}

static void test_escaping(void **state)
{
    (void)state;
    text_buffer text = {0};
    text_html(&text, "%s<b>%s</b>", "<a href=\"x\">'&'</a>\x01\xff\xc3\x28 µ\r", "100 %s");
    assert_text(&text, "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;"
                       "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd( µ&#13;<b>100 %s</b>");
    text_quoted(&text, "E (MPa) 5 %s {x}_2 \xc2\xb5");
    assert_text(&text, "'E (MPa) 5 %s {x}_2 \xc2\xb5'");
    text_quoted(&text, "'it's `rm`\nset \"@x\" $1 #\xff\xc3\xef\xbf\xbe\\");
    assert_text(&text, "\"'it's \\140rm\\140 set \\\"\\100x\\\" $1 #"
                       "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\\\\\"");
    text_tic_label(&text, "100 %s'%");
    assert_text(&text, "\"100 %%s'%%\"");
    text_comment(&text, "a\nb `c` \\");
    assert_text(&text, "# a b  c   \n");
}

/* Numbers and units in ASCII get the typographic characters of the page; names and words do not. */
static void test_typography(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"-2.88 degC to 104 degC", "−2.88 °C to 104 °C"},
        {"3.02 um", "3.02 µm"},
        {"8.89e-13 to 1.92e14 rad/s", "8.89×10⁻¹³ to 1.92×10¹⁴ rad/s"},
        {"20.0 GJ/m^3, 1e-3 mm^3/(N m)", "20.0 GJ/m³, 1×10⁻³ mm³/(N m)"},
        {">= 570 nm", "≥ 570 nm"},
        {"(-5)", "(−5)"},
        {"a-5, x^y, 10^5, 2e5x, 2e, um-1, umlaut", "a-5, x^y, 10^5, 2e5x, 2e, µm-1, umlaut"},
        {"bulk-1.jpk-force-map <b> µ", "bulk-1.jpk-force-map &lt;b&gt; µ"},
        {"-", "-"},
        {"", ""}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        text_buffer text = {0};
        text_typographic(&text, cases[i][0]);
        assert_text(&text, cases[i][1]);
    }
}

static void test_lab_units(void **state)
{
    (void)state;
    /* an interval of two digits, of three to six digits of the value */
    const wt_estimate some = {3.02e-6, 0.815e-6, 0, "m"}, exact = {1, 1.2e-9, 0, "1"},
                      wide = {3.02e-6, 1.1e-5, 0, "m"}, zero = {0, 0.5, 0, "1"},
                      unknown = {2, (double)NAN, 0, "1"};
    assert_string_equal(ESTIMATE(&some), "3.02 µm (95 %: 1.42 to 4.62)");
    /* as the rows: more digits for a narrower interval, and no sign of a positive number */
    assert_string_equal(ESTIMATE(&exact), "1.00000000 (95 %: 1.00000000 to 1.00000000)");
    assert_string_equal(ESTIMATE(&wide), "3.02 µm (95 %: 0 to 24.58)");
    assert_string_equal(ESTIMATE(&zero), "0 (95 %: −0.980 to 0.980)");
    assert_string_equal(ESTIMATE(&unknown), "2.00 (error not known)");
    static const struct {
        wt_quantity quantity;
        const char *unit;
        double value;
        const char *label;
        double shown;
    } cases[] = {
        {WT_Q_INDENTATION, NULL, 1.3e-7, "nm", 130},
        {WT_Q_HEIGHT, NULL, 2.28e-6, "µm", 2.28},
        {WT_Q_FORCE, NULL, 5.36e-8, "nN", 53.6},
        {WT_Q_MODULUS, NULL, 2.005e7, "MPa", 20.05},
        {WT_Q_TEMPERATURE, "K", 293.15, "°C", 20},
        {WT_Q_TEMPERATURE_DIFFERENCE, NULL, 96.3, "K", 96.3},
        {WT_Q_NONE, "K", 0.4, "K", 0.4},
        {WT_Q_VELOCITY, NULL, 5e-3, "mm/s", 5},
        {WT_Q_WEAR_RATE, NULL, 1e-13, "mm³/(N·m)", 1e-4},
        {WT_Q_POWER_DENSITY, NULL, 3e9, "GW/m³", 3},
        {WT_Q_POWER_SPECTRUM_2D, NULL, 2e-16, "m⁴", 2e-16},
        {WT_Q_NONE, NULL, 0.6, "", 0.6},
        {WT_Q_LENGTH, "m", 0, "nm", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        display_unit lab = select_display_unit(cases[i].quantity, cases[i].unit, cases[i].value);
        assert_string_equal(lab.label, cases[i].label);
        assert_near_abs(to_display_value(&lab, cases[i].value), cases[i].shown,
                        1e-12 * fabs(cases[i].shown) + 1e-12);
    }
}

static void test_svg_is_made_fit_for_a_page(void **state)
{
    (void)state;
    static const char svg[] =
        "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 600 1\">\n<title>Gnuplot</title>"
        "<desc>Produced</desc><g id=\"a\"><title>x</title><use xlink:href='#a' "
        "clip-path='url(#c)'/><text> id='a' url(#c)</text></g></svg>";
    text_buffer text = {0};
    svg_symbols symbols = {0};
    assert_true(svg_append_inline(&text, svg, sizeof svg - 1, "layer", "mu", "a < b", &symbols));
    assert_text(&text, "<svg id=\"picture-layer\" role=\"img\" aria-label=\"a &lt; b\" "
                       "style=\"max-width:35.0rem\" viewBox=\"0 0 600 1\">\n"
                       "<g id=\"mu-a\"><use href='#mu-a' clip-path='url(#mu-c)'/>"
                       "<text> id='a' url(#c)</text></g></svg>");
    assert_false(svg_append_inline(&text, "%PDF-1.4", 8, "layer", "mu", "", &symbols));
    text_free(&text);
}

/* Symbols that pictures share occur once on a page; colours and empty groups are short. */
static void test_svg_symbols_are_shared(void **state)
{
    (void)state;
    static const char svg[] = "<svg viewBox=\"0 0 600 1\"><defs><path id='gpPt1'/></defs>"
                              "<g fill=\"none\" color=\"black\">\n</g>"
                              "<use xlink:href='#gpPt1' color='rgb( 11,  79, 255)'/></svg>";
    static const char *const expected[] = {
        "<svg id=\"picture-layer\" role=\"img\" aria-label=\"x\" style=\"max-width:35.0rem\" "
        "viewBox=\"0 0 600 1\">"
        "<defs><path id='gpPt1'/></defs><use href='#gpPt1' color='#0b4fff'/></svg>",
        "<svg id=\"picture-layer\" role=\"img\" aria-label=\"x\" style=\"max-width:35.0rem\" "
        "viewBox=\"0 0 600 1\">"
        "<use href='#gpPt1' color='#0b4fff'/></svg>"};
    svg_symbols symbols = {0};
    for (int i = 0; i < 2; i++) {
        text_buffer text = {0};
        assert_true(svg_append_inline(&text, svg, sizeof svg - 1, "layer", i == 0 ? "a" : "b", "x",
                                      &symbols));
        assert_text(&text, expected[i]);
        text_free(&text);
    }
}

/* ---- axes ------------------------------------------------------------------------------------ */

/* Symbols of one colour that follow one another are a group; coordinates have one decimal. */
static void test_svg_runs_of_symbols_are_grouped(void **state)
{
    (void)state;
    static const char svg[] =
        "<svg viewBox=\"0 0 600 1\"><g fill=\"none\" color=\"black\" stroke=\"currentColor\" "
        "stroke-width=\"1.10\"><use xlink:href='#a' transform='translate(10.26,99.96) scale(3.38)' "
        "color='rgb(  1,  2,  3)'/>\n<use xlink:href='#a' x='9.99' color='rgb(  1,  2,  3)'/>\n"
        "<use xlink:href='#a' color='red'/><path fill-opacity='0.15' d='M100.04,7.25 "
        "'/>100.04</g></svg>";
    text_buffer text = {0};
    svg_symbols symbols = {0};
    assert_true(svg_append_inline(&text, svg, sizeof svg - 1, "layer", "f", "x", &symbols));
    assert_non_null(strstr(text_string(&text),
                           "<g class=\"g\" stroke-width=\"1.10\"><g color='#010203'>"
                           "<use href='#f-a' transform='translate(10.3,100) scale(3.38)'/>\n<use "
                           "href='#f-a' x='9.99'/>\n"
                           "</g><use href='#f-a' color='red'/><path fill-opacity='0.15' "
                           "d='M100,7.25 '/>100.04</g></svg>"));
    text_free(&text);
}

static void test_data_links(void **state)
{
    (void)state;
    text_buffer text = {0};
    text_data_link(&text, "text/plain", "a\tb\n\"%\0µ", 9);
    assert_text(&text, "data:text/plain;charset=utf-8,a%09b%0A%22%25%00%C2%B5");
    text_data_link(&text, "text/plain", "", 0);
    assert_text(&text, "data:text/plain;charset=utf-8,");
}

/* gnuplot puts the label of an axis next to those of its tics, and off the paper if they are
 * wide. */
static void test_wide_labels_have_a_margin(void **state)
{
    (void)state;
    static const schema_field number = {.unit = "1"};
    figure_drawing d = {.status = WT_OK};
    axis_linear(&d, AXIS_Y, "b", &number, (value_span){-0.75, 0.75});
    assert_null(strstr(text_string(&d.script), "lmargin"));
    text_free(&d.script);
    axis_linear(&d, AXIS_Y, "b", &number, (value_span){-0.00075, 0.00075});
    assert_non_null(strstr(text_string(&d.script), "set lmargin 13\n"));
    text_free(&d.script);
    axis_linear(&d, AXIS_X, "b", &number, (value_span){-0.00075, 0.00075});
    assert_null(strstr(text_string(&d.script), "lmargin"));
    text_free(&d.script);
}

static void test_logarithmic_tics_are_at_whole_decades(void **state)
{
    (void)state;
    static const schema_field wavenumber = {.quantity = WT_Q_WAVENUMBER},
                              modulus = {.quantity = WT_Q_MODULUS}, number = {.unit = NULL},
                              temperature = {.quantity = WT_Q_TEMPERATURE},
                              time = {.quantity = WT_Q_TIME};
    figure_drawing d = {.status = WT_OK};
    axis_log(&d, AXIS_X, "q", &wavenumber, (value_span){1e3, 3e7});
    // gnuplot would count decades from the end of the axis if the first tic were not given.
    assert_non_null(strstr(text_string(&d.script), "set xtics 1e3,1e1\n"));
    assert_non_null(strstr(text_string(&d.script), "\nset xrange [733.9"));
    text_free(&d.script);
    axis_log(&d, AXIS_Y, "E", &modulus, (value_span){11e6, 24e6});
    assert_non_null(strstr(text_string(&d.script), "set ylabel 'E (MPa)'\n"));
    assert_non_null(strstr(text_string(&d.script), "set ytics (15.0, 20.0)\n"));
    text_free(&d.script);
    axis_log(&d, AXIS_Y, "E", &modulus, (value_span){20.1e6, 20.3e6});
    assert_non_null(strstr(text_string(&d.script), "set ytics (19.5, 20.0, 20.5, 21.0)\n"));
    text_free(&d.script);
    /* Numbers with many digits are powers, and have a margin at the axis. */
    axis_log(&d, AXIS_Y, "q", &wavenumber, (value_span){1.2e5, 8e6});
    assert_non_null(strstr(text_string(&d.script), ", '2·10^{5}' 200000.0, "));
    assert_non_null(strstr(text_string(&d.script), "set lmargin 12\n"));
    text_free(&d.script);
    // Over many decades moduli are in MPa, times and velocities in SI.
    axis_log(&d, AXIS_Y, "E", &modulus, (value_span){1e6, 1e12});
    assert_non_null(strstr(text_string(&d.script), "set ylabel 'E (MPa)'\n"));
    text_free(&d.script);
    axis_log(&d, AXIS_X, "t", &time, (value_span){1e-9, 1e-3});
    assert_non_null(strstr(text_string(&d.script), "set xlabel 't (s)'\n"));
    text_free(&d.script);
    axis_log(&d, AXIS_X, "t", &time, (value_span){1e-7, 1e-6});
    assert_non_null(strstr(text_string(&d.script), "set xlabel 't (ns)'\n"));
    text_free(&d.script);
    axis_linear(&d, AXIS_X, "T", &temperature, (value_span){293.15, 293.15});
    assert_non_null(strstr(text_string(&d.script), "x_offset = -273.15"));
    text_free(&d.script);
    // There is no axis for numbers that it cannot show.
    value_span span = EMPTY_SPAN;
    span_add(&span, 1e300, true);
    span_add(&span, 1e-300, true);
    span_add(&span, (double)NAN, false);
    span_add(&span, -1, true);
    assert_true(span_is_empty(&span));
    span_add(&span, 1e-99, true);
    span_add(&span, 1e99, true);
    axis_log(&d, AXIS_X, "q", &number, span);
    assert_non_null(strstr(text_string(&d.script), ",1e34\n"));
    text_free(&d.script);
    axis_linear(&d, AXIS_X, "q", &number, (value_span){5e-324, 1e-323});
    assert_non_null(strstr(text_string(&d.script), "set xtics 0.5\n"));
    drawing_clear(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_for_reading),
        cmocka_unit_test(test_fixed_decimals),
        cmocka_unit_test(test_numbers_do_not_follow_the_locale),
        cmocka_unit_test(test_literals),
        cmocka_unit_test(test_escaping),
        cmocka_unit_test(test_typography),
        cmocka_unit_test(test_lab_units),
        cmocka_unit_test(test_svg_is_made_fit_for_a_page),
        cmocka_unit_test(test_svg_symbols_are_shared),
        cmocka_unit_test(test_svg_runs_of_symbols_are_grouped),
        cmocka_unit_test(test_data_links),
        cmocka_unit_test(test_wide_labels_have_a_margin),
        cmocka_unit_test(test_logarithmic_tics_are_at_whole_decades),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
