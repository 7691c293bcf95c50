/* Converts the HDF5 file of a result to bytes, in the sandbox (hdf5_sandbox.h). The file may be
 * damaged or malicious. Types, ranks and lengths are checked before memory is allocated, and links
 * to other files are rejected. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "core/store/hdf5_sandbox.h"
#include "core/store/store.h"
#include "core/table/result_value.h"

#include <endian.h>
#include <stdlib.h>
#include <string.h>

typedef struct hdf5_reader {
    hid_t file;
    hsize_t file_size; /* upper limit for every array and text in the file */
    const char *table; /* for messages; NULL outside of tables */
    FILE *out;
    wt_status status; /* of the first failure, after which the functions below return false */
    wt_error *err;
} hdf5_reader;

static bool fail_corrupt_object(hdf5_reader *r, const char *name, const char *message)
{
    r->status = wt_fail(r->err, WT_E_CORRUPT, "%s", message);
    const bool both = r->table != NULL && name[0] != '\0';
    wt_error_place(r->err, "%s%s%s", r->table != NULL ? r->table : "", both ? "/" : "", name);
    wt_error_advice(r->err, "make the file again");
    return false;
}

static bool fail_out_of_memory(hdf5_reader *r)
{
    r->status = wt_fail(r->err, WT_E_MEMORY, "out of memory");
    return false;
}

/* An invalid name is an error of the file, not of an argument. */
static bool hdf5_accepts_name(hdf5_reader *r, wt_status status)
{
    r->status = status == WT_E_ARG ? WT_E_CORRUPT : status;
    if (status == WT_E_ARG && r->err != NULL)
        r->err->status = WT_E_CORRUPT;
    return status == WT_OK;
}

/* Copies n texts, each with up to `width` bytes of `packed`. An empty text becomes NULL. */
static void unpack_texts(const char *packed, size_t width, size_t n, char **texts)
{
    for (size_t i = 0; i < n; i++) {
        const char *const text = packed + i * width;
        const size_t length = strnlen(text, width);
        if (length > 0)
            texts[i] = wt_strndup(text, length);
    }
}

/* Reads n texts of an attribute or a data set into new copies. */
static bool read_fixed_texts(hdf5_reader *r, hid_t source, bool is_attribute, const char *name,
                             size_t n, char **texts)
{
    bool good = true;
    char *packed = NULL;
    const hid_t type = is_attribute ? H5Aget_type(source) : H5Dget_type(source);
    const size_t width = type >= 0 ? H5Tget_size(type) : 0;
    if (width == 0 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        n > r->file_size / width)
        good = fail_corrupt_object(r, name, "not text of fixed length");
    else if ((packed = try_alloc(n, width)) == NULL)
        good = fail_out_of_memory(r);
    else if ((is_attribute ? H5Aread(source, type, packed)
                           : H5Dread(source, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed)) < 0)
        good = fail_corrupt_object(r, name, "text cannot be read");
    else
        unpack_texts(packed, width, n, texts);
    free(packed);
    hdf5_close(type);
    return good;
}

/* Opens an attribute and returns its number of elements. */
static hid_t open_sized_attribute(hid_t object, const char *name, size_t *n)
{
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    const hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
    const hssize_t points = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    hdf5_close(space);
    *n = (size_t)points;
    if (points >= 0)
        return attribute;
    hdf5_close(attribute);
    return -1;
}

/* Returns the only text of an attribute, which the caller frees; NULL on failure. */
static char *read_text_attribute(hdf5_reader *r, hid_t object, const char *name)
{
    size_t n = 0;
    char *found = NULL;
    const hid_t attribute = open_sized_attribute(object, name, &n);
    const bool good = attribute < 0 || n != 1
                          ? fail_corrupt_object(r, name, "attribute missing or not one text")
                          : read_fixed_texts(r, attribute, true, name, 1, &found);
    hdf5_close(attribute);
    return good && found == NULL ? wt_strdup("") : found;
}

