/* Gauss-Legendre rules with the matrix of their running integral. Internal to math.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_GAUSS_LEGENDRE_H
#define WT_CORE_MATH_GAUSS_LEGENDRE_H

#include "weartrack/core.h"

/* Rule on [-1, 1]. */
typedef struct gauss_rule {
    size_t n, row_stride; /* row_stride: n rounded up to a multiple of 4 */
    double *node;         /* [n], increasing */
    double *weight;       /* [n] */
    double *running;      /* [n * row_stride], row i: int from -1 to node[j] of the i-th Lagrange
                             polynomial */
    double *top; /* [n * LEGENDRE_TOP_STRIDE], column k: weights of the Legendre coefficient
                    n - LEGENDRE_TOP + k */
    double numbers[];
} gauss_rule;

/* Largest number of nodes; number of Legendre coefficients for the error estimate (three pairs),
 * and this number in whole registers. */
enum { GAUSS_NODES_MAX = 20, LEGENDRE_TOP = 6, LEGENDRE_TOP_STRIDE = 8 };
/* Returns the rule with n nodes. n must be one of the sizes that GSL tabulates to full precision, 2
 * to 20. A rule is created at the first request of any thread and shared by all. */
const gauss_rule *gauss_rule_get(size_t n);

/* Adds the integrals of f from -1 to each node to running[row_stride]. Returns the integral to 1.
 */
double gauss_rule_integrate(const gauss_rule *rule, const double *f, double *running);
/* Last Legendre coefficients of an integrand. */
typedef struct legendre_top {
    double coefficient[LEGENDRE_TOP_STRIDE];
} legendre_top;
/* Computes the coefficients of two integrands. */
void gauss_rule_top_coefficients(const gauss_rule *rule, const double *f, const double *g,
                                 legendre_top *of_f, legendre_top *of_g);
/* Estimates the error of sum_i weight[i] f[i] as an integral from -1 to 1, from the decay of the
 * Legendre coefficients. The rule is exact up to twice the degree of the last coefficient. */
double gauss_rule_error(const gauss_rule *rule, const legendre_top *top);

#endif
