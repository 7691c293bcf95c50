/* Reads force maps of Asylum Research (.ardf).
 *
 * The file is a chain of sections: check sum (CRC-32 of all behind it), size, name of four letters,
 * a number, content. Tables of contents name the position of a volume of curves and of a note of
 * "key: value" lines, which is that of an Igor wave of the same instrument. Each curve is a section
 * VSET with its line, point and the position of the next one, a name, and the samples of each
 * channel as floats. A table has one entry for each line; an interrupted map has entries of zeros.
 *
 * The layout is known from readers of other programs. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/table/registry.h"
#include "read/bytes/bytes.h"
#include "read/ibw/ibw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    HEADER = 16,       /* of a section */
    TABLE = 32,        /* of a table, before its entries */
    ENTRY = 24,        /* of a table of contents */
    TEXT_ENTRY = 32,   /* of a table of texts */
    LINE_ENTRY = 40,   /* of the table of lines */
    TEXT_BEGIN = 24,   /* of a text in its section */
    VOLUME = 208,      /* definition of the volume */
    CHANNEL = 80,      /* definition of a channel */
    CURVE = 48,        /* VSET */
    SAMPLES_BEGIN = 56 /* in the section of samples */
};
enum { LINES_MAX = 1 << 20, NOTE_MAX = 1 << 20, SEGMENTS = 5 };
#define SAMPLES_MAX ((size_t)1 << 26) /* of a channel of a curve */

typedef struct ardf_file {
    input_window window;
    const unsigned char *b; /* the section that was read last, */
    size_t size;            /* its size */
    ibw_file wave;          /* channels and note as those of an Igor wave */
    char *note;             /* owned */
    size_t columns, lines;  /* of the map */
    size_t volumes;         /* in the file */
    double step_x, step_y;  /* [m], NaN if unknown */
    uint64_t next;          /* position of the next curve, 0 after the last one */
    unsigned pass;          /* trace or retrace, as the first curve */
    wt_segment_kind kinds[SEGMENTS];
    size_t n_kinds;
    size_t data[IBW_CHANNELS]; /* position of the samples of each channel of the current curve */
} ardf_file;

/* ---- sections -------------------------------------------------------------------------------- */

static wt_status fail_section(wt_error *err, size_t at, const char *expected)
{
    (void)wt_fail(err, WT_E_CORRUPT, "the file is damaged");
    wt_error_place(err, "byte %zu", at);
    wt_error_expected(err, "%s", expected);
    wt_error_advice(err, "copy the file again from the instrument");
    return WT_E_CORRUPT;
}

/* True if a section of this name is here. */
static bool is_section(ardf_file *f, size_t at, const char *name)
{
    return window_bytes(&f->window, at, HEADER, &f->b, NULL) == WT_OK &&
           memcmp(f->b + 8, name, 4) == 0;
}

/* Reads a section of this name and at least this size, and checks its sum. That of an unfinished
 * table of lines need not agree; its entries have their own. */
static wt_status read_section(ardf_file *f, size_t at, const char *name, size_t least,
                              wt_error *err)
{
    wt_status status = window_bytes(&f->window, at, HEADER, &f->b, err);
    f->size = status == WT_OK ? le32(f->b + 4) : 0;
    if (status == WT_OK && memcmp(f->b + 8, name, 4) != 0)
        return fail_section(err, at, name);
    if (status == WT_OK && (f->size < least || f->size > SAMPLES_BEGIN + 4 * SAMPLES_MAX))
        return fail_section(err, at, "a section of a possible size");
    if (status == WT_OK)
        status = window_bytes(&f->window, at, f->size, &f->b, err);
    if (status == WT_OK && strcmp(name, "VTOC") != 0 &&
        crc32(0, f->b + 4, (uInt)(f->size - 4)) != le32(f->b))
        return fail_section(err, at, "a section whose check sum agrees");
    return status;
}

/* Reads a table of entries of this size, and sets *at behind it. Counts the entries of a name;
 * *value is the smallest of their last numbers. Entries of zeros belong to lines that were not
 * measured. */
