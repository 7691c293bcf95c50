/* What a mixture of normal distributions says. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/mixture.h"

#include "base/normal.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static double below(const mixture_part *part, size_t n, double x)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += part[i].weight * (part[i].deviation > 0.0
                                     ? gsl_cdf_ugaussian_P((x - part[i].mean) / part[i].deviation)
                                     : (x >= part[i].mean ? 1.0 : 0.0));
    return sum;
}

static double quantile(const mixture_part *part, size_t n, double probability)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, part[i].mean - 9.0 * part[i].deviation);
        high = fmax(high, part[i].mean + 9.0 * part[i].deviation);
    }
    while (high - low > 1e-12 * fmax(fabs(low), fabs(high))) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            break;
        if (below(part, n, middle) < probability)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

wt_interval mixture_interval(const mixture_part *part, size_t n)
{
    wt_interval interval = {0};
    for (size_t i = 0; i < n; i++)
        interval.value += part[i].weight * part[i].mean;
    interval.low = quantile(part, n, 0.025);
    interval.high = quantile(part, n, 0.975);
    interval.standard_error = (interval.high - interval.low) / (2.0 * NORMAL_95);
    return interval;
}
