/* Writes a report: figures, page, and the run of gnuplot with its errors and fonts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/gnuplot.h"

#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/system/subprocess.h"
#include "report/figure_files.h"
#include "report/page.h"
#include "report/report_files.h"
#include "weartrack/report.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* ---- gnuplot --------------------------------------------------------------------------------- */

/* Largest size of all that gnuplot writes [byte]. */
static size_t folder_size(const gnuplot_call *call)
{
    const size_t pictures = (size_t)1 << 30;
    return call->size > pictures ? call->size : pictures;
}

static wt_status fail_start(const char *program, int code, wt_error *err)
{
    wt_status status = wt_fail(err, WT_E_TOOL, "gnuplot cannot be started");
    wt_error_file(err, program);
    wt_error_found(err, "%s", strerror(code));
    wt_error_advice(err, code == EMFILE || code == ENFILE
                             ? MORE_FILES_ADVICE
                             : "install gnuplot (apt-get install gnuplot-nox) or name the program "
                               "with --gnuplot");
    return status;
}

/* Reports a failed run. gnuplot repeats a command before the message, so the last line is shown. */
static wt_status fail_run(const gnuplot_call *call, const program_result *end, wt_error *err)
{
    wt_status status = WT_E_TOOL;
    if (end->outcome == PROGRAM_SIGNALLED)
        wt_fail(err, status, "gnuplot was ended by signal %d", end->code);
    else if (*call->timed_out)
        wt_fail(err, status, "gnuplot did not end within %g s", call->limit);
    else if (end->outcome == PROGRAM_TOO_LARGE)
        wt_fail(err, status, "gnuplot wrote more than %zu MiB", folder_size(call) >> 20);
    else
        wt_fail(err, status, "gnuplot failed with exit status %d", end->code);
    wt_error_file(err, call->program);
    wt_error_found(err, "%s", end->words[0] != '\0' ? end->words : "no message");
    wt_error_advice(err, *call->timed_out
                             ? "check the plot style; `weartrack report --gnuplot-time` allows more"
                             : "check the plot style; gnuplot 5.4 or later is needed");
    return status;
}

wt_status gnuplot_run(const gnuplot_call *call, wt_error *err)
{
    // Environment variables that change gnuplot.
    static const char *const hidden[] = {"GNU", "COLUMNS=", "LD_PRELOAD=", NULL};
    const program_call run = {.program = call->program,
                              .arguments = call->arguments,
                              .folder = call->folder,
                              .hidden = hidden,
                              .limit = (double)INFINITY, // go_on enforces the limit
                              .foreign = true,
                              .file_size = call->size,
                              .folder_size = folder_size(call),
                              .go_on = call->go_on,
                              .user = call->user};
    program_result end;
    const wt_status status = program_run(&run, &end, err);
    if (status != WT_OK)
        return status;
    if (end.outcome == PROGRAM_NOT_STARTED)
        return fail_start(call->program, end.code, err);
    if (end.outcome == PROGRAM_CANCELLED && !*call->timed_out)
        return wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
    return end.outcome == PROGRAM_EXITED && end.code == 0 ? WT_OK : fail_run(call, &end, err);
}

/* ---- fonts ----------------------------------------------------------------------------------- */

/* Time limit of fc-match [s], which may first build its cache of fonts. */
static const double match_time = 10;

/* Escapes a name as a pattern, where a size would follow a hyphen. */
static void escape_font_pattern(const char *font, char pattern[2 * FONT_NAME_LIMIT + 1])
{
    for (; *font != '\0'; *pattern++ = *font++)
        if (*font == '-')
            *pattern++ = '\\';
    *pattern = '\0';
}

/* True if the font is one of the names of a family, "Noto Sans,Noto Sans Light". */
static bool family_contains(const char *names, const char *font)
{
    const size_t length = strlen(font);
    for (const char *name = names; name != NULL; name = strchr(name, ',')) {
        name += *name == ',';
        if (strcspn(name, ",") == length && strncasecmp(name, font, length) == 0)
            return true;
    }
    return false;
}

