/* Implements inputs: the bytes of a file or pipe, read as far as requested, or of borrowed memory.
 *
 * A file is never mapped, since another program that shortens it would end this one with a signal.
 * A large pipe is stored in a file if parts of it are requested. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "read/bytes/input.h"
#include "core/store/hdf5_sandbox.h"
#include "core/system/temporary.h"
#include "weartrack/read.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/vfs.h>
#include <unistd.h>

/* Opens a file in temporary_directory(); -1 if there is no such folder. The caller then uses
 * memory. */
static int scratch_open(void)
{
    const char *const folder = temporary_directory();
    int file = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0)
        return file;
    /* some file systems do not support O_TMPFILE */
    char *const path = wt_path_join(folder, "weartrack-XXXXXX");
    file = mkostemp(path, O_CLOEXEC);
    if (file >= 0)
        (void)unlink(path);
    free(path);
    return file;
}

wt_status scratch_write(int file, const void *bytes, size_t n, const char *name, wt_error *err)
{
    for (size_t done = 0; done < n;) {
        const ssize_t written = write(file, (const char *)bytes + done, n - done);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0) {
            wt_fail(err, WT_E_IO, "cannot be kept while it is read: %s", strerror(errno));
            wt_error_file(err, name);
            wt_error_advice(err, "set TMPDIR to a folder with room for all of it, unpacked");
            return WT_E_IO;
        }
        done += (size_t)written;
    }
    return WT_OK;
}

#define FIRST_READ ((size_t)64 * 1024)

struct wt_input {
    char *name;
    const unsigned char *bytes;
    size_t length;
    bool whole;            /* `length` bytes are the complete input */
    unsigned char *buffer; /* bytes read so far; owned */
    size_t capacity;
    size_t expected;   /* size of a file, 0 for a pipe */
    size_t most;       /* largest number of bytes that is kept */
    wt_input *content; /* unpacked input, or NULL */
    int fd;            /* -1 if nothing is left to read or to close */
    bool lost;         /* true if bytes of a pipe were lost; then nothing more is read */
};

static wt_input *input_new(const char *name)
{
    wt_input *in = wt_alloc(1, sizeof *in);
    in->name = wt_strdup(name);
    in->fd = -1;
    in->most = WT_INPUT_LIMIT;
    return in;
}

void wt_input_limit(wt_input *input, size_t most)
{
    input->most = most;
}

static wt_status fail_io(const wt_input *in, wt_error *err, int number, const char *what)
{
    wt_status status = number == ENOENT ? WT_E_NOT_FOUND : WT_E_IO;
    wt_fail(err, status, "%s: %s", what, strerror(number));
    wt_error_file(err, in->name);
    return status;
}

static wt_status fail_kind(const char *name, const char *what, wt_error *err)
{
    wt_fail(err, WT_E_ARG, "%s", what);
    wt_error_file(err, name);
    wt_error_expected(err, "a file");
    return WT_E_ARG;
}

/* Opens a file without blocking, since a named pipe may never get a writer. An anonymous pipe, such
 * as that of a shell's <(...), is accepted. */
static wt_status open_input_file(wt_input *in, const char *path, struct stat *info, wt_error *err)
{
    struct statfs system;
    in->fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (in->fd < 0)
        return fail_io(in, err, errno, "cannot be opened");
    if (fstat(in->fd, info) != 0 || fstatfs(in->fd, &system) != 0)
        return fail_io(in, err, errno, "cannot be examined");
    if (S_ISFIFO(info->st_mode) && system.f_type != PIPEFS_MAGIC) {
        (void)fail_kind(path, "is a named pipe", err);
        wt_error_advice(err, "give it as standard input: weartrack ... - < PIPE");
        return WT_E_ARG;
    }
    if (S_ISCHR(info->st_mode) || S_ISBLK(info->st_mode)) /* it may never end */
        return fail_kind(path, "is a device", err);
    if (fcntl(in->fd, F_SETFL, O_RDONLY) != 0)
        return fail_io(in, err, errno, "cannot be examined");
    return WT_OK;
}

