/* Writing a report: figures, then gnuplot, then the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/report.h"

#include "base/param.h"
#include "report/files.h"
#include "report/folder.h"
#include "report/gnuplot.h"
#include "report/page.h"

#include <pthread.h>
#include <stdlib.h>

wt_report_options wt_report_defaults(void)
{
    return (wt_report_options){
        .style = "paper", .gnuplot = "gnuplot", .with_provenance = true, .gnuplot_time = 120};
}

static const wt_param rows[] = {
    {PARAM_TEXT_OF("style", wt_report_options, style), .value = "STYLE",
     .help = "plot style: paper, screen or a file of yours, a script that gnuplot runs"},
    {PARAM_TEXT_OF("gnuplot", wt_report_options, gnuplot), .value = "PROGRAM",
     .flags = PARAM_NO_CASE, .help = "the gnuplot to use"},
    {PARAM("gnuplot-time", wt_report_options, gnuplot_time, WT_Q_TIME, ABOVE(0)), .value = "TIME",
     .flags = PARAM_NO_CASE, .help = "the longest that one figure may take to draw"},
    PARAM_THREADS(wt_report_options),
};
PARAM_TABLE(wt_report_params, wt_report_options, rows, wt_report_defaults, NO_PARTS)

/* ---- figures --------------------------------------------------------------------------------- */

/* One report while it is written. */
typedef struct report {
    bound_tables tables;
    gnuplot_call gnuplot; /* but for the script */
    growing_text style;
    bool has_style; /* in the folder */
    report_folder *folder;
    drawn_figure *figures; /* one for each that this library knows */
    wt_error *errors;      /* of each */
    const wt_progress *progress;
    pthread_mutex_t lock; /* for what follows, and so that progress is told by one at a time */
    size_t step;          /* the last figure that was begun */
    bool failed;
} report;

/* Tells that the figure of this step is next, or the page, the last one; false to stop. */
static bool tell_progress(report *r, size_t step)
{
    (void)pthread_mutex_lock(&r->lock);
    r->step = step > r->step ? step : r->step;
    const char *what = r->step < wt_figure_count() ? figure_find(r->step)->name : "page";
    const bool more = !r->failed && (r->progress == NULL || r->progress->report == NULL ||
                                     r->progress->report(r->progress->user, what, r->step,
                                                         wt_figure_count() + 1));
    (void)pthread_mutex_unlock(&r->lock);
    return more;
}

static bool go_on(void *user)
{
    return tell_progress(user, 0);
}

static wt_status write_data(const report_folder *folder, drawn_figure *figure, wt_error *err)
{
    const figure_drawing *const d = &figure->drawing;
    wt_status status = WT_OK;
    char name[128], *bytes = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&bytes, &length);
    if (stream == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < d->n_sections && status == WT_OK; i++) {
        if (i > 0) // gnuplot's `index` counts what two blank lines part
            (void)fputs("\n\n", stream);
        status = wt_stream_write(stream, d->sections[i], NULL, err);
    }
    if (fclose(stream) != 0 && status == WT_OK)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    (void)snprintf(name, sizeof name, "plots/%s.tsv", d->figure->name);
    if (status == WT_OK)
        status = folder_write(folder, name, bytes, length, err);
    if (status == WT_OK)
        text_bytes(&figure->data, bytes, length);
    free(bytes);
    return status;
}

static wt_status write_script(const report_folder *folder, drawn_figure *drawn, wt_error *err)
{
    const figure_drawing *const d = &drawn->drawing;
    const char *const figure = d->figure->name;
    growing_text *const script = &drawn->script;
    char name[128];
    text_format(script, "# %s. To draw it again: gnuplot %s.gp\n", d->figure->title, figure);
    text_format(script,
                "# Data: %s.tsv, in SI units; x_unit and so on turn them into those of "
                "the axes.\n",
                figure);
    text_comment(script, text_string(&d->caption));
    text_format(script,
                "reset\nfigure_width = %s; figure_height = %s\nload 'style.gp'\n"
                "set datafile separator \"\\t\"\nset output '%s.svg'\n",
                LITERAL(d->width), LITERAL(d->height), figure);
    text_add(script, text_string(&d->script));
    text_add(script, "set output\n");
    (void)snprintf(name, sizeof name, "plots/%s.gp", figure);
    return script->failed || drawn->data.failed
               ? wt_fail(err, WT_E_MEMORY, "out of memory")
               : folder_write(folder, name, text_string(script), script->length, err);
}

/* What the picture of a figure is made of; nothing if there is nothing to draw. */
static wt_status write_figure(report *r, size_t i, wt_error *err)
{
    figure_drawing *d = &r->figures[i].drawing;
    if (bound_find(&r->tables, figure_find(i)->table)->n_rows == 0)
        return WT_OK;
    wt_status status = drawing_make(d, figure_find(i), &r->tables, err);
    if (status != WT_OK)
        return status;
    if (d->script.failed || d->caption.failed)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (d->script.length == 0)
        return WT_OK;
    if ((status = write_data(r->folder, &r->figures[i], err)) != WT_OK ||
        (status = write_script(r->folder, &r->figures[i], err)) != WT_OK || r->has_style)
        return status;
    r->has_style = true;
    return folder_write(r->folder, "plots/style.gp", text_string(&r->style), r->style.length, err);
}

