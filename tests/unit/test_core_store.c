/* The HDF5 store: round trip, same bytes, corrupted files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/core.h"

#include <hdf5.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* HDF5 1.10 leaks an object header when it rejects a corrupted file. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

static char folder[] = "/tmp/weartrack-store-XXXXXX";
static const char case_text[] = "<?xml version=\"1.0\"?>\n<case title=\"\xC3\xBC\"/>\n";

static void path_of(const char *name, char path[256])
{
    (void)snprintf(path, 256, "%s/%s", folder, name);
}

static void add_table(wt_result *result, const char *name, size_t n_rows)
{
    wt_table *const t = wt_table_new(name, "Words with \xC2\xB5");
    assert_non_null(t);
    assert_int_equal(wt_table_add_text_column(t, "file", "name", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus", "Pa", "Young's modulus", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "count", "1", "", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "tip", "sphere", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "empty", "", NULL), WT_OK);
    for (int i = 0; i < 20; i++) {
        char key[32];
        (void)snprintf(key, sizeof key, "value%d", i);
        assert_int_equal(
            wt_table_set_estimate(t, key, (wt_estimate){i * 0.1, (double)NAN, 1e-300, "N/m"}, NULL),
            WT_OK);
    }
    for (size_t i = 0; i < n_rows; i++) {
        char text[32] = "";
        if (i % 5 != 1)
            (void)snprintf(text, sizeof text, "curve \xC2\xB5 %zu\n", i);
        if (i % 7 == 0)
            wt_table_new_block(t);
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_text(t, 0, text);
        wt_table_set_number(t, 1, i % 4 == 0 ? (double)NAN : 1e6 / (double)(i + 3));
        wt_table_set_number(t, 2, i % 4 == 1 ? -(double)INFINITY : -0.0);
    }
    assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
}

static wt_result *make_result(void)
{
    wt_result *const result = wt_result_new();
    assert_non_null(result);
    add_table(result, "indentation/track", 40);
    add_table(result, "answer", 1);
    add_table(result, "indentation/bulk", 0);
    wt_provenance *const p = wt_result_provenance(result);
    char *const argv[] = {"weartrack", "run", "a case.xml"};
    wt_provenance_set_command(p, 3, argv);
    wt_provenance_input input = {
        .path = "a case.xml", .role = WT_ROLE_CASE, .format = "weartrack-case 1", .bytes = 54321};
    wt_sha256("abc", 3, input.sha256);
    wt_provenance_add_input(p, &input);
    wt_result_set_case(result, case_text, sizeof case_text - 1);
    return result;
}

/* The text stream contains everything in a table. */
static char *text_of(const wt_table *t)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const out = open_memstream(&text, &size);
    assert_int_equal(wt_stream_write(out, t, NULL, NULL), WT_OK);
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_results_equal(const wt_result *a, const wt_result *b)
{
    size_t length_a = 0, length_b = 0;
    assert_int_equal(wt_result_n_tables(a), wt_result_n_tables(b));
    for (size_t i = 0; i < wt_result_n_tables(a); i++) {
        char *const text_a = text_of(wt_result_table(a, i));
        char *const text_b = text_of(wt_result_table(b, i));
        assert_string_equal(text_a, text_b);
        free(text_a);
        free(text_b);
    }
    const char *const case_a = wt_result_case(a, &length_a);
    const char *const case_b = wt_result_case(b, &length_b);
    assert_int_equal(length_a, length_b);
    if (length_a > 0)
        assert_memory_equal(case_a, case_b, length_a);
}

static unsigned char *read_bytes(const char *path, size_t *size)
{
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    *size = (size_t)info.st_size;
    unsigned char *const bytes = malloc(*size);
    FILE *const in = fopen(path, "rb");
    assert_true(in != NULL && bytes != NULL);
    assert_int_equal(fread(bytes, 1, *size, in), *size);
    (void)fclose(in);
    return bytes;
}

