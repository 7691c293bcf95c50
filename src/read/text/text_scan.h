/* The walk over a text, shared by the files that read header lines, names and rows.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_SCAN_H
#define WT_READ_TEXT_SCAN_H

#include "read/text/text.h"

typedef enum scan_state {
    SCAN_HEADER, /* no table is open */
    SCAN_UNITS,  /* the names row was read, the line of units comes */
    SCAN_ROWS
} scan_state;

typedef struct wt_scan {
    wt_text_file *file;
    const wt_description *d;
    const wt_read_options *options;
    wt_parselog *log;
    wt_error *err;
    unsigned kinds;
    scan_state state;
    wt_names names;
    wt_cells row;
    wt_text_table *table; /* the open one, or the last one; NULL before the first */
    wt_text_header header;
    char decimal;           /* as declared by the file, or '\0' */
    wt_separator separator; /* as declared by the file, or WT_SEPARATOR_AUTO */
    char title[96];
    size_t step_line;
    bool title_next;     /* the next line is the title of the step */
    bool step_has_table; /* the current step has shown its names row */
    bool blank;          /* the line before was blank */
    bool comment_names;  /* the names row stands in a comment */
    bool snapshot;       /* the header values are in the table */
    unsigned char kind;  /* of the rows after a marker */
    size_t block;
    size_t group_hash; /* of the cells whose change begins a block */
    bool has_group;
} wt_scan;

typedef enum wt_row_is {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, one is not */
    ROW_TEXT    /* no number where numbers belong */
} wt_row_is;

wt_status wt_scan_no_memory(wt_scan *s);
/* Is the text, normalised, that word? */
bool wt_scan_same_word(const char *text, size_t length, const char *word);

/* ---- text_header.c ------------------------------------------------------------------------ */

/* Header values on a line. */
wt_status wt_scan_fields(wt_scan *s, size_t line_number, const char *line, size_t length);
/* Step, end and segment markers. *is says whether the line is one. */
wt_status wt_scan_marks(wt_scan *s, size_t line_number, const char *line, size_t length, bool *is);
/* A step that never showed a names row is remembered by its title. */
wt_status wt_scan_finish_step(wt_scan *s);
void wt_scan_close(wt_scan *s);

/* ---- text_rows.c -------------------------------------------------------------------------- */

/* Room for one more row. */
wt_status wt_scan_grow(wt_scan *s);
/* Reads the cells of s->row into the next row of the table; *bad is the first cell at fault. */
wt_row_is wt_scan_read_row(wt_scan *s, size_t *bad);
/* Keeps the row that was read. */
wt_status wt_scan_add_row(wt_scan *s, size_t line_number);
/* The error for a row that cannot be read. */
wt_status wt_scan_bad_row(wt_scan *s, size_t line_number, size_t bad);

#endif
