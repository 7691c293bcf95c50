/* The report: the folder with its figures and its page.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "report_folder.h"

#include <glob.h>
#include <libxml/parser.h>
#include <libxml/xpath.h>
#include <libxml/xpathInternals.h>
#include <signal.h>
#include <sys/wait.h>

/* ---- complete report ------------------------------------------------------------------------- */

static void test_every_figure_is_listed_once(void **state)
{
    (void)state;
    size_t n = wt_figure_count();
    assert_true(n >= 12);
    for (size_t i = 0; i < n; i++) {
        assert_non_null(wt_figure_get(i).table);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(wt_figure_get(i).name, wt_figure_get(k).name);
    }
    assert_null(wt_figure_get(n).name);
}

static void test_the_man_pages_name_every_figure(void **state)
{
    (void)state;
    static const char *const pages[] = {WT_SOURCE_DIR "/man/weartrack-report.1",
                                        WT_SOURCE_DIR "/man/weartrack-case.5"};
    for (size_t k = 0; k < sizeof pages / sizeof *pages; k++) {
        size_t length = 0;
        char *page = read_all(pages[k], &length);
        for (size_t i = 0; i < wt_figure_count(); i++)
            if (strstr(page, wt_figure_get(i).name) == NULL)
                fail_msg("figure %s is not in %s", wt_figure_get(i).name, pages[k]);
        free(page);
    }
}

static void test_everything(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    assert_int_equal(count_files("out"), 2);
    assert_int_equal(count_files("out/plots"), 3 * wt_figure_count() + 2);
    assert_true(exists("out/plots/style.gp") && exists("out/plots/output.gp"));
    for (size_t i = 0; i < wt_figure_count(); i++) {
        static const char *const endings[] = {"tsv", "gp", "svg"};
        for (size_t k = 0; k < 3; k++) {
            char path[160];
            (void)snprintf(path, sizeof path, "out/plots/%s.%s", wt_figure_get(i).name, endings[k]);
            size_t length = 0;
            char *bytes = read_all(path, &length);
            assert_true(length > 200);
            if (k == 1) { /* Only relative names, and nothing that runs a program. */
                assert_null(strstr(bytes, "/tmp"));
                assert_null(strstr(bytes, "`"));
                assert_null(strstr(bytes, "system"));
            }
            free(bytes);
        }
    }
    assert_int_equal(count_files("."), 1); /* No temporary file is left. */
    wt_result_free(result);
}

static double count_nodes(xmlXPathContext *context, const char *expression)
{
    xmlXPathObject *found = xmlXPathEvalExpression((const xmlChar *)expression, context);
    assert_non_null(found);
    double value = xmlXPathCastToNumber(found);
    xmlXPathFreeObject(found);
    return value;
}

/* The page as XML: well-formed, self-contained, accessible, without repeated ids. */
static void check_page(const char *path, double figures, double tables)
{
    size_t length = 0;
    char *bytes = read_all(path, &length);
    assert_null(strstr(bytes, "<script"));
    assert_null(strstr(bytes, "http://www.w3.org/2000/svg\" src"));
    xmlDoc *page = xmlReadMemory(bytes, (int)length, "page", NULL, XML_PARSE_NONET);
    assert_non_null(page);
    xmlXPathContext *context = xmlXPathNewContext(page);
    (void)xmlXPathRegisterNs(context, (const xmlChar *)"h",
                             (const xmlChar *)"http://www.w3.org/1999/xhtml");
    (void)xmlXPathRegisterNs(context, (const xmlChar *)"s",
                             (const xmlChar *)"http://www.w3.org/2000/svg");
    assert_near(count_nodes(context, "count(/h:html[@lang='en'])"), 1, 0);
    assert_near(count_nodes(context, "count(//h:figure[h:figcaption]//s:svg[@role='img' and "
                                     "string-length(@aria-label) > 5])"),
                figures, 0);
    assert_near(count_nodes(context, "count(//s:svg)"), figures, 0);
    assert_near(count_nodes(context, "count(//s:title)"), 0, 0);
    assert_true(count_nodes(context, "count(//h:table)") >= tables);
    assert_near(count_nodes(context, "count(//h:th[not(@scope)])"), 0, 0);
    assert_near(count_nodes(context, "count(//h:table[not(h:caption)])"), 0, 0);
    assert_near(count_nodes(context, "count(//h:b)"), 0, 0); // the one of the fixture's path
    assert_near(count_nodes(context, "count(//*[@src])"), 0, 0);
    assert_near(count_nodes(context, "count(//h:link)"), 0, 0);
    assert_near(count_nodes(context, "count(//h:a[starts-with(@href, 'http')])"), 0, 0);
    xmlXPathObject *ids = xmlXPathEvalExpression((const xmlChar *)"//@id", context);
    for (int i = 0; ids->nodesetval != NULL && i < ids->nodesetval->nodeNr; i++)
        for (int k = 0; k < i; k++)
            if (xmlStrEqual(ids->nodesetval->nodeTab[i]->children->content,
                            ids->nodesetval->nodeTab[k]->children->content))
                fail_msg("id %s twice", ids->nodesetval->nodeTab[i]->children->content);
    // Each part of the contents leads somewhere.
    xmlXPathObject *links = xmlXPathEvalExpression((const xmlChar *)"//h:nav//h:a/@href", context);
    for (int i = 0; links->nodesetval != NULL && i < links->nodesetval->nodeNr; i++) {
        char expression[128];
        (void)snprintf(expression, sizeof expression, "count(//*[@id='%s'])",
                       (const char *)links->nodesetval->nodeTab[i]->children->content + 1);
        assert_near(count_nodes(context, expression), 1, 0);
    }
    xmlXPathFreeObject(links);
    xmlXPathFreeObject(ids);
    xmlXPathFreeContext(context);
    xmlFreeDoc(page);
    free(bytes);
}

