/* Reads TIFF files of Park Systems with force curves (.tiff).
 *
 * Besides those of a picture, the tags contain a header of channels and a block of floats. The
 * block is ordered by curve, then by channel. Each curve has two halves, approach and retract.
 * Only the first samples of a half were measured; the others repeat the last one.
 *
 * The format is known from one measured file of seven curves. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/registry.h"
#include "read/bytes/bytes.h"
#include "read/bytes/samples.h"
#include "read/force_assembler.h"
#include "read/header_values.h"
#include "read/images.h"
#include "read/reader.h"

#include <math.h>

enum {
    TAG_MAGIC = 50432,
    TAG_PICTURE = 50434,
    TAG_PICTURE_HEADER = 50435,
    TAG_SPECTROSCOPY = 50438,
    TAG_SAMPLES = 50439,
    CHANNELS = 8,
    SLOT = 96,      /* size of a channel in the header [byte] */
    SLOT_UNIT = 64, /* after the name */
    SLOT_GAIN = 80, /* after the unit */
    TAG_STRIPS = 273,
    TAG_STRIP_SIZES = 279,
    STRIPS = 1024,
    LONG_TYPE = 4, /* 32 bits */
    COUNTS = 768,  /* channels, averages, samples, points */
    HEADER = COUNTS + 20,
    ENTRY = 12 /* size of a tag in the directory [byte] */
};
static const uint32_t magic = 0x0e031301;

typedef struct park_channel {
    char name[33], unit[9];
    size_t number;
    double gain;
    wt_quantity quantity; /* WT_Q_NONE if it is not read */
    double factor;        /* from its unit to that of the quantity */
} park_channel;

typedef struct park_file {
    const char *name;
    input_window window;
    size_t data;                /* offset of the block of samples */
    const unsigned char *curve; /* samples of the current curve */
    park_channel channels[CHANNELS];
    size_t n_channels, n_samples, n_curves;
    size_t end; /* end of the data that the directory names */
} park_file;

/* ---- the file -------------------------------------------------------------------------------- */

/* The position of the bytes of a tag. */
typedef struct park_tag {
    size_t from, n;
    bool is_present;
} park_tag;

