/* Residual of a fit in blocks of the contact and of the baseline before it, with the noise of the
 * blocks as an autoregression.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_RESIDUAL_BLOCKS_H
#define WT_INDENTATION_NUMERICS_RESIDUAL_BLOCKS_H

#include "indentation/numerics/curve_model.h"

enum {
    BLOCKS_WINDOW = 48,       /* blocks of the contact */
    BLOCKS_BEFORE = 400,      /* largest number of blocks of the baseline */
    BLOCKS_MIN_BASELINE = 16, /* smallest baseline that determines the noise alone */
    BLOCKS_MAX_ORDER = 6,     /* order of the autoregression */
    BLOCKS_HISTORY = BLOCKS_MAX_ORDER + BLOCKS_WINDOW,
    BLOCKS_COLUMNS = CURVE_N_PARAMETERS + WAVE_PARAMETERS,
};
/* Blocks per degree of freedom of the noise variance. Simulations with noise of several colours
 * determine it (1 % false alarms for white, first-order and 1/f noise). */
#define BLOCKS_PER_FREEDOM 10.0

typedef struct residual_blocks {
    size_t n_before, n; /* blocks of the baseline, and of the window after it */
    double r[BLOCKS_BEFORE + BLOCKS_WINDOW];
    double column[BLOCKS_COLUMNS][BLOCKS_HISTORY]; /* columns of the window and of its history */
    double depth[BLOCKS_HISTORY]; /* mean indentation of the samples in contact, relative to the
                                     largest */
    double touch[BLOCKS_HISTORY]; /* effect of a unit force in contact on the residual */
    size_t n_columns;
    size_t length;           /* samples per block */
    size_t first;            /* first sample of the window */
    double travel;           /* travel in the window [m] */
    size_t gap_from, gap_to; /* blocks of the window with samples that are not compared */
    size_t order;
    double a[BLOCKS_MAX_ORDER + 1]; /* x_i = sum a_k x_(i-k) + innovation, k from 1 */
    double innovation;              /* variance of the innovations */
    double freedom;                 /* degrees of freedom of that variance */
} residual_blocks;

/* Computes block means of the residuals e and of the derivatives at the parameters of the latest
 * evaluation. The window begins a fifth of the contact before it, because a snap-in may be there.
 * Returns false if no sample is in contact. */
bool residual_blocks_average(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                             const double *e, residual_blocks *b);
/* Estimates the noise of the baseline without its slow part. If the baseline is short, the window
 * is used too. Returns false without noise. */
bool residual_blocks_find_noise(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                residual_blocks *b);
/* Computes the n innovations of x[from..]. */
void residual_blocks_whiten(const residual_blocks *b, const double *x, size_t from, size_t n,
                            double *out);
/* Sets the innovations of blocks with samples that are not compared to 0. */
void residual_blocks_zero_gap(const residual_blocks *b, double *x);

/* Subtracts the projection on the unit vector q from x and returns its coefficient. */
double residual_subtract_projection(const double *q, double *x, size_t n);
/* Orthonormalises the columns one by one and subtracts their projections from r. Returns the sum of
 * squares of the projections from column `count` on, and their number. Columns and r are destroyed.
 */
double residual_orthogonalise(double *r, double *const *columns, size_t n_columns, size_t count,
                              size_t n, size_t *n_counted);

#endif
