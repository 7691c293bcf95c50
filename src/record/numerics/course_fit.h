/* Time of a measured course against a predicted one. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_COURSE_FIT_H
#define WT_RECORD_NUMERICS_COURSE_FIT_H

#include "weartrack/core.h"

#include <stddef.h>

/* Returns the predicted friction at a time > 0 [s]. */
typedef double course_function(const void *user, double time);

/* A mean of the friction over a time [s]. */
typedef struct course_mean {
    double begin, end, friction;
} course_mean;

/* Mean of the course from `begin` to `end` [s]. */
double course_mean_of(course_function *course, const void *user, double begin, double end);

/* Least squares of level + ratio x course(time / factor), with the course averaged as the n means
 * are. Returns the factor with its 95 % interval by the sum of squares, which the correlation of
 * successive residuals widens. NaN if the course is not seen; a limit that the means do not
 * determine is NaN. */
wt_interval course_fit_factor(const course_mean *mean, size_t n, course_function *course,
                              const void *user);

/* The same factor alone, sought between `low` and `high`; NaN if it is a limit. */
double course_fit_between(const course_mean *mean, size_t n, course_function *course,
                          const void *user, double low, double high);

#endif
