/* Inside the library: adhesive contact of any tip, after Johnson, Kendall and Roberts.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_ADHESION_H
#define WT_INDENTATION_LAW_ADHESION_H

#include "weartrack/model.h"

/* Whether the law below holds: not for a punch, which has no smaller contact to grow from, nor on a
 * thin sample. */
bool adhesion_applies(const wt_tip *tip);

typedef struct adhesion {
    const wt_contact_table *table; /* of the tip */
    double reduced;                /* E/(1-nu^2) [Pa] */
    double work;                   /* of adhesion [J/m^2], >= 0 */
} adhesion;

/* A place on the branch is given by its bare depth: that of a contact without adhesion that is as
 * large. Derivatives along the branch; by modulus and work at one depth. */
typedef struct adhesive_contact {
    double radius, depth, force;
    double stiffness;           /* dF/ddelta */
    double by_modulus, by_work; /* dF/dE*, dF/dw; by_work: infinite without adhesion */
} adhesive_contact;
adhesive_contact adhesion_at(const adhesion *law, double bare);
/* The same at up to ADHESION_BLOCK places. */
enum { ADHESION_BLOCK = 32 };
typedef struct adhesive_contacts {
    double radius[ADHESION_BLOCK], depth[ADHESION_BLOCK], force[ADHESION_BLOCK],
        stiffness[ADHESION_BLOCK], by_modulus[ADHESION_BLOCK], by_work[ADHESION_BLOCK];
} adhesive_contacts;
void adhesion_along(const adhesion *law, const double *bare, size_t n, adhesive_contacts *to);

/* The bare depth at which a lever of spring constant k lets go; k = 0: under a dead load, INFINITY:
 * at a fixed depth. 0 without adhesion. */
double adhesion_release(const adhesion *law, double k);
/* The largest bare depths with depth + force/k = position, of n positions. release: that of this k;
 * a position that it cannot reach gives it. Quick where positions follow one another. */
void adhesion_balance(const adhesion *law, double k, double release, const double *position,
                      size_t n, double *bare);
/* The work of adhesion of a pull-off force [N] > 0; of a punch, whose edge lets go, by Kendall;
 * NaN on a thin sample, and outside of a nanojoule to a kilojoule per square metre. */
double adhesion_work(const wt_contact_table *table, double reduced, double k, double pull_off);
/* Of Tabor: above 5 the law is that of Johnson, Kendall and Roberts, below 0.1 that of Derjaguin,
 * Muller and Toporov. NaN for a tip without a curvature. */
double adhesion_tabor(const adhesion *law);

#endif
