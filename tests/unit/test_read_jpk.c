/* JPK files with known content by the independent writer: the reader returns the written values, to
 * the step of the stored numbers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/force_assembler.h"
#include "read/jpk/jpk.h"
#include "reader_fixture.h"

#include "writers/jpk_writer.h"

#include <zip.h>

#define MAX_POINTS 64

/* Curves with various numbers: approach, pause, modulation, retract, with different lengths. */
typedef struct sample {
    double height[4][MAX_POINTS], force[4][MAX_POINTS], sensor[4][MAX_POINTS];
    jpk_writer_segment segments[4];
    jpk_writer_curve curve;
} sample;

static void make_sample(sample *s, size_t index)
{
    static const char *const styles[] = {"extend", "pause", "modulation", "retract"};
    static const size_t points[] = {60, 11, 17, 40};
    for (size_t k = 0; k < 4; k++) {
        size_t n = points[k] - index % 3;
        for (size_t i = 0; i < n; i++) {
            double t = (double)i / (double)n;
            s->height[k][i] = 7.3e-6 - 2.385e-6 * t + 1e-8 * (double)index;
            s->force[k][i] = -3.1e-10 + 4.77e-9 * t * t * (1 + 0.1 * (double)index);
            s->sensor[k][i] = 1.1e-6 - 2.2e-6 * t;
        }
        s->segments[k] = (jpk_writer_segment){.style = styles[k],
                                              .n = n,
                                              .duration = 0.25 + 0.5 * (double)k,
                                              .height = s->height[k],
                                              .force = s->force[k],
                                              .measured_height = k == 1 ? NULL : s->sensor[k]};
    }
    s->curve = (jpk_writer_curve){.index = index,
                                  .x = 1.5e-6 * (double)index,
                                  .y = -2.5e-6,
                                  .n_segments = 4,
                                  .segments = s->segments};
}

static sample samples[3];
static jpk_writer_curve curves[3];

/* A map of 3 x 2 positions, of which 0, 4 and 5 were measured. */
static jpk_writer_file make_file(void)
{
    static const size_t index[] = {0, 4, 5};
    for (size_t i = 0; i < 3; i++) {
        make_sample(&samples[i], index[i]);
        curves[i] = samples[i].curve;
    }
    jpk_writer_file f = jpk_writer_defaults();
    f.path = path;
    f.map = true;
    f.n_curves = 3;
    f.curves = curves;
    f.columns = 3;
    f.rows = 2;
    f.back_and_forth = true;
    f.n_planned = 6;
    f.spring_constant = 0.0477;
    f.sensitivity = 61.3e-9;
    f.setpoint = 2.5e-9;
    return f;
}

static void assert_values(const wt_segment *s, wt_quantity quantity, const double *expected,
                          double step)
{
    const wt_channel *c = wt_segment_channel(s, quantity);
    assert_non_null(c);
    for (size_t i = 0; i < s->n_points; i++)
        assert_near_abs(c->values[i], expected[i], step + 1e-15 * 1e-4);
}

