/* Writes the page of a report: frame, answer, main numbers, figures, inputs, failures, cost and
 * provenance.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "core/table/finding.h"
#include "core/table/result_row.h"
#include "report/report_files.h"
#include "report/report_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- main numbers ---------------------------------------------------------------------------- */

enum { CARDS = 4, PARTS = 5 }; /* on the first screen */

/* Writes the name of a row as a heading. A name of a file is not changed. */
static void write_heading(page_writer *page, const result_row *row)
{
    if (strchr(row->name, '.') == NULL)
        text_sentence(&page->out, row->name);
    else
        text_html(&page->out, "%s", row->name);
}

/* Returns the row after the parts of a row. */
static size_t end_of_parts(const result_rows *list, size_t first)
{
    size_t end = first + 1;
    while (end < list->n && list->rows[end].level > 0)
        end++;
    return end;
}

static void write_parts(page_writer *page, const result_rows *list, size_t from, size_t to)
{
    text_add(&page->out, "<ul>\n");
    for (size_t i = from; i < to; i++) {
        const result_row *const row = &list->rows[i];
        const row_number_text number = row_number_format(&row->number);
        const bool alone = isnan(row->number.value) && number.interval[0] != '\0';
        const char *const known = alone ? number.interval : number.value,
                          *const value = row->kind == RESULT_ROW_TEXT ? row->text : known;
        text_add(&page->out, "<li>");
        write_heading(page, row);
        text_add(&page->out, value[0] != '\0' ? ": " : "");
        text_typographic(&page->out, value);
        if (row->kind == RESULT_ROW_NUMBER && !alone && number.interval[0] != '\0') {
            text_add(&page->out, " (");
            text_typographic(&page->out, number.interval);
            text_add(&page->out, ")");
        }
        text_html(&page->out, "%s", row->note[0] == '\0' ? "" : value[0] != '\0' ? "; " : ": ");
        text_typographic(&page->out, row->note);
        text_add(&page->out, "</li>\n");
    }
    text_add(&page->out, "</ul>\n");
}

/* True if the first reason of a row explains its verdict. */
static bool has_reason(const result_row *row)
{
    return row->kind == RESULT_ROW_TEXT && row->reasons[0].text != NULL;
}

/* The reason of a verdict is on its card, the others are folded. */
static void write_reasons(page_writer *page, const result_row *row)
{
    const size_t first = has_reason(row) ? 1 : 0;
    if (first > 0)
        page_reason(page, row->reasons[0].text);
    if (first == RESULT_ROW_REASONS || row->reasons[first].text == NULL)
        return;
    text_add(&page->out, "<details><summary>Why</summary>\n");
    for (size_t i = first; i < RESULT_ROW_REASONS && row->reasons[i].text != NULL; i++) {
        text_html(&page->out, "<p>%s: ", row->reasons[i].heading);
        text_typographic(&page->out, row->reasons[i].text);
        text_add(&page->out, "</p>\n");
    }
    text_add(&page->out, "</details>\n");
}

static void write_row_card(page_writer *page, const result_rows *list, size_t first, size_t end)
{
    const result_row *const row = &list->rows[first];
    text_html(&page->out, "<section class=\"finding%s\">\n<h2>", row->open ? " v-open" : "");
    write_heading(page, row);
    text_add(&page->out, "</h2>\n");
    if (row->kind == RESULT_ROW_TEXT) {
        text_add(&page->out, "<p class=\"verdict\"><strong>");
        text_typographic(&page->out, row->text);
        text_add(&page->out, "</strong></p>\n");
    } else {
        page_large_number(page, &row->number, NULL, (double)NAN);
    }
    /* the reason of a verdict is more complete than its note */
    if (row->note[0] != '\0' && !has_reason(row)) {
        text_add(&page->out, "<p>");
        text_sentence(&page->out, row->note);
        text_add(&page->out, "</p>\n");
    }
    if (end > first + 1)
        write_parts(page, list, first + 1, end);
    write_reasons(page, row);
    text_add(&page->out, "</section>\n");
}

static void write_cell(page_writer *page, const char *label, const char *text)
{
    text_html(&page->out, "<td data-label=\"%s\">", label);
    text_typographic(&page->out, text);
    text_add(&page->out, "</td>");
}

