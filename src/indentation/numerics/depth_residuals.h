/* Inside the fit room: the mean residual of the curves of a group, as cosines, and what a modulus
 * that changes with depth makes of it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_DEPTH_RESIDUALS_H
#define WT_INDENTATION_NUMERICS_DEPTH_RESIDUALS_H

#include "indentation/numerics/curve.h"

enum {
    DEPTH_POINTS = 48, /* of the window of a residual: eight to a half wave of its fastest cosine */
    DEPTH_PARAMETERS = 4, /* those of a layer */
};

/* Contact point [depth], then: ln of the modulus at the top, slope, bend; or ln E1, ln E1/E2, ln
 * (contact radius over thickness); or, of a layer of given thickness on a bulk of given modulus, ln
 * E1 and the slope of what the curves have beside it. */
typedef enum depth_law { DEPTH_LINE, DEPTH_BENT, DEPTH_LAYER, DEPTH_TIED } depth_law;
enum {
    DEPTH_CONTACT,
    DEPTH_LEVEL,
    DEPTH_SLOPE,
    DEPTH_BEND,
    DEPTH_RATIO = DEPTH_SLOPE,
    DEPTH_REACH = DEPTH_BEND
};
/* What a layer is tied to: contact radius at the depth over its thickness, and ln of the modulus of
 * the fit over that of the bulk. */
typedef struct depth_tie {
    double reach, log_ratio;
} depth_tie;

/* The mean curve: what all are taken to share. */
typedef struct depth_mean {
    const wt_contact_table *table;
    double reduced, k, depth, force, length, baseline, window;
    double widest;            /* G' at the depth: twice the contact radius */
    double wave[CURVE_WAVES]; /* over the force */
    double
        bend[CURVE_WAVES]; /* those of the bend that the baselines have in common, if it goes on */
    double loss_error;
    double factor[CURVE_WAVES * CURVE_WAVES]; /* Cholesky's of the scatter of a mean */
    depth_law law;
    depth_tie tie;
    double fitted[DEPTH_POINTS];              /* force of the fit at the points of the window */
    double cosine[DEPTH_POINTS][CURVE_WAVES]; /* of unit waves there */
} depth_mean;

/* ln of the modulus over that of the fit, at a contact radius. */
typedef struct depth_modulus {
    depth_law law;
    double level, slope, bend; /* of line and parabola; slope: of a tied layer, too */
    double ratio, reach;       /* of a layer */
} depth_modulus;

depth_modulus depth_modulus_of(const depth_mean *m, depth_law law, const double *p);
double depth_log_modulus(const depth_modulus *l, double u);

/* What all fits of the mean curve need at the points of its window. */
void depth_mean_prepare(depth_mean *m);
/* Position of a point of the window. */
double depth_mean_point(const depth_mean *m, size_t i);
/* Cosines over the window of a force, of the largest one. */
void depth_mean_cosines(const depth_mean *m, const double d[DEPTH_POINTS],
                        double wave[CURVE_WAVES]);
/* Those of the force of p less that of the fit. */
void depth_mean_waves(const depth_mean *m, const double *p, double wave[CURVE_WAVES]);

#endif
