/* Friction once more, in long double and by other means than the kernel, as a reference: tanh-sinh
 * rules between the relaxation times for the angle, Gauss rules with a nested integral for the
 * wavenumber. Internal to study. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_REFERENCE_VALUES_H
#define WT_STUDY_REFERENCE_VALUES_H

#include <stddef.h>

/* E(w) = e0 + sum of e z / (1 + z), z = (i w tau)^alpha: Prony series (alpha 1) or fractional Zener
 * (one term). */
typedef struct reference_material {
    double e0, alpha;
    size_t n;
    double e[16], tau[16];
    /* factors on E' and E'' along the surface normal, with the Poisson ratio; 0: isotropic */
    double axial_storage, axial_loss, poisson_ratio;
} reference_material;

/* The angular integrals J1 and J2 at w. */
void reference_angle(const reference_material *material, double w, double *j1, double *j2);

typedef struct reference_contact {
    reference_material material;
    double poisson_ratio, pressure, velocity;
    double q0, qr, q1, hurst, c0; /* self-affine */
} reference_contact;

/* order: Gauss nodes of a panel, 2 to 24. */
double reference_friction(const reference_contact *c, int order);

#endif