/* Reads a list of names. An empty list is not stored in the file. */
static bool read_name_list(hdf5_reader *r, hid_t object, const char *name, size_t max,
                           char ***words, size_t *n_words)
{
    size_t n = 0;
    if (H5Aexists(object, name) == 0)
        return true;
    const hid_t attribute = open_sized_attribute(object, name, &n);
    char **const found = attribute >= 0 && n <= max ? wt_alloc(n, sizeof *found) : NULL;
    bool good = found != NULL ? read_fixed_texts(r, attribute, true, name, n, found)
                              : fail_corrupt_object(r, name, "not a list of names");
    for (size_t i = 0; good && i < n; i++)
        good = found[i] != NULL || fail_corrupt_object(r, name, "an empty name");
    hdf5_close(attribute);
    if (good) {
        *words = found;
        *n_words = n;
    } else {
        wt_strings_free(found, found != NULL ? n : 0);
    }
    return good;
}

/* Reads an attribute with one number. If `is_text` is not NULL, it is set for an attribute of
 * another type. */
static bool read_number_attribute(hdf5_reader *r, hid_t object, const char *name, double *value,
                                  bool *is_text)
{
    size_t n = 0;
    const hid_t attribute = open_sized_attribute(object, name, &n);
    const hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
    const bool is_number = type >= 0 && H5Tget_class(type) == H5T_FLOAT;
    bool good = true;
    if (type < 0 || n != 1)
        good = fail_corrupt_object(r, name, "attribute missing or not one value");
    else if (!is_number && is_text != NULL)
        *is_text = true;
    else if (!is_number)
        good = fail_corrupt_object(r, name, "an error of a value is not a number");
    else if (H5Aread(attribute, H5T_NATIVE_DOUBLE, value) < 0)
        good = fail_corrupt_object(r, name, "attribute cannot be read");
    hdf5_close(type);
    hdf5_close(attribute);
    return good;
}

