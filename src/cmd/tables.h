/* Tables from files: what one subcommand wrote, another one reads. A file is a text stream ("-" is
 * standard input) or an HDF5 result. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_TABLES_H
#define WT_CMD_TABLES_H

#include "cmd/cmd.h"

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err);
/* With --strict the call has failed, and says so, where the result that was read holds remarks. */
void cmd_tables_remarks(cmd_session *s, const char *path, const wt_result *tables);
/* The first table of the file whose name begins with `prefix`, in `tables`, which hold all of them;
 * WT_E_NOT_FOUND says which subcommand makes it. The file is an input of the work. */
typedef struct cmd_made {
    const char *by, *role; /* subcommand; what the file is used for */
} cmd_made;
wt_status cmd_table_read(const char *path, const char *prefix, cmd_made made, const wt_job *work,
                         wt_result **tables, const wt_table **table, wt_error *err);
/* The rubber that weartrack master wrote; it borrows from the tables. */
wt_status cmd_rubber_read(const char *path, double poisson_ratio, const wt_job *work,
                          wt_result **tables, wt_rubber *rubber, wt_error *err);

#endif
