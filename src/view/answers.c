/* Answers the requests of the page: each is a call of the library, or starts weartrack.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/base/memory.h"
#include "report/report_files.h"
#include "view/view_embedded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    HTTP_OK = 200,
    HTTP_NOT_FOUND = 404,
    HTTP_CONFLICT = 409,
    HTTP_UNPROCESSABLE = 422,
    MAX_REPORT = 64 << 20
};

/* ---- parts of a reply ------------------------------------------------------------------------ */

/* Replaces the reply by the message of an error. */
static void reply_error(view_reply *reply, unsigned status, const wt_error *err)
{
    char message[2048];
    wt_error_format(err, message, sizeof message);
    text_free(&reply->text);
    reply->status = status;
    text_add(&reply->text, "{\"error\":");
    text_json(&reply->text, message);
    text_add(&reply->text, "}");
}

static void finish_reply(view_reply *reply, wt_status status, const wt_error *err)
{
    if (status != WT_OK)
        reply_error(reply, HTTP_UNPROCESSABLE, err);
    else if (reply->text.length == 0)
        text_add(&reply->text, "{}");
}

static wt_status append_table(const wt_table *table, text_buffer *to, wt_error *err)
{
    char *bytes = NULL;
    size_t length = 0;
    FILE *stream = text_stream_open(&bytes, &length);
    const wt_status status = wt_table_export(stream, table, WT_EXPORT_JSON, false, err);
    text_stream_close(stream);
    if (status == WT_OK)
        text_bytes(to, bytes, length);
    free(bytes);
    return status;
}

/* Appends "NAME":[TABLE,...] of those tables that exist. */
static wt_status append_tables(const char *name, const wt_table *const *tables, size_t n,
                               text_buffer *to, wt_error *err)
{
    wt_status status = WT_OK;
    size_t written = 0;
    text_format(to, "\"%s\":[", name);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        if (tables[i] == NULL)
            continue;
        text_add(to, written++ > 0 ? "," : "");
        status = append_table(tables[i], to, err);
    }
    text_add(to, "]");
    return status;
}

/* ---- files and results ----------------------------------------------------------------------- */

static void answer_file(const view_request *request, view_reply *reply)
{
    static const char *const media[][2] = {{".html", "text/html; charset=utf-8"},
                                           {".css", "text/css; charset=utf-8"},
                                           {".js", "text/javascript; charset=utf-8"}};
    for (const embedded_text *f = view_embedded; f->name != NULL; f++) {
        const char *ending = strrchr(f->name, '.');
        if (strcmp(f->name, request->name) != 0)
            continue;
        reply->bytes = f->text;
        reply->length = f->length;
        for (size_t i = 0; i < COUNT_OF(media); i++)
            if (strcmp(ending, media[i][0]) == 0)
                reply->media = media[i][1];
        return;
    }
    reply->status = HTTP_NOT_FOUND;
    text_add(&reply->text, "{}");
}

/* Content of a file with the remarks of its reader. */
static wt_status answer_info(wt_view *view, const view_request *request, text_buffer *to,
                             wt_error *err)
{
    wt_input *input = NULL;
    wt_table *metadata = NULL, *quality = NULL, *notes = NULL;
    wt_read_options options = wt_read_defaults();
    if (request->number >= view->n_files)
        return wt_fail(err, WT_E_NOT_FOUND, "no file has this number");
    wt_log *log = wt_log_new();
    wt_status status = wt_input_open(view->files[request->number], &input, err);
    if (status == WT_OK)
        status = wt_input_describe(view->formats, input, &options, log, &metadata, err);
    if (status == WT_OK)
        status = wt_data_quality_table(log, view->folder.path, &quality, err);
    if (status == WT_OK)
        status = wt_notes_table(log, view->folder.path, &notes, err);
    if (status == WT_OK) {
        const wt_table *const tables[] = {metadata, quality, notes};
        text_add(to, "{");
        status = append_tables("tables", tables, COUNT_OF(tables), to, err);
        text_add(to, "}");
    }
    wt_input_close(input);
    wt_table_free(metadata);
    wt_table_free(quality);
    wt_table_free(notes);
    wt_log_free(log);
    return status;
}

