/* Internal to the kernel room: what roughness that is not the same in all directions makes of the
 * angular integrals. With phi from the velocity,
 *
 *   C(q, phi) = C(q) [1 + sum_m a_m cos m (phi - chi_m)],   m = 2, 4, ...
 *
 * J1 and J2 are weighed with W = 1 + sum_m a_m cos(m chi_m) cos(m phi); the force to the side comes
 * from K = int sin(phi) V(phi) E''(w cos phi) dphi, V = sum_m a_m sin(m chi_m) sin(m phi). Both are
 * polynomials in cos^2 phi, V sin(phi) with a factor cos(phi) before it. Carbone, Lorenz, Persson
 * and Wohlers, Eur. Phys. J. E 29 (2009) 275.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_WEIGHT_H
#define WT_FRICTION_NUMERICS_ANGULAR_WEIGHT_H

#include "weartrack/kernel.h"

/* Powers of cos^2 phi; those of the sum far below w, whose most is what 4^-m leaves of 1e-16. */
enum { WEIGHT_POWERS = WT_ANISOTROPY_ORDERS + 1, WEIGHT_FAR = 32 };

/* Of J1 and of J2. */
typedef struct angular_weight {
    double power[2][WEIGHT_POWERS]; /* of cos^2k phi */
    double far[2][WEIGHT_FAR];      /* of c^2m in the weight over sqrt(1 - c^2) */
    double caution; /* how much larger relative errors can be than those without a weight */
} angular_weight;

/* Whether there is a preferred direction, and whether there is a force to the side. */
bool anisotropy_is_any(const wt_anisotropy *a);
bool anisotropy_is_aside(const wt_anisotropy *a);
/* That of J1 and J2. */
angular_weight weight_along(const wt_anisotropy *a);
/* That which makes `shift` J1 + K of J1: it has no zero, as K has. */
angular_weight weight_aside(const wt_anisotropy *a, double *shift);

double weight_at(const double power[WEIGHT_POWERS], double square);
/* As the sums without a weight, which stand beside it in angular_panels.c. */
void weight_far(const angular_weight *w, const double *s1, const double *s2, size_t terms,
                double square, double *sum1, double *sum2);
void weight_middle(const angular_weight *w, size_t n, const double *omega, const double *f1,
                   const double *f2, double at, double *j1, double *j2);

#endif
