/* Comparison of several logarithms of ratios. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_NUMERICS_LOG_RATIO_H
#define WT_STUDY_NUMERICS_LOG_RATIO_H

#include "weartrack/study.h"

/* Chance of at least the scatter of n >= 2 values if one value is behind them: Welch's test
 * (Biometrika 38 (1951) 330) with the stated degrees of freedom, or chi-squared if all errors are
 * normal. */
double log_ratios_test(const wt_log_ratio *of, size_t n);

#endif
