/* Prevents that an input file, or a file of another program, is overwritten.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/file_signatures.h"
#include "weartrack/core.h"

#include <pthread.h>
#include <stdio.h>
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

wt_status wt_protect_input(const char *path, wt_error *err)
{
    struct stat info;
    const bool standard = strcmp(path, "-") == 0;
    (void)err;
    if ((standard ? fstat(STDIN_FILENO, &info) : stat(path, &info)) != 0 || !S_ISREG(info.st_mode))
        return WT_OK;
    (void)pthread_mutex_lock(&guard.lock);
    if (guard.started)
        protect_file(&info);
    (void)pthread_mutex_unlock(&guard.lock);
    return WT_OK;
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

/* True if the file ends like a PDF of this program. */
static bool is_weartrack_pdf(FILE *file)
{
    char end[sizeof PDF_SIGNATURE - 1];
    return fseeko(file, -(off_t)sizeof end, SEEK_END) == 0 &&
           fread(end, 1, sizeof end, file) == sizeof end &&
           memcmp(end, PDF_SIGNATURE, sizeof end) == 0;
}

static bool is_weartrack_database(const unsigned char *begin, size_t n)
{
    return n >= SQLITE_APPLICATION_ID_OFFSET + SQLITE_APPLICATION_ID_SIZE &&
           memcmp(begin, SQLITE_SIGNATURE, sizeof SQLITE_SIGNATURE) == 0 &&
           memcmp(begin + SQLITE_APPLICATION_ID_OFFSET, SQLITE_APPLICATION_ID,
                  SQLITE_APPLICATION_ID_SIZE) == 0;
}

/* True if the file was probably written by an instrument: it is neither text nor HDF5, a database
 * or a PDF of this program. Files of instruments may have a text header. Therefore the middle and
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
    bool own = is_weartrack_pdf(file);
    for (size_t i = 0; i < sizeof places / sizeof *places && !own && !foreign; i++) {
        const size_t n =
            fseeko(file, places[i], SEEK_SET) == 0 ? fread(block, 1, sizeof block, file) : 0;
        own = i == 0 &&
              (contains_text(block, n, STORE_FORMAT_ATTRIBUTE) ||
               contains_text(block, n, STORE_MAP_ATTRIBUTE) || is_weartrack_database(block, n));
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
