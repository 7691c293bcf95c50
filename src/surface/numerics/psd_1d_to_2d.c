/* Converts the spectrum of profiles to the spectrum of an isotropic surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/base/memory.h"

#include <math.h>

/* Width of a quadrature subinterval. cosh^(p - 1) is singular at i pi/2, so ten points are exact
 * to rounding for the slopes of spectra (tested to p = -8). */
static const double subinterval_width = 0.5;
/* Beyond this limit cosh^(p - 1) is below rounding even for the flattest allowed slope, -1. */
static const double cosh_limit = 20;

enum { INVERSION_POINTS = 10 };

gsl_integration_glfixed_table *surface_inversion_rule(void)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(INVERSION_POINTS);
    if (rule == NULL)
        out_of_memory(sizeof *rule);
    return rule;
}

/* Integrates cosh^power t from a to b. */
static double cosh_power_integral(const gsl_integration_glfixed_table *rule, double a, double b,
                                  double power)
{
    const double n = fmax(1, ceil((b - a) / subinterval_width)), width = (b - a) / n;
    double sum = 0, t, weight;
    for (double i = 0; i < n; i++)
        for (size_t k = 0; k < rule->n; k++) {
            gsl_integration_glfixed_point(a + i * width, a + (i + 1) * width, k, &t, &weight, rule);
            sum += weight * pow(cosh(t), power);
        }
    return sum;
}

double surface_invert_profile(const double *q, const double *c1, size_t n, bool extrapolate,
                              double at, const gsl_integration_glfixed_table *rule)
{
    double sum = 0, p = 0;
    if (n < 2 || !(at >= q[0]))
        return (double)NAN;
    for (size_t i = 0; i + 1 < n; i++) {
        p = log(c1[i + 1] / c1[i]) / log(q[i + 1] / q[i]);
        if (q[i + 1] <= at)
            continue;
        /* substitution k = at cosh t */
        sum += p * c1[i] * pow(at / q[i], p) *
               cosh_power_integral(rule, q[i] > at ? acosh(q[i] / at) : 0, acosh(q[i + 1] / at),
                                   p - 1);
    }
    const double end = q[n - 1];
    if (extrapolate && !(p <= -1))
        return (double)NAN;
    if (extrapolate) {
        const double from = end > at ? acosh(end / at) : 0;
        sum += p * c1[n - 1] * pow(at / end, p) *
               cosh_power_integral(rule, from, from + cosh_limit, p - 1);
    } else {
        sum -= at < end ? c1[n - 1] / sqrt((end / at) * (end / at) - 1) : (double)NAN;
    }
    return -sum / (M_PI * at);
}
