/* Detection of stick-slip in the samples of a friction record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/record.h"

#include "core/base/arena.h"
#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>

/* Fall of a slip in standard deviations of the sample-to-sample scatter. White scatter does not
 * reach it in a million samples. */
static const double outstanding = 6;
/* Ratio of sticking to slipping time. It is 1 for a wave. */
static const double least_ratio = 2;
enum { FEWEST = 10 }; /* slips that determine a mean and its scatter */

/* Standard deviation of white scatter by the median of second differences, few of which are slips.
 * Their variance is 6 times larger. The median of |x| is 0.6745 standard deviations. */
static double noise_deviation(const double *y, size_t n, double *scratch)
{
    for (size_t i = 0; i + 2 < n; i++)
        scratch[i] = fabs(y[i] - 2 * y[i + 1] + y[i + 2]);
    numbers_sort(scratch, n - 2);
    return scratch[(n - 2) / 2] / (0.6745 * sqrt(6));
}

typedef struct slip_sums {
    double n, mean, squares; /* heights of the falls */
    double rise, fall;       /* number of samples */
} slip_sums;

static void add_fall(slip_sums *s, double height)
{
    s->n++;
    const double off = height - s->mean;
    s->mean += off / s->n;
    s->squares += off * (height - s->mean);
}

/* Finds falls between turning points with hysteresis. */
static slip_sums find_falls(const double *y, size_t n, double least)
{
    slip_sums s = {0};
    size_t top = 0, bottom = 0;
    bool falling = false;
    for (size_t i = 1; i < n; i++) {
        if (!falling && y[i] >= y[top])
            top = i;
        if (falling && y[i] <= y[bottom])
            bottom = i;
        if (!falling && y[top] - y[i] > least) {
            s.rise += (double)(top - bottom);
            falling = true;
            bottom = i;
        } else if (falling && y[i] - y[bottom] > least) {
            s.fall += (double)(bottom - top);
            add_fall(&s, y[top] - y[bottom]);
            falling = false;
            top = i;
        }
    }
    return s;
}

wt_stick_slip wt_stick_slip_find(const double *y, size_t n)
{
    const wt_stick_slip none = {0, (double)NAN, (double)NAN};
    if (n < 4 * FEWEST) /* a slip and its rise take at least four samples */
        return none;
    double *const scratch = wt_alloc(n, sizeof *scratch);
    const double scatter = noise_deviation(y, n, scratch);
    free(scratch);
    const slip_sums s = find_falls(y, n, outstanding * scatter);
    return s.n >= FEWEST && s.rise > least_ratio * s.fall
               ? (wt_stick_slip){(size_t)s.n, s.mean, sqrt(s.squares / (s.n - 1) / s.n)}
               : none;
}
