/* Effect of anisotropic roughness on the angular integrals. Internal to friction. With phi from the
 * velocity,
 *
 *   C(q, phi) = C(q) [1 + sum_m a_m cos m (phi - chi_m)],   m = 2, 4, ...
 *
 * J1 and J2 have the weight W = 1 + sum_m a_m cos(m chi_m) cos(m phi). The lateral force follows
 * from K = int sin(phi) V(phi) E''(w cos phi) dphi, V = sum_m a_m sin(m chi_m) sin(m phi). Both
 * weights are polynomials in cos^2 phi; V sin(phi) has an additional factor cos(phi). Carbone,
 * Lorenz, Persson and Wohlers, Eur. Phys. J. E 29 (2009) 275.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_ANGULAR_WEIGHT_H
#define WT_FRICTION_NUMERICS_ANGULAR_WEIGHT_H

#include "weartrack/surface.h"

/* Number of powers of cos^2 phi, and of terms of the series far below w: 4^-m falls to 1e-16 within
 * it. */
enum { WEIGHT_POWERS = WT_ANISOTROPY_ORDERS + 1, WEIGHT_SERIES_TERMS = 32 };

/* Weights of J1 and of J2. */
typedef struct angular_weight {
    double power[2][WEIGHT_POWERS];     /* coefficients of cos^2k phi */
    double far[2][WEIGHT_SERIES_TERMS]; /* coefficients of c^2m in the weight over sqrt(1 - c^2) */
    double cancellation; /* factor by which relative errors can exceed those without a weight */
} angular_weight;

/* True if there is a preferred direction, and true if there is a lateral force. */
bool anisotropy_is_present(const wt_anisotropy *a);
bool anisotropy_has_lateral_force(const wt_anisotropy *a);
/* Weight of J1 and J2. */
angular_weight weight_longitudinal(const wt_anisotropy *a);
/* Weight that changes J1 to `shift` J1 + K, which has no zero, unlike K. */
angular_weight weight_lateral(const wt_anisotropy *a, double *shift);

double weight_evaluate(const double power[WEIGHT_POWERS], double square);
/* Weighted variants of the sums in angular_subintervals.c. */
void weight_series_sum(const angular_weight *w, const double *s1, const double *s2, size_t terms,
                       double square, double *sum1, double *sum2);
void weight_node_sum(const angular_weight *w, size_t n, const double *omega, const double *f1,
                     const double *f2, double at, double *j1, double *j2);

#endif
