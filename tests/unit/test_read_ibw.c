/* Igor binary waves of Asylum Research: written by an independent writer, damaged, and measured.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "near.h"

#include "weartrack/read.h"
#include "writers/ibw_writer.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define N 7
#define NOTE                                                                                       \
    "SpringConstant: 0.5\rInvOLS: 5e-08\rTriggerChannel:Force\rTriggerPoint: 2e-09\r"              \
    "ImagingMode:Contact\r"
#define PARTED NOTE "Indexes: 0,4,6\rDirection: NaN,1,-1,\r"
static const double raw[N] = {1e-7, 2e-7, 3e-7, 4e-7, 5e-7, 3.5e-7, 2.5e-7};
static const double deflection[N] = {0, 0, 1e-9, 3e-9, 6e-9, 2e-9, -1e-9};
static const double sensor[N] = {2e-7, 3e-7, 4e-7, 5e-7, 6e-7, 4.5e-7, 3.5e-7};
static const char *const labels[] = {"Raw", "Defl", "ZSnsr"};
static const double *const values[] = {raw, deflection, sensor};

static wt_formats *formats;
static char path[] = "/tmp/weartrack-ibw-XXXXXX";

static int set_up(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    return fd < 0 || close(fd) != 0 || wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK ? -1 : 0;
}

static int clean(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return unlink(path);
}

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

static const double *channel(const wt_segment *segment, wt_quantity quantity)
{
    for (size_t i = 0; i < segment->n_channels; i++)
        if (segment->channels[i].quantity == quantity)
            return segment->channels[i].values;
    fail_msg("no %s", wt_quantity_id(quantity));
    return NULL;
}

static wt_status read_curve(const char *file, wt_force_curve *curve, wt_error *err)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve more = {0};
    *err = (wt_error)WT_ERROR_INIT;
    assert_int_equal(wt_input_open(file, &input, err), WT_OK);
    wt_status status = wt_force_open(formats, input, NULL, NULL, &source, err);
    if (status == WT_OK) {
        assert_int_equal(wt_force_count(source), 1);
        status = wt_force_next(source, curve, err);
    }
    if (status == WT_OK)
        assert_int_equal(wt_force_next(source, &more, err), WT_END);
    wt_force_close(source);
    wt_input_close(input);
    return status;
}

static void test_curve(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        ibw_writer_file f = usual(PARTED);
        wt_force_curve curve = {0};
        wt_error err;
        f.big_endian = kind % 2 == 1;
        f.doubles = kind >= 2;
        const double exact = f.doubles ? 1e-15 : 1e-7;
        assert_int_equal(ibw_write(&f), 0);
        if (read_curve(path, &curve, &err) != WT_OK)
            fail_msg("%s; %s", err.message, err.found);
        assert_int_equal(curve.n_segments, 2);
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
        wt_force_curve_clear(&curve);
    }
}

static void refused(const ibw_writer_file *f, wt_status expected, const char *words)
{
    wt_force_curve curve = {0};
    wt_error err;
    assert_int_equal(ibw_write(f), 0);
    const wt_status status = read_curve(path, &curve, &err);
    char all[1000];
    snprintf(all, sizeof all, "%s; %s; %s", err.message, err.expected, err.found);
    if (status != expected || strstr(all, words) == NULL)
        fail_msg("%d: %s", (int)status, all);
    wt_force_curve_clear(&curve);
}

static void test_refused(void **state)
{
    (void)state;
    static const char *const parts[] = {
        "",
        "Indexes: 0,4,7\rDirection: NaN,1,-1\r", /* behind the last sample */
        "Indexes: 0,4,4\rDirection: NaN,1,-1\r",
        "Indexes: 0,4,2\rDirection: NaN,1,-1\r",
        "Indexes: 0,4,6\rDirection: NaN,1\r",
        "Indexes: 0\rDirection: NaN\r",
        "Indexes: -3,4,6\rDirection: NaN,1,-1\r",
        "Indexes: 0,99999999999999999999,6\rDirection: NaN,1,-1\r",
    };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const ibw_writer_file f = usual(parts[i]);
        refused(&f, WT_E_CORRUPT, "approach and retract");
    }
    ibw_writer_file line = usual(PARTED);
    line.n_channels = 0;
    refused(&line, WT_E_EMPTY, "two dimensions");
    ibw_writer_file wide = usual("Indexes: 0,4,6\rDirection: NaN,1,-1\r");
    wide.n_channels = 1; /* neither deflection nor spring constant */
    wt_force_curve curve = {0};
    wt_error err;
    assert_int_equal(ibw_write(&wide), 0);
    assert_int_equal(read_curve(path, &curve, &err), WT_OK);
    assert_int_equal(curve.segments[0].n_channels, 2); /* time and height */
    wt_force_curve_clear(&curve);
}

