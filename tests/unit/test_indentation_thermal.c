/* Spring constants of files with known truth: tables in metres and in volts, a thermal tune by an
 * independent writer, a measured one; corrections, errors, missing values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "assert_near.h"

#include "weartrack/indentation.h"
#include "writers/nid_writer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define NOISE WT_SOURCE_DIR "/fixtures/formats/table-noise/"

static wt_status make(const wt_thermal_job *options, const char *path, double sensitivity,
                      wt_log *log, wt_table **table, wt_error *err)
{
    const char *const paths[] = {path};
    wt_file_set set = {.patterns = paths, .n_patterns = 1, .read = wt_read_defaults()};
    wt_thermal_job job = *options;
    wt_job work = wt_job_defaults();
    set.read.sensitivity = sensitivity;
    work.formats = formats;
    work.log = log;
    job.sets = &set;
    job.n_sets = 1;
    return wt_thermal_compute(&job, &work, table, err);
}

static wt_table *made(const wt_thermal_job *job, const char *path, double sensitivity)
{
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (make(job, path, sensitivity, NULL, &table, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    return table;
}

static double cell(const wt_table *table, const char *column)
{
    const long c = wt_table_find(table, column);
    assert_true(c >= 0);
    return wt_table_number(table, 0, (size_t)c);
}

/* 0.2 N/m at 22 degC, 12 kHz, Q 60, 100 averages. */
static void test_metres(void **state)
{
    (void)state;
    wt_thermal_job job = wt_thermal_job_defaults();
    wt_table *t = made(&job, NOISE "deflection.csv", (double)NAN);
    const double k = cell(t, "spring_constant"), error = cell(t, "fit_error");
    assert_true(cell(t, "spring_constant_low") < 0.2 && cell(t, "spring_constant_high") > 0.2);
    assert_near(k, 0.2, 0.06);
    assert_near(cell(t, "resonance"), 12e3, 0.002);
    assert_near(cell(t, "quality_factor"), 60, 0.1);
    assert_near(cell(t, "temperature"), 295.15, 1e-12);
    assert_near(cell(t, "ratio"), k / 0.21, 1e-12);
    assert_near(cell(t, "spring_constant_standard_error"), error * k, 1e-9);
    assert_string_equal(wt_table_key(t, "includes"), "the fit");
    wt_table_free(t);
    /* errors that all spectra share, and corrections */
    job.sensitivity_error = 0.03;
    job.temperature = (wt_estimate){2 * 295.15, 295.15 * 0.02, 0, "K"};
    job.mode_shape = 1;
    job.chi = 1;
    t = made(&job, NOISE "deflection.csv", (double)NAN);
    assert_near(cell(t, "spring_constant"), 2 * k * 1.09 * 1.09 / 0.971, 1e-9);
    assert_near(cell(t, "spring_constant_standard_error") / cell(t, "spring_constant"),
                sqrt(error * error + 0.06 * 0.06 + 0.01 * 0.01), 1e-9);
    assert_string_equal(wt_table_key(t, "includes"), "the fit and the sensitivity and the "
                                                     "temperature");
    wt_table_free(t);
}

/* Volts with the sensitivity of the file, and with another one; without a temperature. */
static void test_volts(void **state)
{
    (void)state;
    const wt_thermal_job job = wt_thermal_job_defaults();
    wt_log *log = wt_log_new();
    wt_table *t = NULL;
    assert_int_equal(make(&job, NOISE "detector.txt", (double)NAN, log, &t, NULL), WT_OK);
    const double k = cell(t, "spring_constant");
    assert_near(k, 0.2 * 298.15 / 295.15, 0.06);
    assert_int_equal(wt_log_count(log), 1);
    wt_table_free(t);
    t = made(&job, NOISE "detector.txt", 80e-9);
    assert_near(cell(t, "spring_constant"), k / 4, 1e-9);
    wt_table_free(t);
    wt_log_free(log);
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(make(&job, WT_SOURCE_DIR "/fixtures/formats/table-spectrum/surface.txt",
                          (double)NAN, NULL, &t, &err),
                     WT_E_EMPTY);
}

