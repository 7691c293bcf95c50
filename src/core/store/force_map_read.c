/* Reads a map of force curves from the store, curve by curve. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/memory.h"
#include "core/store/force_map.h"
#include "core/store/store.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct map_reader {
    wt_result *result;
    table_view curves, segments;
    map_channel channels[WT_Q_COUNT];
    size_t n_channels;
    sandbox_stream *stream;
    wt_error failure;     /* error of the stream, which every following curve returns */
    size_t n_samples, at; /* samples of an array; start of the next segment */
    size_t n_block;       /* samples of the current block */
    double *block;        /* [n_channels][n_block] */
    size_t next_curve, next_segment;
    map_segment *found; /* segments of the current curve */
    size_t n_found;
    double *values;
    size_t capacity;
};

/* Returns an integer from 0 to `most`, or -1 for any other number. */
static double valid_count(double value, size_t most)
{
    return value >= 0 && value <= (double)most && value == floor(value) ? value : -1;
}

static wt_status bind_map_table(const wt_result *result, const table_schema *schema,
                                table_view *view, wt_error *err)
{
    const wt_table *const table = wt_result_find(result, schema->name);
    if (table == NULL)
        return store_corrupt_error(err, schema->name, "table missing");
    if (table_bind(table, schema, "", view, err) == WT_OK)
        return WT_OK;
    if (err != NULL)
        err->status = WT_E_CORRUPT;
    return WT_E_CORRUPT;
}

static wt_status read_map_channels(map_reader *r, wt_error *err)
{
    table_view v;
    const wt_status status = bind_map_table(r->result, &map_channels_schema, &v, err);
    if (status != WT_OK)
        return status;
    if (v.n_rows == 0 || v.n_rows > WT_Q_COUNT)
        return store_corrupt_error(err, map_channels_schema.name, "no channels, or too many");
    for (size_t row = 0; row < v.n_rows; row++) {
        map_channel *const c = &r->channels[row];
        if (!wt_quantity_find(map_channels_text(&v, row, MAP_CHANNELS_QUANTITY), &c->quantity))
            return store_corrupt_error(err, map_channels_schema.name,
                                       "a quantity that is not known");
        for (size_t i = 0; i < row; i++)
            if (r->channels[i].quantity == c->quantity)
                return store_corrupt_error(err, map_channels_schema.name, "a quantity twice");
        c->name = map_channels_text(&v, row, MAP_CHANNELS_NAME);
        c->unit = map_channels_text(&v, row, MAP_CHANNELS_UNIT);
    }
    r->n_channels = v.n_rows;
    return WT_OK;
}

/* Checks that the segments belong to the curves, and that the file is large enough for the
 * samples. */
static wt_status check_counts(map_reader *r, size_t size, wt_error *err)
{
    const size_t most = size / sizeof(double) / r->n_channels;
    size_t n_segments = 0;
    for (size_t row = 0; row < r->curves.n_rows; row++) {
        const double n = valid_count(map_curves_get(&r->curves, row, MAP_CURVES_SEGMENTS),
                                     r->segments.n_rows - n_segments);
        if (n < 0 ||
            valid_count(map_curves_get(&r->curves, row, MAP_CURVES_CURVE), SIZE_MAX >> 12) < 0)
            return store_corrupt_error(err, map_curves_schema.name, "a curve without its segments");
        n_segments += (size_t)n;
    }
    if (n_segments != r->segments.n_rows)
        return store_corrupt_error(err, map_segments_schema.name, "segments without a curve");
    for (size_t row = 0; row < n_segments; row++) {
        const double n = valid_count(map_segments_get(&r->segments, row, MAP_SEGMENTS_SAMPLES),
                                     most - r->n_samples);
        if (n < 0 || valid_count(map_segments_get(&r->segments, row, MAP_SEGMENTS_NUMBER),
                                 SIZE_MAX >> 12) < 0)
            return store_corrupt_error(err, map_segments_schema.name,
                                       "more samples than the file has");
        r->n_samples += (size_t)n;
    }
    return WT_OK;
}

wt_status map_open(const hdf5_bytes *from, wt_result *result, map_reader **reader, wt_error *err)
{
    map_reader *const r = wt_alloc(1, sizeof *r);
    const sandbox_limits limits = sandbox_limits_for(from->size);
    wt_status status = WT_OK;
    r->failure = (wt_error)WT_ERROR_INIT;
    r->result = result;
    if (wt_result_find(result, map_curves_schema.name) == NULL)
        status = wt_fail(err, WT_E_EMPTY, "no map of force curves in it");
    if (status == WT_OK)
        status = read_map_channels(r, err);
    if (status == WT_OK)
        status = bind_map_table(result, &map_curves_schema, &r->curves, err);
    if (status == WT_OK)
        status = bind_map_table(result, &map_segments_schema, &r->segments, err);
    if (status == WT_OK)
        status = check_counts(r, from->size, err);
    r->block = wt_alloc(r->n_channels * MAP_BLOCK, sizeof *r->block);
    if (status == WT_OK)
        status = hdf5_sandbox_start(from, &limits, store_extract_samples, &r->stream, err);
    if (status == WT_OK)
        *reader = r;
    else
        map_close(r);
    return status;
}

void map_close(map_reader *r)
{
    if (r == NULL)
        return;
    sandbox_close(r->stream);
    wt_result_free(r->result);
    free(r->block);
    free(r->found);
    free(r->values);
    free(r);
}

size_t map_n_curves(const map_reader *reader)
{
    return reader->curves.n_rows;
}

size_t map_channels(const map_reader *reader, const map_channel **channels)
{
    *channels = reader->channels;
    return reader->n_channels;
}

/* The stream has the samples in blocks: all channels of one block, then all channels of the
 * next. */
