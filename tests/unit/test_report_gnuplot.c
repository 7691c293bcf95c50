/* Input and behaviour of gnuplot: hostile texts, a gnuplot that hangs, writes too much, dies or
 * leaves child processes, a report that is killed while it draws.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"
#include "report_folder.h"

#include <errno.h>
#include <libxml/parser.h>
#include <signal.h>
#include <sys/wait.h>

/* ---- texts ----------------------------------------------------------------------------------- */

static const char *hostile;

static void rename_first_group(wt_table *table, size_t row)
{
    const long group = wt_table_find(table, "group");
    if (group >= 0 && strcmp(wt_table_text(table, row, (size_t)group), "bulk") == 0)
        fixture_text(table, "group", hostile);
}

/* Text between the tags of a picture, with entities resolved. */
static bool picture_says(const char *path, const char *words)
{
    xmlDoc *picture = xmlReadFile(path, NULL, XML_PARSE_NONET | XML_PARSE_NOERROR);
    if (picture == NULL)
        fail_msg("%s is not well-formed", path);
    xmlChar *text = xmlNodeGetContent(xmlDocGetRootElement(picture));
    const bool found = strstr((const char *)text, words) != NULL;
    xmlFree(text);
    xmlFreeDoc(picture);
    return found;
}

static void test_hostile_texts(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    static const struct {
        const char *group, *drawn; /* NULL: unchanged */
    } texts[] = {
        {"'", NULL},
        {"'quoted'", NULL},
        {"a''b", NULL},
        {"\"", NULL},
        {"\"q\" . system('touch run')", NULL},
        {"100 %s", NULL},
        {"%d%n%", NULL},
        {"@GPVAL_PWD \"@GPVAL_PWD\" '@GPVAL_PWD", NULL},
        {"`touch run`'`touch run`\"`touch run`", NULL},
        {"$(touch run) $1 ${x}", NULL},
        {"a_b^c{d}&~e {/:Bold=20 x}", NULL},
        {"tail\\", NULL},
        {"\\n\\t\\047", NULL},
        {"# no comment", NULL},
        {"a\nset output 'run'\n", "a set output 'run' "},
        {"\x01\x7f\xff\xc3(", "  \xef\xbf\xbd\xef\xbf\xbd("},
        {"<tspan>]]></text> &amp; id='gnuplot_canvas'",
         "<tspan>]] ></text> &amp; id='gnuplot_canvas'"},
        {" -", NULL},
    };
    static const char *const figures[] = {"modulus_groups", "modulus_rate", "force_indentation"};
    const fixture_change change = {.edit = rename_first_group};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        hostile = texts[k].group;
        wt_result *result = fixture_only(figures, 3, &change); // named as their tables
        write_report(result, "out", NULL);
        for (size_t i = 0; i < 3; i++) {
            char path[96];
            (void)snprintf(path, sizeof path, "out/plots/%s.svg", figures[i]);
            if (!picture_says(path, texts[k].drawn != NULL ? texts[k].drawn : hostile))
                fail_msg("%s lacks: %s", path, hostile);
        }
        assert_true(picture_says("out/index.html", "Modulus"));
        assert_false(exists("run") || exists("out/plots/run"));
        wt_result_free(result);
    }
    // A text of a megabyte.
    char *const long_text = malloc(1000001);
    assert_non_null(long_text);
    memset(long_text, '\'', 1000000);
    long_text[1000000] = '\0';
    hostile = long_text;
    wt_result *result = fixture_only(figures, 3, &change);
    write_report(result, "out", NULL);
    wt_result_free(result);
    free(long_text);
}

