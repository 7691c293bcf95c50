/* Ratio of two moduli as a power of the frequency, with the phase that causality requires.
 *
 * The logarithm of a minimum-phase ratio is analytic, so that its phase follows from its modulus
 * (Bode, Bell Syst. Tech. J. 19 (1940) 421), with u = ln omega:
 *   phase(u) = 1/pi int (d ln|ratio| / du') ln coth(|u - u'| / 2) du'
 * The result is exponent / pi [L(u - u_low) - L(u - u_high)], L(y) = int_0^y ln coth(|t| / 2) dt.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/friction.h"

#include <float.h>
#include <math.h>

/* Coefficient of the series of chi. */
#define TERM(k) (1.0 / ((k) * (k)))

/* Legendre's chi function, the sum of z^k / k^2 over odd k, for 0 <= z <= sqrt(2) - 1. */
static double legendre_chi_2(double z)
{
    /* The series starts at the k whose term is 1e-16 of the first. */
    static const double term[] = {TERM(35), TERM(33), TERM(31), TERM(29), TERM(27), TERM(25),
                                  TERM(23), TERM(21), TERM(19), TERM(17), TERM(15), TERM(13),
                                  TERM(11), TERM(9),  TERM(7),  TERM(5),  TERM(3),  TERM(1)};
    const double square = z * z;
    double sum = 0;
    for (size_t i = 0; i < sizeof term / sizeof term[0]; i++)
        sum = sum * square + term[i];
    return z * sum;
}

/* L as a function of z = e^-|y|, by the closed form of legendre_chi_2(z) + legendre_chi_2((1 - z) /
 * (1 + z)). */
static double phase_integral(double z)
{
    const double other = (1 - z) / (1 + z);
    if (z >= 1)
        return 0;
    return other > z ? M_PI * M_PI / 4 - 2 * legendre_chi_2(z)
                     : log(z) * log(other) + 2 * legendre_chi_2(other);
}

static double step_phase(double omega, double edge)
{
    return omega > edge ? phase_integral(edge / omega) : -phase_integral(omega / edge);
}

void wt_ratio_slope_eval(const wt_ratio_slope *slope, double omega, double *log_ratio,
                         double *phase)
{
    const double clamped = fmin(fmax(omega, slope->low), slope->high);
    *log_ratio = *phase = 0;
    if (slope->exponent == 0)
        return;
    *log_ratio = slope->exponent * log(clamped / slope->reference);
    *phase =
        slope->exponent / M_PI * (step_phase(omega, slope->low) - step_phase(omega, slope->high));
}
