/* Declares what the files of the NanoScope reader share (Bruker, Veeco and Digital Instruments;
 * .spm, .pfc, .000).
 *
 * A file is a text of lines "\key: value" in sections "\*Name", then blocks of little-endian
 * integers. A "Ciao force image list" describes the block of one channel with all curves. A curve
 * is the approach, stored from the contact outwards, then the retract. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_NANOSCOPE_H
#define WT_READ_NANOSCOPE_H

#include "read/bytes/samples.h"
#include "read/force_assembler.h"
#include "read/reader.h"

/* ---- the header: nanoscope_header.c -----------------------------------------------------------
 */

enum { NANOSCOPE_TEXT = 64, NANOSCOPE_CHANNELS = 16 };

/* Maximum header size; headers of measured files end before 40,960 bytes [byte]. */
#define NANOSCOPE_HEADER_MAX ((size_t)1 << 20)

typedef struct nanoscope_line {
    size_t section;  /* index of the section */
    const char *key; /* without "\", "@" and group; the name for a section */
    const char *value;
    size_t number; /* of the line, from 1 */
} nanoscope_line;

typedef struct nanoscope_header {
    char *text;
    nanoscope_line *lines;
    size_t n, n_sections;
} nanoscope_header;

/* A value such as "V [Sens. Zsens] (0.0067 V/LSB) 24.63 V", whose scale is in another line. */
typedef struct nanoscope_value {
    char soft[NANOSCOPE_TEXT]; /* "Sens. Zsens", "" if none */
    double step;               /* 0.0067; NaN if absent */
    double value;              /* 24.63; NaN if absent */
} nanoscope_value;

bool nanoscope_is_header(const unsigned char *bytes, size_t length);
wt_status nanoscope_header_read(const unsigned char *bytes, size_t length, nanoscope_header *header,
                                wt_error *err);
void nanoscope_header_clear(nanoscope_header *header);
/* Returns section `number` with this name; SIZE_MAX if there is none. */
size_t nanoscope_section(const nanoscope_header *header, const char *name, size_t number);
/* Returns the value of a key, or NULL. Keys differ in capitals between versions, so case is
 * ignored. */
const char *nanoscope_get(const nanoscope_header *header, size_t section, const char *key);
double nanoscope_number(const nanoscope_header *header, size_t section, const char *key);
nanoscope_value nanoscope_parse_value(const char *text); /* accepts NULL */
/* Returns a soft scale [m/V]; NaN if there is none. */
double nanoscope_soft_scale(const nanoscope_header *header, const char *soft);
/* Warns of spring constants and sensitivities that are more than one number. */
void nanoscope_check_calibration(const nanoscope_header *header, const char *file, wt_log *log);

/* ---- the curves: nanoscope_file.c -------------------------------------------------------------
 */

typedef struct nanoscope_channel {
    char name[NANOSCOPE_TEXT];
    wt_quantity quantity; /* WT_Q_NONE if it is not read */
    size_t offset;        /* offset of the block in the file */
    unsigned width;       /* size of a sample [byte] */
    double scale;         /* [V] for each count; [m] for a height */
} nanoscope_channel;

typedef struct nanoscope_file {
    nanoscope_header header;
    const char *name; /* name of the input */
    size_t length;
    nanoscope_channel channels[NANOSCOPE_CHANNELS];
    input_window *windows; /* [n_channels] */
    size_t n_channels;
    size_t n_in, n_hold, n_out; /* samples of approach, hold and retract */
    size_t half; /* samples stored for each way of a ramp that was stopped; 0 if it was not */
    size_t n_curves, n_planned;
    long columns, rows; /* grid; 0 if there is none */
    double pitch;       /* distance of the grid points [m]; NaN if unknown */
    double ramp;        /* travel of the piezo [m]; peak to peak for a sinusoid */
    bool sinusoid;      /* PeakForce: a curve is one period of an oscillation */
    size_t shift;       /* index of the deepest sample of a sinusoid in temporal order */
    double time_in, time_hold, time_out; /* durations [s] */
    double velocity_in, velocity_out;    /* [m/s] */
    double trigger;                      /* [V]; NaN if absent or not relative */
    wt_cantilever cantilever;
    bool scaled; /* true if 32-bit counts are 256 times those of the header */
} nanoscope_file;

wt_status nanoscope_file_open(wt_input *input, wt_log *log, nanoscope_file *file, wt_error *err);
void nanoscope_file_close(nanoscope_file *file);
/* Reads the samples of a curve as stored, valid until the next call for the channel. */
wt_status nanoscope_read_curve(const nanoscope_file *file, const nanoscope_channel *channel,
                               size_t curve, const unsigned char **stored, wt_error *err);
/* Returns sample `i` in temporal order (approach, hold, retract) in counts; NaN if it was not
 * measured. */
double nanoscope_sample(const nanoscope_file *file, const nanoscope_channel *channel,
                        const unsigned char *stored, size_t i);

#endif
