/* The prior of the vertical shifts (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_VERTICAL_SHIFT_H
#define WT_DMA_NUMERICS_VERTICAL_SHIFT_H

#include "dma/numerics/spectrum.h"

typedef struct vertical {
    double reference_temperature, expansion; /* [K], [1/K] */
    double geometry, departure;              /* standard deviations [decade] */
    double *mean;                            /* [n] owned by the caller */
    spectrum_prior room;                     /* arrays of the priors: one at a time */
    double *left;                            /* [n] scratch */
    gsl_matrix *root;                        /* scratch */
} vertical;

/* ln b of rubber elasticity. */
double vertical_physical(const vertical *v, double temperature);
/* Room for a prior of so many curves. */
void vertical_make_room(arena *memory, size_t n, vertical *v);
/* Fills the prior of the curves of a spectrum, which borrows mean and room. Free shifts are so but
 * for the anchor, which is clamped as all are; without an error of the geometry it is held. */
wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err) WT_NODISCARD;
/* ln b of the material at isotherm i is vertical_physical plus the sum of weight[i * n + k] times
 * (b_k - mean_k): what is smooth in them. weight: of zeros. */
void vertical_smooth_part(const spectrum_prior *prior, size_t n, double *weight);

#endif
