/* Arrays of known length and lists of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_BASE_ARRAY_H
#define WT_BASE_ARRAY_H

#include <stddef.h>

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* Sorts numbers, none of which is NaN, rising. */
void numbers_sort(double *x, size_t n);

#endif
