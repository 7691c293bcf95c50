/* TIFF files of Park Systems with force curves (.tiff): the tags of Park beside those of a picture
 * hold a header of channels and one block of floats, curve by curve, channel by channel. Of each
 * half, way in and way out, only the first samples were measured; the rest repeats the last one.
 *
 * Known from one measured file of seven curves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/bytes.h"
#include "read/bytes/samples.h"
#include "read/facts.h"
#include "read/force_source.h"
#include "read/reader.h"

#include <math.h>

enum {
    TAG_MAGIC = 50432,
    TAG_SPECTROSCOPY = 50438,
    TAG_SAMPLES = 50439,
    CHANNELS = 8,
    SLOT = 96,      /* bytes of a channel in the header: */
    SLOT_UNIT = 64, /* behind the name */
    SLOT_GAIN = 80, /* behind the unit */
    COUNTS = 768,   /* channels, averages, samples, points */
    HEADER = COUNTS + 20,
    ENTRY = 12 /* of a tag in the directory */
};
static const uint32_t magic = 0x0e031301;

typedef struct park_channel {
    char name[33], unit[9];
    size_t number;
    double gain;
    wt_quantity quantity; /* WT_Q_NONE: not read */
    double factor;        /* from the unit to that of the quantity */
} park_channel;

typedef struct park_file {
    const char *name;
    const unsigned char *data; /* of the block */
    park_channel channels[CHANNELS];
    size_t n_channels, n_samples, n_curves;
} park_file;

/* ---- the file ---------------------------------------------------------------------------------
 */

/* The bytes of a tag; false if it is not there or points behind the end. */
static bool find_tag(const unsigned char *bytes, size_t length, uint16_t tag,
                     const unsigned char **data, size_t *n)
{
    static const unsigned char widths[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
    const size_t at = le32(bytes + 4);
    if (at < 8 || at > length - 2)
        return false;
    const size_t entries = le16(bytes + at);
    if (entries > (length - at - 2) / ENTRY)
        return false;
    for (size_t i = 0; i < entries; i++) {
        const unsigned char *entry = bytes + at + 2 + ENTRY * i;
        const size_t type = le16(entry + 2), count = le32(entry + 4);
        if (le16(entry) != tag || type >= sizeof widths)
            continue;
        const size_t size = widths[type] * count, from = le32(entry + 8);
        *n = size;
        if (size > 4 && (from > length || size > length - from))
            return false;
        *data = size <= 4 ? entry + 8 : bytes + from;
        return true;
    }
    return false;
}

/* Picture of Park whose directory is there. */
static bool is_park(const unsigned char *bytes, size_t length)
{
    const unsigned char *tag = NULL;
    size_t n = 0;
    return length >= 10 && memcmp(bytes, "II*\0", 4) == 0 &&
           find_tag(bytes, length, TAG_MAGIC, &tag, &n) && n == 4 && le32(tag) == magic;
}

/* UTF-16 that is ASCII. */
static void read_name(const unsigned char *from, char *to, size_t size)
{
    size_t n = 0;
    for (; n + 1 < size && le16(from + 2 * n) != 0; n++)
        to[n] = le16(from + 2 * n) < 0x80 ? (char)from[2 * n] : '?';
    to[n] = '\0';
}

static void read_channel(const unsigned char *slot, size_t number, park_channel *c)
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
    read_name(slot, c->name, sizeof c->name);
    read_name(slot + SLOT_UNIT, c->unit, sizeof c->unit);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(c->name, known[i].name) == 0 && isfinite(c->gain) &&
            wt_unit_to_si(strcmp(c->unit, "usec") == 0 ? "us" : c->unit, known[i].quantity,
                          &c->factor, &offset, NULL) == WT_OK)
            c->quantity = known[i].quantity;
}

static wt_status fail(wt_error *err, wt_status status, const char *message, const char *expected)
{
    wt_fail(err, status, "%s", message);
    wt_error_expected(err, "%s", expected);
    return status;
}

