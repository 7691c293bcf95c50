/* Declares the assembly of force curves from decoded segments.
 *
 * A reader decodes the layout of its file: segments, channels, units and calibration. This module
 * computes the requested quantities (force, deflection, time) from them. It reports each quantity
 * that it cannot compute. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_FORCE_ASSEMBLER_H
#define WT_READ_FORCE_ASSEMBLER_H

#include "read/header_values.h"
#include "weartrack/read.h"

/* y = multiplier x + offset */
typedef struct force_linear {
    double multiplier, offset;
} force_linear;

/* A channel of a segment, or a quantity that the calibration of the file derives from it. A
 * detector channel with its calibration is a voltage, a deflection and a force. */
typedef struct force_signal {
    wt_quantity quantity;
    const char *name, *unit; /* as exported */
    force_linear to_si;      /* from the stored numbers of the channel to SI units */
    const void *channel;     /* owned by the reader */
    const char *problem;     /* reason why it cannot be read, or NULL */
} force_signal;

/* The description of a segment that a reader returns. */
typedef struct force_metadata {
    wt_segment_kind kind;
    size_t index;      /* number of the segment in the file */
    size_t n_points;   /* samples of every channel */
    const char *place; /* position in the file for messages, or NULL */
    double start;      /* time of the first sample [s] */
    double duration;   /* duration of n_points intervals [s]; NaN if unknown */
    double velocity;   /* [m/s], NaN if unknown */
    double frequency;  /* modulation frequency [Hz]; 0 or NaN if unknown */
    double setpoint;   /* set point in the SI unit of setpoint_quantity; NaN if unknown */
    wt_quantity setpoint_quantity;
    wt_cantilever cantilever; /* calibration with which the file computed deflections and forces */
    /* Quantities that the format can deliver. A force is computed from any signal of the chain. */
    wt_quantity offers[WT_Q_COUNT];
    size_t n_offers;
    force_signal signals[WT_Q_COUNT];
    size_t n_signals;
} force_metadata;

struct file_reader;

/* The functions with which a reader delivers its curves one by one. */
typedef struct force_stream {
    size_t size; /* size of the reader's struct, whose first member is a wt_force_source */
    /* Opens the source. Name, options and log are set; all other members are zero. After a failure
     * the caller closes the source as well. */
    wt_status (*open)(wt_force_source *source, const struct file_reader *self, wt_input *input,
                      wt_error *err);
    /* Reads the next curve into an empty curve. Returns WT_END after the last curve. */
    wt_status (*next)(wt_force_source *source, wt_force_curve *curve, wt_error *err);
    /* Decodes n samples of a channel of the current segment: values[i] = scaling of the stored
     * number. The values may be non-finite. */
    wt_status (*decode)(wt_force_source *source, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err);
    /* Continues with the curve of this index, which exists. NULL if the earlier curves have to be
     * read. */
    void (*seek)(wt_force_source *source, size_t index);
    void (*close)(wt_force_source *source); /* frees all but the struct itself; may be NULL */
} force_stream;

/* Common state of a source. It is the first member of the struct of each reader. */
struct wt_force_source {
    const force_stream *stream;
    const char *name;        /* name of the input */
    wt_read_options options; /* requested quantities and settings */
    wt_log *log;
    size_t n_curves;                                       /* SIZE_MAX if unknown before reading */
    long grid_columns, grid_rows;                          /* 0 if there is no grid */
    bool constant_checked, heights_checked, given_checked; /* each check runs once */
};

/* Opens the curves of a file with the stream of its reader `self`. The source borrows the input
 * until it is closed. */
wt_status force_open(const force_stream *stream, const struct file_reader *self, wt_input *input,
                     const wt_read_options *options, wt_log *log, wt_force_source **source,
                     wt_error *err);
/* Skips the curves before the one with this index, which was read before. It has no effect if the
 * format cannot skip. */
void force_seek(wt_force_source *source, size_t index);
bool force_is_segment_requested(const wt_force_source *source, wt_segment_kind kind);

/* Returns a positive finite value unchanged, else NaN. */
double force_positive_or_nan(double value);
/* Each quantity is added once; a later addition is ignored. */
void force_add_signal(force_metadata *metadata, force_signal signal);
void force_add_offer(force_metadata *metadata, wt_quantity quantity);
/* Returns NULL if there is none. */
const force_signal *force_find_signal(const force_metadata *metadata, wt_quantity quantity);
/* Adds a segment with the requested quantities, if it has samples. A quantity that cannot be
 * computed is WT_E_MISSING if it was requested by name. It is a warning if all quantities were
 * requested. */
wt_status force_add_segment(wt_force_source *source, const force_metadata *metadata,
                            wt_force_curve *curve, wt_error *err);

/* Sets the grid position of curve `number` of a grid measured line by line. With back_and_forth
 * every other line runs backwards. Returns false if the number lies outside of the grid. */
bool force_set_grid_position(long columns, long rows, bool back_and_forth, size_t number,
                             wt_force_curve *curve);

/* ---- for info ----------------------------------------------------------------------------- */

/* Returns the first offered quantity that is computed from this channel, or WT_Q_NONE. */
wt_quantity force_channel_quantity(const force_metadata *metadata, const wt_read_options *options,
                                   const void *channel);
/* Adds rows with the calibration in use, the sources of the values of the file, and what is missing
 * for a force. */
void force_describe_calibration(const force_metadata *metadata, const wt_read_options *options,
                                const char *spring_constant_source, const char *sensitivity_source,
                                table_writer *list);

#endif
