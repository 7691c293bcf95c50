/* Writes force maps of Asylum Research (.ardf) of one or two passes. The writer shares no code with
 * the reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_ARDF_WRITER_H
#define TESTS_WRITERS_ARDF_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ardf_writer_file {
    const char *path;
    unsigned columns, lines,
        written; /* size of the map; curves of each pass before it was stopped */
    const char *const *labels, *const *units;
    size_t n_channels, n;        /* number of channels and of samples of each */
    const double *const *values; /* [n_channels][n]; curve k adds k nm to each channel */
    const char *segments;        /* such as "Ext;Ret;" */
    unsigned begins[5];          /* as stored: first samples, last sample, zeros */
    double interval, step;       /* [s], [m] */
    const char *note;            /* lines that end with \r */
    bool down, both; /* scanned from the last line; with a second volume of the other pass */
} ardf_writer_file;

/* 0, or -1 */
int ardf_write(const ardf_writer_file *file);
/* Corrects the checksums of all sections. */
void ardf_writer_fix_checksums(unsigned char *bytes, size_t length);

#endif
