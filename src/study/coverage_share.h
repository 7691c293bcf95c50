/* How often intervals held the truth, and what so many trials tell of it (internal to the flow
 * room). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_COVERAGE_SHARE_H
#define WT_STUDY_COVERAGE_SHARE_H

#include <stddef.h>

typedef struct coverage_share {
    double low, high;    /* 95 % interval of the share (Wilson) */
    const char *verdict; /* "holds", "too narrow", "too wide" or "cannot say" */
    double trials;       /* which would tell if the share stays what it is; NaN: these do */
} coverage_share;

/* Of n > 0 trials in which intervals of 95 % held the truth with this share, which need not be that
 * of a whole number of trials. Too narrow or too wide: it is outside 92 to 98 %, and so many
 * misses, or so few, are a chance of less than one in 400 (binomial). Holds: the share is known to
 * be 90 % or more. */
coverage_share coverage_assess(double share, size_t n);

#endif
