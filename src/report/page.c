/* The page of a report: frame, answer, figures.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "report/files.h"
#include "report/folder.h"
#include "report/svg.h"

#include <string.h>

static void page_head(const page_writer *page, growing_text *out, const char *title)
{
    text_add(out, "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" "
                  "xml:lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n" REPORT_MARK);
    if (page->with_provenance)
        text_format(out, " %s", wt_version());
    text_add(out, "\" />\n<meta name=\"viewport\" content=\"width=device-width, "
                  "initial-scale=1\" />\n<meta name=\"color-scheme\" content=\"light dark\" "
                  "/>\n<title>");
    text_html(out, title);
    text_add(out, "</title>\n<style>\n");
    text_add(out, file_of_library("page.css"));
    text_add(out, "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>");
    text_html(out, title);
    text_add(out, "</h1>\n<nav aria-label=\"Contents\">\n<ul>\n");
    text_add(out, text_string(&page->contents));
    text_add(out, "</ul>\n</nav>\n</header>\n");
}

/* Several answers to one question stand under it together. */
static void page_answer(page_writer *page)
{
    const table_view *table = &page->tables->answer;
    if (table->n_rows == 0)
        return;
    page_heading(page, "answer", "Answer");
    const char *question = NULL;
    for (size_t row = 0; row < table->n_rows; row++) {
        const char *next = answer_text(table, row, ANSWER_QUESTION);
        if (question == NULL || strcmp(question, next) != 0) {
            bool caveat = strcmp(answer_text(table, row, ANSWER_KIND), "caveat") == 0;
            text_format(&page->out, "%s<section class=\"%s\">\n<h3>",
                        question == NULL ? "" : "</section>\n",
                        caveat ? "answer caveat" : "answer");
            text_html(&page->out, next);
            text_add(&page->out, "</h3>\n");
            question = next;
        }
        text_add(&page->out, "<p>");
        text_html(&page->out, answer_text(table, row, ANSWER_ANSWER));
        text_add(&page->out, "</p>\n");
    }
    text_add(&page->out, "</section>\n");
}

/* One column of the page, or all of it with the type of the same size. */
static const char *width_class(double width)
{
    return width > 1.2 ? "wide" : width > 0 && width < 0.9 ? "narrow" : "single";
}

static wt_status page_figures(page_writer *page, wt_error *err)
{
    if (page->n_figures == 0)
        return WT_OK;
    size_t number = 0;
    page_heading(page, "figures", "Figures");
    text_add(&page->out, "<div class=\"figures\">\n");
    for (size_t i = 0; i < page->n_figures; i++) {
        const page_figure *figure = &page->figures[i];
        if (figure->omitted != NULL)
            continue;
        text_format(&page->out, "<figure id=\"figure-%s\" class=\"%s\">\n<div class=\"card\">",
                    figure->figure->name, width_class(figure->width));
        if (!svg_inline(&page->out, figure->svg, figure->svg_length, figure->figure->name,
                        figure->figure->title)) {
            wt_status status = wt_fail(err, WT_E_TOOL, "the picture of figure %s is not SVG",
                                       figure->figure->name);
            wt_error_advice(err, "a plot style must use `set terminal svg`");
            return status;
        }
        text_format(&page->out, "</div>\n<figcaption><strong>Figure %zu. ", ++number);
        text_html(&page->out, figure->figure->title);
        text_add(&page->out, ".</strong> ");
        text_html(&page->out, figure->caption);
        text_format(&page->out,
                    " <span class=\"source\">Data and script: <a href=\"plots/%s.tsv\">%s.tsv"
                    "</a>, <a href=\"plots/%s.gp\">%s.gp</a>.</span></figcaption>\n</figure>\n",
                    figure->figure->name, figure->figure->name, figure->figure->name,
                    figure->figure->name);
    }
    text_add(&page->out, "</div>\n");
    for (size_t i = 0; i < page->n_figures; i++) {
        const page_figure *figure = &page->figures[i];
        if (figure->omitted == NULL || figure->omitted[0] == '\0')
            continue;
        text_add(&page->out, "<p class=\"omitted\">Not drawn: ");
        text_html(&page->out, figure->figure->title);
        text_add(&page->out, " – ");
        text_html(&page->out, figure->omitted);
        text_add(&page->out, ".</p>\n");
    }
    return WT_OK;
}

/* The title of the case, if the result has one. */
static const char *page_title(const page_writer *page)
{
    const char *title = answer_words(&page->tables->answer, ANSWER_KEY_CASE_TITLE);
    return title != NULL && title[0] != '\0' ? title : "Wear track against bulk";
}

wt_status page_write(page_writer *page, wt_error *err)
{
    // The body first, so that the contents before it are known.
    growing_text body = {0};
    page_answer(page);
    page_numbers(page);
    wt_status status = page_figures(page, err);
    if (status != WT_OK)
        goto done;
    page_results(page);
    page_indentation(page);
    page_inputs(page);
    page_cost(page);
    page_record(page);
    body = page->out;
    page->out = (growing_text){.failed = body.failed || page->contents.failed};
    page_head(page, &page->out, page_title(page));
    text_bytes(&page->out, text_string(&body), body.length);
    text_add(&page->out, "</main>\n</body>\n</html>\n");
    if (page->out.failed)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
done:
    text_free(&body);
    text_free(&page->contents);
    return status;
}