static void assert_curve(const wt_force_curve *c, const sample *s, const jpk_writer_file *f)
{
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_MODULATION, WT_SEGMENT_RETRACT};
    double start = 0;
    assert_int_equal(c->index, s->curve.index);
    assert_near(c->x, s->curve.x, 0);
    assert_near(c->y, s->curve.y, 0);
    assert_near(c->cantilever.spring_constant, f->spring_constant, 0);
    assert_near(c->cantilever.sensitivity, f->sensitivity, 0);
    assert_false(c->cantilever.spring_constant_is_overridden ||
                 c->cantilever.sensitivity_is_overridden);
    assert_int_equal(c->n_segments, 4);
    double single = f->encoding == JPK_WRITE_FLOAT ? 6e-8 : 0;
    for (size_t k = 0; k < 4; k++) {
        const wt_segment *segment = &c->segments[k];
        const jpk_writer_segment *w = &s->segments[k];
        assert_int_equal(segment->kind, kinds[k]);
        assert_int_equal(segment->index, k);
        assert_int_equal(segment->n_points, w->n);
        assert_near(segment->duration, w->duration, 0);
        assert_values(segment, WT_Q_HEIGHT, w->height, jpk_writer_height_step(f) + single * 2.5e-5);
        assert_values(segment, WT_Q_FORCE, w->force, jpk_writer_force_step(f) + single * 1e-8);
        if (w->measured_height == NULL)
            assert_null(wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT));
        const wt_channel *force = wt_segment_channel(segment, WT_Q_FORCE);
        const wt_channel *bending = wt_segment_channel(segment, WT_Q_DEFLECTION);
        const wt_channel *volts = wt_segment_channel(segment, WT_Q_DEFLECTION_VOLTAGE);
        const wt_channel *time = wt_segment_channel(segment, WT_Q_TIME);
        for (size_t i = 0; i < w->n; i++) {
            assert_near(bending->values[i] * f->spring_constant, force->values[i], 1e-12);
            assert_near(volts->values[i] * f->sensitivity, bending->values[i], 1e-12);
            assert_near_abs(time->values[i], start + w->duration * (double)i / (double)w->n, 1e-14);
        }
        start += w->duration;
    }
    assert_near(c->segments[0].setpoint, f->setpoint, 1e-14);
    const jpk_writer_segment *approach = &s->segments[0];
    double range = approach->height[0] - approach->height[approach->n - 1];
    assert_near(c->segments[0].velocity, range / approach->duration, 1e-12);
    assert_true(isnan(c->segments[1].velocity) && isnan(c->segments[3].setpoint));
}

static void round_trip(jpk_writer_file f)
{
    reading r;
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_count(r.source), f.n_curves);
    assert_int_equal(r.source->grid_columns, f.map ? 3 : 0);
    for (size_t i = 0; i < f.n_curves; i++) {
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_curve(&r.curve, &samples[i], &f);
    }
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
    close_all(&r);
}

static void every_encoding_and_layout(void **state)
{
    (void)state;
    for (int layout = 0; layout < 16; layout++) {
        jpk_writer_file f = make_file();
        f.encoding = (jpk_writer_encoding)(layout & 3);
        f.inline_headers = (layout & 4) != 0;
        f.folders = (layout & 8) != 0;
        round_trip(f);
    }
}

static void single_curve(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    f.map = false;
    f.n_curves = 1;
    round_trip(f);
}

static void missing_indices(void **state)
{
    (void)state;
    /* Positions 0 1 2 | 5 4 3: the second row is in reverse. */
    static const long grid[][2] = {{0, 0}, {1, 1}, {0, 1}};
    jpk_writer_file f = make_file();
    reading r;
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_int_equal(r.curve.grid_x, grid[i][0]);
        assert_int_equal(r.curve.grid_y, grid[i][1]);
    }
    assert_true(has_logged(&r, "3 of the 6 curves"));
    close_all(&r);
}

static void only_requested_channels(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    wt_read_options o = wt_read_defaults();
    reading r;
    o.want = WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_TIME);
    o.segments = WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, &o), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_int_equal(r.curve.n_segments, 1);
    const wt_segment *s = &r.curve.segments[0];
    assert_int_equal(s->kind, WT_SEGMENT_RETRACT);
    assert_int_equal(s->index, 3);
    assert_int_equal(s->n_channels, 2);
    /* Segments that are not read still have a duration. */
    assert_near(wt_segment_channel(s, WT_Q_TIME)->values[0], 0.25 + 0.75 + 1.25, 1e-15);
    close_all(&r);
}

