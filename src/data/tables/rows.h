/* Binds the columns and keys of a table to the structure that a row of it shows. The list of the
 * table names the members, SHOWS(member); the kind follows from the member, so the two cannot
 * disagree:
 *
 *     typedef wt_payne payne_row;
 *     TABLE_ROW(payne, PAYNE)
 *
 * makes payne_add_row(&writer, &row), which begins a row and puts all that it shows; what no
 * member shows is put behind it. TABLE_KEYS(payne, PAYNE) makes payne_set_keys(&writer, &keys) of
 * a payne_keys. Optional keys that are NaN, NULL or "" are left out.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_ROWS_H
#define WT_DATA_TABLES_ROWS_H

#include "data/tables/tables.h"
#include "data/tables/words.h"

/* A string that is pointed to, or what else a member is. */
#define SHOWN_FORM(of)                                                                             \
    _Generic(&((shown_row *)NULL)->of, char **                                                         \
             : FORM_WORDS, default                                                                 \
             : _Generic(((shown_row *)NULL)->of, double                                                \
                        : FORM_NUMBER, size_t                                                      \
                        : FORM_COUNT, bool                                                         \
                        : FORM_YES_NO, wt_estimate                                                 \
                        : FORM_ESTIMATE, wt_interval                                               \
                        : FORM_INTERVAL, const char *                                              \
                        : FORM_WORDS, char *                                                       \
                        : FORM_LETTERS))
#define SHOWS(name) .member = #name, .offset = offsetof(shown_row, name), .form = SHOWN_FORM(name)

#define TABLE_ROW(table, TABLE)                                                                    \
    const schema_field *table##_row_shows(void);                                                   \
    const schema_field *table##_row_shows(void)                                                    \
    {                                                                                              \
        typedef table##_row shown_row;                                                             \
        static const schema_field columns[] = {TABLE##_COLUMNS(COLUMN){.name = NULL}};             \
        return columns;                                                                            \
    }                                                                                              \
    static inline void table##_add_row(table_writer *w, const table##_row *row)                    \
    {                                                                                              \
        writer_row(w, &table##_schema, table##_row_shows(), row);                                  \
    }
#define TABLE_KEYS(table, TABLE)                                                                   \
    const schema_field *table##_keys_show(void);                                                   \
    const schema_field *table##_keys_show(void)                                                    \
    {                                                                                              \
        typedef table##_keys shown_row;                                                            \
        static const schema_field keys[] = {TABLE##_KEYS(KEY){.name = NULL}};                      \
        return keys;                                                                               \
    }                                                                                              \
    static inline void table##_set_keys(table_writer *w, const table##_keys *keys)                 \
    {                                                                                              \
        writer_keys(w, &table##_schema, table##_keys_show(), keys);                                \
    }

#endif
