/* Height maps and profiles in files to one power spectrum: synthetic surfaces with a known
 * spectrum.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "study/synthetic_surface.h"

#include "core/base/array.h"
#include "friction/counter_surface.h"
#include "job/random_draws.h"
#include "truth_fixture.h"
#include "weartrack/case.h"

#include <string.h>
#include <unistd.h>

#define SURFACE WT_SOURCE_DIR "/fixtures/surface/"
/* The values of tests/generate/generate_surface.c. */
static const synthetic_surface behind = {256, 200e-6, 21, 126, 6e-26, 6e5, 0.8, 0, true, 0};

static wt_formats *formats;

static int begin(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

typedef struct making {
    wt_topography_job job;
    wt_topography_tables tables;
    wt_log *log;
    wt_error err;
    wt_status status;
} making;

static void make(making *m, const char *const *files, size_t n)
{
    wt_job work = wt_job_defaults();
    wt_file_set set = {.patterns = files, .n_patterns = n, .read = wt_read_defaults()};
    m->log = wt_log_new();
    work.formats = formats;
    work.log = m->log;
    m->job.sets = &set;
    m->job.n_sets = 1;
    m->err = (wt_error)WT_ERROR_INIT;
    m->status = wt_topography_compute(&m->job, &work, &m->tables, &m->err);
}

static void clear(making *m)
{
    wt_tables_clear(&m->tables, sizeof m->tables);
    wt_log_free(m->log);
}

static bool said(const making *m, const char *words)
{
    for (size_t i = 0; i < wt_log_count(m->log); i++)
        if (strstr(wt_log_get(m->log, i).text, words) != NULL)
            return true;
    return false;
}

static const char *text_cell(const wt_table *t, size_t row, const char *name)
{
    return wt_table_text(t, row, (size_t)wt_table_find(t, name));
}

static const char *const all[] = {SURFACE "near-by.gsf", SURFACE "place-1.gsf",
                                  SURFACE "place-2.gsf"};

static double key(const wt_table *t, const char *name)
{
    wt_estimate e = {(double)NAN, 0, 0, NULL};
    (void)wt_table_estimate(t, name, &e);
    return e.value;
}

static double error_of(const wt_table *t, const char *name)
{
    wt_estimate e = {(double)NAN, (double)NAN, 0, NULL};
    (void)wt_table_estimate(t, name, &e);
    return e.standard_error;
}

/* Three scans of two sizes: the densities cover the truth, and so do the law and its sums over the
 * range. */
static void test_density_law_and_sums(void **state)
{
    (void)state;
    making m = {.job = wt_topography_job_defaults()};
    make(&m, all, COUNT_OF(all));
    assert_int_equal(m.status, WT_OK);
    const wt_table *t = m.tables.power_spectrum;
    const size_t n = wt_table_n_rows(t);
    size_t within = 0;
    for (size_t i = 0; i < n; i++) {
        const double q = cell(t, i, "wavenumber"), c = surface_density(&behind, q);
        within += cell(t, i, "density_low") < c && c < cell(t, i, "density_high") ? 1 : 0;
        assert_string_equal(cell_text(t, i, "source"), "measured");
        assert_near(cell(t, i, "self_affine"), c, 0.6);
    }
    assert_true(n >= 18);
    assert_true(within >= n - 2);
    assert_near_abs(key(t, "hurst"), 0.8, 3 * error_of(t, "hurst"));
    assert_near(key(t, "reliable_to"), 1.6e7, 0.1);
    wt_roughness *r = NULL;
    assert_int_equal(wt_roughness_self_affine(cell(t, 0, "wavenumber"), behind.roll_off,
                                              cell(t, n - 1, "wavenumber"), behind.hurst, behind.c0,
                                              &r, NULL),
                     WT_OK);
    assert_near_abs(log(key(t, "roll_off") / behind.roll_off), 0,
                    3 * error_of(t, "roll_off") / behind.roll_off);
    assert_near_abs(key(t, "rms_height"), wt_roughness_rms_height(r),
                    3 * error_of(t, "rms_height"));
    assert_near_abs(key(t, "rms_slope"), wt_roughness_rms_slope(r), 4 * error_of(t, "rms_slope"));
    assert_true(error_of(t, "rms_slope") < 0.2 * key(t, "rms_slope"));
    wt_roughness_free(r);
    assert_false(said(&m, "one scan"));
    assert_int_equal(wt_table_n_rows(m.tables.surfaces), 3);
    assert_near(cell(m.tables.surfaces, 0, "step_x"), 20e-6 / 256 * 112 / 111, 1e-2);
    clear(&m);
}

/* The upper limit: stated within the range, beyond it, and by the slope. */
static void test_upper_limit(void **state)
{
    (void)state;
    making m = {.job = wt_topography_job_defaults()};
    m.job.end = 3e6;
    make(&m, all, COUNT_OF(all));
    const wt_table *t = m.tables.power_spectrum;
    size_t last = wt_table_n_rows(t) - 1;
    assert_string_equal(cell_text(t, last, "source"), "cut");
    assert_near(cell(t, last, "wavenumber"), 3e6, 1e-12);
    assert_near(cell(t, last, "density"), surface_density(&behind, 3e6), 0.9);
    const double slope = key(t, "rms_slope");
    clear(&m);

    m.job.end = (double)NAN;
    m.job.end_slope = slope;
    make(&m, all, COUNT_OF(all));
    t = m.tables.power_spectrum;
    assert_near(cell(t, wt_table_n_rows(t) - 1, "wavenumber"), 3e6, 1e-9);
    clear(&m);

    m.job.end_slope = 1.3;
    make(&m, all, COUNT_OF(all));
    t = m.tables.power_spectrum;
    last = wt_table_n_rows(t) - 1;
    assert_string_equal(cell_text(t, last, "source"), "law");
    assert_near(key(t, "rms_slope"), 1.3, 0.02);
    assert_near(cell(t, last, "wavenumber"), key(t, "steep_wavenumber"), 1e-9);
    assert_string_equal(wt_table_key(t, "steep_by"), "law");
    assert_true(key(t, "extrapolated_share") > 0.3);
    assert_true(said(&m, "beyond the reliable range"));
    /* the error of the law increases with the extrapolation, and so does that of the slope */
    const double truth = surface_density(&behind, cell(t, last, "wavenumber"));
    assert_near_abs(log(cell(t, last, "density") / truth), 0, 3 * cell(t, last, "law_error"));
    assert_near(cell(t, last, "density_standard_error") / cell(t, last, "density"),
                log(cell(t, last, "density_high") / cell(t, last, "density")) / 1.96, 1e-3);
    size_t first = last;
    while (strcmp(cell_text(t, first - 1, "source"), "law") == 0)
        first--;
    assert_true(first < last);
    assert_true(cell(t, last, "law_error") > 1.5 * cell(t, first, "law_error"));
    assert_true(isnan(cell(t, first - 1, "law_error")) && isnan(cell(t, first, "modes_error")));
    assert_true(key_estimate(t, "rms_slope").standard_error > 0.02);
    clear(&m);

    m.job.end = 1e7;
    make(&m, all, COUNT_OF(all));
    assert_int_equal(m.status, WT_E_ARG);
    clear(&m);
    m.job.end = 1e5; /* below the first bin */
    m.job.end_slope = (double)NAN;
    make(&m, all, COUNT_OF(all));
    assert_int_equal(m.status, WT_E_RANGE);
    clear(&m);
}

/* Heights minus form of four maps together, with a step of several points; the line of a map is the
 * middle one, and a profile has no map. */
static void test_heights(void **state)
{
    (void)state;
    enum { SIDE = 112 }; /* of three scans in a picture of 256 points: every point */
    making m = {.job = wt_topography_job_defaults()};
    make(&m, all, COUNT_OF(all));
    assert_null(m.tables.height_map);
    assert_null(m.tables.height_profile);
    clear(&m);
    m.job.heights = true;
    make(&m, all, COUNT_OF(all));
    const wt_table *map = m.tables.height_map, *line = m.tables.height_profile,
                   *scans = m.tables.surfaces;
    assert_int_equal(wt_table_n_rows(map), COUNT_OF(all) * SIDE * SIDE);
    assert_int_equal(wt_table_n_rows(line), COUNT_OF(all) * SIDE);
    double square = 0, mean = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const double height = cell(map, i, "height");
        assert_near(cell(map, i, "scan"), 1, 0);
        square += height * height;
        mean += height;
    }
    assert_near(sqrt(square) / SIDE, cell(scans, 0, "rms_height"), 1e-6);
    assert_near_abs(mean / SIDE / SIDE, 0, 1e-6 * cell(scans, 0, "rms_height"));
    const size_t second = (size_t)SIDE * SIDE + SIDE / 2 * SIDE;
    for (size_t i = 0; i < SIDE; i++) {
        assert_near(cell(line, SIDE + i, "height"), cell(map, second + i, "height"), 0);
        assert_near(cell(map, second + i, "x"), (double)i * cell(scans, 1, "step_x"), 1e-12);
    }
    clear(&m);
    make(&m, (const char *const[]){SURFACE "profile-*.gsf"}, 1);
    assert_null(m.tables.height_map);
    assert_int_equal(wt_table_n_rows(m.tables.height_profile), 8 * 250);
    clear(&m);
}

