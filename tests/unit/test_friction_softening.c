/* Strain softening in the jobs: mean of strain sweeps, draws, the table softening, and a case that
 * requests it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma_data.h"
#include "sliding_fixture.h"
#include "table_cells.h"

#include "core/table/registry.h"
#include "weartrack/case.h"

#include <stdlib.h>
#include <string.h>

#define SWEEPS WT_SOURCE_DIR "/fixtures/formats/tidy/strain-sweeps.csv"
enum { MOST = 64, N_SWEEPS = 3 };

static wt_table *payne_sweep;
static wt_formats *formats;

static int make_sweeps(void **state)
{
    (void)state;
    static const char *const file[] = {SWEEPS};
    const wt_file_set set = {.patterns = file, .n_patterns = 1, .read = wt_read_defaults()};
    wt_payne_job job = wt_payne_job_defaults();
    wt_payne_tables tables = {0};
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    if (wt_formats_new(NULL, &formats, NULL, &err) != WT_OK)
        return -1;
    common.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    if (wt_payne_compute(&job, &common, &tables, &err) != WT_OK)
        print_error("%s\n", err.message);
    payne_sweep = tables.payne_sweep;
    tables.payne_sweep = NULL;
    wt_tables_clear(&tables, sizeof tables);
    return payne_sweep != NULL ? 0 : -1;
}

static int free_sweeps(void **state)
{
    (void)state;
    wt_table_free(payne_sweep);
    wt_formats_free(formats);
    return 0;
}

/* ---- mean ------------------------------------------------------------------------------------ */

/* Linear in the logarithm of the strain, for source i of the table. */
static double of_source(const char *source, const char *column, double strain)
{
    double x[2] = {(double)NAN, (double)NAN}, y[2] = {0, 0};
    for (size_t row = 0; row < wt_table_n_rows(payne_sweep); row++) {
        const double here = number_cell(payne_sweep, row, "strain");
        if (strcmp(text_cell(payne_sweep, row, "source"), source) != 0)
            continue;
        if (here <= strain * (1 + 1e-12)) {
            x[0] = here;
            y[0] = number_cell(payne_sweep, row, column);
        } else if (isnan(x[1])) {
            x[1] = here;
            y[1] = number_cell(payne_sweep, row, column);
        }
    }
    if (isnan(x[1]))
        return y[0];
    return y[0] + (y[1] - y[0]) * log(strain / x[0]) / log(x[1] / x[0]);
}

/* Three sweeps: their mean and the scatter of a fourth one. */
static void test_mean(void **state)
{
    (void)state;
    const char *sources[N_SWEEPS];
    size_t n = 0;
    for (size_t row = 0; row < wt_table_n_rows(payne_sweep); row++) {
        const char *source = text_cell(payne_sweep, row, "source");
        if (n == 0 || strcmp(sources[n - 1], source) != 0) {
            assert_true(n < N_SWEEPS);
            sources[n++] = source;
        }
    }
    assert_int_equal(n, N_SWEEPS);
    wt_strain_softening s = {0};
    assert_int_equal(wt_strain_softening_from_table(
                         payne_sweep, wt_strain_softening_choice_defaults(), &s, NULL),
                     WT_OK);
    assert_int_equal(s.n_sweeps, N_SWEEPS);
    assert_true(s.table.n > 8);
    const struct {
        const char *column;
        const double *value, *error;
    } both[] = {{"storage_ratio", s.table.storage, s.storage_error},
                {"loss_ratio", s.table.loss, s.loss_error}};
    for (size_t k = 0; k < s.table.n; k++)
        for (size_t c = 0; c < 2; c++) {
            double value[N_SWEEPS], mean = 0, squares = 0;
            for (size_t i = 0; i < N_SWEEPS; i++) {
                value[i] = of_source(sources[i], both[c].column, s.table.strain[k]);
                mean += value[i] / N_SWEEPS;
            }
            for (size_t i = 0; i < N_SWEEPS; i++)
                squares += (value[i] - mean) * (value[i] - mean);
            assert_near(both[c].value[k], mean, 1e-12);
            /* Student's t with 2 degrees of freedom over 1.96 */
            const double other = 4.302652729749464 / 1.959963984540054 *
                                 sqrt(squares / (N_SWEEPS - 1) * (1 + 1.0 / N_SWEEPS));
            assert_true(fabs(both[c].error[k] - other) <= 1e-9 * other + 1e-12);
        }
    wt_strain_softening_clear(&s);
}

