/* Height images of every format: files written byte by byte here, and measured ones.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

#include "read/images.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>

enum { COLUMNS = 5, ROWS = 3, ROOM = 8192 };

/* Bytes of a growing file. */
typedef struct made {
    unsigned char bytes[ROOM];
    size_t n;
} made;

static void put(made *m, uint64_t value, size_t width, bool big)
{
    assert_true(m->n + width <= ROOM);
    for (size_t i = 0; i < width; i++)
        m->bytes[m->n + (big ? width - 1 - i : i)] = (unsigned char)(value >> (8 * i) & 0xff);
    m->n += width;
}

static void put_float(made *m, float value, bool big)
{
    uint32_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    put(m, bits, 4, big);
}

static void put_double(made *m, double value, bool big)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    put(m, bits, 8, big);
}

__attribute__((format(printf, 2, 3))) static void put_text(made *m, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    m->n += (size_t)vsnprintf((char *)m->bytes + m->n, ROOM - m->n, format, values);
    va_end(values);
    assert_true(m->n < ROOM);
}

static void fill(made *m, size_t to)
{
    while (m->n < to)
        put(m, 0, 1, false);
}

/* Height of a pixel in nm, line 0 at the bottom. */
static int height(size_t column, size_t row)
{
    return (int)(10 * row + column) - 12;
}

/* Image `which` of the file has the heights; a part of the file is refused. */
static void check(const made *m, size_t n, size_t which, const char *name, double pitch)
{
    wt_image *images = NULL;
    size_t found = 0;
    wt_error err = WT_ERROR_INIT;
    if (read_images_of(m->bytes, m->n, "made", NULL, &images, &found, &err) != WT_OK)
        fail_msg("%s; %s; %s", err.message, err.expected, err.found);
    assert_int_equal(found, n);
    const wt_image *image = &images[which];
    assert_string_equal(image->name, name);
    assert_string_equal(image->unit, "m");
    assert_int_equal(image->n_columns, COLUMNS);
    assert_int_equal(image->n_rows, ROWS);
    assert_near(image->width, (COLUMNS - 1) * pitch, 1e-12);
    assert_near(image->height, (ROWS - 1) * pitch, 1e-12);
    for (size_t row = 0; row < ROWS; row++)
        for (size_t column = 0; column < COLUMNS; column++)
            assert_near(image->values[row * COLUMNS + column], 1e-9 * height(column, row), 1e-6);
    clear_images(images, found);
    for (size_t cut = 1; cut < m->n; cut += 3) {
        made part = *m;
        part.n -= cut;
        assert_int_not_equal(
            read_images_of(part.bytes, part.n, "made", NULL, &images, &found, NULL), WT_OK);
        assert_null(images);
    }
}

static void simple_field(void **state)
{
    (void)state;
    made m = {.n = 0};
    put_text(&m,
             "Gwyddion Simple Field 1.0\nXRes = %d\n YRes=%d\nXReal = 5\nYReal = 3\n"
             "XYUnits = um\nZUnits = nm\nTitle = Height of a spot\nOther = 7\n",
             COLUMNS, ROWS);
    do
        put(&m, 0, 1, false);
    while (m.n % 4 != 0);
    for (size_t row = ROWS; row-- > 0;) /* the uppermost line first */
        for (size_t column = 0; column < COLUMNS; column++)
            put_float(&m, (float)height(column, row), false);
    check(&m, 1, 0, "Height of a spot", 1e-6);
}

/* Samples of each type, scaled by the header. The units of the area and of the heights differ, and
 * are in Latin-1. */
