/* The page of a report: a self-contained index.html that is well-formed XML as well as HTML.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_PAGE_H
#define WT_REPORT_PAGE_H

#include "core/table/result_row.h"
#include "core/table/result_value.h"
#include "report/drawing.h"

/* Definitions of the symbols of the first picture of a page, which all others share. They point
 * into that picture. */
typedef struct svg_symbols {
    const char *text; /* NULL before the first picture */
    size_t length;
} svg_symbols;

/* Appends the <svg> element of `svg` to a page, without XML declaration. The element has the id
 * "picture-NAME". Ids and references within it have the prefix `id`, so that they are unique.
 * Titles of gnuplot, which would appear as tool tips, are removed. `label` is the accessible name.
 * Its size is limited so that its type is not larger than that of the page. Returns false if there
 * is no <svg>. `symbols` is zero before the first picture of the page. */
bool svg_append_inline(text_buffer *page, const char *svg, size_t length, const char *name,
                       const char *id, const char *label, svg_symbols *symbols);

/* Reads width and height of a picture in its own units. False if it does not state them. */
bool svg_canvas_size(const char *svg, size_t length, double size[2]);

/* A figure of the library, drawn or not. */
typedef struct drawn_figure {
    figure_drawing drawing;        /* zero if the result does not have its table */
    text_buffer data, script, svg; /* for the page; empty if there was nothing to draw */
} drawn_figure;

typedef struct page_writer {
    text_buffer out;
    text_buffer contents; /* list of the headings so far */
    const wt_result *result;
    const figure_tables *tables;
    const text_buffer *style; /* style that the scripts load */
    const char *font;         /* font of the figures; NULL: that of the style */
    bool with_provenance;
    svg_symbols symbols; /* of all figures */
    const drawn_figure *figures;
    size_t n_figures;
} page_writer;

/* Writes the whole page to page->out. WT_E_MEMORY, or WT_E_TOOL if a picture is not SVG. */
wt_status page_write(page_writer *page, wt_error *err) WT_NODISCARD;

/* ---- parts; each is empty without its tables ---------------------------------------------------
 */
void page_cards(page_writer *page);   /* findings, measured against predicted friction */
void page_summary(page_writer *page); /* remedies, limits, data used */
/* Conditions of a result and the data that it rests on, in one line below the title. */
void page_conditions(page_writer *page);
void page_results(page_writer *page);     /* result tables */
void page_indentation(page_writer *page); /* conditions of indentation, rejected curves */

/* Writes a number in large type, or smaller without an interval, and bars of its interval and range
 * on one axis, where a line marks the neutral value unless it is NaN. `unit` replaces the unit of
 * the number unless NULL. */
void page_large_number(page_writer *page, const row_number *number, const char *unit,
                       double neutral);

/* Writes a reason as a sentence; nothing for "". */
void page_reason(page_writer *page, const char *reason);

/* ---- shared by the parts ------------------------------------------------------------------------
 */

/* Writes a section heading with an anchor and lists it in the contents. */
void page_heading(page_writer *page, const char *id, const char *words);
/* Begins a folded part with an anchor, which is listed in the contents, too. On paper it is either
 * unfolded or only named. page_fold_end ends it. */
typedef enum page_print_mode { PAGE_PRINTED, PAGE_UNPRINTED } page_print_mode;
void page_fold(page_writer *page, const char *id, const char *words, page_print_mode on_paper);
void page_fold_end(page_writer *page);
/* Writes an HTML table of some columns and rows; headings and units follow the schema. columns
 * NULL: all with a label; rows NULL: all. `caption` is plain text. */
void page_table(page_writer *page, const table_view *table, const char *caption,
                const unsigned *columns, size_t n_columns, const size_t *rows, size_t n_rows);
/* Writes the table with all rows; nothing if there are none. */
void page_whole_table(page_writer *page, const table_view *table, const char *caption,
                      const unsigned *columns, size_t n_columns);
/* Writes the keys of a table as name, value, standard and numerical error; nothing if there are
 * none. */
void page_keys(page_writer *page, const table_view *table, const char *caption);

#endif
