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

/* A request with its body, which ends with a zero, and what its answer fills. The status of a
 * failed answer is 422 unless it sets another. */
typedef struct view_call {
    const view_request *request;
    const char *body;
    size_t length;
    view_reply *reply;
    text_buffer *to; /* text of the reply */
} view_call;

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

static wt_status answer_file(wt_view *view, const view_call *call, wt_error *err)
{
    static const char *const media[][2] = {{".html", "text/html; charset=utf-8"},
                                           {".css", "text/css; charset=utf-8"},
                                           {".js", "text/javascript; charset=utf-8"}};
    for (const embedded_text *f = view_embedded; f->name != NULL; f++) {
        const char *ending = strrchr(f->name, '.');
        if (strcmp(f->name, call->request->name) != 0)
            continue;
        call->reply->bytes = f->text;
        call->reply->length = f->length;
        for (size_t i = 0; i < COUNT_OF(media); i++)
            if (strcmp(ending, media[i][0]) == 0)
                call->reply->media = media[i][1];
        return WT_OK;
    }
    (void)view;
    call->reply->status = HTTP_NOT_FOUND;
    return wt_fail(err, WT_E_NOT_FOUND, "the page has no such file");
}

/* Content of a file with the remarks of its reader. */
static wt_status answer_info(wt_view *view, const view_call *call, wt_error *err)
{
    const size_t number = call->request->number;
    wt_input *input = NULL;
    wt_table *metadata = NULL, *quality = NULL, *notes = NULL;
    wt_read_options options = wt_read_defaults();
    if (number >= view->n_files)
        return wt_fail(err, WT_E_NOT_FOUND, "no file has this number");
    wt_log *log = wt_log_new();
    wt_status status = wt_input_open(view->files[number], &input, err);
    if (status == WT_OK)
        status = wt_input_describe(view->formats, input, &options, log, &metadata, err);
    if (status == WT_OK)
        status = wt_data_quality_table(log, view->folder.path, &quality, err);
    if (status == WT_OK)
        status = wt_notes_table(log, view->folder.path, &notes, err);
    if (status == WT_OK) {
        const wt_table *const tables[] = {metadata, quality, notes};
        text_add(call->to, "{");
        status = append_tables("tables", tables, COUNT_OF(tables), call->to, err);
        text_add(call->to, "}");
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

static wt_status answer_table(wt_view *view, const view_call *call, wt_error *err)
{
    wt_status status = view_read_result(view, err);
    if (status == WT_OK && view->result == NULL)
        status = wt_fail(err, WT_E_NOT_FOUND, "there is no result yet; run the case");
    if (status != WT_OK)
        return status;
    text_add(call->to, "{");
    status = append_named(view->result, call->request->name, call->to, err);
    text_add(call->to, "}");
    return status;
}

static wt_status answer_report(wt_view *view, const view_call *call, wt_error *err)
{
    case_folder folder = {.descriptor = -1};
    bool exists = false;
    char *path = wt_path_join(view->folder.path, view->report_name);
    wt_status status = case_folder_open(path, &folder, err);
    if (status == WT_OK)
        status = case_folder_read(&folder, "index.html", MAX_REPORT, &exists, call->to, err);
    if (status == WT_OK && !exists)
        status = wt_fail(err, WT_E_NOT_FOUND, "there is no report yet; run the case");
    if (status == WT_OK)
        call->reply->media = "text/html; charset=utf-8";
    case_folder_close(&folder);
    free(path);
    return status;
}

/* ---- trials ---------------------------------------------------------------------------------- */

static wt_status answer_check(wt_view *view, const view_call *call, wt_error *err)
{
    wt_case *c = NULL;
    const wt_status status = case_from_bytes(call->body, call->length, view->case_path, &c, err);
    wt_case_free(c);
    return status;
}

/* Runs the text of a case for the requested tables, as `weartrack run` does. */
static wt_status answer_trial(wt_view *view, const view_call *call, wt_error *err)
{
    wt_result *result = NULL;
    wt_run_options run = wt_run_defaults();
    const double start = wt_time_wall();
    run.threads = view->options.threads;
    run.formats = view->options.formats;
    run.replicates = call->request->replicates;
    run.no_provenance = true;
    wt_status status = case_refit_run(view->refit, call->body, call->length, view->case_path,
                                      call->request->name, &run, &result, err);
    if (status == WT_OK) {
        text_add(call->to, "{");
        status = append_named(result, call->request->name, call->to, err);
        text_format(call->to, ",\"time\":%.4f}", wt_time_wall() - start);
    }
    wt_result_free(result);
    return status;
}

static wt_status answer_curve(wt_view *view, const view_call *call, wt_error *err)
{
    wt_indent_tables tables = {0};
    const double start = wt_time_wall();
    const view_request *r = call->request;
    const refit_curve which = {r->group, r->file, r->number, r->contact_point};
    wt_status status = case_refit_curve(view->refit, call->body, call->length, view->case_path,
                                        &which, NULL, &tables, err);
    if (status == WT_OK) {
        const wt_table *const made[] = {tables.indentation, tables.curves};
        text_add(call->to, "{");
        status = append_tables("tables", made, COUNT_OF(made), call->to, err);
        text_format(call->to, ",\"time\":%.4f}", wt_time_wall() - start);
    }
    wt_indent_tables_clear(&tables);
    return status;
}

/* ---- writing --------------------------------------------------------------------------------- */

/* Replaces a file unless it has changed since the page read it: another page may have done so. */
static wt_status save_file(const wt_view *view, const char *name, const view_call *call,
                           wt_error *err)
{
    text_buffer before = {0};
    bool exists = false;
    char digest[65] = "";
    wt_status status =
        case_folder_read(&view->folder, name, VIEW_BODY_LIMIT, &exists, &before, err);
    if (exists)
        wt_sha256(text_string(&before), before.length, digest);
    text_free(&before);
    if (status == WT_OK && strcmp(digest, call->request->digest) != 0) {
        call->reply->status = HTTP_CONFLICT;
        status = wt_fail(err, WT_E_ARG, "the file has changed since this page read it");
        wt_error_file(err, name);
        wt_error_advice(err, "load the page again");
    }
    if (status == WT_OK)
        status = case_folder_write(&view->folder, name, call->body, call->length, err);
    if (status == WT_OK) {
        wt_sha256(call->body, call->length, digest);
        text_format(call->to, "{\"digest\":\"%s\"}", digest);
    }
    return status;
}

static wt_status answer_save_case(wt_view *view, const view_call *call, wt_error *err)
{
    const wt_status status = answer_check(view, call, err);
    return status == WT_OK ? save_file(view, view->case_name, call, err) : status;
}

static wt_status answer_save_overrides(wt_view *view, const view_call *call, wt_error *err)
{
    char *name = view_overrides_name(view);
    wt_status status = WT_OK;
    if (name != NULL) {
        status = save_file(view, name, call, err);
    } else {
        status = wt_fail(err, WT_E_ARG, "the overrides of the case are in another folder");
        wt_error_advice(err, "move the file beside the case and correct <overrides>");
    }
    free(name);
    return status;
}

/* Writes a data file that was dropped on the page. It never replaces a file. */
static wt_status answer_add(wt_view *view, const view_call *call, wt_error *err)
{
    const char *const name = call->request->name;
    const wt_status status = case_folder_add(&view->folder, name, call->body, call->length, err);
    if (status == WT_OK)
        view_give_file(view, wt_path_join(view->folder.path, name));
    return status;
}

/* ---- programs -------------------------------------------------------------------------------- */

/* Starts `weartrack run CASE`, or `report RESULT` if there is a result without its case. */
static wt_status start_run(wt_view *view, const view_call *call, wt_error *err)
{
    wt_case *c = NULL;
    const wt_status status = wt_case_read(view->case_path, &c, err);
    wt_case_free(c);
    (void)call;
    case_refit_forget(view->refit); /* data files may have changed */
    const char *const run[] = {"run",      view->case_name,  "-o", view->result_name,
                               "--report", view->report_name};
    const char *const report[] = {"report", view->result_name, "-o", view->report_name};
    if (status == WT_OK)
        return view_program_start(view->program, view->folder.path, run, COUNT_OF(run), err);
    if (view->result != NULL)
        return view_program_start(view->program, view->folder.path, report, COUNT_OF(report), err);
    return status;
}

static wt_status start_new_case(wt_view *view, const view_call *call, wt_error *err)
{
    (void)call;
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

static wt_status stop_program(wt_view *view, const view_call *call, wt_error *err)
{
    (void)call;
    (void)err;
    view_program_stop(view->program);
    return WT_OK;
}

static wt_status answer_progress(wt_view *view, const view_call *call, wt_error *err)
{
    const view_program_state state = view_program_get(view->program);
    const bool succeeded =
        state.end.outcome == PROGRAM_EXITED &&
        (state.end.code == WT_RESULT_COMPLETE || state.end.code == WT_RESULT_PARTIAL);
    (void)err;
    text_format(call->to, "{\"running\":%s,\"ended\":%zu,\"time\":%.2f,\"succeeded\":%s,\"words\":",
                state.running ? "true" : "false", state.n_ended, state.time,
                succeeded ? "true" : "false");
    text_json(call->to, state.end.words);
    text_add(call->to, ",\"arguments\":");
    text_json_list(call->to, state.arguments, state.n_arguments);
    text_add(call->to, "}");
    return WT_OK;
}

/* ---- pages ----------------------------------------------------------------------------------- */

/* Index of the page of a request; n_pages: it is not known. */
static size_t find_page(const wt_view *view, const view_call *call)
{
    size_t k = 0;
    while (k < view->n_pages && strcmp(view->pages[k].name, call->request->page) != 0)
        k++;
    return k;
}

static wt_status keep_page(wt_view *view, const view_call *call, wt_error *err)
{
    const size_t k = find_page(view, call);
    (void)err;
    if (k < VIEW_PAGES) {
        view->n_pages += k == view->n_pages;
        memcpy(view->pages[k].name, call->request->page, sizeof view->pages[k].name);
        view->pages[k].last = wt_time_wall();
    }
    return WT_OK;
}

static wt_status close_page(wt_view *view, const view_call *call, wt_error *err)
{
    enum { RELOAD_TIME = 5 }; /* s; a page that is loaded again is closed first */
    const size_t k = find_page(view, call);
    (void)err;
    if (k < view->n_pages) {
        view->pages[k] = view->pages[--view->n_pages];
        view->close_time = wt_time_wall() + RELOAD_TIME;
    }
    return WT_OK;
}

static wt_status answer_state(wt_view *view, const view_call *call, wt_error *err)
{
    return view_append_state(view, call->to, err);
}

void view_answer(void *user, const view_request *request, const char *body, size_t length,
                 view_reply *reply)
{
    static wt_status (*const answers[VIEW_ACTIONS])(wt_view *, const view_call *, wt_error *) = {
        [VIEW_FILE] = answer_file,        [VIEW_STATE] = answer_state,
        [VIEW_INFO] = answer_info,        [VIEW_TABLE] = answer_table,
        [VIEW_REPORT] = answer_report,    [VIEW_PROGRESS] = answer_progress,
        [VIEW_CHECK] = answer_check,      [VIEW_TRIAL] = answer_trial,
        [VIEW_CURVE] = answer_curve,      [VIEW_CASE] = answer_save_case,
        [VIEW_ADD] = answer_add,          [VIEW_OVERRIDES] = answer_save_overrides,
        [VIEW_NEW_CASE] = start_new_case, [VIEW_RUN] = start_run,
        [VIEW_STOP] = stop_program,       [VIEW_ALIVE] = keep_page,
        [VIEW_LEAVE] = close_page};
    wt_error err = WT_ERROR_INIT;
    char message[2048];
    const view_call call = {request, body, length, reply, &reply->text};
    if (answers[request->action](user, &call, &err) != WT_OK) {
        wt_error_format(&err, message, sizeof message);
        text_free(&reply->text);
        reply->status = reply->status == HTTP_OK ? HTTP_UNPROCESSABLE : reply->status;
        text_add(&reply->text, "{\"error\":");
        text_json(&reply->text, message);
        text_add(&reply->text, "}");
    } else if (reply->text.length == 0) {
        text_add(&reply->text, "{}");
    }
}
