/* Crafted result files: each is refused with a message, or gives the undamaged data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/store/hdf5_sandbox.h"
#include "weartrack/core.h"
#include "writers/hdf5_damage.h"

#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* HDF5 1.10 leaks an object header when it rejects a corrupted file. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

/* Files of each layout, to be damaged. */
enum { DAMAGED = 600, DAMAGED_LAYOUT = 150 };

static char folder[] = "/tmp/weartrack-crafted-XXXXXX", path[64];

typedef struct tally {
    size_t read, refused, crashed, slow;
    const char *good; /* text of the tables of the undamaged file; NULL: no tables expected */
} tally;

/* ---- creation -------------------------------------------------------------------------------- */

static wt_result *make_result(void)
{
    wt_result *const result = wt_result_new();
    wt_table *const t = wt_table_new("sweep", "DMA sweep");
    assert_true(result != NULL && t != NULL);
    assert_int_equal(wt_table_add_text_column(t, "file", "name", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus", "Pa", "modulus", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "tip", "sphere", NULL), WT_OK);
    assert_int_equal(
        wt_table_set_estimate(t, "value", (wt_estimate){0.1, (double)NAN, 0, "N/m"}, NULL), WT_OK);
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_text(t, 0, "a");
        wt_table_set_number(t, 1, 1e6 + (double)i);
    }
    assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
    wt_result_set_case(result, "<case/>", 7);
    return result;
}

static char *text_of(const wt_result *result)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const out = open_memstream(&text, &size);
    for (size_t i = 0; i < wt_result_n_tables(result); i++)
        assert_int_equal(wt_stream_write(out, wt_result_table(result, i), NULL, NULL), WT_OK);
    assert_int_equal(fclose(out), 0);
    return text;
}

static uint8_t *bytes_of(size_t *size)
{
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    *size = (size_t)info.st_size;
    uint8_t *const bytes = malloc(*size);
    FILE *const in = fopen(path, "rb");
    assert_true(in != NULL && bytes != NULL);
    assert_int_equal(fread(bytes, 1, *size, in), *size);
    (void)fclose(in);
    return bytes;
}

/* ---- reading in the sandbox ------------------------------------------------------------------ */

static void try(void *user, const char *what, const uint8_t *bytes, size_t size)
{
    tally *const t = user;
    wt_result *result = NULL;
    wt_error err = WT_ERROR_INIT;
    const double start = wt_time_wall();
    const wt_status status = wt_store_read_memory(bytes, size, "made.h5", &result, &err);
    const double taken = wt_time_wall() - start;
    if (status == WT_OK) {
        char *const text = text_of(result);
        t->read++;
        if (t->good == NULL || strcmp(text, t->good) != 0)
            fail_msg("%s: read as something else", what);
        free(text);
        wt_result_free(result);
    } else {
        t->refused++;
        t->crashed += strstr(err.message, "fails on this file") != NULL;
        t->slow += strstr(err.message, "did not end") != NULL;
        if (err.message[0] == '\0' || strcmp(err.file, "made.h5") != 0 || err.status != status)
            fail_msg("%s: no message", what);
    }
    if (taken > 60.0)
        fail_msg("%s: %.0f s", what, taken);
}

static void print_tally(const char *name, const tally *t)
{
    print_message("%s: %zu read, %zu refused, of which %zu crashed HDF5 and %zu hung\n", name,
                  t->read, t->refused, t->crashed, t->slow);
}

static void damaged_results(void **state)
{
    (void)state;
    size_t size = 0;
    wt_result *const result = make_result();
    char *const good = text_of(result);
    tally t = {.good = good};
    assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
    uint8_t *const bytes = bytes_of(&size);
    try(&t, "as it is", bytes, size);
    assert_int_equal(t.read, 1);
    assert_true(hdf5_damage(bytes, size, DAMAGED, try, &t) == DAMAGED);
    print_tally("results", &t);
    assert_true(t.crashed > 0 && t.slow == 0); /* otherwise this test shows nothing */
    free(bytes);
    free(good);
    wt_result_free(result);
}

/* ---- possible contents ----------------------------------------------------------------------- */

/* Opens the group of the table, without its column "modulus". */
static hid_t open_table(hid_t *file)
{
    *file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(*file, "sweep/modulus", H5P_DEFAULT) >= 0);
    return H5Gopen2(*file, "sweep", H5P_DEFAULT);
}

