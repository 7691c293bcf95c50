/* A layer of a job that acts back on the energy that makes it. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_LAYER_ACTS_BACK_H
#define WEARTRACK_FLOW_LAYER_ACTS_BACK_H

#include "flow/layer/layer_energy.h"

typedef struct acts_back {
    const wt_sliding *sliding;
    const wt_layer_job *job; /* calibrated */
    const wt_job *work;
    double modulus_ratio;
} acts_back;

/* A wt_layer_energy_fn; `user` is an acts_back. */
wt_status acts_back_energy(double thickness, void *user, wt_energy_source *source,
                           wt_layer_parameters *parameters, wt_error *err) WT_NODISCARD;
/* All balances from the shortest wave to the longest. */
wt_status acts_back_find(acts_back *back, wt_layer_loop *loop, wt_error *err) WT_NODISCARD;
/* The job with the shear stress of the layer as `known` has it. */
wt_status layer_job_known(const wt_sliding *sliding, const wt_layer_job *job,
                          const wt_layer_known *known, const wt_job *work, wt_layer_job *out,
                          wt_error *err) WT_NODISCARD;

#endif
