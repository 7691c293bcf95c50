/* TIFF files of Park Systems for tests. SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/park_writer.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { SLOT = 96, COUNTS = 768, HEADER = 2972 };

static void put(FILE *out, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++)
        fputc((int)(value >> (8 * i) & 0xff), out);
}

static void put_text(FILE *out, const char *text, size_t size)
{
    const size_t n = strlen(text);
    for (size_t i = 0; i < size / 2; i++)
        put(out, i < n ? (unsigned char)text[i] : 0, 2);
}

static void put_tag(FILE *out, unsigned tag, unsigned type, size_t count, size_t value)
{
    put(out, tag, 2);
    put(out, type, 2);
    put(out, count, 4);
    put(out, value, 4);
}

static void put_header(const park_writer_file *f, FILE *out)
{
    for (size_t c = 0; c < 8; c++) {
        const bool there = c < f->n_channels;
        const double gain = there ? f->channels[c].gain : 0;
        uint64_t bits = 0;
        memcpy(&bits, &gain, sizeof bits);
        put_text(out, there ? f->channels[c].name : "", 64);
        put_text(out, there ? f->channels[c].unit : "", 16);
        put(out, bits, 8);
        put(out, 0, 8);
    }
    put(out, f->n_channels, 4);
    put(out, 0, 4);
    put(out, f->n_samples, 4);
    put(out, f->n_curves, 4);
    for (size_t i = COUNTS + 16; i < HEADER; i++)
        fputc(0, out);
}

int park_write(const park_writer_file *f)
{
    const unsigned tags = (f->picture ? 2u : 4u) + (f->strip > 0 ? 2u : 0u);
    const size_t header = 10 + 12 * tags + 4, data = header + HEADER;
    const size_t block = 4 * f->n_curves * f->n_channels * f->n_samples;
    FILE *out = fopen(f->path, "wb");
    if (out == NULL)
        return -1;
    fwrite("II*\0", 1, 4, out);
    put(out, 8, 4);
    put(out, tags, 2);
    put_tag(out, 256, 3, 1, 16);
    put_tag(out, 50432, 4, 1, 0x0e031301);
    if (!f->picture) {
        put_tag(out, 50438, 7, HEADER, header);
        put_tag(out, 50439, 1, block, data);
    }
    if (f->strip > 0) {
        put_tag(out, 273, 4, 1, f->picture ? header : data + block);
        put_tag(out, 279, 4, 1, f->strip);
    }
    put(out, 0, 4);
    if (!f->picture)
        put_header(f, out);
    for (size_t curve = 0; curve < f->n_curves && !f->picture; curve++)
        for (size_t c = 0; c < f->n_channels; c++)
            for (size_t i = 0; i < f->n_samples; i++) {
                const park_writer_channel *channel = &f->channels[c];
                const float value =
                    (float)(channel->values[curve * f->n_samples + i] / channel->gain);
                uint32_t bits = 0;
                memcpy(&bits, &value, sizeof bits);
                put(out, bits, 4);
            }
    for (size_t i = 0; i < f->strip; i++)
        fputc(128, out);
    return fclose(out);
}
