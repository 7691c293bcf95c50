/* The job of friction records on files with known truth, and messages for files with missing data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "assert_near.h"
#include "table_cells.h"
#include "truth_fixture.h"

#include "weartrack/record.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define RECORDS WT_SOURCE_DIR "/fixtures/record/"
#define FIXTURES WT_SOURCE_DIR "/fixtures/formats/"

static wt_status make(const wt_record_job *options, const char *const *paths, size_t n, wt_log *log,
                      wt_record_tables *tables, wt_error *err)
{
    wt_file_set set = {.patterns = paths, .n_patterns = n, .read = wt_read_defaults()};
    wt_record_job job = *options;
    wt_job work = wt_job_defaults();
    work.formats = formats;
    work.log = log;
    job.sets = &set;
    job.n_sets = 1;
    return wt_record_compute(&job, &work, tables, err);
}

static wt_record_tables made(const wt_record_job *job, const char *path, wt_log *log)
{
    wt_record_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (make(job, &path, 1, log, &tables, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    return tables;
}

static wt_record_job disc_job(void)
{
    wt_record_job job = wt_record_job_defaults();
    job.load = (wt_estimate){5, 0.05, 0, "N"};
    job.track_radius.value = 12e-3;
    return job;
}

/* 4 N at a load of 5 N after a running-in of 20 laps. */
static void test_disc(void **state)
{
    (void)state;
    const wt_record_job job = disc_job();
    wt_record_tables t = made(&job, RECORDS "disc.csv", NULL);
    assert_null(t.wear);
    assert_int_equal(wt_table_n_rows(t.record), 1);
    assert_int_equal(wt_table_n_rows(t.record_cycles), 79); /* the last one is incomplete */
    assert_string_equal(text_cell(t.record, 0, "averaged_over"), "lap");
    assert_true(number_cell(t.record, 0, "friction_coefficient_low") < 0.8);
    assert_true(number_cell(t.record, 0, "friction_coefficient_high") > 0.8);
    assert_true(number_cell(t.record, 0, "running_in_low") <= 20);
    assert_true(number_cell(t.record, 0, "running_in_high") >= 20);
    const double end = number_cell(t.record, 0, "running_in");
    assert_near(number_cell(t.record, 0, "running_in_time"), 0.6 * end, 0.01);
    assert_near(number_cell(t.record, 0, "running_in_distance"), 2 * M_PI * 0.012 * end, 0.01);
    assert_near(number_cell(t.record, 0, "velocity"), 2 * M_PI * 0.012 / 0.6, 1e-3);
    assert_true(strstr(text_cell(t.record, 0, "note"), "few samples") != NULL);
    for (size_t i = 0; i < 79; i++) {
        const double steady = number_cell(t.record_cycles, i, "steady");
        assert_true((steady > 0) == ((double)i >= number_cell(t.record, 0, "running_in_high")));
    }
    wt_estimate key;
    assert_true(wt_table_estimate(t.record, "friction_coefficient", &key));
    assert_near(key.value, number_cell(t.record, 0, "friction_coefficient"), 1e-12);
    wt_tables_clear(&t, sizeof t);
}

/* Each velocity has a row, and there is no common coefficient. */
static void test_steps(void **state)
{
    (void)state;
    const wt_record_job job = wt_record_job_defaults();
    wt_record_tables t = made(&job, RECORDS "steps.csv", NULL);
    assert_int_equal(wt_table_n_rows(t.record), 4);
    for (size_t i = 0; i < 4; i++) {
        assert_near(number_cell(t.record, i, "velocity"), 0.01 * pow(3, (double)i), 1e-9);
        assert_near(number_cell(t.record, i, "temperature"), 296.15 + 10 * (double)i, 1e-9);
        assert_near(number_cell(t.record, i, "normal_force"), i % 2 ? 10 : 5, 1e-9);
        assert_near(number_cell(t.record, i, "friction_coefficient"), 0.8 * pow(1.15, (double)i),
                    0.05);
        assert_int_equal((int)number_cell(t.record, i, "step"), (int)i + 1);
        assert_int_equal((int)number_cell(t.record, i, "cycles"), 40);
    }
    wt_estimate key;
    assert_false(wt_table_estimate(t.record, "friction_coefficient", &key));
    wt_tables_clear(&t, sizeof t);
}

