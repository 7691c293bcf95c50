/* Arrays of known length and lists of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_ARRAY_H
#define WT_CORE_BASE_ARRAY_H

#include <stddef.h>

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* An array of n elements, which were added one by one by this function alone, with room for one
 * more: `array`, or where it is moved to; NULL when out of memory. */
void *array_grow(void *array, size_t n, size_t size);

/* For qsort: rising numbers, or structures that begin with one. */
int numbers_compare(const void *a, const void *b);
/* Sorts numbers, none of which is NaN, rising. */
void numbers_sort(double *x, size_t n);
/* Sorts them; n > 0. */
double numbers_median(double *x, size_t n);
/* By their sum as they stand; n > 0. */
double numbers_mean(const double *x, size_t n);
void numbers_reverse(double *x, size_t n);

#endif
