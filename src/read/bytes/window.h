/* Parts of an input one after the other, some of what comes behind each read with it: for files
 * whose curves stand in blocks. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_WINDOW_H
#define WT_READ_WINDOW_H

#include "weartrack/read.h"

typedef struct input_window {
    wt_input *input;
    size_t size;              /* of the input */
    const unsigned char *all; /* of one that is in memory anyway, or NULL */
    unsigned char *bytes;     /* [n] from `from` on */
    size_t from, n, room;
} input_window;

wt_status window_open(input_window *window, wt_input *input, wt_error *err);
/* n of one input; *windows, to be closed and freed, is there on failure, too, or NULL. */
wt_status windows_open(input_window **windows, size_t n, wt_input *input, wt_error *err);
/* Bytes [at, at + n), which are there until the next call. */
wt_status window_bytes(input_window *window, size_t at, size_t n, const unsigned char **bytes,
                       wt_error *err);
void window_close(input_window *window);

/* Whether these words stand anywhere in it; false if it cannot be read. */
bool input_has(wt_input *input, const char *words);

#endif