/* Reads a tag. A tag that exceeds the file is marked as absent. */
static void read_tag(const unsigned char *entry, size_t at, size_t length, park_tag *tag)
{
    static const unsigned char widths[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
    const size_t type = le16(entry + 2), count = le32(entry + 4);
    if (tag->n > 0 || tag->is_present || type >= sizeof widths)
        return;
    tag->n = widths[type] * count;
    tag->from = tag->n <= 4 ? at + 8 : le32(entry + 8);
    tag->is_present = tag->from <= length && tag->n <= length - tag->from;
}

/* The tags of Park in the directory of the file. */
typedef struct park_tags {
    park_tag magic, header, samples, picture, picture_header, strips, strip_sizes;
    size_t end; /* end of the data that the tags and the picture strips name */
} park_tags;

/* Reads a list of 32-bit numbers, one for each strip. Other types do not occur. */
static wt_status read_strips(input_window *w, const park_tag *tag, uint32_t list[STRIPS],
                             wt_error *err)
{
    const unsigned char *bytes = NULL;
    const size_t n = tag->n / 4 < STRIPS ? tag->n / 4 : STRIPS;
    const wt_status status =
        n > 0 && tag->is_present ? window_bytes(w, tag->from, 4 * n, &bytes, err) : WT_OK;
    for (size_t i = 0; i < STRIPS; i++)
        list[i] = bytes != NULL && i < n ? le32(bytes + 4 * i) : 0;
    return status;
}

/* Extends the end of the data by the strips of the preview picture, which are last in the file. */
static wt_status extend_end(input_window *w, park_tags *tags, wt_error *err)
{
    uint32_t from[STRIPS], sizes[STRIPS];
    wt_status status = read_strips(w, &tags->strips, from, err);
    if (status == WT_OK)
        status = read_strips(w, &tags->strip_sizes, sizes, err);
    for (size_t i = 0; status == WT_OK && i < STRIPS; i++)
        if (from[i] > 0 && (size_t)from[i] + sizes[i] > tags->end)
            tags->end = (size_t)from[i] + sizes[i];
    return status;
}

/* Checks that the file contains all data that the directory names. */
static wt_status check_directory_end(const input_window *w, const park_tags *tags, wt_error *err)
{
    if (tags->end <= w->size)
        return WT_OK;
    (void)wt_fail(err, WT_E_CORRUPT,
                  "bytes are missing at the end or inside, where all behind "
                  "them is shifted");
    wt_error_expected(err, "%zu bytes, as the directory of the file says", tags->end);
    wt_error_found(err, "%zu", w->size);
    wt_error_advice(err, "copy the file again from the instrument");
    return WT_E_CORRUPT;
}

static void warn_extra_bytes(size_t size, size_t end, const char *name, wt_log *log)
{
    if (size > end)
        wt_log_add(log, WT_WARNING, name, NULL,
                   "the file is %zu bytes longer than its directory says: if they stand "
                   "inside, what is behind them is shifted; copy the file again",
                   size - end);
}

static wt_status find_tags(input_window *w, park_tags *tags, wt_error *err)
{
    const unsigned char *bytes = NULL;
    *tags = (park_tags){.magic = {.n = 0}};
    wt_status status = w->size < 10 ? WT_OK : window_bytes(w, 4, 4, &bytes, err);
    const size_t at = bytes != NULL ? le32(bytes) : 0;
    if (status != WT_OK || at < 8 || at > w->size - 2)
        return status;
    status = window_bytes(w, at, 2, &bytes, err);
    const size_t entries = status == WT_OK ? le16(bytes) : 0;
    if (entries > (w->size - at - 2) / ENTRY)
        return WT_OK;
    if (status == WT_OK)
        status = window_bytes(w, at + 2, ENTRY * entries, &bytes, err);
    for (size_t i = 0; status == WT_OK && i < entries; i++) {
        const unsigned char *const entry = bytes + ENTRY * i;
        const size_t place = at + 2 + ENTRY * i;
        if (le16(entry) == TAG_MAGIC && le32(entry + 8) == magic)
            read_tag(entry, place, w->size, &tags->magic);
        else if (le16(entry) == TAG_SPECTROSCOPY)
            read_tag(entry, place, w->size, &tags->header);
        else if (le16(entry) == TAG_SAMPLES)
            read_tag(entry, place, w->size, &tags->samples);
        else if (le16(entry) == TAG_PICTURE)
            read_tag(entry, place, w->size, &tags->picture);
        else if (le16(entry) == TAG_PICTURE_HEADER)
            read_tag(entry, place, w->size, &tags->picture_header);
        else if (le16(entry) == TAG_STRIPS && le16(entry + 2) == LONG_TYPE)
            read_tag(entry, place, w->size, &tags->strips);
        else if (le16(entry) == TAG_STRIP_SIZES && le16(entry + 2) == LONG_TYPE)
            read_tag(entry, place, w->size, &tags->strip_sizes);
    }
    const park_tag *const all[] = {&tags->header,         &tags->samples, &tags->picture,
                                   &tags->picture_header, &tags->strips,  &tags->strip_sizes};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i]->from + all[i]->n > tags->end)
            tags->end = all[i]->from + all[i]->n;
    return status == WT_OK ? extend_end(w, tags, err) : status;
}

/* True for a TIFF file of Park. */
static bool has_park_tags(const park_tags *tags)
{
    return tags->magic.is_present && tags->magic.n == 4;
}

/* Reads a UTF-16 name that is ASCII except for the two micro signs. */
static void read_utf16_name(const unsigned char *from, char *to, size_t size)
{
    size_t n = 0;
    for (; n + 1 < size && le16(from + 2 * n) != 0; n++) {
        const unsigned letter = le16(from + 2 * n);
        const bool micro = letter == 0xb5 || letter == 0x3bc;
        to[n] = (char)(micro ? 'u' : letter < 0x80 ? letter : '?');
    }
    to[n] = '\0';
}

