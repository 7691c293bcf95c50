/* Reads ZIP archives and checks every size before it is used. Layout: APPNOTE.TXT of the ZIP
 * format, sections 4.3 and 4.5.3.
 *
 * Maps have half a million entries, so an entry stores only its name and its position.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/zip.h"
#include "core/base/memory.h"
#include "core/math/special.h"
#include "read/bytes/bytes.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

/* Deflate cannot pack more tightly than 1032 : 1 (zlib, "Maximum compression factor"). The slack
 * allows for entries of a few bytes. */
#define MAX_RATIO 1032u
#define RATIO_SLACK 64u

#define LOCAL_SIZE ((size_t)30)
#define CENTRAL_SIZE ((size_t)46)
#define END_SIZE ((size_t)22)
#define LOCATOR64_SIZE ((size_t)20)
#define END64_SIZE ((size_t)56)
#define COMMENT_MAX ((size_t)65535)
/* Maximum size of all names [byte]. */
#define NAMES_MAX ((1u << 30) - 1)
/* The directory is read in pieces of this size [byte]; no record is longer. */
#define DIRECTORY_PIECE ((size_t)256 * 1024)
#define FLAG_ENCRYPTED 1u
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

/* Builds the directory of the complete entries at the beginning of `bytes`, as it would follow
 * them. *n is 0 if none is complete. The caller frees *directory. */
static void archive_rebuild_directory(const unsigned char *bytes, size_t length,
                                      unsigned char **directory, uint64_t *directory_length,
                                      uint64_t *n)
{
    local_entry e;
    size_t count = 0, at = 0, size = 0;
    /* Offsets above 32 bits would need an extra field in each entry, so the search stops there. */
    while (at < UINT32_MAX && read_local_entry(bytes, length, at, &e)) {
        size += CENTRAL_SIZE + e.name_length;
        count++;
        at = e.end;
    }
    unsigned char *const out = wt_alloc(size, 1), *to = out;
    at = 0;
    for (size_t i = 0; i < count && read_local_entry(bytes, length, at, &e); i++) {
        to = write_central_record(to, &e, at);
        at = e.end;
    }
    *n = count;
    *directory = out;
    *directory_length = size;
}

enum archive_packing { STORED, DEFLATED, ENCRYPTED, UNKNOWN };

struct zip_entry {
    uint64_t offset;                 /* offset of the local header */
    uint32_t packed, size, sum;      /* size is UINT32_MAX for an entry that is too large */
    unsigned name : 30, packing : 2; /* offset in `names`; value of archive_packing */
};

/* The position of the directory. */
typedef struct zip_directory {
    wt_input *input;
    uint64_t offset, size, n;
    bool wide; /* true if n counts all records; else n has 16 bits and may overflow */
} zip_directory;

static wt_status fail_archive(wt_error *err, const char *found)
{
    (void)wt_fail(err, WT_E_CORRUPT, "the ZIP archive cannot be opened");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "copy the file again from the instrument");
    return WT_E_CORRUPT;
}

/* ---- the directory ------------------------------------------------------------------------ */

/* Reads the end record of a large archive. *d is unchanged if there is none. */
static wt_status find_end64(const zip_archive *a, size_t end, zip_directory *d, wt_error *err)
{
    unsigned char record[END64_SIZE];
    if (end < LOCATOR64_SIZE)
        return WT_OK;
    wt_status status = wt_input_copy(a->input, end - LOCATOR64_SIZE, record, LOCATOR64_SIZE, err);
    if (status != WT_OK || le32(record) != 0x07064b50)
        return status;
    const uint64_t at = le64(record + 8);
    if (at > end - LOCATOR64_SIZE || end - LOCATOR64_SIZE - at < END64_SIZE)
        return fail_archive(err, "a directory outside of the file");
    status = wt_input_copy(a->input, (size_t)at, record, END64_SIZE, err);
    if (status == WT_OK && le32(record) != 0x06064b50)
        return fail_archive(err, "no end of the directory");
    d->n = le64(record + 32);
    d->size = le64(record + 40);
    d->offset = le64(record + 48);
    d->wide = true;
    return status;
}

