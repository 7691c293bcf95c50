/* Answers the requests of the page: each is a call of the library, or runs weartrack.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/base/memory.h"
#include "view/view_embedded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NOT_FOUND = 404, CONFLICT = 409, MAX_PAGE = 64 << 20 };

static wt_status answer_file(view_call *call, wt_error *err)
{
    const char *name = wt_path_base(call->target), *ending = strrchr(name, '.');
    if (name[0] == '\0')
        name = ending = "view.html";
    for (const embedded_text *f = view_embedded; f->name != NULL; f++)
        if (strcmp(f->name, name) == 0) {
            text_bytes(&call->reply, f->text, f->length);
            call->media = strcmp(ending, ".js") == 0    ? "text/javascript; charset=utf-8"
                          : strcmp(ending, ".css") == 0 ? "text/css; charset=utf-8"
                                                        : "text/html; charset=utf-8";
            return WT_OK;
        }
    call->status = NOT_FOUND;
    return wt_fail(err, WT_E_NOT_FOUND, "the page has no such file");
}

/* Answers with those tables that exist. They were computed since `start` [s]; 0: long ago. */
static wt_status answer_tables(view_call *call, const wt_table *const *tables, size_t n,
                               double start, wt_error *err)
{
    char *bytes = NULL;
    size_t length = 0;
    const char *before = "{\"tables\":[";
    FILE *stream = text_stream_open(&bytes, &length);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        if (tables[i] == NULL)
            continue;
        (void)fputs(before, stream);
        before = ",";
        status = wt_table_export(stream, tables[i], WT_EXPORT_JSON, false, err);
    }
    text_stream_close(stream);
    text_bytes(&call->reply, bytes, length);
    text_format(&call->reply, "%s],\"time\":%.4f}", before[0] == '{' ? before : "",
                start > 0 ? wt_time_wall() - start : 0.0);
    free(bytes);
    return status;
}

/* Answers with the requested tables of a result, whose names are separated by blanks, and its
 * failures. */
static wt_status answer_named(view_call *call, const wt_result *result, double start, wt_error *err)
{
    enum { MAX_TABLES = 32 };
    const wt_table *tables[MAX_TABLES];
    char *list = format_text("%s failures", call_text(call, "name")), *rest = NULL;
    size_t n = 0;
    for (char *name = strtok_r(list, " ", &rest); name != NULL && n < MAX_TABLES;
         name = strtok_r(NULL, " ", &rest))
        tables[n++] = wt_result_find(result, name);
    free(list);
    return answer_tables(call, tables, n, start, err);
}

/* Content of a file with the remarks of its reader. */
static wt_status answer_info(view_call *call, wt_error *err)
{
    const wt_view *view = call->view;
    const size_t number = call_number(call, "number", SIZE_MAX);
    wt_input *input = NULL;
    wt_table *tables[3] = {NULL}; /* metadata, data quality, notes */
    wt_read_options options = wt_read_defaults();
    if (number >= view->n_files)
        return wt_fail(err, WT_E_NOT_FOUND, "no file has this number");
    wt_log *log = wt_log_new();
    wt_status status = wt_input_open(view->files[number], &input, err);
    if (status == WT_OK)
        status = wt_input_describe(view->formats, input, &options, log, &tables[0], err);
    if (status == WT_OK)
        status = wt_data_quality_table(log, view->folder, &tables[1], err);
    if (status == WT_OK)
        status = wt_notes_table(log, view->folder, &tables[2], err);
    if (status == WT_OK)
        status = answer_tables(call, (const wt_table *const *)tables, COUNT_OF(tables), 0, err);
    wt_input_close(input);
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        wt_table_free(tables[i]);
    wt_log_free(log);
    return status;
}

static wt_status answer_table(view_call *call, wt_error *err)
{
    const wt_status status = view_read_result(call->view, err);
    if (status == WT_OK && call->view->result == NULL)
        return wt_fail(err, WT_E_NOT_FOUND, "there is no result yet; run the case");
    return status == WT_OK ? answer_named(call, call->view->result, 0, err) : status;
}

