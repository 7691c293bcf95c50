/* Variance and correlation length of a residual.
 *
 * The variance of a mean of n correlated samples is that of n/tau independent ones, with
 * tau = 1 + 2 sum_k rho_k (Sokal, Monte Carlo Methods in Statistical Mechanics, 1989, section 3).
 * The sum is cut at the first autocorrelation that is not above its own noise. Slow drift under
 * fast noise would be cut off, too; so neighbours are averaged in pairs again and again (Flyvbjerg
 * and Petersen, J. Chem. Phys. 91 (1989) 461) and the longest of the answers is taken. The work is
 * proportional to n.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/curve.h"

#include <math.h>

enum { MAX_LAG = 48, MIN_BLOCKS = 64 };

static double autocovariance(const double *x, size_t n, size_t lag)
{
    double sum = 0.0;
    for (size_t i = lag; i < n; i++)
        sum += x[i] * x[i - lag];
    return sum / (double)n;
}

static size_t average_pairs(double *x, size_t n)
{
    for (size_t i = 0; i < n / 2; i++)
        x[i] = 0.5 * (x[2 * i] + x[2 * i + 1]);
    return n / 2;
}

noise_level noise_estimate(double *x, size_t n)
{
    noise_level noise = {0.0, 1.0};
    if (n == 0)
        return noise;
    noise.variance = autocovariance(x, n, 0);
    if (!(noise.variance > 0.0))
        return noise;
    double variance = noise.variance;
    for (double block = 1.0;; block *= 2.0) {
        double tau = 1.0, threshold = 2.0 / sqrt((double)n);
        for (size_t lag = 1; lag <= MAX_LAG && lag < n / 2; lag++) {
            double rho = autocovariance(x, n, lag) / variance;
            if (rho < threshold)
                break;
            tau += 2.0 * rho;
        }
        /* var(mean) = variance tau / n is the same for blocks as for samples. */
        noise.correlation_length =
            fmax(noise.correlation_length, tau * block * variance / noise.variance);
        if (n < 2 * MIN_BLOCKS)
            return noise;
        n = average_pairs(x, n);
        variance = autocovariance(x, n, 0);
        if (!(variance > 0.0))
            return noise;
    }
}
