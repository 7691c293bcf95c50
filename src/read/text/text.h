/* Declares the engine that reads text exports by a description: bytes to lines, lines to cells,
 * cells to tables in SI units, and tables to force curves, sweeps, spectra, images and records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_H
#define WT_READ_TEXT_H

#include "read/description/description.h"
#include "read/reader.h"
#include "read/text/text_condition.h"

/* ---- lines -------------------------------------------------------------------------------- */

/* The end of the last line: a complete line end, half a line end or none. */
typedef enum line_end { END_WHOLE, END_HALF, END_NONE } line_end;

/* A file as UTF-8 lines. */
typedef struct text_lines {
    char *text;
    text_span *lines; /* each line ends with a zero byte */
    size_t n;
    const char *encoding;    /* text such as "UTF-16LE with byte order mark" */
    size_t n_replaced;       /* number of invalid byte sequences, which became U+FFFD */
    bool has_half_character; /* true if half a UTF-16 character at the end was dropped */
    line_end end;            /* of the last line; CR alone is half an end if others have CR LF */
} text_lines;

wt_status lines_decode(const unsigned char *bytes, size_t length, text_encoding encoding,
                       text_lines *lines, wt_error *err);
/* Decodes a later piece of UTF-8 text, which has no byte order mark. */
wt_status lines_decode_next(const unsigned char *bytes, size_t length, text_lines *lines,
                            wt_error *err);
/* Returns a text for the encoding that lines_decode will use. */
const char *lines_encoding_name(const unsigned char *bytes, size_t length, text_encoding encoding);
void lines_free(text_lines *lines);
/* Removes the comment mark at the beginning; false if there is none. */
bool line_uncomment(const text_description *description, text_span *line);

/* The lines of an input, which is read as far as requested: as a whole, or in pieces of UTF-8 text
 * that end with a line. */
typedef struct text_feed {
    wt_input *input;
    text_encoding encoding; /* as described */
    size_t piece;           /* size of a piece [byte]; SIZE_MAX for the whole input */
    size_t at, size;        /* position and size of the input */
    bool began;
    unsigned char *buffer;
    size_t buffer_size;
    struct feed_piece *first, *last;
    size_t n;          /* number of lines read, with the dropped ones */
    const char *words; /* encoding and replaced bytes, as in text_lines */
    size_t n_replaced;
    line_end end; /* end of the last line read */
} text_feed;

/* Returns line i, counted from 0, valid until it is dropped. WT_END after the last line. Line i
 * must not be dropped already. */
wt_status feed_line(text_feed *feed, size_t i, text_span *line, wt_error *err);
/* Returns the end of line i, the last one requested. */
line_end feed_line_end(const text_feed *feed, size_t i);
/* Drops the lines before line i. */
void feed_discard(text_feed *feed, size_t i);
void feed_free(text_feed *feed);

/* ---- cells -------------------------------------------------------------------------------- */

/* The cells of a line, without blanks and quotes around them. */
typedef struct text_cells {
    text_span *cells;
    size_t n, capacity;
    char *unquoted; /* text of the cells with doubled quotes; NULL without one */
    size_t unquoted_size;
} text_cells;

const char *separator_name(cell_separator separator); /* static name such as "tab" */
/* Splits a line; SEPARATOR_AUTO is not allowed here. */
void cells_split(text_cells *cells, text_span line, cell_separator separator,
                 const text_description *description);
void cells_free(text_cells *cells);
bool cells_are_blank(const text_cells *cells);
bool cell_equals(text_span cell, const char *text);

typedef enum cell_kind {
    CELL_NUMBER,
    CELL_CLOCK, /* a time such as 1:05:30.5, hours, minutes and seconds, in seconds */
    CELL_MISSING,
    CELL_NOT_FINITE,
    CELL_TEXT
} cell_kind;
/* Classifies a cell: a number or a clock time; a missing value ("", "--", 1e99 or a text of the
 * description); an unlisted "nan" or "inf"; or another text. *value is NaN unless it is a number or
 * a time. */
cell_kind cell_parse(text_span cell, char decimal, const text_description *description,
                     double *value);
/* True if the decimal mark of a number may separate thousands, as in "30.412". */
bool cell_is_grouped(text_span cell, char decimal, bool *has_mark);
/* Copies a text for messages and tables, without control characters, cut at a whole character. */
void text_copy(char *to, size_t size, text_span text);
/* Adds the numbers of cells with a decimal comma and with a decimal point. */
void cells_count_decimal_marks(const text_cells *cells, size_t *commas, size_t *points);

