/* Decodes the samples of a channel as an instrument stores them.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/samples.h"

#include "core/math/simd.h"
#include "read/bytes/bytes.h"

#include <math.h>

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
