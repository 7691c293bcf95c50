/* Writing a report: figures, then gnuplot, then the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/report.h"

#include "report/figures.h"
#include "report/folder.h"
#include "report/gnuplot.h"
#include "report/page.h"
#include "report/report_embedded.h"
#include "report/report_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

wt_report_options wt_report_defaults(void)
{
    return (wt_report_options){.style = NULL, .gnuplot = NULL, .with_provenance = true};
}

const char *wt_report_file(const char *name)
{
    for (const wt_embedded *file = report_embedded; file->name != NULL; file++)
        if (strcmp(file->name, name) == 0)
            return file->text;
    return NULL;
}

void wt_report_styles(char *names, size_t size)
{
    size_t n = 0;
    names[0] = '\0';
    for (const wt_embedded *file = report_embedded; file->name != NULL; file++) {
        const char *end = strstr(file->name, ".gp");
        if (end == NULL || n >= size)
            continue;
        int more = snprintf(names + n, size - n, "%s%.*s", n == 0 ? "" : ", ",
                            (int)(end - file->name), file->name);
        n += more > 0 ? (size_t)more : 0;
    }
}

/* Reads a whole file of at most `limit` bytes into a text. */
static wt_status read_file(const char *path, size_t limit, wt_text *text, wt_error *err)
{
    wt_status status = WT_OK;
    char chunk[8192];
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        status = wt_fail(err, errno == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "cannot be opened: %s",
                         strerror(errno));
        wt_error_file(err, path);
        return status;
    }
    for (size_t got; (got = fread(chunk, 1, sizeof chunk, file)) > 0;) {
        wt_text_bytes(text, chunk, got);
        if (text->length > limit) {
            status = wt_fail(err, WT_E_RANGE, "larger than %zu bytes", limit);
            wt_error_file(err, path);
            goto done;
        }
    }
    if (ferror(file)) {
        status = wt_fail(err, WT_E_IO, "cannot be read: %s", strerror(errno));
        wt_error_file(err, path);
    } else if (text->failed)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
done:
    fclose(file);
    return status;
}

/* A built-in style by name; anything with a slash or ending in .gp is a file. */
static wt_status find_style(const char *style, wt_text *text, wt_error *err)
{
    enum { STYLE_LIMIT = 1 << 20 };
    const char *name = style != NULL ? style : "paper";
    size_t length = strlen(name);
    if (strchr(name, '/') != NULL || (length > 3 && strcmp(name + length - 3, ".gp") == 0))
        return read_file(name, STYLE_LIMIT, text, err);
    wt_text file = {0};
    wt_text_format(&file, "%s.gp", name);
    const char *built_in = wt_report_file(wt_text_string(&file));
    wt_text_free(&file);
    if (built_in != NULL) {
        wt_text_add(text, built_in);
        return text->failed ? wt_fail(err, WT_E_MEMORY, "out of memory") : WT_OK;
    }
    char names[128];
    wt_report_styles(names, sizeof names);
    wt_status status = wt_fail(err, WT_E_NOT_FOUND, "no plot style of that name");
    wt_error_expected(err, "%s, or a file name that ends in .gp", names);
    wt_error_found(err, "\"%s\"", name);
    return status;
}

/* ---- figures --------------------------------------------------------------------------------- */

/* What becomes of one figure. */
typedef struct drawn_figure {
    wt_drawing drawing;
    wt_text svg;
} drawn_figure;

static bool has_tables(const wt_result *result, const wt_figure_info *info)
{
    for (size_t i = 0; info->needs[i] != NULL; i++) {
        const wt_table *table = wt_result_find(result, info->needs[i]);
        if (table == NULL || wt_table_n_rows(table) == 0)
            return false;
    }
    return true;
}

static wt_status write_data(const wt_folder *folder, const wt_drawing *d, wt_error *err)
{
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
    (void)snprintf(name, sizeof name, "plots/%s.tsv", d->name);
    if (status == WT_OK)
        status = wt_folder_write(folder, name, bytes, length, err);
    free(bytes);
    return status;
}

static wt_status write_script(const wt_folder *folder, const wt_drawing *d,
                              const wt_figure_info *info, wt_error *err)
{
    wt_text script = {0};
    char name[128];
    wt_text_format(&script, "# %s. To draw it again: gnuplot %s.gp\n", info->title, info->name);
    wt_text_format(&script,
                   "# Data: %s.tsv, in SI units; x_unit and so on turn them into those of "
                   "the axes.\n",
                   info->name);
    wt_text_comment(&script, wt_text_string(&d->caption));
    wt_text_add(&script, "reset\nfigure_width = ");
    wt_text_literal(&script, d->width > 0 ? d->width : 1);
    wt_text_add(&script, "; figure_height = ");
    wt_text_literal(&script, d->height > 0 ? d->height : 1);
    wt_text_format(&script,
                   "\nload 'style.gp'\nset datafile separator \"\\t\"\nset output '%s.svg'\n",
                   info->name);
    wt_text_add(&script, wt_text_string(&d->script));
    wt_text_add(&script, "set output\n");
    (void)snprintf(name, sizeof name, "plots/%s.gp", info->name);
    wt_status status =
        script.failed || d->script.failed || d->caption.failed
            ? wt_fail(err, WT_E_MEMORY, "out of memory")
            : wt_folder_write(folder, name, wt_text_string(&script), script.length, err);
    wt_text_free(&script);
    return status;
}

