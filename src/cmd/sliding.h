/* Options about rubber, counter surface and conditions, shared by `friction` and `layer`.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_SLIDING_H
#define WT_CMD_SLIDING_H

#include "cmd/dma.h"

typedef struct cmd_sliding {
    const char *material; /* output of `master` */
    cmd_list dma_files;   /* or DMA files */
    const char *roughness;
    cmd_values velocity;
    double poisson_ratio;
    unsigned long replicates;
    cmd_read_values read;
    cmd_dma dma;
    wt_sliding conditions;
    /* made by cmd_sliding_open */
    wt_formats *formats;
    wt_parselog *log;
    wt_result *material_tables;
    wt_result *result;
    wt_rubber rubber;
    wt_surface surface;
    wt_job work;
} cmd_sliding;

void cmd_sliding_init(cmd_sliding *s);
void cmd_sliding_free(cmd_sliding *s);
enum { CMD_SLIDING_OPTIONS = 24 };
size_t cmd_sliding_options(cmd_sliding *s, cmd_option *options);
/* Reads material and roughness and fills `conditions` and `work`. Returns an exit status; what was
 * wrong has been said. */
int cmd_sliding_open(cmd_sliding *s, const char *name, const cmd_common *common, int argc,
                     int first);

#endif
