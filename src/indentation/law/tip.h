/* Inside the model room: what tips and contact laws share.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_TIP_H
#define WT_INDENTATION_LAW_TIP_H

#include "core/base/param.h"
#include "weartrack/model.h"

/* What the short text form names, with its limits; which shape takes which is in tip_text.c, and
 * what must go together in wt_tip_check. */
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

/* On a half-space: G, dG/ddelta = 2a and d2G/ddelta2 at delta > 0; the curvature is that of the
 * side above at the switch depth b^2/R, where it jumps. */
typedef struct contact_point_values {
    double g, slope, curvature;
} contact_point_values;
contact_point_values contact_values(const wt_tip *tip, double delta);

/* Of a contact radius over the thickness of a sample on a rigid base: up to it the force is known.
 */
#define THIN_SAMPLE_REACH 1.0
double thin_sample_reach(const wt_tip *tip, double delta);
/* What the base makes of G and slope of a half-space; no curvature. */
contact_point_values thin_sample_values(const wt_tip *tip, contact_point_values half_space);

/* Of a depth over the radius of a sphere, paraboloid or punch: up to it the contact law holds.
 * Strains are of the order of 1 there, and a sphere's paraboloid is 11 % off. */
#define ROUND_TIP_REACH 1.0
/* Whether the contact law of a tip holds at a depth, on a thin sample too. */
bool contact_law_holds(const wt_tip *tip, double depth);

/* The tip of a table. */
const wt_tip *contact_table_tip(const wt_contact_table *table);
/* contact_values at n depths [n each], 0 out of contact; the curvature to 1e-8. A thin sample's is
 * that of a half-space. */
void contact_table_values(const wt_contact_table *table, const double *delta, size_t n, double *g,
                          double *slope, double *curvature);

/* A pyramid or cone with a cap from the words of wt_tip_describe; false of other tips and words. */
bool tip_from_description(const char *words, wt_tip *tip);
/* The same of a tip of any shape. */
bool tip_of_any_description(const char *words, wt_tip *tip);

/* The depth b^2/R below which a blunted tip is a paraboloid; infinite for a paraboloid, 0 for
 * others. */
double contact_switch_depth(const wt_tip *tip);

#endif
