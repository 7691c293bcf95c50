/* The engine that reads text exports as a description says: bytes to lines, lines to cells, cells
 * to tables in SI units, tables to force curves, sweeps and spectra.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_H
#define WT_READ_TEXT_H

#include "read/description/description.h"
#include "read/reader.h"

/* ---- lines -------------------------------------------------------------------------------- */

/* What is behind the last line. */
typedef enum line_end { END_WHOLE, END_HALF, END_NONE } line_end;

/* A file as UTF-8 lines. */
typedef struct text_lines {
    char *text;
    text_span *lines; /* a zero byte stands where each ends */
    size_t n;
    const char *encoding; /* words: "UTF-16LE with byte order mark" */
    size_t n_replaced;    /* byte sequences that are no characters, now U+FFFD */
    bool odd_byte;        /* half a character of UTF-16 at the end was dropped */
    line_end end;         /* of the last one; CR alone is half of one if others have LF behind it */
} text_lines;

wt_status lines_decode(const unsigned char *bytes, size_t length, text_encoding encoding,
                       text_lines *lines, wt_error *err);
/* More of UTF-8 text, which does not begin with a mark. */
wt_status lines_decode_more(const unsigned char *bytes, size_t length, text_lines *lines,
                            wt_error *err);
/* The words for the encoding that the bytes will be decoded from. */
const char *lines_encoding(const unsigned char *bytes, size_t length, text_encoding encoding);
void lines_free(text_lines *lines);
/* Takes the comment mark off the beginning; false if there is none. */
bool line_uncomment(const text_description *description, text_span *line);

/* The lines of an input, which is read as far as they are asked for: as a whole, or in pieces of
 * UTF-8 text that end with a line. */
typedef struct text_feed {
    wt_input *input;
    text_encoding encoding; /* as described */
    size_t piece;           /* bytes to read together; SIZE_MAX: all */
    size_t at, size;        /* of the input: what is read next, and all; once it began */
    bool began;
    unsigned char *buffer;
    size_t room;
    struct feed_piece *first, *last;
    size_t n;          /* lines so far, those that were dropped among them */
    const char *words; /* encoding, bytes replaced: as of text_lines */
    size_t n_replaced;
    line_end end; /* of the last line so far */
} text_feed;

/* Line i, counted from 0, which must not have been dropped; WT_END behind the last. It stays until
 * it is dropped. */
wt_status feed_line(text_feed *feed, size_t i, text_span *line, wt_error *err);
/* What is behind line i, the last one asked for. */
line_end feed_line_end(const text_feed *feed, size_t i);
/* The lines before line i are no longer needed. */
void feed_drop(text_feed *feed, size_t i);
void feed_free(text_feed *feed);

/* ---- cells -------------------------------------------------------------------------------- */

/* Of a line; without blanks and quotes around each. */
typedef struct text_cells {
    text_span *cells;
    size_t n, capacity;
} text_cells;

const char *separator_name(cell_separator separator); /* "tab"; static */
/* Splits a line; SEPARATOR_AUTO is not allowed here. False when out of memory. */
bool cells_split(text_cells *cells, text_span line, cell_separator separator,
                 const text_description *description);
bool cells_blank(const text_cells *cells);
bool cell_is(text_span cell, const char *text);

typedef enum cell_kind { CELL_NUMBER, CELL_MISSING, CELL_NOT_FINITE, CELL_TEXT } cell_kind;
/* A number, an empty cell (also "--", 1e99 and what the description lists), "nan" or "inf" that it
 * does not list (*value is NaN for both) or something else. */
cell_kind cell_read(text_span cell, char decimal, const text_description *description,
                    double *value);
/* Copies text for messages and tables: without control characters, cut at a whole character. */
void text_copy(char *to, size_t size, text_span text);
/* Counts cells with a decimal comma and with a point. */
void cells_count_marks(const text_cells *cells, size_t *commas, size_t *points);

/* ---- tables ------------------------------------------------------------------------------- */

typedef enum column_problem {
    COLUMN_GOOD,
    COLUMN_NO_UNIT,  /* the file does not say the unit */
    COLUMN_BAD_UNIT, /* the unit fits no quantity of that name */
    COLUMN_UNCLEAR   /* the column that tells what it is (`with`) is not there */
} column_problem;

#define MODULI_OF_TENSION                                                                          \
    (WT_Q_BIT(WT_Q_STORAGE_MODULUS) | WT_Q_BIT(WT_Q_LOSS_MODULUS) |                                \
     WT_Q_BIT(WT_Q_COMPLEX_MODULUS) | WT_Q_BIT(WT_Q_RELAXATION_MODULUS) |                          \
     WT_Q_BIT(WT_Q_CREEP_COMPLIANCE))
