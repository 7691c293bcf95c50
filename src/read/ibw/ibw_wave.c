/* Parses an Igor wave: header, labels and note. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/ibw/ibw.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "read/bytes/bytes.h"
#include "read/header_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    HEADER_5 = 64, /* file header, before the wave header */
    WAVE_5 = 320,  /* wave header, before the samples */
    HEADER_2 = 16, /* file header of version 2 */
    WAVE_2 = 110
};

bool ibw_is_wave(const unsigned char *bytes, size_t length, bool *big_endian)
{
    unsigned sum = 0;
    if (length < HEADER_5 + WAVE_5)
        return false;
    *big_endian = bytes[0] == 0;
    for (size_t i = 0; i < HEADER_5 + WAVE_5; i += 2)
        sum += *big_endian ? be16(bytes + i) : le16(bytes + i);
    return (sum & 0xffff) == 0 && (*big_endian ? be16(bytes) : le16(bytes)) == 5;
}

bool ibw_is_version_2(const unsigned char *bytes, size_t length)
{
    if (length < HEADER_2 + WAVE_2)
        return false;
    const bool big = bytes[0] == 0;
    const uint64_t wave = big ? be32(bytes + 2) : le32(bytes + 2);
    const uint64_t note = big ? be32(bytes + 6) : le32(bytes + 6);
    return (big ? be16(bytes) : le16(bytes)) == 2 && HEADER_2 + wave + note == length;
}

static uint32_t read_uint32(const ibw_file *f, size_t at)
{
    return f->big_endian ? be32(f->bytes + at) : le32(f->bytes + at);
}

static double read_double(const ibw_file *f, size_t at)
{
    return float64(f->big_endian ? be64(f->bytes + at) : le64(f->bytes + at));
}

static wt_status fail_wave(wt_error *err, wt_status status, const char *message,
                           const char *expected)
{
    wt_fail(err, status, "%s", message);
    wt_error_place(err, "header of the Igor wave");
    wt_error_expected(err, "%s", expected);
    if (status == WT_E_CORRUPT)
        wt_error_advice(err, "copy the file again from the instrument");
    else if (status == WT_E_EMPTY)
        wt_error_advice(err, "export the curve as text, with height and deflection");
    return status;
}

enum {
    TYPE = HEADER_5 + 16,
    DIMENSIONS = HEADER_5 + 68,
    STEPS = HEADER_5 + 84,
    STARTS = STEPS + 32
};

static wt_status read_type(ibw_file *f, wt_error *err)
{
    const unsigned type = f->big_endian ? be16(f->bytes + TYPE) : le16(f->bytes + TYPE);
    if (type != 2 && type != 4)
        return fail_wave(err, WT_E_UNSUPPORTED, "the wave does not hold real numbers",
                         "numbers of 32 or 64 bits");
    f->type = type == 2 ? SAMPLE_FLOAT32 : SAMPLE_FLOAT64;
    return WT_OK;
}

static wt_status set_sizes(ibw_file *f, size_t n, size_t channels, wt_error *err)
{
    if (n == 0 || n > (size_t)1 << 28 || channels > IBW_CHANNELS)
        return fail_wave(err, WT_E_CORRUPT, "impossible size of the wave",
                         "up to 268 million samples of up to 32 channels");
    f->n = n;
    f->n_channels = channels;
    return WT_OK;
}

static wt_status read_shape(ibw_file *f, wt_error *err)
{
    const size_t channels = read_uint32(f, DIMENSIONS + 4);
    wt_status status = read_type(f, err);
    if (status == WT_OK && (channels == 0 || read_uint32(f, DIMENSIONS + 8) != 0))
        status = fail_wave(err, WT_E_EMPTY, "the wave holds no force curve",
                           "two dimensions: samples and channels");
    if (status == WT_OK)
        status = set_sizes(f, read_uint32(f, DIMENSIONS), channels, err);
    f->interval = read_double(f, STEPS);
    if (!(f->interval > 0) || !isfinite(f->interval))
        f->interval = (double)NAN;
    return status;
}

