/* Nanosurf .nid files with known content by the independent writer, with numbers that are read back
 * exactly. The measured images and the thermal spectrum are read if they exist.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/force_assembler.h"
#include "reader_fixture.h"
#include "writers/nid_writer.h"

#define LINES 6
#define POINTS 16

/* ---- force curves ------------------------------------------------------------------------- */

/* Forward, a pause and backward; each with height and deflection. */
static double z[3][LINES * POINTS], bending[3][LINES * POINTS];
static size_t lengths[3][LINES];
static nid_writer_channel channels[3][2];
static nid_writer_group groups[3];

/* Ranges are powers of two, so that each stored number is exactly a double. */
static nid_writer_file make_file(const char *unit, bool lengths_differ, bool latin1)
{
    static const char *const names[] = {"Spec forward", "Spec fwd pause", "Spec backward"};
    for (size_t g = 0; g < 3; g++) {
        for (size_t i = 0; i < LINES * POINTS; i++) {
            z[g][i] = ldexp(1, -16) * ((double)(7 * i % 61) / 64 - 0.5);
            bending[g][i] = ldexp(1, -20) * ((double)(1000 * g + 13 * i) / 4096 - 0.5);
        }
        for (size_t line = 0; line < LINES; line++)
            lengths[g][line] = POINTS - (g + line) % 4;
        channels[g][0] = (nid_writer_channel){0,  "Deflection", unit, -ldexp(1, -21), ldexp(1, -20),
                                              32, bending[g]};
        channels[g][1] =
            (nid_writer_channel){7, "Z-Axis Sensor", "m", -ldexp(1, -17), ldexp(1, -16), 16, z[g]};
        groups[g] = (nid_writer_group){.name = names[g],
                                       .points = POINTS,
                                       .lines = LINES,
                                       .line_points = lengths_differ ? lengths[g] : NULL,
                                       .x_name = "Z-Axis",
                                       .x_unit = "m",
                                       .y_name = "SpecPoint",
                                       .y_unit = "",
                                       .x_range = 1e-6,
                                       .n_channels = 2,
                                       .channels = channels[g]};
    }
    nid_writer_file f = nid_writer_defaults();
    f.path = path;
    f.n_groups = 3;
    f.groups = groups;
    f.latin1 = latin1;
    f.spring_constant = 0.25;
    f.deflection_range_m = 1.25e-6;
    f.deflection_range_v = 10;
    f.forward_time = 0.5;
    f.forward_points = POINTS;
    f.forward_pause = 2;
    f.forward_pause_points = POINTS;
    f.backward_time = 1;
    f.backward_points = POINTS;
    f.backward_pause_points = 1;
    f.forward_range = 2e-6;
    return f;
}

static void assert_exact(const wt_segment *s, wt_quantity quantity, const double *expected,
                         double factor)
{
    const wt_channel *c = wt_segment_channel(s, quantity);
    assert_non_null(c);
    for (size_t i = 0; i < s->n_points; i++)
        assert_near(c->values[i], factor * expected[i], factor == 1 ? 0 : 1e-15);
}