static wt_status answer_report(view_call *call, wt_error *err)
{
    char *folder = wt_path_join(call->view->folder, call->view->report_name);
    const wt_status status = case_file_read(folder, "index.html", MAX_PAGE, &call->reply, err);
    call->media = "text/html; charset=utf-8";
    free(folder);
    return status;
}

/* ---- previews ----------------------------------------------------------------------------------
 */

static wt_status answer_check(view_call *call, wt_error *err)
{
    wt_case *c = NULL;
    const wt_status status = case_from_bytes(text_string(&call->body), call->body.length,
                                             call->view->case_path, &c, err);
    wt_case_free(c);
    return status;
}

/* Runs the text of a case for the requested tables, as `weartrack run` does. */
static wt_status answer_preview(view_call *call, wt_error *err)
{
    const wt_view *view = call->view;
    wt_result *result = NULL;
    wt_run_options run = wt_run_defaults();
    enum { MAX_REPLICATES = 100000 };
    const double start = wt_time_wall();
    run.threads = view->options.threads;
    run.formats = view->options.formats;
    run.replicates = call_number(call, "replicates", MAX_REPLICATES);
    run.no_provenance = true;
    wt_status status = case_refit_run(view->refit, text_string(&call->body), call->body.length,
                                      view->case_path, call_text(call, "name"), &run, &result, err);
    if (status == WT_OK)
        status = answer_named(call, result, start, err);
    wt_result_free(result);
    return status;
}

/* Copies the rows of a curve from a table of the result; the copy has none if the table is NULL. */
static wt_table *rows_of_curve(const view_call *call, const wt_table *from, const char *name)
{
    const char *group = call_text(call, "group"), *file = call_text(call, "file");
    const long of_group = from != NULL ? wt_table_find(from, "group") : -1,
               of_file = from != NULL ? wt_table_find(from, "file") : -1,
               of_curve = from != NULL ? wt_table_find(from, "curve") : -1;
    const double curve = (double)call_number(call, "number", SIZE_MAX);
    wt_table *to = wt_table_new(name, "");
    wt_status status = WT_OK;
    if (of_file < 0 || of_curve < 0)
        return to;
    for (size_t c = 0; status == WT_OK && c < wt_table_n_columns(from); c++)
        status = wt_table_column_kind(from, c) == WT_COLUMN_TEXT
                     ? wt_table_add_text_column(to, wt_table_column_name(from, c), "", NULL)
                     : wt_table_add_column(to, wt_table_column_name(from, c),
                                           wt_table_column_unit(from, c), "", NULL);
    for (size_t row = 0; row < wt_table_n_rows(from) && status == WT_OK; row++) {
        const double number = wt_table_number(from, row, (size_t)of_curve);
        if (number < curve || number > curve || isnan(number) ||
            strcmp(wt_table_text(from, row, (size_t)of_file), file) != 0 ||
            (of_group >= 0 && strcmp(wt_table_text(from, row, (size_t)of_group), group) != 0))
            continue;
        status = wt_table_add_row(to, NULL);
        for (size_t c = 0; c < wt_table_n_columns(from); c++)
            if (wt_table_column_kind(from, c) == WT_COLUMN_TEXT)
                wt_table_set_text(to, c, wt_table_text(from, row, c));
            else
                wt_table_set_number(to, c, wt_table_number(from, row, c));
    }
    return to;
}

/* Answers with a curve as the result has it, which has no case. */
static wt_status answer_stored_curve(view_call *call, wt_error *err)
{
    char *name = format_text("indentation/%s", call_text(call, "group"));
    const wt_result *result = call->view->result;
    wt_table *tables[] = {rows_of_curve(call, wt_result_find(result, name), name),
                          rows_of_curve(call, wt_result_find(result, "curves"), "curves")};
    wt_status status = WT_OK;
    if (wt_table_n_rows(tables[0]) == 0 || wt_table_n_rows(tables[1]) == 0) {
        status = wt_fail(err, WT_E_EMPTY, "the result has no samples of this curve");
        wt_error_advice(err, "make it by weartrack indent --curves all");
    } else
        status = answer_tables(call, (const wt_table *const *)tables, COUNT_OF(tables), 0, err);
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        wt_table_free(tables[i]);
    free(name);
    return status;
}

