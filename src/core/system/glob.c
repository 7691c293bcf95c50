/* Expands shell patterns to sorted lists of files. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct path_list {
    char **paths;
    size_t n;
    size_t n_folders; /* number of subfolders, which are not searched */
} path_list;

/* Transfers `path` to the list. */
static void path_list_add(path_list *l, char *path)
{
    l->paths = array_grow(l->paths, l->n, sizeof *l->paths);
    l->paths[l->n++] = path;
}

static int compare_path_bytes(const void *a, const void *b)
{
    char *const *const p = a, *const *const q = b;
    return strcmp(*p, *q);
}

/* Adds a file, or the regular files of a folder without hidden ones. */
static wt_status add_path(path_list *l, const char *path, wt_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0) {
        const wt_status status = wt_fail(err, WT_E_IO, "%s", strerror(errno));
        wt_error_file(err, path);
        return status;
    }
    if (!S_ISDIR(info.st_mode)) {
        path_list_add(l, wt_strdup(path));
        return WT_OK;
    }
    DIR *const folder = opendir(path);
    if (folder == NULL) {
        const wt_status status =
            wt_fail(err, WT_E_IO, "cannot read the folder: %s", strerror(errno));
        wt_error_file(err, path);
        return status;
    }
    const struct dirent *item;
    while ((item = readdir(folder)) != NULL) {
        if (item->d_name[0] == '.')
            continue;
        char *const inner = wt_path_join(path, item->d_name);
        const bool known = stat(inner, &info) == 0;
        l->n_folders += known && S_ISDIR(info.st_mode);
        if (known && S_ISREG(info.st_mode))
            path_list_add(l, inner);
        else
            free(inner);
    }
    (void)closedir(folder);
    return WT_OK;
}

/* Quotes every character with a special meaning for glob. */
static char *escape_glob_characters(const char *text)
{
    char *const quoted = wt_alloc(2 * strlen(text) + 1, 1);
    char *to = quoted;
    for (const char *from = text; *from != '\0'; from++) {
        if (strchr("*?[]\\", *from) != NULL)
            *to++ = '\\';
        *to++ = *from;
    }
    *to = '\0';
    return quoted;
}

wt_status wt_glob(const char *folder, const char *pattern, char ***paths, size_t *n, wt_error *err)
{
    wt_status status = WT_OK;
    path_list l = {NULL, 0, 0};
    glob_t found = {0};
    struct stat info;
    char *quoted = escape_glob_characters(folder != NULL ? folder : "");
    char *full = wt_path_join(quoted, pattern);
    char *literal = wt_path_join(folder, pattern);
    if (stat(literal, &info) == 0) {
        /* A file may have a name like "curve[1].txt". */
        status = add_path(&l, literal, err);
    } else {
        const int code = glob(full, GLOB_NOSORT, NULL, &found);
        if (code != 0 && code != GLOB_NOMATCH) {
            if (code == GLOB_NOSPACE)
                out_of_memory(strlen(full));
            status = wt_fail(err, WT_E_IO, "cannot read a folder");
            wt_error_file(err, literal);
        }
        for (size_t i = 0; status == WT_OK && i < found.gl_pathc; i++)
            status = add_path(&l, found.gl_pathv[i], err);
    }
    if (status == WT_OK && l.n == 0) {
        status = wt_fail(err, WT_E_NOT_FOUND, "no file found");
        wt_error_file(err, literal);
        wt_error_expected(err, "the name of a file or a folder with files, or a pattern such as "
                               "'*.txt'");
        if (l.n_folders > 0) {
            wt_error_found(err, "folders only: %zu", l.n_folders);
            wt_error_advice(err, "'%s/*' takes the files of each", pattern);
        }
    }
    if (status == WT_OK) {
        /* The order is by bytes, because that of glob depends on the locale. */
        qsort(l.paths, l.n, sizeof *l.paths, compare_path_bytes);
        *paths = l.paths;
        *n = l.n;
        l = (path_list){NULL, 0, 0};
    }
    wt_strings_free(l.paths, l.n);
    globfree(&found);
    free(quoted);
    free(full);
    free(literal);
    return status;
}
