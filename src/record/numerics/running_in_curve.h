/* Time of a measured course against a predicted one. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H
#define WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H

#include "weartrack/core.h"

#include <stddef.h>

/* Returns the predicted friction at a time > 0 [s]. */
typedef double running_in_function(const void *user, double time);

/* A mean of the friction over a time [s]. */
typedef struct running_in_mean {
    double begin, end, friction;
} running_in_mean;

/* Mean of the course from `begin` to `end` [s]. */
double running_in_mean_of(running_in_function *course, const void *user, double begin, double end);

/* Least squares of level + ratio x course(time / factor), with the course averaged as the n means
 * are. Returns the factor with its 95 % interval by the sum of squares, which the correlation of
 * successive residuals widens. NaN if the course is not seen; a limit that the means do not
 * determine is NaN. */
wt_interval running_in_curve_factor(const running_in_mean *mean, size_t n,
                                    running_in_function *course, const void *user);

/* The same factor alone, sought between `low` and `high`; NaN if it is a limit. */
double running_in_curve_factor_between(const running_in_mean *mean, size_t n,
                                       running_in_function *course, const void *user, double low,
                                       double high);

#endif
