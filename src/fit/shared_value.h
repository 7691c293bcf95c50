/* One value behind several that were measured apart.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FIT_SHARED_VALUE_H
#define WEARTRACK_FIT_SHARED_VALUE_H

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

/* Of n >= 2 values with their errors and degrees of freedom. The covariances [n n], whose diagonals
 * are not read, may be NULL: `certain` is what they surely have in common, which goes into the
 * test; `possible` what they may have, which goes into the error of the shared value. deviation:
 * [n]. WT_E_ARG if an error is not above 0 or the covariances are none. */
wt_status shared_value_fit(const wt_log_ratio *of, const double *certain, const double *possible,
                           size_t n, shared_value *to, shared_deviation *deviation,
                           wt_error *err) WT_NODISCARD;

#endif
