/* Internal to the kernel room: angular integrals by quadrature over the law of a material.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_KERNEL_ANGULAR_INTEGRAL_H
#define WT_KERNEL_ANGULAR_INTEGRAL_H

#include "kernel/rule.h"
#include "weartrack/model.h"

typedef struct angular_quadrature {
    const wt_material *material;
    const double *breaks; /* borrowed from the material */
    size_t n_breaks;
    gauss_rule *short_rule, *long_rule;
} angular_quadrature;

wt_status angular_quadrature_init(const wt_material *material, pool *memory,
                                  angular_quadrature *quadrature, wt_error *err) WT_NODISCARD;

/* J1 and J2 from the angles where w cos(phi) < w cosine_limit (1 = all). `refine` cuts every panel
 * in `refine` parts: 1 is the working setting, 2 checks it. */
void angular_integrate(const angular_quadrature *quadrature, double w, double cosine_limit,
                       unsigned refine, double *j1, double *j2);

#endif
