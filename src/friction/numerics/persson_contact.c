/* Contact area, its integral over the stress variance, and the stiffness of a layered half-space.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/persson_contact.h"

#include "core/math/simd.h"
#include "core/math/special.h"

#include <float.h>
#include <math.h>

double contact_area(double variance)
{
    return variance > CONTACT_FULL_VARIANCE ? erf(0.5 / sqrt(variance)) : 1;
}

/* Above this variance the argument of erf is at most 1, and its power series converges fast. */
static const double large_variance = 0.25;
/* Lengths in whole registers, because a partial register costs as much. */
enum { REGISTER_LENGTH = CONTACT_PADDING + 1, REGISTERS_PER_BATCH = 8 };

/* erf(x) = 2 / sqrt(pi) sum of (-1)^k x^(2 k + 1) / (k! (2 k + 1)), even and odd k in turn. */
WIDE_REGISTERS
static void large_variance_areas(const double *restrict variance, size_t registers,
                                 double *restrict area)
{
    for (size_t i = 0; i < registers * REGISTER_LENGTH; i++) {
        const double square = 0.25 / variance[i], fourth = square * square;
        double even = 1 / 690452066304000.0, odd = 1 / 12449059983360000.0; /* k = 16, 17 */
        even = even * fourth + 1 / 2528170444800.0;
        odd = odd * fourth + 1 / 40537905408000.0;
        even = even * fourth + 1 / 11975040000.0;
        odd = odd * fourth + 1 / 168129561600.0;
        even = even * fourth + 1 / 76204800.0;
        odd = odd * fourth + 1 / 918086400.0;
        even = even * fourth + 1 / 685440.0;
        odd = odd * fourth + 1 / 6894720.0;
        even = even * fourth + 1 / 9360.0;
        odd = odd * fourth + 1 / 75600.0;
        even = even * fourth + 1 / 216.0;
        odd = odd * fourth + 1 / 1320.0;
        even = even * fourth + 1 / 10.0;
        odd = odd * fourth + 1 / 42.0;
        even = even * fourth + 1;
        odd = odd * fourth + 1 / 3.0;
        area[i] = M_2_SQRTPI * sqrt(square) * (even - square * odd);
    }
}

/* For smaller variances erf(x) = 1 - e^(-x^2) h(x). h varies slowly and is a polynomial of degree
 * 14 in z = 9.6 / (x + 2) - 2.2. z is 1 at x = 1 and -1 at x = 6, where e^(-x^2) is 2e-16. The
 * polynomial interpolates at Chebyshev nodes with the error 3e-17. */
WIDE_REGISTERS
static void scaled_erfc(const double *restrict variance, size_t registers,
                        double *restrict exponent, double *restrict ratio)
{
    for (size_t i = 0; i < registers * REGISTER_LENGTH; i++) {
        const double z = 9.6 / (0.5 / sqrt(variance[i]) + 2) - 2.2, zz = z * z;
        exponent[i] = -0.25 / variance[i];
        double even = 1.8387975053360617e-11, odd = -7.2896200910643853e-11;
        even = even * zz - 2.6260844505113418e-10;
        odd = odd * zz + 2.622321114247012e-9;
        even = even * zz - 5.9375842996148518e-10;
        odd = odd * zz - 7.0051665841091908e-8;
        even = even * zz + 1.6350178932803755e-7;
        odd = odd * zz + 1.9795611364327234e-6;
        even = even * zz - 7.3405185531343522e-6;
        odd = odd * zz - 8.0792204111672134e-5;
        even = even * zz + 0.00019713917780481361;
        odd = odd * zz + 0.0055888162818250791;
        even = even * zz + 0.038560570425178765;
        odd = odd * zz + 0.16189356804102538;
        even = even * zz + 0.22142954022993183;
        ratio[i] = even + z * odd;
    }
}

static void small_variance_areas(const double *variance, size_t registers, double *area)
{
    double exponent[REGISTER_LENGTH * REGISTERS_PER_BATCH],
        ratio[REGISTER_LENGTH * REGISTERS_PER_BATCH], power[REGISTER_LENGTH * REGISTERS_PER_BATCH];
    for (size_t from = 0, n; from < registers; from += n) {
        n = registers - from < REGISTERS_PER_BATCH ? registers - from : REGISTERS_PER_BATCH;
        scaled_erfc(variance + from * REGISTER_LENGTH, n, exponent, ratio);
        vector_exp(exponent, n * REGISTER_LENGTH, power);
        for (size_t i = 0; i < n * REGISTER_LENGTH; i++)
            area[from * REGISTER_LENGTH + i] = 1 - power[i] * ratio[i];
    }
}

void contact_areas(const double *variance, size_t n, double *area)
{
    size_t full = 0, early;
    while (full < n && !(variance[full] > CONTACT_FULL_VARIANCE))
        area[full++] = 1;
    for (early = full; early < n && !(variance[early] > large_variance);)
        early++;
    if (early > full)
        small_variance_areas(variance + full,
                             (early - full + REGISTER_LENGTH - 1) / REGISTER_LENGTH, area + full);
    if (n > early)
        large_variance_areas(variance + early, (n - early + REGISTER_LENGTH - 1) / REGISTER_LENGTH,
                             area + early);
}

/* erfc is so steep that the rounding of its argument y matters; y^2 G = 1/4 gives that rounding. */
double contact_gap(double variance)
{
    const double y = variance > 0 ? 0.5 / sqrt(variance) : (double)INFINITY;
    if (y > 27) /* erfc is 0 in double precision */
        return 0;
    const double square = y * y, rest = fma(y, y, -square) * variance;
    const double missing = (fma(-square, variance, 0.25) - rest) / (2 * y * variance);
    return erfc(y) - M_2_SQRTPI * exp(-square) * missing;
}

