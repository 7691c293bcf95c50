/* Force maps of Asylum Research by an independent writer: complete, stopped, with two passes,
 * corrupted.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/ardf_writer.h"

enum { N = 9, COLUMNS = 3, LINES = 2, CURVES = COLUMNS * LINES };
static const double raw[N] = {1e-7, 2e-7, 3e-7, 4e-7, 4.01e-7, 4.02e-7, 4e-7, 3e-7, 1e-7};
static const double deflection[N] = {0, 1e-9, 3e-9, 6e-9, 6e-9, 6e-9, 5e-9, 2e-9, -1e-9};
static const double phase[N] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
static const char *const labels[] = {"Raw", "Defl", "Phase"}, *const units[] = {"m", "m", "deg"};
static const double *const values[] = {raw, deflection, phase};

static ardf_writer_file usual(void)
{
    return (ardf_writer_file){.path = path,
                              .columns = COLUMNS,
                              .lines = LINES,
                              .written = CURVES,
                              .labels = labels,
                              .units = units,
                              .n_channels = 3,
                              .n = N,
                              .values = values,
                              .segments = "Ext;Dwell;Ret;",
                              .begins = {0, 4, 6, N - 1, 0},
                              .interval = 0.25,
                              .step = 2e-6,
                              .note = "SpringConstant: 0.5\rInvOLS: 5e-08\r"};
}

/* Curves of the first pass, for any direction of the scan and with another pass between its
 * lines. */
static void all_curves(void **state)
{
    (void)state;
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_RETRACT};
    for (int variant = 0; variant < 4; variant++) {
        ardf_writer_file f = usual();
        reading r;
        f.down = variant % 2 == 1;
        f.both = variant >= 2;
        assert_int_equal(ardf_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_int_equal(wt_force_count(r.source), CURVES);
        assert_true(has_logged(&r, "the first of 2 volumes") == f.both);
        for (size_t k = 0; k < CURVES; k++) {
            next_curve(&r);
            const size_t row = k / COLUMNS;
            assert_int_equal(r.curve.index, k);
            assert_int_equal(r.curve.grid_x, k % COLUMNS);
            assert_int_equal(r.curve.grid_y, f.down ? LINES - 1 - row : row);
            assert_near(r.curve.x, 2e-6 * (double)(k % COLUMNS), 1e-15);
            assert_near(r.curve.cantilever.spring_constant, 0.5, 0);
            assert_int_equal(r.curve.n_segments, 3);
            for (size_t s = 0, at = 0; s < 3; s++) {
                const wt_segment *segment = &r.curve.segments[s];
                assert_int_equal(segment->kind, kinds[s]);
                assert_int_equal(segment->n_points, f.begins[s + 1] - f.begins[s] + (s == 2));
                for (size_t i = 0; i < segment->n_points; i++, at++) {
                    const double more = 1e-9 * (double)k;
                    assert_near(channel(segment, WT_Q_HEIGHT)[i], -(raw[at] + more), 1e-6);
                    assert_near(channel(segment, WT_Q_FORCE)[i], 0.5 * (deflection[at] + more),
                                1e-6);
                    assert_near(channel(segment, WT_Q_TIME)[i], 0.25 * (double)at, 1e-15);
                }
            }
        }
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        close_all(&r);
    }
}

static void stopped(void **state)
{
    (void)state;
    for (unsigned written = 0; written < CURVES; written++) {
        ardf_writer_file f = usual();
        reading r;
        f.written = written;
        assert_int_equal(ardf_write(&f), 0);
        if (written == 0) {
            assert_refused(WT_E_EMPTY, "stopped before its first curve");
            continue;
        }
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        for (unsigned k = 0; k < written; k++)
            next_curve(&r);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        assert_true(has_logged(&r, "the map was stopped"));
        close_all(&r);
    }
}

static void inconsistent_files(void **state)
{
    (void)state;
    ardf_writer_file f = usual();
    f.segments = "Ext;Ret;";
    assert_int_equal(ardf_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "a first sample for each segment");
    f = usual();
    f.begins[0] = 1;
    assert_int_equal(ardf_write(&f), 0);
    assert_refused(WT_E_CORRUPT, "a first sample for each segment");
}

/* Checksums detect a changed byte that is used. With corrected checksums no length or position
 * leads outside the file. */
static void damaged(void **state)
{
    (void)state;
    static unsigned char bytes[8192], copy[sizeof bytes];
    const ardf_writer_file f = usual();
    assert_int_equal(ardf_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes);
    assert_true(n < sizeof bytes);
    for (size_t length = 0; length < n; length += 7) {
        reading r;
        FILE *out = fopen(path, "wb");
        assert_non_null(out);
        assert_int_equal(fwrite(bytes, 1, length, out), length);
        assert_int_equal(fclose(out), 0);
        wt_status status = open_force(&r, path, NULL);
        for (size_t k = 0; k < CURVES && status == WT_OK; k++)
            status = wt_force_next(r.source, &r.curve, &r.err);
        assert_int_not_equal(status, WT_OK);
        close_all(&r);
    }
    for (size_t at = 16; at < n; at++)
        for (int value = 0; value < 256; value += 255) {
            memcpy(copy, bytes, n);
            copy[at] = (unsigned char)value;
            ardf_writer_fix_checksums(copy, n);
            (void)open_bytes(copy, n);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_curves), cmocka_unit_test(stopped),
                                       cmocka_unit_test(inconsistent_files),
                                       cmocka_unit_test(damaged)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
