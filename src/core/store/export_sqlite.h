/* A table as an SQLite database. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_STORE_EXPORT_SQLITE_H
#define WT_CORE_STORE_EXPORT_SQLITE_H

#include "weartrack/data.h"

/* The table under its name, with what its columns are in "weartrack_columns" and its keys in
 * "weartrack_keys"; `blocks` as a first column. */
wt_status export_sqlite(FILE *out, const wt_table *table, bool blocks, wt_error *err) WT_NODISCARD;

#endif
