/* Chebyshev interpolation and its truncation error. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/chebyshev.h"
#include "core/math/simd.h"

#include <float.h>
#include <math.h>
#include <string.h>

WIDE_REGISTERS
void chebyshev_fit(const double *restrict value, size_t degree, const double *restrict fit,
                   double *restrict coefficient)
{
    const size_t step = CHEBYSHEV_DEGREE_MAX / degree;
    double sum[CHEBYSHEV_FIT_STRIDE] = {0};
    for (size_t k = 0; k <= degree; k++)
        for (size_t j = 0; j < CHEBYSHEV_FIT_STRIDE; j++)
            sum[j] += value[k * step] * fit[k * CHEBYSHEV_FIT_STRIDE + j];
    memcpy(coefficient, sum, (CHEBYSHEV_DEGREE_MAX + 1) * sizeof *coefficient);
}

double chebyshev_tail(const double *coefficient, const double *value, size_t degree)
{
    double least = (double)INFINITY, most = 0;
    for (size_t k = 0; k <= CHEBYSHEV_DEGREE_MAX; k += CHEBYSHEV_DEGREE_MAX / degree) {
        least = fmin(least, value[k]);
        most = fmax(most, value[k]);
    }
    const double last = fmax(fabs(coefficient[degree]), fabs(coefficient[degree - 1]));
    const double tail = 2 * fmax(last, 0.1 * fabs(coefficient[degree - 2]));
    return most > 0 ? tail / (least > 0 ? least : most) : 0;
}

double chebyshev_to_monomials(double *coefficient, size_t *degree, double allowed)
{
    double t[CHEBYSHEV_DEGREE_MAX + 1] = {0}, last[CHEBYSHEV_DEGREE_MAX + 1] = {1},
                                    now[CHEBYSHEV_DEGREE_MAX + 1] = {0, 1};
    double cut = 0, sum = 0;
    size_t kept = *degree;
    while (kept > 2 && cut + fabs(coefficient[kept]) <= allowed)
        cut += fabs(coefficient[kept--]);
    t[0] = coefficient[0];
    for (size_t n = 1; n <= kept; n++) {
        double next[CHEBYSHEV_DEGREE_MAX + 1] = {0};
        for (size_t k = 0; k <= n; k++) {
            t[k] += coefficient[n] * now[k];
            next[k] -= last[k];
        }
        for (size_t k = 0; k <= n && k < CHEBYSHEV_DEGREE_MAX; k++)
            next[k + 1] += 2 * now[k];
        memcpy(last, now, sizeof last);
        memcpy(now, next, sizeof now);
    }
    for (size_t k = 0; k <= CHEBYSHEV_DEGREE_MAX; k++) {
        coefficient[k] = t[k];
        sum += fabs(t[k]);
    }
    *degree = kept;
    return cut + 2 * DBL_EPSILON * sum;
}
