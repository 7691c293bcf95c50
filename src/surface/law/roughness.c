/* Functions that all roughness laws share: moments, root-mean-square height and slope, release.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/law/roughness.h"
#include "core/math/special.h"

#include <math.h>
#include <stdlib.h>

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

double roughness_moment(const wt_roughness *roughness, int m, double q)
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
    return sqrt(2 * M_PI * roughness_moment(roughness, 1, roughness->q1));
}

double wt_roughness_rms_slope(const wt_roughness *roughness)
{
    return sqrt(2 * M_PI * roughness_moment(roughness, 3, roughness->q1));
}
