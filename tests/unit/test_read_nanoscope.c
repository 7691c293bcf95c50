/* NanoScope force files by the independent writer, with numbers that are read back exactly.
 * test_read_measured.c compares the measured files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/nanoscope_writer.h"

enum {
    IN = 8,
    HOLD = 3,
    OUT = 8,
    SIDE = 3,
    CURVES = SIDE * SIDE,
    MOST = CURVES * (IN + HOLD + OUT)
};
static const double step = 0.000375, sensor_step = 0.0001;
static double volts[MOST], sensor[MOST];

/* Curves in time order: the end of the approach is 0.75 V above its start. */
static nanoscope_writer_file usual(size_t n_hold, bool volume)
{
    static nanoscope_writer_channel channels[2];
    const size_t n = IN + n_hold + OUT;
    for (size_t i = 0; i < (volume ? CURVES : 1) * n; i++) {
        const size_t at = i % n, curve = i / n;
        const double in = at < IN            ? (double)at
                          : at < IN + n_hold ? IN - 1
                                             : (double)(IN + n_hold + OUT - 1 - at);
        volts[i] = step * (-400 + 2000.0 / (IN - 1) * in + 3 * (double)curve);
        volts[i] = step * rint(volts[i] / step);
        sensor[i] = sensor_step * (10 * in + (double)curve);
    }
    channels[0] = (nanoscope_writer_channel){"Deflection Error", "Sens. DeflSens", step, volts};
    channels[1] =
        (nanoscope_writer_channel){"Height Sensor", "Sens. ZsensSens", sensor_step, sensor};
    return (nanoscope_writer_file){.path = path,
                                   .volume = volume,
                                   .side = SIDE,
                                   .n_in = IN,
                                   .n_hold = n_hold,
                                   .n_out = OUT,
                                   .width = 2,
                                   .ramp_volts = 20,
                                   .z_sensitivity = 10,
                                   .deflection_sensitivity = 40,
                                   .spring_constant = 0.5,
                                   .trigger = 0.75,
                                   .rate = 100,
                                   .n_channels = 2,
                                   .channels = channels};
}

static double height(size_t n_hold, size_t at)
{
    return at < IN            ? 200e-9 * (double)(IN - 1 - at) / IN
           : at < IN + n_hold ? 0
                              : 200e-9 * (double)(at - IN - n_hold) / OUT;
}

/* All curves as they were written. */
static void reads_back(const nanoscope_writer_file *f, size_t n_curves)
{
    const size_t n = IN + f->n_hold + OUT;
    reading r;
    assert_int_equal(nanoscope_write(f), 0);
    if (open_force(&r, path, NULL) != WT_OK)
        fail_msg("%s; %s", r.err.message, r.err.found);
    assert_int_equal(wt_force_count(r.source), n_curves);
    for (size_t curve = 0; curve < n_curves; curve++) {
        next_curve(&r);
        assert_int_equal(r.curve.index, curve);
        assert_int_equal(r.curve.grid_x, f->volume ? (long)(curve % SIDE) : -1);
        if (f->volume)
            assert_near(r.curve.y, 100e-9 * (double)(curve / SIDE), 1e-12);
        assert_near(r.curve.cantilever.spring_constant, 0.5, 0);
        assert_near(r.curve.cantilever.sensitivity, 40e-9, 1e-15);
        assert_int_equal(r.curve.n_segments, f->n_hold > 0 ? 3 : 2);
        for (size_t s = 0, at = 0; s < r.curve.n_segments; s++) {
            const wt_segment *segment = &r.curve.segments[s];
            assert_int_equal(segment->index, s);
            const bool hold = f->n_hold > 0 && s == 1;
            assert_int_equal(segment->kind, s == 0 ? WT_SEGMENT_APPROACH
                                            : hold ? WT_SEGMENT_DWELL
                                                   : WT_SEGMENT_RETRACT);
            assert_near(segment->duration, hold ? 0.5 : 0.2, 1e-15);
            for (size_t i = 0; i < segment->n_points; i++, at++) {
                const double v = volts[curve * n + at];
                assert_near_abs(channel(segment, WT_Q_DEFLECTION_VOLTAGE)[i], v, 1e-15);
                assert_near_abs(channel(segment, WT_Q_FORCE)[i], v * 20e-9, 1e-22);
                assert_near_abs(channel(segment, WT_Q_HEIGHT)[i], height(f->n_hold, at), 1e-20);
                assert_near_abs(channel(segment, WT_Q_MEASURED_HEIGHT)[i],
                                -900e-9 * sensor[curve * n + at], 1e-20);
            }
        }
        assert_near(r.curve.segments[0].setpoint, 0.75 * 20e-9, 1e-12);
        assert_near(r.curve.segments[0].velocity, 1e-6, 1e-12);
    }
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
    assert_false(has_logged(&r, "doubtful"));
    assert_true(has_logged(&r, "256 times") == f->scaled);
    close_all(&r);
}

