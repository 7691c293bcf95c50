/* Writes the page of a report: frame, answer, figures, inputs, failures, cost and provenance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "report/report_files.h"

#include <stdio.h>
#include <string.h>

/* ---- inputs and record ----------------------------------------------------------------------- */

static void page_failures(page_writer *page)
{
    const table_view *table = &page->tables->failures;
    if (table->n_rows > 0)
        page_heading(page, "failures", "Failures");
    page_whole_table(page, table, "What could not be read or computed", NULL, 0);
}

static void folded_table(page_writer *page, const char *id, const char *words,
                         const table_view *table, const char *caption)
{
    if (table->n_rows == 0)
        return;
    page_fold(page, id, words, PAGE_PRINTED);
    page_whole_table(page, table, caption, NULL, 0);
    page_fold_end(page);
}

static void page_inputs(page_writer *page)
{
    const figure_tables *t = page->tables;
    folded_table(page, "inputs", "Inputs", &t->inputs, "Files read, with their digests");
    folded_table(page, "methods", "Methods", &t->methods,
                 "Methods, what they did here (±: standard error), and where they are described");
    folded_table(page, "notes", "Notes", &t->notes, "Notes and warnings");
}

static void page_cost(page_writer *page)
{
    // Columns of times are last: they never repeat, so they are omitted without provenance.
    enum { N_TIMES = 2, STAGES = 64 };
    static const unsigned ran[] = {COST_STAGE,           COST_ITEMS,           COST_NODES,
                                   COST_TOLERANCE_ASKED, COST_ERROR_ESTIMATED, COST_STANDARD_ERROR,
                                   COST_REASON,          COST_WALL_TIME,       COST_CPU_TIME},
                          left_out[] = {COST_STAGE, COST_REASON};
    const table_view *table = &page->tables->cost;
    size_t rows[2][STAGES], n[2] = {0, 0};
    if (table->n_rows == 0)
        return;
    for (size_t row = 0; row < table->n_rows; row++) {
        size_t out = cost_get(table, row, COST_RUNS) == 0;
        if (n[out] < STAGES)
            rows[out][n[out]++] = row;
    }
    page_fold(page, "cost", "Cost", PAGE_UNPRINTED);
    if (n[0] > 0)
        page_table(page, table, "Stages that ran", ran,
                   COUNT_OF(ran) - (page->with_provenance ? 0 : N_TIMES), rows[0], n[0]);
    if (n[1] > 0)
        page_table(page, table, "Stages left out", left_out, COUNT_OF(left_out), rows[1], n[1]);
    page_fold_end(page);
}

static void page_record(page_writer *page)
{
    size_t length = 0;
    const char *xml = wt_result_case(page->result, &length);
    if (xml != NULL && length > 0) {
        text_buffer copy = {0}; // the text need not be terminated by zero
        text_bytes(&copy, xml, length);
        page_fold(page, "case", "Case file", PAGE_UNPRINTED);
        text_html(&page->out, "<pre tabindex=\"0\"><code>%s</code></pre>\n", text_string(&copy));
        page_fold_end(page);
        text_free(&copy);
    }
    const wt_provenance *provenance = wt_result_provenance_const(page->result);
    if (!page->with_provenance || provenance == NULL)
        return;
    const char *command = wt_provenance_command(provenance);
    page_fold(page, "provenance", "Provenance", PAGE_PRINTED);
    text_html(&page->out, "<dl>\n<dt>Page written by</dt><dd>weartrack %s</dd>\n", wt_version());
    if (command[0] != '\0')
        text_html(&page->out, "<dt>Command</dt><dd>%s</dd>\n", command);
    text_add(&page->out, "</dl>\n");
    page_fold_end(page);
}

/* ---- page ------------------------------------------------------------------------------------ */

static void page_head(page_writer *page, const char *title)
{
    text_buffer *const out = &page->out;
    text_html(out, "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" "
                   "xml:lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n" REPORT_MARK);
    if (page->with_provenance)
        text_format(out, " %s", wt_version());
    text_html(out,
              "\" />\n<meta name=\"viewport\" content=\"width=device-width, "
              "initial-scale=1\" />\n<meta name=\"color-scheme\" content=\"light dark\" "
              "/>\n<title>%s</title>\n<style>\n",
              title);
    text_add(out, embedded_file_text("page.css"));
    if (page->font != NULL) // only letters, digits, blanks and hyphens
        text_format(out, ":root { --figure-font: \"%s\"; }\n", page->font);
    text_html(out, "</style>\n</head>\n<body>\n<main>\n<header>\n<h1>%s</h1>\n", title);
    page_conditions(page);
    text_add(out, "<nav aria-label=\"Contents\">\n<ul>\n");
    text_add(out, text_string(&page->contents));
    text_add(out, "</ul>\n</nav>\n</header>\n");
}

