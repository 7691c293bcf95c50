/* Every force curve file of the shared reference data, if they exist: detected format, or refusal
 * with its message. Channels are compared with those of another program: n, min, max, mean, first,
 * last of force, heights and time, with positions, calibration, set-point and velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "all_formats.h"
#include "assert_near.h"

#include "weartrack/read.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define REFERENCE WT_SHARED_DIR "/reference/force-curve-channels.csv"
#define MORE WT_SHARED_DIR "/data/afm-more/force-curve-channels2.csv"
#define DATA WT_SHARED_DIR "/data/"
#define MAX_FIELDS 20
#define CALIBRATION_FILE "fmt-jpk-cl_calibration_force-save-2015.02.04-11.25.21.294.jpk-force"

enum field {
    FILE_NAME,
    ENUM,
    MODALITY,
    GRID_X,
    GRID_Y,
    POS_X,
    POS_Y,
    SPRING_CONSTANT,
    SENSITIVITY,
    SETPOINT,
    SPEED,
    RATE,
    SEGMENT,
    COLUMN,
    N,
    MIN,
    MAX,
    MEAN,
    FIRST,
    LAST,
    N_FIELDS
};

/* Properties of each file; a file that is not listed fails. */
typedef struct known_file {
    const char *folder, *name;
    const char *format;  /* detected format; NULL: none */
    const char *refused; /* words of the message if there is no curve */
    size_t curves;
    double spring_constant, sensitivity; /* stated value, 0: none */
    size_t rows;                         /* rows of the reference */
} known_file;

