/* Deflection sensitivity of files by independent writers: volts, calibrated files, forces only,
 * both directions with friction, several files, a soft surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "table_cells.h"

#include "dma_data.h"
#include "weartrack/indentation.h"
#include "writers/curve_hdf5_writer.h"
#include "writers/jpk_writer.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { N = 400, MOST_CURVES = 12, MOST_FILES = 4 };
static const double free_travel = 200e-9, press = 100e-9, spring = 0.3;

static double height[MOST_CURVES][2][N], signal[MOST_CURVES][2][N];

/* A curve with sensitivity s (1 + friction) for the approach and s (1 - friction) for the
 * retraction. The deflection is `scale` times volts; a compliant surface reduces it. */
static void draw_curve(size_t i, double s, double friction, double give, double scale,
                       uint64_t *seed)
{
    for (size_t way = 0; way < 2; way++)
        for (size_t k = 0; k < N; k++) {
            const double share = (double)k / (N - 1);
            const double at = (way == 0 ? share : 1 - share) * (free_travel + press) - free_travel;
            const double own = s * (way == 0 ? 1 + friction : 1 - friction);
            double v = at > 0 ? at / own : 0;
            if (at > 0)
                v *= 1 - give * pow(press / at, 1.0 / 3);
            height[i][way][k] = 5e-6 - at;
            signal[i][way][k] = scale * (v + 0.004 * dma_normal(seed));
        }
}

static void write_map(const char *path, size_t n, double k, double s)
{
    jpk_writer_segment segments[MOST_CURVES][2];
    jpk_writer_curve curves[MOST_CURVES];
    jpk_writer_file file = jpk_writer_defaults();
    for (size_t i = 0; i < n; i++) {
        segments[i][0] = (jpk_writer_segment){"extend", N, 1, height[i][0], signal[i][0], NULL};
        segments[i][1] = (jpk_writer_segment){"retract", N, 1, height[i][1], signal[i][1], NULL};
        curves[i] = (jpk_writer_curve){i, 0, 0, 2, segments[i]};
    }
    file.path = path;
    file.map = true;
    file.n_curves = n;
    file.curves = curves;
    file.spring_constant = k;
    file.sensitivity = s;
    assert_int_equal(jpk_write(&file), 0);
}

static wt_status make(const wt_sensitivity_job *options, const char *const *paths, size_t n,
                      wt_sensitivity_tables *tables, wt_error *err)
{
    const wt_file_set set = {.patterns = paths, .n_patterns = n, .read = wt_read_defaults()};
    wt_sensitivity_job job = *options;
    wt_job work = wt_job_defaults();
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    return wt_sensitivity_compute(&job, &work, tables, err);
}

