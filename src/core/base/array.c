/* Growing arrays and statistics of lists of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "weartrack/core.h"

#include <stdlib.h>
#include <string.h>

void *arena_alloc(arena *memory, size_t n, size_t size)
{
    memory->blocks = array_grow(memory->blocks, memory->n, sizeof *memory->blocks);
    return memory->blocks[memory->n++] = wt_alloc(n, size);
}

double *arena_numbers(arena *memory, size_t n)
{
    return arena_alloc(memory, n, sizeof(double));
}

char *arena_text(arena *memory, const char *text, size_t length)
{
    char *copy = arena_alloc(memory, length + 1, 1);
    if (length > 0)
        memcpy(copy, text, length);
    return copy;
}

void arena_free(arena *memory)
{
    for (size_t i = 0; i < memory->n; i++)
        free(memory->blocks[i]);
    free(memory->blocks);
    *memory = (arena){0};
}

/* The capacity is a power of two, so that a full array is recognised from n. */
void *array_grow(void *array, size_t n, size_t size)
{
    enum { FIRST = 8 };
    const bool full = n == 0 || (n >= FIRST && (n & (n - 1)) == 0);
    if (!full)
        return array;
    return wt_realloc(array, n == 0 ? FIRST : 2 * n, size);
}

int numbers_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

void numbers_sort(double *x, size_t n)
{
    qsort(x, n, sizeof *x, numbers_compare);
}

double numbers_median(double *x, size_t n)
{
    numbers_sort(x, n);
    return n % 2 == 1 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

double numbers_mean(const double *x, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i];
    return sum / (double)n;
}

void numbers_reverse(double *x, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        const double kept = x[i];
        x[i] = x[n - 1 - i];
        x[n - 1 - i] = kept;
    }
}
