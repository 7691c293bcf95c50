/* Computes e^x of an array in vector registers. A call of the C library for each number costs five
 * times as much. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_VECTOR_EXP_H
#define WT_CORE_MATH_VECTOR_EXP_H

#include <stddef.h>

/* Compute e^x[i] and e^x[i] - 1 for x[i] from -infinity to 700, with a relative error of at most 2
 * DBL_EPSILON. Results below 1e-307 are 0. */
void vector_exp(const double *restrict x, size_t n, double *restrict power);
void vector_expm1(const double *restrict x, size_t n, double *restrict power);

#endif
