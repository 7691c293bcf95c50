/* Roughness: what every law shares - root-mean-square height and slope, a spectrum cut to a
 * narrower range, release.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/model.h"

#include <math.h>
#include <stdlib.h>

void wt_roughness_free(wt_roughness *roughness)
{
    if (!roughness)
        return;
    if (roughness->law->free)
        roughness->law->free(roughness);
    free(roughness);
}

/* int q^(m+1) C d(ln q) over [from, to], inside which C is smooth: Gauss-Legendre with 8 nodes on
 * pieces so short that any power law is integrated to rounding. */
static double moment_piece(const wt_roughness *roughness, int m, double from, double to)
{
    static const double node[4] = {0.1834346424956498049, 0.5255324099163289858,
                                   0.7966664774136267396, 0.9602898564975362317};
    static const double weight[4] = {0.3626837833783619830, 0.3137066458778872873,
                                     0.2223810344533744706, 0.1012285362903762592};
    const double length = log1p((to - from) / from);
    const size_t pieces = 1 + (size_t)(length / 0.25);
    const double half = length / (2 * (double)pieces);
    double sum = 0;
    for (size_t p = 0; p < pieces; p++) {
        const double middle = (2 * (double)p + 1) * half;
        double q[8], c[8];
        for (size_t i = 0; i < 4; i++) {
            q[2 * i] = from * exp(middle - half * node[i]);
            q[2 * i + 1] = from * exp(middle + half * node[i]);
        }
        roughness->law->density(roughness, q, 8, c);
        for (size_t i = 0; i < 8; i++)
            sum += half * weight[i / 2] * pow(q[i], m + 1) * c[i];
    }
    return sum;
}

static double moment_all(const wt_roughness *roughness, int m)
{
    if (roughness->law->moment)
        return roughness->law->moment(roughness, m, roughness->q1);
    size_t n = 0;
    const double *breaks = roughness->law->breaks ? roughness->law->breaks(roughness, &n) : NULL;
    double from = roughness->q0;
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += moment_piece(roughness, m, from, breaks[i]);
        from = breaks[i];
    }
    return sum + moment_piece(roughness, m, from, roughness->q1);
}

double wt_roughness_rms_height(const wt_roughness *roughness)
{
    return sqrt(2 * M_PI * moment_all(roughness, 1));
}

double wt_roughness_rms_slope(const wt_roughness *roughness)
{
    return sqrt(2 * M_PI * moment_all(roughness, 3));
}

/* ---- cut ------------------------------------------------------------------------------------- */

typedef struct cut_data {
    const wt_roughness *base; /* borrowed */
    size_t n;
    double breaks[]; /* of the base, inside the cut */
} cut_data;

static void cut_density(const wt_roughness *roughness, const double *q, size_t n, double *c)
{
    const cut_data *d = roughness->data;
    d->base->law->density(d->base, q, n, c);
    for (size_t i = 0; i < n; i++)
        if (!(q[i] >= roughness->q0 && q[i] <= roughness->q1))
            c[i] = 0;
}

static const double *cut_breaks(const wt_roughness *roughness, size_t *n)
{
    const cut_data *d = roughness->data;
    *n = d->n;
    return d->breaks;
}

static void cut_free(wt_roughness *roughness)
{
    free(roughness->data);
}

/* No closed moment: a difference of two moments of the base would cancel. */
static const wt_roughness_law cut_law = {
    .name = "cut",
    .density = cut_density,
    .breaks = cut_breaks,
    .moment = NULL,
    .free = cut_free,
};

wt_status wt_roughness_cut(const wt_roughness *base, double q0, double q1, wt_roughness **roughness,
                           wt_error *err)
{
    if (!base || !roughness)
        return wt_fail(err, WT_E_ARG, "a cut needs a spectrum and a place for the result");
    if (!(q0 >= base->q0 && q1 <= base->q1 && q0 < q1)) {
        wt_fail(err, WT_E_RANGE, "the cut-off wavenumbers are outside the power spectrum");
        wt_error_expected(err, "%g <= q0 < q1 <= %g rad/m", base->q0, base->q1);
        wt_error_found(err, "q0 = %g, q1 = %g rad/m", q0, q1);
        return WT_E_RANGE;
    }
    size_t n = 0;
    const double *breaks = base->law->breaks ? base->law->breaks(base, &n) : NULL;
    wt_roughness *made = malloc(sizeof *made);
    cut_data *d = malloc(sizeof *d + n * sizeof *d->breaks);
    if (!made || !d) {
        free(made);
        free(d);
        return wt_fail(err, WT_E_MEMORY, "out of memory for a power spectrum");
    }
    d->base = base;
    d->n = 0;
    for (size_t i = 0; i < n; i++)
        if (breaks[i] > q0 && breaks[i] < q1)
            d->breaks[d->n++] = breaks[i];
    *made = (wt_roughness){.law = &cut_law, .q0 = q0, .q1 = q1, .data = d};
    *roughness = made;
    return WT_OK;
}
