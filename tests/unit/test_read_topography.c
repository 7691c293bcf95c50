/* Height maps of Gwyddion and X3P written byte by byte here, and measured ones against numbers of
 * other programs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

#include "core/base/array.h"
#include "core/system/temporary.h"
#include "fuzz/pack_list.h"
#include "surface/numerics/surface_analysis.h"

#include <ctype.h>
#include <math.h>

/* ---- files written here ---------------------------------------------------------------------- */

enum { ROOM = 8192, COLUMNS = 5, ROWS = 3 };

typedef struct made {
    uint8_t bytes[ROOM];
    size_t n;
} made;

static void add(made *m, const void *bytes, size_t n)
{
    assert_true(m->n + n <= ROOM);
    memcpy(m->bytes + m->n, bytes, n);
    m->n += n;
}

#define ADD(m, text) add(m, text, sizeof(text) - 1) /* without its zero */

static void add_number(made *m, uint64_t value, size_t width)
{
    uint8_t bytes[8];
    (void)put(bytes, (uint32_t)value, 4);
    (void)put(bytes + 4, (uint32_t)(value >> 32), 4);
    add(m, bytes, width);
}

static void add_double(made *m, double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    add_number(m, bits, 8);
}

/* Height of a point, line 0 at the bottom. */
static double height(size_t column, size_t row)
{
    return 1e-9 * ((double)(10 * row + column) - 12);
}

static void check_heights(const wt_image *image, double pitch)
{
    assert_string_equal(image->unit, "m");
    assert_int_equal(image->n_columns, COLUMNS);
    assert_int_equal(image->n_rows, ROWS);
    assert_near(image->width, (COLUMNS - 1) * pitch, 1e-12);
    assert_near(image->height, (ROWS - 1) * pitch, 1e-12);
    for (size_t row = 0; row < ROWS; row++)
        for (size_t column = 0; column < COLUMNS; column++)
            assert_near_abs(image->values[row * COLUMNS + column], height(column, row), 1e-21);
}

static void refused_as(const made *m, wt_status expected, const char *words)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    char all[1000];
    const wt_status status = read_images_of(m->bytes, m->n, "made", NULL, &images, &n, &err);
    snprintf(all, sizeof all, "%s; %s; %s", err.message, err.expected, err.found);
    if (status != expected || strstr(all, words) == NULL)
        fail_msg("%d: %s", (int)status, all);
    assert_null(images);
}

/* ---- Gwyddion -------------------------------------------------------------------------------- */

/* An object with the components in `inside`. */
static void add_object(made *m, const char *name, const made *inside)
{
    add(m, name, strlen(name) + 1);
    add_number(m, inside->n, 4);
    add(m, inside->bytes, inside->n);
}

static void add_unit(made *m, const char *text)
{
    made unit = {.n = 0};
    ADD(&unit, "unitstr\0s");
    add(&unit, text, strlen(text) + 1);
    add_object(m, "GwySIUnit", &unit);
}

static void add_field(made *m, uint32_t columns, uint32_t rows, uint32_t values, double factor)
{
    made field = {.n = 0};
    ADD(&field, "xres\0i");
    add_number(&field, columns, 4);
    ADD(&field, "yres\0i");
    add_number(&field, rows, 4);
    ADD(&field, "strange\0S\2\0\0\0one\0two\0xreal\0d");
    add_double(&field, 5e-6 / factor);
    ADD(&field, "yreal\0d");
    add_double(&field, 3e-6 / factor);
    ADD(&field, "si_unit_xy\0o");
    add_unit(&field, factor < 1e-3 ? "um" : "m");
    ADD(&field, "si_unit_z\0o");
    add_unit(&field, "m");
    ADD(&field, "data\0D");
    add_number(&field, values, 4);
    for (size_t row = ROWS; row-- > 0;) /* the uppermost first */
        for (size_t column = 0; column < COLUMNS; column++)
            add_double(&field, height(column, row));
    add_object(m, "GwyDataField", &field);
}

static made gwy_of(uint32_t columns, uint32_t rows, uint32_t values)
{
    made all = {.n = 0}, inside = {.n = 0};
    ADD(&inside, "filename\0sx\0/0/data\0o");
    add_field(&inside, columns, rows, values, 1);
    ADD(&inside, "/0/mask\0o");
    add_field(&inside, columns, rows, values, 1);
    ADD(&inside, "/0/data/title\0sZ sensor\0/1/data\0o");
    add_field(&inside, columns, rows, values, 1e-6);
    ADD(&all, "GWYP");
    add_object(&all, "GwyContainer", &inside);
    return all;
}

