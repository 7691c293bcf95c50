/* Writes JPK force files (.jpk-force, .jpk-force-map) from arrays in SI units. The same input gives
 * the same bytes. Shares no code with the reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef TESTS_WRITERS_JPK_WRITER_H
#define TESTS_WRITERS_JPK_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct jpk_writer_segment {
    const char *style; /* "extend", "retract", "pause", "modulation" */
    size_t n;
    double duration;               /* [s]; NaN leaves it out */
    const double *height;          /* [n] m, falling towards the sample */
    const double *force;           /* [n] N, positive when the tip is pushed away */
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
    bool map; /* curves in index/N/; else there is one curve */
    size_t n_curves;
    const jpk_writer_curve *curves;
    long columns, rows; /* grid of the map; 0, 0: none */
    bool back_and_forth;
    size_t n_planned;       /* curves announced in the header; 0 = n_curves */
    double spring_constant; /* [N/m]; NaN: the file says none */
    double sensitivity;     /* [m/V]; NaN: none, then `force` holds volts of the detector */
    double setpoint;        /* [N]; NaN = none */
    bool force_from_volts;  /* the slot of the force leads to the volts, not to the distance */
    jpk_writer_encoding encoding;
    const jpk_writer_curve *miscounted;     /* its header counts one segment more; NULL: none */
    const jpk_writer_segment *without_rest; /* its header ends behind the style; NULL: none */
    unsigned n_more;                        /* channels that are listed beside those there are */
    bool bare_height;    /* the height stays in volts: its conversions are not defined */
    bool odd_height;     /* its samples are integers of a kind that nobody knows */
    bool inline_headers; /* no shared-data: every key stands in the segment header */
    bool folders;        /* with entries for the folders */
    bool stored;         /* not compressed: the same bytes with any version of zlib */
} jpk_writer_file;

/* A file to be filled in: 32-bit integers, shared headers. */
jpk_writer_file jpk_writer_defaults(void);
/* 0, or -1 with a text on stderr. */
int jpk_write(const jpk_writer_file *file);
/* Half a step of the raw numbers in which heights [m] or forces [N] of this file are stored (0 for
 * floating point); what is read back differs by no more than this and a few rounding errors. */
double jpk_writer_height_step(const jpk_writer_file *file);
double jpk_writer_force_step(const jpk_writer_file *file);

#endif
