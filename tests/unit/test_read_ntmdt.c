/* Text exports of NT-MDT with rows written here. test_read_measured.c compares the measured file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

enum { ROWS = 12, IDLE = 3 };

/* From the end of the ramp in the sample outwards; the first rows repeat the first reached
 * position. */
static void write_rows(size_t n, const char *end)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    for (size_t i = 0; i < n; i++) {
        const size_t reached = i < IDLE ? IDLE : i;
        fprintf(out, "-%zu,5\t%d,%02zu\t%d,25\r\n", 10 * (n - i), 3 - (int)reached / 4, reached,
                2 - (int)reached / 4);
    }
    fputs(end, out);
    assert_int_equal(fclose(out), 0);
}

static void curve(void **state)
{
    (void)state;
    reading r;
    write_rows(ROWS, "");
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_true(has_logged(&r, "does not say the unit of the deflection signal"));
    assert_true(has_logged(&r, "3 rows that repeat the first sample"));
    next_curve(&r);
    assert_int_equal(r.curve.n_segments, 2);
    for (size_t s = 0; s < 2; s++) {
        const wt_segment *segment = &r.curve.segments[s];
        assert_int_equal(segment->kind, s == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT);
        assert_int_equal(segment->n_points, ROWS - IDLE);
        for (size_t i = 0; i < segment->n_points; i++) {
            const size_t row = s == 0 ? ROWS - 1 - i : IDLE + i;
            assert_near(channel(segment, WT_Q_MEASURED_HEIGHT)[i],
                        -1e-9 * (10.0 * (double)(ROWS - row) + 0.5), 1e-12);
            assert_near(channel(segment, WT_Q_DEFLECTION_VOLTAGE)[i],
                        s == 0 ? 3 - (double)(row / 4) + 0.01 * (double)row
                               : 2.25 - (double)(row / 4),
                        1e-12);
        }
    }
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
    close_all(&r);
}

/* Other numbers are not detected as this format. */
static void others(void **state)
{
    (void)state;
    write_rows(ROWS, "1,5\t1,0\t1,0\r\n"); /* above 0 */
    assert_refused(WT_E_FORMAT, "not recognised");
    write_rows(ROWS, "-0,1\t1\t1,0\r\n"); /* a number without a comma */
    assert_refused(WT_E_FORMAT, "not recognised");
    write_rows(ROWS, "-0,1\t1,0\r\n"); /* two columns */
    assert_refused(WT_E_FORMAT, "not recognised");
    write_rows(5, "");
    assert_refused(WT_E_FORMAT, "not recognised");
    write_rows(2000, "-0,1\t1,0\r\n"); /* after the part that the detection reads */
    assert_refused(WT_E_CORRUPT, "no row of three numbers");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(curve), cmocka_unit_test(others)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
