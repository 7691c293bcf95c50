/* Means of dwells over files, whose intervals are by files where there are three.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cells.h"

#include "data/tables/tables.h"
#include "flow/dwell/dwell.h"

#include <stdlib.h>

enum { FILES = 3, EACH = 4 };
#define T_2 4.302652729749464 /* 97.5 % point of Student's t */

/* Three files that are 20 % apart, of four curves each; the frequencies of curves differ by up to
 * `jitter`, so that by frequency the files would interleave. */
static dwell_mean mean_of(double jitter, size_t *n)
{
    wt_error err = WT_ERROR_INIT;
    wt_table *table = NULL;
    dwell_mean *means = NULL;
    table_writer t = table_begin(&dwell_moduli_schema, &err);
    for (int i = 0; i < FILES * EACH; i++) {
        char file[8];
        snprintf(file, sizeof file, "f%d", i / EACH);
        table_row(&t);
        dwell_moduli_put_text(&t, DWELL_MODULI_FILE, file);
        dwell_moduli_put(&t, DWELL_MODULI_CURVE, i % EACH);
        dwell_moduli_put(&t, DWELL_MODULI_SEGMENT, 1);
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE_STANDARD_ERROR, 1e4);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS_STANDARD_ERROR, 1e4);
        dwell_moduli_put_text(&t, DWELL_MODULI_KIND, "relaxation");
        dwell_moduli_put(&t, DWELL_MODULI_ANGULAR_FREQUENCY,
                         1 + jitter * (i * 5 % (FILES * EACH)) / (FILES * EACH));
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE, 0.8e6 + 0.2e6 * (i / EACH));
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE_COMMON, 0);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS, 1e5);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS_COMMON, 0);
    }
    if (table_end(&t, &table) != WT_OK)
        fail_msg("%s", err.message);
    assert_int_equal(dwell_means(table, &means, n, &err), WT_OK);
    const dwell_mean first = means[0];
    free(means);
    wt_table_free(table);
    return first;
}

static void test_files(void **state)
{
    (void)state;
    static const double jitter[] = {0, 1e-4};
    for (size_t i = 0; i < 2; i++) {
        size_t n = 0;
        const dwell_mean m = mean_of(jitter[i], &n);
        const double half = T_2 * 0.2e6 / sqrt(FILES);
        assert_int_equal(n, 1);
        assert_int_equal(m.n, FILES * EACH);
        assert_int_equal(m.n_units, FILES);
        assert_near(m.angular_frequency, 1, 0);
        assert_near(m.storage.value, 1e6, 1e-12);
        assert_near(m.storage.low, 1e6 - half, 1e-9);
        assert_near(m.storage.high, 1e6 + half, 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_files)};
    return cmocka_run_group_tests_name("means of dwells", tests, NULL, NULL);
}