static void curves(void **state)
{
    (void)state;
    for (unsigned width = 2; width <= 4; width += 2)
        for (size_t n_hold = 0; n_hold <= HOLD; n_hold += HOLD)
            for (int volume = 0; volume < 2; volume++) {
                nanoscope_writer_file f = usual(n_hold, volume == 1);
                f.width = width;
                reads_back(&f, volume == 1 ? CURVES : 1);
                f.scaled = width == 4;
                reads_back(&f, volume == 1 ? CURVES : 1);
            }
}

/* Blocks as large as a map needs. */
static void large(void **state)
{
    (void)state;
    enum { BIG_SIDE = 64, N = 700 };
    nanoscope_writer_file f = usual(0, true);
    const nanoscope_writer_channel channel = {"Deflection Error", "Sens. DeflSens", step, NULL};
    f.side = BIG_SIDE;
    f.n_in = f.n_out = N;
    f.trigger = 0;
    f.n_channels = 1;
    f.channels = &channel;
    reading r;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_count(r.source), BIG_SIDE * BIG_SIDE);
    close_all(&r);
}

/* Truncated: the curves before the end are read. */
static void truncated(void **state)
{
    (void)state;
    nanoscope_writer_file f = usual(0, true);
    f.missing_bytes = 2 * (IN + OUT) + 1;
    reading r;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_count(r.source), CURVES - 2);
    assert_true(has_logged(&r, "7 of 9 curves"));
    close_all(&r);
    f.missing_bytes = 2 * (IN + OUT) * CURVES;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "the file is cut off");
    assert_int_equal(open_force(&r, path, NULL), WT_E_CORRUPT);
    /* its statement of the number of curves */
    assert_string_equal(r.err.place, "\\*Ciao force image list");
    close_all(&r);
}

/* Only the mark of the format: detected, and corrupted. */
static void header_only(void **state)
{
    (void)state;
    static const char *const marks[] = {"\\*Force file list", "\\*File list"};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
        FILE *out = fopen(path, "wb");
        assert_non_null(out);
        assert_true(fputs(marks[i], out) >= 0);
        assert_int_equal(fclose(out), 0);
        assert_refused(WT_E_CORRUPT, "");
    }
}

/* A stopped ramp leaves padding after the samples of each direction. */
static void stopped_ramp(void **state)
{
    (void)state;
    enum { GONE_IN = 1, GONE_OUT = 2 };
    for (int padding = 0; padding < 2; padding++) {
        nanoscope_writer_file f = usual(0, false);
        reading r;
        f.n_in -= GONE_IN;
        f.n_out -= GONE_OUT;
        f.half = IN;
        f.padding = padding == 0 ? (double)NAN : 0;
        f.trigger = 0;
        assert_int_equal(nanoscope_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_true(has_logged(&r, "7 and 6 of 8 samples"));
        next_curve(&r);
        for (size_t s = 0, at = 0; s < 2; s++) {
            const wt_segment *segment = &r.curve.segments[s];
            assert_int_equal(segment->n_points, s == 0 ? f.n_in : f.n_out);
            assert_near(segment->duration, 0.2 * (double)segment->n_points / IN, 1e-12);
            for (size_t i = 0; i < segment->n_points; i++, at++) {
                assert_near_abs(channel(segment, WT_Q_DEFLECTION_VOLTAGE)[i], volts[at], 1e-15);
                assert_near_abs(channel(segment, WT_Q_HEIGHT)[i],
                                200e-9 / IN * (double)(s == 0 ? f.n_in - 1 - i : i), 1e-20);
            }
        }
        close_all(&r);
        static unsigned char bytes[16384];
        const size_t n = read_bytes(bytes, sizeof bytes);
        bytes[n - 4] ^= 1; /* padding of the last direction */
        assert_int_equal(open_bytes(bytes, n), WT_E_CORRUPT);
    }
}

static void oddities(void **state)
{
    (void)state;
    reading r;
    /* A sample that was not measured is missing, not a number of volts. */
    nanoscope_writer_file f = usual(0, false);
    volts[2] = (double)NAN;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    assert_true(isnan(channel(&r.curve.segments[0], WT_Q_FORCE)[2]));
    assert_true(has_logged(&r, "are missing: not measured"));
    close_all(&r);
    /* It does not affect the detected direction of the sensor or of the deflection. */
    f = usual(0, false);
    volts[IN - 1] = sensor[0] = (double)NAN;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    assert_near_abs(channel(&r.curve.segments[0], WT_Q_MEASURED_HEIGHT)[1], -900e-9 * sensor[1],
                    1e-20);
    assert_false(has_logged(&r, "the scale of the file is doubtful"));
    close_all(&r);
    /* The mark of 16 bits is an ordinary number in 32 bits. */
    f = usual(0, false);
    f.width = 4;
    volts[2] = -32768 * step;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    assert_near(channel(&r.curve.segments[0], WT_Q_DEFLECTION_VOLTAGE)[2], volts[2], 1e-12);
    close_all(&r);
    /* A trigger that contradicts the deflections. */
    f = usual(0, false);
    f.trigger = 0.1;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_true(has_logged(&r, "the trigger was 0.1 V: the scale of the file is doubtful"));
    close_all(&r);
    /* Not calibrated: the message states the required options. */
    f = usual(0, false);
    f.spring_constant = f.deflection_sensitivity = 0;
    wt_read_options o = wt_read_defaults();
    o.want = WT_Q_BIT(WT_Q_FORCE);
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_MISSING);
    assert_string_equal(r.err.advice, "give --spring-constant 0.1N/m and --sensitivity 60nm/V");
    close_all(&r);
}

