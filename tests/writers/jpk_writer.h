/* Writes JPK force files (.jpk-force, .jpk-force-map) from arrays in SI units. The same input gives
 * the same bytes. The writer shares no code with the reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_JPK_WRITER_H
#define TESTS_WRITERS_JPK_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct jpk_writer_segment {
    const char *style; /* "extend", "retract", "pause", "modulation" */
    size_t n;
    double duration;               /* [s]; NaN: omitted */
    const double *height;          /* [n] m, decreasing towards the sample */
    const double *force;           /* [n] N, positive for repulsion */
    const double *measured_height; /* [n] m, or NULL */
} jpk_writer_segment;

typedef struct jpk_writer_curve {
    size_t index; /* number in the map */
    double x, y;  /* [m] */
    size_t n_segments;
    const jpk_writer_segment *segments;
} jpk_writer_curve;

typedef enum jpk_writer_encoding {
    JPK_WRITE_INT32,
    JPK_WRITE_INT16,
    JPK_WRITE_FLOAT,
    JPK_WRITE_DOUBLE
} jpk_writer_encoding;

typedef struct jpk_writer_file {
    const char *path;
    bool map; /* curves in index/N/; false: one curve */
    size_t n_curves;
    const jpk_writer_curve *curves;
    long columns, rows; /* grid of the map; 0: none */
    bool back_and_forth;
    size_t n_planned;       /* curves announced in the header; 0 = n_curves */
    double spring_constant; /* [N/m]; NaN: omitted */
    double sensitivity;     /* [m/V]; NaN: omitted, and `force` is in volts of the detector */
    double setpoint;        /* [N]; NaN = none */
    bool force_from_volts;  /* the force is converted from volts, not from the distance */
    jpk_writer_encoding encoding;
    /* curve whose header states one segment too many, or NULL */
    const jpk_writer_curve *miscounted;
    const jpk_writer_segment *without_rest; /* segment whose header ends after the style, or NULL */
    unsigned n_more;                        /* additional channels in the list that do not exist */
    bool bare_height;    /* the height is in volts, and its conversions are undefined */
    bool odd_height;     /* the encoding of the samples is unknown */
    bool inline_headers; /* no shared-data: every key is in the segment header */
    bool folders;        /* has entries for the folders */
    bool stored;         /* not compressed: independent of the version of zlib */
} jpk_writer_file;

/* Returns a file with defaults: 32-bit integers, shared headers. */
jpk_writer_file jpk_writer_defaults(void);
/* Returns 0, or -1 with a message on stderr. */
int jpk_write(const jpk_writer_file *file);
/* Returns half a step of the stored heights [m] or forces [N], 0 for floating point. Read values
 * differ by at most this and a few rounding errors. */
double jpk_writer_height_step(const jpk_writer_file *file);
double jpk_writer_force_step(const jpk_writer_file *file);

#endif