static void test_gwyddion(void **state)
{
    (void)state;
    const made m = gwy_of(COLUMNS, ROWS, COLUMNS * ROWS);
    wt_image *images = NULL;
    size_t n = 0;
    wt_log *log = wt_log_new();
    assert_int_equal(read_images_of(m.bytes, m.n, "made", log, &images, &n, NULL), WT_OK);
    assert_int_equal(n, 2);
    assert_string_equal(images[0].name, "Z sensor");
    assert_string_equal(images[1].name, "/1/data");
    check_heights(&images[0], 1e-6);
    check_heights(&images[1], 1e-6);
    assert_int_equal(wt_log_count(log), 1);
    assert_non_null(strstr(wt_log_get(log, 0).text, "mask"));
    wt_log_free(log);
    clear_images(images, n);
    for (size_t cut = 1; cut < m.n - 4; cut += 7) {
        made part = m;
        part.n -= cut;
        assert_int_not_equal(read_images_of(part.bytes, part.n, "made", NULL, &images, &n, NULL),
                             WT_OK);
        assert_null(images);
    }
}

static void test_gwyddion_wrong_sizes(void **state)
{
    (void)state;
    const made wide = gwy_of(COLUMNS + 1, ROWS, COLUMNS * ROWS),
               none = gwy_of(0, ROWS, COLUMNS * ROWS),
               below = gwy_of(UINT32_MAX, ROWS, COLUMNS * ROWS), huge = gwy_of(65536, 65536, 0),
               long_data = gwy_of(COLUMNS, ROWS, 0x7fffffff);
    refused_as(&wide, WT_E_CORRUPT, "6 x 3 pixels and 15 values");
    refused_as(&none, WT_E_CORRUPT, "contradict its size");
    refused_as(&below, WT_E_CORRUPT, "contradict its size");
    refused_as(&long_data, WT_E_CORRUPT, "size or its data");
    refused_as(&huge, WT_E_CORRUPT, "");
    made other = {.n = 0};
    const made nothing = {.n = 0};
    ADD(&other, "GWYP");
    add_object(&other, "GwyBrick", &nothing);
    refused_as(&other, WT_E_CORRUPT, "holds no container");
}

/* ---- X3P ------------------------------------------------------------------------------------- */

typedef struct made_x3p {
    const char *folder, *feature, *x_axis, *type, *rest; /* in the axis of z */
    const char *size, *record3, *md5;
    const made *data, *valid;
} made_x3p;

static void add_entry(made *m, const char *folder, const char *name, const void *bytes, size_t n)
{
    char full[128];
    snprintf(full, sizeof full, "%s%s", folder, name);
    assert_true(m->n + 30 + strlen(full) + n <= ROOM);
    m->n = (size_t)(put_entry(m->bytes + m->n, (const uint8_t *)full, strlen(full), bytes, n) -
                    m->bytes);
}

static made x3p_of(const made_x3p *x)
{
    char xml[2048];
    made m = {.n = 0};
    snprintf(xml, sizeof xml,
             "<?xml version='1.0'?><p:ISO5436_2 xmlns:p='http://www.opengps.eu/2008/ISO5436_2'>"
             "<Record1><FeatureType>%s</FeatureType><Axes><CX><AxisType>%s</AxisType><DataType>L"
             "</DataType><Increment>2e-6</Increment></CX><CY><AxisType>I</AxisType><Increment>2e-6"
             "</Increment></CY><CZ><AxisType>A</AxisType><DataType><!-- of the file --> %s "
             "</DataType>%s</CZ></Axes></Record1><Record3>%s%s</Record3></p:ISO5436_2>",
             x->feature != NULL ? x->feature : "SUR", x->x_axis != NULL ? x->x_axis : "I", x->type,
             x->rest,
             x->size != NULL ? x->size
                             : "<MatrixDimension><SizeX>5</SizeX><SizeY>3</SizeY><SizeZ>1</SizeZ>"
                               "</MatrixDimension>",
             x->record3 != NULL
                 ? x->record3
                 : "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
                   "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink>");
    if (x->md5 != NULL) { /* in place of the links */
        char *const links = strstr(xml, "<ValidPointsLink>");
        assert_non_null(links);
        snprintf(links, sizeof xml - (size_t)(links - xml),
                 "<MD5ChecksumPointData>%s</MD5ChecksumPointData></DataLink></Record3>"
                 "</p:ISO5436_2>",
                 x->md5);
    }
    const char *folder = x->folder != NULL ? x->folder : "";
    add_entry(&m, "", "__MACOSX/main.xml", "no", 2);
    add_entry(&m, folder, "main.xml", xml, strlen(xml));
    if (x->data != NULL)
        add_entry(&m, folder, "bindata/data.bin", x->data->bytes, x->data->n);
    if (x->valid != NULL)
        add_entry(&m, folder, "bindata/valid.bin", x->valid->bytes, x->valid->n);
    add_entry(&m, folder, "md5checksum.hex", "0 *main.xml\n", 12);
    return m;
}

