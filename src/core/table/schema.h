/* What a table consists of, declared once: its columns and its keys. The declarations themselves
 * are in the slices' tables*.h. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_SCHEMA_H
#define WT_CORE_TABLE_SCHEMA_H

#include "weartrack/data.h"

/* A set of columns or keys is a 64-bit number. */
enum { SCHEMA_MOST = 64 };
#define SCHEMA_BIT(i) ((uint64_t)1 << (i))

typedef enum schema_kind {
    SCHEMA_NUMBER, /* of a key: with its errors; a text in its place says why it is not known */
    SCHEMA_TEXT,
    SCHEMA_PLAIN /* a key that is a number without errors, as text */
} schema_kind;

/* What the member of a row's structure is that a column or key shows. */
typedef enum schema_form {
    FORM_NONE, /* it is put by a call */
    FORM_NUMBER,
    FORM_COUNT,    /* size_t */
    FORM_YES_NO,   /* bool */
    FORM_ESTIMATE, /* its errors go into the columns of the errors, if it has them */
    FORM_INTERVAL, /* the same for the ends */
    FORM_WORDS,    /* const char *; NULL is "" in a column */
    FORM_LETTERS   /* char [] */
} schema_form;

/* A column or a key. */
typedef struct schema_field {
    const char *name;      /* of a key: ends in '_' where the group follows */
    const char *long_name; /* of a column */
    schema_kind kind;
    wt_quantity quantity;
    const char *unit;     /* SI; NULL = that of the quantity */
    const char *label;    /* on the page; NULL = the long name, of a key the name in words */
    const char *headline; /* of a key: among the main results; NULL = not one of them */
    bool optional;        /* a table may be without it */
    int precision;        /* of a plain key: significant digits of its text, 0 = 6 */
    const char *member;   /* what it shows; NULL: it is put by a call */
    schema_form form;     /* of the member and where it is; only in the list of */
    size_t offset;        /* core/table/table_rows.h, which knows the structure */
    /* of a column: */
    unsigned standard_error; /* columns with the errors of this one, 0 = none */
    unsigned numerical_error;
    unsigned low, high;  /* columns with the ends of its interval, 0 = none */
    bool yes_no;         /* 1 or 0 */
    bool sparse;         /* a row may leave it empty */
    unsigned like;       /* on the page in the unit of this column, 0 = of its own */
    const char *missing; /* on the page for NaN; NULL = a dash */
    int digits;          /* on the page: significant ones, 0 = as usual */
    int decimals;        /* so many instead, 0 = by digits */
} schema_field;

typedef struct table_schema {
    const char *name; /* ends in '/' where a name follows that tells several tables apart */
    const char *title;
    const char *made_by; /* the subcommand that writes it, the first of them */
    const schema_field *columns;
    size_t n_columns;
    const schema_field *keys;
    size_t n_keys;
} table_schema;

const char *schema_unit(const schema_field *field); /* "" for text */

/* The name of a table or key: `suffix` is used where it ends in '/' or '_'. */
enum { SCHEMA_NAME_SIZE = 128 };
void schema_name(const char *name, const char *suffix, char full[SCHEMA_NAME_SIZE]);

#endif
