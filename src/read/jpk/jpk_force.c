/* JPK curves as a stream: one curve at a time, and of it only the segments and channels asked for.
 *
 * Samples are in the order of time. The time runs on from segment to segment: the first sample of a
 * segment is at the sum of the durations before it, the samples are duration / n apart.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct jpk_source {
    wt_force_source base;
    jpk_file file;
    jpk_segment segment; /* scratch */
    wt_read_options options;
    size_t next; /* refs[next] is the first segment of the next curve */
} jpk_source;

/* The quantities that this format can deliver, in the order of the columns. */
static const wt_quantity quantities[] = {
    WT_Q_TIME,
    WT_Q_HEIGHT,
    WT_Q_FORCE,
    WT_Q_DEFLECTION,
    WT_Q_DEFLECTION_VOLTAGE,
    WT_Q_MEASURED_HEIGHT,
    WT_Q_LATERAL_DEFLECTION,
};
#define N_QUANTITIES (sizeof quantities / sizeof *quantities)

/* One column to make. */
typedef struct output {
    wt_quantity quantity;
    const jpk_channel *channel; /* NULL for the time */
    jpk_linear chain;           /* base value -> SI */
    const char *unit;
} output;

static bool wanted(const wt_read_options *options, wt_quantity quantity)
{
    return (options->want & WT_Q_BIT(quantity)) != 0;
}

/* The file does not give what a column needs: an error if it was asked for by name, a warning if
 * simply everything was. */
static wt_status without(const jpk_source *source, wt_quantity quantity, const char *place,
                         const jpk_calibration *calibration, wt_error *err)
{
    if (quantity != WT_Q_FORCE && quantity != WT_Q_DEFLECTION) {
        wt_parselog_add(source->file.log, WT_WARNING, source->file.name, place,
                        "the channel of %s has no calibration: left out",
                        wt_quantity_title(quantity));
        return WT_OK;
    }
    wt_error missing = WT_ERROR_INIT;
    wt_status status = jpk_uncalibrated(calibration, &missing);
    if (source->options.want == WT_Q_ALL) {
        wt_parselog_add(source->file.log, WT_WARNING, source->file.name, place, "no %s: %s; %s",
                        wt_quantity_id(quantity), missing.message, missing.advice);
        return WT_OK;
    }
    if (err != NULL)
        *err = missing;
    return status;
}

static wt_status plan(jpk_source *source, const char *place, double start,
                      const jpk_calibration *calibration, output outputs[N_QUANTITIES], size_t *n,
                      wt_error *err)
{
    const jpk_segment *segment = &source->segment;
    *n = 0;
    for (size_t i = 0; i < N_QUANTITIES; i++) {
        output o = {.quantity = quantities[i], .unit = "s"};
        if (!wanted(&source->options, o.quantity))
            continue;
        if (o.quantity == WT_Q_TIME) {
            if (!isfinite(start + segment->duration))
                wt_parselog_add(source->file.log, WT_WARNING, source->file.name, place,
                                "no duration: the time is left out");
            else
                outputs[(*n)++] = o;
            continue;
        }
        o.channel = jpk_segment_source(segment, o.quantity);
        if (o.channel == NULL)
            continue;
        if (!o.channel->understood) {
            wt_parselog_add(source->file.log, WT_WARNING, source->file.name, place,
                            "channel %s left out: %s", o.channel->name, o.channel->problem);
            continue;
        }
        if (!o.channel->has_file && o.channel->lcd.encoding != JPK_RASTER) {
            wt_fail(err, WT_E_CORRUPT, "data of channel %s are missing", o.channel->name);
            return WT_E_CORRUPT;
        }
        if (jpk_quantity_chain(&o.channel->lcd, o.quantity, calibration, &o.chain, &o.unit)) {
            outputs[(*n)++] = o;
            continue;
        }
        wt_status status = without(source, o.quantity, place, calibration, err);
        if (status != WT_OK)
            return status;
    }
    return WT_OK;
}

static wt_status fill(jpk_source *source, const output *o, double start, size_t n_points,
                      const char *place, wt_channel *column, const output *loaded, wt_error *err)
{
    const jpk_segment *segment = &source->segment;
    byte_buffer *buffer = &source->file.buffer;
    column->quantity = o->quantity;
    snprintf(column->name, sizeof column->name, "%s",
             o->channel != NULL ? o->channel->name : "time");
    snprintf(column->unit, sizeof column->unit, "%s", o->unit);
    if (o->channel == NULL) {
        for (size_t i = 0; i < n_points; i++)
            column->values[i] = start + segment->duration * ((double)i / (double)n_points);
        return WT_OK;
    }
    const jpk_lcd *lcd = &o->channel->lcd;
    jpk_linear inner = lcd->encoding == JPK_RASTER ? o->channel->raster : lcd->encoder;
    jpk_linear total = {o->chain.multiplier * inner.multiplier,
                        o->chain.multiplier * inner.offset + o->chain.offset};
    bool again = loaded != NULL && loaded->channel == o->channel;
    if (lcd->encoding != JPK_RASTER && !again) {
        size_t size = 0;
        wt_status status = archive_size(source->file.archive, o->channel->entry, &size, err);
        if (status == WT_OK)
            status = archive_read(source->file.archive, o->channel->entry, size, buffer, err);
        if (status != WT_OK)
            return status;
    }
    size_t missing = jpk_decode(lcd->encoding, total, buffer->data, n_points, column->values);
    if (missing > 0)
        wt_parselog_add(source->file.log, WT_WARNING, source->file.name, place,
                        "%zu samples of %s are not numbers", missing, o->channel->name);
    return WT_OK;
}

