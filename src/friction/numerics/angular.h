/* Angular integrals J1 and J2 of any material. Internal to friction.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * Both have the weight of anisotropic roughness in the integrand, if one is set. A law with a short
 * closed form is evaluated directly. Any other law is integrated once and then read from Chebyshev
 * series in ln w, so that the cost of a velocity does not depend on the material.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_H
#define WT_FRICTION_NUMERICS_ANGULAR_H

#include "core/base/arena.h"
#include "friction/numerics/angular_weight.h"
#include "weartrack/dma.h"

typedef struct angular_law angular_law;

/* Lowest frequency [rad/s]: the series of a material extend far enough below it, and its squares do
 * not underflow. */
#define ANGULAR_MIN_FREQUENCY 1e-250

/* The material is borrowed. The relative errors are far below `tolerance`. The law is allocated in
 * the arena, its series are not: call angular_clear before the arena is freed. */
wt_status angular_new(const wt_material *material, double tolerance, arena *memory,
                      angular_law **angular, wt_error *err) WT_NODISCARD;
void angular_clear(angular_law *angular); /* no effect on NULL */
/* Sets the weight of both integrals; call it before the first angular_extend. The weight is
 * borrowed. */
void angular_set_weight(angular_law *angular, const angular_weight *weight);

/* Prepares the series for w from w_min to w_max > 0; a short closed form needs none. Existing
 * series do not change. A closed form with a series is read from the series from then on, which
 * changes results within the stated errors. */
wt_status angular_extend(angular_law *angular, double w_min, double w_max,
                         wt_error *err) WT_NODISCARD;
/* True if angular_extend has nothing to do for this range. */
bool angular_covers_range(const angular_law *angular, double w_min, double w_max);
/* Prepares angular_extrapolated_part. */
wt_status angular_prepare_outside(angular_law *angular, wt_error *err) WT_NODISCARD;
/* Evaluates J1 and J2 at n values of w in the covered range; x = ln w. The first and the last value
 * must both be inside or both outside the range of the series. Rising values are fastest. */
void angular_eval(const angular_law *angular, const double *w, const double *x, size_t n,
                  double *j1, double *j2);
/* True if the closed form is used for ln w from x_min to x_max. */
bool angular_uses_closed_form(const angular_law *angular, double x_min, double x_max);
/* Largest relative error of J1 and J2 in a range of ln w, from series and subintervals. *piece is
 * the start of the search: 0, or the value from a lower range. */
double angular_error(const angular_law *angular, double x_min, double x_max, size_t *segment);
/* Parts of J1(w) from frequencies outside the measured range, at n <= GAUSS_NODES_MAX values of w;
 * j1 = J1(w). */
void angular_extrapolated_part(const angular_law *angular, const double *w, const double *j1,
                               size_t n, double *outside);
/* True if the material has at least one limit of its measured range. */
bool angular_has_limits(const angular_law *angular);

#endif
