/* NanoScope force files of Bruker, Veeco and Digital Instruments (.spm, .pfc, .000): what the parts
 * of the reader share.
 *
 * A file is a text of lines "\key: value" in sections "\*Name", then blocks of little-endian
 * integers. A "Ciao force image list" describes the block of one channel: all curves one behind
 * the other, of each the way in, stored from the contact outwards, then the way out.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_NANOSCOPE_H
#define WT_READ_NANOSCOPE_H

#include "read/bytes/samples.h"
#include "read/bytes/window.h"
#include "read/force_assembler.h"
#include "read/reader.h"

/* ---- the header: nanoscope_header.c -----------------------------------------------------------
 */

enum { NANOSCOPE_TEXT = 64, NANOSCOPE_CHANNELS = 16 };
/* Headers of measured files end before 40,960 bytes. */
#define NANOSCOPE_HEADER_MAX ((size_t)1 << 20)

typedef struct nanoscope_line {
    size_t section;  /* number of the section, counted from 0 */
    const char *key; /* without "\", "@" and the group before a colon; the name of a section
                        stands in its first line with an empty value */
    const char *value;
} nanoscope_line;

typedef struct nanoscope_header {
    char *text;
    nanoscope_line *lines;
    size_t n, n_sections;
} nanoscope_header;

/* "V [Sens. Zsens] (0.0067 V/LSB) 24.63 V": a number whose meaning another line tells. */
typedef struct nanoscope_value {
    char soft[NANOSCOPE_TEXT]; /* "Sens. Zsens", "" if none */
    double step;               /* 0.0067, NaN if it is not there */
    double value;              /* 24.63, likewise */
} nanoscope_value;

bool nanoscope_is(const unsigned char *bytes, size_t length);
wt_status nanoscope_header_read(const unsigned char *bytes, size_t length, nanoscope_header *header,
                                wt_error *err);
void nanoscope_header_clear(nanoscope_header *header);
/* The number-th section of that name; SIZE_MAX if there are not so many. */
size_t nanoscope_section(const nanoscope_header *header, const char *name, size_t number);
/* The value of a key; NULL if there is none. The spelling of keys varies in capitals. */
const char *nanoscope_get(const nanoscope_header *header, size_t section, const char *key);
double nanoscope_number(const nanoscope_header *header, size_t section, const char *key);
nanoscope_value nanoscope_value_of(const char *text); /* NULL is nothing */
/* Metres for each volt of a soft scale; NaN if there is none. */
double nanoscope_soft(const nanoscope_header *header, const char *soft);

/* ---- the curves: nanoscope_file.c -------------------------------------------------------------
 */

typedef struct nanoscope_channel {
    char name[NANOSCOPE_TEXT];
    wt_quantity quantity; /* WT_Q_NONE: not read */
    size_t offset;        /* of the block in the file */
    unsigned width;       /* bytes of a sample */
    double scale;         /* volts of a count; of a height metres */
} nanoscope_channel;

typedef struct nanoscope_file {
    nanoscope_header header;
    const char *name; /* of the input */
    size_t length;
    nanoscope_channel channels[NANOSCOPE_CHANNELS];
    input_window *windows; /* [n_channels] */
    size_t n_channels;
    size_t n_in, n_hold, n_out; /* samples of a curve */
    size_t n_curves, n_planned;
    long columns, rows; /* grid; 0 if there is none */
    double pitch;       /* of the grid [m], NaN if unknown */
    double ramp;        /* way of the piezo [m], of a sinusoid that between its turns */
    bool sinusoid;      /* PeakForce: one period of an oscillation */
    size_t shift;       /* of a sinusoid: place of its farthest sample in the order of time */
    double time_in, time_hold, time_out; /* durations [s] */
    double velocity_in, velocity_out;    /* [m/s] */
    double trigger;                      /* [V], NaN if none or not relative */
    wt_cantilever cantilever;
    bool scaled; /* counts of 32 bits are 256 times those of the header */
} nanoscope_file;

wt_status nanoscope_file_open(wt_input *input, wt_log *log, nanoscope_file *file, wt_error *err);
void nanoscope_file_close(nanoscope_file *file);
/* The samples of a curve as they are stored, until the next call for the channel. */
wt_status nanoscope_stored(const nanoscope_file *file, const nanoscope_channel *channel,
                           size_t curve, const unsigned char **stored, wt_error *err);
/* Sample `i` of them in the order of time, way in, hold and way out, in counts; NaN where it was
 * not measured. */
double nanoscope_count(const nanoscope_file *file, const nanoscope_channel *channel,
                       const unsigned char *stored, size_t i);

/* ---- nanoscope_force.c ------------------------------------------------------------------------
 */

/* Segment `s` (way in, hold, way out); the signals point to the file. */
force_metadata nanoscope_facts(const nanoscope_file *file, size_t s);
extern const force_stream nanoscope_force;

/* ---- nanoscope_image.c ------------------------------------------------------------------------
 */

/* All images of measured values: those of a file of images, and that of a force volume. */
wt_status nanoscope_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_image **images, size_t *n_images, wt_error *err);

#endif