static made doubles_of_heights(void)
{
    made m = {.n = 0};
    for (size_t row = 0; row < ROWS; row++)
        for (size_t column = 0; column < COLUMNS; column++)
            add_double(&m, height(column, row));
    return m;
}

/* Integers have an increment and an offset. Those of floating-point numbers are not applied, and
 * those of the x and y axes have no effect on the data. */
static void test_x3p_types(void **state)
{
    (void)state;
    const made valid = {{0xff, 0x7f}, 2}, doubles = doubles_of_heights();
    made whole = {.n = 0};
    for (size_t row = 0; row < ROWS; row++)
        for (size_t column = 0; column < COLUMNS; column++)
            add_number(&whole, (uint16_t)(int16_t)lround(1e9 * height(column, row) + 3), 2);
    const made_x3p kinds[] = {
        {.type = "D", .rest = "<Increment>1e-6</Increment>", .data = &doubles, .valid = &valid},
        {.folder = "one/", .type = "D", .rest = "", .data = &doubles, .valid = &valid},
        {.type = "I",
         .rest = "<Increment>1e-9</Increment><Offset>-3e-9</Offset>",
         .data = &whole,
         .valid = &valid}};
    for (size_t i = 0; i < COUNT_OF(kinds); i++) {
        const made m = x3p_of(&kinds[i]);
        wt_image *images = NULL;
        size_t n = 0;
        wt_error err = WT_ERROR_INIT;
        if (read_images_of(m.bytes, m.n, "made", NULL, &images, &n, &err) != WT_OK)
            fail_msg("%s %s", err.message, err.found);
        assert_int_equal(n, 1);
        check_heights(&images[0], 2e-6);
        clear_images(images, n);
    }
}

/* A bit for each height, the lowest first; a non-finite height is missing, too; an empty
 * element. */
static void test_x3p_missing(void **state)
{
    (void)state;
    const made valid = {{0xf7, 0x6f}, 2}; /* not 3 and 12 */
    made doubles = doubles_of_heights();
    memcpy(doubles.bytes + 8 * 7, "\0\0\0\0\0\0\xf0\x7f", 8); /* infinite */
    const made m = x3p_of(&(made_x3p){.type = "D", .rest = "", .data = &doubles, .valid = &valid});
    wt_image *images = NULL;
    size_t n = 0;
    assert_int_equal(read_images_of(m.bytes, m.n, "made", NULL, &images, &n, NULL), WT_OK);
    for (size_t i = 0; i < (size_t)COLUMNS * ROWS; i++)
        assert_int_equal(isnan(images[0].values[i]) != 0, i == 3 || i == 7 || i == 12);
    clear_images(images, n);

    const made list = x3p_of(&(made_x3p){
        .type = "D",
        .rest = "",
        .size =
            "<MatrixDimension><SizeX>2</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>",
        .record3 = "<DataList><Datum>1e-6</Datum><Datum/><Datum> -3.5E-0006 </Datum>"
                   "<Datum>0</Datum></DataList>"});
    assert_int_equal(read_images_of(list.bytes, list.n, "made", NULL, &images, &n, NULL), WT_OK);
    assert_near(images[0].values[0], 1e-6, 1e-12);
    assert_true(isnan(images[0].values[1]));
    assert_near(images[0].values[2], -3.5e-6, 1e-12);
    clear_images(images, n);
}

