/* The page of a report: index.html, self-contained and well-formed XML as well as HTML.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_PAGE_H
#define WT_REPORT_PAGE_H

#include "report/drawing.h"

/* A figure that this library knows, drawn or not. */
typedef struct drawn_figure {
    figure_drawing drawing;        /* zeroed if the result does not have its table */
    text_buffer data, script, svg; /* of the page; empty if there was nothing to draw */
} drawn_figure;

typedef struct page_writer {
    text_buffer out;
    text_buffer contents; /* list of the headings so far */
    const wt_result *result;
    const figure_tables *tables;
    const language *language; /* NULL: English */
    const text_buffer *style; /* that the scripts load */
    const char *font;         /* of the figures; NULL: that of the style */
    bool with_provenance;
    const drawn_figure *figures;
    size_t n_figures;
} page_writer;

/* Writes the whole page to page->out. WT_E_MEMORY, or WT_E_TOOL if a picture is no SVG. */
wt_status page_write(page_writer *page, wt_error *err) WT_NODISCARD;

/* ---- parts, each nothing without its tables -------------------------------------------------- */
void page_numbers(page_writer *page);     /* the headline numbers */
void page_results(page_writer *page);     /* the tables of results */
void page_indentation(page_writer *page); /* how it was indented, curves rejected */
void page_failures(page_writer *page);    /* what could not be read or computed */
void page_inputs(page_writer *page);      /* inputs, notes */
void page_cost(page_writer *page);
void page_record(page_writer *page); /* case file, provenance */

/* ---- what the parts share -------------------------------------------------------------------- */

/* A section heading with an anchor; it is listed in the contents. */
void page_heading(page_writer *page, const char *id, const char *words);
/* A part that is folded, with an anchor, listed in the contents, too. On paper it is either
 * unfolded or only named. page_fold_end ends it. */
typedef enum page_on_paper { PAGE_PRINTED, PAGE_UNPRINTED } page_on_paper;
void page_fold(page_writer *page, const char *id, const char *words, page_on_paper on_paper);
void page_fold_end(page_writer *page);
/* An HTML table of some columns and rows; headings and units as the schema says. Without columns it
 * has all that have a label, without rows all of the table. `caption` is plain text. */
void page_table(page_writer *page, const table_view *table, const char *caption,
                const unsigned *columns, size_t n_columns, const size_t *rows, size_t n_rows);
/* The same with all rows, nothing if there is none. */
void page_whole_table(page_writer *page, const table_view *table, const char *caption,
                      const unsigned *columns, size_t n_columns);
/* The keys of a table as name, value, statistical and numerical error; nothing if it has none. */
void page_keys(page_writer *page, const table_view *table, const char *caption);

/* One line of such a table. The statistical error is `interval` (plain text) if that is not NULL.
 */
void page_estimates_begin(page_writer *page, const char *caption, bool remarks);
void page_estimate(page_writer *page, const char *words, const wt_estimate *estimate,
                   wt_quantity quantity, const char *interval, const char *remark);
void page_table_end(page_writer *page);

#endif
