/* Damages the internal structures of HDF5 files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/hdf5_damage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LENGTH = 4096, OLD_METADATA = 6000 };

static uint32_t rotate(uint32_t x, unsigned k)
{
    return x << k | x >> (32 - k);
}

static uint32_t word(const uint8_t *k, size_t n)
{
    uint32_t x = 0;
    for (size_t i = 0; i < 4 && i < n; i++)
        x |= (uint32_t)k[i] << (8 * i);
    return x;
}

/* lookup3 (Jenkins 2006, public domain), the checksum of HDF5 structures. */
static uint32_t lookup3(const uint8_t *k, size_t n)
{
    uint32_t a = 0xdeadbeef + (uint32_t)n, b = a, c = a;
    for (; n > 12; n -= 12, k += 12) {
        static const unsigned turns[] = {4, 6, 8, 16, 19, 4};
        uint32_t *const x[] = {&a, &b, &c};
        a += word(k, 4);
        b += word(k + 4, 4);
        c += word(k + 8, 4);
        for (unsigned i = 0; i < 6; i++) {
            uint32_t *const p = x[i % 3], *const q = x[(i + 1) % 3], *const r = x[(i + 2) % 3];
            *p -= *r;
            *p ^= rotate(*r, turns[i]);
            *r += *q;
        }
    }
    if (n == 0)
        return c;
    a += word(k, n);
    b += n > 4 ? word(k + 4, n - 4) : 0;
    c += n > 8 ? word(k + 8, n - 8) : 0;
    c = (c ^ b) - rotate(b, 14);
    a = (a ^ c) - rotate(c, 11);
    b = (b ^ a) - rotate(a, 25);
    c = (c ^ b) - rotate(b, 16);
    a = (a ^ c) - rotate(c, 4);
    b = (b ^ a) - rotate(a, 14);
    return (c ^ b) - rotate(b, 24);
}

/* Four capitals, or the signature of the file. */
static bool begins(const uint8_t *bytes, size_t at)
{
    if (at == 0)
        return true;
    for (size_t i = 0; i < 4; i++)
        if (bytes[at + i] < 'A' || bytes[at + i] > 'Z')
            return false;
    return true;
}

/* Structures end where a checksum matches the bytes back to a signature. A file of the first layout
 * has no checksums, and its metadata are at the start. */
void hdf5_find(const uint8_t *bytes, size_t size, hdf5_map *map)
{
    map->n = 0;
    if (size > 8 && bytes[8] < 2) {
        map->blocks[0].start = 8;
        map->blocks[0].length = (size < OLD_METADATA ? size : OLD_METADATA) - 16;
        map->blocks[0].checked = false;
        map->n = 1;
    }
    for (size_t at = 0; at + 16 < size && map->n < HDF5_BLOCKS; at++) {
        for (size_t length = 8; begins(bytes, at) && length < MAX_LENGTH; length++) {
            if (at + length + 4 > size)
                break;
            if (lookup3(bytes + at, length) == word(bytes + at + length, 4)) {
                map->blocks[map->n].start = at;
                map->blocks[map->n].length = length;
                map->blocks[map->n++].checked = true;
                break;
            }
        }
    }
}

static void put(uint8_t *to, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        to[i] = (uint8_t)(value >> (8 * i));
}

void hdf5_check(uint8_t *bytes, const hdf5_map *map)
{
    for (size_t i = 0; i < map->n; i++) {
        uint8_t *const block = bytes + map->blocks[i].start;
        if (map->blocks[i].checked)
            put(block + map->blocks[i].length, lookup3(block, map->blocks[i].length), 4);
    }
}

size_t hdf5_damage(const uint8_t *bytes, size_t size, size_t n, hdf5_use *use, void *user)
{
    static const size_t widths[] = {1, 2, 4, 8};
    hdf5_map map;
    hdf5_find(bytes, size, &map);
    uint8_t *const copy = malloc(size);
    if (copy == NULL || map.n == 0)
        abort();
    size_t places = 0;
    for (size_t i = 0; i < map.n; i++)
        places += map.blocks[i].length - 4;
    const size_t n_values = 8, all = places * n_values * 4;
    const size_t count = n < all ? n : all;
    size_t used = 0;
    for (size_t k = 0; used < n && k < 2 * count; k++) {
        /* takes every position in turn; the next pass uses other widths and values */
        const size_t number = k * (places * 32 / count) + k % 32;
        const size_t variant = (k * 7 + number) % 32;
        size_t place = number / 32 % places, i = 0;
        while (place >= map.blocks[i].length - 4)
            place -= map.blocks[i++].length - 4;
        const size_t at = map.blocks[i].start + 4 + place, width = widths[variant % 4];
        const uint64_t values[] = {0,
                                   1,
                                   0x7fffffffffffffff,
                                   UINT64_MAX,
                                   size * 997,
                                   255,
                                   (uint64_t)map.blocks[i].start,
                                   word(bytes + at, 4) + 1};
        const uint64_t value = values[variant / 4];
        if (at + width > map.blocks[i].start + map.blocks[i].length)
            continue;
        memcpy(copy, bytes, size);
        put(copy + at, value, width);
        if (memcmp(copy, bytes, size) == 0)
            continue;
        used++;
        hdf5_check(copy, &map);
        char what[128];
        (void)snprintf(what, sizeof what, "%.4s at %zu: byte %zu to %zu, value %llx",
                       (const char *)bytes + map.blocks[i].start, map.blocks[i].start, place + 4,
                       place + 3 + width, (unsigned long long)value);
        use(user, what, copy, size);
    }
    free(copy);
    return used;
}