/* The signs of two directions do not cancel; forces are in grams. */
static void test_two_directions(void **state)
{
    (void)state;
    wt_record_job job = wt_record_job_defaults();
    job.cycle = WT_CYCLE_SAMPLE;
    wt_record_tables t = made(&job, FIXTURES "cetr-viewer/two-directions.csv", NULL);
    assert_int_equal(wt_table_n_rows(t.record), 2);
    assert_near(number_cell(t.record, 0, "friction_coefficient"), 0.301397, 1e-5);
    assert_near(number_cell(t.record, 1, "friction_coefficient"), 0.321357, 1e-5);
    assert_near(number_cell(t.record, 0, "normal_force"), 100.2 * 9.80665e-3, 1e-9);
    assert_true(number_cell(t.record, 0, "difference") < 1e-6);
    wt_tables_clear(&t, sizeof t);
}

/* Mass and area of one run are one measurement of its wear: two equal runs do not scatter, though
 * each is only as accurate as the agreement of its mass and area. */
static void test_wear_of_runs(void **state)
{
    (void)state;
    char again[] = "/tmp/weartrack-run-XXXXXX";
    static char bytes[1 << 20];
    FILE *in = fopen(RECORDS "disc.csv", "rb"), *out = fdopen(mkstemp(again), "wb");
    assert_true(in != NULL && out != NULL);
    const size_t n = fread(bytes, 1, sizeof bytes, in);
    assert_true(n > 2 && n < sizeof bytes && bytes[n - 2] == '6');
    bytes[n - 2] = '7'; /* the last digit; otherwise the same samples would count once */
    assert_true(fwrite(bytes, 1, n, out) == n);
    assert_int_equal(fclose(in), 0);
    assert_int_equal(fclose(out), 0);
    wt_record_job job = disc_job();
    job.load.standard_error = 0;
    job.track_area = (wt_estimate){3e-11, 3e-16, 0, "m^2"};
    job.mass_loss = (wt_estimate){3e-9, 3e-14, 0, "kg"};
    job.density.value = 1150;
    wt_record_tables t = made(&job, RECORDS "disc.csv", NULL);
    const double apart = fabs(number_cell(t.wear, 0, "specific_wear_rate") -
                              number_cell(t.wear, 1, "specific_wear_rate"));
    assert_near(key_estimate(t.wear, "specific_wear_rate").standard_error, apart / 2, 1e-6);
    assert_near(key_estimate(t.wear, "specific_wear_rate_df").value, 1, 0);
    wt_tables_clear(&t, sizeof t);
    wt_error err = WT_ERROR_INIT;
    const char *const both[] = {RECORDS "disc.csv", again};
    if (make(&job, both, 2, NULL, &t, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    assert_int_equal(wt_table_n_rows(t.wear), 4);
    assert_near(key_estimate(t.wear, "specific_wear_rate").standard_error, apart / 2 / sqrt(2),
                1e-6);
    wt_tables_clear(&t, sizeof t);
    unlink(again);
}

/* k = V / (F s) by all methods, and the ball. */
static void test_wear(void **state)
{
    (void)state;
    wt_record_job job = disc_job();
    const double round = 2 * M_PI * 12e-3, distance = round * (79 + 5.0 / 6);
    job.track_area = (wt_estimate){3e-11, 6e-12, 0, "m^2"};
    job.mass_loss = (wt_estimate){3e-9, 3e-10, 0, "kg"};
    job.density.value = 1150;
    job.ball_radius.value = 3e-3;
    job.modulus.value = 20e6;
    wt_record_tables t = made(&job, RECORDS "disc.csv", NULL);
    assert_int_equal(wt_table_n_rows(t.wear), 3);
    const double by_mass = 3e-9 / 1150 / (5 * distance), by_area = 3e-11 * round / (5 * distance);
    assert_near(number_cell(t.wear, 0, "specific_wear_rate"), by_mass, 1e-4);
    assert_near(number_cell(t.wear, 1, "specific_wear_rate"), by_area, 1e-4);
    assert_near(number_cell(t.wear, 1, "specific_wear_rate_standard_error"),
                by_area * hypot(0.2, 0.01), 1e-4);
    assert_near(number_cell(t.wear, 1, "specific_wear_rate_high") /
                    number_cell(t.wear, 1, "specific_wear_rate"),
                exp(1.959963984540054 * hypot(0.2, 0.01)), 1e-6);
    /* 4 um deep by 0.05 um a lap */
    const double h = number_cell(t.wear, 2, "depth");
    assert_near(h, 0.05e-6 * 79, 0.07);
    const double cap = 3e-3 * 3e-3 * acos(1 - h / 3e-3) - (3e-3 - h) * sqrt(h * (6e-3 - h));
    assert_near(number_cell(t.wear, 2, "volume"), cap * round, 1e-9);
    const wt_ball_contact ball = wt_ball_contact_compute(5, 3e-3, 20e6, 0.5);
    assert_near(number_cell(t.wear, 0, "pressure"), ball.pressure, 1e-12);
    assert_near(number_cell(t.wear, 0, "duty"), 3 * ball.contact_radius / (8 * 12e-3), 1e-12);
    wt_tables_clear(&t, sizeof t);
    /* a value stated without an error has none */
    job = disc_job();
    job.load.standard_error = 0;
    job.track_area = (wt_estimate){3e-11, 0, 0, "m^2"};
    t = made(&job, RECORDS "disc.csv", NULL);
    assert_near(number_cell(t.wear, 0, "specific_wear_rate"), by_area, 1e-4);
    assert_true(isnan(number_cell(t.wear, 0, "specific_wear_rate_low")));
    assert_true(isnan(number_cell(t.wear, 0, "volume_standard_error")));
    assert_true(isnan(key_estimate(t.wear, "specific_wear_rate").standard_error));
    wt_tables_clear(&t, sizeof t);
}

/* A parabolic groove of 10 um depth and 0.2 mm width: 2/3 of depth times width, times `size`. */
static void write_groove(const char *folder, const char *name, double size)
{
    char path[64];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("x (mm)\theight (um)\n", out);
    for (int i = 0; i < 400; i++) {
        const double x = i / 200.0, u = (x - 1) / 0.1;
        fprintf(out, "%.9g\t%.9g\n", x, 3 * x - (u * u < 1 ? size * 10 * (1 - u * u) : 0));
    }
    assert_int_equal(fclose(out), 0);
}

/* Wear volume of the track from profiles across it. */
static void test_profiles(void **state)
{
    (void)state;
    static const double area = 2.0 / 3 * 10e-6 * 0.2e-3, round = 2 * M_PI * 12e-3;
    char folder[] = "profiles-XXXXXX", one[64], command[64];
    wt_record_job job = disc_job();
    assert_non_null(mkdtemp(folder));
    write_groove(folder, "one.txt", 0.9);
    (void)snprintf(one, sizeof one, "%s/one.txt", folder);
    job.profile = one;
    wt_record_tables t = made(&job, RECORDS "disc.csv", NULL);
    /* the groove ends between two samples of forty */
    assert_near(number_cell(t.wear, 0, "volume"), 0.9 * area * round, 1e-2);
    wt_tables_clear(&t, sizeof t);
    write_groove(folder, "two.txt", 1.1);
    job.profile = folder;
    t = made(&job, RECORDS "disc.csv", NULL);
    assert_near(number_cell(t.wear, 0, "volume"), area * round, 1e-2);
    assert_near(number_cell(t.wear, 0, "volume_standard_error"), 0.1 * area * round, 1e-2);
    wt_tables_clear(&t, sizeof t);
    (void)snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);

    const char *const disc = RECORDS "disc.csv";
    wt_error err = WT_ERROR_INIT;
    job.track_area = (wt_estimate){1e-9, 0, 0, "m^2"};
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_ARG);
    job.track_area.value = (double)NAN;
    job.profile = WT_SOURCE_DIR "/fixtures/surface/place-1.gsf";
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_ARG);
    assert_non_null(strstr(err.message, "a height map"));
}

