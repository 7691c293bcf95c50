/* Angular integrals of a law at any frequency, from subintervals on which the law is evaluated
 * once. Internal to friction.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_PANELS_H
#define WT_FRICTION_NUMERICS_ANGULAR_PANELS_H

#include "core/math/gauss_legendre.h"
#include "friction/numerics/angular_weight.h"
#include "weartrack/dma.h"

enum { SUBINTERVAL_NODES = 10 }; /* see `max_width` in angular_subintervals.c */

/* Group of many narrow subintervals. The values at its own nodes integrate any kernel that is a
 * polynomial over the group exactly as all subintervals do. */
enum { GROUP_NODES = 16, GROUP_LEAST = 8, GROUP_LEVELS = 20 };
typedef struct subinterval_group {
    double omega[GROUP_NODES], value[2][GROUP_NODES];
} subinterval_group;

/* With y = ln(omega / w) the integrals are 4 int K F dy of F1 = E'', F2 = |E|^2 with
 *   K = c^s / sqrt(1 - c^2) = sum_m b_m c^(2m + s),   c = e^y,   s = 2 and 1. */
typedef struct angular_subintervals {
    const wt_material *material;
    const gauss_rule *rule; /* of SUBINTERVAL_NODES */
    size_t terms;           /* number of terms of the sum for c <= 1/2 */
    size_t n;
    double *edge;          /* [n + 1] ln omega */
    double *edge_omega;    /* [n + 1] */
    double *omega;         /* [n * SUBINTERVAL_NODES] */
    double *value[2];      /* [n * SUBINTERVAL_NODES] F1 and F2 times weight and width */
    double *below[2];      /* [(n + 1) * terms] int_-inf^edge F (omega / edge)^(2m + s) */
    double *largest;       /* [n + 1] largest |ln E'| and |ln E''| up to each edge */
    double start_error[2]; /* error of `below` at the first edge for m = 0 */
    double *rounding[2];   /* [n + 1] error of `below` for m = 0 from the rounding of ln omega */
    double *numbers;       /* memory of these arrays */
    subinterval_group *group[GROUP_LEVELS]; /* groups of dense subintervals; level k has GROUP_LEAST
                                         2^k of them in each group */
    const angular_weight *weight; /* borrowed, set after creation; NULL for the weight 1 */
} angular_subintervals;

/* Creates subintervals for w from `low` to `high` > 0 with relative errors of about `goal`. The
 * rule is borrowed. */
wt_status angular_subintervals_new(const wt_material *material, const gauss_rule *rule, double low,
                                   double high, double goal, angular_subintervals *subintervals,
                                   wt_error *err) WT_NODISCARD;
void angular_subintervals_clear(angular_subintervals *subintervals);

/* J1 at n frequencies >= 2 `high`. */
void angular_subintervals_far(const angular_subintervals *subintervals, const double *w, size_t n,
                              double *j1);
/* J1 and J2 at w from frequencies up to `high` only. */
void angular_subintervals_integrate(const angular_subintervals *subintervals, double w, double *j1,
                                    double *j2);
/* Relative error of J1 and J2 at w. It excludes the effect of rounding on steep moduli within one
 * subinterval of w: J1 and J2 are steep themselves there. */
double angular_subintervals_error(const angular_subintervals *subintervals, double w, double j1,
                                  double j2);

#endif