/* True if `name` in `group` is a link within this file. */
static bool is_internal_link(hid_t group, const char *name)
{
    H5L_info_t info;
    return H5Lexists(group, name, H5P_DEFAULT) > 0 &&
           H5Lget_info(group, name, &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_HARD;
}

/* Opens a group step by step; -1 if a step is missing or leads out of the file. */
static hid_t open_group(hdf5_reader *r, const char *path)
{
    char *const steps = wt_strdup(path);
    hid_t group = H5Gopen2(r->file, "/", H5P_DEFAULT);
    for (char *step = steps; group >= 0 && step != NULL;) {
        char *const slash = strchr(step, '/');
        if (slash != NULL)
            *slash = '\0';
        const hid_t inner = is_internal_link(group, step) ? H5Gopen2(group, step, H5P_DEFAULT) : -1;
        (void)H5Gclose(group);
        group = inner;
        step = slash != NULL ? slash + 1 : NULL;
    }
    free(steps);
    return group;
}

/* Opens a data set whose values are all stored in this file. */
static hid_t open_stored_dataset(const hdf5_reader *r, hid_t group, const char *name, int rank,
                                 hsize_t *n)
{
    bool good = false;
    if (!is_internal_link(group, name))
        return -1;
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
    if (dataset < 0)
        return -1;
    const hid_t creation = H5Dget_create_plist(dataset);
    const hid_t space = H5Dget_space(dataset);
    const hid_t type = H5Dget_type(dataset);
    if (creation >= 0 && space >= 0 && type >= 0 && H5Sget_simple_extent_ndims(space) == rank &&
        H5Pget_layout(creation) == H5D_CONTIGUOUS && H5Pget_external_count(creation) == 0) {
        const hssize_t points = H5Sget_simple_extent_npoints(space);
        const hsize_t size = H5Tget_size(type);
        const hsize_t stored = H5Dget_storage_size(dataset);
        good =
            points >= 0 && size > 0 && stored <= r->file_size && stored / size == (hsize_t)points;
        *n = (hsize_t)points;
    }
    hdf5_close(type);
    hdf5_close(space);
    hdf5_close(creation);
    if (good)
        return dataset;
    hdf5_close(dataset);
    return -1;
}

static bool read_estimate_key(hdf5_reader *r, hid_t group, const char *key, double value,
                              wt_table *table)
{
    char *names[KEY_PARTS] = {NULL};
    char *unit = NULL;
    wt_estimate e = {.value = value};
    table_key_part_names(key, names);
    bool good =
        read_number_attribute(r, group, names[KEY_STANDARD_ERROR], &e.standard_error, NULL) &&
        read_number_attribute(r, group, names[KEY_NUMERICAL_ERROR], &e.numerical_error, NULL) &&
        (unit = read_text_attribute(r, group, names[KEY_UNITS])) != NULL;
    e.unit = unit;
    good = good && hdf5_accepts_name(r, wt_table_set_estimate(table, key, e, r->err));
    for (size_t i = 0; i < KEY_PARTS; i++)
        free(names[i]);
    free(unit);
    return good;
}

static bool read_table_keys(hdf5_reader *r, hid_t group, wt_table *table)
{
    char **keys = NULL;
    size_t n = 0;
    bool good = read_name_list(r, group, STORE_KEYS_ATTRIBUTE, TABLE_KEYS_MAX, &keys, &n);
    for (size_t i = 0; good && i < n; i++) {
        double value;
        bool is_text = false;
        good = read_number_attribute(r, group, keys[i], &value, &is_text);
        if (good && is_text) {
            char *const text = read_text_attribute(r, group, keys[i]);
            good = text != NULL &&
                   hdf5_accepts_name(r, wt_table_set_key(table, keys[i], text, r->err));
            free(text);
        } else if (good) {
            good = read_estimate_key(r, group, keys[i], value, table);
        }
    }
    wt_strings_free(keys, n);
    return good;
}

/* Opens the data set of a column and adds the column without rows. The type of the data set decides
 * between numbers and text. */
static bool read_column(hdf5_reader *r, hid_t group, const char *name, hsize_t n_rows,
                        wt_table *table, hid_t *opened)
{
    hsize_t n = 0;
    const hid_t dataset = open_stored_dataset(r, group, name, 1, &n);
    *opened = dataset;
    if (dataset < 0 || n != n_rows)
        return fail_corrupt_object(r, name,
                                   "column missing, of another length or not stored in one piece");
    const hid_t type = H5Dget_type(dataset);
    const H5T_class_t class = H5Tget_class(type);
    char *const units = read_text_attribute(r, dataset, STORE_UNITS_ATTRIBUTE);
    char *const words =
        units != NULL ? read_text_attribute(r, dataset, STORE_LONG_NAME_ATTRIBUTE) : NULL;
    bool good = words != NULL;
    if (good && class == H5T_FLOAT)
        good = hdf5_accepts_name(r, wt_table_add_column(table, name, units, words, r->err));
    else if (good && class == H5T_STRING)
        good = hdf5_accepts_name(r, wt_table_add_text_column(table, name, words, r->err));
    else if (good)
        good = fail_corrupt_object(r, name, "a column that is neither numbers nor text");
    free(units);
    free(words);
    hdf5_close(type);
    return good;
}

/* Adds the rows and their blocks. */
static bool read_row_blocks(hdf5_reader *r, hid_t dataset, hsize_t n, wt_table *table)
{
    uint64_t *const blocks = try_alloc((size_t)n, sizeof *blocks);
    bool good = blocks != NULL || fail_out_of_memory(r);
    if (good && n > 0 &&
        H5Dread(dataset, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, blocks) < 0)
        good = fail_corrupt_object(r, STORE_BLOCK_DATASET, "blocks cannot be read");
    for (size_t row = 0; good && row < n; row++) {
        const uint64_t before = row > 0 ? blocks[row - 1] : 0;
        if (blocks[row] != before && blocks[row] != before + (row > 0))
            good = fail_corrupt_object(r, STORE_BLOCK_DATASET, "blocks are not numbered in order");
        else if (blocks[row] != before)
            wt_table_new_block(table);
        good = good && hdf5_accepts_name(r, wt_table_add_row(table, r->err));
    }
    free(blocks);
    return good;
}

static bool read_column_cells(hdf5_reader *r, hid_t dataset, table_column *column, size_t n)
{
    bool good = true;
    if (column->kind == WT_COLUMN_TEXT)
        good = read_fixed_texts(r, dataset, false, column->name, n, column->texts);
    else if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column->numbers) <
             0)
        good = fail_corrupt_object(r, column->name, "column cannot be read");
    return good;
}

