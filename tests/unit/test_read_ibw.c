/* Igor binary waves of Asylum Research by an independent writer, and corrupted ones.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/ibw_writer.h"

#define N 7
#define NOTE                                                                                       \
    "SpringConstant: 0.5\rInvOLS: 5e-08\rTriggerChannel:Force\rTriggerPoint: 2e-09\r"              \
    "ImagingMode:Contact\rXLVDT:-3e-06\rYLVDT: 4e-06\r"
#define PARTS "SpringConstant: 0.5\rInvOLS: 5e-08\rIndexes: 0,4,6\rDirection: NaN,1,-1,\r"
#define PARTED NOTE "Indexes: 0,4,6\rDirection: NaN,1,-1,\r"
static const double raw[N] = {1e-7, 2e-7, 3e-7, 4e-7, 5e-7, 3.5e-7, 2.5e-7};
static const double deflection[N] = {0, 0, 1e-9, 3e-9, 6e-9, 2e-9, -1e-9};
static const double sensor[N] = {2e-7, 3e-7, 4e-7, 5e-7, 6e-7, 4.5e-7, 3.5e-7};
static const char *const labels[] = {"Raw", "Defl", "ZSnsr"};
static const double *const values[] = {raw, deflection, sensor};

static ibw_writer_file usual(const char *note)
{
    return (ibw_writer_file){.path = path,
                             .n = N,
                             .n_channels = 3,
                             .labels = labels,
                             .values = values,
                             .interval = 0.25,
                             .note = note};
}

static void test_curve(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        ibw_writer_file f = usual(PARTED);
        reading r;
        f.big_endian = kind % 2 == 1;
        f.doubles = kind >= 2;
        const double exact = f.doubles ? 1e-15 : 1e-7;
        assert_int_equal(ibw_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_int_equal(wt_force_count(r.source), 1);
        next_curve(&r);
        const wt_force_curve curve = r.curve;
        assert_int_equal(curve.n_segments, 2);
        assert_near(curve.x, -3e-6, 0);
        assert_near(curve.y, 4e-6, 0);
        assert_near(curve.cantilever.spring_constant, 0.5, 0);
        assert_near(curve.cantilever.sensitivity, 5e-8, 0);
        for (size_t s = 0, from = 0; s < 2; from += curve.segments[s].n_points, s++) {
            const wt_segment *segment = &curve.segments[s];
            assert_int_equal(segment->kind, s == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT);
            assert_int_equal(segment->n_points, s == 0 ? 4 : 3);
            assert_near(segment->duration, 0.25 * (double)segment->n_points, 1e-15);
            assert_near(segment->setpoint, 2e-9, 0);
            for (size_t i = 0; i < segment->n_points; i++) {
                assert_near(channel(segment, WT_Q_TIME)[i], 0.25 * (double)(from + i), 1e-15);
                assert_near(channel(segment, WT_Q_HEIGHT)[i], -raw[from + i], exact);
                assert_near(channel(segment, WT_Q_MEASURED_HEIGHT)[i], -sensor[from + i], exact);
                assert_near(channel(segment, WT_Q_FORCE)[i], 0.5 * deflection[from + i], exact);
                assert_near(channel(segment, WT_Q_DEFLECTION_VOLTAGE)[i],
                            deflection[from + i] / 5e-8, exact);
            }
        }
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        close_all(&r);
    }
}

/* A curve without Indexes, as extracted from a map, is split where the piezo turns; the approach
 * includes the turning sample. */
