/* Internal to the kernel room: the angular integrals of a law at any frequency, from panels over
 * which the law is evaluated once.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_PANELS_H
#define WT_FRICTION_NUMERICS_ANGULAR_PANELS_H

#include "core/math/gauss_legendre.h"
#include "friction/numerics/angular_weight.h"
#include "weartrack/model.h"

enum { PANEL_NODES = 10 }; /* see `widest` in angular_panels.c */

/* Many narrow panels as one: numbers at its own nodes, with which any kernel that is a polynomial
 * over the group is integrated as by all of them. */
enum { GROUP_NODES = 16, GROUP_LEAST = 8, GROUP_LEVELS = 20 };
typedef struct panel_group {
    double omega[GROUP_NODES], value[2][GROUP_NODES];
} panel_group;

/* With y = ln(omega / w) the integrals are 4 int K F dy of F1 = E'', F2 = |E|^2 with
 *   K = c^s / sqrt(1 - c^2) = sum_m b_m c^(2m + s),   c = e^y,   s = 2 and 1. */
typedef struct angular_panels {
    const wt_material *material;
    const gauss_rule *rule; /* of PANEL_NODES */
    size_t terms;           /* of that sum where c <= 1/2 */
    size_t n;
    double *edge;          /* [n + 1] ln omega */
    double *edge_omega;    /* [n + 1] */
    double *omega;         /* [n * PANEL_NODES] */
    double *value[2];      /* [n * PANEL_NODES] F1 and F2 times weight and width */
    double *below[2];      /* [(n + 1) * terms] int_-inf^edge F (omega / edge)^(2m + s) */
    double *largest;       /* [n + 1] |ln E'| and |ln E''| at the edges so far */
    double start_error[2]; /* of `below` at the first edge, m = 0 */
    double *moved[2];      /* [n + 1] error of `below`, m = 0, from the rounding of ln omega */
    double *numbers;       /* all of them */
    panel_group *group[GROUP_LEVELS]; /* of dense panels, GROUP_LEAST 2^k of them each */
    const angular_weight *weight;     /* borrowed, set once they are made; NULL: 1 */
} angular_panels;

/* For w from `low` to `high` > 0 and relative errors of about `goal`. The rule is borrowed. */
wt_status angular_panels_new(const wt_material *material, const gauss_rule *rule, double low,
                             double high, double goal, angular_panels *panels,
                             wt_error *err) WT_NODISCARD;
void angular_panels_clear(angular_panels *panels);

/* J1 at n frequencies that are all twice `high` or more. */
void angular_panels_far(const angular_panels *panels, const double *w, size_t n, double *j1);
/* J1 and J2 at w, from frequencies up to `high` alone. */
void angular_panels_integrate(const angular_panels *panels, double w, double *j1, double *j2);
/* Relative error of J1 and J2 at w, but for what rounding makes of steep moduli closer to w than a
 * panel: there J1 and J2 are steep themselves. */
double angular_panels_error(const angular_panels *panels, double w, double j1, double j2);

#endif
