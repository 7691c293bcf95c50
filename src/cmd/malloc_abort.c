/* Ends the command with a message when memory runs out. The library calls the handler of
 * wt_memory_set_handler, but its dependencies do not: UDUNITS, libxml2 and the regular expressions
 * of the C library crash or treat an element as missing. A program can replace the allocator, a
 * library cannot. No output is lost, as unfinished files have temporary names.
 *
 * Large allocations return NULL to their caller: a length in a file can be anything, and a message
 * about the file is more useful. The same holds in other processes, such as the one that reads
 * HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

#include <dlfcn.h>
#include <errno.h>
#include <malloc.h>
#include <unistd.h>

/* A sanitizer has its own allocator and also stops at the first failure. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZER_ALLOCATOR
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZER_ALLOCATOR
#endif
#endif

enum { LARGE = 1 << 20 };
static pid_t owner;

void cmd_exit_without_memory(size_t size)
{
    static const char words[] =
        "weartrack: out of memory: nothing is written; close other programs, "
        "or give it less at a time\n";
    (void)size;
    (void)!write(STDERR_FILENO, words, sizeof words - 1);
    _exit(CMD_FAILED);
}

void cmd_exit_on_allocation_failure(void)
{
    owner = getpid();
    (void)wt_memory_set_handler(cmd_exit_without_memory);
#ifdef __GLIBC__
    /* Fixed thresholds. Otherwise glibc raises them up to 32 MB after a large block is freed, and
     * keeps memory of a map that it could return to the system. */
    (void)mallopt(M_MMAP_THRESHOLD, LARGE);
    (void)mallopt(M_TRIM_THRESHOLD, LARGE);
#endif
}

#ifndef SANITIZER_ALLOCATOR

static void *check_allocation(void *memory, size_t size)
{
    if (memory != NULL || size == 0 || size >= LARGE || owner != getpid())
        return memory;
    cmd_exit_without_memory(size);
}

/* Returns the next function of that name in the loading order; NULL while the loader searches for
 * it. */
static void *find_next_function(void **cache, const char *name)
{
    static _Thread_local bool looking;
    if (*cache == NULL && !looking) {
        looking = true;
        *cache = dlsym(RTLD_NEXT, name);
        looking = false;
    }
    if (*cache == NULL)
        errno = ENOMEM;
    return *cache;
}

/* ISO C has no conversion between object and function pointers. */
typedef union allocator_function {
    void *found;
    void *(*one)(size_t size);
    void *(*two)(size_t n, size_t size);
    void *(*grow)(void *old, size_t size);
    void *(*aligned)(size_t alignment, size_t size);
} allocator_function;

void *malloc(size_t size)
{
    static allocator_function real;
    return find_next_function(&real.found, "malloc") != NULL
               ? check_allocation(real.one(size), size)
               : NULL;
}

void *calloc(size_t n, size_t size)
{
    static allocator_function real;
    /* An overflowing product is larger than any memory. */
    const size_t all = size > 0 && n > SIZE_MAX / size ? SIZE_MAX : n * size;
    return find_next_function(&real.found, "calloc") != NULL
               ? check_allocation(real.two(n, size), all)
               : NULL;
}

void *realloc(void *old, size_t size)
{
    static allocator_function real;
    return find_next_function(&real.found, "realloc") != NULL
               ? check_allocation(real.grow(old, size), size)
               : NULL;
}

/* FFTW calls it. */
void *memalign(size_t alignment, size_t size)
{
    static allocator_function real;
    return find_next_function(&real.found, "memalign") != NULL
               ? check_allocation(real.aligned(alignment, size), size)
               : NULL;
}

#endif