static void test_turning_point(void **state)
{
    (void)state;
    static const double falling[N] = {5e-7, 4e-7, 3e-7, 2e-7, 1e-7, 0, -1e-7};
    for (int way = 0; way < 4; way++) {
        const double *own[] = {way == 1 ? falling : raw, deflection, sensor};
        ibw_writer_file f = usual(way == 3 ? NOTE "Direction: NaN,1,-1\r" : NOTE);
        reading r;
        f.values = own;
        static const char *const without_raw[] = {"Other", "Defl", "ZSnsr"}, *const lower_case[] = {
                                                                                 "raw", "defl",
                                                                                 "zsnsr"};
        if (way >= 2)
            f.labels = way == 2 ? without_raw : lower_case;
        assert_int_equal(ibw_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        next_curve(&r);
        const size_t last = r.curve.n_segments - 1;
        assert_int_equal(last, way == 1 ? 0 : 1);
        assert_int_equal(r.curve.segments[0].kind,
                         way == 1 ? WT_SEGMENT_RETRACT : WT_SEGMENT_APPROACH);
        assert_int_equal(r.curve.segments[0].n_points, way == 1 ? N : 5);
        assert_int_equal(r.curve.segments[last].kind, WT_SEGMENT_RETRACT);
        assert_int_equal(r.curve.segments[last].n_points, way == 1 ? N : 2);
        assert_non_null(channel(&r.curve.segments[0], WT_Q_FORCE));
        close_all(&r);
    }
}

/* Value at the end of the approach, in newtons, metres or volts. */
static void test_trigger(void **state)
{
    (void)state;
    static const char *const notes[] = {"TriggerChannel:Force\rTriggerPoint: 2e-09\r" PARTS,
                                        "TriggerChannel:Deflection\rTriggerPoint: 4e-09\r" PARTS,
                                        "TriggerChannel:DeflVolts\rTriggerPoint: 0.08\r" PARTS,
                                        "TriggerChannel:Phase\rTriggerPoint: 90\r" PARTS};
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++) {
        const ibw_writer_file f = usual(notes[i]);
        reading r;
        assert_int_equal(ibw_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        next_curve(&r);
        const double setpoint = r.curve.segments[0].setpoint;
        if (i < 3)
            assert_near(setpoint, 2e-9, 1e-12); /* 0.5 N/m, 50 nm/V */
        else
            assert_true(isnan(setpoint));
        close_all(&r);
    }
}

static void is_refused(const ibw_writer_file *f, wt_status expected, const char *words)
{
    assert_int_equal(ibw_write(f), 0);
    assert_refused(expected, words);
}

static void test_refused(void **state)
{
    (void)state;
    static const char *const parts[] = {
        "Indexes: 0,4,6\r",                      /* no Direction */
        "Indexes: 0,4,7\rDirection: NaN,1,-1\r", /* after the last sample */
        "Indexes: 0,4,4\rDirection: NaN,1,-1\r",
        "Indexes: 0,4,2\rDirection: NaN,1,-1\r",
        "Indexes: 0,4,6\rDirection: NaN,1\r",
        "Indexes: 0\rDirection: NaN\r",
        "Indexes: -3,4,6\rDirection: NaN,1,-1\r",
        "Indexes: 0,99999999999999999999,6\rDirection: NaN,1,-1\r",
    };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const ibw_writer_file f = usual(parts[i]);
        is_refused(&f, WT_E_CORRUPT, "approach and retract");
    }
    static const char *const no_position[] = {"Other", "Defl", "Phase"};
    ibw_writer_file flat = usual(NOTE);
    flat.labels = no_position;
    is_refused(&flat, WT_E_CORRUPT, "approach and retract");
    ibw_writer_file line = usual(PARTED);
    line.n_channels = 0;
    is_refused(&line, WT_E_EMPTY, "two dimensions");
    ibw_writer_file wide = usual("Indexes: 0,4,6\rDirection: NaN,1,-1\r");
    wide.n_channels = 1; /* neither deflection nor spring constant */
    reading r;
    assert_int_equal(ibw_write(&wide), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    next_curve(&r);
    assert_int_equal(r.curve.segments[0].n_channels, 2); /* time and height */
    close_all(&r);
}

/* Wrong sizes, and a truncated file. */
static void test_damaged(void **state)
{
    (void)state;
    static unsigned char bytes[2000];
    static const size_t sizes[] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 64 + 68, 64 + 72};
    ibw_writer_file f = usual(PARTED);
    assert_int_equal(ibw_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned char copy[sizeof bytes];
        memcpy(copy, bytes, n);
        memset(copy + sizes[i], 0xff, 4);
        ibw_writer_fix_checksums(copy, n);
        assert_int_not_equal(open_bytes(copy, n), WT_OK);
        copy[3] ^= 1; /* the check sum */
        assert_int_not_equal(open_bytes(copy, n), WT_OK);
    }
    for (size_t length = 0; length < n; length += 17)
        assert_int_not_equal(open_bytes(bytes, length), WT_OK);
}

