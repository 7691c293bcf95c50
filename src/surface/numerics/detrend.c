/* Removes the form of a surface: a polynomial fitted to its heights by least squares.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/math/cholesky.h"

#include <float.h>
#include <math.h>

/* Powers of x and y in the terms of a form. */
static const int power_x[FORM_TERMS] = {0, 1, 0, 2, 1, 0}, power_y[FORM_TERMS] = {0, 0, 1, 0, 1, 2};
enum { HIGHEST = 4 }; /* highest power in a product of two terms */

static double normalised_coordinate(size_t i, size_t n)
{
    return n > 1 ? (2 * (double)i + 1 - (double)n) / (double)n : 0;
}

/* Lists the terms of the form. A profile has no terms in y. */
static size_t select_form_terms(unsigned degree, bool profile, size_t terms[FORM_TERMS])
{
    size_t n = 0;
    for (size_t t = 0; t < FORM_TERMS; t++)
        if ((unsigned)(power_x[t] + power_y[t]) <= degree && !(profile && power_y[t] > 0))
            terms[n++] = t;
    return n;
}

/* Sums of x^i and of x^i z over the heights of a row. */
typedef struct row_sums {
    double x[HIGHEST + 1], z[HIGHEST / 2 + 1];
    size_t n;
} row_sums;

static row_sums sum_row(const double *z, size_t nx)
{
    row_sums s = {.n = 0};
    for (size_t i = 0; i < nx; i++) {
        if (!isfinite(z[i]))
            continue;
        const double x = normalised_coordinate(i, nx), x2 = x * x;
        s.n++;
        s.x[1] += x;
        s.x[2] += x2;
        s.x[3] += x2 * x;
        s.x[4] += x2 * x2;
        s.z[0] += z[i];
        s.z[1] += x * z[i];
        s.z[2] += x2 * z[i];
    }
    s.x[0] = (double)s.n;
    return s;
}

static double integer_power(double y, int n)
{
    return n == 0 ? 1 : n == 1 ? y : n == 2 ? y * y : n == 3 ? y * y * y : y * y * y * y;
}

static void subtract_form(double *z, size_t nx, size_t ny, const double c[FORM_TERMS])
{
    for (size_t j = 0; j < ny; j++) {
        const double y = normalised_coordinate(j, ny);
        const double a = c[0] + y * (c[2] + y * c[5]), b = c[1] + y * c[4];
        for (size_t i = 0; i < nx; i++) {
            const double x = normalised_coordinate(i, nx);
            z[j * nx + i] -= a + x * (b + x * c[3]);
        }
    }
}

wt_status surface_remove_form(double *z, size_t nx, size_t ny, unsigned degree,
                              double coefficients[FORM_TERMS], wt_error *err)
{
    size_t terms[FORM_TERMS], n_points = 0;
    double m[FORM_TERMS][FORM_TERMS] = {{0}}, v[FORM_TERMS] = {0};
    const size_t n = select_form_terms(degree, ny == 1, terms);
    for (size_t j = 0; j < ny; j++) {
        const row_sums s = sum_row(z + j * nx, nx);
        const double y = normalised_coordinate(j, ny);
        n_points += s.n;
        for (size_t a = 0; a < n; a++) {
            const int xa = power_x[terms[a]], ya = power_y[terms[a]];
            v[a] += integer_power(y, ya) * s.z[xa];
            for (size_t b = 0; b <= a; b++)
                m[a][b] += integer_power(y, ya + power_y[terms[b]]) * s.x[xa + power_x[terms[b]]];
        }
    }
    for (size_t t = 0; t < FORM_TERMS; t++)
        coefficients[t] = 0;
    /* Pivots within the rounding error count as zero. */
    if (n_points < n ||
        !cholesky_solve(&m[0][0], FORM_TERMS, n, (double)(n * n) * DBL_EPSILON, v)) {
        wt_fail(err, WT_E_EMPTY, "too few heights for the form that is taken off");
        wt_error_expected(err, "%zu or more that do not lie on one line", n);
        wt_error_found(err, "%zu", n_points);
        return WT_E_EMPTY;
    }
    for (size_t a = 0; a < n; a++)
        coefficients[terms[a]] = v[a];
    subtract_form(z, nx, ny, coefficients);
    return WT_OK;
}
