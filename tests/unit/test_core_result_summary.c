/* Summary of a result file: the tables of main values, read without HDF5, never older than the
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/store/store.h"

#include <endian.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char path[] = "/tmp/weartrack-abstract-XXXXXX";
enum {
    END = 16,               /* bytes after a summary: its length and mark */
    SET = STORE_DIGEST_SIZE /* its last bytes: the names of its tables */
};

static int set_up(void **state)
{
    (void)state;
    const int fd = mkstemp(path);
    return fd >= 0 ? close(fd) : -1;
}

static int clean(void **state)
{
    (void)state;
    return unlink(path);
}

static void add_table(wt_result *result, const char *name, size_t n_rows)
{
    wt_table *const t = wt_table_new(name, "some words");
    assert_non_null(t);
    assert_int_equal(wt_table_add_text_column(t, "file", "name", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus", "Pa", "Young's modulus", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "case_title", "made", NULL), WT_OK);
    assert_int_equal(
        wt_table_set_estimate(t, "modulus", (wt_estimate){1e6, 1e3, (double)NAN, "Pa"}, NULL),
        WT_OK);
    for (size_t i = 0; i < n_rows; i++) {
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_text(t, 0, "curve");
        wt_table_set_number(t, 1, 1e6 + (double)i);
    }
    assert_int_equal(wt_result_add(result, t, NULL), WT_OK);
}

/* Writes the file again and returns its size. */
static size_t write_result(void)
{
    struct stat info;
    wt_result *const result = wt_result_new();
    assert_non_null(result);
    add_table(result, "indentation/track", 40);
    add_table(result, "answer", 3);
    add_table(result, "shift_factors", 500);
    add_table(result, "notes", 7);
    assert_int_equal(wt_store_write(path, result, true, NULL), WT_OK);
    wt_result_free(result);
    assert_int_equal(stat(path, &info), 0);
    return (size_t)info.st_size;
}

static void change_byte(size_t at)
{
    FILE *const file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, (long)at, SEEK_SET), 0);
    const int is = fgetc(file);
    assert_int_equal(fseek(file, (long)at, SEEK_SET), 0);
    assert_true(fputc(is ^ 1, file) != EOF);
    assert_int_equal(fclose(file), 0);
}

static uint64_t length_of_abstract(size_t size)
{
    uint64_t length = 0;
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, (long)size - END, SEEK_SET), 0);
    assert_int_equal(fread(&length, sizeof length, 1, file), 1);
    assert_int_equal(fclose(file), 0);
    return le64toh(length);
}

/* Returns WT_END if there is none. */
static wt_status read_abstract(wt_result **read, wt_error *err)
{
    struct stat info;
    const int file = open(path, O_RDONLY);
    assert_true(file >= 0 && fstat(file, &info) == 0);
    *read = NULL;
    *err = (wt_error)WT_ERROR_INIT;
    const wt_status status = store_abstract_read(file, (size_t)info.st_size, path, read, err);
    assert_true((*read != NULL) == (status == WT_OK));
    assert_int_equal(close(file), 0);
    return status;
}

static wt_status try_abstract(wt_error *err)
{
    wt_result *read = NULL;
    const wt_status status = read_abstract(&read, err);
    wt_result_free(read);
    return status;
}

static void assert_whole(void)
{
    wt_result *read = NULL;
    assert_int_equal(wt_store_read(path, &read, NULL), WT_OK);
    assert_int_equal(wt_result_n_tables(read), 4);
    wt_result_free(read);
}

/* The tables with their keys; tables of main values with keys only have no rows. */
static void main_values_are_readable(void **state)
{
    (void)state;
    wt_result *all = NULL, *read = NULL;
    wt_error err;
    (void)write_result();
    assert_int_equal(wt_store_read(path, &all, NULL), WT_OK);
    assert_int_equal(read_abstract(&read, &err), WT_OK);
    assert_int_equal(wt_result_n_tables(read), 3);
    assert_null(wt_result_find(read, "indentation/track"));
    static const struct {
        const char *name;
        size_t n_rows;
    } expected[] = {{"answer", 0}, {"shift_factors", 0}, {"notes", 7}};
    for (size_t i = 0; i < 3; i++) {
        const wt_table *const t = wt_result_find(read, expected[i].name);
        wt_estimate e = {0};
        assert_non_null(t);
        assert_int_equal(wt_table_n_rows(t), expected[i].n_rows);
        assert_int_equal(wt_table_n_columns(t), 2);
        assert_string_equal(wt_table_key(t, "case_title"), "made");
        assert_true(wt_table_estimate(t, "modulus", &e));
        assert_true(e.value == 1e6 && e.standard_error == 1e3 && e.numerical_error != 0.0);
    }
    const wt_table *const notes = wt_result_find(read, "notes");
    const wt_table *const of_all = wt_result_find(all, "notes");
    for (size_t row = 0; row < 7; row++)
        assert_true(wt_table_number(notes, row, 1) == wt_table_number(of_all, row, 1));
    wt_result_free(read);
    wt_result_free(all);
    assert_whole();
}

