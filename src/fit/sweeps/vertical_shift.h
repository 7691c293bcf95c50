/* The prior of the vertical shifts (internal to the fit room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_SWEEPS_VERTICAL_SHIFT_H
#define WEARTRACK_FIT_SWEEPS_VERTICAL_SHIFT_H

#include "fit/sweeps/spectrum.h"

typedef struct vertical {
    double reference_temperature, expansion; /* [K], [1/K] */
    double geometry, departure;              /* standard deviations [decade] */
    double *mean;                            /* [n] owned by the caller */
    gsl_matrix *precision;                   /* [n * n] or larger */
} vertical;

/* ln b of rubber elasticity. */
double vertical_physical(const vertical *v, double temperature);
/* Fills mean and precision of the curves of a spectrum; the prior borrows them. Free shifts are so
 * but for the anchor, which is clamped as all are; without an error of the geometry it is held. */
wt_status vertical_prior(vertical *v, wt_vertical_shift kind, const double *temperature,
                         const spectrum *s, spectrum_prior *prior, wt_error *err) WT_NODISCARD;
/* ln b of the material at isotherm i is vertical_physical plus the sum of weight[i * n + k] times
 * (b_k - mean_k): what is smooth in them. weight: of zeros. */
void vertical_smooth_part(const vertical *v, const spectrum_prior *prior, const double *temperature,
                          size_t n, double *weight);

#endif
