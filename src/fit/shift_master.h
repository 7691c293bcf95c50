/* What the shift fit knows when it is done, and the master curve made of it (internal to the fit
 * room). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FIT_SHIFT_MASTER_H
#define WT_FIT_SHIFT_MASTER_H

#include "fit/shift.h"

typedef enum shift_verdict {
    SHIFT_GOOD,
    SHIFT_TOO_SHORT,
    SHIFT_NO_OVERLAP,
    SHIFT_FLAT,
    SHIFT_NO_SLOPE,
    SHIFT_COLLINEAR
} shift_verdict;

typedef struct shift_work {
    wt_shift_options options;
    pool memory;
    shift_set set;
    double reference_temperature; /* [K] */
    bool measured_reference;      /* the anchor is the reference */
    bool extrapolated;            /* the reference temperature lies outside the isotherms */
    size_t anchor;
    size_t n_good;
    bool *placed;            /* [n] */
    shift_verdict *verdict;  /* [n] */
    size_t *n_outliers;      /* [n] */
    double *a, *b;           /* [n] */
    double *sigma_b;         /* [n] */
    double *correlation;     /* [n] */
    double *physical;        /* [n] log b of rho T */
    double *overlap[MODULI]; /* [n] */
    double *tied; /* [n] what an error of b moves a by, 0 unless they are collinear [decade] */
    double *slope_noise;   /* [n] share of noise in the slopes */
    bool *flat;            /* [n] no slope of its own: takes no part */
    double *covariance;    /* [n * n] of a */
    double *scratch;       /* [n * n + 2 n] */
    double *covariance_ab; /* [2n * 2n] of a, then b */
    double rms[MODULI];
    double last_step;
    superposition_check superposition;
} shift_work;

wt_status shift_master_new(const wt_sweep *sweep, const shift_work *work, wt_parselog *log,
                           wt_master_curve *master, wt_error *err) WT_NODISCARD;

#endif
