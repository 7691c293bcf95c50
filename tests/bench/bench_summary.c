/* Rows of the summary. The textbook method reads every file by HDF5 in the sandbox.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/bench.h"

/* Tables of a friction result and of its isotherms, with their sizes. */
enum { VELOCITIES = 31, ISOTHERMS = 12, COLUMNS = 14, KEYS = 20 };

typedef struct kept_result {
    char path[32];
    size_t n_keys; /* from the last tables read */
} kept_result;

static void add_table(wt_result *result, const char *name, size_t n_rows)
{
    wt_error err = WT_ERROR_INIT;
    wt_table *const t = wt_table_new(name, "made for the benchmark");
    for (int i = 0; i < COLUMNS; i++) {
        char column[32];
        (void)snprintf(column, sizeof column, "column_%d", i);
        bench_check(wt_table_add_column(t, column, "Pa", "a column with its words", &err), &err);
    }
    for (int i = 0; i < KEYS; i++) {
        char key[32];
        (void)snprintf(key, sizeof key, "key_%d", i);
        bench_check(wt_table_set_estimate(t, key, (wt_estimate){1e6 + i, 1e3, 1.0, "Pa"}, &err),
                    &err);
    }
    for (size_t row = 0; row < n_rows; row++) {
        bench_check(wt_table_add_row(t, &err), &err);
        for (size_t i = 0; i < COLUMNS; i++)
            wt_table_set_number(t, i, (double)(row * COLUMNS + i));
    }
    bench_check(wt_result_add(result, t, &err), &err);
}

static void make_result(kept_result *kept)
{
    wt_error err = WT_ERROR_INIT;
    wt_result *const result = wt_result_new();
    (void)strcpy(kept->path, "/tmp/weartrack-bench-XXXXXX");
    const int fd = mkstemp(kept->path);
    if (fd >= 0)
        (void)close(fd);
    add_table(result, "friction", VELOCITIES);
    add_table(result, "layer", VELOCITIES);
    add_table(result, "shift_factors", ISOTHERMS);
    add_table(result, "answer", ISOTHERMS);
    bench_check(wt_store_write(kept->path, result, true, &err), &err);
    wt_result_free(result);
}

static void take(kept_result *kept, wt_result *read)
{
    kept->n_keys = 0;
    for (size_t i = 0; i < wt_result_n_tables(read); i++)
        kept->n_keys += wt_table_n_keys(wt_result_table(read, i));
    wt_result_free(read);
}

static void read_weartrack(void *data)
{
    kept_result *const kept = data;
    wt_error err = WT_ERROR_INIT;
    wt_result *read = NULL;
    bench_check(wt_store_read_main_values(kept->path, &read, &err), &err);
    take(kept, read);
}

static void read_textbook(void *data)
{
    kept_result *const kept = data;
    wt_error err = WT_ERROR_INIT;
    wt_result *read = NULL;
    bench_check(wt_store_read(kept->path, &read, &err), &err);
    take(kept, read);
}

void bench_summary(void)
{
    kept_result kept;
    char words[64];
    make_result(&kept);
    const double ours = bench_time(read_weartrack, &kept);
    const size_t n_keys = kept.n_keys;
    const double textbook = bench_time(read_textbook, &kept);
    (void)snprintf(words, sizeof words, "%zu keys, %zu", n_keys, kept.n_keys);
    bench_row("results read for the summary", ours, textbook, 1, "per second", words);
    (void)unlink(kept.path);
}