static wt_status read_table(ardf_file *f, size_t *at, const char *name, size_t entry,
                            const char *wanted, uint64_t *value, size_t *n, wt_error *err)
{
    wt_status status = read_section(f, *at, name, TABLE, err);
    const size_t entries = status == WT_OK ? le32(f->b + 24) : 0, from = *at + TABLE;
    *n = 0;
    if (status == WT_OK && (le32(f->b + 28) != entry || entries > LINES_MAX ||
                            le64(f->b + 16) != TABLE + entries * entry))
        return fail_section(err, *at, "a table whose sizes agree");
    for (size_t i = 0; status == WT_OK && i < entries; i++) {
        const size_t place = from + i * entry;
        status = window_bytes(&f->window, place, entry, &f->b, err);
        if (status != WT_OK || memcmp(f->b + 8, wanted, 4) != 0)
            continue;
        if (crc32(0, f->b + 4, (uInt)entry - 4) != le32(f->b))
            return fail_section(err, place, "an entry whose check sum agrees");
        const uint64_t last = le64(f->b + entry - 8);
        *value = (*n)++ == 0 || last < *value ? last : *value;
    }
    *at = from + entries * entry;
    return status;
}

/* ---- opening --------------------------------------------------------------------------------- */

/* Reads the note, the first text of the table. A file without one has no calibration. */
static wt_status read_note(ardf_file *f, size_t at, wt_error *err)
{
    uint64_t place = 0;
    size_t n = 0;
    wt_status status = read_table(f, &at, "TTOC", TEXT_ENTRY, "TOFF", &place, &n, err);
    if (status == WT_OK && n > 0)
        status = read_section(f, place, "TEXT", TEXT_BEGIN, err);
    if (status != WT_OK || n == 0)
        return status;
    const size_t length = le32(f->b + 20);
    if (length > f->size - TEXT_BEGIN || length > NOTE_MAX)
        return fail_section(err, place, "a note within its section");
    f->note = wt_alloc(length + 1, 1);
    memcpy(f->note, f->b + TEXT_BEGIN, length);
    f->wave.note = f->note;
    f->wave.note_length = length;
    return WT_OK;
}

static double read_step(const unsigned char *number, const unsigned char *unit, const char *wanted)
{
    const double step = float64(le64(number));
    return strncmp((const char *)unit, wanted, 32) == 0 && isfinite(step) && step > 0 ? step
                                                                                      : (double)NAN;
}

/* Reads the definition of the volume: size of the map, sampling interval, names of the segments. */
static wt_status read_volume(ardf_file *f, size_t at, wt_error *err)
{
    char names[33] = "";
    const wt_status status = read_section(f, at, "VDEF", VOLUME, err);
    if (status != WT_OK)
        return status;
    f->columns = le32(f->b + 16);
    f->lines = le32(f->b + 20);
    if (f->columns == 0 || f->columns > LINES_MAX || f->lines == 0 || f->lines > LINES_MAX)
        return fail_section(err, at, "a map of up to 1048576 lines and columns");
    f->step_x = read_step(f->b + 48, f->b + 72, "m");
    f->step_y = read_step(f->b + 56, f->b + 104, "m");
    f->wave.interval = read_step(f->b + 64, f->b + 136, "s");
    memcpy(names, f->b + 168, sizeof names - 1);
    for (char *rest = names, *name; (name = strsep(&rest, ";")) != NULL;)
        if (*name != '\0' && f->n_kinds < SEGMENTS)
            f->kinds[f->n_kinds++] = strncmp(name, "Ext", 3) == 0   ? WT_SEGMENT_APPROACH
                                     : strncmp(name, "Ret", 3) == 0 ? WT_SEGMENT_RETRACT
                                                                    : WT_SEGMENT_DWELL;
    return WT_OK;
}

/* Reads the definitions of the channels from *at on, and sets *at behind them. Heights and
 * deflections are in metres; channels of other units stay without a name. */
static wt_status read_channels(ardf_file *f, size_t *at, wt_error *err)
{
    wt_status status = WT_OK;
    while (is_section(f, *at, "VCHN")) {
        ibw_channel *const channel = &f->wave.channels[f->wave.n_channels];
        if (f->wave.n_channels == IBW_CHANNELS)
            return fail_section(err, *at, "32 channels at most");
        status = read_section(f, *at, "VCHN", CHANNEL, err);
        if (status != WT_OK)
            return status;
        channel->number = f->wave.n_channels++;
        if (strncmp((const char *)f->b + HEADER + 32, "m", 32) == 0)
            memcpy(channel->name, f->b + HEADER, 32);
        *at += f->size;
    }
    status = read_section(f, *at, "XDEF", HEADER, err);
    *at += f->size;
    return status;
}