/* Appends the tables whose names are in `names`, separated by blanks, and the failures. */
static wt_status append_named(const wt_result *result, const char *names, text_buffer *to,
                              wt_error *err)
{
    enum { MAX_TABLES = 32 };
    const wt_table *tables[MAX_TABLES];
    char *list = wt_strdup(names), *rest = NULL;
    size_t n = 0;
    for (const char *name = strtok_r(list, " ", &rest); name != NULL && n + 1 < MAX_TABLES;
         name = strtok_r(NULL, " ", &rest))
        tables[n++] = wt_result_find(result, name);
    tables[n++] = wt_result_find(result, "failures");
    free(list);
    return append_tables("tables", tables, n, to, err);
}

static wt_status answer_table(wt_view *view, const view_request *request, text_buffer *to,
                              wt_error *err)
{
    wt_status status = view_read_result(view, err);
    if (status == WT_OK && view->result == NULL)
        status = wt_fail(err, WT_E_NOT_FOUND, "there is no result yet; run the case");
    if (status != WT_OK)
        return status;
    text_add(to, "{");
    status = append_named(view->result, request->name, to, err);
    text_add(to, "}");
    return status;
}

static wt_status answer_report(const wt_view *view, view_reply *reply, wt_error *err)
{
    case_folder folder = {.descriptor = -1};
    bool exists = false;
    char *path = wt_path_join(view->folder.path, view->report_name);
    wt_status status = case_folder_open(path, &folder, err);
    if (status == WT_OK)
        status = case_folder_read(&folder, "index.html", MAX_REPORT, &exists, &reply->text, err);
    if (status == WT_OK && !exists)
        status = wt_fail(err, WT_E_NOT_FOUND, "there is no report yet; run the case");
    if (status == WT_OK)
        reply->media = "text/html; charset=utf-8";
    case_folder_close(&folder);
    free(path);
    return status;
}

/* ---- trials ---------------------------------------------------------------------------------- */

static wt_status answer_check(const wt_view *view, const char *body, size_t length, wt_error *err)
{
    wt_case *c = NULL;
    const wt_status status = case_from_bytes(body, length, view->case_path, &c, err);
    if (status == WT_OK)
        wt_case_free(c);
    return status;
}

/* Runs the text of a case for the requested tables, as `weartrack run` does. */
static wt_status answer_trial(wt_view *view, const view_request *request, const char *body,
                              size_t length, text_buffer *to, wt_error *err)
{
    wt_result *result = NULL;
    wt_run_options run = wt_run_defaults();
    const double start = wt_time_wall();
    run.threads = view->options.threads;
    run.formats = view->options.formats;
    run.replicates = request->replicates;
    run.no_provenance = true;
    wt_status status = case_refit_run(view->refit, body, length, view->case_path, request->name,
                                      &run, &result, err);
    if (status == WT_OK) {
        text_add(to, "{");
        status = append_named(result, request->name, to, err);
        text_format(to, ",\"time\":%.4f}", wt_time_wall() - start);
    }
    wt_result_free(result);
    return status;
}

static wt_status answer_curve(wt_view *view, const view_request *request, const char *body,
                              size_t length, text_buffer *to, wt_error *err)
{
    wt_indent_tables tables = {0};
    const double start = wt_time_wall();
    const refit_curve which = {request->group, request->file, request->number,
                               request->contact_point};
    wt_status status =
        case_refit_curve(view->refit, body, length, view->case_path, &which, NULL, &tables, err);
    if (status == WT_OK) {
        const wt_table *const made[] = {tables.indentation, tables.curves};
        text_add(to, "{");
        status = append_tables("tables", made, COUNT_OF(made), to, err);
        text_format(to, ",\"time\":%.4f}", wt_time_wall() - start);
    }
    wt_indent_tables_clear(&tables);
    return status;
}

/* ---- writing --------------------------------------------------------------------------------- */

