/* Declares the decoding of samples as an instrument stores them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_SAMPLES_H
#define WT_READ_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>

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

#endif
