/* HDF5 files in the layouts of other programs by the independent writer: afmformats, Nanosurf
 * Studio in both versions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/curve_hdf5_writer.h"

enum { CURVES = 2, ROWS = 6 };

/* ---- afmformats -------------------------------------------------------------------------------
 */

static double height[CURVES * ROWS], force[CURVES * ROWS], time_s[CURVES * ROWS];

static afmformats_writer_file usual(const unsigned char *segments)
{
    for (size_t i = 0; i < CURVES * ROWS; i++) {
        height[i] = 1e-6 - 1e-8 * (double)i;
        force[i] = 1e-9 / 3 * (double)i;
        time_s[i] = 0.25 * (double)i;
    }
    return (afmformats_writer_file){.path = path,
                                    .n_curves = CURVES,
                                    .n = ROWS,
                                    .time = time_s,
                                    .height = height,
                                    .force = force,
                                    .segments = segments,
                                    .spring_constant = 0.3,
                                    .force_unit = "N"};
}

static void afmformats(void **state)
{
    (void)state;
    static const unsigned char two[ROWS] = {0, 0, 0, 0, 1, 1}, three[ROWS] = {0, 0, 1, 1, 1, 2};
    for (int kind = 0; kind < 2; kind++) {
        afmformats_writer_file f = usual(kind == 0 ? two : three);
        reading r;
        f.packed = kind == 1;
        assert_int_equal(afmformats_write(&f), 0);
        if (open_force(&r, path, NULL) != WT_OK)
            fail_msg("%s; %s", r.err.message, r.err.found);
        assert_int_equal(wt_force_count(r.source), CURVES);
        for (size_t curve = 0; curve < CURVES; curve++) {
            next_curve(&r);
            assert_near_abs(r.curve.x, 1e-6 * (double)curve, 1e-18);
            assert_near(r.curve.cantilever.spring_constant, 0.3, 0);
            assert_int_equal(r.curve.n_segments, 2 + kind);
            for (size_t s = 0, at = curve * ROWS; s < r.curve.n_segments; s++) {
                const wt_segment *segment = &r.curve.segments[s];
                assert_int_equal(segment->kind, s == 0                        ? WT_SEGMENT_APPROACH
                                                : s + 1 == r.curve.n_segments ? WT_SEGMENT_RETRACT
                                                                              : WT_SEGMENT_DWELL);
                for (size_t i = 0; i < segment->n_points; i++, at++) {
                    assert_near(channel(segment, WT_Q_FORCE)[i], force[at], 0);
                    assert_near(channel(segment, WT_Q_MEASURED_HEIGHT)[i], height[at], 0);
                    assert_near(channel(segment, WT_Q_TIME)[i], time_s[at], 0);
                }
            }
        }
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        close_all(&r);
    }
}

static void unexpected_afmformats(void **state)
{
    (void)state;
    static const unsigned char back[ROWS] = {0, 0, 1, 1, 0, 0}, one[ROWS] = {1, 1, 1, 1, 1, 1},
                               good[ROWS] = {0, 0, 0, 1, 1, 1};
    const unsigned char *const bad[] = {back, one};
    for (size_t i = 0; i < 2; i++) {
        const afmformats_writer_file f = usual(bad[i]);
        assert_int_equal(afmformats_write(&f), 0);
        assert_refused(WT_E_CORRUPT, "the numbers of the segments are not understood");
    }
    afmformats_writer_file f = usual(good);
    f.force_unit = "nN";
    assert_int_equal(afmformats_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "another length or unit");
    f = usual(good);
    f.number_step = 20000; /* the second one is reported */
    assert_int_equal(afmformats_write(&f), 0);
    assert_refused(WT_E_UNSUPPORTED, "too many curves are missing before curve 20000");
    f = usual(good);
    f.n_curves = 0;
    assert_int_equal(afmformats_write(&f), 0);
    assert_refused(WT_E_EMPTY, "no force curve");
}

/* ---- Nanosurf ---------------------------------------------------------------------------------
 */

