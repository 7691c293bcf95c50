/* What a reader is: one descriptor, shared by the binary readers and by the engine that runs the
 * XML descriptions. Detection never opens a file itself and never trusts a name.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_READER_H
#define WT_READ_READER_H

#include "weartrack/read.h"

/* The four honest answers of a detector. */
typedef enum wt_answer {
    WT_ANSWER_NO,          /* not mine */
    WT_ANSWER_YES,         /* mine, with a score */
    WT_ANSWER_UNSUPPORTED, /* mine, but damaged or of a kind that I cannot handle; `reason` says why
                            */
    WT_ANSWER_MORE         /* cannot say yet: show me at least `need` bytes */
} wt_answer;

typedef struct wt_match {
    wt_answer answer;
    int score;        /* 1..100, higher wins; a tie of the highest is an error that names both */
    size_t need;      /* for WT_ANSWER_MORE */
    char reason[160]; /* for WT_ANSWER_UNSUPPORTED, and a hint for `info` */
} wt_match;

/* The beginning of a file. `whole` says that bytes..length is all there is. */
typedef struct wt_peek {
    const unsigned char *bytes;
    size_t length;
    bool whole;
    const char *name; /* as the user wrote it; for messages only */
} wt_peek;

typedef struct wt_reader {
    wt_format_info info; /* id, title, kind, how it was verified: read.h */
    /* `self` is the reader itself (a description carries its own data behind it). */
    wt_match (*detect)(const struct wt_reader *self, const wt_peek *peek);
    /* Kinds that it cannot deliver are NULL. The source borrows the input until it is closed. */
    wt_status (*open_force)(const struct wt_reader *self, wt_input *input,
                            const wt_read_options *options, wt_parselog *log,
                            wt_force_source **source, wt_error *err);
    wt_status (*read_sweep)(const struct wt_reader *self, wt_input *input,
                            const wt_read_options *options, wt_parselog *log, wt_sweep *sweep,
                            wt_error *err);
    wt_status (*read_images)(const struct wt_reader *self, wt_input *input,
                             const wt_read_options *options, wt_parselog *log, wt_image **images,
                             size_t *n_images, wt_error *err);
    wt_status (*read_spectrum)(const struct wt_reader *self, wt_input *input,
                               const wt_read_options *options, wt_parselog *log,
                               wt_power_spectrum *spectrum, wt_error *err);
    /* Adds what `info` shows: segments, channels, calibration, what is missing or odd. */
    wt_status (*describe)(const struct wt_reader *self, wt_input *input,
                          const wt_read_options *options, wt_parselog *log, wt_table *facts,
                          wt_error *err);
} wt_reader;

/* A force source: the first member of each reader's own struct. */
struct wt_force_source {
    wt_status (*next)(wt_force_source *source, wt_force_curve *curve, wt_error *err);
    void (*close)(wt_force_source *source);
    size_t n_curves;              /* SIZE_MAX if not known before reading */
    long grid_columns, grid_rows; /* 0 if there is no grid */
};

/* The binary readers, one file each. */
extern const wt_reader wt_reader_jpk; /* jpk.c */
extern const wt_reader wt_reader_nid; /* nid.c */

#endif