/* A synthetic surface with x and y exchanged, as a Gwyddion simple field. */
/* With `crossed`, grooves along x and along y are added, as random as two lines of the surface. */
static void write_turned(const char *path, const synthetic_surface *made, bool crossed)
{
    const size_t n = made->n;
    double *z = surface_create(made);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    const int used = fprintf(out,
                             "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\nXReal = %g\n"
                             "YReal = %g\nXYUnits = m\nZUnits = m\n",
                             n, n, made->length, made->length);
    assert_true(used > 0);
    for (int i = 0; i < 4 - used % 4; i++)
        assert_int_equal(fputc(0, out), 0);
    for (size_t k = 0; k < n * n; k++) {
        const float height =
            (float)(z[k % n * n + k / n] + (crossed ? z[k % n] + z[n * n / 2 + k / n] : 0));
        assert_int_equal(fwrite(&height, sizeof height, 1, out), 1);
    }
    assert_int_equal(fclose(out), 0);
    free(z);
}

/* Texture across y: both orders with errors; none for isotropic surfaces, and no table for
 * profiles. */
static void test_directions(void **state)
{
    (void)state;
    char path[] = "/tmp/weartrack-surface-XXXXXX.gsf";
    const int fd = mkstemps(path, 4);
    assert_true(fd >= 0);
    close(fd);
    const char *const file[] = {path};
    synthetic_surface made = behind;
    made.stretch = 0.6;
    write_turned(path, &made, false);
    making m = {.job = wt_topography_job_defaults()};
    make(&m, file, 1);
    assert_int_equal(m.status, WT_OK);
    const wt_table *t = m.tables.power_spectrum;
    assert_near_abs(key(t, "anisotropy"), 0.6, 3 * error_of(t, "anisotropy"));
    assert_true(error_of(t, "anisotropy") < 0.1);
    assert_near_abs(fabs(key(t, "anisotropy_direction")), M_PI_2,
                    3 * error_of(t, "anisotropy_direction"));
    assert_true(key(t, "anisotropy_fourth") < 4 * error_of(t, "anisotropy_fourth"));
    t = m.tables.angular_spectrum;
    assert_int_equal(wt_table_n_rows(t), WT_SURFACE_SECTORS);
    size_t within = 0;
    for (size_t k = 0; k < WT_SURFACE_SECTORS; k++) {
        const double c = 1 - 0.6 * cos(2 * cell(t, k, "direction"));
        within += cell(t, k, "density_ratio_low") < c && c < cell(t, k, "density_ratio_high");
    }
    assert_true(within >= WT_SURFACE_SECTORS - 3);
    assert_true(key(t, "p_value") < 1e-6);
    const double alone = key(m.tables.power_spectrum, "anisotropy"),
                 fourth = key(m.tables.power_spectrum, "anisotropy_fourth");
    clear(&m);

    /* profiles with maps do not affect the anisotropy */
    make(&m, (const char *const[]){path, SURFACE "profile-*.gsf"}, 2);
    t = m.tables.power_spectrum;
    assert_near(key(t, "anisotropy"), alone, 1e-12);
    assert_near(key(t, "anisotropy_fourth"), fourth, 1e-12);
    assert_int_equal(wt_table_n_rows(m.tables.angular_spectrum), WT_SURFACE_SECTORS);
    assert_non_null(strstr(wt_table_key(t, "profiles"), "where both have data"));
    assert_true(said(&m, "the spectrum of profiles assumes a surface that is the same in all"));
    clear(&m);

    make(&m, all, COUNT_OF(all));
    assert_null(wt_table_key(m.tables.power_spectrum, "profiles"));
    assert_true(key(m.tables.angular_spectrum, "p_value") > 0.01);
    clear(&m);
    make(&m, (const char *const[]){SURFACE "profile-*.gsf"}, 1);
    assert_int_equal(m.status, WT_OK);
    assert_null(m.tables.angular_spectrum);
    clear(&m);
    unlink(path);
}