/* Three samples of the first curve and two of the second; in the retraction one and three. */
static const int sizes_in[] = {3, 2}, sizes_out[] = {1, 3}, cut_sizes[] = {3, 3};
static const double v_in[] = {-1, 0, 0.5, (double)NAN, 2}, v_out[] = {0.25, 1, 0, -2},
                    z_in[] = {3e-6, 2e-6, 1e-6, 5e-6, 4e-6}, z_out[] = {1e-6, 4e-6, 5e-6, 6e-6},
                    t_in[] = {0, 0.5, 1, 0, 0.5}, t_out[] = {0, 0, 0.5, 1};
static const double places_x[] = {1e-6, 2e-6}, places_y[] = {3e-6, 4e-6};
static nhf_writer_channel channels[2][3];
static nhf_writer_segment segments[2];

static nhf_writer_file nanosurf(int version)
{
    for (size_t s = 0; s < 2; s++) {
        channels[s][0] = (nhf_writer_channel){"Deflection", "Volt (V)", -10, 10, s ? v_out : v_in};
        channels[s][1] = (nhf_writer_channel){"Position Z", "m", -1e-5, 1e-5, s ? z_out : z_in};
        channels[s][2] = (nhf_writer_channel){"Time", "s", -10, 10, s ? t_out : t_in};
        segments[s] = (nhf_writer_segment){s ? "Retract 1" : "Advance to Setpoint 1",
                                           s ? sizes_out : sizes_in, 3, channels[s]};
    }
    return (nhf_writer_file){.path = path,
                             .version = version,
                             .type = version == 1 ? "spectroscopy_grid" : "spectroscopy",
                             .n_curves = CURVES,
                             .n_segments = 2,
                             .segments = segments,
                             .spring_constant = 0.5,
                             .sensitivity = 1e-7,
                             .x = places_x,
                             .y = places_y};
}

static void check_segment(const wt_segment *segment, size_t s, size_t from, double sign,
                          double shift)
{
    assert_int_equal(segment->kind, s == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT);
    for (size_t i = 0; i < segment->n_points; i++) {
        const size_t at = from + i;
        assert_near_abs(channel(segment, WT_Q_FORCE)[i], 5e-8 * (s ? v_out : v_in)[at], 3e-16);
        assert_near_abs(channel(segment, WT_Q_HEIGHT)[i], sign * (s ? z_out : z_in)[at], 1e-14);
        assert_near_abs(channel(segment, WT_Q_TIME)[i], shift + (s ? t_out : t_in)[at], 1e-8);
    }
}

static void check_curves(const char *file, double sign)
{
    static const size_t from[2][2] = {{0, 0}, {3, 1}};
    reading r;
    if (open_force(&r, file, NULL) != WT_OK)
        fail_msg("%s; %s", r.err.message, r.err.found);
    assert_int_equal(wt_force_count(r.source), CURVES);
    assert_true(has_logged(&r, "not verified on a genuine file"));
    for (size_t curve = 0; curve < CURVES; curve++) {
        next_curve(&r);
        assert_near_abs(r.curve.x, places_x[curve], 1e-14);
        assert_near_abs(r.curve.y, places_y[curve], 1e-14);
        assert_int_equal(r.curve.n_segments, 2);
        assert_int_equal(r.curve.segments[0].n_points, sizes_in[curve]);
        assert_int_equal(r.curve.segments[1].n_points, sizes_out[curve]);
        check_segment(&r.curve.segments[0], 0, from[curve][0], sign, 0);
        check_segment(&r.curve.segments[1], 1, from[curve][1], sign, curve == 0 ? 1 : 0.5);
    }
    close_all(&r);
}

