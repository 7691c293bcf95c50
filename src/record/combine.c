/* Combination of repeated measurements of one quantity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/record.h"

#include <math.h>

void record_group_add(record_group *s, wt_estimate e)
{
    s->n++;
    const double off = e.value - s->mean;
    s->mean += off / s->n;
    s->squares += off * (e.value - s->mean);
    s->error_squares += e.standard_error * e.standard_error;
}

static double scatter_variance(const record_group *s)
{
    return s->n > 1 ? s->squares / (s->n * (s->n - 1)) : 0;
}

double record_group_df(const record_group *s)
{
    const double by_errors = s->error_squares / (s->n * s->n);
    return s->n > 1 && (isnan(by_errors) || scatter_variance(s) > by_errors) ? s->n - 1
                                                                             : (double)NAN;
}

wt_estimate record_group_mean(const record_group *s, const char *unit)
{
    if (!(s->n > 0))
        return (wt_estimate){(double)NAN, (double)NAN, 0, unit};
    const double by_scatter = scatter_variance(s), by_errors = s->error_squares / (s->n * s->n);
    /* An unknown standard error leaves only the scatter, which a single measurement does not
     * have. */
    if (isnan(by_errors) && s->n > 1)
        return (wt_estimate){s->mean, sqrt(by_scatter), 0, unit};
    return (wt_estimate){s->mean, isnan(by_errors) ? by_errors : sqrt(fmax(by_errors, by_scatter)),
                         0, unit};
}

void wear_rates_close_run(wear_rates *rates)
{
    if (!(rates->run.n > 0))
        return;
    record_group_add(&rates->all, record_group_mean(&rates->run, "m^2/N"));
    rates->freedom = record_group_df(&rates->run);
    rates->run = (record_group){.n = 0};
}

wt_estimate wear_rates_mean(const wear_rates *rates)
{
    return record_group_mean(&rates->all, "m^2/N");
}

double wear_rates_df(const wear_rates *rates)
{
    return rates->all.n == 1 ? rates->freedom : record_group_df(&rates->all);
}
