/* Writes the seeds of the fuzz targets of the binary readers, each below 20 kB: make_seeds
 * FOLDER. The seeds are committed in fixtures/fuzz; run the program again after a change of the
 * writers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/ardf_writer.h"
#include "writers/book_writer.h"
#include "writers/curve_hdf5_writer.h"
#include "writers/ibw_writer.h"
#include "writers/jpk_writer.h"
#include "writers/nanoscope_writer.h"
#include "writers/nid_writer.h"
#include "writers/park_writer.h"
#include "writers/surf_writer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#define POINTS 12
static double height[POINTS], force[POINTS], sensor[POINTS];

static void path_of(char *path, size_t size, const char *folder, const char *name)
{
    snprintf(path, size, "%s/%s", folder, name);
}

/* ---- JPK ---------------------------------------------------------------------------------- */

/* The same entries as the list that fuzz_jpk packs. */
static int write_list(const char *archive, const char *list)
{
    zip_t *zip = zip_open(archive, ZIP_RDONLY, NULL);
    FILE *out = fopen(list, "wb");
    int bad = zip == NULL || out == NULL;
    zip_int64_t n = bad ? 0 : zip_get_num_entries(zip, 0);
    for (zip_int64_t i = 0; i < n && !bad; i++) {
        char buffer[16384];
        zip_file_t *file = zip_fopen_index(zip, (zip_uint64_t)i, 0);
        zip_int64_t length = file != NULL ? zip_fread(file, buffer, sizeof buffer) : -1;
        bad = length < 0;
        if (!bad) {
            fprintf(out, "%s%s\036", i > 0 ? "\037" : "", zip_get_name(zip, (zip_uint64_t)i, 0));
            fwrite(buffer, 1, (size_t)length, out);
        }
        if (file != NULL)
            zip_fclose(file);
    }
    if (zip != NULL)
        zip_discard(zip);
    if (out != NULL && fclose(out) != 0)
        bad = 1;
    return bad ? -1 : 0;
}

static int make_jpk(const char *folder)
{
    static const char *const styles[] = {"extend", "pause", "retract"};
    jpk_writer_segment segments[3];
    jpk_writer_curve curves[2];
    for (size_t i = 0; i < 3; i++)
        segments[i] =
            (jpk_writer_segment){styles[i], POINTS - i, 0.5, height, force, i == 1 ? NULL : sensor};
    for (size_t i = 0; i < 2; i++)
        curves[i] = (jpk_writer_curve){3 * i, 1e-6, 2e-6, 3, segments};
    jpk_writer_file f = jpk_writer_defaults();
    f.curves = curves;
    f.spring_constant = 0.05;
    f.sensitivity = 6e-8;
    f.setpoint = 1e-9;
    for (int kind = 0; kind < 4; kind++) {
        char archive[512], list[512], name[32];
        f.map = kind % 2 == 1;
        f.n_curves = f.map ? 2 : 1;
        f.columns = f.rows = f.map ? 2 : 0;
        f.inline_headers = kind >= 2;
        /* Headers that repeat all keys are long. */
        curves[0].n_segments = curves[1].n_segments = f.inline_headers ? 1 : 3;
        f.encoding = (jpk_writer_encoding)kind;
        snprintf(name, sizeof name, "seed%d.zip", kind);
        path_of(archive, sizeof archive, folder, name);
        snprintf(name, sizeof name, "seed%d.list", kind);
        path_of(list, sizeof list, folder, name);
        f.path = archive;
        if (jpk_write(&f) != 0 || write_list(archive, list) != 0)
            return -1;
    }
    return 0;
}

/* ---- Nanosurf ----------------------------------------------------------------------------- */

