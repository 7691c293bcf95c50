/* Tables for other programs in the requested form. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_EXPORT_H
#define WT_CMD_EXPORT_H

#include "cmd/cmd.h"

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