static wt_status open_standard_input(wt_input *in, struct stat *info, wt_error *err)
{
    /* The descriptor is duplicated, so that standard input stays open when the input is closed. */
    in->fd = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
    if (in->fd < 0)
        return fail_io(in, err, errno, "cannot be opened");
    if (fstat(in->fd, info) != 0)
        return fail_io(in, err, errno, "cannot be examined");
    /* Devices other than a terminal and the null device may never end. */
    const bool ends =
        S_ISCHR(info->st_mode) && (info->st_rdev == makedev(1, 3) || isatty(in->fd) != 0);
    if ((S_ISCHR(info->st_mode) && !ends) || S_ISBLK(info->st_mode))
        return fail_kind(in->name, "is a device", err);
    return WT_OK;
}

wt_status wt_input_open(const char *path, wt_input **input, wt_error *err)
{
    if (path == NULL || *path == '\0')
        return wt_fail(err, WT_E_ARG, "no file name given");
    wt_input *const in = input_new(path);
    const bool standard = strcmp(path, "-") == 0;
    struct stat st;
    wt_status status =
        standard ? open_standard_input(in, &st, err) : open_input_file(in, path, &st, err);
    if (status == WT_OK)
        wt_protect_input(path);
    if (status == WT_OK && S_ISDIR(st.st_mode)) {
        status = fail_kind(path, "is a folder", err);
        wt_error_advice(err, "'%s/*' names the files in it", path);
    }
    if (status != WT_OK) {
        wt_input_close(in);
        return status;
    }
    /* Standard input redirected from a file may have any offset; it is then read as a pipe. */
    if (S_ISREG(st.st_mode) && (!standard || lseek(in->fd, 0, SEEK_CUR) == 0))
        in->expected = (size_t)st.st_size;
    *input = in;
    return WT_OK;
}

wt_status wt_input_open_memory(const void *bytes, size_t length, const char *name, wt_input **input,
                               wt_error *err)
{
    if (bytes == NULL && length > 0)
        return wt_fail(err, WT_E_ARG, "no bytes given");
    wt_input *const in = input_new(name == NULL ? "memory" : name);
    in->bytes = bytes;
    in->length = length;
    in->whole = true;
    *input = in;
    return WT_OK;
}

wt_input *input_from_bytes(void *bytes, size_t length, const char *name)
{
    wt_input *const in = input_new(name);
    in->bytes = in->buffer = bytes;
    in->length = length;
    in->whole = true;
    return in;
}

/* Creates an input from an open file of `size` bytes and takes ownership of the descriptor, also on
 * failure. No other program writes to the file. */
static wt_status input_from_file(int file, size_t size, const char *name, wt_input **input,
                                 wt_error *err)
{
    wt_input *const in = input_new(name);
    in->fd = file;
    in->expected = size;
    if (lseek(file, 0, SEEK_SET) == 0) {
        *input = in;
        return WT_OK;
    }
    const wt_status status = fail_io(in, err, errno, "cannot be read");
    wt_input_close(in);
    return status;
}

wt_status wt_input_sibling(const wt_input *input, wt_input **sibling, wt_error *err)
{
    *sibling = NULL;
    if (input->whole || input->expected <= SCRATCH_THRESHOLD)
        return WT_OK;
    const int fd = fcntl(input->fd, F_DUPFD_CLOEXEC, 0);
    if (fd < 0)
        return fail_io(input, err, errno, "cannot be opened once more");
    *sibling = input_new(input->name);
    (*sibling)->expected = input->expected;
    (*sibling)->most = input->most;
    (*sibling)->fd = fd;
    return WT_OK;
}

void wt_input_close(wt_input *input)
{
    if (input == NULL)
        return;
    wt_input_close(input->content);
    if (input->fd >= 0)
        close(input->fd);
    free(input->buffer);
    free(input->name);
    free(input);
}

