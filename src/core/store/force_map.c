/* Reads a map of force curves from the store, curve by curve. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/store/force_map.h"
#include "core/base/memory.h"
#include "core/store/hdf5_sandbox.h"
#include "core/store/store.h"
#include "core/table/registry.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Quantity with its array in the file and the samples that are not written yet. */
typedef struct channel {
    wt_quantity quantity;
    hid_t dataset;
    double *block; /* [MAP_BLOCK] */
} channel;

struct wt_map_writer {
    store_file *file;
    hid_t group;
    channel channels[WT_Q_COUNT];
    size_t n_channels;
    size_t n_blocks, n; /* blocks written; samples of the current block */
    table_writer curves, segments, names;
    wt_error *err;    /* of the current call */
    wt_status failed; /* status of an earlier call, after which the file is lost */
};

/* CRC-32 of the samples of a curve: values of 8 bytes in little-endian order, by segment and by
 * channel. A channel without a number in a segment is skipped. */
static uint32_t map_checksum(uint32_t before, const double *values, size_t n)
{
    unsigned char bytes[64 * sizeof *values];
    uLong sum = before;
    for (size_t i = 0; i < n;) {
        size_t used = 0;
        for (; i < n && used < sizeof bytes; i++) {
            uint64_t bits;
            memcpy(&bits, &values[i], sizeof bits);
            for (unsigned k = 0; k < sizeof bits; k++)
                bytes[used++] = (unsigned char)(bits >> 8 * k);
        }
        sum = crc32(sum, bytes, (uInt)used);
    }
    return (uint32_t)sum;
}

bool map_channel_has_samples(const double *values, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isnan(values[i]))
            return true;
    return false;
}

/* ---- arrays ---------------------------------------------------------------------------------- */

/* Writes a block, or the beginning of one, after `n_blocks` blocks. */
static bool append_block(hid_t dataset, size_t n_blocks, const double *block, size_t n)
{
    const hsize_t at = (hsize_t)n_blocks * MAP_BLOCK, count = n, size = at + n;
    if (H5Dset_extent(dataset, &size) < 0)
        return false;
    const hid_t in_memory = H5Screate_simple(1, &count, NULL);
    const hid_t in_file = H5Dget_space(dataset);
    const bool good =
        in_memory >= 0 && in_file >= 0 &&
        H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &at, NULL, &count, NULL) >= 0 &&
        H5Dwrite(dataset, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, block) >= 0;
    hdf5_close(in_memory);
    hdf5_close(in_file);
    return good;
}

static hid_t create_sample_dataset(const wt_map_writer *w, wt_quantity quantity)
{
    static const hsize_t none = 0, endless = H5S_UNLIMITED, chunk = MAP_BLOCK;
    hid_t dataset = -1;
    const hid_t space = H5Screate_simple(1, &none, &endless);
    const hid_t creation = H5Pcopy(w->file->dataset_creation);
    const hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
    /* Whole chunks are written, so that a cache is not needed. */
    if (space >= 0 && creation >= 0 && access >= 0 && H5Pset_chunk(creation, 1, &chunk) >= 0 &&
        H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0 &&
        H5Pset_chunk_cache(access, 0, 0, 1.0) >= 0)
        dataset = H5Dcreate2(w->group, wt_quantity_id(quantity), H5T_IEEE_F64LE, space, H5P_DEFAULT,
                             creation, access);
    hdf5_close(space);
    hdf5_close(creation);
    hdf5_close(access);
    if (dataset >= 0 &&
        store_write_text_attribute(w->file, dataset, STORE_UNITS_ATTRIBUTE,
                                   wt_quantity_unit(quantity)) &&
        store_write_text_attribute(w->file, dataset, STORE_LONG_NAME_ATTRIBUTE,
                                   wt_quantity_id(quantity)))
        return dataset;
    hdf5_close(dataset);
    return -1;
}

static void fill_block_with_nan(double *block)
{
    for (size_t i = 0; i < MAP_BLOCK; i++)
        block[i] = (double)NAN;
}