/* ---- tables ------------------------------------------------------------------------------- */

typedef enum column_problem {
    COLUMN_GOOD,
    COLUMN_NO_UNIT,  /* the file does not state the unit */
    COLUMN_BAD_UNIT, /* the unit fits no quantity of this name */
    COLUMN_UNCLEAR   /* the column that decides the meaning is absent */
} column_problem;

#define TENSION_MODULI                                                                             \
    (WT_Q_BIT(WT_Q_STORAGE_MODULUS) | WT_Q_BIT(WT_Q_LOSS_MODULUS) |                                \
     WT_Q_BIT(WT_Q_COMPLEX_MODULUS) | WT_Q_BIT(WT_Q_RELAXATION_MODULUS) |                          \
     WT_Q_BIT(WT_Q_CREEP_COMPLIANCE))
#define SHEAR_MODULI                                                                               \
    (WT_Q_BIT(WT_Q_SHEAR_STORAGE_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_LOSS_MODULUS) |                    \
     WT_Q_BIT(WT_Q_SHEAR_COMPLEX_MODULUS) | WT_Q_BIT(WT_Q_SHEAR_RELAXATION_MODULUS) |              \
     WT_Q_BIT(WT_Q_SHEAR_CREEP_COMPLIANCE))

/* A column of a table with a known name. */
typedef struct text_column {
    size_t cell;
    size_t condition; /* index in the conditions of the table; ALL_CONDITIONS without one */
    column_problem problem;
    const column_rule *rule;
    double factor, offset; /* conversion to SI units, with the sign of a negated column */
    const char *assumed;   /* assumption of the rule, unless the user decides it */
    char name[64];         /* name as exported, without its unit */
    char unit[32];         /* unit of the file or of the user; "" if none */
    const char
        *overruled; /* unit of the user that differs from that of the file, which has priority */
    double clock;   /* last clock time [s]; 0 if none */
    size_t days;    /* midnights that it passed */
} text_column;

#define ALL_CONDITIONS SIZE_MAX

/* Priority of a header value over a column of the same quantity. */
typedef enum header_priority {
    HEADER_OVERRIDES,
    HEADER_YIELDS,  /* used if there is no such column */
    HEADER_FALLBACK /* the same, with a warning */
} header_priority;

typedef struct text_header {
    double value[HEADER_COUNT]; /* in SI units; NaN if absent */
    header_priority priority[HEADER_COUNT];
} text_header;

/* The rows under a names row. */
typedef struct text_table {
    size_t names_line; /* counted from 1 */
    size_t step_line;  /* line of the step marker before it; 0 if none */
    char title[96];    /* title of the step; "" if none */
    cell_separator separator;
    char decimal;
    size_t n_names;       /* number of cells of the names row */
    text_column *columns; /* columns that are understood */
    size_t n_columns;
    text_condition *conditions; /* conditions of columns, which split the table */
    size_t n_conditions;
    bool has_own_condition; /* true if a line above this table states its temperature */
    bool has_qualifiers;    /* true if a row qualifies the names, so that rows may lack values */
    text_column *problems;  /* columns with a problem */
    size_t n_problems;
    wt_quantity_set quantities; /* quantities of `columns` */
    size_t group_cell, segment_cell, curve_cell, sample_cell, number_cell,
        flag_cell;        /* cells of the special columns; SIZE_MAX if absent */
    double *values;       /* [n_rows][n_columns], NaN for an empty cell */
    size_t *blocks;       /* [n_rows] block number */
    unsigned char *kinds; /* [n_rows] wt_segment_kind, ROW_KIND_NONE or ROW_KIND_FLAGGED */
    size_t *row_lines;    /* [n_rows] counted from 1 */
    size_t
        *samples; /* [n_rows] index in the list of samples of the file; NO_SAMPLE without a name */
    size_t n_rows;
    text_header header;
    bool is_sample_guessed; /* true if the samples count only if they repeat a grid */
    char sample_name[32];   /* name of that column */
    size_t n_grouped;       /* number of cells whose decimal mark may separate thousands */
    bool has_decimals;      /* true if another cell shows that it does not */
    char grouped[16];       /* one of those cells */
} text_table;
#define ROW_KIND_NONE 255u
#define ROW_KIND_FLAGGED 254u /* the instrument marks the row as outside of its limits */
#define NO_SAMPLE SIZE_MAX
#define SAMPLES_MAX ((size_t)1024)

typedef struct field_value {
    size_t line;    /* line of the field; 0 if absent */
    char text[208]; /* text as in the file */
    char unit[32];
} field_value;