static void wsxm_image(void **state)
{
    static const struct {
        const char *type, *width, *height, *range;
        size_t sample;
    } files[] = {{"", "5 \xb5m", "3000 nm", "240 \xc5", 2},
                 {"Image Data Type: short\r\n", "5 \xb5m", "3 \xb5m", "24 nm", 2},
                 {"Image Data Type: integer\r\n", "5000 nm", "3 \xc2\xb5m", "24000 pm", 4},
                 {"Image Data Type: float\r\n", "50000 \xc5", "3 um", "24 nm", 4},
                 {"Image Data Type: double\r\n", "0.005 mm", "3 um", "0.024 \xb5m", 8}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        enum { HEADER = 400 };
        made m = {.n = 0};
        put_text(&m,
                 "WSxM file copyright Nanotec Electronica\r\nSxM Image file\r\n"
                 "Image header size: %d\r\n\r\n[Control]\r\n\r\n    X Amplitude: %s\r\n"
                 "    Y Amplitude: %s\r\n\r\n[General Info]\r\n\r\n"
                 "    Acquisition channel: Topography\r\n    %s    Number of columns: %d\r\n"
                 "    Number of rows: %d\r\n    Z Amplitude: %s\r\n\r\n[Header end]\r\n",
                 HEADER, files[i].width, files[i].height, files[i].type, COLUMNS, ROWS,
                 files[i].range);
        fill(&m, HEADER);
        for (size_t row = 0; row < ROWS; row++)
            for (size_t column = COLUMNS; column-- > 0;) { /* the last column first */
                const int value = 3 * height(column, row);
                if (files[i].sample == 8)
                    put_double(&m, value, false);
                else if (strstr(files[i].type, "float") != NULL)
                    put_float(&m, (float)value, false);
                else
                    put(&m, (uint64_t)(int64_t)value, files[i].sample, false);
            }
        check(&m, 1, 0, "Topography", 1e-6);
    }
}

/* A height of 16 bits and one of 32; the deflection stays in volts. */
static void nanoscope_image(void **state)
{
    (void)state;
    enum { DATA = 4096, SIZE = COLUMNS * ROWS };
    for (size_t width = 2; width <= 4; width += 2) {
        made m = {.n = 0};
        const bool phase = width == 4; /* another first line, and a micro sign in Latin-1 */
        put_text(&m,
                 "\\*%sFile list\r\n\\Version: 0x08150300\r\n\\*Scanner list\r\n"
                 "\\@Sens. Zsens: V 10.00000 nm/V\r\n\\*Ciao scan list\r\n\\Scan Size: 9 nm\r\n"
                 "\\@Sens. DeflSens: V 40.00000 nm/V\r\n",
                 phase ? "EC " : "");
        for (int i = 0; i < 2; i++)
            put_text(&m,
                     "\\*Ciao image list\r\n\\Data offset: %d\r\n\\Data length: %d\r\n"
                     "\\Bytes/pixel: 2\r\n\\Samps/line: %d\r\n\\Number of lines: %d\r\n"
                     "\\Scan Size: %s\r\n\\Line Direction: Trace\r\n"
                     "\\@2:Image Data: S [%s] \"%s\"\r\n"
                     "\\@2:Z scale: V [Sens. %s] (0.006713867 V/LSB) 6.5536 %s\r\n",
                     DATA + i * SIZE * (int)width, SIZE * (int)width, COLUMNS, ROWS,
                     phase ? "0.5 0.3 \265m" : "500 300 nm", i == 0 ? "DeflectionError" : "Height",
                     i == 1  ? "Height"
                     : phase ? "Phase"
                             : "Deflection Error",
                     i == 0 ? "DeflSens" : "Zsens", i == 0 && phase ? "\260" : "V");
        put_text(&m, "\\*File list end\r\n\032");
        fill(&m, DATA);
        for (size_t i = 0; i < SIZE; i++)
            put(&m, 100, width, false);
        /* A count of 16 bits is 6.5536 V x 10 nm/V / 65536 = 1 pm. */
        for (size_t i = 0; i < SIZE; i++)
            put(&m,
                (uint64_t)(1000LL * height(i % COLUMNS, i / COLUMNS) * (width == 2 ? 1 : 65536)),
                width, false);
        check(&m, 2, 1, "Height, Trace", 100e-9);
        wt_image *images = NULL;
        size_t n = 0;
        assert_int_equal(read_images_of(m.bytes, m.n, "made", NULL, &images, &n, NULL), WT_OK);
        assert_string_equal(images[0].unit, phase ? "deg" : "V");
        assert_near(images[0].values[0], 100 * 6.5536 / (width == 2 ? 65536.0 : 4294967296.0),
                    1e-12);
        clear_images(images, n);
        for (size_t i = 0; i < width; i++) /* the least count was not measured */
            m.bytes[DATA + i] = i + 1 < width ? 0 : 0x80;
        assert_int_equal(read_images_of(m.bytes, m.n, "made", NULL, &images, &n, NULL), WT_OK);
        assert_true(isnan(images[0].values[0]));
        assert_true(images[0].values[1] > 0);
        clear_images(images, n);
    }
}

