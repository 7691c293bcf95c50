/* Reads Igor binary waves: descriptor, detection, metadata and curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/ibw/ibw.h"

#include "core/table/registry.h"
#include "read/header_values.h"
#include "read/images.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static recognition detect(const file_reader *self, file_peek *peek)
{
    recognition match = {.answer = ANSWER_NO};
    bool big_endian = false;
    (void)self;
    if (ibw_is_wave(peek->bytes, peek->length, &big_endian)) {
        match.answer = ANSWER_YES;
        match.score = 90;
    } else if (peek->whole && ibw_is_version_2(peek->bytes, peek->length)) {
        match.answer = ANSWER_UNSUPPORTED;
        snprintf(
            match.reason, sizeof match.reason,
            "an Igor wave of version 2 holds one row of numbers and no force curve: export the "
            "curve as text, with height and deflection");
    }
    return match;
}

/* ---- metadata -------------------------------------------------------------------------------- */

static void add_setpoint(const ibw_file *file, force_metadata *metadata)
{
    static const struct {
        const char *channel;
        wt_quantity quantity;
    } known[] = {{"Force", WT_Q_FORCE},
                 {"Deflection", WT_Q_DEFLECTION},
                 {"DeflVolts", WT_Q_DEFLECTION_VOLTAGE}};
    char channel[IBW_TEXT];
    if (!ibw_note_text(file, "TriggerChannel", channel))
        return;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(channel, known[i].channel) == 0) {
            metadata->setpoint = ibw_note_number(file, "TriggerPoint");
            metadata->setpoint_quantity = known[i].quantity;
        }
}

/* Returns the metadata of the curve. Heights in the file increase towards the sample; the signal is
 * negated. The deflection is in metres, computed with the sensitivity of the note. The velocities
 * of the note are settings, used or not, so none is read. */
force_metadata ibw_metadata(const ibw_file *file, wt_log *log)
{
    static const struct {
        const char *name;
        wt_quantity quantity;
        double multiplier;
    } known[] = {{"ZSnsr", WT_Q_MEASURED_HEIGHT, -1},
                 {"Raw", WT_Q_HEIGHT, -1},
                 {"Defl", WT_Q_DEFLECTION, 1}};
    force_metadata metadata = {
        .velocity = (double)NAN,
        .setpoint = (double)NAN,
        .cantilever = {.spring_constant =
                           ibw_note_calibration(file, "SpringConstant", WT_Q_SPRING_CONSTANT, log),
                       .sensitivity = ibw_note_calibration(file, "InvOLS", WT_Q_SENSITIVITY, log)},
        .offers = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT, WT_Q_FORCE, WT_Q_DEFLECTION,
                   WT_Q_DEFLECTION_VOLTAGE},
        .n_offers = 6};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        for (size_t c = 0; c < file->n_channels; c++)
            if (strcasecmp(file->channels[c].name, known[i].name) == 0)
                force_add_signal(&metadata, (force_signal){.quantity = known[i].quantity,
                                                           .name = file->channels[c].name,
                                                           .unit = "m",
                                                           .to_si = {known[i].multiplier, 0},
                                                           .channel = &file->channels[c]});
    add_setpoint(file, &metadata);
    return metadata;
}

void ibw_describe_channels(const ibw_file *file, const force_metadata *read,
                           const wt_read_options *options, table_writer *metadata)
{
    for (size_t i = 0; i < file->n_channels; i++) {
        const wt_quantity q = force_channel_quantity(read, options, &file->channels[i]);
        char samples[32] = ""; /* of a wave, not of a map */
        if (file->n > 0)
            snprintf(samples, sizeof samples, "%zu samples%s", file->n, q != WT_Q_NONE ? ", " : "");
        if (file->n > 0 || q != WT_Q_NONE)
            metadata_add(metadata, file->channels[i].name, "m", "label", "%s%s", samples,
                         q != WT_Q_NONE ? wt_quantity_id(q) : "");
    }
    force_describe_calibration(read, options, "note, SpringConstant", "note, InvOLS", metadata);
}

static wt_status describe_curves(wt_input *input, const wt_read_options *options, wt_log *log,
                                 table_writer *metadata, wt_error *err)
{
    ibw_file file;
    ibw_segment segments[IBW_SEGMENTS];
    size_t n = 0;
    char text[IBW_TEXT];
    static const char *const keys[] = {"ImagingMode", "Date", "Time", "TriggerChannel"};
    wt_status status = ibw_open(input, &file, NULL, err);
    if (status == WT_OK)
        status = ibw_read_segments(&file, segments, &n, err);
    if (status != WT_OK)
        return status;
    const force_metadata read = ibw_metadata(&file, log);
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", "one for each file", "1");
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (ibw_note_text(&file, keys[i], text))
            metadata_add(metadata, keys[i], "", "note", "%s", text);
    for (size_t i = 0; i < n; i++) {
        char item[32];
        snprintf(item, sizeof item, "segment %zu", i);
        metadata_add(metadata, item, "", "Indexes, Direction or turning point", "%s, %zu points",
                     wt_segment_kind_name(segments[i].kind), segments[i].n);
    }
    ibw_describe_channels(&file, &read, options, metadata);
    return WT_OK;
}

