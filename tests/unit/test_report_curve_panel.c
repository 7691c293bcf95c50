/* The figure of force curves: which stands where, and what is said of it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "report/curve_panel.h"
#include "weartrack/report.h"

#include <stdlib.h>
#include <string.h>

enum { MANY = 30 };

/* A reason of the largest length, for curve 6. */
static const char long_reason[] =
    "the 95 % interval is wide: E +- 55 % (55 % from the fit range), above 20 %; a pull that "
    "the contact law does not describe; baseline bent, which is in the error";

static void add_table(wt_result *result, const char *name, char *text)
{
    FILE *in = fmemopen(text, strlen(text), "r");
    wt_table *table = NULL;
    assert_int_equal(wt_stream_read(in, name, &table, NULL), WT_OK);
    fclose(in);
    assert_int_equal(wt_table_rename(table, name, NULL), WT_OK);
    assert_int_equal(wt_result_add(result, table, NULL), WT_OK);
}

/* Curves 0 to n-1: every third refused, every fifth of the others doubtful; the last one has no
 * samples. */
static wt_result *curves_by_hand(int n)
{
    static const char *const segments[] = {"approach", "retract"};
    char *rows = NULL, *samples = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&rows, &length);
    fprintf(out, "# file[text]\tcurve[1]\tverdict[text]\treason[text]\tmodulus[Pa]\t"
                 "modulus_standard_error[Pa]\n");
    for (int i = 0; i < n; i++)
        fprintf(out, "%s/a'file with \\\\ and \xc2\xb5.txt\t%d\t%s\t%s\t%s\n", "folder", i,
                i % 3 == 0   ? "poor_fit"
                : i % 5 == 0 ? "doubtful"
                             : "accepted",
                i == 6       ? long_reason
                : i % 3 == 0 ? "misfit: 80 %, 50 % allowed; another tip, a layer, loss, adhesion, "
                               "piezo or detector"
                : i % 5 == 0 ? "baseline departs"
                             : "accepted",
                i % 3 == 0 ? "nan\tnan" : "2e6\t1e5");
    fclose(out);
    out = open_memstream(&samples, &length);
    fprintf(out, "# group[text]\tfile[text]\tcurve[1]\tsegment[text]\tdisplacement[m]\tforce[N]\t"
                 "indentation[m]\tfitted_force[N]\tresidual[N]\n");
    for (int i = 0; i + 1 < n; i++) {
        fputs(i > 0 ? "\n" : "", out);
        for (int k = 0; k < 40; k++)
            fprintf(out,
                    "bulk\tfolder/a'file with \\\\ and \xc2\xb5.txt\t%d\t%s\t%de-9\t%de-10\t"
                    "%de-9\t%s\tnan\n",
                    i, segments[k / 20], k % 20 - 10, k % 20, k % 20 - 10,
                    k < 20 && i % 3 != 0 ? "1e-9" : "nan");
    }
    fclose(out);
    wt_result *result = wt_result_new();
    add_table(result, "indentation/bulk", rows);
    add_table(result, "curves", samples);
    free(rows);
    free(samples);
    return result;
}

static void test_order(void **state)
{
    (void)state;
    wt_result *result = curves_by_hand(MANY);
    figure_tables tables;
    curve_list list;
    assert_int_equal(figure_tables_bind(result, &tables, NULL), WT_OK);
    curve_list_init(&tables, &list);
    assert_int_equal(list.n_rows, MANY);
    assert_int_equal(list.n, MANY - 1);
    assert_int_equal(list.of_kind[CURVE_REFUSED], 10);
    assert_int_equal(list.of_kind[CURVE_DOUBTFUL], 4); /* 5, 10, 20, 25 */
    static const double first[] = {0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 5, 10, 20, 25, 1, 2, 4};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (curves_get(&tables.curves, list.curves[i].block.from, CURVES_CURVE) != first[i])
            fail_msg("curve %g is not at place %zu", first[i], i);
    curve_list_clear(&list);
    figure_tables_clear(&tables);
    wt_result_free(result);
}

