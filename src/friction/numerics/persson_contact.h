/* Contact area as a function of the stress variance G. Internal to friction.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FRICTION_NUMERICS_PERSSON_CONTACT_H
#define WT_FRICTION_NUMERICS_PERSSON_CONTACT_H

#include <stddef.h>

/* Below this variance 1 - P is less than 1e-38. */
#define CONTACT_FULL_VARIANCE 3e-3

/* P = erf(1 / (2 sqrt G)); 1 for G <= 0. */
double contact_area(double variance);
/* Contact areas of n rising variances. Both arrays have this number of additional elements, whose
 * values are arbitrary. */
enum { CONTACT_PADDING = 3 };
void contact_areas(const double *variance, size_t n, double *area);
/* 1 - P without cancellation. */
double contact_gap(double variance);
/* Change of P, and of 1 - P, due to the error of G. */
double contact_area_error(double variance, double variance_error);
double contact_gap_error(double variance, double variance_error);
/* int_0^G S P dG' with S = gamma + (1 - gamma) P^2. */
double contact_integral(double variance, double gamma);

/* Ratio of the modulus of a bulk with a bonded layer to that of the bulk: E_eff(q) / E_bulk with x
 * = q thickness and ratio = E_layer / E_bulk. It is 1 for x = 0 and ratio for x = infinity. */
double layered_scale(double x, double ratio);
/* exp(-x) (sinh(x) - x) for x >= 0, without cancellation. */
double sinh_excess(double x);

#endif
