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

void page_value(page_writer *page, const char *value, const char *unit, bool has_interval)
{
    const size_t n = strcspn(value, " ");       /* the unit is behind the first blank */
    if (strpbrk(value, "0123456789") == NULL) { /* such as "not known" */
        text_html(&page->out, "<p class=\"verdict\"><strong>%s</strong></p>\n", value);
        return;
    }
    char number[sizeof((row_number_text *)0)->value];
    (void)snprintf(number, sizeof number, "%.*s", (int)n, value);
    text_add(&page->out, has_interval ? "<p class=\"number\">" : "<p class=\"number plain\">");
    text_typographic(&page->out, number);
    text_add(&page->out, " <span class=\"unit\">");
    text_typographic(&page->out, unit != NULL ? unit : value[n] != '\0' ? value + n + 1 : "");
    text_add(&page->out, "</span></p>\n");
}

static void write_row_bar(page_writer *page, const char *name, const char *class,
                          const row_number *number, const char *limits, double low, double high)
{
    const double none = (double)NAN;
    const result_value axis = {.number = {number->value, none, none, number->unit},
                               .low = number->low,
                               .high = number->high,
                               .neutral = none,
                               .range = {.low = number->range_low, .high = number->range_high}};
    page_bar(page, name, class, limits, &axis, low, high);
}

static void write_parts(page_writer *page, const result_rows *list, size_t from, size_t to)
{
    text_add(&page->out, "<ul>\n");
    for (size_t i = from; i < to; i++) {
        const result_row *const row = &list->rows[i];
        const row_number_text number = row_number_format(&row->number);
        const char *const value = row->kind == RESULT_ROW_TEXT ? row->text : number.value;
        text_add(&page->out, "<li>");
        write_heading(page, row);
        text_add(&page->out, value[0] != '\0' ? ": " : "");
        text_typographic(&page->out, value);
        if (row->kind == RESULT_ROW_NUMBER && number.interval[0] != '\0') {
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
    const row_number_text number = row_number_format(&row->number);
    text_add(&page->out, "<section class=\"finding\">\n<h2>");
    write_heading(page, row);
    text_add(&page->out, "</h2>\n");
    if (row->kind == RESULT_ROW_TEXT) {
        text_add(&page->out, "<p class=\"verdict\"><strong>");
        text_typographic(&page->out, row->text);
        text_add(&page->out, "</strong></p>\n");
    } else {
        page_value(page, number.value, NULL, number.interval[0] != '\0');
        text_add(&page->out, "<dl>\n");
        write_row_bar(page, "95 % interval", "interval", &row->number, number.interval,
                      row->number.low, row->number.high);
        write_row_bar(page, "Model choices", "choices", &row->number, number.range,
                      row->number.range_low, row->number.range_high);
        text_add(&page->out, "</dl>\n");
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

/* Writes the rows that are on no card. */
static void write_row_table(page_writer *page, const result_rows *list, const bool *shown)
{
    bool any = false;
    for (size_t i = 0; i < list->n; i++) {
        if (shown[i])
            continue;
        if (!any)
            text_add(&page->out,
                     "<table class=\"few\" id=\"main\">\n<caption>Further numbers</caption>\n"
                     "<thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\">Value</th>"
                     "<th scope=\"col\">95 % interval</th><th scope=\"col\">Note</th></tr></thead>"
                     "\n<tbody>\n");
        any = true;
        const result_row *const row = &list->rows[i];
        const row_number_text number = row_number_format(&row->number);
        text_add(&page->out, "<tr><th scope=\"row\">");
        write_heading(page, row);
        text_add(&page->out, "</th>");
        write_cell(page, "Value", row->kind == RESULT_ROW_TEXT ? row->text : number.value);
        write_cell(page, "95 % interval", row->kind == RESULT_ROW_TEXT ? "" : number.interval);
        write_cell(page, "Note", row->note);
        text_add(&page->out, "</tr>\n");
    }
    if (any)
        text_add(&page->out, "</tbody>\n</table>\n");
}

void page_rows(page_writer *page)
{
    result_value_tables tables;
    finding findings[FINDING_QUESTIONS];
    result_rows list;
    if (result_values_bind(page->result, &tables, NULL) == WT_OK &&
        (findings_compute(&tables, findings) || findings_are_stated(&page->tables->answer)))
        return; /* the cards of the findings are on the page */
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
    write_row_table(page, &list, shown);
    free(shown);
    result_rows_clear(&list);
}
