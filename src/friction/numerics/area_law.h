/* Contact area in partial contact according to simulations; Persson's diffusion of the stress
 * underestimates it. Internal to friction.
 *
 *   dG = S(P) dG0   with yp08: S = 0.42 + 0.58 P^2   and   wm17: S = 5/9 - 2/9 P^2 + 2/3 P^4
 *   G = (0.42 + 0.58 P) G0                           for   xu24
 *   P = erf(1 / (2 sqrt G))
 *
 * G0 is the variance of the stress at full contact, which depends on moduli, spectrum and pressure.
 * G is a function of G0 alone and is tabulated once.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_AREA_LAW_H
#define WT_FRICTION_NUMERICS_AREA_LAW_H

#include "weartrack/friction.h"

typedef struct area_law area_law;

/* Returns the law, which the first request creates for all threads. It is never freed. NULL for
 * Persson's law. */
wt_status area_law_get(wt_area_law kind, const area_law **law, wt_error *err) WT_NODISCARD;
/* Returns G as a function of G0; G0 itself for a NULL law. */
double area_law_variance(const area_law *law, double variance);
/* int_0^G0 S_mu P dG0' with S_mu = gamma + (1 - gamma) P^2. */
double area_law_integral(const area_law *law, double variance, double gamma);

#endif
