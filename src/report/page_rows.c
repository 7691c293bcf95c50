/* Writes the main numbers of a result that answers none of the questions of a case: the first ones
 * as cards, the others as a table. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/table/finding.h"
#include "core/table/result_row.h"
#include "report/report_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

void page_section_rows(page_writer *page, page_section section)
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

void page_rows(page_writer *page)
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