static void test_page(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    check_page("out/index.html", (double)wt_figure_count(), 18);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    // The cards come first, then the data used, then the sections.
    const char *card = strstr(page, "Is the track different?"), *data = strstr(page, "id=\"data\""),
               *figure = strstr(page, "<figure");
    assert_true(card != NULL && data != NULL && figure != NULL);
    assert_true(card < data && data < figure);
    static const char *const expected[] = {
        "<h1>EPDM, severe &lt;case&gt;</h1>",
        ">0.646</td><td data-label=\"95 % interval\">0.593 to 0.703</td>"
        "<td data-label=\"Model choices\">0.642 to 0.649</td>",
        "Bulk</th><td data-label=\"Value\">7.99 MPa</td>",
        (">3.16 µm</td><td class=\"n\" data-label=\"Standard error\">0.80 µm</td>"
         "<td class=\"n\" data-label=\"Numerical error\">"), /* and the rounding error */
        "bulk: 12 curves, 0 wide, 0 doubtful, 1 rejected",
        "R^2 0.71 below 0.90 &lt;i&gt;",
        "&lt;b&gt;&#39;`touch fixture_was_run`&quot;&amp;;$(rm -r x)\\",
        "left out: nothing asked for it",
        "&lt;case title=&quot;HC &amp;amp; severe&quot;&gt;",
        "weartrack run &#39;&lt;case&gt;.xml&#39;",
        "<h2 id=\"failures\">",
        "@media (prefers-color-scheme: dark)",
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (strstr(page, expected[i]) == NULL)
            fail_msg("the page lacks: %s", expected[i]);
    /* A value without an error has three digits. */
    static const char correlation[] =
        "Correlation of C₁ and C₂</th><td data-label=\"Value\" colspan=\"3\">";
    const char *shown = strstr(page, correlation);
    assert_non_null(shown);
    shown += sizeof correlation - 1;
    assert_int_equal(strcspn(shown, "<"), strlen("0.927"));
    assert_near(strtod(shown, NULL),
                atof(wt_table_key(wt_result_find(result, "shift_factors"), "wlf_correlation")),
                1e-3);
    free(page);
    wt_result_free(result);
}

static size_t count_words(const char *page, const char *words)
{
    size_t n = 0;
    for (const char *s = strstr(page, words); s != NULL; s = strstr(s + 1, words))
        n++;
    return n;
}

/* Cells of a row as text, "bulk|48|0|". */
static void read_row(const char *row, char *words, size_t size)
{
    size_t n = 0;
    const char *end = strstr(row, "</tr>");
    for (const char *s = row; s < end && n + 2 < size; s++) {
        if (strncmp(s, "</t", 3) == 0)
            words[n++] = '|';
        if (*s == '<')
            s = strchr(s, '>');
        else
            words[n++] = *s;
    }
    words[n] = '\0';
}

/* Zero with an error. */
static void set_floor(wt_table *table)
{
    if (strcmp(wt_table_name(table), "shift_factors") == 0)
        fixture_key(table, "offset", 0, 1e-7, "1");
}

/* Order, units and digits of the columns, and the main numbers. */
static void test_tables_on_the_page(void **state)
{
    (void)state;
    const fixture_change change = {.finish = set_floor};
    static const char *const tables[] = {"modulus_groups", "comparison", "shift_factors",
                                         "dma_comparison", "friction"};
    static const char *const rows[] = {
        "Group|Curves n|Rejected|Spots|Geometric mean (MPa)|95 % interval from (MPa)|to (MPa)|"
        "Median (MPa)|Mean (MPa)|Standard deviation (MPa)|",
        "bulk|48|0|4|7.99|5.99|10.7|8.27|8.04|0.910|",
        "Indentation rate from (nm/s)|to (nm/s)|n bulk|n track|Spots bulk|Spots track|Track / bulk|"
        "95 % interval from|to|"
        "Welch t|Degrees of freedom|p (Welch)|p (Holm)|p (Mann-Whitney)|its smallest p|"
        "Effect size|",
        "all|all|48|48|4|4|0.646|0.593|0.703|",
        "77.8|104|16|16|4|4|0.646|0.597|0.700|",
        "Temperature (°C)|log₁₀ a|Standard error|log₁₀ a of the law|log₁₀ b|Standard error|"
        "log₁₀ b, rubber elasticity|Overlap (decades)|Determined by overlap|Note|",
        "−30.0|5.4",
        "Reference isotherm off the law (decades)|0.00000|"
        "1.0×10⁻⁷|–|",
        "Superposition|holds|||misfit below ",
        "WLF C1|6.502|6.479 to 6.525||at 20.0 °C|",
        "WLF C2|110.06 K|109.83 to 110.30|||",
        "Bulk|7.99 MPa|5.99 to 10.65||48 curves, 4 spots|",
        "Degrees of freedom of its error|",
        "Friction coefficient|0.689|0.573 to 0.806|",
        "Friction with layer|0.557|",
        "Group|Equivalent frequency (rad/s)|Indentation (MPa)|95 % interval from (MPa)|to (MPa)|"
        "DMA E′ (MPa)|DMA |E*| (MPa)|Standard error (MPa)|Indentation / DMA|Outside measured "
        "frequencies|",
    };
    NEED_GNUPLOT();
    wt_result *result = fixture_only(tables, 5, &change);
    write_all("gnuplot", "not the program: it is looked up in PATH only\n");
    write_report(result, "out", NULL);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bool found = false;
        for (const char *row = strstr(page, "<tr>"); row != NULL && !found;
             row = strstr(row + 1, "<tr>")) {
            char words[512];
            read_row(row, words, sizeof words);
            found = strncmp(words, rows[i], strlen(rows[i])) == 0;
        }
        if (!found)
            fail_msg("no row of the page reads %s", rows[i]);
    }
    assert_int_equal(
        count_words(page, "<caption>Main numbers: 300 mm/s, 400 kPa, 30.0 °C</caption>"), 1);
    // The velocities are close to the decades of 1e-4 to 10 m/s.
    /* an error that does not apply is not a number */
    assert_non_null(strstr(page, "<th scope=\"row\">Reference temperature</th>"
                                 "<td class=\"n\" data-label=\"Value\">20 °C</td>"
                                 "<td class=\"n\" data-label=\"Standard error\">–</td>"));
    const char *friction = strstr(page, "<caption>Friction at the computed velocities next to");
    assert_non_null(friction);
    char *end = strstr(friction, "</table>");
    assert_non_null(end);
    *end = '\0';
    assert_int_equal(count_words(friction, "<tr>"), 1 + 6);
    free(page);
    wt_result_free(result);
}