/* A disc whose laps are 0.1 m long. */
static void test_length_by_laps(void **state)
{
    (void)state;
    char path[] = "laps-XXXXXX";
    wt_record_job job = disc_job();
    wt_log *log = wt_log_new();
    FILE *out = truth_file(path);
    fputs("time (s)\tdistance (m)\tlaps\tmu\n", out);
    for (int i = 0; i < 400; i++)
        fprintf(out, "%.9g\t%.9g\t%.9g\t%g\n", 0.1 * i, 0.005 * i, 0.05 * i, 0.5 + 0.01 * (i % 7));
    assert_int_equal(fclose(out), 0);
    job.track_radius.value = (double)NAN;
    job.track_area = (wt_estimate){1e-9, 0, 0, "m^2"};
    wt_record_tables t = made(&job, path, log);
    assert_near(number_cell(t.wear, 0, "volume"), 1e-10, 1e-9);
    const size_t n = wt_log_count(log);
    assert_true(n > 0);
    assert_non_null(strstr(wt_log_get(log, n - 1).text, "100 mm long by distance and laps"));
    wt_tables_clear(&t, sizeof t);
    wt_log_free(log);
    assert_int_equal(remove(path), 0);
}

/* Without a radius the velocity is unknown, but different rotations are different conditions; at
 * rest there is no sliding. */
