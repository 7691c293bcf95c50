/* Rebuilds the directory of a ZIP archive whose end is missing, from the headers before each
 * entry. Layout: APPNOTE.TXT of the ZIP format, sections 4.3.7 to 4.3.16.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/bytes.h"
#include "read/bytes/zip.h"

#include <stdlib.h>
#include <string.h>

#define LOCAL_SIZE ((size_t)30)
#define CENTRAL_SIZE ((size_t)46)
#define DESCRIPTOR_SIZE ((size_t)16)
#define FLAG_DESCRIPTOR 8u

/* A complete entry. */
typedef struct local_entry {
    const unsigned char *header;
    const unsigned char *name;
    size_t name_length;
    uint32_t crc, packed, size;
    size_t end; /* offset at which the next header is expected */
} local_entry;

/* Finds the data descriptor of an entry whose sizes were unknown when its header was written. It
 * follows the data after a signature. The match is the one whose packed size equals its distance
 * from the start of the data. */
static bool find_data_descriptor(const unsigned char *bytes, size_t length, size_t start,
                                 local_entry *e)
{
    static const unsigned char signature[] = {'P', 'K', 7, 8};
    size_t at = start;
    while (at < length) {
        const unsigned char *hit = memmem(bytes + at, length - at, signature, sizeof signature);
        if (hit == NULL)
            return false;
        size_t position = (size_t)(hit - bytes);
        if (length - position < DESCRIPTOR_SIZE)
            return false;
        if (le32(hit + 8) == position - start) {
            e->crc = le32(hit + 4);
            e->packed = le32(hit + 8);
            e->size = le32(hit + 12);
            e->end = position + DESCRIPTOR_SIZE;
            return true;
        }
        at = position + 1;
    }
    return false;
}

static bool read_local_entry(const unsigned char *bytes, size_t length, size_t at, local_entry *e)
{
    static const unsigned char signature[] = {'P', 'K', 3, 4};
    if (length - at < LOCAL_SIZE || memcmp(bytes + at, signature, sizeof signature) != 0)
        return false;
    const unsigned char *h = bytes + at;
    size_t name_length = le16(h + 26);
    size_t start = LOCAL_SIZE + name_length + le16(h + 28);
    if (length - at < start)
        return false;
    start += at;
    *e = (local_entry){.header = h, .name = h + LOCAL_SIZE, .name_length = name_length};
    if ((le16(h + 6) & FLAG_DESCRIPTOR) != 0)
        return find_data_descriptor(bytes, length, start, e);
    e->crc = le32(h + 14);
    e->packed = le32(h + 18);
    e->size = le32(h + 22);
    if (e->packed > length - start)
        return false;
    e->end = start + e->packed;
    return true;
}

static unsigned char *write_le16(unsigned char *at, uint32_t value)
{
    at[0] = (unsigned char)(value & 0xff);
    at[1] = (unsigned char)(value >> 8 & 0xff);
    return at + 2;
}

static unsigned char *write_le32(unsigned char *at, uint32_t value)
{
    return write_le16(write_le16(at, value & 0xffff), value >> 16);
}

static unsigned char *write_central_record(unsigned char *at, const local_entry *e, size_t offset)
{
    const unsigned char *h = e->header;
    at = write_le32(at, 0x02014b50);
    at = write_le16(at, 20); /* created by version 2.0 */
    memcpy(at, h + 4, 10);   /* needed version, flags, method, time, date */
    at = write_le32(at + 10, e->crc);
    at = write_le32(at, e->packed);
    at = write_le32(at, e->size);
    at = write_le16(at, (uint32_t)e->name_length);
    memset(at, 0, 12); /* no extra field, no comment, first disk, no attributes */
    at = write_le32(at + 12, (uint32_t)offset);
    memcpy(at, e->name, e->name_length);
    return at + e->name_length;
}

wt_status archive_rebuild_directory(const unsigned char *bytes, size_t length,
                                    unsigned char **directory, uint64_t *directory_length,
                                    uint64_t *n, wt_error *err)
{
    local_entry e;
    size_t count = 0, at = 0, size = 0;
    /* Offsets above 32 bits would need an extra field in each entry, so the search stops there. */
    while (at < UINT32_MAX && read_local_entry(bytes, length, at, &e)) {
        size += CENTRAL_SIZE + e.name_length;
        count++;
        at = e.end;
    }
    *n = count;
    if (count == 0)
        return WT_OK;
    unsigned char *out = malloc(size);
    if (out == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the directory of the archive");
    unsigned char *to = out;
    at = 0;
    for (size_t i = 0; i < count && read_local_entry(bytes, length, at, &e); i++) {
        to = write_central_record(to, &e, at);
        at = e.end;
    }
    *directory = out;
    *directory_length = size;
    return WT_OK;
}