static bool ran(const wt_table *cost, size_t row)
{
    return wt_table_number(cost, row, (size_t)wt_table_find(cost, "runs")) > 0;
}

/* Milliseconds, with two values of some seconds in the middle of the table. */
static void set_times(wt_table *cost, size_t row)
{
    fixture_put(cost, "wall_time", row == 3 || row == 4 ? 2 : 1e-3 * (double)(2 + row));
    fixture_put(cost, "cpu_time", 5);
}

/* The median decides, not the first value, the middle one or the mean. */
static void test_the_median_decides_the_unit(void **state)
{
    (void)state;
    const char *const cost = "cost";
    const fixture_change change = {cost, .keep = ran, .edit = set_times};
    wt_result *result = fixture_only(&cost, 1, &change);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, cost)), 12);
    write_report(result, "out", NULL);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    assert_non_null(strstr(page, "Wall time <span class=\"unit\">(ms)</span>"));
    assert_non_null(strstr(page, "Processor time <span class=\"unit\">(ms)</span>"));
    free(page);
    wt_result_free(result);
}

static void name_evil_group(wt_table *groups, size_t row)
{
    fixture_text(groups, "group", row == 0 ? FIXTURE_EVIL : "track");
}

static void test_nothing_from_a_file_is_run(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    assert_false(exists("fixture_was_run"));
    assert_false(exists("out/plots/fixture_was_run"));
    wt_result_free(result);

    // The group name is also a title in a script.
    const char *const groups = "modulus_groups";
    const fixture_change change = {groups, .edit = name_evil_group};
    result = fixture_only(&groups, 1, &change);
    write_report(result, "out", NULL);
    assert_true(exists("out/plots/modulus_groups.svg"));
    assert_false(exists("out/plots/fixture_was_run"));
    check_page("out/index.html", 1, 1);
    wt_result_free(result);

    // Without a result the title of the page describes its contents.
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    assert_non_null(strstr(page, "<title>Modulus of each group"));
    free(page);
}