static void test_rotation_alone(void **state)
{
    (void)state;
    char path[] = "rotation-XXXXXX";
    static const double rpm[] = {60, 120, 0};
    wt_record_job job = wt_record_job_defaults();
    FILE *out = truth_file(path);
    fputs("step,time (s),rotational speed (rpm),mu\n", out);
    for (int i = 0; i < 300; i++)
        fprintf(out, "%d,%.9g,%g,%g\n", i / 100, 0.1 * i, rpm[i / 100],
                0.5 + 0.02 * (i / 100) + 0.001 * (i % 7));
    assert_int_equal(fclose(out), 0);
    wt_record_tables t = made(&job, path, NULL);
    wt_estimate key;
    assert_int_equal(wt_table_n_rows(t.record), 3);
    assert_false(wt_table_estimate(t.record, "friction_coefficient", &key));
    assert_near(number_cell(t.record, 1, "rotation"), 4 * M_PI, 1e-12);
    assert_true(isnan(number_cell(t.record, 1, "velocity")));
    assert_non_null(strstr(text_cell(t.record, 1, "note"), "--track-radius"));
    assert_non_null(strstr(text_cell(t.record, 2, "note"), "nothing slides"));
    wt_tables_clear(&t, sizeof t);
    job.track_radius.value = 0.01;
    t = made(&job, path, NULL);
    assert_near(number_cell(t.record, 1, "velocity"), 0.04 * M_PI, 1e-12);
    assert_near(number_cell(t.record, 2, "velocity"), 0, 1e-12);
    wt_tables_clear(&t, sizeof t);
    assert_int_equal(remove(path), 0);
}

/* A disc rests for 60 s after 150 of 400 s; the first 200 s are a running-in. By velocity and by
 * laps: neither the running-in time nor the sliding distance includes the pause. */
static void test_pause(void **state)
{
    (void)state;
    for (int by_laps = 0; by_laps < 2; by_laps++) {
        char path[] = "pause-XXXXXX";
        wt_record_job job = disc_job();
        wt_log *log = wt_log_new();
        FILE *out = truth_file(path);
        fprintf(out, "time (s),%s,mu\n", by_laps ? "laps" : "velocity (mm/s)");
        for (int i = 0, slid = 0; i < 4600; i++) {
            const bool rests = i >= 1500 && i < 2100;
            slid += !rests;
            const double scatter = 0.01 * sin(slid / 10 * 37 % 101);
            fprintf(out, "%.9g,%.9g,%.9g\n", 0.1 * i,
                    by_laps ? 0.1 * slid
                    : rests ? 0
                            : 20,
                    rests ? 0.2 : 0.5 + scatter + (slid < 2000 ? 0.2 : 0));
        }
        assert_int_equal(fclose(out), 0);
        job.track_area = (wt_estimate){1e-10, 1e-11, 0, "m^2"};
        wt_record_tables t = made(&job, path, log);
        assert_int_equal(wt_table_n_rows(t.record), 1);
        assert_near(number_cell(t.record, 0, "pauses"), 1, 1e-12);
        assert_near(number_cell(t.record, 0, "paused_time"), 60, 1e-2);
        assert_near(number_cell(t.record, 0, "running_in_time"), 200, 2e-2);
        assert_near(number_cell(t.wear, 0, "distance"), by_laps ? 400 * 2 * M_PI * 0.012 : 8, 2e-3);
        assert_non_null(strstr(text_cell(t.record, 0, "note"), "1 pause of 60 s left out"));
        bool said = false;
        for (size_t i = 0; i < wt_log_count(log); i++)
            said = said || strstr(wt_log_get(log, i).text, "1 pause of 60 s was left out");
        assert_true(said);
        wt_tables_clear(&t, sizeof t);
        wt_log_free(log);
        assert_int_equal(remove(path), 0);
    }
}

