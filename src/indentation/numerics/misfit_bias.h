/* Sums that describe a misfit and the effects of variations of the tip.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_MISFIT_BIAS_H
#define WT_INDENTATION_NUMERICS_MISFIT_BIAS_H

#include "indentation/numerics/curve.h"

enum {
    MISFIT_SMOOTH = 10,            /* functions of the depth that represent a discrepancy */
    MISFIT_RADIUS = MISFIT_SMOOTH, /* effect of another radius of the tip */
    MISFIT_FUNCTIONS,
    MISFIT_VARIATIONS = CURVE_TIP_VARIATIONS + 1, /* variations of the tip, and a pull */
    /* The last columns are the curvatures of the variations. */
    MISFIT_COLUMNS = MISFIT_FUNCTIONS + MISFIT_VARIATIONS + CURVE_TIP_VARIATIONS,
};

/* Whitened sums in units of the noise: columns of the discrepancy without the part that the
 * parameters explain, columns of the tip variations and of a pull, and curvatures of the tip
 * variations. */
typedef struct misfit_sums {
    size_t n_free, which[CURVE_N_PARAMETERS]; /* free parameters */
    size_t n_tips, n_variations; /* variations of the tip; all variations, with a pull */
    bool
        unstated_radius; /* an unstated radius that the residual determines; else its column is 0 */
    double parameter_change[CURVE_N_PARAMETERS]
                           [MISFIT_COLUMNS];   /* change of the parameters per unit of a column */
    double mm[MISFIT_COLUMNS][MISFIT_COLUMNS]; /* products of the columns */
    double my[MISFIT_COLUMNS];                 /* products with the residual */
} misfit_sums;

/* Candidate discrepancy: likelihood, and mean change and variance of the parameters. */
typedef struct misfit_candidate {
    double log_likelihood, chance, shift[CURVE_N_PARAMETERS], variance[CURVE_N_PARAMETERS];
} misfit_candidate;

/* Eliminates the variations of the tip, as parameters with a standard deviation of 1, from the
 * sums. `none` receives their effect without a discrepancy. If they fit better than the stated tip,
 * the whole deviation counts, because the residual does not determine which size is wrong. `tip`
 * receives the part of the variances due to the stated errors. Returns false without a solution. */
bool misfit_remove_bias(misfit_sums *d, misfit_candidate *none, double tip[CURVE_N_PARAMETERS]);

static inline double misfit_dot(const double *a, const double *b, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

#endif