static const known_file known_files[] = {
    {"afm/asylum", "fmt-igor-fd_SiN_FD_plot.ibw", "ibw", NULL, 1, 0, 0, 3},
    {"afm/bruker", "20200904_Egel4-Z1.0_00025.spm", "nanoscope", NULL, 1, 0, 0, 0},
    {"afm/bruker", "Test.000", "nanoscope", NULL, 1, 0, 0, 0},
    {"afm/hdf5", "fmt-hdf5-fd_version_0.13.3.h5", "afmformats-h5", NULL, 1, 0, 0, 8},
    {"afm/jpk", "fmt-jpk-cc_pr14-polymergel-2021.06.30.jpk-force", "jpk", NULL, 1, 0, 0, 12},
    {"afm/jpk", CALIBRATION_FILE, "jpk", NULL, 1, 0.05, 60e-9, 8},
    {"afm/jpk", "fmt-jpk-fd_2020.02.07-16.29.05.036.jpk-qi-data", "jpk", NULL, 4, 0, 0, 32},
    {"afm/jpk", "fmt-jpk-fd_flipsign_2015.05.22-15.31.49.352.jpk-force", "jpk", NULL, 1, 0, 0, 8},
    {"afm/jpk", "fmt-jpk-fd_map-data-reference-points.jpk-force-map", "jpk", NULL, 3, 0, 0, 24},
    {"afm/jpk", "fmt-jpk-fd_map1d_2016-11-07.jpk-force-map", "jpk", NULL, 8, 0, 0, 64},
    {"afm/jpk", "fmt-jpk-fd_single_bad_2017-01-16_2.jpk-force", "jpk", NULL, 1, 0, 0, 8},
    {"afm/jpk", "fmt-jpk-fd_single_bad_bead7_2017-04-27.jpk-force", "jpk", NULL, 1, 0, 0, 8},
    {"afm/jpk", "fmt-jpk-fd_single_tilted-baseline-drift-mitotic_2021-01-29.jpk-force", "jpk", NULL,
     1, 0, 0, 8},
    {"afm/jpk", "fmt-jpk-sr_cell1-0008.jpk-force", "jpk", NULL, 1, 0, 0, 16},
    {"afm/jpk", "force-map2x2-example.jpk-force-map", "jpk", NULL, 4, 0, 0, 32},
    {"afm/jpk", "force-save-example.jpk-force", "jpk", NULL, 1, 0, 0, 8},
    {"afm/jpk", "map-data-2022.10.29-12.27.34.564.jpk-force-map", "jpk", NULL, 16, 0, 0, 128},
    {"afm/jpk-text", "force-save-JPK-3h.txt.gz", "jpk-text", NULL, 1, 0, 0, 0},
    {"afm/nanosurf", "20160301DKRUStorageMedium10um.nid", "nid", "no force curve", 0, 0, 0, 0},
    {"afm/nanosurf", "circles.nid", "nid", "no force curve", 0, 0, 0, 0},
    {"afm/nanosurf", "image.nid", "nid", "no force curve", 0, 0, 0, 0},
    {"afm/nanosurf", "thermal.nid", "nid", "no force curve", 0, 0, 0, 0},
    {"afm/text", "fmt-afm-workshop-fd_single_2018-08-01_13.06.09.csv", "afm-workshop", NULL, 1,
     0.05, 60e-9, 4},
    {"afm/text", "fmt-afm-workshop-fd_single_2021-01-15.csv", "afm-workshop", NULL, 1, 0.05, 60e-9,
     4},
    {"afm/text", "fmt-chiaro-txt_AEBP1_Indentation_002.txt", "chiaro", NULL, 1, 0, 0, 10},
    {"afm/text", "fmt-ntmdt-txt-fd_2015_01_17_gel4-0,1_mQ_adh_6B_Curve_DFL_Height_51.txt",
     "ntmdt-text", NULL, 1, 0.05, 60e-9, 4},
    {"afm/text", "fmt-tab-fd_version_0.13.3.tab", "afmformats-tab", NULL, 1, 0, 0, 6},
    {"afm/text", "veeco_file.txt.gz", "nanoscope-text", NULL, 1, 0, 0, 0},
    {"afm-more", "ForceCurve_009.tiff", "park", NULL, 7, 0, 0, 0},
    {"afm-more", "Test.001", "nanoscope", NULL, 1, 0, 0, 0},
    {"afm-more", "Test.003", "nanoscope", NULL, 256, 0, 0, 0},
    {"afm-more", "mac-double.ibw", NULL, "Igor", 0, 0, 0, 0},
    {"afm-more", "mac-version2.ibw", NULL, "Igor", 0, 0, 0, 0},
    {"afm-more", "mac-version5.ibw", "ibw", "no force curve", 0, 0, 0, 0},
    {"afm-more", "win-double.ibw", NULL, "Igor", 0, 0, 0, 0},
    {"afm-more", "win-version2.ibw", NULL, "Igor", 0, 0, 0, 0},
    {"afm-more", "win-version5.ibw", "ibw", "no force curve", 0, 0, 0, 0},
};
enum { N_KNOWN = sizeof known_files / sizeof *known_files };

/* The open file and curve; the rows of the reference are in their order. */
typedef struct open_file {
    const known_file *known;
    wt_input *input;
    wt_force_source *source;
    wt_log *log;
    wt_force_curve curve;
    size_t n, rows; /* curves read, rows of the reference */
} open_file;

static void fail_with(const wt_error *err)
{
    char text[1024];
    wt_error_format(err, text, sizeof text);
    fail_msg("%s", text);
}

static const known_file *find_known(const char *folder, const char *name)
{
    for (size_t i = 0; i < N_KNOWN; i++)
        if (strcmp(known_files[i].folder, folder) == 0 && strcmp(known_files[i].name, name) == 0)
            return &known_files[i];
    return NULL;
}

static wt_input *open_input(const known_file *k)
{
    char path[512];
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    snprintf(path, sizeof path, DATA "%s/%s", k->folder, k->name);
    if (wt_input_open(path, &input, &err) != WT_OK)
        fail_with(&err);
    return input;
}

/* This file is not calibrated: the force is missing, and the error states the required options. The
 * reference was made with these two values. */
static void is_uncalibrated(open_file *f, wt_read_options o)
{
    wt_error err = WT_ERROR_INIT;
    o.want = WT_Q_BIT(WT_Q_FORCE);
    assert_int_equal(wt_force_open(formats, f->input, &o, f->log, &f->source, &err), WT_OK);
    assert_int_equal(wt_force_next(f->source, &f->curve, &err), WT_E_MISSING);
    assert_string_equal(err.advice, "give --spring-constant 0.1N/m and --sensitivity 60nm/V");
    assert_int_equal(wt_force_next(f->source, &f->curve, &err), WT_END);
    wt_force_close(f->source);
}