static wt_status open_volume(ardf_file *f, size_t at, wt_error *err)
{
    uint64_t unused = 0;
    size_t n = 0;
    wt_status status = read_table(f, &at, "VOLM", ENTRY, "NSET", &unused, &n, err);
    if (status == WT_OK)
        status = read_table(f, &at, "TTOC", TEXT_ENTRY, "TOFF", &unused, &n, err);
    if (status == WT_OK)
        status = read_volume(f, at, err);
    at += f->size;
    if (status == WT_OK)
        status = read_channels(f, &at, err);
    if (status == WT_OK)
        status = read_table(f, &at, "VTOC", LINE_ENTRY, "VOFF", &f->next, &n, err);
    if (status == WT_OK && n == 0)
        status = wt_fail(err, WT_E_EMPTY, "the map was stopped before its first curve");
    if (status == WT_OK)
        status = read_section(f, f->next, "VSET", CURVE, err);
    f->pass = status == WT_OK ? le32(f->b + 28) : 0;
    return status;
}

static wt_status open_ardf(wt_input *input, ardf_file *f, wt_error *err)
{
    uint64_t volume = 0;
    size_t at = HEADER;
    *f = (ardf_file){.wave = {.name = wt_input_name(input)}};
    wt_status status = window_open(&f->window, input, err);
    if (status == WT_OK)
        status = read_table(f, &at, "FTOC", ENTRY, "VOLM", &volume, &f->volumes, err);
    if (status == WT_OK && f->volumes == 0)
        status = wt_fail(err, WT_E_EMPTY, "the file holds images and no force curve");
    if (status == WT_OK)
        status = read_note(f, at, err);
    return status == WT_OK ? open_volume(f, volume, err) : status;
}

static void close_ardf(ardf_file *f)
{
    window_close(&f->window);
    free(f->note);
}

/* ---- curves ---------------------------------------------------------------------------------- */

typedef struct ardf_source {
    wt_force_source base;
    ardf_file file;
    force_metadata metadata;
    size_t number; /* of the next curve */
    size_t from;   /* first sample of the current segment */
} ardf_source;

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    ardf_source *const s = (ardf_source *)base;
    const ibw_channel *const channel = signal->channel;
    const unsigned char *bytes = NULL;
    const wt_status status = window_bytes(
        &s->file.window, s->file.data[channel->number] + 4 * s->from, 4 * n, &bytes, err);
    if (status == WT_OK)
        samples_decode(SAMPLE_FLOAT32, false, bytes, n, scaling.multiplier, scaling.offset, values);
    return status;
}

/* Locates the samples of the curve whose name is at `at`, and the first sample of each segment. */
static wt_status locate_samples(ardf_file *f, size_t at, const unsigned char place[8],
                                size_t begins[SEGMENTS], size_t *n, wt_error *err)
{
    wt_status status = read_section(f, at, "VNAM", HEADER, err);
    for (size_t i = 0; status == WT_OK && i < f->wave.n_channels; i++) {
        at += f->size;
        status = read_section(f, at, "VDAT", SAMPLES_BEGIN, err);
        if (status != WT_OK)
            break;
        const size_t samples = le32(f->b + 28);
        if (samples > (f->size - SAMPLES_BEGIN) / 4 || le32(f->b + 32) != i ||
            memcmp(f->b + 20, place, 8) != 0 || (i > 0 && samples != f->wave.n))
            return fail_section(err, at, "the samples of each channel of one curve");
        f->data[i] = at + SAMPLES_BEGIN;
        f->wave.n = samples;
        *n = 0;
        for (size_t k = 0; k < SEGMENTS; k++) { /* the last sample and zeros follow the begins */
            const size_t begin = le32(f->b + 36 + 4 * k);
            if (begin + 1 >= samples || (k == 0 ? begin != 0 : begin <= begins[k - 1]))
                break;
            begins[(*n)++] = begin;
        }
    }
    if (status == WT_OK && (*n == 0 || *n != f->n_kinds))
        return fail_section(err, at, "a first sample for each segment that the volume names");
    return status;
}