/* Fits one curve as the text of a case requests, and with another value of an option. */
static wt_status answer_curve(view_call *call, wt_error *err)
{
    if (call->body.length == 0 && call->view->result != NULL)
        return answer_stored_curve(call, err);
    wt_indent_tables tables = {0};
    const double start = wt_time_wall();
    const refit_curve which = {call_text(call, "group"), call_text(call, "file"),
                               call_number(call, "number", SIZE_MAX), call_text(call, "name"),
                               call_text(call, "value")};
    wt_status status =
        case_refit_curve(call->view->refit, text_string(&call->body), call->body.length,
                         call->view->case_path, &which, NULL, &tables, err);
    const wt_table *const made[] = {tables.indentation, tables.curves};
    if (status == WT_OK)
        status = answer_tables(call, made, COUNT_OF(made), start, err);
    wt_indent_tables_clear(&tables);
    return status;
}

/* ---- writing --------------------------------------------------------------------------------- */

/* Writes a file. The case and its overrides are replaced unless they have changed since the page
 * read them: another page may have done so. Any other file has to be new. */
static wt_status answer_save(view_call *call, wt_error *err)
{
    wt_view *view = call->view;
    const char *name = call_text(call, "name");
    char digest[65] = "";
    text_buffer before = {0};
    const bool is_case = strcmp(name, view->case_name) == 0,
               is_ours = is_case ||
                         (view->overrides_name != NULL && strcmp(name, view->overrides_name) == 0);
    wt_status status = is_case ? answer_check(call, err) : WT_OK;
    if (status == WT_OK && is_ours) {
        status = case_file_read(view->folder, name, VIEW_FILE_LIMIT, &before, err);
        if (status == WT_OK)
            wt_sha256(text_string(&before), before.length, digest);
        status = status == WT_E_NOT_FOUND ? WT_OK : status;
        text_free(&before);
    }
    if (status == WT_OK && strcmp(digest, call_text(call, "was")) != 0) {
        call->status = CONFLICT;
        status = wt_fail(err, WT_E_ARG, "the file has changed since this page read it");
        wt_error_file(err, name);
        wt_error_advice(err, "load the page again");
    }
    if (status == WT_OK)
        status = case_file_write(view->folder, name, digest[0] != '\0', &call->body, err);
    if (status == WT_OK && !is_ours)
        view_give_file(view, wt_path_join(view->folder, name));
    wt_sha256(text_string(&call->body), call->body.length, digest);
    text_format(&call->reply, "{\"digest\":\"%s\"}", digest);
    return status;
}

/* ---- programs -------------------------------------------------------------------------------- */

/* Starts weartrack with copies of n arguments in the folder of the case. */
static wt_status start_program(view_call *call, const char *const *arguments, size_t n,
                               wt_error *err)
{
    view_program *p = &call->view->program;
    if (p->running)
        return wt_fail(err, WT_E_ARG, "another run has not ended yet");
    wt_strings_free(p->arguments, p->n);
    p->arguments = wt_alloc(n + 1, sizeof *p->arguments);
    for (size_t i = 0; i < n; i++)
        p->arguments[i] = wt_strdup(arguments[i]);
    p->arguments[n] = NULL;
    p->n = n;
    p->running = true;
    p->stop = false;
    p->time = wt_time_wall();
    return WT_OK;
}

/* Starts `weartrack run CASE`, or `report RESULT` if there is a result without its case; or draws
 * the figures of the result for a paper, with the requested width [mm]. */
