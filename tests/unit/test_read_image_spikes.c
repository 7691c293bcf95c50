/* Isolated heights cause a warning; edges, noise and missing points do not.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

#include "read/images.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>

enum { COLUMNS = 40, ROWS = 30, N = COLUMNS * ROWS };

/* A rough plane, 1 m high and with steps of 1 nm. */
static void fill(double *values)
{
    uint32_t state = 1;
    for (size_t i = 0; i < N; i++) {
        state = state * 1664525u + 1013904223u;
        values[i] = 1 + 1e-9 * ((double)(state >> 8) / 0x1p24 - 0.5);
    }
}

/* Warning of the image, or "". */
static const char *warning_of(double *values, size_t columns, size_t rows, const char *unit)
{
    static char said[512];
    wt_image image = {.name = "height",
                      .n_columns = columns,
                      .n_rows = rows,
                      .width = 1e-5,
                      .height = rows > 1 ? 1e-5 : 0,
                      .values = values};
    wt_log *const log = wt_log_new();
    const wt_read_options options = wt_read_defaults();
    (void)snprintf(image.unit, sizeof image.unit, "%s", unit);
    (void)snprintf(image.x_unit, sizeof image.x_unit, "m");
    assert_int_equal(images_apply_options(&image, 1, &options, "file", log, NULL), WT_OK);
    assert_true(wt_log_count(log) < 2);
    said[0] = '\0';
    if (wt_log_count(log) == 1) {
        assert_int_equal(wt_log_get(log, 0).severity, WT_WARNING);
        (void)snprintf(said, sizeof said, "%s", wt_log_get(log, 0).text);
    }
    wt_log_free(log);
    return said;
}

static void isolated_heights(void **state)
{
    (void)state;
    double values[N];
    fill(values);
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    values[7 * COLUMNS + 5] += 1e-7;
    assert_non_null(strstr(warning_of(values, COLUMNS, ROWS, "m"),
                           "1 of 1200 heights stand out alone, the farthest, in column 5 and row 7 "
                           "from below, by 99."));
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "V"), "");
    values[N - 1] -= 2e-7; /* two neighbours only */
    assert_non_null(
        strstr(warning_of(values, COLUMNS, ROWS, "m"),
               "2 of 1200 heights stand out alone, the farthest, in column 39 and row 29"));
    fill(values);
    values[0] = 1e300; /* whose square overflows */
    values[500] = -1e300;
    assert_non_null(strstr(warning_of(values, COLUMNS, ROWS, "m"), "2 of 1200"));
}

/* A height within the roughness, and one that causes less than half of the slopes. */
static void heights_within_roughness(void **state)
{
    (void)state;
    double values[N];
    fill(values);
    values[7 * COLUMNS + 5] = 1 + 5.5e-9; /* 20 % of the squared steps */
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    values[7 * COLUMNS + 5] = 1 + 9.0e-9;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    values[7 * COLUMNS + 5] = 1 + 20.0e-9;
    assert_string_not_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
}

static void edges(void **state)
{
    (void)state;
    double values[N];
    fill(values);
    for (size_t i = 0; i < N; i++)
        values[i] += i % COLUMNS >= 20 ? 1e-6 : 0;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    for (size_t i = 3 * COLUMNS; i < 4 * COLUMNS; i++)
        values[i] += 1e-6; /* a line that the tip missed */
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
}

static void missing(void **state)
{
    (void)state;
    double values[N];
    for (size_t i = 0; i < N; i++)
        values[i] = (double)NAN;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    fill(values);
    for (size_t i = 0; i < N; i += 3)
        values[i] = (double)NAN;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    values[4 * COLUMNS + 21] += 1e-6;
    assert_string_not_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    for (size_t i = 0; i < N; i++)
        values[i] = 1;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
    for (size_t i = 0; i < N; i++)
        values[i] = 0;
    assert_string_equal(warning_of(values, COLUMNS, ROWS, "m"), "");
}

/* A profile, and too few points for a typical step. */
static void profile(void **state)
{
    (void)state;
    double values[N];
    fill(values);
    assert_string_equal(warning_of(values, N, 1, "m"), "");
    values[600] -= 1e-6;
    assert_non_null(strstr(warning_of(values, N, 1, "m"), "in column 600 and row 0 from below"));
    assert_non_null(strstr(warning_of(values + 568, 64, 1, "m"), "1 of 64 "));
    assert_string_equal(warning_of(values + 568, 63, 1, "m"), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(isolated_heights), cmocka_unit_test(heights_within_roughness),
        cmocka_unit_test(edges), cmocka_unit_test(missing), cmocka_unit_test(profile)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
