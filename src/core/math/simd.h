/* The same code for wider registers where the machine has them; all its operations are correctly
 * rounded, so the bits do not depend on the width. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_SIMD_H
#define WT_CORE_MATH_SIMD_H

#include <stdint.h>
#include <stdlib.h> /* tells glibc, whose resolver it needs */
#include <string.h>

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&                 \
    defined(__GNUC__) && !defined(__clang__)
#define WIDE_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define WIDE_REGISTERS
#endif

/* A part of such code: left as a call it would be narrow. */
#define WIDE_PART __attribute__((always_inline)) static inline

/* Four numbers at once, two and two where registers are no wider. Only for locals: how they are
 * handed on depends on the machine. */
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

/* Each the larger or smaller one; numbers alone. */
static inline void wide_raise(wide *low, const wide *x)
{
    const wide_bits above = *x > *low;
    *low = (wide)((above & (wide_bits)*x) | (~above & (wide_bits)*low));
}

static inline void wide_lower(wide *high, const wide *x)
{
    const wide_bits below = *x < *high;
    *high = (wide)((below & (wide_bits)*x) | (~below & (wide_bits)*high));
}

static inline double simd_sum(const wide *x)
{
    return ((*x)[0] + (*x)[1]) + ((*x)[2] + (*x)[3]);
}

#endif
