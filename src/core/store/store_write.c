/* Writes results to the HDF5 store. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/store/hdf5_sandbox.h"
#include "core/store/store.h"
#include "core/table/registry.h"
#include "core/table/table.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

typedef struct store_file {
    wt_atomic_file *out;
    hdf5_bytes to;
    hid_t file;
    hid_t scalar;         /* scalar dataspace */
    hid_t group_creation; /* without times, with all links and attributes in the header */
    hid_t dataset_creation;
} store_file;

static bool write_attribute(hid_t object, const char *name, hid_t file_type, hid_t memory_type,
                            hid_t space, const void *value)
{
    const hid_t attribute = H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0)
        return false;
    const bool good = H5Awrite(attribute, memory_type, value) >= 0;
    return H5Aclose(attribute) >= 0 && good;
}

/* Creates a type for UTF-8 text of fixed length, padded with zeros. HDF5 1.10 crashes on damaged
 * text of variable length. */
static hid_t create_text_type(size_t length)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type < 0 || H5Tset_size(type, length > 0 ? length : 1) < 0 ||
        H5Tset_strpad(type, H5T_STR_NULLPAD) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0) {
        (void)H5Tclose(type);
        return -1;
    }
    return type;
}

static bool write_text_attribute(const store_file *w, hid_t object, const char *name,
                                 const char *text)
{
    const hid_t type = create_text_type(strlen(text));
    const bool good = type >= 0 && write_attribute(object, name, type, type, w->scalar, text);
    return type >= 0 && H5Tclose(type) >= 0 && good;
}

/* Packs texts into an array of one width. The caller frees it. */
static char *pack_texts(const char *const *texts, size_t n, size_t *width)
{
    *width = 1;
    for (size_t i = 0; i < n; i++) {
        const size_t length = strlen(texts[i]);
        if (length > *width)
            *width = length;
    }
    char *const packed = wt_alloc(n, *width);
    for (size_t i = 0; i < n; i++)
        memcpy(packed + i * *width, texts[i], strlen(texts[i]));
    return packed;
}

static bool write_number_attribute(const store_file *w, hid_t object, const char *name,
                                   double value)
{
    return write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, w->scalar, &value);
}

/* Writes a list of names. An empty list is not written. */
static bool write_text_list(hid_t object, const char *name, const char *const *words, size_t n)
{
    const hsize_t size = n;
    size_t width = 0;
    if (n == 0)
        return true;
    char *const packed = pack_texts(words, n, &width);
    const hid_t type = create_text_type(width);
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const bool good =
        type >= 0 && space >= 0 && write_attribute(object, name, type, type, space, packed);
    free(packed);
    hdf5_close(type);
    hdf5_close(space);
    return good;
}

/* Number of values of a data set that is no array. */
#define ONE_VALUE SIZE_MAX

static bool write_dataset(const store_file *w, hid_t group, const char *name, hid_t file_type,
                          hid_t memory_type, const void *values, size_t n, const char *units,
                          const char *long_name)
{
    const hsize_t size = n;
    const hid_t space = n == ONE_VALUE ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    const hid_t dataset =
        H5Dcreate2(group, name, file_type, space, H5P_DEFAULT, w->dataset_creation, H5P_DEFAULT);
    bool good = dataset >= 0;
    if (good && n > 0)
        good = H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    good = good && write_text_attribute(w, dataset, STORE_UNITS_ATTRIBUTE, units) &&
           write_text_attribute(w, dataset, STORE_LONG_NAME_ATTRIBUTE, long_name);
    if (dataset >= 0)
        good = H5Dclose(dataset) >= 0 && good;
    return space >= 0 && H5Sclose(space) >= 0 && good;
}

/* Opens a group by its path and creates missing groups. */
static hid_t create_group(const store_file *w, const char *path)
{
    char *const partial = wt_strdup(path);
    hid_t group = -1;
    for (char *slash = partial; slash != NULL;) {
        slash = strchr(slash, '/');
        if (slash != NULL)
            *slash = '\0';
        const htri_t exists = H5Lexists(w->file, partial, H5P_DEFAULT);
        if (group >= 0)
            (void)H5Gclose(group);
        group = exists > 0
                    ? H5Gopen2(w->file, partial, H5P_DEFAULT)
                    : H5Gcreate2(w->file, partial, H5P_DEFAULT, w->group_creation, H5P_DEFAULT);
        if (group < 0)
            break;
        if (slash != NULL)
            *slash++ = '/';
    }
    free(partial);
    return group;
}

