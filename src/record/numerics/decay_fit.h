/* Fit of a decay to a series of cycles, with the factor of its time unknown. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_DECAY_FIT_H
#define WT_RECORD_NUMERICS_DECAY_FIT_H

#include <stdbool.h>
#include <stddef.h>

/* Model of n means over equal times, in units of the length of the series: level + ratio x
 * exp(-(t / factor)^power), with slow and white scatter. The likelihood is averaged over laws of
 * the scatter and over factors. */
typedef struct decay_fit {
    bool seen;                 /* odds over a constant above DECAY_MIN_ODDS */
    double log_odds;           /* ln of these odds */
    double log_factor;         /* mean */
    double ratio;              /* mean */
    double level, level_error; /* mean and standard deviation */
} decay_fit;

/* As for the running-in: at most one false alarm in twenty. */
#define DECAY_MIN_ODDS 20
/* Fewest means of a fit. */
enum { DECAY_MIN_MEANS = 16 };

/* Fits a power. The series must scatter. Only the odds are set unless the decay is seen. */
decay_fit decay_fit_compute(const double *y, size_t n, double power);

#endif
