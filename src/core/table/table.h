/* Members of a table, and the rules for its names. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_H
#define WT_CORE_TABLE_TABLE_H

#include "weartrack/core.h"

/* Limits that no table reaches. Names are searched linearly, and files are not trusted. */
enum { TABLE_COLUMNS_MAX = 2048, TABLE_KEYS_MAX = 2048, RESULT_TABLES_MAX = 2048 };

typedef struct table_column {
    wt_column_kind kind;
    char *name, *unit, *long_name;
    double *numbers; /* [n_rows] of a number column */
    char **texts;    /* [n_rows] of a text column; NULL is "", and a cell may share the text of the
                        cell above */
} table_column;

typedef struct table_key {
    char *name;
    char *text;         /* one line; of an estimate in the form of format_estimate_key */
    bool is_estimate;   /* the text is an estimate, */
    wt_estimate parsed; /* with these values; its unit points into `unit` */
    char *unit;
} table_key;

/* An estimate has four names in a store: its own name and those of its other parts. */
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

/* True for parts of [a-z0-9_]+ joined by '/'. */
bool table_name_is_valid(const char *name);
/* True for [A-Za-z0-9_]+. */
bool table_name_part_is_valid(const char *word);
/* Returns the names of the parts of an estimate key. The caller frees them. */
void table_key_part_names(const char *key, char *names[KEY_PARTS]);
/* Returns the name of today of a table; the same name if it did not change. */
const char *table_current_name(const char *name);
/* Gives a table, its columns and its keys the names of today. */
void table_use_current_names(wt_table *table);
/* Writes a table. WT_E_ARG for a table without columns or with an invalid name. */
wt_status table_bytes_write(FILE *out, const wt_table *table, wt_error *err) WT_NODISCARD;
/* Decodes a table at *at with validation, and moves *at to its end. */
wt_status table_bytes_read(const char **at, const char *end, wt_table **table,
                           wt_error *err) WT_NODISCARD;
/* Computes the SHA-256 of the encoded table. */
wt_status table_bytes_digest(const wt_table *table, char hex[65], wt_error *err) WT_NODISCARD;

/* Sets version and command from the texts of wt_provenance_version and wt_provenance_command,
 * separated by a line feed. */
void provenance_restore(wt_provenance *p, const char *version_and_command);

#endif
