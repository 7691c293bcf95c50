/* Quantiles and intervals of a mixture of normal distributions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/mixture.h"

#include "core/math/root.h"
#include "core/math/students_t.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* Relative accuracy of a quantile, and distance from the means [standard deviations] at which a
 * normal tail is below 1e-19. */
static const double relative_tolerance = 1e-12, max_deviations = 9.0;
enum { MOST_HALVINGS = 2200 }; /* more than between the largest and the smallest double */

typedef struct mixture_level {
    const mixture_component *part;
    size_t n;
    double probability;
} mixture_level;

static bool is_below_quantile(double x, void *user)
{
    const mixture_level *l = user;
    double sum = 0.0;
    for (size_t i = 0; i < l->n; i++) {
        const mixture_component *p = &l->part[i];
        sum += p->weight * (p->deviation > 0.0 ? gsl_cdf_ugaussian_P((x - p->mean) / p->deviation)
                                               : (x >= p->mean ? 1.0 : 0.0));
    }
    return sum < l->probability;
}

static double normal_mixture_quantile(const mixture_component *part, size_t n, double probability)
{
    mixture_level l = {part, n, probability};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        low = fmin(low, part[i].mean - max_deviations * part[i].deviation);
        high = fmax(high, part[i].mean + max_deviations * part[i].deviation);
    }
    root_bisect(is_below_quantile, &l, &low, &high, relative_tolerance, MOST_HALVINGS);
    return 0.5 * (low + high);
}

wt_interval mixture_interval(const mixture_component *part, size_t n)
{
    wt_interval interval = {0};
    for (size_t i = 0; i < n; i++)
        interval.value += part[i].weight * part[i].mean;
    interval.low = normal_mixture_quantile(part, n, 0.025);
    interval.high = normal_mixture_quantile(part, n, 0.975);
    interval.standard_error = (interval.high - interval.low) / (2.0 * NORMAL_95);
    return interval;
}
