/* Arena: memory blocks that are freed together. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/arena.h"

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