/* Checksum of the heights, in upper or lower case. */
static void test_x3p_checksum(void **state)
{
    (void)state;
    const made doubles = doubles_of_heights();
    char hex[33], capitals[33];
    digest_md5("abc", 3, hex);
    assert_string_equal(hex, "900150983cd24fb0d6963f7d28e17f72"); /* RFC 1321 */
    digest_md5(doubles.bytes, doubles.n, hex);
    for (size_t i = 0; i < sizeof hex; i++)
        capitals[i] = (char)toupper((unsigned char)hex[i]);
    const char *const good[] = {hex, capitals};
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        const made m =
            x3p_of(&(made_x3p){.type = "D", .rest = "", .data = &doubles, .md5 = good[i]});
        wt_image *images = NULL;
        size_t n = 0;
        assert_int_equal(read_images_of(m.bytes, m.n, "made", NULL, &images, &n, NULL), WT_OK);
        check_heights(&images[0], 2e-6);
        clear_images(images, n);
    }
    hex[5] = hex[5] == '0' ? '1' : '0';
    const made m = x3p_of(&(made_x3p){.type = "D", .rest = "", .data = &doubles, .md5 = hex});
    refused_as(&m, WT_E_CORRUPT, "checksum differs");
}

static void test_x3p_profile(void **state)
{
    (void)state;
    const made m = x3p_of(&(made_x3p){
        .feature = "PRF",
        .type = "D",
        .rest = "",
        .size =
            "<MatrixDimension><SizeX>3</SizeX><SizeY>1</SizeY><SizeZ>1</SizeZ></MatrixDimension>",
        .record3 = "<DataList><Datum>1</Datum><Datum>2</Datum><Datum>3</Datum></DataList>"});
    wt_image *images = NULL;
    size_t n = 0;
    assert_int_equal(read_images_of(m.bytes, m.n, "made", NULL, &images, &n, NULL), WT_OK);
    assert_int_equal(images[0].n_rows, 1);
    assert_near(images[0].width, 4e-6, 1e-12);
    assert_string_equal(images[0].x_unit, "m");
    clear_images(images, n);
}

static void test_x3p_refused(void **state)
{
    (void)state;
    made valid = {{0xff, 0x7f}, 2}, doubles = doubles_of_heights();
    made m = x3p_of(&(made_x3p){.type = "D", .rest = "", .x_axis = "A", .data = &doubles});
    refused_as(&m, WT_E_UNSUPPORTED, "not equally spaced");
    m = x3p_of(&(made_x3p){.type = "D", .rest = "", .size = "<ListDimension>15</ListDimension>"});
    refused_as(&m, WT_E_UNSUPPORTED, "cloud of points");
    m = x3p_of(&(made_x3p){.type = "X", .rest = "", .data = &doubles});
    refused_as(&m, WT_E_CORRUPT, "DataType of CZ");
    m = x3p_of(&(made_x3p){.type = "D", .rest = "", .valid = &valid});
    refused_as(&m, WT_E_CORRUPT, "bindata/data.bin, which main.xml names");
    m = x3p_of(&(made_x3p){.type = "F", .rest = "", .data = &doubles, .valid = &valid});
    refused_as(&m, WT_E_CORRUPT, "60 bytes; 120");
    valid.n = 1;
    m = x3p_of(&(made_x3p){.type = "D", .rest = "", .data = &doubles, .valid = &valid});
    refused_as(&m, WT_E_CORRUPT, "2 bytes; 1");
    m = x3p_of(&(made_x3p){.type = "D",
                           .rest = "",
                           .size =
                               "<MatrixDimension><SizeX>900000000</SizeX><SizeY>900000000</SizeY>"
                               "<SizeZ>900000000</SizeZ></MatrixDimension>"});
    refused_as(&m, WT_E_CORRUPT, "impossible size");
    m = x3p_of(
        &(made_x3p){.type = "D", .rest = "", .record3 = "<DataList><Datum>1</Datum></DataList>"});
    refused_as(&m, WT_E_CORRUPT, "15; 1");
    m = x3p_of(
        &(made_x3p){.type = "D", .rest = "", .record3 = "<DataList><Datum>1;2</Datum></DataList>"});
    refused_as(&m, WT_E_CORRUPT, "1;2");
}

/* ---- measured files -------------------------------------------------------------------------- */