/* factor: from the exported unit to force, deflection and voltage. */
static void assert_curves(reading *r, bool lengths_differ, const double factor[3])
{
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_RETRACT};
    static const double times[] = {0.5, 2, 1};
    assert_int_equal(wt_force_count(r->source), LINES);
    for (size_t line = 0; line < LINES; line++) {
        double start = 0;
        assert_int_equal(wt_force_next(r->source, &r->curve, &r->err), WT_OK);
        assert_int_equal(r->curve.index, line);
        assert_int_equal(r->curve.n_segments, 3);
        for (size_t g = 0; g < 3; g++) {
            const wt_segment *s = &r->curve.segments[g];
            assert_int_equal(s->kind, kinds[g]);
            assert_int_equal(s->n_points, lengths_differ ? lengths[g][line] : POINTS);
            assert_exact(s, WT_Q_MEASURED_HEIGHT, z[g] + line * POINTS, 1);
            assert_exact(s, WT_Q_FORCE, bending[g] + line * POINTS, factor[0]);
            assert_exact(s, WT_Q_DEFLECTION, bending[g] + line * POINTS, factor[1]);
            assert_exact(s, WT_Q_DEFLECTION_VOLTAGE, bending[g] + line * POINTS, factor[2]);
            const wt_channel *time = wt_segment_channel(s, WT_Q_TIME);
            for (size_t i = 0; i < s->n_points; i++)
                assert_near_abs(time->values[i], start + times[g] * (double)i / POINTS, 1e-15);
            start += times[g] * (double)s->n_points / POINTS;
        }
        assert_near(r->curve.segments[0].velocity, 2e-6 / 0.5, 1e-15);
        assert_near(r->curve.cantilever.spring_constant, 0.25, 0);
        assert_near(r->curve.cantilever.sensitivity, 1.25e-7, 1e-15);
    }
    assert_int_equal(wt_force_next(r->source, &r->curve, &r->err), WT_END);
}

static void units_versions_encodings(void **state)
{
    (void)state;
    static const char *const units[] = {"V", "m", "N"};
    const double k = 0.25, s = 1.25e-7;
    const double factors[][3] = {{k * s, s, 1}, {k, 1, 1 / s}, {1, 1 / k, 1 / (k * s)}};
    for (size_t i = 0; i < 12; i++) {
        bool lengths_differ = i / 3 % 2 == 1;
        nid_writer_file f = make_file(units[i % 3], lengths_differ, i / 6 == 1);
        reading r;
        assert_int_equal(nid_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_true(has_logged(&r, "not verified on a genuine file"));
        assert_curves(&r, lengths_differ, factors[i % 3]);
        close_all(&r);
    }
}

/* A phase that is not in the file has no duration, even if the header does not state it. */
static void without_pause(void **state)
{
    (void)state;
    nid_writer_file f = make_file("N", false, false);
    reading r;
    groups[1] = groups[2];
    f.n_groups = 2;
    f.forward_pause = 0;
    f.forward_pause_points = 0;
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_int_equal(r.curve.n_segments, 2);
    const wt_channel *time = wt_segment_channel(&r.curve.segments[1], WT_Q_TIME);
    assert_non_null(time);
    assert_near(time->values[0], 0.5, 0);
    assert_near(time->values[POINTS - 1], 0.5 + (POINTS - 1.0) / POINTS, 1e-15);
    close_all(&r);
}

/* Stated values replace those of the instrument, for any exported unit. */
static void user_calibration(void **state)
{
    (void)state;
    static const char *const units[] = {"V", "m", "N"};
    const double k = 0.25, s = 1.25e-7;
    const double to_volts[] = {1, 1 / s, 1 / (k * s)};
    for (size_t i = 0; i < 9; i++) {
        nid_writer_file f = make_file(units[i % 3], false, false);
        wt_read_options o = wt_read_defaults();
        reading r;
        if (i / 3 != 1)
            o.spring_constant = 0.4;
        if (i / 3 != 0)
            o.sensitivity = 1e-7;
        double used_k = isnan(o.spring_constant) ? k : 0.4;
        double used_s = isnan(o.sensitivity) ? s : 1e-7;
        assert_int_equal(nid_write(&f), 0);
        assert_int_equal(open_force(&r, path, &o), WT_OK);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        const wt_channel *force = wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE);
        const wt_channel *deflection = wt_segment_channel(&r.curve.segments[0], WT_Q_DEFLECTION);
        for (size_t j = 0; j < POINTS; j++) {
            assert_near(deflection->values[j], bending[0][j] * to_volts[i % 3] * used_s, 1e-14);
            assert_near(force->values[j], bending[0][j] * to_volts[i % 3] * used_s * used_k, 1e-14);
        }
        assert_near(r.curve.cantilever.spring_constant, used_k, 0);
        assert_int_equal(r.curve.cantilever.spring_constant_is_overridden,
                         !isnan(o.spring_constant));
        close_all(&r);
    }
}

