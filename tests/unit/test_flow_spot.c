/* A spot of a height image: surfaces written out here, whose roughness, drift and dent are known.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "fit/spot/height_image.h"
#include "weartrack/flow.h"
#include "writers/nid_writer.h"

enum { N = 128, WAVES = 40, DRAWS = 100 };
#define WIDTH 1e-6
#define STEP (WIDTH / (N - 1))
#define T_13 2.160368656461 /* 97.5 % of Student's t of 13 degrees of freedom */
#define DEPTH 70e-9
#define CONTACT (2 / M_PI * 0.7002075382097097 * DEPTH) /* of a cone of 35 degrees: 2/pi tan 35 */

static const char before[] = "test_flow_spot_before.nid", after[] = "test_flow_spot_after.nid";
static wt_formats *formats;

typedef struct surface {
    double amplitude[WAVES], qx[WAVES], qy[WAVES], phase[WAVES];
    int n;
    double tilt_x, tilt_y;
    double x, y, dent;  /* a Gaussian of half the contact radius */
    double noise, rows; /* of a pixel; of a whole line, which scanning adds */
} surface;

/* What is at p lies at p + shift + strain p in the image. */
typedef struct view {
    size_t n;
    double width, shift_x, shift_y, strain;
} view;
static const view whole = {N, WIDTH, 0, 0, 0};

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

/* The waves are products of what the columns and the lines have. */
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

static void make_heights(const surface *s, const view *v, uint64_t *state, double *z)
{
    static double x[N], y[N];
    const size_t n = v->n;
    for (size_t i = 0; i < n; i++) {
        x[i] = ((double)i * v->width / (double)(n - 1) - v->shift_x) / (1 + v->strain);
        y[i] = ((double)i * v->width / (double)(n - 1) - v->shift_y) / (1 + v->strain);
    }
    for (size_t j = 0; j < n; j++) {
        const double row = s->rows * truth_normal(state);
        for (size_t i = 0; i < n; i++) {
            const double r = hypot(x[i] - s->x, y[j] - s->y) / (0.5 * CONTACT);
            z[j * n + i] = s->tilt_x * x[i] + s->tilt_y * y[j] - s->dent * exp(-0.5 * r * r) + row +
                           s->noise * truth_normal(state);
        }
    }
    for (int wave = 0; wave < s->n; wave++)
        add_wave(s, wave, x, y, n, z);
}

static void write_heights(const char *path, const double *z, const view *v)
{
    const size_t n = v->n;
    const nid_writer_channel channel = {1, "Z-Axis", "m", -1e-6, 2e-6, 32, z};
    const nid_writer_group group = {"Scan forward", n,   n,        NULL,     "X*", "m",
                                    "Y*",           "m", v->width, v->width, 1,    &channel};
    nid_writer_file file = nid_writer_defaults();
    file.path = path;
    file.n_groups = 1;
    file.groups = &group;
    assert_int_equal(nid_write(&file), 0);
}

