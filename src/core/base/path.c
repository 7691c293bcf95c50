/* Functions for paths as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <stdlib.h>
#include <string.h>

char *wt_path_join(const char *folder, const char *name)
{
    /* "./name" is shortened to "name". */
    if (name[0] == '/' || folder == NULL || folder[0] == '\0' || strcmp(folder, ".") == 0)
        return wt_strdup(name);
    const size_t n_folder = strlen(folder), n_name = strlen(name);
    const size_t slash = folder[n_folder - 1] == '/' ? 0 : 1;
    char *const path = wt_alloc(n_folder + slash + n_name + 1, 1);
    memcpy(path, folder, n_folder);
    if (slash == 1)
        path[n_folder] = '/';
    memcpy(path + n_folder + slash, name, n_name + 1);
    return path;
}

char *wt_path_folder(const char *path)
{
    const char *const slash = strrchr(path, '/');
    if (slash == NULL)
        return wt_strdup(".");
    return wt_strndup(path, slash == path ? 1 : (size_t)(slash - path));
}

const char *wt_path_base(const char *path)
{
    const char *const slash = strrchr(path, '/');
    return slash == NULL ? path : slash + 1;
}

void wt_strings_free(char **strings, size_t n)
{
    if (strings == NULL)
        return;
    for (size_t i = 0; i < n; i++)
        free(strings[i]);
    free(strings);
}
