/* The schemas made from the lists. SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/tables/tables.h"

/* What may stand in a row of a list. */
#define NUMBER .quantity = WT_Q_NONE
#define SI(q) .quantity = WT_Q_##q
#define UNIT(words) .unit = words
#define TEXT .kind = SCHEMA_TEXT
#define PLAIN .kind = SCHEMA_PLAIN
#define YES_NO .yes_no = true
#define LABEL(words) .label = words
#define HEADLINE(words) .headline = words
#define STANDARD_ERROR(id) .standard_error = id##_STANDARD_ERROR
#define NUMERICAL_ERROR(id) .numerical_error = id##_NUMERICAL_ERROR
#define BOTH_ERRORS(id) STANDARD_ERROR(id), NUMERICAL_ERROR(id)
#define INTERVAL(low_end, high_end) .low = low_end, .high = high_end
#define LIKE(column) .like = column
#define MISSING(words) .missing = words
#define DIGITS(n) .digits = n
#define DECIMALS(n) .decimals = n
#define SPARSE .sparse = true
#define OPTIONAL .optional = true

#define COLUMN(id, ...) {__VA_ARGS__},
#define KEY(id, key_name, ...) {.name = key_name, __VA_ARGS__},

/* The row behind the last one stands for none. */
#define SCHEMA(table, TABLE, table_name, words, subcommand)                                        \
    static const schema_field table##_columns[] = {TABLE##_COLUMNS(COLUMN){.name = NULL}};         \
    static const schema_field table##_keys[] = {TABLE##_KEYS(KEY){.name = NULL}};                  \
    const table_schema table##_schema = {                                                          \
        .name = table_name,                                                                        \
        .title = words,                                                                            \
        .made_by = subcommand,                                                                     \
        .columns = table##_columns,                                                                \
        .n_columns = TABLE##_N_COLUMNS,                                                            \
        .keys = table##_keys,                                                                      \
        .n_keys = TABLE##_N_KEYS,                                                                  \
    };                                                                                             \
    _Static_assert((int)TABLE##_N_COLUMNS <= (int)SCHEMA_MOST &&                                   \
                       (int)TABLE##_N_KEYS <= (int)SCHEMA_MOST,                                    \
                   "a set of columns or keys has one bit for each");
TABLES(SCHEMA)

#define SCHEMA_POINTER(table, ...) &table##_schema,
const table_schema *const table_schemas[] = {TABLES(SCHEMA_POINTER)};
const size_t table_n_schemas = sizeof table_schemas / sizeof *table_schemas;
