/* Stated properties of a layer: its state in a replicate, the frequency dependence of its modulus
 * ratio, its shear stress. Internal to friction.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_LAYER_OBSERVATION_H
#define WT_FRICTION_LAYER_OBSERVATION_H

#include "weartrack/friction.h"

/* Checks the parameters and their combination. NULL stands for no stated layer. */
wt_status sliding_layer_check(const wt_layer_observation *observation, wt_error *err) WT_NODISCARD;
/* State of the layer in a replicate. A thickness drawn below 0 gives a bare surface; a NULL
 * observation gives no layer. */
wt_layer_state sliding_layer_state(const wt_layer_observation *observation, uint64_t seed,
                                   size_t replicate);
/* Shear stress with a layer from that of the bulk: tau_s = tau_bulk x modulus ratio (L3), or that
 * of the bulk. A NULL observation returns the stress of the bulk. */
double sliding_layer_shear_stress(const wt_layer_observation *observation, double bulk,
                                  wt_layer_state layer);
/* Frequency dependence of the modulus ratio in a replicate. The exponent is 0 for a NULL
 * observation. */
wt_ratio_slope sliding_layer_ratio_slope(const wt_layer_observation *observation, uint64_t seed,
                                         size_t replicate);
/* Widens `range` [rad/s], initially NaN, by the frequencies at which a falling modulus ratio would
 * give the layer a negative loss modulus in these contacts. The loss modulus is set to 0 there. */
wt_status sliding_layer_zero_loss_range(const wt_sliding *sliding,
                                        const wt_layer_observation *observation, const wt_job *work,
                                        double range[2], wt_error *err) WT_NODISCARD;
/* Writes the moduli of the layer as text, "" for one constant ratio. A range with zero loss modulus
 * also gives a warning in the log. */
void sliding_layer_describe(const wt_layer_observation *observation, const double range[2],
                            wt_log *log, char *text, size_t size);

#endif