/* Change of P = erf(y), y^2 = 1 / (4 G), with G by its slope. Within G (1 +- e) the slope is larger
 * by at most (1 - e)^-1.5 exp(y^2 e). NaN if the change is too large for that. */
static double linear_change(double variance, double variance_error)
{
    const double e = variance_error / variance, square = 0.25 / variance, power = square * e;
    if (!(e < 0.01 && power < 0.1))
        return (double)NAN;
    const double slope = exp(-square) * sqrt(square / M_PI);
    return slope * e * (1 + 2 * e) * (1 + 2 * power);
}

double contact_area_error(double variance, double variance_error)
{
    const double area = contact_area(variance), change = linear_change(variance, variance_error);
    if (change >= 0)
        return change + 4 * DBL_EPSILON * area;
    const double above = area - contact_area(variance + variance_error);
    const double below = contact_area(fmax(0, variance - variance_error)) - area;
    const double moved = fmax(fabs(above), fabs(below));
    return moved + 16 * DBL_EPSILON * (area + moved);
}

/* Relative error of 1 - P: some dozens of roundings of the series and of exp. It is ten times as
 * large if G is rounded before, because y^2 is up to 27^2. */
static const double gap_rounding = 1e-14;

double contact_gap_error(double variance, double variance_error)
{
    const double gap = contact_gap(variance), change = linear_change(variance, variance_error);
    /* where erfc underflows, the true value is below the smallest normal number */
    const double least = variance > 0 ? DBL_MIN : 0;
    if (change >= 0)
        return fmax(change + gap_rounding * gap, least);
    const double above = contact_gap(variance + variance_error) - gap;
    const double below = gap - contact_gap(fmax(0, variance - variance_error));
    const double moved = fmax(above, below);
    return fmax(moved + 10 * gap_rounding * (gap + moved), least);
}

/* int_0^G P^3 dG = int_y^inf erf(u)^3 / (2 u^3) du with y = 1 / (2 sqrt G). erf is 1 beyond u = 6;
 * below it the integrand is smooth, so that composite Gauss-Legendre with 8 nodes is exact. */
static double cube_integral(double variance)
{
    const double end = 6;
    const double y = 0.5 / sqrt(variance);
    if (!(y < end))
        return variance;
    const int pieces = 16;
    const double half = (end - y) / (2 * pieces);
    double sum = 0;
    for (int p = 0; p < pieces; p++) {
        const double middle = y + (2 * p + 1) * half;
        for (int i = 0; i < 4; i++) {
            const double low = middle - half * gauss_8_node[i];
            const double high = middle + half * gauss_8_node[i];
            const double at_low = erf(low) / low;
            const double at_high = erf(high) / high;
            sum += half * gauss_8_weight[i] *
                   (at_low * at_low * at_low + at_high * at_high * at_high) / 2;
        }
    }
    return sum + 0.25 / (end * end);
}

double contact_integral(double variance, double gamma)
{
    if (!(variance > CONTACT_FULL_VARIANCE))
        return variance;
    const double y = 0.5 / sqrt(variance);
    const double plain = variance * erf(y) + sqrt(variance / M_PI) * exp(-y * y) - 0.5 * erfc(y);
    return gamma == 1 ? plain : gamma * plain + (1 - gamma) * cube_integral(variance);
}

double sinh_excess(double x)
{
    if (x > 1)
        return -0.5 * expm1(-2 * x) - x * exp(-x);
    const double square = x * x;
    double term = x;
    double sum = 0;
    for (int k = 1; k <= 9; k++) { /* x^19/19! is 8e-18 at x = 1, and the sum at least x^3/6 */
        term *= square / ((2 * k) * (2 * k + 1));
        sum += term;
    }
    return exp(-x) * sum;
}

/* Burmister (1943), nu = 1/2, bonded: E_eff = E_layer / F with
 *   F = [1 + 4 N x e - N^2 e^2] / [1 - 2 N (1 + 2 x^2) e + N^2 e^2],
 *   e = exp(-2 x), N = (ratio - 1) / (ratio + 1).
 * Both brackets are written as sums of positive terms to avoid cancellation. */
double layered_scale(double x, double ratio)
{
    if (ratio == 1 || !(x > 0))
        return 1;
    if (x > 400) /* exp(-2 x) is 0 in double precision */
        return ratio;
    const double mismatch = fabs(ratio - 1) / (ratio + 1);
    const double rest = 2 * fmin(1, ratio) / (ratio + 1); /* 1 - |N| */
    const double e = exp(-2 * x);
    double numerator, denominator;
    if (ratio < 1) { /* N < 0 */
        numerator = rest * (1 + mismatch * e * e) + 2 * mismatch * sinh_excess(2 * x);
        denominator = (1 + mismatch * e) * (1 + mismatch * e) + 4 * mismatch * x * x * e;
    } else {
        const double m = sqrt(mismatch);
        const double rest_m = rest / (1 + m);
        const double low = rest_m * (1 + m * e) + 2 * m * sinh_excess(x);
        const double high = rest - mismatch * expm1(-2 * x) + 2 * x * m * exp(-x);
        numerator =
            (1 + mismatch) * rest - mismatch * mismatch * expm1(-4 * x) + 4 * mismatch * x * e;
        denominator = low * high;
    }
    return ratio * denominator / numerator;
}
