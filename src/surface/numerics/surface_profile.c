/* Converts the spectrum of profiles to the spectrum of an isotropic surface, with its scatter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Width of a quadrature subinterval. cosh^(p - 1) is singular at i pi/2, so ten points are exact
 * to rounding for the slopes of spectra (tested to p = -8). */
static const double subinterval_width = 0.5;
enum { INVERSION_POINTS = 10 };
/* Beyond this limit cosh^(p - 1) is below rounding even for the flattest allowed slope, -1. */
static const double cosh_limit = 20;

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

/* Maximum variance of ln C. Above it ln C is not normal and the density is dropped. */
static const double largest_variance = 0.5;

/* Returns the relative variance of C at a knot due to the scatter of all knots of C1. */
static double relative_variance(const wt_surface_spectrum *p, const double *q, double *c1,
                                size_t at, double c, const gsl_integration_glfixed_table *rule)
{
    const double step = 1e-4; /* step in ln C1; the inversion is smooth in it */
    double sum = 0;
    for (size_t k = 0; k < p->n; k++) {
        const double unperturbed = c1[k];
        c1[k] = unperturbed * exp(step);
        const double high = surface_invert_profile(q, c1, p->n, true, q[at], rule);
        c1[k] = unperturbed * exp(-step);
        const double low = surface_invert_profile(q, c1, p->n, true, q[at], rule);
        c1[k] = unperturbed;
        const double slope = (high - low) / (2 * step * c);
        sum += slope * slope * surface_log_variance(p->bins[k].freedom);
    }
    return sum;
}

static wt_status fail_flat_spectrum(wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "the spectrum of the profile does not fall at its end");
    wt_error_expected(err, "a slope of ln C1 against ln q below -1 there");
    wt_error_advice(err,
                    "noise makes it flat: measure with less, or end the range at longer waves, "
                    "by more points-per-wave");
    return WT_E_RANGE;
}

wt_status wt_surface_from_profile(const double *wavenumber, const double *c1, size_t n, double *c,
                                  wt_error *err)
{
    if (wavenumber == NULL || c1 == NULL || c == NULL || n < 2)
        return wt_fail(err, WT_E_ARG, "no spectrum of a profile");
    for (size_t k = 0; k < n; k++)
        if (!(c1[k] > 0) || !isfinite(c1[k])) {
            wt_fail(err, WT_E_RANGE, "density %zu of %zu of the profile is not above 0", k + 1, n);
            wt_error_found(err, "%g m^3", c1[k]);
            return WT_E_RANGE;
        }
    gsl_integration_glfixed_table *rule = surface_inversion_rule();
    wt_status status = WT_OK;
    if (isnan(surface_invert_profile(wavenumber, c1, n, true, wavenumber[0], rule)))
        status = fail_flat_spectrum(err);
    for (size_t k = 0; status == WT_OK && k < n; k++) {
        c[k] = surface_invert_profile(wavenumber, c1, n, true, wavenumber[k], rule);
        if (c[k] > 0)
            continue;
        status = wt_fail(err, WT_E_RANGE,
                         "the spectrum of the profile rises too steeply for that "
                         "of a surface that is the same in all directions");
        wt_error_found(err, "no density above 0 at %g rad/m", wavenumber[k]);
    }
    gsl_integration_glfixed_table_free(rule);
    return status;
}

wt_status wt_surface_invert(const wt_surface_spectrum *profile, wt_surface_spectrum *surface,
                            wt_error *err)
{
    if (profile == NULL || surface == NULL || profile->kind != WT_SPECTRUM_1D || profile->n < 2)
        return wt_fail(err, WT_E_ARG, "no spectrum of a profile");
    wt_surface_spectrum made = *profile;
    double *q = wt_alloc(2 * profile->n, sizeof *q), *const c1 = q + profile->n;
    made.kind = WT_SPECTRUM_2D;
    made.n = made.n_sizes = 0;
    made.place_part = NULL; /* each bin of C depends on many bins of C1 */
    made.bins = wt_alloc(profile->n, sizeof *made.bins);
    gsl_integration_glfixed_table *rule = surface_inversion_rule();
    wt_status status = WT_OK;
    for (size_t k = 0; k < profile->n; k++) {
        q[k] = profile->bins[k].wavenumber;
        c1[k] = profile->bins[k].density;
    }
    if (isnan(surface_invert_profile(q, c1, profile->n, true, q[0], rule)))
        status = fail_flat_spectrum(err);
    for (size_t k = 0; status == WT_OK && k < profile->n; k++) {
        const double c = surface_invert_profile(q, c1, profile->n, true, q[k], rule);
        const double variance =
            c > 0 ? relative_variance(profile, q, c1, k, c, rule) : (double)INFINITY;
        if (!(variance < largest_variance))
            continue;
        wt_spectrum_bin *b = &made.bins[made.n++];
        *b = profile->bins[k];
        b->density = c;
        b->deviation = b->cosine = b->sine = b->cosine_fourth = b->sine_fourth = (double)NAN;
        for (size_t s = 0; s < WT_SURFACE_SECTORS; s++)
            b->sector_modes[s] = b->sector_sum[s] = 0;
        b->shared_freedom *= surface_variance_freedom(variance) / b->freedom;
        b->freedom = surface_variance_freedom(variance);
    }
    if (status == WT_OK && made.n < 2) {
        status = wt_fail(err, WT_E_RANGE,
                         "so few profiles do not determine the spectrum of the surface");
        wt_error_expected(err, "densities that are known to a factor of two");
        wt_error_advice(err, "measure more profiles, ten say, longer ones, or a height map");
    }
    free(q);
    gsl_integration_glfixed_table_free(rule);
    if (status == WT_OK)
        *surface = made;
    else
        free(made.bins);
    return status;
}
