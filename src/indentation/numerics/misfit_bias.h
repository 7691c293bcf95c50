/* Inside the fit room: what data and law say of a misfit and of moves of the tip, in sums.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_MISFIT_BIAS_H
#define WT_INDENTATION_NUMERICS_MISFIT_BIAS_H

#include "indentation/numerics/curve.h"

enum {
    MISFIT_SMOOTH = 10,            /* functions of the depth, that carry a discrepancy */
    MISFIT_RADIUS = MISFIT_SMOOTH, /* and what another radius of the tip changes */
    MISFIT_FUNCTIONS,
    MISFIT_MOVES = CURVE_TIP_MOVES + 1, /* and a pull */
    /* and how moves of the tip bend */
    MISFIT_COLUMNS = MISFIT_FUNCTIONS + MISFIT_MOVES + CURVE_TIP_MOVES,
};

/* Whitened and in units of the noise: the discrepancy's columns without what the parameters can
 * imitate, those of moves of the tip and a pull behind them, and then the bends of the former. */
typedef struct misfit_sums {
    size_t n_free, which[CURVE_N_PARAMETERS]; /* the free parameters */
    size_t n_tips, n_moves;                   /* moves of the tip; with a pull */
    bool any_radius; /* an unstated one that the residual tells, else its column is 0 */
    double imitated[CURVE_N_PARAMETERS][MISFIT_COLUMNS]; /* of the parameters, by 1 of a column */
    double mm[MISFIT_COLUMNS][MISFIT_COLUMNS];           /* sums of the columns with each other */
    double my[MISFIT_COLUMNS];                           /* and the residual */
} misfit_sums;

/* What the parameters would be, and how sure that is. */
typedef struct misfit_candidate {
    double log_likelihood, chance, shift[CURVE_N_PARAMETERS], variance[CURVE_N_PARAMETERS];
} misfit_candidate;

/* Takes the moves of the tip out of the sums, as parameters with a deviation of 1 each; what they
 * alone make of the others is what is without a discrepancy. Where they fit better
 * than the stated tip all of its deviation counts: which of its sizes is off the residual does not
 * say. tip: of the variances, that of the stated errors of the tip. False if there is no solution.
 */
bool misfit_remove_bias(misfit_sums *d, misfit_candidate *none, double tip[CURVE_N_PARAMETERS]);

static inline double misfit_dot(const double *a, const double *b, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

#endif
