/* Spring constant of a cantilever from resonance and quality factor in a fluid, without a
 * deflection.
 *
 * Rectangular cantilevers: Sader, Chon and Mulvaney, Rev. Sci. Instrum. 70 (1999) 3967, with the
 * hydrodynamic function of Sader, J. Appl. Phys. 84 (1998) 64, eqs. 20 and 21.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/indentation.h"

#include <complex.h>
#include <math.h>

/* Value in double precision. */
static const double pi = 3.14159265358979323846;
/* Factor of eq. 1 of the paper for the first mode of a rectangular cantilever. */
static const double first_mode = 0.1906;

/* ---- the hydrodynamic function --------------------------------------------------------------- */

/* Computes exp(z) K_n(z), n = 0 and 1, for abs(arg z) < pi/2 as the integral of exp(-z (cosh t -
 * 1)) cosh(n t). The error of the trapezoidal rule falls exponentially with 1/step. The tail ends
 * where the exponent is below that of the smallest double. */
static void bessel_k(double complex z, double complex k[2])
{
    const double step = 1.0 / 64, smallest = -745; /* ln of the smallest double */
    k[0] = k[1] = 0.5 * step;
    for (double t = step;; t += step) {
        const double complex e = -z * (cosh(t) - 1);
        if (creal(e) + t < smallest)
            return;
        k[0] += step * cexp(e);
        k[1] += step * cexp(e) * cosh(t);
    }
}

static double evaluate_polynomial(const double *c, int n, double x)
{
    double sum = 0;
    while (n-- > 0)
        sum = sum * x + c[n];
    return sum;
}

/* Hydrodynamic function of a circular cylinder times a correction for a flat blade. The correction
 * is the fit of the paper, accurate to 0.1 % from Re = 1e-6 to 1e4. */
void wt_hydrodynamic_function(double reynolds, double *real, double *imaginary)
{
    /* Eqs. 21a and 21b of the paper. */
    static const double real_over[] = {0.91324,  -0.48274,   0.46842,   -0.12886,
                                       0.044055, -0.0035117, 0.00069085},
                        real_under[] = {1,        -0.56964,   0.48690,   -0.13444,
                                        0.045155, -0.0035862, 0.00069085},
                        imaginary_over[] = {-0.024134,   -0.029256,   0.016294,
                                            -0.00010961, 0.000064577, -0.000044510},
                        imaginary_under[] = {1,        -0.59702,  0.55182,  -0.18357,
                                             0.079156, -0.014369, 0.0028361};
    const double complex i = (double complex)I, root = csqrt(i * reynolds);
    const double x = log10(reynolds);
    double complex k[2];
    bessel_k(-i * root, k);
    const double complex circle = 1 + 4 * i * k[1] / (root * k[0]),
                         blade = evaluate_polynomial(real_over, 7, x) /
                                     evaluate_polynomial(real_under, 7, x) +
                                 i * evaluate_polynomial(imaginary_over, 6, x) /
                                     evaluate_polynomial(imaginary_under, 7, x);
    *real = creal(circle * blade);
    *imaginary = cimag(circle * blade);
}

/* ---- the fluid ------------------------------------------------------------------------------- */

wt_fluid wt_medium_properties(wt_medium medium, double temperature)
{
    const double t = temperature - WT_ZERO_CELSIUS, unknown = (double)NAN;
    if (medium == WT_MEDIUM_AIR) /* dry air at 1013.25 hPa; viscosity by Sutherland's law */
        return (wt_fluid){101325 * 28.9647e-3 / (8.314462618 * temperature),
                          1.716e-5 * pow(temperature / 273.15, 1.5) * (273.15 + 110.4) /
                              (temperature + 110.4)};
    if (!(t >= 0 && t <= 100))
        return (wt_fluid){unknown, unknown};
    /* Density: Tanaka et al., Metrologia 38 (2001) 301. Viscosity: IAPWS, liquid water at 0.1 MPa.
     */
    const double x = temperature / 300, off = t - 3.983035;
    return (wt_fluid){999.97495 * (1 - off * off * (t + 301.797) / (522528.9 * (t + 69.34881))),
                      1e-6 * (280.68 * pow(x, -1.9) + 511.45 * pow(x, -7.7) +
                              61.131 * pow(x, -19.6) + 0.45903 * pow(x, -40))};
}

/* ---- the spring constant --------------------------------------------------------------------- */

static double sader_stiffness(double length, double width, double resonance, double quality,
                              wt_fluid fluid)
{
    const double omega = 2 * pi * resonance;
    double real, imaginary;
    wt_hydrodynamic_function(fluid.density * omega * width * width / (4 * fluid.viscosity), &real,
                             &imaginary);
    return first_mode * fluid.density * width * width * length * quality * imaginary * omega *
           omega;
}

wt_estimate wt_sader_spring_constant(wt_estimate length, wt_estimate width, wt_estimate resonance,
                                     wt_estimate quality, wt_fluid fluid)
{
    const double step =
        1e-4; /* of a difference quotient, whose error is of the order of its square */
    const double l = length.value, b = width.value, f = resonance.value, q = quality.value;
    const double k = sader_stiffness(l, b, f, q, fluid);
    const double compare_widths = log(sader_stiffness(l, b * (1 + step), f, q, fluid) /
                                      sader_stiffness(l, b * (1 - step), f, q, fluid)) /
                                  (2 * step),
                 by_resonance = log(sader_stiffness(l, b, f * (1 + step), q, fluid) /
                                    sader_stiffness(l, b, f * (1 - step), q, fluid)) /
                                (2 * step);
    const double error = hypot(hypot(length.standard_error / l, quality.standard_error / q),
                               hypot(compare_widths * width.standard_error / b,
                                     by_resonance * resonance.standard_error / f));
    return (wt_estimate){k, k * error, 0, "N/m"};
}
