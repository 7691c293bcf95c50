/* Layer of a job with feedback on the energy that forms it. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_FEEDBACK_H
#define WT_LAYER_FEEDBACK_H

#include "layer/monte_carlo.h"

/* A wt_layer_energy_fn whose `user` is a layer_context. */
wt_status feedback_energy(double thickness, void *user, wt_energy_source *source,
                          wt_layer_parameters *parameters, wt_error *err) WT_NODISCARD;
/* Finds all balances with thicknesses from the shortest wave to the longest. */
wt_status feedback_find_balances(layer_context *context, wt_layer_feedback *loop,
                                 wt_error *err) WT_NODISCARD;

#endif