static void test_the_same_bytes_twice(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    wt_report_options options = wt_report_defaults();
    options.with_provenance = false;
    write_report(result, "one", &options);
    write_report(result, "two", &options);
    for (size_t i = 0; i <= wt_figure_count(); i++) {
        char one[160], two[160];
        const char *name = i < wt_figure_count() ? wt_figure_get(i).name : NULL;
        (void)snprintf(one, sizeof one, name != NULL ? "one/plots/%s.svg" : "one/index.html", name);
        (void)snprintf(two, sizeof two, name != NULL ? "two/plots/%s.svg" : "two/index.html", name);
        size_t n = 0, m = 0;
        char *first = read_all(one, &n), *second = read_all(two, &m);
        assert_int_equal(n, m);
        assert_memory_equal(first, second, n);
        if (name == NULL) {
            assert_null(strstr(first, wt_version()));
            assert_null(strstr(first, "Wall time"));
            assert_null(strstr(first, "weartrack run"));
        }
        free(first);
        free(second);
    }
    wt_result_free(result);
}

/* Without its empty groups, because gnuplot writes one at its start. */
static size_t leave_out_empty_groups(char *picture)
{
    for (char *group = strstr(picture, "<g "); group != NULL; group = strstr(group, "<g ")) {
        char *end = strchr(group, '>');
        if (end != NULL && strncmp(end, ">\n</g>\n", 7) == 0)
            memmove(group, end + 7, strlen(end + 7) + 1);
        else
            group++;
    }
    return strlen(picture);
}

/* `cd plots && gnuplot NAME.gp` draws the same picture, also after the folder was moved. */
static void test_plots_can_be_drawn_again(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    assert_int_equal(rename("out", "moved"), 0);
    size_t n = 0, m = 0;
    char *before = read_all("moved/plots/layer.svg", &n);
    assert_int_equal(unlink("moved/plots/layer.svg"), 0);
    assert_int_equal(system("cd moved/plots && gnuplot -d layer.gp >/dev/null 2>&1"), 0); // NOLINT
    char *after = read_all("moved/plots/layer.svg", &m);
    n = leave_out_empty_groups(before);
    m = leave_out_empty_groups(after);
    assert_int_equal(n, m);
    assert_memory_equal(before, after, n);
    free(before);
    free(after);
    wt_result_free(result);
}

static bool keep_first(const wt_table *table, size_t row)
{
    (void)table;
    return row == 0;
}

static void forget_shearing(wt_table *friction, size_t row)
{
    (void)row;
    fixture_put(friction, "friction", (double)NAN);
    fixture_put(friction, "adhesion", (double)NAN);
}

static void forget_numbers(wt_table *table, size_t row)
{
    (void)row;
    for (size_t c = 0; c < wt_table_n_columns(table); c++)
        if (wt_table_column_kind(table, c) == WT_COLUMN_NUMBER)
            wt_table_set_number(table, c, (double)NAN);
}

static void test_missing_tables(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    /* Friction only: its figures and tables, nothing else. */
    static const char *const sliding[] = {"friction", "roughness", "contact_area"};
    const fixture_change none = {.table = NULL},
                         one = {.keep = keep_first, .edit = forget_shearing};
    wt_result *result = fixture_only(sliding, 3, &none);
    write_report(result, "friction", NULL);
    assert_true(exists("friction/plots/friction.svg"));
    assert_false(exists("friction/plots/layer.gp"));
    check_page("friction/index.html", 4, 2);
    wt_result_free(result);

    // One row and one velocity.
    result = fixture_only(sliding, 1, &one);
    write_report(result, "one", NULL);
    check_page("one/index.html", 1, 1);
    wt_result_free(result);
}

/* Tables without a number: the page states it. */
static void test_nothing_to_draw(void **state)
{
    (void)state;
    fixture_change changes[100];
    const wt_result *produced = fixture_produced();
    const size_t n = wt_result_n_tables(produced);
    assert_true(n <= sizeof changes / sizeof changes[0]);
    for (size_t i = 0; i < n; i++)
        changes[i] =
            (fixture_change){wt_table_name(wt_result_table(produced, i)), .edit = forget_numbers};
    wt_result *result = fixture_changed(produced, changes, n);
    wt_report_options options = wt_report_defaults();
    options.gnuplot = "/nonexistent";
    write_report(result, "out", &options);
    check_page("out/index.html", 0, 0);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    for (size_t i = 0; i < wt_figure_count(); i++) {
        char words[96];
        (void)snprintf(words, sizeof words, "Not drawn: %s – ", wt_figure_get(i).title);
        /* Most results have none of these. */
        static const char *const rare[] = {
            "modulus_map",     "relaxation",       "creep",       "relaxation_isotherms",
            "creep_isotherms", "record_velocity",  "record_load", "record_temperature",
            "validation",      "validation_course"};
        bool silent = false;
        for (size_t k = 0; k < sizeof rare / sizeof *rare; k++)
            silent = silent || strcmp(wt_figure_get(i).name, rare[k]) == 0;
        if ((strstr(page, words) == NULL) != silent)
            fail_msg("%s: is it said that it cannot be drawn?", wt_figure_get(i).name);
    }
    assert_non_null(strstr(page, "Not drawn: Master curve – there are no positive oscillatory "
                                 "moduli"));
    assert_null(strstr(page, ">nan<"));
    assert_false(exists("out/plots/style.gp"));
    free(page);
    wt_result_free(result);
}