static void write_image(const char *path, const surface *s, const view *v, uint64_t *state)
{
    static double z[N * N];
    make_heights(s, v, state, z);
    write_heights(path, z, v);
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
    wt_spot_tables tables = {0};
    common.formats = formats;
    if (wt_spot_make(job, before, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_null(tables.spot_map);
    return tables.spot;
}

/* A wave that is short beside the contact has amplitude / sqrt(2) on any disc; the tilt is taken
 * off. For a cone the area goes with the square of the depth, so 10 % of it are 5 % of the depth.
 */
static void test_roughness(void **state)
{
    (void)state;
    uint64_t seed = 3;
    surface s = {
        .n = 1, .tilt_x = 0.1, .tilt_y = -0.05, .qx = {2 * M_PI / 24e-9}, .qy = {2 * M_PI / 40e-9}};
    const struct {
        double rms;
        const char *verdict;
    } cases[] = {{1e-9, "smooth enough: "}, {7e-9, "too rough: "}};
    for (size_t i = 0; i < 2; i++) {
        wt_spot_job job = job_of(DEPTH);
        s.amplitude[0] = cases[i].rms * M_SQRT2;
        write_image(before, &s, &whole, &seed);
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

/* The slope of a plane, and what noise leaves of it. */
static void test_tilt(void **state)
{
    (void)state;
    uint64_t seed = 5;
    const surface s = {.tilt_x = 0.1, .tilt_y = -0.05, .noise = 0.1e-9};
    const wt_spot_job job = job_of(DEPTH);
    write_image(before, &s, &whole, &seed);
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

/* Heights that end beside the contact: within the error of the position nobody knows how rough it
 * is. */
static void test_hole(void **state)
{
    (void)state;
    static double z[N * N];
    uint64_t seed = 9;
    const surface s = random_surface(&seed);
    make_heights(&s, &whole, &seed, z);
    for (size_t i = 0; i < (size_t)N * N; i++)
        z[i] = i % N < N / 2 + 5 ? z[i] : (double)NAN;
    write_field(before, z);
    wt_spot_job job = job_of(DEPTH);
    for (int known = 0; known < 2; known++) {
        job.position_error = known ? 0 : 3 * CONTACT;
        wt_table *t = make(&job);
        const char *verdict = wt_table_key(t, "roughness_verdict");
        if (strstr(verdict, known ? "smooth enough: " : "not measured about each place") == NULL)
            fail_msg("%s", verdict);
        assert_int_equal(isnan(cell(t, 0, "roughness")), !known);
        wt_table_free(t);
    }
}

static void test_cannot_say(void **state)
{
    (void)state;
    uint64_t seed = 4;
    surface s = random_surface(&seed);
    wt_spot_job shallow = job_of(20e-9), edge = job_of(DEPTH), punch = job_of(DEPTH);
    write_image(before, &s, &whole, &seed);
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
        assert_int_equal(strncmp(verdict, "cannot say: ", 12), 0);
        assert_non_null(strstr(verdict, cases[i].why));
        assert_true(i == 2 || isnan(cell(t, 0, "roughness")));
        wt_table_free(t);
    }
    wt_spot_job job = job_of(DEPTH);
    wt_job common = wt_job_defaults();
    wt_spot_tables none = {0};
    common.formats = formats;
    job.image = "backward";
    assert_int_equal(wt_spot_make(&job, before, &common, &none, NULL), WT_E_NOT_FOUND);
    assert_null(none.spot);
}

/* Of a Gaussian of depth d and width s: mean within a, volume within 2 a. */
static double dent_depth(double d)
{
    const double s = 0.5 * CONTACT, a = CONTACT;
    return d * 2 * s * s / (a * a) * (1 - exp(-a * a / (2 * s * s)));
}

static double dent_volume(double d)
{
    const double s = 0.5 * CONTACT, a = 2 * CONTACT;
    return d * 2 * M_PI * s * s * (1 - exp(-a * a / (2 * s * s)));
}

/* One draw of surface, drift between the pixels, noise and place. */
typedef struct scene {
    double dent, rows, strain, tilt;
    size_t n; /* pixels of the image after, of the same size */
} scene;

static wt_table *draw(const scene *c, uint64_t seed, double shift[2])
{
    surface s = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH);
    s.rows = c->rows;
    job.x = s.x = 0.5e-6 + 100e-9 * (uniform(&seed) - 0.5);
    job.y = s.y = 0.5e-6 + 100e-9 * (uniform(&seed) - 0.5);
    job.after = after;
    write_image(before, &s, &whole, &seed);
    const view v = {c->n, WIDTH, (6 * uniform(&seed) - 3) * STEP, (20 * uniform(&seed) - 10) * STEP,
                    c->strain};
    s.dent = c->dent;
    s.tilt_x += c->tilt;
    write_image(after, &s, &v, &seed);
    shift[0] = v.shift_x + v.strain * s.x;
    shift[1] = v.shift_y + v.strain * s.y;
    return make(&job);
}

static bool holds(const wt_table *t, const char *low, const char *high, double truth)
{
    return cell(t, 0, low) <= truth && cell(t, 0, high) >= truth;
}

/* How many of the draws of a scene hold the truth: depth, volume, drift in x and y; in none the
 * change lies elsewhere. */
static void count_draws(const scene *c, uint64_t first, int held[4], int *yes)
{
    int elsewhere = 0;
    double furthest = 0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        double shift[2];
        wt_table *t = draw(c, first + i, shift);
        *yes += strncmp(wt_table_key(t, "imprint_verdict"), "yes", 3) == 0;
        elsewhere += strstr(wt_table_key(t, "imprint_verdict"), "deepest") != NULL;
        held[0] += holds(t, "imprint_low", "imprint_high", dent_depth(c->dent));
        held[1] += holds(t, "imprint_volume_low", "imprint_volume_high", dent_volume(c->dent));
        const double off[2] = {cell(t, 0, "shift_x") - shift[0], cell(t, 0, "shift_y") - shift[1]};
        held[2] += fabs(off[0]) <= T_13 * cell(t, 0, "shift_x_standard_error");
        held[3] += fabs(off[1]) <= T_13 * cell(t, 0, "shift_y_standard_error");
        furthest = fmax(furthest, hypot(off[0], off[1]) / STEP);
        wt_table_free(t);
    }
    assert_true(furthest < 0.05); /* of a pixel */
    assert_in_range(elsewhere, 0, 0.05 * DRAWS);
}

/* Intervals hold the truth in 92 to 98 % of the draws of all scenes, and no scene stands out. */
static void test_imprint(void **state)
{
    (void)state;
    static const scene scenes[] = {
        {0, 0, 0, 0, N},         {2e-9, 0, 0, 0, N},        {20e-9, 0, 0, 0, N},
        {1e-9, 0.3e-9, 0, 0, N}, {2e-9, 0, 0.01, 0.005, N}, {2e-9, 0.1e-9, 0, 0, 100},
    };
    enum { SCENES = sizeof scenes / sizeof *scenes };
    int all[4] = {0};
    for (size_t k = 0; k < SCENES; k++) {
        int held[4] = {0}, yes = 0;
        count_draws(&scenes[k], 1000 * (k + 1), held, &yes);
        print_message("scene %zu: depth %d, volume %d, drift %d and %d of %d held, yes %d\n", k,
                      held[0], held[1], held[2], held[3], DRAWS, yes);
        for (int i = 0; i < 4; i++) {
            assert_in_range(held[i], 0.88 * DRAWS, DRAWS);
            all[i] += held[i];
        }
        assert_in_range(yes, k == 0 ? 0 : 0.98 * DRAWS, k == 0 ? 0.06 * DRAWS : DRAWS);
    }
    for (int i = 0; i < 4; i++)
        assert_in_range(all[i], 0.92 * SCENES * DRAWS, 0.98 * SCENES * DRAWS);
}

/* Dents beside the place given: on the same lines they make it look higher. Further away than it is
 * looked for, they do not count as untouched places. */
static void test_beside(void **state)
{
    (void)state;
    static const struct {
        double dent, x, y, error; /* in contact radii, but for the dent */
        const char *verdict;
    } cases[] = {
        {5e-9, 1.6, 0, 2, "the change is deepest ("},
        {20e-9, 2, 0, 2, "the change is deepest ("},
        {20e-9, 3, 0, 1, "lower two to four contact radii beside"},
        {20e-9, 0, 4.8, 5, "none is seen within two contact radii: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint64_t seed = 20 + i;
        surface s = random_surface(&seed);
        wt_spot_job job = job_of(DEPTH);
        job.after = after;
        job.x = job.y = WIDTH / 2;
        job.position_error = cases[i].error * CONTACT;
        write_image(before, &s, &whole, &seed);
        s.x = job.x + cases[i].x * CONTACT;
        s.y = job.y + cases[i].y * CONTACT;
        s.dent = cases[i].dent;
        const view v = {N, WIDTH, 1.5 * STEP, 0.5 * STEP, 0};
        write_image(after, &s, &v, &seed);
        wt_table *t = make(&job);
        if (strstr(wt_table_key(t, "imprint_verdict"), cases[i].verdict) == NULL)
            fail_msg("%s is not in: %s", cases[i].verdict, wt_table_key(t, "imprint_verdict"));
        if (i < 2) {
            assert_true(hypot(cell(t, 0, "deepest_x") - s.x, cell(t, 0, "deepest_y") - s.y) <
                        0.3 * CONTACT);
            assert_near(cell(t, 0, "deepest"), dent_depth(s.dent), 0.1);
        }
        assert_true(cell(t, 0, "imprint_standard_error") < 0.2e-9);
        wt_table_free(t);
    }
}

/* The images as they lie in memory, N x N of WIDTH. */
static spot_shift align(const double *a, const double *b, double radius)
{
    const spot_field f = {a, N, N, STEP, STEP}, g = {b, N, N, STEP, STEP};
    spot_shift shift;
    assert_int_equal(spot_align(&f, &g, WIDTH / 2, WIDTH / 2, radius, &shift, NULL), WT_OK);
    return shift;
}

/* What the second image has besides the shift: a tilt, which makes two images differ the less the
 * less of them meets, and a deep dent in the disc that is left out. */
static void test_shift(void **state)
{
    (void)state;
    static double a[N * N], b[N * N];
    static const struct {
        double tilt, dent;
    } cases[] = {{0.005, 0}, {0.3, 0}, {0, 300e-9}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint64_t seed = 40;
        surface s = random_surface(&seed);
        const view v = {N, WIDTH, 4.25 * STEP, -2.5 * STEP, 0};
        make_heights(&s, &whole, &seed, a);
        s.tilt_x += cases[i].tilt;
        s.tilt_y += cases[i].tilt / 2;
        s.x = s.y = WIDTH / 2;
        s.dent = cases[i].dent;
        make_heights(&s, &v, &seed, b);
        const spot_shift shift = align(a, b, 3 * CONTACT);
        assert_true(shift.found);
        assert_int_equal(shift.blocks, 16);
        assert_true(hypot(shift.x - v.shift_x, shift.y - v.shift_y) < 0.05 * STEP);
    }
}

/* Discs far off the image, also further than whole numbers count. */
static void test_far_off(void **state)
{
    (void)state;
    static const double z[4] = {1, 2, 3, 4};
    const spot_field f = {z, 2, 2, STEP, STEP};
    static const double places[] = {-1e15, -1, 1, 1e15, 1e300};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const spot_plane x = spot_plane_fit(&f, places[i], 0, CONTACT),
                         y = spot_plane_fit(&f, 0, places[i], CONTACT);
        assert_int_equal(x.n + x.missing + y.n + y.missing, 0);
        assert_true(isnan(x.rms) && isnan(y.rms));
    }
    assert_int_equal(spot_plane_fit(&f, 0, 0, CONTACT).n, 4);
}

/* The map: a dent of known depth at the place, on a plane. */
static void test_map(void **state)
{
    (void)state;
    uint64_t seed = 7;
    surface s = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH);
    wt_job common = wt_job_defaults();
    wt_spot_tables tables = {0};
    common.formats = formats;
    job.map = true;
    job.after = after;
    job.x = s.x = 64 * STEP;
    job.y = s.y = 60 * STEP;
    write_image(before, &s, &whole, &seed);
    s.dent = 10e-9;
    const view v = {N, WIDTH, 2.5 * STEP, -1.25 * STEP, 0};
    write_image(after, &s, &v, &seed);
    assert_int_equal(wt_spot_make(&job, before, &common, &tables, NULL), WT_OK);
    const wt_table *t = tables.spot_map;
    double deepest = 0, at = 1;
    const size_t n = wt_table_n_rows(t);
    assert_int_equal(n, 39 * 39); /* 5 contact radii are 19.8 pixels */
    for (size_t row = 0; row < n; row++) {
        const double change = cell(t, row, "change");
        assert_true(fabs(cell(t, row, "after") - cell(t, row, "before") - change) < 1e-15);
        if (change < deepest) {
            deepest = change;
            at = hypot(cell(t, row, "x"), cell(t, row, "y"));
        }
    }
    assert_true(at < 1.5 * STEP);
    assert_true(deepest < -9e-9 && deepest > -10.5e-9);
    wt_spot_tables_clear(&tables);
}

/* What hinders telling an imprint is named. */
static void test_no_imprint(void **state)
{
    (void)state;
    uint64_t seed = 6;
    const surface s = random_surface(&seed), other = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH), aside = job, deep = job_of(5 * DEPTH);
    const view away = {N, WIDTH, 0.3e-6, 0, 0}, far = {N, 8 * WIDTH, 0, 0, 0};
    const struct {
        const wt_spot_job *job;
        const surface *s;
        const view *v;
        const char *why;
    } cases[] = {{&job, &other, &whole, "do not agree"},
                 {&aside, &s, &away, "overlap in 70 %"},
                 {&deep, &s, &whole, "0 untouched places"}};
    job.after = aside.after = deep.after = after;
    aside.x = 0.85e-6;
    aside.y = 0.5e-6;
    write_image(before, &s, &whole, &seed);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_image(after, cases[i].s, cases[i].v, &seed);
        wt_table *t = make(cases[i].job);
        const char *verdict = wt_table_key(t, "imprint_verdict");
        if (strncmp(verdict, "cannot say: ", 12) != 0 || strstr(verdict, cases[i].why) == NULL)
            fail_msg("%s is not in: %s", cases[i].why, verdict);
        assert_true(isnan(cell(t, 0, "imprint")));
        wt_table_free(t);
    }
    job.after = before; /* the same image */
    wt_table *t = make(&job);
    assert_non_null(strstr(wt_table_key(t, "imprint_verdict"), "the same heights"));
    wt_table_free(t);
    job.after = after;
    write_image(after, &s, &far, &seed);
    wt_job common = wt_job_defaults();
    common.formats = formats;
    wt_error err = WT_ERROR_INIT;
    wt_spot_tables none = {0};
    assert_int_equal(wt_spot_make(&job, before, &common, &none, &err), WT_E_RANGE);
    assert_non_null(strstr(err.found, "8.000 \xC2\xB5m") != NULL ? err.found : NULL);
}

static int begin(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    wt_formats_free(formats);
    (void)unlink(before);
    (void)unlink(after);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_roughness),  cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_cannot_say), cmocka_unit_test(test_imprint),
        cmocka_unit_test(test_map),        cmocka_unit_test(test_no_imprint),
        cmocka_unit_test(test_beside),     cmocka_unit_test(test_shift),
        cmocka_unit_test(test_far_off),    cmocka_unit_test(test_hole),
    };
    return cmocka_run_group_tests_name("spot", tests, begin, end);
}
