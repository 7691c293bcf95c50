/* Combined curves of a group, the fit of a law of the modulus against depth to their mean
 * residual, and numbers of that law with errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_DEPTH_POOL_H
#define WT_INDENTATION_NUMERICS_DEPTH_POOL_H

#include "core/base/array.h"
#include "core/math/students_t.h"
#include "indentation/numerics/curve.h"

enum {
    DEPTH_POINTS =
        48, /* points of the window of a residual; eight per half wave of the fastest cosine */
    DEPTH_PARAMETERS = 4, /* parameters of a layer */
};

/* Laws. The first parameter is the shift of the contact point over the depth. DEPTH_LINE and
 * DEPTH_QUADRATIC: ln of the modulus at the largest depth, slope, curvature. DEPTH_LAYER: ln E1, ln
 * E1/E2, ln (contact radius over thickness). DEPTH_TIED (layer of given thickness on a bulk of
 * given modulus): ln E1, additional slope. */
typedef enum depth_law { DEPTH_LINE, DEPTH_QUADRATIC, DEPTH_LAYER, DEPTH_TIED } depth_law;

enum {
    DEPTH_CONTACT,
    DEPTH_LEVEL,
    DEPTH_SLOPE,
    DEPTH_BEND,
    DEPTH_RATIO = DEPTH_SLOPE,
    DEPTH_REACH = DEPTH_BEND
};

/* Constraint of a tied layer: contact radius at the depth over the thickness, and ln of the modulus
 * of the fit over that of the bulk. */
typedef struct depth_tie {
    double reach, log_ratio;
} depth_tie;

/* Mean curve, with the parameters that all curves share. */
typedef struct depth_mean {
    const wt_contact_table *table;
    double reduced, k, depth, force, length, baseline, window;
    double widest;            /* G' at the depth, which is twice the contact radius */
    double wave[CURVE_WAVES]; /* relative to the force */
    double bend[CURVE_WAVES]; /* cosines of the common slope change of the baselines, if it
                                 continues in contact */
    double loss_error;
    double factor[CURVE_WAVES * CURVE_WAVES]; /* Cholesky factor of the covariance of the mean */
    depth_law law;
    depth_tie tie;
    double fitted[DEPTH_POINTS];              /* force of the fit at the points of the window */
    double cosine[DEPTH_POINTS][CURVE_WAVES]; /* unit cosines at the points */
} depth_mean;

/* ln of the modulus over that of the fit, as a function of the contact radius. */
typedef struct depth_modulus {
    depth_law law;
    double level, slope, bend; /* of line and parabola; slope also of a tied layer */
    double ratio, reach;       /* of a layer */
} depth_modulus;

/* Largest ratio of the loss error at a shallow depth to that at the whole depth. */
#define DEPTH_SHALLOW_FACTOR 1.5

typedef struct depth_pool {
    const wt_curve_residuals *curve;       /* [n] sorted by spot */
    size_t n, n_excluded_by_loss, n_units; /* n_excluded_by_loss: excluded curves */
    bool by_spot, two_spots;
    bool has_mean; /* true if the mean curve exists */
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
depth_modulus depth_modulus_create(const depth_mean *m, depth_law law, const double *p);
double depth_log_modulus(const depth_modulus *l, double u);
/* Computes the cosines of the force at p minus that of the fit. */
void depth_mean_waves(const depth_mean *m, const double *p, double wave[CURVE_WAVES]);

#endif
