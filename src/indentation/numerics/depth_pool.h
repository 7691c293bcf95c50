/* Inside the fit room: the curves of a group together, a law of the modulus against depth fitted to
 * their mean residual, and numbers of that law with their errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_DEPTH_POOL_H
#define WT_INDENTATION_NUMERICS_DEPTH_POOL_H

#include "core/base/arena.h"
#include "core/math/students_t.h"
#include "indentation/numerics/depth_residuals.h"

/* Of the error of a memory, at no depth more than at the whole one. */
#define DEPTH_MORE_SHALLOW 1.5

typedef struct depth_pool {
    const wt_depth_curve *curve; /* [n] by spot */
    size_t n, n_lossy, n_units;  /* n_lossy: left out */
    bool by_spot, known;         /* known: there is a mean */
    depth_mean mean;
    double *value; /* [n], then of the units */
} depth_pool;

typedef struct depth_fit {
    depth_law law;
    double p[DEPTH_PARAMETERS];
    double gain[DEPTH_PARAMETERS][CURVE_WAVES]; /* of the parameters by the whitened waves */
    double left;                                /* of the squares */
    double excess;                              /* of them over what scatter leaves; 1 at least */
    double chance;                              /* of more by scatter alone */
    bool good;
} depth_fit;

/* A number of the curves: its mean, error by scatter, and what all curves share in it: signed, for
 * two groups may share it, too. */
typedef struct depth_value {
    double mean;
    t_error scatter;
    double bend, loss;
} depth_value;

/* Curves sorted, their mean if they are enough; memory.failed where that has no room. */
void depth_pool_make(depth_pool *d, const wt_contact_table *table, double poisson_ratio,
                     const wt_depth_curve *curve, size_t n, arena *memory);
/* Least squares from `start`; the member `thin` of the mean says what a tied layer is tied to. */
depth_fit depth_fit_law(depth_pool *d, depth_law law, const double *start,
                        wt_error *err) WT_NODISCARD;
/* `at` for the parameters of the fit, its derivatives by them, and with_level: with ln E of each
 * curve; losses: errors of the memory in it. By Student's t over the units. */
depth_value depth_value_of(depth_pool *d, const depth_fit *fit, double at,
                           const double by[DEPTH_PARAMETERS], bool with_level, double losses);
/* What whole waves w, over the force, add to a number with these derivatives. */
double depth_share_of(const depth_mean *m, const depth_fit *fit, const double by[DEPTH_PARAMETERS],
                      const double w[CURVE_WAVES]);

#endif
