/* Shifts [decade] by the overlap of neighbours, from the anchor outwards, for the storage
 * modulus alone. They are used if one spectrum does not describe the isotherms. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_OVERLAP_CHAIN_H
#define WT_DMA_NUMERICS_OVERLAP_CHAIN_H

#include "dma/numerics/isotherm.h"

typedef struct overlap_edge {
    bool placed;
    size_t onto;    /* index of the placed isotherm it is linked to; the anchor: itself */
    double a;       /* shift relative to the anchor */
    double step;    /* standard error of the step onto it */
    double error;   /* standard error of a for fully correlated steps */
    double spread;  /* additional error of a if only one position of each overlap is right, the same
                       in all */
    double by_loss; /* change of a by the overlaps of the loss modulus alone */
    double by_vertical; /* change of a by the other vertical shifts */
} overlap_edge;

/* Fills the edges [set->n]. b: [set->n] vertical shifts of the moduli; alternative_b: [set->n]
 * alternative vertical shifts, or NULL. Without a storage modulus only the anchor is placed. */
void overlap_chain(const shift_set *set, size_t anchor, const double *b,
                   const double *alternative_b, overlap_edge *edge);
/* Computes log_a [set->n], in decades, 0 at the anchor. It is NaN if no isotherm towards the
 * anchor shares enough height, or without a storage modulus. */
void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a);

#endif
