/* Internal to the kernel room: the angular integrals J1 and J2 of any material.
 *
 *   J1(w) = int_0^2pi cos(phi) E''(w cos phi) dphi,   J2(w) = int_0^2pi |E(w cos phi)|^2 dphi
 *
 * From the closed form of the law where it has one; otherwise integrated once and then read from
 * Chebyshev series in ln w, so that the cost per velocity does not know the material.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_KERNEL_ANGULAR_H
#define WT_KERNEL_ANGULAR_H

#include "weartrack/model.h"

typedef struct wt_angular wt_angular;

/* The material is borrowed. */
wt_status wt_angular_new(const wt_material *material, wt_angular **angular,
                         wt_error *err) WT_NODISCARD;
void wt_angular_free(wt_angular *angular);

/* Prepares the series for w from w_min to w_max > 0; nothing to do for a closed form. A series,
 * once made, does not change: results do not depend on the order of the calls. */
wt_status wt_angular_cover(wt_angular *angular, double w_min, double w_max,
                           wt_error *err) WT_NODISCARD;
/* J1 and J2 at n values of w inside the covered range, best in rising order. */
void wt_angular_eval(const wt_angular *angular, const double *w, size_t n, double *j1, double *j2);
/* Largest relative error of J1 and of J2 in the series; 0 for a closed form. */
double wt_angular_error(const wt_angular *angular);
/* The part of J1(w) that comes from frequencies outside the range backed by data; j1 = J1(w).
 * Relative error about 1e-8. */
double wt_angular_outside(const wt_angular *angular, double w, double j1);
/* Whether the range of the material is limited at all. */
bool wt_angular_limited(const wt_angular *angular);

#endif
