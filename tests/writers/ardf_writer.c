/* Force maps of Asylum Research for tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/ardf_writer.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct buffer {
    unsigned char *bytes;
    size_t n;
} buffer;

static void set(buffer *b, size_t at, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        b->bytes[at + i] = i < 8 ? (unsigned char)(value >> (8 * i)) : 0; /* padding at the end */
}

static void put(buffer *b, uint64_t value, size_t width)
{
    set(b, b->n, value, width);
    b->n += width;
}

static void put_text(buffer *b, const char *text, size_t width)
{
    memcpy(b->bytes + b->n, text, strlen(text) < width ? strlen(text) : width);
    b->n += width;
}

static void put_double(buffer *b, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(b, bits, 8);
}

static uint32_t check_sum(const unsigned char *bytes, size_t n)
{
    uint32_t sum = 0xffffffff;
    for (size_t i = 0; i < n; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xedb88320 & (0 - (sum & 1)));
    }
    return ~sum;
}

void ardf_writer_fix_checksums(unsigned char *bytes, size_t length)
{
    buffer b = {bytes, length};
    for (size_t at = 0; at + 16 <= length; at += 4) {
        uint32_t size = 0;
        bool name = true;
        for (size_t i = 8; i-- > 4;)
            size = size << 8 | bytes[at + i];
        for (size_t i = 8; i < 12; i++)
            name = name && bytes[at + i] >= 'A' && bytes[at + i] <= 'Z';
        if (name && size >= 16 && size <= length - at)
            set(&b, at, check_sum(bytes + at + 4, size - 4), 4);
    }
}

/* Begins a section; its checksum is written at the end. */
static void section(buffer *b, const char *name, size_t size)
{
    put(b, 0, 4);
    put(b, size, 4);
    put_text(b, name, 4);
    put(b, 0, 4);
}

static void table(buffer *b, const char *name, size_t n, size_t stride)
{
    section(b, name, 32);
    put(b, 32 + n * stride, 8);
    put(b, n, 4);
    put(b, stride, 4);
}

static void curve(buffer *b, const ardf_writer_file *f, unsigned k, unsigned pass, size_t previous,
                  bool last)
{
    const unsigned line = f->down ? f->lines - 1 - k / f->columns : k / f->columns;
    const unsigned point = pass == 1 ? f->columns - 1 - k % f->columns : k % f->columns;
    const size_t data = 56 + 4 * f->n, size = 48 + 48 + f->n_channels * data;
    const unsigned place[] = {k, line, point};
    section(b, "VSET", 48);
    for (size_t i = 0; i < 3; i++)
        put(b, place[i], 4);
    put(b, f->both ? 10 + pass : 5, 4);
    put(b, previous, 8);
    put(b, last ? 0 : b->n - 40 + size, 8);
    section(b, "VNAM", 48);
    for (size_t i = 0; i < 3; i++)
        put(b, place[i], 4);
    put(b, 5, 4);
    put_text(b, "Curve", 16);
    for (size_t c = 0; c < f->n_channels; c++) {
        section(b, "VDAT", data);
        for (size_t i = 0; i < 3; i++)
            put(b, place[i], 4);
        put(b, f->n, 4);
        put(b, c, 4);
        for (size_t i = 0; i < 5; i++)
            put(b, f->begins[i], 4);
        for (size_t i = 0; i < f->n; i++) {
            const float value = (float)(f->values[c][i] + 1e-9 * (double)k);
            uint32_t bits;
            memcpy(&bits, &value, sizeof bits);
            put(b, bits, 4);
        }
    }
}

/* Writes a volume without its curves. Returns the position of its line table. */
static size_t volume(buffer *b, const ardf_writer_file *f)
{
    table(b, "VOLM", 2, 24);
    section(b, "NSET", 24);
    put(b, f->columns * f->lines, 8);
    put(b, 0, 24);
    table(b, "TTOC", 1, 32);
    put(b, 0, 32);
    section(b, "VDEF", 208);
    put(b, f->columns, 4);
    put(b, f->lines, 4);
    put(b, 0, 24);
    put_double(b, f->step);
    put_double(b, f->step);
    put_double(b, f->interval);
    put_text(b, "m", 32);
    put_text(b, "m", 32);
    put_text(b, "s", 32);
    put_text(b, f->segments, 32);
    put(b, 2, 8);
    for (size_t c = 0; c < f->n_channels; c++) {
        section(b, "VCHN", 80);
        put_text(b, f->labels[c], 32);
        put_text(b, f->units[c], 32);
    }
    section(b, "XDEF", 96);
    put(b, 0, 80);
    const size_t lines = b->n + 32;
    table(b, "VTOC", f->lines, 40);
    b->n += 40 * f->lines;
    section(b, "MLOV", 16);
    return lines;
}

int ardf_write(const ardf_writer_file *f)
{
    const size_t note = (strlen(f->note) + 4) / 4 * 4, passes = f->both ? 2 : 1;
    const size_t one = 200 + f->n_channels * (60 + 4 * f->n);
    buffer b = {calloc(4096 + note + 80 * f->lines + passes * f->written * one, 1), 0};
    size_t lines[2], previous = 0;
    if (b.bytes == NULL)
        return -1;
    section(&b, "ARDF", 16);
    table(&b, "FTOC", 2, 24);
    const size_t volumes = b.n;
    b.n += 48;
    table(&b, "TTOC", 1, 32);
    section(&b, "TOFF", 32);
    put(&b, 0, 8);
    put(&b, b.n + 8, 8);
    section(&b, "TEXT", 24 + note);
    put(&b, 0, 4);
    put(&b, strlen(f->note), 4);
    put_text(&b, f->note, note);
    for (size_t pass = 0; pass < passes; pass++) {
        buffer entry = {b.bytes, volumes + 24 * pass};
        section(&entry, "VOLM", 24);
        put(&entry, b.n, 8);
        lines[pass] = volume(&b, f);
    }
    for (unsigned k = 0; k < f->written; k += f->columns)
        for (unsigned pass = 0; pass < passes; pass++) {
            buffer entry = {b.bytes, lines[pass] + 40 * (k / f->columns)};
            section(&entry, "VOFF", 40);
            put(&entry, k, 4);
            put(&entry, k / f->columns, 4);
            put(&entry, 0, 8);
            put(&entry, b.n, 8);
            for (unsigned i = k; i < k + f->columns && i < f->written; i++) {
                const size_t here = b.n;
                curve(&b, f, i, pass, previous, i + 1 == f->written && pass + 1 == passes);
                previous = here;
            }
        }
    ardf_writer_fix_checksums(b.bytes, b.n);
    FILE *out = fopen(f->path, "wb");
    const bool good = out != NULL && fwrite(b.bytes, 1, b.n, out) == b.n;
    free(b.bytes);
    return out != NULL && fclose(out) == 0 && good ? 0 : -1;
}
