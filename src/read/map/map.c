/* Reads maps of force curves in HDF5 files of this program, weartrack-hdf5(5), which `weartrack
 * convert` writes. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/force_map.h"
#include "core/store/store.h"
#include "core/table/registry.h"
#include "read/bytes/input.h"
#include "read/force_assembler.h"
#include "read/reader.h"

#include <math.h>
#include <string.h>

typedef struct map_source {
    wt_force_source base;
    map_reader *map;
    const map_segment *segment; /* current segment */
    const map_channel *channels;
    size_t n_channels;
} map_source;

/* The first attribute of the root follows the signature. Its name includes the terminating zero; a
 * file name within the stored command has none. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(
        PEEK_BEGINS(peek, HDF5_SIGNATURE) && PEEK_CONTAINS(peek, STORE_MAP_ATTRIBUTE "\0"), 95);
}

static wt_status open_map(wt_input *input, map_reader **map, wt_error *err)
{
    wt_result *result = NULL;
    hdf5_bytes from;
    wt_status status = input_hdf5_bytes(input, &from, err);
    if (status == WT_OK)
        status = store_read_bytes(&from, store_extract, wt_input_name(input), &result, err);
    return status == WT_OK ? map_open(&from, result, map, err) : status;
}

/* ---- curves ------------------------------------------------------------------------------- */

static const double *segment_values(const map_source *source, wt_quantity quantity)
{
    size_t k = 0;
    while (source->channels[k].quantity != quantity)
        k++;
    return source->segment->values + k * source->segment->n_points;
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const double *const from = segment_values((const map_source *)base, signal->quantity);
    (void)err;
    for (size_t i = 0; i < n; i++)
        values[i] = scaling.multiplier * from[i] + scaling.offset;
    return WT_OK;
}

/* Returns the first channel with this name. Quantities computed from one channel share its name. */
static const void *signal_channel(const map_source *source, size_t k)
{
    size_t first = 0;
    while (strcmp(source->channels[first].name, source->channels[k].name) != 0)
        first++;
    return &source->channels[first];
}

static void collect_metadata(const map_source *source, const map_segment *s,
                             const wt_cantilever *cantilever, force_metadata *metadata)
{
    *metadata = (force_metadata){.kind = s->kind,
                                 .index = s->index,
                                 .n_points = s->n_points,
                                 .start = (double)NAN,
                                 .duration = s->duration,
                                 .velocity = s->velocity,
                                 .setpoint = s->setpoint,
                                 .setpoint_quantity = WT_Q_FORCE,
                                 .cantilever = *cantilever};
    for (size_t k = 0; k < source->n_channels; k++) {
        const map_channel *const c = &source->channels[k];
        force_signal signal = {.quantity = c->quantity,
                               .name = c->name,
                               .unit = c->unit,
                               .to_si = {1, 0},
                               .channel = signal_channel(source, k)};
        if (!map_channel_has_samples(s->values + k * s->n_points, s->n_points))
            continue;
        force_add_signal(metadata, signal);
        force_add_offer(metadata, c->quantity);
    }
    if (force_find_signal(metadata, WT_Q_DEFLECTION) != NULL ||
        force_find_signal(metadata, WT_Q_DEFLECTION_VOLTAGE) != NULL)
        force_add_offer(metadata, WT_Q_FORCE);
}

static wt_status next_curve(wt_force_source *base, wt_force_curve *curve, wt_error *err)
{
    map_source *const source = (map_source *)base;
    const map_segment *segments = NULL;
    size_t n = 0;
    wt_status status = map_next_curve(source->map, curve, &segments, &n, err);
    const wt_cantilever cantilever = curve->cantilever;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        force_metadata metadata;
        source->segment = &segments[i];
        collect_metadata(source, &segments[i], &cantilever, &metadata);
        if (force_is_segment_requested(base, metadata.kind))
            status = force_add_segment(base, &metadata, curve, err);
    }
    return status;
}

static void close_source(wt_force_source *base)
{
    map_close(((map_source *)base)->map);
}

static wt_status open_source(wt_force_source *base, const file_reader *self, wt_input *input,
                             wt_error *err)
{
    map_source *const source = (map_source *)base;
    (void)self;
    const wt_status status = open_map(input, &source->map, err);
    if (status == WT_OK) {
        base->n_curves = map_n_curves(source->map);
        source->n_channels = map_channels(source->map, &source->channels);
    }
    return status;
}

static const force_stream map_force = {.size = sizeof(map_source),
                                       .open = open_source,
                                       .next = next_curve,
                                       .decode = decode,
                                       .close = close_source};

/* ---- metadata -------------------------------------------------------------------------------- */

/* Describes the file; the first curve represents all. */
static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    map_source source = {.base = {.options = *options}};
    const map_segment *segments = NULL;
    wt_force_curve curve = {.n_segments = 0};
    size_t n = 0;
    (void)self;
    (void)log;
    wt_status status = open_map(input, &source.map, metadata->err);
    if (status != WT_OK)
        return status;
    source.n_channels = map_channels(source.map, &source.channels);
    metadata_add(metadata, fact_item_text(FACT_CURVES), "", MAP_SAMPLES_GROUP, "%zu",
                 map_n_curves(source.map));
    wt_force_curve_reset(&curve);
    status = map_next_curve(source.map, &curve, &segments, &n, metadata->err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        force_metadata read;
        char item[160];
        const map_segment *const s = &segments[i];
        collect_metadata(&source, s, &curve.cantilever, &read);
        if (i == 0)
            force_describe_calibration(&read, options, "force_map/curves", "force_map/curves",
                                       metadata);
        snprintf(item, sizeof item, "segment %zu", s->index);
        metadata_add(metadata, item, "", "force_map/segments", "%s, %zu points",
                     wt_segment_kind_name(s->kind), s->n_points);
        for (size_t k = 0; k < read.n_signals; k++) {
            const force_signal *const signal = &read.signals[k];
            snprintf(item, sizeof item, "segment %zu channel %s", s->index, signal->name);
            metadata_add(metadata, item, wt_quantity_unit(signal->quantity), signal->name, "%s",
                         wt_quantity_id(signal->quantity));
        }
    }
    map_close(source.map);
    return status == WT_END ? WT_OK : status;
}

const file_reader reader_map = {
    .info = {.id = "weartrack-map",
             .title = "weartrack-hdf5(5): maps of force curves of this program",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence = "the HDF5 file that this program writes",
             .version = "1"},
    .detect = detect,
    .force = &map_force,
    .describe = describe,
};
