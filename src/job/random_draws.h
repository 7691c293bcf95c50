/* Random numbers that depend only on seed, replicate and purpose. The same seed gives the same
 * replicates with any number of threads. A further stated error does not change the other draws.
 * Internal to job. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_RANDOM_DRAWS_H
#define WT_JOB_RANDOM_DRAWS_H

#include "weartrack/core.h"

/* Purpose of a draw. */
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
    /* the number decides the draws: 10 to 14 stay unused */
    FLOW_DRAW_SOFT_STORAGE = 15,
    FLOW_DRAW_SOFT_LOSS,
    /* for the points of a spectrum, in consecutive numbers */
    FLOW_DRAW_MODES,
    /* beyond the largest number of points */
    FLOW_DRAW_RATIO_SLOPE = 1 << 24
} flow_draw;

/* Standard normal number; 0 for WT_NO_REPLICATE. */
double flow_draw_normal(uint64_t seed, size_t replicate, flow_draw what);
/* Returns value + error z, for quantities of either sign. */
double flow_draw_value(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what);
/* Returns value exp(z error/value), for positive quantities. */
double flow_draw_positive(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what);
/* Variant for an error with degrees of freedom, by Student's t; df = 0 means normal. */
double flow_draw_positive_t(wt_estimate e, double df, uint64_t seed, size_t replicate,
                            flow_draw what);

/* Converts an input for a table: a standard error of 0 means that none was stated, and becomes
 * NaN. */
wt_estimate flow_stated_estimate(wt_estimate input);

/* Standard deviation (n - 1) of the finite values among x[0], x[stride], ...; NaN for fewer than
 * two. */
double flow_standard_deviation(const double *x, size_t n, size_t stride);

#endif