/* Adds a download link with the content of a file. */
static void add_file(page_writer *page, const char *name, const char *ending,
                     const text_buffer *file)
{
    text_html(&page->out, "<a download=\"%s.%s\" href=\"", name, ending);
    text_data_link(&page->out, "text/plain", text_string(file), file->length);
    text_html(&page->out, "\">%s.%s</a>", name, ending);
}

/* Largest data of one figure in the page [byte], as the page must be small enough to mail. Larger
 * data are only in the folder. */
static const size_t data_limit = (size_t)4 << 10;

static void add_figure_source(page_writer *page, const drawn_figure *drawn)
{
    const char *const name = drawn->drawing.figure->name;
    text_add(&page->out, " <span class=\"source\">");
    if (drawn->data.length <= data_limit) {
        text_add(&page->out, "Data and script: ");
        add_file(page, name, "tsv", &drawn->data);
        text_add(&page->out, ", ");
    } else
        text_format(&page->out,
                    "Data: plots/%s.tsv, %zu kB, in the folder that weartrack report -o FOLDER "
                    "writes. Script: ",
                    name, drawn->data.length >> 10);
    add_file(page, name, "gp", &drawn->script);
    text_add(&page->out, ".</span>");
}

static wt_status add_figure(page_writer *page, const drawn_figure *drawn, size_t number,
                            wt_error *err)
{
    const figure_description *figure = drawn->drawing.figure;
    text_html(&page->out, "<figure id=\"figure-%s\" class=\"%s\">\n<div class=\"card\">",
              figure->name, drawing_is_wide(&drawn->drawing) ? "wide" : "single");
    char id[16]; /* short, as each symbol of the figure repeats it */
    snprintf(id, sizeof id, "f%zu", number);
    if (!svg_append_inline(&page->out, text_string(&drawn->svg), drawn->svg.length, figure->name,
                           id, figure->title, &page->symbols)) {
        wt_status status =
            wt_fail(err, WT_E_TOOL, "the picture of figure %s is not SVG", figure->name);
        wt_error_advice(err, "a plot style must use `set terminal svg`");
        return status;
    }
    text_add(&page->out, "</div>\n<figcaption><strong>");
    text_format(&page->out, "Figure %zu. ", number);
    text_html(&page->out,
              "%s.</strong>\n<details><summary>What it shows, data and script</summary>\n"
              "<p>%s</p>\n<p>",
              figure->title, text_string(&drawn->drawing.caption));
    add_figure_source(page, drawn);
    text_add(&page->out, "</p>\n</details>\n</figcaption>\n</figure>\n");
    return WT_OK;
}

/* True if figure i is drawn, belongs to the section, and is a main or a folded one. */
static bool is_of_section(const page_writer *page, size_t i, page_section section, bool in_depth)
{
    return page->figures[i].svg.length > 0 && figure_section(i) == section &&
           page->figures[i].drawing.figure->in_depth == in_depth;
}

static size_t count_figures(const page_writer *page, page_section section, bool in_depth)
{
    size_t n = 0;
    for (size_t i = 0; i < page->n_figures; i++)
        n += is_of_section(page, i, section, in_depth);
    return n;
}

/* Adds the main or the folded figures of a section; *number continues counting. */
static wt_status add_figures(page_writer *page, page_section section, bool in_depth, size_t *number,
                             wt_error *err)
{
    wt_status status = WT_OK;
    if (count_figures(page, section, in_depth) == 0)
        return WT_OK;
    text_add(&page->out, "<div class=\"figures\">\n");
    for (size_t i = 0; i < page->n_figures && status == WT_OK; i++)
        if (is_of_section(page, i, section, in_depth))
            status = add_figure(page, &page->figures[i], ++*number, err);
    text_add(&page->out, "</div>\n");
    return status;
}

static void add_missing_figures(page_writer *page, page_section section)
{
    for (size_t i = 0; i < page->n_figures; i++) {
        const figure_description *figure = page->figures[i].drawing.figure;
        if (figure != NULL && page->figures[i].svg.length == 0 && figure->empty_reason != NULL &&
            figure_section(i) == section)
            text_html(&page->out, "<p class=\"omitted\">Not drawn: %s – %s.</p>\n", figure->title,
                      figure->empty_reason);
    }
}

