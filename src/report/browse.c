/* Writes one self-contained page for browsing the curves of a result.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/browse.h"

#include "report/curve_finder.h"
#include "report/report_files.h"
#include "weartrack/report.h"

#include <string.h>

/* A part of the page and its placeholder in browse.html. */
typedef struct page_part {
    const char *mark, *text;
} page_part;

static wt_status find_dygraphs(const char **script, const char **style, const char **licence,
                               wt_error *err)
{
    *script = embedded_file_text("dygraph.min.js");
    *style = embedded_file_text("dygraph.min.css");
    *licence = embedded_file_text("copyright");
    if (*script != NULL && *style != NULL && *licence != NULL)
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_TOOL, "this build has no dygraphs, which draws on the page");
    wt_error_advice(err, "install the Debian package libjs-dygraphs and build weartrack again");
    return status;
}

static void append_page_template(const page_part *parts, size_t n, text_buffer *page)
{
    const char *p = embedded_file_text("browse.html");
    for (const char *mark; (mark = strstr(p, "@@")) != NULL;) {
        text_bytes(page, p, (size_t)(mark - p));
        size_t k = 0;
        while (k < n && strncmp(mark + 2, parts[k].mark, strlen(parts[k].mark)) != 0)
            k++;
        p = mark + 2;
        if (k == n)
            continue;
        text_add(page, parts[k].text);
        p += strlen(parts[k].mark) + 2;
    }
    text_add(page, p);
}

static void append_provenance(const wt_result *result, bool with_provenance, text_buffer *to)
{
    text_html(to, "weartrack %s", wt_version());
    const char *command = wt_provenance_command(wt_result_provenance_const(result));
    if (with_provenance && command[0] != '\0')
        text_html(to, "<details><summary>Command</summary><code>%s</code></details>", command);
}

wt_status wt_curve_browser_write(const wt_result *result, const char *path, bool with_provenance,
                                 wt_error *err)
{
    figure_tables tables = {0};
    text_buffer data = {0}, licence = {0}, source = {0}, page = {0};
    const char *script = NULL, *style = NULL, *copyright = NULL;
    wt_status status = find_dygraphs(&script, &style, &copyright, err);
    if (status == WT_OK)
        status = figure_tables_bind(result, &tables, err);
    if (status == WT_OK)
        status = check_curve_samples(&tables, err);
    if (status == WT_OK) {
        append_browse_data(&tables, &data);
        text_html(&licence, "%s", copyright);
        append_provenance(result, with_provenance, &source);
        const page_part parts[] = {{"dygraph.css", style},
                                   {"browse.css", embedded_file_text("browse.css")},
                                   {"data", text_string(&data)},
                                   {"dygraph.js", script},
                                   {"shared.js", embedded_file_text("shared.js")},
                                   {"browse.js", embedded_file_text("browse.js")},
                                   {"licence", text_string(&licence)},
                                   {"source", text_string(&source)}};
        append_page_template(parts, sizeof parts / sizeof parts[0], &page);
        status = write_user_file(path, &page, err);
    }
    text_free(&data);
    text_free(&licence);
    text_free(&source);
    text_free(&page);
    figure_tables_clear(&tables);
    return status;
}
