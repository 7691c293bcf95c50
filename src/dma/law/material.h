/* Internal interface of the material laws: construction, checks, and the surface compliance of a
 * transversely isotropic half-space.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_MATERIAL_H
#define WT_DMA_LAW_MATERIAL_H

#include "core/base/param.h"
#include "weartrack/dma.h"

#include <complex.h>

/* Parameter row of the Poisson ratio for any structure that has one. */
#define POISSON_RATIO(type)                                                                        \
    {                                                                                              \
        PARAM("poisson-ratio", type, poisson_ratio, WT_Q_NONE, FROM_TO(0, 0.5)),                   \
            .value = "NU", .help = "of the rubber, which is nearly incompressible"                 \
    }
/* Returns WT_E_RANGE unless 0 <= poisson_ratio <= 0.5. */
wt_status material_check_poisson(double poisson_ratio, wt_error *err) WT_NODISCARD;
/* Returns WT_E_RANGE with the name of the parameter unless `good` is true and the value is
 * finite. */
wt_status material_check_value(const char *name, double value, const char *expected, bool good,
                               wt_error *err) WT_NODISCARD;
/* Creates a material that owns `data`. NaN as a frequency limit [rad/s] means unlimited. */
wt_material *material_create(const wt_material_law *law, void *data, double poisson_ratio,
                             double frequency_min, double frequency_max);
/* Implements `free` for a law whose data are one block of memory. */
void material_free_data(wt_material *material);

/* Limits of a modulus [Pa]. Within them its square neither overflows nor underflows a double. */
#define MODULUS_MIN 1e-150
#define MODULUS_MAX 1e150
#define MODULUS_RANGE "from 1e-150 to 1e150 Pa"

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
