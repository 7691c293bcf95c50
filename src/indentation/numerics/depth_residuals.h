/* Mean residual of the curves of a group as cosines, and the effect of a modulus that depends on
 * depth.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_DEPTH_RESIDUALS_H
#define WT_INDENTATION_NUMERICS_DEPTH_RESIDUALS_H

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

depth_modulus depth_modulus_create(const depth_mean *m, depth_law law, const double *p);
double depth_log_modulus(const depth_modulus *l, double u);

/* Tabulates values at the points of the window that all fits of the mean curve share. */
void depth_mean_prepare(depth_mean *m);
/* Position of a point of the window. */
double depth_mean_point(const depth_mean *m, size_t i);
/* Computes the cosines of a force over the window, relative to the largest force. */
void depth_mean_cosines(const depth_mean *m, const double d[DEPTH_POINTS],
                        double wave[CURVE_WAVES]);
/* Computes the cosines of the force at p minus that of the fit. */
void depth_mean_waves(const depth_mean *m, const double *p, double wave[CURVE_WAVES]);

#endif