static wt_status open_file(wt_input *input, park_file *f, wt_error *err)
{
    const unsigned char *bytes = NULL, *header = NULL;
    size_t length = 0, n = 0, block = 0;
    *f = (park_file){.name = wt_input_name(input)};
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    if (!is_park(bytes, length))
        return fail(err, WT_E_CORRUPT, "damaged directory of tags", "a TIFF file of Park Systems");
    if (!find_tag(bytes, length, TAG_SPECTROSCOPY, &header, &n))
        return fail(err, WT_E_EMPTY, "the picture holds no force curve",
                    "the tag 50438 of spectroscopy");
    if (n < HEADER || !find_tag(bytes, length, TAG_SAMPLES, &f->data, &block))
        return fail(err, WT_E_CORRUPT, "the block of samples is missing", "the tag 50439");
    f->n_channels = le32(header + COUNTS);
    f->n_samples = le32(header + COUNTS + 8);
    f->n_curves = le32(header + COUNTS + 12);
    if (f->n_channels == 0 || f->n_channels > CHANNELS || f->n_samples < 2 || f->n_curves == 0 ||
        block / 4 / f->n_channels / f->n_samples != f->n_curves ||
        block != 4 * f->n_channels * f->n_samples * f->n_curves) {
        wt_error_found(err, "%zu bytes for %zu curves of %zu channels of %zu samples", block,
                       f->n_curves, f->n_channels, f->n_samples);
        return fail(err, WT_E_CORRUPT, "the sizes of the block contradict one another",
                    "four bytes for each sample");
    }
    for (size_t c = 0; c < f->n_channels; c++)
        read_channel(header + SLOT * c, c, &f->channels[c]);
    return WT_OK;
}

static const unsigned char *samples_of(const park_file *f, const park_channel *c, size_t curve,
                                       size_t from)
{
    return f->data + 4 * ((curve * f->n_channels + c->number) * f->n_samples + from);
}

/* Samples from `from` on, up to `n`, until the time rises no more. */
static size_t measured(const park_file *f, size_t curve, size_t from, size_t n)
{
    for (size_t i = 0; i < f->n_channels; i++) {
        const park_channel *c = &f->channels[i];
        if (c->quantity != WT_Q_TIME)
            continue;
        const unsigned char *time = samples_of(f, c, curve, from);
        size_t valid = 1;
        while (valid < n && float32(le32(time + 4 * valid)) > float32(le32(time + 4 * valid - 4)))
            valid++;
        return valid;
    }
    return n;
}

/* A channel that is the same everywhere is that of a sensor that the instrument does not have. */
static bool constant(const park_file *f, const park_channel *c, size_t curve)
{
    const unsigned char *values = samples_of(f, c, curve, 0);
    for (size_t i = 1; i < f->n_samples; i++)
        if (memcmp(values, values + 4 * i, 4) != 0)
            return false;
    return true;
}

static force_facts facts_of(const park_file *f, size_t curve, size_t half)
{
    const size_t n = f->n_samples / 2;
    force_facts facts = {.kind = half == 0 ? WT_SEGMENT_APPROACH : WT_SEGMENT_RETRACT,
                         .index = half,
                         .n_points = measured(f, curve, half * n, n),
                         .duration = (double)NAN,
                         .velocity = (double)NAN,
                         .setpoint = (double)NAN,
                         .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN},
                         .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE,
                                    WT_Q_DEFLECTION_VOLTAGE},
                         .n_offers = 5};
    for (size_t i = 0; i < f->n_channels; i++) {
        const park_channel *c = &f->channels[i];
        if (c->quantity == WT_Q_NONE ||
            (c->quantity == WT_Q_MEASURED_HEIGHT && constant(f, c, curve)))
            continue;
        force_add_signal(&facts, (force_signal){.quantity = c->quantity,
                                                .name = c->name,
                                                .unit = c->unit,
                                                .to_si = {c->gain * c->factor, 0},
                                                .channel = c});
    }
    return facts;
}

/* ---- curves -----------------------------------------------------------------------------------
 */

