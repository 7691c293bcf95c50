/* Comparison of two or more logarithms of ratios with their errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/students_t.h"
#include "weartrack/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* ---- two ratios ------------------------------------------------------------------------------ */

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

/* ---- several ratios -------------------------------------------------------------------------- */

double wt_log_ratio_test(const wt_log_ratio *of, size_t n)
{
    const double k = (double)n;
    double sum = 0, mean = 0, chi_squared = 0, spread = 0;
    for (size_t i = 0; i < n; i++) {
        const double weight = 1 / (of[i].standard_error * of[i].standard_error);
        sum += weight;
        mean += weight * (of[i].value - of[0].value);
    }
    mean = of[0].value + mean / sum;
    for (size_t i = 0; i < n; i++) {
        const double weight = 1 / (of[i].standard_error * of[i].standard_error),
                     rest = 1 - weight / sum;
        chi_squared += weight * (of[i].value - mean) * (of[i].value - mean);
        if (!isnan(of[i].df))
            spread += rest * rest / of[i].df;
    }
    return spread > 0
               ? gsl_cdf_fdist_Q(chi_squared / (k - 1) / (1 + 2 * (k - 2) / (k * k - 1) * spread),
                                 k - 1, (k * k - 1) / (3 * spread))
               : gsl_cdf_chisq_Q(chi_squared, k - 1);
}
