/* Cells of a table by the name of their column. A result may come from a file, so a column may be
 * absent or of the other kind.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_CELLS_H
#define WT_REPORT_CELLS_H

#include "weartrack/data.h"

/* Index of a column of that name and kind, -1 if there is none. */
long number_column(const wt_table *table, const char *name);
long text_column(const wt_table *table, const char *name);
/* NaN and "" if there is no such column. */
double cell_number(const wt_table *table, size_t row, const char *name);
const char *cell_text(const wt_table *table, size_t row, const char *name);

#endif