static void write_bytes(const char *path, const unsigned char *bytes, size_t size)
{
    FILE *const out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

/* A block without a row at the end is neither in the file nor in its digest. */
static void block_without_rows(void **state)
{
    (void)state;
    char path[256];
    path_of("block.h5", path);
    wt_result *const result = wt_result_new();
    wt_result *read = NULL;
    wt_table *const t = wt_table_new("blocks", "");
    assert_non_null(t);
    assert_int_equal(wt_table_add_column(t, "x", "1", "", NULL), WT_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        if (i % 2 == 1)
            wt_table_new_block(t);
    }
    assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
    assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
    assert_int_equal(wt_store_read(path, &read, NULL), WT_OK);
    assert_results_equal(result, read);
    assert_int_equal(wt_table_block(wt_result_table(read, 0), 3), 1);
    wt_result_free(read);
    wt_result_free(result);
}

/* Files of the first layout had one digest of all tables as text: refused, with advice. */
static void first_layout(void **state)
{
    (void)state;
    size_t size = 0;
    wt_result *read = NULL;
    wt_error err = WT_ERROR_INIT;
    unsigned char *const bytes = read_bytes(WT_SOURCE_DIR "/fixtures/fuzz/hdf5/layout_1.h5", &size);
    assert_int_equal(wt_store_read_memory(bytes, size, "old", &read, &err), WT_E_UNSUPPORTED);
    assert_null(read);
    assert_string_equal(err.expected, "layout 3 or 5");
    assert_string_equal(err.found, "1");
    assert_non_null(strstr(err.advice, "newer"));
    free(bytes);
}

/* End of the file as stated by HDF5. */
static size_t end_of_hdf5(const unsigned char *bytes, size_t size)
{
    uint64_t end = 0;
    assert_true(size > 36);
    assert_int_equal(bytes[8], 2);
    for (size_t i = 0; i < 8; i++)
        end |= (uint64_t)bytes[28 + i] << (8 * i);
    assert_true(end > 0 && end <= size);
    return (size_t)end;
}

static void round_trip(void **state)
{
    (void)state;
    char path[256];
    path_of("a.h5", path);
    wt_result *const result = make_result();
    wt_result *read = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_store_write(path, result, true, &err), WT_OK);
    const wt_status status = wt_store_read(path, &read, &err);
    if (status != WT_OK)
        print_error("%s %s\n", err.place, err.message);
    assert_int_equal(status, WT_OK);
    assert_results_equal(result, read);
    const wt_provenance *const p = wt_result_provenance_const(read);
    assert_string_equal(wt_provenance_command(p), "weartrack run 'a case.xml'");
    assert_int_equal(wt_provenance_n_inputs(p), 1);
    const wt_provenance_input *const input = wt_provenance_get_input(p, 0);
    assert_string_equal(input->path, "a case.xml");
    assert_int_equal(input->role, WT_ROLE_CASE);
    assert_string_equal(wt_provenance_input_role(input), "case");
    assert_string_equal(input->format, "weartrack-case 1");
    assert_int_equal(input->bytes, 54321);
    assert_int_equal(strlen(input->sha256), 64);
    wt_result_free(read);
    wt_result_free(result);
}

static void same_bytes(void **state)
{
    (void)state;
    char path_a[256], path_b[256];
    size_t size_a = 0, size_b = 0;
    path_of("a.h5", path_a);
    path_of("b.h5", path_b);
    wt_result *const result = make_result();
    assert_int_equal(wt_store_write(path_a, result, false, NULL), WT_OK);
    (void)sleep(1); /* times in HDF5 count seconds */
    assert_int_equal(wt_store_write(path_b, result, false, NULL), WT_OK);
    unsigned char *const a = read_bytes(path_a, &size_a);
    unsigned char *const b = read_bytes(path_b, &size_b);
    assert_int_equal(size_a, size_b);
    assert_memory_equal(a, b, size_a);
    wt_result *read = NULL;
    assert_int_equal(wt_store_read(path_a, &read, NULL), WT_OK);
    assert_string_equal(wt_provenance_command(wt_result_provenance(read)), "");
    assert_int_equal(wt_provenance_n_inputs(wt_result_provenance(read)), 0);
    wt_result_free(read);
    wt_result_free(result);
    free(a);
    free(b);
}

/* The stated length of the file (HDF5 File Format Specification, superblock version 2: bytes 28 to
 * 35) is its length. */
static void length_is_right(void **state)
{
    (void)state;
    char path[256];
    path_of("a.h5", path);
    for (size_t n_rows = 0; n_rows < 2000; n_rows = n_rows * 3 + 1) {
        wt_result *const result = wt_result_new();
        wt_result *read = NULL;
        size_t size = 0;
        add_table(result, "one", n_rows);
        assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
        unsigned char *const bytes = read_bytes(path, &size);
        assert_int_equal(end_of_hdf5(bytes, size), size);
        assert_int_equal(wt_store_read(path, &read, NULL), WT_OK);
        assert_results_equal(result, read);
        free(bytes);
        wt_result_free(read);
        wt_result_free(result);
    }
}

static void empty_result(void **state)
{
    (void)state;
    char path[256];
    path_of("empty.h5", path);
    wt_result *const result = wt_result_new();
    wt_result *read = NULL;
    assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
    assert_int_equal(wt_store_read(path, &read, NULL), WT_OK);
    assert_int_equal(wt_result_n_tables(read), 0);
    assert_null(wt_result_case(read, NULL));
    wt_result_free(read);
    wt_result_free(result);
}

