/* Reads JPK force curves, maps and quantitative imaging (ZIP): descriptor, detection, and the
 * metadata for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"
#include "read/bytes/window.h"
#include "read/metadata.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const char *text = find_description(file, known[i].name);
        if (text != NULL && *text != '\0')
            metadata_add(metadata, known[i].item, "", known[i].name, "%s", text);
    }
}

static void add_curves(const jpk_file *file, table_writer *metadata)
{
    metadata_add(metadata, "curves", "", "entries", "%zu", file->n_curves);
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
        metadata_add(metadata, "missing", "", "", "no channel vDeflection");
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
    jpk_segment *segment = calloc(1, sizeof *segment);
    if (segment == NULL)
        status = wt_fail(metadata->err, WT_E_MEMORY, "no memory to describe the file");
    for (size_t i = 0; i < file.n_refs && file.refs[i].curve == file.refs[0].curve; i++) {
        if (status == WT_OK)
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
    if (segment != NULL)
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
