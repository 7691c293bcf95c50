/* Delivers JPK curves one by one, with the requested segments and channels.
 *
 * Samples are in temporal order, and the time continues from segment to segment.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

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

const force_stream jpk_force = {.size = sizeof(jpk_source),
                                .open = open_source,
                                .next = next_curve,
                                .decode = decode,
                                .seek = seek_curve,
                                .close = close_source};
