/* Angular integrals J1 and J2 of any material. Internal to friction.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * A law with a short closed form is evaluated directly. Any other law is integrated once and then
 * read from Chebyshev series in ln w, so that the cost of a velocity does not depend on the
 * material.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_H
#define WT_FRICTION_NUMERICS_ANGULAR_H

#include "core/base/array.h"
#include "core/math/gauss_legendre.h"
#include "weartrack/dma.h"
#include "weartrack/surface.h"

/* ---- integrals of a material --------------------------------------------------------------------
 */

typedef struct angular_law angular_law;

/* Lowest frequency [rad/s]: the series of a material extend far enough below it, and its squares do
 * not underflow. */
#define ANGULAR_MIN_FREQUENCY 1e-250

/* The material is borrowed. The relative errors are far below `tolerance`. The law is allocated in
 * the arena, its series are not: call angular_clear before the arena is freed. */
angular_law *angular_new(const wt_material *material, double tolerance, arena *memory);
void angular_clear(angular_law *angular); /* no effect on NULL */

/* Prepares the series for w from w_min to w_max > 0; a short closed form needs none. Existing
 * series do not change. A closed form with a series is read from the series from then on, which
 * changes results within the stated errors. */
void angular_extend(angular_law *angular, double w_min, double w_max);
/* True if angular_extend has nothing to do for this range. */
bool angular_covers_range(const angular_law *angular, double w_min, double w_max);
/* Evaluates J1 and J2 at n values of w in the covered range; x = ln w. The first and the last value
 * must both be inside or both outside the range of the series. Rising values are fastest. */
void angular_eval(const angular_law *angular, const double *w, const double *x, size_t n,
                  double *j1, double *j2);
/* True if the closed form is used for ln w from x_min to x_max. */
bool angular_uses_closed_form(const angular_law *angular, double x_min, double x_max);
/* Largest relative error of J1 and J2 in a range of ln w, from series and subintervals. *piece is
 * the start of the search: 0, or the value from a lower range. */
double angular_error(const angular_law *angular, double x_min, double x_max, size_t *segment);

/* ---- subintervals of the frequency ----------------------------------------------------------- */

enum { SUBINTERVAL_NODES = 10 }; /* see `max_width` in angular_panels.c */

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
} angular_subintervals;

/* Creates subintervals for w from `low` to `high` > 0 with relative errors of about `goal`. The
 * rule is borrowed. */
void angular_subintervals_new(const wt_material *material, const gauss_rule *rule, double low,
                              double high, double goal, angular_subintervals *subintervals);
void angular_subintervals_clear(angular_subintervals *subintervals);

/* J1 and J2 at w from frequencies up to `high` only. */
void angular_subintervals_integrate(const angular_subintervals *subintervals, double w, double *j1,
                                    double *j2);
/* Relative error of J1 and J2 at w. It excludes the effect of rounding on steep moduli within one
 * subinterval of w: J1 and J2 are steep themselves there. */
double angular_subintervals_error(const angular_subintervals *subintervals, double w, double j1,
                                  double j2);

#endif
