/* Internal to the kernel room: the force to the side on anisotropic roughness.
 *
 *   mu_side = 1/(2 sigma0) int k^3 C S P K(k v) dk
 *
 * with K of angular_weight.h in the place of J1. From the hysteresis at each node of a pass by
 * K / J1, so nothing is integrated again.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_FRICTION_LATERAL_H
#define WT_FRICTION_NUMERICS_FRICTION_LATERAL_H

#include "friction/numerics/friction_kernel.h"

typedef struct friction_side friction_side;

/* Lives in the pool; to be cleared before that is freed. */
wt_status friction_side_new(const wt_material *material, const wt_friction_options *options,
                            const layer_moduli *own, arena *memory, friction_side **side,
                            wt_error *err) WT_NODISCARD;
void friction_side_clear(friction_side *side); /* NULL: nothing */
/* As angular_cover. */
wt_status friction_side_cover(friction_side *side, double lowest, double highest,
                              wt_error *err) WT_NODISCARD;
/* Of a pass whose nodes are recorded and whose hysteresis has this error; forwards. */
wt_status friction_side_of(const wt_friction_workspace *ws, friction_load at,
                           const friction_record *record, double hysteresis_error,
                           wt_estimate *side) WT_NODISCARD;

#endif
