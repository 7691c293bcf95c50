/* Share of trials whose interval contains the true value, with a verdict. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COVERAGE_SHARE_H
#define WT_STUDY_COVERAGE_SHARE_H

#include <stddef.h>

typedef struct coverage_share {
    double low, high;    /* 95 % interval of the share (Wilson) */
    const char *verdict; /* "holds", "too narrow", "too wide" or "cannot say" */
    double trials;       /* trials needed for a verdict with the same share; NaN if these suffice */
} coverage_share;

/* Assesses the share of n > 0 trials in which 95 % intervals contain the truth; the share times n
 * need not be an integer. "too narrow" or "too wide": the share is outside 92 % to 98 %, and the
 * binomial probability is below 1/400. "holds": the share is known to be 90 % or more. */
coverage_share coverage_assess(double share, size_t n);

#endif
