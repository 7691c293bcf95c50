/* Reads text exports of NT-MDT force curves.
 *
 * A file has three unnamed columns separated by tabs, with decimal commas: the height [nm], and
 * the deflection signal of approach and retract. The rows begin at the end of the ramp in the
 * sample. Rows that the curve did not reach repeat its first sample.
 *
 * The format is known from one measured file, which contains neither the unit of the signal nor a
 * calibration. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "read/bytes/input.h"
#include "read/text/curve_text.h"
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 3, ROWS_MIN = 10, LINE_MAX_LENGTH = 80 };

/* Parses the numbers of a line and moves *line past it; false for any other line. */
static bool parse_row(const char **line, const char *end, double row[COLUMNS], bool *commas)
{
    const char *at = *line;
    for (size_t c = 0; c < COLUMNS; c++) {
        const char *stop = at;
        while (stop < end && *stop != '\t' && *stop != '\r' && *stop != '\n')
            stop++;
        *commas = *commas && memchr(at, ',', (size_t)(stop - at)) != NULL;
        if (!wt_number_parse(at, (size_t)(stop - at), ',', &row[c]) || stop == end ||
            (*stop == '\t') != (c + 1 < COLUMNS))
            return false;
        at = stop + 1;
    }
    if (at[-1] == '\r' && at < end && *at == '\n')
        at++;
    *line = at;
    return true;
}

/* Recognises the format: every number has a comma, and the height increases row by row up to at
 * most 0. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    const char *line = (const char *)peek->bytes, *end = line + peek->length;
    double row[COLUMNS], before = -(double)INFINITY;
    bool commas = true;
    size_t n = 0;
    (void)self;
    for (; parse_row(&line, end, row, &commas); n++) {
        if (row[0] <= before || row[0] > 0 || !commas)
            return recognition_result(false, 0);
        before = row[0];
    }
    /* the visible part ends within a line */
    return recognition_result(
        n >= ROWS_MIN && (line == end || (!peek->whole && end - line < LINE_MAX_LENGTH)), 60);
}

typedef struct ntmdt_ramp {
    double *values; /* [COLUMNS][capacity] */
    size_t n, capacity;
} ntmdt_ramp;

/* Reads the rows with heights in metres. *idle is the number of first rows that the curve did not
 * reach. */
static wt_status read_ntmdt_ramp(const char *line, size_t length, ntmdt_ramp *r, size_t *idle,
                                 wt_error *err)
{
    const char *end = line + length;
    double row[COLUMNS];
    bool commas = true;
    r->capacity = length / (2 * COLUMNS) + 1;
    r->values = wt_alloc(COLUMNS * r->capacity, sizeof *r->values);
    while (r->n < r->capacity && parse_row(&line, end, row, &commas)) {
        r->values[r->n] = 1e-9 * row[0];
        for (size_t c = 1; c < COLUMNS; c++)
            r->values[c * r->capacity + r->n] = row[c];
        r->n++;
    }
    if (line != end || r->n < ROWS_MIN) {
        wt_fail(err, WT_E_CORRUPT, "a line is no row of three numbers");
        wt_error_place(err, "line %zu", r->n + 1);
        wt_error_expected(err, "height, way in and way out, parted by tabs, with decimal commas");
        return WT_E_CORRUPT;
    }
    for (*idle = 0; *idle + 1 < r->n; ++*idle)
        for (size_t c = 1; c < COLUMNS; c++) {
            const double *signal = r->values + c * r->capacity + *idle;
            if (signal[0] != signal[1])
                return WT_OK;
        }
    return WT_OK;
}

/* Warns of missing rows. The measured file has equal steps and ends 1e-5 of a step above 0. A
 * deviation of half a step or more means a missing row. */
static void warn_gaps(const ntmdt_ramp *r, const char *name, wt_log *log)
{
    double last = r->values[r->n - 1], step = last - r->values[r->n - 2];
    for (size_t i = 1; i < r->n; i++)
        step = fmin(step, r->values[i] - r->values[i - 1]);
    for (size_t i = 1; i < r->n; i++)
        if (r->values[i] - r->values[i - 1] > 1.5 * step) {
            wt_log_add(log, WT_WARNING, name, NULL,
                       "the ramp does not go in equal steps: rows are missing before that of "
                       "%.4g nm, among others",
                       1e9 * r->values[i]);
            break;
        }
    if (-last > 1.5 * step)
        wt_log_add(log, WT_WARNING, name, NULL,
                   "the ramp ends at %.4g nm, and not at 0: the file was cut off, and rows "
                   "are missing",
                   1e9 * last);
}

static wt_status convert_ntmdt_to_text(const file_reader *self, wt_input *input, wt_log *log,
                                       wt_input **text, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0, n_text = 0, idle = 0;
    char *made = NULL;
    ntmdt_ramp r = {.n = 0};
    (void)self;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status == WT_OK)
        status = read_ntmdt_ramp((const char *)bytes, length, &r, &idle, err);
    if (status == WT_OK) {
        FILE *const out = text_stream_open(&made, &n_text);
        curve_text curve = {
            .x = (double)NAN,
            .y = (double)NAN,
            .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN},
            .columns = {{WT_Q_MEASURED_HEIGHT, r.values},
                        {WT_Q_DEFLECTION_VOLTAGE, r.values + r.capacity}},
            .n_columns = 2};
        curve_text_begin(out, &curve);
        curve_text_rows(out, &curve, WT_SEGMENT_APPROACH, idle, r.n - idle, true);
        curve.columns[1].values = r.values + 2 * r.capacity;
        curve_text_rows(out, &curve, WT_SEGMENT_RETRACT, idle, r.n - idle, false);
        curve_text_end(out);
        text_stream_close(out);
        *text = input_from_bytes(made, n_text, wt_input_name(input));
        wt_log_add(log, WT_WARNING, wt_input_name(input), NULL,
                   "the file does not say the unit of the deflection signal: its numbers are "
                   "taken as volts, and the sensitivity must be that of one such unit");
        warn_gaps(&r, wt_input_name(input), log);
        if (idle > 0)
            wt_log_add(log, WT_NOTE, wt_input_name(input), NULL,
                       "%zu rows that repeat the first sample are left out", idle);
    }
    free(r.values);
    return status;
}

const file_reader reader_ntmdt = {
    .info = {.id = "ntmdt-text",
             .title = "NT-MDT force curve, text export without names",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence = "a measured file; its units are not in it",
             .version = "1"},
    CURVE_TEXT_READER(convert_ntmdt_to_text),
    .detect = detect,
    .describe = text_describe_converted,
};
