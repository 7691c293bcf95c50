/* Does one spectrum with shifts describe the isotherms? (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SUPERPOSITION_H
#define WT_DMA_NUMERICS_SUPERPOSITION_H

#include "dma/numerics/spectrum.h"

typedef struct lack_of_fit {
    double p; /* that one spectrum misses nothing, of both tests, with the noise as estimated */
    double p_sure;                   /* the same with what is not known of the noise */
    double misfit_low, misfit_high;  /* relative, 95 %: the larger of the two */
    double factor, factor_error, kk; /* ln of a common factor on E'' and p of it */
    double p_beyond; /* p_sure of what lines and parabolas find beside that factor */
    double beyond;   /* and share of the squares that they explain beside it */
    double
        parted; /* share of a shift by which slow and fast times part from it, beside that factor */
} lack_of_fit;

/* From a fit with free vertical shifts; uncertainty: that of its noise (spectrum_within). */
wt_status superposition_test(const spectrum *s, double uncertainty, lack_of_fit *result,
                             wt_error *err) WT_NODISCARD;

#endif
