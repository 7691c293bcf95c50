/* Options about DMA sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/dma.h"

void cmd_dma_init(cmd_dma *dma)
{
    dma->job = wt_master_job_defaults();
    dma->vertical = (int)dma->job.shift.vertical;
}

size_t cmd_dma_options(cmd_dma *dma, cmd_option *options)
{
    const cmd_option all[] = {
        {"reference", 0, CMD_QUANTITY, &dma->job.shift.reference_temperature, "T", WT_Q_TEMPERATURE,
         "reference temperature, such as 20degC; default: the middle isotherm"},
        {"vertical", 0, CMD_CHOICE, &dma->vertical, "none|physical|free", WT_Q_NONE,
         "vertical shift: none, as rubber elasticity says, or fitted; default free"},
        {"expansion", 0, CMD_NUMBER, &dma->job.shift.expansion, "X", WT_Q_NONE,
         "volumetric thermal expansion in 1/K, for --vertical physical; default 0"},
        {"terms-per-decade", 0, CMD_NUMBER, &dma->job.prony.terms_per_decade, "X", WT_Q_NONE,
         "of the Prony series; default 2"},
        {"smoothing", 0, CMD_NUMBER, &dma->job.prony.smoothing, "X", WT_Q_NONE,
         "Tikhonov parameter of the Prony series; default 0, none"},
        {"liquid", 0, CMD_FLAG, &dma->job.prony.liquid, NULL, WT_Q_NONE, "no equilibrium modulus"}};
    const size_t n = sizeof all / sizeof all[0];
    for (size_t i = 0; i < n; i++)
        options[i] = all[i];
    return n;
}

void cmd_dma_finish(cmd_dma *dma)
{
    dma->job.shift.vertical = (wt_vertical_shift)dma->vertical;
}