/* A list of texts of a file. */
typedef struct text_list {
    char **items;
    size_t n;
} text_list;

/* Everything that a description finds in a file or in a part of it. */
typedef struct text_file {
    const text_description *description;
    const char *name;
    text_feed *feed;
    text_table *tables;
    size_t n_tables;
    size_t n_seen;              /* number of tables of all parts so far, with this one */
    wt_quantity_set quantities; /* quantities of those tables */
    field_value *values;        /* [n_fields] last value of each field of the description */
    text_list unknown;          /* names of columns without a rule, each once */
    bool has_repeated_moduli;   /* true if a table has a modulus twice under one name */
    const char *unclear_sign;   /* name whose temperature may have a minus or a hyphen, or NULL */
    text_list steps;            /* titles of steps without a table */
    text_list samples;          /* names of samples, each once */
    arena memory;               /* memory of the lists and the values */
    arena table_memory;         /* memory of the columns */
} text_file;

/* Runs the description of the reader over the input. The names row of a table must suffice for one
 * of the kinds of data in `kinds`. */
wt_status text_scan(const file_reader *reader, wt_input *input, unsigned kinds,
                    const wt_read_options *options, wt_log *log, text_file *file, wt_error *err);
void text_file_free(text_file *file);

/* Variant of text_scan for large files, part by part. A part ends where the description finds the
 * beginning of a step, so no block crosses its end. Tables and failures are those of text_scan, but
 * a failure appears with its part. */
typedef struct text_parts text_parts;
/* Chooses the piece size [byte]. It is SIZE_MAX (a single part) for a small file, or if lines of
 * the description depend on distant lines. */
wt_status text_choose_piece(text_description *description, wt_input *input, size_t *piece,
                            wt_error *err);
/* Begins the parts. The input must be text already; `as_text` of the reader is not called. */
wt_status text_parts_begin(const file_reader *reader, wt_input *input, size_t piece, unsigned kinds,
                           const wt_read_options *options, wt_log *log, text_parts **parts,
                           wt_error *err);
/* Reads the next part with a table. WT_END after the last one, which stays valid. */
wt_status text_parts_next(text_parts *parts, wt_error *err);
/* Returns the content of the current part. */
const text_file *text_parts_file(const text_parts *parts);
void text_parts_free(text_parts *parts);

/* Adds a copy of a text, unless the list has reached its maximum length. */
void text_list_add(text_file *file, text_list *list, size_t max_items, text_span text);
/* The position of a line for messages, such as "line 12". */
typedef struct line_position_text {
    char text[32];
} line_position_text;
line_position_text format_line_position(size_t line);
/* True if the description states this kind of data and the tables have its columns. */
bool text_has_kind(const text_file *file, unsigned kind);
/* Returns the column of a quantity, or NULL; segment < 0 accepts any segment. */
const text_column *text_table_column(const text_table *table, wt_quantity quantity, int segment);
/* True if the name of a column of temperature says that it is that of the sample. */
bool text_column_is_of_sample(const text_column *column);
/* Returns the value of a column in a row. */
double text_table_value(const text_table *table, size_t row, const text_column *column);
/* Fails unless the quantities of the table suffice for `kind`, and names the column that is the
 * cause. WT_E_UNIT if only a unit is unknown. */
wt_status text_table_require(const text_table *table, unsigned kind, wt_error *err);
/* Fails with the problem of a column of one of the quantities, if there is one. */
wt_status text_table_problem(const text_table *table, wt_quantity_set quantities, wt_error *err);
/* Lists the names of unknown columns, with commas; cut with "..." if they do not fit. */
void text_format_unknown(const text_file *file, char *names, size_t size);
/* Logs the unused columns and warns of assumptions about others. */
void text_log_columns(const text_file *file, wt_log *log);
/* Parts of text_log_columns: unused columns of the whole file, and assumptions about the tables of
 * a part. */
void text_log_unknown(const text_file *file, wt_log *log);
void text_log_assumed(const text_file *file, wt_log *log);
/* Fails with WT_E_EMPTY, for instance "no frequency sweep in it", and lists the steps that the file
 * contains. */
wt_status text_fail_empty(const text_file *file, const char *what, wt_error *err);

/* ---- the names row ------------------------------------------------------------------------ */

/* The names and units of a possible names row. */
typedef struct names_row {
    text_cells names, units; /* units.n is 0 without a units row */
    text_cells qualifiers;   /* row between names and units, or below both; n is 0 without one */
    text_condition *above;   /* [n_above] conditions of the cells above the names */
    size_t n_above;
    cell_separator separator;
    char value_unit[32]; /* unit of a matrix in its header; "" if absent */
} names_row;

