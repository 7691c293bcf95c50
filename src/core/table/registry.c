/* Schemas, generated from the lists of columns and keys. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/registry.h"
#include "core/table/field_macros.h"

/* Only the code that writes the table knows the structure: core/table/table_rows.h. */
#define SHOWS(name) .member = #name

#define FIRST_TEXT(text, ...) text
#define TEXT_ROW(value, ...) [value] = FIRST_TEXT(__VA_ARGS__, ""),
#define TEXTS(list, ROWS)                                                                          \
    static const char *const list##_texts[] = {ROWS(TEXT_ROW)};                                    \
    const closed_list list##_list = {list##_texts,                                                 \
                                     (int)(sizeof list##_texts / sizeof *list##_texts)};
#define PUBLIC_TEXTS(list, type, ROWS) TEXTS(list, ROWS)
#define TABLE_TEXTS(list, ROWS, unknown) TEXTS(list, ROWS)
PUBLIC_TEXT_LISTS(PUBLIC_TEXTS)
TABLE_TEXT_LISTS(TABLE_TEXTS)

/* The last row ends an empty list. */
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
    _Static_assert((int)TABLE##_N_COLUMNS <= (int)SCHEMA_FIELDS_MAX &&                             \
                       (int)TABLE##_N_KEYS <= (int)SCHEMA_FIELDS_MAX,                              \
                   "a set of columns or keys has one bit for each");
TABLES(SCHEMA)

#define SCHEMA_POINTER(table, ...) &table##_schema,
const table_schema *const table_schemas[] = {TABLES(SCHEMA_POINTER)};
const size_t table_n_schemas = sizeof table_schemas / sizeof *table_schemas;
