/* Finds copies among the input files of a job, and removes them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/file_copies.h"

#include "core/base/memory.h"
#include "core/math/splitmix64.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 4096 }; /* one page of most file systems: the least that is read from a disk */

typedef struct file_identity {
    size_t index;  /* in the list */
    uint64_t size; /* 0 for a file that is not compared */
    uint64_t ends; /* hash of the first and the last block; only where sizes agree */
} file_identity;

static uint64_t size_of_file(const char *path)
{
    struct stat about;
    return strcmp(path, "-") != 0 && stat(path, &about) == 0 && S_ISREG(about.st_mode) &&
                   about.st_size > 0
               ? (uint64_t)about.st_size
               : 0;
}

/* Reads up to BLOCK bytes at `from`. 0 if they cannot be read. */
static size_t read_block(int descriptor, uint64_t from, unsigned char *block)
{
    const ssize_t n = pread(descriptor, block, BLOCK, (off_t)from);
    return n > 0 ? (size_t)n : 0;
}

static uint64_t hash_ends(const char *path, uint64_t size)
{
    unsigned char block[BLOCK];
    uint64_t hash = splitmix64(size);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return hash;
    for (int end = 0; end < 2; end++) {
        const size_t n = read_block(descriptor, end == 0 || size < BLOCK ? 0 : size - BLOCK, block);
        for (size_t i = 0; i < n; i++)
            hash = splitmix64(hash ^ block[i]);
    }
    (void)close(descriptor);
    return hash;
}

static bool bytes_are_equal(const char *path, const char *other, uint64_t size)
{
    unsigned char block[2][BLOCK];
    const int descriptor[2] = {open(path, O_RDONLY | O_CLOEXEC), open(other, O_RDONLY | O_CLOEXEC)};
    bool equal = descriptor[0] >= 0 && descriptor[1] >= 0;
    for (uint64_t from = 0; equal && from < size; from += BLOCK) {
        const size_t n = read_block(descriptor[0], from, block[0]);
        equal = n > 0 && n == read_block(descriptor[1], from, block[1]) &&
                memcmp(block[0], block[1], n) == 0;
    }
    for (int i = 0; i < 2; i++)
        if (descriptor[i] >= 0)
            (void)close(descriptor[i]);
    return equal;
}

static int compare_numbers(uint64_t a, uint64_t b)
{
    return a < b ? -1 : a > b;
}

static int compare_identities(const void *a, const void *b)
{
    const file_identity *const p = a, *const q = b;
    const int by_size = compare_numbers(p->size, q->size);
    const int by_ends = compare_numbers(p->ends, q->ends);
    return by_size != 0 ? by_size : by_ends != 0 ? by_ends : compare_numbers(p->index, q->index);
}

/* Marks in `copy_of` the files i of the run that have the bytes of an earlier one of the run. */
static void mark_copies(const flow_files *files, const file_identity *run, size_t n,
                        size_t *copy_of)
{
    for (size_t i = 1; i < n; i++) {
        const flow_file *const file = &files->file[run[i].index];
        for (size_t j = 0; j < i; j++) {
            const size_t earlier = run[j].index;
            if (copy_of[earlier] == earlier &&
                bytes_are_equal(files->file[earlier].path, file->path, run[i].size)) {
                copy_of[run[i].index] = earlier;
                break;
            }
        }
    }
}

/* Returns the end of the run of equal sizes, or of equal sizes and ends. */
static size_t run_end(const file_identity *file, size_t from, size_t n, bool ends)
{
    size_t to = from + 1;
    while (to < n && file[to].size == file[from].size &&
           (!ends || file[to].ends == file[from].ends))
        to++;
    return to;
}

static void remove_marked(flow_files *files, const size_t *copy_of, const wt_job *work)
{
    size_t n = 0;
    for (size_t i = 0; i < files->n; i++)
        if (copy_of[i] != i)
            wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, NULL, files->file[i].name, NULL,
                          "the same bytes as %s: a copy, left out; both count as one measurement",
                          files->file[copy_of[i]].name);
    for (size_t i = 0; i < files->n; i++) {
        if (copy_of[i] == i)
            files->file[n++] = files->file[i];
        else
            free((void *)files->file[i].path);
    }
    files->n = n;
}

void file_copies_remove(flow_files *files, const wt_job *work)
{
    const size_t n = files->n;
    file_identity *const file = wt_alloc(n, sizeof *file);
    size_t *const copy_of = wt_alloc(n, sizeof *copy_of);
    for (size_t i = 0; i < n; i++) {
        copy_of[i] = i;
        file[i] = (file_identity){i, size_of_file(files->file[i].path), 0};
    }
    qsort(file, n, sizeof *file, compare_identities);
    for (size_t i = 0, to; i < n; i = to) {
        to = run_end(file, i, n, false);
        for (size_t k = i; to > i + 1 && file[i].size > 0 && k < to; k++)
            file[k].ends = hash_ends(files->file[file[k].index].path, file[k].size);
    }
    qsort(file, n, sizeof *file, compare_identities);
    for (size_t i = 0, to; i < n; i = to) {
        to = run_end(file, i, n, true);
        if (file[i].size > 0)
            mark_copies(files, file + i, to - i, copy_of);
    }
    remove_marked(files, copy_of, work);
    free(file);
    free(copy_of);
}