/* Creates a data set in place of the column; takes ownership of type and creation list. */
static void put_column(hid_t group, hid_t type, hsize_t n, hid_t creation)
{
    const hid_t space = H5Screate_simple(1, &n, NULL);
    const hid_t dataset =
        H5Dcreate2(group, "modulus", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    assert_true(dataset >= 0 && H5Dclose(dataset) >= 0 && H5Sclose(space) >= 0);
    (void)H5Tclose(type);
    (void)H5Pclose(creation);
}

static hid_t no_list(void)
{
    return H5Pcreate(H5P_DATASET_CREATE);
}

static hid_t number(void)
{
    return H5Tcopy(H5T_IEEE_F64LE);
}

static void text_of_any_length(hid_t group)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(type, H5T_VARIABLE);
    put_column(group, type, 4, no_list());
}

static void lists_of_lists(hid_t group)
{
    hid_t type = number();
    for (int i = 0; i < 200; i++)
        type = H5Tvlen_create(type);
    put_column(group, type, 4, no_list());
}

static void deep_compound(hid_t group)
{
    hid_t type = number();
    for (int i = 0; i < 400; i++) {
        const hid_t outer = H5Tcreate(H5T_COMPOUND, H5Tget_size(type));
        (void)H5Tinsert(outer, "inner", 0, type);
        type = outer;
    }
    put_column(group, type, 4, no_list());
}

static void array_type(hid_t group)
{
    const hsize_t dimensions[] = {1000, 1000};
    put_column(group, H5Tarray_create2(H5T_IEEE_F64LE, 2, dimensions), 4, no_list());
}

static void petabyte(hid_t group)
{
    put_column(group, number(), (hsize_t)1 << 50, no_list());
}

static void unknown_filter(hid_t group)
{
    const hid_t creation = no_list();
    const hsize_t chunk = 2;
    (void)H5Pset_chunk(creation, 1, &chunk);
    (void)H5Pset_deflate(creation, 9);
    put_column(group, number(), 4, creation);
}

static void password_file(hid_t group)
{
    const hid_t creation = no_list();
    (void)H5Pset_external(creation, "/etc/passwd", 0, 32);
    put_column(group, number(), 4, creation);
}

static void password_file_as_map(hid_t group)
{
    const hid_t creation = no_list();
    const hsize_t n = 4;
    const hid_t space = H5Screate_simple(1, &n, NULL);
    (void)H5Pset_virtual(creation, space, "/etc/passwd", "x", space);
    put_column(group, number(), 4, creation);
}

static void soft_link(hid_t group)
{
    (void)H5Lcreate_soft("/sweep/file", group, "modulus", H5P_DEFAULT, H5P_DEFAULT);
}

static void link_to_itself(hid_t group)
{
    (void)H5Lcreate_soft("/sweep/modulus", group, "modulus", H5P_DEFAULT, H5P_DEFAULT);
}

static void link_outside(hid_t group)
{
    (void)H5Lcreate_external("/etc/passwd", "/x", group, "modulus", H5P_DEFAULT, H5P_DEFAULT);
}

static void circle(hid_t group)
{
    (void)H5Lcreate_hard(group, ".", group, "modulus", H5P_DEFAULT, H5P_DEFAULT);
}

static void named_type(hid_t group)
{
    const hid_t type = number();
    (void)H5Tcommit2(group, "modulus", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    (void)H5Tclose(type);
}

static void special_files(void **state)
{
    (void)state;
    static void (*const change[])(hid_t) = {
        text_of_any_length, lists_of_lists, deep_compound, array_type,
        petabyte,           unknown_filter, password_file, password_file_as_map,
        soft_link,          link_to_itself, link_outside,  circle,
        named_type};
    wt_result *const result = make_result();
    tally t = {.good = NULL};
    for (size_t i = 0; i < sizeof change / sizeof *change; i++) {
        char what[32];
        size_t size = 0;
        hid_t file = -1;
        assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
        const hid_t group = open_table(&file);
        change[i](group);
        assert_true(H5Gclose(group) >= 0 && H5Fclose(file) >= 0);
        uint8_t *const bytes = bytes_of(&size);
        (void)snprintf(what, sizeof what, "special file %zu", i);
        try(&t, what, bytes, size);
        free(bytes);
    }
    print_tally("special files", &t);
    wt_result_free(result);
}

/* ---- all layouts ----------------------------------------------------------------------------- */

/* Reads everything as readers of instrument files may: chunks, filters, links of groups. */
static herr_t visit(hid_t file, const char *name, const H5O_info_t *info, void *out)
{
    if (info->type != H5O_TYPE_DATASET)
        return 0;
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    char *const bytes = n > 0 ? calloc((size_t)n, H5Tget_size(type)) : NULL;
    if (bytes != NULL && H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes) >= 0)
        (void)fwrite(bytes, H5Tget_size(type), (size_t)n, out);
    free(bytes);
    return 0;
}

