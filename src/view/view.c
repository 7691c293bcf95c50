/* Opens the files of a call, and serves the page until its end.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include "core/base/memory.h"
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

static bool is_case_name(const char *name)
{
    const size_t n = strlen(name);
    return n > strlen(".xml") && strcmp(name + n - strlen(".xml"), ".xml") == 0;
}

/* Returns the name of the case file of a result; NULL if the result is not that of a case. */
static const char *case_of_result(const wt_result *result)
{
    const wt_provenance *p = wt_result_provenance_const(result);
    for (size_t i = 0; i < wt_provenance_n_inputs(p); i++)
        if (wt_provenance_get_input(p, i)->role == WT_ROLE_CASE)
            return wt_path_base(wt_provenance_get_input(p, i)->path);
    return NULL;
}

/* Returns the absolute path, because programs run in the folder of the case and the page shows it.
 */
static char *absolute_path(const char *path, wt_error *err)
{
    char *absolute = realpath(path, NULL);
    if (absolute == NULL) {
        (void)wt_fail(err, WT_E_IO, "%s", strerror(errno));
        wt_error_file(err, path);
    }
    return absolute;
}

static wt_status set_names(wt_view *view, const char *case_name, const char *result_name,
                           wt_error *err)
{
    const int stem = (int)strlen(case_name) - (is_case_name(case_name) ? (int)strlen(".xml") : 0);
    view->case_name = wt_strdup(case_name);
    view->case_path = wt_path_join(view->folder, case_name);
    view->report_name = format_text("%.*s-report", stem, case_name);
    view->result_name =
        result_name != NULL ? wt_strdup(result_name) : format_text("%.*s.h5", stem, case_name);
    if (is_plain_name(view->case_name) && is_plain_name(view->result_name))
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_ARG, "the name of the file cannot be used here");
    wt_error_file(err, result_name != NULL ? result_name : case_name);
    wt_error_expected(err, "a name that does not begin with . or -");
    return status;
}

/* Opens a folder, a case by its ending, a result by its content, or data files. */
static wt_status open_paths(wt_view *view, wt_error *err)
{
    const wt_view_options *o = &view->options;
    struct stat state;
    wt_result *result = NULL;
    const char *first = o->n_paths > 0 ? o->paths[0] : ".", *name = wt_path_base(first);
    const bool is_one = o->n_paths <= 1,
               is_folder = is_one && stat(first, &state) == 0 && S_ISDIR(state.st_mode),
               is_case = is_one && !is_folder && is_case_name(name),
               is_result =
                   is_one && !is_folder && !is_case && wt_store_read(first, &result, NULL) == WT_OK;
    char *folder = is_folder ? wt_strdup(first) : wt_path_folder(first);
    const char *of = is_result ? case_of_result(result) : is_case ? name : NULL;
    view->folder = absolute_path(folder, err);
    free(folder);
    wt_status status = view->folder == NULL ? WT_E_IO
                                            : set_names(view, of != NULL ? of : "case.xml",
                                                        is_result ? name : NULL, err);
    wt_result_free(result);
    view->by_files = !is_folder && !is_case && !is_result;
    for (size_t i = 0; status == WT_OK && view->by_files && i < o->n_paths; i++) {
        char *path = absolute_path(o->paths[i], err);
        status = path != NULL ? WT_OK : WT_E_IO;
        if (path != NULL)
            view_give_file(view, path);
    }
    return status;
}

/* ---- serving --------------------------------------------------------------------------------- */

/* Answers requests for about the time [ms]. False at the end: by the user or without a page. */
static bool serve_step(wt_view *view, unsigned milliseconds, wt_status *status, wt_error *err)
{
    const wt_progress *p = view->progress;
    if (p != NULL && p->report != NULL && !p->report(p->user, "serving", 0, 0))
        return false;
    *status = http_wait(view, milliseconds, err);
    return *status == WT_OK && !(view->end_time > 0 && wt_time_wall() > view->end_time);
}

/* Called while the program runs; false ends it. */
static bool go_on(void *user)
{
    enum { STEP = 20 };                /* ms */
    static const double between = 0.1; /* time between two looks at the program [s] */
    wt_view *view = user;
    wt_status status = WT_OK;
    const double next = wt_time_wall() + between;
    while (!view->program.stop && wt_time_wall() < next)
        if (!serve_step(view, STEP, &status, NULL))
            return false;
    return !view->program.stop;
}

static void run_program(wt_view *view)
{
    enum { DAY = 86400 };
    view_program *p = &view->program;
    wt_error err = WT_ERROR_INIT;
    program_result end;
    const program_call call = {.program = view->options.program,
                               .arguments = (const char *const *)p->arguments,
                               .folder = view->folder,
                               .limit = DAY,
                               .go_on = go_on,
                               .user = view};
    if (program_run(&call, &end, &err) != WT_OK) {
        end = (program_result){.outcome = PROGRAM_NOT_STARTED};
        (void)snprintf(end.words, sizeof end.words, "%.300s", err.message);
    }
    p->end = end;
    p->time = wt_time_wall() - p->time;
    p->n_ended++;
    p->running = false;
}

wt_status wt_view_serve(wt_view *view, const wt_progress *progress, wt_error *err)
{
    enum { STEP = 100 }; /* ms */
    wt_status status = WT_OK;
    view->progress = progress;
    while (serve_step(view, STEP, &status, err))
        if (view->program.running)
            run_program(view);
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
    *v = (wt_view){.options = *options, .routes = view_routes};
    status = open_paths(v, err);
    if (status == WT_OK)
        status = wt_formats_new(options->formats, &v->formats, NULL, err);
    if (status == WT_OK)
        status = create_token(v->token, err);
    if (status == WT_OK)
        status = http_open(v, err);
    if (status != WT_OK) {
        wt_view_close(v);
        return status;
    }
    v->refit = case_refit_new(v->formats);
    (void)snprintf(v->address, sizeof v->address, "http://127.0.0.1:%u/%s/", v->port, v->token);
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
    http_close(view);
    case_refit_free(view->refit);
    wt_formats_free(view->formats);
    wt_result_free(view->result);
    wt_strings_free(view->given, view->n_given);
    wt_strings_free(view->files, view->n_files);
    wt_strings_free(view->program.arguments, view->program.n);
    free(view->folder);
    free(view->case_name);
    free(view->case_path);
    free(view->result_name);
    free(view->report_name);
    free(view->overrides_name);
    free(view);
}