static void open_source(open_file *f, const known_file *known)
{
    wt_error err = WT_ERROR_INIT;
    wt_read_options o = wt_read_defaults();
    *f = (open_file){.known = known, .input = open_input(known), .log = wt_log_new()};
    if (known->spring_constant > 0) {
        is_uncalibrated(f, o);
        o.spring_constant = known->spring_constant;
        o.sensitivity = known->sensitivity;
    }
    if (wt_force_open(formats, f->input, &o, f->log, &f->source, &err) != WT_OK)
        fail_with(&err);
}

static void next_curve(open_file *f)
{
    wt_error err = WT_ERROR_INIT;
    if (wt_force_next(f->source, &f->curve, &err) != WT_OK)
        fail_with(&err);
    f->n++;
}

static void close_file(open_file *f)
{
    if (f->known != NULL) {
        /* The reference contains all curves of the file. */
        assert_int_equal(wt_force_next(f->source, &f->curve, NULL), WT_END);
        assert_int_equal(wt_force_count(f->source), f->n);
        assert_int_equal(f->rows, f->known->rows);
    }
    wt_force_close(f->source);
    wt_input_close(f->input);
    wt_log_free(f->log);
    wt_force_curve_clear(&f->curve);
    *f = (open_file){.n = 0};
}

/* ---- properties of each file ------------------------------------------------------------------
 */

static void check_file(const known_file *k)
{
    wt_error err = WT_ERROR_INIT;
    const wt_format_info *info = NULL;
    wt_input *input = open_input(k);
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    char text[1024];
    size_t n = 0;
    wt_status status = wt_format_detect(formats, input, NULL, 0, &info, &err);
    if ((status == WT_OK) != (k->format != NULL) ||
        (status == WT_OK && strcmp(info->id, k->format) != 0))
        fail_msg("%s is recognised as %s: %s", k->name, status == WT_OK ? info->id : "nothing",
                 err.message);
    if (status == WT_OK)
        status = wt_force_open(formats, input, NULL, NULL, &source, &err);
    while (status == WT_OK && (status = wt_force_next(source, &curve, &err)) == WT_OK)
        n++;
    wt_error_format(&err, text, sizeof text);
    if (k->refused != NULL ? status == WT_END || strstr(text, k->refused) == NULL
                           : status != WT_END)
        fail_msg("%s: %s", k->name, text);
    if (n != k->curves)
        fail_msg("%s: %zu curves", k->name, n);
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    wt_input_close(input);
}

static size_t check_folder(const char *folder)
{
    char path[512];
    size_t n = 0;
    snprintf(path, sizeof path, DATA "%s", folder);
    DIR *dir = opendir(path);
    assert_non_null(dir);
    for (const struct dirent *e; (e = readdir(dir)) != NULL;) {
        if (e->d_name[0] == '.' || strcmp(e->d_name, "force-curve-channels2.csv") == 0)
            continue;
        const known_file *k = find_known(folder, e->d_name);
        if (k == NULL)
            fail_msg("%s/%s is not in the list", folder, e->d_name);
        check_file(k);
        n++;
    }
    closedir(dir);
    return n;
}

static void every_file(void **state)
{
    (void)state;
    size_t n = 0;
    if (access(REFERENCE, R_OK) != 0)
        skip();
    for (size_t i = 0; i < N_KNOWN; i++)
        if (i == 0 || strcmp(known_files[i].folder, known_files[i - 1].folder) != 0)
            n += check_folder(known_files[i].folder);
    assert_int_equal(n, N_KNOWN);
}

/* ---- against the reference --------------------------------------------------------------------
 */

/* Empty fields are unknown in the reference, which has 12 digits. */
static void check(const char *what, double actual, const char *text, double scale, const char *row)
{
    if (*text == '\0')
        return;
    double expected = strtod(text, NULL);
    double allowed = 1e-9 * fmax(fabs(expected), scale);
    if (!(fabs(actual - expected) <= allowed))
        fail_msg("%s is %.17g, not %.17g, in: %s", what, actual, expected, row);
}