#define MODULI_OF_SHEAR                                                                            \
    (WT_Q_BIT(WT_Q_SHEAR_STORAGE_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_LOSS_MODULUS) |                    \
     WT_Q_BIT(WT_Q_SHEAR_COMPLEX_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_RELAXATION_MODULUS) |              \
     WT_Q_BIT(WT_Q_SHEAR_CREEP_COMPLIANCE))

/* A column of a table that is known by its name. */
typedef struct text_column {
    size_t cell;
    column_problem problem;
    const column_rule *rule;
    double factor, offset; /* to SI, the sign of a negated column included */
    const char *assumed;   /* of the rule, unless the user says it */
    char name[64];         /* as exported, without a unit in it */
    char unit[32];         /* as exported or given, "" if none */
    const char *overruled; /* unit given that is another than the file's own, which stands */
} text_column;

typedef struct text_header {
    double value[HEADER_COUNT]; /* SI, NaN if not seen */
    bool fallback[HEADER_COUNT];
} text_header;

/* Rows under one names row. */
typedef struct text_table {
    size_t names_line; /* counted from 1 */
    size_t step_line;  /* of the marker before it, 0 if none */
    char title[96];    /* of the step, "" if none */
    cell_separator separator;
    char decimal;
    size_t n_names;       /* cells of the names row */
    text_column *columns; /* that are understood */
    size_t n_columns;
    text_column *problems; /* columns with a problem */
    size_t n_problems;
    wt_quantity_set quantities;                                            /* of `columns` */
    size_t group_cell, segment_cell, curve_cell, sample_cell, number_cell; /* SIZE_MAX: none */
    double *values;       /* [n_rows][n_columns], NaN for an empty cell */
    size_t *blocks;       /* [n_rows] number that changes where a block begins */
    unsigned char *kinds; /* [n_rows] wt_segment_kind, or ROW_KIND_NONE */
    size_t *row_lines;    /* [n_rows] counted from 1 */
    size_t *samples;      /* [n_rows] place in the list of the file, NO_SAMPLE without a name */
    size_t n_rows;
    text_header header;
} text_table;
#define ROW_KIND_NONE 255u
#define NO_SAMPLE SIZE_MAX
#define SAMPLES_MAX ((size_t)1024)

typedef struct field_value {
    size_t line;    /* 0 if it was not there */
    char text[208]; /* as found */
    char unit[32];
} field_value;

/* Texts found in a file. */
typedef struct text_list {
    char **items;
    size_t n;
} text_list;

/* Everything that a description finds in a file, or in a part of it. */
typedef struct text_file {
    const text_description *description;
    const char *name;
    text_feed *feed;
    text_table *tables;
    size_t n_tables;
    size_t n_seen;              /* tables of the parts so far, this one among them */
    wt_quantity_set quantities; /* of those tables */
    field_value *values;        /* [n_fields] of the description, as last seen */
    text_list unknown;          /* names of columns that no rule knows, each once */
    bool moduli_again;          /* of a name that is read already, in one table */
    text_list steps;            /* titles of steps without a table */
    text_list samples;          /* names of samples, each once */
    arena memory;               /* of the lists and the values */
    arena of_tables;            /* their columns */
} text_file;

/* Runs the description of the reader over the input. `kinds`: the names row of a table must suffice
 * for one of them. */
wt_status text_scan(const file_reader *reader, wt_input *input, unsigned kinds,
                    const wt_read_options *options, wt_log *log, text_file *file, wt_error *err);
void text_file_free(text_file *file);

/* The same part by part, for files that are larger than memory should be: each part ends where the
 * description sees a step begin, so that no block reaches over its end. What a part finds is what
 * text_scan would, and the failures are the same, but come when their part does. */
typedef struct text_parts text_parts;
/* Bytes to read together: SIZE_MAX, and the file is one part, where it is small or where its
 * description lets one line depend on others far away. */
wt_status text_piece(text_description *description, wt_input *input, size_t *piece, wt_error *err);
/* The input is the text itself: `as_text` of the reader is not asked. */
wt_status text_parts_begin(const file_reader *reader, wt_input *input, size_t piece, unsigned kinds,
                           const wt_read_options *options, wt_log *log, text_parts **parts,
                           wt_error *err);
/* Goes on to the next part with a table; WT_END behind the last, which then stays. */
wt_status text_parts_next(text_parts *parts, wt_error *err);
/* What the part has. */
const text_file *text_parts_file(const text_parts *parts);
void text_parts_free(text_parts *parts);

/* Adds a copy of a text, unless the list has `most` already. */
wt_status text_list_add(text_file *file, text_list *list, size_t most, text_span text,
                        wt_error *err);
