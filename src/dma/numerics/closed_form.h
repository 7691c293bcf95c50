/* Shifts by the closed form of ISO 18437-6. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_CLOSED_FORM_H
#define WT_DMA_NUMERICS_CLOSED_FORM_H

#include "dma/numerics/isotherm.h"

/* Computes log_a [set->n], in decades, 0 at the anchor. It is NaN if no isotherm towards the
 * anchor shares enough height, or without a storage modulus. */
void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a);
/* Returns the shift of curve `from` onto curve `onto`, with its storage modulus times 10^b
 * [decade]. It is NaN if they share too little height. */
double closed_form_step(const shift_set *set, size_t onto, size_t from, double b);

#endif