/* Crossing grooves only have an anisotropy of order 4. */
static void test_crossing_grooves(void **state)
{
    (void)state;
    static const char path[] = "test_surface_job_crossing.gsf";
    write_turned(path, &behind, true);
    making m = {.job = wt_topography_job_defaults()};
    make(&m, (const char *const[]){path}, 1);
    assert_int_equal(m.status, WT_OK);
    const wt_table *t = m.tables.power_spectrum;
    assert_true(key(t, "anisotropy_fourth") > 4 * error_of(t, "anisotropy_fourth"));
    assert_true(key(t, "anisotropy") < 3 * error_of(t, "anisotropy"));
    clear(&m);
    unlink(path);
}

/* One scan states what it cannot determine. */
static void test_single_scan(void **state)
{
    (void)state;
    making m = {.job = wt_topography_job_defaults()};
    make(&m, all, 1);
    assert_int_equal(m.status, WT_OK);
    assert_true(said(&m, "one scan: the scatter between places of the surface is not known"));
    assert_true(isnan(key(m.tables.power_spectrum, "place_scatter")));
    assert_non_null(
        strstr(wt_table_key(m.tables.power_spectrum, "standard_error_excludes"), "places"));
    clear(&m);
}

/* The scatter of positions is part of the errors of heights and slopes, with half its size, because
 * they follow the root of the density. Numbers without approximation have no numerical error. */
static void test_numerical_errors(void **state)
{
    (void)state;
    making m = {.job = wt_topography_job_defaults()};
    make(&m, all, COUNT_OF(all));
    static const char *const names[] = {"rms_height", "rms_slope", "place_error", "place_scatter"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        wt_estimate e = {(double)NAN, (double)NAN, (double)NAN, NULL};
        assert_true(wt_table_estimate(m.tables.power_spectrum, names[i], &e));
        assert_near(e.numerical_error, 0, 0);
    }
    clear(&m);
}

/* The table is a counter surface with its errors: replicates scatter by them, each point
 * separately. */
static void test_replicates(void **state)
{
    (void)state;
    enum { DRAWS = 400 };
    char path[] = "/tmp/weartrack-surface-XXXXXX";
    const int fd = mkstemp(path);
    FILE *out = fd >= 0 ? fdopen(fd, "w") : NULL;
    assert_non_null(out);
    making m = {.job = wt_topography_job_defaults()};
    make(&m, all, COUNT_OF(all));
    const wt_table *t = m.tables.power_spectrum;
    assert_int_equal(wt_table_set_estimate(m.tables.power_spectrum, "place_error",
                                           (wt_estimate){0.2, 0, 0, "1"}, NULL),
                     WT_OK);
    assert_int_equal(wt_stream_write(out, t, NULL, NULL), WT_OK);
    assert_int_equal(wt_stream_write(out, m.tables.surfaces, NULL, NULL), WT_OK);
    assert_int_equal(fclose(out), 0);
    wt_job work = wt_job_defaults();
    wt_surface surface = {0};
    work.formats = formats;
    assert_int_equal(wt_surface_open(path, NULL, &work, &surface, NULL), WT_OK);
    assert_int_equal(surface.spectrum.n, wt_table_n_rows(t));
    assert_non_null(surface.modes_error);
    assert_near(surface.c0.standard_error, 0.2, 1e-12);
    const size_t points[] = {1, 9};
    for (size_t p = 0; p < COUNT_OF(points); p++) {
        const double q = surface.spectrum.wavenumber[points[p]],
                     error = cell(t, points[p], "modes_error");
        double sum = 0, square = 0;
        for (size_t i = 0; i < DRAWS; i++) {
            wt_roughness *r = NULL;
            double c = 0;
            assert_int_equal(flow_surface_draw(&surface, 1, 7, i, &r, NULL), WT_OK);
            r->law->density(r, &q, 1, &c);
            const double z = log(c / surface.spectrum.density[points[p]]) / error;
            sum += z;
            square += z * z;
            wt_roughness_free(r);
        }
        assert_near_abs(sum / DRAWS, 0, 0.2);
        assert_near(square / DRAWS, 1, 0.3);
    }
    wt_surface_clear(&surface);
    clear(&m);
    unlink(path);
}