static void missing_calibration(void **state)
{
    (void)state;
    nid_writer_file f = make_file("V", false, false);
    wt_read_options o = wt_read_defaults();
    reading r;
    f.spring_constant = (double)NAN;
    f.deflection_range_m = (double)NAN;
    assert_int_equal(nid_write(&f), 0);
    o.want = WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT);
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_MISSING);
    assert_string_equal(r.err.advice, "give --spring-constant 0.1N/m and --sensitivity 60nm/V");
    close_all(&r);
    o.spring_constant = 0.5;
    o.sensitivity = 1e-7;
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_exact(&r.curve.segments[0], WT_Q_FORCE, bending[0], 0.5 * 1e-7);
    assert_int_equal(r.curve.segments[0].n_channels, 2);
    close_all(&r);
}

/* A force in newtons without a spring constant in the file: the force is read, the deflection needs
 * the option. */
static void force_without_spring_constant(void **state)
{
    (void)state;
    nid_writer_file f = make_file("N", false, false);
    wt_read_options o = wt_read_defaults();
    reading r;
    f.spring_constant = (double)NAN;
    assert_int_equal(nid_write(&f), 0);
    o.want = WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_DEFLECTION);
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_MISSING);
    assert_string_equal(r.err.advice, "give --spring-constant 0.1N/m");
    close_all(&r);
    o.spring_constant = 0.5;
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_exact(&r.curve.segments[0], WT_Q_FORCE, bending[0], 1);
    assert_exact(&r.curve.segments[0], WT_Q_DEFLECTION, bending[0], 2);
    close_all(&r);
}

static void serpentine_map(void **state)
{
    (void)state;
    /* 2 columns, 3 rows: 0 1 | 3 2 | 4 5 */
    static const long grid[LINES][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
    nid_writer_file f = make_file("N", true, false);
    reading r;
    f.map = "-1e-06;3e-06;2e-06;6e-06;2;3;0;1";
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(r.source->grid_columns, 2);
    assert_int_equal(r.source->grid_rows, 3);
    for (size_t i = 0; i < LINES; i++) {
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_int_equal(r.curve.grid_x, grid[i][0]);
        assert_int_equal(r.curve.grid_y, grid[i][1]);
        assert_near(r.curve.x, -1e-6 + 4e-6 * (double)grid[i][0], 1e-15);
        assert_near(r.curve.y, 2e-6 + 2e-6 * (double)grid[i][1], 1e-15);
    }
    close_all(&r);
    f.map = "1e-06;3e-06;2e-06;7e-06;1;6;0;1"; /* a line has no width */
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_near(r.curve.x, 1e-6, 1e-15);
    close_all(&r);
    f.map = "-1e-06;3e-06;2e-06;6e-06;2;3;0.3;1";
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_true(isnan(r.curve.x) && has_logged(&r, "rotated"));
    close_all(&r);
}

static void listed_positions(void **state)
{
    (void)state;
    static const double positions[LINES][3] = {{1.5e-6, -2e-6, 0}, {2.5e-6, -3e-6, 0},
                                               {3.5e-6, -4e-6, 0}, {4.5e-6, -5e-6, 0},
                                               {5.5e-6, -6e-6, 0}, {6.5e-6, -7e-6, 0}};
    nid_writer_file f = make_file("N", false, false);
    reading r;
    f.n_positions = LINES;
    f.positions = positions;
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    for (size_t i = 0; i < LINES; i++) {
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_near(r.curve.x, positions[i][0], 0);
        assert_near(r.curve.y, positions[i][1], 0);
        assert_int_equal(r.curve.grid_x, -1);
    }
    close_all(&r);
}

static void metadata(void **state)
{
    (void)state;
    static const char *const expected[][4] = {
        {"text encoding", "UTF-8", "", "the bytes of the header"},
        {"Spec forward: Deflection", "16 x 6 samples x curves, 32 bits", "V", "DataSet-0:0"},
        {"curves", "6", "", "Lines"},
        {"grid", "1 x 6, back and forth", "", "SpecMapTable"},
        {"segment 0", "approach (Spec forward), up to 16 points", "", ""},
        {"segment 2", "retract (Spec backward), up to 16 points", "", ""},
        {"spring constant", "0.5", "N/m", "given by the user"},
        {"deflection sensitivity", "9.5367431640625e-7", "m/V",
         "Calibration\\Scanhead, TipSignalDC / TipSignalDC1"}};
    nid_writer_file f = make_file("V", false, false);
    wt_read_options o = wt_read_defaults();
    wt_table *facts = NULL;
    reading r = {.log = NULL};
    f.map = "0;0;0;5e-06;1;6;0;1";
    f.deflection_range_m = 10 * 0x1p-20;
    o.spring_constant = 0.5;
    assert_int_equal(nid_write(&f), 0);
    assert_int_equal(wt_input_open(path, &r.input, NULL), WT_OK);
    assert_int_equal(wt_input_describe(formats, r.input, &o, NULL, &facts, &r.err), WT_OK);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        size_t row = 0;
        while (row < wt_table_n_rows(facts) &&
               strcmp(wt_table_text(facts, row, 0), expected[i][0]) != 0)
            row++;
        assert_true(row < wt_table_n_rows(facts));
        for (size_t c = 1; c < 4; c++)
            assert_string_equal(wt_table_text(facts, row, c), expected[i][c]);
    }
    for (size_t row = 0; row < wt_table_n_rows(facts); row++)
        assert_string_not_equal(wt_table_text(facts, row, 0), "missing");
    wt_table_free(facts);
    close_all(&r);
}

