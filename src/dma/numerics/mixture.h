/* A mixture of normal distributions. Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_MIXTURE_H
#define WT_DMA_NUMERICS_MIXTURE_H

#include "weartrack/core.h"

typedef struct mixture_component {
    double weight, mean, deviation;
} mixture_component;

/* Returns the mean, the 95 % limits and the corresponding standard error. The weights must sum
 * to 1. */
wt_interval mixture_interval(const mixture_component *part, size_t n);

#endif
