/* Predicted course of a running-in, and the series of means that it is compared with.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "record/numerics/running_in_curve.h"

#include <math.h>
#include <stdlib.h>

double running_in_curve_at(const running_in_curve *c, double log_time)
{
    const double place = (log_time - c->log_first) / c->log_step;
    if (!(place > 0))
        return c->value[0];
    if (place >= (double)(c->n - 1))
        return 0;
    const size_t i = (size_t)place;
    const double part = place - (double)i;
    return c->value[i] + part * (c->value[i + 1] - c->value[i]);
}

double running_in_curve_height(const running_in_curve *c)
{
    double most = 0;
    for (size_t i = 0; i < c->n; i++)
        most = fmax(most, fabs(c->value[i]));
    return most;
}

double running_in_curve_settling_time(const running_in_curve *c, double share)
{
    const double limit = share * running_in_curve_height(c);
    for (size_t i = c->n; limit > 0 && i-- > 0;)
        if (fabs(c->value[i]) > limit) {
            if (i + 1 == c->n)
                return (double)NAN;
            const double here = fabs(c->value[i]), next = fabs(c->value[i + 1]),
                         part = (here - limit) / (here - next);
            return exp(c->log_first + ((double)i + part) * c->log_step);
        }
    return (double)NAN;
}

running_in_series running_in_series_alloc(size_t n)
{
    return (running_in_series){
        .n = n, .end = wt_alloc(n, sizeof(double)), .friction = wt_alloc(n, sizeof(double))};
}

void running_in_series_clear(running_in_series *s)
{
    free(s->end);
    free(s->friction);
    *s = (running_in_series){.n = 0};
}
