/* What a table is made of, and the rules for its names. SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_TABLE_TABLE_H
#define WT_CORE_TABLE_TABLE_H

#include "weartrack/data.h"

/* More than any table has: names are searched one by one, and a file is not to be trusted. */
enum { TABLE_COLUMNS_MAX = 2048, TABLE_KEYS_MAX = 2048, RESULT_TABLES_MAX = 2048 };

typedef struct table_column {
    wt_column_kind kind;
    char *name, *unit, *long_name;
    double *numbers; /* [n_rows] of a number column */
    char **texts;    /* [n_rows] of a text column; NULL stands for "", one may be that above it */
} table_column;

typedef struct table_key {
    char *name;
    char *text;         /* one line; of an estimate as estimate_text writes it */
    bool is_estimate;   /* the text is that of an estimate, */
    wt_estimate parsed; /* which is this one; its unit points into `unit` */
    char *unit;
} table_key;

/* An estimate has four names in a store: its own and those of its other parts. */
enum { KEY_STANDARD_ERROR, KEY_NUMERICAL_ERROR, KEY_UNITS, KEY_PARTS };

struct wt_table {
    char *name, *title;
    table_column *columns;
    size_t n_columns;
    size_t n_rows;  /* of every column */
    size_t *blocks; /* first row of every block */
    size_t n_blocks;
    table_key *keys;
    size_t n_keys;
};

/* Parts of [a-z0-9_]+ joined by '/'. */
bool table_name_is_valid(const char *name);
/* [A-Za-z0-9_]+ */
bool table_word_is_valid(const char *word);
void table_free_keys(wt_table *table);
/* Names of the parts of an estimate key, new, to be freed also on failure. False when out of
 * memory. */
bool table_key_part_names(const char *key, char *names[KEY_PARTS]);

#endif
