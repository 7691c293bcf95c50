/* Packs any bytes into a ZIP archive. Checksums would reject nearly every change of a finished
 * archive. The bytes are therefore a list of entries: 0x1e separates name and content, 0x1f
 * separates entries. The archive has no central directory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_FUZZ_PACK_LIST_H
#define TESTS_FUZZ_PACK_LIST_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static inline uint32_t crc32(const uint8_t *bytes, size_t n)
{
    uint32_t table[16], crc = 0xffffffff;
    for (uint32_t i = 0; i < 16; i++) {
        uint32_t c = i;
        for (int bit = 0; bit < 4; bit++)
            c = c >> 1 ^ ((c & 1) != 0 ? 0xedb88320 : 0);
        table[i] = c;
    }
    for (size_t i = 0; i < n; i++) {
        crc ^= bytes[i];
        crc = crc >> 4 ^ table[crc & 15];
        crc = crc >> 4 ^ table[crc & 15];
    }
    return ~crc;
}

static inline uint8_t *put(uint8_t *to, uint32_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        *to++ = (uint8_t)(value >> (8 * i) & 0xff);
    return to;
}

static inline uint8_t *put_entry(uint8_t *to, const uint8_t *name, size_t name_length,
                                 const uint8_t *content, size_t n)
{
    to = put(to, 0x04034b50, 4);
    to = put(to, 20, 2);
    to = put(to, 0, 4); /* no flags, not compressed */
    to = put(to, 0x50210000, 4);
    to = put(to, crc32(content, n), 4);
    to = put(put(to, (uint32_t)n, 4), (uint32_t)n, 4);
    to = put(put(to, (uint32_t)name_length, 2), 0, 2);
    memcpy(to, name, name_length);
    memcpy(to + name_length, content, n);
    return to + name_length + n;
}

/* Each entry takes 30 bytes more than in the list, where a separator takes at least one. */
static inline uint8_t *pack_list(const uint8_t *data, size_t size, size_t *length)
{
    size_t entries = 1;
    for (size_t i = 0; i < size; i++)
        entries += data[i] == 0x1f;
    uint8_t *out = malloc(size + 30 * entries);
    uint8_t *to = out;
    if (out == NULL)
        abort();
    for (size_t at = 0; at < size;) {
        const uint8_t *entry = data + at;
        const uint8_t *end = memchr(entry, 0x1f, size - at);
        size_t n = end != NULL ? (size_t)(end - entry) : size - at;
        const uint8_t *middle = memchr(entry, 0x1e, n);
        size_t name_length = middle != NULL ? (size_t)(middle - entry) : 0;
        if (middle != NULL && name_length < 60000)
            to = put_entry(to, entry, name_length, middle + 1, n - name_length - 1);
        at += n + 1;
    }
    *length = (size_t)(to - out);
    return out;
}

#endif
