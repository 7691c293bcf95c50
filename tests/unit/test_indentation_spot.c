/* A spot of a height image: surfaces written out here, whose roughness, drift and dent are known.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "spot_scene.h"

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

/* What the lever did is in metres too, and no height: it must be asked for by name. */
static void test_images_of_the_lever(void **state)
{
    (void)state;
    static const char *const names[] = {"DeflectionRetrace", "AmplitudeRetrace", "HeightRetrace"};
    static double z[N * N];
    uint64_t seed = 6;
    const surface s = random_surface(&seed);
    wt_job common = wt_job_defaults();
    common.formats = formats;
    make_heights(&s, &whole, &seed, z);
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
        wt_spot_tables tables = {0};
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_spot_compute(&job, before, &common, &tables, &err),
                         is_height ? WT_OK : WT_E_NOT_FOUND);
        assert_true(is_height || strstr(err.message, "no image of heights") != NULL);
        wt_spot_tables_clear(&tables);
        job.image = "Retrace";
        assert_int_equal(wt_spot_compute(&job, before, &common, &tables, &err), WT_OK);
        assert_string_equal(wt_table_key(tables.spot, "image"), names[i]);
        wt_spot_tables_clear(&tables);
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
        assert_int_equal(strncmp(verdict, "inconclusive: ", 14), 0);
        assert_non_null(strstr(verdict, cases[i].why));
        assert_true(i == 2 || isnan(cell(t, 0, "roughness")));
        wt_table_free(t);
    }
    wt_spot_job job = job_of(DEPTH);
    wt_job common = wt_job_defaults();
    wt_spot_tables none = {0};
    common.formats = formats;
    job.image = "backward";
    assert_int_equal(wt_spot_compute(&job, before, &common, &none, NULL), WT_E_NOT_FOUND);
    assert_null(none.spot);
}

/* Every column of one spot: the image after is a fiftieth wider, and the shift there is not that of
 * the place. */
static void test_columns(void **state)
{
    (void)state;
    uint64_t seed = 77;
    const view v = {N, WIDTH, 12 * STEP, -7 * STEP, 0.01};
    surface s = random_surface(&seed);
    wt_spot_job job = job_of(DEPTH);
    job.x = s.x = 0.48e-6;
    job.y = s.y = 0.53e-6;
    job.position_error = 20e-9;
    job.largest_effect = 0.2;
    job.after = after;
    write_image(before, &s, &whole, &seed);
    s.dent = 20e-9;
    write_image(after, &s, &v, &seed);
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
    assert_near(cell(t, 0, "limit"), 0.1, 1e-6); /* of a cone */
    assert_near(cell(t, 0, "shift_x"), v.shift_x + v.strain * job.x, 0.01);
    assert_near(cell(t, 0, "shift_y"), v.shift_y + v.strain * job.y, 0.01);
    assert_near(cell(t, 0, "shift_strain"), v.strain, 0.1);
    /* in whole pixels, of the shift at the middle */
    assert_near(cell(t, 0, "overlap"),
                (1 - fabs(v.shift_x + v.strain * WIDTH / 2) / WIDTH) *
                    (1 - fabs(v.shift_y + v.strain * WIDTH / 2) / WIDTH),
                0.015);
    const char *const numbers[] = {"imprint", "imprint_volume"};
    const double truth[] = {dent_depth(s.dent), dent_volume(s.dent)};
    for (size_t i = 0; i < 2; i++) {
        char name[3][48];
        static const char *const ends[] = {"standard_error", "low", "high"};
        for (size_t k = 0; k < 3; k++)
            snprintf(name[k], sizeof name[k], "%s_%s", numbers[i], ends[k]);
        const double value = cell(t, 0, numbers[i]), error = cell(t, 0, name[0]),
                     reach = cell(t, 0, name[2]) - value;
        assert_near_abs(value, truth[i], 4 * error);
        assert_true(error < 0.1 * truth[i]);
        assert_near(value - cell(t, 0, name[1]), reach, 1e-9);
        assert_near(reach / error, wt_student_quantile(cell(t, 0, "places") - 1), 1e-9);
    }
    /* places side by side of twice the contact radius, some of them next to the dent or outside */
    const double most = floor(WIDTH / (4 * CONTACT)) * floor(WIDTH / (4 * CONTACT));
    assert_true(cell(t, 0, "places") >= 8 && cell(t, 0, "places") < most);
    assert_near(cell(t, 0, "deepest"), dent_depth(s.dent), 0.1);
    assert_true(cell(t, 0, "deepest") >= cell(t, 0, "imprint"));
    assert_near_abs(cell(t, 0, "deepest_x"), job.x, 10e-9);
    assert_near_abs(cell(t, 0, "deepest_y"), job.y, 10e-9);
    assert_string_equal(wt_table_key(t, "image"), "Scan forward: Z-Axis");
    assert_non_null(strstr(wt_table_key(t, "tip"), "35"));
    assert_near(strtod(wt_table_key(t, "largest_effect"), NULL), 0.2, 1e-12);
    assert_int_equal(strncmp(wt_table_key(t, "imprint_verdict"), "yes", 3), 0);
    wt_table_free(t);
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
    const wt_height_map f = {a, N, N, STEP, STEP, false}, g = {b, N, N, STEP, STEP, false};
    spot_shift shift;
    shift = spot_align(&f, &g, WIDTH / 2, WIDTH / 2, radius);
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
    assert_int_equal(wt_spot_compute(&job, before, &common, &tables, NULL), WT_OK);
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
        if (strncmp(verdict, "inconclusive: ", 14) != 0 || strstr(verdict, cases[i].why) == NULL)
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
    assert_int_equal(wt_spot_compute(&job, before, &common, &none, &err), WT_E_RANGE);
    assert_non_null(strstr(err.found, "8.000 \xC2\xB5m") != NULL ? err.found : NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns),
        cmocka_unit_test(test_roughness),
        cmocka_unit_test(test_tilt),
        cmocka_unit_test(test_cannot_say),
        cmocka_unit_test(test_map),
        cmocka_unit_test(test_no_imprint),
        cmocka_unit_test(test_beside),
        cmocka_unit_test(test_shift),
        cmocka_unit_test(test_far_off),
        cmocka_unit_test(test_hole),
        cmocka_unit_test(test_images_of_the_lever),
    };
    return cmocka_run_group_tests_name("spot", tests, begin, end);
}
