/* Where the isotherms lie before they are fitted together, and which hang together (internal to the
 * fit room). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SPECTRUM_START_H
#define WT_DMA_NUMERICS_SPECTRUM_START_H

#include "dma/numerics/isotherm.h"

/* Each isotherm against its placed neighbours, outwards from the anchor; a, b: [set->n] decades. */
void spectrum_start(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                    const double *physical, bool *placed, double *a, double *b);
/* Keeps those of `placed` that hang together with the anchor through shared frequencies; overlap:
 * the least that is shared on the way to it [decade], infinite for the anchor. How many are left.
 */
size_t spectrum_connected(const shift_set *set, size_t anchor, const double *a, bool *placed,
                          double *overlap);

#endif
