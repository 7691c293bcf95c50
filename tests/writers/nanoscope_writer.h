/* Writes NanoScope force files from arrays in time order. The writer shares no code with the
 * reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_NANOSCOPE_WRITER_H
#define TESTS_WRITERS_NANOSCOPE_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct nanoscope_writer_channel {
    const char *name;     /* "Deflection Error", "Height Sensor" */
    const char *soft;     /* "Sens. DeflSens" */
    double step;          /* volts per count */
    const double *values; /* [curves][n_in + n_hold + n_out] V; NaN: not measured; NULL: zeros */
} nanoscope_writer_channel;

typedef struct nanoscope_writer_file {
    const char *path;
    bool volume; /* a force volume or a capture, with several curves */
    size_t side; /* number of curves in a line, and of lines */
    size_t n_in, n_hold, n_out;
    size_t half;          /* reserved samples of each direction of a stopped ramp; 0: none */
    double padding;       /* value after the samples of a stopped ramp [V] */
    unsigned width;       /* bytes per sample: 2, 4 */
    bool scaled;          /* counts times 256 */
    size_t missing_bytes; /* bytes missing at the end */
    double ramp_volts, z_sensitivity;               /* [V], [nm/V] */
    double deflection_sensitivity, spring_constant; /* [nm/V], [N/m]; 0: omitted */
    double trigger;                                 /* [V]; 0: none */
    double rate;                                    /* rate of the ramp [V/s] */
    /* amplitude of a PeakForce capture [nm]; 0: a ramp */
    double amplitude;
    double sync; /* sample of the farthest point, from the start of the stored period */
    size_t n_channels;
    const nanoscope_writer_channel *channels;
} nanoscope_writer_file;

/* Returns 0 or -1. */
int nanoscope_write(const nanoscope_writer_file *file);

#endif
