/* Internal to the kernel room: Gauss-Legendre rules with the matrix of their running integral.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_MATH_GAUSS_LEGENDRE_H
#define WT_CORE_MATH_GAUSS_LEGENDRE_H

#include "weartrack/base.h"

/* On [-1, 1]. */
typedef struct gauss_rule {
    size_t n, room;  /* room: n and up to 3 more */
    double *node;    /* [n], rising */
    double *weight;  /* [n] */
    double *running; /* [n * room], row i: int from -1 to node[j] of the i-th Lagrange polynomial */
    double *top;     /* [n * RULE_TOP_ROOM], column k: weights of the Legendre coefficient
                        n - RULE_TOP + k */
    double numbers[];
} gauss_rule;

/* The largest rule; Legendre coefficients that tell how they fall, three pairs, in whole registers.
 */
enum { RULE_MOST = 20, RULE_TOP = 6, RULE_TOP_ROOM = 8 };
/* n must be one of the sizes that GSL tabulates to full precision, 2 to 20. A rule is made when it
 * is first asked for, by any thread, and kept for all. */
wt_status rule_of(size_t n, const gauss_rule **rule, wt_error *err) WT_NODISCARD;

/* Adds the integrals of f from -1 to each node to running[room]; returns that to 1. */
double rule_running(const gauss_rule *rule, const double *f, double *running);
/* The last Legendre coefficients of an integrand. */
typedef struct rule_top {
    double coefficient[RULE_TOP_ROOM];
} rule_top;
/* Of two integrands at a time. */
void rule_tops(const gauss_rule *rule, const double *f, const double *g, rule_top *of_f,
               rule_top *of_g);
/* Error of sum_i weight[i] f[i] for an integral from -1 to 1, by how the Legendre coefficients
 * fall: the rule is exact up to twice the degree of the last one. */
double rule_error(const gauss_rule *rule, const rule_top *top);

#endif
