/* Cells of a table by the name of their column.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/cells.h"

#include <math.h>

static long find(const wt_table *table, const char *name, wt_column_kind kind)
{
    long column = wt_table_find(table, name);
    return column >= 0 && wt_table_column_kind(table, (size_t)column) == kind ? column : -1;
}

long number_column(const wt_table *table, const char *name)
{
    return find(table, name, WT_COLUMN_NUMBER);
}

long text_column(const wt_table *table, const char *name)
{
    return find(table, name, WT_COLUMN_TEXT);
}

double cell_number(const wt_table *table, size_t row, const char *name)
{
    long column = number_column(table, name);
    return column >= 0 ? wt_table_number(table, row, (size_t)column) : (double)NAN;
}

const char *cell_text(const wt_table *table, size_t row, const char *name)
{
    long column = text_column(table, name);
    return column >= 0 ? wt_table_text(table, row, (size_t)column) : "";
}
