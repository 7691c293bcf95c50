/* Reads attributes and data sets of HDF5 files of force curves, and runs the conversion to text in
 * the sandbox. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/hierarchy/curves_hdf5.h"
#include "core/base/memory.h"
#include "core/store/hdf5_sandbox.h"
#include "core/store/store.h"
#include "read/bytes/input.h"
#include "read/bytes/samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Maximum length of a numeric attribute. */
#define NUMBERS_MAX 64
/* Maximum number of links that are examined one by one. */
#define LINKS_MAX 4096
/* Maximum ratio of unpacked data to the file size; deflate cannot exceed it. */
#define UNPACKED_MAX 1040

static hid_t open_attribute(hid_t object, const char *name, size_t *n)
{
    if (H5Aexists(object, name) <= 0)
        return -1;
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    const hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
    const hssize_t points = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    hdf5_close(space);
    *n = points > 0 ? (size_t)points : 0;
    return attribute;
}

double hdf5_number_attribute(hid_t object, const char *name, size_t i)
{
    double values[NUMBERS_MAX] = {(double)NAN}, value = (double)NAN;
    size_t n = 0;
    const hid_t attribute = open_attribute(object, name, &n);
    const hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
    const H5T_class_t class = type >= 0 ? H5Tget_class(type) : H5T_NO_CLASS;
    if ((class == H5T_FLOAT || class == H5T_INTEGER) && i < n && n <= NUMBERS_MAX &&
        H5Aread(attribute, H5T_NATIVE_DOUBLE, values) >= 0)
        value = values[i];
    hdf5_close(type);
    hdf5_close(attribute);
    return value;
}

bool hdf5_text_attribute(hid_t object, const char *name, char text[HDF5_TEXT])
{
    enum { WIDTH_MAX = 65536 };
    size_t n = 0;
    char *moving = NULL, *fixed = NULL;
    const hid_t attribute = open_attribute(object, name, &n);
    const hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
    text[0] = '\0';
    if (type >= 0 && n == 1 && H5Tget_class(type) == H5T_STRING) {
        const size_t width = H5Tget_size(type);
        if (H5Tis_variable_str(type) > 0) {
            if (H5Aread(attribute, type, &moving) >= 0 && moving != NULL)
                snprintf(text, HDF5_TEXT, "%s", moving);
        } else if (width <= WIDTH_MAX) {
            fixed = wt_alloc(width + 1, 1);
            if (H5Aread(attribute, type, fixed) >= 0)
                snprintf(text, HDF5_TEXT, "%s", fixed);
        }
    }
    (void)H5free_memory(moving);
    free(fixed);
    hdf5_close(type);
    hdf5_close(attribute);
    return text[0] != '\0';
}

size_t hdf5_link_count(hid_t group)
{
    H5G_info_t info;
    return H5Gget_info(group, &info) >= 0 ? (size_t)info.nlinks : 0;
}

bool hdf5_link_name(hid_t group, size_t i, char name[HDF5_NAME])
{
    if (i >= hdf5_link_count(group) || i >= LINKS_MAX)
        return false;
    const ssize_t length =
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, HDF5_NAME, H5P_DEFAULT);
    if (length >= HDF5_NAME)
        name[0] = '\0';
    return length > 0; /* a damaged group may state any number of links */
}

/* Opens an object of this file; links to other files are refused. */
static hid_t open_object(hid_t parent, const char *name, H5I_type_t kind)
{
    H5L_info_t info;
    if (name[0] == '\0' || strchr(name, '/') != NULL || H5Lexists(parent, name, H5P_DEFAULT) <= 0 ||
        H5Lget_info(parent, name, &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_HARD)
        return -1;
    const hid_t object = H5Oopen(parent, name, H5P_DEFAULT);
    if (object < 0 || H5Iget_type(object) == kind)
        return object;
    hdf5_close(object);
    return -1;
}

hid_t hdf5_open_group(hid_t parent, const char *name)
{
    return open_object(parent, name, H5I_GROUP);
}

hid_t hdf5_open_data(hid_t parent, const char *name)
{
    return open_object(parent, name, H5I_DATASET);
}

/* Opens a data set for reading by rows. A packed chunk must fit into the chunk cache, or it is
 * unpacked for every row. */
hid_t hdf5_open_rows(hid_t parent, const char *name)
{
    enum { CHUNK_CACHE_SIZE = 1 << 20 };
    const hid_t data = hdf5_open_data(parent, name);
    const hid_t creation = data >= 0 ? H5Dget_create_plist(data) : -1;
    const hid_t type = data >= 0 ? H5Dget_type(data) : -1;
    const size_t width = type >= 0 ? H5Tget_size(type) : 0;
    hsize_t piece = 0;
    hid_t again = -1;
    if (width > 0 && H5Pget_layout(creation) == H5D_CHUNKED &&
        H5Pget_chunk(creation, 1, &piece) == 1 && piece < SIZE_MAX / width &&
        piece * width > CHUNK_CACHE_SIZE) {
        const size_t size = (size_t)piece * width;
        const hid_t access = H5Pcreate(H5P_DATASET_ACCESS);
        hdf5_close(data); /* the cache of an open data set cannot be changed */
        if (access >= 0 &&
            H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, size, 1.0) >= 0)
            again = H5Dopen2(parent, name, access);
        hdf5_close(access);
    } else {
        again = data;
    }
    hdf5_close(type);
    hdf5_close(creation);
    return again;
}

