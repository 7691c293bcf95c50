/* Options about DMA sweeps and what is made of them, for `master` and for the subcommands that
 * start from DMA files. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_DMA_H
#define WT_CMD_DMA_H

#include "cmd/readopts.h"

typedef struct cmd_dma {
    wt_master_job job;
    int vertical; /* wt_vertical_shift */
} cmd_dma;
void cmd_dma_init(cmd_dma *dma);
/* Appends --reference, --vertical, --expansion, --terms-per-decade, --smoothing, --liquid; returns
 * how many. */
size_t cmd_dma_options(cmd_dma *dma, cmd_option *options);
void cmd_dma_finish(cmd_dma *dma);

#endif
