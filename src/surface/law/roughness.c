/* Roughness laws: moments, piecewise power laws (self-affine with a roll-off, log-log tables).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/surface.h"

#include "core/base/param.h"
#include "core/math/special.h"

#include <float.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- piecewise power laws -------------------------------------------------------------------- */

/* C = density[i] (q / knot[i])^slope[i] for knot[i] <= q <= knot[i + 1]. */
typedef struct power_data {
    size_t n;         /* number of segments */
    double *knot;     /* [n + 1] rad/m, rising */
    double *density;  /* [n] m^4 at the left end */
    double *slope;    /* [n] */
    double *below[2]; /* [n] int q C and int q^3 C up to the left end of a segment */
    double numbers[]; /* [5 n + 1] storage of the five arrays */
} power_data;

static void power_density(const wt_roughness *roughness, const double *q, size_t n, double *c)
{
    const power_data *d = roughness->data;
    for (size_t i = 0; i < n; i++) {
        const size_t k = gsl_interp_bsearch(d->knot, q[i], 0, d->n);
        if (!(q[i] >= roughness->q0 && q[i] <= roughness->q1))
            c[i] = 0;
        else if (d->slope[k] == 0)
            c[i] = d->density[k];
        else
            c[i] = d->density[k] * pow(q[i] / d->knot[k], d->slope[k]);
    }
}

static const double *power_breaks(const wt_roughness *roughness, size_t *n)
{
    const power_data *d = roughness->data;
    *n = d->n - 1;
    return d->knot + 1;
}

/* Integrates q^m C from knot k to q. */
static double power_segment_moment(const power_data *d, int m, size_t k, double q)
{
    const double from = d->knot[k];
    const double length = log1p((q - from) / from);
    const double exponent = (m + 1) + d->slope[k];
    const double integral = exponent == 0 ? length : expm1(exponent * length) / exponent;
    return d->density[k] * pow(from, m + 1) * integral;
}

static double power_moment(const wt_roughness *roughness, int m, double q)
{
    const power_data *d = roughness->data;
    const size_t k = gsl_interp_bsearch(d->knot, q, 0, d->n);
    return d->below[m == 3][k] + power_segment_moment(d, m, k, fmin(q, d->knot[d->n]));
}

static void power_free(wt_roughness *roughness)
{
    free(roughness->data);
}

static const wt_roughness_law self_affine_law = {
    .name = "self_affine",
    .density = power_density,
    .breaks = power_breaks,
    .moment = power_moment,
    .free = power_free,
    .powers = true,
};

static const wt_roughness_law table_law = {
    .name = "table",
    .density = power_density,
    .breaks = power_breaks,
    .moment = power_moment,
    .free = power_free,
    .powers = true,
};

static wt_roughness *power_new(const wt_roughness_law *law, const double *knot,
                               const double *density, const double *slope, size_t segments)
{
    wt_roughness *made = wt_alloc(1, sizeof *made);
    power_data *d = wt_alloc(1, sizeof *d + (5 * segments + 1) * sizeof d->numbers[0]);
    d->n = segments;
    d->knot = d->numbers;
    d->density = d->knot + segments + 1;
    d->slope = d->density + segments;
    d->below[0] = d->slope + segments;
    d->below[1] = d->below[0] + segments;
    memcpy(d->knot, knot, (segments + 1) * sizeof *knot);
    memcpy(d->density, density, segments * sizeof *density);
    memcpy(d->slope, slope, segments * sizeof *slope);
    for (size_t i = 0; i < 2; i++) {
        d->below[i][0] = 0;
        for (size_t k = 0; k + 1 < segments; k++)
            d->below[i][k + 1] =
                d->below[i][k] + power_segment_moment(d, i == 0 ? 1 : 3, k, d->knot[k + 1]);
    }
    *made = (wt_roughness){.law = law, .q0 = knot[0], .q1 = knot[segments], .data = d};
    return made;
}