typedef struct summary {
    size_t n, missing;
    double low, high, sum, first, last;
} summary;

static const summary nothing = {.low = (double)INFINITY, .high = -(double)INFINITY};

static void add(summary *s, const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        s->missing += isnan(values[i]) ? 1 : 0;
        s->low = fmin(s->low, values[i]);
        s->high = fmax(s->high, values[i]);
        s->sum += isnan(values[i]) ? 0 : values[i];
    }
    s->first = s->n == 0 ? values[0] : s->first;
    s->last = values[n - 1];
    s->n += n;
}

/* min, max, mean, first, last; a mean near zero is only as accurate as its terms. */
static void check_summary(const summary *s, char *const *field, double floor, const char *row)
{
    const double scale = fmax(fmax(fabs(s->low), fabs(s->high)), floor);
    check("min", s->low, field[0], floor, row);
    check("max", s->high, field[1], floor, row);
    check("mean", s->sum / (double)(s->n - s->missing), field[2], scale, row);
    check("first", s->first, field[3], floor, row);
    check("last", s->last, field[4], floor, row);
}

static wt_quantity quantity_of(const char *column)
{
    static const struct {
        const char *name;
        wt_quantity quantity;
    } known[] = {{"force", WT_Q_FORCE},
                 {"height (measured)", WT_Q_MEASURED_HEIGHT},
                 {"height (piezo)", WT_Q_HEIGHT},
                 {"time", WT_Q_TIME}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(column, known[i].name) == 0)
            return known[i].quantity;
    fail_msg("the reference has an unknown column %s", column);
    return WT_Q_NONE;
}

/* The reference of the Igor wave has approach and retraction as one segment; that of the Chiaro
 * counts the turning sample as retraction. */
static summary summarise(const wt_force_curve *curve, size_t number, wt_quantity q, const char *row)
{
    const bool whole = strncmp(row, "asylum/", 7) == 0;
    const bool turns = strstr(row, "chiaro") != NULL;
    const size_t end = whole ? curve->n_segments : number + 1;
    summary s = nothing;
    for (size_t i = number; i < end; i++) {
        const wt_segment *segment = &curve->segments[i];
        const wt_channel *channel = wt_segment_channel(segment, q);
        if (channel == NULL) {
            fail_msg("no channel for: %s", row);
            break;
        }
        if (turns && i == 1)
            add(&s,
                wt_segment_channel(&curve->segments[0], q)->values + curve->segments[0].n_points -
                    1,
                1);
        add(&s, channel->values, segment->n_points - (turns && i == 0));
    }
    /* The other program reads the numbers of NT-MDT without a unit as nanovolts. */
    const double unit = strstr(row, "ntmdt") != NULL && q == WT_Q_FORCE ? 1e-9 : 1;
    return (summary){s.n,          s.missing,      unit * s.low, unit * s.high,
                     unit * s.sum, unit * s.first, unit * s.last};
}

static void check_values(const wt_force_curve *curve, size_t number, char *const *field,
                         const char *row)
{
    const wt_quantity q = quantity_of(field[COLUMN]);
    const summary s = summarise(curve, number, q, row);
    assert_int_equal(s.n, strtoul(field[N], NULL, 10));
    /* A height is the difference of ramps of 0.1 mm, each rounded to 1e-20 m, in the summation
     * order of the program; one file has a height of 6 pm. */
    const bool height = q == WT_Q_HEIGHT || q == WT_Q_MEASURED_HEIGHT;
    check_summary(&s, field + MIN, height ? 1e-11 : 0, row);
}

/* Values that this program reads differently, or not at all. */
static bool is_other(const known_file *k, const char *column)
{
    const bool chiaro = strcmp(k->format, "chiaro") == 0;
    /* The instrument computes indentation and tip position from the stored values. */
    return chiaro &&
           (strcmp(column, "height (measured)") == 0 || strcmp(column, "tip position") == 0);
}

