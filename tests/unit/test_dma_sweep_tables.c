/* Tables of temperature and strain sweeps: every column against the law of the sweeps.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "truth_fixture.h"

#include "weartrack/case.h"

enum { FILES = 2, POINTS = 51, STRAINS = 29 };
static const double at_hertz[FILES] = {10, 1}; /* the faster one first */
static char paths[FILES][40];

static FILE *next_file(size_t i)
{
    snprintf(paths[i], sizeof paths[i], "/tmp/weartrack-sweep-XXXXXX");
    FILE *out = truth_file(paths[i]);
    fputs("f [Hz],T [degC],E' [MPa],E'' [MPa],strain [%]\n", out);
    return out;
}

static wt_file_set all_files(const char *patterns[FILES])
{
    for (size_t i = 0; i < FILES; i++)
        patterns[i] = paths[i];
    return (wt_file_set){.patterns = patterns, .n_patterns = FILES, .read = wt_read_defaults()};
}

static void remove_files(void)
{
    for (size_t i = 0; i < FILES; i++)
        unlink(paths[i]);
}

/* Number, error and interval: the interval contains the truth and is narrow. */
static void check_interval(const wt_table *t, size_t row, const char *name, double truth,
                           double most)
{
    char column[3][64];
    static const char *const ends[] = {"standard_error", "low", "high"};
    for (size_t i = 0; i < 3; i++)
        snprintf(column[i], sizeof column[i], "%s_%s", name, ends[i]);
    const double value = cell(t, row, name), error = cell(t, row, column[0]),
                 low = cell(t, row, column[1]), high = cell(t, row, column[2]);
    if (!(fabs(value - truth) <= most))
        fail_msg("%s: %.9g, not %.9g", name, value, truth);
    assert_true(error >= 0 && error <= most);
    assert_true(low <= value && value <= high && high - low <= 10 * most);
    assert_true(value - low >= 0.5 * error && high - value >= 0.5 * error);
}

/* ---- temperature sweeps ---------------------------------------------------------------------- */

/* A step of ln E' and a hump of E''; one decade of frequency moves both by 6 K. */
static double storage_at(double celsius, double f)
{
    const double x = celsius + 20 - 6 * log10(f);
    return 5 * pow(200, 1 / (1 + exp(x / 6)));
}

static double loss_at(double celsius, double f)
{
    const double x = (celsius + 28 - 6 * log10(f)) / 9;
    return 1 + 60 * exp(-0.5 * x * x);
}

/* Peak of tan delta, by small steps. */
static double factor_peak(double f, double *height)
{
    double best = 0;
    *height = 0;
    for (double t = -50; t < 20; t += 1e-3)
        if (loss_at(t, f) / storage_at(t, f) > *height) {
            *height = loss_at(t, f) / storage_at(t, f);
            best = t;
        }
    return best;
}

/* Both peaks are rows with their errors, or without them if they are unknown. Frees the table. */
static void check_rows(wt_table *transition)
{
    const wt_estimate factor = {280.45, (double)NAN, 0, "K"}, loss = {270.44, 0.31, 0, "K"};
    wt_result *result = wt_result_new();
    assert_int_equal(
        wt_table_set_estimate(transition, "loss_factor_peak_temperature", factor, NULL), WT_OK);
    assert_int_equal(wt_table_set_estimate(transition, "loss_modulus_peak_temperature", loss, NULL),
                     WT_OK);
    assert_int_equal(wt_result_add(result, transition, NULL), WT_OK);
    wt_result_rows *rows = wt_result_rows_new(result, false);
    const wt_result_row first = wt_result_rows_get(rows, 0), second = wt_result_rows_get(rows, 1);
    assert_string_equal(first.name, "glass transition");
    assert_string_equal(first.text, "7.30 degC");
    assert_string_equal(first.interval, "");
    assert_string_equal(first.note, "peak of tan delta");
    assert_string_equal(second.text, "-2.71 degC");
    assert_string_equal(second.interval, "-3.32 to -2.10");
    assert_string_equal(second.note, "peak of the loss modulus");
    wt_result_rows_free(rows);
    wt_result_free(result);
}