/* If the force does not follow from the distance, two slots imply the spring constant. */
static void indirect_spring_constant(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    wt_read_options o = wt_read_defaults();
    f.force_from_volts = true;
    assert_int_equal(jpk_write(&f), 0);
    for (int given = 0; given < 2; given++) {
        reading r;
        assert_int_equal(open_force(&r, path, &o), WT_OK);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        const double factor = given ? 0.2 / f.spring_constant : 1;
        const wt_channel *force = wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE);
        assert_near(r.curve.cantilever.spring_constant, factor * f.spring_constant, 1e-15);
        for (size_t i = 0; i < samples[0].segments[0].n; i++)
            assert_near_abs(force->values[i], factor * samples[0].force[0][i],
                            factor * jpk_writer_force_step(&f) + 1e-22);
        close_all(&r);
        o.spring_constant = 0.2;
    }
}

static void user_calibration(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    assert_int_equal(jpk_write(&f), 0);
    static const double given[][2] = {{0.1, (double)NAN}, {(double)NAN, 100e-9}, {0.1, 100e-9}};
    for (size_t i = 0; i < 3; i++) {
        wt_read_options o = wt_read_defaults();
        reading r;
        o.spring_constant = given[i][0];
        o.sensitivity = given[i][1];
        double k = isnan(given[i][0]) ? f.spring_constant : given[i][0];
        double s = isnan(given[i][1]) ? f.sensitivity : given[i][1];
        assert_int_equal(open_force(&r, path, &o), WT_OK);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        const wt_channel *force = wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE);
        double factor = k * s / (f.spring_constant * f.sensitivity);
        for (size_t j = 0; j < samples[0].segments[0].n; j++)
            assert_near_abs(force->values[j], factor * samples[0].force[0][j],
                            factor * jpk_writer_force_step(&f) + 1e-22);
        assert_near(r.curve.cantilever.spring_constant, k, 0);
        assert_near(r.curve.cantilever.sensitivity, s, 0);
        assert_int_equal(r.curve.cantilever.spring_constant_is_overridden, !isnan(given[i][0]));
        assert_int_equal(r.curve.cantilever.sensitivity_is_overridden, !isnan(given[i][1]));
        assert_near(r.curve.segments[0].setpoint, factor * f.setpoint, 1e-14);
        close_all(&r);
    }
}

static void missing_calibration(void **state)
{
    (void)state;
    static const struct {
        double spring_constant, sensitivity;
        const char *advice;
    } cases[] = {
        {(double)NAN, (double)NAN, "give --spring-constant 0.1N/m and --sensitivity 60nm/V"},
        {(double)NAN, 60e-9, "give --spring-constant 0.1N/m"},
    };
    for (size_t i = 0; i < 2; i++) {
        jpk_writer_file f = make_file();
        wt_read_options o = wt_read_defaults();
        reading r;
        f.spring_constant = cases[i].spring_constant;
        f.sensitivity = cases[i].sensitivity;
        assert_int_equal(jpk_write(&f), 0);
        /* Requested by name: an error for each curve. */
        o.want = WT_Q_BIT(WT_Q_FORCE);
        assert_int_equal(open_force(&r, path, &o), WT_OK);
        for (size_t j = 0; j < 3; j++) {
            assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_MISSING);
            assert_string_equal(r.err.advice, cases[i].advice);
            assert_int_equal(r.err.status, WT_E_MISSING);
            assert_string_equal(r.err.file, path);
            assert_int_equal(r.curve.n_segments, 0);
        }
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        close_all(&r);
        /* If all are requested: a warning, and the volts. */
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_null(wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE));
        assert_non_null(wt_segment_channel(&r.curve.segments[0], WT_Q_DEFLECTION_VOLTAGE));
        char words[160];
        snprintf(words, sizeof words, "no force: the file does not say the spring constant%s; %s",
                 i == 0 ? " and deflection sensitivity" : "", cases[i].advice);
        assert_true(has_logged(&r, words));
        close_all(&r);
        /* Stated by the user. */
        o.spring_constant = 0.2;
        o.sensitivity = 50e-9;
        assert_int_equal(open_force(&r, path, &o), WT_OK);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        assert_non_null(wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE));
        close_all(&r);
    }
}

/* Volts are not a height; the rest of the curve is read. */
static void height_without_conversion(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    reading r;
    f.bare_height = true;
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_null(wt_segment_channel(&r.curve.segments[0], WT_Q_HEIGHT));
    assert_non_null(wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE));
    assert_true(has_logged(&r, "left out: it has no calibration"));
    close_all(&r);
}

