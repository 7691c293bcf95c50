/* Decay of a series towards a plateau that it does not reach. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_STEADY_STATE_H
#define WT_RECORD_NUMERICS_STEADY_STATE_H

#include "weartrack/core.h"

/* Model: plateau + change x exp(-(t / time)^power). The likelihood is averaged over powers from 1/2
 * to 1, times and laws of the scatter. */
typedef struct steady_decay {
    bool is_detected;    /* odds above 20 to 1 against a running-in that ends within the series */
    wt_interval plateau; /* 95 %, with an error for the law */
    double left;         /* of the change at the end */
} steady_decay;
steady_decay steady_decay_find(const double *y, size_t n);

/* Whether the plateau is told, and whether the decay goes on at the end. */
typedef enum steady_decay_kind {
    DECAY_NONE,
    DECAY_TOLD,
    DECAY_GOES_ON,
    DECAY_UNKNOWN
} steady_decay_kind;
/* Replaces the mean of the steady part by the plateau of a decay in it, if the plateau is known
 * better than the mean is off it. Else the error of the mean holds what it is off. *left: of the
 * change at the end, if the decay goes on. */
steady_decay_kind steady_decay_follow(const double *y, size_t n, wt_interval *mean, double *left);

#endif
