/* Strain sweeps in a table: their start and end, and rows that are not a sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

/* Rows of frequency [Hz], temperature [degC], strain [%]; the moduli identify the row. */
typedef struct row {
    double frequency, temperature, strain;
} row;

static wt_sweep sweep;

static void read_rows(const row *rows, size_t n)
{
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("f [Hz],T [degC],E' [MPa],E'' [MPa],strain [%]\n", out);
    for (size_t i = 0; i < n; i++)
        fprintf(out, "%g,%g,%zu,%g,%g\n", rows[i].frequency, rows[i].temperature, 10 + i,
                1 + 0.1 * (double)i, rows[i].strain);
    assert_int_equal(fclose(out), 0);
    wt_sweep_clear(&sweep);
    assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
    if (wt_sweep_read(formats, input, NULL, NULL, &sweep, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    wt_input_close(input);
}

/* The strain sweep has these rows, by increasing strain. */
static void check(size_t which, const row *rows, size_t first, size_t n, bool falling,
                  const char *way)
{
    assert_true(which < sweep.n_strain_sweeps);
    const wt_strain_sweep *s = &sweep.strain_sweeps[which];
    double frequency = 0, temperature = 0;
    assert_int_equal(s->n, n);
    for (size_t i = 0; i < n; i++) {
        const size_t k = falling ? first + n - 1 - i : first + i;
        assert_near(s->strain[i], rows[k].strain / 100, 1e-9);
        assert_near(s->storage_modulus[i], 1e6 * (double)(10 + k), 1e-9);
        assert_near(s->loss_modulus[i], 1e6 * (1 + 0.1 * (double)k), 1e-9);
        frequency += rows[k].frequency / (double)n;
        temperature += rows[k].temperature / (double)n;
    }
    assert_near(s->angular_frequency, 2 * M_PI * frequency, 1e-9);
    assert_near(s->temperature, 273.15 + temperature, 1e-6);
    if (way != NULL && strstr(s->source, way) == NULL)
        fail_msg("%s does not say %s", s->source, way);
    if (way == NULL)
        assert_null(strstr(s->source, "strain)"));
}

/* Up, down and up again, with turns at the largest and the smallest strain. */
static void test_turns(void **state)
{
    (void)state;
    static const row rows[] = {{1, 20, 0.1},  {1, 20, 0.2},  {1, 20, 0.4},  {1, 20, 0.8},
                               {1, 20, 1.6},  {1, 20, 3.2},  {1, 20, 1.7},  {1, 20, 0.9},
                               {1, 20, 0.45}, {1, 20, 0.25}, {1, 20, 0.12}, {1, 20, 0.3},
                               {1, 20, 0.6},  {1, 20, 1.2},  {1, 20, 2.4},  {1, 20, 4.8}};
    read_rows(rows, sizeof rows / sizeof *rows);
    assert_int_equal(sweep.n_strain_sweeps, 3);
    assert_int_equal(sweep.n_isotherms, 0);
    check(0, rows, 6, 5, true, "(falling strain)"); /* by name, then in file order */
    check(1, rows, 0, 6, false, "(rising strain)");
    check(2, rows, 11, 5, false, "(rising strain)");
}

/* Frequencies one after the other: a sweep for each, without a direction. */
static void test_frequencies(void **state)
{
    (void)state;
    static const row rows[] = {{1, 20, 0.1},  {1, 20, 0.2},  {1, 20, 0.3},  {1, 20, 0.4},
                               {1, 20, 0.5},  {10, 20, 5},   {10, 20, 3},   {10, 20, 2},
                               {10, 20, 1},   {10, 20, 0.8}, {1, 40, 0.1},  {1, 40, 0.2},
                               {1, 40, 0.25}, {1, 40, 0.28}, {1, 40, 0.301}};
    read_rows(rows, sizeof rows / sizeof *rows);
    assert_int_equal(sweep.n_strain_sweeps, 3);
    check(0, rows, 0, 5, false, NULL); /* by temperature, then by frequency */
    check(1, rows, 5, 5, true, NULL);
    check(2, rows, 10, 5, false, NULL);
}

/* Four rows are too few, and amplitudes below three times the smallest are not a sweep; the others
 * are isotherms. */
static void test_none(void **state)
{
    (void)state;
    static const row few[] = {{1, 20, 0.1}, {1, 20, 0.2}, {1, 20, 0.4}, {1, 20, 0.8},
                              {2, 20, 0.1}, {4, 20, 0.1}, {8, 20, 0.1}, {16, 20, 0.1}};
    static const row narrow[] = {{1, 20, 0.1},   {1, 20, 0.15}, {1, 20, 0.2}, {1, 20, 0.25},
                                 {1, 20, 0.299}, {2, 20, 0.1},  {4, 20, 0.1}, {8, 20, 0.1}};
    read_rows(few, sizeof few / sizeof *few);
    assert_int_equal(sweep.n_strain_sweeps, 0);
    assert_true(sweep.n_isotherms > 0);
    read_rows(narrow, sizeof narrow / sizeof *narrow);
    assert_int_equal(sweep.n_strain_sweeps, 0);
    assert_true(sweep.n_isotherms > 0);
}

/* It ends where the temperature has drifted by more than 4 K. Points of the same amplitude, or with
 * a small scatter, are not a turn. */
static void test_drift(void **state)
{
    (void)state;
    static const row drift[] = {{1, 20, 0.1},   {1, 21, 0.2},   {1, 22, 0.3},   {1, 23, 0.4},
                                {1, 24, 0.5},   {1, 24.1, 0.6}, {1, 24.2, 0.9}, {1, 24.3, 1.2},
                                {1, 24.4, 1.5}, {1, 24.5, 1.9}, {1, 24.6, 2.5}};
    static const row scatter[] = {{1, 20, 0.1}, {1, 20, 0.105}, {1, 20, 0.1},
                                  {1, 20, 0.2}, {1, 20, 0.19},  {1, 20, 0.3},
                                  {1, 20, 0.6}, {1, 20, 0.6},   {1, 20, 0.5}};
    read_rows(drift, sizeof drift / sizeof *drift);
    assert_int_equal(sweep.n_strain_sweeps, 2);
    check(0, drift, 0, 5, false, "(rising strain)");
    check(1, drift, 5, 6, false, "(rising strain)");
    read_rows(scatter, sizeof scatter / sizeof *scatter);
    assert_int_equal(sweep.n_strain_sweeps, 1);
    assert_int_equal(sweep.strain_sweeps[0].n, 9);
}

static int end(void **state)
{
    wt_sweep_clear(&sweep);
    return clean(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_turns),
                                       cmocka_unit_test(test_frequencies),
                                       cmocka_unit_test(test_none), cmocka_unit_test(test_drift)};
    return cmocka_run_group_tests_name("strain sweeps of a table", tests, set_up, end);
}
