/* Reads Nanosurf .nid files: descriptor, detection, and the metadata for `info`.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/nid/nid.h"
#include "core/base/number.h"
#include "core/table/registry.h"
#include "read/bytes/samples.h"
#include "read/header_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define SPECTROSCOPY "DataSet\\Parameters\\Spectroscopy"

#define CANTILEVER "DataSet\\Calibration\\Cantilever"

#define SCANHEAD "DataSet\\Calibration\\Scanhead"

/* Names of the phases in the header, in temporal order. */
static const struct {
    wt_segment_kind kind;
    const char *group, *time, *points, *range;
} phase_names[NID_PHASES] = {
    {WT_SEGMENT_APPROACH, "Spec forward", "FwModTime", "FwModDatapoints", "FwModRange"},
    {WT_SEGMENT_DWELL, "Spec fwd pause", "FwPauseTime", "FwPauseDatapoints", NULL},
    {WT_SEGMENT_RETRACT, "Spec backward", "BwModTime", "BwModDatapoints", "BwModRange"},
    {WT_SEGMENT_DWELL, "Spec bwd pause", "BwPauseTime", "BwPauseDatapoints", NULL},
};

/* ---- header ---------------------------------------------------------------------------------- */

/* Returns the full scale of the input with this name, as in
 * "In5=5,TipSignalDC,Deflection,m,1.393e-06,0". */
static double input_full_scale(const nid_header *header, const char *name, wt_quantity quantity)
{
    char key[32], item[NID_TEXT], unit[NID_TEXT];
    size_t n = 0;
    if (!nid_integer(header, SCANHEAD, "InCount", 1000, &n))
        return (double)NAN;
    for (size_t i = 0; i < n; i++) {
        double factor = 1, offset = 0;
        snprintf(key, sizeof key, "In%zu", i);
        const char *list = nid_get(header, SCANHEAD, key);
        if (list == NULL || !nid_list_item(list, ',', 1, item, sizeof item) ||
            strcmp(item, name) != 0)
            continue;
        if (nid_list_item(list, ',', 3, unit, sizeof unit) &&
            nid_list_item(list, ',', 4, item, sizeof item) &&
            wt_unit_to_si(unit, quantity, &factor, &offset, NULL) == WT_OK)
            return factor * parse_number_or_nan(item);
        return (double)NAN;
    }
    return (double)NAN;
}

static void read_phase(const nid_header *header, size_t i, nid_phase *phase)
{
    double time = nid_quantity(header, SPECTROSCOPY, phase_names[i].time, WT_Q_TIME);
    const char *points = nid_get(header, SPECTROSCOPY, phase_names[i].points);
    double n = (double)NAN;
    /* a number without a unit, as in "L[1024]*[]" */
    if (points != NULL && strncmp(points, "L[", 2) == 0 &&
        !wt_number_parse(points + 2, strcspn(points + 2, "]"), '.', &n))
        n = (double)NAN;
    phase->group = phase_names[i].group;
    phase->interval = force_positive_or_nan(time / n);
    phase->metadata =
        (force_metadata){.kind = phase_names[i].kind,
                         .index = i,
                         .place = SPECTROSCOPY,
                         .velocity = (double)NAN,
                         .setpoint = (double)NAN,
                         .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE,
                                    WT_Q_DEFLECTION, WT_Q_DEFLECTION_VOLTAGE},
                         .n_offers = 6};
    if (phase_names[i].range != NULL)
        phase->metadata.velocity = force_positive_or_nan(
            fabs(nid_quantity(header, SPECTROSCOPY, phase_names[i].range, WT_Q_LENGTH)) / time);
}

/* Adds the signal of a channel. The first channel of a quantity counts. The unit decides the
 * quantity of a deflection. */
