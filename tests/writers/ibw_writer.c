/* Igor binary waves for tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/ibw_writer.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADERS = 384 };

static void put(unsigned char *to, uint64_t value, size_t width, bool big)
{
    for (size_t i = 0; i < width; i++)
        to[big ? width - 1 - i : i] = (unsigned char)(value >> (8 * i) & 0xff);
}

static void put_real(unsigned char *to, double value, bool wide, bool big)
{
    const float narrow = (float)value;
    uint64_t bits = 0;
    uint32_t half = 0;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&half, &narrow, sizeof half);
    put(to, wide ? bits : half, wide ? 8 : 4, big);
}

void ibw_writer_fix_checksums(unsigned char *bytes, size_t length)
{
    unsigned sum = 0;
    if (length < HEADERS)
        return;
    const bool big = bytes[0] == 0;
    put(bytes + 2, 0, 2, big);
    for (size_t i = 0; i < HEADERS; i += 2)
        sum += big ? bytes[i] * 256u + bytes[i + 1] : bytes[i + 1] * 256u + bytes[i];
    put(bytes + 2, 0x10000 - (sum & 0xffff), 2, big);
}

int ibw_write(const ibw_writer_file *f)
{
    const size_t width = f->doubles ? 8 : 4,
                 labels = f->n_channels > 0 ? 32 * (f->n_channels + 1) : 0;
    const size_t samples = f->n * (f->n_channels > 0 ? f->n_channels : 1) * width;
    const size_t note = strlen(f->note), size = HEADERS + samples + note + labels;
    const bool big = f->big_endian;
    unsigned char *b = calloc(size, 1);
    if (b == NULL)
        return -1;
    put(b, 5, 2, big);
    put(b + 4, 320 + samples, 4, big);
    put(b + 12, note, 4, big);
    put(b + 40, labels, 4, big);
    put(b + 64 + 12, samples / width, 4, big);
    put(b + 64 + 16, f->doubles ? 4 : 2, 2, big);
    memcpy(b + 64 + 28, "Curve", 5);
    put(b + 64 + 68, f->n, 4, big);
    put(b + 64 + 72, f->n_channels, 4, big);
    put_real(b + 64 + 84, f->interval, true, big);
    put_real(b + 64 + 92, 1, true, big);
    unsigned char *to = b + HEADERS;
    for (size_t c = 0; c < f->n_channels; c++)
        for (size_t i = 0; i < f->n; i++, to += width)
            put_real(to, f->values[c][i], f->doubles, big);
    memcpy(b + HEADERS + samples, f->note, note);
    for (size_t c = 0; c < f->n_channels; c++)
        snprintf((char *)b + HEADERS + samples + note + 32 * (c + 1), 32, "%s", f->labels[c]);
    ibw_writer_fix_checksums(b, size);
    FILE *out = fopen(f->path, "wb");
    const bool good = out != NULL && fwrite(b, 1, size, out) == size;
    free(b);
    return out != NULL && fclose(out) == 0 && good ? 0 : -1;
}