/* Writes a section: its main numbers and figures, then its further figures, folded. */
static wt_status page_section_write(page_writer *page, page_section section, size_t *number,
                                    wt_error *err)
{
    static const struct {
        const char *id, *heading, *more_id;
    } about[PAGE_SECTIONS] = {
        [SECTION_INDENTATION] = {"indentation", "Indentation", "more-indentation"},
        [SECTION_MATERIAL] = {"material", "Material", "more-material"},
        [SECTION_SURFACE] = {"surface", "Surface", "more-surface"},
        [SECTION_FRICTION] = {"friction", "Friction", "more-friction"},
        [SECTION_LAYER] = {"layer", "Layer", "more-layer"},
        [SECTION_COLLECTION] = {"collection", "Collection", "more-collection"},
        [SECTION_UNCERTAINTY] = {"uncertainty", "Uncertainty", "more-uncertainty"}};
    text_buffer before = page->out;
    page->out = (text_buffer){0};
    page_section_rows(page, section);
    wt_status status = add_figures(page, section, false, number, err);
    add_missing_figures(page, section);
    const size_t n_more = count_figures(page, section, true);
    if (status == WT_OK && n_more > 0) {
        text_format(&page->out, "<details class=\"part unprinted\" id=\"%s\">\n",
                    about[section].more_id);
        text_format(&page->out, "<summary>%zu more figure%s</summary>\n<div>\n", n_more,
                    n_more == 1 ? "" : "s");
        status = add_figures(page, section, true, number, err);
        text_add(&page->out, "</div>\n</details>\n");
    }
    text_buffer content = page->out;
    page->out = before;
    if (content.length > 0) {
        page_heading(page, about[section].id, about[section].heading);
        text_bytes(&page->out, text_string(&content), content.length);
    }
    text_free(&content);
    return status;
}

static wt_status page_sections(page_writer *page, wt_error *err)
{
    wt_status status = WT_OK;
    size_t number = 0;
    for (int section = 0; section < PAGE_SECTIONS && status == WT_OK; section++)
        status = page_section_write(page, (page_section)section, &number, err);
    if (number > 0) {
        text_add(&page->out, "<p class=\"source\">");
        text_add(&page->out, "The scripts are of gnuplot, and load ");
        text_buffer output = {0};
        text_add(&output, embedded_file_text("output.gnuplot"));
        add_file(page, "style", "gp", page->style);
        text_add(&page->out, " and ");
        add_file(page, "output", "gp", &output);
        text_add(&page->out, ".</p>\n");
        text_free(&output);
    }
    return status;
}

/* Returns the title of the case, or else the table that depends on all others, the first main
 * figure, or the first table. */
static const char *page_title(const page_writer *page)
{
    const char *title = answer_key_text(&page->tables->answer, ANSWER_KEY_CASE_TITLE);
    if (title != NULL && title[0] != '\0')
        return title;
    const table_view *const asked[] = {&page->tables->validation, &page->tables->collection,
                                       &page->tables->comparison, &page->tables->layer,
                                       &page->tables->friction};
    for (size_t i = 0; i < COUNT_OF(asked); i++)
        if (asked[i]->n_rows > 0)
            return asked[i]->schema->title;
    for (int in_depth = 0; in_depth < 2; in_depth++)
        for (size_t i = 0; i < page->n_figures; i++)
            if (page->figures[i].svg.length > 0 &&
                page->figures[i].drawing.figure->in_depth == in_depth)
                return page->figures[i].drawing.figure->title;
    if (wt_result_n_tables(page->result) == 0)
        return "Nothing was answered";
    const wt_table *first = wt_result_table(page->result, 0);
    title = wt_table_title(first);
    return title[0] != '\0' ? title : wt_table_name(first);
}

wt_status page_write(page_writer *page, wt_error *err)
{
    // The body comes first, as the table of contents depends on it.
    text_buffer body = {0};
    page_cards(page);
    page_rows(page);
    page_failures(page);
    page_summary(page);
    wt_status status = page_sections(page, err);
    if (status == WT_OK) {
        page_results(page);
        page_indentation(page);
        page_inputs(page);
        page_cost(page);
        page_record(page);
        body = page->out;
        page->out = (text_buffer){0};
        page_head(page, page_title(page));
        text_bytes(&page->out, text_string(&body), body.length);
        text_add(&page->out, "</main>\n</body>\n</html>\n");
    }
    text_free(&body);
    text_free(&page->contents);
    return status;
}