/* "line 12", for messages. */
typedef struct text_place {
    char words[32];
} text_place;
text_place line_place(size_t line);
/* Does the description promise data of the kind, and do the tables have its columns? */
bool text_has(const text_file *file, unsigned kind);
/* The column of a quantity, or NULL; segment < 0: any. */
const text_column *text_table_column(const text_table *table, wt_quantity quantity, int segment);
/* Column number i of row r. */
double text_table_value(const text_table *table, size_t row, const text_column *column);
/* Fails unless the quantities of the table suffice for `kind`, and says which column is to blame:
 * WT_E_UNIT where only a unit is not known. */
wt_status text_table_require(const text_table *table, unsigned kind, wt_error *err);
/* Fails with what is wrong with the column of `quantity`, if there is one with a problem. */
wt_status text_table_problem(const text_table *table, wt_quantity_set quantities, wt_error *err);
/* The names of unknown columns, with commas; cut with "..." if there is no room. */
void text_unknown(const text_file *file, char *names, size_t size);
/* Notes which columns were left out, warns of what the names of others leave open. */
void text_log_columns(const text_file *file, wt_log *log);
/* The parts of that: of the whole file, of the tables of a part. */
void text_log_unknown(const text_file *file, wt_log *log);
void text_log_assumed(const text_file *file, wt_log *log);
/* "no frequency sweep in it" and which steps are there instead: WT_E_EMPTY. */
wt_status text_fail_empty(const text_file *file, const char *what, wt_error *err);

/* ---- the names row ------------------------------------------------------------------------ */

/* Names and units of a candidate for a names row. */
typedef struct names_row {
    text_cells names, units; /* units.n is 0 if there is no such row */
    cell_separator separator;
    char value_unit[32]; /* of a matrix, as its header says, "" if it does not */
    bool no_memory;
} names_row;

/* What a name may be: entries of the description's `names`. */
typedef struct known_name {
    size_t first, n;
    text_span unit; /* that stands in the name, or empty */
} known_name;
/* Is the name of a cell one of the description? */
bool names_known(const text_description *description, text_span cell, known_name *known);

/* The part of a line where names would stand; false if it cannot be a names row. */
bool names_part(const text_description *description, text_span *line);
/* Splits `line` and tells whether its cells name enough columns for one of `kinds`. With an auto
 * separator the one that names most columns is taken. False also when `no_memory`. */
bool names_match(names_row *names, const text_description *description, text_span line,
                 cell_separator separator, unsigned kinds);
/* Of a description without names in its files: whether the line is a row of its numbers, and what
 * parts its cells. A matrix gets a name for each of them. False also when `no_memory`. */
bool names_of_row(names_row *names, const text_description *description, text_span line,
                  cell_separator separator);
/* Fills columns, quantities and problems of the table; what is not understood goes to
 * file->unknown. */
wt_status names_resolve(const names_row *names, text_file *file, text_table *table,
                        const wt_read_options *options, wt_error *err);
/* Does a name carry its unit ("f (Hz)", "E' / MPa", "f/Hz", "q[1/m]")? Shortens it to the name. */
bool name_unit(text_span *name, text_span *unit);
void names_free(names_row *names);

/* ---- results ------------------------------------------------------------------------------ */

/* The reader that runs a description, which it borrows. */
file_reader text_reader(text_description *description);
void text_peek_free(struct text_peek *peek);

extern const struct force_stream text_force;
/* Of a reader whose file is a table in disguise: it is read as the text that `made` makes of it. */
#define READER_OF_CURVE_TEXT(made) .runs = "weartrack-stream", .as_text = made, .force = &text_force
/* The same without reading to the end first: how many curves there are is not known. Not for a
 * reader that makes a text (as_text). */
extern const struct force_stream text_force_first;
/* Warns where steps of time or height that are all equal are broken within these rows, of a segment
 * (negative: of none). */
void text_check_steps(const text_file *file, const text_table *t, int segment, size_t first,
                      size_t end, wt_log *log);
/* Curves of the tables at hand that have what a file of one of the kinds needs; kinds 0: of all, as
 * they are read, also those that turn out to be errors. */
size_t text_count_curves(const text_file *file, unsigned kinds);
wt_status text_read_sweep(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_sweep *sweep, wt_error *err);
wt_status text_read_spectrum(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log,
                             wt_power_spectrum *spectrum, wt_error *err);
wt_status text_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_image **images, size_t *n_images, wt_error *err);
wt_status text_read_noise(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_noise_spectrum *spectrum, wt_error *err);
wt_status text_read_record(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_record *record, wt_error *err);
wt_status text_describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                        wt_log *log, table_writer *facts);
/* The same of a reader with `as_text`, whose text is made once. */
wt_status text_describe_made(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, table_writer *facts);

/* The isotherms of a scanned file, appended to `sweep`. */
wt_status text_sweep(const text_file *file, const wt_read_options *options, wt_log *log,
                     wt_sweep *sweep, wt_error *err);

#endif