/* Each changed byte is detected, or the file is read as one without a summary. Reading by HDF5 does
 * not depend on it. */
static void changed_bytes_are_detected(void **state)
{
    (void)state;
    wt_error err;
    const size_t size = write_result();
    const size_t length = (size_t)length_of_abstract(size);
    assert_true(length > 500 && length + END < size);
    for (size_t at = size - END - length; at < size; at++) {
        change_byte(at);
        const wt_status status = try_abstract(&err);
        if (status == WT_OK)
            fail_msg("byte %zu of %zu is changed and not noticed", at - (size - END - length),
                     length);
        assert_true(status == WT_END || (status == WT_E_CORRUPT && err.file[0] != '\0'));
        assert_true(status == WT_E_CORRUPT || at >= size - END - SET);
        change_byte(at);
    }
    assert_int_equal(try_abstract(&err), WT_OK);
    assert_whole();
}

/* With and without a summary the same tables have the same keys. */
static void same_as_by_hdf5(void **state)
{
    (void)state;
    const size_t size = write_result();
    wt_result *by[2] = {NULL, NULL};
    assert_int_equal(wt_store_read_main_values(path, &by[0], NULL), WT_OK);
    assert_int_equal(truncate(path, (off_t)size - 1), 0);
    assert_int_equal(wt_store_read_main_values(path, &by[1], NULL), WT_OK);
    assert_int_equal(wt_result_n_tables(by[0]), wt_result_n_tables(by[1]));
    for (size_t i = 0; i < wt_result_n_tables(by[0]); i++) {
        const wt_table *const a = wt_result_table(by[0], i), *const b = wt_result_table(by[1], i);
        assert_string_equal(wt_table_name(a), wt_table_name(b));
        assert_int_equal(wt_table_n_keys(a), wt_table_n_keys(b));
        for (size_t k = 0; k < wt_table_n_keys(a); k++) {
            const char *const key = wt_table_key_name(a, k);
            assert_string_equal(wt_table_key(a, key), wt_table_key(b, key));
        }
    }
    assert_int_equal(wt_table_n_rows(wt_result_find(by[0], "shift_factors")), 0);
    assert_int_equal(wt_table_n_rows(wt_result_find(by[1], "shift_factors")), 500);
    wt_result_free(by[0]);
    wt_result_free(by[1]);
}

/* A summary with another set of tables is not used, because missing tables would go unnoticed. */
static void other_tables(void **state)
{
    (void)state;
    wt_error err;
    wt_result *read = NULL;
    const size_t size = write_result();
    change_byte(size - END - SET);
    assert_int_equal(try_abstract(&err), WT_END);
    assert_int_equal(wt_store_read_main_values(path, &read, &err), WT_OK);
    assert_int_equal(wt_table_n_rows(wt_result_find(read, "shift_factors")), 500); /* by HDF5 */
    wt_result_free(read);
    char now[STORE_DIGEST_SIZE], again[STORE_DIGEST_SIZE];
    store_headlines_digest(now);
    store_headlines_digest(again);
    assert_string_equal(now, again);
    assert_int_equal(strlen(now), STORE_DIGEST_SIZE - 1);
}

/* A program that opens the file for writing removes the summary, even without changes. */
static void modified_file_has_no_summary(void **state)
{
    (void)state;
    wt_error err;
    const size_t size = write_result();
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const double other = 5.0;
    const hid_t column = H5Dopen2(file, "/notes/modulus", H5P_DEFAULT);
    const hsize_t first = 0, one = 1;
    const hid_t in_file = H5Dget_space(column), in_memory = H5Screate_simple(1, &one, NULL);
    assert_true(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &first, NULL, &one, NULL) >= 0);
    assert_true(H5Dwrite(column, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, &other) >= 0);
    assert_true(H5Sclose(in_file) >= 0 && H5Sclose(in_memory) >= 0 && H5Dclose(column) >= 0 &&
                H5Fclose(file) >= 0);
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_true((size_t)info.st_size < size);
    assert_int_equal(try_abstract(&err), WT_END);
    wt_result *read = NULL;
    assert_int_equal(wt_store_read(path, &read, &err), WT_E_CORRUPT); /* by its digest */
    assert_null(read);
}

