/* The softening with strain inside the jobs. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_STRAIN_SOFTENING_H
#define WT_DMA_STRAIN_SOFTENING_H

#include "weartrack/flow.h"

/* Whether anything of it can be drawn. */
bool strain_softening_has_errors(const wt_strain_softening *softness);
/* Where it comes from and what is known of its error. */
void strain_softening_describe(const wt_strain_softening *softness, char *text, size_t size);
/* A copy without errors, of a replicate (WT_NO_REPLICATE: as it is); to be cleared. */
wt_status strain_softening_draw(const wt_strain_softening *softness, uint64_t seed,
                                size_t replicate, wt_strain_softening *drawn,
                                wt_error *err) WT_NODISCARD;

#endif