/* Strokes of 10 mm, back and forth in a second: by the position, by a signed velocity, or by the
 * stated track length. */
static void test_velocity_of_strokes(void **state)
{
    (void)state;
    static const char *const heads[] = {"position (mm)", "velocity (mm/s)", "comment"};
    for (int by = 0; by < 3; by++) {
        char path[] = "strokes-XXXXXX";
        wt_record_job job = wt_record_job_defaults();
        FILE *out = truth_file(path);
        fprintf(out, "time (s),%s,Ff (N),Fn (N)\n", heads[by]);
        for (int i = 0; i < 4000; i++) {
            const double angle = 2 * M_PI * (i + 0.5) / 100, sign = cos(angle) > 0 ? 1 : -1;
            fprintf(out, "%.9g,%.9g,%g,5\n", 0.01 * i,
                    by == 0 ? 5 * sin(angle) : 10 * M_PI * cos(angle), 4 * sign + 0.01 * (i % 7));
        }
        assert_int_equal(fclose(out), 0);
        job.track_area = (wt_estimate){3e-11, 3e-12, 0, "m^2"};
        if (by == 2)
            job.track_length.value = 10e-3;
        wt_record_tables t = made(&job, path, NULL);
        assert_string_equal(text_cell(t.record, 0, "averaged_over"), "double stroke");
        if (by < 2)
            assert_near(number_cell(t.record, 0, "velocity"), 0.02, 1e-3);
        else
            assert_true(isnan(number_cell(t.record, 0, "velocity")));
        assert_near(number_cell(t.wear, 0, "distance"), 0.02 * 39.99, 1e-3);
        assert_near(number_cell(t.wear, 0, "specific_wear_rate"), 3e-11 / (2 * 5 * 39.99), 2e-3);
        wt_tables_clear(&t, sizeof t);
        assert_int_equal(remove(path), 0);
    }
}

/* Records without a velocity and records at two velocities: no common friction. */
static void test_unknown_velocity(void **state)
{
    (void)state;
    char unknown[] = "a-XXXXXX", known[] = "b-XXXXXX";
    const wt_record_job job = wt_record_job_defaults();
    FILE *out = truth_file(unknown);
    fputs("time (s),mu\n", out);
    for (int i = 0; i < 100; i++)
        fprintf(out, "%d,%g\n", i, 0.5 + 0.001 * (i % 7));
    assert_int_equal(fclose(out), 0);
    out = truth_file(known);
    fputs("step,time (s),velocity (mm/s),mu\n", out);
    for (int i = 0; i < 200; i++)
        fprintf(out, "%d,%d,%d,%g\n", i / 100, i, 10 + 40 * (i / 100), 0.6 + 0.001 * (i % 7));
    assert_int_equal(fclose(out), 0);
    const char *const paths[] = {unknown, known};
    wt_record_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    wt_estimate key;
    assert_int_equal(make(&job, paths, 2, NULL, &t, &err), WT_OK);
    assert_int_equal(wt_table_n_rows(t.record), 3);
    assert_false(wt_table_estimate(t.record, "friction_coefficient", &key));
    wt_tables_clear(&t, sizeof t);
    assert_int_equal(remove(unknown), 0);
    assert_int_equal(remove(known), 0);
}

/* Laps of 4 and of 8 samples, whose distance the instrument divides by their number: the velocity
 * is path over time, not the mean over laps. */
static void test_uneven_laps(void **state)
{
    (void)state;
    char path[] = "uneven-XXXXXX";
    const wt_record_job job = wt_record_job_defaults();
    FILE *out = truth_file(path);
    double time = 0;
    fputs("time (s),distance (m),laps,mu\n", out);
    for (int lap = 0; lap < 100; lap++) {
        const int samples = lap % 4 == 0 ? 4 : 8;
        for (int i = 0; i < samples; i++, time += 0.1) {
            const double at = lap + (double)i / samples;
            fprintf(out, "%.9g,%.9g,%.9g,%g\n", time, 0.1 * at, at, 0.5 + 0.001 * (lap % 7));
        }
    }
    assert_int_equal(fclose(out), 0);
    wt_record_tables t = made(&job, path, NULL);
    assert_near(number_cell(t.record, 0, "velocity"), 0.1 / 0.7, 2e-3);
    wt_tables_clear(&t, sizeof t);
    assert_int_equal(remove(path), 0);
}

