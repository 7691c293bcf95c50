/* Prepared loads of a history. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_DAMAGE_BANDS_H
#define WT_LAYER_NUMERICS_LAYER_DAMAGE_BANDS_H

#include "layer/numerics/layer_damage.h"

typedef struct layer_loads {
    size_t n;
    layer_rates *rates;           /* [n] */
    damage_load *past;            /* [n] earlier loads relative to the present one */
    double *begin;                /* [n] time at which a load begins [s] */
    double start;                 /* thickness of the old layer at time 0 [m] */
    bool falls;                   /* true if the damage falls with depth at any time */
    double q_min, q_max, falling; /* range over all loads; depth below which the damage falls [m] */
    double error;                 /* relative error of the damage */
} layer_loads;

wt_status layer_loads_create(const wt_layer_load *stages, size_t n, layer_loads *loads,
                             wt_error *err) WT_NODISCARD;
void layer_loads_clear(layer_loads *loads);
/* Returns the damage at a time, and the depth worn off until then. */
damage layer_loads_damage(layer_loads *loads, double time, double *worn);
wt_status layer_section_compute(layer_loads *loads, double time, wt_layer_section *section,
                                wt_error *err) WT_NODISCARD;
/* Variant that omits the lower edge of damage that falls with depth, which is the most expensive
 * part. */
wt_status layer_section_bands(layer_loads *loads, double time, wt_layer_section *section,
                              wt_error *err) WT_NODISCARD;

#endif
