/* Conditioning: copies of files, outliers and zeros of records, plausible values, scan lines. Each
 * fault is planted into data with known truth; data without a fault do not change. */
#include "assert_near.h"
#include "core/table/registry.h"

#include "job/conditioning.h"
#include "surface/numerics/surface_analysis.h"

#include <math.h>
#include <string.h>

/* Pseudo-random number in (0, 1): the fractional part of multiples of the golden ratio. */
static double scatter(size_t i)
{
    const double x = 0.6180339887498949 * (double)(i + 1);
    return x - floor(x);
}

static bool log_has(const wt_log *log, const char *text)
{
    for (size_t i = 0; i < wt_log_count(log); i++)
        if (strstr(wt_log_get(log, i).text, text) != NULL)
            return true;
    return false;
}

/* ---- records --------------------------------------------------------------------------------- */

enum { SAMPLES = 400, UNLOADED = 50 };
typedef struct scene {
    double force[SAMPLES], load[SAMPLES];
    wt_record record;
} scene;

/* 10 N of load and 4 N of friction with 5 % of scatter. */
static void make_scene(scene *s)
{
    *s = (scene){.record = {.n = SAMPLES}};
    for (size_t i = 0; i < SAMPLES; i++) {
        s->force[i] = 4 + 0.4 * (scatter(i) - 0.5);
        s->load[i] = 10 + 0.1 * (scatter(7 * i) - 0.5);
    }
    s->record.channel[WT_RECORD_FRICTION_FORCE] = s->force;
    s->record.channel[WT_RECORD_NORMAL_FORCE] = s->load;
}

static void test_sound_record(void **state)
{
    (void)state;
    scene s, same;
    make_scene(&s);
    make_scene(&same);
    s.force[0] = same.force[0] = 12; /* static friction, three times that of sliding */
    wt_log *log = wt_log_new();
    condition_record(&s.record, "file", log);
    assert_memory_equal(s.force, same.force, sizeof s.force);
    assert_memory_equal(s.load, same.load, sizeof s.load);
    assert_int_equal(wt_log_count(log), 0);
    wt_log_free(log);
}

static void test_outliers(void **state)
{
    (void)state;
    static const double values[] = {99, -9999, 1e6, (double)INFINITY};
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        scene s;
        make_scene(&s);
        s.force[123] = values[k];
        wt_log *log = wt_log_new();
        condition_record(&s.record, "file", log);
        for (size_t i = 0; i < SAMPLES; i++)
            assert_int_equal(isnan(s.force[i]), i == 123);
        assert_true(log_has(log, "1 of 400 samples of the friction force"));
        assert_true(log_has(log, "at sample 124"));
        wt_log_free(log);
    }
}

/* Each action is a row with its kind, file, number and reason; a sound record has no table. */
static void test_table_of_actions(void **state)
{
    (void)state;
    scene s;
    wt_log *log = wt_log_new();
    wt_table *table = NULL;
    make_scene(&s);
    condition_record(&s.record, "/data/sound.csv", log);
    assert_int_equal(wt_data_quality_table(log, "/data", &table, NULL), WT_OK);
    assert_null(table);
    s.force[10] = s.force[20] = 1e6;
    condition_record(&s.record, "/data/faulty.csv", log);
    wt_log_add(log, WT_WARNING, "other", NULL, "no action on data");
    assert_int_equal(wt_data_quality_table(log, "/data", &table, NULL), WT_OK);
    assert_int_equal(wt_table_n_rows(table), 1);
    assert_string_equal(wt_table_text(table, 0, DATA_QUALITY_FILE), "faulty.csv");
    assert_string_equal(wt_table_text(table, 0, DATA_QUALITY_ACTION), "left out");
    assert_near(wt_table_number(table, 0, DATA_QUALITY_VALUES), 2, 0);
    assert_non_null(strstr(wt_table_text(table, 0, DATA_QUALITY_REASON), "as outliers"));
    wt_table_free(table);
    /* a copied log has the action, its number and its count */
    wt_log *copy = wt_log_new();
    wt_log_append(copy, log, "sample");
    assert_int_equal(wt_log_count(copy), 2);
    assert_int_equal(wt_log_get(copy, 0).action, WT_LEFT_OUT);
    assert_int_equal(wt_log_get(copy, 0).n_values, 2);
    assert_true(log_has(copy, "sample: 2 of 400 samples"));
    wt_log_free(copy);
    wt_log_free(log);
}