enum { FIELDS = 26 };

/* Cells of a line; false at its end. */
static size_t split(char *line, char *cells[FIELDS])
{
    size_t n = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *p = line; p != NULL && n < FIELDS; n++) {
        cells[n] = p;
        p = strchr(p, ',');
        if (p != NULL)
            *p++ = '\0';
    }
    return n;
}

/* Measured files: how they are read, and the numbers of other programs for comparison. */
typedef struct measured_file {
    const char *name, *path;
    bool flipped;   /* line 0 of the file is the uppermost */
    bool steps;     /* the size is known */
    bool converted; /* by the program Gwyddion, if it is installed */
    bool mirrored;  /* lines are stored in reverse */
    /* the points include both ends of the range, which other programs divide by their number */
    bool ends;
    const char *units[2];
    double dx, dy; /* for the spectrum if the file has no size; 0 */
} measured_file;

static const measured_file measured_files[] = {
    {"KautschukInfiniteFocus.x3p", "/data/topography/KautschukInfiniteFocus.x3p", false, true,
     .dx = 0},
    {"ISO5436-sample1.x3p", "/data/topography/ISO5436-sample1.x3p", false, true, .dx = 0},
    {"ISO5436-sample4_bin.x3p", "/data/topography/ISO5436-sample4_bin.x3p", false, true, .dx = 0},
    {"whitelight.gsf", "/data/topography/whitelight.gsf", true, false, .dx = 5e-9, .dy = 1e-8},
    {"test.gwy", "/data/topography/test.gwy", true, false, .dx = 1, .dy = 1},
    {"sur-2.sur", "/data/topography/sur-2.sur", true, true, .converted = true},
    {"test_surface.sur", "/data/topography/test_surface.sur", true, true, .converted = true},
    {"al3d-1.al3d", "/data/topography/al3d-1.al3d", true, true, .converted = true},
    {"test_1.opd", "/data/topography/test_1.opd", false, true, .converted = true},
    {"sdf-1.sdf", "/data/topography/sdf-1.sdf", true, true, .converted = true},
    {"top-1.top", "/data/topography/top-1.top", false, true, .mirrored = true},
    {"data/afm/nanosurf/circles.nid", "/data/afm/nanosurf/circles.nid", false, false, .ends = true,
     .dx = 1.953125e-7, .dy = 1.953125e-7},
    {"data/afm/nanosurf/image.nid", "/data/afm/nanosurf/image.nid", false, false, .ends = true,
     .dx = 2.89347265625e-8, .dy = 2.89347265625e-8},
    {"opdx-3.opdx", "/data/topography/opdx-3.opdx", false, true, .converted = true},
    {"matrix-4.txt", "/data/topography/matrix-4.txt", true, true, .dx = 0},
    {"dektak-1.csv", "/data/topography/dektak-1.csv", false, true, .dx = 0},
    {"xy-4.txt", "/data/topography/xy-4.txt", false, true, .units = {"x=um", "z=um"}},
    {"wear-track-C1.csv", "/data/topography/wear-track-C1.csv", false, true,
     .units = {"Distance=mm", "Profile=um"}},
};
enum { WINDOW = 512 }; /* points of the profile of the numbers */

static bool has_gwyddion(void)
{
    return system("gwyddion --version >/dev/null 2>&1") == 0;
}

/* Returns the file of that name, or NULL without the file or the program that reads it. */
static const measured_file *file_of(const char *name)
{
    static int program = -1;
    if (program < 0)
        program = has_gwyddion();
    for (size_t i = 0; i < COUNT_OF(measured_files); i++)
        if (strcmp(name, measured_files[i].name) == 0)
            return measured_files[i].converted && program == 0 ? NULL : &measured_files[i];
    return NULL;
}