/* Two sweeps with disjoint strains are two, although their strains increase throughout. */
static void test_disjoint_strains(void **state)
{
    (void)state;
    static const double strain[] = {1e-3, 1e-2, 0.1, 0.2, 0.5, 1},
                        ratio[] = {1, 0.8, 0.5, 1, 0.9, 0.6};
    for (size_t n_sweeps = 1; n_sweeps <= 2; n_sweeps++) {
        table_writer t = table_begin(&payne_sweep_schema, NULL);
        wt_table *table = NULL;
        wt_strain_softening s = {0};
        for (size_t i = 0; i < 3 * n_sweeps; i++) {
            if (i % 3 == 0)
                table_block(&t);
            table_row(&t);
            payne_sweep_put(&t, PAYNE_SWEEP_STRAIN, strain[i]);
            payne_sweep_put(&t, PAYNE_SWEEP_ANGULAR_FREQUENCY, 60);
            payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_MODULUS, 1e6 * ratio[i]);
            payne_sweep_put(&t, PAYNE_SWEEP_LOSS_MODULUS, 1e5 * ratio[i]);
            payne_sweep_put(&t, PAYNE_SWEEP_LOSS_FACTOR, 0.1);
            payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_RATIO, ratio[i]);
            payne_sweep_put(&t, PAYNE_SWEEP_LOSS_RATIO, ratio[i]);
            payne_sweep_put_text(&t, PAYNE_SWEEP_SOURCE, i < 3 ? "low" : "high");
        }
        payne_sweep_set_text(&t, PAYNE_SWEEP_KEY_DEFORMATION, "shear");
        assert_int_equal(table_end(&t, &table), WT_OK);
        assert_int_equal(
            wt_strain_softening_from_table(table, wt_strain_softening_choice_defaults(), &s, NULL),
            n_sweeps == 1 ? WT_OK : WT_E_RANGE);
        wt_strain_softening_clear(&s);
        wt_table_free(table);
    }
}

/* Sweeps at several temperatures or of several samples are not repeats: one is selected. */
static void test_selected_sweep(void **state)
{
    (void)state;
    static const double at[] = {296.15, 296.65, 333.15, 333.15}, end[] = {0.5, 0.52, 0.7, 0.9};
    static const char *const sample[] = {"NR", "NR", "NR", "SBR"};
    table_writer t = table_begin(&payne_sweep_schema, NULL);
    wt_table *table = NULL;
    for (size_t i = 0; i < 12; i++) {
        const double ratio = i % 3 < 2 ? 1 : end[i / 3];
        if (i % 3 == 0)
            table_block(&t);
        table_row(&t);
        payne_sweep_put(&t, PAYNE_SWEEP_STRAIN, pow(10, -3 + (double)(i % 3)));
        payne_sweep_put(&t, PAYNE_SWEEP_ANGULAR_FREQUENCY, 60);
        payne_sweep_put(&t, PAYNE_SWEEP_TEMPERATURE, at[i / 3]);
        payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_MODULUS, 1e6 * ratio);
        payne_sweep_put(&t, PAYNE_SWEEP_LOSS_MODULUS, 1e5 * ratio);
        payne_sweep_put(&t, PAYNE_SWEEP_LOSS_FACTOR, 0.1);
        payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_RATIO, ratio);
        payne_sweep_put(&t, PAYNE_SWEEP_LOSS_RATIO, ratio);
        payne_sweep_put_text(&t, PAYNE_SWEEP_SOURCE, "a file");
        payne_sweep_put_text(&t, PAYNE_SWEEP_SAMPLE, sample[i / 3]);
    }
    payne_sweep_set_text(&t, PAYNE_SWEEP_KEY_DEFORMATION, "shear");
    assert_int_equal(table_end(&t, &table), WT_OK);
    const struct {
        double temperature;
        const char *sample, *found;
        size_t n;
        double last;
    } cases[] = {{(double)NAN, NULL, "NR, SBR", 0, 0}, {(double)NAN, "NR", "23.0, 60.0 degC", 0, 0},
                 {(double)NAN, "SBR", NULL, 1, 0.9},   {(double)NAN, "EPDM", "NR", 0, 0},
                 {300, "NR", NULL, 2, 0.51},           {400, "NR", NULL, 1, 0.7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const wt_strain_softening_choice choice = {.temperature = cases[i].temperature,
                                                   .sample = cases[i].sample};
        wt_strain_softening s = {0};
        wt_error err = WT_ERROR_INIT;
        const wt_status status = wt_strain_softening_from_table(table, choice, &s, &err);
        assert_int_equal(status == WT_OK, cases[i].found == NULL);
        if (cases[i].found != NULL)
            assert_string_equal(err.found, cases[i].found);
        else
            assert_near(s.table.storage[s.table.n - 1], cases[i].last, 1e-12);
        assert_int_equal(s.n_sweeps, cases[i].n);
        wt_strain_softening_clear(&s);
    }
    wt_table_free(table);
}

