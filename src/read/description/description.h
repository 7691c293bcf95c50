/* A format description: what the XML of weartrack-format(5) says, ready for the engine.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_DESCRIPTION_H
#define WT_READ_DESCRIPTION_H

#include "core/base/arena.h"
#include "core/system/embed.h"
#include "read/reader.h"

#include <regex.h>

/* A line that is longer is not compared with regular expressions, which bounds their cost. */
#define PATTERN_LINE_MAX ((size_t)16384)
#define NAME_LONGEST ((size_t)128) /* bytes of a normalised name, with its end */

/* Part of a text; borrowed. */
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

typedef enum units_where {
    UNITS_ROW,
    UNITS_NAME,
    UNITS_NAME_OR_ROW,
    UNITS_LINE,
    UNITS_NONE
} units_where;

typedef struct line_pattern {
    regex_t regex;
    bool compiled;
    char first; /* the byte that every match begins with, '\0' if that is not known */
    struct line_pattern *next; /* of the compiled ones of a description */
} line_pattern;

/* 0 groups: does it match? Else groups[0..n) get what matched; rm_so is -1 for an empty group. A
 * zero byte ends the line. */
bool pattern_match(const line_pattern *pattern, text_span line, regmatch_t *groups, size_t n);
/* Shortens the line to what group 1 matches; false if there is no match, or nothing in it. */
bool pattern_part(const line_pattern *pattern, text_span *line);
text_span pattern_group(text_span line, regmatch_t group);

typedef enum probe_kind { PROBE_REQUIRE, PROBE_HINT, PROBE_FORBID, PROBE_NAMES } probe_kind;

typedef struct text_probe {
    probe_kind kind;
    char *text; /* NULL if `pattern` is used */
    line_pattern pattern;
    size_t within; /* lines */
    int score;
} text_probe;

