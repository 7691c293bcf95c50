/* The folder of a report.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct report_folder {
    char *place; /* where it goes */
    char *made;  /* the temporary one */
    char *plots;
};

static wt_status io_error(wt_error *err, const char *what, const char *path)
{
    int code = errno;
    wt_status status = wt_fail(err, WT_E_IO, "%s: %s", what, strerror(code));
    wt_error_file(err, path);
    return status;
}

/* ---- what may be replaced -------------------------------------------------------------------- */

static bool has_ending(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n > m && strcmp(name + n - m, ending) == 0;
}

static bool ours_in_report(const char *name)
{
    return strcmp(name, "index.html") == 0 || strcmp(name, "plots") == 0;
}

static bool ours_in_plots(const char *name)
{
    return has_ending(name, ".tsv") || has_ending(name, ".gp") || has_ending(name, ".svg");
}

/* The next entry that is neither the folder itself nor the one above; NULL at the end. */
static const struct dirent *next_entry(DIR *folder)
{
    const struct dirent *entry = NULL;
    do
        entry = readdir(folder);
    while (entry != NULL && (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0));
    return entry;
}

static bool has_mark(const char *folder)
{
    enum { HEAD = 4096 };
    char head[HEAD + 1];
    char *path = wt_path_join(folder, "index.html");
    FILE *file = path == NULL ? NULL : fopen(path, "rb");
    free(path);
    if (file == NULL)
        return false;
    size_t n = fread(head, 1, HEAD, file);
    fclose(file);
    head[n] = '\0';
    return strstr(head, REPORT_MARK) != NULL;
}

static wt_status refuse(wt_error *err, const char *path, const char *found)
{
    wt_status status = wt_fail(err, WT_E_IO, "will not be replaced: it is not a weartrack report");
    wt_error_file(err, path);
    wt_error_expected(err, "a new name, an empty folder or an older report");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "name another folder, or move away what is there");
    return status;
}

/* Refuses `place` if a name in a folder is not one of ours; *n counts the names. */
static wt_status check_names(const char *path, bool (*ours)(const char *), const char *place,
                             size_t *n, wt_error *err)
{
    wt_status status = WT_OK;
    char found[300];
    DIR *folder = opendir(path);
    *n = 0;
    if (folder == NULL)
        return io_error(err, "cannot be read", path);
    for (const struct dirent *entry; status == WT_OK && (entry = next_entry(folder)) != NULL;) {
        ++*n;
        (void)snprintf(found, sizeof found, "other files in it: %s", entry->d_name);
        if (!ours(entry->d_name))
            status = refuse(err, place, found);
    }
    closedir(folder);
    return status;
}

/* A folder may be replaced if it is empty or holds an older report and nothing else: what a user
 * put there is never removed. */