static void test_ramps(void **state)
{
    (void)state;
    static const double at[] = {253.15, 290, 400};
    const char *patterns[FILES];
    wt_ramp_job job = wt_ramp_job_defaults();
    wt_job work = wt_job_defaults();
    wt_ramp_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < FILES; i++) {
        FILE *out = next_file(i);
        for (int k = 0; k < POINTS; k++)
            fprintf(out, "%g,%d,%.12g,%.12g,0.05\n", at_hertz[i], -60 + 2 * k,
                    storage_at(-60 + 2 * k, at_hertz[i]), loss_at(-60 + 2 * k, at_hertz[i]));
        fclose(out);
    }
    const wt_file_set set = all_files(patterns);
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.temperature = at;
    job.n_temperatures = 3;
    if (wt_ramp_compute(&job, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    remove_files();
    const wt_table *ramp = tables.ramp, *peaks = tables.glass_transition,
                   *moduli = tables.moduli_at;
    assert_int_equal(wt_table_n_rows(ramp), FILES * POINTS);
    assert_int_equal(wt_table_n_rows(peaks), FILES);
    assert_int_equal(wt_table_n_rows(moduli), FILES * 3);
    for (size_t i = 0; i < FILES; i++) { /* by increasing frequency */
        const double f = at_hertz[FILES - 1 - i];
        for (size_t k = 0; k < POINTS; k++) {
            const size_t row = i * POINTS + k;
            const double celsius = -60 + 2 * (double)k, storage = storage_at(celsius, f),
                         loss = loss_at(celsius, f);
            assert_int_equal(wt_table_block(ramp, row), i);
            assert_near(cell(ramp, row, "temperature"), 273.15 + celsius, 1e-9);
            assert_near(cell(ramp, row, "angular_frequency"), 2 * M_PI * f, 1e-9);
            assert_near(cell(ramp, row, "storage_modulus"), 1e6 * storage, 1e-9);
            assert_near(cell(ramp, row, "loss_modulus"), 1e6 * loss, 1e-9);
            assert_near(cell(ramp, row, "loss_factor"), loss / storage, 1e-9);
            assert_near(cell(ramp, row, "strain"), 5e-4, 1e-9);
            assert_non_null(strstr(paths[FILES - 1 - i], "weartrack"));
            assert_non_null(strstr(cell_text(ramp, row, "source"), paths[FILES - 1 - i] + 5));
        }
        double height = 0;
        const double peak = factor_peak(f, &height);
        assert_near(cell(peaks, i, "angular_frequency"), 2 * M_PI * f, 1e-9);
        check_interval(peaks, i, "loss_factor_peak_temperature", 273.15 + peak, 0.1);
        check_interval(peaks, i, "loss_modulus_peak_temperature", 273.15 - 28 + 6 * log10(f), 0.1);
        assert_near(cell(peaks, i, "loss_factor_peak"), height, 5e-3);
        assert_near(cell(peaks, i, "loss_modulus_peak"), 61e6, 5e-3);
        assert_true(cell(peaks, i, "loss_factor_points") >= 5);
        assert_true(cell(peaks, i, "loss_modulus_points") >= 5);
        assert_true(cell(peaks, i, "loss_factor_misfit") < 0.01);
        assert_true(cell(peaks, i, "loss_modulus_misfit") < 0.01);
        assert_string_equal(cell_text(peaks, i, "loss_factor_note"), "");
        assert_near(cell(peaks, i, "temperature_min"), 213.15, 1e-9);
        assert_near(cell(peaks, i, "temperature_max"), 313.15, 1e-9);
        for (size_t k = 0; k < 3; k++) {
            const size_t row = 3 * i + k;
            const double storage = 1e6 * storage_at(at[k] - 273.15, f),
                         loss = 1e6 * loss_at(at[k] - 273.15, f);
            assert_near(cell(moduli, row, "temperature"), at[k], 0);
            assert_near(cell(moduli, row, "angular_frequency"), 2 * M_PI * f, 1e-9);
            assert_string_equal(cell_text(moduli, row, "note"),
                                k < 2 ? "" : "outside of the temperatures measured");
            if (k == 2) {
                assert_true(isnan(cell(moduli, row, "storage_modulus")));
                continue;
            }
            check_interval(moduli, row, "storage_modulus", storage, 0.02 * storage);
            check_interval(moduli, row, "loss_modulus", loss, 0.02 * loss);
            check_interval(moduli, row, "loss_factor", loss / storage, 0.02 * loss / storage);
        }
    }
    /* the keys are those of 1 Hz */
    assert_near(key_estimate(peaks, "angular_frequency").value, 2 * M_PI, 1e-9);
    assert_near(key_estimate(peaks, "loss_factor_peak_temperature").value,
                cell(peaks, 0, "loss_factor_peak_temperature"), 1e-9);
    assert_near(key_estimate(peaks, "loss_factor_peak_temperature").standard_error,
                cell(peaks, 0, "loss_factor_peak_temperature_standard_error"), 1e-9);
    assert_near(key_estimate(peaks, "loss_modulus_peak_temperature").value,
                cell(peaks, 0, "loss_modulus_peak_temperature"), 1e-9);
    check_rows(tables.glass_transition);
    tables.glass_transition = NULL;
    wt_tables_clear(&tables, sizeof tables);
}

/* ---- strain sweeps --------------------------------------------------------------------------- */

static const double soft = 2.5, fall = 3, half = 0.5, exponent = 0.6, most = 0.9, rest = 0.2;

static double kraus_storage(double percent)
{
    return soft + fall / (1 + pow(percent / half, 2 * exponent));
}

static double kraus_loss(double percent)
{
    const double z = pow(percent / half, exponent);
    return rest + (most - rest) * 2 * z / (1 + z * z);
}

/* Strain where the storage modulus has lost a share of its initial value. */
static double strain_lost(double start, double share)
{
    double low = 1e-4, high = 1e4;
    for (int i = 0; i < 200; i++) {
        const double middle = sqrt(low * high);
        *(kraus_storage(middle) > (1 - share) * start ? &low : &high) = middle;
    }
    return low / 100;
}

static void test_strain(void **state)
{
    (void)state;
    const char *patterns[FILES];
    wt_payne_job job = wt_payne_job_defaults();
    wt_job work = wt_job_defaults();
    wt_payne_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    double percent[STRAINS], storage_of[FILES][STRAINS], loss_of[FILES][STRAINS];
    uint64_t seed = 4;
    for (size_t k = 0; k < STRAINS; k++)
        percent[k] = half * pow(10, -2.5 + 5.0 * (double)k / (STRAINS - 1));
    for (size_t i = 0; i < FILES; i++) {
        FILE *out = next_file(i);
        for (size_t k = 0; k < STRAINS; k++) { /* the faster one is twice as stiff */
            const double scale = i == 0 ? 2 : 1;
            storage_of[i][k] =
                scale * (kraus_storage(percent[k]) + 2e-3 * (soft + fall) * truth_normal(&seed));
            loss_of[i][k] = scale * (kraus_loss(percent[k]) + 2e-3 * most * truth_normal(&seed));
            fprintf(out, "%g,25,%.15g,%.15g,%.15g\n", at_hertz[i], storage_of[i][k], loss_of[i][k],
                    percent[k]);
        }
        fclose(out);
    }
    const wt_file_set set = all_files(patterns);
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_payne_compute(&job, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    remove_files();
    const wt_table *p = tables.payne, *s = tables.payne_sweep;
    assert_int_equal(wt_table_n_rows(p), FILES);
    assert_int_equal(wt_table_n_rows(s), FILES * STRAINS);
    for (size_t i = 0; i < FILES; i++) {
        const double scale = 1e6 * (i == 0 ? 1 : 2), f = at_hertz[FILES - 1 - i],
                     start = cell(p, i, "storage_start");
        assert_near(cell(p, i, "angular_frequency"), 2 * M_PI * f, 1e-9);
        assert_near(cell(p, i, "temperature"), 298.15, 1e-9);
        /* a few of the smallest and of the largest amplitudes */
        assert_near(start, scale * kraus_storage(percent[0]), 0.01);
        assert_near(cell(p, i, "storage_end"), scale * kraus_storage(percent[STRAINS - 1]), 0.01);
        assert_near(cell(p, i, "strain_tenth"), strain_lost(start / scale, 0.1), 0.03);
        assert_near(cell(p, i, "strain_half"), strain_lost(start / scale, 0.5), 0.08);
        assert_near(cell(p, i, "loss_max"), scale * most, 0.01);
        assert_near(cell(p, i, "strain_loss_max"), half / 100, 0.05);
        assert_near(cell(p, i, "points"), STRAINS, 0);
        assert_near(cell(p, i, "strain_min"), percent[0] / 100, 1e-9);
        assert_near(cell(p, i, "strain_max"), percent[STRAINS - 1] / 100, 1e-9);
        assert_non_null(strstr(cell_text(p, i, "source"), paths[FILES - 1 - i] + 5));
        double loss_start = 0;
        for (size_t k = 0; k < STRAINS; k++) {
            const size_t row = i * STRAINS + k;
            const double storage = 1e6 * storage_of[FILES - 1 - i][k],
                         loss = 1e6 * loss_of[FILES - 1 - i][k];
            assert_int_equal(wt_table_block(s, row), i);
            assert_near(cell(s, row, "strain"), percent[k] / 100, 1e-9);
            assert_near(cell(s, row, "angular_frequency"), 2 * M_PI * f, 1e-9);
            assert_near(cell(s, row, "temperature"), 298.15, 1e-9);
            assert_near(cell(s, row, "storage_modulus"), storage, 1e-9);
            assert_near(cell(s, row, "loss_modulus"), loss, 1e-9);
            assert_near(cell(s, row, "loss_factor"), loss / storage, 1e-9);
            assert_near(cell(s, row, "storage_ratio"), storage / start, 1e-6);
            if (k == 0)
                loss_start = loss / cell(s, row, "loss_ratio");
            assert_near(cell(s, row, "loss_ratio"), loss / loss_start, 1e-6);
        }
        assert_near(loss_start, scale * kraus_loss(percent[0]), 0.2);
    }
    wt_tables_clear(&tables, sizeof tables);
}

/* The strain range is that of the remaining points of a sweep. */
static void test_left_out(void **state)
{
    (void)state;
    enum { FIRST = 3, LAST = STRAINS - 2 };
    const char *patterns[FILES];
    wt_payne_job job = wt_payne_job_defaults();
    wt_job work = wt_job_defaults();
    wt_payne_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    double percent[STRAINS];
    for (size_t i = 0; i < FILES; i++) {
        FILE *out = next_file(i);
        for (size_t k = 0; k < STRAINS; k++) {
            percent[k] = half * pow(10, -2.5 + 5.0 * (double)k / (STRAINS - 1));
            const bool good = k >= FIRST && k <= LAST;
            fprintf(out, "%g,25,%.15g,%.15g,%.15g\n", at_hertz[i],
                    good ? kraus_storage(percent[k]) : 0, kraus_loss(percent[k]), percent[k]);
        }
        fclose(out);
    }
    const wt_file_set set = all_files(patterns);
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_payne_compute(&job, &work, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    remove_files();
    for (size_t i = 0; i < FILES; i++) {
        assert_near(cell(tables.payne, i, "points"), LAST - FIRST + 1, 0);
        assert_near(cell(tables.payne, i, "strain_min"), percent[FIRST] / 100, 1e-9);
        assert_near(cell(tables.payne, i, "strain_max"), percent[LAST] / 100, 1e-9);
    }
    wt_tables_clear(&tables, sizeof tables);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_ramps), cmocka_unit_test(test_strain),
                                       cmocka_unit_test(test_left_out)};
    return cmocka_run_group_tests_name("tables of sweeps", tests, open_formats, free_formats);
}