/* ---- curves ---------------------------------------------------------------------------------- */

typedef struct ibw_source {
    wt_force_source base;
    ibw_file file;
    force_metadata metadata;
    ibw_segment segments[IBW_SEGMENTS];
    size_t n_segments;
    size_t from; /* first sample of the current segment */
    bool done;
} ibw_source;

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const ibw_source *source = (const ibw_source *)base;
    const ibw_file *file = &source->file;
    const ibw_channel *channel = signal->channel;
    const size_t width = sample_width(file->type);
    (void)err;
    samples_decode(file->type, file->big_endian,
                   file->bytes + file->data + width * (channel->number * file->n + source->from), n,
                   scaling.multiplier, scaling.offset, values);
    return WT_OK;
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    ibw_source *source = (ibw_source *)base;
    wt_status status = WT_OK;
    if (source->done)
        return WT_END;
    source->done = true;
    curve->x = ibw_note_number(&source->file, "XLVDT");
    curve->y = ibw_note_number(&source->file, "YLVDT");
    for (size_t i = 0; i < source->n_segments && status == WT_OK; i++) {
        const ibw_segment *segment = &source->segments[i];
        force_metadata metadata = source->metadata;
        metadata.kind = segment->kind;
        metadata.index = i;
        metadata.n_points = segment->n;
        metadata.start = source->file.interval * (double)segment->from;
        metadata.duration = source->file.interval * (double)segment->n;
        source->from = segment->from;
        if (force_is_segment_requested(base, segment->kind))
            status = force_add_segment(base, &metadata, curve, err);
    }
    return status;
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    ibw_source *source = (ibw_source *)base;
    (void)self;
    wt_status status = ibw_open(input, &source->file, NULL, err);
    if (status == WT_OK)
        status = ibw_read_segments(&source->file, source->segments, &source->n_segments, err);
    source->metadata = ibw_metadata(
        &source->file, source->base.log); /* has pointers to the channels of this file */
    base->n_curves = 1;
    return status;
}

static const force_stream ibw_force = {
    .size = sizeof(ibw_source), .open = open_source, .next = next_curve, .decode = decode};

/* ---- images ---------------------------------------------------------------------------------- */

/* Returns the unit of a channel by its name, such as "HeightRetrace" or "ZSensorTrace", since the
 * wave states none. */
static const char *channel_unit(const char *name)
{
    static const struct {
        const char *begin, *unit;
    } known[] = {{"Height", "m"},
                 {"ZSensor", "m"},
                 {"Deflection", "m"},
                 {"Amplitude", "m"},
                 {"Phase", "deg"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strncmp(name, known[i].begin, strlen(known[i].begin)) == 0)
            return known[i].unit;
    return "1";
}

static wt_status ibw_images(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_image **images,
                            size_t *n_images, wt_error *err)
{
    ibw_file file;
    ibw_grid grid;
    image_list list = {NULL, 0};
    (void)self;
    (void)options;
    wt_status status = ibw_open(input, &file, &grid, err);
    for (size_t c = 0; status == WT_OK && c < file.n_channels; c++) {
        double *values = NULL;
        wt_image head = {.n_columns = grid.n_columns,
                         .n_rows = grid.n_rows,
                         .width = grid.step_x * (double)(grid.n_columns - 1),
                         .height = grid.step_y * (double)(grid.n_rows - 1),
                         .x_min = grid.x_min,
                         .y_min = grid.y_min,
                         .x_unit = "m"};
        snprintf(head.name, sizeof head.name, "%s", file.channels[c].name);
        snprintf(head.unit, sizeof head.unit, "%s", channel_unit(head.name));
        status = images_add(&list, &head, &values, err);
        if (status != WT_OK)
            break;
        samples_decode(file.type, file.big_endian,
                       file.bytes + file.data + sample_width(file.type) * c * file.n, file.n, 1, 0,
                       values);
    }
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

const file_reader reader_ibw = {
    .info = {.id = "ibw",
             .title = "Igor binary waves of Asylum Research (.ibw), single force curves and images",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE,
             .verified = true,
             .evidence =
                 "a measured curve of an MFP-3D, approach and retract; images: not verified on "
                 "a genuine file",
             .version = "1"},
    .detect = detect,
    .force = &ibw_force,
    .read_images = ibw_images,
    .describe_curves = describe_curves,
    .describe = images_describe,
};