static void read_channel_slot(const unsigned char *slot, size_t number, park_channel *c)
{
    static const struct {
        const char *name;
        wt_quantity quantity;
    } known[] = {{"Vertical (A-B)", WT_Q_DEFLECTION_VOLTAGE},
                 {"Force", WT_Q_FORCE},
                 {"Z Scan", WT_Q_HEIGHT},
                 {"Z Detector", WT_Q_MEASURED_HEIGHT},
                 {"Time Stamp", WT_Q_TIME}};
    double offset = 0;
    *c = (park_channel){.number = number, .gain = float64(le64(slot + SLOT_GAIN))};
    read_utf16_name(slot, c->name, sizeof c->name);
    read_utf16_name(slot + SLOT_UNIT, c->unit, sizeof c->unit);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(c->name, known[i].name) == 0 && isfinite(c->gain) &&
            wt_unit_to_si(strcmp(c->unit, "usec") == 0 ? "us" : c->unit, known[i].quantity,
                          &c->factor, &offset, NULL) == WT_OK)
            c->quantity = known[i].quantity;
}

static wt_status fail_park(wt_error *err, wt_status status, const char *message,
                           const char *expected)
{
    wt_fail(err, status, "%s", message);
    wt_error_expected(err, "%s", expected);
    return status;
}

static wt_status read_park_header(park_file *f, const park_tags *tags, wt_error *err)
{
    const unsigned char *header = NULL;
    const size_t block = tags->samples.n;
    if (tags->header.n < HEADER || !tags->samples.is_present)
        return fail_park(err, WT_E_CORRUPT, "the block of samples is missing", "the tag 50439");
    const wt_status status = window_bytes(&f->window, tags->header.from, HEADER, &header, err);
    if (status != WT_OK)
        return status;
    f->data = tags->samples.from;
    f->n_channels = le32(header + COUNTS);
    f->n_samples = le32(header + COUNTS + 8);
    f->n_curves = le32(header + COUNTS + 12);
    if (f->n_channels == 0 || f->n_channels > CHANNELS || f->n_samples < 2 || f->n_curves == 0 ||
        block / 4 / f->n_channels / f->n_samples != f->n_curves ||
        block != 4 * f->n_channels * f->n_samples * f->n_curves) {
        fail_park(err, WT_E_CORRUPT, "the sizes of the block contradict one another",
                  "four bytes for each sample");
        wt_error_found(err, "%zu bytes for %zu curves of %zu channels of %zu samples", block,
                       f->n_curves, f->n_channels, f->n_samples);
        return WT_E_CORRUPT;
    }
    for (size_t c = 0; c < f->n_channels; c++)
        read_channel_slot(header + SLOT * c, c, &f->channels[c]);
    return WT_OK;
}

static wt_status open_park_file(wt_input *input, park_file *f, wt_error *err)
{
    park_tags tags = {.magic = {.n = 0}};
    *f = (park_file){.name = wt_input_name(input)};
    wt_status status = window_open(&f->window, input, err);
    if (status == WT_OK)
        status = find_tags(&f->window, &tags, err);
    if (status != WT_OK)
        return status;
    if (!has_park_tags(&tags))
        return fail_park(err, WT_E_CORRUPT, "damaged directory of tags",
                         "a TIFF file of Park Systems");
    status = check_directory_end(&f->window, &tags, err);
    f->end = tags.end;
    if (status != WT_OK)
        return status;
    if (!tags.header.is_present)
        return fail_park(err, WT_E_EMPTY, "the picture holds no force curve",
                         "the tag 50438 of spectroscopy");
    return read_park_header(f, &tags, err);
}

/* Reads the samples of a curve into f->curve. */
static wt_status load_curve(park_file *f, size_t curve, wt_error *err)
{
    const size_t size = 4 * f->n_channels * f->n_samples;
    return window_bytes(&f->window, f->data + curve * size, size, &f->curve, err);
}

