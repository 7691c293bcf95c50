/* Binds the columns and keys of a table to the structure of a row. The list of the table names the
 * members with AS(member), IN(part, member) or SHOWS(member). The form is derived from the type of
 * the member, so that both agree:
 *
 *     TABLE_ROW(force_indentation, FORCE_INDENTATION, const char *group;
 *               double indentation, force, fitted_force;)
 *     TABLE_ADD(force_indentation, &writer, group, delta[i], shown[i], model[i]);
 *
 * TABLE_ADD begins a row and puts all that its members show; what none shows is put behind it.
 * TABLE_KEYS and TABLE_SET do the same for keys: those that are optional are left out if they are
 * NaN, NULL or "". A column that is an estimate or an interval fills the columns of its errors and
 * ends, as far as it has them. unit_case_tables_members looks at all of them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_TABLE_ROWS_H
#define WT_CORE_TABLE_TABLE_ROWS_H

#include "core/table/field_macros.h"
#include "core/table/registry.h"

/* Form of a member: a pointer to a string, or one of the other types. */
#define SHOWN_FORM(of)                                                                             \
    _Generic(&((shown_row *)NULL)->of, char **                                                         \
             : FORM_TEXT, default                                                                 \
             : _Generic(((shown_row *)NULL)->of, double                                                \
                        : FORM_NUMBER, size_t                                                      \
                        : FORM_COUNT, bool                                                         \
                        : FORM_YES_NO, wt_estimate                                                 \
                        : FORM_ESTIMATE, wt_interval                                               \
                        : FORM_INTERVAL, const char *                                              \
                        : FORM_TEXT, char *                                                       \
                        : FORM_CHARACTERS, int                                                     \
                        : FORM_ENUM, unsigned                                                      \
                        : FORM_ENUM))
#define SHOWS(name) .member = #name, .offset = offsetof(shown_row, name), .form = SHOWN_FORM(name)

#define SHOWN_BY(table, row, FIELDS, add, writer)                                                  \
    const schema_field *table##_##row##_shows(void);                                               \
    const schema_field *table##_##row##_shows(void)                                                \
    {                                                                                              \
        typedef table##_##row shown_row;                                                           \
        static const schema_field fields[] = {FIELDS{.name = NULL}};                               \
        return fields;                                                                             \
    }                                                                                              \
    static inline void table##_##add(table_writer *w, const table##_##row *from)                   \
    {                                                                                              \
        writer(w, &table##_schema, table##_##row##_shows(), from);                                 \
    }
#define SHOWN_COLUMNS(table, TABLE)                                                                \
    SHOWN_BY(table, row, TABLE##_COLUMNS(COLUMN), add_row, writer_add_row)
#define SHOWN_KEYS(table, TABLE) SHOWN_BY(table, keys, TABLE##_KEYS(KEY), set_keys, writer_set_keys)

/* TABLE_ROW and TABLE_KEYS define the structure with its members; TABLE_ROW_OF and TABLE_KEYS_OF
 * use an existing one. */
#define TABLE_ROW(table, TABLE, ...)                                                               \
    typedef struct table##_row {                                                                   \
        __VA_ARGS__                                                                                \
    } table##_row;                                                                                 \
    SHOWN_COLUMNS(table, TABLE)
#define TABLE_KEYS(table, TABLE, ...)                                                              \
    typedef struct table##_keys {                                                                  \
        __VA_ARGS__                                                                                \
    } table##_keys;                                                                                \
    SHOWN_KEYS(table, TABLE)
#define TABLE_ROW_OF(table, TABLE, type)                                                           \
    typedef type table##_row;                                                                      \
    SHOWN_COLUMNS(table, TABLE)
#define TABLE_KEYS_OF(table, TABLE, type)                                                          \
    typedef type table##_keys;                                                                     \
    SHOWN_KEYS(table, TABLE)

/* Add a row, or set the keys, with values in the order of the members. */
#define TABLE_ADD(table, writer, ...) table##_add_row(writer, &(table##_row){__VA_ARGS__})
#define TABLE_SET(table, writer, ...) table##_set_keys(writer, &(table##_keys){__VA_ARGS__})

#endif
