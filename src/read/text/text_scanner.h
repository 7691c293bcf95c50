/* Where the walk over a text stands, for the files that read header lines, names and rows.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_SCANNER_H
#define WT_READ_TEXT_SCANNER_H

#include "read/text/text.h"

typedef enum scan_state {
    SCAN_HEADER, /* no table is open */
    SCAN_UNITS,  /* the names row was read, the line of units comes */
    SCAN_ROWS
} scan_state;

/* How the last cells of the rows of a table are written. */
typedef struct last_cells {
    size_t n;                        /* rows with one that is not empty */
    size_t cells_min;                /* of a row */
    size_t short_rows;               /* without a cell for every column that is read */
    bool empty;                      /* one is */
    size_t shortest, longest;        /* [bytes] */
    size_t digits_min, exponent_min; /* digits without those of the exponent, and those */
    bool points, exponents;          /* one has them */
} last_cells;

typedef enum cut_row { CUT_NO_ROW, CUT_ROW_KEPT, CUT_ROW_DROPPED } cut_row;

typedef struct text_scanner {
    text_file *file;
    const text_description *d;
    const wt_read_options *options;
    wt_log *log;
    wt_error *err;
    wt_status status; /* the first failure, which ends the walk */
    unsigned kinds;
    bool halts; /* where a step begins */
    bool ended; /* there are no more lines */
    size_t i;   /* the line that is read, counted from 0 */
    text_span line;
    bool comment; /* it is one */
    scan_state state;
    names_row names;
    text_cells row;
    text_table *table; /* the open one, or the last one; NULL before the first */
    text_header header;
    char decimal;             /* as declared by the file, or '\0' */
    cell_separator separator; /* as declared by the file, or SEPARATOR_AUTO */
    char gathered[4096];      /* names that stand in lines of their own, parted by tabs */
    size_t n_gathered;
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
    size_t n_said, n_rows; /* rows that the header says, 0: nothing, and that came since */
    size_t sample;         /* of the header, or NO_SAMPLE */
    bool sample_is_told;   /* since the last table */
    last_cells last;       /* of the table */
    double last_number;    /* of the row before, NaN if it has none */
    bool last_is_short;    /* the line before was a row, the first without all cells */
    cut_row cut;           /* what was done with a last line without its line end */
    bool unclosed;         /* a step or table has not come to the line that must end it */
} text_scanner;

/* From line s->i to the end, or, if it halts, behind a line with which a step begins after a table.
 */
void scan_walk(text_scanner *s);

/* Takes down how the row that was read is written. */
void cut_watch(text_scanner *s);
/* Whether the row, on a last line without a line end, is as whole as those before it. */
bool cut_is_whole(const text_scanner *s);
/* A table or a step ends here, or should have. */
void cut_check_end(text_scanner *s);
/* What speaks for a file that was cut off, when all lines are read: takes an incomplete row back.
 */
void cut_finish(text_scanner *s);

static inline void scan_no_memory(text_scanner *s)
{
    s->status = wt_fail(s->err, WT_E_MEMORY, "no memory for the tables of the file");
}

#endif
