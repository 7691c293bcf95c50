/* Allocation with a handler for the lack of memory. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"

#include <errno.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <string.h>

static _Thread_local int seen; /* errno of the last resource error; 0 without one */

void resource_error_clear(void)
{
    seen = 0;
}

void resource_error_note(int number)
{
    seen = number;
}

wt_status resource_error_fail(int number, wt_error *err)
{
    resource_error_note(number);
    if (number == ENOMEM)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (number == EMFILE || number == ENFILE) {
        (void)wt_fail(err, WT_E_INTERNAL, "a file that reading needs cannot be opened: %s",
                      strerror(number));
        wt_error_advice(err, MORE_FILES_ADVICE);
        return WT_E_INTERNAL;
    }
    (void)wt_fail(err, WT_E_INTERNAL, "the units database of UDUNITS-2 cannot be read%s%s",
                  number > 0 ? ": " : "", number > 0 ? strerror(number) : "");
    wt_error_advice(err, "install it, or name it in the variable UDUNITS2_XML_PATH");
    return WT_E_INTERNAL;
}

wt_status resource_error_finish(wt_status status, wt_error *err)
{
    return seen != 0 ? resource_error_fail(seen, err) : status;
}

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

char *format_text(const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0)
        out_of_memory(strlen(format));
    return text;
}

FILE *text_stream_open(char **text, size_t *length)
{
    FILE *const stream = open_memstream(text, length);
    if (stream == NULL)
        out_of_memory(BUFSIZ);
    return stream;
}

void text_stream_close(FILE *stream)
{
    /* a stream in memory has no other failure */
    const bool failed = ferror(stream) != 0;
    if (fclose(stream) != 0 || failed)
        out_of_memory(BUFSIZ);
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