/* Bytes of the samples or the note are missing, and others follow the labels: these are not
 * names. */
static void test_shifted(void **state)
{
    (void)state;
    unsigned char bytes[4096];
    const ibw_writer_file f = usual(PARTED);
    assert_int_equal(ibw_write(&f), 0);
    const size_t n = read_bytes(bytes, sizeof bytes);
    for (size_t lost = 1; lost < 32; lost += 5) {
        unsigned char copy[sizeof bytes] = {0};
        memcpy(copy, bytes, 400);
        memcpy(copy + 400, bytes + 400 + lost, n - 400 - lost);
        assert_int_equal(open_bytes(copy, n), WT_E_CORRUPT);
    }
}

/* A wave of version 2 is named; one with inconsistent sizes is unknown. */
static void test_old(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        unsigned char bytes[16 + 110 + 40 + 16] = {0};
        bytes[big] = 2;
        bytes[2 + 3 * big] = 110 + 40 + 16;
        FILE *out = fopen(path, "wb");
        assert_non_null(out);
        assert_int_equal(fwrite(bytes, 1, sizeof bytes, out), sizeof bytes);
        assert_int_equal(fclose(out), 0);
        assert_refused(WT_E_UNSUPPORTED, "export the curve as text");
        assert_int_equal(open_bytes(bytes, sizeof bytes - 1), WT_E_FORMAT);
    }
}

/* The common parser of header numbers reads a number of the note. */
static void test_inconsistencies(void **state)
{
    (void)state;
    static const struct {
        const char *calibration, *words;
        double spring_constant;
    } notes[] = {
        {"SpringConstant: 0.5\rInvOLS: 5e-08\r", NULL, 0.5},
        {"SpringConstant: 0.5\rSpringConstant: 0.5001\r", NULL, 0.5},
        {"SpringConstant: 0,5\r", NULL, 0.5},
        {"SpringConstant: 0.5 N/m, thermal noise of 2019\r", NULL, 0.5},
        {"SpringConstant: 0.25\rOther: 1\rSpringConstant: 0.3\r",
         "states SpringConstant twice, 0.25 in line 1 and 0.3 here", 0.25},
        {"SpringConstant: 0.25 0.3 N/m\r", "\"0.25 0.3 N/m\" states two values", (double)NAN},
        {"SpringConstant: 0.25 N/m 0.3 N/m\r", "states two values", (double)NAN},
        {"SpringConstant: 1.234,5\r", "is not one number", (double)NAN}};
    for (size_t i = 0; i < sizeof notes / sizeof *notes; i++) {
        char note[256];
        snprintf(note, sizeof note, "%sIndexes: 0,4,6\rDirection: NaN,1,-1,\r",
                 notes[i].calibration);
        const ibw_writer_file f = usual(note);
        wt_read_options options = wt_read_defaults();
        reading r;
        options.want = WT_Q_BIT(WT_Q_HEIGHT);
        assert_int_equal(ibw_write(&f), 0);
        assert_int_equal(open_force(&r, path, &options), WT_OK);
        next_curve(&r);
        if (isnan(notes[i].spring_constant))
            assert_true(isnan(r.curve.cantilever.spring_constant));
        else
            assert_near(r.curve.cantilever.spring_constant, notes[i].spring_constant, 0);
        assert_int_equal(wt_log_count(r.log), notes[i].words != NULL);
        if (notes[i].words != NULL) {
            const wt_log_entry entry = wt_log_get(r.log, 0);
            assert_true(has_logged(&r, notes[i].words));
            assert_non_null(strstr(entry.place, "of the note"));
            assert_int_equal(entry.action, WT_CONTRADICTED);
        }
        close_all(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_inconsistencies), cmocka_unit_test(test_curve),
        cmocka_unit_test(test_turning_point),   cmocka_unit_test(test_trigger),
        cmocka_unit_test(test_refused),         cmocka_unit_test(test_shifted),
        cmocka_unit_test(test_damaged),         cmocka_unit_test(test_old)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
