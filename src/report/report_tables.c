/* Binds the tables of a result to their schemas.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_tables.h"

#include <stdlib.h>
#include <string.h>

static wt_status bind_indentation(const wt_result *result, figure_tables *tables, wt_error *err)
{
    const char *const prefix = indentation_schema.name;
    const size_t length = strlen(prefix), n = wt_result_n_tables(result);
    tables->indentation = wt_alloc(n, sizeof *tables->indentation);
    for (size_t i = 0; i < n; i++) {
        const wt_table *table = wt_result_table(result, i);
        const char *name = wt_table_name(table);
        if (strncmp(name, prefix, length) != 0)
            continue;
        wt_status status = table_bind(table, &indentation_schema, name + length,
                                      &tables->indentation[tables->n_indentation++], err);
        if (status != WT_OK)
            return status;
    }
    return WT_OK;
}

wt_status figure_tables_bind(const wt_result *result, figure_tables *tables, wt_error *err)
{
    wt_status status = WT_OK;
    *tables = (figure_tables){.n_indentation = 0};
#define BIND(table)                                                                                \
    if (status == WT_OK)                                                                           \
        status = table_bind_result(result, &table##_schema, "", &tables->table, err);
    FIGURE_TABLES(BIND)
    return status != WT_OK ? status : bind_indentation(result, tables, err);
}

void figure_tables_clear(figure_tables *tables)
{
    free(tables->indentation);
    *tables = (figure_tables){.n_indentation = 0};
}

const table_view *figure_tables_find(const figure_tables *tables, const table_schema *schema)
{
#define FIND(table)                                                                                \
    if (schema == &table##_schema)                                                                 \
        return &tables->table;
    FIGURE_TABLES(FIND)
    return NULL;
}

const table_view *figure_tables_indentation(const figure_tables *tables, const char *group)
{
    for (size_t i = 0; i < tables->n_indentation; i++)
        if (strcmp(tables->indentation[i].suffix, group) == 0)
            return &tables->indentation[i];
    return NULL;
}
