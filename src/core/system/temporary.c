/* Temporary files and folders. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/temporary.h"
#include "weartrack/core.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME_PATTERN ".weartrack-%ld-%16[0-9a-f]%n"

const char *temporary_directory(void)
{
    const char *const asked = getenv("TMPDIR");
    return asked != NULL && asked[0] != '\0' ? asked : "/tmp";
}

char *temporary_name(const char *folder)
{
    uint64_t random = 0;
    char base[64];
    if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
        return NULL;
    (void)snprintf(base, sizeof base, ".weartrack-%ld-%016llx", (long)getpid(),
                   (unsigned long long)random);
    return wt_path_join(folder, base);
}

void temporary_lock(int descriptor)
{
    /* Without file locks the check for a living process of this machine is sufficient. */
    (void)flock(descriptor, LOCK_EX | LOCK_NB);
}

char *temporary_folder_create(const char *folder, int *descriptor)
{
    char *const path = temporary_name(folder);
    if (path == NULL)
        return NULL;
    if (mkdir(path, 0777) == 0) {
        *descriptor = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (*descriptor >= 0) {
            temporary_lock(*descriptor);
            return path;
        }
    }
    const int reason = errno;
    free(path);
    errno = reason;
    return NULL;
}

enum { LEVELS = 8 }; /* depth of folders in a temporary one, including those of other programs */

static void remove_tree(int parent, const char *name, int deeper)
{
    if (unlinkat(parent, name, 0) == 0 || deeper < 0)
        return;
    const int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *const folder = fd >= 0 ? fdopendir(fd) : NULL;
    if (folder != NULL) {
        for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
            if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
                remove_tree(fd, entry->d_name, deeper - 1);
        (void)closedir(folder);
    } else if (fd >= 0) {
        (void)close(fd);
    }
    (void)unlinkat(parent, name, AT_REMOVEDIR);
}

void temporary_remove(const char *path)
{
    remove_tree(AT_FDCWD, path, LEVELS);
}

/* A process in another container is invisible but still holds its lock. */
static bool is_abandoned(int folder, const char *name)
{
    long process = 0;
    int end = 0;
    char random[17];
    if (sscanf(name, NAME_PATTERN, &process, random, &end) != 2 || name[end] != '\0' ||
        process <= 0 || kill((pid_t)process, 0) == 0 || errno != ESRCH)
        return false;
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    const bool unlocked = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0;
    if (fd >= 0)
        (void)close(fd);
    return unlocked;
}

void temporary_remove_abandoned(const char *folder)
{
    DIR *const listing = opendir(folder);
    if (listing == NULL)
        return;
    for (const struct dirent *entry; (entry = readdir(listing)) != NULL;)
        if (is_abandoned(dirfd(listing), entry->d_name))
            remove_tree(dirfd(listing), entry->d_name, LEVELS);
    (void)closedir(listing);
}