static void test_an_empty_result_needs_no_gnuplot(void **state)
{
    (void)state;
    wt_result *result = wt_result_new();
    wt_report_options options = wt_report_defaults();
    options.gnuplot = "/nonexistent";
    write_report(result, "out", &options);
    check_page("out/index.html", 0, 0);
    wt_result_free(result);
}

/* ---- failures -------------------------------------------------------------------------------- */

static wt_status try_report(const wt_result *result, const char *folder,
                            const wt_report_options *options, wt_error *err)
{
    *err = (wt_error)WT_ERROR_INIT;
    return wt_report_write(result, folder, options, NULL, err);
}

static void test_no_gnuplot(void **state)
{
    (void)state;
    wt_result *result = fixture_result();
    wt_error err;
    static const char *const programs[] = {"/nonexistent", "no-such-program-xyz", "./neither"};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        wt_report_options options = wt_report_defaults();
        options.gnuplot = programs[i];
        assert_int_equal(try_report(result, "out", &options, &err), WT_E_TOOL);
        assert_non_null(strstr(err.advice, "apt-get install gnuplot-nox"));
        assert_string_equal(err.file, programs[i]);
    }
    assert_int_equal(count_files("."), 0);
    wt_result_free(result);
}

static void test_messages_of_gnuplot(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    wt_error err;
    write_all("bad.gp", "set terminal svg\nthis is no command\n");
    wt_report_options options = wt_report_defaults();
    options.style = "bad.gp";
    assert_int_equal(try_report(result, "out", &options, &err), WT_E_TOOL);
    assert_non_null(strstr(err.found, "style.gp"));
    assert_non_null(strstr(err.found, "line 2"));
    write_all("bad.gp", "set terminal dumb\n");
    assert_int_equal(try_report(result, "out", &options, &err), WT_E_TOOL);
    assert_non_null(strstr(err.advice, "svg"));
    options.style = "nosuch";
    assert_int_equal(try_report(result, "out", &options, &err), WT_E_NOT_FOUND);
    assert_non_null(strstr(err.expected, "paper, screen"));
    options.style = "./nosuch.gp";
    assert_int_equal(try_report(result, "out", &options, &err), WT_E_NOT_FOUND);
    assert_int_equal(count_files("."), 1);
    options.style = "screen";
    write_report(result, "out", &options);
    wt_result_free(result);
}

static void two_seconds(wt_table *copy, size_t row)
{
    (void)row;
    fixture_put(copy, "cpu_time", 1.7);
}

/* With long names a panel is narrow, so that numbers of four digits would overlap. */
static void test_few_numbers_on_a_narrow_axis(void **state)
{
    (void)state;
    const char *const table = "cost";
    NEED_GNUPLOT();
    wt_result *result =
        fixture_only(&table, 1, &(fixture_change){.table = "cost", .edit = two_seconds});
    write_report(result, "out", NULL);
    size_t length = 0;
    char *script = read_all("out/plots/cost.gp", &length);
    const char *const range = strstr(script, "set xrange [0:"), *const tics =
                                                                    strstr(script, "set xtics ");
    assert_true(range != NULL && tics != NULL);
    const double end = strtod(range + strlen("set xrange [0:"), NULL),
                 step = strtod(tics + strlen("set xtics "), NULL);
    assert_true(step > 0 && end / step < 4.5);
    free(script);
    wt_result_free(result);
}

static bool first_row(const wt_table *table, size_t row)
{
    (void)table;
    return row == 0;
}

static void half_area(wt_table *copy, size_t row)
{
    (void)row;
    fixture_put(copy, "isotropic_area_ratio", 0.5);
}

/* A case of one velocity is a point, not a line. The isotropic rubber is dashed in the colour of
 * its velocity. */