/* Both byte orders; the second of two channels. */
static void igor_image(void **state)
{
    (void)state;
    static const char note[] = "ImagingMode: 1\r";
    for (int big = 0; big < 2; big++) {
        made m = {.n = 0};
        const size_t samples = (size_t)4 * COLUMNS * ROWS * 2;
        put(&m, 5, 2, big);
        put(&m, 0, 2, big);
        put(&m, 320 + samples, 4, big);
        put(&m, 0, 4, big);
        put(&m, sizeof note - 1, 4, big);
        fill(&m, 44);
        put(&m, 32 * 3, 4, big); /* labels of the third dimension */
        fill(&m, 64 + 12);
        put(&m, COLUMNS * ROWS * 2, 4, big);
        put(&m, 2, 2, big);
        fill(&m, 64 + 68);
        put(&m, COLUMNS, 4, big);
        put(&m, ROWS, 4, big);
        put(&m, 2, 4, big);
        put(&m, 0, 4, big);
        put_double(&m, 50e-9, big);
        put_double(&m, 50e-9, big);
        fill(&m, 384);
        for (int channel = 0; channel < 2; channel++)
            for (size_t row = 0; row < ROWS; row++)
                for (size_t column = 0; column < COLUMNS; column++)
                    put_float(&m, channel == 0 ? 7 : 1e-9F * (float)height(column, row), big);
        put_text(&m, "%s", note);
        fill(&m, m.n + 32);
        put_text(&m, "PhaseRetrace");
        fill(&m, 384 + samples + sizeof note - 1 + 64);
        put_text(&m, "HeightRetrace");
        fill(&m, 384 + samples + sizeof note - 1 + 96);
        unsigned sum = 0;
        for (size_t i = 0; i < 384; i += 2)
            sum += big ? m.bytes[i] * 256u + m.bytes[i + 1] : m.bytes[i + 1] * 256u + m.bytes[i];
        made check_sum = {.n = 2};
        put(&check_sum, 0x10000 - (sum & 0xffff), 2, big);
        memcpy(m.bytes + 2, check_sum.bytes + 2, 2);
        check(&m, 2, 1, "HeightRetrace", 50e-9);
    }
}

/* The header with 16 bits, or longer with a type: floats. */
static void park_image(void **state)
{
    (void)state;
    for (int floats = 0; floats < 2; floats++) {
        made m = {.n = 0}, header = {.n = 4};
        const size_t size = floats ? 352 : 260, data = (floats ? 4 : 2) * COLUMNS * ROWS;
        const char name[] = "Topography", unit[] = "um";
        for (size_t i = 0; i < sizeof name - 1; i++)
            put(&header, (unsigned char)name[i], 2, false);
        fill(&header, 100);
        put(&header, COLUMNS, 4, false);
        put(&header, ROWS, 4, false);
        fill(&header, 140);
        put_double(&header, 1e-1 * COLUMNS, false);
        put_double(&header, 1e-1 * ROWS, false);
        fill(&header, 220);
        put_double(&header, -2e-3, false); /* gain, scale, offset */
        put_double(&header, floats ? 0 : 0.5, false);
        put_double(&header, 1, false);
        for (size_t i = 0; i < sizeof unit - 1; i++)
            put(&header, (unsigned char)unit[i], 2, false);
        fill(&header, 348);
        put(&header, 2, 4, false);
        put_text(&m, "II*");
        put(&m, 0, 1, false);
        put(&m, 8, 4, false);
        put(&m, 3, 2, false);
        const size_t at = 10 + 36 + 4;
        const size_t tags[3][4] = {
            {50432, 4, 1, 0x0e031301}, {50434, 1, data, at + size}, {50435, 7, size, at}};
        for (size_t i = 0; i < 3; i++) {
            put(&m, tags[i][0], 2, false);
            put(&m, tags[i][1], 2, false);
            put(&m, tags[i][2], 4, false);
            put(&m, tags[i][3], 4, false);
        }
        put(&m, 0, 4, false);
        memcpy(m.bytes + m.n, header.bytes, size);
        m.n += size;
        for (size_t row = 0; row < ROWS; row++)
            for (size_t column = 0; column < COLUMNS; column++) {
                const double raw = height(column, row) / -2.0 - 1; /* nm = -2 (scale raw + 1) */
                if (floats)
                    put_float(&m, (float)raw, false);
                else
                    put(&m, (uint64_t)(int64_t)(2 * raw), 2, false);
            }
        check(&m, 1, 0, "Topography", 100e-9);
    }
}