/* A window correlates neighbouring points, which are drawn together as stated, and with no
 * others. */
static void test_correlated_points(void **state)
{
    (void)state;
    enum { DRAWS = 4000, POINTS = 4 };
    double q[POINTS] = {1e5, 1e6, 1e7, 1e8}, density[POINTS] = {1e-24, 1e-27, 1e-31, 1e-34},
           error[POINTS] = {0.1, 0.2, 0.3, 0.1}, tie[POINTS] = {0.5, 0.3, 0},
           found[POINTS][POINTS] = {{0}};
    wt_surface surface = {
        .q0 = (double)NAN,
        .q1 = (double)NAN,
        .c0 = {1, 0, 0, "1"},
        .spectrum = {.kind = WT_SPECTRUM_2D, .n = POINTS, .wavenumber = q, .density = density},
        .modes_error = error,
        .modes_correlation = tie};
    for (size_t draw = 0; draw < DRAWS; draw++) {
        double c[POINTS], z[POINTS];
        wt_roughness *r = NULL;
        assert_int_equal(flow_surface_draw(&surface, 1, 7, draw, &r, NULL), WT_OK);
        r->law->density(r, q, POINTS, c);
        wt_roughness_free(r);
        for (size_t k = 0; k < POINTS; k++)
            z[k] = log(c[k] / density[k]) / error[k];
        for (size_t k = 0; k < POINTS; k++)
            for (size_t l = 0; l <= k; l++)
                found[k][l] += z[k] * z[l] / DRAWS;
    }
    for (size_t k = 0; k < POINTS; k++)
        for (size_t l = 0; l <= k; l++)
            assert_near_abs(found[k][l], k == l ? 1 : k == l + 1 ? tie[l] : 0, 0.06);
}

/* Positions of three scan sizes are drawn separately: a part of the spectrum from one size has its
 * own error, and a bin between has both. */
static void test_places_of_sizes(void **state)
{
    (void)state;
    enum { DRAWS = 2000, POINTS = 4, SIZES = 3 };
    double q[POINTS] = {1e5, 1e6, 1e7, 1e8}, density[POINTS] = {1e-24, 1e-27, 1e-31, 1e-34},
           none[POINTS] = {0}, product[POINTS] = {0}, square[POINTS] = {0}, between = 0,
           parts[SIZES * POINTS] = {0.5, 0.4, 0, 0, 0, 0.3, 2, 0, 0, 0, 0, 1};
    wt_surface surface = {
        .q0 = (double)NAN,
        .q1 = (double)NAN,
        .c0 = {1, 0.2, 0, "1"},
        .spectrum = {.kind = WT_SPECTRUM_2D, .n = POINTS, .wavenumber = q, .density = density},
        .modes_error = none,
        .n_sizes = SIZES,
        .position_errors = parts};
    for (size_t i = 0; i < DRAWS; i++) {
        double c[POINTS], ln[POINTS];
        wt_roughness *r = NULL;
        const double factor =
            flow_draw_positive(surface.c0, 7, i, FLOW_DRAW_DENSITY); /* as a contact has it */
        assert_int_equal(flow_surface_draw(&surface, factor, 7, i, &r, NULL), WT_OK);
        r->law->density(r, q, POINTS, c);
        wt_roughness_free(r);
        for (size_t k = 0; k < POINTS; k++) {
            ln[k] = log(c[k] / density[k]);
            square[k] += ln[k] * ln[k] / DRAWS;
            product[k] += ln[0] * ln[k] / DRAWS;
        }
        between += ln[2] * ln[3] / DRAWS;
        assert_near_abs(ln[0], 0.5 * log(factor), 1e-9);
        assert_near_abs(ln[1], 0.4 * log(factor) + 0.15 * ln[2], 1e-9);
    }
    assert_near(sqrt(square[0]), 0.1, 0.06);
    assert_near(sqrt(square[1]), 0.1, 0.06);
    assert_near(sqrt(square[2]), 0.4, 0.06);
    assert_near(sqrt(square[3]), 0.2, 0.06);
    assert_near_abs(product[2] / sqrt(square[0] * square[2]), 0, 0.08);
    assert_near_abs(product[3] / sqrt(square[0] * square[3]), 0, 0.08);
    assert_near_abs(between / sqrt(square[2] * square[3]), 0, 0.08);
    surface.c0.standard_error = 0; /* held */
    wt_roughness *r = NULL;
    double c = 0;
    assert_int_equal(flow_surface_draw(&surface, 1, 7, 3, &r, NULL), WT_OK);
    r->law->density(r, &q[2], 1, &c);
    assert_near(c, density[2], 1e-12);
    wt_roughness_free(r);
}

