/* What a reader is: one descriptor, shared by the binary readers and by the engine that runs the
 * XML descriptions. Detection never opens a file itself and never trusts a name.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_READER_H
#define WT_READ_READER_H

#include "read/metadata.h"
#include "weartrack/read.h"

/* The honest answers of a detector. */
typedef enum detector_answer {
    ANSWER_NO,          /* not mine */
    ANSWER_YES,         /* mine, with a score */
    ANSWER_UNSUPPORTED, /* mine, but damaged or of a kind that I cannot handle; `reason` says why */
    ANSWER_MORE,        /* cannot say yet: show me at least `need` bytes */
    ANSWER_NO_MEMORY
} detector_answer;

typedef struct recognition {
    detector_answer answer;
    int score;        /* 1..100, higher wins; a tie of the highest is an error that names both */
    size_t need;      /* for ANSWER_MORE */
    char reason[160]; /* for ANSWER_UNSUPPORTED, and a hint for `info` */
} recognition;

/* The beginning of a file. `whole` says that bytes..length is all there is. */
typedef struct file_peek {
    const unsigned char *bytes;
    size_t length;
    bool whole;
    const char *name;       /* as the user wrote it; for messages only */
    wt_input *input;        /* for a detector that must look far behind; the bytes may move then */
    struct text_peek *text; /* what the text readers made of it for each other; text_peek_free */
} file_peek;

typedef struct file_reader {
    wt_format_info info; /* id, title, kind, how it was verified: read.h */
    const char *runs;    /* id of the description that a binary reader runs, or NULL */
    struct text_description *description; /* that it runs, or NULL */
    /* The text that the description reads, to be closed; NULL: the input itself. */
    wt_status (*as_text)(const struct file_reader *self, wt_input *input, wt_log *log,
                         wt_input **text, wt_error *err);
    const struct hdf5_curves *hdf5; /* that hdf5_as_text reads (hierarchy/curves_hdf5.h), or NULL */
    /* `self` is the reader itself. */
    recognition (*detect)(const struct file_reader *self, file_peek *peek);
    /* Kinds that it cannot deliver are NULL. */
    const struct force_stream *force; /* force_source.h */
    wt_status (*read_sweep)(const struct file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_sweep *sweep,
                            wt_error *err);
    wt_status (*read_images)(const struct file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err);
    wt_status (*read_spectrum)(const struct file_reader *self, wt_input *input,
                               const wt_read_options *options, wt_log *log,
                               wt_power_spectrum *spectrum, wt_error *err);
    wt_status (*read_noise)(const struct file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log,
                            wt_noise_spectrum *spectrum, wt_error *err);
    wt_status (*read_record)(const struct file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_record *record,
                             wt_error *err);
    /* Adds what `info` shows: segments, channels, calibration, what is missing or odd. Fails with
     * what hinders reading. */
    wt_status (*describe)(const struct file_reader *self, wt_input *input,
                          const wt_read_options *options, wt_log *log, table_writer *facts);
} file_reader;

/* A reader that knows its files by their words is asked only where no signature answered. */
static inline bool reader_is_text(const file_reader *reader)
{
    return reader->description != NULL && reader->runs == NULL;
}

/* Detection by bytes: whether the file begins with them, or they stand in what is shown of it. */
bool peek_begins(const file_peek *peek, const char *bytes, size_t n);
bool peek_holds(const file_peek *peek, const char *bytes, size_t n);
#define PEEK_BEGINS(peek, text) peek_begins(peek, text, sizeof(text) - 1)
#define PEEK_HOLDS(peek, text) peek_holds(peek, text, sizeof(text) - 1)
#define HDF5_SIGNATURE "\211HDF\r\n\032\n"
/* Mine, with that score, or not. */
recognition recognised(bool mine, int score);

#define READER(id) extern const file_reader reader_##id;
#include "read/readers.def"

#endif
