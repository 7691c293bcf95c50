/* Computes e^x of an array: x = k ln 2 + r, with a polynomial in r. SPDX-License-Identifier:
 * GPL-3.0-or-later */

#include "core/math/simd.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Returns 2^k; the lowest bits of the argument contain k. */
static inline double power_of_two(double shifted)
{
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits << 52) + (UINT64_C(1023) << 52);
    memcpy(&shifted, &bits, sizeof shifted);
    return shifted;
}

/* Splits e^x = 2^k (1 + *rest) with |*rest| < 0.42; returns 2^k. */
static inline double split_exponential(double x, double *rest)
{
    const double shift = 0x1.8p52; /* large enough that its last bit is the unit */
    /* The product of k and the first part of ln 2 is exact. */
    const double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double lowest = -708;
    const double kept = x < lowest ? lowest : x;
    const double shifted = kept * M_LOG2E + shift;
    const double k = shifted - shift;
    const double r = (kept - k * ln2_high) - k * ln2_low;
    /* Sum of r^j / (j + 2)!. Even and odd j are independent chains, so that neither waits for the
     * other. */
    const double square = r * r;
    double even = 1 / 479001600.0, odd = 1 / 6227020800.0;
    even = even * square + 1 / 3628800.0;
    odd = odd * square + 1 / 39916800.0;
    even = even * square + 1 / 40320.0;
    odd = odd * square + 1 / 362880.0;
    even = even * square + 1 / 720.0;
    odd = odd * square + 1 / 5040.0;
    even = even * square + 1 / 24.0;
    odd = odd * square + 1 / 120.0;
    even = even * square + 0.5;
    odd = odd * square + 1 / 6.0;
    *rest = r + square * (even + r * odd);
    return x < lowest ? 0 : power_of_two(shifted);
}

WIDE_REGISTERS
void vector_exp(const double *restrict x, size_t n, double *restrict power)
{
    for (size_t i = 0; i < n; i++) {
        double rest;
        const double scale = split_exponential(x[i], &rest);
        power[i] = scale + scale * rest;
    }
}

WIDE_REGISTERS
void vector_expm1(const double *restrict x, size_t n, double *restrict power)
{
    for (size_t i = 0; i < n; i++) {
        double rest;
        const double scale = split_exponential(x[i], &rest);
        power[i] = (scale - 1) + scale * rest;
    }
}
