/* Declares a format description: the content of the XML of weartrack-format(5), ready for the text
 * engine.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_DESCRIPTION_H
#define WT_READ_DESCRIPTION_H

#include "core/base/array.h"
#include "core/system/temporary.h"
#include "read/reader.h"

#include <regex.h>

/* A longer line is not compared with regular expressions, which limits their cost. */
#define PATTERN_LINE_MAX ((size_t)16384)
#define COLUMN_NAME_SIZE ((size_t)128) /* size of a normalised name [byte] */

/* A part of a text; borrowed. */
typedef struct text_span {
    const char *text;
    size_t length;
} text_span;

typedef enum text_encoding {
    ENCODING_AUTO,
    ENCODING_UTF_8,
    ENCODING_LATIN_1,
    ENCODING_UTF_16,
    ENCODING_COUNT
} text_encoding;

typedef enum cell_separator {
    SEPARATOR_AUTO,
    SEPARATOR_TAB,
    SEPARATOR_SEMICOLON,
    SEPARATOR_COMMA,
    SEPARATOR_WHITESPACE,
    SEPARATOR_FIXED
} cell_separator;

typedef enum units_location {
    UNITS_ROW,
    UNITS_NAME,
    UNITS_NAME_OR_ROW,
    UNITS_LINE,
    UNITS_NONE
} units_location;

typedef struct line_pattern {
    regex_t regex;
    bool compiled;
    char first;                /* first byte of every match, '\0' if unknown */
    struct line_pattern *next; /* next compiled pattern of the description */
} line_pattern;

/* Returns true if the line matches. For n > 0, groups[0..n) are the matches; rm_so is -1 for an
 * empty group. A zero byte ends the line. */
bool pattern_match(const line_pattern *pattern, text_span line, regmatch_t *groups, size_t n);
/* Shortens the line to the match of group 1; false if there is no match or the group is empty. */
bool pattern_extract(const line_pattern *pattern, text_span *line);
text_span pattern_group(text_span line, regmatch_t group);

typedef enum probe_kind { PROBE_REQUIRE, PROBE_HINT, PROBE_FORBID, PROBE_NAMES } probe_kind;

typedef struct text_probe {
    probe_kind kind;
    char *text; /* text to find; NULL if `pattern` is used */
    line_pattern pattern;
    size_t within; /* number of lines searched */
    int score;
} text_probe;

/* Header values that a table stores. */
typedef enum header_value {
    HEADER_TEMPERATURE,
    HEADER_ANGULAR_FREQUENCY,
    HEADER_SPRING_CONSTANT,
    HEADER_SENSITIVITY,
    HEADER_POSITION_X,
    HEADER_POSITION_Y,
    HEADER_VELOCITY,
    HEADER_DURATION,
    HEADER_SETPOINT,
    HEADER_LOAD,
    HEADER_RADIUS,
    /* The following values depend on the target of the field and not on a quantity. */
    HEADER_VALUE_FACTOR,
    HEADER_WIDTH,
    HEADER_HEIGHT,
    HEADER_PIXEL_SIZE,
    HEADER_COUNT
} header_value;

typedef enum field_sets {
    FIELD_SETS_NOTHING,
    FIELD_SETS_DECIMAL,
    FIELD_SETS_SEPARATOR,
    FIELD_SETS_SAMPLE,
    FIELD_SETS_ROWS,
    FIELD_SETS_TITLE,
    FIELD_SETS_VALUE_UNIT,
    FIELD_SETS_VALUE_FACTOR,
    FIELD_SETS_WIDTH,
    FIELD_SETS_HEIGHT,
    FIELD_SETS_PIXEL_SIZE
} field_sets;

/* Returns the header value of a field; HEADER_COUNT if it has none. */
header_value find_header_value(wt_quantity quantity, field_sets sets);

#define REGEX_GROUPS ((size_t)10) /* capture groups of a header line, with the whole match */

typedef struct header_field {
    line_pattern pattern;
    char *name;
    wt_quantity quantity; /* WT_Q_NONE for a text that `info` shows */
    size_t group;         /* capture group of the value */
    char *unit;           /* unit; NULL if unit_group contains it */
    size_t unit_group;    /* capture group of the unit; 0 if there is none */
    bool fallback;        /* used only if no column has the quantity */
    field_sets sets;
} header_field;

typedef struct step_marker {
    line_pattern pattern;
    bool title_next; /* true if the next line is the title; else group 1 is */
} step_marker;

/* A line that identifies a test whose data are not read. */
typedef struct unread_test {
    line_pattern pattern;
    char *label; /* "a creep test" */
} unread_test;

typedef struct unit_alias {
    char *found, *means;
} unit_alias;

typedef struct column_rule {
    wt_quantity quantity;
    char *unit;          /* NULL if the file must state it */
    char *required_name; /* normalised name of a column that must exist as well, or NULL */
    bool has_segment;
    wt_segment_kind segment; /* valid if has_segment */
    bool negate;
    char *assumed; /* assumption that the name leaves open, or NULL */
} column_rule;

/* A possible name of a column. */
typedef struct column_name {
    char *name; /* normalised */
    size_t rule;
} column_name;

typedef struct segment_marker {
    line_pattern pattern; /* pattern of a marker line */
    char *text;           /* text of a marker cell */
    wt_segment_kind kind;
} segment_marker;

