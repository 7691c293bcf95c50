/* Writes a map of force curves to the store, curve by curve. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/store/force_map.h"
#include "core/store/hdf5_sandbox.h"
#include "core/store/store.h"
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

uint32_t map_checksum(uint32_t before, const double *values, size_t n)
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

static const wt_channel *measured_channel(const wt_segment *segment, wt_quantity quantity)
{
    const wt_channel *const c = wt_segment_channel(segment, quantity);
    return c != NULL && map_channel_has_samples(c->values, segment->n_points) ? c : NULL;
}

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
        const wt_channel *const c = measured_channel(segment, w->channels[k].quantity);
        if (c != NULL)
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
    const table_writer *const tables[] = {&w->curves, &w->segments, &w->names};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < sizeof tables / sizeof *tables; i++)
        status = tables[i]->status;
    if (status == WT_OK)
        status = store_begin(path, &w->file, err);
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