/* Finds the directory. WT_E_CORRUPT if the file has none, for instance because it is truncated.
 * Bytes after its end, which a block-wise copy leaves, are ignored. */
static wt_status find_directory(zip_archive *a, zip_directory *d, wt_error *err)
{
    const size_t length = a->length;
    const size_t n = length < END_SIZE + COMMENT_MAX ? length : END_SIZE + COMMENT_MAX;
    unsigned char *const last = wt_alloc(n, 1);
    wt_status status = wt_input_copy(a->input, length - n, last, n, err);
    size_t at = n < END_SIZE ? 0 : n - END_SIZE + 1;
    while (status == WT_OK && at > 0 &&
           (le32(last + at - 1) != 0x06054b50 || le16(last + at + 19) > n - (at - 1) - END_SIZE))
        at--;
    if (status == WT_OK && at == 0) {
        a->defect = "the end of the archive is missing";
        status = fail_archive(err, "no directory at its end");
    } else if (status == WT_OK) {
        const unsigned char *const end = last + at - 1;
        *d = (zip_directory){a->input, le32(end + 16), le32(end + 12), le16(end + 10), false};
        if (d->n == UINT16_MAX || d->size == UINT32_MAX || d->offset == UINT32_MAX)
            status = find_end64(a, length - n + at - 1, d, err);
    }
    free(last);
    if (status == WT_OK &&
        (d->offset > length || d->size > length - d->offset || d->n > d->size / CENTRAL_SIZE ||
         d->size / CENTRAL_SIZE > UINT32_MAX / 2))
        return fail_archive(err, "a directory outside of the file");
    return status;
}

/* Reads the sizes and offsets that exceed 32 bits from the extra field. The field contains only
 * those. */
static bool read_zip64_extra(const unsigned char *extra, size_t length, uint64_t *size,
                             uint64_t *packed, uint64_t *offset)
{
    uint64_t *const wide[] = {size, packed, offset};
    for (size_t at = 0; at + 4 <= length;) {
        const size_t n = le16(extra + at + 2);
        if (n > length - at - 4)
            return false;
        size_t used = 0;
        for (size_t i = 0; le16(extra + at) == 1 && i < 3; i++) {
            if (*wide[i] != UINT32_MAX)
                continue;
            if (n - used < sizeof(uint64_t))
                return false;
            *wide[i] = le64(extra + at + 4 + used);
            used += sizeof(uint64_t);
        }
        at += 4 + n;
    }
    return true;
}

static wt_status store_name(zip_archive *a, const unsigned char *name, size_t length, wt_error *err)
{
    /* The name ends at its first zero byte, as for every C function. */
    const size_t n = strnlen((const char *)name, length);
    if (a->names_length + n + 1 > a->names_capacity) {
        const size_t new_size = 2 * a->names_capacity + n + 4096;
        char *const names = new_size < NAMES_MAX ? realloc(a->names, new_size) : NULL;
        if (names == NULL)
            return wt_fail(err, WT_E_MEMORY, "no memory for the archive");
        a->names = names;
        a->names_capacity = new_size;
    }
    memcpy(a->names + a->names_length, name, n);
    a->names[a->names_length + n] = '\0';
    a->names_length += n + 1;
    return WT_OK;
}

static unsigned entry_packing(unsigned flags, unsigned method)
{
    return (flags & FLAG_ENCRYPTED) != 0 ? ENCRYPTED
           : method == 0                 ? STORED
           : method == 8                 ? DEFLATED
                                         : UNKNOWN;
}

