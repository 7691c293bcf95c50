/* Reads JPK force curves, maps and quantitative imaging (ZIP): descriptor, detection, and the
 * metadata for `info`. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/jpk/jpk.h"
#include "core/table/registry.h"
#include "read/bytes/samples.h"
#include "read/header_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Slots that each channel names itself. */
#define BASE_SLOT NULL

#define PREFERRED_SLOT ""

/* The quantities with their channel and calibration slot, in the order of the columns. Of several
 * height sensors the first that is understood is used; the instrument itself works with it. */
static const struct {
    wt_quantity quantity;
    const char *channel, *slot;
} sources[] = {
    {WT_Q_HEIGHT, "height", PREFERRED_SLOT},
    {WT_Q_FORCE, "vDeflection", "force"},
    {WT_Q_DEFLECTION, "vDeflection", "distance"},
    {WT_Q_DEFLECTION_VOLTAGE, "vDeflection", BASE_SLOT},
    {WT_Q_MEASURED_HEIGHT, "measuredHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "capacitiveSensorHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "strainGaugeHeight", PREFERRED_SLOT},
    {WT_Q_MEASURED_HEIGHT, "smoothedMeasuredHeight", PREFERRED_SLOT},
    {WT_Q_LATERAL_DEFLECTION, "hDeflection", BASE_SLOT},
};

/* Computes the conversion to a slot in the SI unit of the quantity; false if the file does not
 * define it. */
static bool chain_to_si(const jpk_lcd *lcd, const char *name, force_signal *signal)
{
    const jpk_slot *slot = jpk_lcd_slot(lcd, name);
    force_linear *chain = &signal->to_si;
    double factor = 1, offset = 0;
    signal->unit = slot != NULL ? slot->unit : lcd->base_unit;
    if (!jpk_lcd_chain(lcd, name, chain))
        return false;
    if (strcmp(signal->unit, wt_quantity_unit(signal->quantity)) != 0 &&
        wt_unit_to_si(signal->unit, signal->quantity, &factor, &offset, NULL) != WT_OK)
        return false;
    *chain = (force_linear){factor * chain->multiplier, factor * chain->offset + offset};
    return isfinite(chain->multiplier) && isfinite(chain->offset);
}

static void add_signal(const jpk_channel *c, wt_quantity quantity, const char *slot,
                       force_metadata *metadata)
{
    force_signal signal = {
        .quantity = quantity, .channel = c, .name = c->name, .unit = "", .problem = c->problem};
    if (c->understood) {
        const bool is_named = slot != BASE_SLOT && *slot != '\0';
        const char *name = slot == BASE_SLOT ? c->lcd.base : is_named ? slot : c->lcd.preferred;
        const bool known = chain_to_si(&c->lcd, name, &signal);
        if (!known && is_named)
            return;
        signal.problem = known ? NULL : "it has no calibration";
    }
    force_add_signal(metadata, signal);
}

static double multiplier(const force_metadata *metadata, wt_quantity quantity)
{
    const force_signal *signal = force_find_signal(metadata, quantity);
    return signal != NULL && signal->problem == NULL ? signal->to_si.multiplier : (double)NAN;
}

/* Sets sensitivity and spring constant, which are the multipliers of the slots. */
static void set_calibration(const jpk_lcd *lcd, force_metadata *metadata)
{
    const jpk_slot *slot = jpk_lcd_slot(lcd, "force");
    const bool direct =
        slot != NULL && strcmp(slot->base, "distance") == 0 && strcmp(slot->unit, "N") == 0;
    const double deflection = multiplier(metadata, WT_Q_DEFLECTION);
    const double force = multiplier(metadata, WT_Q_FORCE);
    metadata->cantilever.sensitivity = deflection / multiplier(metadata, WT_Q_DEFLECTION_VOLTAGE);
    metadata->cantilever.spring_constant = force / deflection;
    if (direct && !isnan(metadata->cantilever.spring_constant))
        metadata->cantilever.spring_constant = slot->scaling.multiplier;
}

/* Returns the metadata of a segment except for index, place and start. The result borrows the
 * segment. */