/* Returns the samples of a channel of the current curve. */
static const unsigned char *channel_samples(const park_file *f, const park_channel *c, size_t from)
{
    return f->curve + 4 * (c->number * f->n_samples + from);
}

/* Counts the samples from `from`, at most n, before the time stops increasing. */
static size_t count_measured(const park_file *f, size_t from, size_t n)
{
    for (size_t i = 0; i < f->n_channels; i++) {
        const park_channel *c = &f->channels[i];
        if (c->quantity != WT_Q_TIME)
            continue;
        const unsigned char *time = channel_samples(f, c, from);
        size_t valid = 1;
        while (valid < n && float32(le32(time + 4 * valid)) > float32(le32(time + 4 * valid - 4)))
            valid++;
        return valid;
    }
    return n;
}

/* True for a channel of constant value, which belongs to a sensor that the instrument does not
 * have. */
static bool is_constant(const park_file *f, const park_channel *c)
{
    const unsigned char *values = channel_samples(f, c, 0);
    for (size_t i = 1; i < f->n_samples; i++)
        if (memcmp(values, values + 4 * i, 4) != 0)
            return false;
    return true;
}

static force_metadata half_metadata(const park_file *f, size_t half)
{
    const size_t n = f->n_samples / 2;
    force_metadata metadata = {
        .kind = half == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT,
        .index = half,
        .n_points = count_measured(f, half * n, n),
        .duration = (double)NAN,
        .velocity = (double)NAN,
        .setpoint = (double)NAN,
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN},
        .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE,
                   WT_Q_DEFLECTION_VOLTAGE},
        .n_offers = 5};
    for (size_t i = 0; i < f->n_channels; i++) {
        const park_channel *c = &f->channels[i];
        if (c->quantity == WT_Q_NONE || (c->quantity == WT_Q_MEASURED_HEIGHT && is_constant(f, c)))
            continue;
        force_add_signal(&metadata, (force_signal){.quantity = c->quantity,
                                                   .name = c->name,
                                                   .unit = c->unit,
                                                   .to_si = {c->gain * c->factor, 0},
                                                   .channel = c});
    }
    return metadata;
}

/* ---- curves ---------------------------------------------------------------------------------- */

typedef struct park_source {
    wt_force_source base;
    park_file file;
    size_t curve, from; /* curve and first sample of the current segment */
} park_source;

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const park_source *s = (const park_source *)base;
    (void)err;
    samples_decode(SAMPLE_FLOAT32, false, channel_samples(&s->file, signal->channel, s->from), n,
                   scaling.multiplier, scaling.offset, values);
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    park_source *s = (park_source *)base;
    wt_status status = WT_OK;
    if (s->curve == s->file.n_curves)
        return WT_END;
    curve->index = s->curve;
    status = load_curve(&s->file, s->curve, err);
    for (size_t half = 0; half < 2 && status == WT_OK; half++) {
        const force_metadata metadata = half_metadata(&s->file, half);
        s->from = half * (s->file.n_samples / 2);
        if (force_is_segment_requested(base, metadata.kind))
            status = force_add_segment(base, &metadata, curve, err);
    }
    s->curve++;
    return status;
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    park_file *f = &((park_source *)base)->file;
    (void)self;
    wt_status status = open_park_file(input, f, err);
    bool timed = false;
    for (size_t i = 0; i < f->n_channels && i < CHANNELS; i++)
        timed = timed || f->channels[i].quantity == WT_Q_TIME;
    if (status == WT_OK && !timed)
        wt_log_add(base->log, WT_WARNING, base->name, NULL,
                   "no channel Time Stamp: samples that were not measured cannot be "
                   "distinguished from those that were");
    if (status == WT_OK)
        warn_extra_bytes(f->window.size, f->end, base->name, base->log);
    base->n_curves = f->n_curves;
    return status;
}

static void seek(wt_force_source *base, size_t index)
{
    ((park_source *)base)->curve = index;
}

static void close_source(wt_force_source *base)
{
    window_close(&((park_source *)base)->file.window);
}

