/* Reads and replaces files in the folder of a case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/case_folder.h"

#include "core/system/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NAME_LIMIT = 200 };

bool case_folder_is_name(const char *name)
{
    enum { FIRST_PRINTABLE = 0x20, DELETE = 0x7f };
    const size_t length = strnlen(name, NAME_LIMIT + 1);
    if (length == 0 || length > NAME_LIMIT || name[0] == '.' || name[0] == '-')
        return false;
    for (size_t i = 0; i < length; i++) {
        const unsigned char byte = (unsigned char)name[i];
        if (byte == '/' || byte < FIRST_PRINTABLE || byte == DELETE)
            return false;
    }
    return true;
}

static wt_status fail_on_file(const char *name, const char *what, wt_error *err)
{
    const wt_status status = wt_fail(err, WT_E_IO, "%s", what);
    wt_error_file(err, name);
    return status;
}

wt_status case_folder_open(const char *path, case_folder *folder, wt_error *err)
{
    /* An absolute path, because the page shows it and programs run in the folder. */
    folder->path = realpath(path, NULL);
    folder->descriptor =
        open(folder->path != NULL ? folder->path : path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return folder->descriptor >= 0 ? WT_OK : fail_on_file(path, strerror(errno), err);
}

void case_folder_close(case_folder *folder)
{
    if (folder->descriptor >= 0)
        close(folder->descriptor);
    free(folder->path);
    *folder = (case_folder){.descriptor = -1};
}

static wt_status read_descriptor(int file, size_t limit, text_buffer *text)
{
    char chunk[16 << 10];
    ssize_t got = 0;
    while (text->length <= limit && (got = read(file, chunk, sizeof chunk)) != 0) {
        if (got > 0)
            text_bytes(text, chunk, (size_t)got);
        else if (errno != EINTR)
            return WT_E_IO;
    }
    return WT_OK;
}

wt_status case_folder_read(const case_folder *folder, const char *name, size_t limit, bool *exists,
                           text_buffer *text, wt_error *err)
{
    struct stat state;
    *exists = false;
    if (!case_folder_is_name(name))
        return fail_on_file(name, "that is no plain file name", err);
    /* Without O_NONBLOCK, opening a named pipe would wait for its writer. */
    const int file =
        openat(folder->descriptor, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return errno == ENOENT
                   ? WT_OK
                   : fail_on_file(
                         name, errno == ELOOP ? "symbolic links are not followed" : strerror(errno),
                         err);
    wt_status status = fstat(file, &state) == 0 && S_ISREG(state.st_mode) ? WT_OK : WT_E_IO;
    if (status != WT_OK)
        fail_on_file(name, "not a regular file", err);
    else if ((status = read_descriptor(file, limit, text)) != WT_OK)
        fail_on_file(name, strerror(errno), err);
    else if (text->length > limit)
        status = fail_on_file(name, "the file is too large", err);
    close(file);
    *exists = status == WT_OK;
    return status;
}

static wt_status write_descriptor(int file, const char *bytes, size_t length)
{
    while (length > 0) {
        const ssize_t put = write(file, bytes, length);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return WT_E_IO;
        bytes += put;
        length -= (size_t)put;
    }
    return fsync(file) == 0 ? WT_OK : WT_E_IO;
}

enum { NEW_FILE_MODE = 0666, PERMISSIONS = 0777 };

wt_status case_folder_add(const case_folder *folder, const char *name, const char *bytes,
                          size_t length, wt_error *err)
{
    if (!case_folder_is_name(name))
        return fail_on_file(name, "that is no plain file name", err);
    /* O_EXCL also refuses a symbolic link. */
    const int file = openat(folder->descriptor, name,
                            O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, NEW_FILE_MODE);
    if (file < 0)
        return fail_on_file(
            name, errno == EEXIST ? "the folder has a file of this name" : strerror(errno), err);
    const wt_status status = write_descriptor(file, bytes, length);
    if (status != WT_OK) {
        fail_on_file(name, strerror(errno), err);
        (void)unlinkat(folder->descriptor, name, 0);
    }
    close(file);
    return status;
}

wt_status case_folder_write(const case_folder *folder, const char *name, const char *bytes,
                            size_t length, wt_error *err)
{
    struct stat before;
    if (!case_folder_is_name(name))
        return fail_on_file(name, "that is no plain file name", err);
    const bool exists =
        fstatat(folder->descriptor, name, &before, AT_SYMLINK_NOFOLLOW) == 0 || errno != ENOENT;
    if (exists && !S_ISREG(before.st_mode))
        return fail_on_file(name, "only a regular file is replaced", err);
    char *path = temporary_name(folder->path);
    const char *const temporary = path != NULL ? wt_path_base(path) : "";
    const int file = openat(folder->descriptor, temporary,
                            O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, NEW_FILE_MODE);
    wt_status status = file >= 0 ? write_descriptor(file, bytes, length) : WT_E_IO;
    if (status == WT_OK && exists && fchmod(file, before.st_mode & PERMISSIONS) != 0)
        status = WT_E_IO;
    if (status == WT_OK && renameat(folder->descriptor, temporary, folder->descriptor, name) != 0)
        status = WT_E_IO;
    if (status != WT_OK) {
        fail_on_file(name, strerror(errno), err);
        if (file >= 0)
            (void)unlinkat(folder->descriptor, temporary, 0);
    }
    if (file >= 0)
        close(file);
    free(path);
    return status;
}
