/* Declares the reader of Igor binary waves (.ibw) of version 5, which Asylum Research uses for
 * force curves.
 *
 * The samples are stored channel by channel. A label names each channel, and a note of "key:
 * value" lines contains all else. Source: Technical Note 003 of WaveMetrics; the keys are known
 * from measured files.
 * SPDX-License-Identifier: GPL-3.0-or-later */
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
    const char *name; /* name of the input */
    const unsigned char *bytes;
    bool big_endian;
    sample_type type;
    size_t n; /* number of samples of each channel */
    ibw_channel channels[IBW_CHANNELS];
    size_t n_channels;
    size_t data;     /* offset of the samples */
    double interval; /* sampling interval [s] */
    const char *note;
    size_t note_length;
} ibw_file;

/* A segment of the samples, as the note states. */
typedef struct ibw_segment {
    wt_segment_kind kind;
    size_t from, n;
} ibw_segment;

/* True if a wave of version 5 begins with these bytes: the sum of all 16-bit words of its headers
 * is 0. */
bool ibw_is_wave(const unsigned char *bytes, size_t length, bool *big_endian);
/* True if the bytes are a complete wave of version 2: its sizes add up to the file size. */
bool ibw_is_version_2(const unsigned char *bytes, size_t length);
/* The grid of an image with three dimensions, the last of which is the channel; file.n = n_columns
 * * n_rows. */
typedef struct ibw_grid {
    size_t n_columns, n_rows;
    double step_x, step_y, x_min, y_min; /* [m] */
} ibw_grid;
/* Opens a wave of curves, or of an image if its grid is requested. All offsets are checked against
 * the file size. */
wt_status ibw_open(wt_input *input, ibw_file *file, ibw_grid *grid, wt_error *err) WT_NODISCARD;
/* Reads the value of a key of the note, cut to fit; false if it is absent. */
bool ibw_note_text(const ibw_file *file, const char *key, char value[IBW_TEXT]);
double ibw_note_number(const ibw_file *file, const char *key); /* NaN if it is absent */
/* Returns a value of the cantilever; NaN if it is absent or no number. Values that contradict it
 * are logged. */
double ibw_note_calibration(const ibw_file *file, const char *key, wt_quantity quantity,
                            wt_log *log);
wt_status ibw_read_segments(const ibw_file *file, ibw_segment segments[IBW_SEGMENTS], size_t *n,
                            wt_error *err) WT_NODISCARD;
/* Returns signals and calibration, which all segments share. */
force_metadata ibw_metadata(const ibw_file *file, wt_log *log);
/* Adds the rows of the channels and of the calibration. */
void ibw_describe_channels(const ibw_file *file, const force_metadata *read,
                           const wt_read_options *options, table_writer *metadata);

#endif
