/* Writes NanoScope force files from arrays in the order of time. Shares no code with the reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_WRITERS_NANOSCOPE_WRITER_H
#define TESTS_WRITERS_NANOSCOPE_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct nanoscope_writer_channel {
    const char *name;     /* "Deflection Error", "Height Sensor" */
    const char *soft;     /* "Sens. DeflSens" */
    double step;          /* volts of a count */
    const double *values; /* [curves][n_in + n_hold + n_out] V; NaN: not measured; NULL: zeros */
} nanoscope_writer_channel;

typedef struct nanoscope_writer_file {
    const char *path;
    bool volume; /* a force volume, or a capture: several curves */
    size_t side; /* curves in a line, and lines */
    size_t n_in, n_hold, n_out;
    size_t half;    /* room for each way of a ramp that was stopped; 0: as many as there are */
    double padding; /* behind its samples [V] */
    unsigned width; /* bytes of a sample: 2, 4 */
    bool scaled;    /* counts times 256 */
    size_t missing_bytes;                           /* cut off at the end */
    double ramp_volts, z_sensitivity;               /* [V], [nm/V] */
    double deflection_sensitivity, spring_constant; /* [nm/V], [N/m]; 0: left out */
    double trigger;                                 /* [V]; 0: none */
    double rate;                                    /* [V/s] of the ramp */
    double amplitude;                               /* of a PeakForce capture [nm]; 0: a ramp */
    double sync; /* sample of its farthest point, from where the period is stored */
    size_t n_channels;
    const nanoscope_writer_channel *channels;
} nanoscope_writer_file;

/* 0, or -1 */
int nanoscope_write(const nanoscope_writer_file *file);

#endif
