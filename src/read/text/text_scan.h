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

typedef struct text_scanner {
    text_file *file;
    const text_description *d;
    const wt_read_options *options;
    wt_parselog *log;
    wt_error *err;
    wt_status status; /* the first failure, which ends the walk */
    unsigned kinds;
    size_t i; /* the line that is read, counted from 0 */
    text_span line;
    bool comment; /* it is one */
    scan_state state;
    names_row names;
    text_cells row;
    text_table *table; /* the open one, or the last one; NULL before the first */
    text_header header;
    char decimal;             /* as declared by the file, or '\0' */
    cell_separator separator; /* as declared by the file, or SEPARATOR_AUTO */
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
} text_scanner;

typedef enum row_quality {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, one is not */
    ROW_TEXT    /* no number where numbers belong */
} row_quality;

static inline void scan_no_memory(text_scanner *s)
{
    s->status = wt_fail(s->err, WT_E_MEMORY, "no memory for the tables of the file");
}

/* ---- text_header.c ------------------------------------------------------------------------ */

/* Header values on the line. */
void scan_fields(text_scanner *s);
/* Is the line a marker of a step, an end or a segment? */
bool scan_marks(text_scanner *s);
/* A step that never showed a names row is remembered by its title. */
void scan_finish_step(text_scanner *s);

/* ---- text_rows.c -------------------------------------------------------------------------- */

/* Splits the line into s->row and makes room for it in the table; false on failure. */
bool scan_split_row(text_scanner *s);
/* Reads the cells of s->row into the next row of the table; *bad is the first cell at fault. */
row_quality scan_read_row(text_scanner *s, size_t *bad);
/* Keeps the row that was read. */
void scan_add_row(text_scanner *s);
/* Fails for a row that cannot be read. */
void scan_bad_row(text_scanner *s, size_t bad);

#endif
