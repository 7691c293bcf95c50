/* The report room: the folder with its figures and its page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"
#include "report_fixture.h"
#include "weartrack/report.h"

#include <dirent.h>
#include <libxml/parser.h>
#include <libxml/xpath.h>
#include <libxml/xpathInternals.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- helpers ----------------------------------------------------------------------------------
 */

/* Every test works in a folder of its own, so that nothing depends on another test. */
static int make_workplace(void **state)
{
    char *folder = strdup("/tmp/weartrack-report-XXXXXX");
    if (folder == NULL || mkdtemp(folder) == NULL || chdir(folder) != 0)
        return -1;
    *state = folder;
    return 0;
}

static void remove_all(const char *path)
{
    DIR *folder = unlink(path) == 0 ? NULL : opendir(path); // a link is removed, not followed
    if (folder == NULL)
        return;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        char *inner = wt_path_join(path, entry->d_name);
        remove_all(inner);
        free(inner);
    }
    closedir(folder);
    (void)rmdir(path);
}

static int remove_workplace(void **state)
{
    int status = chdir("/");
    remove_all(*state);
    free(*state);
    return status;
}

static char *read_all(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        fail_msg("%s is not there", path);
    (void)fseek(file, 0, SEEK_END);
    long size = ftell(file);
    assert_true(size >= 0);
    rewind(file);
    char *bytes = malloc((size_t)size + 1);
    assert_non_null(bytes);
    *length = fread(bytes, 1, (size_t)size, file);
    bytes[*length] = '\0';
    (void)fclose(file);
    return bytes;
}

