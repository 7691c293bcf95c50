/* Internal interface: surface compliance of a transversely isotropic half-space at one
 * frequency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_MATERIAL_TRANSVERSE_H
#define WT_DMA_LAW_MATERIAL_TRANSVERSE_H

#include <complex.h>

/* Moduli of the half-space [Pa]. The axis is the surface normal. */
typedef struct transverse_moduli {
    double complex plane, axial; /* Ep, Ez */
    double complex shear;        /* Gzp */
    double plane_poisson;        /* nu_p: contraction in the plane under a load in the plane */
    double axial_poisson;        /* nu_zp: contraction in the plane under a load along the axis */
} transverse_moduli;

/* Returns D of u_z(q) = (D / q) sigma_z(q) [1/Pa]. The error is the rounding error times the
 * condition of the moduli, also for incompressible solids. Conway, Farnham and Ku, J. Appl.
 * Mech. 34 (1967) 491. */
double complex transverse_compliance(const transverse_moduli *m);

#endif
