/* Declares what the files of the Nanosurf .nid reader share.
 *
 * A file is an INI text, the two bytes "#!", then one block of little-endian integers for each
 * channel. Groups name the kind of measurement ("Scan forward", "Spec backward", "Spectrum FFT").
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_NID_H
#define WT_READ_NID_H

#include "read/bytes/samples.h"
#include "read/force_assembler.h"
#include "read/reader.h"

/* ---- the header: nid_header.c ------------------------------------------------------------- */

typedef struct nid_item {
    const char *section; /* without the brackets */
    const char *key;
    const char *value;
} nid_item;

typedef struct nid_line_lengths nid_line_lengths;

typedef struct nid_header {
    nid_item *items; /* [n] sorted by section and key; of equal ones the first */
    size_t n;
    nid_line_lengths *lengths; /* [n_lengths], read by nid_line_length */
    size_t n_lengths;
    char *text; /* UTF-8 */
    bool latin1;
    size_t data; /* offset of the first block */
} nid_header;

wt_status nid_header_read(wt_input *input, nid_header *header, wt_error *err);
void nid_header_clear(nid_header *header);
/* Returns the value of a key, or NULL. */
const char *nid_get(const nid_header *header, const char *section, const char *key);
/* Returns a plain number; NaN if it is absent or no number. */
double nid_number(const nid_header *header, const char *section, const char *key);
/* Reads an integer from 0 to the limit; false for anything else. */
bool nid_integer(const nid_header *header, const char *section, const char *key, size_t max_value,
                 size_t *count);
/* Reads the number of samples of a line of a channel (LineDim7Points, version 3); false if it is
 * absent or not understood. */
bool nid_line_length(const nid_header *header, const char *section, size_t line, size_t *n);
/* Returns the number of a text such as "D[48]*[N/m]" in the SI unit of the quantity; NaN if it is
 * absent or has another unit. */
double nid_quantity(const nid_header *header, const char *section, const char *key,
                    wt_quantity quantity);
/* Copies item i of a list "a;b;c" or "a,b,c", cut to fit; false if the list is shorter. */
bool nid_list_item(const char *list, char separator, size_t i, char *item, size_t size);

/* ---- the channels: nid_data.c ------------------------------------------------------------- */

#define NID_TEXT 48

typedef struct nid_channel {
    size_t group, slot;
    const char *section;    /* "DataSet-0:1"; borrowed from the header */
    const char *group_name; /* "Scan forward" */
    const char *name;       /* Dim2Name; "" if absent */
    const char *unit;       /* Dim2Unit; "" if absent */
    size_t version;
    size_t points, lines; /* stride and number of lines of the block */
    double minimum, range;
    unsigned bits; /* 16 or 32 */
    size_t offset; /* offset of the block in the file */
} nid_channel;

typedef struct nid_file {
    nid_header header;
    const char *name;      /* name of the input */
    nid_channel *channels; /* [n] in the order of their blocks */
    input_window *windows; /* [n] one window for each channel */
    size_t n;
} nid_file;

/* Opens a file. WT_E_CORRUPT unless all blocks exist and end exactly where the file ends. */
wt_status nid_file_open(wt_input *input, nid_file *file, wt_error *err);
void nid_file_close(nid_file *file);
bool nid_is_spectroscopy(const nid_channel *channel);
/* Decodes the first n samples of a line: values[i] = factor * exported value. */
wt_status nid_decode(const nid_file *file, const nid_channel *channel, size_t line, size_t n,
                     double factor, double *values, wt_error *err);
wt_status nid_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_image **images, size_t *n_images, wt_error *err);

/* ---- force curves: nid_force.c ------------------------------------------------------------ */

/* Number of the groups of a force curve, in temporal order. */
#define NID_PHASES 4

typedef struct nid_phase {
    const char *group; /* name of the group in the file */
    double interval;   /* time between samples [s]; NaN if unknown */
    force_metadata
        metadata; /* metadata of all curves; without signals the phase is not in the file */
} nid_phase;

typedef struct nid_spectroscopy {
    nid_phase phases[NID_PHASES];
    size_t n_curves;
    wt_cantilever cantilever; /* as stated in the file */
    long columns, rows;       /* 0 if there is no grid */
} nid_spectroscopy;

/* ---- positions of the curves: ---------------------------------------------------------------- */

/* Returns the grid of a map; 0 and 0 if the file states none. */
void nid_read_grid(const nid_header *header, long *columns, long *rows);
/* Sets the position of a curve; unknown values are NaN and -1. It warns of a position that it does
 * not understand. */
void nid_set_position(const nid_header *header, size_t i, const char *name, wt_log *log,
                      wt_force_curve *curve);

#endif
