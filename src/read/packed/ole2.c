/* Reads compound files. A stream is a chain of sectors; a table (FAT) contains the successor of
 * each sector. Every number of the file is checked where it is used. A chain has no more steps than
 * the file has sectors. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/bytes.h"
#include "read/packed/packed.h"

#include <stdlib.h>
#include <string.h>

/* Offsets in the header and in a directory entry; [MS-CFB] 2.2 and 2.6. */
enum {
    HEADER = 512,
    HEADER_SHIFT = 30,
    HEADER_SMALL_SHIFT = 32,
    HEADER_FOLDER = 48,
    HEADER_SMALL_MOST = 56,
    HEADER_SMALL_TABLE = 60,
    HEADER_MORE = 68,
    HEADER_TABLE = 76,
    IN_HEADER = (HEADER - HEADER_TABLE) / 4,
    ENTRY = 128,
    ENTRY_NAME_LENGTH = 64,
    ENTRY_KIND = 66,
    ENTRY_LEFT = 68,
    ENTRY_RIGHT = 72,
    ENTRY_CHILD = 76,
    ENTRY_START = 116,
    ENTRY_SIZE = 120,
    KIND_STREAM = 2,
    SMALL_SHIFT = 6
};
/* Larger sector numbers are marks, such as the end of a chain or a free sector. */
#define LAST_SECTOR 0xFFFFFFFAu

typedef struct compound {
    const unsigned char *bytes;
    size_t length, sector, n_sectors;
    uint32_t *table; /* [n_table] sectors of the sector table */
    size_t n_table;
    unsigned char *folder, *small, *small_table;
    size_t folder_length, small_length, small_table_length;
} compound;

bool compound_is_file(const unsigned char *bytes, size_t length)
{
    static const unsigned char signature[8] = {0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1};
    return length >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

static wt_status fail_compound(wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "the file is damaged or its end is missing");
    wt_error_found(err, "an old Excel or Word file; a chain of its sectors leads out of it");
    wt_error_advice(err, "copy the file again; or save it as .xlsx, CSV or text");
    return WT_E_CORRUPT;
}

/* Returns the bytes of a sector; the last sector may be short. NULL if there are none. */
static const unsigned char *sector_bytes(const compound *c, uint32_t i, size_t *n)
{
    if (i >= c->n_sectors)
        return NULL;
    const size_t at = (i + (size_t)1) * c->sector, left = c->length - at;
    *n = left < c->sector ? left : c->sector;
    return c->bytes + at;
}

/* Reads the successor of a sector; false if the file does not contain it. */
static bool next_sector(const compound *c, uint32_t i, uint32_t *next)
{
    const size_t per = c->sector / 4, place = 4 * (i % per);
    size_t n = 0;
    const unsigned char *at = i / per < c->n_table ? sector_bytes(c, c->table[i / per], &n) : NULL;
    if (at == NULL || place + 4 > n)
        return false;
    *next = le32(at + place);
    return true;
}

/* Finds the sectors of the table: the first ones in the header, the others in a chain. */
static wt_status read_sector_table(compound *c, wt_error *err)
{
    const size_t per = c->sector / 4 - 1;
    uint32_t more = le32(c->bytes + HEADER_MORE);
    c->table = wt_alloc(c->n_sectors + IN_HEADER, sizeof *c->table);
    for (size_t i = 0; i < IN_HEADER; i++) {
        const uint32_t sector = le32(c->bytes + HEADER_TABLE + 4 * i);
        if (sector > LAST_SECTOR)
            return WT_OK;
        c->table[c->n_table++] = sector;
    }
    while (more <= LAST_SECTOR) {
        size_t n = 0;
        const unsigned char *at = sector_bytes(c, more, &n);
        if (at == NULL || n < c->sector)
            return fail_compound(err);
        for (size_t i = 0; i < per; i++) {
            const uint32_t sector = le32(at + 4 * i);
            if (sector > LAST_SECTOR)
                return WT_OK;
            if (c->n_table >= c->n_sectors)
                return fail_compound(err);
            c->table[c->n_table++] = sector;
        }
        more = le32(at + 4 * per);
    }
    return WT_OK;
}

/* Reads a chain up to a maximum length, or all of it (SIZE_MAX). The caller frees *chain. */
static wt_status read_chain(const compound *c, uint32_t sector, size_t max_length,
                            unsigned char **chain, size_t *n, wt_error *err)
{
    const size_t limit = max_length < c->length ? max_length : c->length;
    size_t used = 0, steps = 0;
    unsigned char *to = wt_alloc(limit, 1);
    bool good = true;
    while (good && used < max_length && sector <= LAST_SECTOR) {
        size_t length = 0;
        const unsigned char *at = sector_bytes(c, sector, &length);
        good = at != NULL && steps++ < c->n_sectors;
        if (!good)
            break;
        const size_t step_size = length < limit - used ? length : limit - used;
        memcpy(to + used, at, step_size);
        used += step_size;
        if (used < max_length)
            good = length == c->sector && next_sector(c, sector, &sector);
    }
    good = good && (max_length == SIZE_MAX || used == max_length);
    *n = used;
    if (good) {
        *chain = to;
        return WT_OK;
    }
    free(to);
    return fail_compound(err);
}

