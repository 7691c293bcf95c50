/* Published rules for the truncation of the beginning of a series.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/record.h"

#include <math.h>

size_t wt_step_detect(const double *y, size_t n)
{
    static const double margin = 0.02; /* fraction of the series on either side */
    const size_t edge = (size_t)ceil(margin * (double)n);
    double all = 0, before = 0, most = -(double)INFINITY;
    size_t best = 0;
    for (size_t i = 0; i < n; i++)
        all += y[i];
    for (size_t k = 1; k < n; k++) {
        before += y[k - 1];
        const double behind = all - before;
        const double gain = before * before / (double)k + behind * behind / (double)(n - k);
        if (k >= edge && k + edge <= n && gain > most) {
            most = gain;
            best = k;
        }
    }
    return best;
}

size_t wt_mser_5(const double *y, size_t n)
{
    enum { BATCH = 5 }; /* batch size of the rule MSER-5 */
    const size_t batches = n / BATCH;
    double sum = 0, squares = 0, least = (double)INFINITY;
    size_t best = 0;
    for (size_t d = batches; d-- > 0;) {
        double mean = 0;
        for (size_t i = 0; i < BATCH; i++)
            mean += y[BATCH * d + i] / BATCH;
        /* Welford's sums from the end */
        const double kept = (double)(batches - d), off = mean - sum;
        sum += off / kept;
        squares += off * (mean - sum);
        const double error = squares / (kept * kept);
        if (d <= batches / 2 && error <= least) {
            least = error;
            best = d;
        }
    }
    return BATCH * best;
}