static void add_channel_signal(const nid_channel *c, force_metadata *metadata)
{
    static const struct {
        const char *name;
        size_t length; /* number of characters that must agree */
        wt_quantity quantity;
    } known[] = {
        {"Deflection", 11, WT_Q_FORCE},
        {"Deflection", 11, WT_Q_DEFLECTION},
        {"Deflection", 11, WT_Q_DEFLECTION_VOLTAGE},
        {"Z-Axis Sensor", 14, WT_Q_MEASURED_HEIGHT},
        {"Z-Axis", 6, WT_Q_HEIGHT},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        force_signal signal = {
            .quantity = known[i].quantity, .name = c->name, .unit = c->unit, .channel = c};
        if (strncmp(c->name, known[i].name, known[i].length) != 0 ||
            wt_unit_to_si(c->unit, signal.quantity, &signal.to_si.multiplier, &signal.to_si.offset,
                          NULL) != WT_OK)
            continue;
        force_add_signal(metadata, signal);
        return;
    }
}

/* Finds the force curves. WT_E_EMPTY if there are none. */
static wt_status nid_find_spectroscopy(const nid_file *file, nid_spectroscopy *s, wt_error *err)
{
    *s = (nid_spectroscopy){
        .cantilever = {
            .spring_constant = force_positive_or_nan(
                nid_quantity(&file->header, CANTILEVER, "Prop0", WT_Q_SPRING_CONSTANT)),
            .sensitivity = force_positive_or_nan(
                input_full_scale(&file->header, "TipSignalDC", WT_Q_DEFLECTION) /
                input_full_scale(&file->header, "TipSignalDC1", WT_Q_DEFLECTION_VOLTAGE))}};
    for (size_t p = 0; p < NID_PHASES; p++) {
        nid_phase *phase = &s->phases[p];
        read_phase(&file->header, p, phase);
        phase->metadata.cantilever = s->cantilever;
        for (size_t i = 0; i < file->n; i++)
            if (strcasecmp(file->channels[i].group_name, phase->group) == 0)
                add_channel_signal(&file->channels[i], &phase->metadata);
        for (size_t i = 0; i < phase->metadata.n_signals; i++) {
            const nid_channel *c = phase->metadata.signals[i].channel;
            s->n_curves = c->lines > s->n_curves ? c->lines : s->n_curves;
        }
    }
    if (s->n_curves == 0) {
        wt_fail(err, WT_E_EMPTY, "the file holds no force curve");
        wt_error_expected(err, "groups \"Spec forward\" with Deflection and Z-Axis");
        wt_error_found(err, "group \"%s\"", file->channels[0].group_name);
        return WT_E_EMPTY;
    }
    nid_read_grid(&file->header, &s->columns, &s->rows);
    return WT_OK;
}

/* ---- curves ------------------------------------------------------------------------------- */

typedef struct nid_source {
    wt_force_source base;
    nid_file file;
    nid_spectroscopy spectroscopy;
    size_t line; /* line of the current or next curve */
} nid_source;

static wt_status read_line_length(const nid_file *file, const nid_channel *c, size_t line,
                                  size_t *n, wt_error *err)
{
    char key[48];
    *n = c->points;
    if (line >= c->lines)
        *n = 0;
    if (c->version < 3 || *n == 0)
        return WT_OK;
    snprintf(key, sizeof key, "LineDim%zuPoints", line);
    const bool known = nid_line_length(&file->header, c->section, line, n);
    if (known && *n <= c->points)
        return WT_OK;
    wt_fail(err, WT_E_CORRUPT, "length of a line is missing or not understood");
    wt_error_place(err, "[%s] %s", c->section, key);
    wt_error_expected(err, "an integer up to %zu", c->points);
    const char *found = nid_get(&file->header, c->section, key);
    if (known)
        wt_error_found(err, "%zu", *n);
    else
        wt_error_found(err, "%s", found != NULL ? found : "nothing");
    return WT_E_CORRUPT;
}

