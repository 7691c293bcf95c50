/* Inside the fit room: the residual of a fit in blocks, those of the contact and those of the
 * baseline before it, and the noise of one block as an autoregression of those before.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_RESIDUAL_BLOCKS_H
#define WT_INDENTATION_NUMERICS_RESIDUAL_BLOCKS_H

#include "indentation/numerics/curve_model.h"

enum {
    BLOCKS_WINDOW = 48,   /* blocks of the contact */
    BLOCKS_BEFORE = 400,  /* most of the baseline */
    BLOCKS_LEAST = 16,    /* of the baseline, to know the noise by it alone */
    BLOCKS_MAX_ORDER = 6, /* of the autoregression */
    BLOCKS_HISTORY = BLOCKS_MAX_ORDER + BLOCKS_WINDOW,
    BLOCKS_COLUMNS = CURVE_N_PARAMETERS + WAVE_PARAMETERS,
};
/* Blocks of the noise that are one degree of freedom of its variance: what simulated noise of
 * several colours asks for (false alarms of 1 % for white, first-order and 1/f noise). */
#define BLOCKS_PER_FREEDOM 10.0

typedef struct residual_blocks {
    size_t n_before, n; /* blocks of the baseline and of the window behind it */
    double r[BLOCKS_BEFORE + BLOCKS_WINDOW];
    double column[BLOCKS_COLUMNS][BLOCKS_HISTORY]; /* of the window, and what it owes to */
    double depth[BLOCKS_HISTORY]; /* mean indentation of the samples in contact, of the largest */
    double touch[BLOCKS_HISTORY]; /* what a force of 1 on them adds to the residual */
    size_t n_columns;
    size_t length;           /* samples in one */
    size_t first;            /* sample at which the window begins */
    double travel;           /* of the window [m] */
    size_t gap_from, gap_to; /* blocks of the window with samples that are not compared */
    size_t order;
    double a[BLOCKS_MAX_ORDER + 1]; /* x_i = sum a_k x_(i-k) + innovation, k from 1 */
    double innovation;              /* its variance */
    double freedom;                 /* degrees of freedom that it has */
} residual_blocks;

/* Block means of the residuals e and of the derivatives, at the parameters of the latest
 * evaluation; the window begins a fifth of the contact before it, for a snap-on hides there. False
 * if nothing is in contact. */
bool residual_blocks_average(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                             const double *e, residual_blocks *b);
/* The noise of the baseline, or where that is short of baseline and window together, less what is
 * slow in it. False if there is none. */
bool residual_blocks_find_noise(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                residual_blocks *b);
/* Innovations of x[from..], n of them. */
void residual_blocks_whiten(const residual_blocks *b, const double *x, size_t from, size_t n,
                            double *out);
/* Innovations of the window that samples which are not compared are part of are set to 0. */
void residual_blocks_leave_out_gap(const residual_blocks *b, double *x);

/* x less the part of it along the unit vector q, which is returned. */
double residual_remove_along(const double *q, double *x, size_t n);
/* Makes columns orthonormal one by one and takes them out of r; returns the sum of squares that
 * those from `count` on take, and how many they are. Destroys columns and r. */
double residual_project_out(double *r, double *const *columns, size_t n_columns, size_t count,
                            size_t n, size_t *n_counted);

#endif
