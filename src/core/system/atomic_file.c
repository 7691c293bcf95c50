/* Output files that appear only when they are complete. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/system/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static struct {
    pthread_mutex_t lock;
    bool started;
    struct file_id {
        dev_t device;
        ino_t number;
    } * files;
    size_t n, capacity;
} guard = {.lock = PTHREAD_MUTEX_INITIALIZER};

void wt_protect_begin(void)
{
    (void)pthread_mutex_lock(&guard.lock);
    guard.started = true;
    (void)pthread_mutex_unlock(&guard.lock);
}

/* The caller holds the lock. */
static void protect_file(const struct stat *info)
{
    if (guard.n == guard.capacity) {
        guard.capacity = guard.capacity > 0 ? 2 * guard.capacity : 64;
        guard.files = wt_realloc(guard.files, guard.capacity, sizeof *guard.files);
    }
    guard.files[guard.n++] = (struct file_id){info->st_dev, info->st_ino};
}

static bool is_protected_file(const struct stat *info)
{
    for (size_t i = guard.n; i-- > 0;)
        if (guard.files[i].device == info->st_dev && guard.files[i].number == info->st_ino)
            return true;
    return false;
}

void wt_protect_input(const char *path)
{
    struct stat info;
    const bool standard = strcmp(path, "-") == 0;
    if ((standard ? fstat(STDIN_FILENO, &info) : stat(path, &info)) != 0 || !S_ISREG(info.st_mode))
        return;
    (void)pthread_mutex_lock(&guard.lock);
    if (guard.started)
        protect_file(&info);
    (void)pthread_mutex_unlock(&guard.lock);
}

static bool contains_text(const unsigned char *block, size_t n, const char *mark)
{
    return memmem(block, n, mark, strlen(mark) + 1) != NULL;
}

/* True if the bytes are not text. */
static bool has_binary_bytes(const unsigned char *block, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (block[i] == 0x7f ||
            (block[i] < 0x20 && !(block[i] >= '\t' && block[i] <= '\r') && block[i] != 0x1b))
            return true;
    return false;
}

/* True if the file was probably written by an instrument: it is neither text nor HDF5 of
 * this program. Files of instruments may have a text header. Therefore the middle and
 * the end of the file are also checked. */
static bool is_foreign(const char *path, off_t size)
{
    static const char nanoscope[] = "\\*F";
    const off_t places[] = {0, size / 2,
                            size > (off_t)STORE_HEADER_SIZE ? size - (off_t)STORE_HEADER_SIZE : 0};
    unsigned char block[STORE_HEADER_SIZE];
    bool foreign = false;
    FILE *file = fopen(path, "rbe");
    if (file == NULL)
        return false; /* the later attempt to write reports an error */
    bool own = false;
    for (size_t i = 0; i < sizeof places / sizeof *places && !own && !foreign; i++) {
        const size_t n =
            fseeko(file, places[i], SEEK_SET) == 0 ? fread(block, 1, sizeof block, file) : 0;
        own = i == 0 && contains_text(block, n, STORE_FORMAT_ATTRIBUTE);
        foreign = !own && (has_binary_bytes(block, n) ||
                           (i == 0 && n > 3 && memcmp(block, nanoscope, 3) == 0));
    }
    (void)fclose(file);
    return foreign;
}

wt_status wt_check_overwrite(const char *path, wt_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return WT_OK;
    (void)pthread_mutex_lock(&guard.lock);
    const bool read = is_protected_file(&info), started = guard.started;
    (void)pthread_mutex_unlock(&guard.lock);
    if (read)
        wt_fail(err, WT_E_ARG, "this is also an input and would be lost: nothing is written");
    else if (started && S_ISREG(info.st_mode) && is_foreign(path, info.st_size))
        wt_fail(err, WT_E_ARG,
                "there is such a file, which this program has not written, and it would be lost: "
                "nothing is written");
    else
        return WT_OK;
    wt_error_file(err, path);
    wt_error_advice(err, "give another name");
    return WT_E_ARG;
}

struct wt_atomic_file {
    char *final;     /* path of the output file */
    char *temporary; /* path during writing; equal text if the target is a device or a pipe */
    bool direct;  /* no rename at the end: the target is no regular file, or the file has its name
                     already */
    bool unnamed; /* `temporary` is no name in a folder: the file vanishes if this program is killed
                   */
    FILE *stream;
};

static void atomic_file_free(wt_atomic_file *file)
{
    if (file == NULL)
        return;
    free(file->final);
    free(file->temporary);
    free(file);
}

enum { ATTEMPTS = 16, LINKS = 40 }; /* attempts to find a free name; symbolic links in a chain */

/* The umask decides the mode, as for any new file. */
static int create_named(const char *folder, char **name)
{
    temporary_remove_abandoned(folder);
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        char *const path = temporary_name(folder);
        if (path == NULL)
            return -1;
        const int descriptor = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
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

/* Creates a file without a name on the file system of `folder`. -1 if the file system does not
 * support this, or if /proc, which is needed to name the file, is missing. */
static int create_unnamed(const char *folder, char **name)
{
    char path[48];
    const int descriptor = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return -1;
    (void)snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    *name = access(path, F_OK) == 0 ? wt_strdup(path) : NULL;
    if (*name != NULL)
        return descriptor;
    (void)close(descriptor);
    return -1;
}

/* The name is safe on disk only after the folder is synchronised. Some file systems do not support
 * this; the file is complete in any case. */
static void sync_folder(const char *path)
{
    char *const folder = wt_path_folder(path);
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        (void)close(descriptor);
    }
    free(folder);
}