static void put_count(FILE *out, uint64_t n)
{
    const uint64_t low_first = htole64(n);
    assert_int_equal(fwrite(&low_first, sizeof low_first, 1, out), 1);
}

/* Writes a file whose summary states a table of many columns with as many rows as bytes. */
static void put_bomb(size_t n_columns, size_t n_filler)
{
    char set[STORE_DIGEST_SIZE];
    FILE *const out = fopen(path, "wb");
    assert_non_null(out);
    (void)fputs("\x89HDF\r\n\x1a\n", out);
    const long from = ftell(out);
    (void)fwrite("notes\0title", 1, sizeof "notes\0title", out);
    put_count(out, 0);
    put_count(out, n_columns);
    for (size_t i = 0; i < n_columns; i++) {
        (void)fprintf(out, "c%zu%c", i, 0);
        put_count(out, 0);
        (void)fwrite("1\0", 1, sizeof "1\0", out);
    }
    put_count(out, n_filler);
    put_count(out, 0);
    for (size_t i = 0; i < n_filler; i++)
        (void)putc(0, out);
    for (size_t i = 0; i < STORE_DIGEST_SIZE; i++)
        (void)putc('0', out);
    for (int i = 0; i < 4; i++)
        put_count(out, i == 1);
    store_headlines_digest(set);
    (void)fwrite(set, sizeof set, 1, out);
    put_count(out, (uint64_t)(ftell(out) - from));
    (void)fwrite("WTABST2\n", 1, 8, out);
    assert_int_equal(fclose(out), 0);
}

/* A crafted summary is refused before it allocates memory out of proportion to its bytes: 2000
 * columns with a row for each of 100,000 bytes are 1.6 GB. */
static void memory_is_proportional_to_file(void **state)
{
    (void)state;
    wt_error err;
    put_bomb(2000, 100000);
    struct rusage before, after;
    assert_int_equal(getrusage(RUSAGE_SELF, &before), 0);
    assert_int_equal(try_abstract(&err), WT_E_CORRUPT);
    assert_non_null(strstr(err.message, "too large"));
    assert_string_equal(err.file, path);
    assert_int_equal(getrusage(RUSAGE_SELF, &after), 0);
    assert_true(after.ru_maxrss - before.ru_maxrss < 100 * 1024); /* KiB */
}

static void put_file(const void *begin, size_t n_begin, uint64_t length)
{
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(begin, 1, n_begin, file), n_begin);
    put_count(file, length);
    assert_int_equal(fwrite("WTABST2\n", 1, 8, file), 8);
    assert_int_equal(fclose(file), 0);
}

/* Invalid lengths, and a text that ends like a summary. */
static void made_files(void **state)
{
    (void)state;
    wt_error err;
    char begin[64] = "\x89HDF\r\n\x1a\n";
    static const uint64_t none[] = {0, sizeof begin + 1, UINT64_MAX, UINT64_MAX - 7, 1ull << 63};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        put_file(begin, sizeof begin, none[i]);
        assert_int_equal(try_abstract(&err), WT_END);
    }
    /* Longer than any summary, in a sparse file. */
    put_file(begin, sizeof begin, (uint64_t)1 << 40);
    FILE *const file = fopen(path, "r+b");
    const uint64_t length = htole64((uint64_t)1 << 30);
    assert_non_null(file);
    assert_int_equal(fseek(file, (long)2 << 30, SEEK_SET), 0);
    assert_int_equal(fwrite(&length, sizeof length, 1, file), 1);
    assert_int_equal(fwrite("WTABST2\n", 1, 8, file), 8);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(try_abstract(&err), WT_END);
    put_file(begin, sizeof begin, sizeof begin);
    assert_int_equal(try_abstract(&err), WT_END);
    begin[0] = '#';
    put_file(begin, sizeof begin, sizeof begin);
    /* A file that is not HDF5 is not read, whatever its end. */
    wt_result *read = NULL;
    assert_int_equal(wt_store_read_main_values(path, &read, &err), WT_E_FORMAT);
    assert_string_equal(err.file, path);
    assert_int_equal(wt_store_read_main_values("/dev/null", &read, &err), WT_E_IO);
    assert_int_equal(wt_store_read_main_values("/no/such.h5", &read, &err), WT_E_NOT_FOUND);
    assert_null(read);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(main_values_are_readable),
                                       cmocka_unit_test(changed_bytes_are_detected),
                                       cmocka_unit_test(same_as_by_hdf5),
                                       cmocka_unit_test(modified_file_has_no_summary),
                                       cmocka_unit_test(other_tables),
                                       cmocka_unit_test(memory_is_proportional_to_file),
                                       cmocka_unit_test(made_files)};
    return cmocka_run_group_tests_name("abstract of a result", tests, set_up, clean);
}