static void check_row(open_file *f, char *const *field, const char *row)
{
    char folder[64], name[256];
    const char *file = field[FILE_NAME] + (field[FILE_NAME][0] == '"');
    snprintf(folder, sizeof folder, "afm/%.*s", (int)strcspn(file, "/"), file);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(strchr(file, '/') + 1, "\""),
             strchr(file, '/') + 1);
    const known_file *known = find_known(folder, name);
    if (known == NULL)
        fail_msg("not in the list: %s", row);
    if (known == NULL || known->refused != NULL)
        return;
    if (f->known != known) {
        close_file(f);
        open_source(f, known);
    }
    const bool counted = strcmp(known->format, "jpk") == 0;
    const size_t index = counted ? strtoul(field[ENUM], NULL, 10) : 0;
    while (f->n == 0 || f->curve.index < index)
        next_curve(f);
    assert_int_equal(f->curve.index, index);
    f->rows++;
    const wt_force_curve *curve = &f->curve;
    size_t number = strtoul(field[SEGMENT], NULL, 10);
    assert_in_range(number, 0, curve->n_segments - 1);
    const wt_segment *segment = &curve->segments[number];
    if (is_other(known, field[COLUMN]))
        return;
    check_values(curve, number, field, row);
    check("spring constant", curve->cantilever.spring_constant, field[SPRING_CONSTANT], 0, row);
    check("sensitivity", curve->cantilever.sensitivity, field[SENSITIVITY], 0, row);
    check("x", curve->x, field[POS_X], 0, row);
    check("y", curve->y, field[POS_Y], 0, row);
    check("grid x", (double)curve->grid_x, field[GRID_X], 0, row);
    check("grid y", (double)curve->grid_y, field[GRID_Y], 0, row);
    if (counted && segment->kind == WT_SEGMENT_APPROACH) {
        check("set-point", segment->setpoint, field[SETPOINT], 0, row);
        check("velocity", segment->velocity, field[SPEED], 0, row);
    }
}

/* Splits at commas outside quotes. */
static size_t split(char *line, char *field[MAX_FIELDS])
{
    size_t n = 0;
    bool quoted = false;
    field[n++] = line;
    for (char *p = line; *p != '\0'; p++) {
        if (*p == '"')
            quoted = !quoted;
        if (*p != ',' || quoted)
            continue;
        *p = '\0';
        if (n < MAX_FIELDS)
            field[n++] = p + 1;
    }
    return n;
}

static void channels(void **state)
{
    (void)state;
    FILE *in = fopen(REFERENCE, "r");
    if (in == NULL) {
        skip();
        return;
    }
    open_file f = {.n = 0};
    char line[1024], row[1024];
    size_t rows = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        char *field[MAX_FIELDS];
        line[strcspn(line, "\r\n")] = '\0';
        memcpy(row, line, sizeof row);
        if (rows++ == 0)
            continue;
        assert_int_equal(split(line, field), N_FIELDS);
        check_row(&f, field, row);
    }
    close_file(&f);
    fclose(in);
    assert_int_equal(rows, 1 + 395);
}

/* ---- NanoScope and Park -----------------------------------------------------------------------
 */

static const double *values_of(const wt_segment *segment, wt_quantity q)
{
    const wt_channel *c = wt_segment_channel(segment, q);
    assert_non_null(c);
    return c->values;
}

/* As stored: the approach from the contact outwards. */
static void add_stored(summary *s, const wt_segment *segment, wt_quantity q)
{
    static double turned[4096];
    const double *values = values_of(segment, q);
    const size_t n = segment->n_points;
    assert_in_range(n, 1, 4096);
    for (size_t i = 0; i < n; i++)
        turned[i] = values[segment->kind == WT_SEGMENT_APPROACH ? n - 1 - i : i];
    add(s, turned, n);
}