/* Finds the number of samples that all channels of a phase have; they are recorded together. */
static wt_status find_phase_length(const nid_source *source, const force_metadata *metadata,
                                   size_t *n, wt_error *err)
{
    *n = SIZE_MAX;
    for (size_t i = 0; i < metadata->n_signals; i++) {
        const nid_channel *c = metadata->signals[i].channel;
        size_t line_points = 0;
        wt_status status = read_line_length(&source->file, c, source->line, &line_points, err);
        if (status != WT_OK)
            return status;
        if (*n != SIZE_MAX && line_points != *n)
            wt_log_add(source->base.log, WT_LOSS, source->file.name, c->section,
                       "channels are of different length; cut to the shortest");
        *n = line_points < *n ? line_points : *n;
    }
    if (*n == SIZE_MAX)
        *n = 0;
    return WT_OK;
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const nid_source *source = (const nid_source *)base;
    /* these units have no offset */
    return nid_decode(&source->file, signal->channel, source->line, n, scaling.multiplier, values,
                      err);
}

/* Adds a phase of the curve and moves *start to its end; NaN after a phase of unknown duration. */
static wt_status add_phase(nid_source *source, const nid_phase *phase, double *start,
                           wt_force_curve *curve, wt_error *err)
{
    force_metadata metadata = phase->metadata;
    wt_status status = find_phase_length(source, &metadata, &metadata.n_points, err);
    if (status != WT_OK || metadata.n_points == 0) /* an absent phase takes no time */
        return status;
    metadata.start = *start;
    metadata.duration = (double)metadata.n_points * phase->interval;
    *start += metadata.duration;
    return force_is_segment_requested(&source->base, metadata.kind)
               ? force_add_segment(&source->base, &metadata, curve, err)
               : WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    nid_source *source = (nid_source *)base;
    double start = 0;
    wt_status status = WT_OK;
    if (source->line == source->spectroscopy.n_curves)
        return WT_END;
    curve->index = source->line;
    nid_set_position(&source->file.header, source->line, base->name, base->log, curve);
    for (size_t p = 0; p < NID_PHASES && status == WT_OK; p++)
        status = add_phase(source, &source->spectroscopy.phases[p], &start, curve, err);
    source->line++;
    return status;
}

static void seek(wt_force_source *base, size_t index)
{
    ((nid_source *)base)->line = index;
}

static void close_source(wt_force_source *base)
{
    nid_file_close(&((nid_source *)base)->file);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    nid_source *source = (nid_source *)base;
    (void)self;
    wt_status status = nid_file_open(input, &source->file, err);
    if (status == WT_OK)
        status = nid_find_spectroscopy(&source->file, &source->spectroscopy, err);
    if (status != WT_OK)
        return status;
    wt_log_add(base->log, WT_NOTE, base->name, NULL,
               "force curves of this format were not verified on a genuine file: compare one "
               "with the instrument's own software");
    base->n_curves = source->spectroscopy.n_curves;
    base->grid_columns = source->spectroscopy.columns;
    base->grid_rows = source->spectroscopy.rows;
    return WT_OK;
}

static const force_stream nid_force = {.size = sizeof(nid_source),
                                       .open = open_source,
                                       .next = next_curve,
                                       .decode = decode,
                                       .seek = seek,
                                       .close = close_source};

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
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        metadata_add_text(metadata, known[i].item, known[i].key,
                          nid_get(&file->header, known[i].section, known[i].key));
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
        metadata_add(metadata, fact_item_text(FACT_MISSING), "", phase->group,
                     "no channel Deflection in m, N or V");
    if (force_find_signal(read, WT_Q_HEIGHT) == NULL &&
        force_find_signal(read, WT_Q_MEASURED_HEIGHT) == NULL)
        metadata_add(metadata, fact_item_text(FACT_MISSING), "", phase->group,
                     "no channel Z-Axis or Z-Axis Sensor in m");
}

static void add_curves(const nid_spectroscopy *s, const wt_read_options *options,
                       table_writer *metadata)
{
    const force_metadata read = {.cantilever = s->cantilever};
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "Lines", "%zu", s->n_curves);
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
    if (nid_find_spectroscopy(&file, &spectroscopy, NULL) == WT_OK)
        add_curves(&spectroscopy, options, metadata);
    nid_file_close(&file);
    return WT_OK;
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
    .force = &nid_force,
    .read_images = nid_read_images,
    .describe = describe,
};
