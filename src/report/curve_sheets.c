/* Writes force curves as a PDF of printable sheets.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/system/file_signatures.h"
#include "core/system/temporary.h"
#include "report/curve_panel.h"
#include "report/figure_files.h"
#include "report/gnuplot.h"
#include "report/report_files.h"
#include "weartrack/report.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Panels on a sheet; each is 55 mm wide and, below its heading, 40 mm high. */
enum { COLUMNS = 3, ROWS = 4, CURVES = COLUMNS * ROWS };

/* Size limit of a sheet [byte], ten times that of twelve curves with the most samples. */
static const size_t sheet_size = (size_t)1 << 20;

/* An A4 sheet. output.gnuplot adds the hundredth of an inch that is subtracted here. */
#define SHEET_BEGIN                                                                                \
    "figure_name = 'sheets'; figure_format = 'pdf'; figure_width = 1; figure_height = 1\n"         \
    "panel_width = (210/25.4-0.01)*72*15/8.\n"
#define SHEET_STYLE                                                                                \
    "load 'style.gp'\nfigure_height = (297/25.4-0.01)*72*15/8./panel_height\n"                     \
    "load 'output.gp'\nset datafile separator \"\\t\"\n"

typedef struct sheets {
    wt_report_options options;
    figure_tables tables;
    curve_list list;
    text_buffer style, script;
    char *folder; /* temporary */
    int in_use;
    size_t n, begun;   /* number of sheets; of those that gnuplot has begun */
    double begin_time; /* wall time when the last one began [s] */
    bool timed_out;
    const wt_progress *progress;
} sheets;

/* ---- one sheet ------------------------------------------------------------------------------- */

/* Writes "sheet_12", the stem of its data file and the name of the file that marks its begin. */
static void sheet_name(size_t sheet, char name[32])
{
    (void)snprintf(name, 32, "sheet_%zu", sheet + 1);
}

static wt_status write_sheet_file(const sheets *s, const char *name, const char *ending,
                                  const text_buffer *text, wt_error *err)
{
    char file[64];
    (void)snprintf(file, sizeof file, "%s%s", name, ending);
    char *path = wt_path_join(s->folder, file);
    const wt_status status = write_temporary_file(path, text_string(text), text->length, err);
    free(path);
    return status;
}

/* Adds the title above the panels. */
static void add_sheet_title(sheets *s, size_t sheet)
{
    static const char *const kinds[] = {"refused", "doubtful", "wide", "accepted"};
    text_buffer words = {0};
    text_format(&words, "Force curves, sheet %zu of %zu:", sheet + 1, s->n);
    for (int k = 0; k < CURVE_KINDS; k++)
        text_format(&words, "%s %zu %s", k > 0 ? "," : "", s->list.of_kind[k], kinds[k]);
    if (s->list.n < s->list.n_rows)
        text_format(&words, " with samples, of %zu curves", s->list.n_rows);
    text_add(&s->script, "set multiplot title ");
    text_quoted(&s->script, text_string(&words));
    text_format(&s->script,
                ".\"\\n%s\" noenhanced layout %d,%d margins 0.085,0.985,0.05,0.87 "
                "spacing 0.085,0.135\n",
                curve_panel_legend, ROWS, COLUMNS);
    text_free(&words);
}

/* Writes the data of a sheet and appends its script. */
static wt_status write_sheet(sheets *s, size_t sheet, wt_error *err)
{
    char name[32];
    sheet_name(sheet, name);
    const figure_description described = {.name = name, .table = &curves_schema};
    figure_drawing d = {
        .figure = &described, .tables = &s->tables, .table = &s->tables.curves, .err = err};
    text_buffer data = {0};
    const size_t first = CURVES * sheet,
                 end = first + CURVES < s->list.n ? first + CURVES : s->list.n;
    text_format(&s->script, "set print '%s'\nprint ''\nunset print\n", name);
    add_sheet_title(s, sheet);
    for (size_t i = first; i < end; i++)
        draw_curve_panel(&d, &s->list.curves[i]);
    text_add(&s->script, text_string(&d.script));
    text_add(&s->script, "unset multiplot\n");
    wt_status status = d.status;
    if (status == WT_OK)
        status = figure_append_data(&d, &data, err);
    if (status == WT_OK)
        status = write_sheet_file(s, name, ".tsv", &data, err);
    text_free(&data);
    drawing_clear(&d);
    return status;
}

/* ---- all ------------------------------------------------------------------------------------- */

static bool notify_sheets(const sheets *s, size_t done)
{
    return s->progress == NULL || s->progress->report == NULL ||
           s->progress->report(s->progress->user, "sheets", done, s->n);
}

static bool is_sheet_begun(const sheets *s, size_t sheet)
{
    char name[32];
    sheet_name(sheet, name);
    char *path = wt_path_join(s->folder, name);
    const bool there = path != NULL && access(path, F_OK) == 0;
    free(path);
    return there;
}

