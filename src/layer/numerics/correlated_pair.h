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

#endif