/* ---- the jobs -------------------------------------------------------------------------------- */

static double velocity[] = {1e-3, 0.1, 10};
enum { N_VELOCITIES = 3 };

static double strain[] = {1e-3, 1e-2, 5e-2}, storage[] = {1, 0.8, 0.5}, loss[] = {1, 0.95, 0.65},
              storage_error[] = {0, 0.03, 0.06}, loss_error[] = {0, 0.02, 0.05};

static wt_strain_softening given(bool errors)
{
    wt_strain_softening s = {.table = {.n = 3, .strain = strain, .storage = storage, .loss = loss}};
    if (errors) {
        s.storage_error = storage_error;
        s.loss_error = loss_error;
    }
    return s;
}

/* Friction up to a wavenumber does not depend on larger ones. Where the strain leaves the table the
 * surface is truncated, and the missing part is the share from above. */
static void test_shares(void **state)
{
    (void)state;
    const wt_strain_softening s = given(false);
    wt_table *table = NULL, *cut = NULL;
    sliding_set_up(velocity, N_VELOCITIES);
    sliding.strain_softening = &s;
    sliding.strain_factor = 0.5;
    assert_int_equal(wt_softened_friction_compute(&sliding, &work, &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), N_VELOCITIES);
    double low = surface.qr, high = surface.q1;
    for (int i = 0; i < 200; i++) {
        wt_surface shorter = surface;
        wt_roughness *road = NULL;
        shorter.q1 = sqrt(low * high);
        assert_int_equal(wt_surface_roughness(&shorter, 1, &road, NULL), WT_OK);
        *(sliding.strain_factor * wt_roughness_rms_slope(road) > strain[2] ? &high : &low) =
            shorter.q1;
        wt_roughness_free(road);
    }
    const double whole = surface.q1;
    surface.q1 = high;
    assert_int_equal(wt_softened_friction_compute(&sliding, &work, &cut, NULL), WT_OK);
    surface.q1 = whole;
    for (size_t i = 0; i < N_VELOCITIES; i++) {
        const double all = number_cell(table, i, "hysteresis"),
                     part = number_cell(cut, i, "hysteresis"),
                     share = number_cell(table, i, "share_above");
        assert_near(share, 1 - part / all, 1e-8);
        assert_true(share > 0.01 && share < 0.9999);
        assert_near(number_cell(cut, i, "share_above"), 0, 1e-8);
        /* softer: more contact, and here more friction */
        assert_true(number_cell(table, i, "area_ratio") >
                    1.5 * number_cell(table, i, "area_ratio_without"));
    }
    wt_table_free(table);
    wt_table_free(cut);
}

/* The tables softening and friction agree; without softening friction is that of a call without the
 * option. */