static void test_cases_side_by_side(void **state)
{
    static const struct {
        const char *table, *script, *holds;
        fixture_change change;
    } tried[] = {{"collected_friction",
                  "out/plots/collected_friction.gp",
                  " with points ls 1",
                  {.table = "collected_friction", .keep = first_row}},
                 {"contact_area",
                  "out/plots/contact_area.gp",
                  ":($3*y_unit):($4*cb_unit) with lines lw 1.8 dt (6,3) lc palette",
                  {.table = "contact_area", .edit = half_area}}};
    (void)state;
    NEED_GNUPLOT();
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        wt_result *result = fixture_only(&tried[i].table, 1, &tried[i].change);
        write_report(result, "out", NULL);
        size_t length = 0;
        char *script = read_all(tried[i].script, &length);
        if (strstr(script, tried[i].holds) == NULL)
            fail_msg("%s lacks %s", tried[i].script, tried[i].holds);
        free(script);
        wt_result_free(result);
    }
}

static void known_well(wt_table *copy, size_t row)
{
    (void)row;
    fixture_put(copy, "friction_coefficient", 0.6078605);
    fixture_put(copy, "friction_coefficient_low", 0.6075830);
    fixture_put(copy, "friction_coefficient_high", 0.6081380);
    fixture_put(copy, "paused_time", 0);
}

/* A cell has the digits of its interval if three digits would make the limits equal; zeros have the
 * unit without a prefix. */
static void test_digits_of_intervals(void **state)
{
    (void)state;
    static const char *const cells[] = {">0.60786</td>", ">0.60758</td>", ">0.60814</td>",
                                        "Time paused <span class=\"unit\">(s)</span>"};
    const char *const table = "record";
    NEED_GNUPLOT();
    wt_result *result =
        fixture_only(&table, 1, &(fixture_change){.table = "record", .edit = known_well});
    write_report(result, "out", NULL);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++)
        if (strstr(page, cells[i]) == NULL)
            fail_msg("the page lacks: %s", cells[i]);
    free(page);
    wt_result_free(result);
}

static void test_only_reports_are_replaced(void **state)
{
    (void)state;
    wt_result *result = wt_result_new();
    wt_error err;
    /* An empty folder may be used; an older report may be replaced. */
    assert_int_equal(mkdir("out", 0777), 0);
    write_report(result, "out/", NULL);
    /* Foreign files stay and stop nothing; obsolete pictures are removed. */
    static const char *const strays[] = {"out/notes.txt",      "out/.DS_Store",
                                         "out/Thumbs.db",      "out/plots/figure.pdf",
                                         "out/plots/mine.svg", "out/plots/.DS_Store",
                                         "out/mine/sub/a.txt", "out/plots/friction.gp.orig"};
    assert_int_equal(mkdir("out/mine", 0777), 0);
    assert_int_equal(mkdir("out/mine/sub", 0777), 0);
    for (size_t i = 0; i < sizeof strays / sizeof *strays; i++)
        write_all(strays[i], strays[i]);
    write_all("out/plots/friction.svg", "<svg/>");
    write_report(result, "out", NULL);
    for (size_t i = 0; i < sizeof strays / sizeof *strays; i++) {
        size_t length = 0;
        char *text = read_all(strays[i], &length);
        assert_string_equal(text, strays[i]);
        free(text);
    }
    assert_false(exists("out/plots/friction.svg"));
    assert_int_equal(count_files("out"), 2 + 4);
    /* An empty folder that a file manager has opened. */
    assert_int_equal(mkdir("seen", 0777), 0);
    write_all("seen/.DS_Store", "x");
    write_all("seen/Thumbs.db", "x");
    write_report(result, "seen", NULL);
    assert_true(exists("seen/index.html") && exists("seen/.DS_Store") && exists("seen/Thumbs.db"));
    remove_all("seen");
    /* A foreign "plots" that points elsewhere is unchanged. */
    remove_all("out/plots");
    assert_int_equal(symlink("mine", "out/plots"), 0);
    assert_int_equal(try_report(result, "out", NULL, &err), WT_E_IO);
    assert_true(exists("out/mine/sub/a.txt") && exists("out/plots"));
    assert_int_equal(unlink("out/plots"), 0);
    // Somebody's own folder.
    assert_int_equal(mkdir("own", 0777), 0);
    write_all("own/notes.txt", "mine");
    assert_int_equal(try_report(result, "own", NULL, &err), WT_E_IO);
    assert_non_null(strstr(err.found, "notes.txt"));
    assert_int_equal(count_files("own"), 1);
    remove_all("own");
    // A page that is not ours.
    assert_int_equal(mkdir("site", 0777), 0);
    write_all("site/index.html", "<html><meta name=\"generator\" content=\"other\"></html>");
    assert_int_equal(try_report(result, "site", NULL, &err), WT_E_IO);
    assert_non_null(strstr(err.advice, "another name"));
    assert_true(exists("site/index.html"));
    /* A file, the folder itself, an impossible path. */
    write_all("file", "x");
    assert_int_equal(try_report(result, "file", NULL, &err), WT_E_IO);
    assert_int_equal(try_report(result, ".", NULL, &err), WT_E_ARG);
    assert_int_equal(try_report(result, "/", NULL, &err), WT_E_ARG);
    assert_int_equal(try_report(result, "a/b/..", NULL, &err), WT_E_ARG);
    assert_int_equal(try_report(result, "no/such/place", NULL, &err), WT_E_IO);
    assert_int_equal(count_files("."), 3);
    // Through a symbolic link: the link stays.
    assert_int_equal(mkdir("real", 0777), 0);
    assert_int_equal(symlink("real", "link"), 0);
    write_report(result, "link", NULL);
    assert_true(exists("real/index.html"));
    char target[16];
    assert_true(readlink("link", target, sizeof target) == 4);
    wt_result_free(result);
}

