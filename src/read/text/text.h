/* The engine that reads text exports as a description says: bytes to lines, lines to cells, cells
 * to tables in SI units, tables to force curves, sweeps and spectra.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_H
#define WT_READ_TEXT_H

#include "read/description/description.h"
#include "read/formats.h"

/* ---- lines -------------------------------------------------------------------------------- */

typedef struct wt_line {
    size_t start; /* offset in the text; a zero byte stands where the line ends */
    size_t length;
} wt_line;

/* A file as UTF-8 lines. */
typedef struct wt_lines {
    char *text;
    wt_line *lines;
    size_t n;
    const char *encoding; /* words: "UTF-16LE with byte order mark" */
    size_t n_replaced;    /* byte sequences that are no characters, now U+FFFD */
    bool odd_byte;        /* half a character of UTF-16 at the end was dropped */
} wt_lines;

wt_status wt_lines_decode(const unsigned char *bytes, size_t length, wt_encoding encoding,
                          wt_lines *lines, wt_error *err);
void wt_lines_free(wt_lines *lines);
const char *wt_lines_get(const wt_lines *lines, size_t i, size_t *length); /* zero-terminated */

/* ---- cells -------------------------------------------------------------------------------- */

typedef struct wt_cell {
    const char *text; /* borrowed from the line; without blanks and quotes around it */
    size_t length;
} wt_cell;

typedef struct wt_cells {
    wt_cell *cells;
    size_t n, capacity;
} wt_cells;

const char *wt_separator_name(wt_separator separator); /* "tab"; static */
/* Splits a line; WT_SEPARATOR_AUTO is not allowed here. False when out of memory. */
bool wt_cells_split(wt_cells *cells, const char *line, size_t length, wt_separator separator,
                    const wt_description *description);
bool wt_cells_blank(const wt_cells *cells);

typedef enum wt_cell_is { WT_CELL_NUMBER, WT_CELL_MISSING, WT_CELL_TEXT } wt_cell_is;
/* A number, an empty cell (also "--", "nan", 1e99 and what the description lists; *value is NaN) or
 * something else. */
wt_cell_is wt_cell_read(wt_cell cell, char decimal, const wt_description *description,
                        double *value);
/* Copies text for messages and tables: without control characters, cut at a whole character. */
void wt_text_copy(char *to, size_t size, const char *text, size_t length);
/* Counts cells with a decimal comma and with a point. */
void wt_cells_count_marks(const wt_cells *cells, size_t *commas, size_t *points);

/* ---- tables ------------------------------------------------------------------------------- */

typedef enum wt_column_problem {
    WT_COLUMN_GOOD,
    WT_COLUMN_NO_UNIT,  /* the file does not say the unit */
    WT_COLUMN_BAD_UNIT, /* the unit fits no quantity of that name */
    WT_COLUMN_UNCLEAR   /* the column that tells what it is (`with`) is not there */
} wt_column_problem;

/* A column of a table that is known by its name. */
typedef struct wt_text_column {
    size_t cell;
    wt_column_problem problem;
    const wt_column_rule *rule;
    double factor, offset; /* to SI, the sign of a negated column included */
    char name[64];         /* as exported, without a unit in it */
    char unit[32];         /* as exported or given, "" if none */
} wt_text_column;

typedef struct wt_text_header {
    double value[WT_HEADER_COUNT]; /* SI, NaN if not seen */
    bool fallback[WT_HEADER_COUNT];
} wt_text_header;

/* Rows under one names row. */
typedef struct wt_text_table {
    size_t names_line; /* counted from 1 */
    size_t step_line;  /* of the marker before it, 0 if none */
    char title[96];    /* of the step, "" if none */
    wt_separator separator;
    char decimal;
    size_t n_names;          /* cells of the names row */
    wt_text_column *columns; /* that are understood */
    size_t n_columns;
    wt_text_column *problems; /* columns with a problem */
    size_t n_problems;
    wt_quantity_set quantities;                  /* of `columns` */
    size_t group_cell, segment_cell, curve_cell; /* SIZE_MAX if not there */
    double *values;                              /* [n_rows][n_columns], NaN for an empty cell */
    size_t *blocks;       /* [n_rows] number that changes where a block begins */
    unsigned char *kinds; /* [n_rows] wt_segment_kind, or WT_ROW_KIND_NONE */
    size_t n_rows, capacity;
    wt_text_header header;
} wt_text_table;
#define WT_ROW_KIND_NONE 255u