/* Draws what the result has tables for; pages[*n_pages] and scripts[*n_scripts] list them. */
static wt_status make_figures(const wt_result *result, const wt_folder *folder,
                              drawn_figure *figures, wt_page_figure *pages, size_t *n_pages,
                              char (*scripts)[96], size_t *n_scripts, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < wt_figure_count() && status == WT_OK; i++) {
        const wt_figure_info *info = wt_figure_get(i);
        if (!has_tables(result, info))
            continue;
        wt_drawing *d = &figures[i].drawing;
        *d = (wt_drawing){.result = result, .name = info->name, .err = err};
        wt_figure_draw(i)(d);
        if (d->status != WT_OK)
            return d->status;
        wt_page_figure *page = &pages[(*n_pages)++];
        *page = (wt_page_figure){.info = info, .width = d->width};
        if (d->script.length == 0) {
            page->omitted = wt_text_string(&d->omitted);
            continue;
        }
        if ((status = write_data(folder, d, err)) == WT_OK)
            status = write_script(folder, d, info, err);
        (void)snprintf(scripts[(*n_scripts)++], sizeof *scripts, "%s.gp", info->name);
    }
    return status;
}

static wt_status read_pictures(const wt_folder *folder, drawn_figure *figures,
                               wt_page_figure *pages, size_t n_pages, wt_error *err)
{
    enum { PICTURE_LIMIT = 64 << 20 };
    for (size_t i = 0; i < n_pages; i++) {
        if (pages[i].omitted != NULL)
            continue;
        drawn_figure *figure = figures;
        while (figure->drawing.name != pages[i].info->name)
            figure++;
        char name[128];
        (void)snprintf(name, sizeof name, "%s.svg", pages[i].info->name);
        char *path = wt_path_join(wt_folder_plots(folder), name);
        if (path == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        wt_status status = read_file(path, PICTURE_LIMIT, &figure->svg, err);
        free(path);
        if (status != WT_OK)
            return status;
        pages[i].svg = wt_text_string(&figure->svg);
        pages[i].svg_length = figure->svg.length;
        pages[i].caption = wt_text_string(&figure->drawing.caption);
    }
    return WT_OK;
}

static wt_status tell(const wt_progress *progress, const char *what, size_t done, wt_error *err)
{
    enum { STEPS = 3 };
    if (progress == NULL || progress->report == NULL ||
        progress->report(progress->user, what, done, STEPS))
        return WT_OK;
    return wt_fail(err, WT_E_CANCELLED, "the report was cancelled");
}

wt_status wt_report_write(const wt_result *result, const char *folder_name,
                          const wt_report_options *options, const wt_progress *progress,
                          wt_error *err)
{
    const wt_report_options chosen = options != NULL ? *options : wt_report_defaults();
    wt_status status = WT_OK;
    wt_folder *folder = NULL;
    wt_text style = {0};
    wt_page page = {.result = result, .with_provenance = chosen.with_provenance};
    size_t n = wt_figure_count(), n_pages = 0, n_scripts = 0;
    drawn_figure *figures = calloc(n, sizeof *figures);
    wt_page_figure *pages = calloc(n, sizeof *pages);
    char(*scripts)[96] = calloc(n, sizeof *scripts);
    const char **names = calloc(n, sizeof *names);

    if (figures == NULL || pages == NULL || scripts == NULL || names == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
        goto done;
    }
    if ((status = find_style(chosen.style, &style, err)) != WT_OK ||
        (status = wt_folder_open(folder_name, &folder, err)) != WT_OK ||
        (status = tell(progress, "figures", 0, err)) != WT_OK ||
        (status = make_figures(result, folder, figures, pages, &n_pages, scripts, &n_scripts,
                               err)) != WT_OK)
        goto done;
    if (n_scripts > 0) {
        for (size_t i = 0; i < n_scripts; i++)
            names[i] = scripts[i];
        if ((status = wt_folder_write(folder, "plots/style.gp", wt_text_string(&style),
                                      style.length, err)) != WT_OK ||
            (status = tell(progress, "pictures", 1, err)) != WT_OK ||
            (status = wt_gnuplot_run(chosen.gnuplot != NULL ? chosen.gnuplot : "gnuplot",
                                     wt_folder_plots(folder), names, n_scripts, err)) != WT_OK ||
            (status = read_pictures(folder, figures, pages, n_pages, err)) != WT_OK)
            goto done;
    }
    page.figures = pages;
    page.n_figures = n_pages;
    if ((status = tell(progress, "page", 2, err)) != WT_OK ||
        (status = wt_page_write(&page, err)) != WT_OK ||
        (status = wt_folder_write(folder, "index.html", page.out.bytes, page.out.length, err)) !=
            WT_OK)
        goto done;
    status = wt_folder_commit(folder, err);
    folder = NULL;
    if (status == WT_OK)
        (void)tell(progress, "page", 3, NULL); // it is there: too late to cancel
done:
    wt_folder_discard(folder);
    for (size_t i = 0; figures != NULL && i < n; i++) {
        wt_drawing_clear(&figures[i].drawing);
        wt_text_free(&figures[i].svg);
    }
    free(figures);
    free(pages);
    free(scripts);
    free(names);
    wt_text_free(&style);
    wt_text_free(&page.out);
    return status;
}