static char *script_of(const figure_tables *tables, const listed_curve *curve)
{
    const figure_description described = {.name = "x", .table = &curves_schema};
    figure_drawing d = {.figure = &described, .tables = tables, .table = &tables->curves};
    draw_curve_panel(&d, curve);
    assert_int_equal(d.status, WT_OK);
    char *script = strdup(text_string(&d.script));
    drawing_clear(&d);
    return script;
}

/* Writes the labels from the third on, separated by blanks. Returns the longest length. */
static size_t join_reason_lines(const char *script, char *to, size_t size)
{
    size_t longest = 0;
    *to = '\0';
    for (int number = 3;; number++) {
        char begin[32];
        const int n = snprintf(begin, sizeof begin, "set label %d '", number);
        const char *line = strstr(script, begin);
        if (line == NULL)
            return longest;
        const size_t length = strcspn(line + n, "'"), used = strlen(to);
        longest = length > longest ? length : longest;
        (void)snprintf(to + used, size - used, "%s%.*s", number > 3 ? " " : "", (int)length,
                       line + n);
    }
}

/* The longest reason stands whole above a panel of the last column, which begins 180 points
 * before the edge of the figure; 40 letters of 8 points have 160 in the mean. */
static void test_long_reason(void **state)
{
    (void)state;
    wt_result *result = curves_by_hand(MANY);
    figure_tables tables;
    curve_list list;
    char joined[512];
    assert_int_equal(figure_tables_bind(result, &tables, NULL), WT_OK);
    curve_list_init(&tables, &list);
    assert_int_equal(sizeof long_reason, 160);
    char *script = script_of(&tables, &list.curves[2]);
    assert_true(join_reason_lines(script, joined, sizeof joined) <= 40);
    assert_string_equal(joined, long_reason);
    free(script);
    curve_list_clear(&list);
    figure_tables_clear(&tables);
    wt_result_free(result);
}

static void test_texts(void **state)
{
    (void)state;
    wt_result *result = curves_by_hand(MANY);
    figure_tables tables;
    curve_list list;
    assert_int_equal(figure_tables_bind(result, &tables, NULL), WT_OK);
    curve_list_init(&tables, &list);
    char *refused = script_of(&tables, &list.curves[1]);
    assert_non_null(strstr(refused, "set label 1 \"a'file with \\\\ and \xc2\xb5.txt:3\""));
    assert_non_null(strstr(refused, "set label 2 'the model does not describe the curve'"));
    /* in lines, whole */
    assert_non_null(strstr(refused, "set label 3 'misfit: 80 %, 50 % allowed; another tip,'"));
    assert_non_null(strstr(refused, "set label 4 'a layer, loss, adhesion, piezo or'"));
    assert_non_null(strstr(refused, "set label 5 'detector'"));
    assert_null(strstr(refused, "set arrow from")); /* no fit, no contact */
    char *doubtful = script_of(&tables, &list.curves[10]);
    assert_non_null(strstr(doubtful, "set label 2 'doubtful'"));
    assert_non_null(strstr(doubtful, "set label 3 'E = 2.00 MPa (95 %: 1.80 to 2.20)'"));
    assert_non_null(strstr(doubtful, "set label 4 'baseline departs'"));
    assert_non_null(strstr(doubtful, "set arrow from"));
    char *accepted = script_of(&tables, &list.curves[14]);
    assert_non_null(strstr(accepted, "set label 3 'E = 2.00 MPa (95 %: 1.80 to 2.20)'"));
    assert_null(strstr(accepted, "set label 4"));
    free(refused);
    free(doubtful);
    free(accepted);
    curve_list_clear(&list);
    figure_tables_clear(&tables);
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_texts),
                                       cmocka_unit_test(test_long_reason)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
