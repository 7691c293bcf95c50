/* Damage against depth, for one load or for several successive loads. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_DAMAGE_H
#define WT_LAYER_NUMERICS_LAYER_DAMAGE_H

#include "layer/numerics/layer_kernel.h"

/* An earlier load. Its damage has moved with the rubber since then. */
typedef struct damage_load {
    const layer_rates *rates;
    double worn_depth; /* depth worn off during the load [m] */
    double worn;       /* depth worn off since then, up to the present load [m] */
    double log_scale;  /* ln of the factor from its integral or density to D / Lambda */
} damage_load;

/* The present load and the earlier ones. */
typedef struct damage {
    const layer_rates *rates;
    bool worn;
    double time;
    double worn_depth;       /* depth worn off during the present load until `time` [m] */
    double level;            /* required ln(D / Lambda) */
    const damage_load *past; /* [n_past] borrowed */
    size_t n_past;
    double q_max; /* largest wavenumber of all loads */
} damage;

damage damage_create(const layer_rates *rates, bool with_wear);
void damage_set_time(damage *d, double time);
/* Converts the present load to an earlier one, for the loads that follow. */
damage_load damage_load_create(const damage *d);
/* ln(D / Lambda) minus the level; `user` is a damage. */
double damage_excess(double depth, void *user);
/* ln(D / Lambda) due to the loads. */
double damage_log_total(double depth, const damage *d);
/* Relative error of D, from the energy and from the logarithms. */
double damage_error(const layer_rates *rates);
/* D / Lambda at a depth, with its slope and a bound of its second derivative over the next `reach`.
 * All are multiplied by exp(log_scale). */
energy_expansion damage_expand(const damage *d, double depth, double reach);

/* Depth interval [m]. */
typedef struct depth_interval {
    double low, high;
} depth_interval;
/* Searches upwards from the lower end of `range`, where D is below the level. With `best` NULL it
 * stops at the first interval where D is below the level at the lower end and not below at the
 * upper; false if there is none. Otherwise it searches the whole range for the depth *best of the
 * largest D, and sets the level to it. */
bool damage_find_rise(damage *d, depth_interval range, depth_interval *crossing, double *best);
/* Finds the deepest band above `from`, where D is below the level; WT_E_NOT_FOUND if there is none.
 * *above is the depth at which D is below the level again, 0 if the band reaches the surface. */
wt_status damage_band(damage *d, double from, depth_interval *band, double *above,
                      wt_error *err) WT_NODISCARD;

#endif
