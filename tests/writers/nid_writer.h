/* Writes Nanosurf .nid files from arrays in the stated units. The writer shares no code with the
 * reader.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_WRITERS_NID_WRITER_H
#define TESTS_WRITERS_NID_WRITER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct nid_writer_channel {
    size_t slot;
    const char *name, *unit; /* unit of the values */
    double minimum, range;   /* values are minimum + range j / 2^bits with an integer j */
    unsigned bits;           /* 16 or 32 */
    const double *values;    /* [lines * points], line by line from the bottom */
} nid_writer_channel;

typedef struct nid_writer_group {
    const char *name; /* "Scan forward", "Spec backward", ... */
    size_t points, lines;
    size_t missed;             /* lines not scanned according to CurLine, from the top; 0 = none */
    const size_t *line_points; /* [lines] for version 3, NULL for version 2 */
    const char *x_name, *x_unit, *y_name, *y_unit;
    double x_range, y_range;
    size_t n_channels;
    const nid_writer_channel *channels; /* sorted by slot */
} nid_writer_group;

typedef struct nid_writer_file {
    const char *path;
    size_t n_groups;
    const nid_writer_group *groups;
    const char *info;                              /* more lines of [DataSet-Info], or NULL */
    bool latin1;                                   /* encoding of the header; false: UTF-8 */
    double spring_constant;                        /* [N/m]; NaN: no cantilever section */
    double deflection_range_m, deflection_range_v; /* full scales; NaN: no scan head section */
    double forward_time, forward_pause, backward_time, backward_pause; /* [s], 0 = none */
    size_t forward_points, forward_pause_points, backward_points, backward_pause_points;
    double forward_range;         /* [m] */
    const char *map;              /* "x0;x1;y0;y1;nx;ny;rotation;placement", or NULL */
    size_t n_positions;           /* length of a list of positions */
    const double (*positions)[3]; /* [n_positions] m */
} nid_writer_file;

nid_writer_file nid_writer_defaults(void);
/* Returns 0, or -1 with a message on stderr. */
int nid_write(const nid_writer_file *file);

#endif
