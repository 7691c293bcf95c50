/* Random draws for stated errors: a hash of seed, replicate and purpose, then the Box-Muller
 * transform. SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/random_draws.h"
#include "weartrack/job.h"

#include "core/math/special.h"
#include "core/math/students_t.h"

#include <math.h>

/* Converts bits to a number in (0, 1). */
static double uniform_from_bits(uint64_t bits)
{
    return ((double)(bits >> 11) + 0.5) * 0x1p-53;
}

double flow_draw_normal(uint64_t seed, size_t replicate, flow_draw what)
{
    if (replicate == WT_NO_REPLICATE)
        return 0;
    uint64_t state =
        splitmix64(splitmix64(splitmix64(seed) ^ (uint64_t)replicate) ^ (uint64_t)what);
    double radius = sqrt(-2 * log(uniform_from_bits(state)));
    return radius * cos(2 * M_PI * uniform_from_bits(splitmix64(state)));
}

double flow_draw_value(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what)
{
    if (!(e.standard_error > 0))
        return e.value;
    return e.value + e.standard_error * flow_draw_normal(seed, replicate, what);
}

double flow_draw_positive(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what)
{
    return flow_draw_positive_t(e, 0, seed, replicate, what);
}

wt_estimate flow_stated_estimate(wt_estimate input)
{
    if (!(input.standard_error > 0))
        input.standard_error = (double)NAN;
    return input;
}

double flow_draw_positive_t(wt_estimate e, double df, uint64_t seed, size_t replicate,
                            flow_draw what)
{
    if (!(e.standard_error > 0) || !(e.value > 0))
        return e.value;
    const double z = flow_draw_normal(seed, replicate, what);
    return e.value * exp(e.standard_error / e.value * (df > 0 ? students_t_from_normal(z, df) : z));
}

double flow_standard_deviation(const double *x, size_t n, size_t stride)
{
    double mean = 0, sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double value = x[i * stride];
        if (!isfinite(value))
            continue;
        count++;
        double step = value - mean;
        mean += step / (double)count;
        sum += step * (value - mean);
    }
    return count < 2 ? (double)NAN : sqrt(sum / (double)(count - 1));
}
