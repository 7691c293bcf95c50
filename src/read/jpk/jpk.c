/* JPK force curves, maps and quantitative imaging (ZIP): the descriptor, detection, and the facts
 * for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"
#include "read/facts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool contains(const file_peek *peek, const char *text)
{
    return memmem(peek->bytes, peek->length, text, strlen(text)) != NULL;
}

/* Names of entries stand unpacked in the archive; a name this long does not come about by chance in
 * packed data. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    recognition match = {.answer = ANSWER_NO};
    if (peek->length < 4 || memcmp(peek->bytes, "PK\3\4", 4) != 0)
        return match;
    if (contains(peek, "/segment-header.properties")) {
        match.answer = ANSWER_YES;
        match.score = 95;
    } else if (!peek->whole) {
        match.answer = ANSWER_MORE;
        match.need = 4 * peek->length;
    } else if (contains(peek, "data-image.") && contains(peek, "header.properties")) {
        match.answer = ANSWER_UNSUPPORTED;
        snprintf(match.reason, sizeof match.reason, "a JPK file without force curves");
    }
    return match;
}

/* ---- facts -------------------------------------------------------------------------------- */

static const char *described(const jpk_file *file, const char *name)
{
    char key[192];
    const char *type = properties_get(&file->header, "type");
    if (type == NULL)
        return NULL;
    snprintf(key, sizeof key, "%s.description.", type);
    return properties_find(&file->header, key, name);
}

static wt_status add_identity(const jpk_file *file, wt_table *facts, wt_error *err)
{
    static const struct {
        const char *item, *name;
    } known[] = {{"instrument", "instrument"},
                 {"software", "source-software"},
                 {"sample", "name"},
                 {"probe", "probe"},
                 {"comment", "comment"}};
    wt_status status = WT_OK;
    const char *version = properties_get(&file->header, "file-format-version");
    status = facts_add(facts, "format version", version != NULL ? version : "not stated", "",
                       "file-format-version", err);
    for (size_t i = 0; i < sizeof known / sizeof *known && status == WT_OK; i++) {
        const char *text = described(file, known[i].name);
        if (text != NULL && *text != '\0')
            status = facts_add(facts, known[i].item, text, "", known[i].name, err);
    }
    return status;
}

static wt_status add_curves(const jpk_file *file, wt_table *facts, wt_error *err)
{
    char text[64];
    wt_status status = facts_count(facts, "curves", file->n_curves, "entries", err);
    if (status == WT_OK && file->n_expected > 0)
        status = facts_count(facts, "curves planned", file->n_expected, "indexes", err);
    if (status == WT_OK && file->columns > 0) {
        snprintf(text, sizeof text, "%ld x %ld%s", file->columns, file->rows,
                 file->back_and_forth ? ", back and forth" : "");
        status = facts_add(facts, "grid", text, "", "position-pattern.grid", err);
    }
    if (status == WT_OK && archive_truncated(file->archive))
        status = facts_add(facts, "odd", "the end of the archive is missing", "", "", err);
    return status;
}

static wt_status add_channels(const jpk_segment *segment, size_t number,
                              const wt_read_options *options, wt_table *facts, wt_error *err)
{
    char item[160], value[512];
    force_facts read;
    jpk_segment_facts(segment, &read);
    snprintf(item, sizeof item, "segment %zu", number);
    snprintf(value, sizeof value, "%s (%s), %zu points", wt_segment_kind_name(segment->kind),
             segment->style[0] != '\0' ? segment->style : "no style", segment->n_points);
    wt_status status = facts_add(facts, item, value, "", "segment-header.properties", err);
    if (status == WT_OK && !isnan(segment->duration)) {
        snprintf(item, sizeof item, "segment %zu duration", number);
        status = facts_number(facts, item, segment->duration, "s", "duration", err);
    }
    if (status == WT_OK && !isnan(segment->velocity)) {
        snprintf(item, sizeof item, "segment %zu velocity", number);
        status =
            facts_number(facts, item, segment->velocity, "m/s", "z-start, z-end, duration", err);
    }
    if (status == WT_OK && segment->incomplete) {
        snprintf(item, sizeof item, "segment %zu odd", number);
        status = facts_add(facts, item, "data are missing or short", "", "", err);
    }
    for (size_t i = 0; i < segment->n_channels && status == WT_OK; i++) {
        const jpk_channel *c = &segment->channels[i];
        wt_quantity quantity = force_read_as(&read, options, c);
        const jpk_slot *slot = c->understood ? jpk_lcd_slot(&c->lcd, c->lcd.preferred) : NULL;
        const char *unit = !c->understood ? "" : slot != NULL ? slot->unit : c->lcd.base_unit;
        snprintf(item, sizeof item, "segment %zu channel %s", number, c->name);
        snprintf(value, sizeof value, "%s%s%s",
                 quantity == WT_Q_NONE ? "not read" : wt_quantity_id(quantity),
                 c->understood ? "" : ": ", c->understood ? "" : c->problem);
        status = facts_add(facts, item, value, unit, c->understood ? c->lcd.preferred : "", err);
    }
    return status;
}

static wt_status add_calibration(const jpk_segment *segment, const wt_read_options *options,
                                 wt_table *facts, wt_error *err)
{
    const jpk_channel *deflection = jpk_segment_channel(segment, "vDeflection");
    if (deflection == NULL || !deflection->understood)
        return facts_add(facts, "missing", "no channel vDeflection", "", "", err);
    force_facts read;
    jpk_segment_facts(segment, &read);
    wt_status status = force_describe_calibration(&read.cantilever, options, "conversion to force",
                                                  "conversion to distance", facts, err);
    if (status == WT_OK)
        status = force_describe_missing(&read, options, facts, err);
    return status;
}

/* The segments of the first curve stand for all: a map has the same ones at each place. */
static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, wt_table *facts, wt_error *err)
{
    (void)self;
    jpk_file file = {0};
    jpk_segment *segment = NULL;
    wt_status status = jpk_file_open(input, log, &file, err);
    if (status != WT_OK)
        return status;
    segment = calloc(1, sizeof *segment);
    if (segment == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "no memory to describe the file");
        goto done;
    }
    for (size_t i = 0; i < file.n_refs && file.refs[i].curve == file.refs[0].curve; i++) {
        status = jpk_segment_read(&file, &file.refs[i], segment, err);
        if (status == WT_OK && i == 0)
            status = add_identity(&file, facts, err);
        if (status == WT_OK && i == 0)
            status = add_curves(&file, facts, err);
        if (status == WT_OK && i == 0)
            status = add_calibration(segment, options, facts, err);
        if (status == WT_OK)
            status = add_channels(segment, file.refs[i].segment, options, facts, err);
        if (status != WT_OK)
            goto done;
    }
done:
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
                 "quantitative imaging, pauses, 16-bit and 32-bit data",
             .version = "1"},
    .detect = detect,
    .open_force = jpk_open_force,
    .describe = describe,
};