/* A period with any stored start is rotated so that its farthest point is in the middle. */
static void peakforce(void **state)
{
    (void)state;
    enum { N = IN + OUT };
    nanoscope_writer_file f = usual(0, false);
    f.amplitude = 100;
    f.sync = 3;
    f.n_channels = 1;
    for (size_t i = 0; i < N; i++)
        volts[i] = step * (double)i;
    reading r;
    assert_int_equal(nanoscope_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_true(has_logged(&r, "not verified on a genuine file"));
    next_curve(&r);
    for (size_t i = 0; i < N; i++) {
        const wt_segment *segment = &r.curve.segments[i / IN];
        assert_near_abs(channel(segment, WT_Q_DEFLECTION_VOLTAGE)[i % IN],
                        step * (double)((i + 3 + N - IN) % N), 1e-15);
        assert_near_abs(channel(segment, WT_Q_HEIGHT)[i % IN],
                        100e-9 * (1 + cos(2 * 3.14159265358979 * (double)i / N)), 1e-18);
        assert_near(segment->duration, 0.25e-3, 1e-12);
    }
    close_all(&r);
}

/* After a change of any byte or a truncation the file is read or refused. */
static void damaged(void **state)
{
    (void)state;
    static unsigned char bytes[16384];
    nanoscope_writer_file f = usual(0, false);
    assert_int_equal(nanoscope_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes);
    static const struct {
        const char *line, *instead;
    } changes[] = {{"Data length: 32", "Data length: 39"},
                   {"Samps/line: 8 8", "Samps/line: 8 9"},
                   {"Data offset: 4096", "Data offset: 9096"},
                   {"\x1a", "9"}};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        unsigned char copy[sizeof bytes];
        const size_t length = strlen(changes[i].line);
        memcpy(copy, bytes, n);
        unsigned char *at = memmem(copy, n, changes[i].line, length);
        assert_non_null(at);
        memcpy(at, changes[i].instead, length);
        assert_int_equal(open_bytes(copy, n), WT_E_CORRUPT);
    }
    for (size_t length = 0; length < n; length += 29)
        (void)open_bytes(bytes, length);
    /* One channel with one curve and another with nine: the first must not read into the block of
     * the other. */
    f = usual(0, true);
    assert_int_equal(nanoscope_write(&f), 0);
    const size_t n_volume = read_bytes(bytes, sizeof bytes);
    unsigned char *at = memmem(bytes, n_volume, "Data length: 288", 16);
    assert_non_null(at);
    memcpy(at, "Data length: 032", 16);
    assert_int_equal(open_bytes(bytes, n_volume), WT_E_CORRUPT);
}

/* A header number is complete, or named with its line. */
static void inconsistencies(void **state)
{
    (void)state;
    static unsigned char bytes[65536];
    static const struct {
        const char *written, *words;
        double spring_constant;
    } cases[] = {{"0.12345", NULL, 0.12345},
                 {"0,12345", NULL, 0.12345},
                 {"0.1 0.2", "\"0.1 0.2\" states two values", (double)NAN},
                 {"1.234,5", "\"1.234,5\" is not one number", (double)NAN}};
    nanoscope_writer_file f = usual(0, false);
    f.spring_constant = 0.12345;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static const char line[] = "Spring Constant: 0.12345";
        assert_int_equal(nanoscope_write(&f), 0);
        const size_t n = read_bytes(bytes, sizeof bytes);
        reading r;
        for (unsigned char *at; (at = memmem(bytes, n, line, sizeof line - 1)) != NULL;) {
            if (i == 0)
                break;
            memcpy(at + strlen("Spring Constant: "), cases[i].written, strlen(cases[i].written));
        }
        FILE *const out = fopen(path, "wb");
        assert_non_null(out);
        assert_int_equal(fwrite(bytes, 1, n, out), n);
        assert_int_equal(fclose(out), 0);
        wt_read_options options = wt_read_defaults();
        options.want = WT_Q_BIT(WT_Q_HEIGHT);
        assert_int_equal(open_force(&r, path, &options), WT_OK);
        next_curve(&r);
        if (isnan(cases[i].spring_constant))
            assert_true(isnan(r.curve.cantilever.spring_constant));
        else
            assert_near(r.curve.cantilever.spring_constant, cases[i].spring_constant, 0);
        assert_int_equal(has_logged(&r, "it is not used: correct the line"),
                         cases[i].words != NULL);
        if (cases[i].words != NULL)
            assert_true(has_logged(&r, cases[i].words));
        close_all(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inconsistencies), cmocka_unit_test(curves),
        cmocka_unit_test(large),           cmocka_unit_test(truncated),
        cmocka_unit_test(header_only),     cmocka_unit_test(oddities),
        cmocka_unit_test(peakforce),       cmocka_unit_test(damaged),
        cmocka_unit_test(stopped_ramp)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
