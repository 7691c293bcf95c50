/* Reference values of friction in long double by other methods than the kernel: tanh-sinh rules
 * between the relaxation times for the angle, Gauss rules with a nested integral for the
 * wavenumber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_REFERENCE_VALUES_H
#define WT_TESTS_REFERENCE_VALUES_H

#include <stddef.h>

/* E(w) = e0 + sum of e z / (1 + z) with z = (i w tau)^alpha: Prony series (alpha 1) or fractional
 * Zener law (one term). Units: Pa, s. */
typedef struct reference_material {
    double e0, alpha;
    size_t n;
    double e[16], tau[16];
    /* factors on E' and E'' along the surface normal, and the Poisson ratio; 0 if isotropic */
    double axial_storage, axial_loss, poisson_ratio;
} reference_material;

/* Computes the angular integrals J1 and J2 at the angular frequency w [rad/s]. */
void reference_angle(const reference_material *material, double w, double *j1, double *j2);

typedef struct reference_contact {
    reference_material material;
    double poisson_ratio, pressure, velocity;
    double q0, qr, q1, hurst, c0; /* self-affine spectrum */
} reference_contact;

/* Returns the hysteresis friction. order: Gauss nodes of a subinterval, 2 to 24. */
double reference_friction(const reference_contact *c, int order);

#endif