static wt_status read_image_grid(ibw_file *f, ibw_grid *grid, wt_error *err)
{
    const size_t layers = read_uint32(f, DIMENSIONS + 8);
    *grid = (ibw_grid){.n_columns = read_uint32(f, DIMENSIONS),
                       .n_rows = read_uint32(f, DIMENSIONS + 4),
                       .step_x = read_double(f, STEPS),
                       .step_y = read_double(f, STEPS + 8),
                       .x_min = read_double(f, STARTS),
                       .y_min = read_double(f, STARTS + 8)};
    const wt_status status = read_type(f, err);
    if (status != WT_OK)
        return status;
    if (layers == 0 || read_uint32(f, DIMENSIONS + 12) != 0)
        return fail_wave(err, WT_E_EMPTY, "the wave holds no image",
                         "three dimensions: columns, lines and channels");
    /* The product of two 32-bit sizes fits. */
    return set_sizes(f, grid->n_columns * grid->n_rows, layers, err);
}

static wt_status fail_damaged_wave(wt_error *err, const char *message, const char *expected)
{
    (void)wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_expected(err, "%s", expected);
    wt_error_advice(err, "copy the file again from the instrument");
    return WT_E_CORRUPT;
}

/* True for a label of letters that only zeros follow. */
static bool is_label(const unsigned char *label, size_t size)
{
    size_t n = 0;
    while (n < size && label[n] >= ' ' && label[n] < 0x7f)
        n++;
    while (n < size && label[n] == 0)
        n++;
    return n == size;
}

/* Returns the number after a key such as "RetractStart3:" of the footer; SIZE_MAX if it is
 * absent. */
static size_t find_footer_number(const char *footer, const char *key)
{
    const char *const found = strstr(footer, key);
    return found != NULL ? (size_t)strtoul(found + strlen(key), NULL, 10) : SIZE_MAX;
}

/* Checks the footer. After the wave Asylum writes small pictures of the channels. The footer states
 * their positions and ends with its own length, as in " 0292 Force". */
static wt_status check_footer(const ibw_file *f, size_t length, size_t end, wt_error *err)
{
    enum { TAIL = 11, FOOTER_MAX = 4096 };
    char footer[FOOTER_MAX + 1], key[32];
    size_t last = 0;
    if (length < end + TAIL || memcmp(f->bytes + length - 6, " Force", 6) != 0)
        return WT_OK;
    memcpy(footer, f->bytes + length - TAIL, TAIL);
    footer[5] = '\0';
    const size_t size = (size_t)strtoul(footer, NULL, 10);
    if (size <= TAIL || size > FOOTER_MAX || size > length)
        return WT_OK;
    memcpy(footer, f->bytes + length - size, size);
    footer[size] = '\0';
    for (int i = 1; i < 10; i++) {
        (void)snprintf(key, sizeof key, "RetractStart%d:", i);
        const size_t at = find_footer_number(footer, key);
        last = at != SIZE_MAX && at > last ? at : last;
    }
    const size_t first = find_footer_number(footer, "ExtendStart1:"),
                 n = find_footer_number(footer, "RetractLength:");
    if (first == SIZE_MAX || last == 0 || n > length)
        return WT_OK;
    if (first == end && last + n == length - size)
        return WT_OK;
    (void)fail_damaged_wave(err, "bytes are missing inside, or there are too many",
                            "what stands behind the wave where the footer of the file says");
    wt_error_found(err, "its end at byte %zu, not at %zu", length - size, last + n);
    return WT_E_CORRUPT;
}

/* Reads the labels of the channels. The first label belongs to the dimension. */
static wt_status read_labels(ibw_file *f, const unsigned char *labels, size_t size, wt_error *err)
{
    enum { LABEL = 32 };
    for (size_t i = 0; i < f->n_channels; i++) {
        ibw_channel *c = &f->channels[i];
        const size_t at = (i + 1) * LABEL;
        *c = (ibw_channel){.number = i};
        if (at + LABEL > size)
            continue;
        if (!is_label(labels + at, LABEL))
            return fail_damaged_wave(err,
                                     "a label of a channel is no name: bytes are missing before it",
                                     "letters and zeros");
        memcpy(c->name, labels + at, LABEL);
    }
    return WT_OK;
}

/* Locates the parts after the samples, in their order. `dimension`: the dimension of the
 * channels. */
