/* Loaded before the C library (LD_PRELOAD). It lets one allocation of the program fail, also in a
 * library or in the C library itself, or lists the allocations with different callers.
 *
 *     FAULT_PROGRAM   name of the program to test; others, such as gnuplot, are unchanged
 *     FAULT_ALLOC     number of the allocation that fails, from 1 on
 *     FAULT_FOR_GOOD  if set, all later ones fail too
 *     FAULT_PLACES    file for the numbers of allocations, the first of each call stack
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <execinfo.h>
#include <malloc.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Other names of the functions in the C library. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

enum { MAX_PLACES = 1 << 16, OWN = 3, DEPTH = OWN + 12 };

static bool active, for_good;
static size_t failing; /* 0 = none */
static const char *list;
static atomic_size_t count;
static _Thread_local bool inside; /* backtrace allocates memory. */
static uint64_t seen[MAX_PLACES];
static size_t first_at[MAX_PLACES], n_seen;

__attribute__((noinline)) static void note_place(size_t number)
{
    void *frames[DEPTH];
    uint64_t hash = 1;
    inside = true;
    const int n = backtrace(frames, DEPTH);
    inside = false;
    for (int i = OWN; i < n; i++) /* skips this function, fails() and the allocator */
        hash = (hash ^ (uint64_t)(uintptr_t)frames[i]) * UINT64_C(0x9E3779B97F4A7C15);
    size_t at = (size_t)(hash >> 40) % MAX_PLACES;
    while (seen[at] != 0 && seen[at] != hash)
        at = (at + 1) % MAX_PLACES;
    if (seen[at] == 0 && n_seen < MAX_PLACES / 2) {
        seen[at] = hash;
        first_at[n_seen++] = number;
    }
}

__attribute__((noinline)) static bool fails(void)
{
    if (!active || inside)
        return false;
    const size_t number = atomic_fetch_add(&count, 1) + 1;
    if (list != NULL)
        note_place(number);
    if (failing == 0 || number < failing || (number > failing && !for_good))
        return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    return fails() ? NULL : __libc_calloc(n, size);
}

void *realloc(void *old, size_t size)
{
    return fails() ? NULL : __libc_realloc(old, size);
}

void *memalign(size_t alignment, size_t size)
{
    return fails() ? NULL : __libc_memalign(alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return fails() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    void *const made = fails() ? NULL : __libc_memalign(alignment, size);
    if (made == NULL)
        return ENOMEM;
    *memory = made;
    return 0;
}

/* Counts from about the start of main; earlier allocations belong to the loader. */
__attribute__((constructor)) static void begin(void)
{
    const char *program = getenv("FAULT_PROGRAM"), *number = getenv("FAULT_ALLOC");
    void *frame;
    if (program == NULL || strcmp(program, program_invocation_short_name) != 0)
        return;
    failing = number != NULL ? strtoull(number, NULL, 10) : 0;
    for_good = getenv("FAULT_FOR_GOOD") != NULL;
    list = getenv("FAULT_PLACES");
    if (list != NULL)
        (void)backtrace(&frame, 1); /* backtrace has made its own allocations now. */
    active = true;
}

__attribute__((destructor)) static void end(void)
{
    active = false;
    FILE *const out = list != NULL ? fopen(list, "w") : NULL;
    if (out == NULL)
        return;
    for (size_t i = 0; i < n_seen; i++)
        fprintf(out, "%zu\n", first_at[i]);
    fprintf(out, "%zu\n", atomic_load(&count));
    fclose(out);
}
