/* Decodes the samples of a channel as an instrument stores them. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "read/bytes/samples.h"
#include "core/base/memory.h"
#include "core/math/simd.h"
#include "read/bytes/bytes.h"
#include "read/bytes/input.h"
#include "weartrack/read.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Minimum number of bytes read at once. */
#define READ_AHEAD ((size_t)64 * 1024)

wt_status window_open(input_window *w, wt_input *input, wt_error *err)
{
    *w = (input_window){.input = input};
    const wt_status status = wt_input_size(input, &w->size, err);
    return status == WT_OK && w->size <= SCRATCH_THRESHOLD
               ? wt_input_bytes(input, &w->all, &w->size, err)
               : status;
}

wt_status windows_open(input_window **windows, size_t n, wt_input *input, wt_error *err)
{
    wt_status status = WT_OK;
    *windows = wt_alloc(n, sizeof **windows);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = window_open(&(*windows)[i], input, err);
    return status;
}

static wt_status fill_window(input_window *w, size_t at, size_t n, wt_error *err)
{
    const size_t left = w->size - at, more = n > READ_AHEAD ? n : READ_AHEAD;
    const size_t read = more < left ? more : left;
    w->n = 0;
    if (read > w->capacity) {
        free(w->bytes);
        w->bytes = try_alloc(read, 1);
        w->capacity = w->bytes != NULL ? read : 0;
    }
    if (w->bytes == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a curve");
    const wt_status status = wt_input_copy(w->input, at, w->bytes, read, err);
    w->from = at;
    w->n = status == WT_OK ? read : 0;
    return status;
}

wt_status window_bytes(input_window *w, size_t at, size_t n, const unsigned char **bytes,
                       wt_error *err)
{
    wt_status status = WT_OK;
    if (at > w->size || n > w->size - at)
        return wt_fail(err, WT_E_CORRUPT, "the end of the file is missing");
    if (w->all != NULL) {
        *bytes = w->all + at;
        return WT_OK;
    }
    if (at < w->from || at - w->from > w->n || n > w->n - (at - w->from))
        status = fill_window(w, at, n, err);
    if (status == WT_OK)
        *bytes = w->bytes + (at - w->from);
    return status;
}

void window_close(input_window *w)
{
    free(w->bytes);
    *w = (input_window){0};
}

bool input_contains(wt_input *input, const char *text)
{
    const size_t length = strlen(text);
    input_window w;
    bool found = false;
    wt_status status = window_open(&w, input, NULL);
    for (size_t at = 0; status == WT_OK && !found && w.size - at >= length;) {
        const unsigned char *bytes = NULL;
        const size_t left = w.size - at, n = left < READ_AHEAD ? left : READ_AHEAD;
        status = window_bytes(&w, at, n, &bytes, NULL);
        found = status == WT_OK && memmem(bytes, n, text, length) != NULL;
        at += n - length + 1; /* a match may cross the boundary of two pieces */
    }
    window_close(&w);
    if (status == WT_E_MEMORY)
        resource_error_note(ENOMEM);
    return found;
}

size_t sample_width(sample_type type)
{
    static const size_t widths[] = {2, 2, 4, 4, 4, 8};
    return widths[type];
}

WIDE_REGISTERS static bool samples_are_finite(const double *values, size_t n)
{
    wide sum = {0.0}, x; /* sum of zeros, or NaN */
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        simd_load(&x, values + i);
        sum += 0.0 * x;
    }
    for (; i < n; i++)
        sum[0] += 0.0 * values[i];
    return !isnan(simd_sum(&sum));
}

size_t samples_mark_missing(double *values, size_t n)
{
    size_t missing = 0;
    if (samples_are_finite(values, n))
        return 0;
    for (size_t i = 0; i < n; i++) {
        if (isfinite(values[i]))
            continue;
        values[i] = (double)NAN;
        missing++;
    }
    return missing;
}

/* One loop for each type and byte order, so that the choice is made once and not for each
 * sample. */
#define DECODE_LOOP(width, number)                                                                 \
    for (size_t i = 0; i < n; i++) {                                                               \
        const unsigned char *b = bytes + (width)*i;                                                \
        values[i] = multiplier * (double)(number) + offset;                                        \
    }
#define DECODE(width, number, order)                                                               \
    if (big_endian)                                                                                \
        DECODE_LOOP(width, number(be##order(b)))                                                   \
    else                                                                                           \
        DECODE_LOOP(width, number(le##order(b)))                                                   \
    break

WIDE_REGISTERS void samples_decode(sample_type type, bool big_endian, const unsigned char *bytes,
                                   size_t n, double multiplier, double offset,
                                   double *restrict values)
{
    switch (type) {
    case SAMPLE_INT16:
        DECODE(2, signed16, 16);
    case SAMPLE_UINT16:
        DECODE(2, , 16);
    case SAMPLE_INT32:
        DECODE(4, signed32, 32);
    case SAMPLE_UINT32:
        DECODE(4, , 32);
    case SAMPLE_FLOAT32:
        DECODE(4, float32, 32);
    case SAMPLE_FLOAT64:
        DECODE(8, float64, 64);
    }
}
