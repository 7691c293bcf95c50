/* Two constants that are known together, as logarithms: critical energy U_c and specific wear rate
 * k of a layer. Internal. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_NUMERICS_CORRELATED_PAIR_H
#define WT_LAYER_NUMERICS_CORRELATED_PAIR_H

#include "weartrack/fit.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct pair_covariance {
    double energy, wear, both; /* variances of ln U_c and ln k, and their covariance */
} pair_covariance;

/* A covariance by its main axes; NaN and "": not known. */
typedef struct constant_axes {
    double correlation;
    char loose[32];                  /* the combination that is known least: "U_c k^-0.42" */
    double loose_error, tight_error; /* standard deviations along it and across it */
} constant_axes;
constant_axes constant_axes_of(pair_covariance c);

/* ln U_c and ln k of a case. */
typedef struct constant_pair {
    double energy, wear;
    pair_covariance whole;
    pair_covariance inputs; /* the part of it that other cases may have in common */
} constant_pair;

/* One pair behind all: the weighted one, its covariance, and chi-squared of 2 (n - 1) degrees of
 * freedom with its p. Chi-squared is the less and the covariance the larger of those with nothing
 * in common and with all that `common` says: [n n], true where i and k share what `inputs` is of.
 */
typedef struct shared_pair {
    double energy, wear;
    pair_covariance covariance;
    double chi_squared, p;
} shared_pair;
wt_status shared_pair_fit(const constant_pair *of, const bool *common, size_t n, shared_pair *to,
                          wt_error *err) WT_NODISCARD;

#endif