/* A copy with scaled heights, and sides ten times as small if `near`. */
static void write_changed(const char *from, float factor, bool near, const char *to)
{
    enum { VALUES = 112 * 112 }; /* after the header */
    static const char *const sides[] = {"XReal = 8.75e-0", "YReal = 8.75e-0"};
    static char bytes[1 << 16];
    FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
    assert_true(in != NULL && out != NULL);
    const size_t n = fread(bytes, 1, sizeof bytes, in), head = n - VALUES * sizeof(float);
    for (size_t i = 0; i < VALUES; i++) {
        float value;
        memcpy(&value, bytes + head + i * sizeof value, sizeof value);
        value *= factor;
        memcpy(bytes + head + i * sizeof value, &value, sizeof value);
    }
    for (size_t i = 0; near && i < COUNT_OF(sides); i++) {
        char *side = memmem(bytes, head, sides[i], strlen(sides[i]));
        assert_non_null(side);
        side[strlen(sides[i])]++;
    }
    assert_int_equal(fwrite(bytes, 1, n, out), n);
    assert_int_equal(fclose(in), 0);
    assert_int_equal(fclose(out), 0);
}

/* Effect of the positions of a size, counted from 1, on a row of the spectrum. */
static double place_error_of(const wt_table *t, double size, double row)
{
    for (size_t i = 0; i < wt_table_n_rows(t); i++)
        if (cell(t, i, "size") == size && cell(t, i, "row") == row)
            return cell(t, i, "places_error");
    return 0;
}

/* Two positions that differ by four in C, a narrow scan elsewhere and a narrower one: each part of
 * the spectrum has the error of its own positions. The numbers include that two positions hardly
 * determine their scatter. */
static void test_scatter_of_places(void **state)
{
    (void)state;
    char path[] = "/tmp/weartrack-place-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && close(fd) == 0);
    char narrowest[] = "/tmp/weartrack-place-XXXXXX";
    const int other = mkstemp(narrowest);
    assert_true(other >= 0 && close(other) == 0);
    write_changed(SURFACE "place-1.gsf", 2, false, path);
    write_changed(SURFACE "near-by.gsf", 0.02F, true, narrowest);
    const char *const files[] = {narrowest, SURFACE "near-by.gsf", SURFACE "place-1.gsf", path};
    const double t_of_one = 12.7062 / 1.95996, scatter = log(4) / sqrt(2);
    making m = {.job = wt_topography_job_defaults()};
    make(&m, files + 2, 2);
    assert_int_equal(m.status, WT_OK);
    const wt_table *t = m.tables.power_spectrum;
    assert_near(key(t, "place_error"), t_of_one * scatter / sqrt(2), 0.05);
    assert_true(error_of(t, "rms_height") / key(t, "rms_height") > key(t, "place_error") / 2);
    assert_null(m.tables.place_errors);
    clear(&m);
    make(&m, files, COUNT_OF(files));
    assert_int_equal(m.status, WT_OK);
    t = m.tables.place_errors;
    assert_non_null(t);
    const double last = (double)wt_table_n_rows(m.tables.power_spectrum),
                 wide = place_error_of(t, 1, 1), narrowest_error = place_error_of(t, 3, last);
    assert_near(narrowest_error, wide * sqrt(2), 1e-6); /* one scan, and two */
    assert_near(place_error_of(t, 2, floor(last / 2)), narrowest_error, 1e-6);
    for (double size = 1; size <= 4; size++) {
        assert_true(size == 1 || place_error_of(t, size, 1) == 0);
        assert_true(size == 3 || place_error_of(t, size, last) == 0);
    }
    clear(&m);
    unlink(path);
    unlink(narrowest);
}

/* Change of a number if each density of the spectrum moves by ln C of `moves`. */
static double change_by(const wt_table *t, const double *moves,
                        double (*number)(const wt_roughness *))
{
    enum { MOST = 100 };
    double q[MOST], c[MOST], values[2];
    const size_t n = wt_table_n_rows(t);
    assert_true(n <= MOST);
    for (int moved = 0; moved < 2; moved++) {
        wt_roughness *r = NULL;
        for (size_t i = 0; i < n; i++) {
            q[i] = cell(t, i, "wavenumber");
            c[i] = cell(t, i, "density") * (moved == 1 ? exp(moves[i]) : 1);
        }
        assert_int_equal(wt_roughness_table(q, c, n, &r, NULL), WT_OK);
        values[moved] = number(r);
        wt_roughness_free(r);
    }
    return values[1] - values[0];
}

/* Errors of rms height and slope from the row errors of the tables: the law, the positions of
 * each size together, or of all, and every bin separately. The correlation by a window reduces
 * the last. */
static void check_errors(const wt_topography_tables *tables)
{
    enum { MOST = 100 };
    static const struct {
        const char *name;
        double (*number)(const wt_roughness *);
    } numbers[] = {{"rms_height", wt_roughness_rms_height}, {"rms_slope", wt_roughness_rms_slope}};
    const wt_table *const t = tables->power_spectrum, *const places = tables->place_errors;
    const size_t n = wt_table_n_rows(t);
    for (size_t k = 0; k < COUNT_OF(numbers); k++) {
        double square = 0, modes = 0, law[MOST] = {0};
        for (size_t i = 0; i < n; i++) {
            double one[MOST] = {0};
            one[i] = cell(t, i, "modes_error");
            law[i] = isnan(cell(t, i, "law_error")) ? 0 : cell(t, i, "law_error");
            modes += isnan(one[i]) ? 0 : pow(change_by(t, one, numbers[k].number), 2);
        }
        square += pow(change_by(t, law, numbers[k].number), 2);
        for (double size = 1; places != NULL && size <= 4; size++) {
            double of[MOST] = {0};
            for (size_t i = 0; i < n; i++)
                of[i] = place_error_of(places, size, (double)i + 1);
            square += pow(change_by(t, of, numbers[k].number), 2);
        }
        if (places == NULL && key(t, "place_error") > 0)
            square += pow(key(t, numbers[k].name) * key(t, "place_error") / 2, 2);
        const double tied = pow(error_of(t, numbers[k].name), 2) - square;
        assert_true(tied > 1.1 * modes && tied < 2 * modes);
    }
}

