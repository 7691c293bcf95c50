/* Figures for a paper: the requested width in every format, with the same font size, and refusals.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "report_folder.h"

#include <math.h>

/* A column of a journal [mm]. */
static const double column = 85;

static double number_behind(const char *text, const char *words)
{
    const char *found = strstr(text, words);
    if (found == NULL)
        fail_msg("it lacks %s", words);
    return strtod(found + strlen(words), NULL);
}

static unsigned long prefix_length(const char *bytes)
{
    unsigned long word = 0;
    for (int i = 0; i < 4; i++)
        word = word << 8 | (unsigned char)bytes[i];
    return word;
}

/* Width and height in millimetres as stated in the file. */
static void svg_size(const char *bytes, double size[2])
{
    size[0] = number_behind(bytes, "<svg width=\"");
    size[1] = number_behind(bytes, "mm\" height=\"");
}

static void pdf_size(const char *bytes, size_t length, double size[2])
{
    static const char box[] = "/MediaBox [ 0 0 ";
    const char *found = memmem(bytes, length, box, sizeof box - 1);
    assert_non_null(found);
    char *end = NULL;
    size[0] = strtod(found + sizeof box - 1, &end) / 72 * 25.4;
    size[1] = strtod(end, NULL) / 72 * 25.4;
    // Text is stored as text with a font, not as a picture.
    assert_non_null(memmem(bytes, length, "/Font", 5));
    assert_null(memmem(bytes, length, "/Subtype /Image", 15));
}

static void png_size(const char *bytes, size_t length, double size[2])
{
    assert_true(length > 100);
    assert_memory_equal(bytes + 1, "PNG", 3);
    assert_memory_equal(bytes + 33, "\0\0\0\x09pHYs", 8);
    const double dots = (double)prefix_length(bytes + 41);
    assert_near(dots, 600 / 0.0254, 1e-4);
    assert_int_equal(prefix_length(bytes + 45), prefix_length(bytes + 41));
    assert_int_equal(bytes[49], 1);
    size[0] = 1e3 * (double)prefix_length(bytes + 16) / dots;
    size[1] = 1e3 * (double)prefix_length(bytes + 20) / dots;
}

/* All text has the same size, except superscripts and subscripts. */
static void check_type(const char *name, const char *bytes)
{
    static const char size[] = "font-size=\"";
    for (const char *s = strstr(bytes, size); s != NULL; s = strstr(s + 1, size)) {
        const double type = strtod(s + sizeof size - 1, NULL);
        const bool shifted = type == 12; // four fifths
        if (type != 15 && !shifted)
            fail_msg("%s: type of %g units", name, type);
    }
}

static void check_sizes(const char *figure, double width, double units)
{
    static const char *const endings[] = {"svg", "pdf", "png"};
    double first[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        char path[160];
        double size[2];
        size_t length = 0;
        (void)snprintf(path, sizeof path, "out/plots/%s.%s", figure, endings[k]);
        char *bytes = read_all(path, &length);
        if (k == 0)
            svg_size(bytes, size);
        else if (k == 1)
            pdf_size(bytes, length, size);
        else
            png_size(bytes, length, size);
        // The resolution of a PDF page is a point, that of SVG a unit.
        if (fabs(size[0] - width) > 0.36)
            fail_msg("%s is %g mm wide, not %g", path, size[0], width);
        if (k == 0) {
            check_type(path, bytes);
            assert_near_abs(number_behind(bytes, "viewBox=\"0 0 "), width * units, 1);
            memcpy(first, size, sizeof first);
        } else if (fabs(size[1] - first[1]) > 0.36)
            fail_msg("%s is %g mm high, %g as SVG", path, size[1], first[1]);
        free(bytes);
    }
}

static void test_widths_and_type(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    static const char *const figures[] = {"friction",     "modulus_groups",     "layer",
                                          "master_curve", "van_gurp_palmen",    "shift_factors",
                                          "error_budget", "force_displacement", "what_if",
                                          "curves"};
    wt_result *result = fixture_result();
    wt_report_options options = wt_report_defaults();
    options.figures = WT_FIGURE_SVG | WT_FIGURE_PDF | WT_FIGURE_PNG;
    options.width = 1e-3 * column;
    write_report(result, "out", &options);
    // 8 points are 15 units.
    const double units = 72 / 25.4 * 15 / 8;
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        check_sizes(figures[i], column, units);
    // Every figure is there in every format.
    assert_int_equal(count_files("out/plots"), 5 * wt_figure_count() + 2);
    /* Figures that are not requested are removed, because they would show old numbers. */
    options.figures = WT_FIGURE_PDF;
    options.width = (double)NAN;
    write_report(result, "out", &options);
    assert_int_equal(count_files("out/plots"), 4 * wt_figure_count() + 2);
    size_t length = 0;
    char *plain = read_all("out/plots/friction.svg", &length);
    assert_null(strstr(plain, "<svg width"));
    assert_near(number_behind(plain, "viewBox=\"0 0 "), 620, 0);
    free(plain);
    wt_result_free(result);
}

