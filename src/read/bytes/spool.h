/* Declares an input that is written piece by piece; a large one goes to a file without a name
 * (read/bytes/scratch.h).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_SPOOL_H
#define WT_READ_SPOOL_H

#include "weartrack/read.h"

/* A sequence of appended bytes; a zero-initialised spool is empty. */
typedef struct spool {
    unsigned char *bytes; /* all bytes, unless there is a file */
    size_t length, capacity;
    int file;
    bool has_file, has_tried_file;
} spool;
/* Appends n bytes. `name` is the name of the input for messages. */
wt_status spool_add(spool *to, const void *bytes, size_t n, const char *name, wt_error *err);
/* Creates an input from the appended bytes and empties the spool, also on failure. */
wt_status spool_to_input(spool *from, const char *name, wt_input **input, wt_error *err);
void spool_discard(spool *from);

#endif