/* Other programs see SI units and texts on every column. */
static void layout_for_other_programs(void **state)
{
    (void)state;
    char path[256];
    path_of("a.h5", path);
    wt_result *const result = make_result();
    assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    static const char *const columns[] = {"file", "modulus", "count", "block"};
    for (size_t i = 0; i < 4; i++) {
        char name[64];
        (void)snprintf(name, sizeof name, "/indentation/track/%s", columns[i]);
        const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
        assert_true(dataset >= 0);
        assert_true(H5Aexists(dataset, "units") > 0);
        assert_true(H5Aexists(dataset, "long_name") > 0);
        (void)H5Dclose(dataset);
    }
    double value = 0;
    const hid_t key =
        H5Aopen_by_name(file, "/answer", "value3_numerical_error", H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Aread(key, H5T_NATIVE_DOUBLE, &value) >= 0);
    assert_near(value, 1e-300, 0);
    (void)H5Aclose(key);
    (void)H5Fclose(file);
    wt_result_free(result);
}

static void check_refused(const char *path, wt_status expected)
{
    wt_result *read = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_store_read(path, &read, &err), expected);
    assert_int_equal(err.status, expected);
    assert_null(read);
    assert_string_equal(err.file, path);
}

static void not_a_store(void **state)
{
    (void)state;
    char path[256];
    path_of("absent.h5", path);
    check_refused(path, WT_E_NOT_FOUND);
    check_refused(folder, WT_E_IO);
    path_of("text.h5", path);
    write_bytes(path, (const unsigned char *)"no HDF5 at all", 14);
    check_refused(path, WT_E_FORMAT);
    path_of("other.h5", path);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(file >= 0 && H5Fclose(file) >= 0);
    check_refused(path, WT_E_FORMAT);
}

static void truncated_files(void **state)
{
    (void)state;
    char path[256], cut_path[256];
    size_t size = 0;
    path_of("a.h5", path);
    path_of("cut.h5", cut_path);
    wt_result *const result = make_result();
    assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
    unsigned char *const bytes = read_bytes(path, &size);
    for (size_t cut = 0; cut < size; cut += 997) {
        write_bytes(cut_path, bytes, cut);
        wt_result *read = NULL;
        assert_int_not_equal(wt_store_read(cut_path, &read, NULL), WT_OK);
        assert_null(read);
    }
    free(bytes);
    wt_result_free(result);
}

/* A flipped bit may be undetected only if it changes nothing. */
static void flipped_values(void **state)
{
    (void)state;
    char path[256], flipped_path[256];
    size_t size = 0, found = 0;
    path_of("a.h5", path);
    path_of("flipped.h5", flipped_path);
    wt_result *const result = make_result();
    assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
    unsigned char *const bytes = read_bytes(path, &size);
    const size_t end = end_of_hdf5(bytes, size);
    const double value = 1e6 / 4.0; /* the modulus of row 1 */
    for (size_t i = 0; i + sizeof value <= end; i++) {
        if (memcmp(bytes + i, &value, sizeof value) != 0)
            continue;
        found++;
        bytes[i + 5] ^= 1;
        write_bytes(flipped_path, bytes, size);
        check_refused(flipped_path, WT_E_CORRUPT);
        bytes[i + 5] ^= 1;
    }
    assert_true(found > 0);
    static const unsigned char word[] = "Young's modulus";
    for (size_t i = 0; i + sizeof word <= end; i++) {
        if (memcmp(bytes + i, word, sizeof word - 1) == 0) {
            bytes[i] ^= 1;
            write_bytes(flipped_path, bytes, size);
            check_refused(flipped_path, WT_E_CORRUPT);
            bytes[i] ^= 1;
        }
    }
    free(bytes);
    wt_result_free(result);
}

/* A link to another file is not followed. */
static void external_links(void **state)
{
    (void)state;
    char path[256], linked[256];
    path_of("a.h5", path);
    path_of("linked.h5", linked);
    wt_result *const result = make_result();
    assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
    assert_int_equal(wt_store_write(linked, result, false, NULL), WT_OK);
    hid_t file = H5Fopen(linked, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, "answer", H5P_DEFAULT) >= 0);
    assert_true(H5Lcreate_external("a.h5", "/answer", file, "answer", H5P_DEFAULT, H5P_DEFAULT) >=
                0);
    assert_true(H5Fclose(file) >= 0);
    check_refused(linked, WT_E_CORRUPT);
    wt_result_free(result);
}