/* The possible meanings of a name: a range of the description's `names`. */
typedef struct name_match {
    size_t first, n;
    text_span unit;              /* unit within the name, or empty */
    text_condition condition;    /* condition within the name, or none */
    char rest[COLUMN_NAME_SIZE]; /* name without the condition, in which `unit` then is */
} name_match;
/* True if the description knows the name of a cell. */
bool find_column_name(const text_description *description, text_span cell, name_match *known);

/* Reduces a line to the part with the names; false if it cannot be a names row. */
bool names_extract(const text_description *description, text_span *line);
/* Splits `line`; true if its cells name enough columns for one of `kinds`. An automatic separator
 * is the one with most known names. */
bool names_match(names_row *names, const text_description *description, text_span line,
                 cell_separator separator, unsigned kinds);
/* For a description without names in its files: true if the line is a row of numbers; it also
 * finds the separator. A matrix gets a name for each cell. */
bool names_match_row(names_row *names, const text_description *description, text_span line,
                     cell_separator separator);
/* Fills columns, quantities and problems of the table. Names that are not understood are added to
 * file->unknown. */
void names_resolve(const names_row *names, text_file *file, text_table *table,
                   const wt_read_options *options);
/* Returns the conversion of a unit, also one that the description names; false if it does not
 * measure the quantity. */
bool description_unit_to_si(const text_description *description, wt_quantity quantity,
                            const char *unit, double *factor, double *offset);
/* Counts the cells that are a unit of the name above them. */
size_t names_count_units(const names_row *names, const text_description *description,
                         const text_cells *cells);
/* Splits the tables whose columns have different conditions into a table for each of them. */
void tables_split_conditions(text_file *file);
void text_table_free(text_table *table); /* frees the rows */
/* True if a name contains its unit ("f (Hz)", "E' / MPa", "f/Hz", "q[1/m]"). It splits them. */
bool split_name_unit(text_span *name, text_span *unit);
void names_free(names_row *names);

/* ---- results ------------------------------------------------------------------------------ */

/* Returns the reader that runs a description; it borrows the description. */
file_reader text_reader(text_description *description);
void text_peek_free(struct text_peek *peek);

extern const struct force_stream text_force;
/* Members of a reader whose file is converted to a text stream by `made`. */
#define CURVE_TEXT_READER(made) .runs = "weartrack-stream", .as_text = made, .force = &text_force
/* Variant of text_force that does not read the file first, so the number of curves is unknown. It
 * does not support a reader with as_text. */
extern const struct force_stream text_force_streamed;
/* Warns if equal steps of time or height are interrupted within the rows [first, end) of a segment
 * (negative: no segment). */
void text_check_steps(const text_file *file, const text_table *t, int segment, size_t first,
                      size_t end, wt_log *log);
/* Counts the curves of the current tables whose columns suffice for one of `kinds`. With kinds 0 it
 * counts all, including those that fail later. */
size_t text_count_curves(const text_file *file, unsigned kinds);
wt_status text_read_sweep(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, wt_sweep *sweep, wt_error *err);
wt_status text_read_spectrum(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log,
                             wt_power_spectrum *spectrum, wt_error *err);
wt_status text_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_image **images, size_t *n_images, wt_error *err);
wt_status text_read_record(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_record *record, wt_error *err);
wt_status text_describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                        wt_log *log, table_writer *metadata);
/* Variant of text_describe for a reader with `as_text`, which converts the file once. */
wt_status text_describe_converted(const file_reader *self, wt_input *input,
                                  const wt_read_options *options, wt_log *log,
                                  table_writer *metadata);

/* Appends the sweeps of a scanned file to `sweep`. */
wt_status text_build_sweep(const text_file *file, const wt_read_options *options, wt_log *log,
                           wt_sweep *sweep, wt_error *err);

/* ---- text_image.c: axes of equal steps. */
typedef struct text_axis {
    double first, step; /* step > 0 */
    size_t n;
    double rounded; /* rounding of the positions; 0 if it has no effect */
} text_axis;

/* Finds the axis of increasing positions; `factor` is their unit. The last flag allows gaps.
 * Returns false if the steps are not equal; *worst is the position that deviates most. */
bool axis_find(const double *positions, size_t n, double factor, bool allows_gaps, text_axis *axis,
               size_t *worst);
/* Returns the index of a position, which must be one of those that define the axis. */
size_t axis_index(const text_axis *axis, double position);

#endif
