/* e^x of many numbers at a time, in registers as wide as the machine has: a call of the C library
 * for each costs five times as much. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_VECTOR_EXP_H
#define WT_CORE_MATH_VECTOR_EXP_H

#include <stddef.h>

/* e^x[i] and e^x[i] - 1 for x[i] from -infinity to 700, to 2 DBL_EPSILON of themselves; what would
 * be below 1e-307 is 0. */
void exponential(const double *restrict x, size_t n, double *restrict power);
void exponential_less_one(const double *restrict x, size_t n, double *restrict power);

#endif