/* Blocks begin with 0, also in a table of one row. */
static void unexpected_block(void **state)
{
    (void)state;
    char path[256];
    path_of("block.h5", path);
    wt_table *const t = wt_table_new("one", "");
    wt_result *const result = wt_result_new();
    const uint64_t five = 5;
    assert_true(t != NULL && result != NULL);
    assert_int_equal(wt_table_add_column(t, "x", "1", "", NULL), WT_OK);
    assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
    wt_table_set_number(t, 0, 1);
    assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
    assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT),
                block = H5Dopen2(file, "one/block", H5P_DEFAULT);
    assert_true(H5Dwrite(block, H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &five) >= 0);
    assert_true(H5Dclose(block) >= 0 && H5Fclose(file) >= 0);
    check_refused(path, WT_E_CORRUPT);
    wt_result_free(result);
}

/* Replaces the column "modulus" of the table. */
static void replace_column(const char *path, const wt_result *result, hid_t type, hsize_t n,
                           bool chunked)
{
    assert_int_equal(wt_store_write(path, result, false, NULL), WT_OK);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, "answer/modulus", H5P_DEFAULT) >= 0);
    const hid_t space = H5Screate_simple(1, &n, NULL);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (chunked)
        assert_true(H5Pset_chunk(creation, 1, &n) >= 0);
    const hid_t dataset =
        H5Dcreate2(file, "answer/modulus", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    assert_true(dataset >= 0);
    (void)H5Dclose(dataset);
    (void)H5Pclose(creation);
    (void)H5Sclose(space);
    (void)H5Fclose(file);
}

static void unexpected_columns(void **state)
{
    (void)state;
    char path[256];
    path_of("odd.h5", path);
    wt_result *const result = make_result();
    replace_column(path, result, H5T_IEEE_F64LE, 1, false); /* without its attributes */
    check_refused(path, WT_E_CORRUPT);
    replace_column(path, result, H5T_IEEE_F64LE, (hsize_t)1 << 50, false); /* a petabyte */
    check_refused(path, WT_E_CORRUPT);
    replace_column(path, result, H5T_IEEE_F64LE, 1, true);
    check_refused(path, WT_E_CORRUPT);
    replace_column(path, result, H5T_STD_I32LE, 1, false);
    check_refused(path, WT_E_CORRUPT);
    replace_column(path, result, H5T_IEEE_F64LE, 2, false); /* another length */
    check_refused(path, WT_E_CORRUPT);
    wt_result_free(result);
}

static void cannot_write(void **state)
{
    (void)state;
    wt_result *const result = make_result();
    wt_error err = WT_ERROR_INIT;
    char path[256];
    path_of("no/such/folder.h5", path);
    assert_int_equal(wt_store_write(path, result, false, &err), WT_E_IO);
    assert_string_equal(err.file, path);
    if (access("/dev/full", W_OK) == 0)
        assert_int_equal(wt_store_write("/dev/full", result, false, &err), WT_E_IO);
    /* Like a full disk. */
    struct rlimit before, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 4096;
    (void)signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    path_of("full.h5", path);
    const wt_status status = wt_store_write(path, result, false, &err);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, WT_E_IO);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(wt_store_write(path, result, false, &err), WT_OK);
    wt_result_free(result);
}

static void names_that_collide(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "answer", "answer/more", "indentation", "case", "provenance",
        "a//b",   "/a",          "A",           "",     "provenance/inputs"};
    wt_result *const result = make_result();
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        wt_table *const t = wt_table_new(bad[i], "");
        assert_int_equal(wt_result_add(result, t, NULL), WT_E_ARG);
    }
    assert_int_equal(wt_result_n_tables(result), 3);
    assert_non_null(wt_result_find(result, "answer"));
    assert_null(wt_result_find(result, "indentation"));
    wt_result_free(result);
}

static int make_folder(void **state)
{
    (void)state;
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char **paths = NULL;
    size_t n = 0;
    if (wt_glob(NULL, folder, &paths, &n, NULL) != WT_OK)
        return -1;
    for (size_t i = 0; i < n; i++)
        (void)unlink(paths[i]);
    wt_strings_free(paths, n);
    return rmdir(folder); /* fails if a temporary file is left */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),
        cmocka_unit_test(same_bytes),
        cmocka_unit_test(length_is_right),
        cmocka_unit_test(empty_result),
        cmocka_unit_test(layout_for_other_programs),
        cmocka_unit_test(not_a_store),
        cmocka_unit_test(truncated_files),
        cmocka_unit_test(flipped_values),
        cmocka_unit_test(external_links),
        cmocka_unit_test(unexpected_block),
        cmocka_unit_test(unexpected_columns),
        cmocka_unit_test(cannot_write),
        cmocka_unit_test(names_that_collide),
        cmocka_unit_test(block_without_rows),
        cmocka_unit_test(first_layout),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
