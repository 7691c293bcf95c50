/* Internal to the kernel room: the angular integrals J1 and J2 of any material.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * each with the weight of anisotropic roughness under the integral, if there is one.
 * From the closed form of the law where it has one; otherwise integrated once and then read from
 * Chebyshev series in ln w, so that the cost per velocity does not know the material; a closed form
 * of many terms likewise.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_H
#define WT_FRICTION_NUMERICS_ANGULAR_H

#include "core/base/arena.h"
#include "friction/numerics/angular_weight.h"
#include "weartrack/model.h"

typedef struct angular_law angular_law;

/* The series of a material reach down from there far enough, and its squares are numbers. */
#define ANGULAR_LEAST 1e-250

/* The material is borrowed. Relative errors are to be far below `tolerance`. The law lives in the
 * pool, but what it makes later does not: to be cleared before the pool is freed. */
wt_status angular_new(const wt_material *material, double tolerance, arena *memory,
                      angular_law **angular, wt_error *err) WT_NODISCARD;
void angular_clear(angular_law *angular); /* NULL: nothing */
/* Weighs both from the beginning, before anything is covered. The weight is borrowed. */
void angular_weigh(angular_law *angular, const angular_weight *weight);

/* Prepares the series for w from w_min to w_max > 0; nothing to do for a closed form of few terms.
 * A series, once made, does not change; but a closed form for which there is one is read from it
 * from then on: that moves results within the errors stated. */
wt_status angular_cover(angular_law *angular, double w_min, double w_max,
                        wt_error *err) WT_NODISCARD;
/* Whether angular_cover has nothing to do for these. */
bool angular_covers(const angular_law *angular, double w_min, double w_max);
/* Prepares angular_outside. */
wt_status angular_cover_outside(angular_law *angular, wt_error *err) WT_NODISCARD;
/* J1 and J2 at n values of w inside the covered range, of which the first and the last are on the
 * same side of where a series begins; x = ln w. It is fastest where they rise. */
void angular_eval(const angular_law *angular, const double *w, const double *x, size_t n,
                  double *j1, double *j2);
/* Whether the closed form gives J1 and J2 for ln w from x_min to x_max. */
bool angular_closed(const angular_law *angular, double x_min, double x_max);
/* Largest relative error of J1 and of J2 for ln w in this range, from series and panels; `*piece`
 * is where to look from, 0 or from a range below. */
double angular_error(const angular_law *angular, double x_min, double x_max, size_t *piece);
/* The parts of J1(w) that come from frequencies outside the range backed by data, at n <= RULE_MOST
 * values of w; j1 = J1(w). */
void angular_outside(const angular_law *angular, const double *w, const double *j1, size_t n,
                     double *outside);
/* Whether the range of the material is limited at all. */
bool angular_limited(const angular_law *angular);

#endif
