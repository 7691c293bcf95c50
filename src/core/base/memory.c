/* Allocation with a handler for the lack of memory. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"

#include <stdatomic.h>
#include <string.h>

static _Atomic(wt_memory_handler *) memory_handler;

wt_memory_handler *wt_memory_set_handler(wt_memory_handler *handler)
{
    return atomic_exchange(&memory_handler, handler);
}

void out_of_memory(size_t size)
{
    wt_memory_handler *const handler = atomic_load(&memory_handler);
    if (handler != NULL)
        handler(size);
    abort();
}

/* The size of n items. An overflow is larger than any memory. */
static size_t bytes_of(size_t n, size_t size)
{
    size_t bytes = 0;
    return __builtin_mul_overflow(n, size, &bytes) ? SIZE_MAX : bytes;
}

/* At least one byte is allocated, because NULL always means a failure. */
void *try_alloc(size_t n, size_t size)
{
    return n > 0 && size > 0 ? calloc(n, size) : calloc(1, 1);
}

void *wt_alloc(size_t n, size_t size)
{
    void *const memory = try_alloc(n, size);
    if (memory == NULL)
        out_of_memory(bytes_of(n, size));
    return memory;
}

void *wt_realloc(void *old, size_t n, size_t size)
{
    const size_t bytes = bytes_of(n, size);
    void *const memory = bytes < SIZE_MAX ? realloc(old, bytes > 0 ? bytes : 1) : NULL;
    if (memory == NULL)
        out_of_memory(bytes);
    return memory;
}

char *wt_strndup(const char *text, size_t n)
{
    char *const copy = wt_alloc(n + 1, 1);
    if (n > 0)
        memcpy(copy, text, n);
    return copy;
}

char *wt_strdup(const char *text)
{
    return wt_strndup(text, strlen(text));
}