static void test_tables_agree(void **state)
{
    (void)state;
    const wt_strain_softening s = given(false);
    wt_friction_tables with = {0}, without = {0};
    wt_table *table = NULL;
    sliding_set_up(velocity, N_VELOCITIES);
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &without, NULL), WT_OK);
    assert_int_equal(wt_softened_friction_compute(&sliding, &work, &table, NULL), WT_E_ARG);
    sliding.strain_softening = &s;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &with, NULL), WT_OK);
    assert_int_equal(wt_softened_friction_compute(&sliding, &work, &table, NULL), WT_OK);
    static const char *const columns[] = {"hysteresis", "area_ratio"}, *const others[] = {
                                                                           "hysteresis_without",
                                                                           "area_ratio_without"};
    for (size_t i = 0; i < N_VELOCITIES; i++)
        for (size_t c = 0; c < 2; c++) {
            assert_near(number_cell(with.friction, i, columns[c]),
                        number_cell(table, i, columns[c]), 1e-13);
            assert_near(number_cell(without.friction, i, columns[c]),
                        number_cell(table, i, others[c]), 1e-13);
        }
    wt_table_free(with.friction);
    wt_table_free(without.friction);
    wt_table_free(table);
}

/* Only f and g have errors: the scatter is that of friction with both moved by a small error. */
static void test_drawn(void **state)
{
    (void)state;
    wt_strain_softening s = given(true), moved[2] = {given(false), given(false)};
    double other[2][3], change[2];
    wt_friction_tables t = {0};
    sliding_set_up(velocity, 1);
    work.replicates = 2000;
    for (size_t k = 0; k < 3; k++) {
        storage_error[k] *= 0.1;
        loss_error[k] *= 0.1;
        other[0][k] = storage[k] + storage_error[k];
        other[1][k] = loss[k] + loss_error[k];
    }
    moved[0].table.storage = other[0];
    moved[1].table.loss = other[1];
    sliding.strain_softening = &s;
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &t, NULL), WT_OK);
    const double value = number_cell(t.friction, 0, "hysteresis"),
                 error = number_cell(t.friction, 0, "hysteresis_standard_error");
    const char *includes = NULL, *lacks = NULL;
    includes = wt_table_key(t.friction, "standard_error_includes");
    assert_non_null(includes);
    assert_string_equal(includes, "softening with strain");
    wt_table_free(t.friction);
    work.replicates = 0;
    for (size_t i = 0; i < 2; i++) {
        sliding.strain_softening = &moved[i];
        assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &t, NULL), WT_OK);
        change[i] = number_cell(t.friction, 0, "hysteresis") - value;
        lacks = wt_table_key(t.friction, "standard_error_excludes");
        assert_non_null(lacks);
        assert_non_null(strstr(lacks, "softening with strain"));
        wt_table_free(t.friction);
    }
    /* 2,000 draws: 1.6 % */
    assert_near(error, hypot(change[0], change[1]), 0.07);
    for (size_t k = 0; k < 3; k++) {
        storage_error[k] *= 10;
        loss_error[k] *= 10;
    }
}

/* Sweeps from a population in which the curves of f and g scatter: 1.96 standard errors cover the
 * friction of another sample with the right probability. An independent law creates the curves. */
