/* Comparison of two ratios of moduli.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/students_t.h"
#include "weartrack/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* Contribution to the denominator of Satterthwaite's degrees of freedom; 0 for a normal error. */
static double df_component(const wt_log_ratio *ratio)
{
    const double variance = ratio->standard_error * ratio->standard_error;
    return isnan(ratio->df) ? 0 : variance * variance / ratio->df;
}

wt_log_ratio_difference wt_log_ratio_compare(const wt_log_ratio *a, const wt_log_ratio *b)
{
    const double nan = (double)NAN;
    wt_log_ratio_difference d = {a->value - b->value, nan, nan, nan, nan};
    const double error = hypot(a->standard_error, b->standard_error);
    if (!isfinite(d.value) || !(error > 0) || !isfinite(error))
        return d;
    const double part = df_component(a) + df_component(b), t = fabs(d.value) / error;
    if (part > 0)
        d.df = error * error * error * error / part;
    const double reach = error * students_t_quantile(part > 0 ? d.df : (double)INFINITY);
    d.low = d.value - reach;
    d.high = d.value + reach;
    d.p = 2 * (part > 0 ? gsl_cdf_tdist_Q(t, d.df) : gsl_cdf_ugaussian_Q(t));
    return d;
}