/* One position, two that differ, more of other sizes, and the extrapolation by the law. */
static void test_errors_of_numbers(void **state)
{
    (void)state;
    char twice[] = "/tmp/weartrack-place-XXXXXX", narrowest[] = "/tmp/weartrack-place-XXXXXX";
    assert_int_equal(close(mkstemp(twice)), 0);
    assert_int_equal(close(mkstemp(narrowest)), 0);
    write_changed(SURFACE "place-1.gsf", 2, false, twice);
    write_changed(SURFACE "near-by.gsf", 0.02F, true, narrowest);
    const char *const files[] = {SURFACE "place-1.gsf", twice, SURFACE "near-by.gsf", narrowest};
    for (size_t n = 1; n <= COUNT_OF(files); n++)
        for (int beyond = 0; beyond < 2; beyond++) {
            making m = {.job = wt_topography_job_defaults()};
            m.job.end = beyond == 1 ? 5e8 : (double)NAN;
            make(&m, files, n);
            assert_int_equal(m.status, WT_OK);
            check_errors(&m.tables);
            assert_true(said(&m, "shorter than 1 nm") == false);
            clear(&m);
        }
    /* limits between bins, at a bin, and outside the roughness */
    making m = {.job = wt_topography_job_defaults()};
    make(&m, files, 1);
    const double first = cell(m.tables.power_spectrum, 0, "wavenumber"),
                 second = cell(m.tables.power_spectrum, 1, "wavenumber");
    clear(&m);
    m.job.end = sqrt(first * second);
    make(&m, files, 1);
    assert_int_equal(wt_table_n_rows(m.tables.power_spectrum), 2);
    assert_string_equal(text_cell(m.tables.power_spectrum, 1, "source"), "cut");
    clear(&m);
    m.job.end = second;
    make(&m, files, 1);
    assert_int_equal(wt_table_n_rows(m.tables.power_spectrum), 2);
    assert_string_equal(text_cell(m.tables.power_spectrum, 1, "source"), "measured");
    clear(&m);
    m.job.end = 1e10;
    make(&m, files, 1);
    assert_true(said(&m, "shorter than 1 nm"));
    clear(&m);
    unlink(twice);
    unlink(narrowest);
}

/* All profiles of the surface one after the other. */
static void write_long_profile(const char *to)
{
    enum { EACH = 250, PROFILES = 8 };
    static const char head[] = "Gwyddion Simple Field 1.0\nXRes = 2000\nYRes = 1\n"
                               "XReal = 0.0015625\nYReal = 7.8125e-07\nXYUnits = m\nZUnits = m\n";
    static const char fill[4] = {0};
    FILE *out = fopen(to, "wb");
    assert_non_null(out);
    fputs(head, out);
    assert_int_equal(fwrite(fill, 1, 4 - strlen(head) % 4, out), 4 - strlen(head) % 4);
    for (int i = 1; i <= PROFILES; i++) {
        char name[256], bytes[4096];
        (void)snprintf(name, sizeof name, SURFACE "profile-%d.gsf", i);
        FILE *in = fopen(name, "rb");
        assert_non_null(in);
        const size_t n = fread(bytes, 1, sizeof bytes, in), data = EACH * sizeof(float);
        assert_true(n > data && n < sizeof bytes);
        assert_int_equal(fwrite(bytes + n - data, 1, data, out), data);
        assert_int_equal(fclose(in), 0);
    }
    assert_int_equal(fclose(out), 0);
}

/* Profiles with height maps: of the same surface; of one with three times its roughness, which does
 * not count as scatter of positions; of other waves; and with positions that differ. */