/* A height that cannot be decoded is reported with its text in the file. */
static void height_of_unknown_type(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    reading r;
    f.odd_height = true;
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    assert_null(wt_segment_channel(&r.curve.segments[0], WT_Q_HEIGHT));
    assert_non_null(wt_segment_channel(&r.curve.segments[0], WT_Q_FORCE));
    assert_true(has_logged(&r, "channel height left out"));
    assert_true(has_logged(&r, "oddinteger"));
    close_all(&r);
}

/* The largest permitted number of channels; one more is refused with a message. */
static void many_channels(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    for (unsigned i = 0; i < 2; i++) {
        reading r;
        f.n_more = JPK_CHANNELS - 3 + i;
        assert_int_equal(jpk_write(&f), 0);
        wt_status status = open_force(&r, path, NULL);
        if (status == WT_OK)
            status = wt_force_next(r.source, &r.curve, &r.err);
        assert_int_equal(status, i == 0 ? WT_OK : WT_E_UNSUPPORTED);
        close_all(&r);
    }
}

/* Truncated at many positions: complete data are read and equal the written ones. */
static void truncated_file(void **state)
{
    (void)state;
    static unsigned char bytes[65536];
    jpk_writer_file f = make_file();
    assert_int_equal(jpk_write(&f), 0);
    const size_t whole = read_bytes(bytes, sizeof bytes);
    assert_in_range(whole, 1000, sizeof bytes - 1);
    size_t most = 0;
    for (size_t n = 0; n < whole; n += 13) {
        reading r = {.log = wt_log_new()};
        assert_int_equal(wt_input_open_memory(bytes, n, "cut", &r.input, NULL), WT_OK);
        wt_status status = wt_force_open(formats, r.input, NULL, r.log, &r.source, &r.err);
        size_t read = 0;
        while (status == WT_OK) {
            status = wt_force_next(r.source, &r.curve, &r.err);
            if (status != WT_OK)
                break;
            assert_true(has_logged(&r, "end of the archive is missing"));
            assert_values(&r.curve.segments[0], WT_Q_FORCE, samples[read].force[0],
                          jpk_writer_force_step(&f));
            read++;
        }
        most = read > most ? read : most;
        close_all(&r);
    }
    assert_int_equal(most, 3);
}

static void metadata(void **state)
{
    (void)state;
    static const char *const expected[][2] = {{"format", "jpk"},
                                              {"instrument", "WT-TEST"},
                                              {"curves", "3"},
                                              {"curves planned", "6"},
                                              {"grid", "3 x 2, back and forth"},
                                              {"spring constant", "0.0477"},
                                              {"segment 1", "dwell (pause), 11 points"},
                                              {"segment 3 channel vDeflection", "force"},
                                              {"segment 3 channel height", "height"}};
    jpk_writer_file f = make_file();
    wt_table *facts = NULL;
    reading r = {.log = NULL};
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(wt_input_open(path, &r.input, NULL), WT_OK);
    assert_int_equal(wt_input_describe(formats, r.input, NULL, NULL, &facts, &r.err), WT_OK);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const char *value = NULL;
        for (size_t row = 0; row < wt_table_n_rows(facts); row++)
            if (strcmp(wt_table_text(facts, row, 0), expected[i][0]) == 0)
                value = wt_table_text(facts, row, 1);
        assert_string_equal(value != NULL ? value : "(none)", expected[i][1]);
    }
    wt_table_free(facts);
    close_all(&r);
}