static int make_nid(const char *folder)
{
    static const double places[2][3] = {{1e-6, 2e-6, 0}, {3e-6, 4e-6, 0}};
    static const size_t lengths[] = {6, 4};
    const nid_writer_channel both[] = {{0, "Deflection", "V", -1e-5, 2e-5, 32, force},
                                       {7, "Z-Axis Sensor", "m", -1e-5, 2e-5, 16, height}};
    nid_writer_group groups[2];
    for (size_t i = 0; i < 2; i++)
        groups[i] = (nid_writer_group){.name = i == 0 ? "Spec forward" : "Spec backward",
                                       .points = POINTS / 2,
                                       .lines = 2,
                                       .line_points = lengths,
                                       .x_name = "Z-Axis",
                                       .x_unit = "m",
                                       .y_name = "SpecPoint",
                                       .y_unit = "",
                                       .x_range = 1e-6,
                                       .n_channels = 2,
                                       .channels = both};
    for (int kind = 0; kind < 3; kind++) {
        char path[512], name[32];
        nid_writer_file f = nid_writer_defaults();
        snprintf(name, sizeof name, "seed%d.nid", kind);
        path_of(path, sizeof path, folder, name);
        f.path = path;
        f.n_groups = 2;
        f.groups = groups;
        f.latin1 = kind == 1;
        f.spring_constant = 0.2;
        f.deflection_range_m = 1e-6;
        f.deflection_range_v = 10;
        f.forward_time = f.backward_time = 1;
        f.forward_points = f.backward_points = POINTS / 2;
        f.forward_pause_points = f.backward_pause_points = 1;
        f.forward_range = 1e-6;
        f.map = kind == 0 ? "0;1e-6;0;1e-6;2;1;0;1" : NULL;
        f.n_positions = kind == 1 ? 2 : 0;
        f.positions = places;
        if (kind == 2) {
            groups[0].name = "Scan forward";
            groups[1].name = "Scan backward";
            groups[0].line_points = groups[1].line_points = NULL;
        }
        if (nid_write(&f) != 0)
            return -1;
    }
    return 0;
}

/* ---- Igor --------------------------------------------------------------------------------- */

static int make_ibw(const char *folder)
{
    static const char *const labels[] = {"Raw", "Defl", "ZSnsr"};
    const double *const values[] = {height, force, sensor};
    char path[512];
    for (int kind = 0; kind < 2; kind++) {
        char name[32];
        snprintf(name, sizeof name, "seed%d.ibw", kind);
        path_of(path, sizeof path, folder, name);
        const ibw_writer_file f = {
            .path = path,
            .big_endian = kind == 1,
            .doubles = kind == 1,
            .n = POINTS,
            .n_channels = 3,
            .labels = labels,
            .values = values,
            .interval = 0.01,
            .note =
                "SpringConstant: 0.5\rInvOLS: 5e-08\rTriggerChannel:Force\rTriggerPoint: 2e-09\r"
                "Indexes: 0,6,8,11\rDirection: NaN,1,0,-1,\r"};
        if (ibw_write(&f) != 0)
            return -1;
    }
    return 0;
}

static int make_ardf(const char *folder)
{
    static const char *const labels[] = {"Raw", "Defl", "ZSnsr"}, *const units[] = {"m", "m", "m"};
    const double *const values[] = {height, force, sensor};
    char path[512];
    for (int kind = 0; kind < 2; kind++) {
        char name[32];
        snprintf(name, sizeof name, "seed%d.ardf", kind);
        path_of(path, sizeof path, folder, name);
        const ardf_writer_file f = {
            .path = path,
            .columns = 2,
            .lines = 2,
            .written = kind == 1 ? 3 : 4,
            .labels = labels,
            .units = units,
            .n_channels = kind == 1 ? 3 : 2,
            .n = POINTS,
            .values = values,
            .segments = kind == 1 ? "Ext;Dwell;Ret;" : "Ext;Ret;",
            .begins = {0, 6, kind == 1 ? 8 : POINTS - 1, kind == 1 ? POINTS - 1 : 0, 0},
            .interval = 0.01,
            .step = 1e-6,
            .note = "SpringConstant: 0.5\rInvOLS: 5e-08\r",
            .both = kind == 1};
        if (ardf_write(&f) != 0)
            return -1;
    }
    return 0;
}

/* ---- images -----------------------------------------------------------------------------------
 */

static int make_image(const char *folder, const char *name, const char *header, size_t data)
{
    char path[512];
    path_of(path, sizeof path, folder, name);
    FILE *out = fopen(path, "wb");
    if (out == NULL)
        return -1;
    (void)fputs(header, out);
    do
        (void)fputc(0, out);
    while (ftell(out) < (long)data || ftell(out) % 4 != 0);
    for (int i = 0; i < 12; i++)
        (void)fwrite("\0\0\x80\x3f", 1, 4, out);
    return fclose(out);
}

static int make_gsf(const char *folder)
{
    return make_image(folder, "seed0.gsf",
                      "Gwyddion Simple Field 1.0\nXRes = 4\nYRes = 3\nXReal = 4e-6\nYReal = 3e-6\n"
                      "XYUnits = m\nZUnits = m\nTitle = Height\n",
                      0);
}