/* Reads the columns, then their rows. */
static bool read_table_columns(hdf5_reader *r, hid_t group, wt_table *table)
{
    hsize_t n_rows = 0;
    char **columns = NULL;
    size_t n = 0, n_opened = 0;
    const hid_t blocks = open_stored_dataset(r, group, STORE_BLOCK_DATASET, 1, &n_rows);
    if (blocks < 0)
        return fail_corrupt_object(r, STORE_BLOCK_DATASET, "blocks missing");
    bool good = read_name_list(r, group, STORE_COLUMNS_ATTRIBUTE, TABLE_COLUMNS_MAX, &columns, &n);
    hid_t *const opened = wt_alloc(n, sizeof *opened);
    for (; good && n_opened < n; n_opened++)
        good = read_column(r, group, columns[n_opened], n_rows, table, &opened[n_opened]);
    good = good && read_row_blocks(r, blocks, n_rows, table);
    for (size_t i = 0; good && n_rows > 0 && i < n; i++)
        good = read_column_cells(r, opened[i], &table->columns[i], (size_t)n_rows);
    for (size_t i = 0; i < n_opened; i++)
        hdf5_close(opened[i]);
    free(opened);
    hdf5_close(blocks);
    wt_strings_free(columns, n);
    return good;
}

/* Returns a new table; NULL on failure. */
static wt_table *read_stored_table(hdf5_reader *r, const char *name)
{
    wt_table *table = NULL;
    r->table = name;
    const hid_t group = table_name_is_valid(name) ? open_group(r, name) : -1;
    char *const title = group >= 0 ? read_text_attribute(r, group, STORE_TITLE_ATTRIBUTE) : NULL;
    if (group < 0 && r->status == WT_OK)
        (void)fail_corrupt_object(r, "", "table missing or misnamed");
    else if (title != NULL)
        table = wt_table_new(name, title);
    if (table != NULL &&
        !(read_table_keys(r, group, table) && read_table_columns(r, group, table))) {
        wt_table_free(table);
        table = NULL;
    }
    free(title);
    hdf5_close(group);
    r->table = NULL;
    return table;
}

static bool write_stored_table(hdf5_reader *r, const char *name)
{
    wt_table *const table = read_stored_table(r, name);
    const bool good =
        table != NULL && hdf5_accepts_name(r, table_bytes_write(r->out, table, r->err));
    wt_table_free(table);
    return good;
}

static bool write_case_text(hdf5_reader *r, uint64_t *passed)
{
    hsize_t n = 0;
    bool good = false;
    char *text = NULL;
    if (H5Lexists(r->file, STORE_CASE_DATASET, H5P_DEFAULT) == 0)
        return true;
    const hid_t dataset = open_stored_dataset(r, r->file, STORE_CASE_DATASET, 0, &n);
    const hid_t type = dataset >= 0 ? H5Dget_type(dataset) : -1;
    const bool is_text =
        type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    /* not longer than the file: open_stored_dataset checks it */
    const size_t length = is_text ? H5Tget_size(type) : 0;
    if (!is_text)
        good = fail_corrupt_object(r, STORE_CASE_DATASET, "not one text of fixed length");
    else if ((text = try_alloc(length, 1)) == NULL)
        good = fail_out_of_memory(r);
    else if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0)
        good = fail_corrupt_object(r, STORE_CASE_DATASET, "cannot be read");
    else
        good = true;
    if (good)
        *passed = fwrite(text, 1, length, r->out);
    free(text);
    hdf5_close(type);
    hdf5_close(dataset);
    return good;
}

