/* Arena: memory blocks that are freed together. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_ARENA_H
#define WT_CORE_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

/* A zero-initialised arena is empty. */
typedef struct arena {
    void **blocks;
    size_t n;
    bool failed; /* set by a failed allocation, so that several allocations need one check */
} arena;

/* Allocates n zeroed items; never NULL. */
void *arena_alloc(arena *memory, size_t n, size_t size);
double *arena_numbers(arena *memory, size_t n);
/* Copies a text and adds a terminating zero. */
char *arena_text(arena *memory, const char *text, size_t length);
void arena_free(arena *memory);

#endif
