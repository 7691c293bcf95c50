/* Detects outliers. SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/outliers.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>

/* Threshold in standard deviations; a normal distribution exceeds it once in 1.7 million. */
static const double outlier_deviations = 5;
/* Standard deviation of a normal distribution over its median and its mean absolute deviation. */
static const double deviations_per_median = 1.4826, deviations_per_mean = 1.253314137315500;

typical_values flow_typical_values(double *values, size_t n)
{
    const double middle = numbers_median(values, n);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        values[i] = fabs(values[i] - middle);
        sum += values[i];
    }
    const double distance = numbers_median(values, n);
    return (typical_values){middle, outlier_deviations *
                                        (distance > 0 ? deviations_per_median * distance
                                                      : deviations_per_mean * sum / (double)n)};
}
