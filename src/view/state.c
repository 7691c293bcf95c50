/* State of a case for the page: texts, files in its folder, and results.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/system/temporary.h"
#include "job/inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- files in the folder of a case ----------------------------------------------------------- */

bool is_plain_name(const char *name)
{
    enum { LIMIT = 200, FIRST_PRINTABLE = 0x20, DELETE = 0x7f };
    if (name[0] == '\0' || name[0] == '.' || name[0] == '-' || strnlen(name, LIMIT + 1) > LIMIT)
        return false;
    for (; *name != '\0'; name++)
        if (*name == '/' || (unsigned char)*name < FIRST_PRINTABLE || *name == DELETE)
            return false;
    return true;
}

static wt_status fail_on_file(wt_status kind, const char *name, const char *what, wt_error *err)
{
    const wt_status status = wt_fail(err, kind, "%s", what);
    wt_error_file(err, name);
    return status;
}

wt_status case_file_read(const char *folder, const char *name, size_t limit, text_buffer *text,
                         wt_error *err)
{
    struct stat state;
    char chunk[16 << 10];
    if (!is_plain_name(name))
        return fail_on_file(WT_E_IO, name, "that is no plain file name", err);
    char *path = wt_path_join(folder, name);
    /* Without O_NONBLOCK, opening a named pipe would wait for its writer. */
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "r") : NULL;
    free(path);
    if (file == NULL)
        return fail_on_file(errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, name,
                            errno == ELOOP ? "symbolic links are not followed" : strerror(errno),
                            err);
    const char *fault =
        fstat(descriptor, &state) == 0 && S_ISREG(state.st_mode) ? NULL : "not a regular file";
    for (size_t n;
         fault == NULL && text->length <= limit && (n = fread(chunk, 1, sizeof chunk, file)) > 0;)
        text_bytes(text, chunk, n);
    if (fault == NULL && ferror(file))
        fault = strerror(errno);
    if (fault == NULL && text->length > limit)
        fault = "the file is too large";
    (void)fclose(file);
    return fault == NULL ? WT_OK : fail_on_file(WT_E_IO, name, fault, err);
}

/* Writes a new file. False with errno. */
static bool write_new(const char *path, const text_buffer *text)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    if (file == NULL)
        return false;
    bool good = fwrite(text_string(text), 1, text->length, file) == text->length &&
                fflush(file) == 0 && fsync(descriptor) == 0;
    good = fclose(file) == 0 && good;
    if (!good)
        (void)unlink(path);
    return good;
}

wt_status case_file_write(const char *folder, const char *name, bool replace,
                          const text_buffer *text, wt_error *err)
{
    struct stat before;
    if (!is_plain_name(name))
        return fail_on_file(WT_E_IO, name, "that is no plain file name", err);
    char *path = wt_path_join(folder, name), *temporary = temporary_name(folder);
    const bool exists = lstat(path, &before) == 0;
    const char *fault = NULL;
    if (exists && !replace)
        fault = "the folder has a file of this name";
    else if (exists && !S_ISREG(before.st_mode))
        fault = "only a regular file is replaced";
    else if (!replace) /* O_EXCL also refuses a symbolic link */
        fault = write_new(path, text) ? NULL : strerror(errno);
    else if (temporary == NULL || !write_new(temporary, text) ||
             (exists && chmod(temporary, before.st_mode & 0777) != 0) ||
             rename(temporary, path) != 0) /* does not follow a link, either */
        fault = strerror(errno);
    if (fault != NULL && temporary != NULL)
        (void)unlink(temporary);
    free(temporary);
    free(path);
    return fault == NULL ? WT_OK : fail_on_file(WT_E_IO, name, fault, err);
}

/* ---- state ----------------------------------------------------------------------------------- */

void view_give_file(wt_view *view, char *path)
{
    view->given = array_grow(view->given, view->n_given, sizeof *view->given);
    view->given[view->n_given++] = path;
}

static void add_file(wt_view *view, const char *path)
{
    enum { MAX_FILES = 2000 };
    for (size_t i = 0; i < view->n_files; i++)
        if (strcmp(view->files[i], path) == 0)
            return;
    if (view->n_files < MAX_FILES) {
        view->files = array_grow(view->files, view->n_files, sizeof *view->files);
        view->files[view->n_files++] = wt_strdup(path);
    }
}

/* Lists the files of all roles of the case, else the visible files of the folder except case and
 * result, and those that were added. */
static void list_files(wt_view *view, const wt_case *c)
{
    wt_job work = wt_job_defaults();
    char **paths = NULL;
    size_t n = 0;
    work.formats = view->formats;
    wt_strings_free(view->files, view->n_files);
    view->files = NULL;
    view->n_files = 0;
    for (const case_files *role = c != NULL ? c->roles : NULL; role != NULL; role = role->next) {
        flow_files files = {0};
        /* A pattern without a file is an error, which the run reports. */
        if (flow_files_list(role->sets, role->n, &work, &files, NULL) == WT_OK)
            for (size_t i = 0; i < files.n; i++)
                add_file(view, files.file[i].path);
        flow_files_clear(&files);
    }
    if (view->n_files == 0 && !view->by_files &&
        wt_glob(view->folder, ".", &paths, &n, NULL) == WT_OK)
        for (size_t i = 0; i < n; i++) {
            const char *name = wt_path_base(paths[i]);
            char *path = wt_path_join(view->folder, name);
            if (strcmp(name, view->case_name) != 0 && strcmp(name, view->result_name) != 0)
                add_file(view, path);
            free(path);
        }
    wt_strings_free(paths, n);
    for (size_t i = 0; i < view->n_given; i++)
        add_file(view, view->given[i]);
}

