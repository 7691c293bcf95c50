/* Running-in curve: a predicted change of friction in a series of cycles, with a factor of its time
 * and a factor of its height. Internal to record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H
#define WT_RECORD_NUMERICS_RUNNING_IN_CURVE_H

#include "record/numerics/autocorrelation.h"
#include "weartrack/core.h"

/* Friction less final friction at times in equal ratios. It is constant before the first time, and
 * zero after the last. */
typedef struct running_in_curve {
    size_t n;
    double log_first, log_step; /* of the times [s] */
    const double *value;        /* [n] */
} running_in_curve;
double running_in_curve_at(const running_in_curve *c, double log_time);
/* Returns the largest remaining change at any time. */
double running_in_curve_height(const running_in_curve *c);
/* Returns the last time at which `share` of the height remains. NaN if the times do not include
 * it. */
double running_in_curve_settling_time(const running_in_curve *c, double share);

/* Means over equal numbers of cycles. */
typedef struct running_in_series {
    size_t n;
    double begin;     /* start of the first mean [s]; 0 unless earlier cycles are missing */
    double unsure;    /* largest error of the times [s], the same for all means */
    double shift;     /* time [s] at which growth starts; 0 unless fitted */
    double *end;      /* [n] ends from the start on [s]; each begins where the previous one ends */
    double *friction; /* [n] */
} running_in_series;
running_in_series running_in_series_alloc(size_t n);
void running_in_series_clear(running_in_series *s);

typedef struct running_in_curve_pair {
    const running_in_series *series;
    const running_in_curve *running_in_curve; /* predicted for this series */
} running_in_curve_pair;

/* Model: friction = level + ratio x curve((time - shift) / factor), with slow and white scatter of
 * one law. The shift is within the error of the times and the incubation of the curve either way,
 * so that the factor is that of the growth. The likelihood is averaged over laws and, except for
 * the factor itself, over factors; of the shifts it is the largest. Several series share factor and
 * ratio, and have a level, a law and a shift each. */
#define RUNNING_IN_CURVE_MIN_ODDS                                                                  \
    20 /* as for the running-in: at most one false alarm in twenty                                 \
        */
typedef struct running_in_curve_fit {
    bool seen;         /* odds over a constant above RUNNING_IN_CURVE_MIN_ODDS */
    double log_odds;   /* ln of the odds */
    double log_factor; /* mean; NaN unless seen */
    double error;      /* standard deviation */
    double low, high;  /* 95 % limits; NaN for a limit that the series does not determine */
    double ratio, ratio_error;
    double level, level_error; /* of the first series */
    double shift;              /* most probable shift in the first series [s] */
    double scatter;            /* variance of the means about it */
    scatter_law law;           /* law of this scatter */
} running_in_curve_fit;

/* `expected`: prior standard deviation of the logarithm of the factor. It determines the ratio if
 * no curve is seen. Returns WT_E_RANGE for fewer than RUNNING_IN_CURVE_MIN_MEANS means. */
enum { RUNNING_IN_CURVE_MIN_MEANS = 16 };
wt_status running_in_curve_fit_compute(const running_in_curve_pair *of, size_t n,
                                       double settled_share, double expected,
                                       running_in_curve_fit *fit, wt_error *err) WT_NODISCARD;
/* Most probable factor and ratio of another curve with one law. The factor is searched within
 * `within` about `around`; if `within` is 0 it is fixed at `around`. */
typedef struct running_in_optimum {
    double log_factor, ratio;
} running_in_optimum;
running_in_optimum running_in_optimum_find(const running_in_series *s, const running_in_curve *c,
                                           scatter_law law, double around, double within);
/* ln of the likelihoods of another curve with one law, without a constant of the series: at a
 * factor with any ratio, and the largest with factor and ratio from 1/margin to margin. */
typedef struct running_in_likelihoods {
    double any, within;
} running_in_likelihoods;
running_in_likelihoods running_in_likelihoods_find(const running_in_series *s,
                                                   const running_in_curve *c, scatter_law law,
                                                   double log_factor, double margin);

#endif