static void jpk_segment_metadata(const jpk_segment *segment, force_metadata *metadata)
{
    *metadata = (force_metadata){
        .kind = segment->kind,
        .n_points = segment->n_points,
        .duration = segment->duration,
        .velocity = segment->velocity,
        .frequency = segment->frequency,
        .setpoint = segment->setpoint_voltage,
        .setpoint_quantity = WT_Q_DEFLECTION_VOLTAGE,
        .offers = {WT_Q_TIME},
        .n_offers = 1,
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        const wt_quantity q = sources[i].quantity;
        const jpk_channel *c = jpk_segment_channel(segment, sources[i].channel);
        force_add_offer(metadata, q);
        if (c != NULL && (c->understood || q != WT_Q_MEASURED_HEIGHT))
            add_signal(c, q, sources[i].slot, metadata);
    }
    const jpk_channel *deflection = jpk_segment_channel(segment, "vDeflection");
    if (deflection != NULL && deflection->understood)
        set_calibration(&deflection->lcd, metadata);
}

typedef struct jpk_source {
    wt_force_source base;
    jpk_file file;
    jpk_segment segment;        /* reused for each segment */
    const jpk_channel *loaded;  /* channel whose data are in the buffer of the file, or NULL */
    const jpk_segment_ref *ref; /* reference of the segment */
    size_t next;                /* refs[next] is the first segment of the next curve */
} jpk_source;

/* Returns the limit on the unpacked size of an entry: a multiple of the size of its samples, with
 * an absolute maximum. */
static size_t max_entry_size(const jpk_channel *channel)
{
    const size_t max_size = (size_t)256 << 20, slack = (size_t)1 << 20, times = 16;
    const size_t width = sample_width(channel->lcd.encoding);
    return channel->n_points < (max_size - slack) / times / width
               ? times * width * channel->n_points + slack
               : max_size;
}

static wt_status load_channel(jpk_source *source, const jpk_channel *channel, wt_error *err)
{
    jpk_file *file = &source->file;
    if (!channel->has_file)
        return wt_fail(err, WT_E_CORRUPT, "data of channel %s are missing", channel->name);
    wt_status status =
        archive_read(file->archive, channel->entry, max_entry_size(channel), &file->buffer, err);
    if (status == WT_OK)
        source->loaded = channel;
    return status;
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    jpk_source *source = (jpk_source *)base;
    jpk_file *file = &source->file;
    const jpk_channel *channel = signal->channel;
    const jpk_lcd *lcd = &channel->lcd;
    const force_linear inner = lcd->raster ? channel->raster : lcd->encoder;
    const double multiplier = scaling.multiplier * inner.multiplier;
    const double offset = scaling.multiplier * inner.offset + scaling.offset;
    if (lcd->raster) {
        for (size_t i = 0; i < n; i++)
            values[i] = multiplier * (double)i + offset;
        return WT_OK;
    }
    const wt_status status = source->loaded != channel ? load_channel(source, channel, err) : WT_OK;
    if (status == WT_OK)
        samples_decode(lcd->encoding, true, file->buffer.data, n, multiplier, offset, values);
    return status;
}

static wt_status add_segment(jpk_source *source, double start, wt_force_curve *curve, wt_error *err)
{
    const jpk_segment *segment = &source->segment;
    const char *place = archive_name(source->file.archive, source->ref->entry);
    if (segment->n_points == 0 && segment->incomplete)
        return wt_fail(err, WT_E_CORRUPT, "data of the segment are missing");
    if (segment->n_points == 0)
        wt_log_add(source->file.log, WT_NOTE, source->file.name, place,
                   "segment without samples left out");
    force_metadata metadata;
    jpk_segment_metadata(segment, &metadata);
    metadata.index = source->ref->segment;
    metadata.place = place;
    metadata.start = start;
    source->loaded = NULL;
    return force_add_segment(&source->base, &metadata, curve, err);
}