enum { TUNE_POINTS = 3000, TUNES = 4 };

/* A thermal tune by the writer, with a white floor of 10 fm/sqrt(Hz). */
static void write_tune(const char *path, double f0, double q, double peak)
{
    static double density[TUNE_POINTS];
    const nid_writer_channel channel = {
        0, "Amplitude Spectral Density", "m/sqrt(Hz)", -1e-12, 2e-12, 32, density};
    const nid_writer_group group = {.name = "Spectrum FFT",
                                    .points = TUNE_POINTS,
                                    .lines = 1,
                                    .x_name = "Frequency",
                                    .x_unit = "Hz",
                                    .x_range = 300e3,
                                    .n_channels = 1,
                                    .channels = &channel};
    nid_writer_file file = nid_writer_defaults();
    for (size_t i = 0; i < TUNE_POINTS; i++) {
        const double x = 300e3 * (double)i / (TUNE_POINTS - 1) / f0;
        const double s = peak * peak / (q * q) / (pow(1 - x * x, 2) + x * x / (q * q));
        density[i] = sqrt(s + 1e-28);
    }
    file.path = path;
    file.groups = &group;
    file.n_groups = 1;
    file.info = "Cantilever temperature=40\r\nAverages=1000\r\nSpring Constant:=27.13 N/m\r\n";
    assert_int_equal(nid_write(&file), 0);
}

/* 777 fm/sqrt(Hz) at the peak is the mean square that it causes. */
static void test_tune(void **state)
{
    (void)state;
    static const char path[] = "test_thermal.nid";
    const double f0 = 180e3, q = 400, peak = 777e-15, pi = 3.14159265358979323846;
    write_tune(path, f0, q, peak);
    const wt_thermal_job job = wt_thermal_job_defaults();
    wt_table *t = made(&job, path, (double)NAN);
    const double square = 0.5 * pi * f0 / q * peak * peak;
    assert_near(cell(t, "deflection"), sqrt(square), 1e-4);
    assert_near(cell(t, "spring_constant"), 0.971 / (1.09 * 1.09) * 1.380649e-23 * 313.15 / square,
                2e-4);
    assert_near(cell(t, "spring_constant_of_file"), 27.13, 1e-12);
    assert_near(cell(t, "averages_of_file"), 1000, 0);
    assert_near(cell(t, "resonance"), f0, 1e-5);
    assert_near(cell(t, "quality_factor"), q, 1e-3);
    assert_near(cell(t, "floor"), 1e-14, 1e-2);
    const double from = cell(t, "fit_from"), to = cell(t, "fit_to");
    assert_true(from > 0 && from < f0 && to > f0 && to <= 300e3);
    assert_near_abs(cell(t, "points"), (to - from) * (TUNE_POINTS - 1) / 300e3, 1.01);
    wt_table_free(t);
    (void)remove(path);
}