static const force_stream park_force = {.size = sizeof(park_source),
                                        .open = open_source,
                                        .next = next_curve,
                                        .decode = decode,
                                        .seek = seek,
                                        .close = close_source};

/* ---- the picture ----------------------------------------------------------------------------- */

/* Offsets in the header of the picture. */
enum {
    PICTURE_NAME = 4,
    PICTURE_COLUMNS = 100,
    PICTURE_ROWS = 104,
    PICTURE_WIDTH = 140, /* [um] */
    PICTURE_HEIGHT = 148,
    PICTURE_GAIN = 220,
    PICTURE_SCALE = 228,
    PICTURE_OFFSET = 236,
    PICTURE_UNIT = 244,
    PICTURE_LEAST = 260,
    PICTURE_TYPE = 348 /* since version 2; 16-bit samples before */
};

static double read_float64(const unsigned char *bytes)
{
    return float64(le64(bytes));
}

static wt_status read_picture_header(const unsigned char *header, const park_tags *tags,
                                     wt_image *head, sample_type *type, wt_error *err)
{
    static const sample_type types[] = {SAMPLE_INT16, SAMPLE_INT32, SAMPLE_FLOAT32};
    const size_t number =
        tags->picture_header.n >= PICTURE_TYPE + 4 ? le32(header + PICTURE_TYPE) : 0;
    const size_t size = tags->picture.n;
    *head = (wt_image){.n_columns = le32(header + PICTURE_COLUMNS),
                       .n_rows = le32(header + PICTURE_ROWS),
                       .x_unit = "m"};
    *type = number < sizeof types / sizeof *types ? types[number] : SAMPLE_INT16;
    if (number >= sizeof types / sizeof *types || head->n_columns == 0 || head->n_rows == 0 ||
        size / sample_width(*type) / head->n_columns != head->n_rows ||
        size != sample_width(*type) * head->n_columns * head->n_rows) {
        fail_park(err, WT_E_CORRUPT, "the size of the picture contradicts its header",
                  "16 bits, 32 bits or a float for each pixel");
        wt_error_found(err, "%zu bytes for %zu x %zu pixels of type %zu", size, head->n_columns,
                       head->n_rows, number);
        return WT_E_CORRUPT;
    }
    read_utf16_name(header + PICTURE_NAME, head->name, 33);
    images_set_size(head, 1e-6 * read_float64(header + PICTURE_WIDTH),
                    1e-6 * read_float64(header + PICTURE_HEIGHT));
    return WT_OK;
}

/* Reads the picture, with lines from the bottom upwards. A value is gain * (scale * sample +
 * offset) in the unit. */
static wt_status read_park_image(input_window *w, const park_tags *tags, image_list *list,
                                 wt_error *err)
{
    const unsigned char *header = NULL, *data = NULL;
    const size_t n = tags->picture_header.n < PICTURE_TYPE + 4 ? PICTURE_LEAST : PICTURE_TYPE + 4;
    wt_image head = {.n_columns = 0};
    sample_type type = SAMPLE_INT16;
    char unit[9];
    double *values = NULL, factor = 1, zero = 0;
    wt_status status = window_bytes(w, tags->picture_header.from, n, &header, err);
    if (status == WT_OK)
        status = read_picture_header(header, tags, &head, &type, err);
    if (status != WT_OK)
        return status;
    read_utf16_name(header + PICTURE_UNIT, unit, sizeof unit);
    const bool length = wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &zero, NULL) == WT_OK;
    snprintf(head.unit, sizeof head.unit, "%s", length ? "m" : unit[0] != '\0' ? unit : "1");
    const double given = read_float64(header + PICTURE_SCALE),
                 gain = read_float64(header + PICTURE_GAIN) * (length ? factor : 1),
                 scale = gain * (given == 0 ? 1 : given),
                 offset = gain * read_float64(header + PICTURE_OFFSET);
    status = images_add(list, &head, &values, err);
    if (status == WT_OK)
        status = window_bytes(w, tags->picture.from, tags->picture.n, &data, err);
    if (status == WT_OK)
        samples_decode(type, false, data, head.n_columns * head.n_rows, scale, offset, values);
    return status;
}