static wt_status read_jpk_curve(jpk_source *source, size_t first, size_t end, wt_force_curve *curve,
                                wt_error *err)
{
    jpk_file *file = &source->file;
    double start = 0;
    for (size_t i = first; i < end; i++) {
        const jpk_segment_ref *ref = source->ref = &file->refs[i];
        size_t before = curve->n_segments;
        wt_status status = jpk_segment_read(file, ref, &source->segment, err);
        if (status == WT_OK && force_is_segment_requested(&source->base, source->segment.kind))
            status = add_segment(source, start, curve, err);
        if (status == WT_E_CORRUPT && file->archive->defect != NULL && before > 0) {
            curve->n_segments = before;
            wt_log_add(file->log, WT_LOSS, file->name, archive_name(file->archive, ref->entry),
                       "last curve ends early: incomplete segment left out");
            return WT_OK;
        }
        if (status != WT_OK) {
            if (err != NULL && err->place[0] == '\0')
                wt_error_place(err, "%s", archive_name(file->archive, ref->entry));
            return status;
        }
        start += source->segment.duration;
    }
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    jpk_source *source = (jpk_source *)base;
    jpk_file *file = &source->file;
    size_t first = source->next, end = first;
    if (first == file->n_refs)
        return WT_END;
    while (end < file->n_refs && file->refs[end].curve == file->refs[first].curve)
        end++;
    source->next = end;
    curve->index = file->refs[first].curve;
    jpk_file_set_position(file, first, curve);
    jpk_file_check_segments(file, first, end - first);
    return read_jpk_curve(source, first, end, curve, err);
}

static void seek_curve(wt_force_source *base, size_t index)
{
    jpk_source *source = (jpk_source *)base;
    source->next = 0;
    while (source->next < source->file.n_refs && source->file.refs[source->next].curve != index)
        source->next++;
}

static void close_source(wt_force_source *base)
{
    jpk_source *source = (jpk_source *)base;
    properties_clear(&source->segment.header);
    jpk_file_close(&source->file);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    jpk_file *file = &((jpk_source *)base)->file;
    (void)self;
    wt_status status = jpk_file_open(input, base->log, file, err);
    base->n_curves = file->n_curves;
    base->grid_columns = file->columns;
    base->grid_rows = file->rows;
    return status;
}

static const force_stream jpk_force = {.size = sizeof(jpk_source),
                                       .open = open_source,
                                       .next = next_curve,
                                       .decode = decode,
                                       .seek = seek_curve,
                                       .close = close_source};

static bool jpk_peek_contains(const file_peek *peek, const char *text)
{
    /* a search through the input may move the visible bytes of a pipe */
    return peek->whole ? memmem(peek->bytes, peek->length, text, strlen(text)) != NULL
                       : input_contains(peek->input, text);
}

/* Entry names are not packed in the archive. A name of this length does not occur by chance in
 * packed data. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    recognition match = {.answer = ANSWER_NO};
    if (peek->length < 4 || memcmp(peek->bytes, "PK\3\4", 4) != 0)
        return match;
    if (jpk_peek_contains(peek, "/segment-header.properties")) {
        match.answer = ANSWER_YES;
        match.score = 95;
    } else if (jpk_peek_contains(peek, "data-image.") &&
               jpk_peek_contains(peek, "header.properties")) {
        match.answer = ANSWER_UNSUPPORTED;
        snprintf(match.reason, sizeof match.reason, "a JPK file without force curves");
    }
    return match;
}

/* ---- metadata -------------------------------------------------------------------------------- */

static const char *find_description(const jpk_file *file, const char *name)
{
    char key[192];
    const char *type = properties_get(&file->header, "type");
    if (type == NULL)
        return NULL;
    snprintf(key, sizeof key, "%s.description.", type);
    return properties_find(&file->header, key, name);
}

static void add_identity(const jpk_file *file, table_writer *metadata)
{
    static const struct {
        const char *item, *name;
    } known[] = {{"instrument", "instrument"},
                 {"software", "source-software"},
                 {"sample", "name"},
                 {"probe", "probe"},
                 {"comment", "comment"}};
    const char *version = properties_get(&file->header, "file-format-version");
    metadata_add(metadata, "format version", "", "file-format-version", "%s",
                 version != NULL ? version : "not stated");
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        metadata_add_text(metadata, known[i].item, known[i].name,
                          find_description(file, known[i].name));
}

