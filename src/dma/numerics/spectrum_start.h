/* Start positions of the isotherms and the set that is connected. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SPECTRUM_START_H
#define WT_DMA_NUMERICS_SPECTRUM_START_H

#include "dma/numerics/isotherm.h"

/* Places each isotherm on its placed neighbours, outwards from the anchor; a, b: [set->n]
 * decades. */
void spectrum_find_initial_shifts(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                                  const double *physical, bool *placed, double *a, double *b);
/* Restricts `placed` to isotherms that are connected to the anchor by shared frequencies.
 * overlap: the smallest shared range on the path [decade], infinite for the anchor. Returns
 * their number. */
size_t spectrum_select_connected(const shift_set *set, size_t anchor, const double *a, bool *placed,
                                 double *overlap);

#endif
