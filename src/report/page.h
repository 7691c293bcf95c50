/* The page of a report: index.html, self-contained and well-formed XML as well as HTML.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_PAGE_H
#define WT_REPORT_PAGE_H

#include "report/text.h"
#include "report/units.h"
#include "weartrack/report.h"

/* A figure that was drawn, or one that could not be. */
typedef struct wt_page_figure {
    const wt_figure_info *info;
    const char *caption; /* plain text */
    const char *omitted; /* why it is not there ("" = not worth a word), NULL if it is */
    const char *svg;
    size_t svg_length;
    double width; /* in panels */
} wt_page_figure;

typedef struct wt_page {
    wt_text out;
    wt_text contents; /* list of the headings so far */
    const wt_result *result;
    bool with_provenance;
    const wt_page_figure *figures;
    size_t n_figures;
} wt_page;

/* Writes the whole page to page->out. WT_E_MEMORY, or WT_E_TOOL if a picture is no SVG. */
wt_status wt_page_write(wt_page *page, wt_error *err) WT_NODISCARD;

/* ---- parts, each nothing without its tables -------------------------------------------------- */
void wt_page_numbers(wt_page *page);     /* the headline numbers */
void wt_page_results(wt_page *page);     /* the tables of results */
void wt_page_indentation(wt_page *page); /* how it was indented, curves rejected */
void wt_page_inputs(wt_page *page);      /* inputs, failures, notes */
void wt_page_cost(wt_page *page);
void wt_page_record(wt_page *page); /* case file, provenance */

/* ---- what the parts share -------------------------------------------------------------------- */

typedef struct wt_page_column {
    const char *name;    /* of the column in the table */
    const char *heading; /* NULL = its long name */
    const char *like;    /* takes the unit of this column, NULL = its own */
    const char *missing; /* shown for NaN, NULL = a dash */
    bool yes_no;         /* 1 and 0 */
} wt_page_column;

/* A section heading with an anchor; it is listed in the contents. */
void wt_page_heading(wt_page *page, const char *id, const char *words);
/* An HTML table of some columns (those the table has) and rows (rows NULL = all n of the table);
 * numbers in lab units. `caption` is plain text. */
void wt_page_table(wt_page *page, const wt_table *table, const char *caption,
                   const wt_page_column *columns, size_t n_columns, const size_t *rows,
                   size_t n_rows);
/* The keys of a table as name, value, statistical and numerical error; nothing if it has none. */
void wt_page_keys(wt_page *page, const wt_table *table, const char *caption);

/* One line of such a table. The statistical error is `interval` (plain text) if that is not NULL.
 */
void wt_page_estimates_begin(wt_page *page, const char *caption, bool remarks);
void wt_page_estimate(wt_page *page, const char *words, const wt_estimate *estimate,
                      const char *quantity, const char *interval, const char *remark);
void wt_page_estimates_end(wt_page *page);
/* "low to high unit" in the lab unit of `value`. */
void wt_page_interval(wt_text *text, double low, double high, double value, const char *unit,
                      const char *quantity);

#endif