static void test_profiles_with_maps(void **state)
{
    (void)state;
    char low[] = "/tmp/weartrack-place-XXXXXX", twice[] = "/tmp/weartrack-place-XXXXXX";
    assert_int_equal(close(mkstemp(low)), 0);
    assert_int_equal(close(mkstemp(twice)), 0);
    write_changed(SURFACE "place-1.gsf", 1.0F / 3, false, low);
    write_changed(SURFACE "place-1.gsf", 2, false, twice);
    static const char format[] = "where both have data, C by them is %lf (95 %%: %lf to %lf) "
                                 "of that";
    const struct {
        const char *maps[2];
        double low, high; /* of the ratio */
        bool disagree;
    } cases[] = {{{SURFACE "place-1.gsf"}, 0.8, 1.3, false},
                 {{SURFACE "place-1.gsf", SURFACE "place-2.gsf"}, 0.8, 1.3, false},
                 {{low}, 7, 12, true},
                 {{SURFACE "place-1.gsf", twice}, 0.3, 0.8, false}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        making m = {.job = wt_topography_job_defaults()};
        const char *files[3] = {SURFACE "profile-*.gsf", cases[i].maps[0], cases[i].maps[1]};
        double ratio[3];
        make(&m, files, files[2] != NULL ? 3 : 2);
        assert_int_equal(m.status, WT_OK);
        const char *const words = wt_table_key(m.tables.power_spectrum, "profiles");
        assert_int_equal(sscanf(words, format, &ratio[0], &ratio[1], &ratio[2]), 3);
        assert_true(ratio[0] > cases[i].low && ratio[0] < cases[i].high);
        assert_true(cases[i].disagree == (ratio[1] > 1 || ratio[2] < 1));
        assert_true(cases[i].disagree == (strstr(words, "they disagree") != NULL));
        assert_true(cases[i].disagree == said(&m, "the profiles and the height maps disagree"));
        if (i == 3) /* two positions that differ by four, without other information */
            assert_true(ratio[2] / ratio[1] > exp(0.9 * 12.7 * log(4)));
        clear(&m);
    }
    making m = {.job = wt_topography_job_defaults()};
    make(&m, (const char *const[]){SURFACE "near-by.gsf", SURFACE "profile-*.gsf"}, 2);
    assert_string_equal(wt_table_key(m.tables.power_spectrum, "profiles"),
                        "they alone tell waves of 3.96 µm to 19.6 µm; they share no waves with "
                        "the height maps");
    clear(&m);
    make(&m, (const char *const[]){SURFACE "road.gsf", SURFACE "profile-*.gsf"}, 2);
    assert_string_equal(wt_table_key(m.tables.power_spectrum, "profiles"),
                        "they alone tell waves of 3.96 µm to 19.6 µm; they share no waves with "
                        "the height maps");
    clear(&m);
    /* one position each: the scatter is unknown, whatever their difference */
    write_long_profile(twice);
    make(&m, (const char *const[]){low, twice}, 2);
    assert_int_equal(m.status, WT_OK);
    assert_non_null(
        strstr(wt_table_key(m.tables.power_spectrum, "profiles"), "agreement is inconclusive"));
    assert_null(strstr(wt_table_key(m.tables.power_spectrum, "profiles"), "disagree"));
    assert_false(said(&m, "the profiles and the height maps disagree"));
    clear(&m);
    unlink(low);
    unlink(twice);
}

/* Rows of positions without a row of the spectrum, or without a size, are errors. */
static void test_bad_places(void **state)
{
    (void)state;
    char path[] = "/tmp/weartrack-places-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && close(fd) == 0);
    making m = {.job = wt_topography_job_defaults()};
    wt_job work = wt_job_defaults();
    work.formats = formats;
    write_changed(SURFACE "place-1.gsf", 2, false, path);
    make(&m, (const char *const[]){SURFACE "place-1.gsf", path, SURFACE "near-by.gsf"}, 3);
    assert_non_null(m.tables.place_errors);
    static const struct {
        const char *column;
        double value;
    } bad[] = {{"size", 0},
               {"size", 1e300},
               {"size", (double)NAN},
               {"row", 0},
               {"row", 1000},
               {"row", (double)NAN},
               {"places_error", -1},
               {"places_error", (double)INFINITY},
               {"row", 1}};
    const size_t last = wt_table_n_rows(m.tables.place_errors) - 1;
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        wt_surface surface = {0};
        wt_error err = WT_ERROR_INIT;
        const long column = wt_table_find(m.tables.place_errors, bad[i].column);
        assert_true(column >= 0);
        const double was = wt_table_number(m.tables.place_errors, last, (size_t)column);
        wt_table_set_number(m.tables.place_errors, (size_t)column, bad[i].value);
        FILE *out = fopen(path, "w");
        assert_non_null(out);
        assert_int_equal(wt_stream_write(out, m.tables.power_spectrum, NULL, NULL), WT_OK);
        assert_int_equal(wt_stream_write(out, m.tables.place_errors, NULL, NULL), WT_OK);
        assert_int_equal(fclose(out), 0);
        wt_table_set_number(m.tables.place_errors, (size_t)column, was);
        const bool good = i + 1 == COUNT_OF(bad);
        assert_int_equal(wt_surface_open(path, NULL, &work, &surface, &err),
                         good ? WT_OK : WT_E_RANGE);
        if (good) {
            assert_int_equal(surface.n_sizes, 2);
            assert_near(surface.position_errors[0] * surface.c0.standard_error,
                        place_error_of(m.tables.place_errors, 1, 1), 1e-6);
        }
        wt_surface_clear(&surface);
    }
    clear(&m);
    unlink(path);
}

/* A height map may replace a spectrum, with the result of its own spectrum; several maps include
 * the error of the positions. */
static void test_map_as_roughness(void **state)
{
    (void)state;
    making m = {.job = wt_topography_job_defaults()};
    wt_job work = wt_job_defaults();
    wt_surface surface = {0};
    wt_error err = WT_ERROR_INIT;
    work.formats = formats;
    make(&m, (const char *const[]){SURFACE "place-1.gsf"}, 1);
    const wt_table *t = m.tables.power_spectrum;
    assert_int_equal(wt_surface_open(SURFACE "place-1.gsf", NULL, &work, &surface, NULL), WT_OK);
    assert_int_equal(surface.spectrum.n, wt_table_n_rows(t));
    assert_non_null(surface.modes_error);
    for (size_t i = 0; i < surface.spectrum.n; i++) {
        assert_near(surface.spectrum.density[i], cell(t, i, "density"), 0);
        assert_near(surface.modes_error[i], cell(t, i, "modes_error"), 0);
    }
    assert_near_abs(surface.c0.standard_error, 0, 0);
    wt_surface_clear(&surface);
    clear(&m);
    make(&m, all + 1, 2);
    assert_int_equal(wt_surface_open(SURFACE "place-*.gsf", NULL, &work, &surface, NULL), WT_OK);
    assert_near(surface.spectrum.density[3], cell(m.tables.power_spectrum, 3, "density"), 0);
    wt_surface_clear(&surface);
    clear(&m);
    assert_int_equal(wt_surface_open(SURFACE "none.gsf", NULL, &work, &surface, &err),
                     WT_E_NOT_FOUND);
}

