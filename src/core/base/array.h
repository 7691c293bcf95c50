/* Functions for growing arrays and lists of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_ARRAY_H
#define WT_CORE_BASE_ARRAY_H

#include <stddef.h>

/* A zero-initialised arena is empty. */
typedef struct arena {
    void **blocks;
    size_t n;
} arena;

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* Makes space for one more element. The array has n elements, each added with this function.
 * Returns the array or its new position; never NULL. */
void *array_grow(void *array, size_t n, size_t size);

/* Comparison for qsort: increasing numbers, or structures that begin with a number. */
int numbers_compare(const void *a, const void *b);
/* Sorts numbers in increasing order; none of them is NaN. */
void numbers_sort(double *x, size_t n);
/* Returns the median and sorts the numbers; n > 0. */
double numbers_median(double *x, size_t n);
/* Returns the mean of the numbers, summed in their order; n > 0. */
double numbers_mean(const double *x, size_t n);
void numbers_reverse(double *x, size_t n);
/* Allocates n zeroed items; never NULL. */
void *arena_alloc(arena *memory, size_t n, size_t size);
double *arena_numbers(arena *memory, size_t n);
/* Copies a text and adds a terminating zero. */
char *arena_text(arena *memory, const char *text, size_t length);
void arena_free(arena *memory);

#endif
