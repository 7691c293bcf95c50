/* Files that were read and must not be written over. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/base.h"

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

void wt_guard_start(void)
{
    (void)pthread_mutex_lock(&guard.lock);
    guard.started = true;
    (void)pthread_mutex_unlock(&guard.lock);
}

/* The guard is locked. */
static wt_status remember(const struct stat *info)
{
    if (guard.n == guard.capacity) {
        const size_t capacity = guard.capacity > 0 ? 2 * guard.capacity : 64;
        struct file_id *const files = realloc(guard.files, capacity * sizeof *files);
        if (files == NULL)
            return WT_E_MEMORY;
        guard.files = files;
        guard.capacity = capacity;
    }
    guard.files[guard.n++] = (struct file_id){info->st_dev, info->st_ino};
    return WT_OK;
}

static bool is_read(const struct stat *info)
{
    for (size_t i = guard.n; i-- > 0;)
        if (guard.files[i].device == info->st_dev && guard.files[i].number == info->st_ino)
            return true;
    return false;
}

wt_status wt_guard_read(const char *path, wt_error *err)
{
    struct stat info;
    const bool standard = strcmp(path, "-") == 0;
    wt_status status = WT_OK;
    if ((standard ? fstat(STDIN_FILENO, &info) : stat(path, &info)) != 0 || !S_ISREG(info.st_mode))
        return WT_OK;
    (void)pthread_mutex_lock(&guard.lock);
    if (guard.started)
        status = remember(&info);
    (void)pthread_mutex_unlock(&guard.lock);
    return status == WT_OK ? WT_OK : wt_fail(err, status, "out of memory");
}

wt_status wt_guard_write(const char *path, wt_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return WT_OK;
    (void)pthread_mutex_lock(&guard.lock);
    const bool refuse = is_read(&info);
    (void)pthread_mutex_unlock(&guard.lock);
    if (!refuse)
        return WT_OK;
    wt_fail(err, WT_E_ARG, "this file was read and would be lost: nothing is written");
    wt_error_file(err, path);
    wt_error_advice(err, "give another name");
    return WT_E_ARG;
}
