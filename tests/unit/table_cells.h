/* Cells of a table by the name of a column, which must exist.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_TABLE_CELLS_H
#define WT_TESTS_TABLE_CELLS_H

#include "assert_near.h"

#include "weartrack/core.h"

#include <string.h>

static inline size_t cell_column(const wt_table *table, const char *name)
{
    const long column = wt_table_find(table, name);
    if (column < 0)
        fail_msg("table %s has no column %s", wt_table_name(table), name);
    return (size_t)column;
}

static inline double number_cell(const wt_table *table, size_t row, const char *name)
{
    return wt_table_number(table, row, cell_column(table, name));
}

static inline const char *text_cell(const wt_table *table, size_t row, const char *name)
{
    return wt_table_text(table, row, cell_column(table, name));
}

/* First row whose cell contains the words. */
static inline size_t row_where(const wt_table *table, const char *name, const char *words)
{
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        if (strcmp(text_cell(table, i, name), words) == 0)
            return i;
    fail_msg("no %s %s", name, words);
    return 0;
}

#endif
