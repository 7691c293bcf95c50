/* Declares inputs of computed bytes, and an input that contains another one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_INPUT_H
#define WT_READ_INPUT_H

#include "weartrack/core.h"
#include "weartrack/read.h"

/* A sequence of appended bytes; a zero-initialised spool is empty. */
typedef struct spool {
    unsigned char *bytes; /* all bytes, unless there is a file */
    size_t length, capacity;
    int file;
    bool has_file, has_tried_file;
} spool;

/* Data up to this size stay in memory, and so does a file that is read in parts [byte]. */
#define SCRATCH_THRESHOLD ((size_t)4 * 1024 * 1024)

/* Creates an input from allocated bytes and takes ownership of them. */
wt_input *input_from_bytes(void *bytes, size_t length, const char *name);

/* Returns the bytes for HDF5 (core/store/hdf5_sandbox.h). They belong to the input, which must
 * outlive them, or to its file if the input is not yet complete in memory. */
struct hdf5_bytes;

wt_status input_hdf5_bytes(wt_input *input, struct hdf5_bytes *bytes, wt_error *err) WT_NODISCARD;
/* Attaches the unpacked content to the input, which then owns it. */
void input_attach_content(wt_input *input, wt_input *content);
/* Returns the innermost attached content; the input itself if it has none. */
wt_input *input_content(wt_input *input);
/* Appends n bytes. `name` is the name of the input for messages. */
wt_status scratch_write(int file, const void *bytes, size_t n, const char *name, wt_error *err);
/* Appends n bytes. `name` is the name of the input for messages. */
wt_status spool_add(spool *to, const void *bytes, size_t n, const char *name, wt_error *err);
/* Creates an input from the appended bytes and empties the spool, also on failure. */
wt_status spool_to_input(spool *from, const char *name, wt_input **input, wt_error *err);
void spool_discard(spool *from);

#endif