typedef struct park_source {
    wt_force_source base;
    park_file file;
    size_t curve, from; /* of the segment that is read */
} park_source;

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const park_source *s = (const park_source *)base;
    (void)err;
    const size_t missing = samples_decode(SAMPLE_FLOAT32, false,
                                          samples_of(&s->file, signal->channel, s->curve, s->from),
                                          n, scaling.multiplier, scaling.offset, values);
    if (missing > 0)
        wt_parselog_add(base->log, WT_WARNING, base->name, signal->name,
                        "%zu samples are not finite numbers and left out", missing);
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    park_source *s = (park_source *)base;
    wt_status status = WT_OK;
    if (s->curve == s->file.n_curves)
        return WT_END;
    curve->index = s->curve;
    for (size_t half = 0; half < 2 && status == WT_OK; half++) {
        const force_facts facts = facts_of(&s->file, s->curve, half);
        s->from = half * (s->file.n_samples / 2);
        if (force_wants_segment(base, facts.kind))
            status = force_add_segment(base, &facts, curve, err);
    }
    s->curve++;
    return status;
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    park_file *f = &((park_source *)base)->file;
    (void)self;
    wt_status status = open_file(input, f, err);
    bool timed = false;
    for (size_t i = 0; i < f->n_channels && i < CHANNELS; i++)
        timed = timed || f->channels[i].quantity == WT_Q_TIME;
    if (status == WT_OK && !timed)
        wt_parselog_add(base->log, WT_WARNING, base->name, NULL,
                        "no channel Time Stamp: samples that were not measured cannot be told from "
                        "those that were");
    base->n_curves = f->n_curves;
    return status;
}

static const force_stream park_force = {
    .size = sizeof(park_source), .open = open_source, .next = next_curve, .decode = decode};

/* ---- the descriptor ---------------------------------------------------------------------------
 */

static recognition detect(const file_reader *self, file_peek *peek)
{
    const unsigned char *tag = NULL;
    size_t n = 0;
    recognition match = {.answer = ANSWER_NO};
    (void)self;
    if (peek->length < 10 || memcmp(peek->bytes, "II*\0", 4) != 0)
        return match;
    if (!peek->whole) {
        match.answer = ANSWER_MORE; /* the directory may stand at the end */
        match.need = SIZE_MAX;
    } else if (is_park(peek->bytes, peek->length)) {
        match.answer = ANSWER_YES;
        match.score = 90;
        if (!find_tag(peek->bytes, peek->length, TAG_SPECTROSCOPY, &tag, &n)) {
            match.answer = ANSWER_UNSUPPORTED;
            snprintf(match.reason, sizeof match.reason,
                     "a picture of Park Systems without force curves: export it as text");
        }
    }
    return match;
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, table_writer *facts)
{
    park_file file;
    (void)self;
    (void)log;
    wt_status status = open_file(input, &file, facts->err);
    if (status != WT_OK)
        return status;
    facts_add(facts, "curves", "", "points", "%zu", file.n_curves);
    for (size_t half = 0; half < 2; half++) {
        const force_facts read = facts_of(&file, 0, half);
        facts_add(facts, half == 0 ? "segment 0" : "segment 1", "", "Time Stamp",
                  "%s, %zu points of the first curve measured, %zu stored",
                  wt_segment_kind_name(read.kind), read.n_points, file.n_samples / 2);
    }
    const force_facts read = facts_of(&file, 0, 0);
    for (size_t i = 0; i < file.n_channels; i++) {
        const park_channel *c = &file.channels[i];
        const wt_quantity q = force_read_as(&read, options, c);
        facts_add(facts, c->name, c->unit, "", "%s",
                  q != WT_Q_NONE                        ? wt_quantity_id(q)
                  : c->quantity == WT_Q_MEASURED_HEIGHT ? "constant: no sensor; not read"
                                                        : "not read");
    }
    force_describe_calibration(&read, options, "", "", facts);
    return WT_OK;
}

const file_reader reader_park = {
    .info = {.id = "park",
             .title = "TIFF files of Park Systems with force curves (.tiff)",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence = "a measured file of seven curves",
             .version = "1"},
    .detect = detect,
    .force = &park_force,
    .describe = describe,
};