typedef struct wt_text_value {
    char *text; /* as found, NULL if the line was not there */
    size_t line;
    char unit[32];
} wt_text_value;

/* Everything that a description finds in a file. */
typedef struct wt_text_file {
    const wt_description *description;
    const char *name;
    wt_lines lines;
    wt_text_table *tables;
    size_t n_tables, capacity;
    wt_text_value *values; /* [n_fields] of the description, as last seen */
    char **unknown;        /* names of columns that no rule knows, each once */
    size_t n_unknown;
    char **steps; /* titles of steps without a table, each once */
    size_t n_steps;
} wt_text_file;

/* Runs the description over the input. `kinds`: the names row of a table must suffice for one of
 * them. */
wt_status wt_text_scan(const wt_description *description, wt_input *input, unsigned kinds,
                       const wt_read_options *options, wt_parselog *log, wt_text_file *file,
                       wt_error *err);
void wt_text_file_free(wt_text_file *file);
/* The column of a quantity, or NULL; segment < 0: any. */
const wt_text_column *wt_text_table_column(const wt_text_table *table, wt_quantity quantity,
                                           int segment);
/* Column number i of row r. */
double wt_text_table_value(const wt_text_table *table, size_t row, const wt_text_column *column);
/* Fails unless the quantities of the table suffice for `kind`, and says which column is to blame:
 * WT_E_UNIT where only a unit is not known. */
wt_status wt_text_table_require(const wt_text_file *file, const wt_text_table *table, unsigned kind,
                                wt_error *err);
/* Fails with what is wrong with the column of `quantity`, if there is one with a problem. */
wt_status wt_text_table_problem(const wt_text_file *file, const wt_text_table *table,
                                wt_quantity_set quantities, wt_error *err);
/* The names of unknown columns, with commas; cut with "..." if there is no room. */
void wt_text_unknown(const wt_text_file *file, char *names, size_t size);
/* Notes which columns were left out. */
void wt_text_log_unknown(const wt_text_file *file, wt_parselog *log);
/* "no frequency sweep in it" and which steps are there instead: WT_E_EMPTY. */
wt_status wt_text_nothing(const wt_text_file *file, const char *what, wt_error *err);

/* ---- the names row ------------------------------------------------------------------------ */

/* Names and units of a candidate for a names row. */
typedef struct wt_names {
    wt_cells names, units; /* units.n is 0 if there is no such row */
    wt_separator separator;
} wt_names;

/* Is the name of a cell one of the description? *unit is what stands in the name. */
bool wt_names_known(const wt_description *description, wt_cell cell, size_t *first, size_t *n,
                    wt_cell *unit);

/* Splits `line` and tells whether its cells name enough columns for one of `kinds`. With an auto
 * separator the one that names most columns is taken. False also when out of memory. */
bool wt_names_match(wt_names *names, const wt_description *description, const char *line,
                    size_t length, wt_separator separator, unsigned kinds);
/* Fills columns, quantities and problems of the table; what is not understood goes to
 * file->unknown. */
wt_status wt_names_resolve(const wt_names *names, wt_text_file *file, wt_text_table *table,
                           const wt_read_options *options, wt_error *err);
/* Does a name carry its unit ("f (Hz)", "E' / MPa", "q[1/m]")? Shortens *length to the name. */
bool wt_name_unit(const char *name, size_t *length, wt_cell *unit);
void wt_names_free(wt_names *names);

/* ---- results ------------------------------------------------------------------------------ */

wt_match wt_text_detect(const wt_description *description, const wt_peek *peek);
wt_status wt_text_open_force(const wt_description *description, wt_input *input,
                             const wt_read_options *options, wt_parselog *log,
                             wt_force_source **source, wt_error *err);
wt_status wt_text_read_sweep(const wt_description *description, wt_input *input,
                             const wt_read_options *options, wt_parselog *log, wt_sweep *sweep,
                             wt_error *err);
wt_status wt_text_read_spectrum(const wt_description *description, wt_input *input,
                                const wt_read_options *options, wt_parselog *log,
                                wt_power_spectrum *spectrum, wt_error *err);
wt_status wt_text_describe(const wt_description *description, wt_input *input,
                           const wt_read_options *options, wt_parselog *log, wt_table *facts,
                           wt_error *err);

/* The isotherms of a scanned file, appended to `sweep`. */
wt_status wt_text_sweep(const wt_text_file *file, const wt_read_options *options, wt_parselog *log,
                        wt_sweep *sweep, wt_error *err);

#endif
