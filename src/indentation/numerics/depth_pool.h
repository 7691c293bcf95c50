/* Combined curves of a group, the fit of a law of the modulus against depth to their mean
 * residual, and numbers of that law with errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_DEPTH_POOL_H
#define WT_INDENTATION_NUMERICS_DEPTH_POOL_H

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "indentation/numerics/depth_residuals.h"

/* Largest ratio of the loss error at a shallow depth to that at the whole depth. */
#define DEPTH_SHALLOW_FACTOR 1.5

typedef struct depth_pool {
    const wt_curve_residuals *curve;       /* [n] sorted by spot */
    size_t n, n_excluded_by_loss, n_units; /* n_excluded_by_loss: excluded curves */
    bool by_spot, has_mean;                /* true if the mean curve exists */
    depth_mean mean;
    double *value; /* [n] of the curves, then of the units */
} depth_pool;

typedef struct depth_fit {
    depth_law law;
    double p[DEPTH_PARAMETERS];
    double gain[DEPTH_PARAMETERS]
               [CURVE_WAVES]; /* derivatives of the parameters by the whitened cosines */
    double left;              /* remaining sum of squares */
    double excess;            /* remaining sum of squares over that from scatter; at least 1 */
    double p_value;           /* p value of the lack of fit */
    bool is_valid;
} depth_fit;

/* Number of the curves: mean, error by scatter, and systematic errors. The latter have a sign,
 * because two groups may share them. */
typedef struct depth_value {
    double mean;
    t_error scatter;
    double bend, loss;
} depth_value;

/* Sorts the curves and computes their mean if there are enough. */
void depth_pool_create(depth_pool *d, const wt_contact_table *table, double poisson_ratio,
                       const wt_curve_residuals *curve, size_t n, arena *memory);
/* Fits a law by least squares from `start`. The member `tie` of the mean has the constraint of a
 * tied layer. */
depth_fit depth_fit_law(depth_pool *d, depth_law law, const double *start,
                        wt_error *err) WT_NODISCARD;
/* Computes a number with its error. `at` is its value at the parameters of the fit and `by` its
 * derivatives. with_level adds ln E of each curve. `losses` is the factor of the loss error. The
 * interval uses Student's t over the units. */
depth_value depth_estimate(depth_pool *d, const depth_fit *fit, double at,
                           const double by[DEPTH_PARAMETERS], bool with_level, double losses);
/* Returns the change of a number with these derivatives due to cosines w, over the force. */
double depth_projection(const depth_mean *m, const depth_fit *fit,
                        const double by[DEPTH_PARAMETERS], const double w[CURVE_WAVES]);

#endif