static wt_status add_segment(jpk_source *source, const jpk_segment_ref *ref, double start,
                             wt_force_curve *curve, wt_error *err)
{
    const jpk_segment *segment = &source->segment;
    output outputs[N_QUANTITIES];
    size_t n = 0;
    jpk_calibration calibration = {
        .cantilever = {.spring_constant = (double)NAN, .sensitivity = (double)NAN}};
    const char *place = archive_name(source->file.archive, ref->entry);
    const jpk_channel *deflection = jpk_segment_channel(segment, "vDeflection");
    if (deflection != NULL && deflection->understood) {
        jpk_calibrate(&deflection->lcd, &source->options, &calibration);
        curve->cantilever = calibration.cantilever;
    }
    if (segment->n_points == 0 && segment->incomplete)
        return wt_fail(err, WT_E_CORRUPT, "data of the segment are missing");
    if (segment->n_points == 0) {
        wt_parselog_add(source->file.log, WT_NOTE, source->file.name, place,
                        "segment without samples left out");
        return WT_OK;
    }
    wt_status status = plan(source, place, start, &calibration, outputs, &n, err);
    if (status != WT_OK)
        return status;
    wt_segment *out = wt_force_curve_add_segment(curve, segment->kind, segment->n_points, n);
    if (out == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a segment of %zu samples",
                       segment->n_points);
    out->index = ref->segment;
    out->duration = segment->duration;
    out->velocity = segment->velocity;
    out->setpoint = calibration.has_force
                        ? segment->setpoint_voltage * calibration.cantilever.sensitivity *
                              calibration.cantilever.spring_constant
                        : (double)NAN;
    const output *loaded = NULL;
    for (size_t i = 0; i < n && status == WT_OK; i++) {
        status = fill(source, &outputs[i], start, segment->n_points, place, &out->channels[i],
                      loaded, err);
        if (outputs[i].channel != NULL)
            loaded = &outputs[i];
    }
    return status;
}

static bool segment_wanted(const wt_read_options *options, wt_segment_kind kind)
{
    return (options->segments & WT_SEGMENT_BIT(kind)) != 0;
}

static wt_status read_curve(jpk_source *source, size_t first, size_t end, wt_force_curve *curve,
                            wt_error *err)
{
    jpk_file *file = &source->file;
    double start = 0;
    for (size_t i = first; i < end; i++) {
        const jpk_segment_ref *ref = &file->refs[i];
        size_t before = curve->n_segments;
        wt_status status = jpk_segment_read(file, ref, &source->segment, err);
        if (status == WT_OK && segment_wanted(&source->options, source->segment.kind))
            status = add_segment(source, ref, start, curve, err);
        if (status == WT_E_CORRUPT && archive_truncated(file->archive) && before > 0) {
            curve->n_segments = before;
            wt_parselog_add(file->log, WT_WARNING, file->name,
                            archive_name(file->archive, ref->entry),
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
    wt_force_curve_reset(curve);
    curve->index = file->refs[first].curve;
    curve->cantilever = (wt_cantilever){.spring_constant = (double)NAN, .sensitivity = (double)NAN};
    jpk_file_position(file, first, curve);
    wt_status status = read_curve(source, first, end, curve, err);
    if (status != WT_OK) {
        wt_force_curve_reset(curve);
        wt_error_file(err, file->name);
    }
    return status;
}

static void close_source(wt_force_source *base)
{
    jpk_source *source = (jpk_source *)base;
    properties_clear(&source->segment.header);
    jpk_file_close(&source->file);
    free(source);
}

wt_status jpk_open_force(const file_reader *self, wt_input *input, const wt_read_options *options,
                         wt_parselog *log, wt_force_source **source, wt_error *err)
{
    (void)self;
    jpk_source *s = calloc(1, sizeof *s);
    if (s == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory to read the file");
    wt_status status = jpk_file_open(input, log, &s->file, err);
    if (status != WT_OK) {
        free(s);
        return status;
    }
    s->base = (wt_force_source){.next = next_curve,
                                .close = close_source,
                                .n_curves = s->file.n_curves,
                                .grid_columns = s->file.columns,
                                .grid_rows = s->file.rows};
    s->options = *options;
    *source = &s->base;
    return WT_OK;
}