static int make_wsxm(const char *folder)
{
    return make_image(folder, "seed0.stp",
                      "WSxM file copyright Nanotec Electronica\r\nSxM Image file\r\n"
                      "Image header size: 300\r\n[Control]\r\n    X Amplitude: 4 \xb5m\r\n"
                      "    Y Amplitude: 3000 nm\r\n[General Info]\r\n"
                      "    Acquisition channel: Topography\r\n    Image Data Type: float\r\n"
                      "    Number of columns: 4\r\n    Number of rows: 3\r\n"
                      "    Z Amplitude: 15 \xc5\r\n[Header end]\r\n",
                      300);
}

static void put_number(FILE *out, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        (void)fputc((int)(value >> (8 * i) & 0xff), out);
}

/* An object of a Gwyddion file, with its size in front. */
static void put_object(FILE *out, const char *name, const char *components, size_t n)
{
    (void)fwrite(name, 1, strlen(name) + 1, out);
    put_number(out, n, 4);
    (void)fwrite(components, 1, n, out);
}

static int make_gwy(const char *folder)
{
    char path[512], *field = NULL, *unit = NULL, *container = NULL;
    size_t n_field = 0, n_unit = 0, n_container = 0;
    FILE *out = open_memstream(&unit, &n_unit);
    (void)fwrite("unitstr\0sm", 1, 11, out);
    (void)fclose(out);
    out = open_memstream(&field, &n_field);
    (void)fwrite("xres\0i\3\0\0\0yres\0i\2\0\0\0xreal\0d\0\0\0\0\0\0\xf0\x3f", 1, 35, out);
    (void)fwrite("yreal\0d\0\0\0\0\0\0\xf0\x3fsi_unit_xy\0o", 1, 27, out);
    put_object(out, "GwySIUnit", unit, n_unit);
    (void)fwrite("si_unit_z\0o", 1, 11, out);
    put_object(out, "GwySIUnit", unit, n_unit);
    (void)fwrite("data\0D\6\0\0\0", 1, 10, out);
    for (int i = 0; i < 6; i++)
        put_number(out, UINT64_C(0x3ff0000000000000) + (uint64_t)i, 8);
    (void)fclose(out);
    out = open_memstream(&container, &n_container);
    (void)fwrite("/0/data\0o", 1, 9, out);
    put_object(out, "GwyDataField", field, n_field);
    (void)fwrite("/0/mask\0o", 1, 9, out);
    put_object(out, "GwyDataField", field, n_field);
    (void)fwrite("/0/data/title\0sHeight", 1, 22, out);
    (void)fclose(out);
    path_of(path, sizeof path, folder, "seed0.gwy");
    out = fopen(path, "wb");
    if (out == NULL)
        return -1;
    (void)fputs("GWYP", out);
    put_object(out, "GwyContainer", container, n_container);
    free(field);
    free(unit);
    free(container);
    return fclose(out);
}

/* Compressed, in one block and in three. */
static int make_surf(const char *folder)
{
    static const int heights[12] = {-3, 7, 1, 0, 100000, -1, 5, 5, 5, 5, 5, 5};
    int bad = 0;
    for (size_t pieces = 1; pieces <= 3 && bad == 0; pieces += 2) {
        char path[512], name[16];
        unsigned char bytes[1024];
        const size_t n = surf_write(bytes, heights, 12, pieces);
        snprintf(name, sizeof name, "seed%zu.sur", pieces / 2);
        path_of(path, sizeof path, folder, name);
        FILE *out = fopen(path, "wb");
        bad = out == NULL || fwrite(bytes, 1, n, out) != n;
        if (out != NULL && fclose(out) != 0)
            bad = 1;
    }
    return bad ? -1 : 0;
}

/* Lists of entries; the target packs them. */
static int make_x3p(const char *folder)
{
    static const char *const heights[] = {
        "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><ValidPointsLink>bindata/"
        "valid.bin</ValidPointsLink></DataLink>",
        "<DataList><Datum>1e-6</Datum><Datum/><Datum>3e-6</Datum><Datum>4e-6</Datum></DataList>"};
    for (int kind = 0; kind < 2; kind++) {
        char path[512], name[32];
        snprintf(name, sizeof name, "seed%d.list", kind);
        path_of(path, sizeof path, folder, name);
        FILE *out = fopen(path, "wb");
        if (out == NULL)
            return -1;
        fprintf(out,
                "main.xml\x1e<ISO5436><Record1><FeatureType>SUR</FeatureType><Axes><CX><AxisType>I"
                "</AxisType><Increment>1e-6</Increment></CX><CY><AxisType>I</AxisType><Increment>"
                "1e-6</Increment></CY><CZ><AxisType>A</AxisType><DataType>%c</DataType></CZ></Axes>"
                "</Record1><Record3><MatrixDimension><SizeX>2</SizeX><SizeY>2</SizeY><SizeZ>1"
                "</SizeZ></MatrixDimension>%s</Record3></ISO5436>",
                kind == 0 ? 'I' : 'D', heights[kind]);
        if (kind == 0)
            (void)fwrite("\x1f"
                         "bindata/data.bin\x1e"
                         "abcdefgh\x1f"
                         "bindata/valid.bin\x1e\7",
                         1, 47, out);
        if (fclose(out) != 0)
            return -1;
    }
    return 0;
}

