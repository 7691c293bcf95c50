/* ZIP archives: complete, truncated, and with wrong sizes and numbers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "read/bytes/zip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct bytes {
    unsigned char data[4096];
    size_t n;
} bytes;

static void put(bytes *b, uint32_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        b->data[b->n++] = (unsigned char)(value >> (8 * i) & 0xff);
}

/* CRC-32 of the ZIP format, bit by bit. */
static uint32_t crc32(const char *text, size_t n)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < n; i++) {
        crc ^= (unsigned char)text[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* A stored entry; with its sizes after the data if `late`, as in files of the instrument (Java). */
static void put_entry(bytes *b, const char *name, const char *text, bool late, uint32_t size)
{
    size_t n = strlen(text);
    uint32_t crc = crc32(text, n);
    put(b, 0x04034b50, 4);
    put(b, 20, 2);
    put(b, late ? 8 : 0, 2);
    put(b, 0, 2); /* stored */
    put(b, 0x50210000, 4);
    put(b, late ? 0 : crc, 4);
    put(b, late ? 0 : (uint32_t)n, 4);
    put(b, late ? 0 : size, 4);
    put(b, (uint32_t)strlen(name), 2);
    put(b, 0, 2);
    memcpy(b->data + b->n, name, strlen(name));
    b->n += strlen(name);
    memcpy(b->data + b->n, text, n);
    b->n += n;
    if (late) {
        put(b, 0x08074b50, 4);
        put(b, crc, 4);
        put(b, (uint32_t)n, 4);
        put(b, size, 4);
    }
}

static wt_status open_bytes(const bytes *b, wt_input **input, zip_archive **archive, wt_error *err)
{
    assert_int_equal(wt_input_open_memory(b->data, b->n, "test", input, NULL), WT_OK);
    return archive_open(*input, archive, err);
}

static void assert_entry(zip_archive *a, const char *name, const char *text)
{
    byte_buffer buffer = {0};
    size_t i = 0;
    assert_true(archive_find(a, name, &i));
    assert_int_equal(archive_read(a, i, 1000, &buffer, NULL), WT_OK);
    assert_int_equal(buffer.length, strlen(text));
    assert_memory_equal(buffer.data, text, buffer.length);
    free(buffer.data);
}

/* Without a directory, truncated at every position: complete entries are read, and nothing else. */
static void truncated_anywhere(void **state)
{
    (void)state;
    bytes b = {.n = 0};
    put_entry(&b, "one", "first text", true, 10);
    size_t one = b.n;
    /* A signature inside the data does not end the entry. */
    put_entry(&b, "two", "has PK\7\10 in it and goes on", true, 26);
    size_t two = b.n;
    put_entry(&b, "three", "sizes in front", false, 14);
    size_t three = b.n;
    for (size_t n = 0; n <= three; n++) {
        bytes part = b;
        part.n = n;
        wt_input *input = NULL;
        zip_archive *archive = NULL;
        size_t complete = (size_t)(n >= one) + (size_t)(n >= two) + (size_t)(n >= three);
        wt_status status = open_bytes(&part, &input, &archive, NULL);
        assert_int_equal(status, complete > 0 ? WT_OK : WT_E_CORRUPT);
        if (complete > 0) {
            assert_string_equal(archive->defect, "the end of the archive is missing");
            assert_int_equal(archive->n, complete);
            assert_entry(archive, "one", "first text");
        }
        if (complete > 1)
            assert_entry(archive, "two", "has PK\7\10 in it and goes on");
        if (complete > 2)
            assert_entry(archive, "three", "sizes in front");
        archive_close(archive);
        wt_input_close(input);
    }
}

static void declared_sizes_are_checked(void **state)
{
    (void)state;
    static const uint32_t sizes[] = {9, 11, 0x7fffffff};
    for (size_t i = 0; i < 3; i++) {
        bytes b = {.n = 0};
        wt_input *input = NULL;
        zip_archive *archive = NULL;
        byte_buffer buffer = {0};
        wt_error err = WT_ERROR_INIT;
        put_entry(&b, "one", "first text", true, sizes[i]);
        assert_int_equal(open_bytes(&b, &input, &archive, &err), WT_OK);
        assert_int_equal(archive_read(archive, 0, SIZE_MAX, &buffer, &err), WT_E_CORRUPT);
        assert_string_equal(err.place, "one");
        archive_close(archive);
        wt_input_close(input);
        free(buffer.data);
    }
}

static void check_sum_and_limit(void **state)
{
    (void)state;
    bytes b = {.n = 0};
    wt_input *input = NULL;
    zip_archive *archive = NULL;
    byte_buffer buffer = {0};
    put_entry(&b, "one", "first text", true, 10);
    assert_int_equal(open_bytes(&b, &input, &archive, NULL), WT_OK);
    assert_int_equal(archive_read(archive, 0, 9, &buffer, NULL), WT_E_CORRUPT);
    archive_close(archive);
    wt_input_close(input);
    b.data[35] ^= 1; /* in the text */
    assert_int_equal(open_bytes(&b, &input, &archive, NULL), WT_OK);
    assert_int_equal(archive_read(archive, 0, 10, &buffer, NULL), WT_E_CORRUPT);
    archive_close(archive);
    wt_input_close(input);
    free(buffer.data);
}

/* Local header of an entry at `offset`, as written by put_entry(..., false, ...). */
static void put_record(bytes *b, const char *name, const char *text, uint32_t offset)
{
    const uint32_t n = (uint32_t)strlen(text);
    put(b, 0x02014b50, 4);
    put(b, 20, 2);
    put(b, 20, 2);
    put(b, 0, 4); /* no flags, stored */
    put(b, 0x50210000, 4);
    put(b, crc32(text, n), 4);
    put(b, n, 4);
    put(b, n, 4);
    put(b, (uint32_t)strlen(name), 2);
    put(b, 0, 4);
    put(b, 0, 4);
    put(b, 0, 4);
    put(b, offset, 4);
    memcpy(b->data + b->n, name, strlen(name));
    b->n += strlen(name);
}

static void put_end(bytes *b, uint32_t n, uint32_t size, uint32_t offset)
{
    put(b, 0x06054b50, 4);
    put(b, 0, 4);
    put(b, n, 2);
    put(b, n, 2);
    put(b, size, 4);
    put(b, offset, 4);
    put(b, 0, 2);
}

/* Two entries; the directory states n. */
static void put_two(bytes *b, uint32_t n)
{
    put_entry(b, "one", "first text", false, 10);
    const uint32_t two = (uint32_t)b->n;
    put_entry(b, "two", "second text", false, 11);
    const uint32_t directory = (uint32_t)b->n;
    put_record(b, "one", "first text", 0);
    put_record(b, "two", "second text", two);
    put_end(b, n, (uint32_t)b->n - directory, directory);
}

/* Entries beyond the number in the directory are read. */
static void number_of_entries(void **state)
{
    (void)state;
    static const uint32_t numbers[] = {2, 0, 1, 3, 60000};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        bytes b = {.n = 0};
        wt_input *input = NULL;
        zip_archive *archive = NULL;
        put_two(&b, numbers[i]);
        assert_int_equal(open_bytes(&b, &input, &archive, NULL), WT_OK);
        assert_int_equal(archive->n, 2);
        if (numbers[i] == 2)
            assert_null(archive->defect);
        else
            assert_string_equal(archive->defect, "the directory of the archive is damaged");
        assert_entry(archive, "one", "first text");
        assert_entry(archive, "two", "second text");
        archive_close(archive);
        wt_input_close(input);
    }
}

/* Programs without ZIP64 count modulo 65536. */
static void entry_count_overflow(void **state)
{
    enum { MORE = 65536 + 3 };
    (void)state;
    bytes b = {.n = 0}, record;
    wt_input *input = NULL;
    zip_archive *archive = NULL;
    put_entry(&b, "000000", "first text", false, 10);
    const size_t head = b.n, each = 46 + 6;
    unsigned char *const all = malloc(head + MORE * each + 22);
    assert_non_null(all);
    memcpy(all, b.data, head);
    for (size_t i = 0; i < MORE; i++) {
        char name[8];
        (void)snprintf(name, sizeof name, "%06zu", i);
        record.n = 0;
        put_record(&record, name, "first text", 0);
        memcpy(all + head + i * each, record.data, each);
    }
    record.n = 0;
    put_end(&record, MORE % 65536, (uint32_t)(MORE * each), (uint32_t)head);
    memcpy(all + head + MORE * each, record.data, 22);
    assert_int_equal(wt_input_open_memory(all, head + MORE * each + 22, "test", &input, NULL),
                     WT_OK);
    assert_int_equal(archive_open(input, &archive, NULL), WT_OK);
    assert_int_equal(archive->n, MORE);
    assert_null(archive->defect);
    assert_entry(archive, "000002", "first text");
    assert_entry(archive, "065538", "first text");
    archive_close(archive);
    wt_input_close(input);
    free(all);
}

/* An entry that is too large does not affect the others. */
static void a_large_entry(void **state)
{
    (void)state;
    bytes b = {.n = 0};
    wt_input *input = NULL;
    zip_archive *archive = NULL;
    byte_buffer buffer = {0};
    wt_error err = WT_ERROR_INIT;
    size_t i = 0;
    put_entry(&b, "one", "first text", false, 10);
    const uint32_t directory = (uint32_t)b.n;
    put_record(&b, "one", "first text", 0);
    const size_t record = b.n;
    put_record(&b, "big", "first text", 0);
    memset(b.data + record + 20, 0xff, 8); /* sizes are in the extra field of 20 bytes */
    b.data[record + 30] = 20;
    put(&b, 1, 2);
    put(&b, 16, 2);
    for (int k = 0; k < 2; k++) {
        put(&b, 0, 4);
        put(&b, 2, 4); /* 8 GiB */
    }
    put_end(&b, 2, (uint32_t)b.n - directory, directory);
    assert_int_equal(open_bytes(&b, &input, &archive, NULL), WT_OK);
    assert_null(archive->defect);
    assert_int_equal(archive->n, 2);
    assert_entry(archive, "one", "first text");
    assert_true(archive_find(archive, "big", &i));
    assert_int_equal(archive_read(archive, i, SIZE_MAX, &buffer, &err), WT_E_UNSUPPORTED);
    assert_string_equal(err.place, "big");
    archive_close(archive);
    wt_input_close(input);
}

/* A copy in blocks fills the last one. */
static void bytes_after_the_end(void **state)
{
    (void)state;
    bytes b = {.n = 0};
    wt_input *input = NULL;
    zip_archive *archive = NULL;
    put_two(&b, 2);
    b.n = 1024; /* zeros */
    assert_int_equal(open_bytes(&b, &input, &archive, NULL), WT_OK);
    assert_null(archive->defect);
    assert_int_equal(archive->n, 2);
    assert_entry(archive, "two", "second text");
    archive_close(archive);
    wt_input_close(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truncated_anywhere),   cmocka_unit_test(declared_sizes_are_checked),
        cmocka_unit_test(check_sum_and_limit),  cmocka_unit_test(number_of_entries),
        cmocka_unit_test(entry_count_overflow), cmocka_unit_test(a_large_entry),
        cmocka_unit_test(bytes_after_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
