/* Writes TIFF files of Park Systems with force curves, without the image. The writer shares no code
 * with the reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_PARK_WRITER_H
#define TESTS_WRITERS_PARK_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct park_writer_channel {
    const char *name, *unit;
    double gain;
    const double *values; /* [curves][samples], in the unit */
} park_writer_channel;

typedef struct park_writer_file {
    const char *path;
    size_t n_curves, n_samples, n_channels;
    const park_writer_channel *channels;
    bool picture; /* no force curves */
    size_t strip; /* bytes of a small image at the end; 0: none */
} park_writer_file;

/* Returns 0 or -1. */
int park_write(const park_writer_file *file);

#endif
