/* Verdict on a share of trials.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/coverage_share.h"

#include "core/math/normal_quantile.h"

#include <math.h>
#include <string.h>

/* Nominal coverage; smallest share that passes (twice the nominal misses); promised range
 * (tests/study). With enough trials any deviation is significant. Within the promised range it is
 * not an error. */
static const double stated = 0.95, least_held = 0.9, promised_low = 0.92, promised_high = 0.98;
/* One-sided level. The probability of a false alarm among about ten numbers is then 5 %. */
static const double alarm = 0.0025;
/* Largest number of trials that is advised. More would take days and distinguish 95.0 % from 95.2
 * %. */
static const size_t most_trials = 100000;

static void set_share_interval(coverage_share *s, double share, double n)
{
    const double z = NORMAL_95, centre = (share + z * z / (2 * n)) / (1 + z * z / n);
    const double half = z / (1 + z * z / n) * sqrt(share * (1 - share) / n + z * z / (4 * n * n));
    s->low = fmax(0, centre - half);
    s->high = fmin(1, centre + half);
}

/* Probability of at most `most` misses in n trials (binomial). */
static double binomial_probability(double most, double n)
{
    double sum = 0;
    for (double k = 0; k <= most; k++)
        sum += exp(lgamma(n + 1) - lgamma(k + 1) - lgamma(n - k + 1) + k * log(1 - stated) +
                   (n - k) * log(stated));
    return fmin(sum, 1);
}

static const char *share_verdict(double share, double n, double low)
{
    /* fractional misses count for neither alarm, except for rounding errors */
    const double misses = n * (1 - share), most = ceil(misses - 1e-9), least = floor(misses + 1e-9);
    if (share < promised_low && 1 - binomial_probability(least - 1, n) < alarm)
        return "too narrow";
    if (share > promised_high && binomial_probability(most, n) < alarm)
        return "too wide";
    return low >= least_held ? "holds" : "cannot say";
}

static coverage_share assess_share(double share, size_t n)
{
    coverage_share s = {.trials = (double)NAN};
    set_share_interval(&s, share, (double)n);
    s.verdict = share_verdict(share, (double)n, s.low);
    return s;
}

coverage_share coverage_assess(double share, size_t n)
{
    coverage_share s = assess_share(share, n);
    if (strcmp(s.verdict, "cannot say") != 0)
        return s;
    /* to 10 %: the outcome of the trials is not known better */
    for (size_t more = n + 1; more < most_trials; more += more / 10 + 1)
        if (strcmp(assess_share(share, more).verdict, "cannot say") != 0) {
            s.trials = (double)more;
            break;
        }
    return s;
}
