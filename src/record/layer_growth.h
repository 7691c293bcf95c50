/* Friction during the growth of a layer at the conditions of a record, for the nominal values and
 * for their draws. Internal to record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_LAYER_GROWTH_H
#define WT_RECORD_LAYER_GROWTH_H

#include "friction/replicates.h"
#include "record/measured_friction.h"
#include "record/numerics/running_in_curve.h"
#include "weartrack/layer.h"

/* Numbers of one draw that precede its friction in time. */
typedef enum growth_quantity {
    GROWTH_END,    /* friction at the steady-state thickness; first member because it is never
                      NaN */
    GROWTH_BARE,   /* friction without a layer */
    GROWTH_WEAR,   /* specific wear rate k [m^2/N] */
    GROWTH_ENERGY, /* critical energy U_c [J/m^3]; NaN if the closure has none */
    GROWTH_QUANTITIES
} growth_quantity;

typedef struct growth {
    size_t n, n_draws, stride;
    double log_first, log_step; /* of the n times [s] */
    double *value; /* [(1 + n_draws) * stride] the numbers, then friction at the times; nominal
                      values first; NaN for a draw without a solution */
    double *running_in_curve; /* [(1 + n_draws) * n] friction less final friction */
    flow_draw line[REPLICATES_MAX_DRAWS];
    size_t n_lines, n_bare;     /* draws without a layer */
    char includes[256];         /* names of the drawn sources */
    bool skip_numerical_errors; /* true if the layer feeds back: only nominal values are computed */
} growth;

/* Computes the growth. The caller clears it, also after a failure. Returns WT_E_RANGE if no layer
 * exists or if it grows without limit. */
wt_status growth_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                         const wt_layer_observation *observation, const measured_step *at,
                         const wt_job *work, growth *g, wt_error *err) WT_NODISCARD;
void growth_clear(growth *g);

/* Returns a number of the nominal values (k = 0) or of draw k - 1. */
double growth_quantity_value(const growth *g, size_t k, growth_quantity number);
running_in_curve growth_curve(const growth *g, size_t k);
/* Returns the friction coefficient at a time [s]. */
double growth_friction_at(const growth *g, size_t k, double time);
/* Returns the standard deviation of a function over the draws with a finite value. NaN if fewer
 * than two have one. */
typedef double growth_function(const growth *g, size_t k, double time);
double growth_standard_deviation(const growth *g, growth_function *of, double time);

#endif