bool wt_report_font_is_available(const char *font, char *instead, size_t size)
{
    char pattern[2 * FONT_NAME_LIMIT + 1];
    if (font == NULL || strlen(font) > FONT_NAME_LIMIT || size == 0)
        return true;
    escape_font_pattern(font, pattern);
    const char *const arguments[] = {"-f", "%{family}\\n", pattern, NULL};
    const program_call call = {
        .program = "fc-match", .arguments = arguments, .folder = "/", .limit = match_time};
    program_result end;
    if (program_run(&call, &end, NULL) != WT_OK || end.outcome != PROGRAM_EXITED || end.code != 0 ||
        end.words[0] == '\0' || family_contains(end.words, font))
        return true;
    const size_t first = utf8_truncated_length(end.words, strcspn(end.words, ","), size - 1);
    memcpy(instead, end.words, first);
    instead[first] = '\0';
    return false;
}

/* ---- a figure -------------------------------------------------------------------------------- */

wt_report_options wt_report_defaults(void)
{
    return (wt_report_options){.style = "paper",
                               .gnuplot = "gnuplot",
                               .with_provenance = true,
                               .gnuplot_time = 120,
                               .width = (double)NAN};
}

static bool is_requested(const char *requested, size_t i)
{
    return requested == NULL || strcmp(figure_find(i)->name, requested) == 0;
}

static bool is_figure_name(const char *name)
{
    for (size_t i = 0; i < wt_figure_count(); i++)
        if (is_requested(name, i))
            return true;
    return false;
}

static const wt_param rows[] = {
    {PARAM_TEXT_OF("style", wt_report_options, style), .value = "STYLE",
     .help = "plot style: paper, screen or a file of yours, a script that gnuplot runs"},
    {PARAM_OTHER_OF("figures", wt_report_options, figures, figure_formats_read), .value = "FORMATS",
     .unset = "",
     .help = "pictures for a paper in the folder, too, some of svg,pdf,png, parted by commas; "
             "bitmaps have 600 dots in an inch"},
    {PARAM_TEXT_OF("figure", wt_report_options, figure), .value = "NAME", .unset = "all of them",
     .flags = PARAM_NO_CASE,
     .help =
         "only this figure, such as friction, on the page and in the folder; a wrong name lists "
         "all"},
    /* The key needs the lower limit; the upper limit is a poster. */
    {PARAM("width", wt_report_options, width, WT_Q_LENGTH, FROM_TO(0.05, 1)), .value = "LENGTH",
     .unset = "as the style has it",
     .help = SUCH_AS(
         "width of a figure in the paper, ", "85mm",
         ", with type of 8 points (style screen: 12); panels stand side by side from 170 mm")},
    {PARAM_TEXT_OF("font", wt_report_options, font), .value = "NAME",
     .unset = "as the style has it", .check = figure_font_check,
     .help = "font of the figures, such as Arial; one that is not on this computer causes a "
             "warning if fc-match of Fontconfig finds another"},
    {PARAM_TEXT_OF("gnuplot", wt_report_options, gnuplot), .value = "PROGRAM",
     .flags = PARAM_NO_CASE, .help = "the gnuplot to use"},
    {PARAM("gnuplot-time", wt_report_options, gnuplot_time, WT_Q_TIME, ABOVE(0)), .value = "TIME",
     .flags = PARAM_NO_CASE, .help = "the longest that one figure may take to draw"},
};
PARAM_TABLE(wt_report_params, wt_report_options, rows, wt_report_defaults, NO_PARTS)

/* ---- figures --------------------------------------------------------------------------------- */

/* One picture: figure and format. */
typedef struct picture {
    size_t figure;
    const char *format;
} picture;

/* One report in progress. */
typedef struct report {
    wt_report_options options;
    figure_tables tables;
    text_buffer style;
    report_folder *folder;
    drawn_figure *figures; /* one for each figure of the library */
    picture *pictures;     /* in the order of drawing */
    size_t n_pictures, next;
    double begin_time; /* wall time when the last one began [s] */
    bool timed_out;    /* the time limit was exceeded */
    const wt_progress *progress;
} report;

/* Reports the current figure, or the page as the last step; false if cancelled. */
static bool notify_progress(const report *r, size_t step)
{
    const size_t n = wt_figure_count();
    return r->progress == NULL || r->progress->report == NULL ||
           r->progress->report(r->progress->user, step < n ? figure_find(step)->name : "page", step,
                               n + 1);
}

