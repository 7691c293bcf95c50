/* The page with all curves: its samples are those of the table, its texts cannot end their element,
 * and a result without samples has no page.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "report/report_files.h"
#include "weartrack/indentation.h"
#include "weartrack/report.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CASE WT_SOURCE_DIR "/fixtures/case/"

static wt_formats *formats;

static void assert_within(double found, double expected, double allowed)
{
    if (!(fabs(found - expected) <= allowed))
        fail_msg("%.9g is not %.9g (allowed %.2g)", found, expected, allowed);
}

/* A group with two maps, as a result. */
static wt_result *fitted(const char *const *curves, size_t n)
{
    static const char *const files[] = {CASE "bulk-1.jpk-force-map", CASE "bulk-2.jpk-force-map"};
    wt_file_set set = {files, 2, NULL, wt_read_defaults(), NULL};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.tip = (wt_tip){.sides = 4, .half_angle = M_PI / 9, .radius = 20e-9};
    job.tip.transition_radius = wt_tip_tangent_transition(job.tip.radius, job.tip.half_angle);
    job.curves = curves;
    job.n_curves = n;
    if (wt_indent_group(&job, &work, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    wt_result *result = wt_result_new();
    assert_int_equal(wt_result_add(result, tables.indentation, NULL), WT_OK);
    tables.indentation = NULL;
    if (tables.curves != NULL)
        assert_int_equal(wt_result_add(result, tables.curves, NULL), WT_OK);
    tables.curves = NULL;
    wt_indent_tables_clear(&tables);
    return result;
}

static char *data_of(const wt_result *result)
{
    figure_tables tables;
    text_buffer text = {0};
    assert_int_equal(figure_tables_bind(result, &tables, NULL), WT_OK);
    append_browse_data(&tables, &text);
    figure_tables_clear(&tables);
    return text.bytes;
}

static size_t decode(const char *text, unsigned char *to)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t n = 0;
    unsigned bits = 0, held = 0;
    for (; *text != '"' && *text != '='; text++) {
        bits = bits << 6 | (unsigned)(strchr(digits, *text) - digits);
        held += 6;
        if (held < 8)
            continue;
        held -= 8;
        to[n++] = (unsigned char)(bits >> held & 255);
    }
    return n;
}

static double value(const unsigned char *bytes, size_t i, double low, double high)
{
    return low + (high - low) * (bytes[2 * i] + 256 * bytes[2 * i + 1]) / 65534;
}

/* Every sample of every curve within a step of the 16 bits: force, displacement and fit. */
static void test_samples(void **state)
{
    (void)state;
    static const char *const all[] = {"all"};
    wt_result *result = fitted(all, 1);
    const wt_table *curves = wt_result_find(result, "curves");
    char *data = data_of(result), *next = data;
    static unsigned char bytes[8192];
    size_t row = 0, n_curves = 0;
    while ((next = strstr(next, ",[")) != NULL) { /* only samples are lists after a comma */
        unsigned long n, approach, contact;
        double z[2], f[2], compliance;
        char *end = NULL;
        if (sscanf(next, ",[%lu,%lu,%lu,%lf,%lf,%lf,%lf,%lf", &n, &approach, &contact, &z[0], &z[1],
                   &f[0], &f[1], &compliance) != 8) {
            next += 2;
            continue;
        }
        end = strchr(next, '"');
        assert_true(decode(end + 1, bytes) == 2 * (2 * n + approach - contact));
        assert_near(compliance, 1 / 0.3, 1e-3);
        for (size_t i = 0; i < n; i++, row++) {
            const double fit = number_cell(curves, row, "fitted_force");
            assert_within(value(bytes, i, z[0], z[1]), number_cell(curves, row, "displacement"),
                          (z[1] - z[0]) / 60000);
            assert_within(value(bytes, n + i, f[0], f[1]), number_cell(curves, row, "force"),
                          (f[1] - f[0]) / 60000);
            if (i >= contact && i < approach)
                assert_within(value(bytes, 2 * n + i - contact, f[0], f[1]), fit,
                              (f[1] - f[0]) / 60000);
            else
                assert_true(i < approach ? fit == 0 : isnan(fit));
        }
        n_curves++;
        next = end;
    }
    assert_int_equal(n_curves, 24);
    assert_int_equal(row, wt_table_n_rows(curves));
    free(data);
    wt_result_free(result);
}

/* The fit in the table is close to its force, and the thinned curve keeps its extremes. */
static void test_residuals(void **state)
{
    (void)state;
    static const char *const words[] = {"worst:3", CASE "bulk-1.jpk-force-map:7"};
    wt_result *result = fitted(words, 2);
    const wt_table *curves = wt_result_find(result, "curves"),
                   *rows = wt_result_find(result, "indentation/bulk");
    size_t in_contact = 0;
    double largest = 0;
    for (size_t i = 0; i < wt_table_n_rows(curves); i++) {
        const double residual = number_cell(curves, i, "residual");
        largest = fmax(largest, number_cell(curves, i, "force"));
        if (isnan(residual))
            continue;
        in_contact += number_cell(curves, i, "indentation") > 0;
        assert_within(residual, 0, 1e-9); /* of 45 nN */
        assert_within(residual,
                      number_cell(curves, i, "force") - number_cell(curves, i, "fitted_force"), 0);
    }
    assert_true(in_contact > 3 * 80);
    double deepest = 0;
    for (size_t i = 0; i < wt_table_n_rows(rows); i++)
        deepest = fmax(deepest, number_cell(rows, i, "max_force"));
    assert_true(largest > 0.7 * deepest && largest < 1.1 * deepest);
    const size_t n = wt_table_block(curves, wt_table_n_rows(curves) - 1) + 1;
    assert_true(n == 3 || n == 4); /* the named one may be one of the worst */
    wt_result_free(result);
}

/* Foreign names and reasons cannot end their element or string. */
static void test_foreign_texts(void **state)
{
    (void)state;
    static const char text[] = "# file[text]\tcurve[1]\tverdict[text]\treason[text]\tmodulus[Pa]\n"
                               "</script><b>\"\\\\ & \\xFF\t0\taccepted\t<!--\t1e6\n";
    FILE *in = fmemopen((void *)(uintptr_t)text, sizeof text - 1, "r");
    wt_table *table = NULL;
    assert_int_equal(wt_stream_read(in, "by hand", &table, NULL), WT_OK);
    fclose(in);
    wt_result *result = wt_result_new();
    assert_int_equal(wt_table_rename(table, "indentation/bulk", NULL), WT_OK);
    assert_int_equal(wt_result_add(result, table, NULL), WT_OK);
    char *data = data_of(result);
    assert_null(strpbrk(data, "<>&"));
    assert_non_null(strstr(data, "\"\\u003c/script\\u003e\\u003cb\\u003e\\u0022\\u005c \\u0026 "
                                 "\\ufffd\""));
    free(data);
    wt_result_free(result);
}

static void test_nothing(void **state)
{
    (void)state;
    wt_result *result = fitted(NULL, 0);
    wt_error err = WT_ERROR_INIT;
    const wt_status status = wt_curve_browser_write(result, "browse-none.html", false, &err);
    assert_true(status == WT_E_EMPTY || status == WT_E_TOOL); /* built without dygraphs */
    assert_true(strstr(err.advice, "--curves all") != NULL ||
                strstr(err.advice, "libjs-dygraphs") != NULL);
    assert_int_not_equal(access("browse-none.html", F_OK), 0);
    assert_int_equal(wt_report_check_curves(result, &err), WT_E_EMPTY);
    assert_non_null(strstr(err.found, "24 curves, none rejected"));
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples), cmocka_unit_test(test_residuals),
        cmocka_unit_test(test_foreign_texts), cmocka_unit_test(test_nothing)};
    if (wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
        return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    wt_formats_free(formats);
    return failed;
}
