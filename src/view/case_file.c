/* Reads and writes files in the folder of a case. SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/system/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool is_plain_name(const char *name)
{
    enum { LIMIT = 200, FIRST_PRINTABLE = 0x20, DELETE = 0x7f };
    if (name[0] == '\0' || name[0] == '.' || name[0] == '-' || strnlen(name, LIMIT + 1) > LIMIT)
        return false;
    for (; *name != '\0'; name++)
        if (*name == '/' || (unsigned char)*name < FIRST_PRINTABLE || *name == DELETE)
            return false;
    return true;
}

static wt_status fail_on_file(wt_status kind, const char *name, const char *what, wt_error *err)
{
    const wt_status status = wt_fail(err, kind, "%s", what);
    wt_error_file(err, name);
    return status;
}

wt_status case_file_read(const char *folder, const char *name, size_t limit, text_buffer *text,
                         wt_error *err)
{
    struct stat state;
    char chunk[16 << 10];
    if (!is_plain_name(name))
        return fail_on_file(WT_E_IO, name, "that is no plain file name", err);
    char *path = wt_path_join(folder, name);
    /* Without O_NONBLOCK, opening a named pipe would wait for its writer. */
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "r") : NULL;
    free(path);
    if (file == NULL)
        return fail_on_file(errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, name,
                            errno == ELOOP ? "symbolic links are not followed" : strerror(errno),
                            err);
    const char *fault =
        fstat(descriptor, &state) == 0 && S_ISREG(state.st_mode) ? NULL : "not a regular file";
    for (size_t n;
         fault == NULL && text->length <= limit && (n = fread(chunk, 1, sizeof chunk, file)) > 0;)
        text_bytes(text, chunk, n);
    if (fault == NULL && ferror(file))
        fault = strerror(errno);
    if (fault == NULL && text->length > limit)
        fault = "the file is too large";
    (void)fclose(file);
    return fault == NULL ? WT_OK : fail_on_file(WT_E_IO, name, fault, err);
}

/* Writes a new file. False with errno. */
static bool write_new(const char *path, const text_buffer *text)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    if (file == NULL)
        return false;
    bool good = fwrite(text_string(text), 1, text->length, file) == text->length &&
                fflush(file) == 0 && fsync(descriptor) == 0;
    good = fclose(file) == 0 && good;
    if (!good)
        (void)unlink(path);
    return good;
}

wt_status case_file_write(const char *folder, const char *name, bool replace,
                          const text_buffer *text, wt_error *err)
{
    struct stat before;
    if (!is_plain_name(name))
        return fail_on_file(WT_E_IO, name, "that is no plain file name", err);
    char *path = wt_path_join(folder, name), *temporary = temporary_name(folder);
    const bool exists = lstat(path, &before) == 0;
    const char *fault = NULL;
    if (exists && !replace)
        fault = "the folder has a file of this name";
    else if (exists && !S_ISREG(before.st_mode))
        fault = "only a regular file is replaced";
    else if (!replace) /* O_EXCL also refuses a symbolic link */
        fault = write_new(path, text) ? NULL : strerror(errno);
    else if (temporary == NULL || !write_new(temporary, text) ||
             (exists && chmod(temporary, before.st_mode & 0777) != 0) ||
             rename(temporary, path) != 0) /* does not follow a link, either */
        fault = strerror(errno);
    if (fault != NULL && temporary != NULL)
        (void)unlink(temporary);
    free(temporary);
    free(path);
    return fault == NULL ? WT_OK : fail_on_file(WT_E_IO, name, fault, err);
}
