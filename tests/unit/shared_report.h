/* One complete report for tests that only read it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_SHARED_REPORT_H
#define WT_TESTS_SHARED_REPORT_H

#include "report_fixture.h"
#include "report_folder.h"

enum { MOST = 64 }; /* sections in the data of one figure */

static char place[] = "/tmp/weartrack-drawn-XXXXXX";
static wt_result *everything;
static bool drawn; /* written to "out", if gnuplot is installed */

static inline int create_shared_report(void **state)
{
    (void)state;
    if (mkdtemp(place) == NULL || chdir(place) != 0)
        return -1;
    drawn = gnuplot_is_installed();
    everything = fixture_result();
    if (drawn)
        write_report(everything, "out", NULL);
    return 0;
}

static inline int remove_shared_report(void **state)
{
    (void)state;
    wt_result_free(everything);
    const int status = chdir("/");
    remove_all(place);
    return status;
}

#define NEED_REPORT()                                                                              \
    do {                                                                                           \
        if (!drawn)                                                                                \
            skip();                                                                                \
        assert_int_equal(chdir(place), 0);                                                         \
    } while (0)

static inline char *read_plot(const char *folder, const char *figure, const char *ending)
{
    char path[160];
    size_t length = 0;
    (void)snprintf(path, sizeof path, "%s/plots/%s.%s", folder, figure, ending);
    return read_all(path, &length);
}

/* The sections of a figure's data, which are tables of the text stream. */
static inline size_t read_sections(const char *folder, const char *figure, wt_table *sections[MOST])
{
    char path[160];
    size_t n = 0;
    (void)snprintf(path, sizeof path, "%s/plots/%s.tsv", folder, figure);
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        fail_msg("%s is not there", path);
    wt_status status = WT_OK;
    while (n < MOST && (status = wt_stream_read(file, path, &sections[n], NULL)) == WT_OK)
        assert_true(wt_table_n_rows(sections[n++]) > 0);
    assert_int_equal(status, WT_END);
    (void)fclose(file);
    return n;
}

static inline void free_sections(wt_table *sections[MOST], size_t n)
{
    for (size_t i = 0; i < n; i++)
        wt_table_free(sections[i]);
}

#endif
