/* When memory runs out this command ends, at once and with a word. The library says "out of memory"
 * wherever it allocates, but what it calls does not: UDUNITS, libxml2 and the C library's regular
 * expressions crash, or take an element for a missing one. A program can stand before them all, a
 * library cannot. Nothing is lost by it: what is being written has no name yet.
 *
 * Large pieces are left to who asks: a length in a file can be anything, and a message about the
 * file says more. So are those of another process, such as the one that reads HDF5.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

#include <dlfcn.h>
#include <errno.h>
#include <malloc.h>
#include <unistd.h>

/* A sanitizer brings its own allocator, and stops at the first failure too. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OTHER_ALLOCATOR
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define OTHER_ALLOCATOR
#endif
#endif

enum { LARGE = 1 << 20 };
static pid_t owner;

void cmd_end_without_memory(void)
{
    owner = getpid();
#ifdef __GLIBC__
    /* Else what was freed once raises the size from which pieces are given back to the system, up
     * to 32 MB: the directory of a map would lie beside the table that comes after it. */
    (void)mallopt(M_MMAP_THRESHOLD, LARGE);
    (void)mallopt(M_TRIM_THRESHOLD, LARGE);
#endif
}

#ifndef OTHER_ALLOCATOR

static void *given_memory(void *memory, size_t size)
{
    static const char words[] =
        "weartrack: out of memory: nothing is written; close other programs, "
        "or give it less at a time\n";
    if (memory != NULL || size == 0 || size >= LARGE || owner != getpid())
        return memory;
    (void)!write(STDERR_FILENO, words, sizeof words - 1);
    _exit(CMD_FAILED);
}

/* The function of that name that this one stands before; NULL while the loader looks for it. */
static void *next_function(void **kept, const char *name)
{
    static _Thread_local bool looking;
    if (*kept == NULL && !looking) {
        looking = true;
        *kept = dlsym(RTLD_NEXT, name);
        looking = false;
    }
    if (*kept == NULL)
        errno = ENOMEM;
    return *kept;
}

/* ISO C has no conversion between the two kinds of pointers. */
typedef union function {
    void *found;
    void *(*one)(size_t size);
    void *(*two)(size_t n, size_t size);
    void *(*grow)(void *old, size_t size);
    void *(*aligned)(size_t alignment, size_t size);
} function;

void *malloc(size_t size)
{
    static function real;
    return next_function(&real.found, "malloc") != NULL ? given_memory(real.one(size), size) : NULL;
}

void *calloc(size_t n, size_t size)
{
    static function real;
    /* Where the product overflows there is no such memory. */
    const size_t all = size > 0 && n > SIZE_MAX / size ? SIZE_MAX : n * size;
    return next_function(&real.found, "calloc") != NULL ? given_memory(real.two(n, size), all)
                                                        : NULL;
}

void *realloc(void *old, size_t size)
{
    static function real;
    return next_function(&real.found, "realloc") != NULL ? given_memory(real.grow(old, size), size)
                                                         : NULL;
}

/* FFTW's. */
void *memalign(size_t alignment, size_t size)
{
    static function real;
    return next_function(&real.found, "memalign") != NULL
               ? given_memory(real.aligned(alignment, size), size)
               : NULL;
}

#endif