static void begin_row_table(page_writer *page, const char *caption)
{
    static const char *const headings[] = {"Quantity", "Value", "95 % interval", "Model choices",
                                           "Note"};
    text_add(&page->out, "<table class=\"few main\">\n<caption>");
    text_typographic(&page->out, caption);
    text_add(&page->out, "</caption>\n<thead><tr>");
    for (size_t i = 0; i < sizeof headings / sizeof *headings; i++)
        text_html(&page->out, "<th scope=\"col\">%s</th>", headings[i]);
    text_add(&page->out, "</tr></thead>\n<tbody>\n");
}

/* Writes the rows that are on no card; `shown` NULL: all with a value. */
static void write_row_table(page_writer *page, const result_rows *list, const bool *shown,
                            const char *caption)
{
    bool any = false;
    for (size_t i = 0; i < list->n; i++) {
        const result_row *const row = &list->rows[i];
        const bool is_text = row->kind == RESULT_ROW_TEXT;
        if (shown != NULL ? shown[i] : is_text && row->text[0] == '\0')
            continue;
        if (!any)
            begin_row_table(page, caption);
        any = true;
        const row_number_text number = row_number_format(&row->number);
        text_add(&page->out, row->level > 0 ? "<tr><th scope=\"row\" class=\"part\">"
                                            : "<tr><th scope=\"row\">");
        write_heading(page, row);
        text_add(&page->out, "</th>");
        write_cell(page, "Value", is_text ? row->text : number.value);
        write_cell(page, "95 % interval", is_text ? "" : number.interval);
        write_cell(page, "Model choices", is_text ? "" : number.range);
        write_cell(page, "Note", row->note);
        text_add(&page->out, "</tr>\n");
    }
    if (any)
        text_add(&page->out, "</tbody>\n</table>\n");
}

/* True if the cards of the findings are on the page. */
static bool has_findings(const page_writer *page)
{
    result_value_tables tables;
    finding findings[FINDING_QUESTIONS];
    return result_values_bind(page->result, &tables, NULL) == WT_OK &&
           (findings_compute(&tables, findings) || findings_are_stated(&page->tables->answer));
}

/* Main numbers of one section of a case, with the texts of the terminal; nothing if it has none. */
static void page_section_rows(page_writer *page, page_section section)
{
    static const result_subject subjects[PAGE_SECTIONS] = {
        [SECTION_INDENTATION] = SUBJECT_CURVES, [SECTION_MATERIAL] = SUBJECT_MATERIAL,
        [SECTION_SURFACE] = SUBJECT_SURFACE,    [SECTION_FRICTION] = SUBJECT_FRICTION,
        [SECTION_LAYER] = SUBJECT_LAYER,        [SECTION_COLLECTION] = RESULT_SUBJECTS,
        [SECTION_UNCERTAINTY] = RESULT_SUBJECTS};
    result_rows list;
    if (subjects[section] == RESULT_SUBJECTS || !has_findings(page))
        return;
    result_rows_of_subject(page->result, subjects[section], &list);
    text_buffer caption = {0};
    text_add(&caption, "Main numbers");
    if (list.heading[0] != '\0')
        text_format(&caption, ": %s", list.heading);
    write_row_table(page, &list, NULL, text_string(&caption));
    text_free(&caption);
    result_rows_clear(&list);
}

/* Cards of a result that answers none of the questions of a case, and a table of what does not fit
 * on them. */
static void page_rows(page_writer *page)
{
    result_rows list;
    if (has_findings(page))
        return;
    result_rows_compute(page->result, &list);
    bool *const shown = wt_alloc(list.n + 1, sizeof *shown);
    size_t n_cards = 0;
    for (size_t i = 0, end; i < list.n && n_cards < CARDS; i = end, n_cards++) {
        end = end_of_parts(&list, i);
        if (n_cards == 0)
            text_add(&page->out, "<div class=\"findings\">\n");
        const size_t last = end - i - 1 <= PARTS ? end : i + 1; /* many parts are a table */
        write_row_card(page, &list, i, last);
        for (size_t k = i; k < last; k++)
            shown[k] = true;
    }
    if (n_cards > 0)
        text_add(&page->out, "</div>\n");
    write_row_table(page, &list, shown, "Further numbers");
    free(shown);
    result_rows_clear(&list);
}

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