/* True if gnuplot has begun a picture: its file exists then. */
static bool is_picture_begun(const report *r, const picture *p)
{
    char name[96];
    (void)snprintf(name, sizeof name, "%s.%s", figure_find(p->figure)->name, p->format);
    char *path = wt_path_join(folder_plots_path(r->folder), name);
    const bool there = access(path, F_OK) == 0;
    free(path);
    return there;
}

/* Asked all the while that gnuplot draws. */
static bool may_continue_pictures(void *user)
{
    report *r = user;
    for (; r->next < r->n_pictures && is_picture_begun(r, &r->pictures[r->next]); r->next++)
        r->begin_time = wt_time_wall();
    r->timed_out = wt_time_wall() - r->begin_time > r->options.gnuplot_time;
    const size_t drawn = r->next > 0 ? r->next - 1 : 0;
    return !r->timed_out && notify_progress(r, r->pictures[drawn].figure);
}

/* A table may have rows, but not those that the figure shows. */
static wt_status fail_without_data(const figure_description *figure, bool has_rows, wt_error *err)
{
    return has_rows ? wt_fail(err, WT_E_EMPTY,
                              "the table %s of the result has nothing that the figure %s shows",
                              figure->table->name, figure->name)
                    : wt_fail(err, WT_E_EMPTY,
                              "the result has no data for the figure %s, which needs the table %s",
                              figure->name, figure->table->name);
}

/* Writes data and script of a figure; nothing if there is nothing to draw. */
static wt_status write_figure(report *r, size_t i, wt_error *err)
{
    figure_drawing *d = &r->figures[i].drawing;
    if (!is_requested(r->options.figure, i))
        return WT_OK;
    const bool has_rows = figure_tables_find(&r->tables, figure_find(i)->table)->n_rows > 0;
    const bool stacked = r->options.width < figure_text_width;
    const wt_status status =
        has_rows ? drawing_build(d, figure_find(i), &r->tables, stacked, err) : WT_OK;
    if (status == WT_OK && d->script.length > 0)
        return figure_write(r->folder, &r->options, &r->figures[i], err);
    return status != WT_OK || r->options.figure == NULL
               ? status
               : fail_without_data(figure_find(i), has_rows, err);
}

/* Writes the files that all scripts load. */
static wt_status write_style(const report *r, wt_error *err)
{
    const char *const output = embedded_file_text("output.gnuplot");
    const wt_status status =
        folder_write(r->folder, "plots/style.gp", text_string(&r->style), r->style.length, err);
    return status == WT_OK ? folder_write(r->folder, "plots/output.gp", output, strlen(output), err)
                           : status;
}

/* Lists every figure in each format, those of the page first. */
static void list_pictures(report *r)
{
    const unsigned formats = r->options.figures | WT_FIGURE_SVG;
    for (size_t k = 0; figure_format_name(k) != NULL; k++)
        for (size_t i = 0; i < wt_figure_count(); i++)
            if ((formats >> k & 1) != 0 && r->figures[i].script.length > 0)
                r->pictures[r->n_pictures++] = (picture){i, figure_format_name(k)};
}

/* Draws all pictures with one gnuplot, as starting it takes longer than a picture. */
static wt_status draw_pictures(report *r, wt_error *err)
{
    enum { EACH = 2 + 1, NAME = 96 }; // `-e FORMAT` if it changes, and the script
    const char **arguments = wt_alloc(EACH * r->n_pictures + 2, sizeof *arguments);
    char(*names)[NAME] = wt_alloc(2 * r->n_pictures, sizeof *names);
    size_t n = 0, used = 0;
    arguments[n++] = "--default-settings";
    for (size_t i = 0; i < r->n_pictures; i++) {
        const picture *p = &r->pictures[i];
        if (i == 0 || p->format != r->pictures[i - 1].format) {
            (void)snprintf(names[used], NAME, "figure_format = '%s'", p->format);
            arguments[n++] = "-e";
            arguments[n++] = names[used++];
        }
        (void)snprintf(names[used], NAME, "%s.gp", figure_find(p->figure)->name);
        arguments[n++] = names[used++];
    }
    r->begin_time = wt_time_wall();
    const gnuplot_call call = {.program = r->options.gnuplot,
                               .folder = folder_plots_path(r->folder),
                               .arguments = arguments,
                               .size = GNUPLOT_PICTURE_LIMIT,
                               .limit = r->options.gnuplot_time,
                               .timed_out = &r->timed_out,
                               .go_on = may_continue_pictures,
                               .user = r};
    const wt_status status = gnuplot_run(&call, err);
    free(arguments);
    free(names);
    return status;
}

