/* Unpacks compressed files of Digital Surf.
 *
 * The head is that of a plain file except for its first word. Then come the number of pieces, the
 * plain and packed size of each, and the pieces as zlib streams. Of several surfaces the first is
 * read.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/gwyddion/surf.h"

#include "read/bytes/bytes.h"
#include "read/bytes/input.h"

#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

/* Offsets in the head, the length of the head, and the sizes of the piece count and of a piece
 * record [byte]. */
enum { BITS = 98, N_POINTS = 116, COMMENT = 334, PRIVATE = 336, HEAD = 512, COUNT = 4, PIECE = 8 };
/* Maximum ratio of plain to packed bytes of Deflate. */
enum { MAX_DEFLATE_RATIO = 1032 };

typedef struct surf_pieces {
    const unsigned char *bytes;
    size_t length, head; /* size of the file; size of all before the piece count */
    size_t n, packed;    /* number of pieces; offset of the first */
    size_t plain;        /* total unpacked size */
} surf_pieces;

static wt_status fail_surf(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "a compressed file of Digital Surf is damaged: %s", what);
    wt_error_advice(err, "copy it again, or save it in MountainsMap without compression");
    return WT_E_CORRUPT;
}

static size_t plain_size(const surf_pieces *p, size_t i)
{
    return le32(p->bytes + p->head + COUNT + PIECE * i);
}

static size_t packed_size(const surf_pieces *p, size_t i)
{
    return le32(p->bytes + p->head + COUNT + PIECE * i + PIECE / 2);
}

static wt_status find_pieces(surf_pieces *p, wt_error *err)
{
    if (p->length < HEAD)
        return fail_surf("its head is cut", err);
    const size_t comment = le16(p->bytes + COMMENT), private_size = le16(p->bytes + PRIVATE);
    p->head = HEAD + comment + private_size;
    if (comment > INT16_MAX || private_size > INT16_MAX || p->head + COUNT > p->length)
        return fail_surf("it ends before its heights", err);
    p->n = le32(p->bytes + p->head);
    if (p->n == 0 || p->n > (p->length - p->head - COUNT) / PIECE)
        return fail_surf("it says of more pieces than it has room for", err);
    p->packed = p->head + COUNT + PIECE * p->n;
    return WT_OK;
}

/* Checks that the pieces lie in the file and have the size that the head states. */
static wt_status check_pieces(surf_pieces *p, size_t max_size, wt_error *err)
{
    const uint64_t heights = (uint64_t)le32(p->bytes + N_POINTS) * (le16(p->bytes + BITS) / 8U);
    size_t left = p->length - p->packed;
    for (size_t i = 0; i < p->n; i++) {
        const size_t packed = packed_size(p, i), plain = plain_size(p, i);
        if (packed > left || plain / MAX_DEFLATE_RATIO > packed)
            return fail_surf("a piece of its heights lies outside of it", err);
        left -= packed;
        p->plain += plain; /* at most MAX_DEFLATE_RATIO times the file size */
    }
    if (p->plain > max_size) {
        wt_fail(err, WT_E_UNSUPPORTED, "the heights of the file are larger than is read");
        wt_error_expected(err, "%zu bytes at most", max_size);
        wt_error_found(err, "%zu", p->plain);
        return WT_E_UNSUPPORTED;
    }
    if (p->plain != heights) {
        fail_surf("its head and its heights are not of one size", err);
        wt_error_expected(err, "%llu bytes", (unsigned long long)heights);
        wt_error_found(err, "%zu", p->plain);
        return WT_E_CORRUPT;
    }
    return WT_OK;
}

static wt_status unpack_pieces(const surf_pieces *p, char *to, size_t *end, wt_error *err)
{
    struct libdeflate_decompressor *const unpacker = libdeflate_alloc_decompressor();
    wt_status status =
        unpacker != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "no memory for a height map");
    size_t at = p->packed, done = 0;
    for (size_t i = 0; status == WT_OK && i < p->n; i++) {
        if (libdeflate_zlib_decompress(unpacker, p->bytes + at, packed_size(p, i), to + done,
                                       plain_size(p, i), NULL) != LIBDEFLATE_SUCCESS)
            status = fail_surf("a piece of its heights cannot be unpacked", err);
        at += packed_size(p, i);
        done += plain_size(p, i);
    }
    *end = at;
    libdeflate_free_decompressor(unpacker);
    return status;
}

wt_status surf_unpack(wt_input *input, size_t max_size, wt_log *log, wt_input **unpacked,
                      wt_error *err)
{
    surf_pieces p = {.n = 0};
    size_t end = 0;
    wt_status status = wt_input_bytes(input, &p.bytes, &p.length, err);
    if (status == WT_OK)
        status = find_pieces(&p, err);
    if (status == WT_OK)
        status = check_pieces(&p, max_size, err);
    if (status != WT_OK)
        return status;
    char *const plain = malloc(p.head + p.plain + 1);
    if (plain == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a height map");
    memcpy(plain, p.bytes, p.head);
    memcpy(plain, SURF_PLAIN, strlen(SURF_PLAIN));
    plain[p.head + p.plain] = '\0';
    status = unpack_pieces(&p, plain + p.head, &end, err);
    if (status != WT_OK) {
        free(plain);
        return status;
    }
    if (end < p.length)
        wt_log_add(log, WT_WARNING, wt_input_name(input), NULL,
                   "%zu bytes behind the heights of the first surface are not read",
                   p.length - end);
    return input_from_bytes(plain, p.head + p.plain, wt_input_name(input), unpacked, err);
}