/* Its first image. */
static void open_measured(const measured_file *file, wt_image *image)
{
    char name[512];
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    wt_read_options read = wt_read_defaults();
    read.units = file->units;
    read.n_units = file->units[0] != NULL ? 2 : 0;
    snprintf(name, sizeof name, "%s%s", WT_SHARED_DIR, file->path);
    assert_int_equal(wt_input_open(name, &input, NULL), WT_OK);
    if (wt_images_read(formats, input, &read, NULL, &images, &n, &err) != WT_OK)
        fail_msg("%s: %s %s", file->name, err.message, err.found);
    wt_input_close(input);
    *image = images[0];
    for (size_t i = 1; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
}

/* Point i of a line as the file stores it. */
static double stored_point(const wt_image *image, const measured_file *file, size_t line, size_t i)
{
    const size_t nx = image->n_columns, row = file->flipped ? image->n_rows - 1 - line : line;
    return image->values[row * nx + (file->mirrored ? nx - 1 - i : i)];
}

static void compare_scalars(const measured_file *file, char *const cells[FIELDS])
{
    wt_image image;
    wt_surface_heights h;
    open_measured(file, &image);
    const size_t nx = image.n_columns, stored = (size_t)atoi(cells[21]);
    const bool profile = image.n_rows == 1;
    const wt_height_map map = wt_image_height_map(&image);
    surface_height_statistics(&map, &h);
    assert_int_equal(nx, atoi(cells[2]));
    assert_int_equal(image.n_rows, atoi(cells[3]));
    assert_int_equal(h.missing, atoi(cells[9]));
    assert_near(h.rms, atof(cells[13]), 1e-9);
    assert_near(h.peak_to_valley, atof(cells[12]) - atof(cells[11]), 1e-9);
    if (file->steps) {
        assert_near(map.dx, atof(cells[4]), 1e-9);
        assert_near(h.slope_x, atof(cells[17]), 1e-8);
    }
    if (file->ends) {
        const double wider = (double)nx / (double)(nx - 1);
        assert_near(map.dx, wider * atof(cells[4]), 1e-9);
        assert_near(map.dy, wider * atof(cells[5]), 1e-9);
        assert_near(wider * h.slope_x, atof(cells[17]), 1e-8);
        assert_near(wider * h.slope_y, atof(cells[18]), 1e-8);
    }
    if (file->steps && !profile) {
        assert_near(map.dy, atof(cells[5]), 1e-9);
        assert_near(h.slope_y, atof(cells[18]), 1e-8);
    }
    double sum = 0, moment = 0;
    for (size_t i = 0; i < (profile ? WINDOW : nx); i++) {
        const double z = profile ? image.values[stored + i] : stored_point(&image, file, stored, i);
        sum += isfinite(z) ? z : 0;
        moment += isfinite(z) ? (double)i * z : 0;
    }
    assert_near_abs(sum, atof(cells[23]), 1e-8 * (fabs(atof(cells[23])) + h.rms));
    assert_near_abs(moment, atof(cells[25]), 1e-8 * (fabs(atof(cells[25])) + (double)nx * h.rms));
    wt_image_clear(&image);
}

static FILE *open_numbers(const char *name)
{
    char numbers[512];
    snprintf(numbers, sizeof numbers, "%s/data/topography/%s", WT_SHARED_DIR, name);
    FILE *csv = fopen(numbers, "r");
    if (csv == NULL)
        skip();
    return csv;
}

static void test_measured(void **state)
{
    (void)state;
    FILE *csv = open_numbers("topography-scalars.csv");
    char line[1024], *cells[FIELDS];
    size_t n_compared = 0, n_expected = 0;
    if (csv == NULL)
        return;
    while (fgets(line, sizeof line, csv) != NULL) {
        const measured_file *const file = split(line, cells) == FIELDS ? file_of(cells[0]) : NULL;
        if (file == NULL)
            continue;
        compare_scalars(file, cells);
        n_compared++;
    }
    (void)fclose(csv);
    for (size_t i = 0; i < COUNT_OF(measured_files); i++)
        n_expected += file_of(measured_files[i].name) != NULL;
    assert_int_equal(n_compared, n_expected);
}

/* One whole line of each, to the printed digits. */
static void test_measured_rows(void **state)
{
    (void)state;
    FILE *csv = open_numbers("topography-rows.csv");
    char line[1024], *cells[FIELDS];
    const measured_file *opened = NULL;
    wt_image image = {.values = NULL};
    size_t n_files = 0, n_expected = 0;
    if (csv == NULL)
        return;
    while (fgets(line, sizeof line, csv) != NULL) {
        const measured_file *const file = split(line, cells) == 4 ? file_of(cells[0]) : NULL;
        if (file == NULL)
            continue;
        if (file != opened) {
            wt_image_clear(&image);
            open_measured(file, &image);
            opened = file;
            n_files++;
        }
        const size_t i = (size_t)atoi(cells[2]);
        const double z = stored_point(&image, file, (size_t)atoi(cells[1]), i);
        const double wanted = cells[3][0] != '\0' ? atof(cells[3]) : (double)NAN;
        if (isnan(wanted) || isnan(z))
            assert_int_equal(isnan(wanted) != 0, isnan(z) != 0);
        else
            assert_near_abs(z, wanted, 1e-11 * fabs(wanted) + 1e-20);
    }
    (void)fclose(csv);
    wt_image_clear(&image);
    for (size_t i = 0; i < COUNT_OF(measured_files); i++)
        n_expected += file_of(measured_files[i].name) != NULL;
    assert_int_equal(n_files, n_expected);
}

/* Spectrum of a file by the steps of another program: subtraction of a plane, 0 for missing
 * heights, bins from 10^(k/10). */
static void transform_measured(const measured_file *file, wt_surface_spectrum *to)
{
    wt_image image;
    double form[FORM_TERMS];
    open_measured(file, &image);
    wt_height_map map = wt_image_height_map(&image);
    const size_t nx = image.n_columns, ny = image.n_rows;
    const double dx = file->dx > 0 ? file->dx : map.dx, dy = file->dx > 0 ? file->dy : map.dy;
    double *z = malloc(nx * ny * sizeof *z);
    assert_non_null(z);
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0; i < nx; i++)
            z[j * nx + i] = stored_point(&image, file, j, i);
    assert_int_equal(surface_remove_form(z, nx, ny, 1, form, NULL), WT_OK);
    for (size_t i = 0; i < nx * ny; i++)
        z[i] = isfinite(z[i]) ? z[i] : 0;
    map = (wt_height_map){z, nx, ny, dx, dy, false};
    const surface_bins bins = {pow(10, 0.05), 1e-9,
                               ny > 1 ? fmin(M_PI / dx, M_PI / dy) : M_PI / dx};
    assert_int_equal(surface_transform(&map, WT_WINDOW_HANN, ny == 1, &bins, to, NULL), WT_OK);
    wt_image_clear(&image);
    free(z);
}