static wt_sensitivity_tables made(const char *const *paths, size_t n)
{
    const wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_sensitivity_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (make(&job, paths, n, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    return tables;
}

static wt_estimate key(const wt_table *table, const char *name)
{
    wt_estimate e = {(double)NAN, (double)NAN, (double)NAN, ""};
    (void)wt_table_estimate(table, name, &e);
    return e;
}

static const char *words(const wt_table *table, size_t row, const char *column)
{
    const long c = wt_table_find(table, column);
    assert_true(c >= 0);
    return wt_table_text(table, row, (size_t)c);
}

/* ---- rows of all curves, computed from those of single curves -------------------------------- */

enum { MOST_ROWS = 2 * MOST_CURVES * MOST_FILES };

/* Numbers and files of the curves of a row. */
typedef struct curve_role {
    double value[MOST_ROWS];
    const char *file[MOST_ROWS];
    size_t n;
} curve_role;

static bool is_used(const wt_table *curves, size_t row)
{
    return strcmp(words(curves, row, "verdict"), "used") == 0;
}

static curve_role take(const wt_table *curves, const char *direction, const char *column)
{
    curve_role all = {.n = 0};
    for (size_t i = 0; i < wt_table_n_rows(curves); i++) {
        double value =
            isnan(number_cell(curves, i, column)) ? (double)NAN : number_cell(curves, i, column);
        if (strcmp(direction, "both") != 0 && strcmp(direction, words(curves, i, "direction")) != 0)
            continue;
        if (strcmp(direction, "both") == 0) { /* the retraction follows its approach */
            if (strcmp(words(curves, i, "direction"), "retract") != 0 || i == 0 ||
                number_cell(curves, i - 1, "curve") != number_cell(curves, i, "curve") ||
                !is_used(curves, i - 1))
                continue;
            value = (value + number_cell(curves, i - 1, column)) / 2;
        }
        if (!is_used(curves, i) || isnan(value))
            continue;
        all.file[all.n] = words(curves, i, "file");
        all.value[all.n++] = value;
    }
    return all;
}

typedef struct mean {
    double value, error, half;
    size_t n;
} mean;

/* Means of three or more files, else of curves. */
static mean mean_of(curve_role all)
{
    curve_role files = {.n = 0};
    size_t each[MOST_ROWS] = {0};
    for (size_t i = 0; i < all.n; i++) {
        if (files.n == 0 || strcmp(files.file[files.n - 1], all.file[i]) != 0)
            files.file[files.n++] = all.file[i];
        files.value[files.n - 1] += all.value[i];
        each[files.n - 1]++;
    }
    for (size_t i = 0; i < files.n; i++)
        files.value[i] /= (double)each[i];
    const curve_role *of = files.n >= 3 ? &files : &all;
    mean m = {.n = of->n};
    double squares = 0;
    for (size_t i = 0; i < m.n; i++)
        m.value += of->value[i] / (double)m.n;
    for (size_t i = 0; i < m.n; i++)
        squares += (of->value[i] - m.value) * (of->value[i] - m.value);
    m.error = sqrt(squares / (double)(m.n - 1) / (double)m.n);
    m.half = m.n > 1 ? wt_student_quantile((double)m.n - 1) * m.error : (double)NAN;
    return m;
}

static void check_interval(const wt_table *t, size_t row, const char *name, mean m)
{
    char column[64];
    const double digits = 1e-9 * fabs(m.value);
    assert_near_abs(number_cell(t, row, name), m.value, digits);
    snprintf(column, sizeof column, "%s_standard_error", name);
    assert_near_abs(number_cell(t, row, column), m.error, digits);
    snprintf(column, sizeof column, "%s_low", name);
    assert_near_abs(number_cell(t, row, column), m.value - m.half, digits);
    snprintf(column, sizeof column, "%s_high", name);
    assert_near_abs(number_cell(t, row, column), m.value + m.half, digits);
}

/* Mean ratio of retraction and approach over curves with both; NaN if there is none. */
static double ways_ratio(const wt_table *curves, const char *column)
{
    curve_role all = {.n = 0};
    for (size_t i = 1; i < wt_table_n_rows(curves); i++) {
        const double ratio = number_cell(curves, i, column) / number_cell(curves, i - 1, column);
        if (strcmp(words(curves, i, "direction"), "retract") != 0 || !is_used(curves, i) ||
            !is_used(curves, i - 1) ||
            number_cell(curves, i - 1, "curve") != number_cell(curves, i, "curve") || isnan(ratio))
            continue;
        all.file[all.n] = words(curves, i, "file");
        all.value[all.n++] = ratio;
    }
    return all.n > 0 ? mean_of(all).value : (double)NAN;
}

/* Uniform between the directions: the width over sqrt(12) about the middle, over sqrt(3) about a
 * limit. A soft surface adds its share to the half width. */
static mean with_ways(mean m, double ratio, const char *direction, double share)
{
    const double width = strcmp(direction, "approach") == 0  ? ratio - 1
                         : strcmp(direction, "retract") == 0 ? 1 - 1 / ratio
                                                             : 2 * (ratio - 1) / (ratio + 1),
                 ways = fabs(width) / sqrt(strcmp(direction, "both") == 0 ? 12 : 3),
                 error = m.value * hypot(isnan(ways) ? 0 : ways, share / 1.959963984540054);
    m.error = hypot(m.error, error);
    m.half = hypot(m.half, 1.959963984540054 * error);
    return m;
}

/* For two or more curves; a refused row has no sensitivity. */
static void check_rows(const wt_sensitivity_tables *tables)
{
    const wt_table *t = tables->sensitivity, *curves = tables->sensitivity_curves;
    for (size_t row = 0; row < wt_table_n_rows(t); row++) {
        const char *direction = words(t, row, "direction");
        const mean change = mean_of(take(curves, direction, "slope_change")),
                   sensitivity = mean_of(take(curves, direction, "sensitivity")),
                   factor = mean_of(take(curves, direction, "factor"));
        const double share = number_cell(t, row, "surface_share");
        const bool refused =
            isnan(number_cell(t, row, "sensitivity")) && isnan(number_cell(t, row, "factor"));
        assert_near(number_cell(t, row, "n"), (double)take(curves, direction, "slope_change").n, 0);
        assert_near(number_cell(t, row, "n_units"), (double)change.n, 0);
        check_interval(t, row, "slope_change", change);
        assert_near_abs(number_cell(t, row, "baseline_tilt"),
                        mean_of(take(curves, direction, "baseline_tilt")).value, 1e-12);
        assert_near(share, 2.4 * fmax(0, change.value + change.half), 0.005);
        assert_string_equal(words(t, row, "note"), "");
        if (refused)
            continue;
        if (sensitivity.n > 0) {
            check_interval(
                t, row, "sensitivity",
                with_ways(sensitivity, ways_ratio(curves, "sensitivity"), direction, share));
            assert_near(number_cell(t, row, "scatter"),
                        sensitivity.error * sqrt((double)sensitivity.n) / sensitivity.value, 1e-9);
        }
        if (factor.n > 0)
            check_interval(t, row, "factor",
                           with_ways(factor, ways_ratio(curves, "factor"), direction, share));
    }
}

/* White noise of 4 mV: least-squares errors of a line through these samples and of the parabola
 * beyond it, for the mean of the curves. */
static void check_noise(const wt_table *curves, double s)
{
    double misfit = 0, slope = 0, change = 0, n_used = 0;
    for (size_t i = 0; i < wt_table_n_rows(curves); i++) {
        if (!is_used(curves, i))
            continue;
        const double n = number_cell(curves, i, "points"),
                     rise = number_cell(curves, i, "travel") / s;
        assert_near(n, N * number_cell(curves, i, "travel") / (free_travel + press), 0.05);
        assert_near_abs(number_cell(curves, i, "baseline_tilt"), 0, 0.02);
        misfit += number_cell(curves, i, "misfit") / (0.004 * s / press);
        slope += number_cell(curves, i, "sensitivity_standard_error") /
                 (s * 0.004 / rise * sqrt(12 / n));
        change += number_cell(curves, i, "slope_change_standard_error") /
                  (8 * 0.004 / rise * sqrt(11.25 / n));
        n_used++;
    }
    assert_near(misfit / n_used, 1, 0.1);
    assert_near(slope / n_used, 1, 0.2);
    assert_near(change / n_used, 1, 0.2);
}

/* Volts only: both directions with friction; their mean is the truth. */
static void test_volts(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_volts.jpk-force-map"};
    uint64_t seed = 3;
    for (size_t i = 0; i < 6; i++)
        draw_curve(i, 60e-9 * (1 + 0.002 * dma_normal(&seed)), 0.02, 0, 1, &seed);
    write_map(path[0], 6, (double)NAN, (double)NAN);
    wt_sensitivity_tables t = made(path, 1);
    assert_int_equal(wt_table_n_rows(t.sensitivity), 3);
    assert_int_equal(wt_table_n_rows(t.sensitivity_curves), 12);
    check_rows(&t);
    check_noise(t.sensitivity_curves, 60e-9);
    assert_string_equal(wt_table_key(t.sensitivity, "n_curves"), "6");
    assert_string_equal(wt_table_key(t.sensitivity, "n_left_out"), "0");
    assert_string_equal(wt_table_key(t.sensitivity, "direction"), "both");
    const wt_estimate s = key(t.sensitivity, "sensitivity");
    assert_near(s.value, number_cell(t.sensitivity, 2, "sensitivity"), 1e-9);
    assert_near(s.standard_error, number_cell(t.sensitivity, 2, "sensitivity_standard_error"),
                1e-9);
    assert_near(strtod(wt_table_key(t.sensitivity, "indent_option") + 14, NULL), 1e9 * s.value,
                1e-5);
    assert_near(strtod(wt_table_key(t.sensitivity, "compare_option") + 20, NULL),
                s.standard_error / s.value, 0.06);
    curve_role difference = take(t.sensitivity_curves, "retract", "sensitivity");
    const curve_role in = take(t.sensitivity_curves, "approach", "sensitivity");
    for (size_t i = 0; i < difference.n; i++)
        difference.value[i] /= in.value[i];
    assert_near(key(t.sensitivity, "retract_over_approach").value, mean_of(difference).value, 1e-9);
    assert_near(key(t.sensitivity, "retract_over_approach").standard_error,
                mean_of(difference).error, 1e-9);
    assert_near(number_cell(t.sensitivity, 0, "sensitivity"), 60e-9 * 1.02, 0.004);
    assert_near(number_cell(t.sensitivity, 1, "sensitivity"), 60e-9 * 0.98, 0.004);
    assert_near(number_cell(t.sensitivity, 2, "sensitivity"), 60e-9, 0.004);
    assert_true(number_cell(t.sensitivity, 2, "sensitivity_low") < 60e-9);
    assert_true(number_cell(t.sensitivity, 2, "sensitivity_high") > 60e-9);
    assert_near(key(t.sensitivity, "retract_over_approach").value, 0.98 / 1.02, 0.003);
    /* the stated interval contains both directions, that of each direction does not contain the
     * other */
    assert_near(number_cell(t.sensitivity, 2, "direction_error"), 0.04 / sqrt(12), 0.03);
    assert_near(number_cell(t.sensitivity, 0, "direction_error"), 0.04 / 1.02 / sqrt(3), 0.03);
    for (size_t row = 0; row < 3; row++) {
        assert_true(number_cell(t.sensitivity, row, "sensitivity_low") < 60e-9 * 0.98);
        assert_true(number_cell(t.sensitivity, row, "sensitivity_high") > 60e-9 * 1.02);
        assert_true(number_cell(t.sensitivity, row, "sensitivity_standard_error") >
                    number_cell(t.sensitivity, row, "direction_error") * 60e-9 * 0.97);
    }
    assert_string_equal(wt_table_key(t.sensitivity, "verdict"), "straight");
    assert_true(strncmp(wt_table_key(t.sensitivity, "indent_option"), "--sensitivity ", 14) == 0);
    assert_true(isnan(key(t.sensitivity, "factor").value));
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* A file calibrated with 50 nm/V: the volts are recovered, and the factor is stated. */
static void test_calibrated(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_force.jpk-force-map"};
    uint64_t seed = 4;
    for (size_t i = 0; i < 4; i++)
        draw_curve(i, 60e-9, 0, 0, spring * 50e-9, &seed);
    write_map(path[0], 4, spring, 50e-9);
    wt_sensitivity_tables t = made(path, 1);
    check_rows(&t);
    assert_near(key(t.sensitivity, "sensitivity").value, 60e-9, 0.004);
    assert_near(key(t.sensitivity, "factor").value, 1.2, 0.004);
    assert_near(key(t.sensitivity, "factor").standard_error,
                number_cell(t.sensitivity, 2, "factor_standard_error"), 1e-9);
    assert_near(strtod(wt_table_key(t.sensitivity, "thermal_spring_constant_factor"), NULL),
                1 / 1.44, 0.01);
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* Forces and a spring constant only: the factor on the deflection. */
static void test_forces(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_force.h5"};
    static double time[2 * N], z[2 * N], f[2 * N];
    static unsigned char segments[2 * N];
    uint64_t seed = 4;
    draw_curve(0, 60e-9, 0, 0, spring * 50e-9, &seed);
    for (size_t k = 0; k < 2 * N; k++) {
        time[k] = 1e-3 * (double)k;
        z[k] = height[0][k / N][k % N];
        f[k] = signal[0][k / N][k % N];
        segments[k] = k >= N;
    }
    const afmformats_writer_file file = {.path = path[0],
                                         .n_curves = 1,
                                         .n = 2 * N,
                                         .time = time,
                                         .height = z,
                                         .force = f,
                                         .segments = segments,
                                         .spring_constant = spring,
                                         .force_unit = "N"};
    assert_int_equal(afmformats_write(&file), 0);
    wt_sensitivity_tables t = made(path, 1);
    assert_near(key(t.sensitivity, "factor").value, 1.2, 0.01);
    assert_true(isnan(key(t.sensitivity, "sensitivity").value));
    assert_null(wt_table_key(t.sensitivity, "indent_option"));
    assert_true(isnan(key(t.sensitivity, "factor").standard_error)); /* one curve */
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* Four files after laser realignment: the files are the units, not their curves. A curve with dust
 * is excluded. */
static void test_files(void **state)
{
    (void)state;
    static const char *const paths[MOST_FILES] = {
        "test_sensitivity_0.jpk-force-map", "test_sensitivity_1.jpk-force-map",
        "test_sensitivity_2.jpk-force-map", "test_sensitivity_3.jpk-force-map"};
    static const double moved[MOST_FILES] = {0.98, 1.01, 1.02, 0.99};
    uint64_t seed = 5;
    for (size_t f = 0; f < MOST_FILES; f++) {
        for (size_t i = 0; i < 10; i++)
            draw_curve(i, 60e-9 * moved[f] * (f == 1 && i == 4 ? 1.3 : 1), 0, 0, 1, &seed);
        write_map(paths[f], 10, (double)NAN, (double)NAN);
    }
    wt_sensitivity_tables t = made(paths, MOST_FILES);
    check_rows(&t);
    assert_near(number_cell(t.sensitivity, 2, "n"), 39, 0);
    assert_near(number_cell(t.sensitivity, 2, "n_units"), 4, 0);
    assert_near(number_cell(t.sensitivity, 2, "sensitivity"), 60e-9, 0.001);
    assert_near(number_cell(t.sensitivity, 2, "scatter"), 0.01826, 0.05);
    assert_string_equal(wt_table_key(t.sensitivity, "n_left_out"), "1");
    wt_tables_clear(&t, sizeof t);
    for (size_t f = 0; f < MOST_FILES; f++)
        (void)remove(paths[f]);
}

/* Dust in the retraction alone excludes the curve, too; the error of one curve is the one within
 * it. */
static void test_retract_and_one(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_retract.jpk-force-map"};
    uint64_t seed = 11;
    for (size_t i = 0; i < 10; i++)
        draw_curve(i, 60e-9, 0, 0, 1, &seed);
    for (size_t k = 0; k < N; k++)
        signal[3][1][k] /= 1.4;
    write_map(path[0], 10, (double)NAN, (double)NAN);
    wt_sensitivity_tables t = made(path, 1);
    check_rows(&t);
    assert_near(number_cell(t.sensitivity, 0, "n"), 9, 0);
    assert_string_equal(wt_table_key(t.sensitivity, "n_left_out"), "1");
    for (size_t i = 0; i < wt_table_n_rows(t.sensitivity_curves); i++)
        assert_string_equal(words(t.sensitivity_curves, i, "verdict"),
                            number_cell(t.sensitivity_curves, i, "curve") == 3
                                ? "left out: far from the other curves"
                                : "used");
    wt_tables_clear(&t, sizeof t);
    write_map(path[0], 1, (double)NAN, (double)NAN);
    t = made(path, 1);
    const wt_table *curves = t.sensitivity_curves, *all = t.sensitivity;
    double own[3], change[3], reach[3];
    for (size_t way = 0; way < 2; way++) {
        own[way] = number_cell(curves, way, "sensitivity_standard_error") /
                   number_cell(curves, way, "sensitivity");
        change[way] = number_cell(curves, way, "slope_change_standard_error");
    }
    own[2] = hypot(own[0], own[1]) / 2;
    change[2] = hypot(change[0], change[1]) / 2;
    for (size_t row = 0; row < 3; row++) {
        char note[64];
        snprintf(note, sizeof note, "standard error within the curve %.2g %%", 100 * own[row]);
        assert_non_null(strstr(words(all, row, "note"), note));
        assert_near(number_cell(all, row, "slope_change_standard_error"), change[row], 1e-9);
        const double value = number_cell(all, row, "slope_change"),
                     half = number_cell(all, row, "slope_change_high") - value;
        assert_near(value - number_cell(all, row, "slope_change_low"), half, 1e-9);
        reach[row] = half / change[row];
        assert_true(reach[row] > 1.96 && reach[row] < 4);
        assert_near(number_cell(all, row, "n"), 1, 0);
        assert_true(isnan(number_cell(all, row, "sensitivity_standard_error")));
    }
    assert_near(reach[2], fmax(reach[0], reach[1]), 1e-9);
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* A curve stored many times, and three measured ones: more than half of the slopes are equal to the
 * last bit. The others are not outliers for that reason. */
static void test_equal(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_equal.jpk-force-map"};
    uint64_t seed = 8;
    for (size_t i = 0; i < 9; i++) {
        uint64_t same = 7;
        draw_curve(i, 60e-9, 0, 0, 1, &same);
    }
    for (size_t i = 9; i < 12; i++)
        draw_curve(i, i == 11 ? 90e-9 : 60e-9, 0, 0, 1, &seed);
    write_map(path[0], 12, (double)NAN, (double)NAN);
    wt_sensitivity_tables t = made(path, 1);
    check_rows(&t);
    assert_near(number_cell(t.sensitivity, 2, "n"), 11, 0);
    assert_string_equal(wt_table_key(t.sensitivity, "n_left_out"), "1");
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* Volts of one file and metres of another have no mean. */
static void test_mixed(void **state)
{
    (void)state;
    static const char *const paths[] = {"test_sensitivity_v.jpk-force-map",
                                        "test_sensitivity_m.h5"};
    static double time[N], z[N], f[N];
    static unsigned char segments[N];
    const wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_sensitivity_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    uint64_t seed = 4;
    draw_curve(0, 60e-9, 0, 0, 1, &seed);
    write_map(paths[0], 1, (double)NAN, (double)NAN);
    for (size_t k = 0; k < N; k++) {
        time[k] = 1e-3 * (double)k;
        z[k] = height[0][0][k];
        f[k] = spring * 50e-9 * signal[0][0][k];
    }
    const afmformats_writer_file file = {.path = paths[1],
                                         .n_curves = 1,
                                         .n = N,
                                         .time = time,
                                         .height = z,
                                         .force = f,
                                         .segments = segments,
                                         .spring_constant = spring,
                                         .force_unit = "N"};
    assert_int_equal(afmformats_write(&file), 0);
    assert_int_equal(make(&job, paths, 2, &t, &err), WT_E_AMBIGUOUS);
    assert_non_null(strstr(err.found, "test_sensitivity_v.jpk-force-map in volts"));
    assert_non_null(strstr(err.found, "test_sensitivity_m.h5 in metres"));
    for (size_t i = 0; i < 2; i++)
        (void)remove(paths[i]);
}

/* A soft surface: no number, with the reason; with a looser limit there is one. */
static void test_soft(void **state)
{
    (void)state;
    static const char *const path[] = {"test_sensitivity_soft.jpk-force-map"};
    wt_sensitivity_job job = wt_sensitivity_job_defaults();
    wt_sensitivity_tables t = {0};
    uint64_t seed = 6;
    for (size_t i = 0; i < 6; i++)
        draw_curve(i, 60e-9, 0, 0.3, 1, &seed);
    write_map(path[0], 6, (double)NAN, (double)NAN);
    t = made(path, 1);
    assert_string_equal(wt_table_key(t.sensitivity, "verdict"),
                        "soft surface: the slope rises with the deflection");
    check_rows(&t);
    assert_true(isnan(key(t.sensitivity, "sensitivity").value));
    assert_true(isnan(number_cell(t.sensitivity, 2, "sensitivity")));
    assert_near(number_cell(t.sensitivity, 2, "surface_share"),
                2.4 * number_cell(t.sensitivity, 2, "slope_change_high"), 0.005);
    wt_tables_clear(&t, sizeof t);
    job.max_slope_change = 0.5;
    job.directions = WT_DIRECTION_RETRACT;
    assert_int_equal(make(&job, path, 1, &t, NULL), WT_OK);
    assert_string_equal(wt_table_key(t.sensitivity, "verdict"), "straight");
    assert_string_equal(wt_table_key(t.sensitivity, "direction"), "retract");
    assert_true(key(t.sensitivity, "sensitivity").value > 60e-9);
    wt_tables_clear(&t, sizeof t);
    (void)remove(path[0]);
}

/* 252 of 256 curves on mica, and one with finer steps, with the same cantilever. */
static void test_genuine(void **state)
{
    (void)state;
    static const char *const map[] = {WT_SHARED_DIR "/data/afm-more/Test.003"};
    static const char *const one[] = {WT_SHARED_DIR "/data/afm-more/Test.001"};
    if (access(map[0], R_OK) != 0 || access(one[0], R_OK) != 0)
        skip();
    wt_sensitivity_tables t = made(map, 1), s = made(one, 1);
    assert_string_equal(wt_table_key(t.sensitivity, "verdict"), "straight");
    assert_true(number_cell(t.sensitivity, 2, "n") > 240);
    assert_near(key(t.sensitivity, "sensitivity").value, 30.2e-9, 0.01);
    assert_near(key(s.sensitivity, "sensitivity").value, 30.2e-9, 0.02);
    wt_tables_clear(&t, sizeof t);
    wt_tables_clear(&s, sizeof s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_retract_and_one), cmocka_unit_test(test_equal),
        cmocka_unit_test(test_mixed),           cmocka_unit_test(test_volts),
        cmocka_unit_test(test_calibrated),      cmocka_unit_test(test_forces),
        cmocka_unit_test(test_files),           cmocka_unit_test(test_soft),
        cmocka_unit_test(test_genuine)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
