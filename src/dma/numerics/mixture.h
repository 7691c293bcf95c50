/* A mixture of normal distributions (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_MIXTURE_H
#define WT_DMA_NUMERICS_MIXTURE_H

#include "weartrack/fit.h"

typedef struct mixture_part {
    double weight, mean, deviation;
} mixture_part;

/* Mean, the quantiles of 95 %, and the standard error that goes with them; weights add up to 1. */
wt_interval mixture_interval(const mixture_part *part, size_t n);

#endif
