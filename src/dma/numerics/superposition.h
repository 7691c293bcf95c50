/* Test if one spectrum with shifts describes the isotherms. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_SUPERPOSITION_H
#define WT_DMA_NUMERICS_SUPERPOSITION_H

#include "dma/numerics/spectrum.h"

typedef struct lack_of_fit {
    double p;      /* p value of one spectrum from both tests, with the noise as estimated */
    double p_sure; /* the same with the uncertainty of the noise */
    double misfit_low, misfit_high;  /* relative misfit, 95 % limits: the larger of the two tests */
    double factor, factor_error, kk; /* ln of a common factor on E'', its error and p value */
    double p_beyond;                 /* p_sure of the isotherm columns without that factor */
    double beyond;                   /* share of their explained squares without that factor */
    double
        parted; /* separation of slow and fast times as a share of the shift, without that factor */
} lack_of_fit;

/* Tests a fit with free vertical shifts; uncertainty: that of its noise (spectrum_isotherm_noise).
 */
lack_of_fit superposition_test(const spectrum *s, double uncertainty);

#endif