/* One or more cantilevers: each row by equipartition, the keys by the rows. */
static void test_several(void **state)
{
    (void)state;
    static const char *const paths[TUNES] = {"test_thermal_0.nid", "test_thermal_1.nid",
                                             "test_thermal_2.nid", "test_thermal_3.nid"};
    static const double f0[TUNES] = {180e3, 150e3, 170e3, 190e3}, q[TUNES] = {400, 300, 500, 350},
                        peak[TUNES] = {445e-15, 400e-15, 458e-15,
                                       650e-15}; /* the last one contradicts the file */
    const double common = hypot(2 * 0.03, 0.5 / 300);
    size_t n_contradicted = 0;
    wt_job work = wt_job_defaults();
    work.formats = formats;
    for (size_t i = 0; i < TUNES; i++)
        write_tune(paths[i], f0[i], q[i], peak[i]);
    for (size_t n = 1; n <= TUNES; n++) {
        wt_thermal_job job = wt_thermal_job_defaults();
        wt_file_set set = {.patterns = paths, .n_patterns = n, .read = wt_read_defaults()};
        wt_table *t = NULL;
        double mean = 0, squares = 0, own = 0, constants[TUNES];
        char text[64];
        job.sets = &set;
        job.n_sets = 1;
        job.sensitivity_error = 0.03;
        job.temperature = (wt_estimate){300, 0.5, 0, "K"};
        assert_int_equal(wt_thermal_compute(&job, &work, &t, NULL), WT_OK);
        assert_int_equal(wt_table_n_rows(t), n);
        for (size_t i = 0; i < n; i++) {
            const double square = 0.5 * M_PI * f0[i] / q[i] * peak[i] * peak[i],
                         k = wt_table_number(t, i, (size_t)wt_table_find(t, "spring_constant")),
                         fit = wt_table_number(t, i, (size_t)wt_table_find(t, "fit_error")),
                         all = hypot(fit, common);
            assert_near(k, 0.971 / (1.09 * 1.09) * 1.380649e-23 * 300 / square, 2e-4);
            static const char *const columns[] = {"spring_constant_standard_error",
                                                  "spring_constant_low", "spring_constant_high",
                                                  "ratio", "temperature"};
            const double expected[] = {k * all, k * exp(-1.959963985 * all),
                                       k * exp(1.959963985 * all), k / 27.13, 300};
            assert_true(fit >= 0 && fit < 0.02);
            for (size_t c = 0; c < 5; c++)
                assert_near(wt_table_number(t, i, (size_t)wt_table_find(t, columns[c])),
                            expected[c], 1e-8);
            constants[i] = k;
            mean += k / (double)n;
            own += fit * fit;
        }
        for (size_t i = 0; i < n; i++)
            squares += pow(constants[i] / mean - 1, 2);
        const double scatter = sqrt(squares / ((double)n - 1)),
                     error =
                         hypot((n < 3 ? sqrt(own / (double)n) : scatter) / sqrt((double)n), common);
        wt_estimate k = {0};
        assert_true(wt_table_estimate(t, "spring_constant", &k));
        assert_near(k.value, mean, 1e-9);
        assert_near(k.standard_error, mean * error, 1e-9);
        if (n < 3)
            assert_null(wt_table_key(t, "scatter"));
        else
            assert_near(strtod(wt_table_key(t, "scatter"), NULL), scatter, 6e-3);
        assert_string_equal(wt_table_key(t, "includes"),
                            n < 3 ? "the fit and the sensitivity and the temperature"
                                  : "the scatter between spectra and the sensitivity and the "
                                    "temperature");
        snprintf(text, sizeof text, "%zu", n);
        assert_string_equal(wt_table_key(t, "n_spectra"), text);
        bool contradicted = false; /* with the 27.13 N/m of the file */
        for (size_t i = 0; i < n; i++)
            contradicted = contradicted || fabs(log(constants[i] / 27.13)) > log(1.5);
        assert_true((wt_table_key(t, "contradiction") != NULL) == contradicted);
        n_contradicted += contradicted;
        if (contradicted) {
            assert_null(wt_table_key(t, "indent_option"));
            assert_null(wt_table_key(t, "compare_option"));
        } else {
            snprintf(text, sizeof text, "--spring-constant %.6gN/m", mean);
            assert_string_equal(wt_table_key(t, "indent_option"), text);
            snprintf(text, sizeof text, "--spring-constant-error %.2g", error);
            assert_string_equal(wt_table_key(t, "compare_option"), text);
        }
        assert_near(strtod(wt_table_key(t, "mode_shape"), NULL), 0.971, 0);
        assert_near(strtod(wt_table_key(t, "chi"), NULL), 1.09, 0);
        wt_table_free(t);
    }
    assert_int_equal(n_contradicted, 1);
    for (size_t i = 0; i < TUNES; i++)
        (void)remove(paths[i]);
}

/* Fit of the instrument: 179.8 kHz, Q 442. */
static void test_measured_tune(void **state)
{
    (void)state;
    static const char path[] = WT_SHARED_DIR "/data/afm/nanosurf/thermal.nid";
    if (access(path, R_OK) != 0)
        skip();
    const wt_thermal_job job = wt_thermal_job_defaults();
    wt_table *t = made(&job, path, (double)NAN);
    assert_near(cell(t, "resonance"), 179.8e3, 5e-4);
    assert_near(cell(t, "quality_factor"), 442, 0.2);
    assert_near(cell(t, "temperature"), 313.15, 1e-12);
    wt_table_free(t);
}

