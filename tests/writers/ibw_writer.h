/* Writes Igor binary waves of version 5 in the layout of Asylum Research: float or double, either
 * byte order. The writer shares no code with the reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_IBW_WRITER_H
#define TESTS_WRITERS_IBW_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ibw_writer_file {
    const char *path;
    bool big_endian, doubles;
    size_t n, n_channels; /* number of samples and channels; 0 channels: a one-dimensional wave */
    const char *const *labels;
    const double *const *values; /* [n_channels][n] */
    double interval;             /* [s] */
    const char *note;            /* lines that end with \r */
} ibw_writer_file;

/* Returns 0 or -1. */
int ibw_write(const ibw_writer_file *file);
/* Corrects the checksum of a wave, if its headers are complete. */
void ibw_writer_fix_checksums(unsigned char *bytes, size_t length);

#endif
