/* Time of a measured course against a predicted one. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_COURSE_FIT_H
#define WT_RECORD_NUMERICS_COURSE_FIT_H

#include "weartrack/core.h"

#include <stddef.h>

/* Returns the predicted friction at a time > 0 [s]. */
typedef double course_function(const void *user, double time);

/* Least squares of y [n] at rising times [n]: level + ratio x course(time / factor). Returns the
 * factor with its 95 % interval by the sum of squares, which the correlation of successive
 * residuals widens. NaN if the course is not seen; a limit that the points do not determine is
 * NaN. */
wt_interval course_fit_factor(const double *time, const double *y, size_t n,
                              course_function *course, const void *user);

#endif
