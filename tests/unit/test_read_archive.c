/* ZIP archives: whole, without their end, and lying about sizes.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "near.h"

#include "read/bytes/archive.h"

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

/* A stored entry; with its sizes behind the data if `late`, as the instrument's Java writes them.
 */
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

/* Without a directory, cut at every place: entries that are complete are read, nothing else. */
static void cut_anywhere(void **state)
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
            assert_true(archive->truncated);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_anywhere),
        cmocka_unit_test(declared_sizes_are_checked),
        cmocka_unit_test(check_sum_and_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