TABLE_ROW(map_channels, MAP_CHANNELS, const char *quantity, *name, *unit;)

/* A channel that appears late is filled with NaN up to the current block. */
static wt_status add_map_channel(wt_map_writer *w, const wt_channel *as)
{
    hdf5_scope scope;
    channel *const c = &w->channels[w->n_channels];
    *c = (channel){as->quantity, -1, wt_alloc(MAP_BLOCK, sizeof *c->block)};
    w->n_channels++;
    fill_block_with_nan(c->block);
    hdf5_enter(&scope);
    c->dataset = create_sample_dataset(w, c->quantity);
    bool good = c->dataset >= 0;
    for (size_t i = 0; good && i < w->n_blocks; i++)
        good = append_block(c->dataset, i, c->block, MAP_BLOCK);
    hdf5_leave(&scope);
    w->names.err = w->err;
    TABLE_ADD(map_channels, &w->names, wt_quantity_id(c->quantity), as->name, as->unit);
    return good ? w->names.status : store_write_error(w->file, w->err);
}

static wt_status write_block(wt_map_writer *w)
{
    hdf5_scope scope;
    bool good = true;
    if (w->n == 0)
        return WT_OK;
    hdf5_enter(&scope);
    for (size_t i = 0; good && i < w->n_channels; i++) {
        good = append_block(w->channels[i].dataset, w->n_blocks, w->channels[i].block, w->n);
        fill_block_with_nan(w->channels[i].block);
    }
    hdf5_leave(&scope);
    w->n_blocks += w->n == MAP_BLOCK;
    w->n = 0;
    return good && w->file->to.failed == 0 ? WT_OK : store_write_error(w->file, w->err);
}

/* ---- curves ---------------------------------------------------------------------------------- */

static wt_status buffer_samples(wt_map_writer *w, const wt_segment *segment)
{
    wt_status status = WT_OK;
    const wt_channel *of[WT_Q_COUNT];
    for (size_t k = 0; k < w->n_channels; k++)
        of[k] = wt_segment_channel(segment, w->channels[k].quantity);
    for (size_t i = 0; status == WT_OK && i < segment->n_points;) {
        const size_t left = segment->n_points - i, room = MAP_BLOCK - w->n;
        const size_t n = left < room ? left : room;
        for (size_t k = 0; k < w->n_channels; k++)
            if (of[k] != NULL)
                memcpy(w->channels[k].block + w->n, of[k]->values + i, n * sizeof(double));
        w->n += n;
        i += n;
        if (w->n == MAP_BLOCK)
            status = write_block(w);
    }
    return status;
}

TABLE_ROW(map_curves, MAP_CURVES, wt_force_curve curve; double grid_x, grid_y, checksum;)

TABLE_ROW(map_segments, MAP_SEGMENTS, const char *kind; wt_segment of;)

static wt_status add_map_segment(wt_map_writer *w, const wt_segment *segment, uint32_t *sum)
{
    wt_status status = WT_OK;
    for (size_t c = 0; status == WT_OK && c < segment->n_channels; c++) {
        size_t k = 0;
        while (k < w->n_channels && w->channels[k].quantity != segment->channels[c].quantity)
            k++;
        if (k == w->n_channels)
            status = add_map_channel(w, &segment->channels[c]);
    }
    for (size_t k = 0; k < w->n_channels; k++) {
        const wt_channel *const c = wt_segment_channel(segment, w->channels[k].quantity);
        if (c != NULL && map_channel_has_samples(c->values, segment->n_points))
            *sum = map_checksum(*sum, c->values, segment->n_points);
    }
    TABLE_ADD(map_segments, &w->segments, wt_segment_kind_name(segment->kind), *segment);
    return status == WT_OK ? buffer_samples(w, segment) : status;
}