static bool check_store_format(hdf5_reader *r)
{
    int format = 0;
    size_t n = 0;
    const hid_t attribute = open_sized_attribute(r->file, STORE_FORMAT_ATTRIBUTE, &n);
    const hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
    if (type < 0 || n != 1 || H5Tget_class(type) != H5T_INTEGER ||
        H5Aread(attribute, H5T_NATIVE_INT, &format) < 0) {
        r->status = wt_fail(r->err, WT_E_FORMAT, "not a result file of weartrack");
        wt_error_expected(r->err, "the attribute \"%s\"", STORE_FORMAT_ATTRIBUTE);
    } else if (format != STORE_FORMAT_OLDEST && format != STORE_FORMAT) {
        r->status = wt_fail(r->err, WT_E_UNSUPPORTED, "result file of another version");
        wt_error_expected(r->err, "layout %d or %d", STORE_FORMAT_OLDEST, STORE_FORMAT);
        wt_error_found(r->err, "%d", format);
        wt_error_advice(
            r->err,
            "make it again from its case or from the file of the instrument, or use the weartrack "
            "that wrote it or a newer one");
    }
    hdf5_close(type);
    hdf5_close(attribute);
    return r->status == WT_OK;
}

/* Attributes and names that describe the whole file. */
typedef struct store_index {
    char **tables, **digests;
    size_t n_tables, n_digests;
    char *version, *command; /* or NULL */
} store_index;

static bool read_store_index(hdf5_reader *r, store_index *w)
{
    bool good =
        check_store_format(r) && read_name_list(r, r->file, STORE_TABLES_ATTRIBUTE,
                                                RESULT_TABLES_MAX, &w->tables, &w->n_tables);
    if (good && H5Aexists(r->file, STORE_COMMAND_ATTRIBUTE) != 0)
        good = (w->command = read_text_attribute(r, r->file, STORE_COMMAND_ATTRIBUTE)) != NULL &&
               (w->version = read_text_attribute(r, r->file, STORE_VERSION_ATTRIBUTE)) != NULL;
    good = good && read_name_list(r, r->file, STORE_DIGESTS_ATTRIBUTE, RESULT_TABLES_MAX + 2,
                                  &w->digests, &w->n_digests);
    const size_t n = w->n_tables + (w->command != NULL) +
                     (H5Lexists(r->file, STORE_CASE_DATASET, H5P_DEFAULT) > 0);
    return good &&
           (w->n_digests == n || fail_corrupt_object(r, STORE_DIGESTS_ATTRIBUTE,
                                                     "not as many digests as there are tables"));
}

static wt_status extract(hid_t file, size_t size, FILE *out, bool main_values_only, wt_error *err)
{
    hdf5_reader r = {.file = file, .file_size = size, .out = out, .err = err};
    store_index w = {.tables = NULL};
    bool good = read_store_index(&r, &w);
    store_tail tail = {.has_origin = w.command != NULL};
    for (size_t i = 0; good && i < w.n_tables; i++)
        if (!main_values_only || result_values_use(w.tables[i])) {
            good = write_stored_table(&r, w.tables[i]);
            tail.n_tables++;
        } else
            w.digests[i][0] = '\0';
    good = good && (!tail.has_origin || write_stored_table(&r, STORE_INPUTS_TABLE)) &&
           write_case_text(&r, &tail.case_length);
    if (good && tail.has_origin)
        tail.origin_length = (uint64_t)fprintf(out, "%s\n%s", w.version, w.command);
    for (size_t i = 0; good && i < w.n_digests; i++) {
        char padded[STORE_DIGEST_SIZE] = "";
        (void)snprintf(padded, sizeof padded, "%s", w.digests[i]);
        (void)fwrite(padded, sizeof padded, padded[0] != '\0', out);
    }
    const uint64_t words[] = {htole64(tail.has_origin), htole64(tail.n_tables),
                              htole64(tail.case_length), htole64(tail.origin_length)};
    if (good)
        (void)fwrite(words, sizeof words, 1, out);
    wt_strings_free(w.tables, w.n_tables);
    wt_strings_free(w.digests, w.n_digests);
    free(w.version);
    free(w.command);
    return r.status;
}

wt_status store_extract(hid_t file, size_t size, FILE *out, wt_error *err)
{
    return extract(file, size, out, false, err);
}

wt_status store_extract_main_values(hid_t file, size_t size, FILE *out, wt_error *err)
{
    return extract(file, size, out, true, err);
}