static void test_covered(void **state)
{
    (void)state;
    enum { RUNS = 200, POINTS = 7 };
    uint64_t seed = 11;
    static const size_t n_sweeps[] = {3, 6};
    for (size_t c = 0; c < 2; c++) {
        size_t held = 0;
        for (size_t run = 0; run < RUNS; run++) {
            table_writer t = table_begin(&payne_sweep_schema, NULL);
            wt_table *table = NULL;
            wt_strain_softening s = {0};
            wt_friction_tables found = {0};
            double x[POINTS], f[POINTS], g[POINTS];
            for (size_t i = 0; i <= n_sweeps[c]; i++) { /* the last one is the other sample */
                const double of_f = exp(0.15 * dma_normal(&seed)),
                             of_g = exp(0.15 * dma_normal(&seed));
                if (i < n_sweeps[c])
                    table_block(&t);
                for (size_t k = 0; k < POINTS; k++) {
                    x[k] = 1e-4 * pow(10, 0.5 * (double)k);
                    f[k] = pow(1 + pow(x[k] / 0.01, 0.8), -0.6 * of_f);
                    g[k] = pow(1 + pow(x[k] / 0.03, 0.8), -0.4 * of_g);
                    if (i == n_sweeps[c])
                        continue;
                    table_row(&t);
                    payne_sweep_put(&t, PAYNE_SWEEP_STRAIN, x[k]);
                    payne_sweep_put(&t, PAYNE_SWEEP_ANGULAR_FREQUENCY, 60);
                    payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_MODULUS, 1e6 * f[k]);
                    payne_sweep_put(&t, PAYNE_SWEEP_LOSS_MODULUS, 1e5 * g[k]);
                    payne_sweep_put(&t, PAYNE_SWEEP_LOSS_FACTOR, 0.1 * g[k] / f[k]);
                    payne_sweep_put(&t, PAYNE_SWEEP_STORAGE_RATIO, f[k]);
                    payne_sweep_put(&t, PAYNE_SWEEP_LOSS_RATIO, g[k]);
                    payne_sweep_put_text(&t, PAYNE_SWEEP_SOURCE, "made");
                }
            }
            payne_sweep_set_text(&t, PAYNE_SWEEP_KEY_DEFORMATION, "shear");
            assert_int_equal(table_end(&t, &table), WT_OK);
            assert_int_equal(wt_strain_softening_from_table(
                                 table, wt_strain_softening_choice_defaults(), &s, NULL),
                             WT_OK);
            sliding_set_up(velocity, 1);
            work.seed = run + 1;
            work.replicates = 64;
            work.tolerance = 1e-4;
            sliding.strain_softening = &s;
            assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &found, NULL),
                             WT_OK);
            const double value = number_cell(found.friction, 0, "hysteresis"),
                         error = number_cell(found.friction, 0, "hysteresis_standard_error");
            wt_table_free(found.friction);
            const wt_strain_softening other = {
                .table = {.n = POINTS, .strain = x, .storage = f, .loss = g},
                .temperature = (double)NAN};
            work.replicates = 0;
            sliding.strain_softening = &other;
            assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &found, NULL),
                             WT_OK);
            held += fabs(number_cell(found.friction, 0, "hysteresis") - value) <= 1.96 * error;
            wt_table_free(found.friction);
            wt_strain_softening_clear(&s);
            wt_table_free(table);
        }
        print_message("%zu sweeps: %g\n", n_sweeps[c], (double)held / RUNS);
        assert_true(100 * held >= 92 * RUNS && 100 * held <= 98 * RUNS);
    }
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        double strain, f;
    } bad[] = {{1e-4, 0.8}, {(double)NAN, 0.8}, {1e-2, 0}, {1e-2, (double)NAN}, {1e-2, 1e4}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double x[] = {1e-3, bad[i].strain}, f[] = {1, bad[i].f}, g[] = {1, 1};
        const wt_softening t = {.n = 2, .strain = x, .storage = f, .loss = g};
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_softening_check(&t, &err), WT_E_RANGE);
        assert_string_equal(err.place, "point 2 of 2");
    }
}

/* ---- cases ----------------------------------------------------------------------------------- */

static wt_result *run(const char *softening, const char *files)
{
    char path[] = "/tmp/weartrack-softening-XXXXXX";
    const int at = mkstemp(path);
    assert_true(at >= 0);
    FILE *out = fdopen(at, "w");
    fprintf(out,
            "<case version='1'><dma><files>%s/fixtures/case/dma.txt</files>%s</dma><roughness>"
            "<self-affine><q0>2e3rad/m</q0><q1>2e6rad/m</q1><hurst>0.8</hurst><c0>2e-17m^4</c0>"
            "</self-affine></roughness><sliding><pressure>0.4MPa</pressure>"
            "<velocity>0.3m/s</velocity>%s</sliding></case>",
            WT_SOURCE_DIR, files, softening);
    fclose(out);
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_run_options options = wt_run_defaults();
    size_t n_failed = 0;
    options.replicates = 0;
    if (wt_case_read(path, &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, &n_failed, &err) != WT_OK)
        print_error("%s: %s %s\n", err.place, err.message, err.found);
    wt_case_free(c);
    remove(path);
    assert_non_null(result);
    return result;
}

static double hysteresis(const wt_result *result)
{
    return number_cell(wt_result_find(result, "friction"), 0, "hysteresis");
}

