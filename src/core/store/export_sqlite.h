/* Exports a table as an SQLite database. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_EXPORT_SQLITE_H
#define WT_CORE_STORE_EXPORT_SQLITE_H

#include "weartrack/core.h"

/* Writes the table under its name. The table "weartrack_columns" describes its columns, and
 * "weartrack_keys" has its keys. With `blocks` the first column is the block number. */
wt_status export_sqlite(FILE *out, const wt_table *table, bool blocks, wt_error *err) WT_NODISCARD;

#endif