/* A failed curve may have left samples, and those of the next curve would be assigned to it. */
static wt_status fail_after_error(const wt_map_writer *w, wt_error *err)
{
    wt_fail(err, w->failed, "a curve before this one could not be written");
    wt_error_advice(err, "discard the map and begin again");
    return w->failed;
}

wt_status wt_map_add_curve(wt_map_writer *w, const wt_force_curve *curve, wt_error *err)
{
    uint32_t sum = 0;
    wt_status status = WT_OK;
    if (w->failed != WT_OK)
        return fail_after_error(w, err);
    w->err = w->curves.err = w->segments.err = err;
    for (size_t s = 0; status == WT_OK && s < curve->n_segments; s++)
        status = add_map_segment(w, &curve->segments[s], &sum);
    if (status != WT_OK)
        return w->failed = status;
    TABLE_ADD(map_curves, &w->curves, *curve, (double)curve->grid_x, (double)curve->grid_y,
              (double)sum);
    w->failed = w->curves.status != WT_OK ? w->curves.status : w->segments.status;
    return w->failed;
}

/* ---- the file -------------------------------------------------------------------------------- */

wt_status wt_map_open(const char *path, wt_map_writer **writer, wt_error *err)
{
    hdf5_scope scope;
    wt_map_writer *const w = wt_alloc(1, sizeof *w);
    w->group = -1;
    w->err = err;
    w->curves = table_begin(&map_curves_schema, err);
    w->segments = table_begin(&map_segments_schema, err);
    w->names = table_begin(&map_channels_schema, err);
    wt_status status = store_begin(path, &w->file, err);
    if (status == WT_OK) {
        hdf5_enter(&scope);
        if (store_write_text_attribute(w->file, w->file->file, STORE_MAP_ATTRIBUTE,
                                       MAP_SAMPLES_GROUP))
            w->group = store_create_group(w->file, MAP_SAMPLES_GROUP);
        hdf5_leave(&scope);
        status = w->group >= 0 ? WT_OK : store_write_error(w->file, err);
    }
    if (status == WT_OK)
        *writer = w;
    else
        wt_map_discard(w);
    return status;
}

/* Closes the arrays. False if HDF5 fails. */
static bool close_arrays(wt_map_writer *w, bool complete)
{
    hdf5_scope scope;
    const char *names[WT_Q_COUNT];
    hdf5_enter(&scope);
    for (size_t i = 0; i < w->n_channels; i++) {
        hdf5_close(w->channels[i].dataset);
        free(w->channels[i].block);
        names[i] = wt_quantity_id(w->channels[i].quantity);
    }
    const bool good =
        !complete || store_write_text_list(w->group, STORE_COLUMNS_ATTRIBUTE, names, w->n_channels);
    hdf5_close(w->group);
    hdf5_leave(&scope);
    w->n_channels = 0;
    w->group = -1;
    return good;
}

void wt_map_discard(wt_map_writer *w)
{
    if (w == NULL)
        return;
    (void)close_arrays(w, false);
    store_discard(w->file);
    wt_table_free(w->curves.table);
    wt_table_free(w->segments.table);
    wt_table_free(w->names.table);
    free(w);
}

wt_status wt_map_commit(wt_map_writer *w, wt_result *result, bool with_provenance, wt_error *err)
{
    table_writer *const tables[] = {&w->curves, &w->segments, &w->names};
    w->err = err;
    wt_status status = w->failed != WT_OK ? fail_after_error(w, err) : write_block(w);
    if (status == WT_OK && !close_arrays(w, true))
        status = store_write_error(w->file, err);
    for (size_t i = 0; status == WT_OK && i < sizeof tables / sizeof *tables; i++) {
        wt_table *table = NULL;
        tables[i]->err = err;
        status = table_end(tables[i], &table);
        tables[i]->table = NULL;
        if (status == WT_OK)
            status = wt_result_add(result, table, err);
    }
    if (status == WT_OK) {
        store_file *const file = w->file;
        w->file = NULL;
        status = store_end(file, result, with_provenance, err);
    }
    wt_map_discard(w);
    return status;
}

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