/* ---- images ------------------------------------------------------------------------------- */

/* 4 lines with 8 points, 8 um wide and 4 um high. */
static void write_scan(const nid_writer_channel *of_scan, size_t n, size_t missed)
{
    const nid_writer_group scan = {.name = "Scan forward",
                                   .points = 8,
                                   .lines = 4,
                                   .missed = missed,
                                   .x_name = "X*",
                                   .x_unit = "um",
                                   .y_name = "Y*",
                                   .y_unit = "m",
                                   .x_range = 8,
                                   .y_range = 4e-6,
                                   .n_channels = n,
                                   .channels = of_scan};
    nid_writer_file f = nid_writer_defaults();
    f.path = path;
    f.n_groups = 1;
    f.groups = &scan;
    assert_int_equal(nid_write(&f), 0);
}

static void image_with_known_rows(void **state)
{
    (void)state;
    double heights[4 * 8], phase[4 * 8];
    for (size_t i = 0; i < 32; i++) {
        heights[i] = ldexp((double)i, -30);
        phase[i] = 2.5 * (double)i;
    }
    const nid_writer_channel two[] = {
        {1, "Z-Axis", "m", -ldexp(1, -20), ldexp(1, -19), 16, heights},
        {3, "Phase", "\302\260", -160, 320, 32, phase},
    };
    write_scan(two, 2, 0);
    reading r;
    wt_image *images = NULL;
    size_t n = 0;
    open_input(&r, path);
    assert_int_equal(wt_images_read(formats, r.input, NULL, r.log, &images, &n, &r.err), WT_OK);
    assert_int_equal(n, 2);
    assert_string_equal(images[0].name, "Scan forward: Z-Axis");
    assert_string_equal(images[0].unit, "m");
    assert_string_equal(images[1].unit, "rad");
    assert_int_equal(images[0].n_columns, 8);
    assert_int_equal(images[0].n_rows, 4);
    assert_near(images[0].width, 8e-6, 1e-15);
    assert_near(images[0].height, 4e-6, 0);
    for (size_t i = 0; i < 32; i++) {
        assert_near(images[0].values[i], heights[i], 0);
        assert_near_abs(images[1].values[i], phase[i] * acos(-1) / 180, 1e-8);
    }
    /* The same file has no force curves and reports it. */
    assert_int_equal(wt_force_open(formats, r.input, NULL, r.log, &r.source, &r.err), WT_E_EMPTY);
    for (size_t i = 0; i < n; i++)
        wt_image_clear(&images[i]);
    free(images);
    close_all(&r);
}