/* Sizes that lie, and a file that is cut. */
static void test_damaged(void **state)
{
    (void)state;
    static unsigned char bytes[2000];
    static const size_t sizes[] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 64 + 68, 64 + 72};
    ibw_writer_file f = usual(PARTED);
    assert_int_equal(ibw_write(&f), 0);
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t n = fread(bytes, 1, sizeof bytes, in);
    (void)fclose(in);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        wt_input *input = NULL;
        wt_force_source *source = NULL;
        unsigned char copy[sizeof bytes];
        memcpy(copy, bytes, n);
        memset(copy + sizes[i], 0xff, 4);
        ibw_writer_mend(copy, n);
        assert_int_equal(wt_input_open_memory(copy, n, "x", &input, NULL), WT_OK);
        assert_int_not_equal(wt_force_open(formats, input, NULL, NULL, &source, NULL), WT_OK);
        wt_input_close(input);
        copy[3] ^= 1; /* the check sum */
        assert_int_equal(wt_input_open_memory(copy, n, "x", &input, NULL), WT_OK);
        assert_int_not_equal(wt_force_open(formats, input, NULL, NULL, &source, NULL), WT_OK);
        wt_input_close(input);
    }
    for (size_t length = 0; length < n; length += 17) {
        wt_input *input = NULL;
        wt_force_source *source = NULL;
        assert_int_equal(wt_input_open_memory(bytes, length, "x", &input, NULL), WT_OK);
        assert_int_not_equal(wt_force_open(formats, input, NULL, NULL, &source, NULL), WT_OK);
        wt_input_close(input);
    }
}

/* Against the channels that another program reads; skipped where the file is absent. */
static void test_measured(void **state)
{
    (void)state;
    const char *file = WT_SHARED_DIR "/data/afm/asylum/fmt-igor-fd_SiN_FD_plot.ibw";
    wt_force_curve curve = {0};
    wt_error err;
    if (access(file, R_OK) != 0)
        skip();
    assert_int_equal(read_curve(file, &curve, &err), WT_OK);
    assert_int_equal(curve.n_segments, 2);
    const wt_segment *in = &curve.segments[0], *out = &curve.segments[1];
    assert_int_equal(in->n_points, 1008);
    assert_int_equal(out->n_points, 1008);
    assert_near(curve.cantilever.spring_constant, 1.1841, 1e-15);
    assert_near(channel(in, WT_Q_FORCE)[0], -3.87494995477e-09, 1e-11);
    assert_near(channel(out, WT_Q_FORCE)[1007], -3.87056807978e-09, 1e-11);
    assert_near(channel(in, WT_Q_MEASURED_HEIGHT)[0], -1.19569119761e-06, 1e-11);
    assert_near(channel(out, WT_Q_MEASURED_HEIGHT)[1007], -1.22030837701e-06, 1e-11);
    assert_near(channel(in, WT_Q_HEIGHT)[0], -1.19570950119e-06, 1e-11);
    assert_near(channel(out, WT_Q_HEIGHT)[1007], -1.22028825444e-06, 1e-11);
    wt_force_curve_clear(&curve);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_curve), cmocka_unit_test(test_refused),
                                       cmocka_unit_test(test_damaged),
                                       cmocka_unit_test(test_measured)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
