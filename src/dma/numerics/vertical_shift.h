/* Prior of the vertical shifts. Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_NUMERICS_VERTICAL_SHIFT_H
#define WT_DMA_NUMERICS_VERTICAL_SHIFT_H

#include "dma/numerics/spectrum.h"

typedef struct vertical {
    double reference_temperature, expansion; /* [K], [1/K] */
    double geometry, departure;              /* standard deviations [decade] */
    double *mean;                            /* [n] owned by the caller */
    spectrum_prior prior_storage;            /* arrays of the prior; one prior at a time */
    double *left;                            /* [n] scratch */
    gsl_matrix *root;                        /* scratch */
} vertical;

/* Returns ln b of rubber elasticity. */
double vertical_physical(const vertical *v, double temperature);
/* Allocates the arrays for n curves. */
void vertical_alloc(arena *memory, size_t n, vertical *v);
/* Fills the prior of the curves of a spectrum, which borrows `mean` and the arrays. Free shifts
 * fix only the anchor, with the clamping error; without a geometry error the anchor is exact. */
wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err) WT_NODISCARD;
/* Computes the weights of the smooth part: ln b of the material at isotherm i is
 * vertical_physical plus the sum of weight[i * n + k] times (b_k - mean_k). weight must be zero. */
void vertical_smooth_part(const spectrum_prior *prior, size_t n, double *weight);

#endif