static wt_status walk(hid_t file, size_t size, FILE *out, wt_error *err)
{
    (void)size;
    if (H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, out) < 0)
        return wt_fail(err, WT_E_CORRUPT, "cannot be visited");
    return WT_OK;
}

static void try_walk(void *user, const char *what, const uint8_t *bytes, size_t size)
{
    tally *const t = user;
    const sandbox_limits limits = {(size_t)64 << 20, (size_t)1 << 20, 2, 20};
    char *answer = NULL;
    size_t length = 0;
    wt_error err = WT_ERROR_INIT;
    if (hdf5_sandbox_read(&(hdf5_bytes){.bytes = (const unsigned char *)bytes, .size = size},
                          &limits, walk, &answer, &length, &err) == WT_OK) {
        t->read++;
        free(answer);
        return;
    }
    t->refused++;
    t->crashed += strstr(err.message, "fails on this file") != NULL;
    t->slow += strstr(err.message, "did not end") != NULL;
    if (err.message[0] == '\0')
        fail_msg("%s: no message", what);
}

/* Groups, attributes and data sets in all layouts: symbol tables, B-trees and heaps of the first;
 * chunk indices and fractal heaps of the last. */
static void make_layouts(H5F_libver_t version)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = no_list();
    const hsize_t n = 64, chunk = 4, endless = H5S_UNLIMITED;
    assert_true(H5Pset_libver_bounds(access, version,
                                     version == H5F_LIBVER_EARLIEST ? H5F_LIBVER_V18 : version) >=
                0);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    const hid_t fixed = H5Screate_simple(1, &n, NULL), growing = H5Screate_simple(1, &n, &endless);
    (void)H5Pset_chunk(creation, 1, &chunk);
    (void)H5Pset_deflate(creation, 1);
    for (int i = 0; i < 12; i++) {
        char name[16];
        double values[64];
        for (int k = 0; k < 64; k++)
            values[k] = i + 0.5 * k;
        (void)snprintf(name, sizeof name, "data%d", i);
        const hid_t set = H5Dcreate2(file, name, H5T_IEEE_F64LE, i % 2 == 0 ? fixed : growing,
                                     H5P_DEFAULT, creation, H5P_DEFAULT);
        assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
        for (int k = 0; k < (i == 0 ? 12 : 1); k++) {
            (void)snprintf(name, sizeof name, "note%d", k);
            (void)H5Aclose(H5Acreate2(set, name, H5T_IEEE_F64LE, fixed, H5P_DEFAULT, H5P_DEFAULT));
        }
        (void)H5Dclose(set);
    }
    (void)H5Sclose(fixed);
    (void)H5Sclose(growing);
    (void)H5Pclose(creation);
    (void)H5Pclose(access);
    assert_true(H5Fclose(file) >= 0);
}

static void all_layouts(void **state)
{
    (void)state;
    static const H5F_libver_t versions[] = {H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST};
    for (size_t i = 0; i < 2; i++) {
        tally t = {.good = NULL};
        size_t size = 0;
        make_layouts(versions[i]);
        uint8_t *const bytes = bytes_of(&size);
        try_walk(&t, "as it is", bytes, size);
        assert_int_equal(t.read, 1);
        assert_true(hdf5_damage(bytes, size, DAMAGED_LAYOUT, try_walk, &t) == DAMAGED_LAYOUT);
        print_tally(i == 0 ? "first layout" : "last layout", &t);
        free(bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_results),
        cmocka_unit_test(special_files),
        cmocka_unit_test(all_layouts),
    };
    if (mkdtemp(folder) == NULL)
        return 1;
    (void)snprintf(path, sizeof path, "%s/a.h5", folder);
    const int failed = cmocka_run_group_tests_name("hdf5 crafted", tests, NULL, NULL);
    (void)unlink(path);
    (void)rmdir(folder);
    return failed;
}
