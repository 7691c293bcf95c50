/* Names of tables, columns and keys in results of earlier versions. Readers of results translate
 * them, so that the rest of the program knows the names of today alone.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_FORMER_NAMES_H
#define WT_CORE_TABLE_FORMER_NAMES_H

#include "weartrack/core.h"

/* Returns the name of today of a table; the same name if it did not change. */
const char *table_current_name(const char *name);

/* Gives a table, its columns and its keys the names of today. */
void table_use_current_names(wt_table *table);

#endif