static void nanosurf_curves(void **state)
{
    static const double v_whole[] = {-1, 0, 0.5, 1, 2};
    (void)state;
    for (int version = 1; version <= 2; version++) {
        nhf_writer_file f = nanosurf(version);
        double up[5], out[4];
        if (version == 1) /* has no value for missing samples */
            channels[0][0].values = v_whole;
        assert_int_equal(nhf_write(&f), 0);
        if (version == 2)
            check_curves(path, 1);
        /* A height that increases towards the sample is reversed. */
        f = nanosurf(2);
        for (size_t i = 0; i < 5; i++)
            up[i] = -z_in[i];
        for (size_t i = 0; i < 4; i++)
            out[i] = -z_out[i];
        channels[0][1].values = up;
        channels[1][1].values = out;
        assert_int_equal(nhf_write(&f), 0);
        check_curves(path, 1);
        /* Positions of curves may be stored as counts, too. */
        f.places_range = 4e-6;
        assert_int_equal(nhf_write(&f), 0);
        check_curves(path, 1);
        /* Missing heights do not affect the detection of the direction. */
        up[0] = (double)NAN;
        assert_int_equal(nhf_write(&f), 0);
        reading r;
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        next_curve(&r);
        assert_near_abs(channel(&r.curve.segments[0], WT_Q_HEIGHT)[1], z_in[1], 1e-14);
        close_all(&r);
    }
    nhf_writer_file f = nanosurf(1);
    reading r;
    channels[0][0].values = v_whole;
    assert_int_equal(nhf_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    check_segment(&r.curve.segments[0], 0, 0, 1, 0);
    close_all(&r);
}

/* The deflection is stored as counts; two nodes convert them to the force. */
static void calibration_graph(void **state)
{
    (void)state;
    nhf_writer_file f = nanosurf(2);
    reading r;
    f.newtons_per_count = 1e-18;
    assert_int_equal(nhf_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    const double count = 20 / (0x1p32 - 2);
    for (size_t i = 0; i < 3; i++)
        assert_near_abs(channel(&r.curve.segments[0], WT_Q_FORCE)[i], 1e-18 * v_in[i] / count,
                        2e-18);
    close_all(&r);
}

static void unexpected_nanosurf(void **state)
{
    (void)state;
    nhf_writer_file f = nanosurf(2);
    f.type = "image_line_based";
    assert_int_equal(nhf_write(&f), 0);
    assert_refused(WT_E_EMPTY, "no force curve");
    f = nanosurf(3);
    assert_int_equal(nhf_write(&f), 0);
    assert_refused(WT_E_UNSUPPORTED, "this version");
    f = nanosurf(2);
    channels[1][0].unit = "Hertz (Hz)";
    assert_int_equal(nhf_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "the unit of a channel is not understood");
    f = nanosurf(2);
    channels[0][0].maximum = channels[0][0].minimum;
    channels[0][0].values =
        (const double[5]){(double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN};
    assert_int_equal(nhf_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "the calibration of a channel is not understood");
    /* Segments beyond the limit are reported. */
    f = nanosurf(2);
    static nhf_writer_segment many[17];
    for (size_t s = 0; s < 17; s++)
        many[s] = segments[s % 2];
    f.n_segments = 17;
    f.segments = many;
    assert_int_equal(nhf_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "more segments than any");
    /* A channel of six samples for curves of five. */
    f = nanosurf(2);
    segments[0].sizes = cut_sizes;
    static const double six[] = {0, 0, 0, 0, 0, 0};
    for (size_t c = 0; c < 3; c++)
        channels[0][c].values = six;
    assert_int_equal(nhf_write(&f), 0);
    reading r;
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    close_all(&r);
}

/* Changed bytes in both layouts: read or refused, never more. Each file is read in the sandbox. */
static void damaged(void **state)
{
    (void)state;
    static unsigned char bytes[65536], copy[sizeof bytes];
    static const unsigned char two[ROWS] = {0, 0, 0, 0, 1, 1};
    for (int kind = 0; kind < 2; kind++) {
        const afmformats_writer_file a = usual(two);
        const nhf_writer_file b = nanosurf(2);
        assert_int_equal(kind == 0 ? afmformats_write(&a) : nhf_write(&b), 0);
        const size_t n = read_bytes(bytes, sizeof bytes);
        for (size_t at = 40; at < n; at += n / 60) {
            memcpy(copy, bytes, n);
            memset(copy + at, 0xff, 5);
            (void)open_bytes(copy, n);
            (void)open_bytes(bytes, at);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(afmformats),          cmocka_unit_test(unexpected_afmformats),
        cmocka_unit_test(nanosurf_curves),     cmocka_unit_test(calibration_graph),
        cmocka_unit_test(unexpected_nanosurf), cmocka_unit_test(damaged)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
