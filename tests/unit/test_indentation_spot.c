/* A position in a height image: surfaces defined here, with known roughness.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "indentation/numerics/height_image.h"
#include "weartrack/indentation.h"
#include "writers/nid_writer.h"

enum { N = 128, WAVES = 40 };
#define WIDTH 1e-6
#define STEP (WIDTH / (N - 1))
#define DEPTH 70e-9
#define CONTACT (2 / M_PI * 0.7002075382097097 * DEPTH) /* of a cone of 35 degrees: 2/pi tan 35 */

static char before[] = "/tmp/weartrack-before-XXXXXX";
static wt_formats *formats;

typedef struct surface {
    double amplitude[WAVES], qx[WAVES], qy[WAVES], phase[WAVES];
    int n;
    double tilt_x, tilt_y;
    double noise; /* of a pixel */
} surface;

static double uniform(uint64_t *state)
{
    return 0.5 * erfc(truth_normal(state) / M_SQRT2);
}

/* Waves of 60 to 400 nm, 1.5 nm rms together. */
static surface random_surface(uint64_t *state)
{
    surface s = {.n = WAVES, .tilt_x = 0.02, .tilt_y = -0.03, .noise = 0.05e-9};
    for (int i = 0; i < WAVES; i++) {
        const double q = 2 * M_PI / (60e-9 * pow(400.0 / 60, uniform(state))),
                     way = 2 * M_PI * uniform(state);
        s.amplitude[i] = 1.5e-9 * sqrt(2.0 / WAVES);
        s.qx[i] = q * cos(way);
        s.qy[i] = q * sin(way);
        s.phase[i] = 2 * M_PI * uniform(state);
    }
    return s;
}

/* The waves are products of column and line factors. */
static void add_wave(const surface *s, int wave, const double *x, const double *y, size_t n,
                     double *z)
{
    static double of_x[2][N], of_y[2][N];
    for (size_t i = 0; i < n; i++) {
        of_x[0][i] = cos(s->qx[wave] * x[i] + s->phase[wave]);
        of_x[1][i] = sin(s->qx[wave] * x[i] + s->phase[wave]);
        of_y[0][i] = s->amplitude[wave] * cos(s->qy[wave] * y[i]);
        of_y[1][i] = s->amplitude[wave] * sin(s->qy[wave] * y[i]);
    }
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++)
            z[j * n + i] += of_x[0][i] * of_y[0][j] - of_x[1][i] * of_y[1][j];
}

static void make_heights(const surface *s, uint64_t *state, double *z)
{
    static double x[N];
    for (size_t i = 0; i < N; i++)
        x[i] = (double)i * STEP;
    for (size_t j = 0; j < N; j++)
        for (size_t i = 0; i < N; i++)
            z[j * N + i] = s->tilt_x * x[i] + s->tilt_y * x[j] + s->noise * truth_normal(state);
    for (int wave = 0; wave < s->n; wave++)
        add_wave(s, wave, x, x, N, z);
}

static void write_image(const surface *s, uint64_t *state)
{
    static double z[N * N];
    make_heights(s, state, z);
    const nid_writer_channel channel = {1, "Z-Axis", "m", -1e-6, 2e-6, 32, z};
    const nid_writer_group group = {"Scan forward", N,   N,     0,     NULL, "X*",    "m",
                                    "Y*",           "m", WIDTH, WIDTH, 1,    &channel};
    nid_writer_file file = nid_writer_defaults();
    file.path = before;
    file.n_groups = 1;
    file.groups = &group;
    assert_int_equal(nid_write(&file), 0);
}

static wt_spot_job job_of(double depth)
{
    wt_spot_job job = wt_spot_job_defaults();
    assert_int_equal(wt_tip_parse("cone:half-angle=35deg", &job.tip, NULL), WT_OK);
    job.depth = depth;
    return job;
}