/* Header of a curve in a map, and of the only one in a file. */
static void lost_segments(void **state)
{
    (void)state;
    for (int map = 0; map < 2; map++) {
        jpk_writer_file f = make_file();
        f.map = map != 0;
        f.n_curves = map != 0 ? 3 : 1;
        f.n_planned = 0;
        f.columns = f.rows = 0;
        f.miscounted = &curves[f.n_curves - 1];
        size_t n_declared = 0;
        reading r;
        assert_int_equal(jpk_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        for (size_t i = 0; i < f.n_curves; i++)
            assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        for (size_t i = 0; i < wt_log_count(r.log); i++) {
            const wt_log_entry e = wt_log_get(r.log, i);
            if (strstr(e.text, "of the 5 segments that its header counts") == NULL)
                continue;
            assert_int_equal(e.severity, WT_WARNING);
            assert_int_equal(e.count, 1);
            assert_non_null(strstr(e.text, "the curve has 4 "));
            n_declared++;
        }
        assert_int_equal(n_declared, 1);
        close_all(&r);
    }
}

/* Position where the header of a curve is truncated. */
static void lost_position(void **state)
{
    (void)state;
    for (int lost = 0; lost < 2; lost++) {
        jpk_writer_file f = make_file();
        size_t n_declared = 0;
        reading r;
        curves[1].y = lost != 0 ? (double)NAN : curves[1].y;
        assert_int_equal(jpk_write(&f), 0);
        assert_int_equal(open_force(&r, path, NULL), WT_OK);
        for (size_t i = 0; i < f.n_curves; i++)
            assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
        for (size_t i = 0; i < wt_log_count(r.log); i++)
            n_declared += strstr(wt_log_get(r.log, i).text, "says no position") != NULL;
        assert_int_equal(n_declared, lost);
        close_all(&r);
    }
}

static void truncated_header(void **state)
{
    (void)state;
    jpk_writer_file f = make_file();
    reading r;
    bool said = false;
    f.map = false;
    f.n_curves = 1;
    f.n_planned = 0;
    f.columns = f.rows = 0;
    f.without_rest = &samples[0].segments[3];
    assert_int_equal(jpk_write(&f), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_OK);
    for (size_t i = 0; i < wt_log_count(r.log); i++) {
        const wt_log_entry e = wt_log_get(r.log, i);
        said |= e.severity == WT_WARNING && strstr(e.text, "lists no channels") != NULL;
    }
    assert_true(said);
    close_all(&r);
}

/* An entry that unpacks to far more than its points need is refused before unpacking, because it
 * would fill the memory. */
static void oversized_entry(void **state)
{
    (void)state;
    enum { SWOLLEN = 8 << 20 };
    jpk_writer_file f = make_file();
    reading r = {.log = NULL};
    f.map = false;
    f.n_curves = 1;
    f.n_planned = 0;
    f.columns = f.rows = 0;
    assert_int_equal(jpk_write(&f), 0);
    void *zeros = calloc(1, SWOLLEN);
    assert_non_null(zeros);
    zip_t *zip = zip_open(path, 0, NULL);
    assert_non_null(zip);
    const zip_int64_t i = zip_name_locate(zip, "segments/0/channels/height.dat", 0);
    assert_true(i >= 0);
    assert_int_equal(
        zip_file_replace(zip, (zip_uint64_t)i, zip_source_buffer(zip, zeros, SWOLLEN, 1), 0), 0);
    assert_int_equal(zip_close(zip), 0);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_CORRUPT);
    assert_non_null(strstr(r.err.message, "too large for what it is"));
    close_all(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_encoding_and_layout),
        cmocka_unit_test(single_curve),
        cmocka_unit_test(missing_indices),
        cmocka_unit_test(only_requested_channels),
        cmocka_unit_test(indirect_spring_constant),
        cmocka_unit_test(user_calibration),
        cmocka_unit_test(missing_calibration),
        cmocka_unit_test(height_without_conversion),
        cmocka_unit_test(height_of_unknown_type),
        cmocka_unit_test(many_channels),
        cmocka_unit_test(truncated_file),
        cmocka_unit_test(metadata),
        cmocka_unit_test(lost_segments),
        cmocka_unit_test(lost_position),
        cmocka_unit_test(truncated_header),
        cmocka_unit_test(oversized_entry),
    };
    return cmocka_run_group_tests(tests, set_up, clean);
}