static wt_status receive_samples(map_reader *r, double *values, size_t n, wt_error *err)
{
    for (size_t i = 0; i < n;) {
        const size_t in_block = r->at % MAP_BLOCK;
        if (in_block == 0) {
            const size_t left = r->n_samples - r->at;
            r->n_block = left < MAP_BLOCK ? left : MAP_BLOCK;
            const wt_status status = sandbox_receive(
                r->stream, r->block, r->n_channels * r->n_block * sizeof *r->block, err);
            if (status != WT_OK)
                return status;
        }
        const size_t left = n - i, capacity = r->n_block - in_block;
        const size_t m = left < capacity ? left : capacity;
        for (size_t k = 0; k < r->n_channels; k++)
            memcpy(values + k * n + i, r->block + k * r->n_block + in_block, m * sizeof *values);
        r->at += m;
        i += m;
    }
    return WT_OK;
}

static wt_status reserve_segments(map_reader *r, size_t first, size_t n, wt_error *err)
{
    size_t samples = 0;
    for (size_t i = 0; i < n; i++)
        samples += (size_t)map_segments_get(&r->segments, first + i, MAP_SEGMENTS_SAMPLES);
    if (n > r->n_found) {
        r->found = wt_realloc(r->found, n, sizeof *r->found);
        r->n_found = n;
    }
    if (samples * r->n_channels > r->capacity) {
        free(r->values);
        r->capacity = samples * r->n_channels;
        r->values = try_alloc(r->capacity, sizeof *r->values);
        if (r->values == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    return WT_OK;
}

static wt_segment_kind find_segment_kind(const char *name)
{
    for (int kind = WT_SEGMENT_APPROACH; kind < WT_SEGMENT_OTHER; kind++)
        if (strcmp(name, wt_segment_kind_name((wt_segment_kind)kind)) == 0)
            return (wt_segment_kind)kind;
    return WT_SEGMENT_OTHER;
}

static long grid_index(double value)
{
    return (long)valid_count(value, INT32_MAX);
}

static double positive_or_nan(double value)
{
    return value > 0 && isfinite(value) ? value : (double)NAN;
}

static void set_curve_metadata(const map_reader *r, size_t row, wt_force_curve *curve)
{
    const table_view *const v = &r->curves;
    curve->index = (size_t)map_curves_get(v, row, MAP_CURVES_CURVE);
    curve->x = map_curves_get(v, row, MAP_CURVES_POSITION_X);
    curve->y = map_curves_get(v, row, MAP_CURVES_POSITION_Y);
    curve->grid_x = grid_index(map_curves_get(v, row, MAP_CURVES_GRID_X));
    curve->grid_y = grid_index(map_curves_get(v, row, MAP_CURVES_GRID_Y));
    curve->cantilever.spring_constant =
        positive_or_nan(map_curves_get(v, row, MAP_CURVES_SPRING_CONSTANT));
    curve->cantilever.sensitivity = positive_or_nan(map_curves_get(v, row, MAP_CURVES_SENSITIVITY));
}

wt_status map_next_curve(map_reader *r, wt_force_curve *curve, const map_segment **segments,
                         size_t *n, wt_error *err)
{
    uint32_t sum = 0;
    const size_t row = r->next_curve, first = r->next_segment;
    if (row == r->curves.n_rows) {
        const wt_status ended = r->stream != NULL ? sandbox_finish(r->stream, err) : WT_OK;
        sandbox_close(r->stream);
        r->stream = NULL;
        return ended == WT_OK ? WT_END : ended;
    }
    const size_t n_segments = (size_t)map_curves_get(&r->curves, row, MAP_CURVES_SEGMENTS);
    set_curve_metadata(r, row, curve);
    if (r->failure.status != WT_OK) {
        r->next_curve++;
        if (err != NULL)
            *err = r->failure;
        return r->failure.status;
    }
    wt_status status = reserve_segments(r, first, n_segments, &r->failure);
    double *values = r->values;
    for (size_t i = 0; status == WT_OK && i < n_segments; i++) {
        const table_view *const v = &r->segments;
        map_segment *const s = &r->found[i];
        *s = (map_segment){
            .kind = find_segment_kind(map_segments_text(v, first + i, MAP_SEGMENTS_SEGMENT)),
            .index = (size_t)map_segments_get(v, first + i, MAP_SEGMENTS_NUMBER),
            .n_points = (size_t)map_segments_get(v, first + i, MAP_SEGMENTS_SAMPLES),
            .duration = map_segments_get(v, first + i, MAP_SEGMENTS_DURATION),
            .velocity = map_segments_get(v, first + i, MAP_SEGMENTS_VELOCITY),
            .setpoint = map_segments_get(v, first + i, MAP_SEGMENTS_SETPOINT),
            .values = values};
        status = receive_samples(r, values, s->n_points, &r->failure);
        for (size_t k = 0; status == WT_OK && k < r->n_channels; k++)
            if (map_channel_has_samples(values + k * s->n_points, s->n_points))
                sum = map_checksum(sum, values + k * s->n_points, s->n_points);
        values += r->n_channels * s->n_points;
    }
    r->next_curve++;
    if (status != WT_OK) {
        sandbox_close(r->stream);
        r->stream = NULL;
        if (err != NULL)
            *err = r->failure;
        return status;
    }
    r->next_segment += n_segments;
    *segments = r->found;
    *n = n_segments;
    if ((double)sum == map_curves_get(&r->curves, row, MAP_CURVES_CHECKSUM))
        return WT_OK;
    (void)store_corrupt_error(err, MAP_SAMPLES_GROUP,
                              "the samples do not agree with their checksum");
    wt_error_place(err, "%s, curve %zu", MAP_SAMPLES_GROUP, curve->index);
    return WT_E_CORRUPT;
}