static wt_status locate_parts(ibw_file *f, size_t length, size_t dimension, wt_error *err)
{
    enum { SIZES = 4, LABELS = 36, DIMENSIONS_MAX = 4, N_BEFORE = 7 };
    const size_t samples = f->n * f->n_channels * sample_width(f->type);
    const size_t wave = read_uint32(f, SIZES), note = read_uint32(f, SIZES + 8);
    /* The sizes of formula, note, data unit and units of the four dimensions; then come the labels
     * of each dimension. */
    static const size_t before[N_BEFORE] = {8, 12, 16, 20, 24, 28, 32};
    const size_t labels = read_uint32(f, LABELS + 4 * dimension);
    uint64_t end = (uint64_t)HEADER_5 + wave;
    if (wave != WAVE_5 + samples)
        return fail_wave(err, WT_E_CORRUPT, "the sizes of the wave contradict one another",
                         "one number for each sample of each channel");
    for (size_t i = 0; i < N_BEFORE; i++) {
        if (before[i] == 12)
            f->note = (const char *)f->bytes + (end < length ? end : length);
        end += read_uint32(f, before[i]);
    }
    for (size_t i = 0; i < dimension; i++)
        end += read_uint32(f, LABELS + 4 * i);
    uint64_t last = end + labels + read_uint32(f, LABELS + 4 * DIMENSIONS_MAX);
    for (size_t i = dimension + 1; i < DIMENSIONS_MAX; i++)
        last += read_uint32(f, LABELS + 4 * i);
    if (last > length) {
        wt_fail(err, WT_E_CORRUPT, "the end of the file is missing");
        wt_error_expected(err, "%llu bytes", (unsigned long long)last);
        wt_error_found(err, "%zu bytes", length);
        wt_error_advice(err, "copy the file again from the instrument");
        return WT_E_CORRUPT;
    }
    f->note_length = note;
    f->data = HEADER_5 + WAVE_5;
    const wt_status status = read_labels(f, f->bytes + end, labels, err);
    return status == WT_OK ? check_footer(f, length, (size_t)last, err) : status;
}

static wt_status open_wave(wt_input *input, ibw_file *file, size_t *length, wt_error *err)
{
    *file = (ibw_file){.name = wt_input_name(input)};
    const wt_status status = wt_input_bytes(input, &file->bytes, length, err);
    if (status == WT_OK && !ibw_is_wave(file->bytes, *length, &file->big_endian))
        return fail_wave(err, WT_E_CORRUPT, "damaged header",
                         "version 5, and a check sum that agrees");
    return status;
}

wt_status ibw_open(wt_input *input, ibw_file *file, ibw_grid *grid, wt_error *err)
{
    size_t length = 0;
    wt_status status = open_wave(input, file, &length, err);
    if (status == WT_OK)
        status = grid != NULL ? read_image_grid(file, grid, err) : read_shape(file, err);
    return status == WT_OK ? locate_parts(file, length, grid != NULL ? 2 : 1, err) : status;
}

/* ---- the note -------------------------------------------------------------------------------- */

/* Copies the value of the next line with the key from *at on, which is line *line after the call.
 */
static bool next_note_text(const ibw_file *file, const char *key, size_t *at, size_t *line_number,
                           char value[IBW_TEXT])
{
    const size_t length = strlen(key);
    while (*at < file->note_length) {
        const char *line = file->note + *at;
        size_t n = 0;
        while (*at + n < file->note_length && line[n] != '\r' && line[n] != '\n')
            n++;
        *at += n + 1;
        ++*line_number;
        if (n <= length || memcmp(line, key, length) != 0 || line[length] != ':')
            continue;
        size_t from = length + 1;
        while (from < n && line[from] == ' ')
            from++;
        const size_t copied = n - from < IBW_TEXT ? n - from : IBW_TEXT - 1;
        memcpy(value, line + from, copied);
        value[copied] = '\0';
        return true;
    }
    return false;
}

bool ibw_note_text(const ibw_file *file, const char *key, char value[IBW_TEXT])
{
    size_t at = 0, line = 0;
    return next_note_text(file, key, &at, &line, value);
}

double ibw_note_number(const ibw_file *file, const char *key)
{
    char text[IBW_TEXT];
    double value = (double)NAN;
    size_t end;
    if (ibw_note_text(file, key, text))
        (void)header_number_read(text, strlen(text), &value, &end);
    return value;
}

double ibw_note_calibration(const ibw_file *file, const char *key, wt_quantity quantity,
                            wt_log *log)
{
    const double tolerance = 1e-3; /* rounding of a printed value */
    const char *const option = header_number_option(quantity);
    char text[IBW_TEXT], place[32];
    double first = (double)NAN, value;
    size_t at = 0, line = 0, first_line = 0, end;
    while (next_note_text(file, key, &at, &line, text)) {
        snprintf(place, sizeof place, "line %zu of the note", line);
        header_number_warn(header_number_read(text, strlen(text), &value, &end), text, strlen(text),
                           key, option, file->name, place, log);
        if (first_line > 0 && fabs(value - first) > tolerance * fabs(first)) {
            wt_log_action(log, WT_WARNING, WT_CONTRADICTED, 2, option, file->name, place,
                          "the note states %s twice, %g in line %zu and %g here; the first one is "
                          "used: state the value by %s",
                          key, first, first_line, value, option);
        } else if (first_line == 0) {
            first = value;
            first_line = line;
        }
    }
    return force_positive_or_nan(first);
}

