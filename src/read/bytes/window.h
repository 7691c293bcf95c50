/* Declares the sequential access to parts of an input with read-ahead, for files whose curves are
 * stored in blocks.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_WINDOW_H
#define WT_READ_WINDOW_H

#include "weartrack/read.h"

typedef struct input_window {
    wt_input *input;
    size_t size;              /* size of the input */
    const unsigned char *all; /* bytes of an input that is in memory anyway, or NULL */
    unsigned char *bytes;     /* [n] bytes from offset `from` */
    size_t from, n, capacity;
} input_window;

wt_status window_open(input_window *window, wt_input *input, wt_error *err);
/* Opens n windows of one input. The caller closes and frees *windows, also after a failure; it may
 * be NULL. */
wt_status windows_open(input_window **windows, size_t n, wt_input *input, wt_error *err);
/* Returns the bytes [at, at + n), valid until the next call. */
wt_status window_bytes(input_window *window, size_t at, size_t n, const unsigned char **bytes,
                       wt_error *err);
void window_close(input_window *window);

/* True if the input contains this text; false if it cannot be read. */
bool input_contains(wt_input *input, const char *text);

#endif