/* Strain sweeps from the case or from a file; without either there is no friction that appears to
 * have softening. */
static void test_cases(void **state)
{
    (void)state;
    static const char sweeps[] = "<files>" SWEEPS "</files>";
    char path[] = "/tmp/weartrack-softening-XXXXXX", text[256];
    const int at = mkstemp(path);
    assert_true(at >= 0);
    FILE *out = fdopen(at, "w");
    assert_int_equal(wt_stream_write(out, payne_sweep, NULL, NULL), WT_OK);
    fclose(out);
    snprintf(text, sizeof text, "<strain-softening><file>%s</file></strain-softening>", path);
    wt_result *none = run("", sweeps),
              *swept = run("<strain-softening><sweeps/></strain-softening>", sweeps),
              *from_file = run(text, ""),
              *without = run("<strain-softening><sweeps/></strain-softening>", "");
    remove(path);
    assert_near(hysteresis(swept), hysteresis(from_file), 1e-12);
    assert_true(hysteresis(swept) > 1.2 * hysteresis(none));
    assert_null(wt_result_find(none, "softening"));
    assert_non_null(wt_result_find(swept, "softening"));
    assert_null(wt_result_find(without, "friction"));
    assert_true(wt_table_n_rows(wt_result_find(without, "failures")) > 0);
    wt_result_free(none);
    wt_result_free(swept);
    wt_result_free(from_file);
    wt_result_free(without);
}

/* A stated table, with columns in any order and strain in any unit: both errors or none. */
static void test_stated_table(void **state)
{
    (void)state;
    static const char *const names[] = {"strain", "g_error", "g", "f_error", "f"};
    static const double values[][5] = {{0.1, 0.02, 1.1, 0.01, 1}, {10, 0.03, 1.2, 0.05, 0.8}};
    for (unsigned errors = 0; errors < 4; errors++) {
        wt_table *t = wt_table_new("given", "");
        wt_strain_softening s = {0};
        wt_error err = WT_ERROR_INIT;
        size_t n = 0, of[5];
        for (size_t c = 0; c < 5; c++) {
            if ((c == 1 && !(errors & 1)) || (c == 3 && !(errors & 2)))
                continue;
            of[n++] = c;
            assert_int_equal(wt_table_add_column(t, names[c], c == 0 ? "%" : "1", "", NULL), WT_OK);
        }
        for (size_t row = 0; row < 2; row++) {
            assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
            for (size_t c = 0; c < n; c++)
                wt_table_set_number(t, c, values[row][of[c]]);
        }
        const wt_status status =
            wt_strain_softening_from_table(t, wt_strain_softening_choice_defaults(), &s, &err);
        if (errors == 1 || errors == 2) {
            assert_int_equal(status, WT_E_MISSING);
            assert_string_equal(err.found, errors == 1 ? "g_error" : "f_error");
        } else {
            assert_int_equal(status, WT_OK);
            assert_int_equal(s.table.n, 2);
            assert_int_equal(s.n_sweeps, 0);
            assert_int_equal(s.storage_error != NULL, errors == 3);
            assert_int_equal(s.loss_error != NULL, errors == 3);
            for (size_t row = 0; row < 2; row++) {
                assert_near(s.table.strain[row], values[row][0] / 100, 1e-12);
                assert_near(s.table.storage[row], values[row][4], 0);
                assert_near(s.table.loss[row], values[row][2], 0);
                if (errors == 3) {
                    assert_near(s.storage_error[row], values[row][3], 0);
                    assert_near(s.loss_error[row], values[row][1], 0);
                }
            }
        }
        wt_strain_softening_clear(&s);
        wt_table_free(t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mean),           cmocka_unit_test(test_disjoint_strains),
        cmocka_unit_test(test_selected_sweep), cmocka_unit_test(test_covered),
        cmocka_unit_test(test_shares),         cmocka_unit_test(test_tables_agree),
        cmocka_unit_test(test_drawn),          cmocka_unit_test(test_refused),
        cmocka_unit_test(test_cases),          cmocka_unit_test(test_stated_table),
    };
    return cmocka_run_group_tests_name("softening", tests, make_sweeps, free_sweeps);
}
