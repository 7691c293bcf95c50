/* Internal interface of strain softening for the jobs. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_STRAIN_SOFTENING_H
#define WT_DMA_STRAIN_SOFTENING_H

#include "weartrack/dma.h"

/* Returns true if at least one point has a standard error. */
bool strain_softening_has_errors(const wt_strain_softening *softening);
/* Describes the source and the error of the softening. */
void strain_softening_describe(const wt_strain_softening *softening, char *text, size_t size);
/* Creates a copy without errors for a replicate (WT_NO_REPLICATE: unchanged). The caller clears
 * it. */
wt_strain_softening strain_softening_draw(const wt_strain_softening *softening, uint64_t seed,
                                          size_t replicate);

#endif
