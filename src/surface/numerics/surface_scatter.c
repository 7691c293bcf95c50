/* Scatter of a power spectrum. The squared amplitude of a mode of a random surface is
 * exponential. The mean of several is chi-squared with two degrees of freedom for each
 * independent mode.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/math/gsl_quiet.h"
#include "core/math/normal_quantile.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>

/* Below one degree of freedom the place error dominates, which is normal in ln C. */
static const double min_df = 1;

double surface_log_bias(double freedom)
{
    return gsl_sf_psi(freedom / 2) - log(freedom / 2);
}

double surface_log_variance(double freedom)
{
    return gsl_sf_psi_n(1, freedom / 2);
}

/* Uses Newton's method in ln x on ln of the trigamma function, which is nearly straight: its
 * slope is between -2 and -1. */
double surface_variance_freedom(double variance)
{
    double x = variance > 1 ? 1 / sqrt(variance) : 1 / variance + 0.5;
    for (int i = 0; i < 8; i++) {
        const double value = gsl_sf_psi_n(1, x), slope = x * gsl_sf_psi_n(2, x) / value;
        x *= exp(log(variance / value) / slope);
    }
    return 2 * x;
}

wt_interval surface_interval(double mean, double freedom)
{
    wt_interval i = {.value = mean};
    gsl_quiet();
    if (freedom >= min_df) {
        i.low = mean * freedom / gsl_cdf_chisq_Qinv(0.025, freedom);
        i.high = mean * freedom / gsl_cdf_chisq_Pinv(0.025, freedom);
    } else {
        const double reach = NORMAL_95 * sqrt(surface_log_variance(freedom));
        i.low = mean * exp(-surface_log_bias(freedom) - reach);
        i.high = mean * exp(-surface_log_bias(freedom) + reach);
    }
    /* The interval is skewed, its logarithm is nearly symmetric. */
    i.standard_error = mean * log(i.high / i.low) / 2 / NORMAL_95;
    return i;
}