/* A longer part at another load is not a fault. */
static void test_other_load(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    for (size_t i = 100; i < 110; i++) {
        s.load[i] *= 20;
        s.force[i] *= 20;
    }
    wt_log *log = wt_log_new();
    condition_record(&s.record, "file", log);
    assert_false(isnan(s.force[105]) || isnan(s.load[105]));
    assert_int_equal(wt_log_count(log), 0);
    wt_log_free(log);
}

static void test_unloaded_scatter(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    for (size_t i = SAMPLES - UNLOADED; i < SAMPLES; i++)
        s.load[i] = 2e-3 * (scatter(i) - 0.5);
    condition_record(&s.record, "file", NULL);
    for (size_t i = 0; i < SAMPLES; i++)
        assert_int_equal(s.load[i] > 0, i < SAMPLES - UNLOADED);
}

static void test_zero_before_loading(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    for (size_t i = 0; i < SAMPLES; i++)
        s.force[i] += 0.8;
    for (size_t i = 0; i < UNLOADED; i++) {
        s.load[i] = 0;
        s.force[i] = 0.8 + 1e-3 * (scatter(i) - 0.5);
    }
    wt_log *log = wt_log_new();
    condition_record(&s.record, "file", log);
    double mean = 0;
    for (size_t i = UNLOADED; i < SAMPLES; i++)
        mean += s.force[i] / (SAMPLES - UNLOADED);
    assert_near(mean, 4, 0.01);
    assert_true(log_has(log, "50 samples before loading"));
    wt_log_free(log);
}

/* ---- copies ---------------------------------------------------------------------------------- */

/* Any single bit counts, also of two samples that change alike, and so does the number of
 * samples. */
static void test_hash_of_samples(void **state)
{
    (void)state;
    enum { N = 11 };
    double x[N];
    for (size_t i = 0; i < N; i++)
        x[i] = scatter(i);
    const uint64_t hash = flow_hash_samples(0, x, N);
    assert_true(flow_hash_samples(0, x, N) == hash);
    assert_true(flow_hash_samples(0, x, N - 1) != hash);
    assert_true(flow_hash_samples(1, x, N) != hash);
    for (size_t i = 0; i < N; i++) {
        const double before = x[i];
        x[i] = nextafter(before, 2);
        assert_true(flow_hash_samples(0, x, N) != hash);
        x[i] = before;
        for (size_t k = 0; k < i; k++) {
            x[i] = -x[i];
            x[k] = -x[k];
            assert_true(flow_hash_samples(0, x, N) != hash);
            x[i] = -x[i];
            x[k] = -x[k];
        }
    }
}

/* Three files of 300 curves each: the second contains 100 of the first; the third contains all of
 * the first but is not conditioned. */
static void test_copied_curves(void **state)
{
    (void)state;
    enum { CURVES = 300, COMMON = 100 };
    sample_set seen = {0};
    wt_file_set mend = {.read.conditioning = WT_CONDITIONING_MEND},
                keep = {.read.conditioning = WT_CONDITIONING_KEEP};
    flow_file file[] = {{.name = "a", .set = &mend, .seen = &seen},
                        {.name = "b", .set = &mend, .seen = &seen},
                        {.name = "c", .set = &keep, .seen = &seen}};
    wt_log *log = wt_log_new();
    const wt_job work = {.log = log};
    copied_curves none = {0}, copies = {0};
    for (uint64_t i = 1; i <= CURVES; i++) /* many share their low bits */
        assert_false(flow_is_copied_curve(&file[0], 16 * i, &none));
    for (uint64_t i = 1; i <= CURVES; i++) /* curves of one file */
        assert_false(flow_is_copied_curve(&file[0], 16 * i, &none));
    for (uint64_t i = CURVES - COMMON + 1; i <= 2 * CURVES - COMMON; i++)
        (void)flow_is_copied_curve(&file[1], 16 * i, &copies);
    assert_int_equal(copies.n, COMMON);
    assert_ptr_equal(copies.original, &file[0]);
    for (uint64_t i = 1; i <= CURVES; i++)
        assert_false(flow_is_copied_curve(&file[2], 16 * i, &none));
    assert_false(flow_is_copied_curve(&file[1], 0, &none)); /* 0: unknown */
    flow_log_copies(&file[0], &none, CURVES, &work);
    assert_int_equal(wt_log_count(log), 0);
    flow_log_copies(&file[1], &copies, CURVES, &work);
    assert_false(file[1].is_copy);
    assert_true(log_has(log, "100 of 300 curves have the same samples"));
    assert_int_equal(wt_log_get(log, 0).action, WT_COPIED);
    assert_int_equal(wt_log_get(log, 0).n_values, COMMON);
    assert_int_equal(flow_check_copy(&file[1], 16, &work), WT_END);
    assert_true(file[1].is_copy);
    assert_true(log_has(log, "the same samples as a: a copy"));
    assert_int_equal(flow_check_copy(&file[2], 16, &work), WT_OK);
    sample_set_clear(&seen);
    wt_log_free(log);
}

