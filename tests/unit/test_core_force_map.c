/* Maps of force curves in HDF5. Stored values are read back bit by bit, and HDF5 alone reads the
 * file as weartrack-hdf5(5) describes. A changed sample only affects its curve; inconsistent counts
 * are refused. */
#include "core/store/force_map.h"
#include "core/store/hdf5_sandbox.h"
#include "weartrack/read.h"

#include <endian.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

enum { CURVES = 40, MOST = 1500 };

static const char path[] = "test_data_map.h5";

/* Segments of 100 to 1500 samples, so that blocks end within them; curves from 20 on have the third
 * quantity. */
static size_t length_of(size_t curve, size_t segment)
{
    return 100 + (curve * 37 + segment * 501) % (MOST - 100);
}

static double value_of(size_t curve, size_t segment, size_t channel, size_t i)
{
    return sin((double)(curve * 7919 + segment * 104729 + i) * 0.1) * pow(10, -(double)channel * 5);
}

static void make_curve(size_t c, wt_force_curve *curve)
{
    static const wt_quantity quantities[] = {WT_Q_MEASURED_HEIGHT, WT_Q_FORCE, WT_Q_TIME};
    wt_force_curve_reset(curve);
    curve->index = 3 * c;
    curve->x = 1e-6 * (double)c;
    curve->y = (double)NAN;
    curve->grid_x = (long)c % 8;
    curve->grid_y = (long)c / 8;
    curve->cantilever.spring_constant = 0.1;
    curve->cantilever.sensitivity = -60e-9; /* missing, so that it is read as NaN */
    for (size_t s = 0; s < 2; s++) {
        const size_t n = length_of(c, s), n_channels = c < 20 ? 2 : 3;
        wt_segment *const segment = wt_force_curve_add_segment(
            curve, s == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT, n, n_channels);
        assert_non_null(segment);
        segment->index = s;
        segment->duration = 0.1 * (double)n;
        segment->velocity = (double)NAN;
        segment->setpoint = 1e-9;
        for (size_t k = 0; k < n_channels; k++) {
            segment->channels[k].quantity = quantities[k];
            (void)snprintf(segment->channels[k].name, sizeof segment->channels[k].name, "ch%zu", k);
            for (size_t i = 0; i < n; i++)
                segment->channels[k].values[i] = value_of(c, s, k, i);
        }
    }
}

static int write_map(void **state)
{
    wt_map_writer *writer = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_result *const result = wt_result_new();
    (void)state;
    assert_int_equal(wt_map_open(path, &writer, NULL), WT_OK);
    for (size_t c = 0; c < CURVES; c++) {
        make_curve(c, &curve);
        assert_int_equal(wt_map_add_curve(writer, &curve, NULL), WT_OK);
    }
    assert_int_equal(access(path, F_OK), -1); /* before it is complete */
    assert_int_equal(wt_map_commit(writer, result, false, NULL), WT_OK);
    wt_force_curve_clear(&curve);
    wt_result_free(result);
    return 0;
}

static int clean(void **state)
{
    (void)state;
    return unlink(path);
}

/* Reads all curves; returns the number of failures and the first failed curve. */
static size_t read_back(size_t *first_bad)
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0}, expected = {.n_segments = 0};
    size_t n_bad = 0, c = 0;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
    assert_int_equal(wt_force_open(formats, input, NULL, NULL, &source, &err), WT_OK);
    assert_int_equal(wt_force_count(source), CURVES);
    for (wt_status got; (got = wt_force_next(source, &curve, &err)) != WT_END; c++) {
        if (got != WT_OK) {
            assert_int_equal(got, WT_E_CORRUPT);
            assert_int_equal(curve.index, 3 * c);
            *first_bad = n_bad++ == 0 ? c : *first_bad;
            continue;
        }
        make_curve(c, &expected);
        assert_true(curve.index == 3 * c && curve.n_segments == 2 && curve.x == expected.x &&
                    isnan(curve.y) && curve.grid_x == expected.grid_x &&
                    curve.grid_y == expected.grid_y && curve.cantilever.spring_constant == 0.1 &&
                    isnan(curve.cantilever.sensitivity));
        for (size_t s = 0; s < 2; s++) {
            const wt_segment *const a = &curve.segments[s], *const b = &expected.segments[s];
            assert_true(a->kind == b->kind && a->n_points == b->n_points && a->index == s &&
                        a->n_channels == b->n_channels && a->duration == b->duration &&
                        isnan(a->velocity) && a->setpoint == 1e-9);
            for (size_t k = 0; k < b->n_channels; k++) {
                const wt_channel *const x = wt_segment_channel(a, b->channels[k].quantity);
                assert_non_null(x);
                assert_string_equal(x->name, b->channels[k].name);
                assert_memory_equal(x->values, b->channels[k].values,
                                    b->n_points * sizeof *x->values);
            }
        }
    }
    assert_int_equal(c, CURVES);
    wt_force_curve_clear(&curve);
    wt_force_curve_clear(&expected);
    wt_force_close(source);
    wt_input_close(input);
    wt_formats_free(formats);
    return n_bad;
}

