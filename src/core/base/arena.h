/* Memory that is freed together.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_BASE_ARENA_H
#define WT_CORE_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialised is empty. */
typedef struct pool {
    void **blocks;
    size_t n;
    bool failed; /* an allocation did, so that several need one check */
} pool;

/* n zeroed items; NULL when out of memory. */
void *pool_alloc(pool *memory, size_t n, size_t size);
double *pool_numbers(pool *memory, size_t n);
/* A copy with a terminating zero. */
char *pool_text(pool *memory, const char *text, size_t length);
void pool_free(pool *memory);

#endif
