/* Igor binary waves (.ibw) of version 5, as Asylum Research writes force curves: the samples of a
 * channel one behind the other, a label for each channel, and a note of "key: value" lines that
 * says everything else. Technical Note 003 of WaveMetrics; the keys are known from measured files.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_IBW_H
#define WT_READ_IBW_H

#include "read/bytes/samples.h"
#include "read/force_assembler.h"
#include "read/reader.h"

enum { IBW_TEXT = 64, IBW_CHANNELS = 32, IBW_SEGMENTS = 64 };

typedef struct ibw_channel {
    char name[33];
    size_t number;
} ibw_channel;

typedef struct ibw_file {
    const char *name; /* of the input */
    const unsigned char *bytes;
    bool big_endian;
    sample_type type;
    size_t n; /* samples of each channel */
    ibw_channel channels[IBW_CHANNELS];
    size_t n_channels;
    size_t data;     /* where they begin */
    double interval; /* [s] */
    const char *note;
    size_t note_length;
} ibw_file;

/* Part of the samples, as the note says. */
typedef struct ibw_segment {
    wt_segment_kind kind;
    size_t from, n;
} ibw_segment;

/* Whether a wave of version 5 begins with these bytes: all 16-bit numbers of its headers add up to
 * 0. */
bool ibw_is(const unsigned char *bytes, size_t length, bool *big_endian);
/* Whether the bytes are a whole wave of version 2: its sizes add up to the file. */
bool ibw_is_old(const unsigned char *bytes, size_t length);
/* Everything is inside the file. */
wt_status ibw_open(wt_input *input, ibw_file *file, wt_error *err) WT_NODISCARD;
/* An image: three dimensions, of which the last are its channels; `n` is columns x rows. */
typedef struct ibw_grid {
    size_t n_columns, n_rows;
    double step_x, step_y, x_min, y_min; /* [m] */
} ibw_grid;
wt_status ibw_open_image(wt_input *input, ibw_file *file, ibw_grid *grid,
                         wt_error *err) WT_NODISCARD;
/* ibw_image.c */
wt_status ibw_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                     wt_log *log, wt_image **images, size_t *n_images, wt_error *err);
/* The value of a key of the note, cut to fit; false if it is not there. */
bool ibw_note(const ibw_file *file, const char *key, char value[IBW_TEXT]);
double ibw_number(const ibw_file *file, const char *key); /* NaN if there is none */
wt_status ibw_segments(const ibw_file *file, ibw_segment segments[IBW_SEGMENTS], size_t *n,
                       wt_error *err) WT_NODISCARD;
/* Signals and calibration, the same for all segments. */
force_metadata ibw_facts(const ibw_file *file);

#endif