/* Every change of the file length, or of its statement in the header, is detected. */
static void sizes_must_add_up(void **state)
{
    (void)state;
    static unsigned char bytes[65536];
    nid_writer_file f = make_file("N", true, false);
    assert_int_equal(nid_write(&f), 0);
    const size_t whole = read_bytes(bytes, sizeof bytes);
    wt_read_options o = wt_read_defaults();
    o.format = "nid"; /* the message of the reader is tested */
    for (size_t n = whole - 1500; n < whole + 3; n++) {
        reading r = {.log = NULL};
        assert_int_equal(wt_input_open_memory(bytes, n, "cut", &r.input, NULL), WT_OK);
        wt_status status = wt_force_open(formats, r.input, &o, NULL, &r.source, &r.err);
        assert_int_equal(status, n == whole ? WT_OK : WT_E_CORRUPT);
        close_all(&r);
    }
}

/* An impossible number of samples or lines. */
static void no_samples(void **state)
{
    (void)state;
    static const char *const keys[] = {"\r\nPoints=", "\r\nLines="};
    static unsigned char bytes[65536];
    for (size_t k = 0; k < 2; k++) {
        nid_writer_file f = make_file("N", false, false);
        wt_read_options o = wt_read_defaults();
        reading r = {.log = NULL};
        assert_int_equal(nid_write(&f), 0);
        const size_t n = read_bytes(bytes, sizeof bytes);
        unsigned char *at = memmem(bytes, n, keys[k], strlen(keys[k]));
        assert_non_null(at);
        for (at += strlen(keys[k]); *at >= '0' && *at <= '9'; at++)
            *at = '0';
        o.format = "nid";
        assert_int_equal(wt_input_open_memory(bytes, n, "none", &r.input, NULL), WT_OK);
        assert_int_equal(wt_force_open(formats, r.input, &o, NULL, &r.source, &r.err),
                         WT_E_CORRUPT);
        assert_non_null(strstr(r.err.message, "is missing or not understood"));
        close_all(&r);
    }
}

/* A complete downward scan ends at line 0; a stopped one has lines of a constant value. */
static void stopped_scans(void **state)
{
    (void)state;
    static const struct {
        size_t missed, flat_from, flat_to;
        const char *warning;
    } scans[] = {{0, 0, 0, NULL},
                 {3, 0, 0, NULL},
                 {1, 3, 4, "scan was stopped at line 2: 1 of 4 lines were not measured"},
                 {2, 0, 1, "scan was stopped at line 1: 1 of 4 lines were not measured"},
                 {2, 3, 4, NULL},
                 {3, 0, 4, NULL}};
    for (size_t k = 0; k < sizeof scans / sizeof scans[0]; k++) {
        double heights[4 * 8];
        for (size_t i = 0; i < 32; i++)
            heights[i] =
                i / 8 >= scans[k].flat_from && i / 8 < scans[k].flat_to ? 0 : ldexp((double)i, -30);
        const nid_writer_channel channel = {1,  "Z-Axis", "m", -ldexp(1, -20), ldexp(1, -19),
                                            16, heights};
        write_scan(&channel, 1, scans[k].missed);
        reading r;
        wt_image *images = NULL;
        size_t n = 0;
        open_input(&r, path);
        assert_int_equal(wt_images_read(formats, r.input, NULL, r.log, &images, &n, &r.err), WT_OK);
        assert_int_equal(wt_log_count(r.log), scans[k].warning != NULL ? 1 : 0);
        if (scans[k].warning != NULL)
            assert_string_equal(wt_log_get(r.log, 0).text, scans[k].warning);
        wt_image_clear(&images[0]);
        free(images);
        close_all(&r);
    }
}

/* ---- measured files, where present -------------------------------------------------------- */

