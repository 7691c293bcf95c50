/* Internal to the kernel room: damage against depth, of one load or of several in turn.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_DAMAGE_H
#define WT_LAYER_NUMERICS_LAYER_DAMAGE_H

#include "layer/numerics/layer_kernel.h"

/* An earlier load: what it did is where the rubber was then. */
typedef struct damage_load {
    const layer_rates *rates;
    double way;       /* worn off while it lasted */
    double worn;      /* and since, up to the load of now */
    double log_scale; /* ln of D / Lambda over its integral or density */
} damage_load;

/* The load of now and those before it. */
typedef struct damage {
    const layer_rates *rates;
    bool worn;
    double time;
    double way;              /* up to the surface until `time` */
    double level;            /* ln(D / Lambda) that is wanted */
    const damage_load *past; /* [n_past] borrowed */
    size_t n_past;
    double past_background; /* D / Lambda without load until now began */
    double q_max;           /* of all loads */
} damage;

damage damage_of(const layer_rates *rates, bool with_wear);
void damage_set_time(damage *d, double time);
/* What it is for the loads that follow. */
damage_load damage_load_of(const damage *d);
/* ln(D / Lambda) above the level; `user` is a damage. */
double damage_at(double depth, void *user);
/* ln(D / Lambda) of the loads alone. */
double damage_of_loads(double depth, const damage *d);
/* Relative error of D: of the energy and of the logarithms. */
double damage_error(const layer_rates *rates);
/* D / Lambda at a depth, with its slope and a bound of its second derivative from there to `reach`
 * deeper; all to be multiplied by exp(log_scale). */
energy_course damage_course(const damage *d, double depth, double reach);

/* A stretch of depth. */
typedef struct stretch {
    double low, high;
} stretch;
/* Goes up from the lower end of `range`, where D is below the level. With `best` NULL to the first
 * stretch at whose lower end D is below and at whose upper end it is not; false if there is none.
 * Else all the way, for the depth *best where D is highest, to which the level is set. */
bool damage_climb(damage *d, stretch range, stretch *crossing, double *best);
/* The deepest band above `from`, where D is below the level; WT_E_NOT_FOUND if there is none.
 * above: where D is below the level again, 0 if the band goes up to the surface. */
wt_status damage_band(damage *d, double from, stretch *band, double *above,
                      wt_error *err) WT_NODISCARD;

#endif