/* Settings of the user change nothing and execute nothing. */
static void test_settings_of_the_user(void **state)
{
    (void)state;
    NEED_GNUPLOT();
    static const char *const variables[] = {"HOME", "GNUPLOT_LIB", "XDG_CONFIG_HOME"};
    const char *const table = "friction";
    wt_result *result = fixture_only(&table, 1, &(fixture_change){.table = NULL});
    char *home = getcwd(NULL, 0), *before[3];
    size_t length[2] = {0, 0};
    write_report(result, "one", NULL);
    assert_int_equal(mkdir("gnuplot", 0777), 0);
    static const char *const files[] = {".gnuplot", "gnuplotrc", "gnuplot/gnuplotrc", "style.gp"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        write_all(files[i], "system('touch run')\n");
    for (size_t i = 0; i < 3; i++) {
        const char *value = getenv(variables[i]);
        before[i] = value != NULL ? strdup(value) : NULL;
        assert_int_equal(setenv(variables[i], home, 1), 0);
    }
    assert_int_equal(setenv("GNUTERM", "dumb", 1), 0);
    write_report(result, "two", NULL);
    for (size_t i = 0; i < 3; i++) {
        if (before[i] != NULL)
            assert_int_equal(setenv(variables[i], before[i], 1), 0);
        else
            assert_int_equal(unsetenv(variables[i]), 0);
        free(before[i]);
    }
    assert_int_equal(unsetenv("GNUTERM"), 0);
    assert_false(exists("run") || exists("two/plots/run"));
    char *one = read_all("one/plots/friction.svg", &length[0]),
         *two = read_all("two/plots/friction.svg", &length[1]);
    assert_int_equal(length[0], length[1]);
    assert_memory_equal(one, two, length[0]);
    free(one);
    free(two);
    free(home);
    wt_result_free(result);
}

/* ---- a gnuplot that fails -------------------------------------------------------------------- */

static void write_program(const char *name, const char *script)
{
    char text[1024];
    (void)snprintf(text, sizeof text, "#!/bin/sh\n%s", script);
    write_all(name, text);
    assert_int_equal(chmod(name, 0755), 0);
}

static wt_result *one_figure(void)
{
    const char *const table = "friction";
    return fixture_only(&table, 1, &(fixture_change){.table = NULL});
}

static void test_programs_that_hang_flood_and_die(void **state)
{
    (void)state;
    static const struct {
        const char *script, *message, *found;
        bool late;
    } programs[] = {
        {"echo drawing; exec sleep 100", "did not end within 0.5 s", "drawing", true},
        {"trap '' TERM INT HUP\nwhile :; do sleep 100; done", "did not end within", "no message",
         true},
        {"exec >/dev/null 2>&1; exec sleep 100", "did not end within", "no message", true},
        {"exec yes nonsense", "did not end within", "n", true}, // cut somewhere
        {"sleep 100 & echo broken; exit 3", "exit status 3", "broken", false},
        {"kill -SEGV $$", "ended by signal 11", "no message", false},
        {"exec cat /dev/zero > friction.svg", "ended by signal 25", "", false},
        {"exit 0", "cannot be opened", "", false},
    };
    wt_result *result = one_figure();
    mark_programs();
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        wt_report_options options = wt_report_defaults();
        wt_error err = WT_ERROR_INIT;
        options.gnuplot = "./fake";
        options.gnuplot_time = programs[i].late ? 0.5 : 60;
        write_program("fake", programs[i].script);
        const double begin = wt_time_wall();
        assert_int_not_equal(wt_report_write(result, "out", &options, NULL, &err), WT_OK);
        const double took = wt_time_wall() - begin;
        if (strstr(err.message, programs[i].message) == NULL ||
            strstr(err.found, programs[i].found) == NULL)
            fail_msg("%s: %s, found %s", programs[i].script, err.message, err.found);
        assert_true(took < 10 && (!programs[i].late || took > 0.4));
        assert_true(all_programs_end());
        assert_int_equal(count_files("."), 1);
    }
    wt_result_free(result);
}

static bool cancel_after(void *user, const char *what, size_t done, size_t total)
{
    (void)what;
    (void)done;
    (void)total;
    return wt_time_wall() < *(const double *)user;
}

static void test_cancelled_while_it_draws(void **state)
{
    (void)state;
    wt_result *result = one_figure();
    wt_report_options options = wt_report_defaults();
    wt_error err = WT_ERROR_INIT;
    options.gnuplot = "./fake";
    mark_programs();
    write_program("fake", "exec sleep 100");
    double begin = wt_time_wall(), end = begin + 0.3;
    const wt_progress progress = {cancel_after, &end};
    assert_int_equal(wt_report_write(result, "out", &options, &progress, &err), WT_E_CANCELLED);
    assert_true(wt_time_wall() - begin < 5);
    assert_true(all_programs_end());
    assert_false(exists("out"));
    wt_result_free(result);
}

/* gnuplot ends also after SIGKILL of the report. */
static void test_killed_while_it_draws(void **state)
{
    (void)state;
    wt_result *result = one_figure();
    wt_report_options options = wt_report_defaults();
    options.gnuplot = "./fake";
    mark_programs();
    write_program("fake", "exec sleep 100");
    const pid_t writer = fork();
    if (writer == 0) {
        wt_error err = WT_ERROR_INIT;
        _exit(wt_report_write(result, "out", &options, NULL, &err) == WT_OK ? 0 : 1);
    }
    assert_true(writer > 0);
    for (int i = 0; i < 500 && find_program() == 0; i++)
        (void)usleep(10000);
    assert_int_not_equal(find_program(), 0);
    assert_int_equal(kill(writer, SIGKILL), 0);
    assert_int_equal(waitpid(writer, NULL, 0), writer);
    assert_true(all_programs_end());
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_hostile_texts, create_work_folder, remove_work_folder),
        cmocka_unit_test_setup_teardown(test_settings_of_the_user, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_programs_that_hang_flood_and_die, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_cancelled_while_it_draws, create_work_folder,
                                        remove_work_folder),
        cmocka_unit_test_setup_teardown(test_killed_while_it_draws, create_work_folder,
                                        remove_work_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
