/* Tables from files that other subcommands wrote. A file is a text stream ("-" is standard input)
 * or an HDF5 result. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_TABLE_OUTPUT_H
#define WT_CMD_TABLE_OUTPUT_H

#include "cmd/cmd.h"

wt_status cmd_tables_read(const char *path, wt_result **tables, wt_error *err);
/* Returns the number of remarks in a result. */
size_t cmd_count_remarks(const wt_result *tables);
/* With --strict, sets the status to failed and reports it if n > 0. */
void cmd_apply_strict(cmd_session *s, const char *path, size_t n);
/* True if the name of a table begins with the prefix. */
bool cmd_tables_contain(const wt_result *tables, const char *prefix);
/* Finds the first table whose name begins with `prefix`; WT_E_NOT_FOUND names the subcommand that
 * creates it. */
wt_status cmd_table_find(const wt_result *tables, const char *path, const char *prefix,
                         const char *made_by, const wt_table **table, wt_error *err);
/* Returns a table of weartrack master for a sample, given by its name or suffix; sample NULL is the
 * table without a suffix. NULL if there is none. */
const wt_table *cmd_sample_table(const wt_result *tables, const char *table, const char *sample);
/* Checks the choice of a sample. WT_E_AMBIGUOUS: there are several samples and none is chosen;
 * WT_E_NOT_FOUND: the sample is missing. */
wt_status cmd_check_sample(const wt_result *tables, const char *path, const char *table,
                           const char *sample, wt_error *err);
/* Creates the rubber from a file of weartrack master, which becomes an input of the work; sample as
 * above. */
wt_status cmd_rubber_read(const char *path, const char *sample, double poisson_ratio,
                          const wt_job *work, wt_result **tables, wt_rubber *rubber, wt_error *err);

/* Options of a subcommand that exports. */
typedef struct export_options {
    wt_export_form form;
    bool formulas;
} export_options;
const wt_params *export_params(void);

/* Writes the table to -o or standard output. Unless --format is among the options given, the end of
 * the name after -o decides. */
wt_status export_table(cmd_session *s, const cmd_option_group *part, const wt_table *table);

#endif
