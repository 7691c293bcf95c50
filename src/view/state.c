/* State of a case for the page: texts, files and results.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/inputs.h"
#include "report/report_files.h"
#include "view/view.h"

#include "core/base/array.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_FILES = 2000 };

/* ---- files ----------------------------------------------------------------------------------- */

void view_give_file(wt_view *view, char *path)
{
    view->given = array_grow(view->given, view->n_given, sizeof *view->given);
    view->given[view->n_given++] = path;
}

static void add_file(wt_view *view, const char *path)
{
    for (size_t i = 0; i < view->n_files; i++)
        if (strcmp(view->files[i], path) == 0)
            return;
    if (view->n_files >= MAX_FILES)
        return;
    view->files = array_grow(view->files, view->n_files, sizeof *view->files);
    view->files[view->n_files++] = wt_strdup(path);
}

/* Adds the files of all roles of the case. */
static void add_case_files(wt_view *view, const wt_case *c)
{
    wt_job work = wt_job_defaults();
    work.formats = view->formats;
    for (const case_files *role = c->roles; role != NULL; role = role->next) {
        flow_files files = {0};
        /* A pattern without a file is an error, which the run reports. */
        if (flow_files_list(role->sets, role->n, &work, &files, NULL) == WT_OK)
            for (size_t i = 0; i < files.n; i++)
                add_file(view, files.file[i].path);
        flow_files_clear(&files);
    }
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Adds the visible files of the folder, except case, result and report. */
static void add_folder_files(wt_view *view)
{
    DIR *folder = opendir(view->folder.path);
    for (const struct dirent *e; folder != NULL && (e = readdir(folder)) != NULL;) {
        struct stat state;
        char *path = wt_path_join(view->folder.path, e->d_name);
        if (e->d_name[0] != '.' && strcmp(e->d_name, view->case_name) != 0 &&
            strcmp(e->d_name, view->result_name) != 0 && stat(path, &state) == 0 &&
            S_ISREG(state.st_mode))
            add_file(view, path);
        free(path);
    }
    if (folder != NULL)
        closedir(folder);
    if (view->n_files > 1)
        qsort(view->files, view->n_files, sizeof *view->files, compare_names);
}

static void list_files(wt_view *view, const wt_case *c)
{
    wt_strings_free(view->files, view->n_files);
    view->files = NULL;
    view->n_files = 0;
    if (c != NULL)
        add_case_files(view, c);
    if (view->n_files == 0 && !view->by_files)
        add_folder_files(view);
    for (size_t i = 0; i < view->n_given; i++)
        add_file(view, view->given[i]);
}

/* ---- overrides ------------------------------------------------------------------------------- */

/* Returns the name of the overrides of a case in its folder, NULL if they are elsewhere. */
static char *overrides_of_case(const wt_case *c)
{
    if (c == NULL || c->indent.choices == NULL)
        return wt_strdup("overrides.tsv");
    char *folder = wt_path_folder(c->indent.choices);
    const char *name = wt_path_base(c->indent.choices);
    const bool here = strcmp(folder, c->folder) == 0 && case_folder_is_name(name);
    free(folder);
    return here ? wt_strdup(name) : NULL;
}

char *view_overrides_name(const wt_view *view)
{
    wt_case *c = NULL;
    if (wt_case_read(view->case_path, &c, NULL) != WT_OK)
        c = NULL;
    char *name = overrides_of_case(c);
    wt_case_free(c);
    return name;
}

/* ---- result ---------------------------------------------------------------------------------- */

wt_status view_read_result(wt_view *view, wt_error *err)
{
    struct stat state;
    if (fstatat(view->folder.descriptor, view->result_name, &state, AT_SYMLINK_NOFOLLOW) != 0 ||
        !S_ISREG(state.st_mode)) {
        wt_result_free(view->result);
        view->result = NULL;
        return WT_OK;
    }
    if (view->result != NULL && state.st_mtim.tv_sec == view->result_time.tv_sec &&
        state.st_mtim.tv_nsec == view->result_time.tv_nsec)
        return WT_OK;
    char *path = wt_path_join(view->folder.path, view->result_name);
    wt_result *result = NULL;
    const wt_status status = wt_store_read(path, &result, err);
    free(path);
    wt_result_free(view->result);
    view->result = result;
    view->result_time = state.st_mtim;
    return status;
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static void append_member(text_buffer *to, const char *name, const char *value)
{
    text_format(to, ",\"%s\":", name);
    if (value != NULL)
        text_json(to, value);
    else
        text_add(to, "null");
}

/* Appends the text of a file and its digest, which identifies it when it is replaced. Without a
 * file the text is `instead`, which may be NULL. */
static void append_file(const case_folder *folder, const char *prefix, const char *name,
                        const char *instead, text_buffer *to)
{
    char key[64], digest[65] = "";
    bool exists = false;
    wt_error failure = WT_ERROR_INIT;
    text_buffer text = {0};
    if (name != NULL &&
        case_folder_read(folder, name, VIEW_BODY_LIMIT, &exists, &text, &failure) == WT_OK &&
        exists)
        wt_sha256(text_string(&text), text.length, digest);
    (void)snprintf(key, sizeof key, "%sText", prefix);
    append_member(to, key, exists ? text_string(&text) : instead);
    (void)snprintf(key, sizeof key, "%sDigest", prefix);
    append_member(to, key, digest);
    (void)snprintf(key, sizeof key, "%sError", prefix);
    append_member(to, key, failure.message);
    text_free(&text);
}

static void append_names(const wt_view *view, text_buffer *to)
{
    text_add(to, ",\"files\":");
    text_json_list(to, (const char *const *)view->files, view->n_files);
    text_add(to, ",\"tables\":[");
    for (size_t i = 0; view->result != NULL && i < wt_result_n_tables(view->result); i++) {
        text_add(to, i > 0 ? "," : "");
        text_json(to, wt_table_name(wt_result_table(view->result, i)));
    }
    text_add(to, "]");
}

static bool has_report(const wt_view *view)
{
    struct stat state;
    char *place = wt_path_join(view->folder.path, view->report_name);
    char *page = wt_path_join(place, "index.html");
    const bool has = stat(page, &state) == 0 && S_ISREG(state.st_mode);
    free(page);
    free(place);
    return has;
}

/* True if a file is missing or not newer than the result. */
static bool is_older(const wt_view *view, const char *name)
{
    struct stat state;
    if (name == NULL || fstatat(view->folder.descriptor, name, &state, AT_SYMLINK_NOFOLLOW) != 0)
        return true;
    const struct timespec *file = &state.st_mtim, *result = &view->result_time;
    return file->tv_sec < result->tv_sec ||
           (file->tv_sec == result->tv_sec && file->tv_nsec <= result->tv_nsec);
}

/* Returns the case in the result, a new string, if the file of the case is missing; else NULL. */
static char *case_of_result(const wt_view *view)
{
    size_t length = 0;
    struct stat state;
    const char *xml = view->result != NULL ? wt_result_case(view->result, &length) : NULL;
    const bool is_missing =
        fstatat(view->folder.descriptor, view->case_name, &state, AT_SYMLINK_NOFOLLOW) != 0;
    return xml != NULL && is_missing ? wt_strndup(xml, length) : NULL;
}

/* True if the result is that of the case and the overrides on the disk. `run --keep` also compares
 * the data files, which takes longer. */
static bool is_current(const wt_view *view, const wt_case *c, const char *overrides)
{
    size_t length = 0;
    const char *xml = view->result != NULL ? wt_result_case(view->result, &length) : NULL;
    return c != NULL && xml != NULL && length == c->xml_length &&
           memcmp(xml, c->xml, length) == 0 && is_older(view, overrides);
}

wt_status view_append_state(wt_view *view, text_buffer *to, wt_error *err)
{
    wt_case *c = NULL;
    wt_error failure = WT_ERROR_INIT;
    char message[1024] = "";
    wt_status status = view_read_result(view, err);
    if (status != WT_OK)
        return status;
    if (wt_case_read(view->case_path, &c, &failure) != WT_OK) {
        c = NULL;
        wt_error_format(&failure, message, sizeof message);
    }
    list_files(view, c);
    char *overrides = overrides_of_case(c), *stored = case_of_result(view);
    text_format(to, "{\"version\":\"%s\"", wt_version());
    append_member(to, "folder", view->folder.path);
    append_member(to, "caseName", view->case_name);
    append_member(to, "title", c != NULL ? wt_case_title(c) : "");
    append_member(to, "caseProblem", stored != NULL ? "" : message);
    append_file(&view->folder, "case", view->case_name, stored, to);
    append_member(to, "overridesName", overrides);
    text_format(to, ",\"overridesInCase\":%s",
                c != NULL && c->indent.choices != NULL ? "true" : "false");
    append_file(&view->folder, "overrides", overrides, NULL, to);
    append_member(to, "resultName", view->result != NULL ? view->result_name : NULL);
    append_member(to, "reportName", has_report(view) ? view->report_name : NULL);
    text_format(to, ",\"current\":%s",
                stored != NULL || is_current(view, c, overrides) ? "true" : "false");
    append_names(view, to);
    text_add(to, ",\"verdicts\":");
    append_verdict_text(to);
    text_add(to, "}");
    free(stored);
    free(overrides);
    wt_case_free(c);
    return WT_OK;
}