/* ---- sweeps ---------------------------------------------------------------------------------- */

enum { POINTS = 5 };

/* Adds an isotherm whose storage modulus is `modulus` at 1 rad/s and increases with the
 * frequency. */
static void add_isotherm(wt_sweep *sweep, double temperature, double modulus, const char *sample)
{
    wt_isotherm *const t = wt_sweep_add(sweep, POINTS, 0);
    t->temperature = temperature;
    t->sample = sample != NULL ? wt_strdup(sample) : NULL;
    for (size_t i = 0; i < POINTS; i++) {
        t->angular_frequency[i] = pow(10, (double)i / 2);
        t->storage_modulus[i] = modulus * pow(t->angular_frequency[i], 0.1);
        t->loss_modulus[i] = 0.2 * t->storage_modulus[i];
    }
}

static bool sweep_is_warned(const wt_sweep *sweep, const char *text)
{
    wt_log *log = wt_log_new();
    check_sweep(sweep, log);
    const bool has = text != NULL ? log_has(log, text) : wt_log_count(log) > 0;
    wt_log_free(log);
    return has;
}

static void test_repeated_isotherms(void **state)
{
    (void)state;
    static const struct {
        double ratio, shift;
        const char *sample;
        bool warned;
    } cases[] = {{1.25, 0, NULL, true}, /* another specimen */
                 {1.02, 0, NULL, false},
                 {1.25, 8, NULL, false}, /* another temperature */
                 {1.25, 0, "b", false}}; /* another sample, by its name */
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        wt_sweep sweep = {0};
        add_isotherm(&sweep, 290, 1e7, "a");
        add_isotherm(&sweep, 290 + cases[k].shift, 1e7 * cases[k].ratio,
                     cases[k].sample != NULL ? cases[k].sample : "a");
        assert_int_equal(sweep_is_warned(&sweep, "differ by 25 %"), cases[k].warned);
        assert_int_equal(sweep_is_warned(&sweep, NULL), cases[k].warned);
        wt_sweep_clear(&sweep);
    }
}

/* Sound isotherms cause no action, and none of their bits changes. */
static void test_sound_sweep(void **state)
{
    (void)state;
    wt_sweep sweep = {0}, same = {0};
    for (size_t i = 0; i < 4; i++) {
        add_isotherm(&sweep, 270 + 10 * (double)i, 1e7 / (double)(i + 1), "a");
        add_isotherm(&same, 270 + 10 * (double)i, 1e7 / (double)(i + 1), "a");
    }
    assert_false(sweep_is_warned(&sweep, NULL));
    for (size_t i = 0; i < 4; i++) {
        const wt_isotherm *const a = &sweep.isotherms[i], *const b = &same.isotherms[i];
        assert_int_equal(a->n, POINTS);
        assert_true(memcmp(&a->temperature, &b->temperature, sizeof a->temperature) == 0);
        assert_memory_equal(a->angular_frequency, b->angular_frequency, POINTS * sizeof(double));
        assert_memory_equal(a->storage_modulus, b->storage_modulus, POINTS * sizeof(double));
        assert_memory_equal(a->loss_modulus, b->loss_modulus, POINTS * sizeof(double));
    }
    wt_sweep_clear(&sweep);
    wt_sweep_clear(&same);
}

