/* Writes inputs, failures, notes, cost, case file and provenance on the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"

void page_failures(page_writer *page)
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

void page_inputs(page_writer *page)
{
    const figure_tables *t = page->tables;
    folded_table(page, "inputs", "Inputs", &t->inputs, "Files read, with their digests");
    folded_table(page, "methods", "Methods", &t->methods,
                 "Methods, what they did here (±: standard error), and where they are described");
    folded_table(page, "notes", "Notes", &t->notes, "Notes and warnings");
}

void page_cost(page_writer *page)
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

void page_record(page_writer *page)
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
