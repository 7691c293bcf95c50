/* Shifts by the overlap of neighbours, from the anchor outwards, of the storage modulus alone: what
 * is left where one spectrum does not describe the isotherms (internal to the fit room). Decades.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_OVERLAP_CHAIN_H
#define WT_DMA_NUMERICS_OVERLAP_CHAIN_H

#include "dma/numerics/isotherm.h"

typedef struct overlap_link {
    bool placed;
    size_t onto;    /* the isotherm it hangs on, of those that are placed; the anchor: itself */
    double a;       /* against the anchor */
    double step;    /* standard error of the step onto it */
    double error;   /* standard error of a, if steps err the same way */
    double spread;  /* of a beside it, if one place of each overlap alone is right, everywhere the
                       same one */
    double by_loss; /* how far the overlaps of the loss modulus alone would move a */
    double by_vertical; /* and how far the other vertical shifts */
} overlap_link;

/* link: [set->n]. b: [set->n] vertical shifts that the moduli are taken with; other_b: [set->n]
 * others that may be right as well, or NULL. Nothing but the anchor is placed without a storage
 * modulus. */
wt_status overlap_chain(const shift_set *set, size_t anchor, const double *b, const double *other_b,
                        overlap_link *link, wt_error *err) WT_NODISCARD;

#endif
