/* Friction during the growth of a layer, for the nominal values and for their draws. Internal to
 * record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_LAYER_GROWTH_H
#define WT_RECORD_LAYER_GROWTH_H

#include "friction/replicates.h"
#include "record/measured_friction.h"
#include "weartrack/layer.h"

typedef struct growth {
    size_t n, n_draws;
    double log_first, log_step; /* of the n times [s] */
    double *value; /* [(1 + n_draws) * stride] friction without a layer and at the steady-state
                      thickness, then at the times; nominal values first; NaN for a draw without a
                      solution */
    size_t stride;
    char includes[256]; /* names of the drawn sources */
} growth;

/* Computes the growth. The caller clears it, also after a failure. Returns WT_E_RANGE if no layer
 * exists or if it grows without limit. */
wt_status growth_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                         const wt_layer_observation *observation, const measured_step *at,
                         const wt_job *work, growth *g, wt_error *err) WT_NODISCARD;
void growth_clear(growth *g);

/* A number of the nominal values (k = 0) or of draw k - 1. */
typedef double growth_function(const growth *g, size_t k, double time);
/* Friction coefficient without a layer, and at a time [s]. */
growth_function growth_bare_friction, growth_friction_at;
/* Friction at the steady-state thickness less that which is farthest from it. */
growth_function growth_change;
/* Last time at which 5 % of that change remain [s]. NaN if the times do not include it. */
growth_function growth_settling_time;
/* Nominal value with its standard deviation over the draws with a finite value, NaN if fewer than
 * two have one. `time` is without effect on functions that have none. */
wt_estimate growth_estimate(const growth *g, growth_function *of, double time);

#endif