static bool write_keys(const store_file *w, hid_t group, const wt_table *table)
{
    const char **const words = wt_alloc(table->n_keys, sizeof *words);
    bool good = true;
    for (size_t i = 0; good && i < table->n_keys; i++) {
        const table_key *const key = &table->keys[i];
        words[i] = key->name;
        if (!key->is_estimate) {
            good = write_text_attribute(w, group, key->name, key->text);
            continue;
        }
        char *names[KEY_PARTS] = {NULL};
        table_key_part_names(key->name, names);
        good = write_number_attribute(w, group, key->name, key->parsed.value) &&
               write_number_attribute(w, group, names[KEY_STANDARD_ERROR],
                                      key->parsed.standard_error) &&
               write_number_attribute(w, group, names[KEY_NUMERICAL_ERROR],
                                      key->parsed.numerical_error) &&
               write_text_attribute(w, group, names[KEY_UNITS], key->unit);
        for (size_t k = 0; k < KEY_PARTS; k++)
            free(names[k]);
    }
    good = good && write_text_list(group, STORE_KEYS_ATTRIBUTE, words, table->n_keys);
    free(words);
    return good;
}

static bool write_hdf5_columns(const store_file *w, hid_t group, const wt_table *table)
{
    const size_t n = table->n_rows > table->n_columns ? table->n_rows : table->n_columns;
    const char **const words = wt_alloc(n, sizeof *words);
    uint64_t *const blocks = wt_alloc(table->n_rows, sizeof *blocks);
    for (size_t i = 0; i < table->n_columns; i++)
        words[i] = table->columns[i].name;
    bool good = write_text_list(group, STORE_COLUMNS_ATTRIBUTE, words, table->n_columns);
    for (size_t i = 0; good && i < table->n_columns; i++) {
        const table_column *const column = &table->columns[i];
        if (column->kind == WT_COLUMN_NUMBER) {
            good = write_dataset(w, group, column->name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                                 column->numbers, table->n_rows, column->unit, column->long_name);
            continue;
        }
        for (size_t row = 0; row < table->n_rows; row++)
            words[row] = wt_table_text(table, row, i);
        size_t width = 0;
        char *const packed = pack_texts(words, table->n_rows, &width);
        const hid_t type = create_text_type(width);
        good = type >= 0 && write_dataset(w, group, column->name, type, type, packed, table->n_rows,
                                          "", column->long_name);
        free(packed);
        hdf5_close(type);
    }
    for (size_t row = 0; good && row < table->n_rows; row++)
        blocks[row] = wt_table_block(table, row);
    good = good && write_dataset(w, group, STORE_BLOCK_DATASET, H5T_STD_U64LE, H5T_NATIVE_UINT64,
                                 blocks, table->n_rows, "1", "number of the block of a row");
    free(words);
    free(blocks);
    return good;
}

static bool write_hdf5_table(const store_file *w, const wt_table *table)
{
    const hid_t group = create_group(w, table->name);
    if (group < 0)
        return false;
    const bool good = write_text_attribute(w, group, STORE_TITLE_ATTRIBUTE, table->title) &&
                      write_keys(w, group, table) && write_hdf5_columns(w, group, table);
    return H5Gclose(group) >= 0 && good;
}

/* Stores the case file as one string of its length, so that it need not be UTF-8. */
static bool write_case_dataset(const store_file *w, const char *text, size_t length)
{
    const hid_t type = create_text_type(length);
    const bool good = type >= 0 && write_dataset(w, w->file, STORE_CASE_DATASET, type, type, text,
                                                 ONE_VALUE, "", "the case file, whole");
    return type >= 0 && H5Tclose(type) >= 0 && good;
}

static bool write_origin(const store_file *w, const wt_provenance *provenance,
                         const wt_table *inputs)
{
    char created[32];
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc) == NULL ||
        strftime(created, sizeof created, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
        return false;
    return write_text_attribute(w, w->file, STORE_VERSION_ATTRIBUTE, wt_version()) &&
           write_text_attribute(w, w->file, STORE_COMMAND_ATTRIBUTE,
                                wt_provenance_command(provenance)) &&
           write_text_attribute(w, w->file, STORE_CREATED_ATTRIBUTE, created) &&
           write_hdf5_table(w, inputs);
}

/* Computes the digests of all tables, the inputs and the case file. The array has space for all of
 * them. */
static wt_status compute_digests(const wt_result *result, const wt_table *inputs,
                                 char (*digests)[STORE_DIGEST_SIZE], size_t *n, wt_error *err)
{
    size_t case_length = 0;
    const char *const case_file = wt_result_case(result, &case_length);
    wt_status status = WT_OK;
    for (*n = 0; status == WT_OK && *n < wt_result_n_tables(result); ++*n)
        status = table_bytes_digest(wt_result_table(result, *n), digests[*n], err);
    if (status == WT_OK && inputs != NULL)
        status = table_bytes_digest(inputs, digests[(*n)++], err);
    if (status == WT_OK && case_file != NULL)
        wt_sha256(case_file, case_length, digests[(*n)++]);
    return status;
}