/* Replaces a file unless it has changed since the page read it: another page may have done so. */
static void save_file(const wt_view *view, const char *name, const view_request *request,
                      const char *body, size_t length, view_reply *reply)
{
    wt_error err = WT_ERROR_INIT;
    text_buffer before = {0};
    bool exists = false;
    char digest[65] = "";
    wt_status status =
        case_folder_read(&view->folder, name, VIEW_BODY_LIMIT, &exists, &before, &err);
    if (exists)
        wt_sha256(text_string(&before), before.length, digest);
    text_free(&before);
    if (status == WT_OK && strcmp(digest, request->digest) != 0) {
        (void)wt_fail(&err, WT_E_ARG, "the file has changed since this page read it");
        wt_error_file(&err, name);
        wt_error_advice(&err, "load the page again");
        reply_error(reply, HTTP_CONFLICT, &err);
        return;
    }
    if (status == WT_OK)
        status = case_folder_write(&view->folder, name, body, length, &err);
    if (status == WT_OK) {
        wt_sha256(body, length, digest);
        text_format(&reply->text, "{\"digest\":\"%s\"}", digest);
    }
    finish_reply(reply, status, &err);
}

static void answer_save_case(const wt_view *view, const view_request *request, const char *body,
                             size_t length, view_reply *reply)
{
    wt_error err = WT_ERROR_INIT;
    if (answer_check(view, body, length, &err) != WT_OK)
        reply_error(reply, HTTP_UNPROCESSABLE, &err);
    else
        save_file(view, view->case_name, request, body, length, reply);
}

static void answer_save_overrides(const wt_view *view, const view_request *request,
                                  const char *body, size_t length, view_reply *reply)
{
    wt_error err = WT_ERROR_INIT;
    char *name = view_overrides_name(view);
    if (name != NULL) {
        save_file(view, name, request, body, length, reply);
    } else {
        (void)wt_fail(&err, WT_E_ARG, "the overrides of the case are in another folder");
        wt_error_advice(&err, "move the file beside the case and correct <overrides>");
        reply_error(reply, HTTP_UNPROCESSABLE, &err);
    }
    free(name);
}

/* Writes a data file that was dropped on the page. It never replaces a file. */
static wt_status answer_add(wt_view *view, const view_request *request, const char *body,
                            size_t length, wt_error *err)
{
    const wt_status status = case_folder_add(&view->folder, request->name, body, length, err);
    if (status == WT_OK)
        view_give_file(view, wt_path_join(view->folder.path, request->name));
    return status;
}

/* ---- programs -------------------------------------------------------------------------------- */

/* Starts `weartrack run CASE`, or `report RESULT` if there is a result without its case. */
static wt_status start_run(wt_view *view, wt_error *err)
{
    wt_case *c = NULL;
    wt_error failure = WT_ERROR_INIT;
    const wt_status status = wt_case_read(view->case_path, &c, &failure);
    if (status == WT_OK)
        wt_case_free(c);
    const char *const run[] = {"run",      view->case_name,  "-o", view->result_name,
                               "--report", view->report_name};
    const char *const report[] = {"report", view->result_name, "-o", view->report_name};
    if (status == WT_OK)
        return view_program_start(view->program, view->folder.path, run, COUNT_OF(run), err);
    if (view->result != NULL)
        return view_program_start(view->program, view->folder.path, report, COUNT_OF(report), err);
    *err = failure;
    return status;
}

static wt_status start_new_case(wt_view *view, wt_error *err)
{
    enum { FIRST_FILE = 3 };
    text_buffer text = {0};
    bool exists = false;
    wt_status status =
        case_folder_read(&view->folder, view->case_name, VIEW_BODY_LIMIT, &exists, &text, err);
    text_free(&text);
    if (status == WT_OK && exists) {
        status = wt_fail(err, WT_E_ARG, "there is a case already");
        wt_error_file(err, view->case_name);
    }
    if (status != WT_OK)
        return status;
    const size_t n = view->by_files ? view->n_given : 1;
    const char **arguments = wt_alloc(FIRST_FILE + n, sizeof *arguments);
    arguments[0] = "new-case";
    arguments[1] = "-o";
    arguments[2] = view->case_name;
    arguments[FIRST_FILE] = ".";
    for (size_t i = 0; view->by_files && i < n; i++)
        arguments[FIRST_FILE + i] = view->given[i];
    status = view_program_start(view->program, view->folder.path, arguments, FIRST_FILE + n, err);
    free(arguments);
    return status;
}

