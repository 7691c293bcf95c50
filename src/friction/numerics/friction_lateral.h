/* Lateral force on anisotropic roughness. Internal to friction.
 *
 *   mu_side = 1/(2 sigma0) int k^3 C S P K(k v) dk
 *
 * with K of angular_weight.h in place of J1. It follows from the hysteresis at each node of a pass
 * by K / J1, so that no further quadrature is needed.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FRICTION_LATERAL_H
#define WT_FRICTION_NUMERICS_FRICTION_LATERAL_H

#include "friction/numerics/friction_kernel.h"

typedef struct lateral_force lateral_force;

/* The object is allocated in the arena; clear it before the arena is freed. */
wt_status lateral_force_new(const wt_material *material, const wt_friction_options *options,
                            const layer_moduli *own, arena *memory, lateral_force **side,
                            wt_error *err) WT_NODISCARD;
void lateral_force_clear(lateral_force *side); /* no effect on NULL */
/* Extends both integrals as angular_extend does. */
wt_status lateral_force_extend(lateral_force *side, double lowest, double highest,
                               wt_error *err) WT_NODISCARD;
/* Computes the lateral friction of a pass with recorded nodes and this error of the hysteresis, for
 * a positive velocity. */
wt_estimate lateral_force_compute(const wt_friction_workspace *ws, friction_load at,
                                  const node_contributions *record, double hysteresis_error);

#endif
