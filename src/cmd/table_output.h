/* Tables from files: what one subcommand wrote, another one reads. A file is a text stream ("-" is
 * standard input) or an HDF5 result. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_TABLE_OUTPUT_H
#define WT_CMD_TABLE_OUTPUT_H

#include "cmd/cmd.h"

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err);
/* How many remarks a result holds. */
size_t cmd_tables_remarks(const wt_result *tables);
/* With --strict the call has failed, and says so, where the result that was read holds any. */
void cmd_strict_remarks(cmd_session *s, const char *path, size_t n);
/* Whether one of them has a name that begins so. */
bool cmd_tables_have(const wt_result *tables, const char *prefix);
/* The first of the tables of a file whose name begins with `prefix`; WT_E_NOT_FOUND says which
 * subcommand makes it. */
wt_status cmd_table_find(const wt_result *tables, const char *path, const char *prefix,
                         const char *made_by, const wt_table **table, wt_error *err);
/* A table of those that weartrack master wrote, of a sample by its name or as its tables are named;
 * NULL is the one there is. NULL if there is none. */
const wt_table *cmd_table_of_sample(const wt_result *tables, const char *table, const char *sample);
/* WT_E_AMBIGUOUS: the tables of that name are of several samples, and none is chosen;
 * WT_E_NOT_FOUND: none is of the sample. */
wt_status cmd_check_sample(const wt_result *tables, const char *path, const char *table,
                           const char *sample, wt_error *err);
/* The rubber of the tables that weartrack master wrote into a file; sample as above. */
wt_status cmd_rubber_of(const wt_result *tables, const char *path, const char *sample,
                        double poisson_ratio, wt_rubber *rubber, wt_error *err);
/* The same from the file, an input of the work. */
wt_status cmd_rubber_read(const char *path, const char *sample, double poisson_ratio,
                          const wt_job *work, wt_result **tables, wt_rubber *rubber, wt_error *err);

#endif
