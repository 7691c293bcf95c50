/* Internal to the model room: the surface of a transversely isotropic half-space at one frequency.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_DMA_LAW_MATERIAL_TRANSVERSE_H
#define WT_DMA_LAW_MATERIAL_TRANSVERSE_H

#include <complex.h>

/* The axis is the surface normal. */
typedef struct transverse_moduli {
    double complex plane, axial; /* Ep, Ez */
    double complex shear;        /* Gzp */
    double plane_poisson;        /* nu_p: in the plane under a load in it */
    double axial_poisson;        /* nu_zp: in the plane under a load along the axis */
} transverse_moduli;

/* D of u_z(q) = (D / q) sigma_z(q), to rounding times the condition of the moduli, also where they
 * are incompressible. Conway, Farnham and Ku, J. Appl. Mech. 34 (1967) 491. */
double complex transverse_compliance(const transverse_moduli *m);

#endif