static wt_status check_replaceable(const char *path, wt_error *err)
{
    struct stat info;
    size_t n = 0;
    if (lstat(path, &info) != 0)
        return errno == ENOENT ? WT_OK : io_error(err, "cannot be looked at", path);
    if (!S_ISDIR(info.st_mode))
        return refuse(err, path, "a file of that name");
    wt_status status = check_names(path, ours_in_report, path, &n, err);
    if (status != WT_OK || n == 0)
        return status;
    if (!has_mark(path))
        return refuse(err, path, "an index.html that weartrack did not write");
    char *plots = wt_path_join(path, "plots");
    if (plots == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (lstat(plots, &info) == 0 || errno != ENOENT)
        status = check_names(plots, ours_in_plots, path, &n, err);
    free(plots);
    return status;
}

/* ---- removing -------------------------------------------------------------------------------- */

/* Removes the files of a folder and, if `plots`, those of the folder "plots" in it, then the
 * folder. Deeper folders stay, and so does what holds them. */
static void remove_folder(const char *path, bool plots)
{
    DIR *folder = opendir(path);
    if (folder == NULL)
        return;
    int fd = dirfd(folder);
    for (const struct dirent *entry; (entry = next_entry(folder)) != NULL;)
        (void)unlinkat(fd, entry->d_name, 0);
    closedir(folder);
    char *inner = plots ? wt_path_join(path, "plots") : NULL;
    if (inner != NULL)
        remove_folder(inner, false);
    free(inner);
    (void)rmdir(path);
}

/* ---- making ---------------------------------------------------------------------------------- */

static void folder_free(report_folder *folder)
{
    free(folder->place);
    free(folder->made);
    free(folder->plots);
    free(folder);
}

/* The place itself: without slashes at the end, symbolic links followed. */
static wt_status find_place(const char *path, char **place, wt_error *err)
{
    char *plain = strdup(path), *real = NULL;
    wt_status status = WT_OK;
    if (plain == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t n = strlen(plain); n > 1 && plain[n - 1] == '/'; n--)
        plain[n - 1] = '\0';
    const char *base = wt_path_base(plain);
    if (base[0] == '\0' || strcmp(base, ".") == 0 || strcmp(base, "..") == 0) {
        status = wt_fail(err, WT_E_ARG, "a report needs a folder of its own");
        wt_error_file(err, path);
        wt_error_advice(err, "name a new folder, for example \"report\"");
        free(plain);
        return status;
    }
    real = realpath(plain, NULL);
    if (real != NULL) {
        *place = real;
        free(plain);
    } else
        *place = plain;
    return WT_OK;
}

/* A folder of a name that is not taken, beside the place: the same file system, so that it can be
 * renamed. NULL with errno set. */
static char *make_beside(const char *place, const char *kind, bool make)
{
    char *parent = wt_path_folder(place);
    const char *base = wt_path_base(place);
    char *made = NULL;
    size_t size = strlen(base) + 64;
    char *name = malloc(size);
    if (parent == NULL || name == NULL)
        errno = ENOMEM;
    for (unsigned attempt = 0; parent != NULL && name != NULL && attempt < 1000; attempt++) {
        (void)snprintf(name, size, ".%s.%s-%ld-%u", base, kind, (long)getpid(), attempt);
        made = wt_path_join(parent, name);
        struct stat info;
        if (made == NULL || (make && mkdir(made, 0777) == 0) ||
            (!make && lstat(made, &info) != 0 && errno == ENOENT))
            break;
        int code = make ? errno : EEXIST;
        free(made);
        made = NULL;
        errno = code;
        if (code != EEXIST)
            break;
    }
    free(parent);
    free(name);
    return made;
}

wt_status folder_open(const char *path, report_folder **out, wt_error *err)
{
    wt_status status = WT_OK;
    report_folder *folder = calloc(1, sizeof *folder);
    if (folder == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if ((status = find_place(path, &folder->place, err)) != WT_OK ||
        (status = check_replaceable(folder->place, err)) != WT_OK)
        goto fail;
    folder->made = make_beside(folder->place, "new", true);
    if (folder->made == NULL) {
        status = io_error(err, "cannot be made", path);
        wt_error_advice(err, "the folder it goes into must exist and be writable");
        goto fail;
    }
    folder->plots = wt_path_join(folder->made, "plots");
    if (folder->plots == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto fail;
    }
    if (mkdir(folder->plots, 0777) != 0) {
        status = io_error(err, "cannot be made", folder->plots);
        goto fail;
    }
    *out = folder;
    return WT_OK;
fail:
    folder_discard(folder);
    return status;
}

const char *folder_plots(const report_folder *folder)
{
    return folder->plots;
}

wt_status folder_write(const report_folder *folder, const char *name, const char *bytes,
                       size_t length, wt_error *err)
{
    wt_status status = WT_OK;
    char *path = wt_path_join(folder->made, name);
    if (path == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    FILE *file = fopen(path, "wb");
    bool good = file != NULL && fwrite(bytes, 1, length, file) == length;
    int code = errno;
    if (file != NULL && fclose(file) != 0 && good) {
        code = errno;
        good = false;
    }
    if (!good) {
        errno = code;
        status = io_error(err, "cannot be written", path);
    }
    free(path);
    return status;
}

wt_status folder_commit(report_folder *folder, wt_error *err)
{
    wt_status status = WT_OK;
    char *old = NULL;
    struct stat info;
    // Again: something may have come there while the figures were drawn.
    if ((status = check_replaceable(folder->place, err)) != WT_OK)
        goto done;
    if (lstat(folder->place, &info) == 0) {
        old = make_beside(folder->place, "old", false);
        if (old == NULL || rename(folder->place, old) != 0) {
            status = io_error(err, "cannot be moved out of the way", folder->place);
            free(old);
            old = NULL;
            goto done;
        }
    }
    if (rename(folder->made, folder->place) != 0) {
        status = io_error(err, "cannot be put into its place", folder->place);
        if (old != NULL)
            (void)rename(old, folder->place);
        goto done;
    }
    free(folder->made);
    folder->made = NULL;
    if (old != NULL)
        remove_folder(old, true);
done:
    free(old);
    folder_discard(folder);
    return status;
}

void folder_discard(report_folder *folder)
{
    if (folder == NULL)
        return;
    if (folder->made != NULL)
        remove_folder(folder->made, true);
    folder_free(folder);
}
