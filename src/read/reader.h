/* Declares the descriptor of a reader, for the binary readers and for the engine of the XML
 * descriptions. Detection never opens a file itself and never relies on the file name.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_READER_H
#define WT_READ_READER_H

#include "read/header_values.h"
#include "weartrack/read.h"

#include <string.h>

/* Answers of a detector. */
typedef enum detector_answer {
    ANSWER_NO,          /* another format */
    ANSWER_YES,         /* recognised, with a score */
    ANSWER_UNSUPPORTED, /* recognised, but damaged or unsupported; `reason` states why */
    ANSWER_MORE,        /* undecided; needs at least `need` bytes */
    ANSWER_FAILED       /* the cause is in the error of the peek */
} detector_answer;

typedef struct recognition {
    detector_answer answer;
    int score;        /* 1 to 100; the highest wins, a tie is an error */
    size_t need;      /* for ANSWER_MORE */
    char reason[160]; /* for ANSWER_UNSUPPORTED */
} recognition;

/* The beginning of a file. `whole`: these bytes are the complete file. */
typedef struct file_peek {
    const unsigned char *bytes;
    size_t length;
    bool whole;
    const char *name; /* as the user typed it; for messages only */
    wt_input *input;  /* for a detector that reads further parts; `bytes` may then become invalid */
    wt_error *err;    /* cause of ANSWER_FAILED */
    struct text_peek *text; /* shared decoding of the text readers; text_peek_free frees it */
} file_peek;

typedef struct file_reader {
    wt_format_info info; /* id, title, kind, how it was verified: read.h */
    const char *runs;    /* id of the description that a binary reader runs, or NULL */
    struct text_description *description; /* the description that it runs, or NULL */
    /* Converts the file to the text that the description reads; the caller closes it. NULL if the
     * input is that text. */
    wt_status (*as_text)(const struct file_reader *self, wt_input *input, wt_log *log,
                         wt_input **text, wt_error *err);
    const struct hdf5_curves *hdf5; /* for hdf5_as_text (hierarchy/curves_hdf5.h), or NULL */
    /* `self` is this reader. */
    recognition (*detect)(const struct file_reader *self, file_peek *peek);
    /* The functions of unsupported kinds of data are NULL. */
    const struct force_stream *force; /* force_assembler.h */
    wt_status (*read_sweep)(const struct file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_sweep *sweep,
                            wt_error *err);
    wt_status (*read_images)(const struct file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err);
    wt_status (*read_spectrum)(const struct file_reader *self, wt_input *input,
                               const wt_read_options *options, wt_log *log,
                               wt_power_spectrum *spectrum, wt_error *err);
    wt_status (*read_record)(const struct file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_record *record,
                             wt_error *err);
    /* Adds the rows of the curves of a reader that is described by images_describe (images.h), or
     * NULL. */
    wt_status (*describe_curves)(wt_input *input, const wt_read_options *options, wt_log *log,
                                 table_writer *metadata, wt_error *err);
    /* Adds the rows for `info`: segments, channels, calibration and defects. Fails if the file
     * cannot be read. */
    wt_status (*describe)(const struct file_reader *self, wt_input *input,
                          const wt_read_options *options, wt_log *log, table_writer *metadata);
} file_reader;

/* peek_begins: true if the file begins with these bytes. peek_contains: true if the visible part
 * contains them. */
static inline bool peek_begins(const file_peek *peek, const char *bytes, size_t n)
{
    return peek->length >= n && memcmp(peek->bytes, bytes, n) == 0;
}

static inline bool peek_contains(const file_peek *peek, const char *bytes, size_t n)
{
    return memmem(peek->bytes, peek->length, bytes, n) != NULL;
}
#define PEEK_BEGINS(peek, text) peek_begins(peek, text, sizeof(text) - 1)
#define PEEK_CONTAINS(peek, text) peek_contains(peek, text, sizeof(text) - 1)
#define HDF5_SIGNATURE "\211HDF\r\n\032\n"
/* Returns ANSWER_YES with this score, or ANSWER_NO. */
static inline recognition recognition_result(bool matches, int score)
{
    return matches ? (recognition){.answer = ANSWER_YES, .score = score}
                   : (recognition){.answer = ANSWER_NO};
}

#define READER(id) extern const file_reader reader_##id;
#include "read/readers.def"

#endif
