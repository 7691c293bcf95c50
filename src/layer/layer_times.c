/* Default times of the history of a layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_energy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of default times, as many as a figure shows well. They reach from half the first time
 * scale to a multiple of the last, where the layer is steady. A missing scale is set by a ratio to
 * the other one. The choice of times does not affect their results. */
#define DEFAULT_TIMES 61
#define TIME_SPAN 100
#define FIRST_OVER_LAST 1e-3
#define LAST_OVER_FIRST 1e6

/* Times from well before the first change to well after the last one. */
double *layer_times_choose(const wt_layer_job *job, const wt_layer_steady_state *b, size_t *n)
{
    *n = job->time != NULL ? job->n_time : DEFAULT_TIMES;
    double *const time = wt_alloc(*n > 0 ? *n : 1, sizeof *time);
    if (job->time != NULL) {
        memcpy(time, job->time, *n * sizeof *time);
        return time;
    }
    double first = b->incubation_time.value, last = b->relaxation_time.value;
    if (!(first > 0) || !isfinite(first))
        first = isfinite(last) && last > 0 ? FIRST_OVER_LAST * last : 1;
    if (!(last > 0) || !isfinite(last))
        last = LAST_OVER_FIRST * first;
    first /= 2;
    last = TIME_SPAN * fmax(last, first);
    for (size_t i = 0; i < *n; i++)
        time[i] = first * pow(last / first, (double)i / (double)(*n - 1));
    return time;
}
