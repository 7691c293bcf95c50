/* What is known of a layer: its state in a replicate, how its modulus ratio goes with the
 * frequency, what shearing it costs. Internal to friction. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_FRICTION_LAYER_OBSERVATION_H
#define WT_FRICTION_LAYER_OBSERVATION_H

#include "weartrack/flow.h"

/* The parameters and what goes together; NULL: nothing is known. */
wt_status sliding_layer_check(const wt_layer_observation *known, wt_error *err) WT_NODISCARD;
/* The layer of a replicate, a bare one where its thickness is drawn below 0; `known` NULL: none. */
wt_layer_state sliding_layer(const wt_layer_observation *known, uint64_t seed, size_t replicate);
/* Its law: that of the bulk has no power of the modulus ratio. */
wt_layer_shear sliding_layer_shear_of(const wt_layer_observation *known);
/* Shear stress with a layer, of that of the bulk: tau_s = tau_bulk x modulus ratio (L3), or as the
 * layer says; cracks are opened without one, too. `known` NULL: that of the bulk. */
double sliding_layer_shear(const wt_layer_observation *known, double bulk, wt_layer_state layer,
                           double area_ratio);
/* The modulus ratio at once and no cracks, which need no words; the law in words. */
bool sliding_layer_shear_is_plain(const wt_layer_shear *shear);
void sliding_layer_shear_describe(const wt_layer_shear *shear, char *text, size_t size);
/* How its modulus ratio goes with the frequency, in a replicate; `known` NULL: it does not. */
wt_ratio_slope sliding_layer_slope(const wt_layer_observation *known, uint64_t seed,
                                   size_t replicate);
/* The material of a layer that has one, at a temperature. */
wt_status sliding_layer_rubber(const wt_sliding *sliding, double temperature, uint64_t seed,
                               size_t replicate, wt_material **material,
                               wt_error *err) WT_NODISCARD;
/* Its shift law, none where it has none of its own. */
wt_shift_law sliding_layer_law(const wt_sliding *sliding, uint64_t seed, size_t replicate);
/* Widens `range` [rad/s], NaN at first, by where a ratio that falls with the frequency would make
 * the loss modulus of the layer below 0 in these contacts: it is taken as 0 there. */
wt_status sliding_layer_gain(const wt_sliding *sliding, const wt_layer_observation *known,
                             const wt_job *work, double range[2], wt_error *err) WT_NODISCARD;
/* Its moduli in words, "" where they are one ratio, with what is to be said of that range, which is
 * a warning, too. */
void sliding_layer_describe(const wt_sliding *sliding, const wt_layer_observation *known,
                            const double range[2], wt_log *log, char *text, size_t size);

#endif