static wt_status store_record(zip_archive *a, const unsigned char *r, size_t name, size_t extra,
                              wt_error *err)
{
    uint64_t size = le32(r + 24), packed = le32(r + 20), offset = le32(r + 42);
    if (!read_zip64_extra(r + CENTRAL_SIZE + name, extra, &size, &packed, &offset) ||
        offset > a->length)
        return fail_archive(err, "an entry outside of the file");
    if (size > UINT32_MAX || packed > UINT32_MAX)
        size = packed = UINT32_MAX;
    a->entries[a->n] = (zip_entry){.offset = offset,
                                   .packed = (uint32_t)packed,
                                   .size = (uint32_t)size,
                                   .sum = le32(r + 16),
                                   .name = (unsigned)a->names_length & NAMES_MAX,
                                   .packing = entry_packing(le16(r + 8), le16(r + 10)) & 3u};
    const wt_status status = store_name(a, r + CENTRAL_SIZE, name, err);
    a->n += status == WT_OK;
    return status;
}

/* True if the number of records agrees with the directory. */
static bool has_all_records(const zip_archive *a, const zip_directory *d)
{
    return d->wide ? a->n == d->n : a->n % (UINT16_MAX + 1) == d->n;
}

/* Reads all records of the directory, whatever count it states. */
static wt_status read_directory(zip_archive *a, const zip_directory *d, wt_error *err)
{
    wt_status status = WT_OK;
    uint64_t at = 0;
    bool ended = false;
    unsigned char *const piece = wt_alloc(DIRECTORY_PIECE, 1);
    a->entries = try_alloc((size_t)(d->size / CENTRAL_SIZE), sizeof *a->entries);
    if (a->entries == NULL)
        status = wt_fail(err, WT_E_MEMORY, "no memory for the archive");
    for (size_t n = 0, used = 0; status == WT_OK && !ended;) {
        const unsigned char *const r = piece + used;
        const size_t left = n - used;
        const size_t name = left >= CENTRAL_SIZE ? le16(r + 28) : 0;
        const size_t extra = left >= CENTRAL_SIZE ? le16(r + 30) : 0;
        const size_t whole =
            CENTRAL_SIZE + name + extra + (left >= CENTRAL_SIZE ? le16(r + 32) : 0);
        if (left < whole && at + n == d->size) {
            ended = true;
        } else if (left < whole) {
            at += used;
            n = d->size - at < DIRECTORY_PIECE ? (size_t)(d->size - at) : DIRECTORY_PIECE;
            used = 0;
            status = wt_input_copy(d->input, (size_t)(d->offset + at), piece, n, err);
        } else if (le32(r) != 0x02014b50) {
            ended = true; /* a signature may follow the records */
        } else {
            status = store_record(a, r, name, extra, err);
            used += whole;
        }
    }
    free(piece);
    if (status == WT_OK && !has_all_records(a, d))
        return fail_archive(err, "a directory that is damaged or cut off");
    return status;
}

/* Opens the complete entries of an archive whose end is missing. */
static wt_status rebuild_entries(zip_archive *a, wt_error *err)
{
    const unsigned char *bytes = NULL;
    unsigned char *made = NULL;
    size_t length = 0;
    zip_directory d = {.wide = true};
    wt_error ignored = WT_ERROR_INIT;
    wt_status status = wt_input_bytes(a->input, &bytes, &length, err);
    if (status == WT_OK)
        archive_rebuild_directory(bytes, length, &made, &d.size, &d.n);
    if (status == WT_OK && d.n == 0)
        status = WT_E_CORRUPT; /* the missing directory is reported already */
    if (status == WT_OK)
        status = wt_input_open_memory(made, d.size, "directory", &d.input, &ignored);
    if (status == WT_OK)
        status = read_directory(a, &d, err);
    wt_input_close(d.input);
    free(made);
    return status;
}

/* ---- names --------------------------------------------------------------------------------- */

const char *archive_name(const zip_archive *archive, size_t i)
{
    return archive->names + archive->entries[i].name;
}

