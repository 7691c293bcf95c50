/* Writes HDF5 files of force curves in the layouts of afmformats and Nanosurf Studio. The writer
 * shares no code with the readers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_CURVE_HDF5_WRITER_H
#define TESTS_WRITERS_CURVE_HDF5_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct afmformats_writer_file {
    const char *path;
    size_t n_curves, n;                  /* rows of each curve */
    size_t number_step;                  /* step between the numbers that are their names; 0: 1 */
    const double *time, *height, *force; /* [n_curves][n]; NULL: omitted */
    const unsigned char *segments;       /* [n] */
    double spring_constant;
    const char *force_unit;
    bool packed;
} afmformats_writer_file;

typedef struct nhf_writer_channel {
    const char *name, *unit; /* "Deflection", "Volt (V)" */
    double minimum, maximum; /* values of the limits of int32 */
    const double *values;    /* [all samples] in the unit; NaN: missing */
} nhf_writer_channel;

typedef struct nhf_writer_segment {
    const char *name; /* "Advance to Setpoint 1" */
    const int *sizes; /* [n_curves] */
    size_t n_channels;
    const nhf_writer_channel *channels;
} nhf_writer_segment;

typedef struct nhf_writer_file {
    const char *path;
    int version; /* 1, 2 */
    const char *type;
    size_t n_curves, n_segments;
    const nhf_writer_segment *segments;
    double spring_constant, sensitivity;
    const double *x, *y;      /* [n_curves] */
    double places_range;      /* limits of the stored positions, either sign; 0: stored in metres */
    double newtons_per_count; /* version 2: factor of the node from deflection to force; 0: none */
} nhf_writer_file;

/* Returns 0 or -1. */
int afmformats_write(const afmformats_writer_file *file);
int nhf_write(const nhf_writer_file *file);

#endif