static void test_measured_spectra(void **state)
{
    (void)state;
    FILE *csv = open_numbers("topography-psd.csv");
    char line[1024], *cells[FIELDS];
    const measured_file *opened = NULL;
    wt_surface_spectrum spectrum = {.n = 0};
    size_t n_compared = 0, n_expected = 0;
    if (csv == NULL)
        return;
    while (fgets(line, sizeof line, csv) != NULL) {
        const measured_file *const file = split(line, cells) == 9 ? file_of(cells[0]) : NULL;
        if (file == NULL)
            continue;
        if (file != opened) {
            wt_surface_spectrum_clear(&spectrum);
            transform_measured(file, &spectrum);
            opened = file;
        }
        /* The reference counts modes of a profile with one sign; unlike the library, it counts that
         * of two points once. */
        const bool profile = strcmp(cells[1], "1") == 0;
        n_expected++;
        for (size_t k = 0; k < spectrum.n; k++) {
            const wt_spectrum_bin *const b = &spectrum.bins[k];
            const size_t n = (size_t)atoi(cells[5]), of_both = 2 * n;
            const bool ends = profile && b->n == of_both - 1;
            if (b->index != atoi(cells[2]) || (b->n != (profile ? of_both : n) && !ends))
                continue;
            assert_near(b->mean_wavenumber, atof(cells[6]), ends ? 1e-2 : 1e-8);
            assert_near(b->density, atof(cells[7]), ends ? 1e-1 : 1e-6);
            n_compared++;
        }
    }
    (void)fclose(csv);
    wt_surface_spectrum_clear(&spectrum);
    assert_true(n_expected > 200);
    assert_int_equal(n_compared, n_expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gwyddion),      cmocka_unit_test(test_gwyddion_wrong_sizes),
        cmocka_unit_test(test_x3p_types),     cmocka_unit_test(test_x3p_missing),
        cmocka_unit_test(test_x3p_profile),   cmocka_unit_test(test_x3p_checksum),
        cmocka_unit_test(test_x3p_refused),   cmocka_unit_test(test_measured),
        cmocka_unit_test(test_measured_rows), cmocka_unit_test(test_measured_spectra),
    };
    return cmocka_run_group_tests(tests, set_up, clean);
}
