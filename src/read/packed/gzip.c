/* Gzip (RFC 1952) through zlib. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/bytes/input.h"
#include "read/packed/packed.h"

#include <limits.h>
#include <stdlib.h>
#include <zlib.h>

#define FIRST_ROOM ((size_t)1 << 16)
/* As much as a day of force curves; nothing else ends an archive that was made to grow. */
#define MOST_BYTES ((size_t)2 << 30)

bool gzip_is(const unsigned char *bytes, size_t length)
{
    return length >= 3 && bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == Z_DEFLATED;
}

typedef struct unpacking {
    z_stream z;
    unsigned char *bytes;
    size_t length, room;
} unpacking;

static wt_status fail(wt_error *err, const unpacking *u, const char *what)
{
    wt_fail(err, WT_E_CORRUPT, "%s", what);
    wt_error_place(err, "gzip archive, after %zu bytes of its content", u->length);
    wt_error_advice(err, "copy the file again, or unpack it with gunzip and look at what comes");
    return WT_E_CORRUPT;
}

static wt_status grow(unpacking *u, wt_error *err)
{
    if (u->length < u->room)
        return WT_OK;
    if (u->room >= MOST_BYTES)
        return fail(err, u, "the archive unpacks to more than 2 GiB");
    const size_t room = u->room > 0 ? 2 * u->room : FIRST_ROOM;
    unsigned char *bytes = realloc(u->bytes, room);
    if (bytes == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the content of a gzip archive");
    u->bytes = bytes;
    u->room = room;
    return WT_OK;
}

/* A piece of what is left; zlib counts in unsigned int. */
static uInt piece(size_t left)
{
    return left < UINT_MAX ? (uInt)left : UINT_MAX;
}

/* Zeros behind the last member are what tape drives leave; anything else would be lost. */
static wt_status check_rest(const unpacking *u, const unsigned char *rest, size_t n, wt_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (rest[i] != 0)
            return fail(err, u, "something else stands behind the archive");
    return WT_OK;
}

/* All members, one after the other. */
static wt_status unpack(unpacking *u, const unsigned char *packed, size_t n, wt_error *err)
{
    size_t at = 0;
    for (;;) {
        const wt_status status = grow(u, err);
        if (status != WT_OK)
            return status;
        const uInt in = piece(n - at), out = piece(u->room - u->length);
        u->z.next_in = (z_const Bytef *)(uintptr_t)(packed + at);
        u->z.avail_in = in;
        u->z.next_out = u->bytes + u->length;
        u->z.avail_out = out;
        const int what = inflate(&u->z, Z_NO_FLUSH);
        at += in - u->z.avail_in;
        u->length += out - u->z.avail_out;
        if (what == Z_STREAM_END) {
            if (!gzip_is(packed + at, n - at))
                return check_rest(u, packed + at, n - at, err);
            if (inflateReset(&u->z) != Z_OK)
                return fail(err, u, "the archive cannot be unpacked");
        } else if (what == Z_MEM_ERROR) {
            return wt_fail(err, WT_E_MEMORY, "no memory to unpack a gzip archive");
        } else if (what == Z_BUF_ERROR && at == n) {
            return fail(err, u, "the end of the archive is missing");
        } else if (what != Z_OK && what != Z_BUF_ERROR) {
            return fail(err, u, "the archive is damaged");
        }
    }
}

wt_status gzip_unpack(wt_input *input, wt_input **content, wt_error *err)
{
    const unsigned char *packed = NULL;
    size_t n = 0;
    unpacking u = {.bytes = NULL};
    wt_status status = wt_input_bytes(input, &packed, &n, err);
    if (status != WT_OK)
        return status;
    if (inflateInit2(&u.z, 16 + MAX_WBITS) != Z_OK) /* 16: gzip and nothing else */
        return wt_fail(err, WT_E_MEMORY, "no memory to unpack a gzip archive");
    status = unpack(&u, packed, n, err);
    (void)inflateEnd(&u.z);
    if (status != WT_OK) {
        free(u.bytes);
        return status;
    }
    return input_own((char *)u.bytes, u.length, wt_input_name(input), content, err);
}
