/* The record on the page: inputs, what failed, notes, cost, case file, provenance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "report/cells.h"

#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const page_column input_columns[] = {
    {"path", "File", NULL, NULL, false},      {"role", "Role", NULL, NULL, false},
    {"format", "Format", NULL, NULL, false},  {"bytes", "Size", NULL, NULL, false},
    {"sha256", "SHA-256", NULL, NULL, false},
};

static const page_column failure_columns[] = {
    {"file", "File", NULL, NULL, false},
    {"message", "What happened", NULL, NULL, false},
};

static const page_column note_columns[] = {
    {"severity", "Severity", NULL, NULL, false}, {"file", "File", NULL, NULL, false},
    {"place", "Place", NULL, NULL, false},       {"text", "Note", NULL, NULL, false},
    {"count", "Times", NULL, NULL, false},
};

static const wt_table *filled(const page_writer *page, const char *name)
{
    const wt_table *table = wt_result_find(page->result, name);
    return table != NULL && wt_table_n_rows(table) > 0 ? table : NULL;
}

void page_inputs(page_writer *page)
{
    const wt_table *failures = filled(page, "failures"), *inputs = filled(page, "inputs"),
                   *notes = filled(page, "notes");
    if (failures != NULL) {
        page_heading(page, "failures", "Failures");
        page_table(page, failures, "What could not be read or computed", failure_columns,
                   COUNT(failure_columns), NULL, wt_table_n_rows(failures));
    }
    if (inputs != NULL) {
        page_heading(page, "inputs", "Inputs");
        page_table(page, inputs, "Files read, with their digests", input_columns,
                   COUNT(input_columns), NULL, wt_table_n_rows(inputs));
    }
    if (notes != NULL) {
        page_heading(page, "notes", "Notes of reading and fitting");
        page_table(page, notes, "Notes and warnings", note_columns, COUNT(note_columns), NULL,
                   wt_table_n_rows(notes));
    }
}

/* Columns of times come last: without provenance they are left out, as they never repeat. */
static const page_column cost_columns[] = {
    {"stage", "Stage", NULL, NULL, false},
    {"items", "Items", NULL, NULL, false},
    {"tolerance_asked", "Tolerance asked", NULL, NULL, false},
    {"error_estimated", "Error estimated", NULL, NULL, false},
    {"because", "Because", NULL, NULL, false},
    {"wall_time", "Wall time", NULL, NULL, false},
    {"cpu_time", "Processor time", "wall_time", NULL, false},
};

void page_cost(page_writer *page)
{
    const wt_table *table = filled(page, "cost");
    if (table == NULL)
        return;
    enum { STAGES = 64 };
    size_t rows[2][STAGES], n[2] = {0, 0};
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        size_t out = cell_number(table, row, "runs") == 0;
        if (n[out] < STAGES)
            rows[out][n[out]++] = row;
    }
    page_heading(page, "cost", "Cost and error by stage");
    size_t columns = COUNT(cost_columns) - (page->with_provenance ? 0 : 2);
    if (n[0] > 0)
        page_table(page, table, "Stages that ran", cost_columns, columns, rows[0], n[0]);
    static const page_column left_out[] = {{"stage", "Stage", NULL, NULL, false},
                                           {"because", "Because", NULL, NULL, false}};
    if (n[1] > 0)
        page_table(page, table, "Stages left out", left_out, COUNT(left_out), rows[1], n[1]);
}

static void definition(page_writer *page, const char *term, const char *text)
{
    text_add(&page->out, "<dt>");
    text_html(&page->out, term);
    text_add(&page->out, "</dt><dd>");
    text_html(&page->out, text);
    text_add(&page->out, "</dd>\n");
}

void page_record(page_writer *page)
{
    size_t length = 0;
    const char *xml = wt_result_case(page->result, &length);
    if (xml != NULL && length > 0) {
        page_heading(page, "case", "Case file");
        text_add(&page->out, "<pre tabindex=\"0\"><code>");
        growing_text copy = {0}; // it need not end in zero
        text_bytes(&copy, xml, length);
        text_html(&page->out, text_string(&copy));
        page->out.failed = page->out.failed || copy.failed;
        text_free(&copy);
        text_add(&page->out, "</code></pre>\n");
    }
    const wt_provenance *provenance = wt_result_provenance_const(page->result);
    if (!page->with_provenance || provenance == NULL)
        return;
    page_heading(page, "provenance", "Provenance");
    text_add(&page->out, "<dl>\n");
    growing_text version = {0};
    text_format(&version, "weartrack %s", wt_version());
    definition(page, "Page written by", text_string(&version));
    page->out.failed = page->out.failed || version.failed;
    text_free(&version);
    if (wt_provenance_command(provenance)[0] != '\0')
        definition(page, "Command", wt_provenance_command(provenance));
    text_add(&page->out, "</dl>\n");
}
