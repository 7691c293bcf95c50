/* Factor and solution in place. SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/cholesky.h"

#include <math.h>

static bool factor_rows(double *a, size_t stride, size_t n, double least)
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

bool cholesky_solve(double *a, size_t stride, size_t n, double least, double *x)
{
    if (!factor_rows(a, stride, n, least))
        return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++)
            x[i] -= a[i * stride + k] * x[k];
        x[i] /= a[i * stride + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            x[i] -= a[k * stride + i] * x[k];
        x[i] /= a[i * stride + i];
    }
    return true;
}
