/* One value behind several that were measured apart.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_NUMERICS_SHARED_VALUE_H
#define WT_STUDY_NUMERICS_SHARED_VALUE_H

#include "weartrack/fit.h"

/* What several values have in common: their mean, weighted by their errors, and whether they
 * scatter by more than these. */
typedef struct shared_value {
    double value, error, low, high; /* interval of 95 % */
    double chi_squared, df, p;      /* of no scatter beyond the errors; df: of chi-squared */
} shared_value;

/* Of one of them, less the shared value; the interval is one of 95 % for all of them together. */
typedef struct shared_deviation {
    double value, low, high;
} shared_deviation;

/* Of n >= 2 values with their errors and degrees of freedom. covariance [n n], whose diagonal is
 * not read, may be NULL: the most that they may have in common. The test and the intervals hold
 * with none of it, too. deviation: [n]. WT_E_ARG if an error is not above 0. */
wt_status shared_value_fit(const wt_log_ratio *of, const double *covariance, size_t n,
                           shared_value *to, shared_deviation *deviation,
                           wt_error *err) WT_NODISCARD;

#endif
