/* Reads Nanosurf .nid files: descriptor, detection, and the metadata for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nid/nid.h"
#include "read/metadata.h"

#include <math.h>
#include <string.h>

/* Maximum part of the header that the detection examines; the reader checks the rest [byte]. */
#define HEADER_PEEK_MAX ((size_t)1 << 18)

static recognition detect(const file_reader *self, file_peek *peek)
{
    static const char first[] = "[DataSet]";
    (void)self;
    recognition match = {.answer = ANSWER_NO};
    if (peek->length < sizeof first - 1 || memcmp(peek->bytes, first, sizeof first - 1) != 0)
        return match;
    if (memmem(peek->bytes, peek->length, "GroupCount=", 11) == NULL) {
        match.answer = peek->whole || peek->length >= HEADER_PEEK_MAX ? ANSWER_NO : ANSWER_MORE;
    } else if (memmem(peek->bytes, peek->length, "\n#!", 3) != NULL) {
        match.answer = ANSWER_YES;
        match.score = 95;
    } else if (!peek->whole && peek->length < HEADER_PEEK_MAX) {
        match.answer = ANSWER_MORE;
    } else if (!peek->whole) {
        match.answer = ANSWER_YES;
        match.score = 95;
    } else {
        match.answer = ANSWER_UNSUPPORTED;
        snprintf(match.reason, sizeof match.reason,
                 "the header of a Nanosurf file without its data");
    }
    match.need = 4 * peek->length;
    return match;
}

static void add_identity(const nid_file *file, table_writer *metadata)
{
    static const struct {
        const char *item, *section, *key;
    } known[] = {{"format version", "DataSet", "Version"},
                 {"instrument", "DataSet-Info", "Head type"},
                 {"controller", "DataSet-Info", "Controller S/N"},
                 {"software", "DataSet-Info", "Software ver."},
                 {"operating mode", "DataSet-Info", "Op. mode"},
                 {"cantilever", "DataSet-Info", "Cantilever type"},
                 {"date (day-month-year)", "DataSet-Info", "Date"},
                 {"time", "DataSet-Info", "Time"}};
    metadata_add(metadata, "text encoding", "", "the bytes of the header", "%s",
                 file->header.latin1 ? "Latin-1" : "UTF-8");
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const char *text = nid_get(&file->header, known[i].section, known[i].key);
        if (text != NULL && *text != '\0')
            metadata_add(metadata, known[i].item, "", known[i].key, "%s", text);
    }
}

static void add_channels(const nid_file *file, table_writer *metadata)
{
    char item[128];
    for (size_t i = 0; i < file->n; i++) {
        const nid_channel *c = &file->channels[i];
        snprintf(item, sizeof item, "%s: %s", c->group_name, c->name);
        metadata_add(metadata, item, c->unit, c->section, "%zu x %zu %s, %u bits", c->points,
                     c->lines, nid_is_spectroscopy(c) ? "samples x curves" : "points x lines",
                     c->bits);
    }
}

static void describe_tune(const nid_file *file, table_writer *metadata)
{
    static const struct {
        const char *item, *key;
    } known[] = {{"temperature of the lever (degree Celsius)", "Cantilever temperature"},
                 {"averages", "Averages"},
                 {"resonance", "Frequency:"},
                 {"quality factor", "Q Factor:"},
                 {"spring constant", "Spring Constant:"}};
    const nid_channel *c = nid_find_tune(file);
    if (c == NULL)
        return;
    metadata_add(metadata, "thermal noise", "", c->section, "%zu points up to %s Hz", c->points,
                 nid_get(&file->header, c->section, "Dim0Range"));
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const char *text = nid_get(&file->header, "DataSet-Info", known[i].key);
        if (text != NULL && *text != '\0')
            metadata_add(metadata, known[i].item, "", known[i].key, "%s", text);
    }
}

static void describe_phase(const nid_phase *phase, table_writer *metadata)
{
    const force_metadata *read = &phase->metadata;
    char item[64];
    if (read->n_signals == 0)
        return;
    snprintf(item, sizeof item, "segment %zu", read->index);
    metadata_add(metadata, item, "", "", "%s (%s), up to %zu points",
                 wt_segment_kind_name(read->kind), phase->group,
                 ((const nid_channel *)read->signals[0].channel)->points);
    if (force_find_signal(read, WT_Q_FORCE) == NULL &&
        force_find_signal(read, WT_Q_DEFLECTION) == NULL &&
        force_find_signal(read, WT_Q_DEFLECTION_VOLTAGE) == NULL)
        metadata_add(metadata, "missing", "", phase->group, "no channel Deflection in m, N or V");
    if (force_find_signal(read, WT_Q_HEIGHT) == NULL &&
        force_find_signal(read, WT_Q_MEASURED_HEIGHT) == NULL)
        metadata_add(metadata, "missing", "", phase->group,
                     "no channel Z-Axis or Z-Axis Sensor in m");
}

static void add_curves(const nid_spectroscopy *s, const wt_read_options *options,
                       table_writer *metadata)
{
    const force_metadata read = {.cantilever = s->cantilever};
    metadata_add(metadata, "curves", "", "Lines", "%zu", s->n_curves);
    if (s->columns > 0)
        metadata_add(metadata, "grid", "", "SpecMapTable", "%ld x %ld, back and forth", s->columns,
                     s->rows);
    for (size_t p = 0; p < NID_PHASES; p++)
        describe_phase(&s->phases[p], metadata);
    force_describe_calibration(&read, options, "Calibration\\Cantilever, Prop0",
                               "Calibration\\Scanhead, TipSignalDC / TipSignalDC1", metadata);
    metadata_add(metadata, "odd", "", "",
                 "force curves of this format were not verified on a genuine file");
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    (void)self;
    (void)log;
    nid_file file = {0};
    nid_spectroscopy spectroscopy;
    wt_status status = nid_file_open(input, &file, metadata->err);
    if (status != WT_OK)
        return status;
    add_identity(&file, metadata);
    add_channels(&file, metadata);
    describe_tune(&file, metadata);
    if (nid_find_spectroscopy(&file, &spectroscopy, NULL) == WT_OK)
        add_curves(&spectroscopy, options, metadata);
    nid_file_close(&file);
    return WT_OK;
}

const file_reader reader_nid = {
    .info = {.id = "nid",
             .title = "Nanosurf images, spectra and force curves (.nid)",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE | WT_KIND_NOISE,
             .verified = true,
             .evidence =
                 "images and spectra: measured files of software 1.7 to 3.10; force curves: "
                 "not verified on a genuine file",
             .version = "1"},
    .detect = detect,
    .force = &nid_force,
    .read_images = nid_read_images,
    .read_noise = nid_read_noise,
    .describe = describe,
};