static wt_status park_images(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err)
{
    image_list list = {NULL, 0};
    input_window window = {.input = NULL};
    park_tags tags = {.magic = {.n = 0}};
    (void)self;
    (void)options;
    wt_status status = window_open(&window, input, err);
    if (status == WT_OK)
        status = find_tags(&window, &tags, err);
    if (status == WT_OK && !has_park_tags(&tags))
        status = fail_park(err, WT_E_CORRUPT, "damaged directory of tags",
                           "a TIFF file of Park Systems");
    if (status == WT_OK)
        status = check_directory_end(&window, &tags, err);
    if (status == WT_OK && !(tags.picture.is_present && tags.picture_header.is_present))
        status = fail_park(err, WT_E_EMPTY, "the file holds no picture of measured values",
                           "the tags 50434 and 50435");
    if (status == WT_OK && tags.picture_header.n < PICTURE_LEAST)
        status = fail_park(err, WT_E_CORRUPT, "the header of the picture is cut off",
                           "260 bytes or more");
    if (status == WT_OK)
        status = read_park_image(&window, &tags, &list, err);
    if (status == WT_OK)
        warn_extra_bytes(window.size, tags.end, wt_input_name(input), log);
    window_close(&window);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

/* ---- the descriptor -------------------------------------------------------------------------- */

/* The directory may be at the end of the file. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    recognition match = {.answer = ANSWER_NO};
    park_tags tags = {.magic = {.n = 0}};
    input_window window;
    (void)self;
    if (peek->length < 10 || memcmp(peek->bytes, "II*\0", 4) != 0)
        return match;
    const wt_status status = window_open(&window, peek->input, peek->err) == WT_OK
                                 ? find_tags(&window, &tags, peek->err)
                                 : WT_E_IO;
    window_close(&window);
    if (status == WT_E_MEMORY) {
        match.answer = ANSWER_FAILED;
    } else if (has_park_tags(&tags)) {
        match.answer = ANSWER_YES;
        match.score = 90;
    }
    return match;
}

static wt_status describe_curves(wt_input *input, const wt_read_options *options, wt_log *log,
                                 table_writer *metadata, wt_error *err)
{
    park_file file;
    (void)log;
    wt_status status = open_park_file(input, &file, err);
    if (status == WT_OK)
        status = load_curve(&file, 0, err);
    if (status != WT_OK) {
        window_close(&file.window);
        return status;
    }
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "points", "%zu", file.n_curves);
    for (size_t half = 0; half < 2; half++) {
        const force_metadata read = half_metadata(&file, half);
        metadata_add(metadata, half == 0 ? "segment 0" : "segment 1", "", "Time Stamp",
                     "%s, %zu points of the first curve measured, %zu stored",
                     wt_segment_kind_name(read.kind), read.n_points, file.n_samples / 2);
    }
    const force_metadata read = half_metadata(&file, 0);
    for (size_t i = 0; i < file.n_channels; i++) {
        const park_channel *c = &file.channels[i];
        const wt_quantity q = force_channel_quantity(&read, options, c);
        metadata_add(metadata, c->name, c->unit, "", "%s",
                     q != WT_Q_NONE                        ? wt_quantity_id(q)
                     : c->quantity == WT_Q_MEASURED_HEIGHT ? "constant: no sensor; not read"
                                                           : "not read");
    }
    force_describe_calibration(&read, options, "", "", metadata);
    window_close(&file.window);
    return WT_OK;
}

const file_reader reader_park = {
    .info = {.id = "park",
             .title = "TIFF files of Park Systems with force curves, an image, or both (.tiff)",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE,
             .verified = true,
             .evidence = "a measured file of seven curves and an image, whose heights were not "
                         "compared with another program",
             .version = "1"},
    .detect = detect,
    .force = &park_force,
    .read_images = park_images,
    .describe_curves = describe_curves,
    .describe = images_describe,
};