static void write_all(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static bool exists(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0;
}

static size_t count_files(const char *path)
{
    size_t n = 0;
    DIR *folder = opendir(path);
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        n += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return n;
}

static bool have_gnuplot(void)
{
    const char *path = getenv("PATH");
    char *copy = strdup(path != NULL ? path : ""), *rest = NULL;
    bool found = false;
    for (char *part = strtok_r(copy, ":", &rest); part != NULL && !found;
         part = strtok_r(NULL, ":", &rest)) {
        char *program = wt_path_join(part, "gnuplot");
        found = program != NULL && access(program, X_OK) == 0;
        free(program);
    }
    free(copy);
    return found;
}

#define NEED_GNUPLOT()                                                                             \
    do {                                                                                           \
        if (!have_gnuplot())                                                                       \
            skip();                                                                                \
    } while (0)

static void write_report(const wt_result *result, const char *folder,
                         const wt_report_options *options)
{
    wt_error err = WT_ERROR_INIT;
    if (wt_report_write(result, folder, options, NULL, &err) != WT_OK) {
        char line[1600];
        (void)wt_error_format(&err, line, sizeof line);
        fail_msg("%s", line);
    }
}

/* ---- the whole --------------------------------------------------------------------------------
 */

static void test_every_figure_is_listed_once(void **state)
{
    (void)state;
    size_t n = wt_figure_count();
    assert_true(n >= 12);
    for (size_t i = 0; i < n; i++) {
        const wt_figure_info *info = wt_figure_get(i);
        assert_non_null(info->needs[0]);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(info->name, wt_figure_get(k)->name);
    }
    assert_null(wt_figure_get(n));
}

static void test_the_man_page_names_every_figure(void **state)
{
    (void)state;
    size_t length = 0;
    char *page = read_all(WT_SOURCE_DIR "/man/weartrack-report.1", &length);
    for (size_t i = 0; i < wt_figure_count(); i++)
        if (strstr(page, wt_figure_get(i)->name) == NULL)
            fail_msg("figure %s is not in the man page", wt_figure_get(i)->name);
    free(page);
}

static void test_everything(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    assert_int_equal(count_files("out"), 2);
    assert_int_equal(count_files("out/plots"), 3 * wt_figure_count() + 1);
    assert_true(exists("out/plots/style.gp"));
    for (size_t i = 0; i < wt_figure_count(); i++) {
        static const char *const endings[] = {"tsv", "gp", "svg"};
        for (size_t k = 0; k < 3; k++) {
            char path[160];
            (void)snprintf(path, sizeof path, "out/plots/%s.%s", wt_figure_get(i)->name,
                           endings[k]);
            size_t length = 0;
            char *bytes = read_all(path, &length);
            assert_true(length > 200);
            if (k == 1) { // relative names only, and nothing that runs a program
                assert_null(strstr(bytes, "/tmp"));
                assert_null(strstr(bytes, "`"));
                assert_null(strstr(bytes, "system"));
            }
            free(bytes);
        }
    }
    assert_int_equal(count_files("."), 1); // nothing temporary is left beside it
    wt_result_free(result);
}

/* The data of a figure are tables of the text stream. */
static void test_data_can_be_read_back(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result();
    write_report(result, "out", NULL);
    for (size_t i = 0; i < wt_figure_count(); i++) {
        char path[160];
        (void)snprintf(path, sizeof path, "out/plots/%s.tsv", wt_figure_get(i)->name);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        wt_status status;
        size_t n = 0;
        do {
            wt_table *table = NULL;
            status = wt_stream_read(file, path, &table, NULL);
            n += status == WT_OK;
            assert_true(status == WT_END || (status == WT_OK && wt_table_n_rows(table) > 0));
            wt_table_free(table);
        } while (status == WT_OK);
        assert_true(n > 0);
        (void)fclose(file);
    }
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
    // The answer stands before everything else.
    const char *answer = strstr(page, "Is there a modified layer?"),
               *numbers = strstr(page, "id=\"numbers\""), *figure = strstr(page, "<figure");
    assert_non_null(answer);
    assert_non_null(numbers);
    assert_non_null(figure);
    assert_true(answer < numbers && numbers < figure);
    static const char *const expected[] = {
        "<h1>EPDM, high carbon black, severe &lt;case&gt;</h1>",
        // value, interval, no numerical error
        ">0.636</td><td class=\"n\">0.587 to 0.688 (95 % interval)</td><td class=\"n\">–</td>",
        ">20.05 MPa</td>",
        ">1.15 µm</td><td class=\"n\">± 0.21 µm</td><td class=\"n\">± 2.0×10⁻⁶ µm</td>",
        "bulk: 4 of 36 curves rejected",
        "R^2 0.71 below 0.90 &lt;i&gt;",
        "&lt;b&gt;&#39;`touch fixture_was_run`&quot;&amp;;$(rm -r x)\\",
        "Correlation of C₁ and C₂</th><td colspan=\"3\">0.987</td>",
        "left out: nothing asked for it",
        "&lt;case title=&quot;HC &amp;amp; severe&quot;&gt;",
        "weartrack run &#39;&lt;case&gt;.xml&#39;",
        "9f86d081884c7d659a2feaa0c55ad015",
        "@media (prefers-color-scheme: dark)",
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (strstr(page, expected[i]) == NULL)
            fail_msg("the page lacks: %s", expected[i]);
    free(page);
    wt_result_free(result);
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

    // Also where a text becomes a title in a script: a group of that name.
    result = wt_result_new();
    wt_table *groups = fixture_table("modulus_groups", "",
                                     "group:T n:1 n_rejected:1 "
                                     "geometric_mean:Pa low:Pa high:Pa");
    fixture_row(groups);
    fixture_text(groups, "group", FIXTURE_EVIL);
    fixture_put(groups, "geometric_mean", 1e7);
    fixture_put(groups, "low", 0.9e7);
    fixture_put(groups, "high", 1.1e7);
    fixture_add(result, groups);
    write_report(result, "out", NULL);
    assert_true(exists("out/plots/modulus_groups.svg"));
    assert_false(exists("out/plots/fixture_was_run"));
    check_page("out/index.html", 1, 2);
    wt_result_free(result);
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
        const char *name = i < wt_figure_count() ? wt_figure_get(i)->name : NULL;
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

/* `cd plots && gnuplot NAME.gp` gives the same picture, also after the folder has moved. */
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
    assert_int_equal(n, m);
    assert_memory_equal(before, after, n);
    free(before);
    free(after);
    wt_result_free(result);
}

static void test_missing_tables(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    // Friction only: one figure, its tables, nothing else.
    wt_result *result = wt_result_new();
    fixture_friction(result);
    write_report(result, "friction", NULL);
    assert_true(exists("friction/plots/friction.svg"));
    assert_false(exists("friction/plots/layer.gp"));
    check_page("friction/index.html", 4, 3);
    wt_result_free(result);

    // One row and one velocity.
    result = wt_result_new();
    wt_table *table = fixture_table("friction", "", "velocity:m/s hysteresis:1");
    fixture_row(table);
    fixture_put(table, "velocity", 0.1);
    fixture_put(table, "hysteresis", 0.3);
    fixture_add(result, table);
    write_report(result, "one", NULL);
    check_page("one/index.html", 1, 1);
    wt_result_free(result);

    // Nothing to draw: tables without a single number. The page says so.
    result = wt_result_new();
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const char *name = wt_figure_get(i)->needs[0];
        if (wt_result_find(result, name) != NULL)
            continue;
        table = fixture_table(name, "", "group:T velocity:m/s time:s density:m^4 depth:m");
        fixture_row(table);
        fixture_text(table, "group", "bulk");
        fixture_add(result, table);
    }
    write_report(result, "nothing", NULL);
    check_page("nothing/index.html", 0, 0);
    size_t length = 0;
    char *page = read_all("nothing/index.html", &length);
    assert_non_null(strstr(page, "Not drawn: Master curve – no point of the master curve"));
    assert_false(exists("nothing/plots/style.gp"));
    free(page);
    wt_result_free(result);
}

/* A copy of a table with text for numbers and numbers for text. */
static wt_table *swapped(const wt_table *table)
{
    wt_table *copy = wt_table_new(wt_table_name(table), wt_table_title(table));
    for (size_t c = 0; c < wt_table_n_columns(table); c++) {
        const char *name = wt_table_column_name(table, c);
        fixture_check(wt_table_column_kind(table, c) == WT_COLUMN_TEXT
                          ? wt_table_add_column(copy, name, "1", name, NULL)
                          : wt_table_add_text_column(copy, name, name, NULL));
    }
    for (size_t row = 0; row < wt_table_n_rows(table) && row < 20; row++) {
        fixture_row(copy);
        for (size_t c = 0; c < wt_table_n_columns(table); c++)
            if (wt_table_column_kind(copy, c) == WT_COLUMN_TEXT)
                fixture_check(wt_table_put_text(copy, c, "1e3", NULL));
            else
                wt_table_put(copy, c, 1e3);
    }
    return copy;
}

/* A model without incubation still states its time; the curve then shows none, nor may a mark. */
static void test_incubation_is_marked_where_the_curve_shows_it(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    for (int grows = 0; grows < 2; grows++) {
        wt_result *result = wt_result_new();
        wt_table *table = fixture_table("layer", "", "time:s thickness:m");
        for (int i = 0; i < 12; i++) {
            fixture_row(table);
            fixture_put(table, "time", 0.1 * (i + 1));
            fixture_put(table, "thickness", grows || i > 4 ? 1e-7 * (i + 1) : 0);
        }
        fixture_key(table, "incubation_time", 0.5, 0, 0, "s");
        fixture_add(result, table);
        write_report(result, "out", NULL);
        size_t length = 0;
        char *script = read_all("out/plots/layer.gp", &length);
        assert_int_equal(strstr(script, "incubation") == NULL, grows);
        free(script);
        wt_result_free(result);
    }
}

/* Results come from files, so a table of a known name may hold anything. */
static void test_columns_of_the_wrong_kind(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    wt_result *result = fixture_result(), *odd = wt_result_new();
    for (size_t i = 0; i < wt_result_n_tables(result); i++)
        fixture_add(odd, swapped(wt_result_table(result, i)));
    write_report(odd, "out", NULL);
    check_page("out/index.html", 0, 1);
    wt_result_free(odd);
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

/* ---- failures ---------------------------------------------------------------------------------
 */

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

static void test_words_of_gnuplot(void **state)
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

static void test_only_reports_are_replaced(void **state)
{
    (void)state;
    wt_result *result = wt_result_new();
    wt_error err;
    // An empty folder may be taken; an older report may be replaced.
    assert_int_equal(mkdir("out", 0777), 0);
    write_report(result, "out/", NULL);
    write_all("out/plots/old.svg", "<svg/>");
    write_report(result, "out", NULL);
    assert_int_equal(count_files("out/plots"), 0);
    // A file of the user's stays, and the report is refused.
    write_all("out/notes.txt", "mine");
    assert_int_equal(try_report(result, "out", NULL, &err), WT_E_IO);
    assert_non_null(strstr(err.found, "notes.txt"));
    assert_true(exists("out/notes.txt") && exists("out/index.html"));
    assert_int_equal(unlink("out/notes.txt"), 0);
    write_all("out/plots/figure.pdf", "mine");
    assert_int_equal(try_report(result, "out", NULL, &err), WT_E_IO);
    assert_true(exists("out/plots/figure.pdf"));
    // A page that is not ours.
    assert_int_equal(mkdir("site", 0777), 0);
    write_all("site/index.html", "<html><meta name=\"generator\" content=\"other\"></html>");
    assert_int_equal(try_report(result, "site", NULL, &err), WT_E_IO);
    assert_non_null(strstr(err.advice, "another folder"));
    assert_true(exists("site/index.html"));
    // A file, the folder itself, a place that cannot be.
    write_all("file", "x");
    assert_int_equal(try_report(result, "file", NULL, &err), WT_E_IO);
    assert_int_equal(try_report(result, ".", NULL, &err), WT_E_ARG);
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

static bool cancel_at(void *user, const char *what, size_t done, size_t total)
{
    assert_non_null(what);
    assert_true(done <= total);
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
        cmocka_unit_test(test_the_man_page_names_every_figure),
        cmocka_unit_test_setup_teardown(test_everything, make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_data_can_be_read_back, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_page, make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_nothing_from_a_file_is_run, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_the_same_bytes_twice, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_plots_can_be_drawn_again, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_missing_tables, make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_incubation_is_marked_where_the_curve_shows_it,
                                        make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_columns_of_the_wrong_kind, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_an_empty_result_needs_no_gnuplot, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_no_gnuplot, make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_words_of_gnuplot, make_workplace, remove_workplace),
        cmocka_unit_test_setup_teardown(test_only_reports_are_replaced, make_workplace,
                                        remove_workplace),
        cmocka_unit_test_setup_teardown(test_cancelled, make_workplace, remove_workplace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
