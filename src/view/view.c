/* Opens the files of a call, and serves the page until its end.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "job/inputs.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>

enum { MAX_PORT = 65535 };

wt_view_options wt_view_defaults(void)
{
    return (wt_view_options){.program = "weartrack"};
}

static const wt_param rows[] = {
    {PARAM("port", wt_view_options, port, WT_Q_NONE, FROM_TO(0, MAX_PORT)), .value = "N",
     .flags = PARAM_NO_CASE, .unset = "a free one", .help = "port of the page, on 127.0.0.1"},
    PARAM_THREADS(wt_view_options)};
PARAM_TABLE(wt_view_params, wt_view_options, rows, wt_view_defaults, NO_PARTS)

/* ---- files of the call ----------------------------------------------------------------------- */

static bool ends_with(const char *text, const char *ending)
{
    const size_t n = strlen(text), m = strlen(ending);
    return n > m && strcmp(text + n - m, ending) == 0;
}

/* Returns the name of the case with another ending. */
static char *name_beside_case(const char *name, const char *ending)
{
    const size_t stem = strlen(name) - (ends_with(name, ".xml") ? strlen(".xml") : 0);
    char *made = wt_alloc(stem + strlen(ending) + 1, 1);
    memcpy(made, name, stem);
    memcpy(made + stem, ending, strlen(ending) + 1);
    return made;
}

static void set_names(wt_view *view, const char *case_name)
{
    view->case_name = wt_strdup(case_name);
    view->case_path = wt_path_join(view->folder.path, case_name);
    view->report_name = name_beside_case(case_name, "-report");
    if (view->result_name == NULL)
        view->result_name = name_beside_case(case_name, ".h5");
}

/* Returns the name of the case file of a result; NULL if the result is not that of a case. */
static const char *case_of_result(const wt_result *result)
{
    const wt_provenance *p = wt_result_provenance_const(result);
    for (size_t i = 0; i < wt_provenance_n_inputs(p); i++)
        if (strcmp(wt_provenance_get_input(p, i)->role, "case") == 0)
            return wt_path_base(wt_provenance_get_input(p, i)->path);
    return NULL;
}

static wt_status open_folder_of(wt_view *view, const char *path, wt_error *err)
{
    char *folder = wt_path_folder(path);
    const wt_status status = case_folder_open(folder, &view->folder, err);
    free(folder);
    return status;
}

static wt_status check_name(const char *name, wt_error *err)
{
    if (case_folder_is_name(name))
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_ARG, "the name of the file cannot be used here");
    wt_error_file(err, name);
    wt_error_expected(err, "a name that does not begin with . or -");
    return status;
}

/* Adds a data file by its absolute path, because the programs run in the folder of the case. */
static wt_status add_data_file(wt_view *view, const char *path, wt_error *err)
{
    char *absolute = realpath(path, NULL);
    if (absolute == NULL) {
        const wt_status status = wt_fail(err, WT_E_IO, "%s", strerror(errno));
        wt_error_file(err, path);
        return status;
    }
    view->by_files = true;
    view_give_file(view, absolute);
    return WT_OK;
}

/* Opens one file: a case by its ending, a result by its content, else data. */
static wt_status open_file(wt_view *view, const char *path, wt_error *err)
{
    const char *name = wt_path_base(path);
    wt_result *result = NULL;
    wt_status status = open_folder_of(view, path, err);
    if (status == WT_OK && ends_with(name, ".xml")) {
        status = check_name(name, err);
        if (status == WT_OK)
            set_names(view, name);
        return status;
    }
    if (status == WT_OK && wt_store_read(path, &result, NULL) == WT_OK) {
        const char *of = case_of_result(result);
        status = check_name(name, err);
        view->result_name = wt_strdup(name);
        set_names(view, of != NULL && case_folder_is_name(of) ? of : "case.xml");
        wt_result_free(result);
        return status;
    }
    if (status == WT_OK)
        set_names(view, "case.xml");
    return status == WT_OK ? add_data_file(view, path, err) : status;
}

