/* Internal to the kernel room: the loads of a history, made ready.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_DAMAGE_BANDS_H
#define WT_LAYER_NUMERICS_LAYER_DAMAGE_BANDS_H

#include "layer/numerics/layer_damage.h"

typedef struct layer_loads {
    size_t n;
    layer_rates *rates;           /* [n] */
    damage_load *past;            /* [n] of the load of now */
    double *begin;                /* [n] time at which a load begins [s] */
    double start;                 /* old layer at time 0 */
    bool falls;                   /* the damage falls with depth, whatever the time */
    double q_min, q_max, falling; /* of all; falling: below it the damage falls */
    double error;                 /* relative, of the damage */
} layer_loads;

wt_status layer_loads_make(const wt_layer_stage *stages, size_t n, layer_loads *loads,
                           wt_error *err) WT_NODISCARD;
void layer_loads_clear(layer_loads *loads);
/* The damage at a time, and what is worn off until then. */
damage layer_loads_at(layer_loads *loads, double time, double *worn);
wt_status layer_section_at(layer_loads *loads, double time, wt_layer_section *section,
                           wt_error *err) WT_NODISCARD;
/* The same bands, but of a damage that falls with depth without their lower edge, which costs most.
 */
wt_status layer_bands_at(layer_loads *loads, double time, wt_layer_section *section,
                         wt_error *err) WT_NODISCARD;

#endif