/* The part of a description that is parsed. */
typedef enum description_extent {
    DESCRIPTION_HEAD,   /* the attributes up to `verified` */
    DESCRIPTION_DETECT, /* the rules of detection and of text decoding */
    DESCRIPTION_WHOLE,
    DESCRIPTION_EXTENTS
} description_extent;

typedef struct text_description {
    arena memory; /* owns all that the members below point to */
    line_pattern *patterns;
    description_extent extent;
    struct text_description
        *loaded[DESCRIPTION_EXTENTS]; /* parts that description_load has parsed */

    char *id, *title, *evidence, *version;
    const char *xml; /* text of the document */
    unsigned kinds;
    bool verified, given_columns;

    text_probe *probes;
    size_t n_probes;

    text_encoding encoding;
    cell_separator separator, names_separator;
    size_t *widths; /* characters for each column of SEPARATOR_FIXED; the last one repeats */
    size_t n_widths;
    char decimal; /* '.' or ','; '\0' for automatic */
    char *comment;
    char **missing; /* texts of an empty cell in addition to the usual ones */
    size_t n_missing;

    header_field *fields;
    size_t n_fields;

    step_marker *steps;
    size_t n_steps;
    line_pattern *end_markers;
    size_t n_end_markers;
    bool end_required; /* true if a table without one of them is truncated */
    unread_test *unread_tests;
    size_t n_unread_tests;
    unit_alias *aliases;
    size_t n_aliases;
    column_rule *rules;
    size_t n_rules;
    column_name *names; /* sorted by name, then by rule */
    size_t n_names;
    bool matrix; /* true if each row is an image line, whose cells are values of the only column */
    bool has_names_line;
    line_pattern names_line;  /* group 1 is the names row, unless the names are elsewhere */
    line_pattern names_lines; /* group 1 of each line above `names_line` is a name */
    char *names_are;          /* names of the columns if the file does not state them */
    units_location units;
    line_pattern units_line; /* for UNITS_LINE; group 1 is the units row */
    char *row_prefix;        /* normalised */
    char **row_numbers;      /* normalised names of the column of row numbers */
    size_t n_row_numbers;
    char *flag_column; /* normalised name of the column in which the instrument flags rows */
    char **flags;      /* normalised flags of rows outside of the limits of the instrument */
    size_t n_flags;
    bool blank_is_block;

    char *group;    /* normalised name of the column that separates isotherms */
    char **samples; /* normalised names of the column of sample names */
    size_t n_samples;
    char **repeating; /* normalised names of a column that names samples if it repeats a grid */
    size_t n_repeating;
    double temperature_jump; /* [K]; NaN if there is none */

    segment_marker *markers;
    size_t n_markers;
    segment_marker *values;
    size_t n_values;
    char *segment_column, *curve_column; /* normalised names */
    bool turning_point;
} text_description;

/* The schema, compiled once for a set of descriptions. */
typedef struct _xmlSchema description_xsd;
wt_status description_xsd_new(description_xsd **schema, wt_error *err);
void description_xsd_free(description_xsd *schema);

/* Parses and checks one description. `name` is used in errors. With schema NULL the document is
 * assumed to be valid. */
wt_status description_parse(description_xsd *schema, const char *xml, size_t length,
                            const char *name, text_description **description, wt_error *err);
wt_status description_parse_file(description_xsd *schema, const char *path,
                                 text_description **description, wt_error *err);
void description_free(text_description *description);

/* Parses the head of a description embedded in the library, which is known to be valid. */
text_description *description_from_library(const embedded_text *file);
/* Parses a description up to at least `extent`. An embedded description is parsed on the first
 * request, from any thread; only lack of memory can fail. The result is borrowed from
 * `description`. */
wt_status description_load(text_description *description, description_extent extent,
                           const text_description **result, wt_error *err);

/* Checks the description as a whole, for instance if the columns suffice for the stated kinds of
 * data. */
wt_status description_check_whole(const text_description *description, const char *name,
                                  wt_error *err);

/* Finds the entries of `names` for a normalised name: the first and their number; false if there is
 * none. */
bool description_find_name(const text_description *description, const char *name, size_t *first,
                           size_t *n);

/* Normalises a name: lower case, no blanks, one spelling of primes and Greek letters. "E \"" and
 * "E″" become "e''"; "tan(δ)" becomes "tan(delta)". The result is cut at COLUMN_NAME_SIZE. */
void name_normalise(text_span text, char name[COLUMN_NAME_SIZE]);
/* True if the normalised text equals the name. */
bool name_equals(text_span text, const char *name);

/* True if the file contains no names, so that its tables begin with their first row. */
static inline bool description_is_nameless(const text_description *d)
{
    return d->matrix || (d->names_are != NULL && !d->has_names_line);
}

/* True if the quantities suffice for one of the kinds of data in `kinds`. */
bool quantities_suffice(wt_quantity_set set, unsigned kinds);
/* Returns all quantities that the kind of data requires or may use. */
wt_quantity_set kind_quantities(unsigned kind);
/* Returns a static text with the required columns, such as "columns of frequency, storage modulus
 * and ...". */
const char *describe_required_columns(unsigned kind);
const char *kind_name(unsigned kind); /* returns a static name such as "sweep" */

#endif