/* "curve 128 approach (first 512 stored)", or all; false: another kind of row. */
static bool check_nanoscope(const known_file *k, char *const *field, const char *row)
{
    open_file f;
    summary s = nothing;
    size_t wanted = SIZE_MAX;
    const wt_quantity q = strcmp(field[2], "V") == 0 ? WT_Q_DEFLECTION_VOLTAGE : WT_Q_FORCE;
    const bool retract = strstr(field[1], "retract") != NULL;
    double unit = strcmp(field[2], "nN") == 0 ? 1e9 : 1;
    if (sscanf(field[1], "curve %zu ", &wanted) != 1 && strstr(field[1], "all curves") == NULL)
        return false;
    open_source(&f, k);
    while (f.n < k->curves) {
        next_curve(&f);
        assert_int_equal(f.curve.n_segments, 2);
        assert_near(f.curve.segments[0].duration, k->curves > 1 ? 0.0896 : 0.2304, 1e-4);
        for (size_t i = 0; i < 2; i++)
            if (wanted == SIZE_MAX || (wanted == f.n - 1 && retract == (i == 1)))
                add_stored(&s, &f.curve.segments[i], q);
        /* The ramp is not stored: 300 nm in steps from the contact. */
        const wt_segment *in = &f.curve.segments[0];
        assert_near(values_of(in, WT_Q_HEIGHT)[0], 299.9999772e-9 * (1 - 1 / (double)in->n_points),
                    1e-9);
        assert_near_abs(values_of(in, WT_Q_HEIGHT)[in->n_points - 1], 0, 1e-20);
        assert_int_equal(f.curve.grid_x, k->curves > 1 ? (long)((f.n - 1) % 16) : -1);
    }
    f.rows = k->rows;
    close_file(&f);
    assert_int_equal(s.n, strtoul(field[3], NULL, 10));
    assert_int_equal(s.missing, strtoul(field[4], NULL, 10));
    s.low *= unit;
    s.high *= unit;
    s.sum *= unit;
    s.first *= unit;
    s.last *= unit;
    check_summary(&s, field + 5, 0, row);
    return true;
}

/* "Force, point 0, approach, valid samples (rising time)" */
static bool check_park(const known_file *k, char *const *field, const char *row)
{
    open_file f;
    summary s = nothing;
    char column[32];
    size_t point = 0;
    if (strstr(field[1], "valid samples") == NULL ||
        sscanf(field[1], "\"%31[^,], point %zu", column, &point) != 2)
        return false;
    const bool force = strcmp(column, "Force") == 0;
    open_source(&f, k);
    while (f.n < k->curves) {
        next_curve(&f);
        if (f.n - 1 != point)
            continue;
        const wt_segment *segment = &f.curve.segments[strstr(field[1], "retract") != NULL ? 1 : 0];
        add(&s, values_of(segment, force ? WT_Q_FORCE : WT_Q_HEIGHT), segment->n_points);
        assert_null(wt_segment_channel(segment, WT_Q_MEASURED_HEIGHT)); /* there is no sensor */
    }
    close_file(&f);
    const double unit = force ? 1e9 : 1e6;
    s = (summary){s.n, 0, s.low * unit, s.high * unit, s.sum * unit, s.first * unit, s.last * unit};
    assert_int_equal(s.n, strtoul(field[3], NULL, 10));
    check_summary(&s, field + 5, 0, row);
    return true;
}

static void more_channels(void **state)
{
    (void)state;
    FILE *in = fopen(MORE, "r");
    char line[1024], row[1024];
    size_t nanoscope = 0, park = 0;
    if (in == NULL) {
        skip();
        return;
    }
    while (fgets(line, sizeof line, in) != NULL) {
        char *field[MAX_FIELDS];
        line[strcspn(line, "\r\n")] = '\0';
        memcpy(row, line, sizeof row);
        if (split(line, field) != 10)
            continue;
        const known_file *k = find_known("afm-more", field[0]);
        if (k == NULL || k->format == NULL)
            continue;
        if (strcmp(k->format, "nanoscope") == 0)
            nanoscope += check_nanoscope(k, field, row);
        else if (strcmp(k->format, "park") == 0)
            park += check_park(k, field, row);
    }
    fclose(in);
    assert_int_equal(nanoscope, 12);
    assert_int_equal(park, 28);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_file), cmocka_unit_test(channels),
                                       cmocka_unit_test(more_channels)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
