/* An input that is made piece by piece; what is large goes to a file without a name
 * (read/bytes/scratch.h). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_SPOOL_H
#define WT_READ_SPOOL_H

#include "weartrack/read.h"

/* Bytes that come one behind the other; zero-initialised is empty. */
typedef struct spool {
    unsigned char *bytes; /* all, unless there is a file */
    size_t length, room;
    int file;
    bool has_file, tried;
} spool;
/* `name` is that of the input. */
wt_status spool_add(spool *to, const void *bytes, size_t n, const char *name, wt_error *err);
/* Takes what was added, also on failure. */
wt_status spool_input(spool *from, const char *name, wt_input **input, wt_error *err);
void spool_drop(spool *from);

#endif