/* A row of a measured field by another program (topography-rows.csv, row 50). */
static void measured(void **state)
{
    (void)state;
    static const double row[] = {1.244444370270e+00, 1.215632915497e+00, 1.212666034698e+00,
                                 1.194503784180e+00};
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0;
    if (wt_input_open(WT_SHARED_DIR "/data/topography/whitelight.gsf", &input, NULL) != WT_OK) {
        skip();
        return;
    }
    assert_int_equal(wt_images_read(formats, input, NULL, NULL, &images, &n, NULL), WT_OK);
    wt_input_close(input);
    assert_int_equal(n, 1);
    assert_string_equal(images[0].unit, "1");
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        assert_near(images[0].values[(images[0].n_rows - 1 - 50) * images[0].n_columns + i], row[i],
                    1e-11);
    clear_images(images, n);
    assert_int_equal(
        wt_input_open(WT_SHARED_DIR "/data/afm-more/ForceCurve_009.tiff", &input, NULL), WT_OK);
    assert_int_equal(wt_images_read(formats, input, NULL, NULL, &images, &n, NULL), WT_OK);
    wt_input_close(input);
    assert_int_equal(images[0].n_columns, 256);
    assert_near(images[0].width, 3.25e-6 * 255 / 256, 1e-12);
    assert_string_equal(images[0].unit, "m");
    clear_images(images, n);
}

/* ---- the list that readers fill -------------------------------------------------------------- */

static void test_list(void **state)
{
    (void)state;
    image_list list = {NULL, 0};
    double *values = NULL;
    wt_error err = WT_ERROR_INIT;
    static const size_t impossible[][2] = {{0, 3},
                                           {3, 0},
                                           {((size_t)1 << 28) + 1, 1},
                                           {1, ((size_t)1 << 28) + 1},
                                           {1 << 14, (1 << 14) + 1}};
    for (size_t i = 0; i < sizeof impossible / sizeof *impossible; i++) {
        const wt_image head = {.n_columns = impossible[i][0], .n_rows = impossible[i][1]};
        char found[64];
        snprintf(found, sizeof found, "%zu x %zu", impossible[i][0], impossible[i][1]);
        assert_int_equal(images_add(&list, &head, &values, &err), WT_E_CORRUPT);
        assert_string_equal(err.found, found);
        assert_string_equal(err.expected, "1 to 268435456 pixels");
        assert_int_equal(list.n, 0);
    }
    for (size_t i = 0; i < 3; i++) {
        wt_image head = {.n_columns = 2 + i, .n_rows = 3};
        snprintf(head.name, sizeof head.name, "image %zu", i);
        assert_int_equal(images_add(&list, &head, &values, &err), WT_OK);
        assert_int_equal(list.n, i + 1);
        assert_ptr_equal(list.images[i].values, values);
        for (size_t k = 0; k < 3 * (2 + i); k++)
            values[k] = (double)(10 * i + k);
    }
    wt_image *images = NULL;
    size_t n = 7;
    assert_int_equal(images_finish(&list, WT_OK, "file", NULL, &images, &n, &err), WT_OK);
    assert_int_equal(n, 3);
    assert_int_equal(list.n, 0);
    assert_null(list.images);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(images[i].n_columns, 2 + i);
        assert_near(images[i].values[5], (double)(10 * i + 5), 0);
    }
    clear_images(images, n);
    images = NULL;
    assert_int_equal(images_finish(&list, WT_OK, "file", NULL, &images, &n, &err), WT_E_EMPTY);
    assert_string_equal(err.message, "the file holds no image");
    const wt_image head = {.n_columns = 2, .n_rows = 2};
    assert_int_equal(images_add(&list, &head, &values, &err), WT_OK);
    assert_int_equal(images_finish(&list, WT_E_CORRUPT, "file", NULL, &images, &n, &err),
                     WT_E_CORRUPT);
    assert_int_equal(list.n, 0);
    assert_null(images);
}

static void test_size(void **state)
{
    (void)state;
    wt_image head = {.n_columns = 5, .n_rows = 4};
    images_set_size(&head, 10e-6, 8e-6);
    assert_near(head.width, 8e-6, 1e-12);
    assert_near(head.height, 6e-6, 1e-12);
}

