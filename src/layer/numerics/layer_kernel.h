/* Formation and wear at constant load. Internal to layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_LAYER_NUMERICS_LAYER_KERNEL_H
#define WT_LAYER_NUMERICS_LAYER_KERNEL_H

#include "layer/numerics/energy_density_kernel.h"

/* Qf(d) = formation exp(log_tail(d) - log_power), Qw = wear; R = Qf(0)/Qw. */
typedef struct layer_rates {
    const wt_energy_source *source;
    double q_min, q_max; /* range of the terms with power [rad/m]; 0 without power */
    double formation;    /* Qf(0) [m/s], duty included */
    double wear;         /* [m/s], duty included */
    double power;        /* power per area [W/m^2] */
    double log_power;    /* ln of the tail at the surface; 0 without power */
    double log_ratio;    /* ln R; -infinity without power, +infinity without wear */
    double threshold;    /* ln(U_c Lambda) */
    double error;        /* relative error of a tail */
    double duty;
    bool skip_numerical_errors;
} layer_rates;

wt_status layer_rates_compute(const wt_energy_source *source, const wt_layer_parameters *parameters,
                              layer_rates *rates, wt_error *err) WT_NODISCARD;
double layer_formation_rate(const layer_rates *rates, double thickness); /* Qf */
/* Local decay rate of Qf, w / int w [1/m]. */
double layer_decay_rate(const layer_rates *rates, double thickness);
/* Thickness at which Qf = scale Qw, with its numerical error; 0 if Qf(0) is below. */
wt_status layer_fixed_point(const layer_rates *rates, double log_scale, wt_estimate *thickness,
                            wt_error *err) WT_NODISCARD;

/* Damage transport: the deepest position with int Omega dt >= Lambda at `time`; 0 before
 * incubation. The search begins at the thickness of an earlier time, or at 0. */
wt_status layer_damage_depth(const layer_rates *rates, double time, double earlier,
                             wt_estimate *thickness, wt_error *err) WT_NODISCARD;
/* First time at which any position at this depth or below is modified; NaN if never. */
wt_status layer_damage_time(const layer_rates *rates, bool with_wear, wt_estimate depth,
                            wt_estimate *time, wt_error *err) WT_NODISCARD;

#endif