/* Sader's method with the noise; a method that differs by more than a factor 1.5 is not advised. */
static void test_inconsistency(void **state)
{
    (void)state;
    wt_thermal_job job = wt_thermal_job_defaults();
    wt_table *t = made(&job, NOISE "deflection.csv", (double)NAN);
    const double k = cell(t, "spring_constant"), f = cell(t, "resonance"),
                 q = cell(t, "quality_factor");
    assert_non_null(wt_table_key(t, "indent_option")); /* 0.21 N/m of the file */
    assert_true(isnan(cell(t, "sader_spring_constant")));
    wt_table_free(t);
    for (int far = 0; far < 2; far++) {
        const double other = far ? 1.6 * k : 1.4 * k;
        job.sader_coefficient = (wt_estimate){other / q / pow(1e-3 * f, 1.3), 0, 0, "1"};
        t = made(&job, NOISE "deflection.csv", (double)NAN);
        assert_near(cell(t, "sader_spring_constant"), other, 1e-9);
        assert_near(cell(t, "sader_ratio"), k / other, 1e-9);
        assert_int_equal(wt_table_key(t, "indent_option") == NULL, far);
        assert_int_equal(wt_table_key(t, "contradiction") != NULL, far);
        wt_table_free(t);
    }
    /* one of the two is not a cantilever; both methods are one too many */
    wt_error err = WT_ERROR_INIT;
    job.width = (wt_estimate){30e-6, 0, 0, "m"};
    assert_int_equal(make(&job, NOISE "deflection.csv", (double)NAN, NULL, &t, &err), WT_E_ARG);
    job.length = (wt_estimate){200e-6, 0, 0, "m"};
    assert_int_equal(make(&job, NOISE "deflection.csv", (double)NAN, NULL, &t, &err), WT_E_ARG);
    job.sader_coefficient.value = (double)NAN;
    t = made(&job, NOISE "deflection.csv", (double)NAN);
    const wt_estimate here = wt_sader_spring_constant(
        job.length, job.width, (wt_estimate){f, 0, 0, "Hz"}, (wt_estimate){q, 0, 0, "1"},
        wt_medium_properties(WT_MEDIUM_AIR, 295.15));
    assert_near(cell(t, "sader_spring_constant"), here.value, 1e-9);
    wt_table_free(t);
}

/* The error of a spectrum that is not an oscillator may be shared: the mean of several has no
 * error, either. */
static void test_not_an_oscillator(void **state)
{
    (void)state;
    static const char path[] = WT_SHARED_DIR "/data/afm/nanosurf/thermal.nid";
    static const char *const links[] = {"test_thermal_a.nid", "test_thermal_b.nid",
                                        "test_thermal_c.nid"};
    enum { N = sizeof links / sizeof *links };
    if (access(path, R_OK) != 0)
        skip();
    for (size_t i = 0; i < N; i++)
        assert_true(symlink(path, links[i]) == 0 || access(links[i], R_OK) == 0);
    wt_thermal_job job = wt_thermal_job_defaults();
    wt_file_set set = {.patterns = links, .n_patterns = N, .read = wt_read_defaults()};
    wt_job work = wt_job_defaults();
    wt_table *t = NULL;
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    assert_int_equal(wt_thermal_compute(&job, &work, &t, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(t), 1); /* links to one file count once */
    assert_true(cell(t, "misfit_p") < 1e-3);
    assert_string_equal(wt_table_key(t, "n_spectra"), "1");
    assert_non_null(strstr(wt_table_key(t, "spring_constant"), "standard_error=nan"));
    assert_null(wt_table_key(t, "compare_option"));
    wt_table_free(t);
    for (size_t i = 0; i < N; i++)
        (void)remove(links[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_metres),        cmocka_unit_test(test_volts),
        cmocka_unit_test(test_tune),          cmocka_unit_test(test_several),
        cmocka_unit_test(test_measured_tune), cmocka_unit_test(test_not_an_oscillator),
        cmocka_unit_test(test_inconsistency)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
