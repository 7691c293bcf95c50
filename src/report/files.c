/* Files that a report reads: those of the library by name, a style or a picture by path.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/files.h"

#include "report/report_embedded.h"

#include <errno.h>
#include <string.h>

const char *file_of_library(const char *name)
{
    for (const embedded_text *file = report_embedded; file->name != NULL; file++)
        if (strcmp(file->name, name) == 0)
            return file->text;
    return NULL;
}

/* Names of the plot styles, "paper, screen"; at most `size` bytes. */
static void style_names(char *names, size_t size)
{
    size_t n = 0;
    names[0] = '\0';
    for (const embedded_text *file = report_embedded; file->name != NULL; file++) {
        const char *end = strstr(file->name, ".gp");
        if (end == NULL || n >= size)
            continue;
        int more = snprintf(names + n, size - n, "%s%.*s", n == 0 ? "" : ", ",
                            (int)(end - file->name), file->name);
        n += more > 0 ? (size_t)more : 0;
    }
}

wt_status file_read(const char *path, size_t limit, growing_text *text, wt_error *err)
{
    wt_status status = WT_OK;
    char chunk[8192];
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        status = wt_fail(err, errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "cannot be opened: %s",
                         strerror(errno));
        wt_error_file(err, path);
        return status;
    }
    for (size_t got; (got = fread(chunk, 1, sizeof chunk, file)) > 0;) {
        text_bytes(text, chunk, got);
        if (text->length > limit) {
            status = wt_fail(err, WT_E_RANGE, "larger than %zu bytes", limit);
            wt_error_file(err, path);
            goto done;
        }
    }
    if (ferror(file)) {
        status = wt_fail(err, WT_E_IO, "cannot be read: %s", strerror(errno));
        wt_error_file(err, path);
    } else if (text->failed)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
done:
    fclose(file);
    return status;
}

wt_status file_style(const char *style, growing_text *text, wt_error *err)
{
    enum { STYLE_LIMIT = 1 << 20 };
    const char *name = style != NULL ? style : "paper";
    size_t length = strlen(name);
    if (strchr(name, '/') != NULL || (length > 3 && strcmp(name + length - 3, ".gp") == 0))
        return file_read(name, STYLE_LIMIT, text, err);
    growing_text file = {0};
    text_format(&file, "%s.gp", name);
    const char *built_in = file_of_library(text_string(&file));
    text_free(&file);
    if (built_in != NULL) {
        text_add(text, built_in);
        return text->failed ? wt_fail(err, WT_E_MEMORY, "out of memory") : WT_OK;
    }
    char names[128];
    style_names(names, sizeof names);
    wt_status status = wt_fail(err, WT_E_NOT_FOUND, "no plot style of that name");
    wt_error_expected(err, "%s, or a file name that ends in .gp", names);
    wt_error_found(err, "\"%s\"", name);
    return status;
}
