/* Reads and writes files of a report: embedded ones by name, others by path.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_files.h"

#include "report/report_embedded.h"
#include "report/report_tables.h"

#include <errno.h>
#include <string.h>

const char *embedded_file_text(const char *name)
{
    for (const embedded_text *file = report_embedded; file->name != NULL; file++)
        if (strcmp(file->name, name) == 0)
            return file->text;
    return NULL;
}

wt_status read_whole_file(const char *path, size_t limit, text_buffer *text, wt_error *err)
{
    wt_status status = WT_OK;
    char chunk[8192];
    FILE *file = fopen(path, "rb");
    for (size_t got;
         file != NULL && text->length <= limit && (got = fread(chunk, 1, sizeof chunk, file)) > 0;)
        text_bytes(text, chunk, got);
    const int reason = errno;
    if (file == NULL)
        status = wt_fail(err, reason == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "cannot be opened: %s",
                         strerror(reason));
    else if (ferror(file))
        status = wt_fail(err, WT_E_IO, "cannot be read: %s", strerror(reason));
    else if (text->length > limit)
        status = wt_fail(err, WT_E_RANGE, "larger than %zu bytes", limit);
    if (status != WT_OK)
        wt_error_file(err, path);
    if (file != NULL)
        fclose(file);
    return status;
}

wt_status write_temporary_file(const char *path, const char *bytes, size_t length, wt_error *err)
{
    FILE *file = fopen(path, "wb");
    bool good = file != NULL && fwrite(bytes, 1, length, file) == length;
    int code = errno;
    if (file != NULL && fclose(file) != 0 && good) {
        code = errno;
        good = false;
    }
    if (good)
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_IO, "cannot be written: %s", strerror(code));
    wt_error_file(err, path);
    return status;
}

wt_status write_user_file(const char *path, const text_buffer *text, wt_error *err)
{
    wt_atomic_file *out = NULL;
    wt_status status = wt_outfile_open(path, &out, err);
    if (status != WT_OK)
        return status;
    if (fwrite(text_string(text), 1, text->length, wt_outfile_stream(out)) == text->length)
        return wt_outfile_commit(out, err);
    wt_outfile_discard(out);
    status = wt_fail(err, WT_E_IO, "cannot be written");
    wt_error_file(err, path);
    return status;
}

/* Adds the names of the built-in styles: "paper, screen". */
static void add_style_names(text_buffer *names)
{
    for (const embedded_text *file = report_embedded; file->name != NULL; file++) {
        const char *end = strstr(file->name, ".gp");
        if (end != NULL)
            text_format(names, "%s%.*s", names->length == 0 ? "" : ", ", (int)(end - file->name),
                        file->name);
    }
}

wt_status find_built_in_style(const char *name, const char **text, wt_error *err)
{
    text_buffer file = {0}, names = {0};
    text_format(&file, "%s.gp", name);
    *text = embedded_file_text(text_string(&file));
    text_free(&file);
    if (*text != NULL)
        return WT_OK;
    add_style_names(&names);
    wt_status status = wt_fail(err, WT_E_NOT_FOUND, "no plot style of that name");
    wt_error_expected(err, "%s", text_string(&names));
    wt_error_found(err, "\"%s\"", name);
    wt_error_advice(err, "a style of your own is a file that ends in .gp, given with --style");
    text_free(&names);
    return status;
}

wt_status read_style(const char *style, text_buffer *text, wt_error *err)
{
    enum { STYLE_LIMIT = 1 << 20 };
    const char *name = style != NULL ? style : "paper", *built_in = NULL;
    size_t length = strlen(name);
    if (strchr(name, '/') != NULL || (length > 3 && strcmp(name + length - 3, ".gp") == 0)) {
        wt_protect_input(name);
        return read_whole_file(name, STYLE_LIMIT, text, err);
    }
    wt_status status = find_built_in_style(name, &built_in, err);
    if (status != WT_OK)
        return status;
    text_add(text, built_in);
    return WT_OK;
}

/* ---- verdicts -------------------------------------------------------------------------------- */

#define VERDICT_NAMES(name, id, text) {id, text},
static const char *const verdicts[][2] = {WT_CURVE_VERDICT_LIST(VERDICT_NAMES)};

const char *verdict_words(int verdict)
{
    return verdict >= 0 && verdict <= WT_CURVE_UNREADABLE ? verdicts[verdict][1] : "";
}

void append_verdict_words(text_buffer *to)
{
    for (int k = WT_CURVE_DOUBTFUL + 1; k <= WT_CURVE_UNREADABLE; k++) {
        text_add(to, k == WT_CURVE_DOUBTFUL + 1 ? "{" : ",");
        text_json(to, verdicts[k][0]);
        text_add(to, ":");
        text_json(to, verdicts[k][1]);
    }
    text_add(to, "}");
}
