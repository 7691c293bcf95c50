/* Declares the state of the scan of a text, for the files that process header lines, names and
 * rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_SCANNER_H
#define WT_READ_TEXT_SCANNER_H

#include "read/text/text.h"

typedef enum scan_state {
    SCAN_HEADER, /* no table is open */
    SCAN_UNITS,  /* the names row was read, the units line follows */
    SCAN_ROWS
} scan_state;

/* The format of the last cells of the rows of a table. */
typedef struct last_cell_stats {
    size_t n;                        /* number of rows with a non-empty last cell */
    size_t cells_min;                /* minimum number of cells in a row */
    size_t short_rows;               /* number of rows without a cell for every column */
    bool empty;                      /* true if one is empty */
    size_t shortest, longest;        /* length [byte] */
    size_t digits_min, exponent_min; /* minimum digits of mantissa and exponent */
    size_t tail_min, tail_max;       /* characters from the decimal point on */
    bool points, exponents;          /* true if one has a decimal point, an exponent */
} last_cell_stats;

typedef enum last_row_state { LAST_ROW_NONE, LAST_ROW_KEPT, LAST_ROW_DROPPED } last_row_state;

typedef struct text_scanner {
    text_file *file;
    const text_description *d;
    const wt_read_options *options;
    wt_log *log;
    wt_error *err;
    wt_status status; /* first failure, which ends the scan */
    unsigned kinds;
    bool halts; /* true if the scan stops at the beginning of a step */
    bool ended; /* true after the last line */
    size_t i;   /* index of the current line */
    text_span line;
    bool comment; /* true if the line is a comment */
    scan_state state;
    names_row names;
    text_cells row;
    text_table *table; /* open or last table; NULL before the first */
    text_header header;
    char decimal;             /* declared by the file, or '\0' */
    cell_separator separator; /* declared by the file, or SEPARATOR_AUTO */
    char gathered[4096];      /* names listed one per line, separated by tabs */
    size_t n_gathered;
    char title[96];
    size_t step_line;
    bool title_next;     /* true if the next line is the title of the step */
    bool step_has_table; /* true if the step has a names row */
    bool blank;          /* true if the previous line was blank */
    bool comment_names;  /* true if the names row is in a comment */
    bool snapshot;       /* true if the table has the header values */
    unsigned char kind;  /* segment kind of the rows after a marker */
    size_t block;
    size_t group_hash; /* hash of the cells whose change begins a block */
    bool has_group;
    size_t row_line;                /* line of the last row; 0 before the first */
    size_t n_declared, n_rows;      /* rows that the header states (0: none), and rows read since */
    size_t sample;                  /* sample of the header, or NO_SAMPLE */
    bool has_sample_name;           /* true if the header named the sample since the last table */
    last_cell_stats last;           /* formats in the table */
    double last_number;             /* number of the previous row; NaN if absent */
    bool last_is_short;             /* true if the previous line was the first incomplete row */
    last_row_state last_row;        /* treatment of a last line without a line end */
    bool unclosed;                  /* true if a step or table lacks its required end line */
    bool reads_conditions;          /* true if lines above a table can state its temperature */
    bool continues_table;           /* true if rows under another condition follow */
    bool has_condition;             /* true if such a line was read since the last table */
    text_condition title_condition; /* of the last line that was not blank */
} text_scanner;

/* Scans from line s->i to the end. If the scan stops at steps, it ends after a line that begins a
 * step after a table. */
void scan_lines(text_scanner *s);

/* ---- text_above.c: conditions above and below the names row -----------------------------------
 */

/* True if the line states the temperature or frequency of the following rows, or of the columns
 * below its cells. Sets continues_table if the following rows belong to another table. */
bool scan_read_condition_line(text_scanner *s);
/* Applies the condition in the line above the names row, if no line stated one. */
void scan_apply_title(text_scanner *s);
/* Reads the conditions of a row of cells; an empty cell has that of the cell before it. Returns the
 * number of cells with a condition; 0 if another cell is neither empty nor the label of the row. */
size_t cells_read_conditions(const text_description *d, const text_cells *cells,
                             text_condition *conditions);

/* True if the row of a last line without a line end is as complete as the rows before it. */
bool truncation_row_is_complete(const text_scanner *s);
/* Checks that a table or step ends as required. */
void truncation_check_table_end(text_scanner *s);
/* Reports signs of truncation after all lines are read, and drops an incomplete last row. */
void truncation_report(text_scanner *s);

/* ---- text_header.c: lines before, between and after tables ----------------------------------- */

/* Reads the header values of the line. */
void scan_header_fields(text_scanner *s);
/* True if the line is a marker of a step, an end or a segment. */
bool scan_match_markers(text_scanner *s);
/* Stores the title of a step without a names row. */
void scan_finish_step(text_scanner *s);

/* Warns if fewer rows exist than the header states, and resets the counts. */
void scan_check_row_count(text_scanner *s);

/* ---- text_rows.c ----------------------------------------------------------------------------- */

typedef enum row_quality {
    ROW_GOOD,
    ROW_BROKEN, /* some cells are numbers, at least one is not */
    ROW_TEXT,   /* no number in the columns that are read */
    ROW_UNUSED  /* the columns that are read are empty, as in rows of a waveform */
} row_quality;

/* Splits the line into s->row and reserves a row of the table. */
void scan_split_row(text_scanner *s);
/* Reads the cells of s->row into the next row of the table; *bad is the first invalid column. */
row_quality scan_read_row(text_scanner *s, size_t *bad);
/* Adds the row that was read to the table. */
void scan_add_row(text_scanner *s);
/* Returns the index of a name in the list of samples and adds it if necessary. NO_SAMPLE for a
 * blank name or a full list. */
size_t scan_find_sample(text_scanner *s, text_span name);
/* Fails for an unreadable row. */
void scan_fail_row(text_scanner *s, size_t bad);

#endif