/* A single file equals that in a folder; it replaces an older page of weartrack and nothing
 * else. */
static void test_a_page_alone(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    const char *const table = "friction";
    wt_result *result = fixture_only(&table, 1, &(fixture_change){.table = NULL});
    wt_error err;
    size_t n = 0, m = 0;
    write_report(result, "out", NULL);
    write_report(result, "page.html", NULL);
    assert_int_equal(count_files("."), 2);
    char *folder = read_all("out/index.html", &n), *alone = read_all("page.html", &m);
    assert_int_equal(n, m);
    assert_memory_equal(folder, alone, n);
    free(folder);
    // The data are inside, the same as in the folder.
    char *data = read_all("out/plots/friction.tsv", &n);
    const char *link =
        strstr(alone, "download=\"friction.tsv\" href=\"data:text/plain;charset=utf-8,");
    assert_non_null(link);
    link = strchr(link, ',') + 1;
    for (size_t i = 0; i < n; i++, link++) {
        unsigned code = (unsigned char)*link;
        if (*link == '%') {
            assert_int_equal(sscanf(link + 1, "%2x", &code), 1);
            link += 2;
        }
        assert_int_equal(code, (unsigned char)data[i]);
    }
    assert_int_equal(*link, '"');
    free(data);
    free(alone);
    // With the permissions that it had.
    assert_int_equal(chmod("page.html", 0640), 0);
    write_report(result, "page.html", NULL);
    struct stat info;
    assert_int_equal(stat("page.html", &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    // Not one of somebody else, not a link to one.
    write_all("own.html", "<html></html>");
    assert_int_equal(symlink("own.html", "link.html"), 0);
    assert_int_equal(try_report(result, "own.html", NULL, &err), WT_E_IO);
    assert_int_equal(try_report(result, "link.html", NULL, &err), WT_E_IO);
    char *own = read_all("own.html", &n);
    assert_string_equal(own, "<html></html>");
    free(own);
    // A folder may have such a name.
    assert_int_equal(mkdir("folder.html", 0777), 0);
    write_report(result, "folder.html", NULL);
    assert_true(exists("folder.html/index.html") && exists("folder.html/plots/friction.gp"));
    assert_int_equal(count_files("."), 5);
    wt_result_free(result);
}

/* The page of strain sweeps has their numbers, though no figure shows them. */
static void test_strain_sweeps(void **state)
{
    (void)state;
    const char *const payne = "payne";
    const fixture_change change = {.table = payne};
    wt_result *result = fixture_only(&payne, 1, &change);
    write_report(result, "out", NULL);
    size_t length = 0;
    char *page = read_all("out/index.html", &length);
    assert_non_null(strstr(page, "Storage modulus, smallest strain"));
    assert_non_null(strstr(page, ">4.87</td>"));
    free(page);
    wt_result_free(result);
}

static void give_law(wt_table *shifts)
{
    fixture_key(shifts, "law_slope", -0.1, (double)NAN, "1/K");
}

/* A stated law is not called fitted, and has no band. */
static void test_a_given_law(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    const char *const shifts = "shift_factors";
    for (int given = 0; given < 2; given++) {
        const fixture_change change = {shifts, .finish = given == 1 ? give_law : NULL};
        wt_result *result = fixture_only(&shifts, 1, &change);
        size_t length = 0;
        write_report(result, "out", NULL);
        char *page = read_all("out/index.html", &length);
        assert_int_equal(strstr(page, "by which the shifts were given") != NULL, given);
        assert_int_equal(strstr(page, "band: its 95 % interval") == NULL, given);
        free(page);
        wt_result_free(result);
    }
}

static void many_groups(wt_table *depths, size_t row)
{
    char name[16];
    (void)snprintf(name, sizeof name, "spot %zu", row % 8);
    fixture_text(depths, "group", name);
}

/* A number above the colours of a figure is reported. */
static void test_too_many_groups(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    const char *const depths = "modulus_depth";
    const fixture_change change = {depths, .edit = many_groups};
    wt_result *result = fixture_only(&depths, 1, &change);
    size_t length = 0;
    write_report(result, "out", NULL);
    char *page = read_all("out/index.html", &length);
    assert_non_null(strstr(page, "Only the first 6 are drawn."));
    free(page);
    wt_result_free(result);
}

/* The permissions, also of the folder, are those of the older report. */
static void test_permissions_are_kept(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        mode_t new_mode, set;
    } files[] = {{"out", 0750, 0700}, {"out/plots", 0750, 0700}, {"out/index.html", 0640, 0604}};
    wt_result *result = wt_result_new();
    struct stat info;
    const mode_t before = umask(027);
    write_report(result, "out", NULL);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(stat(files[i].path, &info), 0);
        assert_int_equal(info.st_mode & 0777, files[i].new_mode);
    }
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(chmod(files[i].path, files[i].set), 0);
    write_report(result, "out", NULL);
    (void)umask(before);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(stat(files[i].path, &info), 0);
        assert_int_equal(info.st_mode & 0777, files[i].set);
    }
    wt_result_free(result);
}

