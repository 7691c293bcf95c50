/* Schemas: the columns and keys of a table, declared once. The declarations are in tables*.h of the
 * slices. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_SCHEMA_H
#define WT_CORE_TABLE_SCHEMA_H

#include "weartrack/core.h"

/* A set of columns or keys is a 64-bit number. */
enum { SCHEMA_FIELDS_MAX = 64 };
#define SCHEMA_BIT(i) ((uint64_t)1 << (i))

typedef enum schema_kind {
    SCHEMA_NUMBER, /* number; of a key: with its errors, or a text with the reason why it is unknown
                    */
    SCHEMA_TEXT,
    SCHEMA_PLAIN /* key that is a number without errors, stored as text */
} schema_kind;

/* Closed list of the texts of a column or key. The position of a text is the value of its enum; `n`
 * is that of an unknown text. In a table a text may be followed by its reason: "yes: the wear track
 * is softer". */
typedef struct closed_list {
    const char *const *texts;
    int n;
} closed_list;

/* A cell of a closed list. */
typedef struct listed_text {
    int value;
    const char *text;   /* that of the list; the whole cell if it is unknown, "" without a cell */
    const char *reason; /* the rest of the cell, or "" */
} listed_text;

/* Reads a cell by the text with which it begins; the longest one if there are several. */
listed_text closed_list_read(const closed_list *list, const char *cell);
const char *closed_list_get(const closed_list *list, int value); /* "" for an unknown value */

/* Type of the member that a column or key shows. */
typedef enum schema_form {
    FORM_NONE, /* set by a function call */
    FORM_NUMBER,
    FORM_COUNT,      /* size_t */
    FORM_YES_NO,     /* bool */
    FORM_ESTIMATE,   /* its errors fill the error columns, if the table has them */
    FORM_INTERVAL,   /* its limits fill the columns of the limits, if the table has them */
    FORM_TEXT,       /* const char *; NULL is "" in a column */
    FORM_CHARACTERS, /* char [] */
    FORM_ENUM        /* enum whose texts are in the list of the field */
} schema_form;

/* Column or key of a table. */
typedef struct schema_field {
    const char *name;      /* of a key: ends in '_' if the name of the group follows */
    const char *long_name; /* of a column */
    schema_kind kind;
    wt_quantity quantity;
    const char *unit;        /* SI; NULL for the unit of the quantity */
    const closed_list *list; /* its texts if they are a closed list, else NULL */
    const char *label;       /* on the page; NULL for the long name, or the name of a key */
    const char *headline;    /* description of a key that is a main result, else NULL */
    bool optional;           /* the table may lack it */
    int precision;           /* significant digits of a plain key; 0 for 6 */
    const char *member;      /* name of the member that it shows; NULL if it is set by a call */
    schema_form form;        /* form and offset of the member, only in the lists of */
    size_t offset;           /* core/table/table_rows.h, which knows the structure */
    /* members of a column: */
    unsigned standard_error; /* columns with its errors; 0 without one */
    unsigned numerical_error;
    unsigned low, high;  /* columns with the limits of its interval; 0 without one */
    bool yes_no;         /* 1 or 0 */
    bool sparse;         /* a cell may be empty */
    unsigned like;       /* column whose unit it has on the page; 0 for its own unit */
    const char *missing; /* text on the page for NaN; NULL for a dash */
    int digits;          /* significant digits on the page; 0 for the default */
    int decimals;        /* decimals instead of digits; 0 for digits */
} schema_field;

typedef struct table_schema {
    const char *name; /* ends in '/' if the name of a group or sample follows */
    const char *title;
    const char *made_by; /* first subcommand that writes it */
    const schema_field *columns;
    size_t n_columns;
    const schema_field *keys;
    size_t n_keys;
} table_schema;

const char *schema_unit(const schema_field *field); /* "" for text */

/* Writes the name of a table or key. The suffix is appended if the name ends in '/' or '_'. */
enum { SCHEMA_NAME_SIZE = 128 };
void schema_name(const char *name, const char *suffix, char full[SCHEMA_NAME_SIZE]);

#endif