static void append_progress(const wt_view *view, text_buffer *to)
{
    const view_program_state state = view_program_get(view->program);
    text_format(to, "{\"running\":%s,\"ended\":%zu,\"time\":%.2f,\"succeeded\":%s,\"words\":",
                state.running ? "true" : "false", state.n_ended, state.time,
                state.end.outcome == PROGRAM_EXITED && (state.end.code == WT_RESULT_COMPLETE ||
                                                        state.end.code == WT_RESULT_PARTIAL)
                    ? "true"
                    : "false");
    text_json(to, state.end.words);
    text_add(to, ",\"arguments\":[");
    for (size_t i = 0; i < state.n_arguments; i++) {
        text_add(to, i > 0 ? "," : "");
        text_json(to, state.arguments[i]);
    }
    text_add(to, "]}");
}

/* ---- pages ----------------------------------------------------------------------------------- */

static void keep_page(wt_view *view, const view_request *request)
{
    size_t k = 0;
    while (k < view->n_pages && strcmp(view->pages[k].name, request->page) != 0)
        k++;
    if (k == VIEW_PAGES)
        return;
    view->n_pages += k == view->n_pages;
    memcpy(view->pages[k].name, request->page, sizeof view->pages[k].name);
    view->pages[k].last = wt_time_wall();
}

static void close_page(wt_view *view, const view_request *request)
{
    enum { RELOAD_TIME = 5 }; /* s; a page that is loaded again is closed first */
    for (size_t k = 0; k < view->n_pages; k++)
        if (strcmp(view->pages[k].name, request->page) == 0) {
            view->pages[k] = view->pages[--view->n_pages];
            view->close_time = wt_time_wall() + RELOAD_TIME;
            return;
        }
}

void view_answer(void *user, const view_request *request, const char *body, size_t length,
                 view_reply *reply)
{
    wt_view *view = user;
    wt_error err = WT_ERROR_INIT;
    wt_status status = WT_OK;
    switch (request->action) {
    case VIEW_FILE:
        answer_file(request, reply);
        return;
    case VIEW_CASE:
        answer_save_case(view, request, body, length, reply);
        return;
    case VIEW_OVERRIDES:
        answer_save_overrides(view, request, body, length, reply);
        return;
    case VIEW_STATE:
        status = view_append_state(view, &reply->text, &err);
        break;
    case VIEW_INFO:
        status = answer_info(view, request, &reply->text, &err);
        break;
    case VIEW_TABLE:
        status = answer_table(view, request, &reply->text, &err);
        break;
    case VIEW_REPORT:
        status = answer_report(view, reply, &err);
        break;
    case VIEW_CHECK:
        status = answer_check(view, body, length, &err);
        break;
    case VIEW_TRIAL:
        status = answer_trial(view, request, body, length, &reply->text, &err);
        break;
    case VIEW_CURVE:
        status = answer_curve(view, request, body, length, &reply->text, &err);
        break;
    case VIEW_ADD:
        status = answer_add(view, request, body, length, &err);
        break;
    case VIEW_NEW_CASE:
        status = start_new_case(view, &err);
        break;
    case VIEW_RUN:
        case_refit_forget(view->refit); /* data files may have changed */
        status = start_run(view, &err);
        break;
    case VIEW_STOP:
        view_program_stop(view->program);
        break;
    case VIEW_PROGRESS:
        append_progress(view, &reply->text);
        break;
    case VIEW_ALIVE:
        keep_page(view, request);
        break;
    case VIEW_LEAVE:
        close_page(view, request);
        break;
    case VIEW_ACTIONS:
        break;
    }
    finish_reply(reply, status, &err);
}