static void test_the_font_is_that_of_the_figures_and_the_page(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    const char *const table = "friction";
    wt_result *result = fixture_only(&table, 1, &(fixture_change){.table = NULL});
    wt_report_options options = wt_report_defaults();
    options.font = "DejaVu Serif";
    write_report(result, "out", &options);
    size_t length = 0;
    char *picture = read_all("out/plots/friction.svg", &length),
         *page = read_all("out/index.html", &length);
    assert_non_null(strstr(picture, "font-family=\"DejaVu Serif\""));
    assert_null(strstr(picture, "font-family=\"Helvetica\""));
    assert_non_null(strstr(page, "--figure-font: \"DejaVu Serif\""));
    free(picture);
    free(page);
    wt_result_free(result);
}

/* An fc-match that always returns one family. */
static void test_a_font_that_is_not_there(void **state)
{
    (void)state;
    char *const path = strdup(getenv("PATH"));
    char instead[10] = "";
    FILE *script = fopen("fc-match", "w");
    assert_non_null(script);
    /* an unescaped hyphen would begin a size */
    (void)fprintf(script, "#!/bin/sh\ncase $3 in 7-*) exit 1;; esac\n"
                          "echo 'DejaVu Sans,Sans Book'\n");
    assert_int_equal(fclose(script), 0);
    assert_int_equal(chmod("fc-match", 0700), 0);
    char *const here = realpath(".", NULL);
    assert_int_equal(setenv("PATH", here, 1), 0);
    assert_true(wt_report_font_is_available(NULL, instead, sizeof instead));
    assert_true(wt_report_font_is_available("dejavu sans", instead, sizeof instead));
    assert_true(wt_report_font_is_available("Sans Book", instead, sizeof instead));
    assert_false(wt_report_font_is_available("Sans", instead, sizeof instead));
    assert_string_equal(instead, "DejaVu Sa");
    assert_false(wt_report_font_is_available("7-", instead, sizeof instead));
    assert_int_equal(unlink("fc-match"), 0);
    /* no family to return */
    assert_true(wt_report_font_is_available("Sans", instead, sizeof instead));
    assert_int_equal(setenv("PATH", path, 1), 0);
    free(here);
    free(path);
}

static void test_refusals(void **state)
{
    (void)state;
    static const char *const fonts[] = {"",     "a'b", "a\"", "a,8", "x;system('touch run')",
                                        "`id`", "@x"};
    wt_report_options options = wt_report_defaults();
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < sizeof fonts / sizeof *fonts; i++) {
        options.font = fonts[i];
        assert_int_not_equal(wt_report_check("out", &options, &err), WT_OK);
    }
    // gnuplot would abort at a name of a thousand letters.
    char letters[1001] = "";
    options.font = memset(letters, 'A', sizeof letters - 1);
    assert_int_not_equal(wt_report_check("out", &options, &err), WT_OK);
    assert_string_equal(err.found, "1000");
    letters[127] = '\0';
    assert_int_equal(wt_report_check("out", &options, &err), WT_OK);
    options = wt_report_defaults();
    static const double widths[] = {0, -0.1, 0.01, 85};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        options.width = widths[i];
        assert_int_not_equal(wt_report_check("out", &options, &err), WT_OK);
    }
    /* The page alone has no folder for them. */
    options = wt_report_defaults();
    assert_int_equal(wt_report_check("page.html", &options, &err), WT_OK);
    options.figures = WT_FIGURE_PDF;
    assert_int_equal(wt_report_check("page.html", &options, &err), WT_E_ARG);
    assert_int_equal(wt_report_check("out", &options, &err), WT_OK);
    // Words.
    static const char *const bad[] = {"", "svg,", ",pdf", "eps", "svg,pdf,gif", "SVG", "pd"};
    uint64_t given = 0;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_not_equal(
            wt_params_set(wt_report_params(), "figures", &options, bad[i], &given, &err), WT_OK);
    assert_int_equal(
        wt_params_set(wt_report_params(), "figures", &options, "png,svg", &given, &err), WT_OK);
    assert_int_equal(options.figures, WT_FIGURE_PNG | WT_FIGURE_SVG);
}

/* Each picture has its own time limit, the last one too. */
static void test_one_of_many_hangs(void **state)
{
    (void)state;
    static const char *const tables[] = {"friction", "modulus_groups", "layer"};
    wt_result *result = fixture_only(tables, 3, &(fixture_change){.table = NULL});
    wt_report_options options = wt_report_defaults();
    wt_error err = WT_ERROR_INIT;
    write_all("fake",
              "#!/bin/sh\nfor f in modulus_groups friction layer; do sleep 0.4; echo > $f.svg; "
              "done\nexec sleep 100\n");
    assert_int_equal(chmod("fake", 0755), 0);
    options.gnuplot = "./fake";
    options.gnuplot_time = 0.8;
    const double begin = wt_time_wall();
    assert_int_equal(wt_report_write(result, "out", &options, NULL, &err), WT_E_TOOL);
    const double took = wt_time_wall() - begin;
    assert_non_null(strstr(err.message, "did not end within 0.8 s"));
    assert_true(took > 1.9 && took < 30); // three of 0.4 s, and one too late
    assert_false(exists("out"));
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_widths_and_type, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_a_font_that_is_not_there, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_the_font_is_that_of_the_figures_and_the_page,
                                        create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_refusals, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_one_of_many_hangs, create_work_folder,
                                        remove_work_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