size_t hdf5_value_count(hid_t data, size_t size)
{
    const hid_t creation = H5Dget_create_plist(data);
    const hid_t space = H5Dget_space(data);
    const hid_t type = H5Dget_type(data);
    const H5T_class_t class = type >= 0 ? H5Tget_class(type) : H5T_NO_CLASS;
    const hssize_t points = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    const H5D_layout_t layout = creation >= 0 ? H5Pget_layout(creation) : H5D_LAYOUT_ERROR;
    const bool good =
        (class == H5T_FLOAT || class == H5T_INTEGER) && points > 0 &&
        H5Sget_simple_extent_ndims(space) == 1 &&
        (layout == H5D_CHUNKED || layout == H5D_CONTIGUOUS || layout == H5D_COMPACT) &&
        H5Pget_external_count(creation) == 0 && (size_t)points / UNPACKED_MAX <= size;
    hdf5_close(type);
    hdf5_close(space);
    hdf5_close(creation);
    return good ? (size_t)points : 0;
}

bool hdf5_read_rows(hid_t data, size_t from, size_t n, double *values)
{
    const hsize_t start = from, count = n;
    const hid_t all = H5Dget_space(data);
    const hid_t space = H5Screate_simple(1, &count, NULL);
    const bool good = all >= 0 && space >= 0 &&
                      H5Sselect_hyperslab(all, H5S_SELECT_SET, &start, NULL, &count, NULL) >= 0 &&
                      H5Dread(data, H5T_NATIVE_DOUBLE, space, all, H5P_DEFAULT, values) >= 0;
    hdf5_close(space);
    hdf5_close(all);
    return good;
}

double *hdf5_read_values(hid_t data, size_t size, size_t *n)
{
    const size_t count = hdf5_value_count(data, size);
    double *values = count > 0 ? try_alloc(count, sizeof *values) : NULL;
    *n = count > 0 ? count : *n;
    if (values != NULL && !hdf5_read_rows(data, 0, count, values)) {
        free(values);
        values = NULL;
    }
    return values;
}

/* ---- outside of the sandbox ------------------------------------------------------------------ */

recognition hdf5_detect(const file_reader *self, file_peek *peek)
{
    const char *const keywords = self->hdf5->keywords;
    return recognition_result(
        PEEK_BEGINS(peek, HDF5_SIGNATURE) &&
            (peek_contains(peek, keywords, strlen(keywords)) ||
             (!peek->whole && !PEEK_CONTAINS(peek, STORE_FORMAT_ATTRIBUTE "\0") &&
              input_contains(peek->input, keywords))),
        85);
}

typedef struct text_sink {
    spool text;
    const char *name;
} text_sink;

static wt_status store_text(void *user, const void *piece, size_t n, wt_error *err)
{
    text_sink *to = user;
    return spool_add(&to->text, piece, n, to->name, err);
}

wt_status hdf5_as_text(const file_reader *self, wt_input *input, wt_log *log, wt_input **text,
                       wt_error *err)
{
    hdf5_bytes from = {.bytes = NULL};
    text_sink to = {.name = wt_input_name(input)};
    sandbox_stream *flow = NULL;
    double factor, offset;
    /* In the sandbox no file can be opened, so the unit database is loaded before. */
    wt_status status = wt_unit_to_si("m", WT_Q_LENGTH, &factor, &offset, err);
    if (status == WT_OK)
        status = input_hdf5_bytes(input, &from, err);
    if (status != WT_OK)
        return status;
    if (self->hdf5->note != NULL)
        wt_log_add(log, WT_NOTE, to.name, NULL, "%s", self->hdf5->note);
    sandbox_limits limits = sandbox_limits_for(from.size);
    /* HDF5 may loop on a damaged heap. A sound file takes far less than this time for each
     * megabyte. */
    limits.answer = ((size_t)16 << 20) + 24 * from.size; /* packed numbers expand */
    limits.cpu_time = 2 + (unsigned)(from.size >> 20);
    status = hdf5_sandbox_start(&from, &limits, self->hdf5->print, &flow, err);
    if (status == WT_OK)
        status = sandbox_drain(flow, store_text, &to, err);
    sandbox_close(flow);
    if (status == WT_OK)
        return spool_to_input(&to.text, to.name, text, err);
    spool_discard(&to.text);
    return status;
}
