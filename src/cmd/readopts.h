/* Options about reading instrument files, the same in every subcommand that reads them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_READOPTS_H
#define WT_CMD_READOPTS_H

#include "cmd/cmd.h"

typedef struct cmd_read_values {
    double spring_constant, sensitivity, temperature; /* SI, NaN if not given */
    cmd_list units;
} cmd_read_values;

void cmd_read_values_init(cmd_read_values *values);
void cmd_read_values_free(cmd_read_values *values);
/* Appends the force options (--spring-constant, --sensitivity), the DMA option (--temperature) and
 * --units to `options`; returns how many. */
size_t cmd_read_force_options(cmd_read_values *values, cmd_option *options);
size_t cmd_read_dma_options(cmd_read_values *values, cmd_option *options);
size_t cmd_read_units_option(cmd_read_values *values, cmd_option *options);
/* What the library wants; borrows from both. */
wt_read_options cmd_read_make(const cmd_read_values *values, const cmd_common *common);

#endif