/* The header values that a table takes with it. */
typedef enum header_value {
    HEADER_TEMPERATURE,
    HEADER_SPRING_CONSTANT,
    HEADER_SENSITIVITY,
    HEADER_POSITION_X,
    HEADER_POSITION_Y,
    HEADER_VELOCITY,
    HEADER_DURATION,
    HEADER_SETPOINT,
    HEADER_LOAD,
    HEADER_RADIUS,
    /* These no quantity tells, but what the field sets. */
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

/* Which header value a field gives; HEADER_COUNT if none. */
header_value header_of(wt_quantity quantity, field_sets sets);

#define GROUPS ((size_t)10) /* of a header line, the whole match included */

typedef struct header_field {
    line_pattern pattern;
    char *name;
    wt_quantity quantity; /* WT_Q_NONE: a text for `info` */
    size_t group;         /* of the value */
    char *unit;           /* NULL: unit_group is the unit */
    size_t unit_group;    /* 0: none */
    bool fallback;        /* only where no column has it */
    field_sets sets;
} header_field;

typedef struct step_marker {
    line_pattern pattern;
    bool title_next; /* the line after it is the title; else group 1 */
} step_marker;

/* A line by which a file without data that are read tells what it is. */
typedef struct other_test {
    line_pattern pattern;
    char *what; /* "a creep test" */
} other_test;

typedef struct unit_alias {
    char *found, *means;
} unit_alias;

typedef struct column_rule {
    wt_quantity quantity;
    char *unit; /* NULL: the file must say */
    char *with; /* normalised name of a column that must be there too, or NULL */
    bool has_segment;
    wt_segment_kind segment; /* if has_segment */
    bool negate;
    char *assumed; /* what the name leaves open and is taken for granted, or NULL */
} column_rule;

/* A name that a column may have. */
typedef struct column_name {
    char *name; /* normalised */
    size_t rule;
} column_name;

typedef struct segment_marker {
    line_pattern pattern; /* of a line */
    char *text;           /* of a cell */
    wt_segment_kind kind;
} segment_marker;

/* How much of a description has been read. */
typedef enum description_extent {
    DESCRIPTION_HEAD,   /* up to `verified` */
    DESCRIPTION_DETECT, /* what tells its files, names of columns apart, and how they are decoded */
    DESCRIPTION_WHOLE,
    DESCRIPTION_EXTENTS
} description_extent;

typedef struct text_description {
    arena memory; /* of all that is pointed to below */
    line_pattern *patterns;
    description_extent extent;
    struct text_description *more[DESCRIPTION_EXTENTS]; /* read since, description_need */

    char *id, *title, *evidence, *version;
    const char *xml; /* the document as it was read */
    unsigned kinds;
    bool verified;

    text_probe *probes;
    size_t n_probes;

    text_encoding encoding;
    cell_separator separator, names_separator;
    size_t *widths; /* characters per column of SEPARATOR_FIXED; the last one repeats */
    size_t n_widths;
    char decimal; /* '.', ',' or '\0' for auto */
    char *comment;
    char **missing; /* texts of an empty cell, beside the usual ones */
    size_t n_missing;

    header_field *fields;
    size_t n_fields;

    step_marker *steps;
    size_t n_steps;
    line_pattern *ends;
    size_t n_ends;
    bool end_required; /* a table without one of them was cut off */
    other_test *others;
    size_t n_others;
    unit_alias *aliases;
    size_t n_aliases;
    column_rule *rules;
    size_t n_rules;
    column_name *names; /* sorted by name, then rule */
    size_t n_names;
    bool matrix; /* each row is a line of an image: its cells are values of the one column */
    bool has_names_line;
    line_pattern names_line;  /* group 1 is the names row, unless names stand elsewhere */
    line_pattern names_lines; /* group 1 of each line above `names_line` is a name */
    char *names_are;          /* what the columns are called where the file does not say it */
    units_where units;
    line_pattern units_line; /* of UNITS_LINE; group 1 is the units row */
    char *row_prefix;        /* normalised */
    char **row_numbers;      /* normalised names of the column that numbers the rows */
    size_t n_row_numbers;
    bool blank_is_block;

    char *group;    /* normalised name of the column that parts isotherms */
    char **samples; /* normalised names of the column that names the sample */
    size_t n_samples;
    double temperature_jump; /* [K], NaN = none */

    segment_marker *markers;
    size_t n_markers;
    segment_marker *values;
    size_t n_values;
    char *segment_column, *curve_column; /* normalised */
    bool turning_point;
} text_description;

/* The schema, compiled once for a set of descriptions. */
typedef struct _xmlSchema description_xsd;
wt_status description_xsd_new(description_xsd **schema, wt_error *err);
void description_xsd_free(description_xsd *schema);

/* Reads and checks one description. `name` is used in errors. schema NULL: it follows it. */
wt_status description_parse(description_xsd *schema, const char *xml, size_t length,
                            const char *name, text_description **description, wt_error *err);
wt_status description_parse_file(description_xsd *schema, const char *path,
                                 text_description **description, wt_error *err);
void description_free(text_description *description);

/* One of those in the library, which are in order: its head. */
wt_status description_of_library(const embedded_text *file, text_description **description,
                                 wt_error *err);
/* At least so much of a description; of one in the library it is read when it is asked for first,
 * by whichever thread, and only memory can hinder that. Borrowed from `description`. */
wt_status description_need(text_description *description, description_extent extent,
                           const text_description **known, wt_error *err);

/* What only the parts together show: do the columns make the kinds that are promised? */
wt_status description_check_whole(const text_description *description, const char *name,
                                  wt_error *err);

/* First entry of `names` for a normalised name, and how many there are; false if none. */
bool description_find_name(const text_description *description, const char *name, size_t *first,
                           size_t *n);

/* Lower case, no blanks, primes and Greek letters spelled one way: "E \"" and "E″" are "e''",
 * "tan(δ)" is "tan(delta)". Cut at NAME_LONGEST. */
void name_normalise(text_span text, char name[NAME_LONGEST]);
/* Is the text, normalised, that name? */
bool name_is(text_span text, const char *name);

/* No names stand in the file: its tables begin with their first row. */
static inline bool description_is_nameless(const text_description *d)
{
    return d->matrix || (d->names_are != NULL && !d->has_names_line);
}

/* Do the quantities make a force curve, sweep, image or spectrum, whichever are among `kinds`? */
bool quantities_suffice(wt_quantity_set set, unsigned kinds);
/* All that is needed, or one of which is. */
wt_quantity_set quantities_of(unsigned kind);
/* Words for what is needed: "columns of frequency, storage modulus and ..."; static. */
const char *quantities_needed(unsigned kind);
const char *kind_name(unsigned kind); /* "sweep"; static */

#endif