/* ---- NanoScope, Park --------------------------------------------------------------------------
 */

static int make_nanoscope(const char *folder)
{
    char path[512];
    const nanoscope_writer_channel channels[] = {
        {"Deflection Error", "Sens. DeflSens", 1e-10, force},
        {"Height Sensor", "Sens. ZsensSens", 1e-8, sensor}};
    for (int kind = 0; kind < 3; kind++) {
        char name[32];
        snprintf(name, sizeof name, "seed%d.spm", kind);
        path_of(path, sizeof path, folder, name);
        const nanoscope_writer_file f = {.path = path,
                                         .volume = kind > 0,
                                         .side = kind > 0 ? 2 : 1,
                                         .n_in = kind > 0 ? 1 : 5,
                                         .n_hold = kind == 1 ? 1 : 0,
                                         .n_out = kind > 0 ? 1 : 5,
                                         .width = kind == 1 ? 4 : 2,
                                         .ramp_volts = 20,
                                         .z_sensitivity = 10,
                                         .deflection_sensitivity = 40,
                                         .spring_constant = 0.5,
                                         .trigger = 1e-9,
                                         .rate = 100,
                                         .amplitude = kind == 2 ? 100 : 0,
                                         .sync = 1,
                                         .n_channels = 2,
                                         .channels = channels};
        if (nanoscope_write(&f) != 0)
            return -1;
    }
    return make_image(folder, "image.spm",
                      "\\*File list\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 10 nm/V\r\n"
                      "\\*Ciao image list\r\n\\Data offset: 512\r\n\\Data length: 48\r\n"
                      "\\Samps/line: 4\r\n\\Number of lines: 3\r\n\\Scan Size: 2 2 ~m\r\n"
                      "\\@2:Image Data: S [Height] \"Height\"\r\n"
                      "\\@2:Z scale: V [Sens. Zsens] (0.006 V/LSB) 1 V\r\n"
                      "\\*File list end\r\n\032",
                      512);
}

static int make_park(const char *folder)
{
    char path[512];
    const park_writer_channel channels[] = {{"Force", "nN", 1, force},
                                            {"Z Scan", "um", 1, height},
                                            {"Z Detector", "um", 1, sensor},
                                            {"Time Stamp", "usec", 1, force}};
    path_of(path, sizeof path, folder, "seed0.tiff");
    const park_writer_file f = {
        .path = path, .n_curves = 2, .n_samples = 6, .n_channels = 4, .channels = channels};
    return park_write(&f);
}

/* ---- HDF5, NT-MDT -----------------------------------------------------------------------------
 */

static int make_afmformats(const char *folder)
{
    static const unsigned char segments[POINTS] = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    char path[512];
    for (int packed = 0; packed < 2; packed++) {
        path_of(path, sizeof path, folder, packed ? "packed.h5" : "plain.h5");
        const afmformats_writer_file f = {.path = path,
                                          .n_curves = 1,
                                          .n = POINTS,
                                          .height = height,
                                          .force = force,
                                          .segments = segments,
                                          .spring_constant = 0.3,
                                          .force_unit = "N",
                                          .packed = packed == 1};
        if (afmformats_write(&f) != 0)
            return -1;
    }
    return 0;
}

static int make_nhf(const char *folder)
{
    static const int sizes[] = {7, 5};
    const nhf_writer_channel channels[] = {{"Deflection", "Volt (V)", -1, 1, force},
                                           {"Position Z", "m", -1e-5, 1e-5, height}};
    const nhf_writer_segment segment = {"Advance to Setpoint 1", sizes, 2, channels};
    char path[512];
    for (int version = 1; version <= 2; version++) {
        path_of(path, sizeof path, folder, version == 1 ? "old.nhf" : "new.nhf");
        const nhf_writer_file f = {.path = path,
                                   .version = version,
                                   .type = version == 1 ? "spectroscopy_grid" : "spectroscopy",
                                   .n_curves = 2,
                                   .n_segments = 1,
                                   .segments = &segment,
                                   .spring_constant = 0.5,
                                   .sensitivity = 1e-7,
                                   .x = height,
                                   .y = sensor,
                                   .newtons_per_count = version == 1 ? 0 : 1e-18};
        if (nhf_write(&f) != 0)
            return -1;
    }
    return 0;
}

