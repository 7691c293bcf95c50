/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/surf_writer.h"

#include <stdint.h>
#include <string.h>

static const char comment[] = "scan!";

static unsigned char *put(unsigned char *to, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        *to++ = (unsigned char)(value >> (8 * i) & 0xff);
    return to;
}

static unsigned char *put_head(unsigned char *to, const char *word, size_t n)
{
    memset(to, 0, 512);
    memcpy(to, word, strlen(word));
    put(to + 14, 1, 2);  /* object type */
    put(to + 18, 2, 2);  /* a surface */
    put(to + 98, 32, 2); /* bits per point */
    put(to + 108, (uint32_t)n, 4);
    put(to + 112, 1, 4);
    put(to + 116, (uint32_t)n, 4);
    put(to + 334, sizeof comment - 1, 2);
    memcpy(to + 512, comment, sizeof comment - 1);
    return to + 512 + sizeof comment - 1;
}

static unsigned char *put_stream(unsigned char *to, const unsigned char *bytes, size_t n)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < n; i++) {
        a = (a + bytes[i]) % 65521;
        b = (b + a) % 65521;
    }
    to = put(put(to, 0x0178, 2), 1, 1); /* last block, not compressed */
    to = put(put(to, (uint32_t)n, 2), ~(uint32_t)n & 0xffff, 2);
    memcpy(to, bytes, n);
    to += n;
    for (int i = 3; i >= 0; i--)
        *to++ = (unsigned char)((b << 16 | a) >> (8 * i) & 0xff);
    return to;
}

static unsigned char *put_heights(unsigned char *to, const int *heights, size_t n)
{
    for (size_t i = 0; i < n; i++)
        to = put(to, (uint32_t)heights[i], 4);
    return to;
}

size_t surf_write_plain(unsigned char *to, const int *heights, size_t n)
{
    return (size_t)(put_heights(put_head(to, "DIGITAL SURF", n), heights, n) - to);
}

size_t surf_write(unsigned char *to, const int *heights, size_t n, size_t pieces)
{
    enum { AROUND = 11 }; /* bytes of a stream other than its data */
    unsigned char *at = put_head(to, "DSCOMPRESSED", n), piece[65536];
    const size_t each = n / pieces;
    at = put(at, (uint32_t)pieces, 4);
    for (size_t i = 0; i < pieces; i++) {
        const size_t own = 4 * (i + 1 < pieces ? each : n - i * each);
        at = put(put(at, (uint32_t)own, 4), (uint32_t)own + AROUND, 4);
    }
    for (size_t i = 0; i < pieces; i++) {
        const size_t own = i + 1 < pieces ? each : n - i * each;
        (void)put_heights(piece, heights + i * each, own);
        at = put_stream(at, piece, 4 * own);
    }
    return (size_t)(at - to);
}
