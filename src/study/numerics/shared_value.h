/* Common value of several independent measurements. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_NUMERICS_SHARED_VALUE_H
#define WT_STUDY_NUMERICS_SHARED_VALUE_H

#include "weartrack/study.h"

/* Weighted mean of several values, with a test of their scatter against their errors. */
typedef struct shared_value {
    double value, error, low, high; /* 95 % interval */
    double chi_squared, df, p;      /* test of no scatter beyond the errors; df: degrees of
                                       freedom of chi-squared */
} shared_value;

/* Deviation of one value from the shared value, with a simultaneous 95 % interval. */
typedef struct shared_deviation {
    double value, low, high;
} shared_deviation;

/* Fits n >= 2 values with their errors and degrees of freedom. covariance: [n n] largest possible
 * covariances, diagonal not read; may be NULL. Test and intervals also hold with zero covariance.
 * deviation: [n]. Returns WT_E_ARG if an error is not above 0. */
wt_status shared_value_fit(const wt_log_ratio *of, const double *covariance, size_t n,
                           shared_value *to, shared_deviation *deviation,
                           wt_error *err) WT_NODISCARD;

#endif