/* Returns the slot of a name, or the free slot where it belongs. */
static size_t name_slot(const zip_archive *a, const char *name)
{
    uint64_t hash = a->seed, word;
    for (size_t n = strlen(name), i = 0; i < n; i += sizeof word) {
        word = 0;
        memcpy(&word, name + i, n - i < sizeof word ? n - i : sizeof word);
        hash = splitmix64(hash ^ word);
    }
    size_t at = (size_t)hash & (a->n_name_slots - 1);
    while (a->slots[at] != 0 && strcmp(archive_name(a, a->slots[at] - 1), name) != 0)
        at = (at + 1) & (a->n_name_slots - 1);
    return at;
}

static void index_names(zip_archive *a)
{
    /* A random seed: names chosen to collide would cost quadratic time. */
    if (getrandom(&a->seed, sizeof a->seed, GRND_NONBLOCK) != (ssize_t)sizeof a->seed)
        a->seed = (uint64_t)(uintptr_t)a;
    a->n_name_slots = 16;
    while (a->n_name_slots < 2 * a->n)
        a->n_name_slots *= 2;
    a->slots = wt_alloc(a->n_name_slots, sizeof *a->slots);
    for (size_t k = 0; k < a->n; k++) {
        const size_t at = name_slot(a, archive_name(a, k));
        if (a->slots[at] == 0)
            a->slots[at] = (uint32_t)k + 1; /* of equal names the first counts */
    }
}

bool archive_find(const zip_archive *archive, const char *name, size_t *i)
{
    const size_t at = name_slot(archive, name);
    if (archive->slots[at] == 0)
        return false;
    *i = archive->slots[at] - 1;
    return true;
}

/* ---- opening ------------------------------------------------------------------------------ */

wt_status archive_open(wt_input *input, zip_archive **archive, wt_error *err)
{
    zip_directory d;
    zip_archive *const a = wt_alloc(1, sizeof *a);
    a->input = input;
    wt_status status = window_open(&a->window, input, err);
    a->length = a->window.size;
    if (status == WT_OK)
        status = find_directory(a, &d, err);
    if (status == WT_OK)
        status = read_directory(a, &d, err);
    if (status == WT_E_CORRUPT) {
        if (a->defect == NULL)
            a->defect = "the directory of the archive is damaged";
        a->n = a->names_length = 0;
        free(a->entries);
        a->entries = NULL;
        status = rebuild_entries(a, err);
    }
    if (status == WT_OK && a->n == 0)
        status = wt_fail(err, WT_E_CORRUPT, "the ZIP archive is empty");
    if (status != WT_OK) {
        archive_close(a);
        return status;
    }
    index_names(a);
    *archive = a;
    return WT_OK;
}

void archive_close(zip_archive *archive)
{
    if (archive == NULL)
        return;
    libdeflate_free_decompressor(archive->unpacker);
    window_close(&archive->window);
    free(archive->entries);
    free(archive->names);
    free(archive->slots);
    free(archive);
}

/* ---- entries ------------------------------------------------------------------------------ */

static wt_status fail_entry(const zip_archive *archive, size_t i, wt_error *err, wt_status status,
                            const char *message)
{
    wt_fail(err, status, "%s", message);
    wt_error_place(err, "%s", archive_name(archive, i));
    return status;
}

wt_status archive_size(const zip_archive *archive, size_t i, size_t *size, wt_error *err)
{
    const zip_entry *const e = &archive->entries[i];
    if (e->packing == ENCRYPTED)
        return fail_entry(archive, i, err, WT_E_UNSUPPORTED, "archive entry is encrypted");
    if (e->packing == UNKNOWN)
        return fail_entry(archive, i, err, WT_E_UNSUPPORTED,
                          "archive entry is packed by another method than deflate");
    if (e->size == UINT32_MAX)
        return fail_entry(archive, i, err, WT_E_UNSUPPORTED, "archive entry has 4 GiB or more");
    if (e->size > (uint64_t)e->packed * MAX_RATIO + RATIO_SLACK) {
        fail_entry(archive, i, err, WT_E_CORRUPT, "archive entry declares an impossible size");
        wt_error_found(err, "%u bytes out of %u", (unsigned)e->size, (unsigned)e->packed);
        return WT_E_CORRUPT;
    }
    *size = e->size;
    return WT_OK;
}