/* The picture of one figure, from its script. */
static wt_status draw_picture(const report *r, drawn_figure *figure, wt_error *err)
{
    const char *const name = figure->drawing.figure->name;
    char script[96], picture[96];
    (void)snprintf(script, sizeof script, "%s.gp", name);
    (void)snprintf(picture, sizeof picture, "%s.svg", name);
    gnuplot_call call = r->gnuplot;
    call.script = script;
    const wt_status status = gnuplot_run(&call, err);
    if (status != WT_OK)
        return status;
    char *path = wt_path_join(folder_plots(r->folder), picture);
    if (path == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    const wt_status read = file_read(path, GNUPLOT_PICTURE_LIMIT, &figure->svg, err);
    free(path);
    return read;
}

static wt_status draw_one(void *user, size_t i, unsigned worker)
{
    report *r = user;
    (void)worker;
    if (r->figures[i].drawing.script.length == 0)
        return WT_OK;
    const wt_status status =
        tell_progress(r, i) ? draw_picture(r, &r->figures[i], &r->errors[i])
                            : wt_fail(&r->errors[i], WT_E_CANCELLED, "the report was cancelled");
    if (status != WT_OK) {
        (void)pthread_mutex_lock(&r->lock);
        r->failed = true;
        (void)pthread_mutex_unlock(&r->lock);
    }
    return status;
}

/* Those that are ended because of another one say no more than that. */
static wt_status draw_all(report *r, unsigned threads, wt_error *err)
{
    const size_t n = wt_figure_count();
    const wt_status status = wt_parallel_for(n, threads, draw_one, r, NULL, "figures");
    const wt_error *first = NULL;
    for (size_t i = 0; i < n; i++)
        if (r->errors[i].status != WT_OK && (first == NULL || first->status == WT_E_CANCELLED))
            first = &r->errors[i];
    if (first == NULL)
        return status;
    if (err != NULL)
        *err = *first;
    return first->status;
}

static wt_status make_page(const report *r, const wt_result *result, bool with_provenance,
                           wt_error *err)
{
    page_writer page = {.result = result,
                        .tables = &r->tables,
                        .style = &r->style,
                        .with_provenance = with_provenance,
                        .figures = r->figures,
                        .n_figures = wt_figure_count()};
    wt_status status = page_write(&page, err);
    if (status == WT_OK)
        status = folder_write(r->folder, "index.html", page.out.bytes, page.out.length, err);
    text_free(&page.out);
    return status;
}

wt_status wt_report_check(const char *folder, const wt_report_options *options, wt_error *err)
{
    const wt_report_options chosen = options != NULL ? *options : wt_report_defaults();
    growing_text style = {0};
    report_folder *made = NULL;
    wt_status status = param_check(wt_report_params(), &chosen, err);
    if (status == WT_OK)
        status = file_style(chosen.style, &style, err);
    if (status == WT_OK)
        status = folder_open(folder, &made, err);
    folder_discard(made);
    text_free(&style);
    return status;
}

wt_status wt_report_write(const wt_result *result, const char *folder,
                          const wt_report_options *options, const wt_progress *progress,
                          wt_error *err)
{
    const wt_report_options chosen = options != NULL ? *options : wt_report_defaults();
    size_t n = wt_figure_count();
    report r = {.gnuplot = {.program = chosen.gnuplot,
                            .limit = chosen.gnuplot_time,
                            .go_on = go_on,
                            .user = &r},
                .progress = progress,
                .lock = PTHREAD_MUTEX_INITIALIZER,
                .figures = calloc(n, sizeof *r.figures),
                .errors = calloc(n, sizeof *r.errors)};
    wt_status status = param_check(wt_report_params(), &chosen, err);
    if (status == WT_OK && (r.figures == NULL || r.errors == NULL))
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK)
        status = bound_make(result, &r.tables, err);
    if (status == WT_OK)
        status = file_style(chosen.style, &r.style, err);
    if (status == WT_OK)
        status = folder_open(folder, &r.folder, err);
    if (status == WT_OK)
        r.gnuplot.folder = folder_plots(r.folder);
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = write_figure(&r, i, err);
    if (status == WT_OK)
        status = draw_all(&r, chosen.threads, err);
    if (status == WT_OK && !tell_progress(&r, n))
        status = wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
    if (status == WT_OK)
        status = make_page(&r, result, chosen.with_provenance, err);
    if (status == WT_OK) {
        status = folder_commit(r.folder, err);
        r.folder = NULL;
        if (status == WT_OK)
            (void)tell_progress(&r, n + 1); // it is there: too late to cancel
    }
    folder_discard(r.folder);
    for (size_t i = 0; r.figures != NULL && i < n; i++) {
        drawing_clear(&r.figures[i].drawing);
        text_free(&r.figures[i].data);
        text_free(&r.figures[i].script);
        text_free(&r.figures[i].svg);
    }
    free(r.figures);
    free(r.errors);
    (void)pthread_mutex_destroy(&r.lock);
    text_free(&r.style);
    bound_clear(&r.tables);
    return status;
}