static wt_status start_run(view_call *call, wt_error *err)
{
    const wt_view *v = call->view;
    const size_t millimetres = call_number(call, "number", SIZE_MAX);
    char *width = format_text("%zumm", millimetres),
         *place = format_text("%s-%s", v->report_name, width);
    const char *const run[] = {"run",          v->case_name, "-o",
                               v->result_name, "--report",   v->report_name},
                      *const report[] = {"report", v->result_name, "-o", v->report_name},
                      *const figures[] = {"report",    v->result_name, "-o",      place,
                                          "--figures", "svg,pdf",      "--width", width};
    const bool has_case = access(v->case_path, F_OK) == 0;
    case_refit_forget(v->refit); /* data files may have changed */
    const wt_status status = millimetres > 0 ? start_program(call, figures, COUNT_OF(figures), err)
                             : has_case || v->result == NULL
                                 ? start_program(call, run, COUNT_OF(run), err)
                                 : start_program(call, report, COUNT_OF(report), err);
    free(place);
    free(width);
    return status;
}

static wt_status start_new_case(view_call *call, wt_error *err)
{
    enum { FIRST_FILE = 3 };
    const wt_view *view = call->view;
    if (access(view->case_path, F_OK) == 0) {
        const wt_status status = wt_fail(err, WT_E_ARG, "there is a case already");
        wt_error_file(err, view->case_name);
        return status;
    }
    const size_t n = view->by_files ? view->n_given : 1;
    const char **arguments = wt_alloc(FIRST_FILE + n, sizeof *arguments);
    arguments[0] = "new-case";
    arguments[1] = "-o";
    arguments[2] = view->case_name;
    for (size_t i = 0; i < n; i++)
        arguments[FIRST_FILE + i] = view->by_files ? view->given[i] : ".";
    const wt_status status = start_program(call, arguments, FIRST_FILE + n, err);
    free(arguments);
    return status;
}

static wt_status answer_progress(view_call *call, wt_error *err)
{
    const view_program *p = &call->view->program;
    const bool succeeded = p->end.outcome == PROGRAM_EXITED &&
                           (p->end.code == WT_RESULT_COMPLETE || p->end.code == WT_RESULT_PARTIAL);
    (void)err;
    text_format(&call->reply,
                "{\"running\":%s,\"ended\":%zu,\"time\":%.2f,\"succeeded\":%s,\"words\":",
                p->running ? "true" : "false", p->n_ended,
                p->running ? wt_time_wall() - p->time : p->time, succeeded ? "true" : "false");
    text_json(&call->reply, p->end.words);
    text_add(&call->reply, ",\"arguments\":");
    text_json_list(&call->reply, (const char *const *)p->arguments, p->n);
    text_add(&call->reply, "}");
    return WT_OK;
}

/* Counts the open pages and stops the program. The server ends some seconds after the last page,
 * because one that is loaded again is closed first; or if none reports any more: a hidden page does
 * once a minute. */
static wt_status answer_page(view_call *call, wt_error *err)
{
    static const double reload_time = 5, lost_after = 180; /* s */
    wt_view *view = call->view;
    const char *name = call_text(call, "name");
    (void)err;
    view->n_pages += strcmp(name, "open") == 0;
    view->n_pages -= strcmp(name, "leave") == 0 && view->n_pages > 0;
    view->program.stop = view->program.stop || strcmp(name, "stop") == 0;
    view->end_time = wt_time_wall() + (view->n_pages > 0 ? lost_after : reload_time);
    return WT_OK;
}

const view_route view_routes[] = {{"", 0, answer_file},
                                  {"state", 0, view_answer_state},
                                  {"info", 0, answer_info},
                                  {"table", 0, answer_table},
                                  {"report", 0, answer_report},
                                  {"progress", 0, answer_progress},
                                  {"check", VIEW_BODY_LIMIT, answer_check},
                                  {"preview", VIEW_BODY_LIMIT, answer_preview},
                                  {"curve", VIEW_BODY_LIMIT, answer_curve},
                                  {"save", VIEW_FILE_LIMIT, answer_save},
                                  {"new-case", VIEW_BODY_LIMIT, start_new_case},
                                  {"run", VIEW_BODY_LIMIT, start_run},
                                  {"page", VIEW_BODY_LIMIT, answer_page},
                                  {NULL, 0, NULL}};