static wt_table *make(const wt_spot_job *job)
{
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    wt_table *table = NULL;
    common.formats = formats;
    if (wt_spot_compute(job, before, &common, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return table;
}

static int begin(void **state)
{
    (void)state;
    const int file = mkstemp(before);
    if (file < 0 || close(file) != 0)
        return -1;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    wt_formats_free(formats);
    (void)unlink(before);
    return 0;
}

/* A wave shorter than the contact has amplitude / sqrt(2) on any disc; the tilt is subtracted. The
 * area of a cone is proportional to the squared depth, so that 10 % of it are 5 % of the depth. */
static void test_roughness(void **state)
{
    (void)state;
    uint64_t seed = 3;
    surface s = {
        .n = 1, .tilt_x = 0.1, .tilt_y = -0.05, .qx = {2 * M_PI / 24e-9}, .qy = {2 * M_PI / 40e-9}};
    const struct {
        double rms;
        const char *verdict;
    } cases[] = {{1e-9, "yes: "}, {7e-9, "no: "}};
    for (size_t i = 0; i < 2; i++) {
        wt_spot_job job = job_of(DEPTH);
        s.amplitude[0] = cases[i].rms * M_SQRT2;
        write_image(&s, &seed);
        wt_table *t = make(&job);
        assert_near(cell(t, 0, "contact_radius"), CONTACT, 1e-6);
        assert_near(cell(t, 0, "x"), WIDTH / 2, 1e-6);
        assert_near(cell(t, 0, "roughness"), cases[i].rms, 0.05);
        assert_near(cell(t, 0, "roughness_median"), cases[i].rms, 0.05);
        assert_near(cell(t, 0, "ratio"), cases[i].rms / DEPTH, 0.05);
        assert_near(cell(t, 0, "limit"), 0.05, 1e-6);
        assert_int_equal(strncmp(wt_table_key(t, "roughness_verdict"), cases[i].verdict,
                                 strlen(cases[i].verdict)),
                         0);
        wt_table_free(t);
    }
}

/* Slope of a plane, and its error by noise. */
static void test_tilt(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const surface s = {.tilt_x = 0.1, .tilt_y = -0.05, .noise = 0.1e-9};
    const wt_spot_job job = job_of(DEPTH);
    write_image(&s, &seed);
    wt_table *t = make(&job);
    assert_near(cell(t, 0, "tilt"), hypot(0.1, 0.05), 0.01);
    assert_near(cell(t, 0, "roughness_median"), 0.1e-9, 0.05);
    wt_table_free(t);
}

/* Gwyddion Simple Field, which has missing heights. */
static void write_field(const char *path, const double *z)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    const int n = fprintf(file,
                          "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = %g\n"
                          "YReal = %g\nXYUnits = m\nZUnits = m\nTitle = height\n",
                          N, N, WIDTH, WIDTH);
    for (int i = n; i == n || i % 4 != 0; i++)
        (void)fputc(0, file);
    for (size_t i = 0; i < (size_t)N * N; i++) {
        const float value = (float)z[i];
        assert_int_equal(fwrite(&value, sizeof value, 1, file), 1);
    }
    assert_int_equal(fclose(file), 0);
}

/* The image ends beside the contact: the roughness is unknown within the error of the position. */
static void test_hole(void **state)
{
    (void)state;
    static double z[N * N];
    uint64_t seed = 9;
    const surface s = random_surface(&seed);
    make_heights(&s, &seed, z);
    for (size_t i = 0; i < (size_t)N * N; i++)
        z[i] = i % N < N / 2 + 5 ? z[i] : (double)NAN;
    write_field(before, z);
    wt_spot_job job = job_of(DEPTH);
    for (int known = 0; known < 2; known++) {
        job.position_error = known ? 0 : 3 * CONTACT;
        wt_table *t = make(&job);
        const char *verdict = wt_table_key(t, "roughness_verdict");
        if (strstr(verdict, known ? "yes: " : "not measured about each place") == NULL)
            fail_msg("%s", verdict);
        assert_int_equal(isnan(cell(t, 0, "roughness")), !known);
        wt_table_free(t);
    }
}

/* The deflection channel is in metres, too, but no height: it must be requested by name. */
static void test_deflection_images(void **state)
{
    (void)state;
    static const char *const names[] = {"DeflectionRetrace", "AmplitudeRetrace", "HeightRetrace"};
    static double z[N * N];
    uint64_t seed = 6;
    const surface s = random_surface(&seed);
    wt_job common = wt_job_defaults();
    common.formats = formats;
    make_heights(&s, &seed, z);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        FILE *out = fopen(before, "wb");
        assert_non_null(out);
        const int length =
            fprintf(out,
                    "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = %g\nYReal = %g\n"
                    "XYUnits = m\nZUnits = m\nTitle = %s\n",
                    N, N, WIDTH, WIDTH, names[i]);
        for (int k = length % 4; k < 4; k++)
            (void)fputc(0, out);
        for (size_t k = 0; k < (size_t)N * N; k++) {
            const float one = (float)z[k];
            assert_int_equal(fwrite(&one, sizeof one, 1, out), 1);
        }
        assert_int_equal(fclose(out), 0);
        const bool is_height = i == 2;
        wt_spot_job job = job_of(DEPTH);
        wt_table *table = NULL;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_spot_compute(&job, before, &common, &table, &err),
                         is_height ? WT_OK : WT_E_NOT_FOUND);
        assert_true(is_height || strstr(err.message, "no image of heights") != NULL);
        wt_table_free(table);
        table = NULL;
        job.image = "Retrace";
        assert_int_equal(wt_spot_compute(&job, before, &common, &table, &err), WT_OK);
        assert_string_equal(wt_table_key(table, "image"), names[i]);
        wt_table_free(table);
        table = NULL;
    }
}

