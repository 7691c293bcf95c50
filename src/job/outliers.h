/* Which of several values are far from the others (internal to the flow room).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_JOB_OUTLIERS_H
#define WT_JOB_OUTLIERS_H

#include <stddef.h>

typedef struct typical_values {
    double middle, most; /* those further from the middle than this are far */
} typical_values;

/* Of n > 0 values, which are changed: the median and five standard deviations, of which the median
 * distance from it tells, or, where more than half of the values are the median itself, the mean
 * distance (Iglewicz and Hoaglin 1993). */
typical_values flow_usual_values(double *values, size_t n);

#endif