wt_status wt_roughness_self_affine(double q0, double qr, double q1, double hurst, double c0,
                                   wt_roughness **roughness, wt_error *err)
{
    if (roughness == NULL)
        return wt_fail(err, WT_E_ARG, "a power spectrum needs a place for the result");
    if (!(q0 > 0) || !isfinite(q0))
        return range_error("q0 of a power spectrum", q0, "finite and > 0 rad/m", err);
    if (!(q1 > q0) || !isfinite(q1))
        return range_error("q1 of a power spectrum", q1, "finite and > q0, in rad/m", err);
    if (!(qr >= q0 && qr <= q1))
        return range_error("qr of a power spectrum", qr, "q0 <= qr <= q1, in rad/m", err);
    if (!(hurst > -1 && hurst <= 3))
        return range_error("hurst of a power spectrum", hurst,
                           "-1 < hurst <= 3 (0 to 1 for a self-affine surface)", err);
    if (!(c0 > 0) || !isfinite(c0))
        return range_error("c0 of a power spectrum", c0, "finite and > 0 m^4", err);
    const double fall = -2 * (1 + hurst);
    if (qr == q0)
        *roughness = power_new(&self_affine_law, (double[]){q0, q1}, &c0, &fall, 1);
    else if (qr == q1)
        *roughness = power_new(&self_affine_law, (double[]){q0, q1}, &c0, (double[]){0}, 1);
    else
        *roughness = power_new(&self_affine_law, (double[]){q0, qr, q1}, (double[]){c0, c0},
                               (double[]){0, fall}, 2);
    return WT_OK;
}

wt_status wt_roughness_table(const double *q, const double *c, size_t n, wt_roughness **roughness,
                             wt_error *err)
{
    if (q == NULL || c == NULL || roughness == NULL || n < 2)
        return wt_fail(err, WT_E_ARG, "a table of a power spectrum needs at least 2 knots");
    for (size_t i = 0; i < n; i++) {
        wt_status status = WT_OK;
        if (!(q[i] > (i ? q[i - 1] : 0)) || !isfinite(q[i]))
            status = range_error("wavenumber of a power spectrum", q[i],
                                 "finite, > 0 rad/m and rising", err);
        else if (!(c[i] > 0) || !isfinite(c[i]))
            status = range_error("density of a power spectrum", c[i], "finite and > 0 m^4", err);
        if (status != WT_OK) {
            wt_error_place(err, "knot %zu of %zu", i + 1, n);
            return status;
        }
    }
    double *slope = wt_alloc(n - 1, sizeof *slope);
    for (size_t i = 0; i + 1 < n; i++)
        slope[i] = log(c[i + 1] / c[i]) / log1p((q[i + 1] - q[i]) / q[i]);
    *roughness = power_new(&table_law, q, c, slope, n - 1);
    free(slope);
    return WT_OK;
}

/* ---- every law ------------------------------------------------------------------------------- */

void wt_roughness_free(wt_roughness *roughness)
{
    if (roughness == NULL)
        return;
    if (roughness->law->free != NULL)
        roughness->law->free(roughness);
    free(roughness);
}

/* Integrates q^(m+1) C d(ln q) over [from, to], where C is smooth. Gauss-Legendre quadrature
 * with 8 nodes uses segments so short that a power law is exact to rounding. */
static double segment_moment(const wt_roughness *roughness, int m, double from, double to)
{
    const double length = log1p((to - from) / from);
    const size_t segments = 1 + (size_t)(length / 0.25);
    const double half = length / (2 * (double)segments);
    double sum = 0;
    for (size_t p = 0; p < segments; p++) {
        const double middle = (2 * (double)p + 1) * half;
        double q[8], c[8];
        for (size_t i = 0; i < 4; i++) {
            q[2 * i] = from * exp(middle - half * gauss_8_node[i]);
            q[2 * i + 1] = from * exp(middle + half * gauss_8_node[i]);
        }
        roughness->law->density(roughness, q, 8, c);
        for (size_t i = 0; i < 8; i++)
            sum += half * gauss_8_weight[i / 2] * pow(q[i], m + 1) * c[i];
    }
    return sum;
}

double wt_roughness_moment(const wt_roughness *roughness, int m, double q)
{
    if (roughness->law->moment != NULL)
        return roughness->law->moment(roughness, m, q);
    size_t n = 0;
    const double *breaks =
        roughness->law->breaks != NULL ? roughness->law->breaks(roughness, &n) : NULL;
    double from = roughness->q0;
    double sum = 0;
    for (size_t i = 0; i < n && breaks[i] < q; i++) {
        sum += segment_moment(roughness, m, from, breaks[i]);
        from = breaks[i];
    }
    return sum + segment_moment(roughness, m, from, q);
}

double wt_roughness_rms_height(const wt_roughness *roughness)
{
    return sqrt(2 * M_PI * wt_roughness_moment(roughness, 1, roughness->q1));
}

double wt_roughness_rms_slope(const wt_roughness *roughness)
{
    return sqrt(2 * M_PI * wt_roughness_moment(roughness, 3, roughness->q1));
}
