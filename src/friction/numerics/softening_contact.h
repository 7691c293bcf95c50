/* Strain softening of the moduli over the wavenumber. Internal to friction.
 *
 *   E'(w) -> f(eps) E'(w),   E''(w) -> g(eps) E''(w),   eps(q) = alpha rms slope up to q,
 *
 * f and g are linear in ln eps between the points of a table and constant outside. At a wavenumber
 *   J1 -> g J1,   J2 -> f^2 J2 + (g^2 - f^2) J2'',   J2''(w) = int_0^2pi E''(w cos phi)^2 dphi.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_SOFTENING_CONTACT_H
#define WT_FRICTION_NUMERICS_SOFTENING_CONTACT_H

#include "core/base/array.h"
#include "weartrack/dma.h"
#include "weartrack/surface.h"

typedef struct strain_law {
    const wt_roughness *roughness;
    double factor; /* alpha */
    size_t n;
    double *log_strain, *f, *g; /* [n] */
    size_t n_cuts;
    double *cuts;        /* [n_cuts] ln(q / q0) at which the strain of a point of the table is
                            reached, rising */
    double range[2];     /* wavenumbers of the first and the last point; q1 if not reached */
    double cancellation; /* factor by which the relative error of the sum for J2 can exceed that of
                       its terms */
    double steepest;     /* largest |d ln f / d ln eps| and |d ln g / d ln eps| */
    const wt_material *source;
    wt_material loss; /* material whose |E|^2 is the squared loss modulus of the source */
} strain_law;

/* Creates the law from a checked table. Roughness and material are borrowed. */
wt_status softening_new(const wt_softening *table, double factor, const wt_material *material,
                        const wt_roughness *roughness, arena *memory, strain_law **made,
                        wt_error *err) WT_NODISCARD;
/* f and g at n wavenumbers q = q0 e^t. */
void softening_factors(const strain_law *s, const double *q, const double *t, size_t n, double *f,
                       double *g);

#endif