/* Reads the segments of the current curve. */
static wt_status add_segments(ardf_source *s, const size_t *begins, size_t n, wt_force_curve *curve,
                              wt_error *err)
{
    const ibw_file *const wave = &s->file.wave;
    wt_status status = WT_OK;
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        force_metadata metadata = s->metadata;
        metadata.kind = s->file.kinds[i];
        metadata.index = i;
        metadata.n_points = (i + 1 < n ? begins[i + 1] : wave->n) - begins[i];
        metadata.start = wave->interval * (double)begins[i];
        metadata.duration = wave->interval * (double)metadata.n_points;
        s->from = begins[i];
        if (force_is_segment_requested(&s->base, metadata.kind))
            status = force_add_segment(&s->base, &metadata, curve, err);
    }
    return status;
}

/* Finds the next curve of this pass, its place (line, point) and what follows it. WT_END after the
 * last one. Positions rise in the file, so the walk ends. */
static wt_status find_curve(ardf_source *s, unsigned char place[8], size_t *at, wt_error *err)
{
    ardf_file *const f = &s->file;
    while (s->number < s->base.n_curves && is_section(f, f->next, "VSET")) {
        const size_t here = f->next;
        f->next = 0;
        const wt_status status = read_section(f, here, "VSET", CURVE, err);
        if (status != WT_OK)
            return status;
        f->next = le64(f->b + 40) > here ? le64(f->b + 40) : 0;
        if (le32(f->b + 20) >= f->lines || le32(f->b + 24) >= f->columns)
            return fail_section(err, here, "a place in the map");
        memcpy(place, f->b + 20, 8);
        *at = here + f->size;
        if (le32(f->b + 28) == f->pass)
            return WT_OK;
    }
    if (s->number < s->base.n_curves)
        wt_log_add(s->base.log, WT_WARNING, s->base.name, NULL,
                   "the file holds %zu of %zu curves: the map was stopped", s->number,
                   s->base.n_curves);
    s->number = s->base.n_curves;
    return WT_END;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    ardf_source *const s = (ardf_source *)base;
    size_t begins[SEGMENTS], n = 0, at = 0;
    unsigned char place[8];
    wt_status status = find_curve(s, place, &at, err);
    if (status == WT_END)
        return status;
    curve->index = s->number++; /* also of a curve that cannot be read */
    if (status != WT_OK)
        return status;
    curve->grid_y = (long)le32(place);
    curve->grid_x = (long)le32(place + 4);
    curve->x = s->file.step_x * (double)curve->grid_x;
    curve->y = s->file.step_y * (double)curve->grid_y;
    status = locate_samples(&s->file, at, place, begins, &n, err);
    return status == WT_OK ? add_segments(s, begins, n, curve, err) : status;
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    ardf_source *const s = (ardf_source *)base;
    (void)self;
    const wt_status status = open_ardf(input, &s->file, err);
    if (status != WT_OK)
        return status;
    s->metadata = ibw_metadata(&s->file.wave, base->log);
    base->n_curves = s->file.columns * s->file.lines;
    base->grid_columns = (long)s->file.columns;
    base->grid_rows = (long)s->file.lines;
    if (s->file.volumes > 1)
        wt_log_add(base->log, WT_WARNING, base->name, NULL,
                   "the first of %zu volumes is read, such as trace without retrace",
                   s->file.volumes);
    return WT_OK;
}

static void close_source(wt_force_source *base)
{
    close_ardf(&((ardf_source *)base)->file);
}

static const force_stream ardf_force = {.size = sizeof(ardf_source),
                                        .open = open_source,
                                        .next = next_curve,
                                        .decode = decode,
                                        .close = close_source};

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    ardf_file f;
    (void)self;
    const wt_status status = open_ardf(input, &f, metadata->err);
    if (status == WT_OK) {
        const force_metadata read = ibw_metadata(&f.wave, log);
        metadata_add(metadata, fact_item_text(FACT_CURVES), "", "VDEF", "%zu", f.columns * f.lines);
        metadata_add(metadata, "grid", "", "VDEF", "%zu x %zu", f.columns, f.lines);
        ibw_describe_channels(&f.wave, &read, options, metadata);
    }
    close_ardf(&f);
    return status;
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(peek->length >= HEADER && memcmp(peek->bytes + 8, "ARDF", 4) == 0,
                              95);
}

const file_reader reader_ardf = {
    .info = {.id = "ardf",
             .title = "Force maps of Asylum Research (.ardf)",
             .kinds = WT_KIND_FORCE,
             .verified = false,
             .evidence = "the layout as readers of other programs have it; not tried on a "
                         "measured file",
             .version = "1"},
    .detect = detect,
    .force = &ardf_force,
    .describe = describe,
};
