/* Weight of an anisotropic roughness in the angular integrals, as polynomials in cos^2 phi.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/angular.h"

#include "surface/law/roughness.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- anisotropy ------------------------------------------------------------------------------ */

bool anisotropy_is_present(const wt_anisotropy *a)
{
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++)
        if (a->amplitude[k] != 0)
            return true;
    return false;
}

/* Amplitudes of cos(m phi) and of sin(m phi). */
static void split_harmonic(const wt_anisotropy *a, size_t k, double *even, double *odd)
{
    /* an integer of turns off, so that grooves across and along are exact */
    const double turn = remainder(anisotropy_order(k) * a->angle[k], 2 * M_PI);
    *even = a->amplitude[k] * cos(turn);
    *odd = a->amplitude[k] * sin(turn);
    /* pi is rounded: what m chi = pi leaves is nothing */
    if (fabs(*odd) <= 4 * DBL_EPSILON * (1 + fabs(anisotropy_order(k) * a->angle[k])) * fabs(*even))
        *odd = 0;
}

bool anisotropy_has_lateral_force(const wt_anisotropy *a)
{
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++) {
        double even, odd;
        split_harmonic(a, k, &even, &odd);
        if (odd != 0)
            return true;
    }
    return false;
}

/* ---- weights --------------------------------------------------------------------------------- */

/* The next shifted Chebyshev polynomial in x = cos^2 phi: 2 (2 x - 1) now - before. */
static void next_chebyshev(double before[WEIGHT_POWERS], double now[WEIGHT_POWERS])
{
    double next[WEIGHT_POWERS];
    for (size_t j = 0; j < WEIGHT_POWERS; j++)
        next[j] = 4 * (j > 0 ? now[j - 1] : 0) - 2 * now[j] - before[j];
    memcpy(before, now, sizeof next);
    memcpy(now, next, sizeof next);
}

/* int_0^(pi/2) cos^p. */
static double cosine_moment(double p)
{
    return 0.5 * sqrt(M_PI) * exp(lgamma(0.5 * (p + 1)) - lgamma(0.5 * p + 1));
}

/* Ratio of the sum of absolute terms of the polynomial to its value, for moduli that are powers of
 * the frequency: |E|^2 from constant to its steepest, E'' in between. */
static double polynomial_cancellation(const double power[WEIGHT_POWERS])
{
    double cancellation = 1;
    for (int p = 0; p <= 2; p++) {
        double sum = 0, terms = 0;
        for (size_t j = 0; j < WEIGHT_POWERS; j++) {
            const double term = power[j] * cosine_moment(p + 2 * (double)j);
            sum += term;
            terms += fabs(term);
        }
        cancellation = fmax(cancellation, terms / sum);
    }
    return cancellation;
}

/* 1 / sqrt(1 - c^2) = sum_m b_m c^2m. */
static void complete_weight(angular_weight *w)
{
    double b[WEIGHT_SERIES_TERMS];
    for (size_t m = 0; m < WEIGHT_SERIES_TERMS; m++)
        b[m] = m == 0 ? 1 : b[m - 1] * (double)(2 * m - 1) / (double)(2 * m);
    w->cancellation = 1;
    for (size_t f = 0; f < 2; f++) {
        for (size_t m = 0; m < WEIGHT_SERIES_TERMS; m++)
            for (size_t j = 0; j < WEIGHT_POWERS && j <= m; j++)
                w->far[f][m] += w->power[f][j] * b[m - j];
        w->cancellation = fmax(w->cancellation, polynomial_cancellation(w->power[f]));
    }
}

angular_weight weight_longitudinal(const wt_anisotropy *a)
{
    angular_weight w = {.power = {{1}, {1}}};
    double before[WEIGHT_POWERS] = {1}, now[WEIGHT_POWERS] = {-1, 2}; /* cos 0, cos 2 phi */
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++) {
        double even, odd;
        split_harmonic(a, k, &even, &odd);
        for (size_t j = 0; j < WEIGHT_POWERS; j++)
            w.power[0][j] += even * now[j];
        next_chebyshev(before, now);
    }
    memcpy(w.power[1], w.power[0], sizeof w.power[1]);
    complete_weight(&w);
    return w;
}

angular_weight weight_lateral(const wt_anisotropy *a, double *shift)
{
    angular_weight w = {.power = {{0}, {1}}};
    /* sin(phi) sin(2 k phi) = cos(phi) 2 (1 - x) U_(k-1)(2 x - 1), within 2 k */
    double before[WEIGHT_POWERS] = {0}, now[WEIGHT_POWERS] = {1};
    *shift = 0;
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++) {
        double even, odd;
        split_harmonic(a, k, &even, &odd);
        for (size_t j = 0; j < WEIGHT_POWERS; j++)
            w.power[0][j] += 2 * odd * (now[j] - (j > 0 ? now[j - 1] : 0));
        *shift += anisotropy_order(k) * fabs(odd);
        next_chebyshev(before, now);
    }
    w.power[0][0] += *shift;
    complete_weight(&w);
    return w;
}

/* ---- sums ------------------------------------------------------------------------------------ */

double weight_evaluate(const double power[WEIGHT_POWERS], double square)
{
    double sum = power[WEIGHT_POWERS - 1];
    for (size_t j = WEIGHT_POWERS - 1; j-- > 0;)
        sum = sum * square + power[j];
    return sum;
}

void weight_series_sum(const angular_weight *w, const double *s1, const double *s2, size_t terms,
                       double square, double *sum1, double *sum2)
{
    double power = 1;
    for (size_t m = 0; m < terms; m++) {
        *sum1 += w->far[0][m] * power * s1[m];
        *sum2 += w->far[1][m] * power * s2[m];
        power *= square;
    }
}

void weight_node_sum(const angular_weight *w, size_t n, const double *omega, const double *f1,
                     const double *f2, double at, double *j1, double *j2)
{
    for (size_t i = 0; i < n; i++) {
        const double c = omega[i] / at, square = c * c;
        const double kernel = c / sqrt((1 - c) * (1 + c));
        *j1 += weight_evaluate(w->power[0], square) * kernel * c * f1[i];
        *j2 += weight_evaluate(w->power[1], square) * kernel * f2[i];
    }
}
