/* Force curves from what a reader finds. A reader decodes the layout of its file: which segments
 * and channels there are, in which units, with which calibration. What was asked for is made of
 * that here: force, deflection, time, and what to say of a quantity that cannot be made.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FORCE_ASSEMBLER_H
#define WT_READ_FORCE_ASSEMBLER_H

#include "read/metadata.h"
#include "weartrack/read.h"

/* y = multiplier x + offset */
typedef struct force_linear {
    double multiplier, offset;
} force_linear;

/* A channel of a segment, or what the file's own calibration makes of it: a detector signal with
 * its calibration is a voltage, a deflection and a force. */
typedef struct force_signal {
    wt_quantity quantity;
    const char *name, *unit; /* as exported */
    force_linear to_si;      /* from the numbers of the channel, as `decode` takes them */
    const void *channel;     /* the reader's own */
    const char *problem;     /* why it cannot be read, or NULL */
} force_signal;

/* What a reader says of a segment. */
typedef struct force_metadata {
    wt_segment_kind kind;
    size_t index;      /* number in the file */
    size_t n_points;   /* samples of every channel */
    const char *place; /* in the file, for messages; or NULL */
    double start;      /* time of the first sample [s] */
    double duration;   /* of n_points intervals [s]; NaN if unknown */
    double velocity;   /* [m/s], NaN if unknown */
    double frequency;  /* of a modulation [Hz]; 0 or NaN if unknown */
    double setpoint;   /* of the quantity below, NaN if unknown */
    wt_quantity setpoint_quantity;
    wt_cantilever cantilever; /* that the file's deflections and forces were made with */
    /* What the format has to give; a force is made from any signal. */
    wt_quantity offers[WT_Q_COUNT];
    size_t n_offers;
    force_signal signals[WT_Q_COUNT];
    size_t n_signals;
} force_metadata;

struct file_reader;

/* How a reader streams its curves. */
typedef struct force_stream {
    size_t size; /* of its own struct, whose first member is a wt_force_source */
    /* Name, options and log are set, the rest is zero. What failed is closed like any other. */
    wt_status (*open)(wt_force_source *source, const struct file_reader *self, wt_input *input,
                      wt_error *err);
    /* Fills an empty curve. */
    wt_status (*next)(wt_force_source *source, wt_force_curve *curve, wt_error *err);
    /* values[n] = scaling of the numbers of a channel of the segment that is being read. Whether
     * they are finite is not asked. */
    wt_status (*decode)(wt_force_source *source, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err);
    /* Goes on with the curve of this index, which is there. NULL: those before it are read. */
    void (*seek)(wt_force_source *source, size_t index);
    void (*close)(wt_force_source *source); /* all but the struct itself; NULL: there is nothing */
} force_stream;

/* The first member of each reader's own struct. */
struct wt_force_source {
    const force_stream *stream;
    const char *name;        /* of the input */
    wt_read_options options; /* what was asked for */
    wt_log *log;
    size_t n_curves;              /* SIZE_MAX if not known before reading */
    long grid_columns, grid_rows; /* 0 if there is no grid */
    bool constant_checked, heights_checked, given_checked; /* force_contradiction.h */
};

/* The curves of a file, by the stream of its reader `self`; the source borrows the input until it
 * is closed. */
wt_status force_open(const force_stream *stream, const struct file_reader *self, wt_input *input,
                     const wt_read_options *options, wt_log *log, wt_force_source **source,
                     wt_error *err);
/* Leaves out curves before that of an index that was read before, as far as the format lets it. */
void force_seek(wt_force_source *source, size_t index);
bool force_wants_segment(const wt_force_source *source, wt_segment_kind kind);

/* A calibration, a velocity or a time as a header says it; NaN if that is nothing. */
double force_positive(double value);
/* Each quantity once: what comes first counts. */
void force_add_signal(force_metadata *facts, force_signal signal);
void force_offer(force_metadata *facts, wt_quantity quantity);
/* NULL if there is none. */
const force_signal *force_find_signal(const force_metadata *facts, wt_quantity quantity);
/* Adds a segment, if it has samples, with what was asked for. What cannot be made is WT_E_MISSING
 * if it was asked for by name, a warning if simply everything was. */
wt_status force_add_segment(wt_force_source *source, const force_metadata *facts,
                            wt_force_curve *curve, wt_error *err);

/* Place of curve number `number` of a grid that is measured line by line, every other one on the
 * way back if so; false if it lies outside. */
bool force_place(long columns, long rows, bool back_and_forth, size_t number,
                 wt_force_curve *curve);

/* ---- for info ----------------------------------------------------------------------------- */

/* The first quantity offered that is made of this channel, or WT_Q_NONE. */
wt_quantity force_read_as(const force_metadata *facts, const wt_read_options *options,
                          const void *channel);
/* Rows of the calibration that is used, where the file's own values come from, and what is missing
 * for a force. */
void force_describe_calibration(const force_metadata *facts, const wt_read_options *options,
                                const char *spring_constant_source, const char *sensitivity_source,
                                table_writer *list);

#endif
