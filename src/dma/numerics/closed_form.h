/* Shifts by the closed form of ISO 18437-6 (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_CLOSED_FORM_H
#define WT_DMA_NUMERICS_CLOSED_FORM_H

#include "dma/numerics/isotherm.h"

/* log_a: [set->n] decades, 0 at the anchor; NaN where no isotherm on the way to the anchor shares
 * enough height, and everywhere without a storage modulus. */
void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a);
/* Where curve `from` goes on curve `onto`, its storage modulus times 10^b [decade]; NaN if they
 * share too little. */
double closed_form_step(const shift_set *set, size_t onto, size_t from, double b);

#endif
