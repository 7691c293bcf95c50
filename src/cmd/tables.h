/* Tables from files: what one subcommand wrote, another one reads. A file is a text stream ("-" is
 * standard input) or an HDF5 result. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_TABLES_H
#define WT_CMD_TABLES_H

#include "cmd/cmd.h"

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err);
/* With --strict the call has failed, and says so, where the result that was read holds remarks. */
void cmd_tables_remarks(cmd_session *s, const char *path, const wt_result *tables);
/* Whether one of them has a name that begins so. */
bool cmd_tables_have(const wt_result *tables, const char *prefix);
/* The first of the tables of a file whose name begins with `prefix`; WT_E_NOT_FOUND says which
 * subcommand makes it. */
wt_status cmd_table_find(const wt_result *tables, const char *path, const char *prefix,
                         const char *made_by, const wt_table **table, wt_error *err);
/* The rubber of the tables that weartrack master wrote into a file. */
wt_status cmd_rubber_of(const wt_result *tables, const char *path, double poisson_ratio,
                        wt_rubber *rubber, wt_error *err);
/* The same from the file, an input of the work. */
wt_status cmd_rubber_read(const char *path, double poisson_ratio, const wt_job *work,
                          wt_result **tables, wt_rubber *rubber, wt_error *err);

#endif
