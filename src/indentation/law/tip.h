/* Declarations that tips and contact laws share. Internal to the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_TIP_H
#define WT_INDENTATION_LAW_TIP_H

#include "core/base/param.h"
#include "weartrack/indentation.h"

/* Dimensions of the short text form with their limits. tip.c defines the dimensions of each shape,
 * and wt_tip_check their combinations. */
typedef enum tip_dimension {
    TIP_HALF_ANGLE,
    TIP_RADIUS,
    TIP_SIDES,
    TIP_TRANSITION,
    TIP_N_DIMENSIONS
} tip_dimension;
extern const wt_param tip_dimensions[TIP_N_DIMENSIONS];

/* m(n) = (n/pi) sin(pi/n), the ratio of the mean to the largest distance of the faces from the axis
 * in Rico's averaging; 1 for sides = 0. */
double tip_facet_factor(unsigned sides);
/* Transition radius of a tip that states none: R cos(half-angle), where a sphere is tangent to the
 * faces, but at most the radius of equal slopes. Beyond that the averaged faces of a flat tip with
 * few sides, such as that of Berkovich, would be concave. */
double tip_default_transition(double radius, double half_angle, unsigned sides);
/* Largest transition radius of a convex tip. */
double tip_largest_transition(double radius, double half_angle, unsigned sides);

/* Contact function of a half-space: G, dG/ddelta = 2a and d2G/ddelta2 at delta > 0. The curvature
 * jumps at the switch depth b^2/R; there it is the value above. */
typedef struct contact_point_values {
    double g, slope, curvature;
} contact_point_values;
contact_point_values contact_values(const wt_tip *tip, double delta);

/* Largest contact radius over the thickness of a sample on a rigid base for which the force is
 * known. */
#define THIN_SAMPLE_MAX_RATIO 1.0
/* Up to this ratio the base changes the modulus by 0.1 %, so that the sample is thick. */
#define THICK_SAMPLE_MAX_RATIO 0.001
double thin_sample_radius_ratio(const wt_tip *tip, double delta);
/* Corrects G and slope of a half-space for the rigid base. The curvature is NaN. */
contact_point_values thin_sample_values(const wt_tip *tip, contact_point_values half_space);

/* Largest depth over the radius of a sphere, paraboloid or punch for which the contact law applies.
 * Strains are of the order of 1 there, and a paraboloid differs from a sphere by 11 %. */
#define ROUND_TIP_MAX_DEPTH_RATIO 1.0
/* True if the contact law of a tip applies at a depth, including the limit of a thin sample. */
bool contact_law_is_valid(const wt_tip *tip, double depth);

/* Returns the tip of a table. */
const wt_tip *contact_table_tip(const wt_contact_table *table);
/* Computes contact_values at n depths [n each], 0 out of contact. The curvature has an error of
 * 1e-8. A thin sample has the values of a half-space. */
void contact_table_values(const wt_contact_table *table, const double *delta, size_t n, double *g,
                          double *slope, double *curvature);

/* True if two tips differ by more than the rounding of a file. */
bool tips_differ(const wt_tip *a, const wt_tip *b);

/* Returns the depth b^2/R below which a blunted tip is a paraboloid. It is infinite for a
 * paraboloid and 0 for other tips. */
double contact_switch_depth(const wt_tip *tip);

/* ---- layer on a half-space ------------------------------------------------------------------- */

/* Layer (E1, thickness h) bonded to a half-space (E2), both incompressible, under a rigid tip
 * without friction. Range of the ratio of moduli within which the law is accurate to 2 %. */
#define THIN_LAYER_MIN_RATIO 0.3
#define THIN_LAYER_MAX_RATIO 3.0

/* Apparent modulus of a homogeneous model over E1. ratio = E1/E2; x = contact radius of the
 * homogeneous half-space at that depth over h. The error is below 2 % where thin_layer_is_valid. */
double thin_layer_apparent_modulus(double ratio, double x);
bool thin_layer_is_valid(double ratio, double x);

#endif