static void test_inconclusive(void **state)
{
    (void)state;
    uint64_t seed = 4;
    surface s = random_surface(&seed);
    wt_spot_job shallow = job_of(20e-9), edge = job_of(DEPTH), punch = job_of(DEPTH);
    write_image(&s, &seed);
    edge.x = 50e-9;
    assert_int_equal(wt_tip_parse("punch:radius=40nm", &punch.tip, NULL), WT_OK);
    const struct {
        const wt_spot_job *job;
        const char *why;
    } cases[] = {
        {&shallow, "too coarse"}, {&edge, "is not measured about"}, {&punch, "does not grow"}};
    for (size_t i = 0; i < 3; i++) {
        wt_table *t = make(cases[i].job);
        const char *verdict = wt_table_key(t, "roughness_verdict");
        assert_int_equal(strncmp(verdict, "inconclusive: ", 14), 0);
        assert_non_null(strstr(verdict, cases[i].why));
        assert_true(i == 2 || isnan(cell(t, 0, "roughness")));
        wt_table_free(t);
    }
    wt_spot_job job = job_of(DEPTH);
    wt_job common = wt_job_defaults();
    wt_table *none = NULL;
    common.formats = formats;
    job.image = "backward";
    assert_int_equal(wt_spot_compute(&job, before, &common, &none, NULL), WT_E_NOT_FOUND);
    assert_null(none);
}

/* Every column of one position. */
static void test_columns(void **state)
{
    (void)state;
    uint64_t seed = 77;
    const surface s = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH);
    job.x = 0.48e-6;
    job.y = 0.53e-6;
    job.position_error = 20e-9;
    write_image(&s, &seed);
    wt_table *t = make(&job);
    double pixels = 0;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++)
            pixels += hypot(i * STEP - job.x, j * STEP - job.y) <= CONTACT;
    assert_near(cell(t, 0, "x"), job.x, 1e-6);
    assert_near(cell(t, 0, "y"), job.y, 1e-6);
    assert_near(cell(t, 0, "indentation"), DEPTH, 1e-12);
    assert_near_abs(cell(t, 0, "pixels"), pixels, 1);
    const double rms = cell(t, 0, "roughness"), low = cell(t, 0, "roughness_low"),
                 high = cell(t, 0, "roughness_high");
    assert_true(low > 0.2e-9 && low <= rms && rms <= high && high < 2.5e-9 && low < high);
    assert_near(cell(t, 0, "ratio"), rms / DEPTH, 1e-9);
    assert_near(cell(t, 0, "ratio_low"), low / DEPTH, 1e-9);
    assert_near(cell(t, 0, "ratio_high"), high / DEPTH, 1e-9);
    assert_near(cell(t, 0, "limit"), 0.05, 1e-6); /* of a cone */
    assert_string_equal(wt_table_key(t, "image"), "Scan forward: Z-Axis");
    assert_non_null(strstr(wt_table_key(t, "tip"), "35"));
    assert_near(strtod(wt_table_key(t, "largest_effect"), NULL), 0.1, 1e-12);
    wt_table_free(t);
}

/* Discs far outside the image, also beyond the range of integers. */
static void test_disc_outside_image(void **state)
{
    (void)state;
    static const double z[4] = {1, 2, 3, 4};
    const wt_height_map f = {z, 2, 2, STEP, STEP, false};
    static const double places[] = {-1e15, -1, 1, 1e15, 1e300};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const spot_plane x = spot_plane_fit(&f, places[i], 0, CONTACT),
                         y = spot_plane_fit(&f, 0, places[i], CONTACT);
        assert_int_equal(x.n + x.missing + y.n + y.missing, 0);
        assert_true(isnan(x.rms) && isnan(y.rms));
    }
    assert_int_equal(spot_plane_fit(&f, 0, 0, CONTACT).n, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns),
        cmocka_unit_test(test_roughness),
        cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_inconclusive),
        cmocka_unit_test(test_disc_outside_image),
        cmocka_unit_test(test_hole),
        cmocka_unit_test(test_deflection_images),
    };
    return cmocka_run_group_tests_name("spot", tests, begin, end);
}
