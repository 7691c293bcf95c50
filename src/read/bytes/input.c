/* Input: the bytes of a file or a pipe (read as far as they were asked for), of a file too large
 * for that (mapped) or of memory (borrowed), all behind the same two functions.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/input.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#define FIRST_READ ((size_t)64 * 1024)
/* A file that another program shortens while it is mapped ends this one with a signal, so only what
 * is too large to be copied is mapped. */
#define MAPPED_FROM ((size_t)1 << 30)

struct wt_input {
    char *name;
    const unsigned char *bytes;
    size_t length;
    bool whole;            /* bytes..length is all there is */
    void *mapping;         /* of `length` bytes, or NULL */
    unsigned char *buffer; /* what was read */
    size_t capacity;
    size_t expected; /* size of a file, 0 of a pipe */
    int fd;          /* -1 if there is nothing left to read or to close */
};

static wt_status input_new(const char *name, wt_input **input, wt_error *err)
{
    wt_input *in = calloc(1, sizeof *in);
    char *copy = strdup(name);
    if (in == NULL || copy == NULL) {
        free(in);
        free(copy);
        wt_fail(err, WT_E_MEMORY, "no memory to open the input");
        wt_error_file(err, name);
        return WT_E_MEMORY;
    }
    in->name = copy;
    in->fd = -1;
    *input = in;
    return WT_OK;
}

static wt_status fail_io(const wt_input *in, wt_error *err, int number, const char *what)
{
    wt_status status = number == ENOENT ? WT_E_NOT_FOUND : WT_E_IO;
    wt_fail(err, status, "%s: %s", what, strerror(number));
    wt_error_file(err, in->name);
    return status;
}

static wt_status map_file(wt_input *in, size_t size, wt_error *err)
{
    void *mapping = mmap(NULL, size, PROT_READ, MAP_PRIVATE, in->fd, 0);
    if (mapping == MAP_FAILED)
        return fail_io(in, err, errno, "cannot be mapped");
    in->mapping = mapping;
    in->bytes = mapping;
    in->length = size;
    in->whole = true;
    close(in->fd);
    in->fd = -1;
    return WT_OK;
}

wt_status wt_input_open(const char *path, wt_input **input, wt_error *err)
{
    wt_input *in = NULL;
    if (path == NULL || *path == '\0')
        return wt_fail(err, WT_E_ARG, "no file name given");
    wt_status status = input_new(path, &in, err);
    if (status != WT_OK)
        return status;
    bool standard = strcmp(path, "-") == 0;
    /* The number of standard input is duplicated, so that closing the input leaves it open. */
    in->fd = standard ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : open(path, O_RDONLY | O_CLOEXEC);
    if (in->fd < 0) {
        status = fail_io(in, err, errno, "cannot be opened");
        goto fail;
    }
    struct stat st;
    if (fstat(in->fd, &st) != 0) {
        status = fail_io(in, err, errno, "cannot be examined");
        goto fail;
    }
    if ((status = wt_guard_read(path, err)) != WT_OK)
        goto fail;
    if (S_ISDIR(st.st_mode)) {
        status = wt_fail(err, WT_E_ARG, "is a folder");
        wt_error_file(err, path);
        wt_error_expected(err, "a file");
        goto fail;
    }
    /* Standard input that was redirected from a file may stand anywhere in it: read it as a pipe.
     */
    if (S_ISREG(st.st_mode) && !standard) {
        in->expected = (size_t)st.st_size;
        if (in->expected >= MAPPED_FROM)
            status = map_file(in, in->expected, err);
        if (status != WT_OK)
            goto fail;
    }
    *input = in;
    return WT_OK;
fail:
    wt_input_close(in);
    return status;
}

wt_status wt_input_open_memory(const void *bytes, size_t length, const char *name, wt_input **input,
                               wt_error *err)
{
    if (bytes == NULL && length > 0)
        return wt_fail(err, WT_E_ARG, "no bytes given");
    wt_input *in = NULL;
    wt_status status = input_new(name == NULL ? "memory" : name, &in, err);
    if (status != WT_OK)
        return status;
    in->bytes = bytes;
    in->length = length;
    in->whole = true;
    *input = in;
    return WT_OK;
}

wt_status input_own(char *bytes, size_t length, const char *name, wt_input **input, wt_error *err)
{
    wt_input *in = NULL;
    wt_status status = wt_input_open_memory(bytes, length, name, &in, err);
    if (status != WT_OK) {
        free(bytes);
        return status;
    }
    in->buffer = (unsigned char *)bytes;
    *input = in;
    return WT_OK;
}

void wt_input_close(wt_input *input)
{
    if (input == NULL)
        return;
    if (input->mapping != NULL)
        munmap(input->mapping, input->length);
    if (input->fd >= 0)
        close(input->fd);
    free(input->buffer);
    free(input->name);
    free(input);
}

const char *wt_input_name(const wt_input *input)
{
    return input->name;
}

/* Reads on until `want` bytes are there or it ends. A file gets its memory at once, with one byte
 * more in which its end is seen; but a part of it is read in parts. */
static wt_status fill(wt_input *in, size_t want, wt_error *err)
{
    while (!in->whole && in->length < want) {
        if (in->length == in->capacity) {
            size_t capacity = in->capacity > 0   ? in->capacity
                              : in->expected > 0 ? in->expected + 1
                                                 : FIRST_READ;
            if (in->capacity > SIZE_MAX / 2)
                return wt_fail(err, WT_E_MEMORY, "input too large");
            if (in->capacity > 0)
                capacity *= 2;
            unsigned char *buffer = realloc(in->buffer, capacity);
            if (buffer == NULL) {
                wt_fail(err, WT_E_MEMORY, "no memory for %zu bytes of input", capacity);
                wt_error_file(err, in->name);
                return WT_E_MEMORY;
            }
            in->buffer = buffer;
            in->bytes = buffer;
            in->capacity = capacity;
        }
        size_t room = in->capacity - in->length;
        if (want - in->length < room && room > FIRST_READ)
            room = want - in->length > FIRST_READ ? want - in->length : FIRST_READ;
        ssize_t got = read(in->fd, in->buffer + in->length, room);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return fail_io(in, err, errno, "cannot be read");
        if (got == 0)
            in->whole = true;
        in->length += (size_t)got;
    }
    return WT_OK;
}

wt_status wt_input_bytes(wt_input *input, const unsigned char **bytes, size_t *length,
                         wt_error *err)
{
    bool whole;
    return wt_input_peek(input, SIZE_MAX, bytes, length, &whole, err);
}

wt_status wt_input_peek(wt_input *input, size_t want, const unsigned char **bytes, size_t *length,
                        bool *whole, wt_error *err)
{
    wt_status status = fill(input, want, err);
    if (status != WT_OK)
        return status;
    *bytes = input->bytes;
    *length = input->length;
    *whole = input->whole;
    return WT_OK;
}