static wt_status draw_all_figures(report *r, wt_error *err)
{
    wt_status status = WT_OK;
    list_pictures(r);
    if (r->n_pictures == 0)
        return WT_OK;
    if ((status = write_style(r, err)) == WT_OK && !notify_progress(r, r->pictures[0].figure))
        status = wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
    if (status == WT_OK)
        status = draw_pictures(r, err);
    for (size_t i = 0; i < wt_figure_count() && status == WT_OK; i++)
        if (r->figures[i].script.length > 0)
            status = figure_collect(r->folder, &r->options, &r->figures[i], err);
    return status;
}

static wt_status write_report_page(const report *r, const wt_result *result, wt_error *err)
{
    page_writer page = {.result = result,
                        .tables = &r->tables,
                        .style = &r->style,
                        .font = r->options.font,
                        .with_provenance = r->options.with_provenance,
                        .figures = r->figures,
                        .n_figures = wt_figure_count()};
    wt_status status = page_write(&page, err);
    if (status == WT_OK)
        status = folder_write(r->folder, "index.html", page.out.bytes, page.out.length, err);
    text_free(&page.out);
    return status;
}

static wt_status check_report_options(const char *place, const wt_report_options *options,
                                      wt_error *err)
{
    wt_status status = param_check(wt_report_params(), options, err);
    if (status == WT_OK && !is_figure_name(options->figure))
        status = wt_fail(err, WT_E_ARG, "there is no figure '%s'", options->figure);
    if (status != WT_OK || options->figures == 0 || !path_is_page(place))
        return status;
    status = wt_fail(err, WT_E_ARG, "pictures for a paper need a folder");
    wt_error_file(err, place);
    wt_error_advice(err, "name a folder, without .html at its end");
    return status;
}

wt_status wt_report_check(const char *folder, const wt_report_options *options, wt_error *err)
{
    const wt_report_options chosen = options != NULL ? *options : wt_report_defaults();
    text_buffer style = {0};
    report_folder *made = NULL;
    wt_status status = check_report_options(folder, &chosen, err);
    if (status == WT_OK)
        status = read_style(chosen.style, &style, err);
    if (status == WT_OK)
        status = folder_open(folder, &made, err);
    folder_discard(made);
    text_free(&style);
    return status;
}

static void report_clear(report *r)
{
    folder_discard(r->folder);
    for (size_t i = 0; r->figures != NULL && i < wt_figure_count(); i++) {
        drawing_clear(&r->figures[i].drawing);
        text_free(&r->figures[i].data);
        text_free(&r->figures[i].script);
        text_free(&r->figures[i].svg);
    }
    free(r->figures);
    free(r->pictures);
    text_free(&r->style);
    figure_tables_clear(&r->tables);
}

wt_status wt_report_write(const wt_result *result, const char *folder,
                          const wt_report_options *options, const wt_progress *progress,
                          wt_error *err)
{
    enum { FORMATS = 3 };
    const size_t n = wt_figure_count();
    report r = {.options = options != NULL ? *options : wt_report_defaults(),
                .progress = progress,
                .figures = wt_alloc(n, sizeof *r.figures),
                .pictures = wt_alloc(FORMATS * n, sizeof *r.pictures)};
    wt_status status = check_report_options(folder, &r.options, err);
    if (status == WT_OK)
        status = figure_tables_bind(result, &r.tables, err);
    if (status == WT_OK)
        status = read_style(r.options.style, &r.style, err);
    if (status == WT_OK)
        status = folder_open(folder, &r.folder, err);
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = write_figure(&r, i, err);
    if (status == WT_OK)
        status = draw_all_figures(&r, err);
    if (status == WT_OK && !notify_progress(&r, n))
        status = wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
    if (status == WT_OK)
        status = write_report_page(&r, result, err);
    if (status == WT_OK) {
        status = folder_commit(r.folder, err);
        r.folder = NULL;
        if (status == WT_OK)
            (void)notify_progress(&r, n + 1); // the report is complete and cannot be cancelled
    }
    report_clear(&r);
    return status;
}
