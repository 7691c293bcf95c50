/* The softening with strain inside the jobs. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_STRAIN_SOFTENING_H
#define WT_DMA_STRAIN_SOFTENING_H

#include "weartrack/flow.h"

/* Whether anything of it can be drawn. */
bool softness_has_errors(const wt_softness *softness);
/* Where it comes from and what is known of its error. */
void softness_describe(const wt_softness *softness, char *text, size_t size);
/* A copy without errors, of a replicate (WT_NO_REPLICATE: as it is); to be cleared. */
wt_status softness_draw(const wt_softness *softness, uint64_t seed, size_t replicate,
                        wt_softness *drawn, wt_error *err) WT_NODISCARD;

#endif
