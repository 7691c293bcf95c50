/* Nanosurf .nid: the descriptor, detection, and the facts for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nid/nid.h"
#include "read/facts.h"
#include "read/force_source.h"

#include <math.h>
#include <string.h>

static recognition detect(const file_reader *self, file_peek *peek)
{
    static const char first[] = "[DataSet]";
    (void)self;
    recognition match = {.answer = ANSWER_NO};
    if (peek->length < sizeof first - 1 || memcmp(peek->bytes, first, sizeof first - 1) != 0)
        return match;
    if (memmem(peek->bytes, peek->length, "GroupCount=", 11) == NULL) {
        match.answer = peek->whole ? ANSWER_NO : ANSWER_MORE;
    } else if (memmem(peek->bytes, peek->length, "\n#!", 3) != NULL) {
        match.answer = ANSWER_YES;
        match.score = 95;
    } else if (!peek->whole) {
        match.answer = ANSWER_MORE;
    } else {
        match.answer = ANSWER_UNSUPPORTED;
        snprintf(match.reason, sizeof match.reason,
                 "the header of a Nanosurf file without its data");
    }
    match.need = 4 * peek->length;
    return match;
}

static wt_status add_text(const nid_header *header, const char *item, const char *section,
                          const char *key, wt_table *facts, wt_error *err)
{
    const char *text = nid_get(header, section, key);
    if (text == NULL || *text == '\0')
        return WT_OK;
    return facts_add(facts, item, text, "", key, err);
}

static wt_status add_identity(const nid_file *file, wt_table *facts, wt_error *err)
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
    wt_status status = facts_add(facts, "text encoding", file->header.latin1 ? "Latin-1" : "UTF-8",
                                 "", "the bytes of the header", err);
    for (size_t i = 0; i < sizeof known / sizeof *known && status == WT_OK; i++)
        status = add_text(&file->header, known[i].item, known[i].section, known[i].key, facts, err);
    return status;
}

static wt_status add_channels(const nid_file *file, wt_table *facts, wt_error *err)
{
    char item[128], value[128];
    wt_status status = WT_OK;
    for (size_t i = 0; i < file->n && status == WT_OK; i++) {
        const nid_channel *c = &file->channels[i];
        snprintf(item, sizeof item, "%s: %s", c->group_name, c->name);
        snprintf(value, sizeof value, "%zu x %zu %s, %u bits", c->points, c->lines,
                 nid_is_spectroscopy(c) ? "samples x curves" : "points x lines", c->bits);
        status = facts_add(facts, item, value, c->unit, c->section, err);
    }
    return status;
}

static wt_status add_curves(const nid_spectroscopy *s, const wt_read_options *options,
                            wt_table *facts, wt_error *err)
{
    char item[64], value[128];
    wt_status status = facts_count(facts, "curves", s->n_curves, "Lines", err);
    if (status == WT_OK && s->columns > 0) {
        snprintf(value, sizeof value, "%ld x %ld, back and forth", s->columns, s->rows);
        status = facts_add(facts, "grid", value, "", "SpecMapTable", err);
    }
    for (size_t p = 0; p < NID_PHASES && status == WT_OK; p++) {
        const nid_phase *phase = &s->phases[p];
        if (phase->z == NULL && phase->sensor == NULL && phase->bending == NULL)
            continue;
        snprintf(item, sizeof item, "segment %zu", p);
        snprintf(value, sizeof value, "%s (%s), up to %zu points",
                 wt_segment_kind_name(phase->kind), phase->group,
                 phase->bending != NULL  ? phase->bending->points
                 : phase->sensor != NULL ? phase->sensor->points
                                         : phase->z->points);
        status = facts_add(facts, item, value, "", "", err);
        if (status == WT_OK && phase->bending == NULL)
            status = facts_add(facts, "missing", "no channel Deflection in m, N or V", "",
                               phase->group, err);
        if (status == WT_OK && phase->z == NULL && phase->sensor == NULL)
            status = facts_add(facts, "missing", "no channel Z-Axis or Z-Axis Sensor in m", "",
                               phase->group, err);
    }
    if (status == WT_OK)
        status = force_describe_calibration(
            &s->file_cantilever, options, "Calibration\\Cantilever, Prop0",
            "Calibration\\Scanhead, TipSignalDC / TipSignalDC1", facts, err);
    if (status == WT_OK)
        status = facts_add(facts, "odd",
                           "force curves of this format were not verified on a genuine file", "",
                           "", err);
    return status;
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, wt_table *facts, wt_error *err)
{
    (void)self;
    (void)log;
    nid_file file = {0};
    nid_spectroscopy spectroscopy;
    wt_status status = nid_file_open(input, &file, err);
    if (status != WT_OK)
        return status;
    status = add_identity(&file, facts, err);
    if (status == WT_OK)
        status = add_channels(&file, facts, err);
    if (status == WT_OK && nid_spectroscopy_find(&file, &spectroscopy, NULL) == WT_OK)
        status = add_curves(&spectroscopy, options, facts, err);
    nid_file_close(&file);
    return status;
}

const file_reader reader_nid = {
    .info = {.id = "nid",
             .title = "Nanosurf images, spectra and force curves (.nid)",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE,
             .verified = true,
             .evidence =
                 "images and spectra: measured files of software 1.7 to 3.10; force curves: "
                 "not verified on a genuine file",
             .version = "1"},
    .detect = detect,
    .open_force = nid_open_force,
    .read_images = nid_read_images,
    .describe = describe,
};
