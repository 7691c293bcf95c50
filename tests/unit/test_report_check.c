/* Checks before the work that a report can be written.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/report.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static size_t count_entries(void)
{
    DIR *folder = opendir(".");
    assert_non_null(folder);
    size_t n = 0;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        n += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return n;
}

static void test_nothing_is_left(void **state)
{
    (void)state;
    char place[] = "/tmp/weartrack-check-XXXXXX";
    assert_non_null(mkdtemp(place));
    assert_int_equal(chdir(place), 0);
    wt_report_options options = wt_report_defaults();
    assert_true(options.with_provenance);
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_report_check("out", NULL, &err), WT_OK);
    assert_int_equal(wt_report_check("out", &options, &err), WT_OK);
    assert_int_equal(count_entries(), 0);

    options.style = "no-such-style";
    assert_int_not_equal(wt_report_check("out", &options, &err), WT_OK);
    assert_non_null(strstr(err.message, "style"));
    assert_int_not_equal(wt_report_check("no/such/folder", NULL, &err), WT_OK);
    assert_int_equal(count_entries(), 0);

    /* the largest style, and one byte more */
    enum { LIMIT = 1 << 20 };
    options.style = "./large.gp";
    for (int more = 0; more < 2; more++) {
        FILE *style = fopen(options.style, "w");
        assert_non_null(style);
        for (int i = 0; i < LIMIT + more; i++)
            assert_int_equal(fputc('#', style), '#');
        assert_int_equal(fclose(style), 0);
        assert_int_equal(wt_report_check("out", &options, &err), more ? WT_E_RANGE : WT_OK);
    }
    assert_int_equal(remove(options.style), 0);

    /* a foreign folder is not replaced */
    assert_int_equal(mkdir("mine", 0777), 0);
    FILE *own = fopen("mine/own.txt", "w");
    assert_non_null(own);
    assert_int_equal(fclose(own), 0);
    assert_int_not_equal(wt_report_check("mine", NULL, &err), WT_OK);
    assert_int_equal(access("mine/own.txt", F_OK), 0);
    assert_int_equal(count_entries(), 1);

    assert_int_equal(remove("mine/own.txt"), 0);
    assert_int_equal(rmdir("mine"), 0);
    assert_int_equal(chdir("/"), 0);
    assert_int_equal(rmdir(place), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_nothing_is_left)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
