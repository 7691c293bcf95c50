/* Adhesive contact of any tip after Johnson, Kendall and Roberts. Internal to the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_ADHESION_H
#define WT_INDENTATION_LAW_ADHESION_H

#include "weartrack/indentation.h"

/* The law is that of a thick sample. Returns whether it applies to a tip: a punch has no smaller
 * contact from which it grows. */
bool adhesion_applies(const wt_tip *tip);

typedef struct adhesion {
    const wt_contact_table *table; /* contact table of the tip */
    double reduced;                /* E/(1-nu^2) [Pa] */
    double work;                   /* work of adhesion [J/m^2], >= 0 */
} adhesion;

/* Contact at a point of the branch. The parameter is the bare depth, which is the depth of a
 * contact without adhesion of equal size. stiffness is the derivative along the branch. by_modulus
 * and by_work are derivatives at constant depth. */
typedef struct adhesive_contact {
    double radius, depth, force;
    double stiffness;           /* dF/ddelta */
    double by_modulus, by_work; /* dF/dE*, dF/dw; by_work is infinite without adhesion */
} adhesive_contact;
adhesive_contact adhesion_contact_value(const adhesion *law, double bare);
/* Contacts at up to ADHESION_BLOCK points. */
enum { ADHESION_BLOCK = 32 };
typedef struct adhesive_contacts {
    double radius[ADHESION_BLOCK], depth[ADHESION_BLOCK], force[ADHESION_BLOCK],
        stiffness[ADHESION_BLOCK], by_modulus[ADHESION_BLOCK], by_work[ADHESION_BLOCK];
} adhesive_contacts;
void adhesion_contacts(const adhesion *law, const double *bare, size_t n, adhesive_contacts *to);

/* Returns the bare depth at which a cantilever of spring constant k pulls off. k = 0 means dead
 * load, INFINITY a fixed depth. The result is 0 without adhesion. */
double adhesion_release(const adhesion *law, double k);
/* Computes the largest bare depths with depth + force/k = position for n positions. `release` is
 * the result of adhesion_release for this k; positions beyond it return it. Consecutive positions
 * should be close for speed. */
void adhesion_balance(const adhesion *law, double k, double release, const double *position,
                      size_t n, double *bare);
/* Returns the work of adhesion for a pull-off force [N] > 0. A punch uses Kendall's law. The result
 * is NaN outside 1 nJ/m^2 to 1 kJ/m^2. */
double adhesion_work(const wt_contact_table *table, double reduced, double k, double pull_off);
/* Returns Tabor's parameter. Above 5 the law of Johnson, Kendall and Roberts applies, below 0.1
 * that of Derjaguin, Muller and Toporov. The result is NaN for a tip without curvature. */
double adhesion_tabor(const adhesion *law);

#endif