static int make_ntmdt(const char *folder)
{
    char path[512];
    path_of(path, sizeof path, folder, "seed0.txt");
    FILE *out = fopen(path, "wb");
    for (int i = 0; out != NULL && i < POINTS; i++)
        fprintf(out, "-%d,5\t%d,25\t%d,5\r\n", 10 * (POINTS - i), i < 2 ? 7 : 9 - i, 8 - i);
    return out != NULL ? fclose(out) : -1;
}

/* ---- spreadsheets ------------------------------------------------------------------------- */

static int make_packed(const char *folder)
{
    static const char sweep[] =
        "f\tT\tE'\tE''\nHz\tdegC\tMPa\tMPa\n1\t20\t11\t1.25\n10\t20\t12\t1.5\n";
    const book_writer_sheet sheets[] = {{"A", "Operator\tM & M\n", false}, {"B", sweep, false}};
    char archive[512], list[512];
    for (int shared = 0; shared < 2; shared++) {
        path_of(archive, sizeof archive, folder, "book.xlsx");
        path_of(list, sizeof list, folder, shared ? "shared.list" : "inline.list");
        if (xlsx_write(archive, sheets, 2, shared) != 0 || write_list(archive, list) != 0 ||
            remove(archive) != 0)
            return -1;
    }
    static const char *const names[] = {"plain.xls", "shared.xls", "old.xls"};
    for (xls_way way = XLS_PLAIN; way <= XLS_OLD; way++) {
        path_of(archive, sizeof archive, folder, names[way]);
        if (xls_write(archive, way, sheets, 2) != 0)
            return -1;
    }
    return 0;
}

/* ---- properties --------------------------------------------------------------------------- */

static int make_properties(const char *folder)
{
    char path[512];
    path_of(path, sizeof path, folder, "seed0.properties");
    FILE *out = fopen(path, "wb");
    if (out == NULL)
        return -1;
    fputs("#Sat Oct 29 12:27:44 CEST 2022\r\nstart-time=2022-10-29 12\\:27\\:34.358 +0200\n"
          "! another comment\nz-scanner.description=100\\u00B5m \\uD834\\uDD1E\nlatin=\265m\n"
          "channels.list = height \\\n   vDeflection\nkey\\ with\\=all : value\nempty\n=\n"
          "channel.height.lcd-info.*=0\nnumber=-3.2226296801682413E-5\nnumber=2",
          out);
    return fclose(out);
}

static int make_folder(char *path, size_t size, const char *parent, const char *name)
{
    path_of(path, size, parent, name);
    return mkdir(path, 0777) == 0 || access(path, W_OK) == 0 ? 0 : -1;
}

int main(int argc, char *argv[])
{
    static const struct {
        const char *name;
        int (*make)(const char *folder);
    } targets[] = {{"afmformats", make_afmformats},
                   {"ardf", make_ardf},
                   {"gsf", make_gsf},
                   {"gwy", make_gwy},
                   {"ibw", make_ibw},
                   {"jpk", make_jpk},
                   {"nanoscope", make_nanoscope},
                   {"nhf", make_nhf},
                   {"nid", make_nid},
                   {"ntmdt", make_ntmdt},
                   {"packed", make_packed},
                   {"park", make_park},
                   {"properties", make_properties},
                   {"surf", make_surf},
                   {"wsxm", make_wsxm},
                   {"x3p", make_x3p}};
    char folder[256];
    if (argc != 2) {
        fprintf(stderr, "usage: make_seeds FOLDER\n");
        return 2;
    }
    for (size_t i = 0; i < POINTS; i++) {
        height[i] = 7e-6 - 1e-7 * (double)i;
        force[i] = 1e-9 * (double)(i * i) / POINTS;
        sensor[i] = 2e-6 - 1e-7 * (double)i;
    }
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        if (make_folder(folder, sizeof folder, argv[1], targets[i].name) != 0 ||
            targets[i].make(folder) != 0) {
            fprintf(stderr, "%s/%s: cannot be written\n", argv[1], targets[i].name);
            return 1;
        }
    }
    return 0;
}