static wt_status fail_segments(const char *found, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "the note does not part the samples into approach and retract");
    wt_error_place(err, "note of the wave, Indexes and Direction");
    wt_error_expected(err, "rising sample numbers, such as 0,1008,2015, and NaN,1,-1");
    wt_error_found(err, "%s", found);
    return WT_E_CORRUPT;
}

/* Parses the next number of a comma-separated list, in the C locale, where a comma is no decimal
 * mark. */
static double parse_next_number(char **text)
{
    const locale_t previous = clocale_enter();
    const double value = strtod(*text + (**text == ','), text);
    clocale_leave(previous);
    return value;
}

/* Returns the channel of the piezo position, by preference the signal without noise; NULL if there
 * is none. */
static const ibw_channel *position_channel(const ibw_file *file)
{
    static const char *const names[] = {"Raw", "ZSnsr"};
    for (size_t i = 0; i < COUNT_OF(names); i++)
        for (size_t c = 0; c < file->n_channels; c++)
            if (strcasecmp(file->channels[c].name, names[i]) == 0)
                return &file->channels[c];
    return NULL;
}

/* Splits the samples where the piezo turns. A curve that was extracted from a map has no keys that
 * state it. Positions increase towards the sample. */
static wt_status split_at_turning_point(const ibw_file *file, ibw_segment segments[IBW_SEGMENTS],
                                        size_t *n, wt_error *err)
{
    const ibw_channel *channel = position_channel(file);
    if (channel == NULL || file->n < 2)
        return fail_segments("no such lines, and no channel Raw or ZSnsr that turns", err);
    double *position = wt_alloc(file->n, sizeof *position);
    size_t top = 0;
    samples_decode(file->type, file->big_endian,
                   file->bytes + file->data +
                       sample_width(file->type) * (channel->number * file->n),
                   file->n, 1, 0, position);
    for (size_t i = 1; i < file->n; i++)
        if (position[i] > position[top] || isnan(position[top]))
            top = i;
    free(position);
    const size_t turn = top > 0 ? top + 1 : 0; /* falling from the start: a retract alone */
    if (turn > 0)
        segments[(*n)++] = (ibw_segment){WT_SEGMENT_APPROACH, 0, turn};
    if (turn < file->n)
        segments[(*n)++] = (ibw_segment){WT_SEGMENT_RETRACT, turn, file->n - turn};
    return WT_OK;
}

/* Splits the samples by the keys of the note. "0,1008,2015" and "NaN,1,-1," mean an approach from 0
 * to 1008 and a retract from there to the end. Without Indexes the samples are split where the
 * piezo turns. */
wt_status ibw_read_segments(const ibw_file *file, ibw_segment segments[IBW_SEGMENTS], size_t *n,
                            wt_error *err)
{
    char indexes[IBW_TEXT], directions[IBW_TEXT];
    *n = 0;
    const bool has_indexes = ibw_note_text(file, "Indexes", indexes),
               has_directions = ibw_note_text(file, "Direction", directions);
    if (!has_indexes)
        return split_at_turning_point(file, segments, n, err);
    if (!has_directions)
        return fail_segments("no Direction", err);
    char *index = indexes, *direction = directions;
    unsigned long from = strtoul(index, &index, 10);
    (void)parse_next_number(&direction);
    while (*index == ',' && index[1] >= '0' && index[1] <= '9' && *n < IBW_SEGMENTS) {
        const unsigned long to = strtoul(index + 1, &index, 10);
        const double sign = *direction == ',' ? parse_next_number(&direction) : (double)NAN;
        const bool last = *index != ',' || index[1] < '0' || index[1] > '9';
        if (to <= from || to >= file->n + !last || isnan(sign))
            return fail_segments(indexes, err);
        /* Each number is the first sample of a segment; the last one is the last sample. */
        segments[(*n)++] = (ibw_segment){.kind = sign > 0   ? WT_SEGMENT_APPROACH
                                                 : sign < 0 ? WT_SEGMENT_RETRACT
                                                            : WT_SEGMENT_DWELL,
                                         .from = from,
                                         .n = to - from + last};
        from = to;
    }
    return *n > 0 && *index != ',' ? WT_OK : fail_segments(indexes, err);
}
