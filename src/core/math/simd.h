/* Vector registers: the same code uses wider registers if the machine has them. All operations are
 * correctly rounded, so that the bits do not depend on the width. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CORE_MATH_SIMD_H
#define WT_CORE_MATH_SIMD_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h> /* defines __GLIBC__, whose resolver target_clones needs */
#include <string.h>

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&                 \
    defined(__GNUC__) && !defined(__clang__)
#define WIDE_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define WIDE_REGISTERS
#endif

/* For an inline part of such code. A call would use the narrow registers. */
#define WIDE_INLINE __attribute__((always_inline)) static inline

/* Four numbers, processed in pairs if the registers are narrow. Use the type for local variables
 * only, because the calling convention depends on the machine. */
typedef double wide __attribute__((vector_size(32)));
typedef int64_t wide_bits __attribute__((vector_size(32)));
enum { WIDE = 4 };

static inline void simd_load(wide *to, const double *from)
{
    memcpy(to, from, sizeof *to);
}

static inline void simd_store(double *to, const wide *from)
{
    memcpy(to, from, sizeof *from);
}

/* Replaces each element by the larger or the smaller one of both. The elements must not be NaN. */
static inline void wide_maximum(wide *low, const wide *x)
{
    const wide_bits above = *x > *low;
    *low = (wide)((above & (wide_bits)*x) | (~above & (wide_bits)*low));
}

static inline void wide_minimum(wide *high, const wide *x)
{
    const wide_bits below = *x < *high;
    *high = (wide)((below & (wide_bits)*x) | (~below & (wide_bits)*high));
}

static inline double simd_sum(const wide *x)
{
    return ((*x)[0] + (*x)[1]) + ((*x)[2] + (*x)[3]);
}

/* Compute e^x[i] and e^x[i] - 1 for x[i] from -infinity to 700, with a relative error of at most 2
 * DBL_EPSILON. Results below 1e-307 are 0. */
void vector_exp(const double *restrict x, size_t n, double *restrict power);
void vector_expm1(const double *restrict x, size_t n, double *restrict power);

#endif
