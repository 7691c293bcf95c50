/* Two correlated constants as logarithms: critical energy U_c and specific wear rate k of a layer.
 * Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_NUMERICS_CORRELATED_PAIR_H
#define WT_LAYER_NUMERICS_CORRELATED_PAIR_H

#include "weartrack/core.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct pair_covariance {
    double energy, wear, both; /* variances of ln U_c and ln k, and their covariance */
} pair_covariance;

/* Principal axes of a covariance; NaN and "" if unknown. */
typedef struct constant_axes {
    double correlation;
    char loose[32];                  /* combination with the largest uncertainty: "U_c k^-0.42" */
    double loose_error, tight_error; /* standard deviations along and across that combination */
} constant_axes;
constant_axes constant_axes_compute(pair_covariance c);

/* ln U_c and ln k of a case. */
typedef struct constant_pair {
    double energy, wear;
    pair_covariance whole;
    pair_covariance inputs; /* part of the covariance that cases may share */
} constant_pair;

/* Common pair of all cases: the weighted mean, its covariance, and chi-squared with 2 (n - 1)
 * degrees of freedom and its p value. Two assumptions are compared: independent cases, and
 * systematic errors according to `common`, an [n n] array that is true if i and k share the errors
 * of `inputs`. Chi-squared is the smaller result and the covariance the larger. */
typedef struct shared_pair {
    double energy, wear;
    pair_covariance covariance;
    double chi_squared, p;
} shared_pair;
wt_status shared_pair_fit(const constant_pair *of, const bool *common, size_t n, shared_pair *to,
                          wt_error *err) WT_NODISCARD;

#endif