typedef struct friction_of_case {
    wt_estimate friction;
    double first, last; /* wavenumbers of its roughness */
    size_t n_surfaces;  /* that were measured */
} friction_of_case;

static friction_of_case run_case(const char *roughness)
{
    char path[] = "/tmp/weartrack-case-XXXXXX";
    const int fd = mkstemp(path);
    FILE *out = fd >= 0 ? fdopen(fd, "w") : NULL;
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t n_failed = 0;
    friction_of_case got = {.n_surfaces = 0};
    assert_non_null(out);
    fprintf(out,
            "<case version='1'><dma><files>" WT_SOURCE_DIR "/fixtures/case/dma.txt</files></dma>"
            "<roughness>%s</roughness><sliding><pressure>0.4MPa</pressure>"
            "<velocity>0.3m/s</velocity><temperature>30degC</temperature></sliding></case>",
            roughness);
    assert_int_equal(fclose(out), 0);
    if (wt_case_read(path, &c, &err) != WT_OK ||
        wt_run_case(c, NULL, NULL, &result, &n_failed, &err) != WT_OK)
        fail_msg("%s %s: %s", roughness, err.place, err.message);
    const wt_table *t = wt_result_find(result, "roughness");
    got.friction = key_estimate(wt_result_find(result, "friction"), "hysteresis_at_reference");
    got.first = cell(t, 0, "wavenumber");
    got.last = cell(t, wt_table_n_rows(t) - 1, "wavenumber");
    got.n_surfaces = wt_result_find(result, "surfaces") != NULL
                         ? wt_table_n_rows(wt_result_find(result, "surfaces"))
                         : 0;
    wt_result_free(result);
    wt_case_free(c);
    unlink(path);
    return got;
}

/* Contribution of the map to the error of friction: the law over the same waves is within a factor
 * of three of it. */
static double error_of_surface(const friction_of_case *map)
{
    char law[256];
    /* the first wave of a scan is shorter than the roll-off */
    snprintf(law, sizeof law,
             "<self-affine><q0>%.17grad/m</q0><q1>%.17grad/m</q1><hurst>0.8</hurst>"
             "<c0>%.17gm^4</c0></self-affine>",
             map->first, map->last, 2e-17 * pow(map->first / 4e3, -2 * (1 + 0.8)));
    const friction_of_case exact = run_case(law);
    const double error = sqrt(map->friction.standard_error * map->friction.standard_error -
                              exact.friction.standard_error * exact.friction.standard_error);
    assert_near_abs(map->friction.value, exact.friction.value, 3 * error);
    assert_int_equal(exact.n_surfaces, 0);
    return error;
}

/* From a measured map to friction with the error of the surface. */
static void test_map_in_a_case(void **state)
{
    (void)state;
    const friction_of_case map = run_case("<files>" SURFACE "road.gsf</files>");
    const double of_surface = error_of_surface(&map);
    assert_true(of_surface > 0.01 * map.friction.value);
    assert_true(of_surface < 0.1 * map.friction.value);
    assert_int_equal(map.n_surfaces, 1);
    const friction_of_case cut = run_case("<end>3e4rad/m</end><files>" SURFACE "road.gsf</files>");
    assert_near(cut.last, 3e4, 1e-9);
    const friction_of_case beyond =
        run_case("<end>1e6rad/m</end><files>" SURFACE "road.gsf</files>");
    assert_near(beyond.last, 1e6, 1e-9);
    /* a decade and a half beyond the map the exponent of the law has the largest error */
    assert_true(error_of_surface(&beyond) > 3 * of_surface);
}

/* Files without a height map fail; the others continue. */
static void test_failures(void **state)
{
    (void)state;
    char path[] = "/tmp/weartrack-surface-XXXXXX";
    const int fd = mkstemp(path);
    const char words[] = "Gwyddion Simple Field 1.0\nXRes = 4\nYRes = 4\nXReal = 1\nYReal = 1\n"
                         "ZUnits = V\n\0\0\0";
    assert_true(fd >= 0);
    assert_true(write(fd, words, sizeof words) == (ssize_t)sizeof words);
    close(fd);
    making m = {.job = wt_topography_job_defaults()};
    make(&m, (const char *const[]){path}, 1);
    assert_int_equal(m.status, WT_E_CORRUPT);
    clear(&m);
    m.job.image = "backward";
    make(&m, all, 1);
    assert_int_equal(m.status, WT_E_NOT_FOUND);
    assert_non_null(strstr(m.err.message, "no image of heights called backward"));
    clear(&m);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_density_law_and_sums),
        cmocka_unit_test(test_upper_limit),
        cmocka_unit_test(test_heights),
        cmocka_unit_test(test_directions),
        cmocka_unit_test(test_crossing_grooves),
        cmocka_unit_test(test_single_scan),
        cmocka_unit_test(test_numerical_errors),
        cmocka_unit_test(test_replicates),
        cmocka_unit_test(test_correlated_points),
        cmocka_unit_test(test_places_of_sizes),
        cmocka_unit_test(test_scatter_of_places),
        cmocka_unit_test(test_bad_places),
        cmocka_unit_test(test_errors_of_numbers),
        cmocka_unit_test(test_profiles_with_maps),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_map_as_roughness),
        cmocka_unit_test(test_map_in_a_case),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
