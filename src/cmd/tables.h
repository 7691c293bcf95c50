/* Tables from files: what one subcommand wrote, another one reads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_TABLES_H
#define WT_CMD_TABLES_H

#include "cmd/cmd.h"

/* All tables of a text stream or of an HDF5 result; "-" is standard input. */
wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err);
/* With --strict CMD_FAILED, after saying so, where the result that was read holds remarks. */
int cmd_tables_remarks(const char *name, const cmd_common *common, const char *path,
                       const wt_result *tables);
/* The first table whose name begins with `prefix`; WT_E_NOT_FOUND names `path` and says what it
 * should be. */
wt_status cmd_tables_find(const wt_result *tables, const char *path, const char *prefix,
                          const char *made_by, const wt_table **table, wt_error *err);

/* The rubber that weartrack master wrote; it borrows from the tables. */
wt_status cmd_tables_rubber(const char *path, double poisson_ratio, wt_result **tables,
                            wt_rubber *rubber, wt_error *err);

#endif