/* Writes a report in another process, and pauses while it draws. */
static pid_t draw_slowly(const wt_result *result, const char *folder, const char *gnuplot)
{
    const pid_t writer = fork();
    if (writer == 0) {
        wt_report_options options = wt_report_defaults();
        options.gnuplot = gnuplot;
        _exit(wt_report_write(result, folder, &options, NULL, NULL) == WT_OK ? 0 : 1);
    }
    assert_true(writer > 0);
    return writer;
}

/* gnuplot only writes in its folder: that of a new report, or one in the report folder. */
static void wait_for(const char *name)
{
    bool found = false;
    char pattern[64];
    for (int i = 0; i < 2000 && !found; i++) {
        static const char *const places[] = {".weartrack-*/plots/", "out/.weartrack-*/plots/"};
        glob_t matches;
        (void)snprintf(pattern, sizeof pattern, "%s%s", places[i % 2], name);
        found = glob(pattern, 0, NULL, &matches) == 0;
        globfree(&matches);
        (void)usleep(5000);
    }
    assert_true(found);
}

/* The next run removes the files of a killed one, in a new folder and over an older report; it does
 * not touch those of a live run. */
static void test_leftovers(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    const char *const table = "friction";
    wt_result *result = fixture_only(&table, 1, &(fixture_change){.table = NULL});
    write_all("slow", "#!/bin/sh\n: > slow_begun\nexec sleep 100\n");
    write_all("later",
              "#!/bin/sh\n: > later_begun\nsleep 1\nrm later_begun\nexec gnuplot \"$@\"\n");
    assert_int_equal(chmod("slow", 0755) + chmod("later", 0755), 0);
    for (int again = 0; again < 2; again++) {
        const pid_t killed = draw_slowly(result, "out", "./slow");
        wait_for("slow_begun");
        assert_int_equal(kill(killed, SIGKILL), 0);
        assert_int_equal(waitpid(killed, NULL, 0), killed);
        const pid_t alive = draw_slowly(result, "out", "./later");
        wait_for("later_begun");
        write_report(result, "out", NULL); /* into the same folder while the other one draws */
        write_report(result, "other", NULL);
        int end = -1;
        assert_int_equal(waitpid(alive, &end, 0), alive);
        assert_int_equal(end, 0);
        assert_int_equal(count_files("out"), 2);
        assert_int_equal(count_files("out/plots"), 5);
        assert_int_equal(count_files("."), 4); // out, other, and the two programs
    }
    wt_result_free(result);
}

static bool cancel_at(void *user, const char *what, size_t done, size_t total)
{
    assert_non_null(what);
    assert_true(done <= total);
    assert_int_equal(total, wt_figure_count() + 1); // the page is the last step
    return done < *(const size_t *)user;
}

static void test_cancelled(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    for (size_t step = 0; step <= wt_figure_count(); step += wt_figure_count() / 2) {
        const wt_progress progress = {cancel_at, &step};
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_report_write(result, "out", NULL, &progress, &err), WT_E_CANCELLED);
        assert_int_equal(count_files("."), 0);
    }
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_figure_is_listed_once),
        cmocka_unit_test(test_the_man_pages_name_every_figure),
        cmocka_unit_test_setup_teardown(test_everything, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_page, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_strain_sweeps, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_a_given_law, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_too_many_groups, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_tables_on_the_page, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_the_median_decides_the_unit, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_nothing_from_a_file_is_run, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_the_same_bytes_twice, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_plots_can_be_drawn_again, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_missing_tables, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_nothing_to_draw, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_an_empty_result_needs_no_gnuplot, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_no_gnuplot, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_messages_of_gnuplot, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_only_reports_are_replaced, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_few_numbers_on_a_narrow_axis, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_cases_side_by_side, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_digits_of_intervals, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_a_page_alone, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_permissions_are_kept, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_leftovers, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_cancelled, create_work_folder, remove_work_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