static void add_curves(const jpk_file *file, table_writer *metadata)
{
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "entries", "%zu", file->n_curves);
    if (file->n_expected > 0)
        metadata_add(metadata, "curves planned", "", "indexes", "%zu", file->n_expected);
    if (file->columns > 0)
        metadata_add(metadata, "grid", "", "position-pattern.grid", "%ld x %ld%s", file->columns,
                     file->rows, file->back_and_forth ? ", back and forth" : "");
    if (file->archive->defect != NULL)
        metadata_add(metadata, "odd", "", "", "%s", file->archive->defect);
}

static void describe_segment(const jpk_segment *segment, size_t number,
                             const wt_read_options *options, table_writer *metadata)
{
    char item[160];
    force_metadata read;
    jpk_segment_metadata(segment, &read);
    snprintf(item, sizeof item, "segment %zu", number);
    metadata_add(metadata, item, "", "segment-header.properties", "%s (%s), %zu points",
                 wt_segment_kind_name(segment->kind),
                 segment->style[0] != '\0' ? segment->style : "no style", segment->n_points);
    snprintf(item, sizeof item, "segment %zu duration", number);
    if (!isnan(segment->duration))
        metadata_add_number(metadata, item, segment->duration, "s", "duration");
    snprintf(item, sizeof item, "segment %zu velocity", number);
    if (!isnan(segment->velocity))
        metadata_add_number(metadata, item, segment->velocity, "m/s", "z-start, z-end, duration");
    snprintf(item, sizeof item, "segment %zu odd", number);
    if (segment->incomplete)
        metadata_add(metadata, item, "", "", "data are missing or short");
    for (size_t i = 0; i < segment->n_channels; i++) {
        const jpk_channel *c = &segment->channels[i];
        const wt_quantity quantity = force_channel_quantity(&read, options, c);
        const char *quantity_text = quantity == WT_Q_NONE ? "not read" : wt_quantity_id(quantity);
        const jpk_slot *slot = c->understood ? jpk_lcd_slot(&c->lcd, c->lcd.preferred) : NULL;
        snprintf(item, sizeof item, "segment %zu channel %s", number, c->name);
        if (c->understood)
            metadata_add(metadata, item, slot != NULL ? slot->unit : c->lcd.base_unit,
                         c->lcd.preferred, "%s", quantity_text);
        else
            metadata_add(metadata, item, "", "", "%s: %s", quantity_text, c->problem);
    }
}

static void describe_calibration(const jpk_segment *segment, const wt_read_options *options,
                                 table_writer *metadata)
{
    const jpk_channel *deflection = jpk_segment_channel(segment, "vDeflection");
    force_metadata read;
    jpk_segment_metadata(segment, &read);
    if (deflection == NULL || !deflection->understood)
        metadata_add(metadata, fact_item_text(FACT_MISSING), "", "", "no channel vDeflection");
    else
        force_describe_calibration(&read, options, "conversion to force", "conversion to distance",
                                   metadata);
}

/* Describes the file. The segments of the first curve represent all, since the curves of a map have
 * the same segments. */
static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    (void)self;
    jpk_file file = {0};
    wt_status status = jpk_file_open(input, log, &file, metadata->err);
    if (status != WT_OK)
        return status;
    jpk_segment *segment = wt_alloc(1, sizeof *segment);
    for (size_t i = 0; i < file.n_refs && file.refs[i].curve == file.refs[0].curve; i++) {
        status = jpk_segment_read(&file, &file.refs[i], segment, metadata->err);
        if (status != WT_OK)
            break;
        if (i == 0) {
            add_identity(&file, metadata);
            add_curves(&file, metadata);
            describe_calibration(segment, options, metadata);
        }
        describe_segment(segment, file.refs[i].segment, options, metadata);
    }
    properties_clear(&segment->header);
    free(segment);
    jpk_file_close(&file);
    return status;
}

const file_reader reader_jpk = {
    .info = {.id = "jpk",
             .title = "JPK force curves, maps and quantitative imaging (ZIP)",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence =
                 "measured files of 2013 to 2022, software 4.3 to 6.3: single curves, maps, "
                 "quantitative imaging, pauses, 16-bit and 32-bit data; modulation segments: "
                 "not verified on a genuine file",
             .version = "1"},
    .detect = detect,
    .force = &jpk_force,
    .describe = describe,
};
