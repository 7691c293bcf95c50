/* Friction and layer by an independent quadrature of the integrals of Persson.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_CONTACT_H
#define STUDY_CONTACT_H

#include "material.h"

#define VELOCITIES_MAX 4

/* Spectrum: c0 from q0 to qr, c0 (q/qr)^(-2(1+hurst)) up to q1. SI units, temperature in degC. */
typedef struct contact {
    double q0, qr, q1, hurst, c0;
    double pressure, shear_stress, poisson, temperature;
    int velocities;
    double velocity[VELOCITIES_MAX];
    int layer_compute_energy; /* index of the velocity that wears the layer */
    double wear_rate, critical_energy;
    /* modulus ratio of a layer, which also scales the shear stress; 0: none */
    double layer_ratio, layer_thickness;
    double error; /* stated relative errors of c0, pressure, shear stress, wear rate and energy */
} contact;

typedef struct contact_truth {
    double area[VELOCITIES_MAX], hysteresis[VELOCITIES_MAX], friction[VELOCITIES_MAX];
    double thickness;
} contact_truth;

/* `steps` is the number of intervals for each segment of the spectrum; 100 are accurate to 1e-6. */
contact_truth contact_solve(const contact *c, const rubber_state *state, int steps);

/* Dissipated power per area below a depth, at the first velocity. */
typedef struct contact_power contact_power;
contact_power *contact_power_make(const contact *c, const rubber_state *state, int steps);
double contact_power_below(const contact_power *power, double depth);
/* Friction with the layer of `c`. */
double contact_power_friction(const contact_power *power, const contact *c);
void contact_power_free(contact_power *power);

#endif
