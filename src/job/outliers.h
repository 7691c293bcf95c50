/* Detects outliers in a list of values. Internal to job. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_JOB_OUTLIERS_H
#define WT_JOB_OUTLIERS_H

#include <stddef.h>

typedef struct typical_values {
    double middle, most; /* values further from the middle than `most` are outliers */
} typical_values;

/* Computes the median and five standard deviations of n > 0 values, which are changed. The standard
 * deviation follows from the median absolute deviation. If more than half of the values equal the
 * median, it follows from the mean absolute deviation (Iglewicz and Hoaglin 1993). */
typical_values flow_typical_values(double *values, size_t n);

#endif