/* Stated options replace missing values of the file; differing values cause a warning. */
static void test_given(void **state)
{
    (void)state;
    double values[] = {1, 2, 3, 4, 5, 6};
    wt_image image = {.name = "Z",
                      .unit = "1",
                      .n_columns = 3,
                      .n_rows = 2,
                      .x_unit = "m",
                      .width = (double)NAN,
                      .height = (double)NAN,
                      .values = values};
    wt_read_options given = wt_read_defaults();
    wt_log *log = wt_log_new();
    given.pixel_size = 2e-6;
    given.height_unit = "nm";
    assert_int_equal(images_apply_options(&image, 1, &given, "file", log, NULL), WT_OK);
    assert_int_equal(wt_log_count(log), 0);
    assert_near(image.width, 4e-6, 1e-12);
    assert_near(image.height, 2e-6, 1e-12);
    assert_near(values[5], 6e-9, 1e-12);
    assert_string_equal(image.unit, "m");
    given.pixel_size = 3e-6;
    assert_int_equal(images_apply_options(&image, 1, &given, "file", log, NULL), WT_OK);
    assert_near(values[5], 6e-9, 1e-12); /* a length already */
    assert_near(image.width, 6e-6, 1e-12);
    assert_int_equal(wt_log_count(log), 1);
    assert_non_null(strstr(wt_log_get(log, 0).text, "another size"));
    snprintf(image.unit, sizeof image.unit, "V");
    assert_int_equal(images_apply_options(&image, 1, &given, "file", log, NULL), WT_OK);
    assert_int_equal(wt_log_count(log), 2);
    assert_non_null(strstr(wt_log_get(log, 1).text, "in V"));
    given.height_unit = "apples";
    snprintf(image.unit, sizeof image.unit, "V");
    assert_int_equal(images_apply_options(&image, 1, &given, "file", log, NULL), WT_E_UNIT);
    wt_log_free(log);
}

/* Missing data are reported: the number of pixels, and an invalid size. */
static void test_missing(void **state)
{
    (void)state;
    static const struct {
        size_t columns, rows, missing;
        double width, height;
        const char *words; /* text of the last log entry; NULL: none */
    } cases[] = {
        {4, 3, 0, 1, 1, NULL},
        {4, 3, 1, 1, 1, "1 of 12 pixels are not finite numbers and left out"},
        {4, 3, 2, 1, 0, "the size of the image is not known; --pixel-size gives it"},
        {4, 3, 0, -1, 1, "the size of the image is not known; --pixel-size gives it"},
        {4, 1, 0, 1, 0, NULL},
        {1, 3, 0, 0, 1, NULL},
        {4, 3, 0, (double)NAN, 1, "the size of the image is not known; --pixel-size gives it"},
        {4, 3, 0, 1, (double)INFINITY, "the size of the image is not known; --pixel-size gives it"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        image_list list = {NULL, 0};
        double *values = NULL;
        wt_image *images = NULL;
        size_t n = 0;
        wt_log *log = wt_log_new();
        const wt_image head = {.name = "Z",
                               .n_columns = cases[i].columns,
                               .n_rows = cases[i].rows,
                               .width = cases[i].width,
                               .height = cases[i].height};
        assert_int_equal(images_add(&list, &head, &values, NULL), WT_OK);
        for (size_t k = 0; k < head.n_columns * head.n_rows; k++)
            values[k] = k < cases[i].missing ? (k == 0 ? (double)NAN : (double)INFINITY) : 1;
        assert_int_equal(images_finish(&list, WT_OK, "file", log, &images, &n, NULL), WT_OK);
        const wt_read_options nothing = wt_read_defaults();
        assert_int_equal(images_apply_options(images, n, &nothing, "file", log, NULL), WT_OK);
        const bool unknown = cases[i].words != NULL && strstr(cases[i].words, "size") != NULL;
        const size_t said = (cases[i].missing > 0) + (size_t)unknown;
        assert_int_equal(wt_log_count(log), said);
        for (size_t k = 0; k < head.n_columns * head.n_rows; k++)
            assert_int_equal(isnan(images[0].values[k]), k < cases[i].missing);
        if (cases[i].words != NULL) {
            assert_string_equal(wt_log_get(log, said - 1).text, cases[i].words);
            assert_string_equal(wt_log_get(log, said - 1).file, "file");
            assert_string_equal(wt_log_get(log, said - 1).place, "Z");
        }
        assert_int_equal(isnan(images[0].width) || isnan(images[0].height), unknown);
        clear_images(images, n);
        wt_log_free(log);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_list),    cmocka_unit_test(test_size),
        cmocka_unit_test(test_given),   cmocka_unit_test(test_missing),
        cmocka_unit_test(simple_field), cmocka_unit_test(nanoscope_image),
        cmocka_unit_test(igor_image),   cmocka_unit_test(park_image),
        cmocka_unit_test(wsxm_image),   cmocka_unit_test(measured),
    };
    return cmocka_run_group_tests(tests, set_up, clean);
}