/* The cap of a ball that grows by Archard's law from the first cycle: the path before the mean of
 * the first cycles counts. */
static void test_depth_by_archard(void **state)
{
    (void)state;
    char path[] = "archard-XXXXXX";
    const double ball = 3e-3, radius = 10e-3, k = 1e-13, load = 5, velocity = 0.1, end = 2000;
    wt_record_job job = wt_record_job_defaults();
    job.track_radius.value = radius;
    job.ball_radius.value = ball;
    FILE *out = truth_file(path);
    fputs("time (s),velocity (m/s),mu,Fn (N),wear depth (um)\n", out);
    for (int i = 0; i < 4000; i++) {
        /* cross-section of a shallow cap: 4/3 sqrt(2 R) h^1.5 */
        const double time = end * i / 3999, area = k * load * velocity * time / (2 * M_PI * radius),
                     depth = pow(area / (4.0 / 3 * sqrt(2 * ball)), 2.0 / 3);
        fprintf(out, "%.9g,%g,%g,%g,%.9g\n", time, velocity, 0.5 + 0.001 * (i % 7), load,
                1e6 * depth + 0.01 * (i % 5));
    }
    assert_int_equal(fclose(out), 0);
    wt_record_tables t = made(&job, path, NULL);
    assert_near(number_cell(t.wear, 0, "specific_wear_rate"), k, 0.01);
    assert_true(number_cell(t.wear, 0, "specific_wear_rate_low") < k);
    assert_true(number_cell(t.wear, 0, "specific_wear_rate_high") > k);
    wt_tables_clear(&t, sizeof t);
    assert_int_equal(remove(path), 0);
}

static void test_missing_data(void **state)
{
    (void)state;
    wt_record_job job = wt_record_job_defaults();
    wt_record_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    const char *const disc = RECORDS "disc.csv";
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_MISSING);
    assert_non_null(strstr(err.advice, "--load"));
    assert_true(t.record == NULL && t.record_cycles == NULL && t.wear == NULL);
    job.mass_loss = (wt_estimate){1e-6, 0, 0, "kg"};
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_ARG);
    assert_non_null(strstr(err.advice, "density"));
    job = wt_record_job_defaults();
    job.poisson_ratio = 0.6;
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_RANGE);
    job = wt_record_job_defaults();
    job.cycle = WT_CYCLE_STROKE;
    job.load.value = 5;
    assert_int_equal(make(&job, &disc, 1, NULL, &t, &err), WT_E_MISSING);
    assert_non_null(strstr(err.message, "double strokes"));
}

/* A coefficient that differs from the ratio of its forces is reported. */
static void test_inconsistency(void **state)
{
    (void)state;
    static const char path[] = "test_record_job.csv";
    const wt_record_job job = wt_record_job_defaults();
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fprintf(out, "time (s),mu,Ff (N),Fn (N)\n");
    for (int i = 0; i < 100; i++)
        fprintf(out, "%d,%g,%g,10\n", i, 0.5 + 0.001 * (i % 7), 6 + 0.01 * (i % 7));
    fclose(out);
    wt_log *log = wt_log_new();
    wt_record_tables t = made(&job, path, log);
    bool said = false;
    for (size_t i = 0; i < wt_log_count(log); i++)
        said = said || strstr(wt_log_get(log, i).text, "differ by up to 0.1") != NULL;
    assert_true(said);
    assert_near(number_cell(t.record, 0, "difference"), 0.1, 1e-9);
    assert_near(number_cell(t.record, 0, "friction_coefficient"), 0.503, 1e-3);
    wt_tables_clear(&t, sizeof t);
    wt_log_free(log);
    (void)remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc),
        cmocka_unit_test(test_steps),
        cmocka_unit_test(test_two_directions),
        cmocka_unit_test(test_wear),
        cmocka_unit_test(test_wear_of_runs),
        cmocka_unit_test(test_profiles),
        cmocka_unit_test(test_length_by_laps),
        cmocka_unit_test(test_rotation_alone),
        cmocka_unit_test(test_pause),
        cmocka_unit_test(test_velocity_of_strokes),
        cmocka_unit_test(test_uneven_laps),
        cmocka_unit_test(test_unknown_velocity),
        cmocka_unit_test(test_depth_by_archard),
        cmocka_unit_test(test_missing_data),
        cmocka_unit_test(test_inconsistency),
    };
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