/* Returns the packed bytes of an entry, as many as the directory states; valid until the next
 * call. */
static wt_status read_packed(zip_archive *a, size_t i, const unsigned char **packed, wt_error *err)
{
    const zip_entry *const e = &a->entries[i];
    const size_t offset = (size_t)e->offset, left = a->length - offset;
    const size_t whole = LOCAL_SIZE + strlen(archive_name(a, i)) + e->packed; /* header estimate */
    if (left < LOCAL_SIZE)
        return fail_entry(a, i, err, WT_E_CORRUPT, "archive entry lies outside of the file");
    wt_status status = window_bytes(&a->window, offset, whole < left ? whole : left, packed, err);
    if (status != WT_OK)
        return status;
    if (le32(*packed) != 0x04034b50)
        return fail_entry(a, i, err, WT_E_CORRUPT, "archive entry cannot be opened");
    const size_t start = LOCAL_SIZE + (size_t)le16(*packed + 26) + (size_t)le16(*packed + 28);
    if (start > left || e->packed > left - start)
        return fail_entry(a, i, err, WT_E_CORRUPT, "archive entry lies outside of the file");
    return window_bytes(&a->window, offset + start, e->packed, packed, err);
}

static wt_status inflate_entry(zip_archive *a, size_t i, const unsigned char *packed,
                               byte_buffer *buffer, wt_error *err)
{
    const zip_entry *const e = &a->entries[i];
    if (a->unpacker == NULL && (a->unpacker = libdeflate_alloc_decompressor()) == NULL)
        out_of_memory(0);
    switch (libdeflate_deflate_decompress(a->unpacker, packed, e->packed, buffer->data, e->size,
                                          NULL)) {
    case LIBDEFLATE_SUCCESS:
        return WT_OK;
    case LIBDEFLATE_SHORT_OUTPUT:
    case LIBDEFLATE_INSUFFICIENT_SPACE:
        return fail_entry(a, i, err, WT_E_CORRUPT,
                          "archive entry is not of the size that it declares");
    case LIBDEFLATE_BAD_DATA:
        break;
    }
    return fail_entry(a, i, err, WT_E_CORRUPT, "archive entry cannot be unpacked");
}

wt_status archive_read(zip_archive *archive, size_t i, size_t limit, byte_buffer *buffer,
                       wt_error *err)
{
    size_t size = 0;
    const unsigned char *packed = NULL;
    const zip_entry *const e = &archive->entries[i];
    wt_status status = archive_size(archive, i, &size, err);
    if (status != WT_OK)
        return status;
    if (size > limit) {
        fail_entry(archive, i, err, WT_E_CORRUPT, "archive entry is too large for what it is");
        wt_error_expected(err, "at most %zu bytes", limit);
        wt_error_found(err, "%zu bytes", size);
        return WT_E_CORRUPT;
    }
    if (e->packing == STORED && e->packed != e->size)
        return fail_entry(archive, i, err, WT_E_CORRUPT,
                          "archive entry is not of the size that it declares");
    if (size >= buffer->capacity) {
        free(buffer->data);
        buffer->data = try_alloc(size + 1, 1);
        buffer->capacity = buffer->data != NULL ? size + 1 : 0;
    }
    if (buffer->data == NULL)
        return fail_entry(archive, i, err, WT_E_MEMORY, "no memory for an archive entry");
    status = read_packed(archive, i, &packed, err);
    if (status == WT_OK && e->packing == STORED)
        memcpy(buffer->data, packed, size);
    else if (status == WT_OK)
        status = inflate_entry(archive, i, packed, buffer, err);
    if (status == WT_OK && libdeflate_crc32(0, buffer->data, size) != e->sum) {
        fail_entry(archive, i, err, WT_E_CORRUPT, "archive entry cannot be unpacked");
        wt_error_found(err, "a checksum that does not agree");
        return WT_E_CORRUPT;
    }
    buffer->length = size;
    return status;
}
