/* Cholesky factor and solution in place. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/cholesky.h"

#include <math.h>

bool cholesky_factor(double *a, size_t stride, size_t n, double least)
{
    for (size_t i = 0; i < n; i++) {
        double *row = a + i * stride;
        for (size_t j = 0; j <= i; j++) {
            const double *other = a + j * stride;
            double sum = row[j];
            for (size_t k = 0; k < j; k++)
                sum -= row[k] * other[k];
            if (i == j && !(sum > least * row[i]))
                return false;
            row[j] = i == j ? sqrt(sum) : sum / other[j];
        }
    }
    return true;
}

void cholesky_forward(const double *l, size_t stride, size_t n, const double *b, double *x)
{
    for (size_t i = 0; i < n; i++) {
        double sum = b[i];
        for (size_t k = 0; k < i; k++)
            sum -= l[i * stride + k] * x[k];
        x[i] = sum / l[i * stride + i];
    }
}

bool cholesky_solve(double *a, size_t stride, size_t n, double least, double *x)
{
    if (!cholesky_factor(a, stride, n, least))
        return false;
    cholesky_forward(a, stride, n, x, x);
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            x[i] -= a[k * stride + i] * x[k];
        x[i] /= a[i * stride + i];
    }
    return true;
}
