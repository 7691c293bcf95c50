/* Random numbers that depend on nothing but seed, replicate and what they are for, so that the same
 * seed gives the same replicates on any number of threads, and stating one more error changes none
 * of the other draws. Internal to job.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_RANDOM_DRAWS_H
#define WT_JOB_RANDOM_DRAWS_H

#include "weartrack/flow.h"

/* What a draw is for. */
typedef enum flow_draw {
    FLOW_DRAW_SHIFT_LAW,
    FLOW_DRAW_PRESSURE,
    FLOW_DRAW_TEMPERATURE,
    FLOW_DRAW_SHEAR_STRESS,
    FLOW_DRAW_DENSITY,
    FLOW_DRAW_CRITICAL_ENERGY,
    FLOW_DRAW_WEAR,
    FLOW_DRAW_OBSERVED,
    FLOW_DRAW_THICKNESS,
    FLOW_DRAW_RATIO,
    /* of data that are made, not of replicates */
    FLOW_DRAW_NOISE,
    FLOW_DRAW_ISOTHERM,
    FLOW_DRAW_SPOT,
    FLOW_DRAW_CURVE,
    FLOW_DRAW_FORCE,
    /* of replicates again: what stands before keeps its numbers */
    FLOW_DRAW_SOFT_STORAGE,
    FLOW_DRAW_SOFT_LOSS,
    /* of the points of a spectrum, each behind the one before */
    FLOW_DRAW_MODES,
    /* beyond as many points as there can be */
    FLOW_DRAW_RATIO_SLOPE = 1 << 24
} flow_draw;

/* Standard normal; 0 for WT_NO_REPLICATE. */
double flow_draw_normal(uint64_t seed, size_t replicate, flow_draw what);
/* value + error z, for quantities of either sign. */
double flow_draw_value(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what);
/* value exp(z error/value), for quantities > 0: stays positive. */
double flow_draw_positive(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what);
/* The same with an error that has degrees of freedom, by Student's t; 0 = normal. */
double flow_draw_positive_t(wt_estimate e, double df, uint64_t seed, size_t replicate,
                            flow_draw what);

/* An input as it stands in a table: 0 says that no error was stated, and what is not stated is not
 * known. */
wt_estimate flow_as_stated(wt_estimate input);

/* Standard deviation (n - 1) of the finite ones of x[0], x[stride], ...; NaN with fewer than two.
 */
double flow_spread(const double *x, size_t n, size_t stride);

#endif
