/* Nanosurf .nid: what the parts of the reader share.
 *
 * A file is an INI text, the two bytes "#!", then one block of little-endian integers per channel.
 * Groups name what was measured ("Scan forward", "Spec backward", "Spectrum FFT").
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_NID_H
#define WT_READ_NID_H

#include "read/bytes/window.h"
#include "read/force_assembler.h"
#include "read/reader.h"

/* ---- the header: nid_header.c ------------------------------------------------------------- */

typedef struct nid_item {
    const char *section; /* without the brackets */
    const char *key;
    const char *value;
} nid_item;

typedef struct nid_lengths nid_lengths;
typedef struct nid_header {
    nid_item *items; /* [n] sorted by section, key; of equal ones the first is kept */
    size_t n;
    nid_lengths *lengths; /* [n_lengths] for nid_line_length */
    size_t n_lengths;
    char *text; /* UTF-8 */
    bool latin1;
    size_t data; /* offset of the first block */
} nid_header;

wt_status nid_header_read(wt_input *input, nid_header *header, wt_error *err);
void nid_header_clear(nid_header *header);
/* NULL if there is none. */
const char *nid_get(const nid_header *header, const char *section, const char *key);
/* Plain numbers; NaN if missing or not a number. */
double nid_number(const nid_header *header, const char *section, const char *key);
/* A whole number from 0 to `most`; false if missing or anything else. */
bool nid_count(const nid_header *header, const char *section, const char *key, size_t most,
               size_t *count);
/* Samples of a line of a channel (LineDim7Points), in version 3; false if missing or not
 * understood. */
bool nid_line_length(const nid_header *header, const char *section, size_t line, size_t *n);
/* "D[48]*[N/m]": the number in the SI unit of the quantity; NaN if missing or of another unit. */
double nid_typed(const nid_header *header, const char *section, const char *key,
                 wt_quantity quantity);
/* Items of a list "a;b;c" or "a,b,c"; false if there are not so many. Cut to fit. */
bool nid_list_item(const char *list, char separator, size_t i, char *item, size_t size);

/* ---- the channels: nid_data.c ------------------------------------------------------------- */

#define NID_TEXT 48

typedef struct nid_channel {
    size_t group, slot;
    const char *section;    /* "DataSet-0:1"; borrowed from the header */
    const char *group_name; /* "Scan forward" */
    const char *name;       /* Dim2Name, "" if none */
    const char *unit;       /* Dim2Unit, "" if none */
    size_t version;
    size_t points, lines; /* stride and number of lines of the block */
    double minimum, range;
    unsigned bits; /* 16 or 32 */
    size_t offset; /* of the block in the file */
} nid_channel;

typedef struct nid_file {
    nid_header header;
    const char *name;      /* of the input */
    nid_channel *channels; /* [n] in the order of their blocks */
    input_window *windows; /* [n] of each */
    size_t n;
} nid_file;

/* All blocks are there and end exactly where the file ends, or it is WT_E_CORRUPT. */
wt_status nid_file_open(wt_input *input, nid_file *file, wt_error *err);
void nid_file_close(nid_file *file);
bool nid_is_spectroscopy(const nid_channel *channel);
/* values[n] = the first n samples of a line: factor * exported value. */
wt_status nid_decode(const nid_file *file, const nid_channel *channel, size_t line, size_t n,
                     double factor, double *values, wt_error *err);
/* The SI unit for an exported one, "" with factor 1 if it is none of the units known here. */
const char *nid_si_unit(const char *unit, double *factor);
wt_status nid_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_image **images, size_t *n_images, wt_error *err);

/* ---- thermal tune: nid_noise.c ------------------------------------------------------------ */

/* The channel of the measured spectrum, NULL if the file is no thermal tune. */
const nid_channel *nid_tune(const nid_file *file);
wt_status nid_read_noise(const file_reader *self, wt_input *input, const wt_read_options *options,
                         wt_log *log, wt_noise_spectrum *spectrum, wt_error *err);

/* ---- force curves: nid_force.c ------------------------------------------------------------ */

/* The groups of a force curve in the order of time. */
#define NID_PHASES 4
typedef struct nid_phase {
    const char *group;    /* name of the group in the file */
    double interval;      /* between samples [s], NaN if unknown */
    force_metadata facts; /* that all curves share; without signals the phase is not in the file */
} nid_phase;

typedef struct nid_spectroscopy {
    nid_phase phases[NID_PHASES];
    size_t n_curves;
    wt_cantilever cantilever; /* as the file says */
    long columns, rows;       /* 0 if there is no grid */
} nid_spectroscopy;

/* WT_E_EMPTY if there are no curves. */
wt_status nid_spectroscopy_find(const nid_file *file, nid_spectroscopy *spectroscopy,
                                wt_error *err);
extern const force_stream nid_force;

/* ---- where the curves are: nid_position.c ------------------------------------------------- */

/* Grid of a map; 0, 0 if the file says nothing of one. */
void nid_grid(const nid_header *header, long *columns, long *rows);
/* Place of a curve; what is not known is NaN and -1. Logs what it does not understand. */
void nid_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                  wt_force_curve *curve);

#endif