static void map_is_read_back(void **state)
{
    size_t bad = 0;
    (void)state;
    assert_int_equal(read_back(&bad), 0);
}

static size_t length_in(hid_t file, const char *name)
{
    const hid_t data = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(data);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    hdf5_close(space);
    hdf5_close(data);
    return (size_t)n;
}

static void layout_is_documented(void **state)
{
    static double force[2 * CURVES * MOST], samples[2 * CURVES];
    size_t n = 0, row = 0;
    (void)state;
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    for (size_t c = 0; c < CURVES; c++)
        n += length_of(c, 0) + length_of(c, 1);
    assert_int_equal(length_in(file, "force_map/samples/force"), n);
    assert_int_equal(length_in(file, "force_map/samples/time"), n);
    assert_int_equal(length_in(file, "force_map/curves/checksum"), CURVES);
    assert_int_equal(length_in(file, "force_map/segments/samples"), 2 * CURVES);
    const hid_t counts = H5Dopen2(file, "force_map/segments/samples", H5P_DEFAULT);
    const hid_t forces = H5Dopen2(file, "force_map/samples/force", H5P_DEFAULT);
    assert_true(H5Dread(counts, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples) >= 0);
    assert_true(H5Dread(forces, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, force) >= 0);
    n = 0;
    for (size_t c = 0; c < CURVES; c++)
        for (size_t s = 0; s < 2; s++, row++) {
            assert_true(samples[row] == (double)length_of(c, s));
            for (size_t i = 0; i < length_of(c, s); i++)
                assert_true(force[n++] == value_of(c, s, 1, i));
        }
    hdf5_close(counts);
    hdf5_close(forces);
    (void)H5Fclose(file);
}

/* Bytes of a number in the file, which occur once. */
static off_t find_number(int fd, double value)
{
    static char bytes[1 << 23];
    const ssize_t n = pread(fd, bytes, sizeof bytes, 0);
    assert_true(n > 0 && (size_t)n < sizeof bytes);
    const char *const found = memmem(bytes, (size_t)n, &value, sizeof value);
    assert_non_null(found);
    return found - bytes;
}

static void a_changed_sample(void **state)
{
    size_t bad = 0;
    (void)state;
    const int fd = open(path, O_RDWR);
    const double before = value_of(17, 1, 1, 50), after = 1.0000001 * before;
    const off_t at = find_number(fd, before);
    assert_int_equal(pwrite(fd, &after, sizeof after, at), sizeof after);
    assert_int_equal(read_back(&bad), 1);
    assert_int_equal(bad, 17);
    assert_int_equal(pwrite(fd, &before, sizeof before, at), sizeof before);
    (void)close(fd);
    assert_int_equal(read_back(&bad), 0);
}