/* Returns the file of the manual overrides of a case, a name in its folder; NULL if the case names
 * a file elsewhere. */
static char *overrides_of_case(const wt_case *c)
{
    if (c == NULL || c->indent.choices == NULL)
        return wt_strdup("overrides.tsv");
    char *folder = wt_path_folder(c->indent.choices);
    const char *name = wt_path_base(c->indent.choices);
    const bool here = strcmp(folder, c->folder) == 0 && is_plain_name(name);
    free(folder);
    return here ? wt_strdup(name) : NULL;
}

/* Time of a regular file, not of a link, in the folder [ns]; 0 if there is none. */
static int64_t file_time(const wt_view *view, const char *name)
{
    enum { NANOSECONDS = 1000000000 };
    struct stat state;
    char *path = wt_path_join(view->folder, name);
    const bool exists = lstat(path, &state) == 0 && S_ISREG(state.st_mode);
    free(path);
    return exists ? (int64_t)state.st_mtim.tv_sec * NANOSECONDS + state.st_mtim.tv_nsec : 0;
}

wt_status view_read_result(wt_view *view, wt_error *err)
{
    const int64_t time = file_time(view, view->result_name);
    if (time == view->result_time)
        return WT_OK;
    wt_result_free(view->result);
    view->result = NULL;
    view->result_time = time;
    if (time == 0)
        return WT_OK;
    char *path = wt_path_join(view->folder, view->result_name);
    const wt_status status = wt_store_read(path, &view->result, err);
    free(path);
    return status;
}

static void append_member(text_buffer *to, const char *name, const char *value)
{
    text_format(to, ",\"%s\":", name);
    if (value != NULL)
        text_json(to, value);
    else
        text_add(to, "null");
}

/* Appends the text of a file and its digest, which identifies it when it is replaced. */
static void append_file(const wt_view *view, const char *member, const char *name, text_buffer *to)
{
    char digest[65] = "";
    wt_error failure = WT_ERROR_INIT;
    text_buffer text = {0};
    const wt_status status =
        name != NULL ? case_file_read(view->folder, name, VIEW_BODY_LIMIT, &text, &failure)
                     : WT_E_NOT_FOUND;
    if (status == WT_OK)
        wt_sha256(text_string(&text), text.length, digest);
    text_format(to, ",\"%s\":{\"problem\":", member);
    text_json(to, status == WT_E_NOT_FOUND ? "" : failure.message);
    append_member(to, "name", name);
    append_member(to, "text", status == WT_OK ? text_string(&text) : NULL);
    append_member(to, "digest", digest);
    text_add(to, "}");
    text_free(&text);
}

wt_status view_answer_state(view_call *call, wt_error *err)
{
    wt_view *view = call->view;
    text_buffer *to = &call->reply;
    wt_case *c = NULL;
    wt_error failure = WT_ERROR_INIT;
    char message[1024] = "";
    const char *xml = NULL;
    size_t length = 0;
    const wt_status status = view_read_result(view, err);
    if (status != WT_OK)
        return status;
    if (wt_case_read(view->case_path, &c, &failure) != WT_OK) {
        c = NULL;
        wt_error_format(&failure, message, sizeof message);
    }
    list_files(view, c);
    free(view->overrides_name);
    view->overrides_name = overrides_of_case(c);
    const char *overrides = view->overrides_name;
    char *page = format_text("%s/index.html", view->report_name),
         *made_of = view->result != NULL && (xml = wt_result_case(view->result, &length)) != NULL
                        ? wt_strndup(xml, length)
                        : NULL;
    text_format(to, "{\"overridesAreLater\":%s",
                overrides != NULL && file_time(view, overrides) > view->result_time ? "true"
                                                                                    : "false");
    append_member(to, "version", wt_version());
    append_member(to, "folder", view->folder);
    append_member(to, "title", c != NULL ? wt_case_title(c) : "");
    append_member(to, "caseProblem", message);
    append_file(view, "case", view->case_name, to);
    append_file(view, "overrides", overrides, to);
    append_member(to, "resultCase", made_of);
    append_member(to, "resultName", view->result != NULL ? view->result_name : NULL);
    append_member(to, "reportName", file_time(view, page) != 0 ? view->report_name : NULL);
    text_add(to, ",\"files\":");
    text_json_list(to, (const char *const *)view->files, view->n_files);
    text_add(to, ",\"tables\":[");
    for (size_t i = 0; view->result != NULL && i < wt_result_n_tables(view->result); i++) {
        text_add(to, i > 0 ? "," : "");
        text_json(to, wt_table_name(wt_result_table(view->result, i)));
    }
    text_add(to, "],\"verdicts\":");
    append_verdict_text(to);
    text_add(to, "}");
    free(page);
    free(made_of);
    wt_case_free(c);
    return WT_OK;
}
