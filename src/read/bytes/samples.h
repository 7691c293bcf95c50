/* Declares the decoding of samples as an instrument stores them. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_SAMPLES_H
#define WT_READ_SAMPLES_H

#include "weartrack/read.h"

typedef struct input_window {
    wt_input *input;
    size_t size;              /* size of the input */
    const unsigned char *all; /* bytes of an input that is in memory anyway, or NULL */
    unsigned char *bytes;     /* [n] bytes from offset `from` */
    size_t from, n, capacity;
} input_window;

typedef enum sample_type {
    SAMPLE_INT16,
    SAMPLE_UINT16,
    SAMPLE_INT32,
    SAMPLE_UINT32,
    SAMPLE_FLOAT32,
    SAMPLE_FLOAT64
} sample_type;

size_t sample_width(sample_type type); /* size of a sample [byte] */
/* Replaces non-finite values by NaN and returns their number. */
size_t samples_mark_missing(double *values, size_t n);
/* Computes values[i] = multiplier * sample + offset; the values may be non-finite. The caller has
 * checked that the bytes exist. */
void samples_decode(sample_type type, bool big_endian, const unsigned char *bytes, size_t n,
                    double multiplier, double offset, double *values);
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
