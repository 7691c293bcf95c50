/* Inside the library: adhesive contact of any tip, after Johnson, Kendall and Roberts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_MODEL_ADHESION_H
#define WT_MODEL_ADHESION_H

#include "weartrack/model.h"

/* Whether the law below holds: not for a punch, which has no smaller contact to grow from, nor on a
 * thin sample. */
bool adhesion_applies(const wt_tip *tip);

typedef struct adhesion {
    const wt_tip *tip;
    double reduced; /* E/(1-nu^2) [Pa] */
    double work;    /* of adhesion [J/m^2], >= 0 */
} adhesion;

/* At one contact radius. Derivatives along the branch; by modulus and work at one depth. */
typedef struct adhesive_contact {
    double depth, force;
    double stiffness;           /* dF/ddelta */
    double by_modulus, by_work; /* dF/dE*, dF/dw; by_work: infinite without adhesion */
} adhesive_contact;
adhesive_contact adhesion_at(const adhesion *law, double radius);

/* The contact radius at which a lever of spring constant k lets go; k = 0: under a dead load,
 * INFINITY: at a fixed depth. 0 without adhesion. */
double adhesion_release(const adhesion *law, double k);
/* The largest contact radius with depth + force/k = position. release: that of this k; a position
 * that it cannot reach gives it. start: a guess, or 0. */
double adhesion_radius(const adhesion *law, double k, double position, double release,
                       double start);
/* The work of adhesion of a pull-off force [N] > 0; of a punch, whose edge lets go, by Kendall;
 * NaN on a thin sample, and outside of a nanojoule to a kilojoule per square metre. */
double adhesion_work(const wt_tip *tip, double reduced, double k, double pull_off);
/* Of Tabor: above 5 the law is that of Johnson, Kendall and Roberts, below 0.1 that of Derjaguin,
 * Muller and Toporov. NaN for a tip without a curvature. */
double adhesion_tabor(const adhesion *law);

#endif
