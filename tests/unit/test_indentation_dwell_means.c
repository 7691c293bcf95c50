/* Means of dwells over files. With three or more files the intervals use the files as units.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "core/table/registry.h"
#include "indentation/dwell.h"

#include <stdlib.h>

enum { FILES = 3, EACH = 4 };
#define T_2 4.302652729749464 /* 97.5 % point of Student's t */

/* Three files that differ by 20 %, with four curves each. The frequencies of curves differ by up to
 * `jitter`, so that sorted by frequency the files would interleave. */
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

typedef struct row {
    const char *file;
    double frequency, storage, storage_common, loss, loss_common;
} row;

static dwell_mean *means_of(const row *rows, size_t n_rows, size_t *n)
{
    wt_table *table = NULL;
    dwell_mean *means = NULL;
    table_writer t = table_begin(&dwell_moduli_schema, NULL);
    for (size_t i = 0; i < n_rows; i++) {
        table_row(&t);
        dwell_moduli_put_text(&t, DWELL_MODULI_FILE, rows[i].file);
        dwell_moduli_put(&t, DWELL_MODULI_CURVE, (double)i);
        dwell_moduli_put(&t, DWELL_MODULI_SEGMENT, 1);
        dwell_moduli_put_text(&t, DWELL_MODULI_KIND, "relaxation");
        dwell_moduli_put(&t, DWELL_MODULI_ANGULAR_FREQUENCY, rows[i].frequency);
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE, rows[i].storage);
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE_STANDARD_ERROR, 3);
        dwell_moduli_put(&t, DWELL_MODULI_STORAGE_COMMON, rows[i].storage_common);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS, rows[i].loss);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS_STANDARD_ERROR, 2);
        dwell_moduli_put(&t, DWELL_MODULI_LOSS_COMMON, rows[i].loss_common);
    }
    assert_int_equal(table_end(&t, &table), WT_OK);
    assert_int_equal(dwell_means(table, &means, n, NULL), WT_OK);
    wt_table_free(table);
    return means;
}

static void check_mean(wt_interval m, double value, double error, double half)
{
    assert_near(m.value, value, 1e-12);
    assert_near(m.standard_error, error, 1e-9);
    assert_near(m.low, value - half, 1e-9);
    assert_near(m.high, value + half, 1e-9);
}

/* Two files: the curves are the units. Their shared error is the root mean square and is added to
 * the scatter. It is unknown if most curves do not state it. */
static void test_common(void **state)
{
    (void)state;
    static const double z = 1.959963984540054;
    const double none = (double)NAN;
    const row rows[] = {{"a", 10, 100, 3, 50, 1},
                        {"b", 10, 104, 4, 56, none},
                        {"b", 10, 102, 5, 47, none},
                        {"a", 1, 70, 6, 7, 8},
                        {"a", 1.0011, 71, none, 9, 2}};
    size_t n = 0;
    dwell_mean *m = means_of(rows, 5, &n);
    assert_int_equal(n, 3);
    /* one curve has its stated error */
    assert_near(m[0].angular_frequency, 1, 0);
    assert_int_equal(m[0].n, 1);
    check_mean(m[0].storage, 70, 3, 3 * z);
    check_mean(m[0].loss, 7, 2, 2 * z);
    assert_near(m[1].angular_frequency, 1.0011, 0);
    check_mean(m[1].storage, 71, 3, 3 * z);
    assert_near(m[2].angular_frequency, 10, 0);
    assert_int_equal(m[2].n, 3);
    assert_int_equal(m[2].n_units, 3);
    const double common = sqrt((9 + 16 + 25) / 3.0), scatter = 2 / sqrt(3);
    check_mean(m[2].storage, 102, hypot(scatter, common), hypot(T_2 * scatter, z * common));
    assert_near(m[2].loss.value, 51, 1e-12);
    assert_true(isnan(m[2].loss.standard_error) && isnan(m[2].loss.high));
    free(m);
    /* half of them suffice */
    const row half[] = {{"a", 5, 10, 3, 20, none}, {"b", 5, 14, none, 26, none}};
    m = means_of(half, 2, &n);
    assert_int_equal(n, 1);
    check_mean(m->storage, 12, hypot(2, 3), hypot(12.706204736174698 * 2, z * 3));
    free(m);
}

/* Frequencies within a thousandth are equal. */
static void test_same_frequency(void **state)
{
    (void)state;
    const row rows[] = {{"a", 1.0009, 4, 0, 1, 0}, {"a", 1, 2, 0, 1, 0}, {"a", 1.0018, 8, 0, 1, 0}};
    size_t n = 0;
    dwell_mean *m = means_of(rows, 3, &n);
    assert_int_equal(n, 2);
    assert_int_equal(m[0].n, 2);
    assert_near(m[0].storage.value, 3, 1e-12);
    assert_near(m[1].storage.value, 8, 1e-12);
    free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_files), cmocka_unit_test(test_common),
                                       cmocka_unit_test(test_same_frequency)};
    return cmocka_run_group_tests_name("means of dwells", tests, NULL, NULL);
}