/* Gives an unnamed file its final name, or a temporary one in the same folder if the final name
 * exists. */
static bool link_unnamed(wt_atomic_file *file)
{
    const char *const from = file->temporary;
    if (linkat(AT_FDCWD, from, AT_FDCWD, file->final, AT_SYMLINK_FOLLOW) == 0) {
        file->direct = true;
        sync_folder(file->final);
        return true;
    }
    if (errno != EEXIST)
        return false;
    char *const folder = wt_path_folder(file->final);
    bool named = false;
    temporary_remove_abandoned(folder);
    for (int attempt = 0; attempt < ATTEMPTS && !named; attempt++) {
        char *const path = temporary_name(folder);
        if (path == NULL)
            break;
        named = linkat(AT_FDCWD, from, AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
        if (named) {
            free(file->temporary);
            file->temporary = path;
            file->unnamed = false;
            break;
        }
        const int reason = errno;
        free(path);
        errno = reason;
        if (reason != EEXIST)
            break;
    }
    const int reason = errno;
    free(folder);
    errno = reason;
    return named;
}

/* Removes the incomplete file, if it has a name. */
static void remove_temporary(const wt_atomic_file *file)
{
    if (!file->direct && !file->unnamed)
        (void)unlink(file->temporary);
}

/* Resolves symbolic links. The target need not exist. */
static char *resolve_links(const char *path)
{
    char target[PATH_MAX];
    char *name = wt_strdup(path);
    for (int i = 0; i < LINKS; i++) {
        const ssize_t length = readlink(name, target, sizeof target - 1);
        if (length < 0)
            break;
        target[length] = '\0';
        char *const folder = wt_path_folder(name);
        free(name);
        name = wt_path_join(folder, target);
        free(folder);
    }
    return name;
}

/* `info` describes the file that is replaced, NULL if there is none. */
static wt_status open_output_stream(wt_atomic_file *new_file, const char *folder,
                                    const struct stat *info, wt_error *err)
{
    int descriptor = -1;
    if (new_file->direct) {
        new_file->temporary = wt_strdup(new_file->final);
        descriptor = open(new_file->final, O_WRONLY | O_CLOEXEC);
    } else {
        descriptor = create_unnamed(folder, &new_file->temporary);
        new_file->unnamed = descriptor >= 0;
        if (descriptor < 0)
            descriptor = create_named(folder, &new_file->temporary);
    }
    if (descriptor >= 0 && !new_file->direct)
        temporary_lock(descriptor);
    /* The mode is set before the file has any contents. */
    const bool moded =
        info == NULL || new_file->direct || fchmod(descriptor, info->st_mode & 0777) == 0;
    if (descriptor >= 0 && moded)
        new_file->stream = fdopen(descriptor, "w");
    if (new_file->stream != NULL)
        return WT_OK;
    wt_fail(err, WT_E_IO, "cannot create the file: %s", strerror(errno));
    wt_error_advice(err, "check that the folder exists and may be written to");
    if (descriptor >= 0) {
        (void)close(descriptor);
        remove_temporary(new_file);
    }
    return WT_E_IO;
}

wt_status wt_outfile_open(const char *path, wt_atomic_file **file, wt_error *err)
{
    struct stat info;
    wt_atomic_file *new_file = wt_alloc(1, sizeof *new_file);
    const bool exists = stat(path, &info) == 0;
    new_file->direct = exists && !S_ISREG(info.st_mode);
    new_file->final = new_file->direct ? wt_strdup(path) : resolve_links(path);
    char *const folder = wt_path_folder(new_file->final);
    wt_status status = wt_check_overwrite(path, err);
    if (status == WT_OK && exists && S_ISDIR(info.st_mode)) {
        status = wt_fail(err, WT_E_IO, "cannot write: it is a folder");
        wt_error_expected(err, "the name of a file");
    }
    if (status == WT_OK)
        status = open_output_stream(new_file, folder, exists ? &info : NULL, err);
    if (status == WT_OK) {
        *file = new_file;
    } else {
        wt_error_file(err, path);
        atomic_file_free(new_file);
    }
    free(folder);
    return status;
}

FILE *wt_outfile_stream(wt_atomic_file *file)
{
    return file->stream;
}

wt_status wt_outfile_commit(wt_atomic_file *file, wt_error *err)
{
    const char *what = NULL;
    int reason = 0;
    if (fflush(file->stream) != 0 || ferror(file->stream)) {
        what = "cannot write the file";
        reason = errno;
    } else if (!file->direct && fsync(fileno(file->stream)) != 0) {
        what = "cannot write the file to the disk";
        reason = errno;
    } else if (file->unnamed && !link_unnamed(file)) {
        what = "cannot give the file its name";
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
        remove_temporary(file);
        status = wt_fail(err, WT_E_IO, "%s: %s", what, strerror(reason));
        wt_error_file(err, file->final);
    }
    atomic_file_free(file);
    return status;
}

void wt_outfile_discard(wt_atomic_file *file)
{
    if (file == NULL)
        return;
    (void)fclose(file->stream);
    remove_temporary(file);
    atomic_file_free(file);
}
