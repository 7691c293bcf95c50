/* Output files that appear only when they are complete. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/base.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

struct wt_outfile {
    char *final;     /* where it goes */
    char *temporary; /* where it is written; equal text if the target is a device or a pipe */
    bool direct;     /* the target is not a regular file and is written in place */
    FILE *stream;
};

static void outfile_free(wt_outfile *file)
{
    if (file == NULL)
        return;
    free(file->final);
    free(file->temporary);
    free(file);
}

/* Creates a new file in `folder`; the name begins with a dot, so that no pattern picks it up. */
static int create_beside(const char *folder, char **name)
{
    for (int attempt = 0; attempt < 16; attempt++) {
        uint64_t random = 0;
        char base[48];
        if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
            return -1;
        (void)snprintf(base, sizeof base, ".weartrack-%016llx", (unsigned long long)random);
        char *const path = wt_path_join(folder, base);
        if (path == NULL)
            return -1;
        /* Mode as for any new file: the umask decides. */
        const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            *name = path;
            return descriptor;
        }
        const int reason = errno;
        free(path);
        errno = reason;
        if (reason != EEXIST)
            return -1;
    }
    return -1;
}

wt_status wt_outfile_open(const char *path, wt_outfile **file, wt_error *err)
{
    wt_status status = WT_OK;
    int descriptor = -1;
    char *folder = NULL;
    struct stat info;
    wt_outfile *new_file = calloc(1, sizeof *new_file);
    if (new_file == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    const bool exists = stat(path, &info) == 0;
    /* Through a symbolic link the file behind it is replaced, not the link. */
    new_file->final = exists ? realpath(path, NULL) : strdup(path);
    folder = new_file->final != NULL ? wt_path_folder(new_file->final) : NULL;
    if (folder == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    if (exists && S_ISDIR(info.st_mode)) {
        status = wt_fail(err, WT_E_IO, "cannot write: it is a folder");
        wt_error_expected(err, "the name of a file");
        goto done;
    }
    if (exists && !S_ISREG(info.st_mode)) {
        new_file->direct = true;
        new_file->temporary = strdup(new_file->final);
        if (new_file->temporary != NULL)
            descriptor = open(new_file->final, O_WRONLY | O_CLOEXEC);
    } else {
        descriptor = create_beside(folder, &new_file->temporary);
    }
    if (descriptor >= 0)
        new_file->stream = fdopen(descriptor, "w");
    if (new_file->stream == NULL) {
        status = wt_fail(err, WT_E_IO, "cannot create the file: %s", strerror(errno));
        wt_error_advice(err, "check that the folder exists and may be written to");
        if (descriptor >= 0) {
            (void)close(descriptor);
            if (!new_file->direct)
                (void)unlink(new_file->temporary);
        }
        goto done;
    }
    *file = new_file;
    new_file = NULL;
done:
    wt_error_file(status != WT_OK ? err : NULL, path);
    outfile_free(new_file);
    free(folder);
    return status;
}

FILE *wt_outfile_stream(wt_outfile *file)
{
    return file->stream;
}

const char *wt_outfile_path(const wt_outfile *file)
{
    return file->temporary;
}

/* The name is safe on disk only when its folder is; not every file system can do that, and the file
 * is complete either way. */
static void sync_folder(const char *path)
{
    char *const folder = wt_path_folder(path);
    const int descriptor = folder != NULL ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        (void)close(descriptor);
    }
    free(folder);
}

wt_status wt_outfile_commit(wt_outfile *file, wt_error *err)
{
    const char *what = NULL;
    int reason = 0;
    if (fflush(file->stream) != 0 || ferror(file->stream)) {
        what = "cannot write the file";
        reason = errno;
    } else if (!file->direct && fsync(fileno(file->stream)) != 0) {
        what = "cannot write the file to the disk";
        reason = errno;
    }
    if (fclose(file->stream) != 0 && what == NULL) {
        what = "cannot close the file";
        reason = errno;
    }
    if (what == NULL && !file->direct) {
        if (rename(file->temporary, file->final) != 0) {
            what = "cannot give the file its name";
            reason = errno;
        } else {
            sync_folder(file->final);
        }
    }
    wt_status status = WT_OK;
    if (what != NULL) {
        if (!file->direct)
            (void)unlink(file->temporary);
        status = wt_fail(err, WT_E_IO, "%s: %s", what, strerror(reason));
        wt_error_file(err, file->final);
    }
    outfile_free(file);
    return status;
}

void wt_outfile_discard(wt_outfile *file)
{
    if (file == NULL)
        return;
    (void)fclose(file->stream);
    if (!file->direct)
        (void)unlink(file->temporary);
    outfile_free(file);
}
