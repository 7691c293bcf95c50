/* Samples of a channel as an instrument stores them.
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

size_t sample_width(sample_type type); /* [byte] */
/* What is not finite becomes NaN; returns how many. */
size_t samples_mend(double *values, size_t n);
/* values[n] = multiplier * sample + offset, as they come. The caller has checked that the bytes are
 * there. */
void samples_decode(sample_type type, bool big_endian, const unsigned char *bytes, size_t n,
                    double multiplier, double offset, double *values);

#endif
