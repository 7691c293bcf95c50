/* A format description: what the XML of weartrack-format(5) says, ready for the engine.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_DESCRIPTION_H
#define WT_READ_DESCRIPTION_H

#include "read/reader.h"

#include <regex.h>

/* A line that is longer is not compared with regular expressions, which bounds their cost. */
#define WT_PATTERN_LINE_MAX ((size_t)16384)
#define WT_NAME_MAX ((size_t)128) /* bytes of a normalised name, with its end */

typedef enum wt_encoding {
    WT_ENCODING_AUTO,
    WT_ENCODING_UTF_8,
    WT_ENCODING_LATIN_1,
    WT_ENCODING_UTF_16
} wt_encoding;

typedef enum wt_separator {
    WT_SEPARATOR_AUTO,
    WT_SEPARATOR_TAB,
    WT_SEPARATOR_SEMICOLON,
    WT_SEPARATOR_COMMA,
    WT_SEPARATOR_WHITESPACE,
    WT_SEPARATOR_FIXED
} wt_separator;

typedef enum wt_units_where {
    WT_UNITS_ROW,
    WT_UNITS_NAME,
    WT_UNITS_NAME_OR_ROW,
    WT_UNITS_LINE,
    WT_UNITS_NONE
} wt_units_where;

typedef struct wt_pattern {
    regex_t regex;
    bool compiled;
    char first; /* the byte that every match begins with, '\0' if that is not known */
} wt_pattern;

/* 0 groups: does it match? Else groups[0..n) get what matched; rm_so is -1 for an empty group. */
bool wt_pattern_match(const wt_pattern *pattern, const char *line, size_t length,
                      regmatch_t *groups, size_t n);

typedef enum wt_probe_kind {
    WT_PROBE_REQUIRE,
    WT_PROBE_HINT,
    WT_PROBE_FORBID,
    WT_PROBE_NAMES
} wt_probe_kind;

typedef struct wt_probe {
    wt_probe_kind kind;
    char *text; /* NULL if `pattern` is used */
    wt_pattern pattern;
    size_t within; /* lines */
    int score;
} wt_probe;

/* The header values that a table takes with it. */
typedef enum wt_header_value {
    WT_HEADER_TEMPERATURE,
    WT_HEADER_SPRING_CONSTANT,
    WT_HEADER_SENSITIVITY,
    WT_HEADER_POSITION_X,
    WT_HEADER_POSITION_Y,
    WT_HEADER_VELOCITY,
    WT_HEADER_DURATION,
    WT_HEADER_SETPOINT,
    WT_HEADER_COUNT
} wt_header_value;

/* Which header value holds a quantity; WT_HEADER_COUNT if none does. */
wt_header_value wt_header_of(wt_quantity quantity);

typedef enum wt_field_sets {
    WT_FIELD_SETS_NOTHING,
    WT_FIELD_SETS_DECIMAL,
    WT_FIELD_SETS_SEPARATOR
} wt_field_sets;

#define WT_GROUPS ((size_t)10) /* of a header line, the whole match included */

typedef struct wt_field {
    wt_pattern pattern;
    char *name;
    wt_quantity quantity; /* WT_Q_NONE: a text for `info` */
    size_t group;         /* of the value */
    char *unit;           /* NULL: unit_group is the unit */
    size_t unit_group;    /* 0: none */
    bool fallback;        /* only where no column has it */
    wt_field_sets sets;
} wt_field;

typedef struct wt_step {
    wt_pattern pattern;
    bool title_next; /* the line after it is the title; else group 1 */
} wt_step;

typedef struct wt_unit_alias {
    char *found, *means;
} wt_unit_alias;

typedef struct wt_column_rule {
    wt_quantity quantity;
    char *unit; /* NULL: the file must say */
    char *with; /* normalised name of a column that must be there too, or NULL */
    bool has_segment;
    wt_segment_kind segment; /* if has_segment */
    bool negate;
} wt_column_rule;

/* A name that a column may have. */
typedef struct wt_column_name {
    char *name; /* normalised */
    size_t rule;
} wt_column_name;

typedef struct wt_marker {
    wt_pattern pattern; /* of a line */
    char *text;         /* of a cell */
    wt_segment_kind kind;
} wt_marker;

typedef struct wt_description {
    char *id, *title, *evidence, *version;
    char *xml; /* the document as it was read */
    unsigned kinds;
    bool verified;

    wt_probe *probes;
    size_t n_probes;

    wt_encoding encoding;
    wt_separator separator, names_separator;
    size_t *widths; /* characters per column of WT_SEPARATOR_FIXED; the last one repeats */
    size_t n_widths;
    char decimal; /* '.', ',' or '\0' for auto */
    char *comment;
    char **missing; /* texts of an empty cell, beside the usual ones */
    size_t n_missing;

    wt_field *fields;
    size_t n_fields;

    wt_step *steps;
    size_t n_steps;
    wt_pattern *ends;
    size_t n_ends;
    wt_unit_alias *aliases;
    size_t n_aliases;
    wt_column_rule *rules;
    size_t n_rules;
    wt_column_name *names; /* sorted by name, then rule */
    size_t n_names;
    bool has_names_line;
    wt_pattern names_line; /* group 1 is the names row */
    wt_units_where units;
    wt_pattern units_line; /* of WT_UNITS_LINE; group 1 is the units row */
    char *row_prefix;      /* normalised */
    bool blank_is_block;

    char *group;             /* normalised name of the column that parts isotherms */
    double temperature_jump; /* [K], NaN = none */

    wt_marker *markers;
    size_t n_markers;
    wt_marker *values;
    size_t n_values;
    char *segment_column, *curve_column; /* normalised */
    bool turning_point;
} wt_description;

/* The schema, compiled once for a set of descriptions. */
typedef struct wt_description_schema wt_description_schema;
wt_status wt_description_schema_new(wt_description_schema **schema, wt_error *err);
void wt_description_schema_free(wt_description_schema *schema);

/* Reads and checks one description. `name` is used in errors. */
wt_status wt_description_parse(const wt_description_schema *schema, const char *xml, size_t length,
                               const char *name, wt_description **description, wt_error *err);
void wt_description_free(wt_description *description);

/* What only the parts together show: do the columns make the kinds that are promised? */
wt_status wt_description_check_whole(const wt_description *description, const char *name,
                                     wt_error *err);

/* First entry of `names` for a normalised name, and how many there are; false if none. */
bool wt_description_find_name(const wt_description *description, const char *name, size_t *first,
                              size_t *n);

/* Lower case, no blanks, primes and Greek letters spelled one way: "E \"" and "E″" are "e''",
 * "tan(δ)" is "tan(delta)". Cut at WT_NAME_MAX. */
void wt_name_normalise(const char *text, size_t length, char name[WT_NAME_MAX]);

/* Do the quantities make a force curve, sweep or spectrum (one WT_KIND_ bit)? */
bool wt_quantities_suffice(wt_quantity_set set, unsigned kind);
/* Words for what is needed: "a frequency, a storage modulus and ..."; static. */
const char *wt_quantities_needed(unsigned kind);

#endif
