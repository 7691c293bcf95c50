/* Random draws from stated errors: splitmix64 (Steele, Lea, Flood, OOPSLA 2014) as a hash of seed,
 * replicate and purpose, then Box-Muller.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/draws.h"

#include <math.h>

static uint64_t mix(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

/* In (0, 1). */
static double uniform(uint64_t bits)
{
    return ((double)(bits >> 11) + 0.5) * 0x1p-53;
}

double flow_draw_normal(uint64_t seed, size_t replicate, flow_draw what)
{
    if (replicate == FLOW_CENTRE)
        return 0;
    uint64_t state = mix(mix(mix(seed) ^ (uint64_t)replicate) ^ (uint64_t)what);
    double radius = sqrt(-2 * log(uniform(state)));
    return radius * cos(2 * M_PI * uniform(mix(state)));
}

double flow_draw_value(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what)
{
    if (!(e.standard_error > 0))
        return e.value;
    return e.value + e.standard_error * flow_draw_normal(seed, replicate, what);
}

double flow_draw_positive(wt_estimate e, uint64_t seed, size_t replicate, flow_draw what)
{
    if (!(e.standard_error > 0) || !(e.value > 0))
        return e.value;
    return e.value * exp(e.standard_error / e.value * flow_draw_normal(seed, replicate, what));
}

double flow_spread(const double *x, size_t n, size_t stride)
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
