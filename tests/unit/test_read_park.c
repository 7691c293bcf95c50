/* TIFF files of Park Systems by the independent writer. test_read_measured.c compares the measured
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/park_writer.h"

enum { CURVES = 2, HALF = 8, SAMPLES = 2 * HALF, VALID_IN = 5, VALID_OUT = 6 };
static double force[CURVES * SAMPLES], z[CURVES * SAMPLES], detector[CURVES * SAMPLES],
    time_us[CURVES * SAMPLES];

static bool valid(size_t i)
{
    return i < HALF ? i < VALID_IN : i - HALF < VALID_OUT;
}

/* Numbers that floats represent exactly; the last one of each half is repeated. */
static park_writer_file usual(void)
{
    static const park_writer_channel channels[] = {{"Force", "nN", 2, force},
                                                   {"Z Scan", "um", 0.5, z},
                                                   {"Z Detector", "um", 1, detector},
                                                   {"Time Stamp", "usec", 1, time_us}};
    for (size_t i = 0; i < CURVES * SAMPLES; i++) {
        const bool there = valid(i % SAMPLES);
        force[i] = there ? (double)(8 * i) : force[i - 1];
        z[i] = there ? -0.25 * (double)i : z[i - 1];
        time_us[i] = there ? 1024.0 * (double)(1 + i % SAMPLES) : time_us[i - 1];
        detector[i] = -9.5;
    }
    return (park_writer_file){.path = path,
                              .n_curves = CURVES,
                              .n_samples = SAMPLES,
                              .n_channels = 4,
                              .channels = channels};
}

static void curves(void **state)
{
    (void)state;
    for (int sensor = 0; sensor < 2; sensor++) {
        const park_writer_file f = usual();
        reading r;
        for (size_t i = 0; sensor == 1 && i < CURVES * SAMPLES; i++)
            detector[i] = (double)i;
        assert_int_equal(park_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_int_equal(wt_force_count(r.source), CURVES);
        for (size_t curve = 0; curve < CURVES; curve++) {
            next_curve(&r);
            for (size_t s = 0; s < 2; s++) {
                const wt_segment *segment = &r.curve.segments[s];
                assert_int_equal(segment->n_points, s == 0 ? VALID_IN : VALID_OUT);
                assert_true((wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT) != NULL) ==
                            (sensor == 1));
                for (size_t i = 0; i < segment->n_points; i++) {
                    const size_t at = curve * SAMPLES + s * HALF + i;
                    assert_near(channel(segment, WT_Q_FORCE)[i], 1e-9 * force[at], 1e-14);
                    assert_near(channel(segment, WT_Q_HEIGHT)[i], 1e-6 * z[at], 1e-14);
                    assert_near(channel(segment, WT_Q_TIME)[i], 1e-6 * time_us[at], 1e-14);
                }
            }
        }
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        close_all(&r);
    }
}

/* Without a time the measured part is unknown, which is reported. */
static void untimed(void **state)
{
    (void)state;
    park_writer_file f = usual();
    reading r;
    f.n_channels = 3;
    assert_int_equal(park_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_true(has_logged(&r, "no channel Time Stamp"));
    next_curve(&r);
    assert_int_equal(r.curve.segments[0].n_points, HALF);
    close_all(&r);
}

static void pictures(void **state)
{
    (void)state;
    park_writer_file f = usual();
    f.picture = true;
    assert_int_equal(park_write(&f), 0);
    assert_refused(WT_E_EMPTY, "the picture holds no force curve");
}

static void damaged(void **state)
{
    (void)state;
    static unsigned char bytes[8192];
    const park_writer_file f = usual();
    assert_int_equal(park_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes);
    const size_t header = 10 + 12 * 4 + 4 + 768;
    for (size_t i = 0; i < 16; i += 4) { /* channels, averages, samples, points */
        unsigned char copy[sizeof bytes];
        memcpy(copy, bytes, n);
        memset(copy + header + i, 0xff, 4);
        if (i != 4)
            assert_int_equal(open_bytes(copy, n), WT_E_CORRUPT);
    }
    for (size_t length = 0; length < n; length += 13)
        assert_int_not_equal(open_bytes(bytes, length), WT_OK);
}

/* Missing bytes move all later ones, which the small image at the end shows. */
static void missing_inside(void **state)
{
    (void)state;
    static unsigned char bytes[8192];
    park_writer_file f = usual();
    f.strip = 64;
    assert_int_equal(park_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes), head = 10 + 12 * 6 + 4;
    assert_int_equal(open_bytes(bytes, n), WT_OK);
    for (size_t at = head; at + 4 < n; at += 37) {
        unsigned char copy[sizeof bytes];
        memcpy(copy, bytes, at);
        memcpy(copy + at, bytes + at + 4, n - at - 4);
        assert_int_equal(open_bytes(copy, n - 4), WT_E_CORRUPT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(curves), cmocka_unit_test(untimed),
                                       cmocka_unit_test(pictures), cmocka_unit_test(damaged),
                                       cmocka_unit_test(missing_inside)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