/* Tables that do not fit the arrays, with a correct digest. */
static void counts(void **state)
{
    static const struct {
        const char *table, *column;
        double value;
    } cases[] = {
        {"force_map/segments", "samples", 1e6},   {"force_map/segments", "samples", -1},
        {"force_map/segments", "samples", 1e300}, {"force_map/segments", "samples", 100.5},
        {"force_map/segments", "number", -3},     {"force_map/curves", "segments", 3},
        {"force_map/curves", "segments", 1e18},   {"force_map/curves", "segments", (double)NAN},
        {"force_map/curves", "curve", -1}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_result *result = NULL;
        map_reader *map = NULL;
        wt_error err = WT_ERROR_INIT;
        const int fd = open(path, O_RDONLY);
        const hdf5_bytes from = {.file = fd, .size = (size_t)lseek(fd, 0, SEEK_END)};
        assert_int_equal(wt_store_read(path, &result, NULL), WT_OK);
        /* changes its last row after the reader has started */
        wt_table *const table = (wt_table *)(uintptr_t)wt_result_find(result, cases[i].table);
        wt_table_set_number(table, (size_t)wt_table_find(table, cases[i].column), cases[i].value);
        wt_status status = map_open(&from, result, &map, &err);
        assert_int_equal(status, WT_E_CORRUPT);
        assert_true(err.message[0] != '\0');
        (void)close(fd);
    }
}

/* A file truncated after its tables were read: every remaining curve fails. */
static void truncated_map(void **state)
{
    wt_result *result = NULL;
    map_reader *map = NULL;
    const map_segment *segments = NULL;
    wt_force_curve curve = {.n_segments = 0};
    size_t n = 0, n_bad = 0;
    wt_error err = WT_ERROR_INIT;
    wt_status got = WT_OK;
    (void)state;
    const int fd = open(path, O_RDONLY);
    /* The summary follows the HDF5 data and states its length. */
    const off_t size = lseek(fd, 0, SEEK_END);
    uint64_t abstract = 0;
    assert_int_equal(pread(fd, &abstract, sizeof abstract, size - 16), sizeof abstract);
    const hdf5_bytes from = {.file = fd, .size = (size_t)size - 16 - le64toh(abstract) - 8};
    assert_int_equal(wt_store_read(path, &result, NULL), WT_OK);
    assert_int_equal(map_open(&from, result, &map, &err), WT_OK);
    for (; (got = map_next_curve(map, &curve, &segments, &n, &err)) != WT_END; n_bad++) {
        assert_int_equal(got, WT_E_CORRUPT);
        assert_int_equal(curve.index, 3 * n_bad);
        assert_non_null(strstr(err.message, "damaged or cut off"));
        err = (wt_error)WT_ERROR_INIT;
    }
    assert_int_equal(n_bad, CURVES);
    map_close(map);
    (void)close(fd);
}

static void no_disk(void **state)
{
    wt_map_writer *writer = NULL;
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(wt_map_open("/dev/full", &writer, &err), WT_E_IO);
    assert_int_equal(wt_map_open("no/such/folder.h5", &writer, &err), WT_E_IO);
    assert_null(writer);
}

/* After a failure no more data are accepted, and there is no file. */
static void a_full_disk(void **state)
{
    static const char small[] = "test_data_map_full.h5";
    wt_map_writer *writer = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_result *const result = wt_result_new();
    struct rlimit usual, little;
    wt_status status = WT_OK;
    (void)state;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &usual), 0);
    little = (struct rlimit){1 << 18, usual.rlim_max};
    (void)signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(wt_map_open(small, &writer, NULL), WT_OK);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
    for (size_t c = 0; status == WT_OK && c < 100 * (size_t)CURVES; c++) {
        make_curve(c % CURVES, &curve);
        status = wt_map_add_curve(writer, &curve, NULL);
    }
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &usual), 0);
    assert_int_equal(status, WT_E_IO);
    assert_int_equal(wt_map_add_curve(writer, &curve, NULL), WT_E_IO);
    assert_int_equal(wt_map_commit(writer, result, false, NULL), WT_E_IO);
    assert_int_equal(access(small, F_OK), -1);
    wt_force_curve_clear(&curve);
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(map_is_read_back),
        cmocka_unit_test(truncated_map),
        cmocka_unit_test(layout_is_documented),
        cmocka_unit_test(a_changed_sample),
        cmocka_unit_test(counts),
        cmocka_unit_test(no_disk),
        cmocka_unit_test(a_full_disk),
    };
    return cmocka_run_group_tests_name("map of force curves", tests, write_map, clean);
}