static bool write_result_objects(const store_file *w, const wt_result *result,
                                 const wt_table *inputs, char (*digests)[STORE_DIGEST_SIZE],
                                 size_t n_digests)
{
    const int format = STORE_FORMAT;
    const size_t n = wt_result_n_tables(result);
    size_t case_length = 0;
    const char *const case_file = wt_result_case(result, &case_length);
    const char **const words = wt_alloc(n_digests, sizeof *words);
    bool good = write_attribute(w->file, STORE_FORMAT_ATTRIBUTE, H5T_STD_I32LE, H5T_NATIVE_INT,
                                w->scalar, &format);
    for (size_t i = 0; good && i < n; i++)
        words[i] = wt_table_name(wt_result_table(result, i));
    good = good && write_text_list(w->file, STORE_TABLES_ATTRIBUTE, words, n);
    for (size_t i = 0; good && i < n_digests; i++)
        words[i] = digests[i];
    good = good && write_text_list(w->file, STORE_DIGESTS_ATTRIBUTE, words, n_digests);
    if (inputs != NULL)
        good = good && write_origin(w, wt_result_provenance_const(result), inputs);
    for (size_t i = 0; good && i < n; i++)
        good = write_hdf5_table(w, wt_result_table(result, i));
    if (case_file != NULL)
        good = good && write_case_dataset(w, case_file, case_length);
    free(words);
    return good;
}

/* Object headers have no times, so that the bytes depend on the content only. */
static bool set_creation_options(hid_t list)
{
    return list >= 0 && H5Pset_obj_track_times(list, false) >= 0;
}

static bool set_group_creation_options(hid_t list)
{
    return set_creation_options(list) && H5Pset_attr_phase_change(list, UINT16_MAX, 0) >= 0 &&
           H5Pset_link_phase_change(list, UINT16_MAX, 0) >= 0;
}

static void close_store_file(store_file *w)
{
    hdf5_scope scope;
    hdf5_enter(&scope);
    hdf5_close(w->file);
    hdf5_close(w->scalar);
    hdf5_close(w->group_creation);
    hdf5_close(w->dataset_creation);
    hdf5_leave(&scope);
    wt_outfile_discard(w->out);
}

static bool create_store_file(store_file *w)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    w->scalar = H5Screate(H5S_SCALAR);
    w->group_creation = H5Pcreate(H5P_GROUP_CREATE);
    w->dataset_creation = H5Pcreate(H5P_DATASET_CREATE);
    /* The layout of HDF5 1.8 has checksums of its own structures, and all versions can read it. */
    if (w->scalar >= 0 && set_group_creation_options(w->group_creation) &&
        set_creation_options(w->dataset_creation) && set_group_creation_options(creation) &&
        hdf5_bytes_set_driver(access, &w->to) &&
        H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0 &&
        H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0)
        w->file = H5Fcreate("weartrack.h5", H5F_ACC_TRUNC, creation, access);
    hdf5_close(access);
    hdf5_close(creation);
    return w->file >= 0;
}

/* Creates the error of HDF5 or of the disk. */
static wt_status write_error(const store_file *w, wt_error *err)
{
    return w->to.failed != 0
               ? wt_fail(err, WT_E_IO, "cannot write the file: %s", strerror(w->to.failed))
               : wt_fail(err, WT_E_INTERNAL, "HDF5 cannot make the file");
}

static wt_status begin_store(const char *path, store_file *w, wt_error *err)
{
    struct stat info;
    hdf5_scope scope;
    const wt_status status = wt_outfile_open(path, &w->out, err);
    if (status != WT_OK)
        return status;
    w->to.file = fileno(wt_outfile_stream(w->out));
    if (fstat(w->to.file, &info) != 0 || !S_ISREG(info.st_mode))
        return wt_fail(err, WT_E_IO, "not a regular file: HDF5 writes no pipe and no device");
    hdf5_enter(&scope);
    const bool good = create_store_file(w);
    hdf5_leave(&scope);
    return good ? WT_OK : write_error(w, err);
}

wt_status wt_store_write(const char *path, const wt_result *result, bool with_provenance,
                         wt_error *err)
{
    store_file w = {.file = -1, .scalar = -1, .group_creation = -1, .dataset_creation = -1};
    size_t n_digests = 0;
    wt_table *inputs = NULL;
    char(*const digests)[STORE_DIGEST_SIZE] =
        wt_alloc(wt_result_n_tables(result) + 2, sizeof *digests);
    wt_status status = begin_store(path, &w, err);
    if (status == WT_OK && with_provenance)
        status = wt_provenance_table(wt_result_provenance_const(result), STORE_INPUTS_TABLE,
                                     &inputs, err);
    if (status == WT_OK)
        status = compute_digests(result, inputs, digests, &n_digests, err);
    if (status == WT_OK) {
        hdf5_scope scope;
        hdf5_enter(&scope);
        bool good = write_result_objects(&w, result, inputs, digests, n_digests);
        good = H5Fclose(w.file) >= 0 && good && w.to.failed == 0;
        w.file = -1;
        hdf5_leave(&scope);
        status = good ? WT_OK : write_error(&w, err);
    }
    if (status == WT_OK) {
        status = wt_outfile_commit(w.out, err);
        w.out = NULL;
    }
    if (status != WT_OK)
        wt_error_file(err, path);
    wt_table_free(inputs);
    free(digests);
    close_store_file(&w);
    return status;
}