/* Callback while gnuplot runs; false ends it. */
static bool may_continue_sheets(void *user)
{
    sheets *s = user;
    for (; s->begun < s->n && is_sheet_begun(s, s->begun); s->begun++)
        s->begin_time = wt_time_wall();
    s->timed_out = wt_time_wall() - s->begin_time > s->options.gnuplot_time;
    return !s->timed_out && notify_sheets(s, s->begun > 0 ? s->begun - 1 : 0);
}

/* Creates a temporary folder in the folder of the output, or in that for temporary files if the
 * output is a pipe. */
static wt_status create_sheets_folder(sheets *s, const char *path, wt_error *err)
{
    struct stat info;
    const bool beside = stat(path, &info) != 0 || S_ISREG(info.st_mode);
    char *const parent = beside ? wt_path_folder(path) : realpath(temporary_directory(), NULL);
    if (parent != NULL) {
        temporary_remove_abandoned(parent);
        s->folder = temporary_folder_create(parent, &s->in_use);
    }
    const int code = errno;
    free(parent);
    if (s->folder != NULL && fchmod(s->in_use, S_IRWXU) == 0)
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_IO, "cannot be made: %s", strerror(s->folder != NULL ? errno : code));
    wt_error_file(err, path);
    wt_error_advice(err, beside ? "the folder it goes into must exist and be writable"
                                : "set TMPDIR to a folder that may be written to");
    return status;
}

static wt_status write_sheets_script(sheets *s, wt_error *err)
{
    text_buffer output = {0};
    wt_status status = write_sheet_file(s, "style", ".gp", &s->style, err);
    text_add(&output, embedded_file_text("output.gnuplot"));
    if (status == WT_OK)
        status = write_sheet_file(s, "output", ".gp", &output, err);
    text_free(&output);
    text_add(&s->script, SHEET_BEGIN);
    if (s->options.font != NULL)
        text_format(&s->script, "figure_font = '%s'\n", s->options.font);
    text_add(&s->script, SHEET_STYLE);
    for (size_t i = 0; i < s->n && status == WT_OK; i++)
        status = write_sheet(s, i, err);
    text_add(&s->script, "set output\n");
    return status == WT_OK ? write_sheet_file(s, "sheets", ".gp", &s->script, err) : status;
}

static wt_status draw_sheets(sheets *s, const char *path, wt_error *err)
{
    static const char *const arguments[] = {"--default-settings", "sheets.gp", NULL};
    text_buffer made = {0};
    const gnuplot_call call = {.program = s->options.gnuplot,
                               .folder = s->folder,
                               .arguments = arguments,
                               .size = s->n * sheet_size,
                               .limit = s->options.gnuplot_time,
                               .timed_out = &s->timed_out,
                               .go_on = may_continue_sheets,
                               .user = s};
    s->begin_time = wt_time_wall();
    wt_status status = gnuplot_run(&call, err);
    char *pdf = status == WT_OK ? wt_path_join(s->folder, "sheets.pdf") : NULL;
    if (status == WT_OK)
        status = read_whole_file(pdf, s->n * sheet_size, &made, err);
    text_add(&made, PDF_SIGNATURE);
    if (status == WT_OK)
        status = write_user_file(path, &made, err);
    free(pdf);
    text_free(&made);
    return status;
}

static void sheets_clear(sheets *s)
{
    if (s->folder != NULL) {
        temporary_remove(s->folder);
        close(s->in_use);
    }
    free(s->folder);
    curve_list_clear(&s->list);
    text_free(&s->style);
    text_free(&s->script);
    figure_tables_clear(&s->tables);
}

wt_status wt_curve_sheets_write(const wt_result *result, const char *path,
                                const wt_report_options *options, const wt_progress *progress,
                                wt_error *err)
{
    sheets s = {.options = options != NULL ? *options : wt_report_defaults(), .progress = progress};
    wt_status status = param_check(wt_report_params(), &s.options, err);
    if (status == WT_OK)
        status = figure_tables_bind(result, &s.tables, err);
    if (status == WT_OK)
        status = check_curve_samples(&s.tables, err);
    if (status == WT_OK)
        curve_list_init(&s.tables, &s.list);
    s.n = (s.list.n + CURVES - 1) / CURVES;
    if (status == WT_OK && s.n == 0)
        status = wt_fail(err, WT_E_EMPTY, "no curve has samples of displacement and force");
    if (status == WT_OK)
        status = read_style(s.options.style, &s.style, err);
    if (status == WT_OK)
        status = create_sheets_folder(&s, path, err);
    if (status == WT_OK)
        status = write_sheets_script(&s, err);
    if (status == WT_OK && !notify_sheets(&s, 0))
        status = wt_fail(err, WT_E_CANCELLED, "the sheets were cancelled");
    if (status == WT_OK)
        status = draw_sheets(&s, path, err);
    if (status == WT_OK)
        (void)notify_sheets(&s, s.n);
    sheets_clear(&s);
    return status;
}