static void test_plausible_moduli(void **state)
{
    (void)state;
    static const struct {
        double modulus;
        bool warned;
    } cases[] = {{1e-2, true}, {1e5, false}, {3e9, false}, {1e15, true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        wt_sweep sweep = {0};
        add_isotherm(&sweep, 290, cases[k].modulus, NULL);
        assert_int_equal(sweep_is_warned(&sweep, "implausible"), cases[k].warned);
        wt_sweep_clear(&sweep);
    }
    wt_log *log = wt_log_new();
    check_friction_coefficient(0.8, "file", log);
    assert_int_equal(wt_log_count(log), 0);
    check_friction_coefficient(42, "file", log);
    assert_true(log_has(log, "percent"));
    wt_log_free(log);
}

/* ---- scan lines ------------------------------------------------------------------------------ */

enum { SIDE = 64 };

/* Waves in all directions; shorter ones have less height. */
static void surface_create(double z[SIDE * SIDE])
{
    memset(z, 0, SIDE * SIDE * sizeof *z);
    for (size_t k = 0; k < 200; k++) {
        const double angle = 2 * M_PI * scatter(k), phase = 2 * M_PI * scatter(31 * k),
                     q = 2 * M_PI / SIDE * (2 + 0.1 * (double)k), height = pow(q, -1.8);
        for (size_t i = 0; i < SIDE * SIDE; i++)
            z[i] += height *
                    cos(q * (cos(angle) * (double)(i % SIDE) + sin(angle) * (double)(i / SIDE)) +
                        phase);
    }
}

static void test_scan_lines(void **state)
{
    (void)state;
    double sound[SIDE * SIDE], z[SIDE * SIDE], squares = 0;
    surface_create(sound);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        squares += sound[i] * sound[i] / (SIDE * SIDE);
    const double rms = sqrt(squares);

    memcpy(z, sound, sizeof z);
    wt_height_map map = {z, SIDE, SIDE, 1, 1, false};
    scan_line_faults found = surface_scan_lines(z, &map, true);
    assert_int_equal(found.scars, 0);
    assert_true(found.offsets == 0);
    assert_memory_equal(z, sound, sizeof z);
    assert_false(map.levelled);

    /* a scar of two rows is found and replaced */
    for (size_t i = 10; i < 50; i++) {
        z[20 * SIDE + i] += 6 * rms;
        z[21 * SIDE + i] += 5 * rms;
    }
    found = surface_scan_lines(z, &map, true);
    assert_int_equal(found.scars, 2);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_true(fabs(z[i] - sound[i]) < 2 * rms);

    /* offsets are found; with "keep" they change nothing */
    double lifted[SIDE * SIDE];
    for (size_t i = 0; i < SIDE * SIDE; i++)
        lifted[i] = sound[i] + rms * (scatter(17 * (i / SIDE)) - 0.5);
    memcpy(z, lifted, sizeof z);
    found = surface_scan_lines(z, &map, false);
    assert_true(found.offsets > 0.1 * rms && found.offsets < rms);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_near(z[i], lifted[i], 1e-9 * rms);
    found = surface_scan_lines(z, &map, true);
    assert_true(found.offsets > 0 && map.levelled);
    for (size_t j = 0; j < SIDE; j++) {
        double sum = 0;
        for (size_t i = 0; i < SIDE; i++)
            sum += z[j * SIDE + i];
        assert_true(fabs(sum / SIDE) < 1e-9 * rms);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sound_record),       cmocka_unit_test(test_outliers),
        cmocka_unit_test(test_table_of_actions),   cmocka_unit_test(test_other_load),
        cmocka_unit_test(test_unloaded_scatter),   cmocka_unit_test(test_zero_before_loading),
        cmocka_unit_test(test_repeated_isotherms), cmocka_unit_test(test_plausible_moduli),
        cmocka_unit_test(test_scan_lines),         cmocka_unit_test(test_hash_of_samples),
        cmocka_unit_test(test_copied_curves),      cmocka_unit_test(test_sound_sweep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