void input_attach_content(wt_input *input, wt_input *content)
{
    wt_input_close(input->content);
    input->content = content;
}

wt_input *input_content(wt_input *input)
{
    while (input->content != NULL)
        input = input->content;
    return input;
}

const char *wt_input_name(const wt_input *input)
{
    return input->name;
}

static wt_status fail_lost_bytes(const wt_input *in, wt_error *err)
{
    wt_fail(err, WT_E_IO, "a part of it was lost when it could not be read or kept");
    wt_error_file(err, in->name);
    return WT_E_IO;
}

static wt_status fail_size(const wt_input *in, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "is larger than %zu MiB", in->most >> 20);
    wt_error_file(err, in->name);
    return WT_E_RANGE;
}

/* Reads until `want` bytes are present or the input ends. The buffer of a file is allocated at
 * once, with one more byte to detect the end. A part of the file is read in steps. */
static wt_status fill_buffer(wt_input *in, size_t want, wt_error *err)
{
    if (!in->whole && want > in->most && in->expected > in->most)
        return fail_size(in, err);
    while (!in->whole && in->length < want) {
        if (in->lost)
            return fail_lost_bytes(in, err);
        if (in->length > in->most)
            return fail_size(in, err);
        if (in->length == in->capacity) {
            size_t capacity = in->capacity > 0   ? in->capacity
                              : in->expected > 0 ? in->expected + 1
                                                 : FIRST_READ;
            if (in->capacity > SIZE_MAX / 2)
                return wt_fail(err, WT_E_MEMORY, "input too large");
            if (in->capacity > 0)
                capacity = in->expected > in->capacity ? in->expected + 1 : 2 * capacity;
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
        size_t space = in->capacity - in->length;
        if (want - in->length < space && space > FIRST_READ)
            space = want - in->length > FIRST_READ ? want - in->length : FIRST_READ;
        ssize_t got = read(in->fd, in->buffer + in->length, space);
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

/* Copies a large pipe to a file; the bytes read so far stay in the buffer. */
static wt_status spool_pipe(wt_input *in, wt_error *err)
{
    static const size_t step = 4 * FIRST_READ;
    wt_status status = fill_buffer(in, SCRATCH_THRESHOLD + 1, err);
    if (status == WT_OK && in->lost)
        status = fail_lost_bytes(in, err);
    if (status != WT_OK || in->whole || in->fd < 0)
        return status;
    const int file = scratch_open();
    if (file < 0)
        return fill_buffer(in, SIZE_MAX, err);
    unsigned char *const piece = wt_alloc(step, 1);
    size_t size = in->length;
    bool more = true;
    status = scratch_write(file, in->bytes, size, in->name, err);
    while (status == WT_OK && more) {
        const ssize_t got = read(in->fd, piece, step);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            status = fail_io(in, err, errno, "cannot be read");
        else if (got > 0)
            status = scratch_write(file, piece, (size_t)got, in->name, err);
        size += got > 0 ? (size_t)got : 0;
        more = got > 0;
        if (status == WT_OK && size > in->most)
            status = fail_size(in, err);
    }
    free(piece);
    if (status == WT_OK && lseek(file, (off_t)in->length, SEEK_SET) < 0)
        status = fail_io(in, err, errno, "cannot be read");
    if (status != WT_OK) {
        in->lost = size > in->length;
        (void)close(file);
        return status;
    }
    (void)close(in->fd);
    in->fd = file;
    in->expected = size;
    return WT_OK;
}

wt_status wt_input_size(wt_input *input, size_t *size, wt_error *err)
{
    const unsigned char *bytes = NULL;
    const wt_status status = input->expected == 0 ? spool_pipe(input, err) : WT_OK;
    if (status != WT_OK)
        return status;
    if (input->expected > 0 && !input->whole) {
        *size = input->expected;
        return WT_OK;
    }
    return wt_input_bytes(input, &bytes, size, err);
}

wt_status wt_input_copy(wt_input *in, size_t from, void *to, size_t n, wt_error *err)
{
    size_t got = 0;
    wt_status status = in->expected == 0 ? spool_pipe(in, err) : WT_OK;
    if (status == WT_OK && in->expected <= SCRATCH_THRESHOLD)
        status = fill_buffer(in, SIZE_MAX, err);
    if (status != WT_OK)
        return status;
    if (from <= in->length && n <= in->length - from) {
        if (n > 0)
            memcpy(to, in->bytes + from, n);
        return WT_OK;
    }
    while (got < n && in->fd >= 0) {
        const ssize_t more = pread(in->fd, (char *)to + got, n - got, (off_t)(from + got));
        if (more < 0 && errno == EINTR)
            continue;
        if (more < 0)
            return fail_io(in, err, errno, "cannot be read");
        if (more == 0)
            break;
        got += (size_t)more;
    }
    if (got == n)
        return WT_OK;
    wt_fail(err, WT_E_IO, "has become shorter while it was read");
    wt_error_file(err, in->name);
    return WT_E_IO;
}

wt_status input_hdf5_bytes(wt_input *input, hdf5_bytes *bytes, wt_error *err)
{
    *bytes = (hdf5_bytes){.file = -1};
    wt_status status = wt_input_size(input, &bytes->size, err);
    if (status != WT_OK || (input->expected > 0 && !input->whole)) {
        bytes->file = input->fd;
        return status;
    }
    return wt_input_bytes(input, &bytes->bytes, &bytes->size, err);
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
    wt_status status = fill_buffer(input, want, err);
    if (status != WT_OK)
        return status;
    *bytes = input->bytes;
    *length = input->length;
    *whole = input->whole;
    return WT_OK;
}

static wt_status reserve_spool(spool *to, size_t n, const char *name, wt_error *err)
{
    size_t capacity = to->capacity > 0 ? to->capacity : 1 << 16;
    while (capacity - to->length < n && capacity <= SIZE_MAX / 2)
        capacity *= 2;
    unsigned char *const bytes = capacity > to->capacity ? realloc(to->bytes, capacity) : to->bytes;
    if (bytes == NULL) {
        wt_fail(err, WT_E_MEMORY, "no memory for %zu bytes of input", capacity);
        wt_error_file(err, name);
        return WT_E_MEMORY;
    }
    to->bytes = bytes;
    to->capacity = capacity;
    return WT_OK;
}

wt_status spool_add(spool *to, const void *bytes, size_t n, const char *name, wt_error *err)
{
    wt_status status = WT_OK;
    if (!to->has_tried_file && n > SCRATCH_THRESHOLD - to->length) {
        to->has_tried_file = true;
        to->file = scratch_open();
        to->has_file = to->file >= 0;
        if (to->has_file)
            status = scratch_write(to->file, to->bytes, to->length, name, err);
        if (to->has_file) {
            free(to->bytes);
            to->bytes = NULL;
            to->capacity = 0;
        }
    }
    if (status == WT_OK && to->has_file)
        status = scratch_write(to->file, bytes, n, name, err);
    else if (status == WT_OK && (status = reserve_spool(to, n, name, err)) == WT_OK && n > 0)
        memcpy(to->bytes + to->length, bytes, n);
    to->length += status == WT_OK ? n : 0;
    return status;
}

wt_status spool_to_input(spool *from, const char *name, wt_input **input, wt_error *err)
{
    wt_status status = WT_OK;
    if (from->has_file)
        status = input_from_file(from->file, from->length, name, input, err);
    else
        *input = input_from_bytes(from->bytes, from->length, name);
    *from = (spool){0};
    return status;
}

void spool_discard(spool *from)
{
    if (from->has_file)
        (void)close(from->file);
    free(from->bytes);
    *from = (spool){0};
}
