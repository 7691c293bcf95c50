/* Every JPK file of the shared reference data, where present, against the channels that another
 * program decoded: n, min, max, mean, first, last of force, heights and time, with positions,
 * calibration, set-point and velocity. Both export the same signs, so nothing is turned round.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "near.h"

#include "weartrack/read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define REFERENCE WT_SHARED_DIR "/reference/force-curve-channels.csv"
#define DATA WT_SHARED_DIR "/data/afm/"
#define MAX_FIELDS 20

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

/* The file and the curve that are open; the rows of the reference come in their order. */
typedef struct open_file {
    char name[256];
    wt_input *input;
    wt_force_source *source;
    wt_parselog *log;
    wt_force_curve curve;
    size_t n; /* curves read */
} open_file;

static const wt_formats *formats;

static void close_file(open_file *f)
{
    if (f->source != NULL) {
        /* The reference has all curves that the file has. */
        assert_int_equal(wt_force_next(f->source, &f->curve, NULL), WT_END);
        assert_int_equal(wt_force_count(f->source), f->n);
    }
    wt_force_close(f->source);
    wt_input_close(f->input);
    wt_parselog_free(f->log);
    wt_force_curve_clear(&f->curve);
    *f = (open_file){.n = 0};
}

static void fail_with(const wt_error *err)
{
    char text[1024];
    wt_error_format(err, text, sizeof text);
    fail_msg("%s", text);
}

/* This file is not calibrated: the force is missing and the error says what to give. The reference
 * was made with these two values given by the user. */
static wt_read_options options_for(open_file *f)
{
    wt_read_options o = wt_read_defaults();
    if (strstr(f->name, "-cl_calibration_") == NULL)
        return o;
    wt_error err = WT_ERROR_INIT;
    o.want = WT_Q_BIT(WT_Q_FORCE);
    assert_int_equal(wt_force_open(formats, f->input, &o, f->log, &f->source, &err), WT_OK);
    assert_int_equal(wt_force_next(f->source, &f->curve, &err), WT_E_MISSING);
    assert_string_equal(err.advice, "give --spring-constant 0.1N/m and --sensitivity 120nm/V");
    assert_int_equal(wt_force_next(f->source, &f->curve, &err), WT_END);
    wt_force_close(f->source);
    f->source = NULL;
    o.want = WT_Q_ALL;
    o.spring_constant = 0.05;
    o.sensitivity = 60e-9;
    return o;
}

static void go_to(open_file *f, const char *name, size_t index)
{
    wt_error err = WT_ERROR_INIT;
    if (strcmp(f->name, name) != 0) {
        close_file(f);
        char path[512];
        snprintf(f->name, sizeof f->name, "%.255s", name);
        snprintf(path, sizeof path, DATA "%.255s", name);
        f->log = wt_parselog_new();
        if (wt_input_open(path, &f->input, &err) != WT_OK)
            fail_with(&err);
        wt_read_options options = options_for(f);
        if (wt_force_open(formats, f->input, &options, f->log, &f->source, &err) != WT_OK)
            fail_with(&err);
    }
    while (f->n == 0 || f->curve.index < index) {
        if (wt_force_next(f->source, &f->curve, &err) != WT_OK)
            fail_with(&err);
        f->n++;
    }
    assert_int_equal(f->curve.index, index);
}

/* Empty fields are what the reference does not know. The reference has 12 digits. */
static void check(const char *what, double actual, const char *text, double scale, const char *row)
{
    if (*text == '\0')
        return;
    double expected = strtod(text, NULL);
    double allowed = 1e-9 * fmax(fabs(expected), scale);
    if (!(fabs(actual - expected) <= allowed))
        fail_msg("%s is %.17g, not %.17g, in: %s", what, actual, expected, row);
}

static const wt_channel *find_channel(const wt_segment *segment, const char *column)
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
            return wt_segment_channel(segment, known[i].quantity);
    fail_msg("the reference has an unknown column %s", column);
    return NULL;
}

static void check_values(const wt_segment *segment, const wt_channel *c, char *const *field,
                         const char *row)
{
    size_t n = segment->n_points;
    double low = (double)INFINITY, high = -(double)INFINITY, sum = 0;
    assert_int_equal(n, strtoul(field[N], NULL, 10));
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, c->values[i]);
        high = fmax(high, c->values[i]);
        sum += c->values[i];
    }
    /* A height is the difference of ramps of 0.1 mm, each rounded to 1e-20 m, in whatever order a
     * program adds them; one file has a height of 6 pm. */
    bool height = c->quantity == WT_Q_HEIGHT || c->quantity == WT_Q_MEASURED_HEIGHT;
    double floor = height ? 1e-11 : 0;
    /* A mean near zero is no more exact than its terms. */
    double scale = fmax(fmax(fabs(low), fabs(high)), floor);
    check("min", low, field[MIN], floor, row);
    check("max", high, field[MAX], floor, row);
    check("mean", sum / (double)n, field[MEAN], scale, row);
    check("first", c->values[0], field[FIRST], floor, row);
    check("last", c->values[n - 1], field[LAST], floor, row);
}

static void check_row(open_file *f, char *const *field, const char *row)
{
    go_to(f, field[FILE_NAME], strtoul(field[ENUM], NULL, 10));
    const wt_force_curve *curve = &f->curve;
    size_t number = strtoul(field[SEGMENT], NULL, 10);
    assert_in_range(number, 0, curve->n_segments - 1);
    const wt_segment *segment = &curve->segments[number];
    const wt_channel *channel = find_channel(segment, field[COLUMN]);
    if (channel == NULL)
        fail_msg("no channel for: %s", row);
    check_values(segment, channel, field, row);
    check("x", curve->x, field[POS_X], 0, row);
    check("y", curve->y, field[POS_Y], 0, row);
    check("grid x", (double)curve->grid_x, field[GRID_X], 0, row);
    check("grid y", (double)curve->grid_y, field[GRID_Y], 0, row);
    check("spring constant", curve->cantilever.spring_constant, field[SPRING_CONSTANT], 0, row);
    check("sensitivity", curve->cantilever.sensitivity, field[SENSITIVITY], 0, row);
    if (segment->kind == WT_SEGMENT_APPROACH) {
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

static void every_jpk_file(void **state)
{
    (void)state;
    FILE *in = fopen(REFERENCE, "r");
    if (in == NULL) {
        skip();
        return;
    }
    wt_formats *set = NULL;
    assert_int_equal(wt_formats_new(NULL, &set, NULL, NULL), WT_OK);
    formats = set;
    open_file f = {.n = 0};
    char line[1024], row[1024];
    size_t rows = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        char *field[MAX_FIELDS];
        line[strcspn(line, "\r\n")] = '\0';
        memcpy(row, line, sizeof row);
        if (strncmp(line, "jpk/", 4) != 0)
            continue;
        assert_int_equal(split(line, field), N_FIELDS);
        check_row(&f, field, row);
        rows++;
    }
    close_file(&f);
    fclose(in);
    wt_formats_free(set);
    assert_int_equal(rows, 356);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_jpk_file)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