/* Reads a stream of small sectors, which are in the stream of the root. */
static wt_status read_small_chain(const compound *c, uint32_t sector, size_t max_length,
                                  unsigned char **chain, size_t *n, wt_error *err)
{
    const size_t unit = (size_t)1 << SMALL_SHIFT;
    if (max_length > c->small_length)
        return fail_compound(err);
    unsigned char *to = wt_alloc(max_length, 1);
    size_t used = 0;
    while (used < max_length) {
        const size_t left = max_length - used, step_size = left < unit ? left : unit;
        if (sector > c->small_length / unit || sector * unit + step_size > c->small_length)
            break;
        memcpy(to + used, c->small + sector * unit, step_size);
        used += step_size;
        if (used < max_length && 4 * ((size_t)sector + 1) > c->small_table_length)
            break;
        if (used < max_length)
            sector = le32(c->small_table + 4 * (size_t)sector);
    }
    *n = used;
    if (used == max_length) {
        *chain = to;
        return WT_OK;
    }
    free(to);
    return fail_compound(err);
}

static const unsigned char *folder_entry(const compound *c, uint32_t i)
{
    return i < c->folder_length / ENTRY ? c->folder + i * (size_t)ENTRY : NULL;
}

/* True if the entry has this name. Names are UTF-16LE and end with a zero, which the length
 * includes. */
static bool entry_has_name(const unsigned char *entry, const char *name)
{
    const size_t n = strlen(name);
    if (le16(entry + ENTRY_NAME_LENGTH) != 2 * (n + 1))
        return false;
    for (size_t i = 0; i < n; i++) {
        const uint16_t letter = le16(entry + 2 * i);
        const uint16_t wanted = (uint16_t)(unsigned char)name[i];
        const uint16_t other = letter >= 'A' && letter <= 'Z' ? letter + ('a' - 'A') : letter;
        const uint16_t lower = wanted >= 'A' && wanted <= 'Z' ? wanted + ('a' - 'A') : wanted;
        if (other != lower)
            return false;
    }
    return true;
}

/* Finds a stream of the root folder, whose entries are a tree. Subfolders are skipped, since an
 * embedded object has streams with the same names. NULL if there is none. */
static const unsigned char *find_stream_entry(const compound *c, const char *name)
{
    const size_t n = c->folder_length / ENTRY;
    uint32_t *waiting = wt_alloc(n, sizeof *waiting);
    bool *seen = wt_alloc(n, sizeof *seen);
    const unsigned char *found = NULL;
    size_t n_waiting = 0;
    if (n > 0 && le32(c->folder + ENTRY_CHILD) < n) {
        waiting[n_waiting++] = le32(c->folder + ENTRY_CHILD);
        seen[waiting[0]] = true;
    }
    while (n_waiting > 0 && found == NULL) {
        const unsigned char *entry = folder_entry(c, waiting[--n_waiting]);
        if (entry[ENTRY_KIND] == KIND_STREAM && entry_has_name(entry, name))
            found = entry;
        for (size_t side = ENTRY_LEFT; side <= ENTRY_RIGHT; side += ENTRY_RIGHT - ENTRY_LEFT) {
            const uint32_t i = le32(entry + side);
            if (i >= n || seen[i])
                continue;
            seen[i] = true;
            waiting[n_waiting++] = i;
        }
    }
    free(seen);
    free(waiting);
    return found;
}

/* Returns the size of a stream. Version 3 has undefined bytes in the upper half. */
static size_t entry_size(const compound *c, const unsigned char *entry)
{
    const uint64_t size = le64(entry + ENTRY_SIZE);
    const uint64_t stated = c->sector == HEADER ? size & 0xFFFFFFFFu : size;
    return stated < SIZE_MAX ? (size_t)stated : SIZE_MAX - 1;
}

static wt_status read_entry_stream(compound *c, const unsigned char *entry, unsigned char **stream,
                                   size_t *n, wt_error *err)
{
    const size_t size = entry_size(c, entry);
    const uint32_t start = le32(entry + ENTRY_START);
    if (size >= le32(c->bytes + HEADER_SMALL_MOST))
        return read_chain(c, start, size, stream, n, err);
    wt_status status = read_chain(c, le32(c->folder + ENTRY_START), entry_size(c, c->folder),
                                  &c->small, &c->small_length, err);
    if (status == WT_OK)
        status = read_chain(c, le32(c->bytes + HEADER_SMALL_TABLE), SIZE_MAX, &c->small_table,
                            &c->small_table_length, err);
    return status == WT_OK ? read_small_chain(c, start, size, stream, n, err) : status;
}

wt_status compound_read_stream(const unsigned char *bytes, size_t length, const char *const *names,
                               size_t n_names, unsigned char **stream, size_t *n, wt_error *err)
{
    compound c = {.bytes = bytes, .length = length};
    const unsigned char *entry = NULL;
    if (length < HEADER)
        return fail_compound(err);
    const unsigned shift = le16(bytes + HEADER_SHIFT);
    if ((shift != 9 && shift != 12) || le16(bytes + HEADER_SMALL_SHIFT) != SMALL_SHIFT)
        return fail_compound(err);
    c.sector = (size_t)1 << shift;
    c.n_sectors = length > c.sector ? (length - c.sector + c.sector - 1) / c.sector : 0;
    wt_status status = read_sector_table(&c, err);
    if (status == WT_OK)
        status =
            read_chain(&c, le32(bytes + HEADER_FOLDER), SIZE_MAX, &c.folder, &c.folder_length, err);
    for (size_t i = 0; i < n_names && status == WT_OK && entry == NULL; i++)
        entry = find_stream_entry(&c, names[i]);
    if (status == WT_OK)
        status = entry != NULL ? read_entry_stream(&c, entry, stream, n, err) : WT_E_NOT_FOUND;
    free(c.small_table);
    free(c.small);
    free(c.folder);
    free(c.table);
    return status;
}