static wt_status open_paths(wt_view *view, wt_error *err)
{
    struct stat state;
    const wt_view_options *o = &view->options;
    const char *first = o->n_paths > 0 ? o->paths[0] : ".";
    if (o->n_paths <= 1 && stat(first, &state) == 0 && S_ISDIR(state.st_mode)) {
        const wt_status status = case_folder_open(first, &view->folder, err);
        if (status == WT_OK)
            set_names(view, "case.xml");
        return status;
    }
    if (o->n_paths == 1)
        return open_file(view, first, err);
    wt_status status = open_folder_of(view, first, err);
    if (status == WT_OK)
        set_names(view, "case.xml");
    for (size_t i = 0; status == WT_OK && i < o->n_paths; i++)
        status = add_data_file(view, o->paths[i], err);
    return status;
}

/* ---- pages ----------------------------------------------------------------------------------- */

static unsigned admit(void *user, const view_head *head, view_request *request)
{
    const wt_view *view = user;
    return view_request_parse(head, view->token, http_port(view->server), request);
}

/* Removes pages that have not reported for a while: a hidden page reports once a minute. Returns
 * true if the server ends. */
static bool is_last_page_closed(wt_view *view)
{
    enum { LOST_AFTER = 180 }; /* s */
    const double now = wt_time_wall();
    for (size_t i = 0; i < view->n_pages;)
        if (now - view->pages[i].last > LOST_AFTER) {
            view->pages[i] = view->pages[--view->n_pages];
            view->close_time = now;
        } else {
            i++;
        }
    return view->n_pages == 0 && view->close_time > 0 && now > view->close_time;
}

wt_status wt_view_serve(wt_view *view, const wt_progress *progress, wt_error *err)
{
    enum { STEP = 100 }; /* ms */
    wt_status status = WT_OK;
    while (status == WT_OK && !is_last_page_closed(view) &&
           (progress == NULL || progress->report == NULL ||
            progress->report(progress->user, "serving", 0, 0)))
        status = http_wait(view->server, STEP, err);
    return status;
}

/* ---- the server ------------------------------------------------------------------------------ */

static wt_status create_token(char token[VIEW_TOKEN_LENGTH + 1], wt_error *err)
{
    unsigned char bytes[VIEW_TOKEN_LENGTH / 2];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return wt_fail(err, WT_E_IO, "no random number: %s", strerror(errno));
    for (size_t i = 0; i < sizeof bytes; i++)
        (void)snprintf(token + 2 * i, 3, "%02x", bytes[i]);
    return WT_OK;
}

wt_status wt_view_open(const wt_view_options *options, wt_view **view, wt_error *err)
{
    if (options == NULL || view == NULL)
        return wt_fail(err, WT_E_ARG, "no options");
    wt_status status = param_check(wt_view_params(), options, err);
    if (status != WT_OK)
        return status;
    wt_view *v = wt_alloc(1, sizeof *v);
    *v = (wt_view){.options = *options, .folder = {.descriptor = -1}};
    status = open_paths(v, err);
    if (status == WT_OK)
        status = wt_formats_new(options->formats, &v->formats, NULL, err);
    if (status == WT_OK)
        status = create_token(v->token, err);
    if (status == WT_OK)
        status = http_open(options->port, admit, view_answer, v, &v->server, err);
    if (status != WT_OK) {
        wt_view_close(v);
        return status;
    }
    v->program = view_program_new(options->program);
    v->refit = case_refit_new(v->formats);
    (void)snprintf(v->address, sizeof v->address, "http://127.0.0.1:%u/%s/", http_port(v->server),
                   v->token);
    *view = v;
    return WT_OK;
}

const char *wt_view_address(const wt_view *view)
{
    return view->address;
}

bool wt_view_show(const wt_view *view)
{
    return program_detach("xdg-open", view->address);
}

void wt_view_close(wt_view *view)
{
    if (view == NULL)
        return;
    http_close(view->server);
    view_program_free(view->program);
    case_refit_free(view->refit);
    wt_formats_free(view->formats);
    wt_result_free(view->result);
    wt_strings_free(view->given, view->n_given);
    wt_strings_free(view->files, view->n_files);
    case_folder_close(&view->folder);
    free(view->case_name);
    free(view->case_path);
    free(view->result_name);
    free(view->report_name);
    free(view);
}