static wt_image *read_shared(const char *name, size_t *n)
{
    wt_image *images = NULL;
    char full[512];
    reading r;
    snprintf(full, sizeof full, WT_SHARED_DIR "/data/afm/nanosurf/%s", name);
    if (access(full, R_OK) != 0)
        return NULL;
    open_input(&r, full);
    if (wt_images_read(formats, r.input, NULL, r.log, &images, n, &r.err) != WT_OK)
        fail_msg("%s: %s", name, r.err.message);
    close_all(&r);
    return images;
}

/* The header of this file states the peak as 772 fm/sqrt(Hz) at 179.8 kHz, in bins of 38.147 Hz. */
static void measured_thermal_spectrum(void **state)
{
    (void)state;
    size_t n = 0, peak = 0;
    wt_image *images = read_shared("thermal.nid", &n);
    if (images == NULL) {
        skip();
        return;
    }
    assert_int_equal(n, 2);
    const wt_image *s = &images[0];
    assert_string_equal(s->name, "Spectrum FFT: Amplitude Spectral Density");
    assert_string_equal(s->unit, "m/sqrt(Hz)");
    assert_string_equal(s->x_unit, "Hz");
    assert_int_equal(s->n_rows, 1);
    assert_int_equal(s->n_columns, 8369);
    double bin = s->width / (double)(s->n_columns - 1);
    assert_near(bin, 38.147, 1e-5);
    /* The fit range of the instrument excludes the noise at low frequency. */
    for (size_t i = (size_t)(114e3 / bin); i < (size_t)(266e3 / bin); i++)
        peak = s->values[i] > s->values[peak] || peak == 0 ? i : peak;
    assert_near_abs(s->values[peak], 777e-15, 0.5e-15);
    assert_near_abs(s->x_min + bin * (double)peak, 179787, 0.5);
    clear_images(images, n);
}

static double correlation(const wt_image *a, const wt_image *b, bool mirrored)
{
    size_t n = a->n_columns, m = n * a->n_rows;
    double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < m; i++) {
        mean_a += a->values[i] / (double)m;
        mean_b += b->values[i] / (double)m;
    }
    for (size_t i = 0; i < m; i++) {
        double x = a->values[i] - mean_a;
        double y = b->values[mirrored ? i - i % n + n - 1 - i % n : i] - mean_b;
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return ab / sqrt(aa * bb);
}

static void measured_images(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        size_t n, side;
        double width;
    } files[] = {{"image.nid", 6, 256, 7.40729e-6},
                 {"circles.nid", 4, 256, 5e-5},
                 {"20160301DKRUStorageMedium10um.nid", 4, 128, 1e-5}};
    for (size_t i = 0; i < 3; i++) {
        size_t n = 0;
        wt_image *images = read_shared(files[i].name, &n);
        if (images == NULL) {
            skip();
            return;
        }
        assert_int_equal(n, files[i].n);
        for (size_t j = 0; j < n; j++) {
            assert_int_equal(images[j].n_columns, files[i].side);
            assert_int_equal(images[j].n_rows, files[i].side);
            assert_near(images[j].width, files[i].width, 1e-12);
            assert_near(images[j].height, files[i].width, 1e-12);
        }
        /* Forward and backward scans show the same surface in the same orientation. */
        assert_string_equal(images[0].unit, "m");
        assert_true(correlation(&images[0], &images[n / 2], false) > 0.7);
        assert_true(correlation(&images[0], &images[n / 2], true) < 0.2);
        clear_images(images, n);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_versions_encodings),
        cmocka_unit_test(without_pause),
        cmocka_unit_test(user_calibration),
        cmocka_unit_test(missing_calibration),
        cmocka_unit_test(force_without_spring_constant),
        cmocka_unit_test(serpentine_map),
        cmocka_unit_test(listed_positions),
        cmocka_unit_test(metadata),
        cmocka_unit_test(image_with_known_rows),
        cmocka_unit_test(stopped_scans),
        cmocka_unit_test(sizes_must_add_up),
        cmocka_unit_test(no_samples),
        cmocka_unit_test(measured_thermal_spectrum),
        cmocka_unit_test(measured_images),
    };
    return cmocka_run_group_tests(tests, set_up, clean);
}
