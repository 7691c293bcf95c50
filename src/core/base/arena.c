/* Arena: memory blocks that are freed together. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/arena.h"

#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

void *arena_alloc(arena *memory, size_t n, size_t size)
{
    void **blocks = array_grow(memory->blocks, memory->n, sizeof *blocks);
    memory->blocks = blocks != NULL ? blocks : memory->blocks;
    void *block = blocks != NULL ? calloc(n > 0 ? n : 1, size) : NULL;
    if (block != NULL)
        memory->blocks[memory->n++] = block;
    else
        memory->failed = true;
    return block;
}

double *arena_numbers(arena *memory, size_t n)
{
    return arena_alloc(memory, n, sizeof(double));
}

char *arena_text(arena *memory, const char *text, size_t length)
{
    char *copy = arena_alloc(memory, length + 1, 1);
    if (copy != NULL && length > 0)
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
